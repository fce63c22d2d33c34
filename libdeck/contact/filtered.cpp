// Filtered distances: brackets of the exact distance in double and double-double, else rationals.
//
// Node-segment and edge-edge are the same question: how far is the origin from the convex hull of
// a few points v_k (corner minus node; secondary minus main end). Error terms, with u the rounding
// unit: v_k has relative error u per component; a product sum of three to five terms then has at
// most 8u times the sum of magnitudes. 16u is used throughout. Quantities below 2^-500 are never
// believed (they may have lost digits to underflow): inputs are scaled so that the largest v_k is
// between 2^-100 and 2^100.
#include "deck/contact/filtered.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "contact/dd.hpp"
#include "contact/exact.hpp"
#include "contact/filtered_exact.hpp"

namespace deck {
namespace {

using closest_detail::larger;
using closest_detail::smaller;
using P = Point3<double>;
template <class T>
using Hull = std::array<Point3<T>, 4>;

constexpr double kTiny = 0x1p-500, kInfinity = std::numeric_limits<double>::infinity();

// 16 times a bound of the relative error of one operation.
template <class T>
constexpr double kSlack = 0x1p-49;
template <>
constexpr double kSlack<DoubleDouble> = 0x1p-98;

template <class T>
Point3<T> magnitude_of(const Point3<T>& v) {
  return {closest_detail::absolute_value(v.x), closest_detail::absolute_value(v.y),
          closest_detail::absolute_value(v.z)};
}

template <class T>
Point3<T> largest_magnitudes(const Hull<T>& v) {
  Point3<T> out = magnitude_of(v[0]);
  for (std::size_t k = 1; k < 4; ++k) {
    const Point3<T> m = magnitude_of(v[k]);
    out = {larger(out.x, m.x), larger(out.y, m.y), larger(out.z, m.z)};
  }
  return out;
}

// The four support values w.(-v_k) and what to take off them for round-off.
template <class T>
struct Support {
  std::array<T, 4> value;
  T error, length;  // length of w
  bool usable;

  Support(const Point3<T>& w, const Hull<T>& v, const Point3<T>& largest) {
    using std::sqrt;
    for (std::size_t k = 0; k < 4; ++k) value[k] = -dot(w, v[k]);
    error = dot(magnitude_of(w), largest);
    const T squared = dot(w, w);
    usable = error > T(kTiny) && squared > T(kTiny) && squared < T(1 / kTiny);
    error = T(kSlack<T>) * error;
    length = sqrt(squared);
  }
  T bound(const T& least) const {
    if (!usable || !(least > error)) return T(0);
    return (least - error) / length * (T(1) - T(kSlack<T>));
  }
  // Lower bound of the distance to the hull of all four points.
  T hull() const {
    return bound(smaller(smaller(value[0], value[1]), smaller(value[2], value[3])));
  }
  // Lower bound of the distance to the sub-triangle of points k, k+1 and the mean of all.
  T sub_triangle(std::size_t k) const {
    const T mean = T(0.25) * ((value[0] + value[2]) + (value[1] + value[3]));
    return bound(smaller(smaller(value[k], value[(k + 1) % 4]), mean));
  }
};

// Upper bound of the distance: the length of the point with these weights.
template <class T>
T upper_bound(const std::array<T, 4>& weights, const Hull<T>& v) {
  using std::sqrt;
  Point3<T> r{T(0), T(0), T(0)};
  T sum(0), size(0);
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(weights[k] >= T(0))) return T(kInfinity);
    r = r + weights[k] * v[k];
    const Point3<T> m = magnitude_of(v[k]);
    size = size + weights[k] * (m.x + m.y + m.z);
    sum = sum + weights[k];
  }
  if (!(sum > T(0.5) && sum < T(2))) return T(kInfinity);
  const T length = sqrt(dot(r, r));
  const T high = (length + T(kSlack<T>) * size + T(kTiny)) / sum;
  return high * (T(1) + T(kSlack<T>));
}

enum class Answer : std::uint8_t { no, yes, unknown };

