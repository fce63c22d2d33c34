// Depenetration: moves nodes out of each other's gap, a share of the depth at a time, until none is
// left, without making a penetration or a crossed element that was not there before.
#pragma once
#include <optional>
#include <vector>

#include "deck/edit/fix.hpp"

namespace deck {

struct MoveNodesOptions : FixOptions {
  std::vector<std::int64_t> lock;         ///< parts whose nodes stay
  std::vector<std::int64_t> move;         ///< only nodes of these parts move; empty: all
  bool lock_rigid_bodies = false;         ///< nodes of /RBODY stay
  bool lock_boundary_conditions = false;  ///< nodes of /BCS stay
  bool secondary_only = false;            ///< main sides do not give way
  double most_moved = 0.1;                ///< share of the nodes of a part that may move
  /// What earlier runs moved (earlier_moves()). Those nodes that are still where they were put
  /// count for `most_moved` and are measured from where they were at first.
  std::vector<MovedNode> earlier;
  /// No node moves farther than this, working units. Absent: ten times the deepest
  /// penetration.
  std::optional<double> most_displacement;
  double share = 0.7;       ///< of the depth, per iteration
  double clearance = 1e-3;  ///< of the gap, left between gap and distance at the end
  int smooth = 0;           ///< rings of neighbours that follow the moved nodes
  int iterations = 60;
};

/// The nodes that earlier runs moved in the deck of that path, by a report of the last one
/// ("deck/fix" as JSON). Empty where the text is no such report.
std::vector<MovedNode> earlier_moves(std::string_view report, std::string_view path);

/// Moves nodes of /NODE lines. Verified with the coordinates as printed: the deck is read again
/// with them. Moves that would make a new penetration, deepen another one, cross elements, turn one
/// inside out or halve one of its sides are taken back. Penetrations that cannot be solved this way
/// are in `refused` with the reason. Error: unknown part ids, or the deck cannot be read again.
Result<PenetrationFix> move_nodes(const EditContext& context, const MoveNodesOptions& options);

/// Takes crossed elements apart where the move of one node does it: to the other side of what its
/// edge passes through, or in line with its neighbours. Made only if a crossing goes and none
/// comes, no penetration is new or deeper, no element turned inside out and no side halved. The
/// crossings that stay are in `refused`. Of the options, those that say which nodes may move, how
/// many of a part and how far (absent: any distance) count, and `clearance`.
Result<PenetrationFix> untangle(const EditContext& context, const MoveNodesOptions& options);

}  // namespace deck
