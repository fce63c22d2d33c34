// Conversions in addition to edit.hpp: write effective values into interface cards; report every
// changed value; verify that the converted deck starts like the old one: equal effective values,
// gaps, penetrations, actions, forces, masses and time steps, in its own units.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "deck/edit.hpp"

namespace deck {

struct ResolveOptions {
  /// Write although an undecided value still depends on a default card; false: refuse.
  bool allow_loss = false;
};

/// Fills every cell of a contact or tie whose effective value is not 0 and comes from a default
/// card or is built in. Effective values keep their bits. Filled cells do not change, unless the
/// meaning of their unit does (Stfac, after Istf 1 is written). The default cards stay, without
/// effect on these cells. Losses: `kept` for every written value (old and new text, origin) and for
/// values from the mesh or other fields, which stay blank; `approximated` if the cell is too narrow
/// for the value; `undecided` if a default card gives a value for which the card has no cell (Iedge
/// of TYPE19, cells newer than the deck's version, a parameter that is 0).
Rewrite resolve_defaults(const LoadedDeck& context, const ResolveOptions& options = {});

/// Adds a loss entry per edit without one: the changed field, with `option` as reason; adds columns
/// to the others. Also if the conversion is refused: then as the planned change.
void add_changed_values(const LoadedDeck& context, std::string_view option, Rewrite& rewrite);

/// Relation of two decks.
struct VerifyRelation {
  bool new_ids = false;   ///< renumbered: nodes, elements and interfaces in the same order
  bool extract = false;   ///< the second deck has some interfaces of the first, ids unchanged
  bool expanded = false;  ///< every TYPE19 of the first is TYPE7 and TYPE11 in the second
  bool rounded = false;   ///< cells of the second deck may be too narrow for all digits
  std::set<std::int64_t> lossy;  ///< interfaces that lost a value, which is accepted
  bool lossy_defaults = false;   ///< /DEFAULT/INTER lost a value, which is accepted
  bool cells = false;            ///< only units or columns differ: all other cells are compared too
};
/// Relation for a conversion by name ("--units") and its losses.
VerifyRelation relation_of(std::string_view step, const std::vector<LossEntry>& losses);

/// First difference, with both values; nullopt if none. Compares effective values, contacts, forces
/// of the first cycle, masses, time steps of elements, and evaluates what is missing in both decks.
/// Values of the first deck are converted to the working units of the second. A pair at its gap
/// within round-off may penetrate in one deck only.
///
/// Some formulas of the solver depend on the unit of length: differences caused by them alone go to
/// `accepted`.
///
///     if (auto why = first_difference(deck, result, relation_of("--units", rewrite.losses)))
///       refuse(*why);
std::optional<std::string> first_difference(const LoadedDeck& before, const LoadedDeck& after,
                                            const VerifyRelation& relation,
                                            std::vector<LossEntry>* accepted = nullptr);

}  // namespace deck
