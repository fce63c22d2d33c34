// What `deck cycle` says of effects: how many run and what they take, which run where, what one of
// them changes. Private to the report stage.
#pragma once
#include <string>

#include "report/shared/cycle.hpp"

namespace deck {

/// "9 of 29 effects run; they take 42 ns a pair, all would take 174", then the effects by
/// interface.
std::string effects_text(const CycleInput& input, const CycleTextOptions& options);

/// Force, energy and time step with and without an effect; "" where that was not asked for.
std::string without_text(const CycleInput& input, const CycleTextOptions& options);

}  // namespace deck
