// Layout of cards: headings, all lines of a new card, setting one cell.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "text/shared/edits.hpp"

namespace deck {

/// "#  grnd_IDs  surf_IDm      Istf": each name ends at its column's end and is cut to its width;
/// cells of fewer than three columns have none. Empty if the version lacks the card.
std::string card_heading(const CardSchema& card, int version);

/// All lines of a new card: `header`, a title if the keyword has one, and per line of a card
/// without values a heading and blanks up to its last column. A repeated card is written once.
/// Lines end with "\n".
std::string new_card(const Schema& schema, std::string_view header, int version,
                     std::string_view title);

/// Edit that writes `text` into the first existing cell `field`, `round` repetitions later, without
/// moving other cells; empty text blanks it. Error (config): the version has no such field, its
/// line is missing or in free format, or the text is too long; the message says which.
Result<TextEdit> set_cell(const Deck& deck, const Block& block, std::string_view field,
                          std::string_view text, int round = 0);

}  // namespace deck
