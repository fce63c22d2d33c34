// Lines of nodes and elements, found by walking their block again: no item is stored. Private.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "deck/model.hpp"

namespace deck::detail {

/// Model::node_blocks and element_blocks hold a block as one run of items or, where its rows do not
/// ascend by id, as several that follow each other. Those of the block that begins at `first`.
std::span<const BulkBlock> runs_of_block(std::span<const BulkBlock> blocks, std::size_t first);

/// Calls take(item, line) for the items of a block, as they stand in the deck.
void each_item_span(const Deck& deck, std::span<const BulkBlock> runs,
                    const std::function<void(std::uint32_t, const Span&)>& take);

/// Finds the blocks of nodes.
class NodeBlocks {
 public:
  explicit NodeBlocks(const Model& model);
  /// Position in Model::node_blocks; their number: none.
  std::size_t run_of(NodeIndex n) const;
  const Block* operator[](NodeIndex n) const {
    const std::size_t run = run_of(n);
    return run < runs_.size() ? runs_[run].block : nullptr;
  }

 private:
  std::span<const BulkBlock> runs_;
  std::vector<std::uint32_t> order_;  ///< runs that are not empty, by their first item
};

/// Model::node_span for many nodes, in any order and with repetitions: every block is walked once.
std::vector<Span> node_spans(const Model& model, std::span<const NodeIndex> nodes);

/// Model::element_span for many elements of one kind, the same way.
std::vector<Span> element_spans(const Model& model, ElementKind kind,
                                std::span<const std::uint32_t> elements);

/// Items that this thread's walks have passed so far: what they cost, for tests.
std::uint64_t items_walked();

}  // namespace deck::detail
