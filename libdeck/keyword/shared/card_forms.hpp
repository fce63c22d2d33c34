// Cards in other forms: the text of a card from its schema and some values; the JSON form of a
// deck: what a cell's value is, and how bytes that are no UTF-8 are spelled. Private to the
// library.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// A card block of `schema` at `version`: header, title, one line per card whose conditions hold.
/// Fields that are not given stay blank. Unknown names are put out as a comment so that a typing
/// error in an example shows.
std::string render_card(const Schema& schema, std::string_view header, int version,
                        const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace deck

namespace deck::detail {

/// Schema of the document.
inline constexpr std::string_view deck_json_id = "deck/deck";
inline constexpr int deck_json_version = 1;

enum class CellKind : std::uint8_t { null, integer, real, text };

/// How a cell is written: text for parameters, names and numbers that cannot be read.
CellKind kind_of(const Cell& cell);

/// The card that takes all lines behind the title in this version, if the block is such a list.
const CardSchema* list_card(const Schema& schema, int version);

/// The cards that a block ends before although it should have them, in order.
std::vector<const CardSchema*> missing_cards(const Deck& deck, const Block& block);

bool is_utf8(std::string_view bytes);
/// Bytes taken for Latin-1, as UTF-8.
std::string latin1_to_utf8(std::string_view bytes);

}  // namespace deck::detail
