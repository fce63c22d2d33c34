// Main segments: repair, orientation, degeneracy, carriers. Stiffness of segments, edges and
// secondary nodes as stored at start-up.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/published.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

using Ids = std::array<std::int64_t, 4>;

/// One quad shell, nodes 1-4, one free node 99 and the segments given.
SmallDeck plain(const std::vector<std::vector<int>>& segments) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(99, 5, 5, 50);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).segments("/SURF/SEG/1", segments);
  return d.group("/GRNOD/NODE/2", {99}).add("@/INTER/TYPE7/1 Gapmin=1");
}

std::vector<Ids> main_ids(const Built& b, const Contact& c) {
  std::vector<Ids> out;
  for (const MainSegment& m : c.main) out.push_back(b.ids(m.nodes));
  return out;
}

TEST(Repair, FirstMatchingRuleOnly) {
  const Built b(plain({{1, 2, 2, 4}, {1, 2, 3, 1}, {1, 1, 3, 4}, {1, 2, 3, 4}, {1, 2, 3, 3}}));
  const Contact& c = b.contact();
  const std::vector<Ids> expected = {
      {1, 2, 4, 4}, {1, 2, 3, 3}, {1, 3, 4, 4}, {1, 2, 3, 4}, {1, 2, 3, 3}};
  EXPECT_EQ(main_ids(b, c), expected);
  EXPECT_EQ(c.repaired_segments, 3);
  EXPECT_EQ(c.degenerate_segments, 0);
}

TEST(Degenerate, CrossedAndFlatSegmentsOfType7) {
  // Nodes 1 3 2 4 make a bow tie; 1 5 2 with node 5 between them has no area.
  SmallDeck d = plain({{1, 3, 2, 4}, {1, 2, 3, 4}, {1, 5, 2, 2}});
  d.node(5, 5, 0, 0).add("@/INTER/TYPE10/2 Gap=1");
  const Built b(d);
  EXPECT_EQ(b.contact(1).degenerate, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(b.contact(2).degenerate_segments, 0) << "TYPE10 is not checked";
}

/// Two stacked bricks (nodes 1-8 and 5-8, 15-18) and a single one (31-38).
SmallDeck bricks() {
  SmallDeck d;
  const double x[4] = {0, 2, 2, 0}, y[4] = {0, 0, 2, 2};
  for (int i = 0; i < 4; ++i) {
    d.node(1 + i, x[i], y[i], 0).node(5 + i, x[i], y[i], 2).node(15 + i, x[i], y[i], 4);
    d.node(31 + i, 50 + x[i], y[i], 0).node(35 + i, 50 + x[i], y[i], 2);
  }
  d.node(99, 0, 0, 50).solid_part(2);
  d.brick(2, 1, {1, 2, 3, 4, 5, 6, 7, 8}).brick(2, 2, {5, 6, 7, 8, 15, 16, 17, 18});
  d.brick(2, 4, {31, 32, 33, 34, 35, 36, 37, 38}).group("/GRNOD/NODE/2", {99});
  return d;
}

TEST(Orientation, FacesOfOneSolidPointOutwardSharedOnesAreLeftAlone) {
  SmallDeck d = bricks();
  d.segments("/SURF/SEG/1",
             {{1, 2, 3, 4}, {5, 6, 7, 8}, {4, 1, 2, 3}, {1, 4, 3, 2}, {31, 32, 33, 34}});
  const Built b(d.add("@/INTER/TYPE7/1"));
  const Contact& c = b.contact();
  const std::vector<Ids> expected = {
      {4, 3, 2, 1}, {5, 6, 7, 8}, {3, 2, 1, 4}, {1, 4, 3, 2}, {34, 33, 32, 31}};
  EXPECT_EQ(main_ids(b, c), expected);
  EXPECT_EQ(c.reoriented_segments, 3);
  // The face between the bricks belongs to the one with the larger id.
  EXPECT_EQ(c.main[1].carrier, Carrier::solid);
  EXPECT_EQ(b.model.solid8.id[c.main[1].element], 2);
}

TEST(Orientation, TriangleSwapsItsFirstTwoNodes) {
  SmallDeck d;
  d.node(21, 40, 0, 0).node(22, 43, 0, 0).node(23, 40, 3, 0).node(24, 40, 0, 3).node(99, 9, 9, 9);
  d.solid_part(3).tetra(3, 3, 21, 22, 23, 24).group("/GRNOD/NODE/2", {99});
  d.segments("/SURF/SEG/1", {{21, 22, 23, 23}, {21, 23, 22, 22}});
  const Built b(d.add("@/INTER/TYPE7/1"));
  const std::vector<Ids> expected = {{22, 21, 23, 23}, {21, 23, 22, 22}};
  EXPECT_EQ(main_ids(b, b.contact()), expected);
  EXPECT_EQ(b.contact().reoriented_segments, 1);
}

TEST(Carrier, ThickestShellThenLargerYoungsModulus) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(99, 5, 5, 50);
  d.elastic_material(2, 300).shell_part(1, 1).shell_part(2, 2).shell_part(3, 2, 0, 2);
  d.shell(1, 1, 1, 2, 3, 4).shell(2, 2, 2, 3, 4, 1).shell(3, 3, 3, 4, 1, 2);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}}).group("/GRNOD/NODE/2", {99});
  const Built b(d.add("@/INTER/TYPE7/1"));
  const MainSegment& m = b.contact().main.at(0);
  EXPECT_EQ(m.carrier, Carrier::shell4);
  EXPECT_EQ(b.model.shell4.id[m.element], 3);
  EXPECT_DOUBLE_EQ(m.stiffness, 600);
}

