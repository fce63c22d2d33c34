// Gaps of contacts: defaults, variable gaps, limits, lengths. Figures are the published worked
// examples and hand calculations.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "contact/published.hpp"

namespace deck::test {
namespace {

/// A 10 x 10 quad (nodes 1-4, part 1) and what may stand over it: beam 141-142 with orientation
/// node 143, truss 143-144, free node 145.
SmallDeck beam_and_truss(double thickness = 2) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(141, 2, 3, 2.2).node(142, 2, 3, 7.2).node(143, 4, 3, 1.6).node(144, 4, 3, 6);
  d.node(145, 6, 3, 0.9);
  d.shell_part(1, thickness).beam_part(2, 4).truss_part(3, 2.25);
  d.shell(1, 1, 1, 2, 3, 4).bar("BEAM", 2, 7, 141, 142, 143).bar("TRUSS", 3, 8, 143, 144);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {141, 143, 145});
  return d;
}

double pair_gap(const Built& b, const Contact& c, std::int64_t node) {
  const SecondaryNode* s = b.secondary(c, node);
  return s == nullptr ? NAN : c.pair_gap(static_cast<std::uint32_t>(s - c.secondary.data()), 0);
}

TEST(VariableGap, SumsHalfThicknessAndHalfSectionWithinTheBoundsOfTheCard) {
  struct Case {
    const char* fields;
    double gapmin, beam, truss, free;  ///< the pair gaps of nodes 141, 143 and 145
  };
  // The third node of a beam only orients it: node 143 has the truss alone.
  const Case cases[] = {{"Gapmin=0.3", 0.3, 0.3, 0.3, 0.3},
                        {"Gapmin=-3", 2, 2, 2, 2},  // counts as none
                        {"Igap=-1 Gapmin=0.6", 0.6, 0.6, 0.6, 0.6},
                        {"Igap=1 Gapmin=0.1", 0.1, 2, 1.75, 1},
                        {"Igap=1", 2, 2, 2, 2},  // the smallest thickness
                        {"Igap=1 Fscalegap=0.5 Gapmax=1 Gapmin=0.1", 0.1, 2, 1.75, 1},
                        {"Igap=2 Fscalegap=0.5", 1, 1, 1, 1},
                        {"Igap=2 Fscalegap=0.5 Gapmin=0.25", 0.25, 1, 0.875, 0.5},
                        {"Igap=2 Gapmax=1.5 Gapmin=0.1", 0.1, 1.5, 1.5, 1},
                        {"Igap=2 Gapmax=1.5 Gapmin=1.7", 1.7, 1.7, 1.7, 1.7},  // Gapmin wins
                        {"Igap=2 Gapmin=0.2 Gapmax=-1", 0.2, 0.2, 0.2, 0.2},   // only 0 is no bound
                        {"Igap=3 %mesh_size=0.4 Gapmin=0.01", 0.01, 2, 1.75, 1}};
  for (const Case& c : cases) {
    const Built b(beam_and_truss().add(std::string("@/INTER/TYPE7/1 ") + c.fields));
    const Contact& contact = b.contact();
    EXPECT_DOUBLE_EQ(contact.gapmin, c.gapmin) << c.fields;
    EXPECT_DOUBLE_EQ(pair_gap(b, contact, 141), c.beam) << c.fields;
    EXPECT_DOUBLE_EQ(pair_gap(b, contact, 143), c.truss) << c.fields;
    EXPECT_DOUBLE_EQ(pair_gap(b, contact, 145), c.free) << c.fields;
  }
}

TEST(VariableGap, PartThicknessReplacesSectionsAndGivesSpringsAGap) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 2, 2, 9).node(6, 2, 2, 12).node(7, 4, 2, 9).node(8, 4, 2, 12).node(9, 6, 2, 9);
  d.shell_part(1, 2, 0.7).beam_part(2, 4, 0.5).spring_part(3, 10, 0.3).spring_part(4, 10);
  d.shell(1, 1, 1, 2, 3, 4).bar("BEAM", 2, 2, 5, 6, 1).bar("SPRING", 3, 3, 7, 8);
  d.bar("SPRING", 4, 4, 9, 8);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {1, 5, 7, 8, 9});
  const Built b(d.add("@/INTER/TYPE7/1 Igap=1 Gapmin=0.01"));
  for (const auto& [node, gap] : {std::pair(1, 0.35), {5, 0.25}, {7, 0.15}, {8, 0.15}, {9, 0.0}})
    EXPECT_DOUBLE_EQ(b.secondary(b.contact(), node)->gap, gap) << node;
}

/// The published solids; a side of the first brick is a segment too.
SmallDeck solids_and_skin() {
  return published_solids().segments("/SURF/SEG/1", {{5, 6, 7, 8}, {1, 2, 6, 5}});
}

