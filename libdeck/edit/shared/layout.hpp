// Cards laid out: headings over the columns, all lines of a new card, one cell set.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "text/shared/edits.hpp"

namespace deck {

/// "#  grnd_IDs  surf_IDm      Istf": names that end where their columns end, cut to their width;
/// one that is narrower than three columns is left out. Empty for a card of another version.
std::string card_heading(const CardSchema& card, int version);

/// Every line of a new card: `header`, a title if the keyword has one, and for each line that a
/// card without values has a heading and a line of blanks up to its last column. A card that
/// repeats stands once. Lines end with "\n".
std::string new_card(const Schema& schema, std::string_view header, int version,
                     std::string_view title);

/// Edit that writes `text` into the first cell called `field` whose line is there, `round` lines of
/// a repeated card later, and moves nothing else; empty text blanks it. Error (config): no such
/// field in this version, its line is missing, the line is in free format, or the text is longer
/// than the cell; the message says which.
Result<TextEdit> set_cell(const Deck& deck, const Block& block, std::string_view field,
                          std::string_view text, int round = 0);

}  // namespace deck
