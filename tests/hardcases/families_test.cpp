// What the recipes of the hard-case families sweep, and that their samples stay the same ones: the
// figures of tools/docs/accuracy.md are those of these samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "accuracy/shared/accuracy.hpp"
#include "contact/shared/filtered.hpp"

namespace deck {
namespace {

using P = Point3<double>;

double sum_of(const P& p) { return p.x + p.y + p.z; }
double length_of(const P& p) { return std::sqrt(dot(p, p)); }
double size_of(const PairSample& s) {
  double out = 0;
  for (const P& p : s.x) out = std::max({out, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return out;
}
P mean_of_corners(const PairSample& s) { return 0.25 * (s.x[0] + s.x[1] + s.x[2] + s.x[3]); }
double plain_distance(const PairSample& s) {
  return s.edges ? closest_between_edges<Form::robust>(s.x[0], s.x[1], s.x[2], s.x[3]).distance
                 : closest_on_segment<Form::robust>(s.x[4], s.corners(), s.triangle).distance();
}
/// Height of the node over a quad whose plane is upright to an axis: the coordinate that the
/// corners have in common.
double height_of(const PairSample& s) {
  for (const auto part : {&P::x, &P::y, &P::z})
    if (s.x[0].*part == s.x[1].*part && s.x[0].*part == s.x[2].*part &&
        s.x[0].*part == s.x[3].*part)
      return s.x[4].*part - s.x[0].*part;
  return std::numeric_limits<double>::quiet_NaN();
}

/// A parameter of a family that is swept evenly from `low` to `high`.
struct Sweep {
  const char* what;
  int family;
  std::function<double(const PairSample&)> measure;
  double low, high;
};

const Sweep sweeps[] = {
    {"decades of the warp of a saddle", 9,
     [](const PairSample& s) { return std::log10(sum_of(s.x[0]) - 2); }, -2, 0.5},
    {"decades of the warp over a focal line", 10,
     [](const PairSample& s) { return std::log10(sum_of(s.x[0]) - 2); }, -0.5, 3},
    {"decades of the height of a near touch", 16,
     [](const PairSample& s) { return std::log10(std::abs(height_of(s))); }, -300, -6},
    {"whole heights over a plane", 22, [](const PairSample& s) { return height_of(s); }, 0, 3},
    {"decades of half the wall", 32,
     [](const PairSample& s) { return std::log10(2 * std::abs(height_of(s))); }, -3, 1},
    {"decades of the angle between two sides, in degrees", 40,
     [](const PairSample& s) {
       return std::log10(2 * std::atan2(s.x[1].y, s.x[1].x) * 180 / std::acos(-1.0));
     },
     -4, 2.255},
    {"the node before the sharp edge", 40, [](const PairSample& s) { return s.x[4].x; }, 0, 1.2},
    {"the node along the sharp edge", 40, [](const PairSample& s) { return s.x[4].z; }, -1.2, 1.2},
};

TEST(HardCaseSweeps, FillTheirRangeAndDoNotLeaveIt) {
  for (const Sweep& sweep : sweeps) {
    double low = 1e300, high = -1e300;
    for (const PairSample& s : hard_cases(sweep.family, 3000)) {
      const double v = sweep.measure(s);
      ASSERT_FALSE(std::isnan(v)) << sweep.what;
      low = std::min(low, v);
      high = std::max(high, v);
    }
    const double range = sweep.high - sweep.low, rounding = 1e-9 * (1 + std::abs(sweep.high));
    EXPECT_GE(low, sweep.low - rounding) << sweep.what;
    EXPECT_LE(high, sweep.high + rounding) << sweep.what;
    EXPECT_LE(low, sweep.low + 0.1 * range) << sweep.what;
    EXPECT_GE(high, sweep.high - 0.1 * range) << sweep.what;
  }
}

TEST(HardCaseSweeps, UnitsAreOneOfTwoSizes) {
  for (const auto& [family, small, big] :
       {std::tuple(19, 1e-30, 1e-12), std::tuple(20, 1e30, 1e75)}) {
    std::size_t smaller = 0, all = 0;
    for (const PairSample& s : hard_cases(family, 400)) {
      const double size = size_of(s);
      const bool is_small = size < std::sqrt(small * big);
      EXPECT_LT(size, 10 * (is_small ? small : big));
      EXPECT_GT(size, 0.01 * (is_small ? small : big));
      smaller += is_small;
      ++all;
    }
    EXPECT_NEAR(static_cast<double>(smaller), 0.5 * static_cast<double>(all), 40) << family;
  }
}

TEST(HardCaseSweeps, OnePointOfAMixedOffsetIsABillionAway) {
  for (const PairSample& s : hard_cases(18, 300)) {
    std::array<double, 5> far{};
    for (std::size_t k = 0; k < 5; ++k) far[k] = length_of(s.x[k]);
    std::sort(far.begin(), far.end());
    EXPECT_NEAR(far[4], 1e9, 3);
    EXPECT_LT(far[3], 10);
  }
}

TEST(HardCaseSweeps, HugeOffsetsLeaveTheNodeAThousandthFromTheMiddle) {
  std::array<int, 3> found{};
  for (const PairSample& s : hard_cases(17, 600)) {
    const double offset = length_of(s.x[0]);
    const auto size = static_cast<std::size_t>(offset < 1e7 ? 0 : offset < 5e8 ? 1 : 2);
    const double wanted[] = {1e6, 1e8, 1e9};
    EXPECT_NEAR(offset, wanted[size], 5);
    ++found[size];
    // Coordinates of 1e9 are rounded to 1e-7.
    if (!s.edges) {
      EXPECT_NEAR(length_of(s.x[4] - mean_of_corners(s)), 1e-3, 1e-6);
    }
  }
  for (const int n : found) EXPECT_NEAR(n, 200, 40);
}

TEST(HardCaseGaps, AreTheDistanceOrOneStepOrAShareBesideItOrOfAnySize) {
  std::size_t same = 0, above = 0, below = 0, close = 0, beside = 0, any = 0;
  double largest = 0, smallest = 1e300, most_close = 0, least_beside = 1;
  const auto samples = hard_cases(34, 6000);  // ordinary edges, never touching
  for (const PairSample& s : samples) {
    const double d = plain_distance(s), off = s.gap / d - 1;
    const double share = s.gap / length_of(s.x[1] - s.x[0]);
    same += s.gap == d;
    above += s.gap == std::nextafter(d, 1e300);
    below += s.gap == std::nextafter(d, 0.0);
    close += std::abs(off) > 1e-14 && std::abs(off) < 1e-10;
    if (std::abs(off) < 1.01e-10) most_close = std::max(most_close, std::abs(off));
    if (std::abs(off) > 1.01e-10) least_beside = std::min(least_beside, std::abs(off));
    if (std::abs(off) > 2e-10 && std::abs(off) < std::pow(10.0, -0.5)) ++beside;
    if (std::abs(off) > std::pow(10.0, -0.5) * (1 + 1e-12)) {
      ++any;
      smallest = std::min(smallest, share);
      largest = std::max(largest, share);
    }
  }
  // A sixth each: 1000. The share of 1e-17 to 1e-10 is the distance itself for a seventh, a step
  // beside it for a fourteenth.
  EXPECT_NEAR(static_cast<double>(same), 1140, 120);
  EXPECT_NEAR(static_cast<double>(above), 1030, 120);
  EXPECT_NEAR(static_cast<double>(below), 1030, 120);
  EXPECT_NEAR(static_cast<double>(close), 1000 * 4.0 / 7.0, 100);
  EXPECT_NEAR(static_cast<double>(beside), 1000, 150);
  EXPECT_NEAR(static_cast<double>(any), 900, 150);
  EXPECT_GT(most_close, 0.9e-10);
  EXPECT_LT(least_beside, 1.2e-10);
  EXPECT_GE(smallest, 1e-6 * (1 - 1e-12));
  EXPECT_LT(smallest, 1.1e-6);
  EXPECT_LE(largest, 1 + 1e-12);
  EXPECT_GT(largest, 0.9);
}

TEST(HardCaseGaps, ANearTouchHasTheHeightOrASmallShareBesideIt) {
  std::size_t same = 0;
  double largest = 0;
  for (const PairSample& s : hard_cases(16, 2000)) {
    const double height = std::abs(height_of(s));
    same += s.gap == height;
    largest = std::max(largest, std::abs(s.gap / height - 1));
  }
  EXPECT_NEAR(static_cast<double>(same), 1000, 100);
  EXPECT_LE(largest, 0.1 + 1e-12);
  EXPECT_GT(largest, 0.09);
}

TEST(HardCaseGaps, ATouchIsTheDistanceOrOneStepBesideIt) {
  std::size_t same = 0, above = 0, below = 0, edges = 0;
  for (const PairSample& s : hard_cases(30, 1500)) {
    const auto& x = s.x;
    const double d = s.edges ? filtered_closest_between_edges(x[0], x[1], x[2], x[3]).distance
                             : filtered_closest_on_segment(x[4], s.corners(), false).distance;
    same += s.gap == d;
    above += s.gap == std::nextafter(d, 2 * d);
    below += s.gap == std::nextafter(d, 0.0);
    edges += s.edges;
  }
  for (const std::size_t n : {same, above, below}) EXPECT_NEAR(static_cast<double>(n), 500, 70);
  EXPECT_EQ(same + above + below, 1500u);
  EXPECT_NEAR(static_cast<double>(edges), 750, 80);
}

TEST(HardCaseGaps, DecimalGapsAreSumsOfTenthsOverTheSameTenths) {
  std::size_t none = 0, other = 0;
  for (const PairSample& s : hard_cases(31, 1000)) {
    const double tenths = 10 * height_of(s);
    EXPECT_NEAR(tenths, std::round(tenths), 1e-12);
    EXPECT_GE(tenths, 2 - 1e-12);
    EXPECT_LE(tenths, 18 + 1e-12);
    none += s.gap == 0;
    if (s.gap == 0) continue;
    EXPECT_NEAR(10 * s.gap, tenths, 1e-12);
    other += s.gap != height_of(s);
  }
  EXPECT_NEAR(static_cast<double>(none), 250, 50);
  EXPECT_GT(other, 50u);  // 0.1 + 0.2 is not 0.3
}

TEST(HardCaseGaps, AWallIsJudgedFromItsMiddle) {
  std::size_t above = 0, half = 0;
  for (const PairSample& s : hard_cases(32, 1000)) {
    const double wall = 2 * std::abs(height_of(s));
    above += height_of(s) > 0;
    half += s.gap == 0.5 * wall;
    EXPECT_TRUE(s.gap == 0.5 * wall || s.gap == wall);
  }
  EXPECT_NEAR(static_cast<double>(above), 500, 60);
  EXPECT_NEAR(static_cast<double>(half), 500, 60);
}

/// FNV-1a over the shapes and 24 bits of every coordinate: the functions of the system's library
/// may differ in the last ones.
std::uint32_t digest(std::span<const PairSample> samples) {
  std::uint64_t state = 0xCBF29CE484222325u;
  const auto add = [&](std::uint64_t v) { state = (state ^ v) * 0x100000001B3u; };
  for (const PairSample& s : samples) {
    add(static_cast<std::uint64_t>(4 * s.family + 2 * s.edges + s.triangle));
    for (const P& p : s.x)
      for (const double v : {p.x, p.y, p.z}) {
        int exponent = 0;
        const double digits = std::frexp(v, &exponent);
        add(static_cast<std::uint64_t>(std::llround(digits * 0x1p24)));
        add(static_cast<std::uint64_t>(2 * (exponent + 2000) + std::signbit(v)));
      }
  }
  return static_cast<std::uint32_t>(state >> 32);
}

/// Recorded from 100 samples of each family (seed 1) after the tests of this folder held: who
/// changes a recipe on purpose changes the figures of tools/docs/accuracy.md, too.
constexpr std::pair<int, std::uint32_t> recorded[] = {
    {1, 0xD7ACFB7D},  {2, 0x2F69AE5B},  {3, 0x9A7BD14D},  {4, 0xF8784C17},  {5, 0x215894B3},
    {6, 0xC17B6E9C},  {7, 0xD7F23D6C},  {8, 0xAE49D270},  {9, 0x324292D5},  {10, 0x23BC9EE7},
    {11, 0x16A1861A}, {12, 0x8EBDBACC}, {13, 0x5E124A44}, {14, 0x657BE2E1}, {15, 0x2683CB8E},
    {16, 0xF18F80FF}, {17, 0xB5BE48DD}, {18, 0x8FF5C5F9}, {19, 0xA72AB983}, {20, 0xA5C1E71A},
    {21, 0x8851341F}, {22, 0x2682DC72}, {23, 0x795D2CD8}, {24, 0xF063CEC1}, {25, 0x0144DAFB},
    {26, 0x125A7579}, {27, 0x86DA3E56}, {28, 0xF5F6D90C}, {29, 0x3781CBA0}, {30, 0x7398C253},
    {31, 0x29AABE15}, {32, 0x97D5DEE4}, {33, 0x0A72A5F9}, {34, 0x95623FBE}, {38, 0x2E5D6EBA},
    {39, 0x40497329}, {40, 0xE4366E65},
};

TEST(HardCaseFamilies, SamplesAreThoseOfThePublishedFigures) {
  std::string now;
  for (const HardFamily& f : hard_families()) {
    if (!f.sampled) continue;
    const auto samples = hard_cases(f.id, 100);
    const auto* was = std::find_if(std::begin(recorded), std::end(recorded),
                                   [&](const auto& r) { return r.first == f.id; });
    ASSERT_NE(was, std::end(recorded)) << f.id;
    EXPECT_EQ(digest(samples), was->second) << f.id << ' ' << f.name;
  }
}

}  // namespace
}  // namespace deck
