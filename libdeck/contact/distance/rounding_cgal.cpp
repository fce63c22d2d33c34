// Rounds roots and depths of exact numbers: a guess in double, corrected by exact comparisons.
#include <CGAL/Exact_integer.h>
#include <CGAL/Fraction_traits.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "contact/shared/exact_number.hpp"

namespace deck {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Infinity counts as the power of two above all doubles, as in rounding.
Rational number_of(double value) {
  return value == infinity ? Rational(2) * Rational(0x1p1023) : Rational(value);
}

// A number > 0 divided by 4^shift, which puts it in the range of doubles.
struct Normalised {
  Rational value;
  int shift = 0;
};
constexpr int exponent_step = 450;
Normalised normalised(Rational value) {
  int shift = 0;
  const Rational low(0x1p-600), high(0x1p600), up(0x1p900), down(0x1p-900);
  for (; value < low; shift -= exponent_step) value *= up;
  for (; value > high; shift += exponent_step) value *= down;
  return {value, shift};
}

double guessed_square_root(const Rational& value) {
  if (CGAL::is_zero(value)) return 0.0;
  const Normalised s = normalised(value);
  return std::ldexp(std::sqrt(CGAL::to_double(s.value)), s.shift);
}

// Largest double at most the number; at_most(r): r is at most the number.
template <class Test>
double rounded_down(double guess, const Test& at_most) {
  double r = guess < infinity ? guess : std::numeric_limits<double>::max();
  while (!at_most(r)) r = std::nextafter(r, 0.0);
  for (;;) {
    const double next = std::nextafter(r, infinity);
    if (next == infinity || !at_most(next)) return r;
    r = next;
  }
}

}  // namespace

double rounded_towards_zero(const Rational& value) {
  // Libraries round to nearest or truncate: at most one step too far.
  double r = CGAL::to_double(value);
  const Rational size = CGAL::abs(value);
  while (std::isinf(r) || CGAL::compare(Rational(std::abs(r)), size) == CGAL::LARGER)
    r = std::nextafter(r, 0.0);
  return r;
}

double rounded_square_root(const Rational& value) {
  if (CGAL::sign(value) <= 0) return 0.0;
  const double low = rounded_down(guessed_square_root(value), [&](double r) {
    return CGAL::compare(CGAL::square(Rational(r)), value) != CGAL::LARGER;
  });
  const double high = std::nextafter(low, infinity);
  const Rational twice_the_middle = number_of(low) + number_of(high);
  switch (CGAL::compare(CGAL::square(twice_the_middle), Rational(4) * value)) {
    case CGAL::LARGER:
      return low;
    case CGAL::SMALLER:
      return high;
    case CGAL::EQUAL:
      break;
  }
  return std::bit_cast<std::uint64_t>(low) % 2 == 0 ? low : high;
}

Rational long_square_root(const Rational& value) {
  if (!CGAL::is_positive(value)) return Rational(0);
  const Normalised s = normalised(value);
  const Rational places(0x1p600), step(std::ldexp(1.0, exponent_step));
  CGAL::Exact_integer numerator, denominator;
  CGAL::Fraction_traits<Rational>::Decompose()(s.value * CGAL::square(places), numerator,
                                               denominator);
  const CGAL::Exact_integer whole = numerator / denominator;
  Rational root = Rational(CGAL::sqrt(whole)) / places;
  for (int left = s.shift; left > 0; left -= exponent_step) root *= step;
  for (int left = s.shift; left < 0; left += exponent_step) root /= step;
  return root;
}

double rounded_positive_depth(const Rational& depth) {
  const double rounded = rounded_towards_zero(depth);
  return rounded > 0 ? rounded : std::numeric_limits<double>::denorm_min();
}

}  // namespace deck
