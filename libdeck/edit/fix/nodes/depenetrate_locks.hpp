// Which nodes may not move, and why. Private to the stage.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "edit/fix/nodes/depenetrate_mesh.hpp"
#include "edit/shared/depenetrate.hpp"

namespace deck::detail {

enum class Hold : std::uint8_t {
  none,
  locked_part,
  not_selected,  ///< --only other parts
  rigid_body,
  boundary,
  not_writable,  ///< NodeCells::obstacle says why
  share,         ///< its part would need more moved nodes than may
  displacement,  ///< moved as far as it may
  crossed,       ///< belongs to a crossed element already
  would_cross,
  would_invert,
  would_shrink,
  would_penetrate,
  would_untie,
  depth,      ///< moved as far as the penetration is deep, or would have to move farther
  bystander,  ///< in no penetration: stays
};
const char* to_string(Hold hold);

/// Holds from the options. Error: an unknown part, or a card with commas.
Result<std::vector<std::uint8_t>> make_holds(const LoadedDeck& context,
                                             const MoveNodesOptions& options);

}  // namespace deck::detail
