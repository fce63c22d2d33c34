// Heat of one pair in one cycle: across the gap, and by friction (node-segment pairs only).
#pragma once
#include <array>

#include "deck/cycle.hpp"

namespace deck::cycle {

/// Thermal state of a node-segment pair; index 0: secondary node, 1..4: corners.
struct HeatState {
  std::array<std::array<double, 3>, 5> position{};
  std::array<double, 5> temperature{};
  std::array<double, 4> weight{};
  double area = 0.0;           ///< of the secondary node; 0: the whole segment's
  double normal_force = 0.0;   ///< signed; negative under pressure
  double friction_heat = 0.0;  ///< energy dissipated by sliding in this cycle
  double gap = 0.0;            ///< effective gap
  double conductivity = 0.0;   ///< of the secondary side; 0: no extra resistance
  double dt1 = 0.0;
};

struct HeatFlow {
  std::array<double, 5> q{};  ///< energy received by each role, see PacketView
  double conductance = 0.0;   ///< A h; 0 for radiation, as in the solver
};

/// Thermal state of an edge-edge pair; roles 0, 1: secondary ends, 2, 3: main ends.
struct EdgeHeatState {
  std::array<std::array<double, 3>, 4> position{};
  std::array<double, 4> temperature{};
  std::array<double, 4> weight{};        ///< h_s, 1 - h_s, h_m, 1 - h_m
  std::array<double, 4> conductivity{};  ///< at each end
  std::array<double, 2> width{};         ///< of the secondary and the main edge
  double normal_force = 0.0;             ///< signed; negative under pressure
  double distance = 0.0;
  double gap = 0.0;            ///< pair gap, before Inacti
  double area = -1.0;          ///< shared area; < 0: computed from the widths
  double effective_gap = 0.0;  ///< 0.9 of the gap that Inacti leaves
  double dt1 = 0.0;
};

/// Area that two edges share. Ithe_form 0: length times width of the secondary edge. Form 1: the
/// smaller of (shorter length times smaller width) and the rhombus of two strips crossing at their
/// angle.
[[nodiscard]] double edge_contact_area(const ContactCard& card, const EdgeHeatState& state);

/// Heat between two edges: conduction within the gap, radiation up to Drad beyond it, no friction
/// heat; q[4] is 0. As in the solver, fct_IDK takes the signed force (negative under pressure), and
/// no heat crosses a gap of conductivity 0.
[[nodiscard]] HeatFlow pair_heat(const ContactCard& card, const EdgeHeatState& state);

/// Ithe_form 0: the secondary side exchanges heat with Tint only. Form 1: both sides exchange (sum
/// of q without friction is 0). As in the solver, the gap is a resistance on one side of the
/// segment only (form 0), and form 0 with fct_IDK gives no friction heat.
[[nodiscard]] HeatFlow pair_heat(const ContactCard& card, const HeatState& state);

}  // namespace deck::cycle
