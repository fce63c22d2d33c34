// Examined and unexamined interfaces, and texts about them.
#include "deck/model.hpp"
#include "deck/rule_id.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "base/shared/words.hpp"

namespace deck {
namespace {

constexpr std::size_t most_ids = 10;  // in a sentence; JSON has all
constexpr std::size_t most_files = 3;

std::string keyword_of(const Block& block) {
  if (block.schema != nullptr && !block.schema->cards.empty()) return block.schema->keyword;
  // A schema without cards can cover many types: "/INTER/LAGMUL/TYPE16/12" without ids.
  std::string_view keyword = block.header;
  while (true) {
    const auto slash = keyword.rfind('/');
    if (slash == 0 || slash == keyword.npos) break;
    if (keyword.find_first_not_of("0123456789-&", slash + 1) == slash + 1) break;
    keyword = keyword.substr(0, slash);
  }
  return std::string(keyword);
}

/// "/INTER/TYPE25" becomes "TYPE25"; keywords without type are unchanged.
std::string type_of(const std::string& keyword) {
  constexpr std::string_view front = "/INTER/";
  return keyword.starts_with("/INTER/TYPE") ? keyword.substr(front.size()) : keyword;
}

std::string ids_text(const std::vector<std::int64_t>& ids) {
  return (ids.size() == 1 ? "id " : "ids ") + list_text(ids, most_ids);
}

}  // namespace

std::string examined_types(Examined examined) {
  std::string text = examined == Examined::contacts ? "TYPE" : "TYPE2, ";
  for (std::size_t i = 0; i < interface_types.size(); ++i)
    text += (i == 0                            ? ""
             : i + 1 == interface_types.size() ? " and "
                                               : ", ") +
            std::to_string(interface_types[i]->type);
  return text;
}

Coverage coverage_of(const Deck& deck, const Interfaces& interfaces, Examined examined) {
  Coverage out;
  const auto& looked_at = examined == Examined::contacts ? interfaces.ordered : interfaces.all;
  out.examined = looked_at.size();
  std::set<const Block*> known;
  for (const InterBase* i : looked_at) known.insert(i->block);
  std::map<std::string, std::vector<std::int64_t>> left;
  for (const Block& b : deck.blocks) {
    // /INTER/SUB requests output of a part of an interface.
    if (!b.header.starts_with("/INTER/") || b.header.starts_with("/INTER/SUB") ||
        known.contains(&b))
      continue;
    left[keyword_of(b)].push_back(deck.shifted_id(b, "inter", b.id.value));
  }
  for (auto& [keyword, ids] : left) out.not_examined.push_back({keyword, std::move(ids)});
  std::set<std::string> missing;
  // The solver generates nodes and elements for these.
  for (const Block& b : deck.blocks)
    if (b.schema != nullptr && b.schema->keyword == "/ALE/STRUCTURED_MESH")
      missing.emplace(b.header);
  for (const Finding& d : deck.findings.all())
    if (d.rule == RuleId::DK004 || d.rule == RuleId::DK005 || d.rule == RuleId::DK006)
      missing.emplace(deck.sources.text(d.span));
  out.missing.assign(missing.begin(), missing.end());
  return out;
}

std::string not_examined_text(const Coverage& coverage) {
  std::string text;
  for (const NotExamined& n : coverage.not_examined)
    text += (text.empty() ? "" : ", ") + std::to_string(n.ids.size()) +
            (n.ids.size() == 1 ? " interface of " : " interfaces of ") + type_of(n.keyword) + " (" +
            ids_text(n.ids) + ")";
  return text;
}

std::string coverage_lead(const Coverage& coverage) {
  if (!coverage.complete()) {
    std::string text = "No verdict: the model is incomplete, ";
    for (std::size_t i = 0; i < std::min(coverage.missing.size(), most_files); ++i)
      text += (i == 0 ? "'" : ", '") + coverage.missing[i] + "'";
    if (coverage.missing.size() > most_files)
      text += " and " + std::to_string(coverage.missing.size() - most_files) + " more";
    return text + " could not be read.";
  }
  if (!coverage.nothing()) return {};
  if (coverage.not_examined.empty()) return "Nothing examined: the deck has no contact interface.";
  return "Nothing examined: " + not_examined_text(coverage) + ".";
}

std::string coverage_tail(const Coverage& coverage) {
  if (coverage.not_examined.empty() || (coverage.nothing() && coverage.complete())) return {};
  return " Not examined: " + not_examined_text(coverage) + ".";
}

}  // namespace deck