TEST(ShellOnSolid, OneSegmentWhereBothPartsAreSelected) {
  SmallDeck d = bricks();
  d.shell_part(1, 0.15).shell(1, 11, 35, 36, 37, 38);
  d.group("/SURF/PART/EXT/3", {2}).group("/SURF/PART/EXT/6", {1, 2});
  d.add("@/INTER/TYPE7/3 surf_IDm=3").add("@/INTER/TYPE7/6 surf_IDm=6");
  const Built b(d);
  EXPECT_EQ(b.contact(3).main.size(), 16u);
  EXPECT_EQ(b.contact(6).main.size(), 16u);
  EXPECT_EQ(b.main(b.contact(3), {35, 36, 37, 38})->carrier, Carrier::solid);
  EXPECT_EQ(b.main(b.contact(6), {35, 36, 37, 38})->carrier, Carrier::shell4);
}

constexpr double bulk = 500.0 / 3;  // E = 200, nu = 0.3

SmallDeck published() { return published_solids().segments("/SURF/SEG/1", {{5, 6, 7, 8}}); }

TEST(MainStiffness, OfSolidsAndShellsIsThatOfThePublishedExample) {
  struct Case {
    const char* card;
    std::vector<std::int64_t> segment;
    double stiffness;
  };
  const Case cases[] = {
      {"TYPE7/1 surf_IDm=3", {5, 6, 7, 8}, 16 * bulk / 8},
      {"TYPE7/1 surf_IDm=3", {11, 12, 13, 14}, 310.0775},
      {"TYPE7/1 surf_IDm=3", {15, 16, 17, 18}, 324.0310},
      {"TYPE7/1 surf_IDm=3", {12, 13, 17, 16}, 410.0775},
      {"TYPE7/1 surf_IDm=7", {21, 22, 23}, 500},  // one and a half times a tetrahedron's volume
      {"TYPE7/1 surf_IDm=7", {22, 23, 24}, 1500},
      {"TYPE7/1 surf_IDm=2", {15, 16, 17, 18}, 30},  // the shell on the face of the solid
      {"TYPE7/1 surf_IDm=6", {15, 16, 17, 18}, 30},
      {"TYPE7/1 surf_IDm=1 Istf=1 Stfac=2", {5, 6, 7, 8}, -2 * 16 * bulk / 8},  // a product
      {"TYPE7/1 surf_IDm=5", {31, 32, 33, 34}, 200},
      {"TYPE7/1 surf_IDm=5", {32, 35, 36, 33}, 600},
      {"TYPE7/1 surf_IDm=5 Stfac=0.25", {32, 35, 36, 33}, 150},
      {"TYPE7/1 surf_IDm=5 Istf=1 Stfac=50", {32, 35, 36, 33}, 50},
      {"TYPE7/1 surf_IDm=5 Istf=5 Stfac=-3", {32, 35, 36, 33}, 3},
      {"TYPE10/1 surf_IDm=5 Stfac=0", {32, 35, 36, 33}, 120}};
  for (const Case& c : cases) {
    const Built b(published().add(std::string("@/INTER/") + c.card));
    const MainSegment* m = b.main(b.contact(), c.segment);
    ASSERT_NE(m, nullptr) << c.card;
    EXPECT_NEAR(m->stiffness, c.stiffness, 1e-4) << c.card << ' ' << c.segment[0];
  }
}

