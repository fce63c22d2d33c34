// The segment that is nearest to a node which found none: by a tree of boxes, so that a tie whose
// sides lie far apart costs no more than one that holds.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "contact/shared/tie_parts.hpp"

namespace deck::detail {
namespace {

constexpr std::uint32_t leaf_size = 8;

double along(const Vec& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

double square_outside(double x, double low, double high) {
  const double d = std::max({0.0, low - x, x - high});
  return d * d;
}

bool holds(const Corners& c, NodeIndex node) {
  return std::find(c.begin(), c.end(), node) != c.end();
}

}  // namespace

NearestSegments::NearestSegments(const Coordinates& x, const std::vector<Corners>& segments)
    : x_(x), segments_(segments), order_(segments.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  centres_.reserve(segments.size());
  for (const Corners& c : segments)
    centres_.push_back(0.25 * (at(x, c[0]) + at(x, c[1]) + at(x, c[2]) + at(x, c[3])));
  if (!segments.empty()) split(0, static_cast<std::uint32_t>(segments.size()));
}

/// Adds the box of a stretch of the order and those below it; gives its place.
std::uint32_t NearestSegments::split(std::uint32_t begin, std::uint32_t end) {
  const auto here = static_cast<std::uint32_t>(boxes_.size());
  TreeBox box{at(x_, segments_[order_[begin]][0]), at(x_, segments_[order_[begin]][0]), begin, end,
              0};
  for (std::uint32_t i = begin; i < end; ++i)
    for (const NodeIndex n : segments_[order_[i]]) {
      const Vec p = at(x_, n);
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  boxes_.push_back(box);
  if (end - begin <= leaf_size) return here;
  const Vec size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(along(centres_[a], axis), a) <
                            std::pair(along(centres_[b], axis), b);
                   });
  split(begin, middle);
  const std::uint32_t second = split(middle, end);
  boxes_[here].second = second;
  return here;
}

NearestSegments::Found NearestSegments::of(NodeIndex node) const {
  Found best;
  if (boxes_.empty()) return best;
  const Vec p = at(x_, node);
  const auto outside = [&](const TreeBox& b) {
    return std::sqrt(square_outside(p.x, b.low.x, b.high.x) +
                     square_outside(p.y, b.low.y, b.high.y) +
                     square_outside(p.z, b.low.z, b.high.z));
  };
  std::vector<std::pair<double, std::uint32_t>> open{{outside(boxes_[0]), 0}};
  while (!open.empty()) {
    const auto [least, index] = open.back();
    open.pop_back();
    if (best.segment != no_index && least > best.distance) continue;
    const TreeBox& box = boxes_[index];
    if (box.second == 0) {
      for (std::uint32_t i = box.begin; i < box.end; ++i) {
        const std::uint32_t m = order_[i];
        if (holds(segments_[m], node)) continue;
        const double d = distance_from(x_, node, segments_[m]);
        if (best.segment == no_index || d < best.distance ||
            (d == best.distance && m < best.segment))
          best = {m, d};
      }
      continue;
    }
    std::pair<double, std::uint32_t> one{outside(boxes_[index + 1]), index + 1};
    std::pair<double, std::uint32_t> two{outside(boxes_[box.second]), box.second};
    if (one.first < two.first) std::swap(one, two);
    open.push_back(one);
    open.push_back(two);  // the nearer is looked at first
  }
  return best;
}

}  // namespace deck::detail
