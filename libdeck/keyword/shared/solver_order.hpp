// The order in which the solver takes the blocks of one category (all /INTER, all elements, …):
// file by file, the main file first and an include before those that it opens; by ascending id in a
// file, elements by that of their part; blocks of equal id as they are written. /TRANSFORM and
// /INIVEL are the exceptions: they keep the order of Deck::blocks. Private to the library.
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
/// Those whose header begins so: "/INTER".
std::vector<const Block*> in_solver_order(const Deck& deck, std::string_view category);

}  // namespace deck::detail
