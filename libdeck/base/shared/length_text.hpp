// Numbers as people read them. Lengths: a length that no computation can hold, or beyond what
// bounds it, is "unbounded".
#pragma once
#include <string>
#include <string_view>

namespace deck {

/// True for what is no length: not a number, or so large that its square is none.
inline bool is_unbounded(double length) { return !(length * length <= 1.7976931348623157e308); }

/// With `digits` significant digits, as people read it; "unbounded" also beyond `largest`.
std::string length_text(double length, int digits = 6, double largest = 1e300);

/// In place of a number that is none, or that no double holds.
inline constexpr std::string_view not_computed = "not computed";
/// A number with `digits` significant digits, as people read it, or `not_computed`.
std::string figure_text(double value, int digits = 4);

}  // namespace deck
