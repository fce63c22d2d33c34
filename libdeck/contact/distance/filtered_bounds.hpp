// Brackets of the exact distance of a pair in double and double-double.
//
// Node-segment and edge-edge ask for the distance of the origin from the convex hull of a few
// points v_k (corner minus node; secondary minus main end). Errors, with unit roundoff u: v_k has
// relative error u per component; a product sum of three to five terms has at most 8u times the sum
// of magnitudes. 16u is used everywhere. Quantities below 2^-500 are not trusted (underflow):
// inputs are scaled so that the largest v_k is between 2^-100 and 2^100.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "contact/shared/dd.hpp"
#include "contact/shared/filtered.hpp"

namespace deck {

// Calls Work::run(arguments...) with all its callees inlined, compiled also for processors with
// fused multiply-add and chosen at run time: double-double then takes half the instructions and
// gives the same bits, because the error of a product is exact either way. Exact proofs are not
// inlined.
template <class Work, class... Arguments>
#if defined(__x86_64__)
[[gnu::target("avx2,fma"), gnu::flatten]]
#endif
auto run_fused(const Arguments&... arguments) {
  return Work::run(arguments...);
}

template <class Work, class... Arguments>
auto fused(const Arguments&... arguments) {
#if defined(__x86_64__)
  static const bool can = __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
  if (can) return run_fused<Work>(arguments...);
#endif
  return Work::run(arguments...);
}

}  // namespace deck

namespace deck::filter {

using scalar::larger;
using scalar::smaller;
using P = Point3<double>;
template <class T>
using Hull = std::array<Point3<T>, 4>;

constexpr double tiny = 0x1p-500, unbounded = std::numeric_limits<double>::infinity();

// 16 times the relative error of one operation.
template <class T>
inline constexpr double safety = 0x1p-49;
template <>
inline constexpr double safety<DoubleDouble> = 0x1p-98;

// Leading double of a number: enough for error bounds, which have a factor of 16 to spare.
inline double head(double a) { return a; }
inline double head(const DoubleDouble& a) { return a.hi(); }

template <class T>
P magnitude_of(const Point3<T>& v) {
  return {std::abs(head(v.x)), std::abs(head(v.y)), std::abs(head(v.z))};
}

template <class T>
P largest_magnitudes(const Hull<T>& v) {
  P out = magnitude_of(v[0]);
  for (std::size_t k = 1; k < 4; ++k) {
    const P m = magnitude_of(v[k]);
    out = {larger(out.x, m.x), larger(out.y, m.y), larger(out.z, m.z)};
  }
  return out;
}

// True if the gap's square, and its product with a usable square, are normal numbers.
inline bool can_be_squared(double gap) { return gap > 0x1p-200 && gap < 0x1p250; }

// Four support values w.(-v_k) and their round-off.
template <class T>
struct Support {
  std::array<T, 4> value;
  T squared;  // length of w
  double error;
  bool usable;

  Support(const Point3<T>& w, const Hull<T>& v, const P& largest) {
    for (std::size_t k = 0; k < 4; ++k) value[k] = -dot(w, v[k]);
    error = dot(magnitude_of(w), largest);
    squared = dot(w, w);
    usable = error > tiny && head(squared) > tiny && head(squared) < 1 / tiny;
    error *= safety<T>;
  }
  T least() const { return smaller(smaller(value[0], value[1]), smaller(value[2], value[3])); }
  // For points k, k+1 and the mean of all.
  T least(std::size_t k) const {
    const T mean = T(0.25) * ((value[0] + value[2]) + (value[1] + value[3]));
    return smaller(smaller(value[k], value[(k + 1) % 4]), mean);
  }
  // Lower bound of the distance to points whose smallest value is `smallest`.
  T bound(const T& smallest) const {
    using std::sqrt;
    if (!usable || !(head(smallest) > error)) return T(0);
    return (smallest - T(error)) / sqrt(squared) * (T(1) - T(safety<T>));
  }
  // True only if that distance is at least `gap`. Compares squares: no root, no quotient.
  bool is_apart(const T& smallest, double gap) const {
    if (!usable || !(head(smallest) > error)) return false;
    if (!can_be_squared(gap)) return bound(smallest) >= T(gap);
    const T m = smallest - T(error);
    return m * m * (T(1) - T(2 * safety<T>)) >= T(gap) * T(gap) * squared;
  }
  bool is_apart(double gap) const { return is_apart(least(), gap); }
};

// The point with given weights (their sum may be off), and its error.
template <class T>
struct WeightedPoint {
  Point3<T> r{T(0), T(0), T(0)};
  T sum{0.0};
  double error = 0.0;
  bool usable = false;

