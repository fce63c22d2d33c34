// Pair searches that were done before, found again by comparing their inputs byte by byte.
#include "deck/contact/search_memory.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/bits.hpp"

namespace deck {
namespace {

using Bytes = std::span<const std::byte>;

/// What decides about a result beside the arrays: the lengths of the arrays, and the options.
/// One word each, so that no padding is compared.
template <std::size_t N>
std::array<std::uint64_t, N + 6> head_of(const std::array<Bytes, N>& arrays, std::uint64_t kind,
                                         const SearchOptions& o) {
  std::array<std::uint64_t, N + 6> head{};
  std::size_t at = 0;
  head[at++] = kind << 32 | static_cast<std::uint64_t>(o.form);
  head[at++] = static_cast<std::uint64_t>(o.gap.rule);
  for (const double v : {o.gap.gapmin, o.gap.gapmax, o.drad, o.margin})
    head[at++] = bit_cast<std::uint64_t>(v);
  for (const Bytes& a : arrays) head[at++] = a.size();
  return head;
}

template <std::size_t N>
std::array<Bytes, N + 1> with_head(const std::array<std::uint64_t, N + 6>& head,
                                   const std::array<Bytes, N>& arrays) {
  std::array<Bytes, N + 1> out;
  out[0] = std::as_bytes(std::span(head));
  std::copy(arrays.begin(), arrays.end(), out.begin() + 1);
  return out;
}

std::size_t size_of(std::span<const Bytes> pieces) {
  std::size_t sum = 0;
  for (const Bytes& p : pieces) sum += p.size();
  return sum;
}

/// A number made of the head and of some words of every array: inputs that differ mostly differ in
/// it. Saves comparing; decides nothing.
std::uint64_t mark_of(std::span<const Bytes> pieces) {
  constexpr std::size_t samples = 16, word = sizeof(std::uint64_t);
  std::uint64_t mark = 0;
  for (const Bytes& p : pieces) {
    const std::size_t words = p.size() / word, step = std::max<std::size_t>(1, words / samples);
    for (std::size_t i = 0; i < words; i += step) {
      std::uint64_t value = 0;
      std::memcpy(&value, p.data() + i * word, word);
      mark = (mark ^ value) * 0x9E3779B97F4A7C15U;
      mark ^= mark >> 29;
    }
  }
  return mark;
}

bool is_same(const std::vector<std::byte>& known, std::span<const Bytes> pieces) {
  if (known.size() != size_of(pieces)) return false;
  const std::byte* at = known.data();
  for (const Bytes& p : pieces) {
    if (!p.empty() && std::memcmp(at, p.data(), p.size()) != 0) return false;
    at += p.size();
  }
  return true;
}

}  // namespace

template <class Search>
SearchResult SearchMemory::answer(Pieces input, const SearchOptions& options,
                                  const Search& search) {
  const std::uint64_t mark = mark_of(input);
  const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.mark == mark && is_same(e.input, input);
  });
  if (known == entries_.end()) {
    ++misses_;
    SearchResult found = search();
    if (found.complete) keep(mark, input, found);
    return found;
  }
  known->used = ++hits_ + misses_;
  SearchResult found;
  found.complete = known->pairs.size() <= options.max_pairs;
  if (found.complete) found.pairs = known->pairs;
  return found;
}

void SearchMemory::keep(std::uint64_t mark, Pieces input, const SearchResult& result) {
  Entry entry;
  entry.mark = mark;
  entry.used = hits_ + misses_;
  const std::size_t bytes =
      sizeof(Entry) + size_of(input) + result.pairs.size() * sizeof(CandidatePair);
  if (bytes > room_) return;
  while (bytes_ + bytes > room_) {
    const auto oldest =
        std::min_element(entries_.begin(), entries_.end(),
                         [](const Entry& a, const Entry& b) { return a.used < b.used; });
    bytes_ -= oldest->bytes();
    *oldest = std::move(entries_.back());
    entries_.pop_back();
  }
  entry.input.reserve(size_of(input));
  for (const Bytes& p : input) entry.input.insert(entry.input.end(), p.begin(), p.end());
  entry.pairs = result.pairs;
  bytes_ += bytes;
  entries_.push_back(std::move(entry));
}

SearchResult SearchMemory::find(const NodeSegmentInput& in, const SearchOptions& options) {
  const auto arrays = std::to_array<Bytes>(
      {std::as_bytes(in.nodes.x), std::as_bytes(in.nodes.y), std::as_bytes(in.nodes.z),
       std::as_bytes(in.secondary), std::as_bytes(in.secondary_gap),
       std::as_bytes(in.secondary_length), std::as_bytes(in.secondary_stiffness),
       std::as_bytes(in.segments), std::as_bytes(in.segment_gap), std::as_bytes(in.segment_length),
       std::as_bytes(in.segment_stiffness)});
  const auto head = head_of(arrays, 0, options);
  return answer(with_head(head, arrays), options,
                [&] { return find_node_segment_pairs(in, options); });
}

SearchResult SearchMemory::find(const EdgeEdgeInput& in, const SearchOptions& options) {
  const auto arrays = std::to_array<Bytes>(
      {std::as_bytes(in.nodes.x), std::as_bytes(in.nodes.y), std::as_bytes(in.nodes.z),
       std::as_bytes(in.secondary), std::as_bytes(in.secondary_gap),
       std::as_bytes(in.secondary_length), std::as_bytes(in.secondary_stiffness),
       std::as_bytes(in.main), std::as_bytes(in.main_gap), std::as_bytes(in.main_length),
       std::as_bytes(in.main_stiffness)});
  const auto head = head_of(arrays, 1, options);
  return answer(with_head(head, arrays), options,
                [&] { return find_edge_edge_pairs(in, options); });
}

}  // namespace deck
