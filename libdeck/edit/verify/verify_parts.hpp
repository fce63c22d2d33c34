// What verification compares. Private to the stage.
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

/// What a deck is at its start. Points into the deck: for one comparison.
struct Behaviour {
  const LoadedDeck& context;
  const Scene& scene;
  const cycle::State& state;
  const cycle::SceneOutcome& cycle;
  std::array<std::vector<double>, 5> steps;  ///< of shell4, shell3, solid8, truss, beam
  const std::vector<double>& beam_factors;   ///< Mesh::beam_factors
  std::vector<double> part_mass;             ///< of the elements of each part
  double extent = 0;                         ///< largest coordinate
};
Behaviour behaviour_of(const LoadedDeck& deck);

inline constexpr std::array verified_kinds = {ElementKind::shell4, ElementKind::shell3,
                                              ElementKind::solid8, ElementKind::truss,
                                              ElementKind::beam};

/// Which items of the first deck those of the second are. Both have them in the same order as they
/// are written; the solver's order changes with their ids and files.
struct Partners {
  std::vector<std::uint32_t> old;  ///< empty: the same indices
  std::uint32_t operator[](std::size_t now) const {
    return old.empty() ? static_cast<std::uint32_t>(now) : old[now];
  }
};

/// Two decks, and how values and nodes of the first are found in the second.
struct DeckComparison {
  DeckComparison(const Behaviour& a, const Behaviour& b, const VerifyRelation& r,
                 std::vector<LossEntry>* accept = nullptr);

  using Difference = std::optional<std::string>;
  const Behaviour& before;
  const Behaviour& after;
  const VerifyRelation& relation;
  std::vector<LossEntry>* accepted;
  UnitSystem from, to;
  double tolerance = 0;

  double factor(int mass, int length, int time) const;
  /// Node of the first deck that `node` of the second is.
  NodeIndex old_node(NodeIndex node) const { return node == no_index ? node : nodes_[node]; }
  /// Contact of the first deck that is written where contact `i` of the second is.
  std::uint32_t old_contact(std::size_t i) const { return contacts_[i]; }
  std::string node_name(NodeIndex node) const;
  /// True if `now` is `was` in the other units, or within `slack` of it.
  bool same(double was, double now, double unit, double slack = 0) const;
  /// Nothing if they are the same.
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
  Partners nodes_, interfaces_, contacts_;
};

}  // namespace deck::detail
