// Whether an edge passes through a segment, decided by the exact predicates of CGAL.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "contact/crossings/crossings_exact.hpp"

namespace deck::detail {

bool passes_through(const Point3<double>& p, const Point3<double>& q, const Point3<double>& a,
                    const Point3<double>& b, const Point3<double>& c) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto to = [](const Point3<double>& v) { return Kernel::Point_3(v.x, v.y, v.z); };
  const Kernel::Point_3 kp = to(p), kq = to(q), ka = to(a), kb = to(b), kc = to(c);
  const int side_p = CGAL::orientation(ka, kb, kc, kp);
  const int side_q = CGAL::orientation(ka, kb, kc, kq);
  if (side_p * side_q >= 0) return false;
  // The line meets the triangle if it has all three sides on the same hand; 0: it meets the side.
  const int s1 = CGAL::orientation(kp, kq, ka, kb);
  const int s2 = CGAL::orientation(kp, kq, kb, kc);
  if (s1 * s2 < 0) return false;
  const int s3 = CGAL::orientation(kp, kq, kc, ka);
  return s1 * s3 >= 0 && s2 * s3 >= 0;
}

}  // namespace deck::detail
