// Tests of numbers in cells, read and written.
#include "deck/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <span>

#include "text/shared/number_scan.hpp"

namespace deck {
namespace {

constexpr double largest = std::numeric_limits<double>::max();

using Real = std::pair<const char*, double>;

void expect_reals(NumberStatus status, std::span<const Real> reals) {
  for (const auto& [text, value] : reals) {
    const RealCell r = read_real(text);
    EXPECT_EQ(r.value, value) << text;
    EXPECT_EQ(r.status, status) << text;
  }
}

TEST(ReadReal, AcceptsEverySpellingOfTheFormat) {
  const Real ok[] = {{"1.5", 1.5},         {"5", 5},
                     {"  -2.25  ", -2.25}, {"+1.5", 1.5},
                     {".5", .5},           {"5.", 5},
                     {"1e3", 1000},        {"1E+3", 1000},
                     {"1.D+3", 1000},      {"1.0d-3", 1e-3},
                     {"\t7\t", 7},         {"0", 0},
                     {"0e99999", 0},       {"0.000e-99999", 0},
                     {"1e22", 1e22},       {"1e23", 1e23},
                     {"4e-320", 4e-320},   {"5e-324", 5e-324},
                     {"1.5d0 ", 1.5},      {"1.5d300", 1.5e300}};
  expect_reals(NumberStatus::ok, ok);
  const Real many_digits[] = {{"00000000000000000000000000000001", 1},
                              {"123456789012345678901234567890", 123456789012345678901234567890.0},
                              {"9007199254740993", 9007199254740992.0},
                              {"1.7976931348623157e308", largest},
                              {"1234567890123456789012345D-2", 12345678901234567890123.45}};
  expect_reals(NumberStatus::ok, many_digits);
  const Real implicit_exponent[] = {{"1.5-3", 1.5e-3}, {"2+6", 2e6}, {"-1.5+3", -1500}};
  expect_reals(NumberStatus::implicit_exponent, implicit_exponent);
}

TEST(ReadReal, NamesEveryFault) {
  const Real blank[] = {{"", 0}, {"                    ", 0}};
  expect_reals(NumberStatus::blank, blank);
  const Real not_a_number[] = {{"abc", 0}, {".", 0}, {"-", 0}, {"+-1", 0}, {"e5", 0}};
  expect_reals(NumberStatus::not_a_number, not_a_number);
  const Real not_finite[] = {{"-INF", -std::numeric_limits<double>::infinity()},
                             {"Infinity", std::numeric_limits<double>::infinity()}};
  expect_reals(NumberStatus::not_finite, not_finite);
  const Real trailing_text[] = {{"1 2", 1},     {"1.0 5", 1},     {"1,5", 1},     {"1_0", 1},
                                {"1e", 1},      {"1.5e+", 1.5},   {"1.5.2", 1.5}, {"0x10", 16},
                                {"-0X1p3", -8}, {"0x1.8 y", 1.5}, {"0x", 0},      {"0xinf", 0},
                                {"0x-1", 0},    {"00x1", 0},      {"12abc", 12},  {"1e5 x", 1e5}};
  expect_reals(NumberStatus::trailing_text, trailing_text);
  const Real overflow[] = {{"1e400", largest},
                           {"-1e400", -largest},
                           {"1+999", largest},
                           {"1e99999999999999999999", largest}};
  expect_reals(NumberStatus::overflow, overflow);
  const Real underflow[] = {{"1e-400", 0}, {"1-999", 0}, {"1e-99999999999999999999", 0}};
  expect_reals(NumberStatus::underflow, underflow);
  EXPECT_TRUE(std::isnan(read_real("NaN").value));
  EXPECT_EQ(read_real("NaN").status, NumberStatus::not_finite);
}

TEST(ReadReal, TellsHugeFromTinyByTheWholeNumberNotByTheExponentSign) {
  const std::string zeros(400, '0');
  EXPECT_EQ(read_real("1" + zeros + "e-50").status, NumberStatus::overflow);
  EXPECT_EQ(read_real("0." + zeros + "1e50").status, NumberStatus::underflow);
  EXPECT_EQ(read_real("1" + zeros + "e-400").value, 1);
  EXPECT_EQ(read_real("0." + zeros + "1").status, NumberStatus::underflow);
  EXPECT_EQ(read_real("1" + zeros).status, NumberStatus::overflow);
  for (const char* nothing : {"0e99999", "-0.000e+99999", "0.0e-99999", ".0e99999"}) {
    EXPECT_EQ(read_real(nothing).status, NumberStatus::ok) << nothing;
    EXPECT_EQ(read_real(nothing).value, 0) << nothing;
  }
}

/// Reads the same text with std::from_chars after spelling it the C++ way.
double reference(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

TEST(ReadReal, AgreesWithFromCharsOnRandomSpellings) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 1000000; ++i) {
    std::string text;
    if (random() % 2) text += '-';
    const auto digits = [&](std::uint64_t most) {
      for (auto n = random() % (most + 1); n > 0; --n)
        text += static_cast<char>('0' + random() % 10);
    };
    text += static_cast<char>('0' + random() % 10);
    digits(10);
    if (random() % 4) {
      text += '.';
      digits(20);
    }
    if (random() % 2) {
      text += 'e';
      text += std::to_string(static_cast<int>(random() % 60) - 30);
    }
    const std::string cell =
        std::string(random() % 12, ' ') + text + std::string(random() % 3, ' ');
    const RealCell r = read_real(cell);
    ASSERT_EQ(r.status, NumberStatus::ok) << cell;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(r.value), std::bit_cast<std::uint64_t>(reference(text)))
        << cell;
  }
}

