// Counting sort of elements by node and by part.
#include <algorithm>

#include "deck/model/connectivity.hpp"

namespace deck {
namespace {

/// Calls f(row, element) for all elements in order; twice, to count and to fill.
template <class Visit>
IndexRows fill_rows(std::size_t rows, Visit visit) {
  IndexRows out;
  out.first.assign(rows + 1, 0);
  visit([&](std::uint32_t row, std::uint32_t) { ++out.first[row + 1]; });
  for (std::size_t i = 0; i < rows; ++i) out.first[i + 1] += out.first[i];
  out.entries.resize(out.first[rows]);
  std::vector<std::uint32_t> next(out.first.begin(), out.first.end() - (rows > 0 ? 1 : 0));
  visit([&](std::uint32_t row, std::uint32_t element) { out.entries[next[row]++] = element; });
  return out;
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
  return fill_rows(node_count, [&](auto&& emit) {
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
}

PartElements connect_parts(const Elements& family, std::size_t part_count) {
  return fill_rows(part_count, [&](auto&& emit) {
    for (std::uint32_t e = 0; e < family.size(); ++e)
      if (family.part[e] != no_index) emit(family.part[e], e);
  });
}

}  // namespace deck
