// Finds the index of an id: by counting where ids do nothing else, in a table where they lie close,
// else in a sorted list.
#include <algorithm>
#include <limits>

#include "deck/model/model.hpp"

namespace deck {
namespace {

// A table entry costs 4 bytes, a sorted entry 16: up to this many table entries per id the table is
// the smaller of the two as well as the faster.
constexpr std::uint64_t entries_per_id = 4;

/// Each id is one above the one before, and there is one more behind the last.
bool count_up(const std::vector<std::int64_t>& ids) {
  if (ids.front() >
      std::numeric_limits<std::int64_t>::max() - static_cast<std::int64_t>(ids.size()))
    return false;
  const std::int64_t first = ids.front();
  std::uint64_t differences = 0;
  for (std::size_t i = 0; i < ids.size() && differences == 0;) {
    // Many at once without a branch.
    for (const std::size_t end = std::min(ids.size(), i + 1024); i < end; ++i)
      differences |= static_cast<std::uint64_t>(ids[i]) - static_cast<std::uint64_t>(first) - i;
  }
  return differences == 0;
}

}  // namespace

void IdMap::build(const std::vector<std::int64_t>& ids) {
  base_ = 0;
  dense_.clear();
  sorted_.clear();
  duplicates_.clear();
  if (ids.empty()) return;
  if (count_up(ids)) {
    // The list says where the ids begin and, without an index, where they have ended.
    base_ = ids.front();
    sorted_ = {{base_, 0}, {base_ + static_cast<std::int64_t>(ids.size()), no_index}};
    return;
  }
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
  if (!sorted_.empty() && sorted_.back().second == no_index) {
    const std::uint64_t at = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(base_);
    const auto count = static_cast<std::uint64_t>(sorted_.back().first - base_);
    return at < count ? static_cast<std::uint32_t>(at) : no_index;
  }
  const auto it = std::lower_bound(sorted_.begin(), sorted_.end(), id,
                                   [](const std::pair<std::int64_t, std::uint32_t>& entry,
                                      std::int64_t value) { return entry.first < value; });
  return it != sorted_.end() && it->first == id ? it->second : no_index;
}

}  // namespace deck
