// By hand: the place of a tied node on its segment, penalty of ties, stiffness of lines and solids.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/shared/tie_parts.hpp"
#include "contact/small_deck.hpp"
#include "contact/tied_sheet.hpp"
#include "deck/contact/ties.hpp"

namespace deck::test {
namespace {

// --- places on segments

Coordinates with_node(double x, double y, double z) {
  Coordinates c;
  c.x = {0, 10, 10, 0, x};
  c.y = {0, 0, 10, 10, y};
  c.z = {0, 0, 0, 0, z};
  return c;
}

TEST(PlaceOnASegment, IsThatOfTheSquareAlsoBeyondItsRim) {
  const detail::Corners square{0, 1, 2, 3};
  for (const double x : {1.0, 4.0, 5.0, 8.5, -2.0, 12.0})
    for (const double y : {2.0, 5.0, 9.0, -1.0, 11.0}) {
      const detail::Projection p = detail::project(with_node(x, y, 3), 4, square, 20, false);
      EXPECT_NEAR(p.s, x / 5 - 1, 1e-12) << x << ' ' << y;
      EXPECT_NEAR(p.t, y / 5 - 1, 1e-12) << x << ' ' << y;
      const double beside_x = std::max({0.0, -x, x - 10}), beside_y = std::max({0.0, -y, y - 10});
      const double away = std::hypot(beside_x, beside_y, 3.0);
      EXPECT_NEAR(p.depth, 20 - away, 1e-9) << x << ' ' << y;
      EXPECT_NEAR(detail::distance_from(with_node(x, y, 3), 4, square), away, 1e-9);
    }
}

TEST(PlaceOnASegment, OfATriangleRunsFromItsLastCornerAndKnowsTheSideAtIt) {
  const detail::Corners triangle{0, 1, 3, 3};  // (0, 0), (10, 0), (0, 10)
  const auto at = [&](double x, double y, bool weights) {
    const detail::Projection p = detail::project(with_node(x, y, 2), 4, triangle, 5, weights);
    return std::pair(p.s, p.t);
  };
  const auto near = [](std::pair<double, double> got, double s, double t) {
    EXPECT_NEAR(got.first, s, 1e-12);
    EXPECT_NEAR(got.second, t, 1e-12);
  };
  // Shares 0.5 of the first and 0.2 of the second corner.
  near(at(2, 3, false), -0.3 / 0.7, 1 - 2 * 0.7);
  near(at(2, 3, true), 0.5, 0.2);
  near(at(6, 1, false), 0.3 / 0.9, 1 - 2 * 0.9);
  near(at(0, 10, false), 0, 1);    // the last corner
  near(at(1, 10, false), 2, 1);    // beside it
  near(at(-1, 10, false), -2, 1);  // on the other side
  near(at(0, 0, false), -1, -1);
  near(at(10, 0, false), 1, -1);
}

// --- texts and counts

TEST(PenaltyOfTies, IsOfWhatIsTiedWithSpotflag25And26) {
  for (const int spotflag : {5, 25, 26, 27}) {
    SmallDeck d = sheet({{5, 5, 1}, {5, 15, 1}, {5, 5, 900}});
    SceneOptions options;
    options.ties = true;
    const Built b(d.add(tie_card({.ignore = 1, .spotflag = spotflag})), options);
    ASSERT_EQ(b.scene.ties.size(), 1u);
    const auto& nodes = b.scene.ties[0].nodes;
    ASSERT_EQ(nodes.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(nodes[k].tied, k < 2) << spotflag;
      EXPECT_EQ(nodes[k].penalty, k < 2 && (spotflag == 25 || spotflag == 26)) << spotflag << k;
    }
  }
}

// --- stiffness

TEST(StiffnessOfEdges, IsNotThatOfALineWhichHasOneNodeOfThemOnly) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 8, 0).node(4, 0, 8, 0).node(5, -9, 0, 0);
  d.node(6, 19, 0, 0).node(7, 0, -7, 3);
  d.shell_part(1, 2).truss_part(2, 9).beam_part(3, 16).spring_part(4, 77);
  d.shell(1, 1, 1, 2, 3, 4).bar("TRUSS", 2, 2, 5, 1).bar("BEAM", 3, 3, 2, 6, 7);
  d.bar("SPRING", 4, 4, 1, 7);
  d.segments("/LINE/SEG/1", {{1, 2}, {1, 5}, {6, 2}, {7, 1}}).segments("/LINE/SEG/2", {{3, 4}});
  const Built b(d.add("@/INTER/TYPE11/1"));
  const auto& e = b.contact().main_edges;
  ASSERT_EQ(e.size(), 4u);
  const std::tuple<Carrier, double, double, double> wanted[] = {{Carrier::shell4, 400, 2, 0},
                                                                {Carrier::truss, 600, 0, 3},
                                                                {Carrier::beam, 800, 0, 4},
                                                                {Carrier::spring, 77, 0, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& [carrier, stiffness, shell, section] = wanted[k];
    EXPECT_EQ(e[k].carrier, carrier) << k;
    EXPECT_DOUBLE_EQ(e[k].stiffness, stiffness) << k;
    EXPECT_DOUBLE_EQ(e[k].shell, shell) << k;
    EXPECT_DOUBLE_EQ(e[k].section, section) << k;
  }
}

TEST(StiffnessOfNodes, AddsShellsAndLinesAndTheMeanOfItsSolids) {
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
  SceneOptions options;
  options.nodal_stiffness = true;
  const Built b(d.add("@/INTER/TYPE7/1 grnd_IDs=9 surf_IDm=1 Istf=2"), options);
  const double bulk = 200 / 1.2, other = 800 / 1.2;
  const double lines = 200 * 4 / 10.0 + 200 * 9 / 5.0 + 7, shells = 0.5 * (200 + 600);
  const double volume = (30 + 60) / 8.0, mean = (30 * bulk + 60 * other) / 90;
  EXPECT_NEAR(b.contact().secondary.at(0).nodal_stiffness,
              lines + shells + mean * std::cbrt(2 * volume), 1e-9);
}

}  // namespace
}  // namespace deck::test
