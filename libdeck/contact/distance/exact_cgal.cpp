// Exact distances: the closest-point templates on CGAL's exact numbers, with regions chosen by
// intervals if these decide; exact test of an edge passing through a triangle.
#include "contact/shared/exact.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "contact/shared/exact_number.hpp"

namespace deck {
namespace {

using Q = Rational;

Point3<double> lower(const Point3<Q>& p) {
  return {rounded_towards_zero(p.x), rounded_towards_zero(p.y), rounded_towards_zero(p.z)};
}

SegmentClosest<Q> exact_segment(const Point3<double>& p, const std::array<Point3<double>, 4>& x,
                                bool triangle) {
  const std::array corners{to_exact(x[0]), to_exact(x[1]), to_exact(x[2]), to_exact(x[3])};
  return closest_on_segment<Form::robust>(to_exact(p), corners, triangle);
}

EdgeClosest<Q> exact_edges(const Point3<double>& s1, const Point3<double>& s2,
                           const Point3<double>& m1, const Point3<double>& m2) {
  return closest_between_edges<Form::robust>(to_exact(s1), to_exact(s2), to_exact(m1),
                                             to_exact(m2));
}

int compare(const Q& distance_squared, double limit) {
  if (limit < 0.0) return 1;
  const Q l(limit);
  return CGAL::compare(distance_squared, CGAL::square(l));
}

}  // namespace

ExactSegment exact_closest_on_segment(const Point3<double>& p,
                                      const std::array<Point3<double>, 4>& corners, bool triangle) {
  const SegmentClosest<Q> c = exact_segment(p, corners, triangle);
  ExactSegment out;
  out.distance = rounded_square_root(c.distance_squared());
  out.distance_squared = rounded_towards_zero(c.distance_squared());
  out.best = c.best;
  for (std::size_t k = 0; k < 4; ++k) out.weights[k] = rounded_towards_zero(c.weights[k]);
  out.vector = lower(c.closest().vector);
  return out;
}

ExactEdges exact_closest_between_edges(const Point3<double>& s1, const Point3<double>& s2,
                                       const Point3<double>& m1, const Point3<double>& m2) {
  const EdgeClosest<Q> c = exact_edges(s1, s2, m1, m2);
  return {rounded_square_root(c.distance_squared),
          rounded_towards_zero(c.distance_squared),
          rounded_towards_zero(c.weight_s),
          rounded_towards_zero(c.weight_m),
          c.parallel,
          lower(c.vector)};
}

int exact_compare_distance(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                           bool triangle, double limit) {
  return compare(exact_segment(p, corners, triangle).distance_squared(), limit);
}

int exact_compare_distance(const Point3<double>& s1, const Point3<double>& s2,
                           const Point3<double>& m1, const Point3<double>& m2, double limit) {
  return compare(exact_edges(s1, s2, m1, m2).distance_squared, limit);
}

namespace detail {

bool passes_through(const Point3<double>& p, const Point3<double>& q, const Point3<double>& a,
                    const Point3<double>& b, const Point3<double>& c) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto to = [](const Point3<double>& v) { return Kernel::Point_3(v.x, v.y, v.z); };
  const Kernel::Point_3 kp = to(p), kq = to(q), ka = to(a), kb = to(b), kc = to(c);
  const int side_p = CGAL::orientation(ka, kb, kc, kp);
  const int side_q = CGAL::orientation(ka, kb, kc, kq);
  if (side_p * side_q >= 0) return false;
  // The line meets the triangle if all sides are on one hand; 0: it meets that side.
  const int s1 = CGAL::orientation(kp, kq, ka, kb);
  const int s2 = CGAL::orientation(kp, kq, kb, kc);
  if (s1 * s2 < 0) return false;
  const int s3 = CGAL::orientation(kp, kq, kc, ka);
  return s1 * s3 >= 0 && s2 * s3 >= 0;
}

}  // namespace detail

}  // namespace deck
