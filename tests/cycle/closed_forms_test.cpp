// Closed forms: limits of velocities and steps, curves, laws of friction, pairs that are near.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cycle/plates.hpp"
#include "cycle/shared/contact_run.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using detail::velocity_limit;

// --- how far the sides have come nearer

Contact two_sides(bool edges) {
  Contact c;
  if (edges) {
    c.kind = deck::ContactKind::edge_edge;
    ContactEdge s, m;
    s.nodes = {0, 1};
    s.gap = 0.5;
    m.nodes = {2, 3};
    m.gap = 0.25;
    c.secondary_edges = {s};
    c.main_edges = {m};
    return c;
  }
  for (const NodeIndex n : {0u, 1u}) {
    SecondaryNode s;
    s.node = n;
    s.gap = n == 0 ? 0.75 : 0.5;
    c.secondary.push_back(s);
  }
  MainSegment m;
  m.nodes = {2, 3, 4, 4};
  m.gap = 0.25;
  c.main = {m};
  return c;
}

// --- the limit of velocities

TEST(VelocityLimit, IsNineTenthsOfTheGapOverTheRangesOfBothSides) {
  State state;
  state.moving = true;
  state.velocity = {
      std::vector<double>{2, 0, 0, 0, 0, 0}, {0, -3, 0, 0, 0, 0}, {0, 0, 0, 6, 0, 99}};
  ContactCard card;
  card.gapmin = 0.5;
  for (const bool edges : {false, true}) {
    Contact c = two_sides(edges);
    // Ranges: 2 - 0, 0 + 3, 6 - 0: a speed of 7.
    EXPECT_DOUBLE_EQ(velocity_limit(c, card, state), 0.9 * 0.5 / 7) << edges;
    c.igap = 1;  // the smallest gap of both sides together, no less than Gapmin
    EXPECT_DOUBLE_EQ(velocity_limit(c, card, state), 0.9 * 0.75 / 7) << edges;
    card.gapmin = 1.5;
    EXPECT_DOUBLE_EQ(velocity_limit(c, card, state), 0.9 * 1.5 / 7) << edges;
    card.gapmin = 0.5;
    for (int side = 0; side < 2; ++side) {
      Contact half = c;
      if (side == 0) half.secondary.clear(), half.secondary_edges.clear();
      if (side == 1) half.main.clear(), half.main_edges.clear();
      EXPECT_EQ(velocity_limit(half, card, state), 1e30);
    }
  }
  state.moving = false;
  EXPECT_EQ(velocity_limit(two_sides(false), card, state), 1e30);
}

TEST(StepLimits, AreTheSmallestOfPairsNodesAndVelocities) {
  Totals t;
  t.dt_kinematic = 4e-3;
  t.dt_kinematic_pair = 17;
  NodalSums sums;
  sums.resize(4);
  sums.stiffness = {8, 0, 32, 50};
  const double mass[] = {1e-4, 1, 1e-4, 0};  // 5e-3, none, 2.5e-3, none
  const auto limit = [&](const double* m, double factor, double velocity) {
    const StepLimit l = step_limit(t, sums, m, factor, velocity);
    return std::tuple(l.source, l.dt, l.index);
  };
  using S = StepLimit::Source;
  EXPECT_EQ(limit(mass, 1, 1e30), std::tuple(S::nodal, std::sqrt(2e-4 / 32), std::size_t{2}));
  EXPECT_EQ(limit(mass, 2, 1e30), std::tuple(S::kinematic, 4e-3, std::size_t{17}));
  EXPECT_EQ(limit(nullptr, 1, 1e30), std::tuple(S::kinematic, 4e-3, std::size_t{17}));
  EXPECT_EQ(limit(mass, 1, 1e-3), std::tuple(S::velocity, 1e-3, SIZE_MAX));
  EXPECT_EQ(limit(nullptr, 1, 4e-3), std::tuple(S::kinematic, 4e-3, std::size_t{17}));
  EXPECT_EQ(step_limit(Totals(), NodalSums(), nullptr, 1, 1e30).source, S::none);
}

// --- values

