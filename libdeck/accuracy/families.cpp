// Generators of hard cases: one family per degenerate shape.
#include <cmath>
#include <utility>

#include "accuracy/shared/accuracy.hpp"

namespace deck {
namespace {

using P = Point3<double>;
using Sample = PairSample;

// SplitMix64: equal numbers everywhere, unlike distributions of the standard library. Draw once per
// expression: compilers may choose the order of operands.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 0x1234567u) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double range(double low, double high) { return low + (high - low) * unit(); }
  double log(double low, double high) { return std::pow(10.0, range(low, high)); }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  int integer(int low, int high) { return low + below(high - low + 1); }
  double sign() { return below(2) == 0 ? -1.0 : 1.0; }
  double signed_log(double low, double high) {
    const double s = sign();
    return s * log(low, high);
  }
  P point(double size = 1.0) {
    return {range(-size, size), range(-size, size), range(-size, size)};
  }
  P integers(int size) {
    const auto one = [&] { return static_cast<double>(integer(-size, size)); };
    const double x = one(), y = one();
    return {x, y, one()};
  }
  P direction() {
    for (;;) {
      const P v = point();
      const double n = deck::length(v);
      if (n > 0.1 && n < 1.0) return (1.0 / n) * v;
    }
  }
  // A vector in any direction, its length swept over decades.
  P step(double low, double high) {
    const double size = log(low, high);
    return size * direction();
  }

