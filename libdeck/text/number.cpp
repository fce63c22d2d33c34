// Reading is a single pass over the cell for the spellings that decks are full of (up to 19 digits,
// small exponents: exact by Clinger's argument) and std::from_chars for the rest.
#include "deck/text/number.hpp"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace deck {
namespace {

constexpr double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::uint64_t exact_mantissa = std::uint64_t{1} << 53;

bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
bool is_blank(char c) { return static_cast<unsigned char>(c) <= 0x20; }

/// The general case: any length, any exponent, any malformed text. `s` is trimmed and not empty.
RealCell read_real_slow(std::string_view s) {
  std::string text;
  text.reserve(s.size() + 2);
  std::size_t i = 0;
  if (s[0] == '+' || s[0] == '-') {
    if (s[0] == '-') text += '-';
    ++i;
  }
  const std::size_t digits_begin = i;
  std::size_t digits = 0;
  bool point = false;
  for (; i < s.size(); ++i) {
    if (is_digit(s[i])) {
      ++digits;
    } else if (s[i] == '.' && !point) {
      point = true;
    } else {
      break;
    }
    text += s[i];
  }
  if (digits == 0) {
    const std::string_view rest = s.substr(digits_begin);
    const auto starts = [&](const char* word) {
      for (std::size_t k = 0; k < 3; ++k)
        if (k >= rest.size() || (rest[k] | 0x20) != word[k]) return false;
      return true;
    };
    return {0, starts("nan") || starts("inf") ? NumberStatus::not_finite
                                              : NumberStatus::not_a_number};
  }
  NumberStatus status = NumberStatus::ok;
  if (i < s.size()) {
    std::size_t j = i;
    const bool letter = s[j] == 'e' || s[j] == 'E' || s[j] == 'd' || s[j] == 'D';
    if (letter) ++j;
    const bool sign = j < s.size() && (s[j] == '+' || s[j] == '-');
    const std::size_t exponent_digits = j + (sign ? 1 : 0);
    if ((letter || sign) && exponent_digits < s.size() && is_digit(s[exponent_digits])) {
      text += 'e';
      if (sign && s[j] == '-') text += '-';
      for (i = exponent_digits; i < s.size() && is_digit(s[i]); ++i) text += s[i];
      if (!letter) status = NumberStatus::implicit_exponent;
    }
    if (i < s.size()) status = NumberStatus::trailing_text;
  }
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc::result_out_of_range) {
    // Too large or too small: the mantissa is not zero here, so the exponent decides.
    const auto e = text.find('e');
    const bool small = e != std::string::npos && e + 1 < text.size() && text[e + 1] == '-';
    if (small) return {0, NumberStatus::underflow};
    return {text[0] == '-' ? -std::numeric_limits<double>::max()
                           : std::numeric_limits<double>::max(),
            NumberStatus::overflow};
  }
  return {value, status};
}

}  // namespace

RealCell read_real(std::string_view cell) {
  const char* p = cell.data();
  const char* end = p + cell.size();
  while (p != end && is_blank(*p)) ++p;
  if (p == end) return {0, NumberStatus::blank};
  while (is_blank(end[-1])) --end;
  const char* const begin = p;
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  std::uint64_t mantissa = 0;
  const char* const digits = p;
  while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
  std::ptrdiff_t count = p - digits;
  int exponent = 0;
  if (p != end && *p == '.') {
    const char* const fraction = ++p;
    while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
    exponent = -static_cast<int>(p - fraction);
    count += p - fraction;
  }
  if (count == 0 || count > 19)
    return read_real_slow({begin, static_cast<std::size_t>(end - begin)});
  bool implicit = false;
  if (p != end) {
    const bool letter = *p == 'e' || *p == 'E' || *p == 'd' || *p == 'D';
    implicit = !letter;
    if (letter) ++p;
    const bool sign = p != end && (*p == '-' || *p == '+');
    const bool minus = sign && *p == '-';
    if (sign) ++p;
    int written = 0, length = 0;
    while (p != end && is_digit(*p) && length < 5) {
      written = written * 10 + (*p++ - '0');
      ++length;
    }
    if (p != end || length == 0 || (!letter && !sign))
      return read_real_slow({begin, static_cast<std::size_t>(end - begin)});
    exponent += minus ? -written : written;
  }
  if (mantissa > exact_mantissa || exponent < -22 || exponent > 22) {
    if (mantissa == 0)
      return {negative ? -0.0 : 0.0,
              implicit ? NumberStatus::implicit_exponent : NumberStatus::ok};
    return read_real_slow({begin, static_cast<std::size_t>(end - begin)});
  }
  // Mantissa and power of ten are exact doubles, so one rounding happens: the result is correct.
  auto value = static_cast<double>(mantissa);
  value = exponent < 0 ? value / power_of_ten[-exponent] : value * power_of_ten[exponent];
  return {negative ? -value : value,
          implicit ? NumberStatus::implicit_exponent : NumberStatus::ok};
}

