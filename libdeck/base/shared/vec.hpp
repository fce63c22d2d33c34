// Vector of doubles with length and direction.
#pragma once
#include <array>
#include <cmath>

#include "deck/point3.hpp"

namespace deck {

using Vec = Point3<double>;

inline Vec to_vec(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }
inline double norm(const Vec& a) { return std::sqrt(dot(a, a)); }
/// Unit vector; the null vector is returned unchanged.
inline Vec unit(const Vec& a) {
  const double l = norm(a);
  return l > 0.0 ? (1.0 / l) * a : Vec{};
}

/// Length without overflow. Divides by the largest component first: std::hypot with three arguments
/// gives different bits in each standard library. 0 for three zeros.
inline double length3(double x, double y, double z) {
  x = std::abs(x), y = std::abs(y), z = std::abs(z);
  const double a = x < y ? (y < z ? z : y) : (x < z ? z : x);
  if (a == 0.0) return 0.0;
  return a * std::sqrt((x / a) * (x / a) + (y / a) * (y / a) + (z / a) * (z / a));
}

}  // namespace deck
