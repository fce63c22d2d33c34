// When two numbers of two decks count as equal. Private to inspection.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace deck::detail {

/// Numbers are equal within a share of the larger one, or of the size of what they belong to: for
/// coordinates and lengths the size of the model, for points of a function its largest value.
class EqualNumbers {
 public:
  explicit EqualNumbers(double tolerance) : tolerance_(tolerance) {}

  /// `rounded`: one of them was multiplied by a factor of units, which rounds in itself.
  bool operator()(double x, double y, double size, bool rounded) {
    if (x == y || (std::isnan(x) && std::isnan(y))) return true;
    const double apart = std::abs(x - y), larger = std::max(std::abs(x), std::abs(y));
    const bool by_rounding = rounded && apart <= unit_rounding * larger;
    if (by_rounding) return true;
    const bool equal = apart <= tolerance_ * std::max(larger, size);
    if (equal) ++used_;
    if (!equal && apart <= nearly * larger) ++nearly_equal_;
    return equal;
  }

  double tolerance() const { return tolerance_; }
  /// Pairs that only the tolerance made equal.
  std::size_t used() const { return used_; }
  /// Pairs that differ by less than `nearly` of their value.
  std::size_t nearly_equal() const { return nearly_equal_; }

  static constexpr double nearly = 1e-9;

 private:
  /// What the products of a few factors of units lose.
  static constexpr double unit_rounding = 1e-12;
  double tolerance_;
  std::size_t used_ = 0, nearly_equal_ = 0;
};

}  // namespace deck::detail