/// A quad of a void part, and a node 0.2 above it.
SmallDeck void_quad(double young) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(99, 3, 3, 0.2);
  d.void_material(2, young).void_part(1, 2, 2).shell(1, 1, 1, 2, 3, 4);
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {99}).add("@/INTER/TYPE7/1");
}

TEST(VoidElement, IsAnOrdinaryShellButTakesNoPartWithoutStiffness) {
  for (const double young : {200.0, 0.0}) {
    const Built b(void_quad(young));
    EXPECT_DOUBLE_EQ(b.contact().main.at(0).stiffness, 2 * young);
    EXPECT_EQ(b.contact().penetrations.size(), young > 0 ? 1u : 0u);
    EXPECT_DOUBLE_EQ(b.contact().gapmin, 2) << "its thickness makes the gap all the same";
  }
}

TEST(EdgeStiffness, ByCarrierAndFactorLaterRulesOverrideEarlierOnes) {
  SmallDeck d = published_edges();
  d.node(51, 60, 0, 0).node(52, 61, 0, 0).spring_part(6, 77).bar("SPRING", 6, 6, 51, 52);
  d.bar("TRUSS", 4, 14, 3, 4)
      .bar("TRUSS", 4, 15, 2, 51)
      .shell_part(7, 0.5)
      .shell(7, 17, 33, 34, 38, 37);
  d.segments("/LINE/SEG/7",
             {{1, 2}, {21, 22}, {41, 42}, {31, 32}, {31, 35}, {51, 52}, {1, 31}, {3, 4}, {33, 34}});
  const Built b(d.add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=7")
                    .add("@/INTER/TYPE11/2 line_IDs=2 line_IDm=7 Stfac=2")
                    .add("@/INTER/TYPE11/3 line_IDs=2 line_IDm=7 Istf=1 Stfac=5")
                    .add("@/INTER/TYPE11/4 line_IDs=2 line_IDm=7 Istf=5 Stfac=-4"));
  const double wanted[] = {400,            // shell: E t; one node of a truss is none of it
                           400,            // beam: E sqrt(A)
                           60,             // truss
                           12 * bulk / 4,  // brick: V B / L^2
                           12 * bulk / 9,
                           77,    // spring
                           0,     // nothing
                           60,    // truss over shell
                           100};  // shell over brick
  for (std::size_t k = 0; k < std::size(wanted); ++k) {
    const auto stiffness = [&](int id) { return b.contact(id).main_edges.at(k).stiffness; };
    EXPECT_NEAR(stiffness(1), wanted[k], 1e-9) << k;
    EXPECT_NEAR(stiffness(2), 2 * wanted[k], 1e-9) << k;
    EXPECT_EQ(stiffness(3), k == 6 ? 0 : 5) << k;
    EXPECT_EQ(stiffness(4), k == 6 ? 0 : 4) << k;
  }
  EXPECT_DOUBLE_EQ(b.contact(1).main_edges[7].shell, 2) << "the gap knows both";
  EXPECT_NEAR(b.contact(1).main_edges[7].section, 0.3, 1e-15);
}

/// Nodal stiffness of the nodes of a group.
double nodal(const SmallDeck& small, int node) {
  SceneOptions options;
  options.nodal_stiffness = true;
  const Built b(small, options);
  const Contact& c = b.contact();
  const SecondaryNode* s = b.secondary(c, node);
  return s == nullptr ? NAN
                      : c.nodal_stiffness.at(static_cast<std::size_t>(s - c.secondary.data()));
}

TEST(NodalStiffness, SolidNodeOfThePublishedExample) {
  SmallDeck d = published();
  d.group("/GRNOD/NODE/9", {1, 21}).add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=5 Istf=4");
  EXPECT_NEAR(nodal(d, 1), 209.986842, 1e-6);
  // Tetrahedron: a quarter of its own volume 4.5.
  EXPECT_NEAR(nodal(d, 21), bulk * std::cbrt(2 * 4.5 / 4), 1e-9);
}