TEST(DefaultGap, IsMadeOfThicknessesOrOfTheEdgesOfSolids) {
  using O = GapminOrigin;
  struct Case {
    const char* card;
    double gapmin;
    O origin;
  };
  const Case cases[] = {{"TYPE7/1 surf_IDm=1", 0.2, O::solid_edge},  // a tenth of the shortest
                        {"TYPE7/1 surf_IDm=3", 0.2, O::solid_edge},
                        {"TYPE7/1 surf_IDm=7 Igap=1", 0.3, O::solid_edge},
                        {"TYPE7/1 surf_IDm=2", 0.15, O::mean_thickness},  // the shell on the solid
                        {"TYPE7/1 surf_IDm=6", 0.15, O::mean_thickness},
                        {"TYPE7/1 surf_IDm=5", 2, O::mean_thickness},
                        {"TYPE7/1 surf_IDm=5 Igap=1", 1, O::minimum_thickness},
                        {"TYPE10/1 surf_IDm=5", 2, O::mean_thickness}};
  for (const Case& c : cases) {
    const Built b(solids_and_skin().add(std::string("@/INTER/") + c.card));
    EXPECT_NEAR(b.contact().gapmin, c.gapmin, 1e-15) << c.card;
    EXPECT_EQ(b.contact().gapmin_origin, c.origin) << c.card;
  }
}

TEST(DefaultGap, HalfTheShortestMainSideLimitsIt) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 1, 0, 0).node(3, 1, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 5);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {9});
  const Built b(d.add("@/INTER/TYPE7/1"));
  EXPECT_DOUBLE_EQ(b.contact().gapmin, 0.5);
  EXPECT_EQ(b.contact().gapmin_origin, GapminOrigin::half_edge);
}

TEST(GapThickness, PartGoesBeforeElementBeforeProperty) {
  SmallDeck d;
  for (int i = 0; i < 3; ++i) {
    const double x = 20 * i;
    d.node(10 * i + 1, x, 0, 0).node(10 * i + 2, x + 10, 0, 0);
    d.node(10 * i + 3, x + 10, 10, 0).node(10 * i + 4, x, 10, 0);
  }
  d.node(99, 0, 0, 50).shell_part(1, 0.5, 0.7).shell_part(2, 0.5).shell_part(3, 0.5);
  d.shell(1, 1, 1, 2, 3, 4, 0.3).shell(2, 2, 11, 12, 13, 14, 0.3).shell(3, 3, 21, 22, 23, 24);
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2}).group("/SURF/PART/3", {3});
  d.group("/GRNOD/NODE/2", {99});
  for (int i = 1; i <= 3; ++i)
    d.add("@/INTER/TYPE7/" + std::to_string(i) + " Igap=1 surf_IDm=" + std::to_string(i));
  const Built b(d);
  EXPECT_DOUBLE_EQ(b.contact(1).main.at(0).gap, 0.35);
  EXPECT_DOUBLE_EQ(b.contact(2).main.at(0).gap, 0.15);
  EXPECT_DOUBLE_EQ(b.contact(3).main.at(0).gap, 0.25);
  // Stiffness never sees the part thickness.
  EXPECT_DOUBLE_EQ(b.contact(1).main.at(0).stiffness, 60);
  const Built v5(d.add("/INTTHICK/V5"));
  EXPECT_DOUBLE_EQ(v5.contact(1).main.at(0).gap, 0.25);
  EXPECT_DOUBLE_EQ(v5.contact(1).main.at(0).stiffness, 100);
}

TEST(MeshSizeGap, FollowsMainSidesAtTheNode) {
  // The end of a strip: sides 0.781 .. 1.118 long; self contact.
  SmallDeck d = bent_strip();
  const Built b(d.add("@/INTER/TYPE7/1 Igap=3 %mesh_size=0.4 Gapmin=0.1"));
  const Contact& c = b.contact();
  std::set<long> gaps;
  for (std::uint32_t s = 0; s < c.secondary.size(); ++s)
    for (std::uint32_t m = 0; m < c.main.size(); ++m)
      gaps.insert(std::lround(1e6 * c.pair_gap(s, m)));
  for (const long expected : {651821, 712410, 739411, 800000})
    EXPECT_TRUE(gaps.contains(expected)) << expected;
  EXPECT_NEAR(c.main_length[3], 0.4 * std::hypot(0.6, 0.5), 1e-15);
}

