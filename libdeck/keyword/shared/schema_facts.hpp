// What follows from a schema: the legal words of a keyword with lists of words (the variables of a
// time history), and whether a deck older than the keyword has its lines. Private to the library.
#pragma once
#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "deck/keyword.hpp"

namespace deck::detail {

/// Whether the condition holds for the cell of its field; nullptr: it has none.
bool holds(const Condition& condition, const Cell* cell);

/// Empty: not known. "SX*" is SX, then a digit or '_', then any rest.
std::span<const std::string> legal_words(const Schema& schema);
/// Whether the text is one of them, in any case.
bool has_word(const Schema& schema, std::string_view text);

/// False if the solver takes the keyword and none of its lines in a deck of this version ("older":
/// "unread" in the schema).
inline bool reads_lines(const Schema& schema, int version) {
  return version >= schema.from || schema.cards.empty() ||
         std::any_of(schema.cards.begin(), schema.cards.end(),
                     [&](const CardSchema& card) { return card.in_version(version); });
}

}  // namespace deck::detail
