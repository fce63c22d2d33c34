// Stable sort of records by a node number first: a counting sort, because node numbers of one
// selection lie close together, then small sorts inside every bucket.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace deck::detail {

/// Sorts `v` by bucket(x) ascending, equal ones by `before`; stable.
template <class T, class Bucket, class Before>
void sort_by_bucket(std::vector<T>& v, Bucket bucket, Before before) {
  if (v.size() < 2) return;
  std::uint32_t low = 0xffffffffu, high = 0;
  for (const T& x : v) {
    const std::uint32_t b = bucket(x);
    low = std::min(low, b);
    high = std::max(high, b);
  }
  const std::size_t range = std::size_t{high} - low + 1;
  if (range > v.size() * 16) {
    std::stable_sort(v.begin(), v.end(), [&](const T& a, const T& b) {
      return bucket(a) != bucket(b) ? bucket(a) < bucket(b) : before(a, b);
    });
    return;
  }
  std::vector<std::uint32_t> start(range + 1, 0);
  for (const T& x : v) ++start[bucket(x) - low + 1];
  for (std::size_t i = 0; i < range; ++i) start[i + 1] += start[i];
  std::vector<T> sorted(v.size());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (const T& x : v) sorted[next[bucket(x) - low]++] = x;
  for (std::size_t i = 0; i < range; ++i) {
    const auto first = sorted.begin() + start[i], last = sorted.begin() + start[i + 1];
    if (last - first < 2) continue;
    if (last - first > 24) {
      std::stable_sort(first, last, before);
      continue;
    }
    for (auto it = first + 1; it != last; ++it) {
      T x = *it;
      auto at = it;
      while (at != first && before(x, *(at - 1))) {
        *at = *(at - 1);
        --at;
      }
      *at = x;
    }
  }
  v = std::move(sorted);
}

}  // namespace deck::detail