TEST(ReadReal, PlainSpellingsGiveTheSameByTheShortWay) {
  std::mt19937_64 random(11);
  std::size_t plain = 0;
  for (int i = 0; i < 300000; ++i) {
    const std::size_t width = 16 + random() % 9, first = 20;
    const std::size_t count = random() % (width + 1), point = random() % (count + 1);
    std::string line(first, "9- "[random() % 3]);  // what stands in front of the cell
    line.append(width, ' ');
    for (std::size_t k = 0; k < count; ++k)
      line[line.size() - 1 - k] = k == point ? '.' : static_cast<char>('0' + random() % 10);
    if (count < width && random() % 2) line[line.size() - 1 - count] = '-';
    if (random() % 4 == 0) line[first + random() % width] = "0. -+e\n\t"[random() % 8];
    if (random() % 8 == 0) line[first + random() % width] = static_cast<char>(random());
    const std::string_view cell = std::string_view(line).substr(first);
    double value = 0;
    const bool taken = detail::scan_plain_real(cell.data(), cell.data() + width, value);
    double twenty = 0;
    if (width == 20) {
      ASSERT_EQ(detail::scan_plain_twenty(cell.data(), twenty), taken) << cell;
    }
    if (!taken) continue;
    if (width == 20) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(twenty), std::bit_cast<std::uint64_t>(value)) << cell;
    }
    ++plain;
    const RealCell r = detail::scan_real<detail::Blanks::spaces>(cell.data(), cell.data() + width);
    ASSERT_EQ(r.status, NumberStatus::ok) << cell;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(r.value), std::bit_cast<std::uint64_t>(value)) << cell;
  }
  EXPECT_GT(plain, 100000u);
}

TEST(ReadInteger, TheShortWayTakesBlanksAndUpToEightDigitsAndNothingElse) {
  std::mt19937_64 random(17);
  std::size_t plain = 0;
  for (int i = 0; i < 1000000; ++i) {
    std::string cell(10, ' ');
    for (std::size_t k = random() % 11; k > 0; --k)
      cell[10 - k] = static_cast<char>('0' + random() % 10);
    if (random() % 3 == 0) cell[random() % 10] = static_cast<char>(random());
    if (random() % 6 == 0) cell[random() % 10] = " 0-+/:\t\r"[random() % 8];
    const std::size_t first = cell.find_first_not_of(' ');
    const bool expected = first != std::string::npos && first >= 2 &&
                          cell.find_first_not_of("0123456789", first) == std::string::npos;
    std::uint64_t value = 0, other = 0;
    ASSERT_EQ(detail::unlike_id(cell.data(), value) == 0, expected) << cell;
    ASSERT_EQ(detail::scan_plain_integer(cell.data(), cell.data() + 10, other), expected) << cell;
    if (!expected) continue;
    ++plain;
    ASSERT_EQ(value, std::stoull(cell));
    ASSERT_EQ(other, value);
  }
  EXPECT_GT(plain, 300000u);
}

