// Number cells: every status and value must agree with a plain reference, and writing a value and
// reading it back must say the truth about exactness.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "deck/text.hpp"
#include "text/shared/number_scan.hpp"

namespace {

void require(bool good) {
  if (!good) std::abort();
}

/// Reads a clean cell ("  -1.5d3 ") with strtod after spelling it the C way; nullptr: not clean.
bool reference(std::string_view cell, double& value) {
  const auto blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  while (!cell.empty() && blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && blank(cell.back())) cell.remove_suffix(1);
  std::string text;
  std::size_t i = 0, digits = 0;
  const auto digit = [&] { return i < cell.size() && cell[i] >= '0' && cell[i] <= '9'; };
  if (i < cell.size() && (cell[i] == '-' || cell[i] == '+')) text += cell[i++];
  for (; digit(); ++digits) text += cell[i++];
  if (i < cell.size() && cell[i] == '.') text += cell[i++];
  for (; digit(); ++digits) text += cell[i++];
  if (digits == 0) return false;
  if (i < cell.size()) {
    if (std::strchr("eEdD", cell[i]) != nullptr && cell[i] != '\0')
      ++i;
    else if (cell[i] != '+' && cell[i] != '-')
      return false;
    text += 'e';
    if (i < cell.size() && (cell[i] == '-' || cell[i] == '+')) text += cell[i++];
    if (!digit()) return false;
    while (digit()) text += cell[i++];
    if (i != cell.size()) return false;
  }
  value = std::strtod(text.c_str(), nullptr);
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 300) return 0;
  // A copy of its own, so that the sanitizer sees a byte read too many.
  const std::unique_ptr<char[]> copy(new char[size]);
  if (size > 0) std::memcpy(copy.get(), data, size);
  const std::string_view cell(copy.get(), size);
  const deck::RealCell real = deck::read_real(cell);
  const deck::IntegerCell integer = deck::read_integer(cell);
  require(std::isfinite(real.value) || real.status == deck::NumberStatus::not_finite);
  double expected = 0;
  if (reference(cell, expected)) {
    if (real.status == deck::NumberStatus::overflow) {
      require(std::isinf(expected));
    } else if (real.status == deck::NumberStatus::underflow) {
      require(expected == 0);
    } else {
      require(real.status == deck::NumberStatus::ok ||
              real.status == deck::NumberStatus::implicit_exponent);
      require(real.value == expected);
    }
  } else {
    require(real.status != deck::NumberStatus::ok &&
            real.status != deck::NumberStatus::implicit_exponent);
  }
  if (integer.status == deck::NumberStatus::ok && real.status == deck::NumberStatus::ok)
    require(static_cast<double>(integer.value) == real.value);
  std::uint64_t plain = 0;
  if (size >= 8 && deck::detail::scan_plain_integer(cell.data(), cell.data() + size, plain)) {
    require(integer.status == deck::NumberStatus::ok);
    require(static_cast<std::uint64_t>(integer.value) == plain);
    std::uint64_t id = 0;
    require(size != 10 || (deck::detail::unlike_id(cell.data(), id) == 0 && id == plain));
  }
  double coordinate = 0;
  if (size >= 16 && deck::detail::scan_plain_real(cell.data(), cell.data() + size, coordinate)) {
    require(real.status == deck::NumberStatus::ok);
    require(coordinate == real.value && std::signbit(coordinate) == std::signbit(real.value));
    require(size != 20 || deck::detail::scan_plain_twenty(cell.data(), coordinate));
  }
  double value = 0;
  if (size >= 8) std::memcpy(&value, data, 8);
  for (const int width : {8, 10, 20}) {
    const auto text = deck::format_real(value, width);
    if (!text) continue;
    require(text->text.size() <= static_cast<std::size_t>(width));
    const deck::RealCell back = deck::read_real(text->text);
    require(back.status == deck::NumberStatus::ok);
    require(text->exact == (back.value == value));
  }
  return 0;
}