template <class T>
Answer compare(const T& low, const T& high, double gap) {
  if (high < T(gap)) return Answer::yes;
  return low >= T(gap) ? Answer::no : Answer::unknown;
}

template <std::size_t N>
bool all_finite(const std::array<P, N>& points) {
  for (const P& q : points)
    if (!std::isfinite(q.x) || !std::isfinite(q.y) || !std::isfinite(q.z)) return false;
  return true;
}

// Five (four) input points brought to a harmless size by a power of two, exactly.
struct Scaled {
  int shift = 0;
  bool possible = true;
  template <std::size_t N>
  static Scaled of(std::array<P, N>& points, double big) {
    Scaled out;
    if (big >= 0x1p-100 && big <= 0x1p100) return out;
    out.shift = big < kInfinity ? -std::ilogb(big) : -1026;
    for (P& q : points) {
      for (double* c : {&q.x, &q.y, &q.z}) {
        const double y = std::ldexp(*c, out.shift);
        out.possible &= std::isfinite(y) && std::ldexp(y, -out.shift) == *c;
        *c = y;
      }
    }
    return out;
  }
  // The gap at the same scale; nothing if digits are lost.
  std::optional<double> gap(double value) const {
    if (!possible) return std::nullopt;
    if (shift == 0) return value;
    const double scaled = std::ldexp(value, shift);
    if (!std::isfinite(scaled)) return kInfinity;
    if (std::ldexp(scaled, -shift) != value) return std::nullopt;
    return scaled;
  }
};

template <class T>
Point3<T> lift(const P& a) {
  return {T(a.x), T(a.y), T(a.z)};
}

double largest_of(const P& v) { return larger(v.x, larger(v.y, v.z)); }

// --- node and segment -----------------------------------------------------------------------

// Corners, then the node; a triangle's fourth corner is its third.
std::array<P, 5> points_of(const P& p, const std::array<P, 4>& x, bool triangle) {
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
};

// Lower bound from the vectors of the sub-triangles: first one for all four, then each on its own.
template <class T>
T lower_bound(const SegmentClosest<T>& c, const Hull<T>& v, const Point3<T>& largest,
              bool triangle) {
  const Support<T> best(c.closest().vector, v, largest);
  const T hull = best.hull();
  if (triangle) return hull;
  T low = best.sub_triangle(static_cast<std::size_t>(c.best));
  for (std::size_t k = 0; k < 4 && hull < low; ++k) {
    if (k == static_cast<std::size_t>(c.best)) continue;
    T other = best.sub_triangle(k);
    if (other < low) other = larger(other, Support<T>(c.sub[k].vector, v, largest).sub_triangle(k));
    low = smaller(low, other);
  }
  return larger(hull, low);
}

// Two cheap directions that often prove the distance without any closest point: the normal of the
// diagonals, and from the middle to the node.
bool clearly_apart(const SegmentPair& pair, double gap) {
  const Hull<double>& v = pair.v;
  const P middle = (v[0] + v[2]) + (v[1] + v[3]);
  P n = cross(v[2] - v[0], v[3] - v[1]);
  if (dot(n, middle) > 0.0) n = -n;
  if (Support<double>(n, v, pair.largest).hull() >= gap) return true;
  return Support<double>(-middle, v, pair.largest).hull() >= gap;
}

// Double-double closest point of one sub-triangle where the double result tells on which part it
// lies: most of the work is finding that out. A wrong part gives bounds that decide nothing.
SubTriangleClosest<DoubleDouble> guided_sub_triangle(
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
    out.distance = closest_detail::length(out.vector);
  }
  return out;
}

