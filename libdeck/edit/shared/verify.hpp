// Verification of a conversion: the deck that came out starts as the deck that went in — the same
// effective values, gaps, penetrations, actions, forces, masses and time steps, in its own units.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "deck/edit/rewrite.hpp"

namespace deck {

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
/// Of one conversion by its name ("--units") and what it reports.
VerifyRelation relation_of(std::string_view step, const std::vector<LossEntry>& losses);

/// The first thing that is not the same, with both values; nullopt: nothing. Compared are effective
/// values, contacts, forces of the first cycle, masses, time steps of the elements; what of them
/// was not made before is made and stays with its deck. Values of the first deck are taken in the
/// working units of the second. A pair that is within rounding of its gap may penetrate in one deck
/// only.
///
/// A few formulas of the solver depend on the unit of length. With `accepted` what differs only by
/// them is no difference; it is entered there.
///
///     if (auto why = first_difference(deck, result, relation_of("--units", rewrite.losses)))
///       refuse(*why);
std::optional<std::string> first_difference(const LoadedDeck& before, const LoadedDeck& after,
                                            const VerifyRelation& relation,
                                            std::vector<LossEntry>* accepted = nullptr);

}  // namespace deck
