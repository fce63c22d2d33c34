// Data that verification compares.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/cycle.hpp"
#include "edit/shared/conversion.hpp"

namespace deck::detail {

/// Start of a deck. Points into the deck.
struct DeckStart {
  const LoadedDeck& context;
  const Scene& scene;
  const cycle::State& state;
  const cycle::SceneOutcome& cycle;
  std::array<std::vector<double>, 5> steps;  ///< of shell4, shell3, solid8, truss, beam
  const std::vector<double>& beam_factors;   ///< Mesh::beam_factors
  std::vector<double> part_mass;             ///< of the elements of each part
  double extent = 0;                         ///< largest coordinate
};
DeckStart behaviour_of(const LoadedDeck& deck);

inline constexpr std::array verified_kinds = {ElementKind::shell4, ElementKind::shell3,
                                              ElementKind::solid8, ElementKind::truss,
                                              ElementKind::beam};

/// Indices of the second deck's items in the first. Both are in written order; the solver's order
/// changes with ids and files.
struct OldIndices {
  std::vector<std::uint32_t> old;  ///< empty: equal indices
  std::uint32_t operator[](std::size_t now) const {
    return old.empty() ? static_cast<std::uint32_t>(now) : old[now];
  }
};

/// Two decks, and the map from values and nodes of the second to the first.
struct DeckComparison {
  DeckComparison(const DeckStart& a, const DeckStart& b, const VerifyRelation& r,
                 std::vector<LossEntry>* accept = nullptr);

  using Difference = std::optional<std::string>;
  const DeckStart& before;
  const DeckStart& after;
  const VerifyRelation& relation;
  std::vector<LossEntry>* accepted;
  UnitSystem from, to;
  double tolerance = 0;

  double factor(int mass, int length, int time) const;
  NodeIndex old_node(NodeIndex node) const { return node == no_index ? node : nodes_[node]; }
  std::uint32_t old_contact(std::size_t i) const { return contacts_[i]; }
  std::string node_name(NodeIndex node) const;
  /// True if `now` is `was` in the other units, within `slack`.
  bool same(double was, double now, double unit, double slack = 0) const;
  /// Empty if equal.
  Difference number(const std::string& what, double was, double now, double unit,
                    double slack = 0) const;

  Difference values() const;
  Difference springs() const;
  Difference contacts() const;
  Difference masses() const;
  Difference time_steps() const;
  Difference beam_step(std::uint32_t old, std::uint32_t beam, Difference difference) const;
  Difference cells() const;

 private:
  OldIndices nodes_, interfaces_, contacts_;
};

}  // namespace deck::detail
