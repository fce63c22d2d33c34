// Initial penetrations and what Inacti and Fpenmax do about them. Figures are the published worked
// examples.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <tuple>

#include "contact/published.hpp"
#include "contact/rules/actions.hpp"

namespace deck::test {
namespace {

using std::sqrt;
using Normal = std::array<double, 3>;

/// A 10 x 10 quad of thickness 2 with corner heights z, nodes 1-4, and free nodes 101, 102 ...
SmallDeck over_quad(const std::vector<Normal>& points, const std::array<double, 4>& z = {}) {
  SmallDeck d;
  d.node(1, 0, 0, z[0]).node(2, 10, 0, z[1]).node(3, 10, 10, z[2]).node(4, 0, 10, z[3]);
  std::vector<int> ids(points.size());
  std::iota(ids.begin(), ids.end(), 101);
  for (std::size_t i = 0; i < points.size(); ++i)
    d.node(ids[i], points[i][0], points[i][1], points[i][2]);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}}).group("/GRNOD/NODE/2", ids);
  return d;
}

void expect_normal(const PenetrationRow& row, const Normal& n) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(row.normal[k], n[k], 1e-6) << k;
}

TEST(FlatQuad, DepthsAndNormalsOfThePublishedExample) {
  const Built b(
      over_quad({{3, 4, 0.4}, {3, 4, -0.7}, {5, 5, 0.25}}).add("@/INTER/TYPE7/1 Gapmin=1"));
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 3u);
  EXPECT_NEAR(b.row(c, 101)->depth, 0.6, 1e-15);
  expect_normal(*b.row(c, 101), {0, 0, 1});
  EXPECT_NEAR(b.row(c, 102)->depth, 0.3, 1e-15);
  expect_normal(*b.row(c, 102), {0, 0, -1});
  EXPECT_NEAR(b.row(c, 103)->depth, 0.75, 1e-15);
  for (const PenetrationRow& r : c.penetrations) EXPECT_EQ(r.action, PenetrationAction::none);
}

/// Two sheets of n by n nodes, the upper ones at uneven heights within the gap of the lower ones.
SmallDeck two_sheets(int n) {
  SmallDeck d;
  std::vector<int> upper;
  const auto lower_id = [n](int i, int j) { return 1 + i * n + j; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      d.node(lower_id(i, j), i, j, 0);
      upper.push_back(n * n + lower_id(i, j));
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      d.node(n * n + lower_id(i, j), i + 0.3, j + 0.4, 0.1 + 0.01 * ((7 * i + 3 * j) % 11));
  d.shell_part(1, 1);
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j)
      d.shell(1, lower_id(i, j), lower_id(i, j), lower_id(i + 1, j), lower_id(i + 1, j + 1),
              lower_id(i, j + 1));
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", upper);
}

TEST(Penetrations, AreTheSameForAnyNumberOfThreads) {
  for (const char* inacti : {"0", "1", "3", "6"}) {
    const SmallDeck d =
        two_sheets(40).add("@/INTER/TYPE7/1 Gapmin=0.5 Inacti=" + std::string(inacti));
    SceneOptions many;
    many.threads = 3;
    const Built one(d), three(d, many);
    const Contact &a = one.contact(), &b = three.contact();
    EXPECT_GT(a.candidates, 8192u);  // more than two threads judge at once
    EXPECT_EQ(a.candidates, b.candidates);
    EXPECT_EQ(one.scene.decisions.pairs, three.scene.decisions.pairs);
    EXPECT_EQ(one.scene.coordinates.z, three.scene.coordinates.z);
    ASSERT_EQ(a.penetrations.size(), b.penetrations.size());
    EXPECT_GE(a.penetrations.size(), 1000u);
    for (std::size_t i = 0; i < a.penetrations.size(); ++i) {
      const PenetrationRow &p = a.penetrations[i], &q = b.penetrations[i];
      ASSERT_EQ(std::tie(p.secondary, p.main, p.depth, p.action, p.gap0, p.moved_by),
                std::tie(q.secondary, q.main, q.depth, q.action, q.gap0, q.moved_by))
          << inacti << " " << i;
    }
  }
}

