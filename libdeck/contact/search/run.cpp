// Runs a sweep on several threads and merges the sorted pairs; search margins of the solver.
#include <algorithm>
#include <atomic>
#include <limits>

#include "base/shared/parallel.hpp"
#include "contact/search/sweep.hpp"

namespace deck::sweep {
namespace {

// Counting sort by secondary, then sort of each secondary's few mains. Every thread owns a range
// of secondaries and reads all pairs.
void merge(const std::vector<Found>& found, std::size_t secondaries, int threads,
           SearchResult& result) {
  std::vector<std::size_t> next(secondaries + 1, 0);
  parallel_parts(threads, secondaries, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (const Found& by_thread : found) {
      by_thread.pairs.for_each([&](const CandidatePair& pair) {
        if (pair.secondary >= begin && pair.secondary < end) ++next[pair.secondary + 1];
      });
    }
  });
  for (std::size_t i = 0; i < secondaries; ++i) next[i + 1] += next[i];
  result.pairs.resize(next[secondaries]);
  CandidatePair* const out = result.pairs.data();
  parallel_parts(threads, secondaries, [&](std::size_t, std::size_t begin, std::size_t end) {
    // next[i]: first pair of i, at the end one past its last.
    for (const Found& by_thread : found) {
      by_thread.pairs.for_each([&](const CandidatePair& pair) {
        if (pair.secondary >= begin && pair.secondary < end) out[next[pair.secondary]++] = pair;
      });
    }
  });
  parallel_pieces(threads, secondaries, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      std::sort(out + (i == 0 ? 0 : next[i - 1]), out + next[i]);
  });
}

}  // namespace

void run(const std::function<void(std::size_t, std::size_t, Found&)>& body, std::size_t count,
         std::size_t secondaries, const SearchOptions& options, BothForms& both) {
  constexpr std::size_t chunk_items = 64 * items_at_once;
  const std::size_t chunks = (count + chunk_items - 1) / chunk_items;
  const int threads = effective_threads(options.threads);
  // Every sink may leave its last chunk nearly empty: a full one proves that there are too many.
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<std::int64_t>::max() / 2);
  const std::size_t slack = 2 * static_cast<std::size_t>(threads) * Sink::chunk_items;
  std::atomic<std::int64_t> allowance{
      static_cast<std::int64_t>(std::min(options.max_pairs, most) + slack)};
  std::vector<Found> found;
  for (int t = 0; t < threads; ++t) found.emplace_back(&allowance);
  std::atomic<std::size_t> next_chunk{0}, pairs{0};
  CancelFlag cancel;
  const auto work = [&](std::size_t worker) {
    Found& mine = found[worker];
    for (;;) {
      const std::size_t chunk = next_chunk.fetch_add(1);
      if (chunk >= chunks || pairs.load() > options.max_pairs || cancel.is_set()) return;
      const std::size_t before = mine.size();
      body(chunk * chunk_items, std::min(count, (chunk + 1) * chunk_items), mine);
      if (mine.full()) cancel.set();
      pairs += mine.size() - before;
    }
  };
  run_workers(static_cast<int>(std::min(found.size(), chunks)), cancel, work);
  SearchResult& result = both.result;
  for (const Found& by_thread : found) result.tested += by_thread.tested;
  if (pairs.load() > options.max_pairs || cancel.is_set()) {
    result.complete = false;
    return;
  }
  for (const Found& by_thread : found)
    by_thread.robust_only.for_each(
        [&](const CandidatePair& pair) { both.robust_only.push_back(pair); });
  std::sort(both.robust_only.begin(), both.robust_only.end());
  if (pairs.load() == both.robust_only.size()) return;
  merge(found, secondaries, threads, result);
}

}  // namespace deck::sweep

namespace deck {

double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments) {
  if (segments.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& s : segments)
    for (std::size_t k = 0; k < 4; ++k) sum += detail::edge_length(nodes, s[k], s[(k + 1) % 4]);
  return detail::margin_of(sum, 4 * segments.size());
}

}  // namespace deck