TEST(Curves, ContinueTheirEndSegmentsAndStepOverTheSmallestSpacing) {
  const Curve c{{1, 3, 7}, {2, 6, 4}};
  const std::pair<double, double> points[] = {{0, 0}, {1, 2}, {2, 4}, {3, 6},
                                              {5, 5}, {7, 4}, {9, 3}};
  for (const auto& [x, y] : points) EXPECT_EQ(c(x), y) << x;
  EXPECT_EQ((Curve{{5}, {8}})(99), 8);
  EXPECT_EQ((Curve{{}, {}})(1), 0);
  EXPECT_EQ((Curve{{1, 2}, {3}})(1), 0);
  const Curve step{{0, 1, 1, 2}, {0, 2, 5, 6}};
  EXPECT_EQ(step(1), 2);
  EXPECT_EQ(step(1.5), 5.5);
  const Curve ends_in_a_step{{0, 1, 1}, {0, 2, 5}};
  EXPECT_EQ(ends_in_a_step(1), 2);
  EXPECT_DOUBLE_EQ(ends_in_a_step(1 + 0x1p-40), 2 + 3 / 1e-16 * 0x1p-40);
}

// --- laws of friction, by hand

TEST(FrictionLaws, AreTheirFormulas) {
  const std::array<double, 6> c{0.25, 0.5, 0.125, 0.0625, 2, 4};
  const double p = 3, v = 5, mu = 0.75;
  EXPECT_DOUBLE_EQ(friction_coefficient(0, mu, c, p, v), mu);
  EXPECT_DOUBLE_EQ(friction_coefficient(1, mu, c, p, v),
                   mu + 0.25 * p + 0.5 * v + 0.125 * p * v + 0.0625 * p * p + 2 * v * v);
  EXPECT_DOUBLE_EQ(
      friction_coefficient(2, mu, c, p, v),
      mu + 0.25 * std::exp(2.5) * 9 + 0.125 * std::exp(0.3125) * 3 + 2 * std::exp(20.0));
  EXPECT_DOUBLE_EQ(friction_coefficient(4, mu, c, p, v), 0.25 + 0.5 * std::exp(-2.5));
  EXPECT_EQ(friction_coefficient(1, -9, {}, p, v), 1e-30);
  EXPECT_EQ(friction_coefficient(0, -9, {}, p, v), -9);
}

TEST(FrictionLaws, TheStribeckCurveIsContinuousAtItsSpeeds) {
  // From 0.25 up to 0.125 at 2, to 0.0625 at 4, then towards 0.5.
  const std::array<double, 6> c{0.25, 0.5, 0.125, 0.0625, 2, 4};
  const auto at = [&](double v) { return friction_coefficient(3, 9, c, 9, v); };
  EXPECT_DOUBLE_EQ(at(0), 0.25);
  EXPECT_DOUBLE_EQ(at(1), 0.25 - 0.125 * 0.75);
  EXPECT_DOUBLE_EQ(at(2), 0.125);
  EXPECT_DOUBLE_EQ(at(2.5), 0.125 - 0.0625 * (3 - 0.5) / 16);
  EXPECT_DOUBLE_EQ(at(3), 0.09375);
  EXPECT_DOUBLE_EQ(at(4), 0.0625);
  EXPECT_DOUBLE_EQ(at(6), 0.5 - 0.4375 / (1 + 0.4375 * 4));
  // A first speed of 0: no rising branch.
  EXPECT_DOUBLE_EQ(friction_coefficient(3, 9, {0.25, 0.5, 0.125, 0.0625, 0, 4}, 9, 0), 0.125);
}