TEST(FlatQuad, OutsideEdgeAndCorner) {
  const Built b(over_quad({{10.5, 5, 0.5}, {10.6, 10.3, 0.3}, {10.9, 10.9, 0.5}})
                    .add("@/INTER/TYPE7/1 Gapmin=1"));
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 2u);
  EXPECT_NEAR(b.row(c, 101)->depth, 1 - sqrt(0.5), 1e-15);
  expect_normal(*b.row(c, 101), {sqrt(0.5), 0, sqrt(0.5)});
  EXPECT_EQ(b.row(c, 101)->feature, Feature::edge);
  EXPECT_NEAR(b.row(c, 102)->depth, 1 - sqrt(0.54), 1e-15);
  expect_normal(*b.row(c, 102), {0.816497, 0.408248, 0.408248});
  EXPECT_EQ(b.row(c, 102)->feature, Feature::corner);
  // The third is near enough to be a candidate (0.2 mean sides beyond the gap), not to penetrate.
  EXPECT_EQ(c.candidates, 3u);
}

TEST(WarpedQuad, StoredPenetrationsOfInacti6) {
  const Built b(over_quad({{5, 3, 1.3}, {8, 2, 1.9}, {5, 5, 0.6}, {1, 5, 1.8}}, {0, 2, 0, 2})
                    .add("@/INTER/TYPE7/1 Gapmin=1 Inacti=6"));
  const Contact& c = b.contact();
  const double depth[] = {0.705826, 0.702956, 0.603941, 0.215535};
  const double p0[] = {0.720535, 0.717808, 0.623744, 0.254759};
  const double gap0[] = {0.279465, 0.282192, 0.376256, 0.745241};
  ASSERT_EQ(c.penetrations.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const PenetrationRow& r = c.penetrations[i];
    EXPECT_NEAR(r.depth, depth[i], 1e-6);
    EXPECT_EQ(r.action, PenetrationAction::gap_reduced);
    EXPECT_TRUE(r.has_gap0);
    EXPECT_NEAR(r.p0, p0[i], 1e-6);
    EXPECT_NEAR(r.gap0, gap0[i], 1e-6);
  }
  expect_normal(c.penetrations[0], {-0.196116, 0, 0.980581});
  expect_normal(c.penetrations[1], {-0.099015, 0.099015, 0.990148});
  expect_normal(c.penetrations[3], {0, -0.196116, 0.980581});
}

TEST(ModernInacti, WhatIsStoredAndWhichFindTheSame) {
  const auto acted = [](int type, int inacti, double depth) {
    PenetrationRow row;
    row.depth = depth;
    detail::act_on_modern(type, inacti, row);
    return std::pair(row.action, row.p0);
  };
  EXPECT_EQ(acted(24, 5, 0.25), std::pair(PenetrationAction::offset_stored, 0.25));
  EXPECT_EQ(acted(24, -1, 0.25), std::pair(PenetrationAction::initial_force, 0.25));
  EXPECT_EQ(acted(25, -1, 0.25), std::pair(PenetrationAction::initial_force, 0.0));
  EXPECT_EQ(acted(25, 0, 0.25), std::pair(PenetrationAction::ignored, 0.0));
  EXPECT_EQ(acted(25, 0, 1e-9), std::pair(PenetrationAction::ignored, 1e-9))
      << "too small to count";
  EXPECT_TRUE(detail::finds_the_same(5, -1));
  EXPECT_FALSE(detail::finds_the_same(0, 5));
}

TEST(Inacti5, StoresThePenetrationItself) {
  const Built b(over_quad({{3, 4, 0.4}}).add("@/INTER/TYPE7/1 Gapmin=1 Inacti=5"));
  const PenetrationRow& r = *b.row(b.contact(), 101);
  EXPECT_NEAR(r.p0, 0.600000006, 1e-15);
  EXPECT_NEAR(r.gap0, 0.399999994, 1e-15);
}

TEST(Inacti6, AddsFivePercentOfWhatIsLeft) {
  const Built b(over_quad({{3, 4, 0.4}}).add("@/INTER/TYPE7/1 Gapmin=1 Inacti=6"));
  const PenetrationRow& r = *b.row(b.contact(), 101);
  EXPECT_NEAR(r.p0, 0.6200000057, 1e-14);
  EXPECT_NEAR(r.gap0, 0.3799999943, 1e-14);
}

