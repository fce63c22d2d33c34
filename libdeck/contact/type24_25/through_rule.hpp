// Rule of TYPE25 for an edge and one side of a segment of a solid, as numbers without a deck.
// Templates run in double, in intervals and in exact numbers.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/shared/vec.hpp"
#include "deck/point3.hpp"

namespace deck::detail::type24_25 {

/// Directions are the solver's single-precision values: exact input here.
struct ThroughRule {
  std::array<Vec, 2> edge{};    ///< the end with the smaller id first
  std::array<Vec, 4> corner{};  ///< triangle: last two equal
  bool triangle = false;
  std::size_t side = 0;  ///< from this corner to the next
  double gap = 0, margin = 0;
  bool of_solids = false;                           ///< the edge lies between solids
  Vec beta;                                         ///< of the side; not used by edges of solids
  std::array<Vec, 2> edge_normal{}, side_normal{};  ///< at the ends, for edges of solids
};

/// False: a position is missing, or a direction exceeds single precision.
inline bool is_finite(const ThroughRule& r) {
  bool all = std::isfinite(r.gap) && std::isfinite(r.margin);
  const auto test_finite = [&](const Vec& v) {
    all = all && std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  for (const Vec& v : r.corner) test_finite(v);
  for (const auto* pair : {&r.edge, &r.edge_normal, &r.side_normal})
    for (const Vec& v : *pair) test_finite(v);
  test_finite(r.beta);
  return all;
}

/// Root: of a non-negative number of type T.
template <class T, class Root>
class ThroughSide {
 public:
  using V = Point3<T>;

  ThroughSide(const ThroughRule& r, const Root& root)
      : r_(r),
        root_(root),
        edge_{{lift(r.edge[0]), lift(r.edge[1])}},
        p_{{lift(r.corner[0]), lift(r.corner[1]), lift(r.corner[2]), lift(r.corner[3])}},
        centre_(p_[2]),
        side_{{p_[r.side], p_[(r.side + 1) % 4]}} {
    if (!r.triangle) centre_ = T(0.25) * (p_[0] + p_[1] + p_[2] + p_[3]);
    facet_ = cross(side_[0] - centre_, side_[1] - centre_);
  }

  /// True if the edge passes through the segment beside this side; sets `depth`.
  bool passes(T& depth) {
    if (!crosses() || !meets() || !boxes_meet()) return false;
    depth = norm(apart_);
    return r_.of_solids ? behind_each_other(depth) : inside();
  }

 private:
  static V lift(const Vec& p) { return {T(p.x), T(p.y), T(p.z)}; }
  T norm(const V& v) const { return root_(dot(v, v)); }
  V unit(const V& v) const {
    const T length = norm(v);
    return length > T(0) ? V{T(v.x / length), T(v.y / length), T(v.z / length)} : V{};
  }

  /// Tests the plane of the facet, within the facet or a little beside it.
  bool crosses() const {
    const T a = dot(facet_, edge_[0] - centre_), b = dot(facet_, edge_[1] - centre_);
    if (!(T(a * b) <= T(0)) || a == b) return false;
    const V q = edge_[0] + T(a / (a - b)) * (edge_[1] - edge_[0]) - centre_;
    const T size = scalar::larger(T(1e-30), dot(facet_, facet_));
    const T first = dot(facet_, cross(q, side_[1] - centre_)) / size;
    const T second = dot(facet_, cross(side_[0] - centre_, q)) / size;
    return first >= T(-0.1) && second >= T(-0.1) && T(first + second) <= T(1.01);
  }

  /// Finds the nearest points of edge and side. False: on the straight lines they lie too far
  /// beyond the ends for the solver.
  bool meets() {
    const auto taken = [](const T& h) { return h >= T(-0.001) && h <= T(1.03); };
    const auto clamped = [](const T& h) { return scalar::larger(T(0), scalar::smaller(T(1), h)); };
    const V u = edge_[0] - edge_[1], v = side_[0] - side_[1], w = edge_[1] - side_[1];
    const T uu = scalar::larger(T(1e-30), dot(u, u)), vv = scalar::larger(T(1e-30), dot(v, v)),
            uv = dot(u, v), det = scalar::larger(T(1e-20), T(uu * vv - uv * uv));
    on_side_ = (uu * dot(v, w) - uv * dot(u, w)) / det;
    if (!taken(on_side_)) return false;
    on_side_ = clamped(on_side_);
    on_edge_ = (on_side_ * uv - dot(u, w)) / uu;
    if (!taken(on_edge_)) return false;
    on_edge_ = clamped(on_edge_);
    on_side_ = clamped(T((on_edge_ * uv + dot(v, w)) / vv));
    apart_ = (edge_[1] + on_edge_ * u) - (side_[1] + on_side_ * v);
    return true;
  }

  /// In the axes of the segment.
  bool boxes_meet() const {
    const V up = unit(cross(p_[2] - p_[0], p_[3] - p_[1])), first = p_[1] - p_[0],
            along = unit(first - dot(first, up) * up);
    for (const V& axis : {along, cross(up, along), up}) {
      T low = dot(axis, p_[0]), high = low;
      for (const V& q : p_) {
        low = scalar::smaller(low, dot(axis, q));
        high = scalar::larger(high, dot(axis, q));
      }
      const T by = T(0.02) * (high - low) + T(r_.gap) + T(r_.margin);
      const T a = dot(axis, edge_[0]), b = dot(axis, edge_[1]);
      if (scalar::larger(a, b) < T(low - by) || scalar::smaller(a, b) > T(high + by)) return false;
    }
    return true;
  }

  /// Edge of solids: both lie behind one another along both normals.
  bool behind_each_other(T& depth) const {
    const V s = unit(edge_[1] - edge_[0]), d = unit(side_[1] - side_[0]);
    if (scalar::absolute_value(dot(s, d)) > T(0.999)) return false;
    const V across = unit(cross(s, d)), apart = dot(apart_, across) * across;
    depth = norm(apart);
    const T on_side = dot(apart, between(r_.side_normal, on_side_)),
            on_edge = -dot(apart, between(r_.edge_normal, on_edge_));
    return on_side <= T(1e-4) * depth && on_edge <= T(1e-4) * depth &&
           scalar::absolute_value(on_side) > T(0.2) * depth &&
           scalar::absolute_value(on_edge) > T(0.2) * depth;
  }
  static V between(const std::array<Vec, 2>& ends, const T& weight) {
    return weight * lift(ends[0]) + T(T(1) - weight) * lift(ends[1]);
  }

  /// Other edge: within the angle of the two facets at the side.
  bool inside() const {
    const V beta = lift(r_.beta), a = -facet_, b = T(T(2) * dot(a, beta)) * beta - a;
    const V other = r_.triangle ? p_[(r_.side + 2) % 4] : centre_;
    const bool in_a = dot(apart_, a) > T(0), in_b = dot(apart_, b) > T(0);
    return dot(other - p_[r_.side], b) >= T(0) ? in_a && in_b : in_a || in_b;
  }

  const ThroughRule& r_;
  const Root& root_;
  std::array<V, 2> edge_;
  std::array<V, 4> p_;
  V centre_;
  std::array<V, 2> side_;
  V facet_, apart_;
  T on_edge_{}, on_side_{};
};

/// In double, as in the solver.
struct ThroughFigures {
  bool passes = false;
  double depth = 0;
};
ThroughFigures evaluate_through(const ThroughRule& rule);
/// Without round-off; finite numbers only. `figures`: compute the depth, rounded. `exact` counts
/// the cases that intervals did not decide.
ThroughFigures exact_through(const ThroughRule& rule, bool figures, std::uint64_t& exact);

}  // namespace deck::detail::type24_25
