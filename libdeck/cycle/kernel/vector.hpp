// Three-component arithmetic for the stages that work on one pair at a time.
#pragma once
#include <array>
#include <cstddef>

#include "base/shared/vec.hpp"

namespace deck::cycle::detail {

using deck::Vec;

inline Vec at(const std::array<const double*, 3>& p, std::size_t i) {
  return {p[0][i], p[1][i], p[2][i]};
}
/// Corners of the segment of a pair.
template <class View>
std::array<Vec, 4> corners(const View& view, std::size_t i) {
  return {at(view.position[1], i), at(view.position[2], i), at(view.position[3], i),
          at(view.position[4], i)};
}

/// The frame that ties ride on: first diagonal, its companion in the surface, the normal.
struct Frame {
  Vec t1, t2, n;
  Frame(const std::array<Vec, 4>& corner) {
    t1 = unit(corner[2] - corner[0]);
    n = unit(cross(t1, corner[3] - corner[1]));
    t2 = cross(n, t1);
  }
  [[nodiscard]] Vec along(double fn, double f1, double f2) const {
    return fn * n + (f1 * t1 + f2 * t2);
  }
};

/// Axes of a segment for directed friction: the mean directions of its sides (a triangle: its first
/// side and the one from corner 1 to 3), turned against one another until they are square.
struct SegmentAxes {
  Vec first, second, normal;
  SegmentAxes(const Vec& x1, const Vec& x2, const Vec& x3, const Vec& x4, bool triangle) {
    const Vec a = triangle ? x2 - x1 : (x2 + x3) - (x1 + x4);
    const Vec b = triangle ? x3 - x1 : (x3 + x4) - (x1 + x2);
    normal = unit(cross(a, b));
    const double ratio = norm(b) > 0.0 ? norm(a) / norm(b) : 0.0;
    first = unit(a + ratio * cross(b, normal));
    second = cross(normal, first);
  }
};

}  // namespace deck::cycle::detail
