// /TRANSFORM: every type moves nodes as it should, in the right order, and boxes do not notice.
#include <cmath>

#include "model/selection_deck.hpp"

namespace deck::test {
namespace {

/// First line of a transform: group, three reals, last cells.
std::string head(std::int64_t group, const std::vector<double>& xyz, const Ids& rest) {
  std::string out = cells({group});
  out.pop_back();
  out += reals(xyz);
  out.pop_back();
  return out + cells(rest);
}
std::string all_nodes() { return "/GRNOD/GENE/1\nall\n" + cells({1, 1000}); }

void expect_at(BuiltModel& b, std::int64_t id, double x, double y, double z) {
  const NodeIndex n = b.model().nodes.map.find(id);
  ASSERT_NE(n, no_index);
  EXPECT_NEAR(b.model().nodes.x[n], x, 1e-12);
  EXPECT_NEAR(b.model().nodes.y[n], y, 1e-12);
  EXPECT_NEAR(b.model().nodes.z[n], z, 1e-12);
}

TEST(Transform, OrderOfTheDeckCounts) {
  const std::string move = "/TRANSFORM/TRA/1\nt\n" + head(1, {10, 0, 0}, {});
  const std::string scale = "/TRANSFORM/SCA/2\nt\n" + head(1, {2, 2, 2}, {});
  BuiltModel first(grid_nodes() + all_nodes() + move + scale);
  expect_at(first, 1, 20, 0, 0);
  BuiltModel second(grid_nodes() + all_nodes() + scale + move);
  expect_at(second, 1, 10, 0, 0);
}

TEST(Transform, BoxesSeeTheCoordinatesBeforeIt) {
  BuiltModel b(grid_nodes() + all_nodes() + "/BOX/RECTA/1\nb\n" + cells({0, 0, 0}) +
               reals({-1, -1, -1}) + reals({1, 1, 1}) + "/GRNOD/BOX/2\ng\n" + cells({1}) +
               "/TRANSFORM/TRA/1\nt\n" + head(1, {100, 0, 0}, {}));
  expect_at(b, 1, 100, 0, 0);
  EXPECT_EQ(b.group(2), (Ids{1}));
}

TEST(Transform, SubmodelMovesOnlyItsNodesAndBoxesFollow) {
  BuiltModel b(grid_nodes() + "//SUBMODEL/4\nsub\n" + cells({0, 100}) + "/NODE\n" +
               node(1, 0, 0, 0) + "/BOX/RECTA/1\nb\n" + cells({0, 0, 0}) + reals({-1, -1, -1}) +
               reals({1, 1, 1}) + "//ENDSUB\n" + "/GRNOD/BOX/2\ng\n" + cells({1}) +
               "/TRANSFORM/TRA/1\nt\n" + head(0, {10, 10, 0}, {0, 0, 4}));
  expect_at(b, 101, 10, 10, 0);
  expect_at(b, 1, 0, 0, 0);
  EXPECT_EQ(b.group(2), (Ids{5, 101}));
}

TEST(Transform, MissingGroupAndNodeAreReported) {
  BuiltModel group(grid_nodes() + "/TRANSFORM/TRA/1\nt\n" + head(9, {1, 2, 3}, {}));
  EXPECT_EQ(group.message(RuleId::DK110), 1865);
  BuiltModel missing(grid_nodes() + all_nodes() + "/TRANSFORM/TRA/1\nt\n" +
                     head(1, {1, 2, 3}, {1, 77}));
  EXPECT_EQ(missing.message(RuleId::DK110), 694);
}

/// Nodes 101 of submodel 4 and a transform that names the submodel.
std::string submodel_and(const std::string& transform) {
  return grid_nodes() + "//SUBMODEL/4\nsub\n" + cells({0, 100}) + "/NODE\n" + node(1, 1, 0, 0) +
         "//ENDSUB\n" + transform;
}

TEST(Transform, ScaleAndMirrorImageOfASubmodelExistFrom2026On) {
  const std::string scale = "/TRANSFORM/SCA/1\nt\n" + head(0, {2, 2, 2}, {0, 0, 4});
  const std::string mirror =
      "/TRANSFORM/SYM/1\nt\n" + head(0, {20, 0, 0}, {0, 0, 4}) + "          " + reals({25, 0, 0});
  const std::string move = "/TRANSFORM/TRA/1\nt\n" + head(0, {1, 0, 0}, {0, 0, 4});
  for (const std::string& transform : {scale, mirror}) {
    BuiltModel now(submodel_and(transform), "kg mm ms", 2026);
    EXPECT_EQ(now.findings(RuleId::DK110), 0u);
    EXPECT_NE(now.model().nodes.x[now.model().nodes.map.find(101)], 1);
    BuiltModel before(submodel_and(transform), "kg mm ms", 2025);
    expect_at(before, 101, 1, 0, 0);
    EXPECT_EQ(before.message(RuleId::DK110), 1865);
  }
  BuiltModel moved(submodel_and(move), "kg mm ms", 100);
  expect_at(moved, 101, 2, 0, 0);
  BuiltModel ignored(submodel_and(move), "kg mm ms", 90);
  expect_at(ignored, 101, 1, 0, 0);
}

TEST(Transform, WhereTheVersionHasNoSubmodelTheGroupMoves) {
  BuiltModel b(submodel_and(all_nodes() + "/TRANSFORM/SCA/1\nt\n" + head(1, {2, 2, 2}, {0, 0, 4})),
               "kg mm ms", 2025);
  expect_at(b, 9, 40, 40, 0);
  EXPECT_EQ(b.findings(RuleId::DK062), 0u);
}

TEST(Transform, OfAGroupAndASubmodelIsMessage914) {
  BuiltModel b(submodel_and(all_nodes() + "/TRANSFORM/TRA/1\nt\n" + head(1, {1, 0, 0}, {0, 0, 4})));
  EXPECT_EQ(b.message(RuleId::DK062), 914);
}

TEST(Transform, TypeThatIsNotEvaluatedSaysSo) {
  BuiltModel b(grid_nodes() + all_nodes() + "/TRANSFORM/POSITION/1\nt\n" +
               cells({1, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(b.findings(RuleId::DK110), 1u);
  expect_at(b, 1, 0, 0, 0);
}

}  // namespace
}  // namespace deck::test
