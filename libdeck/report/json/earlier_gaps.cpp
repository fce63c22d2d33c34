// Reads an earlier `deck gaps --json` for comparison.
#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>

#include "deck/report/gaps.hpp"
#include "text/shared/read_json.hpp"

namespace deck {
namespace {

using Json = nlohmann::json;

Error wrong(const std::string& path, const std::string& why) {
  return {Error::Code::syntax,
          path + ": " + why + "; expected the document that 'deck gaps --json' writes"};
}

bool is_gaps(const Json& d) {
  return d.is_object() && d.contains("interfaces") && d["interfaces"].is_array();
}

std::string text(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}

std::string deck_path_of(const Json& d) {
  return d.contains("deck") && d["deck"].is_object() ? text(d["deck"], "path") : std::string();
}

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
  const auto edge = p.find("edge");
  if (edge != p.end() && edge->is_array() && edge->size() == 2) {
    row.secondary = {whole((*edge)[0]), whole((*edge)[1])};
    std::sort(row.secondary.begin(), row.secondary.end());
  } else {
    row.secondary = {p.contains("node") ? whole(p["node"]) : 0, 0};
  }
  row.depth = number(p, "penetration");
  row.gap = number(p, "gap");
  const auto at = p.find("at");
  if (at != p.end() && at->is_array() && at->size() == 3) {
    row.at.emplace();
    for (std::size_t k = 0; k < 3; ++k)
      (*row.at)[k] = (*at)[k].is_number() ? (*at)[k].get<double>() : 0;
  }
  return row;
}

/// Adds the deepest row of every node or edge; false: the list holds something else.
bool add_rows(const Json& list, std::int64_t interface_id, const std::string& role,
              EarlierGaps& out) {
  std::vector<EarlierGaps::Row>& rows = out.rows;
  std::map<std::array<std::int64_t, 2>, std::size_t> deepest;
  for (const Json& p : list) {
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
  const auto ties = document.find("ties");
  if (ties == document.end() || !ties->is_array()) return;
  for (const Json& tie : *ties) {
    if (!tie.is_object() || !tie.contains("id") || !tie.contains("nodes")) continue;
    std::set<std::int64_t>& untied = out.untied[whole(tie["id"])];
    for (const Json& n : tie["nodes"])
      if (n.is_object() && n.contains("node") && n.contains("tied") && n["tied"] == false)
        untied.insert(whole(n["node"]));
  }
}

/// Without one of its includes nobody knows what the deck had.
bool was_incomplete(const Json& document) {
  const auto verdict = document.find("verdict");
  if (verdict == document.end() || !verdict->is_object() || !verdict->contains("sentences"))
    return false;
  const Json& sentences = (*verdict)["sentences"];
  return std::any_of(sentences.begin(), sentences.end(), [](const Json& sentence) {
    return sentence.is_object() && text(sentence, "what") == "no_verdict";
  });
}

}  // namespace

Result<EarlierGaps> read_earlier_gaps(std::string path, std::string_view json,
                                      std::string_view deck_path) {
  const Json all = read_json<Json>(json, is_compared);
  if (all.is_discarded()) return wrong(path, "this is not JSON");
  EarlierGaps out;
  const Json* document = is_gaps(all) ? &all : nullptr;
  if (document != nullptr) out.decks.push_back(deck_path_of(all));
  if (document == nullptr && all.is_object() && all.contains("decks") && all["decks"].is_array()) {
    for (const Json& d : all["decks"]) {
      if (!is_gaps(d)) continue;
      out.decks.push_back(deck_path_of(d));
      const bool first = std::count(out.decks.begin(), out.decks.end(), deck_path) == 1;
      if (document == nullptr || (out.decks.back() == deck_path && first)) document = &d;
    }
  }
  if (document == nullptr) return wrong(path, "there is no list \"interfaces\"");
  out.path = std::move(path);
  if (was_incomplete(*document))
    return Error{Error::Code::io,
                 out.path + ": an include was missing when this was written; write it again"};
  const Json& schema = all.contains("schema") ? all["schema"] : Json();
  if (const std::int64_t version = schema.is_object() && schema.contains("version")
                                       ? whole(schema["version"])
                                       : gaps_version;
      version != gaps_version)
    return Error{Error::Code::syntax,
                 out.path + ": this is version " + std::to_string(version) +
                     " of the document, in which ties count as penetrations. Write it again: deck "
                     "gaps " +
                     (document->contains("deck") ? deck_path_of(*document) : std::string("DECK")) +
                     " --json " + out.path};
  out.deck_path = deck_path_of(*document);
  for (const Json& inter : (*document)["interfaces"]) {
    if (!inter.is_object() || !inter.contains("contacts") || !inter["contacts"].is_array())
      return wrong(out.path, "an interface has no list \"contacts\"");
    const std::int64_t id = inter.contains("id") ? whole(inter["id"]) : 0;
    for (const Json& contact : inter["contacts"]) {
      if (!contact.is_object() || !contact.contains("penetrations") ||
          !contact["penetrations"].is_array())
        return wrong(out.path, "a contact has no list \"penetrations\"");
      const bool read = add_rows(contact["penetrations"], id, text(contact, "role"), out);
      // A TYPE25 has its edges in a list beside.
      const auto edges = contact.find("edge_penetrations");
      const bool beside = edges != contact.end() && edges->is_array();
      const auto ties = contact.find("tied_pairs");
      if (ties != contact.end() && ties->is_array())
        for (const Json& p : *ties)
          if (p.is_object()) out.tied[id].insert(row_of(p).secondary[0]);
      if (!read || (beside && !add_rows(*edges, id, to_string(ContactRole::edges), out)))
        return wrong(out.path, "a penetration is not an object");
    }
  }
  add_untied(*document, out);
  return out;
}

}  // namespace deck