TEST(OrthotropicReturn, LandsOnTheEllipse) {
  const auto back = [](double f1, double f2, double mu1, double mu2, double fn) {
    return orthotropic_return(f1, f2, mu1, mu2, fn);
  };
  using Two = std::array<double, 2>;
  EXPECT_EQ(back(3, 4, 0.5, 0.25, 0), (Two{0, 0}));
  EXPECT_EQ(back(3, 0, 0.3, 0.1, 10), (Two{3, 0}));  // on it: stays
  EXPECT_EQ(back(1, -0.5, 0.3, 0.1, -10), (Two{1, -0.5}));
  // No friction across: the force along is cut to its limit.
  EXPECT_EQ(back(6, 5, 0.3, 0, 10), (Two{3, 0}));
  EXPECT_EQ(back(6, -5, 0, 0.2, -10), (Two{0, -2}));
  for (const auto& [f1, f2] : {std::pair(6.0, 5.0), std::pair(-6.0, 5.0), std::pair(7.0, -2.0)}) {
    const Two f = back(f1, f2, 0.3, 0.1, 10);
    EXPECT_NEAR(f[0] * f[0] / 9 + f[1] * f[1], 1, 1e-12);
    EXPECT_EQ(std::signbit(f[0]), std::signbit(f1));
    EXPECT_EQ(std::signbit(f[1]), std::signbit(f2));
    // One Newton step on the level, by hand.
    const double level = f1 * f1 / 9 + f2 * f2, g1 = f1 / 9, g2 = f2;
    const double step = (level - std::sqrt(level)) / (g1 * g1 + g2 * g2);
    const double p1 = f1 - step * g1, p2 = f2 - step * g2;
    EXPECT_NEAR(std::abs(f[0] / f[1]), std::abs(p1 / p2), 1e-12);
  }
}

// --- lists of an evaluation

/// Nodes over one shell at the given depths below a gap of 1; each in a shell of its own.
std::unique_ptr<test::Built> nodes_at(const std::vector<double>& heights) {
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 1000, 0, 0).node(3, 1000, 1000, 0).node(4, 0, 1000, 0);
  std::vector<int> ids;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    ids.push_back(static_cast<int>(100 + k));
    d.node(ids.back(), 300 + static_cast<double>(k), 450 + static_cast<double>(k % 7), heights[k]);
  }
  d.shell_part(1, 1.0);
  d.shell(1, 1, 1, 2, 3, 4);
  d.group("/GRNOD/NODE/1", ids).group("/SURF/PART/2", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1");
  return std::make_unique<test::Built>(d, testing::with_stiffness());
}

TEST(NearPairs, AreCountedBelowTheShareAndTheTwentyNearestListed) {
  std::vector<double> heights;
  for (int k = 1; k <= 40; ++k) heights.push_back(((k * 7) % 41) / 64.0);
  const auto b = nodes_at(heights);
  CycleOptions options;
  options.near_singular = 0.5;  // 32 of 64: that one is not below
  options.keep_pairs = true;
  const SceneOutcome r = run_cycle(b->scene, make_state(b->scene), options);
  const ContactOutcome& c = r.contacts.at(0);
  EXPECT_EQ(c.pairs.size(), 40u);
  EXPECT_EQ(c.near_singular_count, 31u);
  ASSERT_EQ(c.near_singular.size(), 20u);
  for (std::size_t k = 0; k < 20; ++k) {
    const PairOutcome& p = c.near_singular[k];
    EXPECT_EQ(p.gap, 1.0);
    EXPECT_NEAR(p.distance, static_cast<double>(k + 1) / 64, 1e-9);
    EXPECT_NEAR(p.penetration, 1 - static_cast<double>(k + 1) / 64, 1e-9);
    EXPECT_EQ(heights[p.at.secondary], static_cast<double>(k + 1) / 64);
  }
  // The nearest one has the largest force: K/2 p / d.
  EXPECT_EQ(c.largest.at.secondary, c.near_singular[0].at.secondary);
  EXPECT_NEAR(c.largest_force, 0.5 * c.largest.k0 * 63, 1e-9 * c.largest_force);
  EXPECT_EQ(c.massless_nodes, 40u);  // nodes of no element have no mass
  double sum = 0;
  for (const PairOutcome& p : c.pairs) {
    EXPECT_NEAR(p.force[2], -0.5 * p.k0 * p.penetration / p.distance, 1e-9 * c.largest_force);
    sum += std::abs(p.force[2]);
  }
  EXPECT_NEAR(c.totals.total_abs, sum, 1e-9 * sum);
}

}  // namespace
}  // namespace deck::cycle
