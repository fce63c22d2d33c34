// Rounded numbers and bounds of moves, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "edit/fix/common.hpp"
#include "edit/fix/nodes/ways_out.hpp"

namespace deck::test {
namespace {

TEST(RoundedNumbers, AreTheNearestOnTheirSide) {
  const auto down = [](double bound, int digits, int width = 20) {
    const auto r = detail::round_down(bound, digits, width);
    return r ? r->value : -1;
  };
  const auto up = [](double bound, int digits, int width = 20) {
    const auto r = detail::round_up(bound, digits, width);
    return r ? r->value : -1;
  };
  EXPECT_EQ(down(1.2356, 3), 1.23);
  EXPECT_EQ(up(1.2356, 3), 1.24);
  EXPECT_EQ(down(1.2344, 3), 1.23);
  EXPECT_EQ(up(1.2344, 3), 1.24);
  EXPECT_EQ(down(1.23, 3), 1.23) << "the bound itself is allowed";
  EXPECT_EQ(up(1.23, 3), 1.23);
  EXPECT_EQ(down(1.0001, 2), 1.0);
  EXPECT_EQ(up(9.99, 2), 10.0);
  EXPECT_EQ(down(0.099999, 2), 0.099);
  EXPECT_EQ(down(0.96, 1), 0.9);
  EXPECT_EQ(up(1.5e-7, 1), 2e-7);
  EXPECT_EQ(down(1.5e9, 1), 1e9);
  EXPECT_EQ(down(0, 3), -1);
  EXPECT_EQ(down(-1, 3), -1);
  // Fewer digits where the columns hold no more.
  EXPECT_EQ(down(123.456789, 9, 5), 123.4);
  EXPECT_EQ(up(123.456789, 9, 5), 123.5);
  EXPECT_EQ(detail::round_down(1.23, 3, 20, 1.23)->value, 1.22) << "below the number";
  EXPECT_EQ(detail::round_down(1.235, 3, 20, 1.24)->value, 1.23);
  EXPECT_EQ(detail::round_down(123.456789, 9, 5)->text, "123.4");
}

/// Of directions at right angles each gives its own share; what is left is made as short as
/// allowed: along each direction the reach, and in a corner of several the root of 3 times as much.
TEST(BoundsOfMoves, OfManyNodesAtOnceAreThoseOfEach) {
  detail::DepthBounds bounds;
  detail::NodeMoves wanted;
  std::vector<std::array<double, 3>> expected;
  std::vector<bool> at_bound;
  for (NodeIndex n = 0; n < 37; ++n) {
    const std::size_t axes = 1 + n % 3;
    const double sign = n % 2 == 0 ? 1 : -1, reach = 2 + n % 3;
    const std::array<double, 3> asked{3.0 * (n % 5) - 6, 2.0 * (n % 7) - 6, 4.0 * (n % 3) - 3};
    wanted.emplace_back(n, Vec{asked[0], asked[1], asked[2]});
    std::array<double, 3> by = asked;
    double farthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      by[k] = k < axes ? sign * std::max(0.0, sign * asked[k]) : 0;
      farthest = std::max(farthest, std::abs(by[k]));
      if (k >= axes) continue;
      detail::PairState state;
      state.nodes[0] = n;
      state.count = state.secondary_count = 1;
      bounds.add({}, state, {k == 0 ? sign : 0, k == 1 ? sign : 0, k == 2 ? sign : 0}, reach);
    }
    const double length = std::sqrt(by[0] * by[0] + by[1] * by[1] + by[2] * by[2]);
    farthest = std::max(farthest, length / (axes > 1 ? std::sqrt(3.0) : 1));
    if (farthest > reach)
      for (double& v : by) v *= reach / farthest;
    expected.push_back(by);
    at_bound.push_back(farthest >= reach);
  }
  EXPECT_GT(std::count(at_bound.begin(), at_bound.end(), true), 9);
  EXPECT_GT(std::count(at_bound.begin(), at_bound.end(), false), 9);
  for (const int threads : {1, 3}) {
    const auto places = bounds.allowed(wanted, threads);
    ASSERT_EQ(places.size(), expected.size());
    for (std::size_t n = 0; n < places.size(); ++n) {
      SCOPED_TRACE(n);
      EXPECT_NEAR(places[n].by.x, expected[n][0], 1e-12);
      EXPECT_NEAR(places[n].by.y, expected[n][1], 1e-12);
      EXPECT_NEAR(places[n].by.z, expected[n][2], 1e-12);
      EXPECT_EQ(places[n].at_bound, at_bound[n]);
    }
  }
}

}  // namespace
}  // namespace deck::test
