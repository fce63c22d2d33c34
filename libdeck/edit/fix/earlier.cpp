// Reads from the report of a repair which nodes it moved, so that the next one counts them.
#include <nlohmann/json.hpp>

#include "deck/edit/depenetrate.hpp"

namespace deck {
namespace {

using Json = nlohmann::json;

std::array<double, 3> point(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

/// Throws where something is missing.
std::vector<MovedNode> moves_in(const Json& document) {
  std::vector<MovedNode> out;
  for (const char* list : {"moved", "moved_before"})
    for (const Json& m : document.at(list)) {
      MovedNode node;
      node.id = m.at("node").get<std::int64_t>();
      node.from = point(m.at("from"));
      node.to = point(m.at("to"));
      out.push_back(node);
    }
  return out;
}

}  // namespace

std::vector<MovedNode> earlier_moves(std::string_view report, std::string_view path) {
  try {
    const Json root = Json::parse(report);
    if (root.at("schema").at("id") != "deck/fix") return {};
    const auto of_deck = [&](const Json& document) {
      return document.at("deck").at("path") == path && document.at("strategy") == "move-nodes";
    };
    if (!root.contains("decks")) return of_deck(root) ? moves_in(root) : std::vector<MovedNode>();
    for (const Json& document : root.at("decks"))
      if (of_deck(document)) return moves_in(document);
  } catch (const Json::exception&) {
  }
  return {};
}

}  // namespace deck
