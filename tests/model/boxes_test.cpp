// Boxes: inside tests with their boundaries, and what they select.
#include "model/selection_deck.hpp"

namespace deck::test {
namespace {

std::string rectangle(std::int64_t id, std::vector<double> from, std::vector<double> to,
                      std::int64_t skew = 0) {
  return "/BOX/RECTA/" + std::to_string(id) + "\nb\n" + cells({0, 0, skew}) + reals(from) +
         reals(to);
}
std::string in_box(std::int64_t id, std::int64_t box) {
  return "/GRNOD/BOX/" + std::to_string(id) + "\ng\n" + cells({box});
}
std::string shells() {
  return parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) + cells({2, 2, 3, 6, 5}) +
         "/SHELL/2\n" + cells({3, 4, 5, 8, 7}) + cells({4, 5, 6, 9, 8});
}

TEST(BoxRectangle, HoldsItsBoundaryWhateverTheOrderOfTheCorners) {
  BuiltModel b(grid_nodes() + rectangle(1, {20, 10, 1}, {10, 0, -1}) + in_box(1, 1));
  EXPECT_EQ(b.group(1), (Ids{2, 3, 5, 6}));
}

TEST(BoxRectangle, FlatBoxHoldsExactlyItsPlane) {
  BuiltModel b(grid_nodes() + rectangle(1, {0, 0, 0}, {20, 20, 0}) + in_box(1, 1) +
               rectangle(2, {0, 0, 1e-12}, {20, 20, 1e-12}) + in_box(2, 2));
  EXPECT_EQ(b.group(1).size(), 9u);
  EXPECT_TRUE(b.group(2).empty());
}

TEST(BoxRectangle, FollowsItsSkew) {
  // Axes turned by 45 degrees: the box is the diamond |x - 10| + |y - 10| <= 11.
  const std::string skew =
      "/SKEW/FIX/3\ns\n" + reals({0, 0, 0}) + reals({-1, 1, 0}) + reals({0, 0, 1});
  BuiltModel b(grid_nodes() + skew + rectangle(1, {10, -1, -1}, {10, 21, 1}, 3) + in_box(1, 1));
  EXPECT_EQ(b.group(1), (Ids{2, 4, 5, 6, 8}));
}

TEST(BoxRectangle, NodesReplaceTheCorners) {
  BuiltModel b(grid_nodes() + "/BOX/RECTA/1\nb\n" + cells({2, 6, 0}) + reals({500, 500, 500}) +
               reals({600, 600, 600}) + in_box(1, 1));
  EXPECT_EQ(b.group(1), (Ids{2, 3, 5, 6}));
}

TEST(BoxCylinder, HoldsRadiusAndEnds) {
  BuiltModel b(grid_nodes() + "/BOX/CYLIN/1\nb\n" + "                              " + reals({20}) +
               reals({0, 10, 0}) + reals({10, 10, 0}) + in_box(1, 1));
  EXPECT_EQ(b.group(1), (Ids{1, 2, 4, 5, 7, 8}));
}

TEST(BoxCylinder, HoldsThePointsOfItsOwnAxisWhicheverWayThatLeans) {
  const std::string axes[] = {reals({0, 10, 10}), reals({10, 0, 10}), reals({10, 10, 0})};
  const std::vector<double> middles[] = {{0, 5, 5}, {5, 0, 5}, {5, 5, 0}};
  for (int i = 0; i < 3; ++i) {
    std::string nodes = "/NODE\n";
    for (int k = 0; k < 3; ++k) nodes += node(k + 1, middles[k][0], middles[k][1], middles[k][2]);
    BuiltModel b(nodes + "/BOX/CYLIN/1\nb\n" + "                              " + reals({2}) +
                 reals({0, 0, 0}) + axes[i] + in_box(1, 1));
    EXPECT_EQ(b.group(1), (Ids{i + 1}));
  }
}

TEST(BoxSphere, HoldsItsSurface) {
  BuiltModel b(grid_nodes() + "/BOX/SPHER/1\nb\n" + "                              " + reals({20}) +
               reals({10, 10, 0}) + in_box(1, 1));
  EXPECT_EQ(b.group(1), (Ids{2, 4, 5, 6, 8}));
}

TEST(BoxOfBoxes, IsTheUnionOfItsMembers) {
  BuiltModel b(grid_nodes() + rectangle(1, {-1, -1, -1}, {1, 1, 1}) +
               rectangle(2, {19, 19, -1}, {21, 21, 1}) + "/BOX/BOX/3\nb\n" + cells({1, 2}) +
               in_box(1, 3));
  EXPECT_EQ(b.group(1), (Ids{1, 9}));
}

TEST(BoxOfBoxes, CircleIsMessage797AndEnds) {
  BuiltModel b(grid_nodes() + "/BOX/BOX/1\nb\n" + cells({2}) + "/BOX/BOX/2\nb\n" + cells({1}) +
               in_box(1, 1));
  b.group(1);
  EXPECT_EQ(b.message(RuleId::DK152), 797);
}

TEST(Box, ElementsNeedAllNodesOrOneOfThem) {
  const std::string box = rectangle(1, {-1, -1, -1}, {11, 11, 1});
  BuiltModel b(shells() + box + "/SURF/BOX/1\ns\n" + cells({1}) + "/SURF/BOX2/2\ns\n" + cells({1}));
  EXPECT_EQ(b.surface(1).size(), 1u);
  EXPECT_EQ(b.surface(2).size(), 4u);
}

TEST(Box, MissingBoxHasTheNumberOfItsUser) {
  BuiltModel nodes(grid_nodes() + in_box(1, 9));
  nodes.group(1);
  EXPECT_EQ(nodes.message(RuleId::DK159), 690);
  BuiltModel surface(shells() + "/SURF/BOX/1\ns\n" + cells({9}));
  surface.surface(1);
  EXPECT_EQ(surface.message(RuleId::DK159), 800);
}

TEST(Box, MissingSkewIsMessage748) {
  BuiltModel b(grid_nodes() + rectangle(1, {0, 0, 0}, {1, 1, 1}, 9) + in_box(1, 1));
  b.group(1);
  EXPECT_EQ(b.message(RuleId::DK159), 748);
}

TEST(Box, MissingLimitsAreMessage752) {
  BuiltModel b(grid_nodes() + "/BOX/RECTA/1\nb\n" + cells({0}) + "\n\n" + in_box(1, 1));
  b.group(1);
  EXPECT_EQ(b.message(RuleId::DK159), 752);
}

}  // namespace
}  // namespace deck::test
