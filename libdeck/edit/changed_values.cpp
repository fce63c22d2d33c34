// Finds the block and the cell of every edit.
#include "edit/shared/conversion.hpp"

#include <algorithm>
#include <map>

#include "deck/keyword.hpp"
#include "keyword/shared/place.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

/// Cells of one block by place, decoded on first use.
class CellFinder {
 public:
  explicit CellFinder(const Deck& deck) : deck_(deck) {}
  struct Place {
    std::pair<std::uint32_t, std::uint64_t> begin;
    std::uint64_t end = 0;
    std::string name;
  };
  /// First cell that an edit touches; nullptr if none.
  const Place* find(const Block& block, const Span& edit) {
    if (&block != block_) read(block);
    auto it = std::upper_bound(cells_.begin(), cells_.end(), std::pair{edit.file, edit.offset},
                               [](const auto& key, const Place& p) { return key < p.begin; });
    if (it != cells_.begin()) {
      const Place& before = *std::prev(it);
      if (before.begin.first == edit.file && edit.offset < before.end) return &before;
    }
    // The edit begins in front of the cell.
    const std::uint64_t end = edit.offset + std::max<std::uint32_t>(edit.length, 1);
    const bool next = it != cells_.end() && it->begin.first == edit.file && it->begin.second < end;
    return next ? &*it : nullptr;
  }

 private:
  void read(const Block& block) {
    block_ = &block;
    cells_.clear();
    if (block.schema == nullptr || block.opaque) return;
    for (const DecodedCard& card : decode(deck_, block).cards)
      for (const Cell& cell : card.cells)
        if (cell.span.valid() && cell.span.length > 0)
          cells_.push_back({{cell.span.file, cell.span.offset},
                            cell.span.offset + cell.span.length,
                            cell.field->name});
    std::sort(cells_.begin(), cells_.end(),
              [](const Place& a, const Place& b) { return a.begin < b.begin; });
  }
  const Deck& deck_;
  const Block* block_ = nullptr;
  std::vector<Place> cells_;
};

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 200;
  const std::string_view bare = detail::trim(text);
  return bare.size() <= longest ? std::string(bare) : std::string(bare.substr(0, longest)) + "...";
}

}  // namespace

void add_changed_values(const LoadedDeck& context, std::string_view option, Rewrite& rewrite) {
  const Deck& deck = context.deck();
  const BlockIndex blocks(deck);
  CellFinder cells(deck);
  // Losses that the conversion has reported, by line.
  std::multimap<std::pair<std::string_view, std::uint64_t>, std::size_t> told;
  const std::size_t known = rewrite.losses.size();
  rewrite.losses.reserve(known + rewrite.edits.size());
  for (std::size_t i = 0; i < known; ++i)
    told.emplace(std::pair{std::string_view(rewrite.losses[i].file), rewrite.losses[i].line}, i);
  std::vector<const TextEdit*> edits;
  for (const TextEdit& e : rewrite.edits) edits.push_back(&e);
  std::stable_sort(edits.begin(), edits.end(), [](const TextEdit* a, const TextEdit* b) {
    return std::pair{a->span.file, a->span.offset} < std::pair{b->span.file, b->span.offset};
  });
  for (const TextEdit* edit : edits) {
    const std::string_view before = deck.sources.text(edit->span);
    if (before == edit->text) continue;
    const std::int64_t index = blocks.find(edit->span.file, edit->span.offset);
    const Block* block = index < 0 ? nullptr : &deck.blocks[static_cast<std::size_t>(index)];
    const CellFinder::Place* cell = block == nullptr ? nullptr : cells.find(*block, edit->span);
    Span span = edit->span;
    std::string now = edit->text;
    const std::uint64_t edit_end = span.offset + span.length;
    if (cell != nullptr && cell->begin.second <= span.offset && edit_end <= cell->end) {
      // Report the whole value if some of its digits change.
      span = {span.file, static_cast<std::uint32_t>(cell->end - cell->begin.second),
              cell->begin.second};
      const std::string_view whole = deck.sources.text(span);
      now = std::string(whole.substr(0, edit->span.offset - span.offset)) + edit->text +
            std::string(whole.substr(edit_end - span.offset));
    }
    const Position place = deck.sources.position(span);
    const std::string old_text = shown(deck.sources.text(span)), new_text = shown(now);
    const std::uint64_t end = place.column + std::max<std::uint32_t>(span.length, 1) - 1;
    const auto [first, last] =
        told.equal_range({std::string_view(deck.sources[edit->span.file].path()), place.line});
    const auto same = std::find_if(first, last, [&](const auto& entry) {
      const LossEntry& e = rewrite.losses[entry.second];
      return e.column == 0 && !e.field.empty() &&
             (e.old_text == old_text || e.new_text == new_text);
    });
    if (same != last) {
      LossEntry& e = rewrite.losses[same->second];
      e.column = place.column;
      e.end_column = end;
      continue;
    }
    LossEntry entry;
    entry.loss = Loss::kept;
    entry.file = deck.sources[edit->span.file].path();
    entry.line = place.line;
    entry.column = place.column;
    entry.end_column = end;
    if (block != nullptr) {
      entry.keyword = std::string(block->keyword);
      entry.id = block->id.value;
    }
    if (cell != nullptr) entry.field = cell->name;
    entry.old_text = old_text;
    entry.new_text = new_text;
    entry.note = std::string(option);
    rewrite.losses.push_back(std::move(entry));
  }
}

}  // namespace deck
