// The gate and the comparison with an earlier run as members of a JSON document.
#include <algorithm>

#include "report/diagnostics_common.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/verdict.hpp"

namespace deck {
namespace {

void write_finding(JsonWriter& j, const Deck& deck, const Diagnostic& d) {
  j.begin_object().field("rule", id_text(d.rule)).field("severity", to_string(d.severity));
  j.field("message", d.message).key("source");
  write_json_place(j, deck, d.span);
  j.key("entity");
  if (d.keyword.empty())
    j.null();
  else
    j.begin_object(true).field("keyword", d.keyword).field("id", d.id).end_object();
  j.end_object();
}

void write_ids(JsonWriter& j, const std::array<std::int64_t, 2>& secondary) {
  if (secondary[1] == 0) {
    j.field("node", secondary[0]);
    return;
  }
  j.key("edge").begin_array(true).value(secondary[0]).value(secondary[1]).end_array();
}

void write_counts(JsonWriter& j, const GateReport& gate) {
  j.field("with", gate.earlier->path).field("deck", gate.earlier->deck_path);
  for (const Trend t : {Trend::fresh, Trend::worse, Trend::better, Trend::same})
    j.field(to_string(t), gate.comparison.count(t));
  j.field("solved", std::uint64_t{gate.comparison.solved.size()});
}

void write_comparison(JsonWriter& j, const Scene& scene, const SceneView& view,
                      const GateReport& gate) {
  const EarlierGaps& earlier = *gate.earlier;
  const GapsComparison& c = gate.comparison;
  j.begin_object();
  write_counts(j, gate);
  j.key("rows").begin_array();
  for (const GapsComparison::Row& r : c.rows) {
    if (r.trend == Trend::same) continue;
    const NamedPenetration& p = view.penetrations[r.penetration];
    const Contact& contact = scene.contacts[p.contact];
    j.begin_object(true).field("change", to_string(r.trend)).field("interface", contact.inter->id);
    j.field("role", to_string(contact.role));
    write_ids(j, p.secondary);
    j.field("depth", contact.penetrations[p.row].depth).key("was");
    r.earlier == no_index ? j.null() : j.value(earlier.rows[r.earlier].depth);
    j.end_object();
  }
  for (const std::uint32_t i : c.solved) {
    const EarlierGaps::Row& row = earlier.rows[i];
    j.begin_object(true).field("change", "solved").field("interface", row.interface_id);
    j.field("role", row.role);
    write_ids(j, row.secondary);
    j.key("depth").null().field("was", row.depth).end_object();
  }
  j.end_array().end_object();
}

}  // namespace

std::size_t undecided_contacts(const Scene& scene) {
  return static_cast<std::size_t>(std::count_if(scene.contacts.begin(), scene.contacts.end(),
                                                [](const Contact& c) { return !c.evaluated; }));
}

GateReport gate_report(const Gate& gate, const Scene& scene, const SceneView& view,
                       const cycle::SceneOutcome* forces, const EarlierGaps* earlier,
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

void write_gate(JsonWriter& j, const Deck& deck, const Scene& scene, const SceneView& view,
                const GateReport& gate) {
  j.key("gate");
  if (!gate.asked) {
    j.null();
  } else {
    j.begin_object().field("passed", gate.passed());
    j.field("undecided", std::uint64_t{gate.undecided}).key("findings").begin_array();
    for (const Diagnostic& d : gate.findings) write_finding(j, deck, d);
    j.end_array().end_object();
  }
  j.key("compared");
  gate.earlier != nullptr ? write_comparison(j, scene, view, gate) : void(j.null());
}

std::string gate_json(const LintedDeck& deck, const GateReport& gate,
                      const std::vector<const Diagnostic*>& stops, bool passed) {
  std::string out;
  JsonWriter j(out);
  j.begin_object();
  write_json_head(j, "deck/gate", 1);
  write_json_deck(j, deck.path, *deck.deck, nullptr, nullptr);
  write_verdict(j, deck.verdict ? *deck.verdict : lint_verdict(deck));
  j.field("passed", passed).field("undecided", std::uint64_t{gate.undecided});
  j.key("findings").begin_array();
  for (const Diagnostic* d : stops) write_finding(j, *deck.deck, *d);
  j.end_array().key("compared");
  if (gate.earlier == nullptr) {
    j.null();
  } else {
    j.begin_object(true);
    write_counts(j, gate);
    j.end_object();
  }
  const LintResult& r = *deck.result;
  j.key("summary").begin_object(true).field("errors", r.errors).field("warnings", r.warnings);
  j.field("infos", r.infos).field("baselined", r.baselined).end_object();
  j.end_object();
  return out + "\n";
}

}  // namespace deck
