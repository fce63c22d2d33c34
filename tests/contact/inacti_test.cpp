// Initial penetrations, Inacti and Fpenmax by the published worked examples.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "contact/published.hpp"
#include "contact/rules/actions.hpp"
#include "contact/shared/reported.hpp"

namespace deck::test {
namespace {

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

TEST(ModernInacti, WhatIsStored) {
  const auto acted = [](int type, int inacti, double depth) {
    PenetrationRow row;
    row.depth = depth;
    detail::act_on_type24_25(type, inacti, row);
    return std::pair(row.action, row.p0);
  };
  EXPECT_EQ(acted(24, 5, 0.25), std::pair(PenetrationAction::offset_stored, 0.25));
  EXPECT_EQ(acted(24, -1, 0.25), std::pair(PenetrationAction::initial_force, 0.25));
  EXPECT_EQ(acted(25, -1, 0.25), std::pair(PenetrationAction::initial_force, 0.0));
  EXPECT_EQ(acted(25, 0, 0.25), std::pair(PenetrationAction::ignored, 0.0));
  EXPECT_EQ(acted(25, 0, 1e-9), std::pair(PenetrationAction::ignored, 1e-9))
      << "too small to count";
}

TEST(Inacti, StoresThePenetrationOrSwitchesOneSideOff) {
  using A = PenetrationAction;
  struct Case {
    const char* card;
    A action;
    double p0;  ///< what is taken off the gap of 1
    bool node_off, segment_off;
  };
  const Case cases[] = {
      {"@/INTER/TYPE7/1 Gapmin=1", A::none, 0, false, false},
      {"@/INTER/TYPE7/1 Gapmin=1 Inacti=1", A::node_stiffness_zero, 0, true, false},
      {"@/INTER/TYPE7/1 Gapmin=1 Inacti=2", A::segment_stiffness_zero, 0, false, true},
      {"@/INTER/TYPE7/1 Gapmin=1 Inacti=5", A::gap_reduced, 0.600000006, false, false},
      {"@/INTER/TYPE7/1 Gapmin=1 Inacti=6", A::gap_reduced, 0.6200000057, false, false},
      {"@/INTER/TYPE10/1 Gap=1 Inacti=3", A::none, 0, false, false}};
  for (const Case& c : cases) {
    const Built b(over_quad({{3, 4, 0.4}, {3, 4, 3}}).add(c.card));
    const Contact& contact = b.contact();
    const PenetrationRow& r = *b.row(contact, 101);
    EXPECT_NEAR(r.depth, 0.6, 1e-15);
    EXPECT_EQ(r.action, c.action) << c.card;
    EXPECT_EQ(r.has_gap0, c.p0 > 0);
    EXPECT_NEAR(r.p0, c.p0, 1e-14) << c.card;
    EXPECT_NEAR(r.gap0, r.has_gap0 ? 1 - c.p0 : 0, 1e-14);
    EXPECT_EQ(b.secondary(contact, 101)->off, c.node_off) << c.card;
    EXPECT_FALSE(b.secondary(contact, 102)->off);
    EXPECT_EQ(contact.main.at(0).off, c.segment_off) << c.card;
    EXPECT_DOUBLE_EQ(contact.main.at(0).stiffness, 400);
  }
}

TEST(Inacti3, MovesTheNodeJustOutOfTheGapForLaterInterfacesToo) {
  const Built b(over_quad({{3, 4, 0.4}})
                    .add("@/INTER/TYPE7/1 Gapmin=1")
                    .add("@/INTER/TYPE7/2 Gapmin=1 Inacti=3")
                    .add("@/INTER/TYPE7/3 Gapmin=1.5"));
  const PenetrationRow& r = *b.row(b.contact(2), 101);
  EXPECT_EQ(r.action, PenetrationAction::node_moved);
  EXPECT_NEAR(r.moved_by[2], 0.600000006, 1e-15);
  const NodeIndex n = b.model.nodes.map.find(101);
  EXPECT_NEAR(b.scene.coordinates.z[n], 1.000000006, 1e-15);
  EXPECT_EQ(b.scene.coordinates.x[n], 3);
  EXPECT_EQ(b.model.nodes.z[n], 0.4) << "the model keeps the deck's coordinates";
  EXPECT_NEAR(b.row(b.contact(1), 101)->depth, 0.6, 1e-15);
  EXPECT_NEAR(b.row(b.contact(3), 101)->depth, 0.5 - 6e-9, 1e-15);
}

TEST(Inacti3, SolidsAtAMovedNodeHaveTheirNewVolumeInLaterInterfaces) {
  const Built b(over_quad({{3, 4, 0.4}, {3, 4, 5}, {4, 4, 5}, {3, 5, 5}})
                    .solid_part(2)
                    .tetra(2, 2, 101, 102, 103, 104)
                    .segments("/SURF/SEG/5", {{102, 103, 104}})
                    .add("@/INTER/TYPE7/1 surf_IDm=5 Gapmin=0.1\n@/INTER/TYPE7/2 Gapmin=1 Inacti=3")
                    .add("@/INTER/TYPE7/3 surf_IDm=5 Gapmin=0.1"));
  const auto stiffness = [&](int id) { return b.contact(id).main.at(0).stiffness; };
  EXPECT_NEAR(stiffness(3) / stiffness(1), 4.6 / (4 - 6e-9), 1e-12);
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
  EXPECT_NEAR(c.penetrations[1].depth, 1 - 6 / std::sqrt(116.0), 1e-8);
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

TEST(Fpenmax, SwitchesOffOnlyWhatIsDeeperAlsoWithoutInacti) {
  for (const int inacti : {5, 0}) {
    const Built b(over_triangle().add("@/INTER/TYPE7/1 Gapmin=1 Fpenmax=0.65 Inacti=" +
                                      std::to_string(inacti)));
    const Contact& c = b.contact();
    EXPECT_EQ(c.penetrations.size(), 5u);
    for (const PenetrationRow& r : c.penetrations) {
      const bool deep = b.model.node_id(c.secondary[r.secondary].node) == 134;
      const auto other = inacti == 5 ? PenetrationAction::gap_reduced : PenetrationAction::none;
      EXPECT_EQ(r.action, deep ? PenetrationAction::node_stiffness_zero : other);
      EXPECT_EQ(c.secondary[r.secondary].off, deep);
      EXPECT_EQ(r.has_gap0, !deep && inacti == 5);
    }
  }
}

SmallDeck on_surface(const std::string& card) {
  return over_quad({{3, 4, 0}, {3, 4, 0.9999999999}, {3, 4, 1}, {3, 4, 1e-16}, {5, 5, 0}})
      .add(card);
}

TEST(OnSurface, EveryAccuracyTellsItFromBeingNear) {
  for (const Accuracy accuracy :
       {Accuracy::fast, Accuracy::reference, Accuracy::robust, Accuracy::exact}) {
    SceneOptions options;
    options.accuracy = accuracy;
    const Built b(on_surface("@/INTER/TYPE7/1 Gapmin=1"), options);
    const Contact& c = b.contact();
    ASSERT_EQ(c.penetrations.size(), 4u) << to_string(accuracy);
    for (const int node : {101, 105}) {
      EXPECT_TRUE(b.row(c, node)->on_surface) << to_string(accuracy);
      EXPECT_EQ(b.row(c, node)->depth, 1);
      EXPECT_EQ(b.row(c, node)->normal, Normal{});
    }
    EXPECT_NEAR(b.row(c, 102)->depth, 1e-10, accuracy == Accuracy::fast ? 2e-16 : 1e-16);
    EXPECT_EQ(b.row(c, 103), nullptr);
    EXPECT_FALSE(b.row(c, 104)->on_surface) << to_string(accuracy);
    EXPECT_DOUBLE_EQ(b.row(c, 104)->depth, 1);
  }
}

TEST(OnSurface, SolverStopsUnlessTheCardAvoidsIt) {
  for (const auto& [card, action] :
       {std::pair("TYPE7/1 Gapmin=1", "error-612"),
        {"TYPE7/1 Gapmin=1 Inacti=1000", "error-612"},
        {"TYPE7/1 Gapmin=1 Inacti=5", "error-611"},
        {"TYPE7/1 Gapmin=1 Inacti=3", "error-611"},
        {"TYPE7/1 Gapmin=1 Inacti=1", "node-stiffness-zero"},
        {"TYPE7/1 Gapmin=1 Inacti=2", "segment-stiffness-zero"},
        {"TYPE7/1 Gapmin=1 Inacti=6 Fpenmax=0.5", "node-stiffness-zero"},
        {"TYPE10/1 Gap=1", "error-612"},
        {"TYPE10/1 Gap=1 ITIED=1", "none"}}) {
    const Built b(on_surface(std::string("@/INTER/") + card));
    EXPECT_EQ(std::string(to_string(b.row(b.contact(), 101)->action)), action) << card;
  }
  const Built five(on_surface("@/INTER/TYPE7/1 Gapmin=1 Inacti=5"));
  EXPECT_EQ(five.row(five.contact(), 101)->p0, 1) << "not inflated";
  EXPECT_EQ(five.row(five.contact(), 101)->gap0, 0);
}

SmallDeck edges(const std::string& card) { return published_edges().add(card); }

TEST(EdgePair, Inacti5And6StoreHalfOnEachEdgeWhereTheLargestWins) {
  const Built five(edges("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Inacti=5"));
  const Built six(edges("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Inacti=6"));
  for (const auto& [b, stored] : {std::pair(&five, 0.230051), {&six, 0.258548}}) {
    const Contact& c = b->contact();
    const PenetrationRow& r = *b->edges(c, {11, 12}, {1, 2});
    EXPECT_NEAR(r.depth, 0.460101, 1e-6);
    EXPECT_NEAR(c.secondary_stored[r.secondary], stored, 1e-6);
    EXPECT_NEAR(c.main_stored[r.main], stored, 1e-6);
  }
  // Edge 11-12 keeps what its deeper pair stored; the shallower pair loses more than it has.
  const PenetrationRow& far = *five.edges(five.contact(), {11, 12}, {3, 4});
  EXPECT_NEAR(far.depth, 0.353444, 1e-6);
  EXPECT_NEAR(far.p0, 0.5 * 0.460101 + 0.5 * 0.353444, 1e-6);
  EXPECT_NEAR(far.gap0, far.gap - far.p0, 1e-15);
}

TEST(EdgePair, Inacti1And2SwitchOneSideOff) {
  for (const bool main : {false, true}) {
    const Built b(
        edges(std::string("@/INTER/TYPE11/1 line_IDs=3 line_IDm=1 Inacti=") + (main ? "2" : "1")));
    const PenetrationRow& r = *b.edges(b.contact(), {21, 22}, {1, 2});
    EXPECT_EQ(r.action, PenetrationAction::edge_stiffness_zero);
    EXPECT_EQ(b.contact().secondary_edges[r.secondary].off, !main);
    EXPECT_EQ(b.contact().main_edges[r.main].off, main);
  }
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

}  // namespace
}  // namespace deck::test
