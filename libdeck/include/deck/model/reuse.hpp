// Whether what was made of one model is true for another: for programs that look at a deck again
// after every edit.
#pragma once
#include "deck/model/model.hpp"

namespace deck {

/// True if all groups, surfaces, lines and sets have the same members in both models, provided that
/// their definitions are the same in both decks: the same nodes and elements in the same order, the
/// same parts with the same property, material and subset. Coordinates count where the deck has
/// boxes. Costs a comparison of the arrays.
bool same_members(const Model& a, const Model& b);

}  // namespace deck
