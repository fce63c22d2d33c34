// Heat of one contact pair in one cycle: conduction or radiation across the gap, and the share of
// friction work that becomes heat.
#ifndef DECK_CYCLE_HEAT_HPP_
#define DECK_CYCLE_HEAT_HPP_

#include <array>

#include "deck/cycle/card.hpp"
#include "deck/cycle/plan.hpp"

namespace deck::cycle {

/// State of a node–segment pair as far as heat is concerned; index 0 is the secondary node,
/// 1..4 the corners.
struct HeatState {
  std::array<std::array<double, 3>, 5> position{};
  std::array<double, 5> temperature{};
  std::array<double, 4> weight{};
  double area = 0.0;           ///< of the secondary node; 0: the whole segment's
  double normal_force = 0.0;   ///< signed, negative presses
  double friction_heat = 0.0;  ///< energy dissipated by sliding in this cycle
  double gap = 0.0;            ///< effective gap
  double conductivity = 0.0;   ///< of the secondary side, 0: no extra resistance
  double dt1 = 0.0;
};

struct HeatFlow {
  std::array<double, 5> q{};  ///< energy received by the secondary node and the four corners
  double conductance = 0.0;   ///< A h; the reference reports none for radiation
};

/// Ithe_form 0 exchanges with Tint on the secondary side only, form 1 between both sides (sum of q
/// without friction is 0).
[[nodiscard]] HeatFlow pair_heat(const ContactCard& card, const HeatState& state,
                                 Model model = Model::reference);

}  // namespace deck::cycle

#endif  // DECK_CYCLE_HEAT_HPP_
