// Stiffness of main segments, edges and secondary nodes as stored at start-up.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/published.hpp"

namespace deck::test {
namespace {

constexpr double bulk = 500.0 / 3;  // E = 200, nu = 0.3

SmallDeck published() { return published_solids().segments("/SURF/SEG/1", {{5, 6, 7, 8}}); }

TEST(MainStiffness, SolidsOfThePublishedExample) {
  const Built b(published().add("@/INTER/TYPE7/3 surf_IDm=3"));
  const Contact& c = b.contact(3);
  EXPECT_NEAR(b.main(c, {5, 6, 7, 8})->stiffness, 16 * bulk / 8, 1e-11);
  EXPECT_NEAR(b.main(c, {11, 12, 13, 14})->stiffness, 310.0775, 1e-4);
  EXPECT_NEAR(b.main(c, {15, 16, 17, 18})->stiffness, 324.0310, 1e-4);
  EXPECT_NEAR(b.main(c, {12, 13, 17, 16})->stiffness, 410.0775, 1e-4);
}

TEST(MainStiffness, TetrahedronUsesOneAndAHalfTimesItsVolume) {
  const Built b(published().add("@/INTER/TYPE7/7 surf_IDm=7"));
  const Contact& c = b.contact(7);
  EXPECT_NEAR(b.main(c, {21, 22, 23})->stiffness, 500, 1e-9);
  EXPECT_NEAR(b.main(c, {22, 23, 24})->stiffness, 1500, 1e-9);
}

TEST(MainStiffness, ShellOnASolidFaceWhereTheSegmentIsPlainOrTheShell) {
  const Built b(published()
                    .add("@/INTER/TYPE7/2 surf_IDm=2")
                    .add("@/INTER/TYPE7/3 surf_IDm=3")
                    .add("@/INTER/TYPE7/6 surf_IDm=6"));
  EXPECT_DOUBLE_EQ(b.main(b.contact(2), {15, 16, 17, 18})->stiffness, 30);
  EXPECT_NEAR(b.main(b.contact(3), {15, 16, 17, 18})->stiffness, 324.0310, 1e-4);
  EXPECT_DOUBLE_EQ(b.main(b.contact(6), {15, 16, 17, 18})->stiffness, 30);
}

TEST(MainStiffness, FactorsAndConstants) {
  const Built b(published()
                    .add("@/INTER/TYPE7/1 surf_IDm=5")
                    .add("@/INTER/TYPE7/2 surf_IDm=5 Stfac=0.25")
                    .add("@/INTER/TYPE7/3 surf_IDm=5 Istf=1 Stfac=50")
                    .add("@/INTER/TYPE7/4 surf_IDm=5 Istf=5 Stfac=-3")
                    .add("@/INTER/TYPE10/5 surf_IDm=5 Stfac=0"));
  const auto both = [&](int id) {
    const Contact& c = b.contact(id);
    return std::pair(c.main.at(0).stiffness, c.main.at(1).stiffness);
  };
  EXPECT_EQ(both(1), std::pair(200.0, 600.0));
  EXPECT_EQ(both(2), std::pair(50.0, 150.0));
  EXPECT_EQ(both(3), std::pair(50.0, 50.0));
  EXPECT_EQ(both(4), std::pair(3.0, 3.0));
  EXPECT_EQ(both(5), std::pair(40.0, 120.0));
}

TEST(MainStiffness, ConstantOnSolidsStoresANegativeProduct) {
  const Built b(published().add("@/INTER/TYPE7/1 surf_IDm=1 Istf=1 Stfac=2"));
  EXPECT_NEAR(b.contact(1).main.at(0).stiffness, -2 * 16 * bulk / 8, 1e-11);
}

/// A quad of a void part, and a node 0.2 above it.
SmallDeck void_quad(double young) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(99, 3, 3, 0.2);
  d.void_material(2, young).void_part(1, 2, 2).shell(1, 1, 1, 2, 3, 4);
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {99}).add("@/INTER/TYPE7/1");
}

TEST(VoidElement, WithStiffnessIsAnOrdinaryShell) {
  const Built b(void_quad(200));
  EXPECT_DOUBLE_EQ(b.contact().main.at(0).stiffness, 400);
  EXPECT_DOUBLE_EQ(b.contact().gapmin, 2);
  EXPECT_EQ(b.contact().penetrations.size(), 1u);
}

TEST(VoidElement, WithoutStiffnessTakesNoPart) {
  const Built b(void_quad(0));
  EXPECT_EQ(b.contact().main.at(0).stiffness, 0);
  EXPECT_EQ(b.contact().candidates, 0u);
  EXPECT_TRUE(b.contact().penetrations.empty());
  EXPECT_DOUBLE_EQ(b.contact().gapmin, 2) << "its thickness still makes the gap";
}

/// Shells (t = 2, 1.2), beam, truss and brick as lines.
SmallDeck lines() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 8, 0).node(4, 0, 8, 0);
  d.node(21, 2, -2, 9.7).node(22, 2.5, 9, 9.9).node(23, 3, 15, 9.5);
  const double x[8] = {0, 2, 2, 0, 0, 2, 2, 0}, y[8] = {0, 0, 2, 2, 0, 0, 2, 2};
  for (int i = 0; i < 8; ++i) d.node(31 + i, 40 + x[i], y[i], i < 4 ? 0 : 3);
  d.node(41, 41, -1, 9).node(42, 41.2, 3, 9).node(51, 60, 0, 0).node(52, 61, 0, 0);
  d.shell_part(1, 2).beam_part(3, 4).truss_part(4, 0.09).solid_part(5).spring_part(6, 77);
  d.shell(1, 1, 1, 2, 3, 4).bar("BEAM", 3, 3, 21, 22, 23).bar("TRUSS", 4, 4, 41, 42);
  d.brick(5, 5, {31, 32, 33, 34, 35, 36, 37, 38}).bar("SPRING", 6, 6, 51, 52);
  d.segments("/LINE/SEG/1", {{1, 2}, {21, 22}, {41, 42}, {31, 32}, {31, 35}, {51, 52}, {1, 31}});
  return d.segments("/LINE/SEG/2", {{3, 4}});
}

