// Depenetration: moves nodes out of gaps without a new penetration or crossed element.
#pragma once
#include <optional>
#include <vector>

#include "deck/edit.hpp"

namespace deck {

struct MoveNodesOptions : FixOptions {
  std::vector<std::int64_t> lock;         ///< parts whose nodes stay
  std::vector<std::int64_t> move;         ///< parts whose nodes may move; empty: all
  bool lock_rigid_bodies = false;         ///< nodes of /RBODY stay
  bool lock_boundary_conditions = false;  ///< nodes of /BCS stay
  bool secondary_only = false;            ///< main nodes do not move
  double most_moved = 0.1;                ///< share of a part's nodes that may move
  /// Longest move of a node, working units. Default: ten times the deepest penetration.
  std::optional<double> most_displacement;
  double clearance = 1e-3;  ///< share of the gap: final distance beyond it
};

/// Moves nodes of /NODE lines. The deck is read again with the printed coordinates to verify the
/// result. A node stays if its move would make or deepen a penetration, cross elements, turn an
/// element inside out, or halve one of its sides. `refused` lists the remaining penetrations with
/// reasons. Error: unknown part id, or the deck cannot be read again.
Result<PenetrationFix> move_nodes(const LoadedDeck& context, const MoveNodesOptions& options);

/// Moves one part with everything connected to it (parts with common nodes, ties, rigid bodies and
/// elements) by the translation that frees the most pairs; among equals the shortest, then the one
/// with fewer nodes. The move makes and deepens no penetration, crosses no elements and keeps ties.
/// It is at most `most_displacement` long (default: twice the deepest penetration). Other options
/// used: `lock`, `move`, `lock_...`, `clearance`. Verification and errors: see move_nodes().
Result<PenetrationFix> move_part(const LoadedDeck& context, const MoveNodesOptions& options);

}  // namespace deck
