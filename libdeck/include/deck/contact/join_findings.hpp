// Gathers, for verdicts about contacts, what else was found wrong with their deck: whether the
// solver comes to its contacts at all.
#pragma once
#include "deck/keyword/deck.hpp"
#include "deck/model/model.hpp"

namespace deck {

/// Adds what cannot be read in the cells that contacts depend on (interfaces, groups, parts,
/// properties, materials ...) to `out`: there 0 stands, and every value looks like one that was
/// meant. Errors only; lint has the rest.
void report_unreadable_cells(const Deck& deck, Diagnostics& out);

/// Joins what cells and the groups of the model were found to lack, and `found` (what building
/// model and scene had to say), to Deck::diagnostics, where make_verdict looks for it. To
/// be called once, behind build_scene(), which resolves the groups of contacts.
void join_findings(Deck& deck, const Model& model, Diagnostics found);

}  // namespace deck
