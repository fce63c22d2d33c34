// The report of a gate, and the document of `deck gate --json`.
#include <algorithm>
#include <string>

#include "deck/report.hpp"
#include "report/shared/gate.hpp"
#include "report/shared_records.hpp"

namespace deck {

COMMON_RECORD(GateFinding, "gate_finding", "A bound that is exceeded.",
              COLUMN("rule", "", id_text(r.d->rule)),
              COLUMN("severity", "", to_string(r.d->severity)), COLUMN("message", "", r.d->message),
              COLUMN("source", "", place_of(*r.deck, r.d->span)),
              COLUMN("entity", "", entity_of(*r.d)));

namespace {

/// A penetration that is new, worse, better or solved since the earlier document.
struct ChangedRow {
  std::string_view change;
  std::int64_t interface_id = 0;
  std::string_view role;
  std::array<std::int64_t, 2> secondary{};
  std::optional<double> depth, was;
};
COMMON_LINE_RECORD(ChangedRow, "changed", "A node or edge, by its deepest pair.",
                   COLUMN("change", "new, worse, better or solved", r.change),
                   COLUMN("interface", "", r.interface_id), COLUMN("role", "", r.role),
                   COLUMN("node", "Secondary node", if_any(r.secondary[1] == 0, r.secondary[0])),
                   COLUMN("edge", "Secondary edge", if_any(r.secondary[1] != 0, r.secondary)),
                   COLUMN("depth", "", r.depth),
                   COLUMN("was", "Depth in the earlier document", r.was));

void each_changed(const ComparedRow& r, const std::function<void(const ChangedRow&)>& add) {
  const GapBaseline& earlier = *r.gate->earlier;
  for (const GapsComparison::Row& row : r.gate->comparison.rows) {
    if (row.trend == Trend::same) continue;
    const NamedPenetration& p = r.view->penetrations[row.penetration];
    const Contact& contact = r.scene->contacts[p.contact];
    add({to_string(row.trend), contact.inter->id, to_string(contact.role), p.secondary,
         contact.penetrations[p.row].depth,
         row.earlier == no_index ? std::nullopt
                                 : std::optional<double>(earlier.rows[row.earlier].depth)});
  }
  for (const std::uint32_t i : r.gate->comparison.solved) {
    const GapBaseline::Row& row = earlier.rows[i];
    add({"solved", row.interface_id, row.role, row.secondary, std::nullopt, row.depth});
  }
}

/// For rows with a member `gate` that has an earlier document.
constexpr ColumnsOf comparison_columns(COLUMN("with", "", r.gate->earlier->path),
                                       COLUMN("deck", "", r.gate->earlier->deck_path),
                                       COLUMN("new", "", r.gate->comparison.count(Trend::added)),
                                       COLUMN("worse", "", r.gate->comparison.count(Trend::worse)),
                                       COLUMN("better", "",
                                              r.gate->comparison.count(Trend::better)),
                                       COLUMN("same", "", r.gate->comparison.count(Trend::same)),
                                       COLUMN("solved", "", r.gate->comparison.solved.size()));

/// The arguments of gate_json().
struct GateDocument {
  const LintedDeck* linted = nullptr;
  const GateReport* gate = nullptr;
  const std::vector<const Finding*>* stops = nullptr;
  bool passed = false;
};

/// The comparison as numbers.
struct Compared {
  const GateReport* gate = nullptr;
};
LINE_RECORD(Compared, "compared",
            "Nodes and edges, each by its deepest pair, against the earlier document.",
            comparison_columns);

RECORD(GateDocument, "document", "",
       COLUMN("deck", "", DeckRow{r.linted->path, r.linted->deck, nullptr, nullptr}),
       COLUMN("verdict", "", verdict_of(*r.linted)), COLUMN("passed", "", r.passed),
       COLUMN("undecided", "Contacts that could not be evaluated", r.gate->undecided),
       COLUMN("findings", "Those that fail the gate", rows<GateFinding>(*r.stops, r.linted->deck)),
       COLUMN("compared", "null: nothing was compared",
              known(r.gate->earlier != nullptr, Compared{r.gate})),
       LINE_OBJECT("summary", "Findings of lint.", finding_columns,
                   COLUMN("baselined", "Known from the baseline", r.linted->result->baselined)));

constexpr DocumentHead gate_head{"deck/gate", 1, "Written by deck gate --json."};

}  // namespace

COMMON_RECORD(GateRow, "gate",
              "Result of the bounds of --max-depth and its like, or of [gate] in .decklint.toml.",
              COLUMN("passed", "", r.gate->passed()),
              COLUMN("undecided", "Contacts that could not be evaluated", r.gate->undecided),
              COLUMN("findings", "", rows<GateFinding>(r.gate->findings, r.deck)));

COMMON_RECORD(
    ComparedRow, "compared",
    "Against the earlier document of --compare, or of 'compare' in [gate]: nodes and edges, each "
    "by its deepest pair.",
    comparison_columns, COLUMN("rows", "", rows_from<each_changed>(r)));

IfAny<std::optional<GateRow>> gate_of(const Deck& deck, const GateReport* gate) {
  if (gate == nullptr) return {};
  return {known(gate->asked, GateRow{&deck, gate})};
}

IfAny<std::optional<ComparedRow>> comparison_of(const Scene& scene, const SceneView& view,
                                                const GateReport* gate) {
  if (gate == nullptr) return {};
  return {known(gate->earlier != nullptr, ComparedRow{&scene, &view, gate})};
}

void write_gate(JsonWriter& json, const Deck& deck, const Scene& scene, const SceneView& view,
                const GateReport& gate) {
  write_value(json.key("gate"), gate_of(deck, &gate).value);
  write_value(json.key("compared"), comparison_of(scene, view, &gate).value);
}

std::size_t undecided_contacts(const Scene& scene) {
  return static_cast<std::size_t>(std::count_if(scene.contacts.begin(), scene.contacts.end(),
                                                [](const Contact& c) { return !c.evaluated; }));
}

GateReport gate_report(const Gate& gate, const Scene& scene, const SceneView& view,
                       const cycle::SceneOutcome* forces, const GapBaseline* earlier,
                       const ChangedLines* changed) {
  GateReport report;
  report.asked = gate.any();
  if (earlier != nullptr) {
    report.earlier = earlier;
    report.comparison = compare_gaps(*earlier, scene, view);
  }
  if (!report.asked) return report;
  report.undecided = undecided_contacts(scene);
  report.findings = check_gate(gate, scene, view, forces, earlier, changed);
  return report;
}

DocumentSchema gate_schema() { return document_schema<GateDocument>(gate_head); }

std::string gate_json(const LintedDeck& deck, const GateReport& gate,
                      const std::vector<const Finding*>& stops, bool passed) {
  return write_document(gate_head, GateDocument{&deck, &gate, &stops, passed}) + "\n";
}

}  // namespace deck
