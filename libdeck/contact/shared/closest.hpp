// Closest points of a node and a segment, and of two edges, in two forms: the solver's formulas,
// with all their guards, and a robust one without absolute floors.
//
// Templates on the number type: float, double, double-double, interval, exact rational. Types
// without a square root (NumberTraits<T>::has_sqrt == false) compare squared distances.
//
//     n4 ---- n3     A quadrangle is four sub-triangles O, A, B around the mean O of its corners:
//      | \  / |      sub-triangle k has A = corner k, B = corner k+1. A triangle is the single
//      |  O   |      sub-triangle O = n3, A = n1, B = n2. Weights sum to 1; vectors lead from
//     n1 ---- n2     the segment (main side) to the node (secondary side).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "deck/contacts.hpp"
#include "deck/point3.hpp"

namespace deck {

inline bool is_finite(const Point3<double>& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
template <std::size_t N>
bool all_finite(const std::array<Point3<double>, N>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Point3<double>& p) { return is_finite(p); });
}

template <class T>
struct SubTriangleClosest {
  T weight_o{}, weight_a{}, weight_b{};  // closest point = sum of weight * vertex
  Point3<T> vector;                      // from the closest point to the node, not normalised
  T distance_squared{};
  T distance{};  // left 0 where the number type has no square root
};

// Closest point on a segment: the four sub-triangles and the best of them.
template <class T>
struct SegmentClosest {
  std::array<SubTriangleClosest<T>, 4> sub;
  int best = 0;                // sub-triangle with the smallest distance, the first of ties
  std::array<T, 4> weights{};  // of the four corners, sum 1; a triangle's fourth is 0
  const SubTriangleClosest<T>& closest() const { return sub[static_cast<std::size_t>(best)]; }
  const T& distance() const { return closest().distance; }
  const T& distance_squared() const { return closest().distance_squared; }
};

// Initial penetration of a node-segment pair.
template <class T>
struct Penetration {
  T value{};                // max over the sub-triangles of max(0, gap - distance); > 0: penetrated
  int sub = 0;              // first sub-triangle that has that value
  Point3<T> normal;         // unit vector from the segment to the node; zero if the node is on it
  bool on_surface = false;  // the distance is exactly 0: no direction exists
};

enum class EdgeFeature : std::uint8_t { interior, first_node, second_node };

// Closest points of two edges.
template <class T>
struct EdgeClosest {
  T weight_s{}, weight_m{};  // weight of the *first* node of the secondary and the main edge
  Point3<T> vector;          // from the main point to the secondary point, not normalised
  T distance_squared{};
  T distance{};  // left 0 where the number type has no square root
  EdgeFeature feature_s = EdgeFeature::interior, feature_m = EdgeFeature::interior;
  bool parallel = false;  // robust form: parallel and overlapping, middle of the overlap taken
};

