// Remembers what pair searches found: decks of a library share their meshes, and a search over the
// same arrays need not be done twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "deck/contact/search.hpp"

namespace deck {

/// Searches by their whole input: coordinates, sides, gaps, lengths, stiffness and options, bit for
/// bit. A hit is therefore what the search would find, and one changed coordinate is another
/// search. Threads do not count (they change no result), and of max_pairs only whether the result
/// fits. For one thread at a time.
class SearchMemory {
 public:
  /// Keeps the searches used last, up to `bytes` with their inputs.
  explicit SearchMemory(std::size_t bytes = std::size_t{64} << 20) : room_(bytes) {}

  /// As find_node_segment_pairs and find_edge_edge_pairs; of a hit only `pairs` is filled.
  SearchResult find(const NodeSegmentInput& input, const SearchOptions& options);
  SearchResult find(const EdgeEdgeInput& input, const SearchOptions& options);

  std::size_t hits() const { return hits_; }      ///< searches answered from memory
  std::size_t misses() const { return misses_; }  ///< searches done

 private:
  struct Entry {
    std::uint64_t mark = 0, used = 0;  ///< of its input, and when
    std::vector<std::byte> input;
    std::vector<CandidatePair> pairs;
    std::size_t bytes() const {
      return sizeof(Entry) + input.size() + pairs.size() * sizeof(CandidatePair);
    }
  };
  using Pieces = std::span<const std::span<const std::byte>>;
  template <class Search>
  SearchResult answer(Pieces input, const SearchOptions& options, const Search& search);
  void keep(std::uint64_t mark, Pieces input, const SearchResult& result);

  std::size_t room_, bytes_ = 0, hits_ = 0, misses_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace deck
