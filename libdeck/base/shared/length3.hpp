// Length of three doubles without overflow, with the same bits whatever the standard library: the
// three-argument std::hypot is scaled differently in each.
#pragma once

#include <algorithm>
#include <cmath>

namespace deck {

// sqrt(x^2 + y^2 + z^2), all divided by the largest of them first. 0 for three zeros.
inline double length3(double x, double y, double z) {
  x = std::abs(x), y = std::abs(y), z = std::abs(z);
  const double a = x < y ? (y < z ? z : y) : (x < z ? z : x);
  if (a == 0.0) return 0.0;
  return a * std::sqrt((x / a) * (x / a) + (y / a) * (y / a) + (z / a) * (z / a));
}

}  // namespace deck
