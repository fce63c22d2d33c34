// What a MeshMemory holds: the arrays of chunks without findings, by the text of the chunks and
// their plans. Private to the bulk reader.
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "base/known_inputs.hpp"
#include "deck/model/mesh_memory.hpp"
#include "model/bulk/bulk_plan.hpp"

namespace deck {
namespace detail {

/// The nodes of a chunk. The arrays may be longer than `size`.
struct NodeRows {
  std::vector<std::int64_t> id;
  std::vector<double> x, y, z;
  std::size_t size = 0;
  std::vector<std::uint32_t> counts;  ///< per segment

  std::size_t bytes() const { return size * 32 + counts.size() * 4; }
  NodeRows trimmed() const;
};

/// The elements of a chunk; part and block are those of their segment. The arrays of ids and nodes
/// may be longer than `size` says.
struct ElementRows {
  std::vector<std::int64_t> id;
  std::vector<std::uint32_t> extra;
  std::vector<NodeIndex> nodes, extra_nodes;
  std::vector<double> thickness;  ///< up to the last element that has its own
  std::vector<SolidShape> shape;
  std::size_t size = 0, width = 0;
  std::vector<std::uint32_t> counts;  ///< per segment
  std::vector<bool> thick;            ///< per segment: an element has its own thickness

  std::size_t bytes() const {
    return size * (8 + 4 * width) + (extra.size() + extra_nodes.size()) * 4 + thickness.size() * 8 +
           shape.size() + counts.size() * 5;
  }
  ElementRows trimmed() const;
};

/// What decides about the arrays of a chunk. Valid as long as the deck.
class ChunkBytes {
 public:
  /// `nodes` is the number of the model's list of nodes; of nodes it is 0. `first_block` is the
  /// place of the first plan's block among the element blocks of the model.
  ChunkBytes(const Deck& deck, const std::vector<BlockPlan>& plans, const Chunk& chunk,
             std::uint64_t nodes, std::uint64_t first_block);
  ChunkBytes(const ChunkBytes&) = delete;
  ChunkBytes& operator=(const ChunkBytes&) = delete;
  operator std::span<const InputBytes>() const { return pieces_; }

 private:
  std::vector<std::uint64_t> head_;
  std::vector<InputBytes> pieces_;
};

/// Arrays of one kind, for several threads.
template <class Rows>
class KnownRows {
 public:
  explicit KnownRows(std::size_t bytes) : known_(bytes) {}

  /// nullptr: not known.
  std::shared_ptr<const Rows> find(const ChunkBytes& chunk) {
    const std::lock_guard lock(mutex_);
    const auto* const found = known_.find(chunk);
    ++(found != nullptr ? hits : misses);
    return found != nullptr ? *found : nullptr;
  }
  void keep(const ChunkBytes& chunk, const Rows& rows) {
    auto kept = std::make_shared<const Rows>(rows.trimmed());
    const std::size_t bytes = kept->bytes();
    const std::lock_guard lock(mutex_);
    known_.keep(chunk, std::move(kept), bytes);
  }

  std::size_t hits = 0, misses = 0;

 private:
  std::mutex mutex_;
  KnownInputs<std::shared_ptr<const Rows>> known_;
};

}  // namespace detail

struct MeshMemory::Store {
  explicit Store(std::size_t bytes) : nodes(bytes / 2), elements(bytes / 4), room(bytes / 4) {}

  /// The number of a list of ids, from 1 on: the same for the same ids. 0: there is no room for it.
  std::uint64_t number_of(const std::vector<std::int64_t>& ids);

  detail::KnownRows<detail::NodeRows> nodes;
  detail::KnownRows<detail::ElementRows> elements;
  std::vector<std::vector<std::int64_t>> lists;
  std::size_t room;
};

}  // namespace deck
