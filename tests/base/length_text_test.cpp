// A length as text.
#include "base/shared/words.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace deck {
namespace {

TEST(LengthText, HasDigitsAsAskedForAndIsUnboundedBeyondTheBound) {
  EXPECT_EQ(length_text(1.23456789), "1.23457");
  EXPECT_EQ(length_text(1.23456789, 3), "1.23");
  EXPECT_EQ(length_text(-0.0), "-0");
  for (const double v : {std::nan(""), double{INFINITY}, -double{INFINITY}, 1.4e154, 1.7e308})
    EXPECT_EQ(length_text(v), "unbounded") << v;
  EXPECT_EQ(length_text(1e154), "1e+154") << "its square is a number";
  EXPECT_EQ(length_text(10, 6, 10), "10");
  EXPECT_EQ(length_text(-10.5, 6, 10), "unbounded");
}

}  // namespace
}  // namespace deck
