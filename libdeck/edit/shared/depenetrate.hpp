// Depenetration: moves nodes out of each other's gap without making a penetration or a crossed
// element that was not there before.
#pragma once
#include <optional>
#include <vector>

#include "deck/edit.hpp"

namespace deck {

struct MoveNodesOptions : FixOptions {
  std::vector<std::int64_t> lock;         ///< parts whose nodes stay
  std::vector<std::int64_t> move;         ///< only nodes of these parts move; empty: all
  bool lock_rigid_bodies = false;         ///< nodes of /RBODY stay
  bool lock_boundary_conditions = false;  ///< nodes of /BCS stay
  bool secondary_only = false;            ///< main sides do not give way
  double most_moved = 0.1;                ///< share of the nodes of a part that may move
  /// No node moves farther than this, working units. Absent: ten times the deepest
  /// penetration.
  std::optional<double> most_displacement;
  double clearance = 1e-3;  ///< of the gap, left between gap and distance at the end
};

/// Moves nodes of /NODE lines. Verified with the coordinates as printed: the deck is read again
/// with them. Nodes whose move would make a new penetration, deepen another one, cross elements,
/// turn one inside out or halve one of its sides stay where they are. Penetrations that cannot be
/// solved this way are in `refused` with the reason. Error: unknown part ids, or the deck cannot be
/// read again.
Result<PenetrationFix> move_nodes(const LoadedDeck& context, const MoveNodesOptions& options);

/// Of one part, with all that hangs on it (parts that share nodes with it, ties, rigid bodies and
/// rigid elements), the translation that frees the most pairs; of equals the shortest, then the one
/// that moves fewer nodes. It makes no penetration, deepens none, crosses no elements and leaves
/// what is tied. `most_displacement` bounds it; absent: twice the deepest penetration. Of the other
/// options `lock`, `move`, both `lock_...` and `clearance` count. Verified as move_nodes. Error:
/// unknown part ids, or the deck cannot be read again.
Result<PenetrationFix> move_part(const LoadedDeck& context, const MoveNodesOptions& options);

}  // namespace deck
