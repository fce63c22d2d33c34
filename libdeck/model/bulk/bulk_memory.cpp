// Chunks of nodes and elements that were read before.
#include "model/bulk/bulk_memory.hpp"

#include "base/bits.hpp"

namespace deck {

MeshMemory::MeshMemory(std::size_t bytes) : store_(std::make_unique<Store>(bytes)) {}
MeshMemory::~MeshMemory() = default;

std::size_t MeshMemory::hits() const { return store_->nodes.hits + store_->elements.hits; }
std::size_t MeshMemory::misses() const { return store_->nodes.misses + store_->elements.misses; }

std::uint64_t MeshMemory::Store::number_of(const std::vector<std::int64_t>& ids) {
  for (std::size_t i = 0; i < lists.size(); ++i)
    if (lists[i] == ids) return i + 1;
  const std::size_t bytes = ids.size() * sizeof(std::int64_t) + sizeof(ids);
  if (bytes > room) return 0;
  room -= bytes;
  lists.push_back(ids);
  return lists.size();
}

namespace detail {

namespace {

template <class T>
std::vector<T> head(const std::vector<T>& all, std::size_t size) {
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace

NodeRows NodeRows::trimmed() const {
  return {head(id, size), head(x, size), head(y, size), head(z, size), size, counts};
}

ElementRows ElementRows::trimmed() const {
  return {
      head(id, size), extra, head(nodes, size * width), extra_nodes, thickness, shape, size, width,
      counts,         thick};
}

ChunkBytes::ChunkBytes(const Deck& deck, const std::vector<BlockPlan>& plans, const Chunk& chunk,
                       std::uint64_t nodes, std::uint64_t first_block) {
  constexpr std::size_t words = 10;
  head_.reserve(2 + words * chunk.segments.size());
  head_.push_back(chunk.segments.size());
  head_.push_back(nodes);
  pieces_.resize(1);
  for (const TextSegment& s : chunk.segments) {
    const BlockPlan& plan = plans[s.plan];
    head_.insert(
        head_.end(),
        {s.end - s.begin, static_cast<std::uint64_t>(s.block_ends),
         static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(plan.block->schema)),
         static_cast<std::uint64_t>(plan.block->version), first_block + s.plan,
         static_cast<std::uint64_t>(plan.format.kind) << 16 |
             static_cast<std::uint64_t>(plan.format.shape) << 8 |
             static_cast<std::uint64_t>(plan.format.required),
         static_cast<std::uint64_t>(plan.id_offset), static_cast<std::uint64_t>(plan.node_offset),
         bit_cast<std::uint64_t>(plan.length), plan.part});
    const std::string_view text = deck.sources[s.file].bytes().substr(s.begin, s.end - s.begin);
    pieces_.push_back(std::as_bytes(std::span<const char>(text.data(), text.size())));
  }
  pieces_[0] = std::as_bytes(std::span<const std::uint64_t>(head_));
}

}  // namespace detail
}  // namespace deck
