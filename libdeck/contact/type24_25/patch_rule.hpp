// Rule of TYPE24 for one node and one segment, as numbers without a deck: foot on the bilinear
// patch, penetration, choice among a node's pairs. Templates run in double and in exact numbers.
//
//    4 ---- 3    The patch has parameters s, t from -1 to 1 (1 = (-1,-1), 3 = (1,1)). They follow
//    |  .c  |    from the areas of the triangles at its sides seen from the centre (a) and from
//    1 ---- 2    the node (c). penetration = gap - signed height over the patch.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/shared/vec.hpp"
#include "contact/shared/closest.hpp"

namespace deck::detail::type24_25 {

/// Direction of the node and limits are the solver's values: exact input here.
struct PatchRule {
  Vec node;
  std::array<Vec, 4> corner{};  ///< triangle: last two equal
  bool solid = false;           ///< of a solid or coat, not a sheet
  double node_gap = 0, segment_gap = 0;
  double limit = 1e30;        ///< at this depth a solid segment no longer counts
  double accepted = 1e30;     ///< deepest accepted penetration
  bool own_solid = false;     ///< a solid at the node has a corner of the segment
  bool rejects_part = false;  ///< the node is of the same part, which is not allowed
  bool never_blocks = false;
  bool by_direction = false;  ///< rejects nodes whose direction is that of a solid segment
  Vec direction;              ///< of the node
};

/// False: a position is missing, or a direction overflows.
inline bool is_finite(const PatchRule& r) {
  bool all = is_finite(r.node) && is_finite(r.direction);
  for (const Vec& corner : r.corner) all = all && is_finite(corner);
  for (const double v : {r.node_gap, r.segment_gap, r.limit, r.accepted})
    all = all && std::isfinite(v);
  return all;
}

/// Constants of the solver: negligible share of the area, overhang and penetration.
constexpr double flat_patch = 1e-10, beside_patch = 2e-6, tiny_penetration = 1e-8;

/// Parameters of the foot, -1 to 1 on the patch.
template <class T>
struct PatchPlace {
  T s{}, t{};
  bool triangle = false, outside = false;
};

/// For a triangle; `c`: sub-areas at sides 1, 2, 4 from the node.
template <class T>
void triangle_parameters(const T& a1, const T& c1, const T& c2, const T& c4, T& s, T& t) {
  const T e(beside_patch), zero(0), least = T(-e * a1);
  t = c1 / a1 - T(1);
  if (c2 <= zero && c4 <= zero && c2 >= least && c4 >= least)
    s = zero;
  else if (c2 <= zero && c4 > zero)
    s = T(-c2 / a1) <= e ? T(1) : T(2);
  else if (c4 <= zero && c2 > zero)
    s = T(-c4 / a1) <= e ? T(-1) : T(-2);
}

/// From sub-areas at the sides, from the centre (`a`) and from the node (`c`). flat(area),
/// flat_product(product of two): negligible beside the area of the patch.
template <class T, class Flat, class FlatProduct>
PatchPlace<T> place_on_patch(const std::array<T, 4>& a, const std::array<T, 4>& c, const Flat& flat,
                             const FlatProduct& flat_product) {
  const auto ratio = [&](const T& up, const T& down) {
    return flat_product(down) ? T(0) : T(up / down);
  };
  PatchPlace<T> out;
  out.s = ratio(T(a[1] * c[3] - c[1] * a[3]), T(a[1] * c[3] + c[1] * a[3]));
  out.t = ratio(T(c[0] * a[2] - a[0] * c[2]), T(c[0] * a[2] + a[0] * c[2]));
  out.triangle = flat(a[2]);
  if (out.triangle) triangle_parameters(a[0], c[0], c[1], c[3], out.s, out.t);
  const T most(1 + beside_patch);
  out.outside = scalar::absolute_value(out.s) > most || scalar::absolute_value(out.t) > most;
  return out;
}

template <class T>
void onto_triangle(T& s, T& t) {
  const T zero(0), one(1), quarter(0.25);
  T w1 = quarter * (one - t) * (one - s), w2 = quarter * (one - t) * (one + s);
  const auto cut = [&](const T& v) { return v < zero ? zero : v > one ? one : v; };
  if (one - w1 - w2 >= zero) {
    w1 = cut(w1), w2 = cut(w2);
  } else if (w2 > w1 && w2 >= one) {
    w1 = zero, w2 = one;
  } else if (w1 >= one) {
    w1 = one, w2 = zero;
  } else {
    const T d = w1 - w2;
    w1 = cut(T(T(0.5) * (one + d))), w2 = cut(T(T(0.5) * (one - d)));
  }
  if (w1 + w2 == zero) return;
  s = (w2 - w1) / (w1 + w2);
  t = one - T(2) * (w1 + w2);
}

template <class T>
Point3<T> closest_on_patch(const std::array<Point3<T>, 4>& p, const PatchPlace<T>& place) {
  T s = place.s, t = place.t;
  const T one(1);
  if (place.outside && place.triangle && t < one) onto_triangle(s, t);
  for (T* v : {&s, &t})
    if (*v < -one)
      *v = -one;
    else if (*v > one)
      *v = one;
  const T f1 = (one - t) * (one - s), f2 = (one - t) * (one + s), f3 = (one + t) * (one + s),
          f4 = (one + t) * (one - s);
  return T(0.25) * (f1 * p[0] + f2 * p[1] + f3 * p[2] + f4 * p[3]);
}

/// One pair: penetration, <= 0 if none.
template <class T>
struct PatchResult {
  bool exists = true, blocks = true;
  T penetration{}, distance{};
};

/// `distance`: from the closest point if the node is outside, else |height|. `same_way`: node and
/// segment have the same direction.
template <class T>
PatchResult<T> judge_patch(const PatchRule& r, const T& gap, const T& height, const T& distance,
                           bool outside, bool same_way) {
  PatchResult<T> out;
  out.distance = distance;
  T& p = out.penetration;
  const T zero(0), tiny(tiny_penetration);
  const auto size = [](const T& v) { return scalar::absolute_value(v); };
  const auto live = [&] { return p > zero || size(p) < tiny; };
  const auto reject = [&] { p = -size(p) - tiny; };
  if (r.solid) {
    p = gap - height;
    if (outside) reject();
    if (live() && (p >= T(r.limit) || r.own_solid)) {
      reject();
      out.blocks = false;
    }
    if (r.by_direction && same_way && live()) {
      reject();
      out.blocks = false;
    }
  } else {
    out.exists = !outside;
    if (outside) return out;
    p = gap - size(height);
    const bool deep = p > T(r.accepted);
    out.blocks = !deep;
    if (p > zero) out.distance = size(T(gap - height));
    if (height < zero || deep) reject();
  }
  if (r.rejects_part && live()) reject();
  if (r.never_blocks) out.blocks = false;
  return out;
}

/// State of a node between its pairs.
template <class T>
class PatchState {
 public:
  /// `nearest`: the nearest pair counts (Inacti other than 0), else the smallest penetration.
  PatchState(bool nearest, double accepted) : nearest_(nearest), accepted_(accepted) {}