TEST(Inacti3, MovesTheNodeJustOutOfTheGap) {
  const Built b(over_quad({{3, 4, 0.4}}).add("@/INTER/TYPE7/1 Gapmin=1 Inacti=3"));
  const PenetrationRow& r = *b.row(b.contact(), 101);
  EXPECT_EQ(r.action, PenetrationAction::node_moved);
  EXPECT_NEAR(r.moved_by[2], 0.600000006, 1e-15);
  const NodeIndex n = b.model.nodes.map.find(101);
  EXPECT_NEAR(b.scene.coordinates.z[n], 1.000000006, 1e-15);
  EXPECT_EQ(b.scene.coordinates.x[n], 3);
  EXPECT_EQ(b.model.nodes.z[n], 0.4) << "the model keeps the deck's coordinates";
}

TEST(Inacti3, LaterInterfacesSeeTheMovedNode) {
  const Built b(over_quad({{3, 4, 0.4}})
                    .add("@/INTER/TYPE7/1 Gapmin=1")
                    .add("@/INTER/TYPE7/2 Gapmin=1 Inacti=3")
                    .add("@/INTER/TYPE7/3 Gapmin=1.5"));
  EXPECT_NEAR(b.row(b.contact(1), 101)->depth, 0.6, 1e-15);
  EXPECT_NEAR(b.row(b.contact(3), 101)->depth, 0.5 - 6e-9, 1e-15);
}

/// Two quads that meet at a right angle along x = 10: a floor and a wall, and a node near both.
SmallDeck floor_and_wall(double from_floor, double from_wall) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 10, 0, 10).node(6, 10, 10, 10).node(101, 10 - from_wall, 5, from_floor);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101});
}

TEST(Inacti3, PairsOfOneGroupAreAllMeasuredFromTheStart) {
  // Wall first: 0.25 from the floor (depth 0.75), 0.5 from the wall (depth 0.5). Both depths are
  // those of the deck's position; only the larger move counts.
  const Built b(floor_and_wall(0.25, 0.5).add("@/INTER/TYPE7/1 Gapmin=1 Inacti=3"));
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 2u);
  EXPECT_NEAR(c.penetrations[0].depth, 0.75, 1e-15);
  EXPECT_NEAR(c.penetrations[1].depth, 0.5, 1e-15);
  EXPECT_EQ(c.penetrations[1].moved_by, Normal{});
  const NodeIndex n = b.model.nodes.map.find(101);
  EXPECT_NEAR(b.scene.coordinates.z[n], 1 + 7.5e-9, 1e-14);
  EXPECT_NEAR(b.scene.coordinates.x[n], 9.5, 1e-14);
}

TEST(Inacti3, TheLargerMoveReplacesTheSmallerOne) {
  const Built b(floor_and_wall(0.5, 0.25).add("@/INTER/TYPE7/1 Gapmin=1 Inacti=3"));
  const NodeIndex n = b.model.nodes.map.find(101);
  EXPECT_NEAR(b.scene.coordinates.z[n], 0.5, 1e-14);
  EXPECT_NEAR(b.scene.coordinates.x[n], 9 - 7.5e-9, 1e-14);
}

TEST(Inacti3, OfTwoEqualMovesTheFirstStays) {
  // All in binary fractions, the node at the origin of the floor's axis: both moves are equal.
  SmallDeck d;
  d.node(1, 0, 0, -0.5).node(2, 8, 0, -0.5).node(3, 8, 8, -0.5).node(4, 0, 8, -0.5);
  d.node(5, 8, 0, 7.5).node(6, 8, 8, 7.5).node(101, 7.5, 4, 0);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101});
  const Built b(d.add("@/INTER/TYPE7/1 Gapmin=1 Inacti=3"));
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 2u);
  ASSERT_EQ(c.penetrations[0].depth, c.penetrations[1].depth);
  const NodeIndex n = b.model.nodes.map.find(101);
  EXPECT_EQ(b.scene.coordinates.x[n], 7.5);
  EXPECT_GT(b.scene.coordinates.z[n], 0.49);
  EXPECT_EQ(c.penetrations[1].moved_by, Normal{});
}

