// Order of shells in the solver: by material and property; 4-node shells are renumbered per group
// for a small bandwidth. The order decides ties between otherwise equal shells. Input: the model;
// output: a rank per shell; cost: n log n.
#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>

#include "contact/shared/tie_steps.hpp"

namespace deck::detail {
namespace {

using Key = std::tuple<int, int, std::uint32_t, std::uint32_t>;

/// Sort key of shells in the solver: law, property type, positions of material and property.
Key sort_key(const Model& model, const Elements& family, std::uint32_t e) {
  const std::uint32_t p = family.part[e];
  if (p == no_index) return {};
  const Part& part = model.parts[p];
  return {part.mat == no_index ? 0 : model.materials[part.mat].law,
          part.prop == no_index ? 0 : model.properties[part.prop].number, part.mat, part.prop};
}

/// Elements sorted by key, in model order within a group.
std::vector<std::uint32_t> sorted_elements(const Model& model, const Elements& family) {
  std::vector<std::uint32_t> out(family.size());
  std::iota(out.begin(), out.end(), 0U);
  const auto key = [&](std::uint32_t e) { return sort_key(model, family, e); };
  std::stable_sort(out.begin(), out.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return out;
}

/// Renumbers the elements of one group: Cuthill-McKee from a far element of each connected part.
class ElementRenumbering {
 public:
  ElementRenumbering(const Elements& family, Connectivity& connectivity,
                     std::span<const std::uint32_t> group, std::vector<std::uint32_t>& place_of)
      : group_(group) {
    // Positions in this group; no_index for other elements.
    for (std::uint32_t i = 0; i < group.size(); ++i) place_of[group[i]] = i;
    rows_.first.push_back(0);
    std::vector<std::uint32_t> seen(group.size(), no_index), some;
    for (std::uint32_t i = 0; i < group.size(); ++i) {
      for (int k = 0; k < family.width; ++k) {
        const NodeIndex n = family.of(group[i])[k];
        if (n == no_index) continue;
        some.clear();
        for (const std::uint32_t e : connectivity.elements(family.kind, n))
          if (place_of[e] != no_index) some.push_back(place_of[e]);
        std::sort(some.begin(), some.end());
        for (const std::uint32_t j : some)
          if (seen[j] != i) {
            seen[j] = i;
            rows_.entries.push_back(j);
          }
      }
      rows_.first.push_back(static_cast<std::uint32_t>(rows_.entries.size()));
    }
    for (const std::uint32_t e : group) place_of[e] = no_index;
  }

  std::vector<std::uint32_t> order() {
    std::vector<std::uint32_t> out;
    std::vector<bool> numbered(group_.size(), false);
    for (std::uint32_t i = 0; i < group_.size(); ++i) {
      if (numbered[i]) continue;
      std::size_t head = out.size();
      const std::uint32_t start = far_element(i);
      numbered[start] = true;
      out.push_back(start);
      for (; head < out.size(); ++head) {
        const auto begin = static_cast<std::ptrdiff_t>(out.size());
        for (const std::uint32_t j : rows_.row(out[head]))
          if (!numbered[j]) {
            numbered[j] = true;
            out.push_back(j);
          }
        std::sort(out.begin() + begin, out.end(), [&](std::uint32_t a, std::uint32_t b) {
          return std::pair(degree(a), a) < std::pair(degree(b), b);
        });
      }
    }
    return out;
  }

 private:
  std::size_t degree(std::uint32_t i) const { return rows_.row(i).size(); }

  /// Start of the numbering of the part around `from`.
  std::uint32_t far_element(std::uint32_t from) {
    std::uint32_t best = from;
    std::int64_t farthest = -1;
    for (;;) {
      const auto [element, distance] = sweep(best);
      best = element;
      if (distance <= farthest) return best;
      farthest = distance;
    }
  }

  /// Farthest element from `origin`; among equals the largest degree, then the smallest number.
  std::pair<std::uint32_t, std::int64_t> sweep(std::uint32_t origin) {
    if (distance_.empty()) distance_.resize(group_.size(), -1);
    std::vector<std::uint32_t> visited{origin};
    distance_[origin] = 0;
    std::uint32_t best = origin;
    const auto rank = [&](std::uint32_t e) {
      return std::tuple(-distance_[e], -static_cast<std::int64_t>(degree(e)), e);
    };
    for (std::size_t head = 0; head < visited.size(); ++head)
      for (const std::uint32_t j : rows_.row(visited[head]))
        if (distance_[j] < 0) {
          distance_[j] = distance_[visited[head]] + 1;
          visited.push_back(j);
          if (rank(j) < rank(best)) best = j;
        }
    const std::int64_t far = distance_[best];
    for (const std::uint32_t e : visited) distance_[e] = -1;
    return {best, far};
  }

  std::span<const std::uint32_t> group_;
  IndexRows rows_;  ///< neighbours of each element, including itself
  std::vector<std::int64_t> distance_;
};

std::vector<std::uint32_t> places(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> out(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) out[order[i]] = i;
  return out;
}

}  // namespace

ElementOrder element_order(const Model& model, Connectivity& connectivity) {
  const Elements& quads = model.shell4;
  std::vector<std::uint32_t> sorted = sorted_elements(model, quads), renumbered;
  std::vector<std::uint32_t> scratch(quads.size(), no_index);
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin + 1;
    const Key key = sort_key(model, quads, sorted[begin]);
    while (end < sorted.size() && sort_key(model, quads, sorted[end]) == key) ++end;
    const std::span<const std::uint32_t> group(sorted.data() + begin, end - begin);
    for (const std::uint32_t i : ElementRenumbering(quads, connectivity, group, scratch).order())
      renumbered.push_back(group[i]);
    begin = end;
  }
  return {places(renumbered), places(sorted_elements(model, model.shell3))};
}

}  // namespace deck::detail