namespace closest_detail {

using scalar::absolute_value;
using scalar::larger;
using scalar::smaller;
using scalar::square_root;

template <class T>
T clamp01(const T& a) {
  return larger(T(0), smaller(T(1), a));
}

// Reference formula on one sub-triangle; `p` the node, absolute coordinates.
template <class T>
SubTriangleClosest<T> reference_sub_triangle(const Point3<T>& p, const Point3<T>& o,
                                             const Point3<T>& corner_a, const Point3<T>& corner_b) {
  const T floor30(1e-30), floor20(1e-20), zero(0);
  const Point3<T> a = corner_a - o, b = corner_b - o, r = p - o;
  const Point3<T> n = cross(a, b);
  const T s = T(1) / larger(floor30, dot(n, n));
  T la = s * dot(n, cross(r, b));
  T lb = s * dot(n, cross(a, r));
  T lo = T(1) - la - lb;
  const Point3<T> e = corner_b - corner_a;
  const T ee = larger(floor20, dot(e, e));
  const T bb = larger(floor30, dot(b, b));
  const T aa = larger(floor30, dot(a, a));
  const T ho = lo * absolute_value(lo) / ee;
  const T ha = la * absolute_value(la) / bb;
  const T hb = lb * absolute_value(lb) / aa;
  if (lo < zero && ho <= ha && ho <= hb) {
    la = clamp01(T(dot(corner_b - p, e) / ee));
    lb = T(1) - la;
    lo = zero;
  } else if (la < zero && ha <= hb && ha <= ho) {
    la = zero;
    lb = clamp01(T(dot(r, b) / bb));
    lo = T(1) - lb;
  } else if (lb < zero && hb <= ho && hb <= ha) {
    lb = zero;
    la = clamp01(T(dot(r, a) / aa));
    lo = T(1) - la;
  }
  SubTriangleClosest<T> out;
  out.vector = p - (o + la * a + lb * b);
  out.weight_o = lo;
  out.weight_a = la;
  out.weight_b = lb;
  out.distance_squared = dot(out.vector, out.vector);
  out.distance = square_root(out.distance_squared);
  return out;
}

// Closest point on the edge from u (weight 1-t) to v (weight t). `u`, `v` are relative to the node,
// `e` = v - u. The distance |e x u| / |e| does not cancel.
template <class T>
struct EdgePoint {
  T t{}, distance{}, distance_squared{};
  Point3<T> vector;
};
template <class T>
EdgePoint<T> closest_on_edge(const Point3<T>& u, const Point3<T>& v, const Point3<T>& e) {
  EdgePoint<T> out;
  const T ee = dot(e, e);
  const T along = -dot(e, u);
  if (along <= T(0) || ee <= T(0)) {
    out.t = T(0);
    out.vector = -u;
  } else if (along >= ee) {
    out.t = T(1);
    out.vector = -v;
  } else {
    const Point3<T> moment = cross(u, e);  // e x (node - u)
    out.t = along / ee;
    out.vector = T(T(1) / ee) * cross(moment, e);
    if constexpr (NumberTraits<T>::has_sqrt) {
      out.distance = length(moment) / square_root(ee);
      out.distance_squared = out.distance * out.distance;
    } else {
      out.distance_squared = dot(moment, moment) / ee;
    }
    return out;
  }
  out.distance = length(out.vector);
  out.distance_squared = dot(out.vector, out.vector);
  return out;
}

template <class T>
bool nearer(const T& distance_a, const T& squared_a, const T& distance_b, const T& squared_b) {
  if constexpr (NumberTraits<T>::has_sqrt) {
    (void)squared_a, (void)squared_b;
    return distance_a < distance_b;
  } else {
    (void)distance_a, (void)distance_b;
    return squared_a < squared_b;
  }
}

// True unless the point with the computed weights, which lies in the triangle despite round-off, is
// clearly farther than the distance along the normal. On needles it is: the normal is noise, and
// the edges are more accurate.
template <class T>
bool normal_is_trustworthy(const SubTriangleClosest<T>& face, const Point3<T>& vo,
                           const Point3<T>& va, const Point3<T>& vb) {
  if constexpr (std::is_floating_point_v<T>) {
    const Point3<T> q = face.weight_o * vo + face.weight_a * va + face.weight_b * vb;
    const T size =
        larger(largest_component(vo), larger(largest_component(va), largest_component(vb)));
    return square_root(dot(q, q)) - face.distance <=
           T(256) * std::numeric_limits<T>::epsilon() * size;
  } else {
    (void)face, (void)vo, (void)va, (void)vb;
    return true;
  }
}

// Robust formula on one sub-triangle. Vertices minus node; a, b, e are the edges A-O, B-O, B-A,
// from the input if that is more accurate.
template <class T>
SubTriangleClosest<T> robust_sub_triangle(const Point3<T>& vo, const Point3<T>& va,
                                          const Point3<T>& vb, const Point3<T>& a,
                                          const Point3<T>& b, const Point3<T>& e) {
  SubTriangleClosest<T> out;
  const Point3<T> n = cross(a, b);
  const T nn = dot(n, n);
  if (nn > NumberTraits<T>::parallel_guard() * dot(a, a) * dot(b, b)) {
    const T fa = dot(n, cross(b, vo)), fb = dot(n, cross(vo, a)), fo = dot(n, cross(va, vb));
    const T sum = fa + fb + fo;
    if (fa >= T(0) && fb >= T(0) && fo >= T(0) && sum > T(0)) {
      const T height = -dot(n, vo);
      out.weight_a = fa / sum;
      out.weight_b = fb / sum;
      out.weight_o = fo / sum;
      out.vector = T(height / nn) * n;
      if constexpr (NumberTraits<T>::has_sqrt) {
        out.distance = absolute_value(height) / square_root(nn);
        out.distance_squared = out.distance * out.distance;
      } else {
        out.distance_squared = height * height / nn;
      }
      if (normal_is_trustworthy(out, vo, va, vb)) return out;
    }
  }
  const EdgePoint<T> ab = closest_on_edge(va, vb, e);
  const EdgePoint<T> ob = closest_on_edge(vo, vb, b);
  const EdgePoint<T> oa = closest_on_edge(vo, va, a);
  const EdgePoint<T>* best = &ab;
  if (nearer(ob.distance, ob.distance_squared, best->distance, best->distance_squared)) best = &ob;
  if (nearer(oa.distance, oa.distance_squared, best->distance, best->distance_squared)) best = &oa;
  const T first = T(1) - best->t;
  out.weight_o = best == &ab ? T(0) : first;
  out.weight_a = best == &ab ? first : (best == &oa ? best->t : T(0));
  out.weight_b = best == &oa ? T(0) : best->t;
  out.vector = best->vector;
  out.distance = best->distance;
  out.distance_squared = best->distance_squared;
  return out;
}

template <class T>
using Corners = std::array<Point3<T>, 4>;

template <class T>
std::array<SubTriangleClosest<T>, 4> reference_sub_triangles(const Point3<T>& p,
                                                             const Corners<T>& x, bool triangle) {
  Point3<T> o = x[2];
  if (!triangle) o = T(0.25) * (x[0] + x[1] + x[2] + x[3]);
  return {reference_sub_triangle(p, o, x[0], x[1]), reference_sub_triangle(p, o, x[1], x[2]),
          reference_sub_triangle(p, o, x[2], x[3]), reference_sub_triangle(p, o, x[3], x[0])};
}

// Power of two that keeps products of up to six such numbers in range; 0 if none is needed.
// Infinity means that a difference overflowed: finite coordinates divided by the largest power of
// two are at most 1.
template <class T>
int safe_shift(const T& big) {
  constexpr int safe = std::numeric_limits<T>::max_exponent / 10;
  if (!(big > T(0)) || (big >= std::ldexp(T(1), -safe) && big <= std::ldexp(T(1), safe))) return 0;
  return big <= std::numeric_limits<T>::max() ? -std::ilogb(big)
                                              : -std::numeric_limits<T>::max_exponent;
}

template <class T>
Point3<T> shifted(const Point3<T>& v, int shift) {
  return {std::ldexp(v.x, shift), std::ldexp(v.y, shift), std::ldexp(v.z, shift)};
}

// The four sub-triangles, scaled into range.
template <class T>
std::array<SubTriangleClosest<T>, 4> scaled_sub_triangles(const Point3<T>& p, const Corners<T>& x,
                                                          bool triangle) {
  const Corners<T> v{x[0] - p, x[1] - p, x[2] - p, x[3] - p};
  std::array<SubTriangleClosest<T>, 4> out;
  if (triangle) {
    out[0] = robust_sub_triangle(v[2], v[0], v[1], x[0] - x[2], x[1] - x[2], x[1] - x[0]);
    // The three degenerate sub-triangles are corner 3.
    SubTriangleClosest<T> node;
    node.weight_o = T(1);
    node.vector = -v[2];
    node.distance = length(node.vector);
    node.distance_squared = dot(node.vector, node.vector);
    out[1] = out[2] = out[3] = node;
    return out;
  }
  const Point3<T> vo = T(0.25) * ((v[0] + v[2]) + (v[1] + v[3]));
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    out[k] = robust_sub_triangle(vo, v[k], v[next], v[k] - vo, v[next] - vo, x[next] - x[k]);
  }
  return out;
}