TEST(Inacti3, GroupsOf128CandidatesAddUp) {
  // 127 nodes far enough to be candidates only, then the node: its two pairs fall into two groups.
  SmallDeck d = floor_and_wall(0.25, 0.5);
  std::vector<int> ids;
  for (int i = 0; i < 127; ++i) {
    d.node(201 + i, 2 + 0.03 * i, 2, 1.5);
    ids.push_back(201 + i);
  }
  ids.push_back(101);
  d.group("/GRNOD/NODE/7", ids);
  const Built b(d.add("@/INTER/TYPE7/1 grnd_IDs=7 Gapmin=1 Inacti=3"));
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 2u);
  // Internal order is by id: 101 comes first unless the group keeps its own order.
  const NodeIndex n = b.model.nodes.map.find(101);
  const bool last = c.secondary.back().node == n;
  const double x = b.scene.coordinates.x[n];
  EXPECT_NEAR(x, last ? 9 - 5e-9 : 9.5, 1e-12);
}

TEST(Inacti3, APairOfTheNextGroupIsMeasuredAfterTheMove) {
  // A floor, a wall that leans over it, and 127 nodes that are candidates of the floor alone: the
  // floor's pair of node 501 ends the first group, the wall's begins the second.
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 6, 0, 10).node(6, 6, 10, 10).node(501, 9, 5, 0.25);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
  std::vector<int> ids;
  for (int i = 0; i < 127; ++i) {
    d.node(201 + i, 2 + 0.03 * i, 2, 1.5);
    ids.push_back(201 + i);
  }
  ids.push_back(501);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", ids);
  const Built b(d.add("@/INTER/TYPE7/1 Gapmin=1 Inacti=3"));
  const Contact& c = b.contact();
  ASSERT_EQ(c.candidates, 129u);
  ASSERT_EQ(c.penetrations.size(), 2u);
  EXPECT_NEAR(c.penetrations[0].depth, 0.75, 1e-15);
  // The floor moves the node up to z = 1 and nearer to the wall, whose distance from (x, z) is
  // (10 (10 - x) - 4 z) / sqrt(116): 6 instead of 9 of these parts.
  EXPECT_NEAR(c.penetrations[1].depth, 1 - 6 / sqrt(116.0), 1e-8);
}

TEST(Inacti1, SwitchesTheNodeOff) {
  const Built b(over_quad({{3, 4, 0.4}, {3, 4, 3}}).add("@/INTER/TYPE7/1 Gapmin=1 Inacti=1"));
  const Contact& c = b.contact();
  EXPECT_EQ(b.row(c, 101)->action, PenetrationAction::node_stiffness_zero);
  EXPECT_TRUE(b.secondary(c, 101)->off);
  EXPECT_FALSE(b.secondary(c, 102)->off);
  EXPECT_EQ(b.secondary(c, 101)->multiplier, 1) << "as stored at start-up";
}

TEST(Inacti2, SwitchesTheSegmentOff) {
  const Built b(over_quad({{3, 4, 0.4}}).add("@/INTER/TYPE7/1 Gapmin=1 Inacti=2"));
  const Contact& c = b.contact();
  EXPECT_EQ(b.row(c, 101)->action, PenetrationAction::segment_stiffness_zero);
  EXPECT_TRUE(c.main.at(0).off);
  EXPECT_DOUBLE_EQ(c.main.at(0).stiffness, 400);
}

/// The right triangle (0,0) (6,0) (0,6) with the nodes of the published example.
SmallDeck over_triangle() {
  SmallDeck d;
  d.node(51, 500, 0, 0).node(52, 506, 0, 0).node(53, 500, 6, 0);
  d.node(131, 501, 1, 0.5).node(132, 503.5, 3.5, 0.4).node(133, 506.4, -0.3, 0.2);
  d.node(134, 502, 2, -0.3).node(135, 500, 6.5, 0.1);
  d.shell_part(1, 2).shell3(1, 6, 51, 52, 53).segments("/SURF/SEG/1", {{51, 52, 53, 53}});
  return d.group("/GRNOD/NODE/2", {131, 132, 133, 134, 135});
}