TEST(EdgeStiffness, ByCarrier) {
  const Built b(lines().add("@/INTER/TYPE11/1"));
  const auto& e = b.contact().main_edges;
  ASSERT_EQ(e.size(), 7u);
  EXPECT_DOUBLE_EQ(e[0].stiffness, 400);             // shell: E t
  EXPECT_DOUBLE_EQ(e[1].stiffness, 400);             // beam: E sqrt(A)
  EXPECT_NEAR(e[2].stiffness, 60, 1e-12);            // truss
  EXPECT_NEAR(e[3].stiffness, 12 * bulk / 4, 1e-9);  // brick: V B / L^2
  EXPECT_NEAR(e[4].stiffness, 12 * bulk / 9, 1e-9);
  EXPECT_DOUBLE_EQ(e[5].stiffness, 77);
  EXPECT_EQ(e[6].stiffness, 0);
  EXPECT_EQ(e[6].carrier, Carrier::none);
}

TEST(EdgeStiffness, Istf1StoresStfacWhereverSomethingCarriesTheEdge) {
  const Built b(lines()
                    .add("@/INTER/TYPE11/1 Istf=1 Stfac=5")
                    .add("@/INTER/TYPE11/2 Istf=5 Stfac=-4")
                    .add("@/INTER/TYPE11/3 Stfac=2"));
  EXPECT_EQ(b.contact(1).main_edges[0].stiffness, 5);
  EXPECT_EQ(b.contact(1).main_edges[6].stiffness, 0);
  EXPECT_EQ(b.contact(2).main_edges[0].stiffness, 4);
  EXPECT_EQ(b.contact(2).istf, 1);
  EXPECT_EQ(b.contact(3).main_edges[0].stiffness, 800);
  EXPECT_EQ(b.contact(3).istf, 5) << "nothing given ends as 5";
}

TEST(EdgeStiffness, LaterRulesOverrideEarlierOnes) {
  SmallDeck d = lines();
  d.bar("TRUSS", 4, 14, 1, 2).shell_part(7, 0.5).shell(7, 17, 31, 32, 36, 35);
  const Built b(d.add("@/INTER/TYPE11/1"));
  EXPECT_NEAR(b.contact().main_edges[0].stiffness, 60, 1e-12);  // truss over shell
  EXPECT_DOUBLE_EQ(b.contact().main_edges[3].stiffness, 100);   // shell over brick
  EXPECT_DOUBLE_EQ(b.contact().main_edges[0].shell, 2);         // the gap knows both
  EXPECT_NEAR(b.contact().main_edges[0].section, 0.3, 1e-15);
}

/// Nodal stiffness of the nodes of a group.
double nodal(const SmallDeck& small, int node) {
  SceneOptions options;
  options.nodal_stiffness = true;
  const Built b(small, options);
  const SecondaryNode* s = b.secondary(b.contact(), node);
  return s == nullptr ? NAN : s->nodal_stiffness;
}

TEST(NodalStiffness, SolidNodeOfThePublishedExample) {
  SmallDeck d = published();
  d.group("/GRNOD/NODE/9", {1, 21}).add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=5 Istf=4");
  EXPECT_NEAR(nodal(d, 1), 209.986842, 1e-6);
  // Tetrahedron: a quarter of its own volume 4.5.
  EXPECT_NEAR(nodal(d, 21), bulk * std::cbrt(2 * 4.5 / 4), 1e-9);
}

TEST(NodalStiffness, MeanOverShellsSumOverBars) {
  SmallDeck d = published();
  d.truss_part(8, 0.09).bar("TRUSS", 8, 80, 32, 35).spring_part(9, 7).bar("SPRING", 9, 90, 32, 31);
  d.group("/GRNOD/NODE/9", {32, 31});
  d.add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=1 Istf=2");
  EXPECT_NEAR(nodal(d, 32), 0.5 * (200 + 600) + 200 * 0.09 / 10 + 7, 1e-12);
  EXPECT_NEAR(nodal(d, 31), 200 + 7, 1e-12);
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
  const int middle[8][3] = {{1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0},
                            {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2}};
  std::string cards = "/SHEL16/2\n        50";
  const auto cell = [](int id) {
    std::string text = std::to_string(id);
    return std::string(10 - text.size(), ' ') + text;
  };
  for (int i = 0; i < 8; ++i) {
    const int x = (i % 4 == 1 || i % 4 == 2) ? 2 : 0, y = i % 4 >= 2 ? 2 : 0, z = i >= 4 ? 2 : 0;
    d.node(400 + i, 100 + x, y, z);
    d.node(410 + i, 100 + middle[i][0], middle[i][1], middle[i][2]);
    cards += cell(400 + i);
  }
  cards += "\n";
  for (int i = 0; i < 8; ++i) cards += cell(410 + i) + (i == 3 ? "\n" : "");
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