  WeightedPoint(const std::array<T, 4>& weights, const Hull<T>& v) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double w = head(weights[k]);
      if (!(w >= 0.0)) return;
      if (w == 0.0) continue;
      r = r + weights[k] * v[k];
      const P m = magnitude_of(v[k]);
      error += w * (m.x + m.y + m.z);
      sum = sum + weights[k];
    }
    error = safety<T> * error + tiny;
    usable = head(sum) > 0.5 && head(sum) < 2.0;
  }
  // Upper bound of the distance.
  T bound() const {
    using std::sqrt;
    if (!usable) return T(unbounded);
    return (sqrt(dot(r, r)) + T(error)) / sum * (T(1) + T(safety<T>));
  }
  // True only if the distance is below `gap`.
  bool is_closer(double gap) const {
    if (!usable) return false;
    if (!can_be_squared(gap)) return bound() < T(gap);
    const T limit = T(gap) * sum - T(error);
    return head(limit) > 0x1p-250 && dot(r, r) * (T(1) + T(2 * safety<T>)) < limit * limit;
  }
};

enum class Answer : std::uint8_t { no, yes, unknown };

// Input points scaled exactly by a power of two.
struct Scaled {
  int shift = 0;
  bool possible = true;
  template <std::size_t N>
  static Scaled of(std::array<P, N>& points, double big) {
    Scaled out;
    if (big >= 0x1p-100 && big <= 0x1p100) return out;
    out.shift = big < unbounded ? -std::ilogb(big) : -1026;
    for (P& q : points) {
      for (double* c : {&q.x, &q.y, &q.z}) {
        const double y = std::ldexp(*c, out.shift);
        out.possible &= std::isfinite(y) && std::ldexp(y, -out.shift) == *c;
        *c = y;
      }
    }
    return out;
  }
  // The gap in this scale; nothing if digits are lost.
  std::optional<double> gap(double value) const {
    if (!possible) return std::nullopt;
    if (shift == 0) return value;
    const double scaled = std::ldexp(value, shift);
    if (!std::isfinite(scaled)) return unbounded;
    if (std::ldexp(scaled, -shift) != value) return std::nullopt;
    return scaled;
  }
};

template <class T>
Point3<T> lift(const P& a) {
  return {T(a.x), T(a.y), T(a.z)};
}

inline double largest_of(const P& v) { return larger(v.x, larger(v.y, v.z)); }

// --- node and segment -----------------------------------------------------------------------

// Corners, then the node; corner 4 of a triangle is corner 3.
inline std::array<P, 5> points_of(const P& p, const std::array<P, 4>& x, bool triangle) {
  return {x[0], x[1], x[2], triangle ? x[2] : x[3], p};
}

struct SegmentPair {
  std::array<P, 5> points;  // corners, node
  bool triangle = false;
  Hull<double> v;
  P largest;

  SegmentPair(const P& p, const std::array<P, 4>& x, bool is_triangle)
      : points(points_of(p, x, is_triangle)), triangle(is_triangle) {
    refresh();
  }
  void refresh() {
    for (std::size_t k = 0; k < 4; ++k) v[k] = points[k] - points[4];
    largest = largest_magnitudes(v);
  }
  std::array<P, 4> corners() const { return {points[0], points[1], points[2], points[3]}; }
  template <class T>
  Hull<T> hull_of() const {
    Hull<T> out;
    for (std::size_t k = 0; k < 4; ++k) out[k] = lift<T>(points[k]) - lift<T>(points[4]);
    return out;
  }
  // First with the parts found in double, then with all parts.
  static constexpr std::array guided{true, false};
};

inline SegmentClosest<double> closest_of(const SegmentPair& pair) {
  return closest_on_segment<Form::robust>(pair.points[4], pair.corners(), pair.triangle);
}
// Answer that these closest points prove.
template <class T>
Answer answer_of(const SegmentClosest<T>& c, const Hull<T>& v, const P& largest, bool triangle,
                 double gap) {
  if (WeightedPoint<T>(c.weights, v).is_closer(gap)) return Answer::yes;
  const Support<T> best(c.closest().vector, v, largest);
  if (best.is_apart(gap)) return Answer::no;
  if (triangle) return Answer::unknown;
  for (std::size_t k = 0; k < 4; ++k) {
    if (best.is_apart(best.least(k), gap)) continue;
    if (k == static_cast<std::size_t>(c.best)) return Answer::unknown;
    const Support<T> own(c.sub[k].vector, v, largest);
    if (!own.is_apart(own.least(k), gap)) return Answer::unknown;
  }
  return Answer::no;
}

// Distances and gaps so small beside the pair are double-double's own round-off.
inline bool beyond_double_double(double length, double largest) {
  return length < safety<DoubleDouble> * largest;
}

