// Pieces of the page of `deck accuracy`. Private to the report stage.
#pragma once
#include <string>
#include <vector>

#include "accuracy/shared/choice.hpp"

namespace deck::detail {

/// Advice, the choices, when to take which, the kinds of hard cases.
std::string accuracy_first_screen(const std::vector<AccuracyChoice>& choices);
/// A node passes a sliver: a chart, and a sentence for every jump.
std::string accuracy_motion();

}  // namespace deck::detail