template <class T>
std::array<SubTriangleClosest<T>, 4> robust_sub_triangles(const Point3<T>& p, const Corners<T>& x,
                                                          bool triangle) {
  if constexpr (std::is_floating_point_v<T>) {
    T big(0);
    for (const Point3<T>& corner : x) big = larger(big, largest_component(corner - p));
    if (const int shift = safe_shift(big); shift != 0) {
      const Corners<T> y{shifted(x[0], shift), shifted(x[1], shift), shifted(x[2], shift),
                         shifted(x[3], shift)};
      auto out = scaled_sub_triangles(shifted(p, shift), y, triangle);
      for (auto& sub : out) {
        sub.vector = shifted(sub.vector, -shift);
        sub.distance = std::ldexp(sub.distance, -shift);
        sub.distance_squared = std::ldexp(sub.distance_squared, -2 * shift);
      }
      return out;
    }
  }
  return scaled_sub_triangles(p, x, triangle);
}

// Distributes the weights of the best sub-triangle to the corners.
template <class T>
void set_weights(SegmentClosest<T>& out, bool triangle) {
  const auto k = static_cast<std::size_t>(out.best);
  const SubTriangleClosest<T>& s = out.sub[k];
  if (triangle) {
    // Sub-triangle 0 is (n3, n1, n2); the others are corner 3.
    out.weights = {T(0), T(0), T(1), T(0)};
    if (k == 0) out.weights = {s.weight_a, s.weight_b, s.weight_o, T(0)};
    return;
  }
  const T quarter = s.weight_o * T(0.25);
  out.weights = {quarter, quarter, quarter, quarter};
  out.weights[k] = out.weights[k] + s.weight_a;
  out.weights[(k + 1) % 4] = out.weights[(k + 1) % 4] + s.weight_b;
}

