// One entity of a deck: its card, effective values, references from and to it.
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

/// Entity named by "3", "/INTER/TYPE7/3", "part:4" or "node:57".
struct Entity {
  std::string kind;     ///< "inter", "part", "node", "shell" ...
  std::string keyword;  ///< "/INTER/TYPE7"
  std::int64_t id = 0;
  std::string title;
  const Block* block = nullptr;    ///< block with it; for a node or element its list
  Span span;                       ///< its header; for a node or element its line
  std::uint32_t index = no_index;  ///< in the model: of a node, element, part, property, material
};

/// "KEYWORD/ID", "KIND:ID" or the id of an interface. Error (config): no such entity; the message
/// lists other entities with that id.
Result<Entity> find_entity(const Deck& deck, const Model& model, std::string_view what);

/// One line of a card with its cells by name.
struct ShownCard {
  const CardSchema* schema = nullptr;  ///< nullptr: a line that no schema describes
  Line line;
  bool title = false, free_format = false;
  std::vector<Cell> cells;
};

/// A reference in either direction.
struct Link {
  std::string field;    ///< cell with the reference, on the referring side
  std::string keyword;  ///< the other side; "" if it does not exist
  std::string kind;
  std::int64_t id = 0;
  std::int64_t last = 0;  ///< a range of ids
  std::string title;
  Span span;                ///< cell with the reference (used_by), or header of the target
  std::uint64_t count = 1;  ///< number of equal ones: elements of a part
};

using FactValue = std::variant<std::int64_t, double, std::string>;

struct EntityView {
  Entity entity;
  std::vector<Span> includes;    ///< include directives from the main file down to its file
  std::vector<ShownCard> cards;  ///< data lines in order
  std::vector<std::pair<std::string, FactValue>> facts;  ///< from the model
  const InterBase* inter = nullptr;                      ///< set if its fields are evaluated
  std::vector<Link> refers_to;
  std::vector<Link> used_by;     ///< referring blocks and elements
  std::vector<Link> interfaces;  ///< contacts that use it indirectly; field: "secondary" ...
};

/// Resolves groups, surfaces and sets if needed.
EntityView view_entity(const Deck& deck, const Model& model, const Interfaces& interfaces,
                       const Entity& entity);

}  // namespace deck
