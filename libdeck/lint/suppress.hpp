// Suppression comments in the deck: "# decklint: ignore[DK203] reason=..." for the block it stands
// in or before, "# decklint: ignore-file[...] reason=..." for its file. Private to the lint stage.
#pragma once
#include <string>
#include <vector>

#include "deck/lint/lint.hpp"

namespace deck::detail {

struct Suppression {
  std::vector<std::string> rules;  ///< ids or prefixes
  std::string reason;
  bool whole_file = false;
  std::uint32_t file = 0;
  std::int64_t block = -1;  ///< index into Deck::blocks; -1: whole file, or nothing
  Span span;                ///< the comment line
  bool used = false;
};

/// Finds which block an offset of a file belongs to.
class BlockIndex {
 public:
  explicit BlockIndex(const Deck& deck);
  /// Index into Deck::blocks, -1: none.
  std::int64_t find(std::uint32_t file, std::uint64_t offset) const;
  /// Start of the next header behind `offset` in the file, if only comments stand between.
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

/// All suppressions of the deck; malformed ones become findings.
std::vector<Suppression> find_suppressions(const Deck& deck, const BlockIndex& index,
                                           Reporter& reporter);
/// The suppression that covers `d`, nullptr: none.
Suppression* covering(std::vector<Suppression>& suppressions, const BlockIndex& index,
                      const Diagnostic& d);

}  // namespace deck::detail
