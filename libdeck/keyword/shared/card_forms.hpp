// Card text from a schema and values; JSON form of cell values, including bytes that are not UTF-8.
// Private to the library.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// Writes header, title and one line per card whose conditions hold. Fields without a value stay
/// blank. Unknown names are written as a comment, to show typing errors in examples.
std::string render_card(const Schema& schema, std::string_view header, int version,
                        const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace deck

namespace deck::detail {

/// Id of the schema of the document.
inline constexpr std::string_view deck_json_id = "deck/deck";
inline constexpr int deck_json_version = 1;

enum class CellKind : std::uint8_t { null, integer, real, text };

/// Form of a cell: text for parameters, names and unreadable numbers.
CellKind kind_of(const Cell& cell);

/// The card that takes all lines after the title in this version; nullptr: another layout.
const CardSchema* list_card(const Schema& schema, int version);

/// The cards without a line that the block should have, in order.
std::vector<const CardSchema*> missing_cards(const Deck& deck, const Block& block);

bool is_utf8(std::string_view bytes);
/// Converts Latin-1 to UTF-8.
std::string latin1_to_utf8(std::string_view bytes);

}  // namespace deck::detail
