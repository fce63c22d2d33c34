// Facts derived from a schema: legal words of a keyword (variables of a time history), and if a
// deck older than the keyword has its lines. Private to the library.
#pragma once
#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "deck/keyword.hpp"

namespace deck::detail {

/// True if the condition holds for `cell`; nullptr: no such cell.
bool is_met(const Condition& condition, const Cell* cell);

/// Empty: unknown. "SX*": SX, then a digit or '_', then any text.
std::span<const std::string> legal_words(const Schema& schema);
/// True if the text is one of the words, in any case.
bool has_word(const Schema& schema, std::string_view text);

/// False if the solver accepts the keyword and reads none of its lines in this version ("older":
/// "unread").
inline bool reads_lines(const Schema& schema, int version) {
  return version >= schema.from || schema.cards.empty() ||
         std::any_of(schema.cards.begin(), schema.cards.end(),
                     [&](const CardSchema& card) { return card.in_version(version); });
}

}  // namespace deck::detail
