// Finds the lines of nodes or elements by walking their block again.
#include "model/shared/item_spans.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

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

std::size_t first_run(std::span<const BulkBlock> blocks, std::size_t run) {
  while (run > 0 && blocks[run - 1].block == blocks[run].block) --run;
  return run;
}

/// Calls `visit(item, line)` for the items of a block in file order, until it returns false.
template <class Visit>
void walk_items(const Deck& deck, std::span<const BulkBlock> runs, const Visit& visit) {
  if (runs.empty()) return;
  LineCursor cursor(deck.sources, *runs.front().block);
  const std::size_t lines = lines_per_item(*runs.front().block);
  for (const BulkBlock& run : runs)
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const Line line = cursor.next();
      if (!line.valid()) return;
      ++walked;
      if (!visit(run.first + i, line)) return;
      for (std::size_t k = 1; k < lines; ++k) cursor.next();
    }
}

/// Lines of items in any order, with repetitions, by one walk per block. `run_of`: index of an
/// item's run in `blocks`. Missing items get the header.
template <class RunOf>
std::vector<Span> spans_by_block(const Deck& deck, std::span<const BulkBlock> blocks,
                                 std::span<const std::uint32_t> items, const RunOf& run_of) {
  struct Wanted {
    std::size_t block;  ///< its first run
    std::uint32_t item;
    std::size_t at;
  };
  std::vector<Span> out(items.size());
  std::vector<Wanted> wanted;
  for (std::size_t at = 0; at < items.size(); ++at)
    if (const std::size_t run = run_of(items[at]); run < blocks.size())
      wanted.push_back({first_run(blocks, run), items[at], at});
  std::sort(wanted.begin(), wanted.end(), [](const Wanted& a, const Wanted& b) {
    return std::tie(a.block, a.item) < std::tie(b.block, b.item);
  });
  for (auto begin = wanted.begin(), end = begin; begin != wanted.end(); begin = end) {
    const auto runs = runs_of_block(blocks, begin->block);
    for (end = begin; end != wanted.end() && end->block == begin->block; ++end)
      out[end->at] = runs.front().block->header_span;
    auto next = begin;
    std::size_t left = static_cast<std::size_t>(end - begin);
    walk_items(deck, runs, [&](std::uint32_t item, const Line& line) {
      if (next == end || next->item != item)
        next = std::lower_bound(begin, end, item,
                                [](const Wanted& w, std::uint32_t i) { return w.item < i; });
      for (; next != end && next->item == item; ++next, --left) out[next->at] = line.whole();
      return left > 0;
    });
  }
  return out;
}

}  // namespace

std::uint64_t items_walked() { return walked; }

std::span<const BulkBlock> runs_of_block(std::span<const BulkBlock> blocks, std::size_t first) {
  std::size_t end = first;
  while (end < blocks.size() && blocks[end].block == blocks[first].block) ++end;
  return blocks.subspan(first, end - first);
}

void for_each_item_span(const Deck& deck, std::span<const BulkBlock> runs,
                        const std::function<void(std::uint32_t, const Span&)>& visit) {
  walk_items(deck, runs, [&](std::uint32_t item, const Line& line) {
    visit(item, line.whole());
    return true;
  });
}

NodeBlocks::NodeBlocks(const Model& model) : runs_(model.node_blocks), order_(runs_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::erase_if(order_, [&](std::uint32_t r) { return runs_[r].count == 0; });
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    return runs_[a].first < runs_[b].first;
  };
  if (!std::is_sorted(order_.begin(), order_.end(), before))
    std::sort(order_.begin(), order_.end(), before);
}

std::size_t NodeBlocks::run_of(NodeIndex n) const {
  const auto it =
      std::upper_bound(order_.begin(), order_.end(), n,
                       [&](NodeIndex node, std::uint32_t r) { return node < runs_[r].first; });
  if (it == order_.begin()) return runs_.size();
  const BulkBlock& run = runs_[*std::prev(it)];
  return n - run.first < run.count ? *std::prev(it) : runs_.size();
}

std::vector<Span> node_spans(const Model& model, std::span<const NodeIndex> nodes) {
  if (model.deck == nullptr) return std::vector<Span>(nodes.size());
  const NodeBlocks blocks(model);
  return spans_by_block(*model.deck, model.node_blocks, nodes,
                        [&](NodeIndex n) { return blocks.run_of(n); });
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