 private:
  std::uint64_t state_;
};

P unit_of(const P& v) {
  const double n = deck::length(v);
  return n > 0.0 ? (1.0 / n) * v : P{0, 0, 1};
}
P normal_to(const P& v, SplitMix64& r) { return unit_of(cross(v, r.direction())); }

double distance_of(const Sample& s) {
  if (s.edges) return closest_between_edges<Form::robust>(s.x[0], s.x[1], s.x[2], s.x[3]).distance;
  return closest_on_segment<Form::robust>(s.x[4], s.corners(), s.triangle).distance();
}

// A gap near the distance, at it, one step beside it, or of any size.
void choose_gap(Sample& s, SplitMix64& r) {
  const double d = distance_of(s);
  const P size = s.x[1] - s.x[0];
  const double length = deck::length(size);
  switch (d > 0.0 && std::isfinite(d) ? r.below(6) : 5) {
    case 0:
      s.gap = d;
      break;
    case 1:
      s.gap = std::nextafter(d, 2.0 * d);
      break;
    case 2:
      s.gap = std::nextafter(d, 0.0);
      break;
    case 3:
      s.gap = d * (1.0 + r.signed_log(-17, -10));
      break;
    case 4:
      s.gap = d * (1.0 + r.signed_log(-10, -0.5));
      break;
    default:
      s.gap = (length > 0.0 ? length : 1.0) * r.log(-6, 0);
      break;
  }
  if (!std::isfinite(s.gap)) s.gap = std::numeric_limits<double>::max();
}

Sample segment(const P& a, const P& b, const P& c, const P& d, const P& node) {
  Sample s;
  s.x = {a, b, c, d, node};
  return s;
}
Sample triangle(const P& a, const P& b, const P& c, const P& node) {
  Sample s = segment(a, b, c, c, node);
  s.triangle = true;
  return s;
}
Sample edges(const P& s1, const P& s2, const P& m1, const P& m2) {
  Sample s;
  s.x = {s1, s2, m1, m2, P{}};
  s.edges = true;
  return s;
}

// A node over, beside or far from the triangle, at a height swept over nine decades.
P node_near(const P& a, const P& b, const P& c, SplitMix64& r) {
  const double u = r.range(-0.2, 1.2), v = r.range(-0.2, 1.2);
  const P n = unit_of(cross(b - a, c - a));
  return a + u * (b - a) + v * (c - a) + r.signed_log(-9, 0) * n;
}

// An ordinary quad of size 1 with slight warp, and a node near it.
Sample ordinary_quad(SplitMix64& r) {
  const P o = r.point(), e = r.direction(), f = normal_to(e, r), n = cross(e, f);
  const auto at = [&](double x, double y) {
    const double u = x + r.range(-0.2, 0.2), v = y + r.range(-0.2, 0.2);
    return o + u * e + v * f + r.range(-0.05, 0.05) * n;
  };
  const P a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
  const double u = r.range(-0.2, 1.2), v = r.range(-0.2, 1.2);
  const P node = o + u * e + v * f + r.signed_log(-6, 0) * n;
  return segment(a, b, c, d, node);
}
Sample ordinary_edges(SplitMix64& r) {
  const P o = r.point(), w = r.step(-6, 0);
  const P s1 = o - r.direction(), s2 = o + r.direction();
  const P m1 = o + w - r.direction(), m2 = o + w + r.direction();
  return edges(s1, s2, m1, m2);
}
Sample ordinary(SplitMix64& r) {
  if (r.below(3) == 0) return ordinary_edges(r);
  if (r.below(2) == 0) return ordinary_quad(r);
  const P a = r.point(), b = r.point(), c = r.point();
  return triangle(a, b, c, node_near(a, b, c, r));
}

template <class F>
void for_each_coordinate(Sample& s, F&& f) {
  for (P& p : s.x) {
    p.x = f(p.x);
    p.y = f(p.y);
    p.z = f(p.z);
  }
}
void translate(Sample& s, const P& by) {
  for (P& p : s.x) p = p + by;
}
void permute_axes(Sample& s, SplitMix64& r) {
  for (int k = r.below(3); k > 0; --k)
    for (P& p : s.x) p = {p.y, p.z, p.x};
}
// Integer quad in the plane z = const, convex, counter-clockwise.
Sample flat_quad(SplitMix64& r, double z) {
  const auto at = [&](int x, int y) {
    return P{static_cast<double>(16 * x + r.integer(-3, 3)),
             static_cast<double>(16 * y + r.integer(-3, 3)), z};
  };
  const P a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
  const P inside{static_cast<double>(r.integer(5, 11)), static_cast<double>(r.integer(5, 11)), z};
  return segment(a, b, c, d, inside);
}

// --- families 1 to 10: degenerate and warped segments -----------------------------------------

Sample thin_triangle(SplitMix64& r, double t, double epsilon) {
  const P a = r.point(), b = r.point(), n = normal_to(b - a, r);
  const P c = a + t * (b - a) + (epsilon * deck::length(b - a)) * n;
  const double u = r.range(-0.2, 1.2), v = r.range(-0.2, 1.2);
  const P node = a + u * (b - a) + v * (c - a) + r.step(-9, 0);
  return r.below(4) == 0 ? segment(a, b, c, a + 0.5 * (c - a), node) : triangle(a, b, c, node);
}
Sample needle(SplitMix64& r) {
  const double t = r.unit(), epsilon = r.log(-15, -3);
  return thin_triangle(r, t, epsilon);
}
Sample sliver(SplitMix64& r) {
  constexpr double shares[] = {0.5, -1e-3, 1.0 + 1e-3};
  const double t = shares[r.below(3)], epsilon = r.log(-15, -3);
  return thin_triangle(r, t, epsilon);
}
Sample collinear(SplitMix64& r) {
  const P a = r.integers(9), d = r.integers(4);
  const P b = a + static_cast<double>(r.integer(1, 5)) * d;
  const P c = a + static_cast<double>(r.integer(-5, 9)) * d;
  return triangle(a, b, c, r.below(2) == 0 ? r.integers(20) : r.point(20));
}
Sample coincident_pair(SplitMix64& r) {
  const P a = r.point(), b = r.point();
  P node = r.point();
  if (r.below(2) == 0) {
    node = a + r.unit() * (b - a);
    node = node + r.step(-12, 0);
  }
  if (r.below(2) == 0) return triangle(a, a, b, node);
  return r.below(2) == 0 ? triangle(a, b, a, node) : segment(a, a, b, b, node);
}
Sample all_coincident(SplitMix64& r) {
  const P a = r.point();
  const P node = r.below(8) == 0 ? a : a + r.step(-15, 0);
  return r.below(2) == 0 ? triangle(a, a, a, node) : segment(a, a, a, a, node);
}
Sample collapsed_quad(SplitMix64& r) {
  const P a = r.point(), b = r.point(), c = r.point(), node = node_near(a, b, c, r);
  return r.below(2) == 0 ? triangle(a, b, c, node) : segment(a, b, c, c, node);
}
Sample bow_tie(SplitMix64& r) {
  Sample s = ordinary_quad(r);
  std::swap(s.x[2], s.x[3]);
  return s;
}
Sample arrow(SplitMix64& r) {
  Sample s = ordinary_quad(r);
  s.x[2] = s.x[0] + r.range(0.05, 0.45) * (s.x[2] - s.x[0]);
  return s;
}
Sample saddle(SplitMix64& r) {
  const double kappa = r.log(-2, 0.5), h = kappa;
  Sample s = segment({1, 1, h}, {-1, 1, -h}, {-1, -1, h}, {1, -1, -h}, {0, 0, 1.0 / kappa});
  if (r.below(2) == 0) s.x[4].z = r.signed_log(-8, 2);
  permute_axes(s, r);
  return s;
}
Sample focal(SplitMix64& r) {
  const double h = r.log(-0.5, 3);
  Sample s = segment({1, 1, h}, {-1, 1, 0}, {-1, -1, h}, {1, -1, 0}, {0, 0, h * r.range(0.3, 0.7)});
  s.x[4] = s.x[4] + r.step(-16, -1);
  permute_axes(s, r);
  return s;
}

// --- families 11 to 16: node on or next to the segment ------------------------------------------

Sample on_vertex(SplitMix64& r) {
  Sample s = ordinary_quad(r);
  s.x[4] = s.x[static_cast<std::size_t>(r.below(4))];
  return s;
}
Sample on_edge(SplitMix64& r) {
  const P a = r.integers(99), b = r.integers(99), c = r.integers(99), d = r.integers(99);
  const double t = static_cast<double>(r.integer(0, 64)) / 64.0;
  const P node = a + t * (b - a);
  return r.below(2) == 0 ? triangle(a, b, c, node) : segment(a, b, c, d, node);
}
Sample on_diagonal(SplitMix64& r) {
  Sample s = flat_quad(r, static_cast<double>(r.integer(-5, 5)));
  s.x[4] = r.below(2) == 0 ? 0.25 * (s.x[0] + s.x[1] + s.x[2] + s.x[3]) : 0.5 * (s.x[0] + s.x[2]);
  permute_axes(s, r);
  return s;
}
Sample beside_edge(SplitMix64& r) {
  Sample s = on_edge(r);
  const auto step = [&](double v) { return std::nextafter(v, r.sign() * 1e9); };
  s.x[4] = {step(s.x[4].x), step(s.x[4].y), step(s.x[4].z)};
  return s;
}
Sample in_plane(SplitMix64& r) {
  Sample s = flat_quad(r, r.range(-5, 5));
  s.x[4].x += r.range(-1, 1);
  permute_axes(s, r);
  return s;
}
Sample near_touch(SplitMix64& r) {
  Sample s = flat_quad(r, 0.0);
  s.x[4].z = r.signed_log(-300, -6);
  s.gap = std::abs(s.x[4].z) * (1.0 + r.signed_log(-16, -1));
  if (r.below(2) == 0) s.gap = std::abs(s.x[4].z);
  permute_axes(s, r);
  return s;
}

// --- families 17 to 22: sizes and special numbers ------------------------------------------------

Sample huge_offset(SplitMix64& r) {
  constexpr double sizes[] = {1e6, 1e8, 1e9};
  Sample s = ordinary(r);
  const double size = sizes[r.below(3)];
  if (!s.edges) s.x[4] = 0.25 * (s.x[0] + s.x[1] + s.x[2] + s.x[3]) + 1e-3 * r.direction();
  translate(s, size * r.direction());
  if (r.below(2) == 0) s.gap = 1e-3;
  return s;
}
Sample mixed_offset(SplitMix64& r) {
  Sample s = ordinary(r);
  P& far = s.x[static_cast<std::size_t>(r.below(s.triangle ? 2 : 4))];
  far = far + 1e9 * r.direction();
  return s;
}
Sample scaled(SplitMix64& r, double by) {
  Sample s = ordinary(r);
  for_each_coordinate(s, [by](double v) { return v * by; });
  return s;
}
Sample tiny_units(SplitMix64& r) { return scaled(r, r.below(2) == 0 ? 1e-12 : 1e-30); }
Sample big_units(SplitMix64& r) { return scaled(r, r.below(2) == 0 ? 1e30 : 1e75); }
Sample subnormal(SplitMix64& r) {
  const double unit = r.below(2) == 0 ? 0x1p-1074 : r.log(-322, -308);
  Sample s = ordinary(r);
  const double steps = r.log(0, 3);
  for_each_coordinate(s, [&](double v) { return std::round(v * steps) * unit; });
  return s;
}
Sample negative_zero(SplitMix64& r) {
  Sample s = flat_quad(r, 0.0);
  s.x[4].z = static_cast<double>(r.integer(0, 3));
  for_each_coordinate(s, [&](double v) { return v == 0.0 && r.below(2) == 0 ? -0.0 : v; });
  permute_axes(s, r);
  return s;
}

// --- families 23 to 29: two edges ----------------------------------------------------------------

Sample parallel(SplitMix64& r, int low, int high) {
  P d = r.integers(5);
  if (dot(d, d) == 0.0) d = {1, 2, 3};
  const P o = r.integers(20);
  P side = cross(d, r.integers(4));
  const auto along = [&](int k) { return static_cast<double>(k) * d; };
  const int length = r.integer(1, 8), start = r.integer(low, high);
  const P m1 = o + along(start * length) + side, m2 = m1 + along(r.integer(1, 8));
  const P s1 = o, s2 = o + along(length);
  return r.below(2) == 0 ? edges(s1, s2, m1, m2) : edges(s1, s2, m2, m1);
}
Sample parallel_overlapping(SplitMix64& r) { return parallel(r, 0, 0); }
Sample parallel_apart(SplitMix64& r) { return parallel(r, 2, 5); }
Sample near_parallel(SplitMix64& r) {
  const P o = r.point(), d = r.direction(), side = normal_to(d, r);
  const double angle = r.log(-17, -4);
  const P e = d + angle * normal_to(d, r), beside = o + r.log(-6, 0) * side;
  const P start = beside + r.range(-1, 1) * d, s2 = o + r.range(0.3, 2) * d;
  return edges(o, s2, start, start + r.range(0.3, 2) * e);
}
Sample near_collinear(SplitMix64& r) {
  const P o = r.point(), d = r.direction(), side = normal_to(d, r);
  const double lateral = r.log(-12, -6);
  const P start = o + (1.0 + r.range(0.05, 0.5)) * d + lateral * side;
  const P along = start + r.range(0.3, 2) * d;
  return edges(o, o + d, start, along + (lateral * r.range(-1, 1)) * side);
}
Sample crossing(SplitMix64& r) {
  constexpr double shares[] = {0.0, 0.5, 1.0};
  const P s = r.integers(32), m = r.integers(32), o = r.integers(64);
  const double hs = shares[r.below(3)], hm = shares[r.below(3)];
  const P s1 = o - hs * s, m1 = o - hm * m;
  return edges(s1, s1 + s, m1, m1 + m);
}
Sample duplicate_edges(SplitMix64& r) {
  const P a = r.point(), b = r.point();
  switch (r.below(3)) {
    case 0:
      return edges(a, b, a, b);
    case 1:
      return edges(a, b, b, a);
    default:
      return edges(a, b, a + 0.25 * (b - a), a + 0.75 * (b - a));
  }
}
Sample zero_length(SplitMix64& r) {
  const P a = r.point(), b = r.point(), c = r.point();
  switch (r.below(3)) {
    case 0:
      return edges(a, a, b, c);
    case 1:
      return edges(b, c, a, a);
    default:
      return edges(a, a, b, b);
  }
}

// --- families 30 to 40: decisions and search shapes ---------------------------------------------

Sample touching(SplitMix64& r) {
  constexpr double triples[][3] = {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {1, 0, 1}};
  Sample s;
  double d = 0.0;
  const double scale = std::ldexp(1.0, r.integer(-12, 12));
  if (r.below(2) == 0) {
    s = flat_quad(r, 0.0);
    d = scale * static_cast<double>(r.integer(1, 99));
    s.x[4].z = r.sign() * d;
  } else {
    const double* t = triples[r.below(4)];
    s = edges({0, 0, -1}, {0, 0, 1}, {scale * t[0], scale * t[1], -1},
              {scale * t[0], scale * t[1], 2});
    d = scale * t[2];
  }
  permute_axes(s, r);
  constexpr int ulps[] = {-1, 0, 1};
  const int step = ulps[r.below(3)];
  s.gap = step == 0 ? d : std::nextafter(d, step < 0 ? 0.0 : 2.0 * d);
  return s;
}
Sample decimal_gaps(SplitMix64& r) {
  Sample s = flat_quad(r, 0.0);
  const double a = static_cast<double>(r.integer(1, 9)) / 10.0;
  const double b = static_cast<double>(r.integer(1, 9)) / 10.0;
  s.x[4].z = static_cast<double>(std::lround(10.0 * a) + std::lround(10.0 * b)) / 10.0;
  s.gap = r.below(4) == 0 ? 0.0 : a + b;
  permute_axes(s, r);
  return s;
}
Sample both_sides(SplitMix64& r) {
  const double wall = r.log(-3, 1);
  Sample s = flat_quad(r, r.sign() * 0.5 * wall);
  s.x[4].z = 0.0;
  s.gap = r.below(2) == 0 ? 0.5 * wall : wall;
  permute_axes(s, r);
  return s;
}
Sample node_of_segment(SplitMix64& r) {
  Sample s = ordinary(r);
  if (s.edges) {
    s.x[2] = s.x[0];
  } else {
    s.x[4] = s.x[static_cast<std::size_t>(r.below(3))];
  }
  return s;
}
Sample symmetric(SplitMix64& r) {
  Sample s = ordinary_edges(r);
  if (r.below(2) == 0) {
    std::swap(s.x[0], s.x[2]);
    std::swap(s.x[1], s.x[3]);
  }
  return s;
}
Sample search_shapes(SplitMix64& r) {
  Sample s = ordinary(r);
  const int shape = r.below(3);
  for (P& p : s.x) {
    if (shape == 0) p.z = 1.0;
    if (shape == 1) p = {p.x, 2.0, 1.0};
  }
  if (shape == 2) s.x[4] = s.x[4] + P{1e6, 0, 0};
  return s;
}
Sample size_ratio(SplitMix64& r) {
  Sample s = ordinary(r);
  if (s.edges) {
    s.x[1] = s.x[0] + 1e3 * (s.x[1] - s.x[0]);
    s.x[3] = s.x[2] + 1e-3 * (s.x[3] - s.x[2]);
    return s;
  }
  for (std::size_t k = 0; k < 4; ++k) s.x[k] = 1e3 * s.x[k];
  s.x[4] = s.x[0] + r.unit() * (s.x[2] - s.x[0]);
  s.x[4] = s.x[4] + r.step(-3, 0);
  return s;
}
Sample dihedral(SplitMix64& r) {
  const double pi = std::acos(-1.0), angle = r.log(-4, 2.255) * pi / 180.0;
  const P n1{std::cos(0.5 * angle), std::sin(0.5 * angle), 0};
  const P n2{std::cos(0.5 * angle), -std::sin(0.5 * angle), 0};
  const P node{r.range(0, 1.2), 0, r.range(-1.2, 1.2)};
  const Sample s = segment({0, 0, -1}, n1, {0, 0, 1}, n2, node);
  return s;
}

struct FamilyRecipe {
  HardFamily family;
  Sample (*make)(SplitMix64&);
};

const char* const same_as_exact = "finite, correctly rounded, decision exact";
const FamilyRecipe recipes[] = {
    {{1, "needle", same_as_exact}, needle},
    {{2, "sliver", "region at the obtuse corner as in exact arithmetic"}, sliver},
    {{3, "zero area, collinear", "behaves as its longest edge"}, collinear},
    {{4, "zero area, two nodes coincide", "behaves as an edge"}, coincident_pair},
    {{5, "all nodes coincide", "behaves as a point"}, all_coincident},
    {{6, "quad with a collapsed edge", "same distance as the triangle, by id or coordinate"},
     collapsed_quad},
    {{7, "bow-tie quad", "smallest of the four sub-triangles"}, bow_tie},
    {{8, "arrow quad", "smallest of the four sub-triangles"}, arrow},
    {{9, "saddle, two equal projections", "the common distance; first sub-triangle of ties"},
     saddle},
    {{10, "strong warp, many minima", "the exact smallest value"}, focal},
    {{11, "node on a corner", "distance exactly 0"}, on_vertex},
    {{12, "node on an edge", "distance exactly 0"}, on_edge},
    {{13, "node on the diagonal", "distance exactly 0"}, on_diagonal},
    {{14, "one step beside an edge", "no jump of the distance"}, beside_edge},
    {{15, "node in the plane", "distance exactly 0 inside"}, in_plane},
    {{16, "near touch", "sign of gap minus distance right down to 1e-300"}, near_touch},
    {{17, "huge offset", "exact on the rounded coordinates"}, huge_offset},
    {{18, "mixed offset", "no overflow, decision exact"}, mixed_offset},
    {{19, "tiny units", "as at size 1, scaled"}, tiny_units},
    {{20, "big units", "as at size 1, scaled; never infinite"}, big_units},
    {{21, "subnormal coordinates", "finite, decision exact"}, subnormal},
    {{22, "negative zero", "-0 as +0; NaN and infinity are refused on reading"}, negative_zero},
    {{23, "parallel edges, overlapping", "distance of the lines"}, parallel_overlapping},
    {{24, "parallel edges, apart", "end to end"}, parallel_apart},
    {{25, "nearly parallel edges", "continuous in the angle, no drop to 0"}, near_parallel},
    {{26, "nearly collinear edges", "end to end, distance above 0"}, near_collinear},
    {{27, "crossing edges", "distance exactly 0"}, crossing},
    {{28, "identical edges", "independent of the order of nodes"}, duplicate_edges},
    {{29, "edge of length zero", "behaves as a point"}, zero_length},
    {{30, "distance equal to the gap", "in contact if and only if distance < gap"}, touching},
    {{31, "decimal gaps", "decided on the rounded sum"}, decimal_gaps},
    {{32, "both sides", "the same decision on both sides"}, both_sides},
    {{33, "node of the segment", "distance exactly 0; the search leaves it out by its number"},
     node_of_segment},
    {{34, "sides exchanged", "the same distance"}, symmetric},
    {{35, "contraction of operations", "same answers from all builds: separate builds", false},
     nullptr},
    {{36, "fast-math guard", "does not compile with -ffast-math", false}, nullptr},
    {{37, "rounding mode", "not sampled", false}, nullptr},
    {{38, "search degeneracies", "pairs of such scenes; the search itself has its own tests"},
     search_shapes},
    {{39, "extreme size ratio", same_as_exact}, size_ratio},
    {{40, "sharp dihedral", "continuous, first sub-triangle of ties"}, dihedral},
};

struct FamilyGroup {
  int last;  // id of its last family
  const char* name;
};
const FamilyGroup family_groups[] = {{2, "needles and slivers"},  {5, "zero area"},
                                     {10, "needles and slivers"}, {16, "corners and edges"},
                                     {22, "units and offsets"},   {29, "parallel edges"},
                                     {34, "touch at the gap"},    {40, "needles and slivers"}};

}  // namespace

std::span<const HardFamily> hard_families() {
  static const std::vector<HardFamily> list = [] {
    std::vector<HardFamily> out;
    for (const FamilyRecipe& recipe : recipes) {
      const FamilyGroup* group = family_groups;
      while (recipe.family.id > group->last) ++group;
      out.push_back(recipe.family);
      out.back().group = group->name;
    }
    return out;
  }();
  return list;
}

std::vector<PairSample> hard_cases(int family, std::size_t samples, std::uint64_t seed) {
  std::vector<PairSample> out;
  for (const FamilyRecipe& recipe : recipes) {
    if (recipe.family.id != family || recipe.make == nullptr) continue;
    SplitMix64 random(seed * 64 + static_cast<std::uint64_t>(family));
    out.reserve(samples);
    while (out.size() < samples) {
      Sample s = recipe.make(random);
      s.family = family;
      // Recipes that need a gap set it; decimal gaps may be 0 on purpose.
      if (s.gap == 0.0 && family != 31) choose_gap(s, random);
      out.push_back(s);
    }
  }
  return out;
}

}  // namespace deck
