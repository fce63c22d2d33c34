// Puts the items of bulk blocks into the solver's order: file by file, then by id.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "model/bulk/bulk.hpp"
#include "model/bulk/bulk_plan.hpp"

namespace deck::detail {

/// Ranges of blocks of one file as one.
inline std::vector<BulkBlock> ranges_of_files(std::span<const BulkBlock> blocks) {
  std::vector<BulkBlock> out;
  for (const BulkBlock& b : blocks)
    if (!out.empty() && out.back().block->header_span.file == b.block->header_span.file)
      out.back().count = b.first + b.count - out.back().first;
    else
      out.push_back(b);
  return out;
}

/// The solver's order of items that were read as `ids`: each of the ranges by id. Place in `ids` of
/// every item; empty: they are in order.
inline std::vector<std::uint32_t> order_by_id(const std::vector<std::int64_t>& ids,
                                              const std::vector<BulkBlock>& ranges) {
  std::vector<std::uint32_t> out;
  for (const BulkBlock& b : ranges) {
    const auto at = [&](auto& list) { return list.begin() + static_cast<std::ptrdiff_t>(b.first); };
    if (std::is_sorted(at(ids), at(ids) + b.count)) continue;
    if (out.empty()) {
      out.resize(ids.size());
      std::iota(out.begin(), out.end(), 0U);
    }
    std::stable_sort(at(out), at(out) + b.count,
                     [&](std::uint32_t i, std::uint32_t k) { return ids[i] < ids[k]; });
  }
  return out;
}

/// Arrays with `width` values per item; one without any stays empty.
template <class... T>
void put_in_order(const std::vector<std::uint32_t>& places, std::size_t width,
                  std::vector<T>&... arrays) {
  const auto put = [&](auto& array) {
    if (array.empty() || places.empty()) return;
    const auto read = array;
    auto to = array.begin();
    for (const std::uint32_t place : places)
      to = std::copy_n(read.begin() + static_cast<std::ptrdiff_t>(place * width), width, to);
  };
  (put(arrays), ...);
}

/// A block whose items were put in order, as runs of items that still follow one another.
inline void add_runs(const BulkBlock& block, const std::vector<std::uint32_t>& places,
                     std::vector<std::uint32_t>& items, std::vector<BulkBlock>& out) {
  if (items.empty()) {
    items.resize(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) items[places[i]] = i;
  }
  out.push_back({block.block, items.empty() ? block.first : items[block.first], 0});
  for (std::uint32_t i = block.first; i < block.first + block.count; ++i) {
    const std::uint32_t item = items.empty() ? i : items[i];
    if (item != out.back().first + out.back().count) out.push_back({block.block, item, 0});
    ++out.back().count;
  }
}

}  // namespace deck::detail
