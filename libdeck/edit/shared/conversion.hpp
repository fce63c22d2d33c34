// Conversions beside those of edit.hpp: effective values written into the cards of the contact
// interfaces; and what all conversions have: the report of every value that changed, and the
// verification that the deck that came out starts as the deck that went in — the same effective
// values, gaps, penetrations, actions, forces, masses and time steps, in its own units.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit.hpp"

namespace deck {

struct ResolveOptions {
  /// Write the rest although a default card stays in force for what is undecided. Without it that
  /// is a refusal: the deck would go on depending on the card.
  bool allow_loss = false;
};

/// Fills every cell of a contact or tie whose effective value comes from a default card
/// or is built in and is not zero. Effective values stay the same to the last bit. Cells that hold
/// a value already are not touched, except where the meaning of their unit changes (Stfac, once
/// Istf 1 stands on the card). The default cards stay; they have no effect on these cells any more.
/// Loss report: `kept` for every value written (old text, new text, and where it came from) and for
/// values that follow from the mesh or from other fields, which stay blank; `approximated` where no
/// text of the cell's width gives the value back exactly; `undecided` where a default card is at
/// work and the card has no cell for the value (Iedge of TYPE19, cells newer than the deck's
/// version, a parameter that is 0).
Rewrite resolve_defaults(const LoadedDeck& context, const ResolveOptions& options = {});

/// Adds an entry to rewrite.losses for every edit that has none yet, with the field the edit
/// changes and `option` as the reason, and the columns to those that have. Also where the
/// conversion is refused: then it is what would have been changed.
void add_changed_values(const LoadedDeck& context, std::string_view option, Rewrite& rewrite);

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
