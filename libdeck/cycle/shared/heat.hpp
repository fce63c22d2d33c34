// Heat of one contact pair in one cycle: conduction or radiation across the gap, and the share of
// friction work that becomes heat (node-segment pairs; none between edges).
#pragma once
#include <array>

#include "deck/cycle.hpp"

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
  std::array<double, 5> q{};  ///< energy received by each role, see PacketView
  double conductance = 0.0;   ///< A h; 0 for radiation, as in the solver
};

/// State of an edge-edge pair; roles 0, 1 are the ends of the secondary edge, 2, 3 of the main
/// edge.
struct EdgeHeatState {
  std::array<std::array<double, 3>, 4> position{};
  std::array<double, 4> temperature{};
  std::array<double, 4> weight{};        ///< h_s, 1 - h_s, h_m, 1 - h_m
  std::array<double, 4> conductivity{};  ///< at each end
  std::array<double, 2> width{};         ///< of the secondary and the main edge
  double normal_force = 0.0;             ///< signed, negative presses
  double distance = 0.0;
  double gap = 0.0;            ///< pair gap, before Inacti
  double area = -1.0;          ///< shared area where it is known already; < 0: from the widths
  double effective_gap = 0.0;  ///< nine tenths of what Inacti leaves
  double dt1 = 0.0;
};

/// Area that two edges share: the secondary edge's length times its width (Ithe_form 0); between
/// both sides the smaller of shorter length times smaller width and of the rhombus of two strips
/// that cross at their angle.
[[nodiscard]] double edge_contact_area(const ContactCard& card, const EdgeHeatState& state);

/// Heat between two edges: conduction within the gap, radiation up to Drad beyond it. No share of
/// friction becomes heat. q[4] is 0. As in the solver fct_IDK is evaluated at the signed force,
/// which is negative under pressure, and nothing passes a gap whose conductivity is 0.
[[nodiscard]] HeatFlow pair_heat(const ContactCard& card, const EdgeHeatState& state);

/// Ithe_form 0 exchanges with Tint on the secondary side only, form 1 between both sides (sum of q
/// without friction is 0). The gap is a resistance (form 0) on one side of the segment only, and
/// with fct_IDK form 0 delivers no friction heat, as in the solver.
[[nodiscard]] HeatFlow pair_heat(const ContactCard& card, const HeatState& state);

}  // namespace deck::cycle
