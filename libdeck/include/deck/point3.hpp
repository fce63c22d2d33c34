// Point3: a vector of three numbers with its arithmetic, for coordinates, differences and forces.
// The number type is double, double-double, interval, exact number or a SIMD pack. All sums add x,
// then y, then z, so that results are reproducible.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace deck {

template <class T>
struct Point3 {
  T x{}, y{}, z{};
};

template <class T>
Point3<T> operator+(const Point3<T>& a, const Point3<T>& b) {
  return {T(a.x + b.x), T(a.y + b.y), T(a.z + b.z)};
}
template <class T>
Point3<T> operator-(const Point3<T>& a, const Point3<T>& b) {
  return {T(a.x - b.x), T(a.y - b.y), T(a.z - b.z)};
}
template <class T>
Point3<T> operator-(const Point3<T>& a) {
  return {T(-a.x), T(-a.y), T(-a.z)};
}
template <class T>
Point3<T> operator*(const std::type_identity_t<T>& f, const Point3<T>& a) {
  return {T(f * a.x), T(f * a.y), T(f * a.z)};
}
template <class T>
T dot(const Point3<T>& a, const Point3<T>& b) {
  return T(a.x * b.x + a.y * b.y + a.z * b.z);
}
template <class T>
Point3<T> cross(const Point3<T>& a, const Point3<T>& b) {
  return {T(a.y * b.z - a.z * b.y), T(a.z * b.x - a.x * b.z), T(a.x * b.y - a.y * b.x)};
}

// Properties of a number type that the templates use.
template <class T>
struct NumberTraits {
  static constexpr bool has_sqrt = true;
  // True if multiplying by a power of two is exact and exponents are bounded.
  static constexpr bool is_machine_float = std::is_floating_point_v<T>;
  // Squared sine below which two directions count as parallel: their cross product is round-off.
  static T parallel_guard() {
    if constexpr (is_machine_float) {
      return T(16) * std::numeric_limits<T>::epsilon() * std::numeric_limits<T>::epsilon();
    } else {
      return T(0);
    }
  }
};

namespace scalar {

template <class T>
T larger(const T& a, const T& b) {
  using std::max;
  return max(a, b);
}
template <class T>
T smaller(const T& a, const T& b) {
  using std::min;
  return min(a, b);
}
// Not named magnitude: argument-dependent lookup would prefer CGAL's function of that name, which
// is something else for intervals.
template <class T>
T absolute_value(const T& a) {
  using std::abs;
  return T(abs(a));
}
template <class T>
T square_root(const T& a) {
  if constexpr (NumberTraits<T>::has_sqrt) {
    using std::sqrt;
    return sqrt(a);
  } else {
    return T(0);
  }
}

}  // namespace scalar

template <class T>
T largest_component(const Point3<T>& v) {
  return scalar::larger(scalar::absolute_value(v.x),
                        scalar::larger(scalar::absolute_value(v.y), scalar::absolute_value(v.z)));
}

// Euclidean length. Squares that would leave the exponent range are scaled by a power of two.
template <class T>
T length(const Point3<T>& v) {
  if constexpr (std::is_floating_point_v<T>) {
    constexpr int safe = std::numeric_limits<T>::max_exponent / 3;
    const T big = largest_component(v);
    if (big > T(0) && (big < std::ldexp(T(1), -safe) || big > std::ldexp(T(1), safe))) {
      const int shift = -std::ilogb(big);
      const Point3<T> w{std::ldexp(v.x, shift), std::ldexp(v.y, shift), std::ldexp(v.z, shift)};
      return std::ldexp(std::sqrt(dot(w, w)), -shift);
    }
  }
  return scalar::square_root(dot(v, v));
}

}  // namespace deck
