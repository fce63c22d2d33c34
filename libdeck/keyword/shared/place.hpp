// Block, card line and cell at a position in a file.
#pragma once
#include <cstdint>
#include <vector>

#include "deck/keyword.hpp"

namespace deck {

/// Finds the block of an offset. The deck must outlive it.
class BlockIndex {
 public:
  explicit BlockIndex(const Deck& deck);
  /// Index into Deck::blocks, -1: none.
  std::int64_t find(std::uint32_t file, std::uint64_t offset) const;
  /// Index of the next header in the file if only comments are between; else -1.
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

/// One line of a file and its role.
struct PlacedLine {
  enum class What : std::uint8_t {
    outside,    ///< belongs to no keyword
    comment,    ///< begins with '#' or '$'
    directive,  ///< #include and its continuation lines
    header,
    title,
    card,    ///< a line with `card` and `cells`
    opaque,  ///< a line without known cells: no schema, encrypted, or after the described lines
  };
  What what = What::outside;
  Line line;                              ///< the whole line
  std::int64_t block = -1;                ///< index into Deck::blocks
  DecodedCard card;                       ///< for What::card
  const Cell* cell_at(int column) const;  ///< 1-based column; nullptr: none
};

/// The line with this offset. Decodes its block; for nodes and elements only the line.
PlacedLine line_at(const Deck& deck, const BlockIndex& index, std::uint32_t file,
                   std::uint64_t offset);

/// First and last column (1-based) of a cell: of its field, its list position, or the text in free
/// format.
struct CellColumns {
  int first = 0, last = 0;
};
CellColumns columns_of(const DecodedCard& card, const Cell& cell);

}  // namespace deck
