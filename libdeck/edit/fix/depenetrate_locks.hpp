// Which nodes may not move, and why. Private to the stage.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "deck/edit/depenetrate.hpp"
#include "edit/fix/depenetrate_mesh.hpp"

namespace deck::detail {

enum class Hold : std::uint8_t {
  none,
  locked_part,
  not_selected,  ///< --only other parts
  rigid_body,
  boundary,
  not_writable,  ///< NodeCells::obstacle says why
  share,         ///< as many nodes of the part moved as may
  displacement,  ///< moved as far as it may
  crossed,       ///< belongs to a crossed element already
  would_cross,
  would_invert,
  would_shrink,
  would_penetrate,
};
const char* to_string(Hold hold);

/// Holds from the options. Error: an unknown part, or cards that cannot be read for their nodes.
Result<std::vector<std::uint8_t>> make_holds(const EditContext& context,
                                             const MoveNodesOptions& options);

}  // namespace deck::detail
