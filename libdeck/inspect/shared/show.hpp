// One entity of a deck with all there is to know about it: its card, what the solver makes of it,
// what it refers to, and what uses it.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "deck/model.hpp"
#include "keyword/shared/references.hpp"

namespace deck {

/// What a person names with "3", "/INTER/TYPE7/3", "part:4" or "node:57".
struct Entity {
  std::string kind;     ///< "inter", "part", "node", "shell" ...
  std::string keyword;  ///< "/INTER/TYPE7"
  std::int64_t id = 0;
  std::string title;
  const Block* block = nullptr;    ///< holds it; of a node or element the list that it stands in
  Span span;                       ///< its header or, of a node or element, its line
  std::uint32_t index = no_index;  ///< of a node, element, part, property or material in the model
};

/// "KEYWORD/ID", "KIND:ID" or the id of an interface. Error (config): nothing has that name; the
/// message says what else has that id.
Result<Entity> find_entity(const Deck& deck, const Model& model, std::string_view what);

/// One line of a card with its cells by name.
struct ShownCard {
  const CardSchema* schema = nullptr;  ///< nullptr: a line that no schema describes
  Line line;
  bool title = false, free_format = false;
  std::vector<Cell> cells;
};

/// A reference, either way.
struct Link {
  std::string field;    ///< cell that names it, on the side that does
  std::string keyword;  ///< the other side; "" if it does not exist
  std::string kind;
  std::int64_t id = 0;
  std::int64_t last = 0;  ///< a range of ids
  std::string title;
  Span span;                ///< where the naming cell stands (used_by), or the target's header
  std::uint64_t count = 1;  ///< of equal ones: elements of a part
};

using FactValue = std::variant<std::int64_t, double, std::string>;

struct EntityView {
  Entity entity;
  std::vector<Span> includes;    ///< include directives from the main file down to its file
  std::vector<ShownCard> cards;  ///< data lines in order
  std::vector<std::pair<std::string, FactValue>> facts;  ///< what the model makes of it
  const InterBase* inter = nullptr;                      ///< one whose fields are evaluated
  std::vector<Link> refers_to;
  std::vector<Link> used_by;     ///< blocks that name it, and elements
  std::vector<Link> interfaces;  ///< contacts that reach it through others; field: "secondary" ...
};

/// Resolves groups, surfaces and sets where that is needed to answer.
EntityView view_entity(const Deck& deck, const Model& model, const Interfaces& interfaces,
                       const Entity& entity);

}  // namespace deck
