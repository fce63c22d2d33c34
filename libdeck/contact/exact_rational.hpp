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

// The double nearest to the square root of an exact non-negative number (ties to even).
double rounded_square_root(const mpq_class& value);

}  // namespace deck