// Two cheap directions that often prove the distance without closest points: the normal of the
// diagonals, and from the middle to the node.
inline bool clearly_apart(const SegmentPair& pair, double gap) {
  const Hull<double>& v = pair.v;
  const P middle = (v[0] + v[2]) + (v[1] + v[3]);
  P n = cross(v[2] - v[0], v[3] - v[1]);
  if (dot(n, middle) > 0.0) n = -n;
  if (Support<double>(n, v, pair.largest).is_apart(gap)) return true;
  return Support<double>(-middle, v, pair.largest).is_apart(gap);
}

// Double-double closest point of one sub-triangle on the part found in double, which saves most of
// the work. With a wrong part the bounds decide nothing.
inline SubTriangleClosest<DoubleDouble> guided_sub_triangle(
    const SubTriangleClosest<double>& hint, const Point3<DoubleDouble>& vo,
    const Point3<DoubleDouble>& va, const Point3<DoubleDouble>& vb, const Point3<DoubleDouble>& a,
    const Point3<DoubleDouble>& b, const Point3<DoubleDouble>& e) {
  using T = DoubleDouble;
  const bool has_o = hint.weight_o > 0.0, has_a = hint.weight_a > 0.0, has_b = hint.weight_b > 0.0;
  SubTriangleClosest<T> out;
  if (has_o && has_a && has_b) {
    const Point3<T> n = cross(a, b);
    const T fa = dot(n, cross(b, vo)), fb = dot(n, cross(vo, a)), nn = dot(n, n);
    const T height = -dot(n, vo), scale = T(1) / nn;
    out.weight_a = scale * fa;
    out.weight_b = scale * fb;
    out.weight_o = T(1) - out.weight_a - out.weight_b;
    out.vector = height < T(0) ? -n : n;
    out.distance = abs(height) / sqrt(nn);
    return out;
  }
  const auto edge = [&out](const Point3<T>& u, const Point3<T>& v, const Point3<T>& along,
                           T& weight_u, T& weight_v) {
    const auto point = closest_detail::closest_on_edge(u, v, along);
    weight_u = T(1) - point.t;
    weight_v = point.t;
    out.vector = point.vector;
    out.distance = point.distance;
  };
  if (has_a && has_b) {
    edge(va, vb, e, out.weight_a, out.weight_b);
  } else if (has_o && has_b) {
    edge(vo, vb, b, out.weight_o, out.weight_b);
  } else if (has_o && has_a) {
    edge(vo, va, a, out.weight_o, out.weight_a);
  } else {
    (has_a ? out.weight_a : has_b ? out.weight_b : out.weight_o) = T(1);
    out.vector = -(has_a ? va : has_b ? vb : vo);
    out.distance = deck::length(out.vector);
  }
  return out;
}

// Double-double closest points of the sub-triangles that can have it; the others keep infinity.
inline SegmentClosest<DoubleDouble> wide_closest(const SegmentPair& pair,
                                                 const SegmentClosest<double>& narrow,
                                                 const Hull<DoubleDouble>& v, bool guided) {
  using T = DoubleDouble;
  SegmentClosest<T> out;
  const auto sub = [&](const SubTriangleClosest<double>& hint, const auto&... vectors) {
    return guided ? guided_sub_triangle(hint, vectors...)
                  : closest_detail::robust_sub_triangle(vectors...);
  };
  const auto x = [&](std::size_t k) { return lift<T>(pair.points[k]); };
  if (pair.triangle) {
    out.sub[0] = sub(narrow.sub[0], v[2], v[0], v[1], x(0) - x(2), x(1) - x(2), x(1) - x(0));
    closest_detail::set_weights(out, true);
    return out;
  }
  const double high = WeightedPoint<double>(narrow.weights, pair.v).bound();
  const Point3<T> vo = T(0.25) * ((v[0] + v[2]) + (v[1] + v[3]));
  bool first = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    out.sub[k].distance = T(unbounded);
    out.sub[k].vector = lift<T>(narrow.sub[k].vector);
    const Support<double> own(narrow.sub[k].vector, pair.v, pair.largest);
    if (own.bound(own.least(k)) > high) continue;
    out.sub[k] = sub(narrow.sub[k], vo, v[k], v[next], v[k] - vo, v[next] - vo, x(next) - x(k));
    if (first || out.sub[k].distance < out.distance()) out.best = static_cast<int>(k);
    first = false;
  }
  closest_detail::set_weights(out, false);
  // A guided point outside its sub-triangle is no point of the segment and bounds nothing.
  const SubTriangleClosest<T>& best = out.closest();
  if (!(best.weight_o >= T(0) && best.weight_a >= T(0) && best.weight_b >= T(0)))
    out.weights[0] = T(-1);
  return out;
}

