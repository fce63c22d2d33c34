// What stands at a place of a file: which block, which line of its card, which cell. For everything
// that is asked with a file, a line and a column in hand.
#pragma once
#include <cstdint>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// Finds which block an offset of a file belongs to. The deck must outlive it.
class BlockIndex {
 public:
  explicit BlockIndex(const Deck& deck);
  /// Index into Deck::blocks, -1: none.
  std::int64_t find(std::uint32_t file, std::uint64_t offset) const;
  /// Index of the next header behind `offset` in the file, if only comments stand between; -1.
  std::int64_t next_header_after_comments(std::uint32_t file, std::uint64_t offset) const;
  /// True if the file has no header before `offset`.
  bool before_first_header(std::uint32_t file, std::uint64_t offset) const;

 private:
  struct Range {
    std::uint32_t file;
    std::uint64_t begin, end;
    std::int64_t block;
  };
  const Deck* deck_;
  std::vector<Range> ranges_;   // sorted by file, begin
  std::vector<Range> headers_;  // likewise
};

/// One line of a file with what it is for.
struct PlacedLine {
  enum class What : std::uint8_t {
    outside,    ///< belongs to no keyword
    comment,    ///< begins with '#' or '$'
    directive,  ///< #include and its continued lines
    header,
    title,
    card,    ///< a line that the schema of its block describes: `card` and `cells`
    opaque,  ///< a line of a block without schema, encrypted, or behind the described ones
  };
  What what = What::outside;
  Line line;                              ///< the whole line
  std::int64_t block = -1;                ///< index into Deck::blocks
  DecodedCard card;                       ///< of What::card
  const Cell* cell_at(int column) const;  ///< of a 1-based column; nullptr: none
};

/// The line that holds the offset. Costs decoding its block, of nodes and elements its line.
PlacedLine line_at(const Deck& deck, const BlockIndex& index, std::uint32_t file,
                   std::uint64_t offset);

/// First and last column of a cell of a line (1-based): those of its field, of a list its place in
/// the list, in free format what is written.
struct CellColumns {
  int first = 0, last = 0;
};
CellColumns columns_of(const DecodedCard& card, const Cell& cell);

}  // namespace deck
