// Decoding: the lines of a block against its schema. Every value keeps its span, so that a
// diagnostic can point at the columns and an edit can change them and nothing else.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/deck.hpp"
#include "deck/text/number.hpp"

namespace deck {

/// One decoded cell.
struct Cell {
  const Field* field = nullptr;
  Span span;              ///< its columns on the line, clipped to the line (may be empty)
  std::string_view text;  ///< trimmed
  NumberStatus status = NumberStatus::blank;
  std::int64_t integer = 0;  ///< int, id, flag; what the reference solver reads
  double real = 0;           ///< real cells, in the deck's units
  bool parameter = false;    ///< the value came from a &parameter
  bool blank() const { return status == NumberStatus::blank; }
};

struct DecodedCard {
  const CardSchema* schema = nullptr;
  Line line;  ///< invalid: the line is missing
  /// One per field of this version whose conditions hold; for Repeat::ids one per non-blank id, for
  /// lists with a count one per id.
  std::vector<Cell> cells;
  bool free_format = false;
  int round = 0;  ///< repeated cards and counted lists: which time, or which line, from 1
  bool missing() const { return !line.valid(); }
};

struct DecodedBlock {
  const Block* block = nullptr;
  std::string title;
  Line title_line;
  std::vector<DecodedCard> cards;  ///< in line order; repeated cards appear once per line
  std::vector<Line> extra;         ///< data lines after the last card of the schema
  /// First cell of that name; nullptr if this version or this block does not have it.
  const Cell* find(std::string_view field) const;
  /// Value of an integer/id/flag cell, 0 if absent.
  std::int64_t integer(std::string_view field) const;
  /// Value of a real cell in the deck's units, 0 if absent.
  double real(std::string_view field) const;
  /// Spot for messages about the block as a whole.
  Span span() const { return block->header_span; }
};

/// Reads every cell of `block`. Lines may be fewer or more than the schema's: that is data, and
/// with `diagnostics` also findings (missing and extra lines, text in blank columns, unreadable
/// numbers, tabs, text beyond the last cell).
DecodedBlock decode(const Deck& deck, const Block& block, Diagnostics* diagnostics = nullptr);

/// True if all conditions hold for the cells of a block. Cells of `card` count first, then those of
/// the same round, then those that do not repeat.
bool holds(const std::vector<Condition>& when, const DecodedBlock& block,
           const DecodedCard* card = nullptr);
/// Dimension of a field in a given block (resolves Field::dimension_when), `card` being its line.
Dimension dimension_of(const Field& field, const DecodedBlock& block,
                       const DecodedCard* card = nullptr);
/// Value of a real cell in working units; `card`: its line, where that decides on the dimension.
double working_value(const Deck& deck, const DecodedBlock& block, const Cell& cell,
                     const DecodedCard* card = nullptr);
/// The same of the first cell of that name; 0 where there is none.
double working_value(const Deck& deck, const DecodedBlock& block, std::string_view field);

/// Cells of one line. Free format if the line holds a comma (titles never are). Conditions of cells
/// can look at this line only: where they test another field they count as true.
DecodedCard decode_line(const Deck& deck, const Block& block, const CardSchema& card,
                        const Line& line, Diagnostics* diagnostics);

}  // namespace deck
