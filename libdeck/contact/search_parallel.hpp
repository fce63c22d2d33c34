// Splits a range over threads. Each part is contiguous and its bounds depend only on the number of
// threads, so that callers can make results independent of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace deck {

// Number of threads to use: `requested`, or one per core for 0 and below.
inline int effective_threads(int requested) {
  if (requested > 0) return requested;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

// Calls body(part, begin, end) for `threads` contiguous parts of [0, count), concurrently.
template <class Body>
void parallel_parts(int threads, std::size_t count, const Body& body) {
  constexpr std::size_t kWorthAThread = 4096;
  const auto parts = static_cast<std::size_t>(threads);
  const auto bound = [count, parts](std::size_t part) {
    return count / parts * part + std::min(part, count % parts);
  };
  if (threads <= 1 || count < kWorthAThread) {
    for (std::size_t part = 0; part < parts; ++part) body(part, bound(part), bound(part + 1));
    return;
  }
  std::vector<std::jthread> workers;
  for (std::size_t part = 1; part < parts; ++part) {
    workers.emplace_back([&body, &bound, part] { body(part, bound(part), bound(part + 1)); });
  }
  body(std::size_t{0}, bound(0), bound(1));
}

}  // namespace deck