TEST(ReadReal, NeverLooksOutsideTheCell) {
  // Exact-size heap copies, so that a sanitizer sees a byte too many; without one the digits that
  // stand around the cell must not change the value.
  const std::string line = "99999999123456.5e199999999";
  for (std::size_t first = 0; first < line.size(); ++first)
    for (std::size_t size = 0; size <= line.size() - first; ++size) {
      const std::unique_ptr<char[]> copy(new char[size]);
      std::memcpy(copy.get(), line.data() + first, size);
      const RealCell alone = read_real({copy.get(), size});
      const RealCell within = read_real(std::string_view(line).substr(first, size));
      EXPECT_EQ(alone.value, within.value);
      EXPECT_EQ(alone.status, within.status);
      const IntegerCell a = read_integer({copy.get(), size});
      const IntegerCell b = read_integer(std::string_view(line).substr(first, size));
      EXPECT_EQ(a.value, b.value);
      EXPECT_EQ(a.status, b.status);
    }
}

TEST(ReadInteger, TakesEighteenDigits) {
  EXPECT_EQ(read_integer("123456789012345678").value, 123456789012345678);
  for (const char* more : {"1234567890123456789", "99999999999999999999999999"}) {
    EXPECT_EQ(read_integer(more).value, 0) << more;
    EXPECT_EQ(read_integer(more).status, NumberStatus::overflow) << more;
  }
}

TEST(ReadInteger, EveryShortTextOfASmallAlphabetMatchesTheDefinition) {
  // All texts of up to six characters: blanks, sign, digits, text.
  const std::string alphabet = " -+09x";
  const auto expected = [&](const std::string& s) -> IntegerCell {
    std::size_t i = s.find_first_not_of(' ');
    if (i == std::string::npos) return {0, NumberStatus::blank};
    const bool minus = s[i] == '-';
    if (minus || s[i] == '+') ++i;
    std::int64_t value = 0;
    std::size_t digits = 0;
    for (; i < s.size() && s[i] >= '0' && s[i] <= '9'; ++i, ++digits)
      value = value * 10 + (s[i] - '0');
    if (digits == 0) return {0, NumberStatus::not_a_number};
    const bool rest = s.find_first_not_of(' ', i) != std::string::npos;
    return {minus ? -value : value, rest ? NumberStatus::trailing_text : NumberStatus::ok};
  };
  for (std::size_t length = 0, count = 1; length <= 6; ++length, count *= alphabet.size())
    for (std::size_t code = 0; code < count; ++code) {
      std::string text;
      for (std::size_t k = 0, rest = code; k < length; ++k, rest /= alphabet.size())
        text += alphabet[rest % alphabet.size()];
      for (const std::string& cell : {text, "    " + text, text + "    "}) {
        const IntegerCell n = read_integer(cell), e = expected(cell);
        ASSERT_EQ(n.status, e.status) << '[' << cell << ']';
        ASSERT_EQ(n.value, e.value) << '[' << cell << ']';
      }
    }
}

// ---- writing ------------------------------------------------------------------------------------

/// The smallest distance any spelling of `value` in `width` columns can be from it, by trying them
/// all: every number of digits, every place of the point, with and without exponent.
double best_distance(double value, int width) {
  double best = std::numeric_limits<double>::infinity();
  for (int digits = 1; digits <= 17; ++digits) {
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, std::fabs(value),
                                   std::chars_format::scientific, digits - 1);
    const std::string text(buffer, end.ptr);
    const auto mark = text.find('e');
    std::string mantissa = text.substr(0, mark);
    std::erase(mantissa, '.');
    while (mantissa.size() > 1 && mantissa.back() == '0') mantissa.pop_back();
    const int exponent = std::stoi(text.substr(mark + 1));
    const auto consider = [&](std::string spelled) {
      if (value < 0) spelled.insert(0, "-");
      if (spelled.size() > static_cast<std::size_t>(width)) return;
      best = std::min(best, std::fabs(reference(spelled) - value));
    };
    const int count = static_cast<int>(mantissa.size());
    for (int point = -25; point <= 25; ++point) {
      // `point`: digits in front of the decimal point.
      std::string spelled;
      if (point <= 0)
        spelled = "." + std::string(static_cast<std::size_t>(-point), '0') + mantissa;
      else if (point >= count)
        spelled = mantissa + std::string(static_cast<std::size_t>(point - count), '0') + ".";
      else
        spelled = mantissa.substr(0, static_cast<std::size_t>(point)) + "." +
                  mantissa.substr(static_cast<std::size_t>(point));
      const int left = exponent + 1 - point;
      if (left == 0) consider(spelled);
      consider(spelled + "e" + std::to_string(left));
      if (point >= count)
        consider(spelled.substr(0, spelled.size() - 1) + "e" + std::to_string(left));
    }
  }
  return best;
}