// Double-double closest point of those sub-triangles that can hold it; the others keep the
// distance infinity.
SegmentClosest<DoubleDouble> wide_closest(const SegmentPair& pair,
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
    closest_detail::classify(out, true);
    return out;
  }
  const double high = upper_bound(narrow.weights, pair.v);
  const Point3<T> vo = T(0.25) * ((v[0] + v[2]) + (v[1] + v[3]));
  bool first = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    out.sub[k].distance = T(kInfinity);
    out.sub[k].vector = lift<T>(narrow.sub[k].vector);
    if (Support<double>(narrow.sub[k].vector, pair.v, pair.largest).sub_triangle(k) > high)
      continue;
    out.sub[k] = sub(narrow.sub[k], vo, v[k], v[next], v[k] - vo, v[next] - vo, x(next) - x(k));
    if (first || out.sub[k].distance < out.distance()) out.best = static_cast<int>(k);
    first = false;
  }
  closest_detail::classify(out, false);
  return out;
}

template <class T>
Hull<T> wide_hull(const SegmentPair& pair) {
  Hull<T> v;
  for (std::size_t k = 0; k < 4; ++k) v[k] = lift<T>(pair.points[k]) - lift<T>(pair.points[4]);
  return v;
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
};

template <class T>
std::array<T, 4> hull_weights(const EdgeClosest<T>& c) {
  const T rest_s = T(1) - c.weight_s, rest_m = T(1) - c.weight_m;
  return {c.weight_s * c.weight_m, c.weight_s * rest_m, rest_s * rest_m, rest_s * c.weight_m};
}

// The vector points from the main to the secondary edge, like the v_k: the support wants -vector.
template <class T>
T lower_bound(const EdgeClosest<T>& c, const Hull<T>& v, const Point3<T>& largest) {
  return Support<T>(-c.vector, v, largest).hull();
}

bool clearly_apart(const EdgePair& pair, double gap) {
  const Hull<double>& v = pair.v;
  const P middle = (v[0] + v[2]) + (v[1] + v[3]);
  P n = cross(pair.points[1] - pair.points[0], pair.points[3] - pair.points[2]);
  if (dot(n, middle) > 0.0) n = -n;
  if (Support<double>(n, v, pair.largest).hull() >= gap) return true;
  return Support<double>(-middle, v, pair.largest).hull() >= gap;
}

EdgeClosest<double> closest_of(const EdgePair& pair) {
  const auto& x = pair.points;
  return closest_between_edges<Form::robust>(x[0], x[1], x[2], x[3]);
}

EdgeClosest<DoubleDouble> wide_closest(const EdgePair& pair) {
  const auto x = [&](std::size_t k) { return lift<DoubleDouble>(pair.points[k]); };
  return closest_between_edges<Form::robust>(x(0), x(1), x(2), x(3));
}

void count(FilterCounters* counters, FilterStage stage) {
  if (counters == nullptr) return;
  ++counters->pairs;
  counters->double_double += stage != FilterStage::double_precision;
  counters->exact += stage == FilterStage::exact;
}

// The double that both ends of the bracket round to, back at the original scale.
std::optional<double> rounded(const DoubleDouble& low, const DoubleDouble& high, int shift) {
  if (low.hi() != high.hi() || !(low.hi() > 0.0)) return std::nullopt;
  const double value = std::ldexp(low.hi(), -shift);
  if (!std::isnormal(value)) return std::nullopt;
  return value;
}

// The corners of each sub-triangle that carry its closest point; none for those that were ruled
// out in double.
std::array<PartGuess, 4> guesses(const SegmentClosest<DoubleDouble>& c) {
  std::array<PartGuess, 4> out;
  for (std::size_t k = 0; k < 4; ++k) {
    const DoubleDouble zero(0.0);
    const auto& sub = c.sub[k];
    out[k] = {sub.weight_o > zero, sub.weight_a > zero, sub.weight_b > zero};
  }
  return out;
}

Answer proved(std::optional<bool> closer) {
  if (!closer) return Answer::unknown;
  return *closer ? Answer::yes : Answer::no;
}

}  // namespace

