// Numbers times a unit factor as decimal text. Powers of ten move the point and keep all digits;
// other products are rounded once.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "deck/text.hpp"
#include "edit/convert/units/unit_system.hpp"
#include "text/shared/columns.hpp"
#include "text/shared/number_scan.hpp"

namespace deck::detail {
namespace {

/// 0.d1d2d3... * 10^point, without leading and trailing zeros; no digits: zero.
struct DecimalDigits {
  bool negative = false;
  std::string digits;
  int point = 0;
};

/// Larger exponents do not fit a deck's numbers.
constexpr int most_exponent = 10000;

std::optional<DecimalDigits> parse(std::string_view cell) {
  cell = trim(cell);
  std::size_t i = 0;
  const auto read_sign = [&] {
    const bool sign = i < cell.size() && (cell[i] == '+' || cell[i] == '-');
    return sign && cell[i++] == '-';
  };
  DecimalDigits d;
  d.negative = read_sign();
  bool any = false, point = false;
  for (; i < cell.size() && (is_digit(cell[i]) || (cell[i] == '.' && !point)); ++i) {
    if (cell[i] == '.') {
      point = true;
      continue;
    }
    any = true;
    const bool counts = !d.digits.empty() || cell[i] != '0';
    if (counts) d.digits += cell[i];
    if (counts && !point) ++d.point;
    if (!counts && point) --d.point;  // a zero behind the point
  }
  if (!any) return std::nullopt;
  if (i < cell.size()) {
    const char c = static_cast<char>(cell[i] | 0x20);
    if (c == 'e' || c == 'd') ++i;
    const bool minus = read_sign();
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
DecimalDigits decimal_of(double value, int significant = 0) {
  char buffer[64];
  const auto end = write_scientific(buffer, buffer + sizeof buffer, value, significant);
  return *parse({buffer, static_cast<std::size_t>(end.ptr - buffer)});
}

/// All digits of `d` in at most `room` columns; empty if they do not fit.
std::string print(const DecimalDigits& d, std::size_t room) {
  if (d.digits.empty()) return room >= 3 ? "0.0" : room == 2 ? "0." : "0";
  return readable_text({d.negative, d.digits, d.point}, room);
}

/// `d` rounded to `count` digits, half away from zero.
DecimalDigits rounded(DecimalDigits d, std::size_t count) {
  if (d.digits.size() <= count) return d;
  const bool up = d.digits[count] >= '5';
  d.digits.resize(count);
  if (up) {
    while (!d.digits.empty() && d.digits.back() == '9') d.digits.pop_back();
    if (!d.digits.empty()) {
      ++d.digits.back();
    } else {
      d.digits = "1";
      ++d.point;
    }
  }
  while (!d.digits.empty() && d.digits.back() == '0') d.digits.pop_back();
  return d;
}

/// Product with a factor. Drops digits behind the twelfth that come from binary round-off: 1 inch
/// there and back is 1 inch.
DecimalDigits product(const DecimalDigits& d, double value, const UnitFactor& factor) {
  const double result = static_cast<double>(static_cast<long double>(value) * factor.value);
  if (!std::isfinite(result) || result == 0) return {};
  constexpr int short_digits = 12;
  constexpr double of_doubles = 4e-16;
  // Texts of fifteen digits or more may be cut: error of half a unit of the last digit.
  const int count = static_cast<int>(d.digits.size());
  const double of_text = count >= 15 ? 0.5 * std::pow(10.0, 1 - count) : 0;
  const DecimalDigits snapped = decimal_of(result, short_digits);
  const double near = read_real(print(snapped, 40)).value;
  return std::fabs(near - result) <= (of_doubles + of_text) * std::fabs(result)
             ? snapped
             : decimal_of(result);
}

std::optional<DecimalDigits> scaled(std::string_view cell, const UnitFactor& factor) {
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

std::optional<int> power_of_ten(double ratio) {
  if (!(ratio > 0) || !std::isfinite(ratio)) return std::nullopt;
  const int power = static_cast<int>(std::lround(std::log10(ratio)));
  if (read_real("1e" + std::to_string(power)).value != ratio) return std::nullopt;
  return power;
}

UnitFactor base_factor(double from, double to) {
  UnitFactor f;
  f.value = static_cast<long double>(from) / static_cast<long double>(to);
  const auto a = power_of_ten(from), b = power_of_ten(to);
  if (from == to)
    f.power = 0;
  else if (a && b)
    f.power = *a - *b;
  return f;
}

}  // namespace

std::string UnitFactor::text() const {
  const auto number = format_real(static_cast<double>(value), widest_number);
  return power ? "1e" + std::to_string(*power) : number ? number->text : std::string("?");
}

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
  const auto result = width < 1 ? std::nullopt : scaled(cell, factor);
  if (!result) return std::nullopt;
  const auto room = static_cast<std::size_t>(width);
  ScaledText out;
  std::size_t count = std::max<std::size_t>(result->digits.size(), 1);
  // Keep one column blank if it costs no digit: readers separate numbers by blanks.
  out.text = print(*result, room - 1);
  while (out.text.empty() && count > 0)
    if (out.text = print(rounded(*result, count), room); out.text.empty()) --count;
  const RealCell now = read_real(out.text);
  if (now.status != NumberStatus::ok || (now.value == 0 && !result->digits.empty()))
    return std::nullopt;
  // All digits are there, only the point has moved.
  out.exact = factor.power && count >= result->digits.size();
  if (out.exact) return out;
  const auto back = scaled(out.text, factor.inverse());
  out.exact = back && read_real(print(*back, 400)).value == read_real(cell).value;
  return out;
}

}  // namespace deck::detail
