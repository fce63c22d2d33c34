// Sorting by a small integer key, such as a node: a counting sort, then short runs by insertion.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace deck::detail {

/// All x that each(take) passes to take(x), sorted by bucket(x) ascending, then by `before`;
/// stable.
template <class T, class Each, class Bucket, class Before>
std::vector<T> in_buckets(const Each& each, Bucket bucket, Before before) {
  std::size_t count = 0;
  std::uint32_t low = 0xffffffffu, high = 0;
  each([&](const T& x) {
    const std::uint32_t b = bucket(x);
    low = std::min(low, b);
    high = std::max(high, b);
    ++count;
  });
  std::vector<T> sorted;
  if (count == 0) return sorted;
  const std::size_t range = std::size_t{high} - low + 1;
  if (range > count * 16) {
    sorted.reserve(count);
    each([&](const T& x) { sorted.push_back(x); });
    std::stable_sort(sorted.begin(), sorted.end(), [&](const T& a, const T& b) {
      return bucket(a) != bucket(b) ? bucket(a) < bucket(b) : before(a, b);
    });
    return sorted;
  }
  sorted.resize(count);
  std::vector<std::uint32_t> start(range + 1, 0);
  each([&](const T& x) { ++start[bucket(x) - low + 1]; });
  for (std::size_t i = 0; i < range; ++i) start[i + 1] += start[i];
  each([&](const T& x) { sorted[start[bucket(x) - low]++] = x; });  // afterwards the ends
  auto last = sorted.begin();
  for (std::size_t i = 0; i < range; ++i) {
    const auto first = std::exchange(last, sorted.begin() + start[i]);
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
  return sorted;
}
/// Likewise for the items of a list.
template <class T, class Bucket, class Before>
void sort_by_bucket(std::vector<T>& v, Bucket bucket, Before before) {
  v = in_buckets<T>([&](const auto& take) { std::for_each(v.begin(), v.end(), take); }, bucket,
                    before);
}

}  // namespace deck::detail
