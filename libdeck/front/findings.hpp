// What was found wrong with a deck, kept by the stage that found it and joined on request. Private
// to the stage.
#pragma once
#include <array>
#include <optional>

#include "deck/loaded_deck.hpp"

namespace deck::detail {

class FindingLists {
 public:
  FindingLists(const Findings& of_reading, int per_rule);

  /// Where a stage reports to.
  Findings& of(Stage stage) { return lists_[static_cast<std::size_t>(stage)]; }
  /// Where contacts without penetrations report to.
  Findings& of_mesh() { return mesh_; }
  void add(Finding finding) { added_.report(std::move(finding)); }
  void forget_scene();
  /// Some file of the deck was not read.
  bool incomplete() const;

  bool wants_cells() const { return !cells_read_; }
  /// Finds what cannot be read in the cells that contacts depend on (interfaces, groups, parts,
  /// properties, materials ...): there 0 stands, and every value looks like one that was meant.
  /// Errors only; lint has the rest.
  void read_cells(const Deck& deck, int threads);

  /// All up to a stage in their order, each once; with those of contacts without penetrations from
  /// Stage::cells on.
  Findings joined(Stage until) const;
  /// All, with the errors of the groups; `of_scene` is what making contacts has found.
  Findings joined(const Model& model, const Findings& of_scene) const;

 private:
  int per_rule_;
  std::array<Findings, 5> lists_;  ///< by stage
  Findings mesh_, added_;
  bool cells_read_ = false;
};

}  // namespace deck::detail