TEST(Triangle, DepthsAndNormalsOfThePublishedExample) {
  const Built b(over_triangle().add("@/INTER/TYPE7/1 Gapmin=1 Inacti=5"));
  const Contact& c = b.contact();
  const double depth[] = {0.5, 0.187596, 0.461484, 0.7, 0.490098};
  ASSERT_EQ(c.penetrations.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(c.penetrations[i].depth, depth[i], 1e-6);
  expect_normal(c.penetrations[1], {0.615457, 0.615457, 0.492366});
  expect_normal(c.penetrations[2], {0.742781, -0.557086, 0.371391});
  expect_normal(c.penetrations[4], {0, 0.980581, 0.196116});
}

TEST(Fpenmax, SwitchesOffOnlyWhatIsDeeper) {
  const Built b(over_triangle().add("@/INTER/TYPE7/1 Gapmin=1 Inacti=5 Fpenmax=0.65"));
  const Contact& c = b.contact();
  EXPECT_EQ(c.penetrations.size(), 5u);
  for (const PenetrationRow& r : c.penetrations) {
    const bool deep = b.model.node_id(c.secondary[r.secondary].node) == 134;
    EXPECT_EQ(r.action,
              deep ? PenetrationAction::node_stiffness_zero : PenetrationAction::gap_reduced);
    EXPECT_EQ(c.secondary[r.secondary].off, deep);
    EXPECT_EQ(r.has_gap0, !deep);
  }
}

TEST(Fpenmax, ActsWithoutInactiToo) {
  const Built b(over_triangle().add("@/INTER/TYPE7/1 Gapmin=1 Fpenmax=0.65"));
  EXPECT_EQ(b.row(b.contact(), 134)->action, PenetrationAction::node_stiffness_zero);
  EXPECT_EQ(b.row(b.contact(), 131)->action, PenetrationAction::none);
}

SmallDeck on_surface(const std::string& card) {
  return over_quad({{3, 4, 0}, {3, 4, 0.9999999999}, {3, 4, 1}, {3, 4, 1e-16}, {5, 5, 0}})
      .add(card);
}

TEST(OnSurface, ExactZeroOnly) {
  const Built b(on_surface("@/INTER/TYPE7/1 Gapmin=1"));
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 4u);
  EXPECT_TRUE(b.row(c, 101)->on_surface);
  EXPECT_EQ(b.row(c, 101)->depth, 1);
  EXPECT_EQ(b.row(c, 101)->normal, Normal{});
  EXPECT_NEAR(b.row(c, 102)->depth, 1e-10, 1e-16);
  EXPECT_EQ(b.row(c, 103), nullptr);
  EXPECT_FALSE(b.row(c, 104)->on_surface);
  EXPECT_DOUBLE_EQ(b.row(c, 104)->depth, 1);
  EXPECT_TRUE(b.row(c, 105)->on_surface);
}

TEST(OnSurface, EveryAccuracyTellsItFromBeingNear) {
  for (const Accuracy accuracy :
       {Accuracy::fast, Accuracy::reference, Accuracy::robust, Accuracy::exact}) {
    SceneOptions options;
    options.accuracy = accuracy;
    const Built b(on_surface("@/INTER/TYPE7/1 Gapmin=1"), options);
    const Contact& c = b.contact();
    EXPECT_TRUE(b.row(c, 101)->on_surface) << to_string(accuracy);
    EXPECT_EQ(b.row(c, 101)->normal, Normal{}) << to_string(accuracy);
    EXPECT_FALSE(b.row(c, 104)->on_surface) << to_string(accuracy);
  }
}

TEST(OnSurface, SolverStopsUnlessTheCardAvoidsIt) {
  const auto action = [](const std::string& card) {
    const Built b(on_surface(card));
    return std::string(to_string(b.row(b.contact(), 101)->action));
  };
  EXPECT_EQ(action("@/INTER/TYPE7/1 Gapmin=1"), "error-612");
  EXPECT_EQ(action("@/INTER/TYPE7/1 Gapmin=1 Inacti=1000"), "error-612");
  EXPECT_EQ(action("@/INTER/TYPE7/1 Gapmin=1 Inacti=5"), "error-611");
  EXPECT_EQ(action("@/INTER/TYPE7/1 Gapmin=1 Inacti=3"), "error-611");
  EXPECT_EQ(action("@/INTER/TYPE7/1 Gapmin=1 Inacti=1"), "node-stiffness-zero");
  EXPECT_EQ(action("@/INTER/TYPE7/1 Gapmin=1 Inacti=2"), "segment-stiffness-zero");
  EXPECT_EQ(action("@/INTER/TYPE7/1 Gapmin=1 Inacti=6 Fpenmax=0.5"), "node-stiffness-zero");
  EXPECT_EQ(action("@/INTER/TYPE10/1 Gap=1"), "error-612");
  EXPECT_EQ(action("@/INTER/TYPE10/1 Gap=1 ITIED=1"), "none");
}

