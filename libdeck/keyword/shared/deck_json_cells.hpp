// What the JSON form of a deck and its reader have to agree on: what a cell's value is, how bytes
// that are no UTF-8 are spelled, and the sums that tell what was changed. Private to the library.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/decode.hpp"

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
/// Bytes taken for Latin-1, as UTF-8 ...
std::string latin1_to_utf8(std::string_view bytes);
/// ... and back; nullopt if a character is beyond Latin-1 or the text is no UTF-8.
std::optional<std::string> utf8_to_latin1(std::string_view text);

/// A short sum of texts, 8 digits in hexadecimal. Beside a text in a document it tells whether the
/// text still is what was written there.
class TextSum {
 public:
  TextSum& add(std::string_view text);
  std::string text() const;

 private:
  std::uint64_t hash_ = 1469598103934665603u;
};
inline std::string sum_of_text(std::string_view text) { return TextSum().add(text).text(); }
/// The same for a JSON value, however its numbers are spelled and its members are ordered.
std::string sum_of_json(std::string_view json);

}  // namespace deck::detail
