// Each arithmetic on pairs whose distance, decision and force are known by hand, and the two
// questions that are asked of an arithmetic: does it notice how a pair is written, does it jump.
#include "accuracy/tiers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "accuracy/pair_rewriting.hpp"
#include "accuracy/shared/motion.hpp"

namespace deck::accuracy {
namespace {

using P = Point3<double>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

PairSample quad(P node, double gap, P shift = {0, 0, 0}) {
  PairSample s;
  s.x = {P{0, 0, 0} + shift, P{4, 0, 0} + shift, P{4, 4, 0} + shift, P{0, 4, 0} + shift,
         node + shift};
  s.gap = gap;
  return s;
}
PairSample triangle(P node, double gap) {
  PairSample s;
  s.x = {P{0, 0, 0}, P{8, 0, 0}, P{0, 8, 0}, P{0, 8, 0}, node};
  s.triangle = true;
  s.gap = gap;
  return s;
}
/// The nearest points are (2, 0, 0) and (2, 0, 3): a quarter and three quarters of their edges.
PairSample edges(double gap) {
  PairSample s;
  s.edges = true;
  s.x = {P{1, 0, 0}, P{5, 0, 0}, P{2, -6, 3}, P{2, 2, 3}, P{}};
  s.gap = gap;
  return s;
}
Outcome ask(const Tier& tier, const PairSample& s) {
  FilterCounters unused;
  return tier.run(s, unused);
}
const Tier& named(std::span<const Tier> tiers, std::string_view name, std::string_view what) {
  for (const Tier& t : tiers)
    if (t.name == name && t.what == what) return t;
  throw std::out_of_range(std::string(name));
}
const Tier& of_distance(std::string_view name) { return named(distance_tiers(), name, "distance"); }
const Tier& of_force(std::string_view name) { return named(force_tiers(), name, "force"); }

/// The closest point that the weights of an answer name.
P foot(const PairSample& s, const Outcome& o) {
  if (s.edges) return o.weights[0] * s.x[0] + (1 - o.weights[0]) * s.x[1];
  P q{};
  for (std::size_t k = 0; k < 4; ++k) q = q + o.weights[k] * s.x[k];
  return q;
}

TEST(Tiers, AgreeWherePairsAreEasy) {
  const std::pair<PairSample, P> cases[] = {
      {quad({1, 2, 3}, 3.5), {1, 2, 0}},      {quad({3, 1.5, -3}, 3.5), {3, 1.5, 0}},
      {quad({2, -3, 0}, 3.5), {2, 0, 0}},     {quad({2, 7, 0}, 3.5), {2, 4, 0}},
      {triangle({1, 2, 3}, 3.5), {1, 2, 0}},  {triangle({0, 11, 0}, 3.5), {0, 8, 0}},
      {triangle({-3, 4, 0}, 3.5), {0, 4, 0}}, {edges(3.5), {2, 0, 0}},
  };
  for (const auto& [sample, point] : cases)
    for (const Tier& tier : distance_tiers()) {
      const Outcome o = ask(tier, sample), truth = ask(of_distance("exact"), sample);
      EXPECT_TRUE(o.closer) << tier.name;
      PairSample touching = sample;
      touching.gap = 3;
      EXPECT_FALSE(ask(tier, touching).closer) << tier.name;
      const bool decision_alone = tier.run == named(distance_tiers(), "robust", "gaps").run;
      EXPECT_NEAR(o.value, decision_alone ? 0 : 3, 1e-6) << tier.name;
      EXPECT_EQ(o.feature, decision_alone ? -1 : truth.feature) << tier.name;
      if (decision_alone) continue;
      const P off = foot(sample, o) - point;
      EXPECT_LT(std::sqrt(dot(off, off)), 1e-6) << tier.name;
      if (sample.edges) {
        EXPECT_EQ(o.weights, (std::array<double, 4>{0.75, 0.25, 0, 0}));
      }
    }
}

TEST(Tiers, NumberPartsOfSegmentsAndOfEdgesApart) {
  EXPECT_EQ(number_of(Feature::corner, 3), 19);
  EXPECT_EQ(number_of(EdgeFeature::first_node, EdgeFeature::second_node), 74);
  EXPECT_EQ(ask(of_distance("exact"), quad({-3, -4, 0}, 1)).feature, number_of(Feature::corner, 0));
}

TEST(Tiers, LocalCoordinatesKeepWhatAnOffsetTakesFromSinglePrecision) {
  const PairSample s = quad({1, 2, 3}, 3.5, {0x1p26, -0x1p26, 0x1p27});
  EXPECT_EQ(ask(of_distance("float-local"), s).value, 3);
  EXPECT_NE(ask(of_distance("float"), s).value, 3);
  EXPECT_EQ(ask(of_force("float-local"), s).value, static_cast<double>(0.25F / (3.0F / 3.5F)));
  EXPECT_NE(ask(of_force("float"), s).value, ask(of_force("float-local"), s).value);
}

TEST(Tiers, TheTextbookSubtractionLosesDigitsAtAnOffset) {
  for (PairSample s : {quad({0.9, 1.7, 3}, 3.5, {0, 0, 0}), edges(3.5)}) {
    for (P& p : s.x) p = p + P{1e9 / 3, 1e9 / 7, -1e9 / 11};
    const double exact = ask(of_distance("exact"), s).value;
    EXPECT_NEAR(ask(of_distance("double-residual"), s).value, exact, 1e-15);
    EXPECT_NEAR(ask(of_distance("double"), s).value, exact, 1e-6);
    if (s.edges) continue;
    EXPECT_NE(ask(of_distance("double"), s).value, exact);
    EXPECT_NE(ask(of_force("double"), s).value, ask(of_force("double-residual"), s).value);
  }
}

TEST(Tiers, SinglePrecisionHasNoAnswerBeyondItsRange) {
  PairSample node = quad({1, 2, 1e39}, 2e39), edge = edges(2e39);
  edge.x[3].y = -1e39;
  for (const PairSample& s : {node, edge})
    for (const char* name : {"float", "float-local"})
      for (const Tier* tier : {&of_distance(name), &of_force(name)}) {
        const Outcome o = ask(*tier, s);
        EXPECT_TRUE(std::isnan(o.value)) << name;
        EXPECT_FALSE(o.closer) << name;
        EXPECT_EQ(o.feature, -1) << name;
      }
  EXPECT_EQ(ask(of_distance("double"), node).value, 1e39);
}

TEST(Tiers, RobustDistancesAreDecidedExactlyWhereTheyRoundToTheGap) {
  // Beyond a corner the distance is sqrt(2), above its double or below.
  const PairSample s = quad({5, 5, 0}, std::sqrt(2.0));
  const bool below = ask(of_distance("exact"), s).closer;
  EXPECT_EQ(ask(of_distance("robust"), s).value, std::sqrt(2.0));
  EXPECT_EQ(ask(of_distance("robust"), s).closer, below);
  EXPECT_TRUE(below);  // the double is too large by 9.7e-17
  PairSample less = s;
  less.gap = std::nextafter(s.gap, 0.0);
  EXPECT_FALSE(ask(of_distance("robust"), less).closer);
}

TEST(Tiers, CountWhatTheRobustAnswersNeed) {
  FilterCounters counters;
  of_distance("robust").run(quad({1, 2, 3}, 3), counters);
  EXPECT_EQ(counters.pairs, 1u);
  named(distance_tiers(), "robust", "gaps").run(edges(3), counters);
  of_force("robust").run(quad({1, 2, 3}, 3.5), counters);
  of_force("robust").run(edges(3.5), counters);
  EXPECT_EQ(counters.pairs, 4u);
}

// K/2 g (g - d) / d; below a share of 1e-8 of the gap its tangent there.
TEST(ForceLaw, IsTheElasticLawWithATangentBelowAHundredMillionth) {
  EXPECT_EQ(elastic_force(4, 1, 3), 6);
  EXPECT_EQ(elastic_force(4, 3, 1), 0.5 * 1 / 0.75);
  const double f = 1e-8, g = 4;
  EXPECT_DOUBLE_EQ(elastic_force(g, f * g, g - f * g), 0.5 * g * (1 - f) / f);
  EXPECT_DOUBLE_EQ(elastic_force(g, 0, g), 0.5 * g * ((1 - f) / f + 1 / f));
  EXPECT_DOUBLE_EQ(elastic_force(g, 0.25 * f * g, g), 0.5 * g * ((1 - f) / f + 0.75 / f));
  EXPECT_DOUBLE_EQ(force_slope(1, 4), 8);
  EXPECT_DOUBLE_EQ(force_slope(3, 4), 0.5 / 0.5625);
  EXPECT_DOUBLE_EQ(force_slope(0, 4), 0.5e16);
}

TEST(ForceTiers, GiveTheLawAndNothingBeyondTheGap) {
  for (const Tier& tier : force_tiers()) {
    const double digits = std::string_view(tier.name).starts_with("float") ? 1e-6 : 1e-14;
    for (const PairSample& s : {quad({1, 2, 3}, 3.5), triangle({1, 2, 3}, 3.5), edges(3.5)}) {
      const Outcome o = ask(tier, s);
      EXPECT_TRUE(o.closer) << tier.name;
      EXPECT_NEAR(o.value, 0.5 * 3.5 * 0.5 / 3, digits) << tier.name;
      for (const double gap : {3.0, 2.5, 0.0, -1.0}) {
        PairSample none = s;
        none.gap = gap;
        EXPECT_FALSE(ask(tier, none).closer) << tier.name << ' ' << gap;
        EXPECT_EQ(ask(tier, none).value, 0) << tier.name << ' ' << gap;
      }
    }
  }
}

TEST(ForceTiers, TheReferenceDropsANodeThatIsNearlyOnTheSegment) {
  // What is left of the gap is gap - (gap - d).
  EXPECT_EQ(ask(of_force("reference"), quad({1, 2, 0.5e-10}, 1)).value, 0);
  EXPECT_FALSE(ask(of_force("reference"), quad({1, 2, 0.5e-10}, 1)).closer);
  const double d = 2e-10, depth = 1 - d, left = 1 - depth;
  EXPECT_DOUBLE_EQ(ask(of_force("reference"), quad({1, 2, d}, 1)).value, 0.5 / left * depth);
  // A small gap: the floor of the distance is a length, not a share.
  const double gap = 1e-9, small = 0.25e-10;
  EXPECT_DOUBLE_EQ(ask(of_force("reference"), quad({1, 2, small}, gap)).value,
                   0.5 * (gap / 1e-10) * (gap - small));
  for (const char* name : {"double", "double-residual", "double-double", "robust", "exact"})
    EXPECT_NEAR(ask(of_force(name), quad({1, 2, 0.5e-10}, 1)).value, elastic_force(1, 0.5e-10, 1),
                1e-4 * elastic_force(1, 0.5e-10, 1))
        << name;
}

TEST(ForceKernel, AnswersStandWhereTheirPairsStood) {
  std::vector<PairSample> samples;
  const double gaps[] = {3.5, 4, 3, 6, 2, 5, 3.25};
  for (std::size_t k = 0; k < 7; ++k)
    samples.push_back(k % 3 == 0   ? quad({1, 2, 3}, gaps[k])
                      : k % 3 == 1 ? edges(gaps[k])
                                   : triangle({1, 2, 3}, gaps[k]));
  samples.push_back(quad({1, 2, 0}, 2));  // on the surface
  samples.push_back(edges(-1));
  const KernelRun run = run_kernel(samples, 2);
  ASSERT_EQ(run.outcomes.size(), 9u);
  for (std::size_t k = 0; k < 7; ++k) {
    const double g = gaps[k], force = g > 3 ? 0.5 * g * (g - 3) / 3 : 0;
    EXPECT_NEAR(run.outcomes[k].value, force, 1e-14) << k;
    EXPECT_EQ(run.outcomes[k].closer, g > 3) << k;
  }
  EXPECT_DOUBLE_EQ(run.outcomes[7].value, elastic_force(2, 0, 2));
  EXPECT_TRUE(run.outcomes[7].closer);
  EXPECT_EQ(run.outcomes[8].value, 0);
  EXPECT_GT(run.ns_per_pair, 0);
  EXPECT_EQ(run_kernel({}, 1).ns_per_pair, 0);
}

TEST(ForceKernel, MeasuresOnceWhereNoRepeatIsAskedFor) {
  // Beyond the long side of the triangle.
  const PairSample s = triangle({8, 8, 0}, 7);
  const double d = std::sqrt(32.0);
  EXPECT_NEAR(run_kernel(std::span(&s, 1), 0).outcomes[0].value, 3.5 * (7 - d) / d, 1e-14);
}

// --- invariance and continuity, asked of arithmetics that are made for it

Tier tier_of(Outcome (*run)(const PairSample&, FilterCounters&)) {
  return {"made", "distance", run};
}
Outcome value_of(double v, bool closer = false) { return {v, closer, -1, {}}; }
double distance_of(const PairSample& s) { return ask(of_distance("exact"), s).value; }

TEST(Invariance, ATrueDistanceNoticesNothing) {
  const Tier good = tier_of([](const PairSample& s, FilterCounters&) {
    return value_of(distance_of(s), distance_of(s) < s.gap);
  });
  for (const PairSample& s : {quad({1, 2, 3}, 3.5), triangle({-1, 2, 3}, 3.5), edges(3.5)})
    EXPECT_TRUE(is_invariant(good, s, true));
  const Tier none = tier_of([](const PairSample&, FilterCounters&) { return value_of(nan); });
  EXPECT_TRUE(is_invariant(none, edges(1), true));
}

TEST(Invariance, OrderOrientationAndAxesAreEachAsked) {
  // Each of these notices one way of writing alone: squares do not notice other axes.
  const Tier order = tier_of([](const PairSample& p, FilterCounters&) {
    return value_of(0, dot(p.x[0], p.x[0]) < dot(p.x[1], p.x[1]));
  });
  PairSample s = edges(1);
  s.x = {P{1, 1, 1}, P{1, 3, 1}, P{1, 1, 1}, P{1, 3, 1}, P{}};
  EXPECT_FALSE(is_invariant(order, s, false));
  const Tier sides = tier_of([](const PairSample& p, FilterCounters&) {
    return value_of(
        0, dot(p.x[0], p.x[0]) + dot(p.x[1], p.x[1]) < dot(p.x[2], p.x[2]) + dot(p.x[3], p.x[3]));
  });
  s.x = {P{1, 1, 1}, P{1, 1, 1}, P{1, 3, 1}, P{1, 3, 1}, P{}};
  EXPECT_FALSE(is_invariant(sides, s, false));
  const Tier axes = tier_of([](const PairSample& p, FilterCounters&) {
    return value_of(0, p.x[0].x + p.x[1].x + p.x[2].x + p.x[3].x > 0);
  });
  s.x = {P{1, 1, 1}, P{1, 1, 1}, P{1, 1, 1}, P{1, 1, 1}, P{}};
  EXPECT_FALSE(is_invariant(axes, s, false));
  const Tier first =
      tier_of([](const PairSample& p, FilterCounters&) { return value_of(p.x[0].x * p.x[0].x); });
  EXPECT_FALSE(is_invariant(first, edges(1), true));
  EXPECT_TRUE(is_invariant(first, edges(1), false));  // only the value differs
}

TEST(Invariance, PowersOfTwoScaleDistancesAndLeaveDecisions) {
  const auto same_everywhere = [](const PairSample& s, FilterCounters&) {
    return value_of(3, s.gap > 0);
  };
  EXPECT_FALSE(is_invariant(tier_of(same_everywhere), quad({1, 2, 3}, 3.5), true));
  EXPECT_TRUE(is_invariant(tier_of(same_everywhere), quad({1, 2, 3}, 3.5), false));
  // Decisions about a fixed length, each noticed by one power alone.
  const Tier fixed = tier_of(
      [](const PairSample& p, FilterCounters&) { return value_of(0, p.gap > 0.4 && p.gap < 0.6); });
  for (const double gap : {0x1p149, 1.0, 0x1p-41, 0x1p-151})
    EXPECT_FALSE(is_invariant(fixed, quad({1, 2, 3}, gap), false)) << gap;
  EXPECT_TRUE(is_invariant(fixed, quad({1, 2, 3}, 0x1p20), false));
}

TEST(Invariance, DigitsAreNotAskedOfNumbersBelowTheNormalOnes) {
  PairSample tiny;
  tiny.gap = 0x1p-1000;
  const Tier becomes_subnormal = tier_of([](const PairSample& s, FilterCounters&) {
    return value_of(s.gap < 0x1p-1000 ? 0 : std::ldexp(s.gap, -22));
  });
  EXPECT_TRUE(is_invariant(becomes_subnormal, tiny, true));
  const Tier was_subnormal = tier_of([](const PairSample& s, FilterCounters&) {
    return value_of(s.gap > 0x1p-1000 ? 7 : 0x1p-1030);
  });
  EXPECT_TRUE(is_invariant(was_subnormal, tiny, true));
}

TEST(PairRewriting, NamesTheSamePair) {
  const P a{1, 2, 3}, b{4, 5, 6}, c{7, 8, 9}, d{10, 11, 12}, n{13, 14, 15};
  PairSample q, t, e;
  q.x = {a, b, c, d, n};
  t.x = {a, b, c, c, n};
  t.triangle = true;
  e.x = {a, b, c, d, P{}};
  e.edges = true;
  const auto same = [](const PairSample& s, const std::array<P, 5>& x) {
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_TRUE(s.x[k].x == x[k].x && s.x[k].y == x[k].y && s.x[k].z == x[k].z) << k;
  };
  same(other_order(q), {b, c, d, a, n});
  same(other_order(t), {b, c, a, a, n});
  same(other_order(e), {b, a, c, d, P{}});
  same(turned_over(q), {a, d, c, b, n});
  same(turned_over(t), {b, a, c, c, n});
  same(turned_over(e), {c, d, a, b, P{}});
  same(other_axes(e),
       {P{-3, 1, -2}, P{-6, 4, -5}, P{-9, 7, -8}, P{-12, 10, -11}, P{-0.0, 0, -0.0}});
}

/// A tier whose value is 1, and 1 + 4 or 5 units in the last place as soon as `beyond` says so.
template <bool (*beyond)(const PairSample&), int units>
Tier stepping() {
  return tier_of([](const PairSample& s, FilterCounters&) {
    return value_of(beyond(s) ? 1 + units * epsilon : 1.0);
  });
}
bool right_of_half(const PairSample& s) { return s.x[4].x > 0.5; }
bool below_half(const PairSample& s) { return s.x[4].y < 0.5; }
bool above_half(const PairSample& s) { return s.x[4].z > 0.5; }
bool first_right_of_half(const PairSample& s) { return s.x[0].x > 0.5; }

TEST(Continuity, AllowsTheStepAndFourUnitsOfTheDistance) {
  const PairSample s = quad({0.5, 0.5, 0.5}, 1);
  // The step is sqrt(0.5^2 + 0.25^2 + 0.5^2) = 0.75 units.
  EXPECT_TRUE(is_continuous(stepping<right_of_half, 4>(), s));
  EXPECT_FALSE(is_continuous(stepping<right_of_half, 5>(), s));
  EXPECT_FALSE(is_continuous(stepping<right_of_half, -12>(), s));
  EXPECT_FALSE(is_continuous(stepping<below_half, 5>(), s));
  EXPECT_FALSE(is_continuous(stepping<above_half, 5>(), s));
  EXPECT_TRUE(is_continuous(stepping<first_right_of_half, 5>(), s));
  PairSample e = edges(1);
  e.x[0] = {0.5, 0.5, 0.5};
  EXPECT_FALSE(is_continuous(stepping<first_right_of_half, 5>(), e));
  EXPECT_TRUE(is_continuous(stepping<right_of_half, 5>(), e));
}

TEST(Continuity, AllowsNoMoreThanTheWayOfTheNode) {
  // Far out steps are large: the distance may change by as much, not by twice as much.
  const PairSample s = quad({0x1p40, 0, 0}, 1);
  EXPECT_TRUE(is_continuous(
      tier_of([](const PairSample& p, FilterCounters&) { return value_of(p.x[4].x - 0x1p40); }),
      s));
  EXPECT_FALSE(is_continuous(tier_of([](const PairSample& p, FilterCounters&) {
                               return value_of(1.002 * (p.x[4].x - 0x1p40));
                             }),
                             s));
}

// --- the hard case in motion

TEST(MotionSentences, NameEveryJumpAndWhoJumps) {
  HardMotion m;
  for (const Accuracy a :
       {Accuracy::reference, Accuracy::fast, Accuracy::robust, Accuracy::exact}) {
    HardMotion::Line line;
    line.accuracy = a;
    const double base = 100 * (1 + static_cast<double>(m.lines.size()));
    for (int k = 0; k <= 100; ++k) line.force.push_back(base + k * k);
    m.lines.push_back(line);
  }
  m.lines[0].jumps = {1, 100};
  m.lines[2].jumps = {1, 50};
  m.lines[2].force[50] = 7.126;
  EXPECT_EQ(
      motion_sentences(m, "i"),
      (std::vector<std::string>{
          "At step 1 the force of <i>reference</i> and <i>robust</i> rises from 100.00 to "
          "101.00; exactly 401.00.",
          "At step 50 the force of <i>robust</i> falls from 2701.00 to 7.13; exactly 2900.00.",
          "At step 100 the force of <i>reference</i> rises from 9901.00 to 10100.00; exactly "
          "10400.00."}));
  EXPECT_EQ(motion_sentences(m)[1].substr(0, 32), "At step 50 the force of robust f");
}

TEST(HardMotionWay, IsAHundredthOfThePath) {
  const HardMotion m = hard_motion();
  EXPECT_DOUBLE_EQ(m.way, std::sqrt(4 + 0.04) / 100);
  for (const auto& line : m.lines) {
    EXPECT_EQ(line.depth.size(), 101u);
    EXPECT_EQ(line.force.size(), 101u);
    for (std::size_t k = 0; k < line.depth.size(); ++k)
      EXPECT_EQ(line.force[k] > 0, line.depth[k] > 0) << k;
  }
}

}  // namespace
}  // namespace deck::accuracy
