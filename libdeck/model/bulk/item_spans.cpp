// Walks a bulk block once more for the lines of single nodes or elements.
#include "model/shared/item_spans.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace deck::detail {
namespace {

std::size_t lines_per_item(const Block& block) {
  if (block.schema == nullptr) return 1;
  std::size_t grouped = 0;
  for (const CardSchema& card : block.schema->cards)
    grouped += card.repeat == Repeat::group && card.in_version(block.version);
  return std::max<std::size_t>(grouped, 1);
}

thread_local std::uint64_t walked = 0;

/// Calls `take(index, line)` for the items of a block in order, until it returns false.
template <class Take>
void walk_items(const Deck& deck, const BulkBlock& range, const Take& take) {
  LineCursor cursor(deck.sources, *range.block);
  const std::size_t lines = lines_per_item(*range.block);
  for (std::uint32_t i = range.first;; ++i) {
    Line line = cursor.next();
    while (line.valid() && line.text.empty()) line = cursor.next();
    if (!line.valid()) break;
    ++walked;
    if (!take(i, line)) break;
    for (std::size_t k = 1; k < lines; ++k) cursor.next();
  }
}

/// Lines of items of any blocks, in any order and with repetitions, by one walk of a block for all
/// its items. `block_of` an item, all blocks at `blocks`.
template <class BlockOf>
std::vector<Span> spans_by_block(const Deck& deck, std::span<const BulkBlock> blocks,
                                 std::span<const std::uint32_t> items, const BlockOf& block_of) {
  std::vector<Span> out(items.size());
  std::vector<std::size_t> order(items.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair{block_of(items[a]), items[a]} < std::pair{block_of(items[b]), items[b]};
  });
  std::vector<std::uint32_t> inside;
  for (std::size_t at = 0; at < order.size();) {
    const std::size_t begin = at, block = block_of(items[order[at]]);
    inside.clear();
    for (; at < order.size() && block_of(items[order[at]]) == block; ++at)
      inside.push_back(items[order[at]]);
    if (block >= blocks.size()) continue;
    const std::vector<Span> spans = item_spans(deck, blocks[block], inside);
    for (std::size_t i = 0; i < spans.size(); ++i) out[order[begin + i]] = spans[i];
  }
  return out;
}

}  // namespace

std::uint64_t items_walked() { return walked; }

std::vector<Span> item_spans(const Deck& deck, const BulkBlock& range,
                             std::span<const std::uint32_t> indices) {
  std::vector<Span> out(indices.size(), range.block->header_span);
  std::size_t next = 0;
  if (!indices.empty())
    walk_items(deck, range, [&](std::uint32_t i, const Line& line) {
      for (; next < indices.size() && indices[next] <= i; ++next)
        if (indices[next] == i) out[next] = line.whole();
      return next < indices.size();
    });
  return out;
}

void each_item_span(const Deck& deck, const BulkBlock& range,
                    const std::function<void(std::uint32_t, const Span&)>& take) {
  std::uint32_t left = range.count;
  if (left > 0)
    walk_items(deck, range, [&](std::uint32_t i, const Line& line) {
      take(i, line.whole());
      return --left > 0;
    });
}

std::vector<Span> node_spans(const Model& model, std::span<const NodeIndex> nodes) {
  if (model.deck == nullptr) return std::vector<Span>(nodes.size());
  const std::vector<BulkBlock>& blocks = model.node_blocks;
  // Ranges ascend; empty blocks share their `first` with the next one.
  return spans_by_block(*model.deck, blocks, nodes, [&](NodeIndex n) {
    auto it = std::upper_bound(blocks.begin(), blocks.end(), n,
                               [](NodeIndex index, const BulkBlock& b) { return index < b.first; });
    while (it != blocks.begin())
      if (--it; n < it->first + it->count) return static_cast<std::size_t>(it - blocks.begin());
    return blocks.size();
  });
}

std::vector<Span> element_spans(const Model& model, ElementKind kind,
                                std::span<const std::uint32_t> elements) {
  const Elements& family = model.family(kind);
  if (model.deck == nullptr) return std::vector<Span>(elements.size());
  return spans_by_block(*model.deck, model.element_blocks, elements, [&](std::uint32_t e) {
    return e < family.size() ? std::size_t{family.block[e]} : model.element_blocks.size();
  });
}

}  // namespace deck::detail