TEST(OnSurface, GapIsUsedUpByInacti5AndFpenmaxComesFirst) {
  const Built five(on_surface("@/INTER/TYPE7/1 Gapmin=1 Inacti=5"));
  EXPECT_EQ(five.row(five.contact(), 101)->p0, 1) << "not inflated";
  EXPECT_EQ(five.row(five.contact(), 101)->gap0, 0);
  const Built six(on_surface("@/INTER/TYPE7/1 Gapmin=1 Inacti=6 Fpenmax=0.5"));
  EXPECT_EQ(six.row(six.contact(), 101)->action, PenetrationAction::node_stiffness_zero);
}

TEST(Type10, OnlyReports) {
  const Built b(over_quad({{3, 4, 0.4}}).add("@/INTER/TYPE10/1 Gap=1 Inacti=3"));
  const Contact& c = b.contact();
  EXPECT_EQ(c.type, 10);
  EXPECT_NEAR(b.row(c, 101)->depth, 0.6, 1e-15);
  EXPECT_EQ(b.row(c, 101)->action, PenetrationAction::none);
  EXPECT_DOUBLE_EQ(c.main.at(0).stiffness, 400) << "Stfac = 1 on the card";
}

SmallDeck edges(const std::string& card) { return published_edges().add(card); }

TEST(EdgePair, CrossingsOfThePublishedExample) {
  const Built shells(edges("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1"));
  const PenetrationRow& near = *shells.edges(shells.contact(), {11, 12}, {1, 2});
  EXPECT_NEAR(near.weight_s, 0.801013, 1e-6);
  EXPECT_NEAR(near.weight_m, 0.580101, 1e-6);
  EXPECT_NEAR(near.distance, 1.139899, 1e-6);
  EXPECT_NEAR(near.depth, 0.460101, 1e-6);
  expect_normal(near, {0, -0.013332, 0.999911});
  const PenetrationRow& far = *shells.edges(shells.contact(), {11, 12}, {3, 4});
  EXPECT_NEAR(far.depth, 0.353444, 1e-6);
  EXPECT_NEAR(far.weight_m, 0.473223, 1e-6);
  const Built beam(edges("@/INTER/TYPE11/1 line_IDs=3 line_IDm=1"));
  EXPECT_NEAR(beam.edges(beam.contact(), {21, 22}, {1, 2})->depth, 1.263758, 1e-6);
  const Built truss(edges("@/INTER/TYPE11/1 line_IDs=4 line_IDm=5"));
  EXPECT_NEAR(truss.edges(truss.contact(), {41, 42}, {35, 36})->depth, 0.187505, 1e-6);
}

TEST(EdgePair, Inacti5And6StoreHalfOnEachEdge) {
  const Built five(edges("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Inacti=5"));
  const Built six(edges("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Inacti=6"));
  const auto stored = [](const Built& b, std::int64_t n1, std::int64_t n2) {
    const Contact& c = b.contact();
    const PenetrationRow& r = *b.edges(c, {11, 12}, {n1, n2});
    return std::array{c.secondary_edges[r.secondary].stored_penetration,
                      c.main_edges[r.main].stored_penetration};
  };
  EXPECT_NEAR(stored(five, 1, 2)[0], 0.230051, 1e-6);
  EXPECT_NEAR(stored(five, 1, 2)[1], 0.230051, 1e-6);
  EXPECT_NEAR(stored(six, 1, 2)[0], 0.258548, 1e-6);
}

TEST(EdgePair, TheStoreIsPerEdgeAndTheLargestWins) {
  const Built b(edges("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Inacti=5"));
  const Contact& c = b.contact();
  const PenetrationRow& far = *b.edges(c, {11, 12}, {3, 4});
  // Edge 11-12 keeps what its deeper pair stored; the shallower pair loses more than it has.
  EXPECT_NEAR(far.p0, 0.5 * 0.460101 + 0.5 * 0.353444, 1e-6);
  EXPECT_GT(far.p0, far.depth);
  EXPECT_NEAR(far.gap0, far.gap - far.p0, 1e-15);
}