template <class T>
EdgeFeature edge_feature(const T& weight_of_first) {
  if (weight_of_first == T(1)) return EdgeFeature::first_node;
  return weight_of_first == T(0) ? EdgeFeature::second_node : EdgeFeature::interior;
}

template <class T>
EdgeClosest<T> reference_edges(const Point3<T>& s1, const Point3<T>& s2, const Point3<T>& m1,
                               const Point3<T>& m2) {
  const T floor20(1e-20);
  const Point3<T> s = s2 - s1, m = m2 - m1, w = m2 - s2;
  const T aa = dot(s, s), cc = dot(m, m), q = -dot(s, m), xa = dot(s, w), xb = -dot(m, w);
  const T det = larger(floor20, T(cc * aa - q * q));
  EdgeClosest<T> out;
  out.weight_m = clamp01(T((xa * q - xb * aa) / det));
  out.weight_s = clamp01(T(-(xa + out.weight_m * q) / larger(aa, floor20)));
  out.weight_m = clamp01(T(-(xb + out.weight_s * q) / larger(cc, floor20)));
  const T rest_s = T(1) - out.weight_s, rest_m = T(1) - out.weight_m;
  // Summed from left to right as in the solver: this order decides pairs at the gap.
  out.vector = out.weight_s * s1 + rest_s * s2 - out.weight_m * m1 - rest_m * m2;
  out.distance_squared = dot(out.vector, out.vector);
  out.distance = square_root(out.distance_squared);
  return out;
}

// Quotient clamped to [0,1]; divides only if the result is inside; 0/0 gives 0.
template <class T>
T clamped_ratio(const T& numerator, const T& denominator) {
  if (numerator <= T(0)) return T(0);
  if (numerator >= denominator) return T(1);
  return numerator / denominator;
}

// Two edges, scaled into range.
template <class T>
EdgeClosest<T> scaled_edges(const Point3<T>& s1, const Point3<T>& s2, const Point3<T>& m1,
                            const Point3<T>& m2) {
  // Points s2 - hs*s and m2 - hm*m; h is the weight of the first node.
  const Point3<T> s = s2 - s1, m = m2 - m1, w = m2 - s2;
  const T aa = dot(s, s), cc = dot(m, m), q = dot(s, m);
  const Point3<T> n = cross(s, m);
  const T nn = dot(n, n);
  EdgeClosest<T> out;
  if (nn > NumberTraits<T>::parallel_guard() * aa * cc) {
    // Lines: w + hs*s - hm*m is parallel to n. Clamp, then project back and forth once: exact
    // unless parallel, and insensitive to round-off of hm for nearly parallel edges.
    const T hm = clamped_ratio(T(dot(n, cross(s, w))), nn);
    out.weight_s = clamped_ratio(T(hm * q - dot(s, w)), aa);
    out.weight_m = clamped_ratio(T(out.weight_s * q + dot(m, w)), cc);
    const T hs = clamped_ratio(T(out.weight_m * q - dot(s, w)), aa);
    out.weight_s = hs;
  } else if (!(aa > T(0)) || !(cc > T(0))) {
    out.weight_s = clamped_ratio(T(-dot(s, w)), aa);
    out.weight_m = clamped_ratio(T(out.weight_s * q + dot(m, w)), cc);
  } else {
    // Parallel: ends of M on S, as weight of s1; overlap with [0,1].
    const T at_m2 = -dot(s, w) / aa;
    const T at_m1 = at_m2 + q / aa;
    const T low = larger(T(0), smaller(at_m1, at_m2));
    const T high = smaller(T(1), larger(at_m1, at_m2));
    out.parallel = low < high;
    out.weight_s = clamp01(T(T(0.5) * (low + high)));
    if (!(low < high)) out.weight_s = high < T(0.5) ? T(0) : T(1);
    out.weight_m = clamped_ratio(T(out.weight_s * q + dot(m, w)), cc);
  }
  out.vector = out.weight_m * m - out.weight_s * s - w;
  if (out.parallel) {
    const Point3<T> moment = cross(s, w);
    out.vector = T(T(1) / aa) * cross(s, moment);
  }
  out.distance_squared = dot(out.vector, out.vector);
  out.distance = length(out.vector);
  return out;
}

