// What strategies that move nodes work on. Private to the stage.
#pragma once
#include "edit/fix/common.hpp"
#include "edit/fix/nodes/depenetrate_cells.hpp"
#include "edit/shared/depenetrate.hpp"

namespace deck::detail {

/// A deck with a model of its own, whose nodes move; the deck itself stays as it is.
class MovableDeck {
 protected:
  MovableDeck(const LoadedDeck& context, const MoveNodesOptions& options);
  MovableDeck(const MovableDeck&) = delete;
  MovableDeck& operator=(const MovableDeck&) = delete;
  ~MovableDeck() = default;

  /// The contacts with the nodes where they are now, as the deck puts them (see fix_scene).
  Scene evaluate() const {
    return fix_scene(model_, interfaces_, context_.options().read.limits, options_, false);
  }

  const LoadedDeck& context_;
  const MoveNodesOptions& options_;
  Model model_;
  Interfaces interfaces_;
  Coordinates start_, now_;
  NodeCells cells_;
};

}  // namespace deck::detail
