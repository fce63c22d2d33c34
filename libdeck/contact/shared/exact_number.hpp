// CGAL's exact numbers as number types of the closest-point templates. Only for files *_cgal.cpp:
// CGAL compiles slowly and needs its own compiler flags.
#pragma once

#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>

#include "contact/shared/closest.hpp"

namespace deck {

// Contains every double and is closed under sums, products and quotients.
#ifdef CGAL_USE_GMP
using Rational = CGAL::Exact_rational;
#else  // CGAL would use unreduced quotients of integers
using Rational = CGAL::BOOST_cpp_arithmetic_kernel::Rational;
#endif

// No square root: squared distances are compared.
template <>
struct NumberTraits<Rational> {
  static constexpr bool has_sqrt = false;
  static constexpr bool is_machine_float = false;
  static Rational parallel_guard() { return Rational(0); }
};

inline Point3<Rational> to_exact(const Point3<double>& p) {
  return {Rational(p.x), Rational(p.y), Rational(p.z)};
}

// Rounded towards zero with any library behind the number.
double rounded_towards_zero(const Rational& value);

// The double nearest to the square root of an exact non-negative number (ties to even).
double rounded_square_root(const Rational& value);

// That root cut off after at least 300 binary digits; 0 for numbers <= 0.
Rational long_square_root(const Rational& value);

// Depth of a penetration, rounded towards zero but kept above it.
double rounded_positive_depth(const Rational& depth);

}  // namespace deck
