// Double-double: an unevaluated sum of two doubles, about 106 bits.
// Fallback precision of the distance kernels; needs strict IEEE arithmetic (no fast-math).
#pragma once

#include <cmath>
#include <limits>

#include "contact/shared/closest.hpp"

#ifdef __FAST_MATH__
#error "double-double arithmetic needs strict IEEE semantics; build without -ffast-math"
#endif

namespace deck {

// Value hi + lo with |lo| <= ulp(hi)/2. The error of +, -, *, / and sqrt is a few 2^-104.
class DoubleDouble {
 public:
  DoubleDouble() = default;
  // Implicit: literals in templates convert without loss.
  DoubleDouble(double value) : hi_(value) {}  // NOLINT(google-explicit-constructor)
  DoubleDouble(double hi, double lo) : hi_(hi), lo_(lo) {}

  double hi() const { return hi_; }
  double lo() const { return lo_; }
  explicit operator double() const { return hi_; }

  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi_, -a.lo_}; }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = two_sum(a.hi_, b.hi_);
    const DoubleDouble low = two_sum(a.lo_, b.lo_);
    const DoubleDouble first = quick_sum(high.hi_, high.lo_ + low.hi_);
    return quick_sum(first.hi_, first.lo_ + low.lo_);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }

  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const double product = a.hi_ * b.hi_;
    const double error = std::fma(a.hi_, b.hi_, -product);
    return quick_sum(product, error + (a.hi_ * b.lo_ + a.lo_ * b.hi_));
  }

  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double q1 = a.hi_ / b.hi_;
    if (!std::isfinite(q1)) return q1;
    DoubleDouble rest = a - b * q1;
    const double q2 = rest.hi_ / b.hi_;
    rest = rest - b * q2;
    const double q3 = rest.hi_ / b.hi_;
    return quick_sum(q1, q2) + q3;
  }

  friend DoubleDouble sqrt(const DoubleDouble& a) {
    if (!(a.hi_ > 0.0)) return std::sqrt(a.hi_);
    const double root = std::sqrt(a.hi_);
    const DoubleDouble rest = a - DoubleDouble(root) * root;
    return quick_sum(root, rest.hi_ / (2.0 * root));
  }
  friend DoubleDouble abs(const DoubleDouble& a) { return a.hi_ < 0.0 ? -a : a; }

  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi_ == b.hi_ && a.lo_ == b.lo_;
  }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi_ < b.hi_ || (a.hi_ == b.hi_ && a.lo_ < b.lo_);
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi_ < b.hi_ || (a.hi_ == b.hi_ && a.lo_ <= b.lo_);
  }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }

 private:
  // a + b exactly: rounded sum and its error.
  static DoubleDouble two_sum(double a, double b) {
    const double sum = a + b;
    const double part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
  }
  // two_sum for |a| >= |b|.
  static DoubleDouble quick_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
  }

  double hi_ = 0.0;
  double lo_ = 0.0;
};

template <>
struct NumberTraits<DoubleDouble> {
  static constexpr bool has_sqrt = true;
  static constexpr bool is_machine_float = false;
  static DoubleDouble parallel_guard() { return 0x1p-204; }  // (2^-102)^2
};

}  // namespace deck
