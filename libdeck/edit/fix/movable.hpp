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

  /// The contacts with the nodes where they are now, as the deck puts them (see fix_scene); the
  /// same object with every call. Only pairs with nodes that moved since the last call are looked
  /// at again, where the rest of a contact does not depend on places. Ties are those of the first
  /// call until evaluate_with_ties().
  const Scene& evaluate();
  const Scene& evaluate_with_ties();

  const LoadedDeck& context_;
  const MoveNodesOptions& options_;
  Model model_;
  Interfaces interfaces_;
  Coordinates start_, now_;
  NodeCells cells_;

 private:
  bool keeps_its_sides(const Contact& contact) const;
  void build_again(const std::vector<bool>& which);
  void search_again(Contact& contact, const std::vector<bool>& moved);

  Scene scene_;
  std::vector<bool> of_solids_;  ///< by node
  bool ties_outdated_ = false;
};

}  // namespace deck::detail
