// The old search of ties (Isearch 1): segment, place and distance by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/shared/scene_parts.hpp"
#include "contact/small_deck.hpp"
#include "contact/tied_sheet.hpp"

namespace deck::test {
namespace {

// --- the old search of ties

TEST(OldSearch, TakesASegmentAtTheNearestNodeAndThePlaceOnIt) {
  struct Case {
    double x, y, z;
    std::uint32_t segment;
    double s, t, distance;
  };
  const Case cases[] = {
      {5, 5, 200, 0, 0, 0, 200},  // four nodes are as near: the highest id, its first
      {7, 6, 3, 0, 0.4, 0.2, 3},  // around node (10, 10) it is in the first segment
      {12, 6, 3, 1, -0.6, 0.2, 3},
      {8, 13, 3, 3, 0.6, -0.4, 3},
      {12, 13, -2, 4, -0.6, -0.4, 2},
      {23, 28, 2, 8, -0.4, 0.6, 2},
      {31, 15, 1, 5, 1.2, 0, 1},                     // beyond the rim: as far as it is
      {30.05, 15, 1, 5, 1, 0, std::hypot(0.05, 1)},  // by little: on the rim
      {15, -0.05, 1, 1, 0, -1, std::hypot(0.05, 1)}};
  std::vector<std::array<double, 3>> nodes;
  for (const Case& c : cases) nodes.push_back({c.x, c.y, c.z});
  SceneOptions options;
  options.ties = true;
  const Built b(sheet(nodes).add(tie_card({.isearch = 1})), options);
  const Tie& tie = b.scene.ties.at(0);
  ASSERT_EQ(tie.nodes.size(), std::size(cases));
  for (std::size_t k = 0; k < tie.nodes.size(); ++k) {
    const TiedNode& n = tie.nodes[k];
    EXPECT_TRUE(n.tied);
    EXPECT_EQ(n.segment, cases[k].segment) << k;
    EXPECT_NEAR(n.s, cases[k].s, 1e-12) << k;
    EXPECT_NEAR(n.t, cases[k].t, 1e-12) << k;
    EXPECT_NEAR(n.distance, cases[k].distance, 1e-9) << k;
  }
}

TEST(OldSearch, PlacesOnATriangleAreOverTheirFoot) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 0, 10, 0);
  const double places[][3] = {{2, 3, 4}, {6, 1, 2}, {1, 7, 3}, {3, 3, -5}};
  std::vector<int> group;
  const auto add = [&](double x, double y, double z) {
    group.push_back(101 + static_cast<int>(group.size()));
    d.node(group.back(), x, y, z);
  };
  for (const auto& p : places) add(p[0], p[1], p[2]);
  add(5.05, 5.05, 1);  // beside the long side
  add(-0.05, 4, 1);    // beside the left one
  d.shell_part(1, 2).shell3(1, 1, 1, 2, 3).group("/SURF/PART/1", {1}).group("/GRNOD/NODE/9", group);
  SceneOptions options;
  options.ties = true;
  const Built b(d.add(tie_card({.isearch = 1})), options);
  const Tie& tie = b.scene.ties.at(0);
  ASSERT_EQ(tie.nodes.size(), 6u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(tie.nodes[k].distance, std::abs(places[k][2]), 1e-9) << k;
    EXPECT_LT(std::abs(tie.nodes[k].s), 1) << k;
  }
  // On the side: s is its end, t from the height over the base.
  EXPECT_NEAR(tie.nodes[4].s, 1, 1e-12);
  EXPECT_NEAR(tie.nodes[4].t, 0.01, 1e-12);
  EXPECT_NEAR(tie.nodes[4].distance, std::hypot(0.1, 1), 1e-9);
  EXPECT_NEAR(tie.nodes[5].s, -1, 1e-12);
  EXPECT_NEAR(tie.nodes[5].t, -0.2, 1e-12);
  EXPECT_NEAR(tie.nodes[5].distance, std::hypot(0.05, 1), 1e-9);
}

}  // namespace
}  // namespace deck::test