IntegerCell read_integer(std::string_view cell) {
  const char* p = cell.data();
  const char* end = p + cell.size();
  while (p != end && is_blank(*p)) ++p;
  if (p == end) return {0, NumberStatus::blank};
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  std::uint64_t value = 0;
  const char* const digits = p;
  while (p != end && is_digit(*p)) {
    if (p - digits >= 18) return {0, NumberStatus::overflow};
    value = value * 10 + static_cast<unsigned>(*p++ - '0');
  }
  if (p == digits) return {0, NumberStatus::not_a_number};
  const auto signed_value =
      negative ? -static_cast<std::int64_t>(value) : static_cast<std::int64_t>(value);
  while (p != end && is_blank(*p)) ++p;
  return {signed_value, p == end ? NumberStatus::ok : NumberStatus::trailing_text};
}

std::optional<FormattedReal> format_real(double value, int width) {
  if (!std::isfinite(value) || width < 1) return std::nullopt;
  if (value == 0) value = 0;  // a deck has no use for -0
  const auto room = static_cast<std::size_t>(width);
  const auto reads_back = [&](std::string_view text) { return read_real(text).value == value; };
  std::optional<FormattedReal> best;
  const auto consider = [&](std::string text) {
    // "e+05" and "e-05" waste columns; a point keeps the cell recognisable as a real.
    if (const auto e = text.find('e'); e != std::string::npos) {
      std::string exponent = text.substr(e + 1);
      const bool minus = exponent[0] == '-';
      exponent.erase(0, exponent.find_first_not_of("+-0"));
      text.resize(e);
      if (text.find('.') != std::string::npos)
        while (text.back() == '0') text.pop_back();
      if (!exponent.empty() && exponent != std::string()) text += (minus ? "e-" : "e") + exponent;
    } else {
      if (text.find('.') == std::string::npos) text += '.';
    }
    if (text.size() > room && text.starts_with("0.")) text.erase(0, 1);
    if (text.size() > room && text.starts_with("-0.")) text.erase(1, 1);
    if (text.size() > room) return;
    const bool exact = reads_back(text);
    const auto error = [&](const std::string& t) {
      return std::fabs(read_real(t).value / (value == 0 ? 1 : value) - (value == 0 ? 0 : 1));
    };
    if (!best || (exact && !best->exact) ||
        (exact == best->exact && (exact ? text.size() < best->text.size()
                                        : error(text) < error(best->text))))
      best = FormattedReal{std::move(text), exact};
  };
  char buffer[400];
  const auto shortest = std::to_chars(buffer, buffer + sizeof buffer, value);
  consider({buffer, shortest.ptr});
  const auto fixed =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed);
  if (fixed.ec == std::errc{}) consider({buffer, fixed.ptr});
  const auto scientific =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific);
  consider({buffer, scientific.ptr});
  for (int precision = 17; precision >= 0 && !(best && best->exact); --precision) {
    const auto s = std::to_chars(buffer, buffer + sizeof buffer, value,
                                 std::chars_format::scientific, precision);
    consider({buffer, s.ptr});
    const auto f = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed,
                                 precision);
    if (f.ec == std::errc{}) consider({buffer, f.ptr});
  }
  return best;
}

std::optional<std::string> format_integer(std::int64_t value, int width) {
  std::string text = std::to_string(value);
  if (text.size() > static_cast<std::size_t>(width < 0 ? 0 : width)) return std::nullopt;
  return text;
}

}  // namespace deck
