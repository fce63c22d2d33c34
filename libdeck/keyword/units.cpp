// Unit codes of headers and of /UNIT as factors to kilogram, metre, second.
#include <cstdlib>
#include <string>

#include "deck/keyword/deck.hpp"
#include "deck/text/number.hpp"

namespace deck {
namespace {

struct Prefix {
  std::string_view code;
  int power;
};
// Longest spelling first, so that "mu" is not taken for "m" + "u".
constexpr Prefix prefixes[] = {{"mu", -6},   {"\xc2\xb5", -6}, {"da", 1},  {"y", -24}, {"z", -21},
                               {"a", -18},   {"f", -15},       {"p", -12}, {"n", -9},  {"u", -6},
                               {"\xb5", -6}, {"m", -3},        {"c", -2},  {"d", -1},  {"h", 2},
                               {"k", 3},     {"K", 3},         {"M", 6},   {"G", 9},   {"T", 12},
                               {"P", 15},    {"E", 18},        {"Z", 21},  {"Y", 24},  {"", 0}};

/// factor^power without rounding surprises for the small integer powers of dimensions.
double integer_power(double base, int power) {
  double result = 1;
  for (int i = 0; i < std::abs(power); ++i) result *= base;
  return power < 0 ? 1 / result : result;
}

}  // namespace

std::optional<double> unit_factor(std::string_view code, char base) {
  while (!code.empty() && static_cast<unsigned char>(code.front()) <= ' ') code.remove_prefix(1);
  while (!code.empty() && static_cast<unsigned char>(code.back()) <= ' ') code.remove_suffix(1);
  if (code.empty()) return std::nullopt;
  const RealCell number = read_real(code);
  if (number.status == NumberStatus::ok || number.status == NumberStatus::implicit_exponent)
    return number.value > 0 ? std::optional(number.value) : std::nullopt;
  if (code.back() != base) return std::nullopt;
  const std::string_view prefix = code.substr(0, code.size() - 1);
  // Grams count from the kilogram.
  const int offset = base == 'g' ? -3 : 0;
  for (const Prefix& p : prefixes) {
    if (p.code != prefix) continue;
    // Correctly rounded, so that "mm" and "0.001" are the same unit.
    return read_real("1e" + std::to_string(p.power + offset)).value;
  }
  return std::nullopt;
}

double conversion_factor(const UnitSystem& from, const UnitSystem& to, const Dimension& d) {
  if (from == to) return 1;
  return integer_power(from.mass / to.mass, d.mass) *
         integer_power(from.length / to.length, d.length) *
         integer_power(from.time / to.time, d.time);
}

}  // namespace deck
