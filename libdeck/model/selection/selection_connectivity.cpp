// Counting sort of elements by node and by part.
#include <algorithm>

#include "model/shared/connectivity.hpp"

namespace deck {
namespace {

/// Lists of the rows, row after row, and where each begins. Calls visit(f) twice, to count and to
/// fill; visit calls f(row, entry) for all entries in order.
template <class Entry, class Visit>
void fill_rows(std::size_t rows, std::vector<std::uint32_t>& first, std::vector<Entry>& entries,
               Visit visit) {
  first.assign(rows + 1, 0);
  visit([&](std::uint32_t row, const Entry&) { ++first[row + 1]; });
  for (std::size_t i = 0; i < rows; ++i) first[i + 1] += first[i];
  entries.resize(first[rows]);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  visit([&](std::uint32_t row, const Entry& entry) { entries[next[row]++] = entry; });
}

}  // namespace

int extra_node_count(SolidShape shape) {
  switch (shape) {
    case SolidShape::tetra10:
      return 6;
    case SolidShape::brick20:
      return 12;
    case SolidShape::thick16:
      return 8;
    default:
      return 0;
  }
}

NodeElements connect_nodes(const Elements& family, std::size_t node_count, int slots,
                           bool mid_nodes) {
  const int width = slots > 0 ? std::min(slots, family.width) : family.width;
  NodeElements out;
  fill_rows(node_count, out.first, out.entries, [&](auto&& emit) {
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const NodeIndex* n = family.of(e);
      for (int i = 0; i < width; ++i)
        if (n[i] != no_index && std::find(n, n + i, n[i]) == n + i) emit(n[i], e);
      if (!mid_nodes || family.extra.empty() || family.extra[e] == no_index) continue;
      const NodeIndex* mid = family.extra_nodes.data() + family.extra[e];
      const int count = extra_node_count(family.shape[e]);
      for (int i = 0; i < count; ++i)
        if (mid[i] != no_index && std::find(mid, mid + i, mid[i]) == mid + i &&
            std::find(n, n + width, mid[i]) == n + width)
          emit(mid[i], e);
    }
  });
  return out;
}

PartElements connect_parts(const Elements& family, std::size_t part_count) {
  PartElements out;
  fill_rows(part_count, out.first, out.runs, [&](auto&& emit) {
    const auto count = static_cast<std::uint32_t>(family.size());
    for (ElementRun run; run.first < count; run.first = run.end) {
      const std::uint32_t part = family.part[run.first];
      run.end = run.first + 1;
      while (run.end < count && family.part[run.end] == part) ++run.end;
      if (part != no_index) emit(part, run);
    }
  });
  return out;
}

}  // namespace deck
