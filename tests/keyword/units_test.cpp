// Unit codes and conversion factors.
#include <gtest/gtest.h>

#include "deck/keyword.hpp"

namespace deck {
namespace {

TEST(UnitFactor, PrefixAndBaseGiveTheFactorToKilogramMetreSecond) {
  struct Case {
    const char* code;
    char base;
    double factor;
  };
  const Case cases[] = {
      {"m", 'm', 1},      {"mm", 'm', 1e-3},    {"km", 'm', 1e3},     {"cm", 'm', 1e-2},
      {"dm", 'm', 1e-1},  {"dam", 'm', 10},     {"hm", 'm', 100},     {"Mm", 'm', 1e6},
      {"mum", 'm', 1e-6}, {"um", 'm', 1e-6},    {"\xb5m", 'm', 1e-6}, {"\xc2\xb5m", 'm', 1e-6},
      {"nm", 'm', 1e-9},  {"pm", 'm', 1e-12},   {"fm", 'm', 1e-15},   {"am", 'm', 1e-18},
      {"zm", 'm', 1e-21}, {"ym", 'm', 1e-24},   {"Gm", 'm', 1e9},     {"Tm", 'm', 1e12},
      {"Pm", 'm', 1e15},  {"Em", 'm', 1e18},    {"Zm", 'm', 1e21},    {"Ym", 'm', 1e24},
      {"s", 's', 1},      {"ms", 's', 1e-3},    {"mus", 's', 1e-6},   {"g", 'g', 1e-3},
      {"kg", 'g', 1},     {"Kg", 'g', 1},       {"Mg", 'g', 1e3},     {"mg", 'g', 1e-6},
      {"Gg", 'g', 1e6},   {"0.001", 'm', 1e-3}, {"  mm ", 'm', 1e-3}, {"1.D-3", 's', 1e-3},
      {"25.4", 'm', 25.4}};
  for (const Case& c : cases) {
    const auto factor = unit_factor(c.code, c.base);
    ASSERT_TRUE(factor) << c.code;
    EXPECT_EQ(*factor, c.factor) << c.code;
  }
}

TEST(UnitFactor, AnythingElseIsUnknown) {
  for (const char* code :
       {"", "0", "-1", "mn", "qm", "kgm", "inch", "nan", "inf", "mm mm", "s", "M"})
    EXPECT_FALSE(unit_factor(code, 'm')) << code;
}

TEST(ConversionFactor, MultipliesThePowersOfTheBaseUnits) {
  UnitSystem from, to;
  from.mass = 1000;    // Mg
  from.length = 1e-3;  // mm
  from.time = 1;       // s
  to.time = 1e-3;      // kg m ms
  EXPECT_EQ(conversion_factor(from, from, {1, -1, -2}), 1);
  EXPECT_DOUBLE_EQ(conversion_factor(from, to, {0, 1, 0}), 1e-3);
  EXPECT_DOUBLE_EQ(conversion_factor(from, to, {1, -1, -2}), 1000 * 1000 / 1e6);
  EXPECT_EQ(conversion_factor(from, to, {}), 1);
  EXPECT_EQ(conversion_factor(from, to, {0, 0, 0, 1}), 1);  // temperatures are not scaled
}

TEST(ConversionFactor, ThereAndBackIsTheIdentity) {
  UnitSystem a, b;
  a.mass = 1000;
  a.length = 1e-3;
  b.time = 1e-3;
  for (std::int8_t m = -2; m <= 2; ++m)
    for (std::int8_t l = -3; l <= 3; ++l)
      for (std::int8_t t = -3; t <= 3; ++t) {
        const Dimension d{m, l, t};
        EXPECT_DOUBLE_EQ(conversion_factor(a, b, d) * conversion_factor(b, a, d), 1);
      }
}

}  // namespace
}  // namespace deck
