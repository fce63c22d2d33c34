// Decimal digits as text, in the two forms a deck knows.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace deck::detail {

/// value = 0.d1d2d3… * 10^point, without trailing zeros.
struct Decimal {
  bool negative = false;
  std::string_view digits;
  int point = 0;
};

/// "12.5", "0.05" or, without `leading_zero`, ".05"; always with a point.
std::string fixed_text(const Decimal& d, bool leading_zero);
/// "1.25e3". `before`: digits in front of the point; all of them: no point at all.
std::string scientific_text(const Decimal& d, std::size_t before);

}  // namespace deck::detail