double random_double(std::mt19937_64& random) {
  for (;;) {
    const double v = std::bit_cast<double>(random());
    if (std::isfinite(v)) return v;
  }
}

TEST(FormatReal, NoSpellingThatFitsIsCloser) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 6000; ++i) {
    double v = random_double(random);
    if (i % 2)
      v = std::ldexp(static_cast<double>(random() >> 11), -53) *
          std::pow(10.0, static_cast<int>(random() % 40) - 20);
    if (i % 3 == 0) v = static_cast<double>(static_cast<float>(v));
    if (v == 0 || !std::isfinite(v)) continue;
    for (const int width : {20, 16, 10, 8}) {
      const auto text = format_real(v, width);
      const double best = best_distance(v, width);
      ASSERT_EQ(text.has_value(), std::isfinite(best)) << v << ' ' << width;
      if (!text) continue;
      ASSERT_LE(text->text.size(), static_cast<std::size_t>(width));
      const double read = read_real(text->text).value;
      EXPECT_LE(std::fabs(read - v), best) << text->text << ' ' << width;
      EXPECT_EQ(text->exact, read == v);
    }
  }
}

TEST(FormatReal, MillionsOfRandomDoublesReadBackAsSaid) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 1000000; ++i) {
    const double v = random_double(random);
    const auto text = format_real(v, 20);
    ASSERT_TRUE(text.has_value()) << v;
    ASSERT_LE(text->text.size(), 20u);
    const RealCell r = read_real(text->text);
    ASSERT_EQ(r.status, NumberStatus::ok) << text->text;
    ASSERT_EQ(text->exact, r.value == v) << text->text;
    ASSERT_NE(text->text.find_first_of(".e"), std::string::npos) << text->text;
    const auto f = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(f)) continue;
    const auto single = format_real(static_cast<double>(f), 20);
    ASSERT_TRUE(single.has_value()) << f;
    ASSERT_EQ(static_cast<float>(read_real(single->text).value), f) << single->text;
  }
}

TEST(FormatReal, WritesReadableNumbersReadably) {
  const std::pair<double, const char*> cases[] = {
      {1, "1."},      {0, "0.0"},     {-0.0, "0.0"},      {0.001, "0.001"}, {1000, "1000."},
      {-2.5, "-2.5"}, {1e22, "1e22"}, {1.5e-7, "1.5e-7"}, {0.1, "0.1"},     {210000, "210000."},
  };
  for (const auto& [value, text] : cases) EXPECT_EQ(format_real(value, 20)->text, text);
}

TEST(FormatReal, GivesUpOnlyWhereNothingFits) {
  EXPECT_FALSE(format_real(std::nan(""), 20));
  EXPECT_FALSE(format_real(largest * 10, 20));
  EXPECT_FALSE(format_real(1, 0));
  EXPECT_FALSE(format_real(0, 1));
  EXPECT_EQ(format_real(0, 2)->text, "0.");
  EXPECT_EQ(format_real(-0.0, 3)->text, "0.0");
  EXPECT_FALSE(format_real(1e-300, 5));
  EXPECT_EQ(format_real(1e-300, 6)->text, "1e-300");
  EXPECT_EQ(format_real(123456, 3)->text, "1e5");
  EXPECT_FALSE(format_real(123456, 3)->exact);
  EXPECT_FALSE(format_real(-0.5, 2));
  EXPECT_EQ(format_real(largest, 8)->text, "1797e305") << "never beyond the largest number";
}

TEST(FormatInteger, RefusesWhatDoesNotFit) {
  EXPECT_EQ(*format_integer(-12, 3), "-12");
  EXPECT_FALSE(format_integer(-12, 2));
  EXPECT_FALSE(format_integer(1, -1));
  EXPECT_EQ(*format_integer(std::numeric_limits<std::int64_t>::min(), 20), "-9223372036854775808");
}

}  // namespace
}  // namespace deck
