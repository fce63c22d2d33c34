// Asks the system for memory in large pieces.
#include "base/shared/pages.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>

#include "base/shared/parallel.hpp"

namespace deck {
namespace {

constexpr std::uintptr_t large_page = 2 << 20;

/// The multiples of `unit` between two addresses: first and last, or 0 and 0.
struct Inside {
  std::uintptr_t begin = 0, end = 0;
  Inside(const void* first, const void* last, std::uintptr_t unit) {
    const auto a = (reinterpret_cast<std::uintptr_t>(first) + unit - 1) / unit * unit;
    const auto b = reinterpret_cast<std::uintptr_t>(last) / unit * unit;
    if (a >= b) return;
    begin = a;
    end = b;
  }
};

}  // namespace

void prefer_large_pages(const void* begin, const void* end) {
  const Inside all(begin, end, large_page);
  if (all.begin < all.end)
    ::madvise(reinterpret_cast<void*>(all.begin), all.end - all.begin, MADV_HUGEPAGE);
}

void populate_pages(void* begin, void* end, int threads) {
#ifdef MADV_POPULATE_WRITE
  constexpr std::uintptr_t page = 4096, at_once = 4 * large_page;
  const Inside all(begin, end, page);
  if (all.end - all.begin < large_page) return;
  const std::uintptr_t base = all.begin / at_once * at_once;
  parallel_items(threads, (all.end - base + at_once - 1) / at_once, [&](std::size_t i) {
    const std::uintptr_t first = std::max(all.begin, base + i * at_once);
    const std::uintptr_t last = std::min(all.end, base + (i + 1) * at_once);
    ::madvise(reinterpret_cast<void*>(first), last - first, MADV_POPULATE_WRITE);
  });
#else
  static_cast<void>(threads);
#endif
}

}  // namespace deck
