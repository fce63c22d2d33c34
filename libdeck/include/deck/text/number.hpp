// Reading and writing numbers in fixed-width cells, the way Radioss Starter decks spell them:
// blanks around, E/e/D/d exponents, exponents without a letter ("1.5-3"), an optional plus sign.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace deck {

enum class NumberStatus : std::uint8_t {
  ok,
  blank,              ///< nothing but blanks: the value is absent
  implicit_exponent,  ///< "1.5-3": read as 1.5e-3
  trailing_text,      ///< a number, then something else; value is the leading number
  not_a_number,       ///< no number at all; the reference solver takes 0
  not_finite,         ///< "nan", "inf": so is the value
  overflow,           ///< beyond the type's range
  underflow,          ///< not zero, but rounds to zero
};

struct RealCell {
  double value = 0;
  NumberStatus status = NumberStatus::blank;
};
struct IntegerCell {
  std::int64_t value = 0;
  NumberStatus status = NumberStatus::blank;
};

/// Reads one real cell; correctly rounded. Never looks outside `cell`.
RealCell read_real(std::string_view cell);
/// Reads one integer cell.
IntegerCell read_integer(std::string_view cell);

/// The text of `value` with the most significant digits that fit `width` columns, always with a
/// decimal point or an exponent: fixed form where that reads well (1e-4 … 1e10), scientific form
/// elsewhere, and whichever fits when only one does ("12345678901234567e-30" saves the column of
/// the point). Never more digits than are needed to read the same value back. nullopt: not even one
/// digit fits, or the value is not finite. `exact` tells whether reading the text gives `value`
/// back.
struct FormattedReal {
  std::string text;
  bool exact = false;
};
std::optional<FormattedReal> format_real(double value, int width);
/// nullopt if it does not fit.
std::optional<std::string> format_integer(std::int64_t value, int width);

/// Shortest text that reads back to `number`, with a point or an exponent.
std::string shortest(double number);

}  // namespace deck
