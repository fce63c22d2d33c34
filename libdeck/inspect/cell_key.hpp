// Names the cells of a block by what they mean, not by the line they are on. Private to inspection.
#pragma once
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "deck/keyword/decode.hpp"

namespace deck::detail {

/// Field, round of repeated cards, and which cell of that name in the round. Two versions that have
/// a cell on different lines give it the same key.
using CellKey = std::tuple<std::string, int, int>;

/// The key of every cell of a block.
inline std::map<const Cell*, CellKey> cell_keys(const DecodedBlock& d) {
  std::map<const Cell*, CellKey> keys;
  std::map<std::pair<std::string_view, int>, int> count;
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells) {
      const std::string& name = cell.field->name;
      keys.emplace(&cell, CellKey{name, card.round, count[{name, card.round}]++});
    }
  return keys;
}

}  // namespace deck::detail