TEST(NodalStiffness, AddsShellsAndLinesAndTheMeanOfItsSolids) {
  // Two bricks of 30 and 60 of different materials at node 1, with every line at node 1, too.
  SmallDeck d;
  d.elastic_material(2, 800);
  d.node(1, 0, 0, 0).node(2, 2, 0, 0).node(3, 2, 3, 0).node(4, 0, 3, 0);
  d.node(5, 0, 0, 5).node(6, 2, 0, 5).node(7, 2, 3, 5).node(8, 0, 3, 5);
  d.node(12, -4, 0, 0).node(13, -4, 3, 0).node(15, -4, 0, 5).node(17, -4, 3, 5);
  d.node(21, 0, -10, 0).node(22, 0, 0, -5).node(23, 9, 9, 9).node(24, 0, -3, -3);
  d.node(31, 50, 0, 0).node(32, 60, 0, 0).node(33, 60, 9, 0).node(34, 50, 9, 0);
  d.solid_part(1).solid_part(2, 2).truss_part(3, 4).beam_part(4, 9).spring_part(5, 7);
  d.shell_part(6, 1).shell_part(7, 3).shell_part(8, 1);
  d.brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8}).brick(2, 2, {12, 1, 4, 13, 15, 5, 8, 17});
  d.bar("TRUSS", 3, 3, 21, 1).bar("BEAM", 4, 4, 1, 22, 23).bar("SPRING", 5, 5, 1, 24);
  d.shell3(6, 6, 1, 21, 24).shell3(7, 7, 24, 22, 1).shell(8, 8, 31, 32, 33, 34);
  d.group("/SURF/PART/1", {8}).group("/GRNOD/NODE/9", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=1 Istf=2");
  const double other = 800 / 1.2;
  const double lines = 200 * 4 / 10.0 + 200 * 9 / 5.0 + 7, shells = 0.5 * (200 + 600);
  const double volume = (30 + 60) / 8.0, mean = (30 * bulk + 60 * other) / 90;
  EXPECT_NEAR(nodal(d, 1), lines + shells + mean * std::cbrt(2 * volume), 1e-9);
}

TEST(NodalStiffness, TheNodeThatOrientsABeamIsNotHeldByIt) {
  SmallDeck d = published();
  d.node(300, 65, 5, 7).beam_part(8, 0.09).bar("BEAM", 8, 80, 32, 35, 300);
  d.shell3(4, 301, 31, 32, 300).group("/GRNOD/NODE/9", {300, 32, 35});
  d.add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=1 Istf=2");
  EXPECT_NEAR(nodal(d, 300), 200, 1e-12) << "its shell of thickness 1 alone";
}

TEST(NodalStiffness, AThickShellOfSixteenNodesGivesEachCornerAThirtySecond) {
  SmallDeck d = published();
  std::string cards = "/SHEL16/2\n        50";
  for (const int first : {400, 410})  // corners; middles of the sides of both faces
    for (int i = 0; i < 8; ++i) {
      const int side = i % 4, next = (side + 1) % 4;
      const auto x = [](int corner) { return corner == 1 || corner == 2 ? 2 : 0; };
      const auto y = [](int corner) { return corner >= 2 ? 2 : 0; };
      const int other = first == 400 ? side : next;
      d.node(first + i, 100 + 0.5 * (x(side) + x(other)), 0.5 * (y(side) + y(other)), i / 4 * 2);
      cards += fmt::sprintf(first == 410 && i % 4 == 0 ? "\n%10d" : "%10d", first + i);
    }
  d.add(cards).group("/GRNOD/NODE/9", {400, 410});
  d.add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=1 Istf=2");
  EXPECT_NEAR(nodal(d, 400), bulk * std::cbrt(2 * 8.0 / 32), 1e-9);
  EXPECT_NEAR(nodal(d, 410), bulk * std::cbrt(2 * 8.0 * 3 / 32), 1e-9);
}

TEST(NodalStiffness, NodesSwitchedOffHaveNone) {
  SmallDeck d = published();
  d.node(200, 65, 5, 0.5).shell(4, 200, 200, 31, 34, 33).group("/GRNOD/NODE/9", {200});
  d.add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=5 Istf=2 Inacti=1");
  EXPECT_EQ(nodal(d, 200), 0);
}

}  // namespace
}  // namespace deck::test
