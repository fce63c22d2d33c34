// Decks older than a keyword: read with its oldest layout, or with none of its lines.
#pragma once
#include <algorithm>

#include "deck/keyword/schema.hpp"

namespace deck::detail {

/// False if the solver takes the keyword and none of its lines in a deck of this version ("older":
/// "unread" in the schema).
inline bool reads_lines(const Schema& schema, int version) {
  return version >= schema.from || schema.cards.empty() ||
         std::any_of(schema.cards.begin(), schema.cards.end(),
                     [&](const CardSchema& card) { return card.in_version(version); });
}

}  // namespace deck::detail
