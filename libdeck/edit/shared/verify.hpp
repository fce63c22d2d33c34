// Verification of a conversion: the deck that came out starts as the deck that went in — the same
// effective values, gaps, penetrations, actions, forces, masses and time steps, in its own units.
#pragma once
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "deck/edit/rewrite.hpp"

namespace deck {

/// What a deck is at its start: effective values, contacts, forces of the first cycle, nodal
/// masses, time steps of the elements. Points into the deck it was made of.
class Behaviour {
 public:
  explicit Behaviour(const LoadedDeck& deck);
  ~Behaviour();
  Behaviour(const Behaviour&) = delete;
  Behaviour& operator=(const Behaviour&) = delete;

  struct Parts;
  const Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

/// How the two decks are related.
struct VerifyRelation {
  bool new_ids = false;   ///< renumbered: nodes, elements and interfaces in the same order
  bool extract = false;   ///< the second holds some interfaces of the first, with the same ids
  bool expanded = false;  ///< every TYPE19 of the first is TYPE7 and TYPE11 in the second
  bool rounded = false;   ///< cells of the second hold fewer digits than it takes
  std::set<std::int64_t> lossy;  ///< interfaces of which a value was given up, and that is accepted
  bool lossy_defaults = false;   ///< the same of /DEFAULT/INTER
  bool cells =
      false;  ///< the same deck in other units or columns: all other cells are compared, too
};
/// Of one conversion, by what it reports.
VerifyRelation relation_of(const std::vector<LossEntry>& losses);

/// The first thing that is not the same, with both values; nullopt: nothing. Values of the first
/// deck are taken in the working units of the second. A pair that is within rounding of its gap may
/// penetrate in one deck only.
///
///     Behaviour before(deck), after(result);
///     if (auto why = first_difference(before, after, relation_of(rewrite.losses))) refuse(*why);
std::optional<std::string> first_difference(const Behaviour& before, const Behaviour& after,
                                            const VerifyRelation& relation);

}  // namespace deck
