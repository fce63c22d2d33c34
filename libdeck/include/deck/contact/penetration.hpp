// One initial penetration: its figures, and what the solver does about it.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "deck/contact/closest.hpp"

namespace deck {

/// What the solver does about one initial penetration.
enum class PenetrationAction : std::uint8_t {
  none,
  node_stiffness_zero,     ///< Inacti 1, or Fpenmax exceeded
  segment_stiffness_zero,  ///< Inacti 2
  node_moved,              ///< Inacti 3
  gap_reduced,             ///< Inacti 5, 6
  edge_stiffness_zero,     ///< TYPE11: Inacti 1, 2, or deeper than 99.5 % of the gap with 5, 6
  ignored,                 ///< TYPE24, 25: Inacti 0
  offset_stored,           ///< TYPE24, 25: Inacti 5, taken off the penetration from then on
  initial_force,           ///< TYPE24, 25: Inacti -1, a force from the start
  removed_tied,            ///< TYPE24, 25: a tie holds the node, Irem_i2
  error_611,  ///< the node is exactly on the segment: the solver stops (Inacti 3, 5, 6)
  error_612,  ///< the same with Inacti 0
};
inline constexpr std::size_t penetration_actions = 12;  ///< how many there are
/// The solver stops at this penetration.
inline bool stops_solver(PenetrationAction action) {
  return action == PenetrationAction::error_611 || action == PenetrationAction::error_612;
}
/// For people, of one or of several: "nothing", "gap reduced", "edges switched off", ...
const char* action_words(PenetrationAction action, std::size_t pairs = 2);
const char* to_string(PenetrationAction action);  ///< "none", "node-stiffness-zero", ...

struct PenetrationRow {
  std::uint32_t secondary = 0, main = 0;  ///< positions in the contact's lists
  double depth = 0;                       ///< gap - distance
  double gap = 0;                         ///< pair gap
  double distance = 0;
  std::array<double, 3> normal{};  ///< unit, main to secondary; zero when on_surface
  bool on_surface = false;
  /// Accuracy::robust: false where the pair is no nearer than its gap, and only the round-off of
  /// the solver's formula makes a penetration of it. The solver acts on it all the same.
  bool in_contact = true;
  Feature feature = Feature::face;
  PenetrationAction action = PenetrationAction::none;
  bool has_gap0 = false;
  double p0 = 0, gap0 = 0;            ///< Inacti 5, 6: stored penetration and gap left
                                      ///< (TYPE24, 25: what is stored, no gap left)
  std::array<double, 3> moved_by{};   ///< Inacti 3
  double weight_s = 0, weight_m = 0;  ///< edge pairs: weights of the first nodes
};

}  // namespace deck
