// Reading: number_scan.hpp for the spellings that decks are full of (up to 19 digits, small
// exponents), std::from_chars for the rest. Writing: the candidates of every form, checked by
// reading them back.
#include "deck/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "text/shared/number_scan.hpp"

namespace deck {
namespace detail {
namespace {

/// Approximate power of ten of a non-zero number, to separate huge from tiny.
std::int64_t decimal_exponent(std::string_view mantissa, std::string_view exponent, bool minus) {
  constexpr std::int64_t enough = 1'000'000'000'000;
  std::int64_t written = 0;
  for (const char c : exponent) written = std::min(written * 10 + (c - '0'), enough);
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  const auto first = static_cast<std::int64_t>(mantissa.find_first_of("123456789"));
  return (minus ? -written : written) + point - first;
}

/// Reads the text after "0x" as strtod does: hexadecimal digits, point, 'p' with a power of two.
/// Blank result: no digit follows, so the number is the leading 0.
RealCell read_hexadecimal(std::string_view s) {
  double value = 0;
  if (s.empty() || s[0] == '-') return {};
  const auto [end, error] =
      std::from_chars(s.data(), s.data() + s.size(), value, std::chars_format::hex);
  if (end == s.data() || !std::isfinite(value)) return {};  // "inf" and "nan" have no digits
  if (error == std::errc::result_out_of_range) return {0, NumberStatus::overflow};
  return {value, NumberStatus::trailing_text};  // legal for the solver, but hardly intended
}

/// Reads a text without digits. Texts starting with "nan" or "inf" have that value, as in the
/// solver, and spoil all later results; others are not numbers.
RealCell read_word(std::string_view text, bool negative) {
  const auto starts = [&](std::string_view word) {
    if (text.size() < word.size()) return false;
    for (std::size_t k = 0; k < word.size(); ++k)
      if ((text[k] | 0x20) != word[k]) return false;
    return true;
  };
  using Limits = std::numeric_limits<double>;
  if (starts("nan")) return {Limits::quiet_NaN(), NumberStatus::not_finite};
  if (!starts("inf")) return {0, NumberStatus::not_a_number};
  return {negative ? -Limits::infinity() : Limits::infinity(), NumberStatus::not_finite};
}

/// Reads "mantissa e exponent" that scan_real() could not decide: too long, too large or malformed.
/// `s` is trimmed and not empty.
RealCell convert(std::string_view s) {
  std::size_t i = s[0] == '+' || s[0] == '-' ? 1 : 0;
  const bool negative = s[0] == '-';
  const std::size_t digits_begin = i;
  std::size_t digits = 0;
  bool point = false, nonzero = false;
  for (; i < s.size(); ++i) {
    if (is_digit(s[i])) {
      ++digits;
      nonzero = nonzero || s[i] != '0';
    } else if (s[i] == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  if (digits == 0) return read_word(s.substr(digits_begin), negative);
  if (i < s.size() && (s[i] | 0x20) == 'x' && s.substr(digits_begin, i - digits_begin) == "0")
    if (const auto hex = read_hexadecimal(s.substr(i + 1)); hex.status != NumberStatus::blank)
      return {negative ? -hex.value : hex.value, hex.status};
  const std::string_view mantissa = s.substr(digits_begin, i - digits_begin);
  NumberStatus status = NumberStatus::ok;
  std::string_view exponent;
  bool minus = false, letter = true;
  if (i < s.size()) {
    std::size_t j = i;
    letter = (s[j] | 0x20) == 'e' || (s[j] | 0x20) == 'd';
    if (letter) ++j;
    const bool sign = j < s.size() && (s[j] == '+' || s[j] == '-');
    minus = sign && s[j] == '-';
    const std::size_t first = j + (sign ? 1 : 0);
    if ((letter || sign) && first < s.size() && is_digit(s[first])) {
      for (i = first; i < s.size() && is_digit(s[i]);) ++i;
      exponent = s.substr(first, i - first);
      if (!letter) status = NumberStatus::implicit_exponent;
    }
    if (i < s.size()) status = NumberStatus::trailing_text;
  }
  double value = 0;
  std::from_chars_result result;
  if (exponent.empty()) {
    result = std::from_chars(mantissa.data(), mantissa.data() + mantissa.size(), value);
  } else {
    // std::from_chars needs an "e": rewrite the number. Cells of a deck fit the buffer; only
    // hostile ones use the heap.
    char buffer[64];
    std::string heap;
    char* text = buffer;
    const std::size_t size = mantissa.size() + exponent.size() + 2;
    if (size > sizeof buffer) {
      heap.resize(size);
      text = heap.data();
    }
    char* to = text;
    to = std::copy(mantissa.begin(), mantissa.end(), to);
    *to++ = 'e';
    if (minus) *to++ = '-';
    to = std::copy(exponent.begin(), exponent.end(), to);
    result = std::from_chars(text, to, value);
  }
  if (result.ec == std::errc::result_out_of_range) {
    if (!nonzero) {
      value = 0;  // 0e99999 is zero for any exponent
    } else if (decimal_exponent(mantissa, exponent, minus) < 0) {
      return {0, NumberStatus::underflow};
    } else {
      const double largest = std::numeric_limits<double>::max();
      return {negative ? -largest : largest, NumberStatus::overflow};
    }
  }
  return {negative ? -value : value, status};
}

}  // namespace

RealCell read_real_general(const char* begin, const char* end) {
  return convert({begin, static_cast<std::size_t>(end - begin)});
}

}  // namespace detail

RealCell read_real(std::string_view cell) {
  return detail::scan_real(cell.data(), cell.data() + cell.size());
}

IntegerCell read_integer(std::string_view cell) {
  return detail::scan_integer(cell.data(), cell.data() + cell.size());
}

namespace detail {
namespace {

/// "12.5", "0.05" or, without `leading_zero`, ".05".
std::string fixed_text(const Decimal& d, bool leading_zero) {
  std::string text = d.negative ? "-" : "";
  const int count = static_cast<int>(d.digits.size());
  if (d.point <= 0) {
    text += leading_zero ? "0." : ".";
    text.append(static_cast<std::size_t>(-d.point), '0').append(d.digits);
  } else if (d.point >= count) {
    text.append(d.digits).append(static_cast<std::size_t>(d.point - count), '0') += '.';
  } else {
    const auto split = static_cast<std::size_t>(d.point);
    text.append(d.digits.substr(0, split)).append(1, '.').append(d.digits.substr(split));
  }
  return text;
}

/// "1.25e3". `before`: digits before the point; if all, no point.
std::string scientific_text(const Decimal& d, std::size_t before) {
  std::string text = d.negative ? "-" : "";
  text += d.digits.substr(0, before);
  if (before < d.digits.size()) text.append(1, '.').append(d.digits.substr(before));
  return text + "e" + std::to_string(d.point - static_cast<int>(before));
}

}  // namespace

std::string readable_text(const Decimal& d, std::size_t room) {
  const bool plain = d.point > -4 && d.point <= 10;
  std::string text = plain ? fixed_text(d, true) : scientific_text(d, 1);
  if (text.size() <= room) return text;
  for (const bool leading_zero : {true, false})
    if (text = fixed_text(d, leading_zero); text.size() <= room) return text;
  if (text = scientific_text(d, 1); text.size() <= room) return text;
  // Without the point one more digit fits.
  if (text = scientific_text(d, d.digits.size()); text.size() <= room) return text;
  return {};
}

}  // namespace detail

namespace {

using detail::Decimal;
using detail::readable_text;

/// Rounds correctly to `significant` digits; 0: the fewest that read back to `value`.
Decimal to_decimal(double value, int significant, char (&buffer)[32]) {
  const auto result = detail::write_scientific(buffer, buffer + sizeof buffer, value, significant);
  // From "-d.ddde+XX": removes the point.
  Decimal out;
  char* first = buffer;
  if (*first == '-') {
    out.negative = true;
    ++first;
  }
  char* const mark = std::find(first, result.ptr, 'e');
  const char* number = mark + 1;
  if (*number == '+') ++number;
  int exponent = 0;
  std::from_chars(number, result.ptr, exponent);
  char* last = mark;
  if (mark - first > 1) {
    first[1] = first[0];
    ++first;
  }
  while (last - first > 1 && last[-1] == '0') --last;
  out.digits = {first, static_cast<std::size_t>(last - first)};
  out.point = exponent + 1;
  return out;
}

}  // namespace

std::optional<FormattedReal> format_real(double value, int width) {
  if (!std::isfinite(value) || width < 1) return std::nullopt;
  const auto room = static_cast<std::size_t>(width);
  char buffer[32];
  const Decimal shortest = to_decimal(value, 0, buffer);
  if (value == 0) {  // decks do not need -0
    if (room < 2) return std::nullopt;
    return FormattedReal{room > 2 ? "0.0" : "0.", true};
  }
  if (std::string text = readable_text(shortest, room); !text.empty())
    return FormattedReal{std::move(text), true};
  for (int digits = static_cast<int>(shortest.digits.size()) - 1; digits > 0; --digits) {
    char other[32];
    Decimal decimal = to_decimal(value, digits, other);
    // Rounding up can overflow ("2e308"): then the digits are cut.
    if (std::string text = readable_text(decimal, room); !text.empty()) {
      RealCell read = read_real(text);
      if (read.status != NumberStatus::ok) {
        decimal = shortest;
        decimal.digits = decimal.digits.substr(0, static_cast<std::size_t>(digits));
        text = readable_text(decimal, room);
        read = read_real(text);
      }
      if (read.status == NumberStatus::ok)
        return FormattedReal{std::move(text), read.value == value};
    }
  }
  return std::nullopt;
}

std::optional<std::string> format_integer(std::int64_t value, int width) {
  std::string text = std::to_string(value);
  if (text.size() > static_cast<std::size_t>(width < 0 ? 0 : width)) return std::nullopt;
  return text;
}

std::string shortest(double number) {
  std::string text = fmt::format("{}", number);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

}  // namespace deck