bool is_closer_than(const P& p, const std::array<P, 4>& corners, bool triangle, double gap,
                    FilterCounters* counters) {
  if (!(gap > 0.0)) return count(counters, FilterStage::double_precision), false;
  if (gap == kInfinity) return count(counters, FilterStage::double_precision), true;
  SegmentPair pair(p, corners, triangle);
  const double big = largest_of(pair.largest);
  FilterStage stage = FilterStage::double_precision;
  Answer answer = big == 0.0 ? Answer::yes : Answer::unknown;
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  const std::optional<double> limit = scaled.gap(gap);
  if (answer == Answer::unknown && limit) {
    if (clearly_apart(pair, *limit)) return count(counters, stage), false;
    const auto c = closest_on_segment<Form::robust>(pair.points[4], pair.corners(), triangle);
    answer = upper_bound(c.weights, pair.v) < *limit ? Answer::yes : Answer::unknown;
    if (answer == Answer::unknown && lower_bound(c, pair.v, pair.largest, triangle) >= *limit)
      answer = Answer::no;
    if (answer == Answer::unknown) {
      stage = FilterStage::double_double;
      const auto v = wide_hull<DoubleDouble>(pair);
      const auto largest = largest_magnitudes(v);
      auto w = wide_closest(pair, c, v, true);
      answer = compare(lower_bound(w, v, largest, triangle), upper_bound(w.weights, v), *limit);
      if (answer == Answer::unknown) {
        w = wide_closest(pair, c, v, false);
        answer = compare(lower_bound(w, v, largest, triangle), upper_bound(w.weights, v), *limit);
      }
      if (answer == Answer::unknown) {
        stage = FilterStage::exact;
        answer = proved(prove_closer(pair.points, triangle, w.best, guesses(w), *limit));
      }
    }
  }
  if (answer == Answer::unknown) {
    stage = FilterStage::exact;
    const bool closer = all_finite(points_of(p, corners, triangle)) &&
                        exact_compare_distance(p, corners, triangle, gap) < 0;
    answer = closer ? Answer::yes : Answer::no;
  }
  count(counters, stage);
  return answer == Answer::yes;
}

bool is_closer_than(const P& s1, const P& s2, const P& m1, const P& m2, double gap,
                    FilterCounters* counters) {
  if (!(gap > 0.0)) return count(counters, FilterStage::double_precision), false;
  if (gap == kInfinity) return count(counters, FilterStage::double_precision), true;
  EdgePair pair({s1, s2, m1, m2});
  const double big = largest_of(pair.largest);
  FilterStage stage = FilterStage::double_precision;
  Answer answer = big == 0.0 ? Answer::yes : Answer::unknown;
  const Scaled scaled = big == 0.0 ? Scaled{} : Scaled::of(pair.points, big);
  if (scaled.shift != 0) pair.refresh();
  const std::optional<double> limit = scaled.gap(gap);
  if (answer == Answer::unknown && limit) {
    if (clearly_apart(pair, *limit)) return count(counters, stage), false;
    const auto c = closest_of(pair);
    answer =
        compare(lower_bound(c, pair.v, pair.largest), upper_bound(hull_weights(c), pair.v), *limit);
    if (answer == Answer::unknown) {
      stage = FilterStage::double_double;
      const auto v = pair.hull_of<DoubleDouble>();
      const auto w = wide_closest(pair);
      answer = compare(lower_bound(w, v, largest_magnitudes(v)), upper_bound(hull_weights(w), v),
                       *limit);
      if (answer == Answer::unknown) {
        stage = FilterStage::exact;
        answer = proved(prove_closer(pair.points, w.feature_s, w.feature_m, w.parallel, *limit));
      }
    }
  }
  if (answer == Answer::unknown) {
    stage = FilterStage::exact;
    const bool closer = all_finite(std::array<P, 4>{s1, s2, m1, m2}) &&
                        exact_compare_distance(s1, s2, m1, m2, gap) < 0;
    answer = closer ? Answer::yes : Answer::no;
  }
  count(counters, stage);
  return answer == Answer::yes;
}

bool is_touching(const P& p, const std::array<P, 4>& corners, bool triangle) {
  // Nearer than the smallest number: not nearer in double is an answer for nearly all pairs.
  SegmentPair pair(p, corners, triangle);
  if (clearly_apart(pair, std::numeric_limits<double>::denorm_min())) return false;
  return filtered_closest_on_segment(p, corners, triangle).distance == 0.0 &&
         exact_compare_distance(p, corners, triangle, 0.0) == 0;
}

