// Tells a Starter deck from everything else that a person may name by mistake: a compressed file,
// an Engine file, a deck of another solver, a web page, an include file.
#pragma once
#include <string>

#include "deck/keyword.hpp"

namespace deck {

/// Empty for a Starter deck, else what the main file is and what to do, behind "FILE: ". A Starter
/// deck has more than one line, and /BEGIN, or the banner with a keyword; whether the solver likes
/// it is another question.
std::string no_starter_deck(const Deck& deck);

/// Why a deck of input version 41, 42 or 44 is not read, with its place; empty for other decks.
std::string unread_version(const Deck& deck);

}  // namespace deck
