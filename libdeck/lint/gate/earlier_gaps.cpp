// Reads the penetrations of an earlier `deck gaps --json`.
#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "deck/contacts.hpp"
#include "deck/lint.hpp"
#include "text/shared/read_json.hpp"

namespace deck {
namespace {

using Json = nlohmann::json;

Error wrong(const std::string& path, const std::string& why) {
  return {Error::Code::syntax,
          path + ": " + why + "; expected the document that 'deck gaps --json' writes"};
}

/// A member of an object; null: absent.
const Json& member(const Json& object, const char* key) {
  static const Json none;
  const auto it = object.find(key);
  return it != object.end() ? *it : none;
}

/// A member that is a list; empty: absent.
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

/// null: not a finite number, such as an unbounded gap.
double number(const Json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) return 0;
  return it->is_number() ? it->get<double>()
         : it->is_null() ? std::numeric_limits<double>::max()
                         : 0;
}

std::int64_t whole(const Json& v) { return v.is_number_integer() ? v.get<std::int64_t>() : 0; }

/// Edge lists of TYPE24 and TYPE25.
constexpr const char* edge_lists[] = {"edge_penetrations", "edge_solid_penetrations",
                                      "point_penetrations"};

/// Documents of `gaps --all` are large; only compared members are kept.
bool is_compared(int, Json::parse_event_t event, Json& parsed) {
  static const std::set<std::string, std::less<>> keys = {
      "at",          "contacts",   "counted", "deck",        "decks",        "edge",
      "gap",         "id",         "node",    "interfaces",  "nodes",        "path",
      "role",        "schema",     "tied",    "penetration", "penetrations", "sentences",
      "ties",        "tied_pairs", "verdict", "version",     "what",         edge_lists[0],
      edge_lists[1], edge_lists[2]};
  return event != Json::parse_event_t::key || keys.contains(parsed.get_ref<std::string&>());
}

GapBaseline::Row row_of(const Json& p) {
  GapBaseline::Row row;
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

/// Adds the deepest row of every node or edge; false: not such a list.
bool add_rows(const Json& penetrations, std::int64_t interface_id, const std::string& role,
              GapBaseline& out) {
  std::vector<GapBaseline::Row>& rows = out.rows;
  std::map<std::array<std::int64_t, 2>, std::size_t> deepest;
  for (const Json& p : penetrations) {
    if (!p.is_object()) return false;
    if (member(p, "counted") == false) continue;
    GapBaseline::Row row = row_of(p);
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

/// Nodes that a TYPE2 did not tie. Missing in documents of older versions.
void add_untied(const Json& document, GapBaseline& out) {
  for (const Json& tie : list(document, "ties")) {
    if (!tie.contains("id") || !tie.contains("nodes")) continue;
    std::set<std::int64_t>& untied = out.untied[whole(tie["id"])];
    for (const Json& n : tie["nodes"])
      if (n.contains("node") && member(n, "tied") == false) untied.insert(whole(n["node"]));
  }
}

/// True if an include of the deck was missing.
bool was_incomplete(const Json& document) {
  const Json& sentences = list(member(document, "verdict"), "sentences");
  return std::any_of(sentences.begin(), sentences.end(),
                     [](const Json& sentence) { return text(sentence, "what") == "no_verdict"; });
}

}  // namespace

Result<GapBaseline> read_earlier_gaps(std::string path, std::string_view json,
                                      std::string_view deck_path) {
  const Json all = read_json<Json>(json, is_compared);
  if (all.is_discarded()) return wrong(path, "this is not JSON");
  std::vector<const Json*> documents;
  if (is_gaps(all)) documents.push_back(&all);
  for (const Json& d : list(all, "decks"))
    if (is_gaps(d) && !is_gaps(all)) documents.push_back(&d);
  if (documents.empty()) return wrong(path, "there is no list \"interfaces\"");
  GapBaseline out;
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
      bool good = add_rows(list(contact, "penetrations"), id, text(contact, "role"), out);
      Json edges = Json::array();  // without duplicates
      for (const char* key : edge_lists)
        for (const Json& p : list(contact, key)) edges.push_back(p);
      good = good && add_rows(edges, id, to_string(ContactRole::edges), out);
      if (!good) return wrong(out.path, "a penetration is not an object");
    }
  }
  add_untied(document, out);
  return out;
}

}  // namespace deck
