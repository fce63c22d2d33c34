// Exact proofs of a guess: either a point nearer than the gap, or a direction w in which every
// vertex is at least the gap away: min_k(w.(node - v_k))^2 >= gap^2 w.w. No division: exact sums
// and products of doubles suffice.
#include "contact/shared/filtered.hpp"

#include <CGAL/Number_types/internal/Exact_type_selector.h>

#include <cmath>
#include <initializer_list>

namespace deck {
namespace {

// Integers times powers of two: doubles, their sums and products. With GMP CGAL::Mpzf.
using Z = CGAL::internal::Exact_ring_selector<double>::Type;
using V = Point3<Z>;

V vector_of(const Point3<double>& p) { return {Z(p.x), Z(p.y), Z(p.z)}; }

// True if all these vertices (relative to the node) are at least the gap away in direction w.
bool apart(const V& w, std::initializer_list<const V*> vertices, const Z& gap) {
  Z least;
  bool first = true;
  for (const V* v : vertices) {
    const Z value = -dot(w, *v);
    if (!CGAL::is_positive(value)) return false;
    if (first || value < least) least = value;
    first = false;
  }
  return least * least >= gap * gap * dot(w, w);
}

// Direction from the closest point of a part to the node, and if it is nearer than the gap.
struct PartDirection {
  V w;
  bool nearer = false;
};

// value / scale < gap^2; with gap 0: value is 0.
bool is_nearer(const Z& value, const Z& scale, const Z& gap) {
  return CGAL::is_zero(gap) ? CGAL::is_zero(value) : value < gap * gap * scale;
}

PartDirection corner_part(const V& p, const Z& gap) {
  return {-p, is_nearer(dot(p, p), Z(1), gap)};
}

PartDirection edge_part(const V& p, const V& q, const Z& gap) {
  const V e = q - p, moment = cross(p, e);
  const Z along = -dot(e, p), ee = dot(e, e);
  const bool inside = !CGAL::is_negative(along) && along <= ee;
  return {cross(moment, e), inside && is_nearer(dot(moment, moment), ee, gap)};
}

// Triangle o, a, b; `whole`: the parallelogram of o-a and o-b.
PartDirection face_part(const V& o, const V& a, const V& b, bool whole, const Z& gap) {
  const V p = a - o, q = b - o;
  V n = cross(p, q);
  const V r = -o;
  const Z fp = dot(n, cross(r, q)), fq = dot(n, cross(p, r)), nn = dot(n, n);
  const bool inside = CGAL::is_positive(nn) && !CGAL::is_negative(fp) && !CGAL::is_negative(fq) &&
                      (whole ? fp <= nn && fq <= nn : fp + fq <= nn);
  const Z height = -dot(n, o);
  if (CGAL::is_negative(height)) n = -n;
  return {n, inside && is_nearer(height * height, nn, gap)};
}

PartDirection part_of(const PartGuess& guess, const V& o, const V& a, const V& b, const Z& gap) {
  if (guess.o && guess.a && guess.b) return face_part(o, a, b, false, gap);
  if (guess.a && guess.b) return edge_part(a, b, gap);
  if (guess.o && guess.a) return edge_part(o, a, gap);
  if (guess.o && guess.b) return edge_part(o, b, gap);
  return corner_part(guess.o ? o : (guess.a ? a : b), gap);
}

}  // namespace

bool is_closer_to_piece(const std::array<Point3<double>, 5>& points, const SegmentPiece& piece,
                        double gap) {
  if (!std::isfinite(gap)) return true;
  const V base = vector_of(points[piece.base]);
  const V p = base - vector_of(points[4]);
  const Z limit(gap);
  std::array<V, 2> along;
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t k = 0; k < 4; ++k)
      if ((piece.corners[d] >> k & 1U) != 0) along[d] = along[d] + (vector_of(points[k]) - base);
  if (piece.corners[0] == 0) return is_nearer(dot(p, p), Z(1), limit);
  const V n = cross(along[0], piece.corners[1] == 0 ? p : along[1]);
  if (piece.corners[1] == 0) return is_nearer(dot(n, n), dot(along[0], along[0]), limit);
  const Z height = dot(n, p);
  return is_nearer(height * height, dot(n, n), limit);
}

std::optional<bool> prove_closer(const std::array<Point3<double>, 5>& points, bool triangle,
                                 int best, const std::array<PartGuess, 4>& guess, double gap) {
  if (!all_finite(points) || !std::isfinite(gap)) return std::nullopt;
  const V node = vector_of(points[4]);
  std::array<V, 4> v;
  for (std::size_t k = 0; k < 4; ++k) v[k] = vector_of(points[k]) - node;
  const Z limit(gap);
  if (triangle) {
    const PartDirection part = part_of(guess[0], v[2], v[0], v[1], limit);
    if (part.nearer) return true;
    if (apart(part.w, {&v[0], &v[1], &v[2]}, limit)) return false;
    return std::nullopt;
  }
  const V centre = Z(0.25) * ((v[0] + v[1]) + (v[2] + v[3]));
  const auto k = static_cast<std::size_t>(best);
  const PartDirection part = part_of(guess[k], centre, v[k], v[(k + 1) % 4], limit);
  if (part.nearer) return true;
  if (apart(part.w, {&v[0], &v[1], &v[2], &v[3]}, limit)) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const V &a = v[i], &b = v[(i + 1) % 4];
    if (apart(part.w, {&centre, &a, &b}, limit)) continue;
    if (i == k || !(guess[i].o || guess[i].a || guess[i].b)) return std::nullopt;
    const PartDirection other = part_of(guess[i], centre, a, b, limit);
    if (other.nearer) return true;
    if (!apart(other.w, {&centre, &a, &b}, limit)) return std::nullopt;
  }
  return false;
}

std::optional<bool> prove_closer(const std::array<Point3<double>, 4>& x, EdgeFeature secondary,
                                 EdgeFeature main, bool parallel, double gap) {
  if (!all_finite(x) || !std::isfinite(gap)) return std::nullopt;
  std::array<V, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = vector_of(x[k]);
  const Z limit(gap);
  // Corners of the parallelogram of differences, in order.
  const std::array<V, 4> v{p[0] - p[2], p[0] - p[3], p[1] - p[3], p[1] - p[2]};
  const bool first_s = secondary == EdgeFeature::first_node;
  const bool first_m = main == EdgeFeature::first_node;
  PartDirection part;
  if (parallel) {
    part = edge_part(v[0], v[3], limit);
  } else if (secondary == EdgeFeature::interior && main == EdgeFeature::interior) {
    part = face_part(v[0], v[1], v[3], true, limit);
  } else if (secondary == EdgeFeature::interior) {
    part = first_m ? edge_part(v[0], v[3], limit) : edge_part(v[1], v[2], limit);
  } else if (main == EdgeFeature::interior) {
    part = first_s ? edge_part(v[0], v[1], limit) : edge_part(v[3], v[2], limit);
  } else {
    part = corner_part(first_s ? v[first_m ? 0 : 1] : v[first_m ? 3 : 2], limit);
  }
  if (part.nearer) return true;
  if (apart(part.w, {&v[0], &v[1], &v[2], &v[3]}, limit)) return false;
  return std::nullopt;
}

}  // namespace deck
