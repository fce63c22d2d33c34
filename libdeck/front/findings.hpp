// Findings of a deck by stage, merged on request. Private to the stage.
#pragma once
#include <array>

#include "deck/loaded_deck.hpp"

namespace deck::detail {

class FindingLists {
 public:
  FindingLists(const Findings& of_reading, int per_rule);

  /// Findings of one stage.
  Findings& of(Stage stage) { return lists_[static_cast<std::size_t>(stage)]; }
  /// Findings of the scene without penetrations.
  Findings& of_mesh() { return mesh_; }
  void add(Finding finding) { added_.report(std::move(finding)); }
  void forget_scene();
  /// True if a file of the deck was not read.
  bool incomplete() const;

  bool wants_cells() const { return !cells_read_; }
  /// Reads the cells of all blocks except bulk data. of(Stage::cells) gets the errors in blocks
  /// that contacts depend on (interfaces, groups, parts, properties, materials): unreadable cells
  /// are read as 0, which looks intended. Lint reports the rest.
  void read_cells(const Deck& deck, int threads);
  const Findings& of_all_cells() const { return all_cells_; }

  /// Findings up to a stage, without duplicates; from Stage::cells on with those of the scene
  /// without penetrations.
  Findings joined(Stage until) const;
  /// All findings, with errors of groups; `of_scene`: findings of building contacts.
  Findings joined(const Model& model, const Findings& of_scene) const;

 private:
  int per_rule_;
  std::array<Findings, 5> lists_;  ///< by stage
  Findings mesh_, added_, all_cells_;
  bool cells_read_ = false;
};

}  // namespace deck::detail
