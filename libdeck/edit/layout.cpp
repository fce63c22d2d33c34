// Lays cards out by their schema.
#include "edit/shared/layout.hpp"

#include <algorithm>

#include "keyword/shared/place.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

using detail::trim;

/// Puts `text` so that it ends at column `last`.
void put_ending_at(std::string& line, int last, std::string_view text) {
  const auto end = static_cast<std::size_t>(last);
  if (line.size() < end) line.resize(end, ' ');
  const std::size_t begin = end - std::min(end, text.size());
  line.replace(begin, end - begin, text.substr(text.size() - (end - begin)));
}

/// True for lines of a block without values: their conditions are true for zeros.
bool stands_without_values(const std::vector<Condition>& when) {
  return std::all_of(when.begin(), when.end(), [](const Condition& c) {
    return c.words.empty() && c.field != Condition::data_lines && c.accepts(0);
  });
}

}  // namespace

std::string card_heading(const CardSchema& card, int version) {
  if (!card.in_version(version)) return {};
  if (card.blank()) return "# blank line";  // without a comment users would delete the line
  std::string head = "#";
  for (const Field& f : card.fields) {
    if (!f.in_version(version)) continue;
    const auto width = static_cast<std::size_t>(f.last - f.first + 1);
    // One column between names stays free.
    if (width < 3 || static_cast<std::size_t>(f.last) <= head.size() + 1) continue;
    const std::size_t room = std::min(width, static_cast<std::size_t>(f.last) - head.size()) - 1;
    put_ending_at(head, f.last, std::string_view(f.name).substr(0, std::max<std::size_t>(room, 1)));
  }
  return head;
}

std::string new_card(const Schema& schema, std::string_view header, int version,
                     std::string_view title) {
  std::string out = std::string(header) + "\n";
  if (schema.has_title) out += std::string(title) + "\n";
  bool absent = false;  // presence of a group follows its first card
  for (std::size_t i = 0; i < schema.cards.size(); ++i) {
    const CardSchema& card = schema.cards[i];
    const bool of_group = card.repeat == Repeat::group;
    const bool goes_on = of_group && i > 0 && schema.cards[i - 1].repeat == Repeat::group &&
                         schema.cards[i - 1].count == card.count;
    if (!goes_on) absent = of_group && card.optional;
    if (!card.in_version(version) || !stands_without_values(card.when) || card.optional || absent)
      continue;
    int last = 0;
    for (const Field& f : card.fields)
      if (f.in_version(version) && stands_without_values(f.when)) last = std::max(last, f.last);
    if (last == 0 && !card.blank()) continue;
    out += card_heading(card, version) + "\n" + std::string(static_cast<std::size_t>(last), ' ') +
           "\n";
  }
  return out;
}

Result<TextEdit> set_cell(const Deck& deck, const Block& block, std::string_view field,
                          std::string_view text, int round) {
  const auto bad = [&](const std::string& why) {
    return Error{Error::Code::config, std::string(block.header) + ": " + why};
  };
  if (block.schema == nullptr) return bad("no schema describes its lines");
  if (block.opaque) return bad("the block is encrypted");
  const DecodedBlock decoded = decode(deck, block);
  int at = 0;
  bool missing = false;
  for (const DecodedCard& card : decoded.cards)
    for (const Cell& cell : card.cells) {
      if (cell.field->name != field || at++ != round) continue;
      if (card.free_format) return bad("the line of " + std::string(field) + " is in free format");
      const CellColumns columns = columns_of(card, cell);
      const auto width = static_cast<std::size_t>(columns.last - columns.first + 1);
      if (text.size() > width)
        return bad("'" + std::string(text.substr(0, 60)) + "' is longer than the " +
                   std::to_string(width) + " columns of " + std::string(field));
      return CellWriter::edit(deck.sources, card.line.whole(), columns.first, columns.last, text);
    }
  for (const CardSchema& card : block.schema->cards)
    for (const Field& f : card.fields)
      missing |= f.name == field && card.in_version(block.version) && f.in_version(block.version);
  return bad(missing ? "its line with " + std::string(field) + " is not there"
                     : "version " + std::to_string(block.version) + " has no field " +
                           std::string(field));
}

}  // namespace deck
