// What rows of elements say beyond nodes and thickness. Private to inspection.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "deck/keyword/decode.hpp"
#include "deck/model/model.hpp"

namespace deck::detail {

/// A cell that is not 0: an angle, a component of a direction, a skew, a third node.
struct ElementCell {
  const Field* field = nullptr;
  double real = 0;
  std::int64_t id = 0;  ///< cells of ids and integers, with the offset of a submodel
};

/// By family and index of the element: the cells of its rows that the model does not hold.
/// Elements without such a cell have no entry.
using ElementCells = std::array<std::unordered_map<std::uint32_t, std::vector<ElementCell>>, 8>;

/// Reads the rows of all elements once; those that end behind the nodes are not decoded.
ElementCells element_cells(const Deck& deck, const Model& model);

}  // namespace deck::detail