TEST(EdgePair, Inacti1And2SwitchOneSideOff) {
  const Built one(edges("@/INTER/TYPE11/1 line_IDs=3 line_IDm=1 Inacti=1"));
  const PenetrationRow& r1 = *one.edges(one.contact(), {21, 22}, {1, 2});
  EXPECT_EQ(r1.action, PenetrationAction::edge_stiffness_zero);
  EXPECT_TRUE(one.contact().secondary_edges[r1.secondary].off);
  EXPECT_FALSE(one.contact().main_edges[r1.main].off);
  const Built two(edges("@/INTER/TYPE11/1 line_IDs=3 line_IDm=1 Inacti=2"));
  const PenetrationRow& r2 = *two.edges(two.contact(), {21, 22}, {1, 2});
  EXPECT_FALSE(two.contact().secondary_edges[r2.secondary].off);
  EXPECT_TRUE(two.contact().main_edges[r2.main].off);
}

/// Two trusses that cross at height `z`; gap 1.
SmallDeck crossing(double z, const std::string& inacti) {
  SmallDeck d;
  d.node(1, -1, 0, 0).node(2, 1, 0, 0).node(3, 0, -1, z).node(4, 0, 1, z);
  d.truss_part(1, 1).bar("TRUSS", 1, 1, 1, 2).bar("TRUSS", 1, 2, 3, 4);
  d.segments("/LINE/SEG/1", {{1, 2}}).segments("/LINE/SEG/2", {{3, 4}});
  return d.add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Gapmin=1 Inacti=" + inacti);
}

TEST(EdgePair, BeyondHalfAPercentOfTheGapTheEdgeIsSwitchedOff) {
  const auto action = [](double z, const std::string& inacti) {
    const Built b(crossing(z, inacti));
    return b.contact().penetrations.at(0).action;
  };
  for (const char* inacti : {"5", "6"}) {
    EXPECT_EQ(action(0.004, inacti), PenetrationAction::edge_stiffness_zero);
    EXPECT_EQ(action(0.006, inacti), PenetrationAction::gap_reduced);
  }
  // With Inacti 5 the penetration is inflated by 1e-8 before the comparison, with 6 it is not.
  EXPECT_EQ(action(0.005 + 5e-9, "5"), PenetrationAction::edge_stiffness_zero);
  EXPECT_EQ(action(0.005 + 5e-9, "6"), PenetrationAction::gap_reduced);
}

TEST(EdgePair, TouchingEdgesHaveNoDirectionAndNoError) {
  const Built b(crossing(0, "0"));
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 1u);
  EXPECT_TRUE(c.penetrations[0].on_surface);
  EXPECT_EQ(c.penetrations[0].normal, Normal{});
  EXPECT_EQ(on_surface_error(c), 0);
}

/// Edges of free trusses, as in the published special cases.
Built* trusses(const Normal& s1, const Normal& s2, const Normal& m1, const Normal& m2, double gap) {
  SmallDeck d;
  d.node(1, s1[0], s1[1], s1[2]).node(2, s2[0], s2[1], s2[2]);
  d.node(3, m1[0], m1[1], m1[2]).node(4, m2[0], m2[1], m2[2]);
  d.truss_part(1, 1).bar("TRUSS", 1, 1, 1, 2).bar("TRUSS", 1, 2, 3, 4);
  d.segments("/LINE/SEG/1", {{3, 4}}).segments("/LINE/SEG/2", {{1, 2}});
  char card[100];
  std::snprintf(card, sizeof card, "@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Gapmin=%g", gap);
  return new Built(d.add(card));
}

TEST(EdgePair, ParallelAndEndToEnd) {
  const std::unique_ptr<Built> parallel(trusses({0, 1, 0}, {4, 1, 0}, {1, 0, 0}, {9, 0, 0}, 1.5));
  const PenetrationRow& p = parallel->contact().penetrations.at(0);
  EXPECT_DOUBLE_EQ(p.weight_s, 0);
  EXPECT_DOUBLE_EQ(p.weight_m, 0.625);
  EXPECT_DOUBLE_EQ(p.depth, 0.5);
  const std::unique_ptr<Built> ends(trusses({0, 0, 0}, {4, 0, 0}, {4.3, 0.4, 0}, {8, 3, 0}, 1));
  const PenetrationRow& e = ends->contact().penetrations.at(0);
  EXPECT_DOUBLE_EQ(e.weight_s, 0);
  EXPECT_DOUBLE_EQ(e.weight_m, 1);
  EXPECT_NEAR(e.depth, 0.5, 1e-15);
}

}  // namespace
}  // namespace deck::test
