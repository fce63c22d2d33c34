// Numbers from and to text without the standard library's functions: the same bits and the same
// characters as with them; and the length of three doubles.
#include "base/shared/real_text.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base/shared/bits.hpp"
#include "base/shared/length3.hpp"

namespace deck {
namespace {

#ifdef __cpp_lib_to_chars

std::string written(std::to_chars_result (*write)(char*, char*, double, int), double value,
                    int significant) {
  char buffer[64];
  const auto end = write(buffer, buffer + sizeof buffer, value, significant);
  return end.ec == std::errc() ? std::string(buffer, end.ptr) : "too long";
}

std::to_chars_result standard(char* first, char* last, double value, int significant) {
  return significant == 0
             ? std::to_chars(first, last, value, std::chars_format::scientific)
             : std::to_chars(first, last, value, std::chars_format::scientific, significant - 1);
}

/// Doubles of every kind: all exponents, few digits, ends of ranges.
std::vector<double> values() {
  std::vector<double> out{0.0,
                          -0.0,
                          1.0,
                          10.0,
                          0.1,
                          123456.0,
                          1e15,
                          1e16,
                          1e17,
                          1e22,
                          1e23,
                          5e-324,
                          2.2250738585072014e-308,
                          1.7976931348623157e308,
                          9007199254740993.0,
                          5.684341886080802e-14,
                          0.5,
                          2.5,
                          0.125,
                          -1e-5,
                          1e-4};
  for (int e = -1074; e <= 1023; ++e) out.push_back(std::ldexp(1.0, e));
  std::mt19937_64 random(7);
  while (out.size() < 100000) {
    const auto v = bit_cast<double>(static_cast<std::uint64_t>(random()));
    if (std::isfinite(v)) out.push_back(v);
    out.push_back(static_cast<double>(random() % 100000) / 1000.0);
  }
  return out;
}

TEST(PortableRealText, WritesWhatTheStandardLibraryWrites) {
  int digits = 0;
  for (const double v : values()) {
    ASSERT_EQ(written(portable::write_real_text, v, 0), written(standard, v, 0));
    digits = digits % 17 + 1;
    ASSERT_EQ(written(portable::write_real_text, v, digits), written(standard, v, digits))
        << digits;
  }
}

TEST(PortableRealText, SaysWhereTheBufferIsTooShort) {
  char buffer[4];
  EXPECT_EQ(portable::write_real_text(buffer, buffer + 4, 1.5, 0).ec, std::errc::value_too_large);
  char fits[5];
  ASSERT_EQ(portable::write_real_text(fits, fits + 5, 1.0, 0).ec, std::errc());
  EXPECT_EQ(std::string(fits, 5), "1e+00");
}

using Reader = std::from_chars_result (*)(const char*, const char*, double&);

std::from_chars_result standard_decimal(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}
std::from_chars_result standard_hexadecimal(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value, std::chars_format::hex);
}

void expect_same(const std::string& text, Reader ours, Reader theirs) {
  double a = 0.25, b = 0.25;
  const char* const p = text.data();
  const auto mine = ours(p, p + text.size(), a), other = theirs(p, p + text.size(), b);
  EXPECT_EQ(mine.ec, other.ec) << text;
  EXPECT_EQ(mine.ptr - p, other.ptr - p) << text;
  EXPECT_EQ(bit_cast<std::uint64_t>(a), bit_cast<std::uint64_t>(b)) << text;
}

TEST(PortableRealText, ReadsWhatTheStandardLibraryReads) {
  for (const char* text : {"",
                           "-",
                           "+1",
                           ".",
                           "-.",
                           "e5",
                           "1",
                           "-1",
                           "1.",
                           ".5",
                           "-.5e1x",
                           "1e",
                           "1e+",
                           "1e-",
                           "1ex",
                           "1e5",
                           "1E5",
                           "1..2",
                           "1.2.3",
                           "1e400",
                           "-1e400",
                           "1e-400",
                           "0e999",
                           "0.000e-999",
                           "4.9e-324",
                           "2e-324",
                           "2.4703282292062327e-324",
                           "2.4703282292062328e-324",
                           "2.5e-324",
                           "1.7976931348623158e308",
                           "1.7976931348623159e308",
                           "9007199254740993",
                           "inf",
                           "-INF",
                           "infinity",
                           "infinit",
                           "nan",
                           "NaN(x)",
                           "nan(",
                           "nan(1 )",
                           "-nan",
                           "0x1p3",
                           " 1",
                           "1 ",
                           "123456789012345678901234567890",
                           "1e0000000000000000005",
                           "1,5",
                           "1d5"})
    expect_same(text, portable::read_real_text, standard_decimal);
  std::mt19937_64 random(11);
  for (int i = 0; i < 100000; ++i) {
    std::string text = std::to_string(random() % 1000);
    text += '.' + std::to_string(random());
    if (i % 2 == 0) text += std::to_string(random());
    text += 'e' + std::to_string(static_cast<int>(random() % 700) - 350);
    expect_same(text, portable::read_real_text, standard_decimal);
  }
}

TEST(PortableRealText, ReadsHexadecimalDigitsAsTheStandardLibraryDoes) {
  for (const char* text : {"", "1", "ff", "FF.8", "1p3", "1p", "1.8p-1", ".8", "g", "-1", "1p99999",
                           "1p-99999", "0p99999", "1.00000000000008p0", "1.000000000000081p0",
                           "1.fffffffffffff8p1023", "1p-1074", "1p-1075", "1.8p-1075"})
    expect_same(text, portable::read_hexadecimal_text, standard_hexadecimal);
}

#endif

TEST(Length3, IsWithinARoundingOfTheRootOfTheSquares) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    const auto part = [&] { return static_cast<double>(random() % 2001) - 1000.0; };
    const double x = part(), y = part(), z = part();
    const double exact = std::sqrt(x * x + y * y + z * z);
    EXPECT_NEAR(length3(x, y, z), exact, 4e-16 * exact);
  }
}

TEST(Length3, NeitherOverflowsNorVanishes) {
  EXPECT_EQ(length3(0, 0, 0), 0.0);
  EXPECT_EQ(length3(-3e300, 0, 4e300), 5e300);
  EXPECT_EQ(length3(3e-300, -4e-300, 0), 5e-300);
  EXPECT_TRUE(std::isnan(length3(1, std::numeric_limits<double>::quiet_NaN(), 2)));
}

#ifdef __GLIBCXX__
TEST(Length3, IsWhatTheHostsHypotMakes) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 10000; ++i) {
    const auto part = [&] {
      return std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 40) - 80);
    };
    const double x = part(), y = -part(), z = part();
    EXPECT_EQ(length3(x, y, z), std::hypot(x, y, z));
  }
}
#endif

}  // namespace
}  // namespace deck