bool is_touching(const P& s1, const P& s2, const P& m1, const P& m2) {
  EdgePair pair({s1, s2, m1, m2});
  if (clearly_apart(pair, std::numeric_limits<double>::denorm_min())) return false;
  return filtered_closest_between_edges(s1, s2, m1, m2).distance == 0.0 &&
         exact_compare_distance(s1, s2, m1, m2, 0.0) == 0;
}

FilteredSegment filtered_closest_on_segment(const P& p, const std::array<P, 4>& corners,
                                            bool triangle, FilterCounters* counters) {
  FilteredSegment out;
  SegmentPair pair(p, corners, triangle);
  const double big = largest_of(pair.largest);
  const Scaled scaled = big == 0.0 ? Scaled{0, false} : Scaled::of(pair.points, big);
  if (scaled.possible) {
    if (scaled.shift != 0) pair.refresh();
    const auto c = closest_on_segment<Form::robust>(pair.points[4], pair.corners(), triangle);
    const auto v = wide_hull<DoubleDouble>(pair);
    const auto largest = largest_magnitudes(v);
    const auto round_once = [&](const SegmentClosest<DoubleDouble>& w) {
      return rounded(lower_bound(w, v, largest, triangle), upper_bound(w.weights, v), scaled.shift);
    };
    auto w = wide_closest(pair, c, v, true);
    auto value = round_once(w);
    if (!value) {
      w = wide_closest(pair, c, v, false);
      value = round_once(w);
    }
    if (value) {
      out.distance = *value;
      out.feature = w.feature;
      out.feature_index = w.feature_index;
      for (std::size_t k = 0; k < 4; ++k) out.weights[k] = w.weights[k].hi();
      count(counters, out.stage);
      return out;
    }
    if (prove_closer(pair.points, triangle, w.best, guesses(w), 0.0).value_or(false)) {
      for (std::size_t k = 0; k < 4; ++k) out.weights[k] = w.weights[k].hi();
      out = {0.0, w.feature, w.feature_index, out.weights, FilterStage::exact};
      count(counters, out.stage);
      return out;
    }
  }
  if (!all_finite(points_of(p, corners, triangle))) {
    out.distance = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  const ExactSegment e = exact_closest_on_segment(p, corners, triangle);
  out = {e.distance, e.feature, e.feature_index, e.weights, FilterStage::exact};
  count(counters, out.stage);
  return out;
}

FilteredEdges filtered_closest_between_edges(const P& s1, const P& s2, const P& m1, const P& m2,
                                             FilterCounters* counters) {
  FilteredEdges out;
  EdgePair pair({s1, s2, m1, m2});
  const double big = largest_of(pair.largest);
  const Scaled scaled = big == 0.0 ? Scaled{0, false} : Scaled::of(pair.points, big);
  if (scaled.possible) {
    if (scaled.shift != 0) pair.refresh();
    const auto v = pair.hull_of<DoubleDouble>();
    const auto w = wide_closest(pair);
    const auto value = rounded(lower_bound(w, v, largest_magnitudes(v)),
                               upper_bound(hull_weights(w), v), scaled.shift);
    if (value) {
      out = {*value,      w.weight_s.hi(), w.weight_m.hi(),
             w.feature_s, w.feature_m,     FilterStage::double_double};
      count(counters, out.stage);
      return out;
    }
    if (prove_closer(pair.points, w.feature_s, w.feature_m, w.parallel, 0.0).value_or(false)) {
      out = {0.0, w.weight_s.hi(), w.weight_m.hi(), w.feature_s, w.feature_m, FilterStage::exact};
      count(counters, out.stage);
      return out;
    }
  }
  if (!all_finite(std::array<P, 4>{s1, s2, m1, m2})) {
    out.distance = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  const ExactEdges e = exact_closest_between_edges(s1, s2, m1, m2);
  out = {e.distance, e.weight_s, e.weight_m, e.feature_s, e.feature_m, FilterStage::exact};
  count(counters, out.stage);
  return out;
}

}  // namespace deck
