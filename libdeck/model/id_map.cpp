// Index of an id, by the cheapest of four forms that fits the ids:
//   consecutive ids: subtraction, no table
//   dense ids (at most 4 table entries per id): one table
//   ids dense in several ranges, as in decks of several files: several tables, found by bisection
//   other ids: sorted pairs, found by bisection
// Cost: O(n) to build (last form: O(n log n)), O(1) or O(log n) to find.
#include <algorithm>
#include <limits>

#include "deck/model.hpp"

namespace deck {
namespace {

// A table entry has 4 bytes, a sorted entry 16: up to this many per id a table is better.
constexpr std::uint64_t entries_per_id = 4;

/// Ids are often dense within each file. A table has whole pages.
constexpr std::int64_t ids_of_a_page = 256;

std::int64_t page_of(std::int64_t id) {
  return id / ids_of_a_page - static_cast<std::int64_t>(id % ids_of_a_page < 0);
}

/// First ids of consecutive tables with their start, and the end of the last; empty: larger than a
/// sorted list.
std::vector<std::pair<std::int64_t, std::uint32_t>> tables_for(
    const std::vector<std::int64_t>& ids) {
  const std::uint64_t most = entries_per_id * ids.size() / ids_of_a_page;
  std::vector<std::int64_t> pages;
  for (const std::int64_t id : ids)
    if (const std::int64_t page = page_of(id); pages.empty() || pages.back() != page)
      pages.push_back(page);
  std::sort(pages.begin(), pages.end());
  pages.erase(std::unique(pages.begin(), pages.end()), pages.end());
  std::vector<std::pair<std::int64_t, std::uint32_t>> tables;
  if (pages.size() > most) return tables;
  for (std::size_t i = 0; i < pages.size(); ++i)
    if (i == 0 || pages[i] != pages[i - 1] + 1)
      tables.emplace_back(pages[i] * ids_of_a_page, static_cast<std::uint32_t>(i * ids_of_a_page));
  tables.emplace_back(std::numeric_limits<std::int64_t>::max(),
                      static_cast<std::uint32_t>(pages.size() * ids_of_a_page));
  return tables;
}

/// Position of an id in these tables; any position after the end if it is in none.
std::size_t place_in(const std::vector<std::pair<std::int64_t, std::uint32_t>>& tables,
                     std::int64_t id) {
  const auto after = std::partition_point(tables.begin(), tables.end() - 1,
                                          [&](const auto& table) { return table.first <= id; });
  const std::size_t none = tables.back().second;
  if (after == tables.begin()) return none;
  const auto& table = *(after - 1);
  const std::uint64_t at = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(table.first);
  return at < after->second - table.second ? table.second + at : none;
}

/// True if the ids are consecutive.
bool count_up(const std::vector<std::int64_t>& ids) {
  if (ids.front() >
      std::numeric_limits<std::int64_t>::max() - static_cast<std::int64_t>(ids.size()))
    return false;
  const std::int64_t first = ids.front();
  std::uint64_t differences = 0;
  for (std::size_t i = 0; i < ids.size() && differences == 0;) {
    // In blocks without branches.
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
    // The list has the first id and, without index, the end.
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
  } else if (sorted_ = tables_for(ids); !sorted_.empty()) {
    dense_.assign(sorted_.back().second, no_index);
  }
  if (!dense_.empty()) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::size_t at =
          sorted_.empty() ? static_cast<std::size_t>(ids[i] - base_) : place_in(sorted_, ids[i]);
      if (dense_[at] == no_index)
        dense_[at] = i;
      else
        duplicates_.push_back(i);
    }
    return;
  }
  sorted_.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) sorted_.emplace_back(ids[i], i);
  // Sorted by id, then index: the first definition of an id comes first.
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
  if (!dense_.empty() && !sorted_.empty()) {
    const std::size_t at = place_in(sorted_, id);
    return at < dense_.size() ? dense_[at] : no_index;
  }
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
