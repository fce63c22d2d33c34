// Errors of a deck at which the solver stops before it comes to its contacts: no verdict about
// contacts is clean beside them.
#pragma once
#include <string>

#include "deck/keyword/deck.hpp"

namespace deck {

/// " The solver stops first: 2 errors in the deck ..." where Deck::diagnostics has errors that are
/// the solver's own as well; else empty. Empty sides of contacts are left out: verdicts name them.
std::string stops_text(const Deck& deck);

}  // namespace deck
