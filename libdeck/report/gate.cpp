// The gate: its report, the earlier document that it compares with, and the document of `deck gate
// --json`.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "deck/report.hpp"
#include "report/shared/gate.hpp"
#include "report/shared_records.hpp"
#include "text/shared/read_json.hpp"

namespace deck {

namespace {

using Json = nlohmann::json;

Error wrong(const std::string& path, const std::string& why) {
  return {Error::Code::syntax,
          path + ": " + why + "; expected the document that 'deck gaps --json' writes"};
}

/// A member of an object; null where there is none.
const Json& member(const Json& object, const char* key) {
  static const Json none;
  const auto it = object.find(key);
  return it != object.end() ? *it : none;
}

/// A member that is a list; empty where there is none.
const Json& list(const Json& object, const char* key) {
  static const Json none = Json::array();
  const Json& found = member(object, key);
  return found.is_array() ? found : none;
}

bool is_gaps(const Json& d) { return member(d, "interfaces").is_array(); }

std::string text(const Json& object, const char* key) {
  const Json& found = member(object, key);
  return found.is_string() ? found.get<std::string>() : std::string();
}

std::string deck_path_of(const Json& d) { return text(member(d, "deck"), "path"); }

/// null stands for a number that no computation can hold: of a gap without bound.
double number(const Json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) return 0;
  return it->is_number() ? it->get<double>()
         : it->is_null() ? std::numeric_limits<double>::max()
                         : 0;
}

std::int64_t whole(const Json& v) { return v.is_number_integer() ? v.get<std::int64_t>() : 0; }

/// A document of `gaps --all` is large, and little of it is compared: the rest is not kept.
bool is_compared(int, Json::parse_event_t event, Json& parsed) {
  static const std::set<std::string, std::less<>> keys = {
      "at",          "contacts",     "deck",       "decks",   "edge",      "edge_penetrations",
      "gap",         "id",           "interfaces", "node",    "nodes",     "path",
      "penetration", "penetrations", "role",       "schema",  "sentences", "tied",
      "tied_pairs",  "ties",         "verdict",    "version", "what"};
  return event != Json::parse_event_t::key || keys.contains(parsed.get_ref<std::string&>());
}

EarlierGaps::Row row_of(const Json& p) {
  EarlierGaps::Row row;
  if (const Json& edge = list(p, "edge"); edge.size() == 2) {
    row.secondary = {whole(edge[0]), whole(edge[1])};
    std::sort(row.secondary.begin(), row.secondary.end());
  } else {
    row.secondary = {whole(member(p, "node")), 0};
  }
  row.depth = number(p, "penetration");
  row.gap = number(p, "gap");
  if (const Json& at = list(p, "at"); at.size() == 3) {
    row.at.emplace();
    for (std::size_t k = 0; k < 3; ++k) (*row.at)[k] = at[k].is_number() ? at[k].get<double>() : 0;
  }
  return row;
}

/// Adds the deepest row of every node or edge; false: the list holds something else.
bool add_rows(const Json& penetrations, std::int64_t interface_id, const std::string& role,
              EarlierGaps& out) {
  std::vector<EarlierGaps::Row>& rows = out.rows;
  std::map<std::array<std::int64_t, 2>, std::size_t> deepest;
  for (const Json& p : penetrations) {
    if (!p.is_object()) return false;
    EarlierGaps::Row row = row_of(p);
    row.interface_id = interface_id;
    row.role = role;
    const auto [it, fresh] = deepest.emplace(row.secondary, rows.size());
    if (fresh)
      rows.push_back(std::move(row));
    else if (row.depth > rows[it->second].depth)
      rows[it->second] = std::move(row);
  }
  return true;
}

/// Nodes that a TYPE2 did not tie. Documents of older versions have no list.
void add_untied(const Json& document, EarlierGaps& out) {
  for (const Json& tie : list(document, "ties")) {
    if (!tie.contains("id") || !tie.contains("nodes")) continue;
    std::set<std::int64_t>& untied = out.untied[whole(tie["id"])];
    for (const Json& n : tie["nodes"])
      if (n.contains("node") && member(n, "tied") == false) untied.insert(whole(n["node"]));
  }
}

/// Without one of its includes nobody knows what the deck had.
bool was_incomplete(const Json& document) {
  const Json& sentences = list(member(document, "verdict"), "sentences");
  return std::any_of(sentences.begin(), sentences.end(),
                     [](const Json& sentence) { return text(sentence, "what") == "no_verdict"; });
}

}  // namespace

