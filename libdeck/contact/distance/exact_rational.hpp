// GMP rationals as number type of the closest-point templates.
#pragma once

#include <gmpxx.h>

#include "deck/contact/closest.hpp"

namespace deck {

// No square root: distances stay squared and are compared so.
template <>
struct NumberTraits<mpq_class> {
  static constexpr bool has_sqrt = false;
  static constexpr bool is_machine_float = false;
  static mpq_class parallel_guard() { return 0; }
};

// Squares of the exact distances; finite coordinates only.
mpq_class exact_distance_squared(const Point3<double>& p,
                                 const std::array<Point3<double>, 4>& corners, bool triangle);
mpq_class exact_distance_squared(const Point3<double>& s1, const Point3<double>& s2,
                                 const Point3<double>& m1, const Point3<double>& m2);

// gap - sqrt(squared) within one unit in the last place, whatever cancels; 0 if not positive.
double rounded_depth(double gap, const mpq_class& squared);

// The double nearest to the square root of an exact non-negative number (ties to even).
double rounded_square_root(const mpq_class& value);

}  // namespace deck
