// The solver's order of the blocks of one category (all /INTER, all elements): file by file, the
// main file first, an include before the files that it opens; in a file by ascending id, elements
// by part id; equal ids as written. Exceptions that keep file order: /TRANSFORM, /INIVEL. Private
// to the library.
#pragma once
#include <concepts>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"

namespace deck::detail {

void sort_as_solver(const Deck& deck, std::vector<const Block*>& category);

template <std::predicate<const Block&> Wanted>
std::vector<const Block*> in_solver_order(const Deck& deck, const Wanted& wanted) {
  std::vector<const Block*> out;
  for (const Block& b : deck.blocks)
    if (wanted(b)) out.push_back(&b);
  sort_as_solver(deck, out);
  return out;
}
/// Blocks whose header starts with this text: "/INTER".
std::vector<const Block*> in_solver_order(const Deck& deck, std::string_view category);

}  // namespace deck::detail