TEST(MeshSizeGap, OnlyBitesInSelfContactAndSeesLineElements) {
  SmallDeck d = beam_and_truss();
  d.node(146, 0, 0, 0.25).bar("TRUSS", 3, 9, 1, 146);
  const Built b(d.add("@/INTER/TYPE7/1 Igap=3 %mesh_size=0.4 Gapmin=0.01"));
  const Contact& c = b.contact();
  EXPECT_DOUBLE_EQ(c.main_length.at(0), 0.4 * 0.25);
  EXPECT_EQ(c.secondary_length.at(0), 1e30) << "node 141";
  EXPECT_DOUBLE_EQ(pair_gap(b, c, 141), 2);
}

TEST(EdgeGap, DefaultIsTheMeanAndShortestSideTheLeastOfBothSides) {
  struct Case {
    const char* lines;
    double gapmin, shortest;
  };
  const Case cases[] = {{"line_IDs=2 line_IDm=1", 1.6, 8},
                        {"line_IDs=3 line_IDm=1", 2.0, 8},
                        {"line_IDs=4 line_IDm=5", 0.25, 2},
                        {"line_IDs=5 line_IDm=4", 0.25, 2}};
  for (const Case& c : cases) {
    const Built b(published_edges().add(std::string("@/INTER/TYPE11/1 ") + c.lines));
    EXPECT_DOUBLE_EQ(b.contact().gapmin, c.gapmin) << c.lines;
    EXPECT_DOUBLE_EQ(b.contact().shortest_side, c.shortest) << c.lines;
    EXPECT_EQ(b.contact().gapmin_origin, GapminOrigin::both_sides);
  }
}

TEST(EdgeGap, VariableGapIsTheSumAndAtLeastGapmin) {
  const Built b(published_edges()
                    .add("@/INTER/TYPE11/1 line_IDs=3 line_IDm=1 Igap=1 Gapmin=0.5")
                    .add("@/INTER/TYPE11/2 line_IDs=3 line_IDm=1 Igap=1 Gapmin=3")
                    .add("@/INTER/TYPE11/3 line_IDs=4 line_IDm=5 Igap=3 Gapmin=0.01"));
  const auto pair = [](const Contact& c) { return c.pair_gap(0, 0); };
  EXPECT_DOUBLE_EQ(b.contact(1).main_edges.at(0).gap, 1);
  EXPECT_DOUBLE_EQ(b.contact(1).secondary_edges.at(0).gap, 1);
  EXPECT_DOUBLE_EQ(pair(b.contact(1)), 2);
  EXPECT_DOUBLE_EQ(pair(b.contact(2)), 3);
  EXPECT_DOUBLE_EQ(b.contact(3).secondary_length.at(0),
                   static_cast<double>(0.4F) * std::sqrt(0.04 + 16 + 0.0025));
  EXPECT_DOUBLE_EQ(pair(b.contact(3)), 0.15);
}

TEST(LargestGap, IsTheSumOfTheThickestOfBothSides) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 8, 0).node(4, 0, 8, 0);
  for (int i = 0; i < 4; ++i) d.node(11 + i, 6.0 * (i == 1 || i == 2), 6.0 * (i > 1), 9);
  d.shell_part(1, 2).shell_part(2, 1).shell(1, 1, 1, 2, 3, 4).shell(2, 2, 11, 12, 13, 14);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2}).group("/SURF/PART/3", {1, 2});
  const Built b(d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Igap=1 Gapmin=0.1")
                    .add("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Igap=3 Gapmin=0.1 %mesh_size=0.1")
                    .add("@/INTER/TYPE7/3 grnd_IDs=2 surf_IDm=3 Igap=3 Gapmin=0.1 %mesh_size=0.1"));
  EXPECT_DOUBLE_EQ(b.contact(1).max_gap, 1.0 + 0.5);
  EXPECT_DOUBLE_EQ(b.contact(2).max_gap, 1.0 + 0.5);  // free nodes know no limit
  EXPECT_DOUBLE_EQ(b.contact(3).max_gap, 0.8 + 0.6);
}

TEST(RadiationDistance, DefaultsToTheLargerOfGapAndShortestSide) {
  const std::string thermal = " Ithe=1 Gapmin=0.5";
  const Built b(beam_and_truss()
                    .add("/HEAT/MAT/1\n               293.0               100.0")
                    .add("@/INTER/TYPE7/1" + thermal)
                    .add("@/INTER/TYPE7/2 Drad=0.2" + thermal)
                    .add("@/INTER/TYPE7/3 Drad=3" + thermal)
                    .add("@/INTER/TYPE7/4 Gapmin=0.5"));
  EXPECT_DOUBLE_EQ(b.contact(1).drad, 10);
  EXPECT_DOUBLE_EQ(b.contact(2).drad, 0.5);
  EXPECT_DOUBLE_EQ(b.contact(3).drad, 3);
  EXPECT_EQ(b.contact(4).drad, 0);
}

}  // namespace
}  // namespace deck::test