  /// True if the node now penetrates this pair.
  bool accept(const PatchResult<T>& r) {
    const T& p = r.penetration;
    const T zero(0);
    if (!r.exists) return false;
    if (scalar::absolute_value(p) < T(tiny_penetration) || (p < zero && r.blocks)) {
      if (!known_) {
        memory_ = -r.distance;
        known_ = true;
      } else if (r.distance < scalar::absolute_value(memory_)) {
        memory_ = -r.distance;
        if (nearest_) found_ = false;
      }
      return false;
    }
    if (p > T(accepted_) || !(p > zero)) return false;
    if (known_ && !(nearest_ ? r.distance < scalar::absolute_value(memory_) : p < memory_))
      return false;
    memory_ = nearest_ ? r.distance : p;
    known_ = found_ = true;
    return true;
  }
  bool found() const { return found_; }

 private:
  bool nearest_;
  double accepted_;
  bool known_ = false, found_ = false;
  T memory_{};
};

struct PatchFigures {
  PatchResult<double> result;
  double gap = 0, height = 0;  ///< height: absolute value
  Vec normal;
  bool doubtful = false;  ///< round-off may change its effect on the node
  double slack = 0;       ///< bound of the round-off of the distance
  double least = 0;       ///< lower bound of the distance of a doubtful pair
};
/// `with_doubts`: report doubts.
PatchFigures evaluate_patch(const PatchRule& rule, bool with_doubts);

/// Result for a node in double.
struct PatchChoice {
  bool penetrates = false;
  bool doubtful = false;              ///< round-off may change if it penetrates
  std::uint32_t pair = 0;             ///< position in the list
  PatchFigures figures;               ///< of this pair
  std::vector<std::uint32_t> needed;  ///< positions of pairs that may decide, and `pair`
};
/// `nearest`: see PatchState.
PatchChoice choose_pair(std::span<const PatchRule> pairs, bool nearest, bool with_doubts);

/// Result for a node in exact arithmetic.
struct ExactNode {
  bool penetrates = false;
  std::uint32_t pair = 0;                   ///< position in the list
  double depth = 0, gap = 0, distance = 0;  ///< rounded; depth > 0 if penetrating
};
/// `asked`: pair whose distance is returned without penetration. Finite numbers only.
ExactNode exact_node(std::span<const PatchRule> pairs, bool nearest, std::uint32_t asked);

}  // namespace deck::detail::type24_25