template <class T>
EdgeClosest<T> robust_edges(const Point3<T>& s1, const Point3<T>& s2, const Point3<T>& m1,
                            const Point3<T>& m2) {
  if constexpr (std::is_floating_point_v<T>) {
    T big = largest_component(s2 - s1);
    big = larger(big, larger(largest_component(m2 - m1), largest_component(m2 - s2)));
    if (const int shift = safe_shift(big); shift != 0) {
      EdgeClosest<T> out = scaled_edges(shifted(s1, shift), shifted(s2, shift), shifted(m1, shift),
                                        shifted(m2, shift));
      out.vector = shifted(out.vector, -shift);
      out.distance = std::ldexp(out.distance, -shift);
      out.distance_squared = std::ldexp(out.distance_squared, -2 * shift);
      return out;
    }
  }
  return scaled_edges(s1, s2, m1, m2);
}

}  // namespace closest_detail

// Closest point of node `p` on a segment with corners `x` (in order; triangle: x[3] == x[2] and
// `triangle` set).
//
// Form::reference follows the solver operation by operation: the exact closest point unless a
// sub-triangle has area 0 within round-off. Form::robust is the closest point in exact arithmetic;
// scaling the input by a power of two scales the result and changes no decision.
//
//   const auto c = deck::closest_on_segment<deck::Form::reference>(p, corners, false);
//   if (c.distance() < gap) ...
template <Form F, class T>
SegmentClosest<T> closest_on_segment(const Point3<T>& p, const std::array<Point3<T>, 4>& x,
                                     bool triangle) {
  SegmentClosest<T> out;
  if constexpr (F == Form::reference) {
    out.sub = closest_detail::reference_sub_triangles(p, x, triangle);
  } else {
    out.sub = closest_detail::robust_sub_triangles(p, x, triangle);
  }
  for (std::size_t k = 1; k < 4; ++k) {
    const SubTriangleClosest<T>&a = out.sub[k], &b = out.closest();
    if (closest_detail::nearer(a.distance, a.distance_squared, b.distance, b.distance_squared)) {
      out.best = static_cast<int>(k);
    }
  }
  closest_detail::set_weights(out, triangle);
  return out;
}

// Compiled once, in filtered.cpp: of copies in several files the linker kept one that is hardly
// optimised, which cost 8 % of `gaps` (a million shells).
extern template SegmentClosest<double> closest_on_segment<Form::reference>(
    const Point3<double>&, const std::array<Point3<double>, 4>&, bool);
extern template SegmentClosest<double> closest_on_segment<Form::robust>(
    const Point3<double>&, const std::array<Point3<double>, 4>&, bool);

// Penetration of that node for pair gap `gap`. Needs a number type with a square root.
template <class T>
Penetration<T> penetration(const SegmentClosest<T>& closest, const T& gap) {
  using scalar::larger;
  Penetration<T> out;
  for (std::size_t k = 0; k < 4; ++k) {
    const T value = larger(T(0), T(gap - closest.sub[k].distance));
    if (k == 0 || value > out.value) {
      out.value = value;
      out.sub = static_cast<int>(k);
    }
  }
  const SubTriangleClosest<T>& sub = closest.sub[static_cast<std::size_t>(out.sub)];
  out.on_surface = !(sub.distance > T(0));
  if (!out.on_surface) {
    const T factor = T(1) / larger(T(1e-30), sub.distance);
    out.normal = factor * sub.vector;
  }
  return out;
}

// Closest points of edges s1-s2 and m1-m2. Form::reference: one fixed-point sweep with floors
// 1e-20; not always the closest points for nearly parallel edges. Form::robust: the closest points;
// parallel edges meet in the middle of their overlap.
template <Form F, class T>
EdgeClosest<T> closest_between_edges(const Point3<T>& s1, const Point3<T>& s2, const Point3<T>& m1,
                                     const Point3<T>& m2) {
  EdgeClosest<T> out;
  if constexpr (F == Form::reference) {
    out = closest_detail::reference_edges(s1, s2, m1, m2);
  } else {
    out = closest_detail::robust_edges(s1, s2, m1, m2);
  }
  out.feature_s = closest_detail::edge_feature(out.weight_s);
  out.feature_m = closest_detail::edge_feature(out.weight_m);
  return out;
}

}  // namespace deck
