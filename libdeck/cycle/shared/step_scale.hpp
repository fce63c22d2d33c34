// The share of a stable step that the solver takes. Shared with the stages to the right.
#pragma once

namespace deck::cycle {

/// What steps of elements and nodes are multiplied with, unless the Engine file says otherwise.
inline constexpr double step_scale = 0.9;

}  // namespace deck::cycle
