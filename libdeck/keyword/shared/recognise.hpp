// Recognizes files that are not Starter decks: packed file, Engine file, deck of another solver,
// web page, include file.
#pragma once
#include <string>

#include "deck/keyword.hpp"

namespace deck {

/// Empty for a Starter deck; else kind of the file and advice, to print after "FILE: ". A Starter
/// deck has several lines and /BEGIN, or the banner with a keyword.
std::string no_starter_deck(const Deck& deck);

/// Reason why a deck of input version 41, 42 or 44 is not read, with its place; else empty.
std::string unread_version(const Deck& deck);

}  // namespace deck
