// The measurement behind `deck accuracy` on pairs and scenes that are made by hand: every figure of
// its rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "accuracy/shared/accuracy.hpp"
#include "contact/shared/filtered.hpp"

namespace deck {
namespace {

using P = Point3<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

PairSample quad(P node, double gap, int family = 0) {
  PairSample s;
  s.x = {P{0, 0, 0}, P{4, 0, 0}, P{4, 4, 0}, P{0, 4, 0}, node};
  s.gap = gap;
  s.family = family;
  return s;
}
const TierResult& tier(const AccuracyReport& r, const std::string& name, const std::string& what) {
  for (const TierResult& t : r.tiers)
    if (t.name == name && t.what == what) return t;
  throw std::out_of_range(name);
}
const FamilyResult& family(const std::vector<FamilyResult>& rows, int id, const std::string& tier) {
  for (const FamilyResult& f : rows)
    if (f.id == id && f.tier == tier) return f;
  throw std::out_of_range(tier);
}
AccuracyOptions once() {
  AccuracyOptions o;
  o.repeats = 1;
  return o;
}

/// 0.1 in single precision is 0.1 + 1.49e-9: an error that is known.
const double tenth = 0.1, tenth_in_float = static_cast<double>(0.1F);

TEST(MeasuredErrors, AreRelativeInUnitsAndOverTheSizeOfThePair) {
  // Exact in every number type; off by float(0.1) - 0.1, with a gap between; not a float at all.
  const std::vector<PairSample> samples = {
      quad({1, 2, 3}, 3.5, 3), quad({1, 2, tenth}, std::nextafter(tenth, 1.0), 3),
      quad({1, 2, tenth}, std::nextafter(tenth, 1.0), 5), quad({1, 2, 1e39}, 2e39, 7)};
  const AccuracyReport r = measure_accuracy(samples, once());
  EXPECT_EQ(r.scene, "hard-cases");
  const double error = tenth_in_float - tenth, unit = std::nextafter(tenth, 1.0) - tenth;
  const FamilyResult& f = family(r.families, 3, "float");
  EXPECT_EQ(f.name, "zero area, collinear");
  EXPECT_EQ(f.expected, "behaves as its longest edge");
  EXPECT_EQ(f.samples, 2u);
  EXPECT_DOUBLE_EQ(f.max_relative_error, error / tenth);
  EXPECT_DOUBLE_EQ(f.max_ulp, error / unit);
  EXPECT_EQ(f.decision_errors, 1u);
  EXPECT_EQ(f.non_finite, 0u);
  ASSERT_TRUE(f.has_example);
  EXPECT_EQ(f.example.x[4].z, tenth);
  EXPECT_EQ(f.got, tenth_in_float);
  EXPECT_EQ(f.exact, tenth);
  EXPECT_TRUE(f.exact_closer);
  EXPECT_EQ(family(r.families, 5, "float").samples, 1u);

  const FamilyResult& beyond = family(r.families, 7, "float");
  EXPECT_EQ(beyond.max_relative_error, infinity);
  EXPECT_EQ(beyond.max_ulp, infinity);
  EXPECT_EQ(beyond.non_finite, 1u);
  EXPECT_EQ(beyond.decision_errors, 1u);
  EXPECT_TRUE(std::isnan(beyond.got));
  EXPECT_EQ(beyond.exact, 1e39);

  for (const int id : {3, 5, 7}) {
    const FamilyResult& good = family(r.families, id, "robust");
    EXPECT_EQ(good.max_relative_error, 0);
    EXPECT_EQ(good.decision_errors, 0u);
    EXPECT_FALSE(good.has_example);
  }
  // One row for every arithmetic of distances and every family, and for every accuracy.
  EXPECT_EQ(r.families.size(), 3u * 10u);
  EXPECT_EQ(r.kinds.size(), 3u * 4u);

  const TierResult& t = tier(r, "float", "distance");
  EXPECT_EQ(t.samples, 4u);
  EXPECT_EQ(t.decision_errors, 3u);
  EXPECT_EQ(t.non_finite, 1u);
  EXPECT_EQ(t.max_scaled_error, infinity);
  const AccuracyReport finite = measure_accuracy(std::span(samples).first(3), once());
  // The pair is 4 wide.
  EXPECT_DOUBLE_EQ(tier(finite, "float", "distance").max_scaled_error, error / 4);
  EXPECT_EQ(tier(finite, "exact", "distance").max_scaled_error, 0);
  EXPECT_EQ(tier(finite, "float", "distance").seconds, 0);
}

TEST(MeasuredErrors, OfAForceCountAsErrorsOfTheDistance) {
  // F(d) = g/2 (g/d - 1) and dF/dd = -g^2 / (2 d^2).
  const auto expected = [](double gap, double size) {
    const float g = static_cast<float>(gap), d = 0.1F, depth = g - d;
    const double got = static_cast<double>(0.5F * depth / (d / g));
    const double want = 0.5 * gap * (gap / tenth - 1), slope = 0.5 * gap * gap / (tenth * tenth);
    return std::abs(got - want) / slope / size;
  };
  for (const auto& [gap, size] : {std::pair(0.7, 4.0), std::pair(39.7, 39.7)}) {
    const std::vector<PairSample> one = {quad({1, 2, tenth}, gap, 3)};
    const AccuracyReport r = measure_accuracy(one, once());
    EXPECT_NEAR(tier(r, "float", "force").max_scaled_error, expected(gap, size),
                1e-3 * expected(gap, size));
    EXPECT_GT(expected(gap, size), 0.0);
    EXPECT_LT(tier(r, "robust", "force").max_relative_error, 1e-12);
    const TierResult& kernel = tier(r, "kernel", "force");
    EXPECT_EQ(std::tuple(kernel.decision_errors, kernel.samples, kernel.rewritten),
              std::tuple(0u, 1u, 0u));
    EXPECT_GT(kernel.ns_per_pair, 0);
  }
}

TEST(MeasuredErrors, OfForcesAreNotAskedWhereADepthHasNoDigits) {
  const std::vector<PairSample> tiny = {quad({1, 2, tenth * 0x1p-900}, 0x1p-901, 3)};
  for (const TierResult& t : measure_accuracy(tiny, once()).tiers)
    if (t.what == "force") {
      EXPECT_EQ(t.max_relative_error, 0) << t.name;
      EXPECT_EQ(t.max_scaled_error, 0) << t.name;
    }
}

TEST(MeasuredErrors, TheExampleIsTheWrongDecisionThatIsFarthestOff) {
  // Both decided wrongly in single precision; and an error that is larger, but decided rightly.
  const double far = 1.0 + 0x1p-25;  // rounds to 1
  const std::vector<PairSample> samples = {quad({1, 2, tenth}, std::nextafter(tenth, 1.0), 3),
                                           quad({1, 2, 1 - 0x1p-26}, 1.0, 3),
                                           quad({1, 2, far * 1e-3}, 1, 3)};
  const FamilyResult f = family(measure_accuracy(samples, once()).families, 3, "float");
  EXPECT_EQ(f.decision_errors, 2u);
  // 1.49e-9 / 0.1 against 1.49e-8 / 1: nearly the same share; the first one is the larger.
  EXPECT_EQ(f.example.x[4].z,
            std::abs(tenth_in_float - tenth) / tenth_in_float > 0x1p-26 ? tenth : 1 - 0x1p-26);
  // Without a wrong decision it is the largest error.
  const std::vector<PairSample> right = {quad({1, 2, 0.3}, 1, 3), quad({1, 2, 0.7}, 1, 3),
                                         quad({1, 2, 0.5}, 1, 3)};
  const FamilyResult g = family(measure_accuracy(right, once()).families, 3, "float");
  const auto share = [](double v) { return std::abs(static_cast<double>(float(v)) - v) / v; };
  ASSERT_TRUE(g.has_example);
  EXPECT_EQ(g.example.x[4].z, share(0.3) > share(0.7) ? 0.3 : 0.7);
  EXPECT_DOUBLE_EQ(g.max_relative_error, std::max(share(0.3), share(0.7)));
}

TEST(MeasuredErrors, AnotherPartCountsOnlyWhereItIsFarther) {
  // A sliver of tenths: the reference formula names a part that is farther away.
  PairSample s;
  s.x = {P{-0.1, 0, 0}, P{0.6, 0.9, 0}, P{-0.8, -0.9, 0}, P{-0.8, -0.9, 0}, P{0.86, 1.2, 0.3}};
  s.triangle = true;
  s.gap = 2;
  s.family = 1;
  const std::vector<PairSample> one = {s};
  const AccuracyReport r = measure_accuracy(one, once());
  EXPECT_EQ(tier(r, "reference", "distance").feature_errors, 1u);
  EXPECT_EQ(tier(r, "robust", "distance").feature_errors, 0u);
  EXPECT_EQ(tier(r, "reference", "gaps").feature_errors, 0u);
}

TEST(MeasuredPairs, AreThinnedEvenlyForWhatIsSlow) {
  const std::vector<PairSample> ten(10, quad({1, 2, 3}, 3.5));
  // Every (10 / limit + 1)-th, never more than the limit.
  for (const auto& [limit, asked] : {std::pair(0u, 1u), std::pair(1u, 1u), std::pair(3u, 3u),
                                     std::pair(5u, 4u), std::pair(10u, 5u), std::pair(11u, 10u)}) {
    AccuracyOptions o = once();
    o.decisions_only = true;
    o.rewritten_limit = limit;
    const AccuracyReport r = measure_accuracy(ten, o);
    EXPECT_EQ(r.scene, "deck");
    EXPECT_TRUE(r.families.empty() && r.kinds.empty() && r.stages.empty());
    ASSERT_EQ(r.tiers.size(), 4u);
    for (const TierResult& t : r.tiers) {
      EXPECT_EQ(t.rewritten, asked) << limit;
      EXPECT_EQ(t.samples, 10u);
      EXPECT_EQ(t.jumps, 0u);
      EXPECT_GT(t.ns_per_pair, 0);
      EXPECT_EQ(t.spread, 0);  // of one timing
    }
  }
}

TEST(MeasuredPairs, ForcesAndSlowDistancesAreNotRewritten) {
  const std::vector<PairSample> one = {quad({1, 2, 3}, 3.5)};
  for (const TierResult& t : measure_accuracy(one, once()).tiers) {
    const bool slow = t.name == "interval" || t.name == "epeck" || t.name == "exact";
    const bool asked = t.what == "gaps" || (t.what == "distance" && !slow);
    EXPECT_EQ(t.rewritten, asked ? 1u : 0u) << t.name << ' ' << t.what;
  }
}

TEST(MeasuredPairs, ProgressCountsTheExactAnswersEveryTierAndTheTimes) {
  const std::vector<PairSample> one = {quad({1, 2, 3}, 3.5)};
  AccuracyOptions o = once();
  o.decisions_only = true;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> calls;
  o.progress = [&](std::uint64_t done, std::uint64_t all) { calls.emplace_back(done, all); };
  static_cast<void>(measure_accuracy(one, o));
  ASSERT_EQ(calls.size(), 6u);
  for (std::uint64_t k = 0; k < 6; ++k) EXPECT_EQ(calls[k], std::pair(k, std::uint64_t{6}));
}

TEST(MeasuredStages, ArePairsByTheLastArithmeticOfTheirDecision) {
  std::vector<PairSample> samples;
  for (const int id : {1, 12, 25, 30, 31})
    for (const PairSample& s : hard_cases(id, 15)) samples.push_back(s);
  std::array<std::uint64_t, 3> ends{};
  for (const PairSample& s : samples) {
    FilterCounters c;
    if (s.edges)
      is_closer_than(s.x[0], s.x[1], s.x[2], s.x[3], s.gap, &c);
    else
      is_closer_than(s.x[4], s.corners(), s.triangle, s.gap, &c);
    ++ends[c.exact == 1 ? 2 : c.double_double];
  }
  const AccuracyReport r = measure_accuracy(samples, once());
  ASSERT_EQ(r.stages.size(), 3u);
  const char* names[] = {"filter", "double-double", "exact"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(r.stages[k].name, names[k]);
    EXPECT_EQ(r.stages[k].pairs, ends[k]);
    EXPECT_GT(ends[k], 0u) << names[k];
    EXPECT_GT(r.stages[k].ns_per_pair, 0);
  }
  const auto all = static_cast<double>(samples.size());
  const TierResult& robust = tier(r, "robust", "gaps");
  EXPECT_DOUBLE_EQ(robust.exact_share, static_cast<double>(ends[2]) / all);
  EXPECT_DOUBLE_EQ(robust.fallback_share, static_cast<double>(ends[1] + ends[2]) / all);
}

TEST(Dominated, IsATierThatAnotherOfItsKindBeatsInSomethingAndInNothingLosesTo) {
  const auto row = [](const char* what, double ns, double relative, double scaled,
                      std::uint64_t wrong) {
    TierResult t{"t", what};
    t.ns_per_pair = ns;
    t.max_relative_error = relative;
    t.max_scaled_error = scaled;
    t.decision_errors = wrong;
    t.dominated = true;  // of an earlier call
    return t;
  };
  const TierResult base = row("distance", 5, 5, 5, 5);
  const auto beaten = [&](const TierResult& other) {
    std::vector<TierResult> both = {base, other};
    mark_dominated(both);
    return both[0].dominated;
  };
  EXPECT_FALSE(beaten(base));
  EXPECT_FALSE(beaten(row("gaps", 1, 1, 1, 1)));
  EXPECT_TRUE(beaten(row("distance", 4, 5, 5, 5)));
  EXPECT_TRUE(beaten(row("distance", 5, 4, 5, 5)));
  EXPECT_TRUE(beaten(row("distance", 5, 5, 4, 5)));
  EXPECT_TRUE(beaten(row("distance", 5, 5, 5, 4)));
  EXPECT_FALSE(beaten(row("distance", 6, 1, 1, 1)));
  EXPECT_FALSE(beaten(row("distance", 1, 6, 1, 1)));
  EXPECT_FALSE(beaten(row("distance", 1, 1, 6, 1)));
  EXPECT_FALSE(beaten(row("distance", 1, 1, 1, 6)));
  std::vector<TierResult> three = {row("distance", 5, 5, 5, 5), row("distance", 1, 1, 1, 1),
                                   row("distance", 9, 9, 9, 9)};
  mark_dominated(three);
  EXPECT_TRUE(three[0].dominated && !three[1].dominated && three[2].dominated);
}

// --- whole decks

PenetrationRow pressed(std::uint32_t secondary, std::uint32_t main, double distance,
                       bool in_contact = true) {
  PenetrationRow r;
  r.secondary = secondary;
  r.main = main;
  r.distance = distance;
  r.in_contact = in_contact;
  return r;
}
Scene scene_with(std::uint64_t pairs, std::vector<PenetrationRow> first,
                 std::vector<PenetrationRow> second) {
  Scene s;
  s.decisions.pairs = pairs;
  s.contacts.resize(2);
  s.contacts[0].penetrations = std::move(first);
  s.contacts[1].penetrations = std::move(second);
  return s;
}
const double unit = std::numeric_limits<double>::epsilon();

TEST(MeasuredDecks, CompareEveryPairOfEveryContactWithTheExactOnes) {
  const auto run = [](Accuracy a) {
    Scene s = scene_with(20, {pressed(1, 2, 1), pressed(2, 1, 2), pressed(7, 7, 9, false)},
                         {pressed(1, 2, 4)});
    if (a == Accuracy::robust)
      s = scene_with(21, {pressed(1, 2, 1 + 4 * unit), pressed(2, 1, 2 - 2 * unit)},
                     {pressed(1, 2, 4)});
    if (a == Accuracy::reference)  // one too few, two too many
      s = scene_with(22, {pressed(1, 2, 1), pressed(1, 3, 3), pressed(2, 2, 3)},
                     {pressed(1, 2, 5)});
    if (a == Accuracy::fast) s = scene_with(23, {pressed(1, 2, infinity), pressed(2, 1, 2)}, {});
    s.decisions.fallback = a == Accuracy::robust ? 10 : 0;
    s.decisions.exact = a == Accuracy::robust ? 5 : 0;
    return s;
  };
  AccuracyReport r;
  r.tiers.push_back({"kept", "distance"});
  r.tiers.push_back({"gone", "gaps"});
  measure_gaps(run, {2}, r);
  ASSERT_EQ(r.tiers.size(), 5u);
  const char* names[] = {"kept", "exact", "robust", "reference", "fast"};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(r.tiers[k].name, names[k]);
  for (std::size_t k = 1; k < 5; ++k) {
    EXPECT_EQ(r.tiers[k].what, "gaps");
    EXPECT_EQ(r.tiers[k].samples, 19u + k);
    EXPECT_GT(r.tiers[k].seconds, 0);
    EXPECT_GE(r.tiers[k].spread, 0);
    EXPECT_DOUBLE_EQ(r.tiers[k].ns_per_pair, 1e9 * r.tiers[k].seconds / 20);
  }
  EXPECT_EQ(r.tiers[1].spread, 0);
  EXPECT_EQ(r.tiers[1].decision_errors, 0u);
  EXPECT_EQ(r.tiers[2].decision_errors, 0u);
  EXPECT_DOUBLE_EQ(r.tiers[2].max_relative_error, 4 * unit);
  EXPECT_DOUBLE_EQ(r.tiers[2].max_ulp, 4);
  EXPECT_EQ(r.tiers[2].fallback_share, 0.5);
  EXPECT_EQ(r.tiers[2].exact_share, 0.25);
  EXPECT_EQ(r.tiers[3].decision_errors, 3u);
  EXPECT_EQ(r.tiers[3].max_relative_error, 0.25);
  EXPECT_EQ(r.tiers[3].max_ulp, 1 / (4 * unit));
  EXPECT_EQ(r.tiers[4].decision_errors, 1u);
  EXPECT_EQ(r.tiers[4].non_finite, 1u);
  EXPECT_EQ(r.tiers[3].non_finite, 0u);
  EXPECT_TRUE(r.tiers[3].dominated || r.tiers[2].ns_per_pair > r.tiers[3].ns_per_pair);
}

struct Calls {
  std::vector<Accuracy> order;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> progress;
};
Calls calls_of(GapsTiming timing) {
  Calls calls;
  timing.progress = [&](std::uint64_t done, std::uint64_t all) {
    calls.progress.emplace_back(done, all);
  };
  AccuracyReport r;
  measure_gaps(
      [&](Accuracy a) {
        calls.order.push_back(a);
        return Scene();
      },
      timing, r);
  // Without pairs a share of them is a share of one.
  EXPECT_EQ(r.tiers.at(0).ns_per_pair, 1e9 * r.tiers.at(0).seconds);
  return calls;
}

TEST(MeasuredDecks, AccuraciesTakeTurnsAfterTheExactOne) {
  using A = Accuracy;
  const Calls calls = calls_of({2});
  EXPECT_EQ(calls.order, (std::vector<A>{A::exact, A::robust, A::reference, A::fast, A::robust,
                                         A::reference, A::fast}));
  ASSERT_EQ(calls.progress.size(), 7u);
  for (std::uint64_t k = 0; k < 7; ++k)
    EXPECT_EQ(calls.progress[k], std::pair(k, std::uint64_t{7}));
  EXPECT_EQ(calls_of({0}).order.size(), 4u);
  EXPECT_EQ(calls_of({-3}).order.size(), 4u);
}

TEST(MeasuredDecks, AtLeastThreeRoundsAndNoMoreOnceTheTimeIsSpent) {
  EXPECT_EQ(calls_of({10, 0.0, 0.0}).order.size(), 10u);
  EXPECT_EQ(calls_of({2, 0.0, 0.0}).order.size(), 7u);
}

TEST(MeasuredDecks, ShortRunsAreRepeatedUntilEnoughTimeIsSpent) {
  using Clock = std::chrono::steady_clock;
  std::vector<Clock::time_point> begins, ends;
  AccuracyReport r;
  measure_gaps(
      [&](Accuracy) {
        begins.push_back(Clock::now());
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ends.push_back(Clock::now());
        return Scene();
      },
      {1, 0.02}, r);
  // The exact run, then rounds of three: none begins once 20 ms are spent, and not fewer.
  ASSERT_GE(begins.size(), 4u);
  ASSERT_EQ(begins.size() % 3, 1u);
  const std::chrono::duration<double> before = ends[ends.size() - 4] - begins[1];
  const std::chrono::duration<double> all = ends.back() - ends[0];
  if (begins.size() > 4) {
    EXPECT_LT(before.count(), 0.02);
  }
  EXPECT_GE(all.count(), 0.02);
}

TEST(MeasuredDecks, ThePairThatWasFastestCounts) {
  int run = 0;
  AccuracyReport r;
  measure_gaps(
      [&](Accuracy a) {
        if (a == Accuracy::fast && ++run != 3)
          std::this_thread::sleep_for(std::chrono::milliseconds(60));
        return Scene();
      },
      {4}, r);
  const TierResult& fast = tier(r, "fast", "gaps");
  EXPECT_LT(fast.seconds, 0.06);
  EXPECT_GT(fast.spread, 0.0);
  EXPECT_GE(fast.spread, (0.06 - fast.seconds) / fast.seconds);
}

// --- pairs of a scene

/// A quad and a triangle in z = 0 side by side, nodes above them, and two edges above each other.
struct Pairs {
  Scene scene;
  Contact nodes() const {
    Contact c;
    c.gap_rule = {GapRule::sum_limited, 0.25};
    for (const auto& [node, gap, length] :
         {std::tuple(5u, 0.5, 0.75), std::tuple(6u, 1.0, 9.0), std::tuple(7u, 0.5, 9.0)}) {
      SecondaryNode s;
      s.node = node;
      s.gap = gap;
      s.length = length;
      c.secondary.push_back(s);
    }
    MainSegment quad, triangle;
    quad.nodes = {0, 1, 2, 3};
    quad.gap = 2.0;
    quad.length = 0.5;
    triangle.nodes = {1, 4, 2, 2};
    triangle.gap = 0.75;
    triangle.length = 9.0;
    c.main = {quad, triangle};
    return c;
  }
  Contact edges() const {
    Contact c;
    c.kind = ContactKind::edge_edge;
    c.gap_rule = {GapRule::sum_limited, 0.125};
    for (const auto& [a, b, gap, length] :
         {std::tuple(5u, 6u, 0.5, 0.75), std::tuple(6u, 7u, 1.0, 9.0)}) {
      ContactEdge e;
      e.nodes = {a, b};
      e.gap = gap;
      e.length = length;
      c.secondary_edges.push_back(e);
    }
    ContactEdge m;
    m.nodes = {0, 2};
    m.gap = 1.5;
    m.length = 0.5;
    c.main_edges = {m};
    return c;
  }
  Pairs() {
    scene.coordinates.x = {0, 4, 4, 0, 8, 1, 2, 6};
    scene.coordinates.y = {0, 0, 4, 4, 0, 2, 1, 1};
    scene.coordinates.z = {0, 0, 0, 0, 0, 0.5, 0.75, 1.0};
  }
  P at(std::size_t n) const {
    const Coordinates& c = scene.coordinates;
    return {c.x[n], c.y[n], c.z[n]};
  }
  /// Every pair as node numbers and its gap.
  using Row = std::pair<std::array<int, 5>, double>;
  std::vector<Row> rows(std::size_t limit = 0) const {
    std::vector<Row> out;
    for (const PairSample& s : scene_pairs(scene, limit)) {
      std::array<int, 5> n{};
      n.fill(-1);
      for (std::size_t k = 0; k < (s.edges ? 4u : 5u); ++k)
        for (int m = 0; m < 8; ++m) {
          const P off = s.x[k] - at(static_cast<std::size_t>(m));
          if (dot(off, off) == 0) n[k] = m;
        }
      EXPECT_EQ(s.triangle, !s.edges && n[2] == n[3]);
      EXPECT_EQ(s.family, 0);
      out.emplace_back(n, s.gap);
    }
    std::sort(out.begin(), out.end());
    return out;
  }
};

TEST(ScenePairs, HaveTheNodesOfBothSidesAndTheGapOfThePair) {
  Pairs p;
  p.scene.contacts = {p.nodes()};
  // Gap: sum of both, no more than the sum of the lengths. Node 7 is 2 beside the quad.
  const std::vector<Pairs::Row> all = {{{0, 1, 2, 3, 5}, 1.25}, {{0, 1, 2, 3, 6}, 3.0},
                                       {{0, 1, 2, 3, 7}, 2.5},  {{1, 4, 2, 2, 5}, 1.25},
                                       {{1, 4, 2, 2, 6}, 1.75}, {{1, 4, 2, 2, 7}, 1.25}};
  for (const Pairs::Row& row : p.rows()) EXPECT_TRUE(std::count(all.begin(), all.end(), row));
  // Those within their gap are surely there.
  const auto found = p.rows();
  for (const std::size_t k : {0u, 1u, 2u, 5u})
    EXPECT_EQ(std::count(found.begin(), found.end(), all[k]), 1) << k;
  p.scene.contacts[0].drad = 9;  // reaches all
  EXPECT_EQ(p.rows(), all);
}

TEST(ScenePairs, OfEdgesHaveBothEdges) {
  Pairs p;
  p.scene.contacts = {p.edges()};
  p.scene.contacts[0].drad = 9;
  EXPECT_EQ(p.rows(), (std::vector<Pairs::Row>{{{5, 6, 0, 2, -1}, 1.25}, {{6, 7, 0, 2, -1}, 2.5}}));
  p.scene.contacts[0].dropped = true;
  EXPECT_TRUE(p.rows().empty());
}

TEST(ScenePairs, ContactsWithAnEmptySideGiveNone) {
  Pairs p;
  for (int missing = 0; missing < 4; ++missing) {
    Contact n = p.nodes(), e = p.edges();
    if (missing == 0) n.secondary.clear();
    if (missing == 1) n.main.clear();
    if (missing == 2) e.secondary_edges.clear();
    if (missing == 3) e.main_edges.clear();
    p.scene.contacts = {missing < 2 ? n : e};
    EXPECT_TRUE(p.rows().empty()) << missing;
  }
}

TEST(ScenePairs, AreTakenEvenlyWhereThereAreTooMany) {
  Pairs p;
  p.scene.contacts = {p.nodes(), p.edges()};
  for (Contact& c : p.scene.contacts) c.drad = 9;
  const auto all = scene_pairs(p.scene, 0);
  ASSERT_EQ(all.size(), 8u);
  const auto same = [&](std::size_t limit, std::vector<std::size_t> wanted) {
    const auto some = scene_pairs(p.scene, limit);
    ASSERT_EQ(some.size(), wanted.size()) << limit;
    for (std::size_t k = 0; k < wanted.size(); ++k)
      for (std::size_t c = 0; c < 5; ++c) {
        const P off = some[k].x[c] - all[wanted[k]].x[c];
        EXPECT_EQ(dot(off, off), 0) << limit << ' ' << k;
      }
  };
  same(8, {0, 1, 2, 3, 4, 5, 6, 7});
  same(9, {0, 1, 2, 3, 4, 5, 6, 7});
  same(3, {0, 2, 5});
  same(5, {0, 1, 3, 4, 6});
}

}  // namespace
}  // namespace deck
