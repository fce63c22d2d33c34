// Numbers from text and to text: the standard library's functions, or strtod in the C locale and
// fmt in their place.
#include "base/shared/real_text.hpp"

#include <fmt/format.h>
#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace deck {

namespace portable {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hexadecimal(char c) { return is_digit(c) || ((c | 0x20) >= 'a' && (c | 0x20) <= 'f'); }
bool is_letter_of(char c, char lower) { return static_cast<char>(c | 0x20) == lower; }

/// Length of `word` (in small letters) if [p, end) begins with it, whatever the case.
std::size_t matches(const char* p, const char* end, std::string_view word) {
  if (static_cast<std::size_t>(end - p) < word.size()) return 0;
  for (std::size_t k = 0; k < word.size(); ++k)
    if (!is_letter_of(p[k], word[k])) return 0;
  return word.size();
}

/// A number found in a text: where it ends, and whether any of its digits is not 0.
struct Found {
  const char* end = nullptr;  ///< nullptr: there is none
  bool nonzero = false;
};

/// Digits with at most one point, then an exponent behind `mark`, if it has digits.
template <class Digit>
Found scan(const char* p, const char* last, const Digit& digit, char mark) {
  Found out;
  bool digits = false, point = false;
  for (; p != last; ++p) {
    if (digit(*p)) {
      digits = true;
      out.nonzero = out.nonzero || *p != '0';
    } else if (*p == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  if (!digits) return {};
  out.end = p;
  if (p == last || !is_letter_of(*p, mark)) return out;
  ++p;
  if (p != last && (*p == '-' || *p == '+')) ++p;
  if (p == last || !is_digit(*p)) return out;
  while (p != last && is_digit(*p)) ++p;
  out.end = p;
  return out;
}

/// strtod rounds exactly, but reads the point of a locale.
double convert(const std::string& text) {
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", locale_t{});
  return strtod_l(text.c_str(), nullptr, plain);
}

std::from_chars_result take(const char* first, const Found& found, const std::string& text,
                            double& value) {
  if (found.end == nullptr) return {first, std::errc::invalid_argument};
  const double read = convert(text);
  if (std::isinf(read) || (read == 0.0 && found.nonzero))
    return {found.end, std::errc::result_out_of_range};
  value = read;
  return {found.end, std::errc()};
}

/// "nan", "nan(text)", "inf" or "infinity" at p; nullptr: none of them.
const char* no_number(const char* p, const char* last, double& value) {
  if (std::size_t n = matches(p, last, "nan"); n != 0) {
    value = std::numeric_limits<double>::quiet_NaN();
    p += n;
    if (p == last || *p != '(') return p;
    const char* q = p + 1;
    while (q != last && (is_digit(*q) || is_letter_of(*q, '_') || (*q | 0x20) >= 'a')) ++q;
    return q != last && *q == ')' ? q + 1 : p;
  }
  std::size_t n = matches(p, last, "infinity");
  if (n == 0) n = matches(p, last, "inf");
  if (n == 0) return nullptr;
  value = std::numeric_limits<double>::infinity();
  return p + n;
}

}  // namespace

std::from_chars_result read_real_text(const char* first, const char* last, double& value) {
  const bool negative = first != last && *first == '-';
  const char* const begin = first + (negative ? 1 : 0);
  if (double special = 0; const char* const end = no_number(begin, last, special)) {
    value = negative ? -special : special;
    return {end, std::errc()};
  }
  const Found found = scan(begin, last, is_digit, 'e');
  return take(first, found, found.end == nullptr ? "" : std::string(first, found.end), value);
}

std::from_chars_result read_hexadecimal_text(const char* first, const char* last, double& value) {
  const bool negative = first != last && *first == '-';
  const char* const begin = first + (negative ? 1 : 0);
  if (double special = 0; const char* const end = no_number(begin, last, special)) {
    value = negative ? -special : special;
    return {end, std::errc()};
  }
  const Found found = scan(begin, last, is_hexadecimal, 'p');
  std::string text = negative ? "-0x" : "0x";
  if (found.end != nullptr) text.append(begin, found.end);
  return take(first, found, text, value);
}

std::to_chars_result write_real_text(char* first, char* last, double value, int significant) {
  std::string text;
  if (significant > 0) {
    text = fmt::format("{:.{}e}", value, significant - 1);
  } else {
    // fmt writes the shortest digits with or without exponent, whatever reads better.
    const std::string plain = fmt::format("{}", std::abs(value));
    const auto mark = std::min(plain.find('e'), plain.size());
    int exponent = mark < plain.size() ? atoi(plain.c_str() + mark + 1) : 0;
    std::string digits = plain.substr(0, mark);
    const auto point = std::min(digits.find('.'), digits.size());
    exponent += static_cast<int>(point) - 1;
    digits.erase(point, 1);
    const auto zeros = std::min(digits.find_first_not_of('0'), digits.size() - 1);
    digits.erase(0, zeros);
    exponent -= static_cast<int>(zeros);
    digits.erase(std::max<std::size_t>(digits.find_last_not_of('0') + 1, 1));
    text = fmt::format("{}{}{}{}e{}{:02}", std::signbit(value) ? "-" : "", digits[0],
                       digits.size() > 1 ? "." : "", digits.substr(1), exponent < 0 ? '-' : '+',
                       std::abs(exponent));
  }
  if (static_cast<std::size_t>(last - first) < text.size())
    return {last, std::errc::value_too_large};
  return {std::copy(text.begin(), text.end(), first), std::errc()};
}

}  // namespace portable

#ifdef __cpp_lib_to_chars  // set where the functions know floating-point numbers

std::from_chars_result read_real_text(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}
std::from_chars_result read_hexadecimal_text(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value, std::chars_format::hex);
}
std::to_chars_result write_real_text(char* first, char* last, double value, int significant) {
  return significant == 0
             ? std::to_chars(first, last, value, std::chars_format::scientific)
             : std::to_chars(first, last, value, std::chars_format::scientific, significant - 1);
}

#else

std::from_chars_result read_real_text(const char* first, const char* last, double& value) {
  return portable::read_real_text(first, last, value);
}
std::from_chars_result read_hexadecimal_text(const char* first, const char* last, double& value) {
  return portable::read_hexadecimal_text(first, last, value);
}
std::to_chars_result write_real_text(char* first, char* last, double value, int significant) {
  return portable::write_real_text(first, last, value, significant);
}

#endif

}  // namespace deck
