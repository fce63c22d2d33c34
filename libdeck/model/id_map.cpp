// Finds the index of an id: in a table where ids lie close, else in a sorted list.
#include <algorithm>

#include "deck/model/model.hpp"

namespace deck {
namespace {

// A table entry costs 4 bytes, a sorted entry 16: up to this many table entries per id the table is
// the smaller of the two as well as the faster.
constexpr std::uint64_t entries_per_id = 4;

}  // namespace

void IdMap::build(const std::vector<std::int64_t>& ids) {
  base_ = 0;
  dense_.clear();
  sorted_.clear();
  duplicates_.clear();
  if (ids.empty()) return;
  const auto [low, high] = std::minmax_element(ids.begin(), ids.end());
  const std::uint64_t range =
      static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(*low);  // exact modulo 2^64
  const auto count = static_cast<std::uint32_t>(ids.size());
  if (range < entries_per_id * std::uint64_t{count} + 64) {
    base_ = *low;
    dense_.assign(static_cast<std::size_t>(range) + 1, no_index);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::uint32_t& slot = dense_[static_cast<std::size_t>(ids[i] - base_)];
      if (slot == no_index)
        slot = i;
      else
        duplicates_.push_back(i);
    }
    return;
  }
  sorted_.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) sorted_.emplace_back(ids[i], i);
  // Pairs order by id, then by index: the first definition of an id comes first.
  if (!std::is_sorted(sorted_.begin(), sorted_.end())) std::sort(sorted_.begin(), sorted_.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    if (kept > 0 && sorted_[kept - 1].first == sorted_[i].first)
      duplicates_.push_back(sorted_[i].second);
    else
      sorted_[kept++] = sorted_[i];
  }
  sorted_.resize(kept);
  std::sort(duplicates_.begin(), duplicates_.end());
}

std::uint32_t IdMap::find(std::int64_t id) const {
  if (!dense_.empty()) {
    const std::uint64_t at = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(base_);
    return at < dense_.size() ? dense_[static_cast<std::size_t>(at)] : no_index;
  }
  const auto it = std::lower_bound(sorted_.begin(), sorted_.end(), id,
                                   [](const std::pair<std::int64_t, std::uint32_t>& entry,
                                      std::int64_t value) { return entry.first < value; });
  return it != sorted_.end() && it->first == id ? it->second : no_index;
}

}  // namespace deck
