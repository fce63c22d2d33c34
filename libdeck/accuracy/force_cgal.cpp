// The elastic contact force of one pair from its exact distance: what the other arithmetics are
// held against.
#include <CGAL/number_utils.h>

#include "accuracy/tiers.hpp"
#include "contact/shared/exact_number.hpp"

namespace deck::accuracy {
Outcome exact_force(const PairSample& s, FilterCounters&) {
  const Rational squared = s.edges ? exact_distance_squared(s.x[0], s.x[1], s.x[2], s.x[3])
                                   : exact_distance_squared(s.x[4], s.corners(), s.triangle);
  Outcome out;
  const Rational gap(s.gap), difference = CGAL::square(gap) - squared;
  out.closer = s.gap > 0.0 && CGAL::is_positive(difference);
  if (!out.closer) return out;
  const Rational share(linear_below), d = long_square_root(squared), floor = share * gap;
  Rational force;
  if (d >= floor) {
    force = gap * difference / ((gap + d) * 2 * d);
  } else {
    force = (gap - floor) / (2 * share) + (floor - d) / (2 * Rational(linear_below * linear_below));
  }
  out.value = CGAL::to_double(force);
  return out;
}

}  // namespace deck::accuracy