Result<EarlierGaps> read_earlier_gaps(std::string path, std::string_view json,
                                      std::string_view deck_path) {
  const Json all = read_json<Json>(json, is_compared);
  if (all.is_discarded()) return wrong(path, "this is not JSON");
  std::vector<const Json*> documents;
  if (is_gaps(all)) documents.push_back(&all);
  for (const Json& d : list(all, "decks"))
    if (is_gaps(d) && !is_gaps(all)) documents.push_back(&d);
  if (documents.empty()) return wrong(path, "there is no list \"interfaces\"");
  EarlierGaps out;
  for (const Json* d : documents) out.decks.push_back(deck_path_of(*d));
  const auto same = std::find(out.decks.begin(), out.decks.end(), deck_path);
  const auto chosen = same != out.decks.end() ? same - out.decks.begin() : 0;
  const Json& document = *documents[static_cast<std::size_t>(chosen)];
  out.path = std::move(path);
  if (was_incomplete(document))
    return Error{Error::Code::io,
                 out.path + ": an include was missing when this was written; write it again"};
  const Json& schema = member(all, "schema");
  if (const std::int64_t version =
          schema.contains("version") ? whole(schema["version"]) : gaps_version;
      version != gaps_version)
    return Error{Error::Code::syntax,
                 out.path + ": this is version " + std::to_string(version) +
                     " of the document, in which ties count as penetrations. Write it again: deck "
                     "gaps " +
                     (document.contains("deck") ? deck_path_of(document) : std::string("DECK")) +
                     " --json " + out.path};
  out.deck_path = deck_path_of(document);
  for (const Json& inter : list(document, "interfaces")) {
    if (!member(inter, "contacts").is_array())
      return wrong(out.path, "an interface has no list \"contacts\"");
    const std::int64_t id = whole(member(inter, "id"));
    for (const Json& contact : list(inter, "contacts")) {
      if (!member(contact, "penetrations").is_array())
        return wrong(out.path, "a contact has no list \"penetrations\"");
      for (const Json& p : list(contact, "tied_pairs"))
        if (p.is_object()) out.tied[id].insert(row_of(p).secondary[0]);
      // A TYPE25 has its edges in a list beside.
      if (!add_rows(list(contact, "penetrations"), id, text(contact, "role"), out) ||
          !add_rows(list(contact, "edge_penetrations"), id, to_string(ContactRole::edges), out))
        return wrong(out.path, "a penetration is not an object");
    }
  }
  add_untied(document, out);
  return out;
}

COMMON_RECORD(GateFinding, "gate_finding", "A bound that is exceeded.",
              COLUMN("rule", "", id_text(r.d->rule)),
              COLUMN("severity", "", to_string(r.d->severity)), COLUMN("message", "", r.d->message),
              COLUMN("source", "", place_of(*r.deck, r.d->span)),
              COLUMN("entity", "", entity_of(*r.d)));

namespace {

/// A penetration that is new, worse or better than in the earlier document, or solved.
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
  const EarlierGaps& earlier = *r.gate->earlier;
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
    const EarlierGaps::Row& row = earlier.rows[i];
    add({"solved", row.interface_id, row.role, row.secondary, std::nullopt, row.depth});
  }
}

/// Of a row with a member `gate`, which has an earlier document.
constexpr ColumnsOf comparison_columns(COLUMN("with", "", r.gate->earlier->path),
                                       COLUMN("deck", "", r.gate->earlier->deck_path),
                                       COLUMN("new", "", r.gate->comparison.count(Trend::fresh)),
                                       COLUMN("worse", "", r.gate->comparison.count(Trend::worse)),
                                       COLUMN("better", "",
                                              r.gate->comparison.count(Trend::better)),
                                       COLUMN("same", "", r.gate->comparison.count(Trend::same)),
                                       COLUMN("solved", "", r.gate->comparison.solved.size()));

/// The arguments of gate_json().
struct GateDocument {
  const LintedDeck* linted = nullptr;
  const GateReport* gate = nullptr;
  const std::vector<const Diagnostic*>* stops = nullptr;
  bool passed = false;
};

/// The comparison in numbers.
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

DocumentSchema gate_schema() { return document_schema<GateDocument>(gate_head); }

std::string gate_json(const LintedDeck& deck, const GateReport& gate,
                      const std::vector<const Diagnostic*>& stops, bool passed) {
  return write_document(gate_head, GateDocument{&deck, &gate, &stops, passed}) + "\n";
}

}  // namespace deck
