// Decimal digits as text, in the two forms a deck knows.
#pragma once
#include <charconv>
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

/// A finite number as "-d.ddde+XX" with `significant` digits, exactly rounded; 0: the fewest that
/// read back to the same double.
inline std::to_chars_result write_scientific(char* first, char* last, double value,
                                             int significant) {
  constexpr auto form = std::chars_format::scientific;
  return significant == 0 ? std::to_chars(first, last, value, form)
                          : std::to_chars(first, last, value, form, significant - 1);
}

/// The most readable text of all these digits that fits, empty if none does.
std::string readable_text(const Decimal& d, std::size_t room);

}  // namespace deck::detail
