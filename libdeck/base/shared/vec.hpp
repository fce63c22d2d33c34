// The vector of doubles that the stages share, and its length and direction.
#pragma once
#include <array>
#include <cmath>

#include "deck/base/point3.hpp"

namespace deck {

using Vec = Point3<double>;

inline Vec to_vec(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }
inline double norm(const Vec& a) { return std::sqrt(dot(a, a)); }
/// Unit vector; the null vector stays null.
inline Vec unit(const Vec& a) {
  const double l = norm(a);
  return l > 0.0 ? (1.0 / l) * a : Vec{};
}

}  // namespace deck
