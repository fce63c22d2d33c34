// Blocks of nodes and elements that unit conversion has converted before, for decks that share
// includes: one edit each instead of one per cell. Private to unit conversion.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/known_inputs.hpp"
#include "deck/text/diagnostic.hpp"

namespace deck::detail {

class ConvertedRows {
 public:
  /// Appends the edit of a block with these bytes, which begins at `begin` of `file`, and returns
  /// how many cells it changes; nullopt: there was none. `how` says which columns got which
  /// factors.
  std::optional<std::size_t> replay(std::string_view bytes, std::string_view how,
                                    std::uint32_t file, std::uint64_t begin,
                                    std::vector<TextEdit>& edits) const {
    const auto [first, last] = blocks_.equal_range(mark_of(bytes));
    for (auto it = first; it != last; ++it) {
      const Block& b = it->second;
      if (b.how != how || b.bytes != bytes) continue;
      if (b.cells > 0) edits.push_back({Span{file, b.length, begin + b.offset}, b.text});
      return b.cells;
    }
    return std::nullopt;
  }

  /// Makes one edit of those from `first` on, if they are in the order of the block, and
  /// remembers it. Beyond a bound of memory nothing more is remembered.
  void keep(std::string_view bytes, std::string_view how, std::uint64_t begin,
            std::vector<TextEdit>& edits, std::size_t first) {
    constexpr std::size_t most = std::size_t{64} << 20;
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max() / 2) return;
    Block b{{}, std::string(how), {}, 0, 0, edits.size() - first};
    if (b.cells > 0) {
      const std::uint64_t from = edits[first].span.offset;
      std::uint64_t at = from;
      b.text.reserve(bytes.size());
      for (std::size_t i = first; i < edits.size(); ++i) {
        const Span& span = edits[i].span;
        if (span.offset < at) return;
        b.text += bytes.substr(at - begin, span.offset - at);
        b.text += edits[i].text;
        at = span.offset + span.length;
      }
      b.offset = from - begin;
      b.length = static_cast<std::uint32_t>(at - from);
      const std::uint32_t file = edits[first].span.file;
      edits.resize(first);
      edits.push_back({Span{file, b.length, from}, b.text});
    }
    if (bytes.size() > most - held_) return;
    held_ += bytes.size();
    b.bytes = bytes;
    blocks_.emplace(mark_of(bytes), std::move(b));
  }

 private:
  static std::uint64_t mark_of(std::string_view bytes) {
    const InputBytes piece = std::as_bytes(std::span<const char>(bytes.data(), bytes.size()));
    return deck::input_mark({&piece, 1}) ^ bytes.size();
  }

  /// One edit from the first cell that changes to the last.
  struct Block {
    std::string bytes, how, text;
    std::uint64_t offset;
    std::uint32_t length;
    std::size_t cells;
  };
  std::unordered_multimap<std::uint64_t, Block> blocks_;
  std::size_t held_ = 0;
};

}  // namespace deck::detail
