// Moves one whole part, so that both sides keep their shape: the translation that frees the most.
#pragma once
#include "edit/shared/depenetrate.hpp"

namespace deck {

/// Of one part, with all that hangs on it (parts that share nodes with it, ties, rigid bodies and
/// rigid elements), the translation that frees the most pairs; of equals the shortest, then the one
/// that moves fewer nodes. It makes no penetration, deepens none, crosses no elements and leaves
/// what is tied. `most_displacement` bounds it; absent: twice the deepest penetration. Of the other
/// options `lock`, `move`, both `lock_...` and `clearance` count. Verified as move_nodes. Error:
/// unknown part ids, or the deck cannot be read again.
Result<PenetrationFix> move_part(const LoadedDeck& context, const MoveNodesOptions& options);

}  // namespace deck
