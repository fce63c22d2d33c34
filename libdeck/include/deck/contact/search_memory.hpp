// Remembers what pair searches found and how their pairs were judged: decks of a library share
// their meshes, and what follows from the same arrays need not be computed twice.
#pragma once

#include <cstddef>
#include <memory>

#include "deck/contact/search.hpp"

namespace deck {

/// Searches by their whole input: coordinates, sides, gaps, lengths, stiffness and options, bit for
/// bit. A hit is therefore what the search would find, and one changed coordinate is another
/// search. Threads do not count (they change no result), and of max_pairs only whether the result
/// fits. For one thread at a time.
class SearchMemory {
 public:
  /// Keeps what was used last, up to `bytes` of searches and of judged contacts with their inputs.
  explicit SearchMemory(std::size_t bytes = std::size_t{32} << 20);
  ~SearchMemory();
  SearchMemory(const SearchMemory&) = delete;
  SearchMemory& operator=(const SearchMemory&) = delete;

  /// As find_node_segment_pairs and find_edge_edge_pairs; of a hit only `pairs` is filled.
  SearchResult find(const NodeSegmentInput& input, const SearchOptions& options);
  SearchResult find(const EdgeEdgeInput& input, const SearchOptions& options);

  std::size_t hits() const;    ///< searches, and lists of judged pairs, answered from memory
  std::size_t misses() const;  ///< those done

  struct Store;  ///< private to the library
  Store& store() { return *store_; }

 private:
  std::unique_ptr<Store> store_;
};

}  // namespace deck
