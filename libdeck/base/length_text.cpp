// Numbers as text.
#include "base/shared/length_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace deck {

std::string length_text(double length, int digits, double largest) {
  if (is_unbounded(length) || std::fabs(length) > largest) return "unbounded";
  return fmt::format("{:.{}g}", length, digits);
}

std::string figure_text(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string(not_computed);
}

}  // namespace deck
