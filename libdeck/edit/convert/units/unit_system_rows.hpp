// Blocks of nodes and elements that unit conversion has converted before, for decks that share
// includes. Private to unit conversion.
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "deck/text/diagnostic.hpp"

namespace deck::detail {

class ConvertedRows {
 public:
  /// Appends the edits of a block with these bytes, which begins at `begin` of `file`; false: there
  /// was none. `how` says which columns got which factors.
  bool replay(std::string_view bytes, std::string_view how, std::uint32_t file, std::uint64_t begin,
              std::vector<TextEdit>& edits) const {
    const auto [first, last] = blocks_.equal_range(std::hash<std::string_view>()(bytes));
    for (auto it = first; it != last; ++it) {
      const Block& b = it->second;
      if (b.how != how || b.bytes != bytes) continue;
      if (const std::size_t all = edits.size() + b.cells.size(); all > edits.capacity())
        edits.reserve(std::max(all, 2 * edits.capacity()));
      std::size_t at = 0;
      for (const Cell& c : b.cells) {
        edits.push_back({Span{file, c.length, begin + c.offset}, b.texts.substr(at, c.text)});
        at += c.text;
      }
      return true;
    }
    return false;
  }

  /// Remembers the edits from `first` on, all of them in the block. Beyond a bound of memory
  /// nothing more is.
  void keep(std::string_view bytes, std::string_view how, std::uint64_t begin,
            const std::vector<TextEdit>& edits, std::size_t first) {
    constexpr std::size_t most = std::size_t{64} << 20;
    if (bytes.size() > most - held_) return;
    held_ += bytes.size();
    Block b{std::string(bytes), std::string(how), {}, {}};
    b.cells.reserve(edits.size() - first);
    for (std::size_t i = first; i < edits.size(); ++i) {
      const TextEdit& e = edits[i];
      b.cells.push_back({e.span.offset - begin, static_cast<std::uint32_t>(e.span.length),
                         static_cast<std::uint32_t>(e.text.size())});
      b.texts += e.text;
    }
    blocks_.emplace(std::hash<std::string_view>()(bytes), std::move(b));
  }

 private:
  struct Cell {
    std::uint64_t offset;
    std::uint32_t length, text;
  };
  struct Block {
    std::string bytes, how;
    std::vector<Cell> cells;
    std::string texts;  ///< of all cells, one after the other
  };
  std::unordered_multimap<std::size_t, Block> blocks_;
  std::size_t held_ = 0;
};

}  // namespace deck::detail
