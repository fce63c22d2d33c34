// Items of very different size on several threads: large items one after another with all threads,
// small items in parallel with one thread each.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "base/shared/parallel.hpp"

namespace deck {

/// The worker that runs an item, and the threads that it may use.
struct Share {
  std::size_t worker = 0;
  int threads = 1;
};

/// Calls body(item, share) once per item, the largest first. `sizes`: work per item in any unit. An
/// item larger than its fair share of the rest, and a large item near the end, get all threads. The
/// results of body must not depend on the share.
template <class Body>
void side_by_side(int threads, std::span<const std::size_t> sizes, const Body& body) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (threads <= 1) {
    for (const std::size_t item : order) body(item, Share{});
    return;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  std::size_t left = 0;
  for (const std::size_t size : sizes) left += size;
  constexpr std::size_t serves_all = 65536;  // loop length that justifies threads
  const auto cores = static_cast<std::size_t>(threads);
  std::size_t first = 0;
  for (; first < order.size(); ++first) {
    const std::size_t size = sizes[order[first]];
    const std::size_t share = left / cores;
    if (size <= share && (size < serves_all || size <= share / 4)) break;
    body(order[first], Share{0, threads});
    left -= size;
  }
  std::atomic<std::size_t> next{first};
  CancelFlag cancel;
  const std::size_t count = order.size() - first;
  if (count == 0) return;
  run_workers(static_cast<int>(std::min(count, cores)), cancel, [&](std::size_t worker) {
    for (;;) {
      const std::size_t i = next.fetch_add(1);
      if (i >= order.size() || cancel.is_set()) return;
      body(order[i], Share{worker, 1});
    }
  });
}

}  // namespace deck