// --- two edges ------------------------------------------------------------------------------

struct EdgePair {
  std::array<P, 4> points;  // s1, s2, m1, m2
  Hull<double> v;           // s1-m1, s1-m2, s2-m2, s2-m1
  P largest;

  explicit EdgePair(const std::array<P, 4>& x) : points(x) { refresh(); }
  void refresh() {
    v = hull_of<double>();
    largest = largest_magnitudes(v);
  }
  template <class T>
  Hull<T> hull_of() const {
    const Point3<T> s1 = lift<T>(points[0]), s2 = lift<T>(points[1]), m1 = lift<T>(points[2]),
                    m2 = lift<T>(points[3]);
    return {s1 - m1, s1 - m2, s2 - m2, s2 - m1};
  }
  static constexpr bool triangle = false;
  static constexpr std::array guided{true};
};

template <class T>
std::array<T, 4> hull_weights(const EdgeClosest<T>& c) {
  const T rest_s = T(1) - c.weight_s, rest_m = T(1) - c.weight_m;
  return {c.weight_s * c.weight_m, c.weight_s * rest_m, rest_s * rest_m, rest_s * c.weight_m};
}

// The vector points from main to secondary, like v_k: the support needs its negative.
template <class T>
Answer answer_of(const EdgeClosest<T>& c, const Hull<T>& v, const P& largest, bool, double gap) {
  if (WeightedPoint<T>(hull_weights(c), v).is_closer(gap)) return Answer::yes;
  return Support<T>(-c.vector, v, largest).is_apart(gap) ? Answer::no : Answer::unknown;
}

inline bool clearly_apart(const EdgePair& pair, double gap) {
  const Hull<double>& v = pair.v;
  const P middle = (v[0] + v[2]) + (v[1] + v[3]);
  P n = cross(pair.points[1] - pair.points[0], pair.points[3] - pair.points[2]);
  if (dot(n, middle) > 0.0) n = -n;
  if (Support<double>(n, v, pair.largest).is_apart(gap)) return true;
  return Support<double>(-middle, v, pair.largest).is_apart(gap);
}

inline EdgeClosest<double> closest_of(const EdgePair& pair) {
  const auto& x = pair.points;
  return closest_between_edges<Form::robust>(x[0], x[1], x[2], x[3]);
}

inline EdgeClosest<DoubleDouble> wide_closest(const EdgePair& pair, const EdgeClosest<double>&,
                                              const Hull<DoubleDouble>&, bool) {
  const auto x = [&](std::size_t k) { return lift<DoubleDouble>(pair.points[k]); };
  return closest_between_edges<Form::robust>(x(0), x(1), x(2), x(3));
}

inline void count(FilterCounters* counters, FilterStage stage) {
  if (counters == nullptr) return;
  ++counters->pairs;
  counters->double_double += stage != FilterStage::double_precision;
  counters->exact += stage == FilterStage::exact;
}

// Corners of each sub-triangle with its closest point; none for those ruled out in double.
template <class T>
std::array<PartGuess, 4> guesses(const SegmentClosest<T>& c) {
  std::array<PartGuess, 4> out;
  for (std::size_t k = 0; k < 4; ++k) {
    const T zero(0.0);
    const auto& sub = c.sub[k];
    out[k] = {sub.weight_o > zero, sub.weight_a > zero, sub.weight_b > zero};
  }
  return out;
}

inline Answer proved(std::optional<bool> closer) {
  if (!closer) return Answer::unknown;
  return *closer ? Answer::yes : Answer::no;
}

// --- one piece of a pair ----------------------------------------------------------------------

// Distance of a pair from the plane, line or corner that double found closest, by a few
// double-double operations. Decides most pairs that double leaves open.
//
// For any point q of that plane or line: squared distance = |q|^2 minus the square of q's part
// along it. That part is small of second order, so double suffices for it. It is the distance of
// the pair if all other vertices lie beyond the plane through the closest point across its
// direction; this is proved in double, with room for round-off.

// Bracket of the squared distance.
struct PieceDistance {
  DoubleDouble squared;
  double error = 0.0;  // bound of |exact square - squared|
  SegmentPiece piece;  // the closest piece; not for edges
  Answer closer_than(double gap) const;
};

// `c`: result in double. Nothing if the proof fails.
std::optional<PieceDistance> piece_distance(const SegmentPair& pair,
                                            const SegmentClosest<double>& c);
std::optional<PieceDistance> piece_distance(const EdgePair& pair, const EdgeClosest<double>& c);

}  // namespace deck::filter
