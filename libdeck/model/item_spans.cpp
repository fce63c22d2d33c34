// Walks a bulk block once more for the lines of single nodes or elements.
#include "model/item_spans.hpp"

#include <algorithm>
#include <numeric>

namespace deck::detail {
namespace {

std::size_t lines_per_item(const Block& block) {
  if (block.schema == nullptr) return 1;
  std::size_t grouped = 0;
  for (const CardSchema& card : block.schema->cards)
    grouped += card.repeat == Repeat::group && card.in_version(block.version);
  return std::max<std::size_t>(grouped, 1);
}

}  // namespace

std::vector<Span> item_spans(const Deck& deck, const BulkBlock& range,
                             std::span<const std::uint32_t> indices) {
  std::vector<Span> out(indices.size(), range.block->header_span);
  LineCursor cursor(deck.sources, *range.block);
  const std::size_t lines = lines_per_item(*range.block);
  std::size_t next = 0;
  for (std::uint32_t i = range.first; next < indices.size(); ++i) {
    Line line = cursor.next();
    while (line.valid() && line.text.empty()) line = cursor.next();
    if (!line.valid()) break;
    for (; next < indices.size() && indices[next] <= i; ++next)
      if (indices[next] == i) out[next] = line.whole();
    for (std::size_t k = 1; k < lines; ++k) cursor.next();
  }
  return out;
}

std::vector<Span> node_spans(const Model& model, std::span<const NodeIndex> nodes) {
  std::vector<Span> out(nodes.size());
  if (model.deck == nullptr) return out;
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return nodes[a] < nodes[b]; });
  std::size_t at = 0;
  for (const BulkBlock& block : model.node_blocks) {
    while (at < order.size() && nodes[order[at]] < block.first) ++at;
    std::vector<std::uint32_t> inside;
    const std::size_t begin = at;
    for (; at < order.size() && nodes[order[at]] < block.first + block.count; ++at)
      inside.push_back(nodes[order[at]]);
    if (inside.empty()) continue;
    const std::vector<Span> spans = item_spans(*model.deck, block, inside);
    for (std::size_t i = 0; i < spans.size(); ++i) out[order[begin + i]] = spans[i];
  }
  return out;
}

}  // namespace deck::detail
