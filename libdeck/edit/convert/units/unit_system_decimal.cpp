// Decimal digits times a factor without a detour over binary numbers.
#include "edit/convert/units/unit_system_decimal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "deck/text/number.hpp"
#include "text/shared/number_scan.hpp"

namespace deck::detail {
namespace {

/// 0.d1d2d3... * 10^point; no leading and no trailing zeros; no digits: zero.
struct Digits {
  bool negative = false;
  std::string digits;
  int point = 0;

  Decimal view() const { return {negative, digits, point}; }
};

/// Exponents beyond this are no numbers that a deck can hold.
constexpr int most_exponent = 10000;

std::optional<Digits> parse(std::string_view cell) {
  while (!cell.empty() && static_cast<unsigned char>(cell.front()) <= ' ') cell.remove_prefix(1);
  while (!cell.empty() && static_cast<unsigned char>(cell.back()) <= ' ') cell.remove_suffix(1);
  Digits d;
  std::size_t i = 0;
  if (i < cell.size() && (cell[i] == '+' || cell[i] == '-')) d.negative = cell[i++] == '-';
  bool any = false, point = false;
  for (; i < cell.size() && (is_digit(cell[i]) || (cell[i] == '.' && !point)); ++i) {
    if (cell[i] == '.') {
      point = true;
      continue;
    }
    any = true;
    if (!d.digits.empty() || cell[i] != '0') {
      d.digits += cell[i];
      if (!point) ++d.point;
    } else if (point) {
      --d.point;  // a zero between the point and the first digit
    }
  }
  if (!any) return std::nullopt;
  if (i < cell.size()) {
    const char c = static_cast<char>(cell[i] | 0x20);
    if (c == 'e' || c == 'd') ++i;
    bool minus = false;
    if (i < cell.size() && (cell[i] == '+' || cell[i] == '-')) minus = cell[i++] == '-';
    int exponent = 0;
    const std::size_t first = i;
    for (; i < cell.size() && is_digit(cell[i]); ++i)
      exponent = std::min(exponent * 10 + (cell[i] - '0'), most_exponent);
    if (i == first || i < cell.size()) return std::nullopt;
    d.point += minus ? -exponent : exponent;
  }
  while (!d.digits.empty() && d.digits.back() == '0') d.digits.pop_back();
  return d;
}

/// Shortest digits that read back as `value`, or a given number of them.
Digits decimal_of(double value, int significant = 0) {
  char buffer[64];
  const auto end = write_scientific(buffer, buffer + sizeof buffer, value, significant);
  return *parse({buffer, static_cast<std::size_t>(end.ptr - buffer)});
}

/// All digits of `d` in at most `room` columns; empty: they do not fit.
std::string print(const Digits& d, std::size_t room) {
  if (d.digits.empty()) return room >= 3 ? "0.0" : room == 2 ? "0." : "0";
  const bool reads_well = d.point > -4 && d.point <= 10;
  const bool fixed_possible = d.point > -30 && d.point < 30;
  std::string text = reads_well ? fixed_text(d.view(), true) : scientific_text(d.view(), 1);
  if (text.size() <= room) return text;
  for (const bool leading_zero : {true, false})
    if (fixed_possible && (text = fixed_text(d.view(), leading_zero)).size() <= room) return text;
  if ((text = scientific_text(d.view(), 1)).size() <= room) return text;
  // Without the point one more digit fits.
  if ((text = scientific_text(d.view(), d.digits.size())).size() <= room) return text;
  return {};
}

/// `d` rounded to `count` digits, half away from zero.
Digits rounded(Digits d, std::size_t count) {
  if (d.digits.size() <= count) return d;
  const bool up = d.digits[count] >= '5';
  d.digits.resize(count);
  if (up) {
    std::size_t i = count;
    while (i > 0 && d.digits[i - 1] == '9') --i;
    d.digits.resize(i);
    if (i > 0) {
      ++d.digits[i - 1];
    } else {
      d.digits = "1";
      ++d.point;
    }
  }
  while (!d.digits.empty() && d.digits.back() == '0') d.digits.pop_back();
  return d;
}

/// How a number was written, so that its successor looks like it.
struct Spelling {
  bool point = false, leading_zero = true;
  std::size_t decimals = 0;  ///< digits behind the point
  char letter = 0;           ///< of the exponent; 0: none
  bool plus = false;         ///< a positive exponent has a sign
  std::size_t exponent_digits = 0;
};

Spelling spelling_of(std::string_view cell) {
  Spelling s;
  const auto letter = cell.find_first_of("eEdD");
  const std::string_view mantissa = cell.substr(0, letter);
  if (const auto point = mantissa.find('.'); point != std::string_view::npos) {
    s.point = true;
    s.leading_zero = point > 0 && is_digit(mantissa[point - 1]);
    for (std::size_t i = point + 1; i < mantissa.size() && is_digit(mantissa[i]); ++i) ++s.decimals;
  }
  if (letter == std::string_view::npos) return s;
  s.letter = cell[letter];
  const std::string_view exponent = cell.substr(letter + 1);
  for (const char c : exponent)
    if (is_digit(c)) ++s.exponent_digits;
  s.plus = exponent.starts_with('+') || (exponent.starts_with('-') && s.exponent_digits > 1);
  return s;
}

/// One digit, the point, at least `decimals` more, and the exponent in the spelling of the old one.
std::string exponent_text(const Digits& d, const Spelling& like, std::size_t decimals) {
  std::string text = d.negative ? "-" : "";
  text += d.digits[0];
  if (like.point || d.digits.size() > 1) text += '.';
  text.append(d.digits, 1);
  if (d.digits.size() - 1 < decimals) text.append(decimals - (d.digits.size() - 1), '0');
  const int exponent = d.point - 1;
  std::string digits = std::to_string(std::abs(exponent));
  if (digits.size() < like.exponent_digits)
    digits.insert(0, like.exponent_digits - digits.size(), '0');
  text += like.letter;
  if (exponent < 0 || like.plus) text += exponent < 0 ? '-' : '+';
  return text + digits;
}

/// All digits of `d` in at most `room` columns, spelled as the number that it replaces: with or
/// without an exponent, a point, digits behind it. Empty: they do not fit in any spelling.
std::string print_like(const Digits& d, const Spelling& like, std::size_t room) {
  if (d.digits.empty()) return print(d, room);
  if (like.letter != 0) {
    for (const std::size_t decimals : {like.decimals, std::size_t{0}})
      if (std::string text = exponent_text(d, like, decimals); text.size() <= room) return text;
    return print(d, room);
  }
  std::string text = print(d, room);
  if (text.empty() || text.find('e') != std::string::npos) return text;
  if (!like.leading_zero)
    if (const auto zero = text.find("0."); zero == (d.negative ? 1U : 0U)) text.erase(zero, 1);
  if (!text.ends_with('.')) return text;
  if (!like.point)
    text.pop_back();
  else if (like.decimals > 0 && text.size() < room)
    text += '0';
  return text;
}

/// With as many digits as fit.
std::string print_rounded(const Digits& d, const Spelling& like, std::size_t room) {
  for (std::size_t count = std::max<std::size_t>(d.digits.size(), 1); count > 0; --count)
    if (std::string text = print_like(rounded(d, count), like, room); !text.empty()) return text;
  return {};
}

/// A computed product. Digits behind the twelfth that are there only because doubles are not
/// decimals are dropped, so that 1 inch there and back is 1 inch.
Digits product(const Digits& d, double value, const UnitFactor& factor) {
  const double result = static_cast<double>(static_cast<long double>(value) * factor.value);
  if (!std::isfinite(result) || result == 0) return {};
  constexpr int short_digits = 12;
  constexpr double of_doubles = 4e-16;
  // A text of fifteen digits or more may have been cut by its cell: half a unit of its last digit.
  const int count = static_cast<int>(d.digits.size());
  const double of_text = count >= 15 ? 0.5 * std::pow(10.0, 1 - count) : 0;
  const Digits snapped = decimal_of(result, short_digits);
  const double near = read_real(print(snapped, 40)).value;
  return std::fabs(near - result) <= (of_doubles + of_text) * std::fabs(result)
             ? snapped
             : decimal_of(result);
}

std::optional<Digits> scaled(std::string_view cell, const UnitFactor& factor) {
  auto d = parse(cell);
  if (!d || d->digits.empty()) return d;
  const RealCell read = read_real(cell);
  if (read.status != NumberStatus::ok && read.status != NumberStatus::implicit_exponent)
    return std::nullopt;
  if (factor.power) {
    d->point += *factor.power;
    return d;
  }
  d = product(*d, read.value, factor);
  return d->digits.empty() ? std::nullopt : d;
}

/// True if `text` holds every digit of `d`.
bool shows_all(std::string_view text, const Digits& d) {
  const auto shown = parse(text);
  return shown && shown->negative == d.negative && shown->digits == d.digits &&
         shown->point == d.point;
}

std::optional<int> power_of_ten(double ratio) {
  if (!(ratio > 0) || !std::isfinite(ratio)) return std::nullopt;
  const int power = static_cast<int>(std::lround(std::log10(ratio)));
  if (read_real("1e" + std::to_string(power)).value != ratio) return std::nullopt;
  return power;
}

UnitFactor base_factor(double from, double to) {
  UnitFactor f;
  if (from == to) {
    f.power = 0;
    return f;
  }
  f.value = static_cast<long double>(from) / static_cast<long double>(to);
  const auto a = power_of_ten(from), b = power_of_ten(to);
  if (a && b) f.power = *a - *b;
  return f;
}

}  // namespace

UnitFactor UnitFactor::inverse() const {
  UnitFactor f;
  if (power) f.power = -*power;
  f.value = 1 / value;
  return f;
}

UnitFactors::UnitFactors(const UnitSystem& from, const UnitSystem& to)
    : base_{base_factor(from.mass, to.mass), base_factor(from.length, to.length),
            base_factor(from.time, to.time)} {}

UnitFactor UnitFactors::of(const Dimension& dimension) const {
  const int exponents[3] = {dimension.mass, dimension.length, dimension.time};
  UnitFactor f;
  f.power = 0;
  for (int i = 0; i < 3; ++i) {
    if (exponents[i] == 0) continue;
    if (f.power && base_[i].power)
      *f.power += exponents[i] * *base_[i].power;
    else
      f.power.reset();
    for (int k = 0; k < std::abs(exponents[i]); ++k)
      f.value = exponents[i] > 0 ? f.value * base_[i].value : f.value / base_[i].value;
  }
  return f;
}

std::optional<ScaledText> scale_text(std::string_view cell, int width, const UnitFactor& factor) {
  if (width < 1) return std::nullopt;
  const auto result = scaled(cell, factor);
  if (!result) return std::nullopt;
  ScaledText out;
  out.text = print_rounded(*result, spelling_of(cell), static_cast<std::size_t>(width));
  if (out.text.empty()) return std::nullopt;
  const RealCell now = read_real(out.text);
  if (now.status != NumberStatus::ok || (now.value == 0 && !result->digits.empty()))
    return std::nullopt;
  // All digits are there and only the point has moved: it moves back.
  if (factor.power && shows_all(out.text, *result)) {
    out.exact = true;
    return out;
  }
  const auto back = scaled(out.text, factor.inverse());
  out.exact = back && read_real(print(*back, 400)).value == read_real(cell).value;
  return out;
}

}  // namespace deck::detail
