// Pair searches that were done before.
#include "contact/search/memory_store.hpp"

namespace deck {
namespace {

template <class Input, class Search>
SearchResult answer(SearchMemory::Store& store, const Input& input, const SearchOptions& options,
                    const Search& search) {
  const detail::SearchBytes<0> bytes(input, options, {});
  const auto* const known = store.searches.find(bytes);
  if (known == nullptr) {
    ++store.misses;
    SearchResult found = search(input, options);
    if (found.complete)
      store.searches.keep(bytes, found.pairs, found.pairs.size() * sizeof(CandidatePair));
    return found;
  }
  ++store.hits;
  SearchResult found;
  found.complete = known->size() <= options.max_pairs;
  if (found.complete) found.pairs = *known;
  return found;
}

}  // namespace

SearchMemory::SearchMemory(std::size_t bytes) : store_(std::make_unique<Store>(bytes)) {}
SearchMemory::~SearchMemory() = default;

std::size_t SearchMemory::hits() const { return store_->hits; }
std::size_t SearchMemory::misses() const { return store_->misses; }

SearchResult SearchMemory::find(const NodeSegmentInput& input, const SearchOptions& options) {
  return answer(*store_, input, options, find_node_segment_pairs);
}

SearchResult SearchMemory::find(const EdgeEdgeInput& input, const SearchOptions& options) {
  return answer(*store_, input, options, find_edge_edge_pairs);
}

}  // namespace deck
