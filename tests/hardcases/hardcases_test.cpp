// The robust tier on the hard-case families, held against exact rationals.
// DECK_HARDCASE_SAMPLES sets the samples per family (default 5000).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "accuracy/shared/accuracy.hpp"
#include "contact/shared/exact.hpp"
#include "contact/shared/filtered.hpp"

namespace deck {
namespace {

using P = Point3<double>;

std::size_t samples_per_family() {
  const char* text = std::getenv("DECK_HARDCASE_SAMPLES");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 5000;
}

bool decision(const PairSample& s) {
  return s.edges ? is_closer_than(s.x[0], s.x[1], s.x[2], s.x[3], s.gap)
                 : is_closer_than(s.x[4], s.corners(), s.triangle, s.gap);
}
// Closest points by the solver's formula, as a hint: those of any pair must do.
auto hints(const PairSample& s) {
  return std::pair(closest_between_edges<Form::reference>(s.x[0], s.x[1], s.x[2], s.x[3]),
                   closest_on_segment<Form::reference>(s.x[4], s.corners(), s.triangle));
}
bool decision(const PairSample& s, const PairSample& other) {
  const auto& x = s.x;
  const auto [edges, segment] = hints(other);
  return s.edges ? is_closer_than(x[0], x[1], x[2], x[3], s.gap, nullptr, &edges)
                 : is_closer_than(x[4], s.corners(), s.triangle, s.gap, nullptr, &segment);
}
double exact_distance(const PairSample& s) {
  return s.edges ? exact_closest_between_edges(s.x[0], s.x[1], s.x[2], s.x[3]).distance
                 : exact_closest_on_segment(s.x[4], s.corners(), s.triangle).distance;
}
// Rounding is monotone: only where the rounded distance is the gap do the digits behind matter.
bool exact_decision(const PairSample& s, double exact) {
  if (exact != s.gap || s.gap <= 0.0) return exact < s.gap;
  return (s.edges ? exact_compare_distance(s.x[0], s.x[1], s.x[2], s.x[3], s.gap)
                  : exact_compare_distance(s.x[4], s.corners(), s.triangle, s.gap)) < 0;
}

std::string place(const PairSample& s) {
  std::string out = fmt::format("gap {}, points", s.gap);
  for (const P& p : s.x) out += fmt::format(" ({:a}, {:a}, {:a})", p.x, p.y, p.z);
  return out;
}

std::vector<int> sampled_families() {
  std::vector<int> out;
  for (const HardFamily& f : hard_families())
    if (f.sampled) out.push_back(f.id);
  return out;
}

class HardCases : public testing::TestWithParam<int> {};

TEST_P(HardCases, RobustDecidesAsExactArithmeticWithoutAndWithAHint) {
  const auto all = hard_cases(GetParam(), samples_per_family());
  for (const PairSample& s : all) {
    const bool exact = exact_decision(s, exact_distance(s));
    for (const bool ours : {decision(s), decision(s, s), decision(s, all[0])})
      ASSERT_EQ(ours, exact) << place(s);
  }
}

TEST_P(HardCases, TouchesAreExact) {
  const auto all = hard_cases(GetParam(), 400, 11);
  for (const PairSample& s : all) {
    const auto& x = s.x;
    const int beyond = s.edges ? exact_compare_distance(x[0], x[1], x[2], x[3], 0.0)
                               : exact_compare_distance(x[4], s.corners(), s.triangle, 0.0);
    const bool touching =
        s.edges ? is_touching(x[0], x[1], x[2], x[3]) : is_touching(x[4], s.corners(), s.triangle);
    ASSERT_EQ(touching, beyond == 0) << place(s);
    for (const auto& [edges, segment] : {hints(s), hints(all[0])})
      ASSERT_EQ(s.edges ? is_touching(x[0], x[1], x[2], x[3], &edges)
                        : is_touching(x[4], s.corners(), s.triangle, &segment),
                beyond == 0)
          << place(s);
  }
}

TEST_P(HardCases, AnswersDoNotDependOnHowThePairIsWritten) {
  for (const PairSample& s : hard_cases(GetParam(), 200, 7)) {
    const bool closer = decision(s);
    for (const PairSample& t : {other_order(s), turned_over(s), other_axes(s)})
      ASSERT_EQ(decision(t), closer) << place(s);
    for (const int power : {-150, -1, 40, 150}) {
      PairSample t = s;
      if (!scale(t, power)) continue;
      ASSERT_EQ(decision(t), closer) << power << ' ' << place(s);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Family, HardCases, testing::ValuesIn(sampled_families()),
                         [](const auto& param) { return std::to_string(param.param); });

TEST(HardCaseFamilies, HaveTheDistancesThatTheirNamesSay) {
  for (const int on_the_segment : {11, 12, 27, 33})
    for (const PairSample& s : hard_cases(on_the_segment, 200))
      ASSERT_EQ(exact_distance(s), 0.0) << place(s);
  const int apart_on_a_line = 26, one_step_from_an_edge = 14;
  for (const PairSample& s : hard_cases(apart_on_a_line, 500)) ASSERT_GT(exact_distance(s), 0.01);
  for (const PairSample& s : hard_cases(one_step_from_an_edge, 500))
    ASSERT_LT(exact_distance(s), 99 * 0x1p-51) << place(s);
}

TEST(Filtered, TouchingIsNoContact) {
  const std::array<P, 4> quad{P{0, 0, 0}, P{1, 0, 0}, P{1, 1, 0}, P{0, 1, 0}};
  const double gap = 0.1 + 0.2;
  EXPECT_FALSE(is_closer_than({0.5, 0.5, gap}, quad, false, gap));
  EXPECT_FALSE(is_closer_than({0.5, 0.5, -gap}, quad, false, gap));
  EXPECT_TRUE(is_closer_than({0.5, 0.5, 0.3}, quad, false, gap));  // 0.1 + 0.2 > 0.3 as doubles
  EXPECT_FALSE(is_closer_than({0.5, 0.5, 0.0}, quad, false, 0.0));
}

TEST(Filtered, UndefinedCoordinatesAreNoContact) {
  const std::array<P, 4> quad{P{0, 0, 0}, P{1, 0, 0}, P{1, 1, 0}, P{0, 1, 0}};
  for (const double bad : {std::nan(""), double{INFINITY}, -double{INFINITY}}) {
    EXPECT_FALSE(is_closer_than({bad, 0, 0}, quad, false, 1.0));
    EXPECT_FALSE(is_closer_than({0, bad, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 1}, 1.0));
  }
}

TEST(Filtered, LargestCoordinatesDoNotOverflow) {
  const double big = std::numeric_limits<double>::max();
  const std::array<P, 4> quad{P{big, 0, 0}, P{big, big, 0}, P{-big, big, 0}, P{-big, 0, 0}};
  EXPECT_TRUE(is_closer_than({0, 0, 0.5 * big}, quad, false, 0.75 * big));
  EXPECT_FALSE(is_closer_than({0, 0, 0.5 * big}, quad, false, 0.5 * big));
}

}  // namespace
}  // namespace deck
