// Lines of nodes and elements, found by walking their block again: no item is stored. Private.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "deck/model.hpp"

namespace deck::detail {

/// The runs of the block that begins at `first`, in Model::node_blocks or element_blocks: one run,
/// or several if its ids do not ascend.
std::span<const BulkBlock> runs_of_block(std::span<const BulkBlock> blocks, std::size_t first);

/// Calls visit(item, line) for the items of a block in file order.
void for_each_item_span(const Deck& deck, std::span<const BulkBlock> runs,
                        const std::function<void(std::uint32_t, const Span&)>& visit);

/// Finds the blocks of nodes.
class NodeBlocks {
 public:
  explicit NodeBlocks(const Model& model);
  /// Position in Model::node_blocks; its size: none.
  std::size_t run_of(NodeIndex n) const;
  const Block* operator[](NodeIndex n) const {
    const std::size_t run = run_of(n);
    return run < runs_.size() ? runs_[run].block : nullptr;
  }

 private:
  std::span<const BulkBlock> runs_;
  std::vector<std::uint32_t> order_;  ///< non-empty runs by first item
};

/// Model::node_span for many nodes in any order, with one walk per block.
std::vector<Span> node_spans(const Model& model, std::span<const NodeIndex> nodes);

/// Model::element_span for many elements, with one walk per block.
std::vector<Span> element_spans(const Model& model, ElementKind kind,
                                std::span<const std::uint32_t> elements);

/// Number of items visited by this thread, for tests of the cost.
std::uint64_t items_walked();

}  // namespace deck::detail
