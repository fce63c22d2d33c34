// Groups, surfaces and lines: what is selected, in which order, and what is said about mistakes.
// Over 600 lines: independent tests of one resolver.
#include <algorithm>

#include "model/selection_deck.hpp"
#include "model/shared/faces.hpp"

namespace deck::test {
namespace {

/// Quads 1..4 on the grid in parts 1 (1, 2) and 2 (3, 4).
std::string quads() {
  return grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) + cells({2, 2, 3, 6, 5}) +
         "/SHELL/2\n" + cells({3, 4, 5, 8, 7}) + cells({4, 5, 6, 9, 8});
}

TEST(NodeGroup, ListIsUniqueAndAscending) {
  BuiltModel b(parts() + quads() + "/GRNOD/NODE/5\ng\n" + cells({9, 2, 9, 4}));
  EXPECT_EQ(b.group(5), (Ids{2, 4, 9}));
}

TEST(NodeGroup, InternalOrderIsThatOfTheIdsNotOfTheFile) {
  BuiltModel b("/NODE\n" + node(20, 0, 0, 0) + node(3, 1, 0, 0) + node(7, 2, 0, 0) +
               "/GRNOD/NODE/1\ng\n" + cells({20, 7, 3}));
  EXPECT_EQ(b.group(1), (Ids{3, 7, 20}));
}

TEST(NodeGroup, NodensKeepsTheOrderOfTheList) {
  BuiltModel b(quads() + "/GRNOD/NODENS/5\ng\n" + cells({9, 2, 9, 4}));
  EXPECT_EQ(b.group(5), (Ids{9, 2, 4}));
}

TEST(NodeGroup, EmptyResultIsWarning690) {
  BuiltModel b(parts() + quads() + "/GRNOD/PART/5\ng\n" + cells({3}));
  EXPECT_TRUE(b.group(5).empty());
  EXPECT_EQ(b.message(RuleId::DK153), 690);
}

TEST(NodeGroup, RangesIncludeBothEnds) {
  BuiltModel b(quads() + "/GRNOD/GENE/5\ng\n" + cells({2, 4, 8, 100}));
  EXPECT_EQ(b.group(5), (Ids{2, 3, 4, 8, 9}));
}

TEST(NodeGroup, HugeRangesCostNoMoreThanTheNodes) {
  BuiltModel b(quads() + "/GRNOD/GENE/5\ng\n" + cells({1, 2000000000}));
  EXPECT_EQ(b.group(5).size(), 9u);
}

TEST(NodeGroup, RangesWithIncrement) {
  BuiltModel b(quads() + "/GRNOD/GEN_INCR/5\ng\n" + cells({1, 9, 4}));
  EXPECT_EQ(b.group(5), (Ids{1, 5, 9}));
}

TEST(NodeGroup, RangesWithIncrementAreOneALine) {
  BuiltModel b(quads() + "/GRNOD/GEN_INCR/5\ng\n" + cells({1, 3, 2, 5, 9, 1}) + cells({6, 7, 1}) +
               cells({8, 9}));
  EXPECT_EQ(b.group(5), (Ids{1, 3, 6, 7}));
}

TEST(NodeGroup, RangesWithIncrementAreNotReadBefore2019) {
  const std::string group = "/GRNOD/GEN_INCR/5\ng\n" + cells({1, 9, 4});
  EXPECT_EQ(BuiltModel(quads() + group, "kg mm ms", 2019).group(5).size(), 3u);
  BuiltModel old(quads() + group, "kg mm ms", 2018);
  EXPECT_TRUE(old.group(5).empty());
  EXPECT_EQ(old.message(RuleId::DK153), 690);
}

TEST(ElementGroup, RangesAreNotReadBefore2018) {
  const std::string groups = "/GRSHEL/GENE/5\ng\n" + cells({1, 100}) + "/GRNOD/GRSHEL/6\ng\n" +
                             cells({5}) + "/GRNOD/GENE/7\ng\n" + cells({1, 3});
  EXPECT_FALSE(BuiltModel(quads() + groups, "kg mm ms", 2018).group(6).empty());
  BuiltModel old(quads() + groups, "kg mm ms", 2017);
  EXPECT_TRUE(old.group(6).empty());
  EXPECT_EQ(old.group(7), (Ids{1, 2, 3}));
}

TEST(NodeGroup, NegativeGroupIsRemovedAfterAllPositiveOnes) {
  BuiltModel b(quads() + "/GRNOD/NODE/1\na\n" + cells({1, 2, 3}) + "/GRNOD/NODE/2\nb\n" +
               cells({2, 3, 4}) + "/GRNOD/NODE/3\nc\n" + cells({3}) + "/GRNOD/GRNOD/4\nd\n" +
               cells({1, -3, 2}));
  EXPECT_EQ(b.group(4), (Ids{1, 2, 4}));
}

TEST(NodeGroup, CircleOfGroupsIsMessage176AndEnds) {
  BuiltModel b(quads() + "/GRNOD/GRNOD/1\na\n" + cells({2}) + "/GRNOD/GRNOD/2\nb\n" + cells({1}));
  b.group(1);
  EXPECT_EQ(b.message(RuleId::DK152), 176);
}

TEST(NodeGroup, PartsGiveTheNodesOfTheirElements) {
  BuiltModel b(parts() + quads() + "/GRNOD/PART/5\ng\n" + cells({2}));
  EXPECT_EQ(b.group(5), (Ids{4, 5, 6, 7, 8, 9}));
}

TEST(NodeGroup, NodesOfANegativePartAreRemoved) {
  BuiltModel b(parts() + quads() + "/GRNOD/PART/5\ng\n" + cells({1, -2}));
  EXPECT_EQ(b.group(5), (Ids{1, 2, 3}));
}

TEST(NodeGroup, NodeRemovedWithAnEarlierFamilyComesBackWithALaterOne) {
  // Node 5 belongs to a shell of part 2 (removed) and to a truss of part 6 (added later).
  BuiltModel b(parts() + quads() + "/TRUSS/6\n" + cells({1, 1, 5}) + "/GRNOD/PART/5\ng\n" +
               cells({1, 6, -2}));
  EXPECT_EQ(b.group(5), (Ids{1, 2, 3, 5}));
}

TEST(NodeGroup, SubsetStandsForAllPartsBelowIt) {
  BuiltModel b(parts() + quads() + cube_nodes() + cubes() + "/GRNOD/SUBSET/5\ng\n" + cells({1}));
  EXPECT_EQ(b.group(5).size(), 9u + 12u);
}

TEST(NodeGroup, MaterialAndPropertySelectTheirParts) {
  BuiltModel b(parts() + quads() + cube_nodes() + cubes() + "/GRNOD/PROP/5\ng\n" + cells({2}) +
               "/GRNOD/MAT/6\ng\n" + cells({1}));
  EXPECT_EQ(b.group(5).size(), 12u);
  EXPECT_EQ(b.group(6).size(), 21u);
}

TEST(NodeGroup, SurfaceGroupIgnoresNegativeIds) {
  BuiltModel b(parts() + quads() + "/SURF/PART/1\ns\n" + cells({1}) + "/SURF/PART/2\ns\n" +
               cells({2}) + "/GRNOD/SURF/5\ng\n" + cells({1, -2}));
  EXPECT_EQ(b.group(5), (Ids{1, 2, 3, 4, 5, 6}));
}

TEST(NodeGroup, ElementGroupGivesItsNodes) {
  BuiltModel b(parts() + quads() + "/GRSHEL/SHEL/1\ne\n" + cells({4, 1}) + "/GRNOD/GRSHEL/5\ng\n" +
               cells({1}));
  EXPECT_EQ(b.group(5), (Ids{1, 2, 4, 5, 6, 8, 9}));
}

TEST(NodeGroup, SecondDefinitionOfAnIdIsReportedAndTheFirstKept) {
  BuiltModel b(quads() + "/GRNOD/NODE/5\na\n" + cells({1}) + "/GRNOD/NODE/5\nb\n" + cells({2}));
  EXPECT_EQ(b.group(5), (Ids{1}));
  EXPECT_EQ(b.message(RuleId::DK167), 79);
}

TEST(ElementGroup, NegativeGroupRemovesElements) {
  BuiltModel b(parts() + quads() + "/GRSHEL/PART/1\na\n" + cells({1, 2}) + "/GRSHEL/SHEL/2\nb\n" +
               cells({2}) + "/GRSHEL/GRSHEL/3\nc\n" + cells({1, -2}));
  EXPECT_EQ(b.selections().element_group("grshel", 3)->size(), 3u);
}

TEST(ElementGroup, PairOfEqualIdsSelectsNothing) {
  BuiltModel b(parts() + quads() + "/GRSHEL/GENE/1\na\n" + cells({2, 2, 3, 4}));
  EXPECT_EQ(b.selections().element_group("grshel", 1)->size(), 2u);
}

TEST(PartGroup, ListsParts) {
  BuiltModel b(parts() + "/GRPART/SUBSET/1\np\n" + cells({2}));
  EXPECT_EQ(*b.selections().part_group(1), (std::vector<std::uint32_t>{3, 4}));
}

TEST(PartGroup, RangesCountIdsAsWrittenInTheirSubmodel) {
  BuiltModel b(parts() + "//SUBMODEL/1\nsub\n" + cells({0, 0, 0, 100}) + "/PART/1\np\n" +
               cells({1, 1}) + "/PART/5\np\n" + cells({1, 1}) + "/GRPART/GENE/7\ng\n" +
               cells({1, 3}) + "//ENDSUB\n");
  const auto* group = b.selections().part_group(7);
  ASSERT_NE(group, nullptr);
  ASSERT_EQ(group->size(), 1u);
  EXPECT_EQ(b.model().parts[group->front()].id, 101);
}

TEST(Surface, ShellSegmentsAreSortedByFamilyThenElementId) {
  BuiltModel b(parts() + grid_nodes() + "/SH3N/1\n" + cells({1, 1, 2, 4}) + "/SHELL/1\n" +
               cells({9, 2, 3, 6, 5}) + cells({4, 4, 5, 8, 7}) + "/SURF/PART/1\ns\n" + cells({1}));
  EXPECT_EQ(b.surface(1), (std::vector<Ids>{{4, 5, 8, 7}, {2, 3, 6, 5}, {1, 2, 4, 4}}));
}

TEST(Surface, NegativePartReversesTheNormal) {
  BuiltModel b(parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) + "/SH3N/1\n" +
               cells({1, 2, 3, 6}) + "/SURF/PART/1\ns\n" + cells({-1}));
  EXPECT_EQ(b.surface(1), (std::vector<Ids>{{4, 5, 2, 1}, {6, 3, 2, 2}}));
}

/// An outline, asked first or last, has the segments of the surface, wherever a piece begins.
void expect_outline(const std::string& blocks, std::int64_t id, bool by_elements) {
  BuiltModel first(blocks), last(blocks);
  const auto outline = first.selections().outline(id);
  ASSERT_TRUE(outline);
  EXPECT_EQ(outline->segments.held_by_elements(), by_elements);
  const Surface* surface = last.selections().surface(id);
  ASSERT_NE(surface, nullptr);
  const auto same = [](const Segment& a, const Segment& b) {
    return a.nodes == b.nodes && a.carrier == b.carrier && a.element == b.element;
  };
  const auto expect_same = [&](const SegmentList& list) {
    ASSERT_EQ(list.size(), surface->segments.size());
    std::vector<Segment> room;
    for (std::size_t begin = 0; begin <= list.size(); ++begin)
      for (std::size_t end = begin; end <= list.size(); ++end) {
        const auto some = list.some(begin, end, room);
        EXPECT_TRUE(std::equal(some.begin(), some.end(), surface->segments.begin() + begin,
                               surface->segments.begin() + end, same))
            << begin << " " << end;
      }
  };
  expect_same(outline->segments);
  expect_same(last.selections().outline(id)->segments);
  const Surface* again = first.selections().surface(id);
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(again->title, surface->title);
  EXPECT_EQ(again->span.offset, surface->span.offset);
  expect_same({first.model(), again->segments});
  first.selections().resolve_all();
  last.selections().resolve_all();
  EXPECT_EQ(first.selections().diagnostics().counts(), last.selections().diagnostics().counts());
}

TEST(Surface, OutlineHasTheSegmentsOfTheSurface) {
  const std::string shells = parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) +
                             "/SHELL/2\n" + cells({2, 2, 3, 6, 5}) + "/SHELL/1\n" +
                             cells({3, 4, 5, 8, 7}) + cells({4, 5, 6, 9, 8}) + "/SH3N/3\n" +
                             cells({1, 1, 2, 5}) + cells({2, 2, 6, 5});
  const auto of = [](const Ids& parts) { return "/SURF/PART/1\ntitle\n" + cells(parts); };
  expect_outline(shells + of({2, 3}), 1, true);
  expect_outline(shells + of({1, -3}), 1, true);
  expect_outline(shells + of({-1, 9}), 1, true);
  expect_outline(shells + of({9}), 1, true);
  expect_outline(shells + of({1, 2}), 1, false);  // the order is that of the ids: 1 2 3 4
  expect_outline(shells + "/SHELL/3\n" + cells({9, 1, 2, 5, 77}) + of({3}), 1, false);
  expect_outline(shells + of({1}) + "/SURF/SURF/2\ns\n" + cells({1}), 2, false);
  const std::string bricks = "/BRICK/4\n" + cells({1, 1, 2, 5, 4, 11, 12, 15, 14});
  expect_outline(shells + bricks + of({1, 4}), 1, false);
  expect_outline(shells + bricks + "/SURF/PART/EXT/1\ns\n" + cells({1}), 1, true);
  BuiltModel none(shells + of({1}));
  EXPECT_FALSE(none.selections().outline(2));
}

TEST(Surface, AnOutlineCountsAsHeld) {
  const std::string blocks = parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) +
                             cells({2, 2, 3, 6, 5}) + "/SURF/PART/1\ns\n" + cells({1});
  for (const std::size_t room : {1, 2}) {
    Limits limits;
    limits.selection_bytes = room * sizeof(Segment);
    BuiltModel b(blocks);
    b.selections().set_limits(limits);
    const auto outline = b.selections().outline(1);
    ASSERT_TRUE(outline);
    EXPECT_EQ(outline->segments.size(), room == 2 ? 2u : 0u);
    EXPECT_EQ(b.selections().surface(1)->segments.size(), outline->segments.size());
    EXPECT_EQ(b.selections().complete(), room == 2);
  }
}

TEST(Surface, PlainSegmentsKeepTheirOrderAndComeFirst) {
  BuiltModel b(parts() + quads() + "/SURF/SEG/1\ns\n" + cells({1, 5, 6, 9, 8}) +
               cells({2, 1, 2, 5}) + "/SURF/PART/2\np\n" + cells({1}) + "/SURF/SURF/3\nu\n" +
               cells({2, 1}));
  EXPECT_EQ(b.surface(3),
            (std::vector<Ids>{{5, 6, 9, 8}, {1, 2, 5, 5}, {1, 2, 5, 4}, {2, 3, 6, 5}}));
}

TEST(Surface, SegmentOfTwoNodesCountsInTwoDimensionsOnly) {
  const std::string segments = "/SURF/SEG/1\ns\n" + cells({1, 5, 6}) + cells({2, 6, 9, 0, 0});
  BuiltModel flat("/ANALY\n" + cells({1, 0, 0}) + grid_nodes() + segments);
  EXPECT_EQ(flat.surface(1), (std::vector<Ids>{{5, 6, 6, 6}, {6, 9, 9, 9}}));
  BuiltModel solid(grid_nodes() + segments);
  EXPECT_TRUE(solid.surface(1).empty());
}

TEST(Surface, NegativeSurfaceIsReversed) {
  BuiltModel b(parts() + quads() + "/SURF/SEG/1\ns\n" + cells({1, 5, 6, 9, 8}) +
               cells({2, 1, 2, 5}) + "/SURF/SURF/3\nu\n" + cells({-1}));
  EXPECT_EQ(b.surface(3), (std::vector<Ids>{{8, 9, 6, 5}, {5, 2, 1, 1}}));
}

TEST(Surface, DifferenceDropsDuplicatesAndRemovedSegments) {
  BuiltModel b(parts() + quads() + "/SURF/PART/1\na\n" + cells({1, 2}) + "/SURF/PART/2\nb\n" +
               cells({1}) + "/SURF/DSURF/3\nd\n" + cells({1, 1, -2}));
  EXPECT_EQ(b.surface(3), (std::vector<Ids>{{4, 5, 8, 7}, {5, 6, 9, 8}}));
}

TEST(Surface, CircleOfSurfacesIsMessage189) {
  BuiltModel b(quads() + "/SURF/SURF/1\na\n" + cells({2}) + "/SURF/SURF/2\nb\n" + cells({1}));
  EXPECT_TRUE(b.surface(1).empty());
  EXPECT_EQ(b.message(RuleId::DK152), 189);
}

TEST(Surface, AnalyticalMemberIsMessage187) {
  BuiltModel b(quads() + "/SURF/PLANE/1\na\n" + reals({0, 0, 0}) + reals({0, 0, 1}) +
               "/SURF/SURF/2\nb\n" + cells({1}));
  EXPECT_TRUE(b.surface(2).empty());
  EXPECT_TRUE(b.selections().surface(1)->analytical);
  EXPECT_EQ(b.message(RuleId::DK158), 187);
}

TEST(Surface, GroupsOfShellsKeepTheirSign) {
  BuiltModel b(parts() + quads() + "/GRSHEL/SHEL/1\ne\n" + cells({1}) + "/GRSHEL/SHEL/2\ne\n" +
               cells({4}) + "/SURF/GRSHEL/3\ns\n" + cells({1, -2}));
  EXPECT_EQ(b.surface(3), (std::vector<Ids>{{1, 2, 5, 4}, {8, 9, 6, 5}}));
}

TEST(SolidFaces, FacesOfABrickInTheirOrderAllOutward) {
  BuiltModel b(parts() + cube_nodes() + cubes() + "/SURF/PART/EXT/1\ns\n" + cells({4}));
  EXPECT_EQ(b.surface(1), (std::vector<Ids>{{104, 105, 102, 101},
                                            {107, 108, 111, 110},
                                            {101, 102, 108, 107},
                                            {105, 104, 110, 111},
                                            {102, 105, 111, 108},
                                            {101, 107, 110, 104}}));
}

TEST(SolidFaces, FaceBetweenTwoSelectedSolidsIsInterior) {
  BuiltModel b(parts() + cube_nodes() + cubes() + "/SURF/PART/EXT/1\ns\n" + cells({4, 5}) +
               "/SURF/PART/ALL/2\ns\n" + cells({4, 5}));
  EXPECT_EQ(b.surface(1).size(), 10u);
  EXPECT_EQ(b.surface(2).size(), 12u);
}

TEST(SolidFaces, ExteriorOfAGroupOrOfTheWholeModel) {
  BuiltModel b(parts() + cube_nodes() + cubes() + "/GRBRIC/PART/1\ne\n" + cells({4}) +
               "/SURF/GRBRIC/EXT/1\ns\n" + cells({1}) + "/SURF/GRBRIC/FREE/2\ns\n" + cells({1}));
  EXPECT_EQ(b.surface(1).size(), 6u);
  EXPECT_EQ(b.surface(2).size(), 5u);
}

TEST(SolidFaces, AGroupLosesTheFaceUnderAShellByThePlaceOfItsPart) {
  // The cubes 1 (part 4) and 2 (part 5); the shell's part is the k-th of the deck.
  const auto deck = [](int part, const std::string& group) {
    return parts() + cube_nodes() + cubes() + "/SHELL/" + std::to_string(part) + "\n" +
           cells({7, 101, 102, 105, 104}) + "/GRBRIC/PART/1\ne\n" + group +
           "/SURF/GRBRIC/EXT/1\ns\n" + cells({1}) + "/SURF/GRBRIC/FREE/2\ns\n" + cells({1}) +
           "/SURF/PART/EXT/3\ns\n" + cells({4, 5});
  };
  BuiltModel second(deck(2, cells({4, 5})));  // the second solid is in the group
  EXPECT_EQ(second.surface(1).size(), 9u);
  EXPECT_EQ(second.surface(2).size(), 9u);
  EXPECT_EQ(second.surface(3).size(), 10u);
  EXPECT_EQ(second.findings(RuleId::DK063), 2u);
  BuiltModel not_in_it(deck(2, cells({4})));
  EXPECT_EQ(not_in_it.surface(1).size(), 6u);
  BuiltModel no_such_solid(deck(3, cells({4, 5})));
  EXPECT_EQ(no_such_solid.surface(1).size(), 10u);
  EXPECT_EQ(no_such_solid.findings(RuleId::DK063), 0u);
}

TEST(SolidFaces, SolidsWithoutExtOrAllAreMessage1104) {
  BuiltModel b(parts() + cube_nodes() + cubes() + "/SURF/PART/1\ns\n" + cells({4}));
  EXPECT_TRUE(b.surface(1).empty());
  EXPECT_EQ(b.message(RuleId::DK155), 1104);
}

TEST(SolidFaces, GroupOfSolidsWithoutExtOrFreeIsMessage479) {
  BuiltModel b(parts() + cube_nodes() + cubes() + "/GRBRIC/PART/1\ne\n" + cells({4}) +
               "/SURF/GRBRIC/1\ns\n" + cells({1}));
  EXPECT_TRUE(b.surface(1).empty());
  EXPECT_EQ(b.message(RuleId::DK157), 479);
}

TEST(SolidFaces, PentaHasTwoTrianglesAndThreeQuads) {
  BuiltModel b(parts() + cube_nodes() + "/PENTA6/4\n" + cells({1, 101, 102, 104, 107, 108, 110}) +
               "/SURF/PART/EXT/1\ns\n" + cells({4}));
  const auto faces = b.surface(1);
  ASSERT_EQ(faces.size(), 5u);
  int triangles = 0;
  for (const Ids& f : faces) triangles += f[2] == f[3];
  EXPECT_EQ(triangles, 2);
}

TEST(SolidFaces, TetraHasOneTriangleOppositeToEveryNode) {
  BuiltModel b(parts() + cube_nodes() + "/TETRA4/4\n" + cells({1, 101, 102, 104, 107}) +
               "/SURF/PART/EXT/1\ns\n" + cells({4}));
  const auto faces = b.surface(1);
  ASSERT_EQ(faces.size(), 4u);
  for (const std::int64_t n : {101, 102, 104, 107}) {
    int without = 0;
    for (const Ids& f : faces) without += std::count(f.begin(), f.end(), n) == 0;
    EXPECT_EQ(without, 1) << "node " << n;
  }
  for (const Ids& f : faces) EXPECT_EQ(f[2], f[3]);
}

std::string tetra10() {
  std::string out = "/NODE\n" + node(1, 0, 0, 0) + node(2, 2, 0, 0) + node(3, 0, 2, 0) +
                    node(4, 0, 0, 2) + node(5, 1, 0, 0) + node(6, 1, 1, 0) + node(7, 0, 1, 0) +
                    node(8, 0, 0, 1) + node(9, 1, 0, 1) + node(10, 0, 1, 1);
  return out + "/TETRA10/4\n" + cells({1}) + cells({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
}

TEST(SolidFaces, FaceOfATenNodeTetraIsCutIntoFour) {
  BuiltModel b(parts() + tetra10() + "/SURF/PART/EXT/1\ns\n" + cells({4}));
  const auto faces = b.surface(1);
  EXPECT_EQ(faces.size(), 16u);
  // Every corner of the tetrahedron is in three small triangles, every mid-side node in six.
  for (std::int64_t n = 1; n <= 10; ++n) {
    int uses = 0;
    for (const Ids& f : faces) uses += std::count(f.begin(), f.begin() + 3, n);
    EXPECT_EQ(uses, n <= 4 ? 3 : 6) << "node " << n;
  }
}

TEST(SolidFaces, PlainTriangleOnATenNodeTetraIsCutTheSameWay) {
  BuiltModel b(parts() + tetra10() + "/SURF/SEG/1\ns\n" + cells({1, 1, 3, 2}));
  EXPECT_EQ(b.surface(1),
            (std::vector<Ids>{{1, 7, 5, 5}, {3, 6, 7, 7}, {2, 5, 6, 6}, {7, 6, 5, 5}}));
}

TEST(SolidFaces, ATenNodeFaceWithOneOrTwoMidsIsCutAtTheFirst) {
  const std::array<NodeIndex, 3> corners{10, 20, 30};
  std::array<std::array<NodeIndex, 4>, 4> out;
  using Tri = std::array<NodeIndex, 4>;
  ASSERT_EQ(detail::cut_triangle(corners, {no_index, 25, no_index}, out), 2);
  EXPECT_EQ(out[0], (Tri{20, 25, 10, 10}));
  EXPECT_EQ(out[1], (Tri{25, 30, 10, 10}));
  // Two: no quadrangle, the second mid is left aside.
  ASSERT_EQ(detail::cut_triangle(corners, {no_index, 25, 31}, out), 2);
  EXPECT_EQ(out[0], (Tri{20, 25, 10, 10}));
  EXPECT_EQ(out[1], (Tri{25, 30, 10, 10}));
  ASSERT_EQ(detail::cut_triangle(corners, {15, no_index, 31}, out), 2);
  EXPECT_EQ(out[0], (Tri{10, 15, 30, 30}));
  EXPECT_EQ(out[1], (Tri{15, 20, 30, 30}));
}

TEST(SolidFaces, SolidsWithTwentyNodesAreMessage651) {
  std::string nodes = "/NODE\n";
  for (int n = 1; n <= 20; ++n) nodes += node(n, n % 2, n / 2 % 2, n / 4);
  BuiltModel b(parts() + nodes + "/BRIC20/4\n" + cells({1, 1, 2, 3, 4, 5, 6, 7, 8}) +
               cells({9, 10, 11, 12, 13, 14, 15, 16}) + cells({17, 18, 19, 20}) +
               "/SURF/PART/EXT/1\ns\n" + cells({4}));
  EXPECT_TRUE(b.surface(1).empty());
  EXPECT_EQ(b.message(RuleId::DK156), 651);
}

/// Two solids that overlap: both have the edges 1-5 and 2-6, and nodes 3 and 7 of the first are
/// nodes of the second too, so that the face 1 5 7 3 of the second lies inside the first. `name`
/// gives the nodes their ids.
template <class Name>
std::string overlapping(bool inner_first, Name name) {
  std::string nodes = "/NODE\n";
  for (int n = 1; n <= 8; ++n)
    nodes += node(name(n), n % 4 == 2 || n % 4 == 3, n % 4 == 3 || n % 4 == 0, n > 4);
  nodes += node(name(9), 2, 1, 0) + node(name(10), 2, 1, 1);
  const auto brick = [&](std::vector<int> card) {
    for (std::size_t i = 1; i < card.size(); ++i) card[i] = name(card[i]);
    std::string line;
    for (const int n : card) line += cells({n}).substr(0, 10);
    return line + "\n";
  };
  const std::string outer = brick({1, 1, 2, 3, 4, 5, 6, 7, 8});
  const std::string inner = brick({2, 1, 2, 9, 3, 5, 6, 10, 7});
  return nodes + "/BRICK/4\n" + (inner_first ? inner + outer : outer + inner);
}
std::string overlapping(bool inner_first) {
  return overlapping(inner_first, [](int n) { return n; });
}
bool has_face(BuiltModel& b, Ids nodes) {
  std::sort(nodes.begin(), nodes.end());
  const auto faces = b.surface(1);
  return std::any_of(faces.begin(), faces.end(), [&](Ids f) {
    std::sort(f.begin(), f.end());
    return f == nodes;
  });
}
bool has_inner_face(BuiltModel& b) { return has_face(b, {1, 3, 5, 7}); }

TEST(SolidFaces, FaceInsideASolidIsDroppedWhereAFaceThereEndsWithItsSecondNode) {
  // 1 5 7 3 of the inner solid: the outer one has 1 2 6 5, which begins with 1 and ends with 5. Of
  // 1 2 6 5, which both have in the same sense, both copies go: 1 4 3 2 and 1 3 9 2 end with 2.
  for (const bool inner_first : {false, true}) {
    BuiltModel b(parts() + overlapping(inner_first) + "/SURF/PART/EXT/1\ns\n" + cells({4}));
    EXPECT_FALSE(has_inner_face(b));
    EXPECT_FALSE(has_face(b, {1, 2, 6, 5}));
    EXPECT_EQ(b.surface(1).size(), 9u);
  }
}

TEST(SolidFaces, FaceInsideASolidStaysWhereThatOnesFacesBeginWithOtherNodes) {
  // With node 2 the first of all, 1 2 6 5 does not begin with 1 any more.
  const auto name = [](int n) { return n == 2 ? 1 : 10 + n; };
  for (const bool inner_first : {false, true}) {
    BuiltModel b(parts() + overlapping(inner_first, name) + "/SURF/PART/EXT/1\ns\n" + cells({4}));
    EXPECT_TRUE(has_face(b, {11, 13, 15, 17}));
  }
}

TEST(SolidFaces, TwoFacesWithThreeNodesInCommonCanHideOneAnother) {
  // Known from a public deck: 297 300 362 336 goes because 297 335 336 300 of the other solid,
  // which has all four nodes, ends with 300.
  const std::string nodes = "/NODE\n" + node(297, 0, 0, 1) + node(300, 1, 0, 1) +
                            node(362, 1, 1, 1) + node(336, 0, 1, 1) + node(335, -1, 1, 1) +
                            node(401, 0, 0, 0) + node(402, 1, 0, 0) + node(403, 1, 1, 0) +
                            node(404, 0, 1, 0) + node(501, 0, 2, 2) + node(502, -1, 2, 2) +
                            node(503, 0, 1, 2);
  const std::string first = cells({1, 401, 402, 403, 404, 297, 300, 362, 336});
  const std::string second = cells({2, 300, 336, 335, 297, 362, 501, 502, 503});
  BuiltModel b(parts() + nodes + "/BRICK/4\n" + first + second + "/SURF/PART/EXT/1\ns\n" +
               cells({4}));
  EXPECT_FALSE(has_face(b, {297, 300, 362, 336}));
  EXPECT_TRUE(has_face(b, {297, 335, 336, 300})) << "the first solid lacks 335: not symmetric";
}

TEST(SolidFaces, SmallestNodeIsThatOfTheIdsNotOfTheFile) {
  // The same two solids with the nodes written backwards.
  std::string nodes = "/NODE\n";
  nodes += node(10, 2, 1, 1) + node(9, 2, 1, 0);
  for (int n = 8; n >= 1; --n)
    nodes += node(n, n % 4 == 2 || n % 4 == 3, n % 4 == 3 || n % 4 == 0, n > 4);
  const std::string bricks = overlapping(false).substr(overlapping(false).find("/BRICK"));
  BuiltModel b(parts() + nodes + bricks + "/SURF/PART/EXT/1\ns\n" + cells({4}));
  EXPECT_FALSE(has_inner_face(b));
  EXPECT_EQ(b.surface(1).size(), 9u);
}

TEST(SolidFaces, TurnedPentahedraKeepTwoOfTheirSlots) {
  // 1 2 3 4 5 6 with negative volume is stored as 4 5 6 1 1 2 3 4: its triangles become
  // quadrangles.
  const std::string nodes = "/NODE\n" + node(1, 0, 0, 0) + node(2, 0, 1, 0) + node(3, 1, 0, 0) +
                            node(4, 0, 0, 1) + node(5, 0, 1, 1) + node(6, 1, 0, 1);
  BuiltModel b(parts() + nodes + "/PENTA6/4\n" + cells({1, 1, 2, 3, 4, 5, 6}) +
               "/SURF/PART/EXT/1\ns\n" + cells({4}));
  BuiltModel good(parts() + nodes + "/PENTA6/4\n" + cells({1, 1, 3, 2, 4, 6, 5}) +
                  "/SURF/PART/EXT/1\ns\n" + cells({4}));
  EXPECT_EQ(good.surface(1).size(), 5u);
  EXPECT_TRUE(has_face(good, {1, 2, 3, 3}) || has_face(good, {1, 1, 2, 3}) ||
              has_face(good, {1, 2, 2, 3}));
  EXPECT_EQ(b.surface(1).size(), 5u);
  EXPECT_TRUE(has_face(b, {1, 4, 5, 6}));
  EXPECT_TRUE(has_face(b, {1, 2, 3, 4}));
}

TEST(SolidFaces, FaceInsideASolidThatIsNotSelectedStays) {
  BuiltModel b(parts() + overlapping(false) + "/BRICK/5\n" + cells({3, 1, 2, 9, 3, 5, 6, 10, 7}) +
               "/SURF/PART/EXT/1\ns\n" + cells({5}));
  EXPECT_TRUE(has_inner_face(b));
}

TEST(SolidFaces, AllFacesIncludeTheOnesInsideOtherSolids) {
  BuiltModel b(parts() + overlapping(false) + "/SURF/PART/ALL/1\ns\n" + cells({4}));
  EXPECT_TRUE(has_inner_face(b));
}

TEST(ShellOnSolid, FacesOfTenNodeTetrahedraAreNotHeldAgainstShells) {
  const std::string skin = "/SH3N/1\n" + cells({7, 1, 2, 3});
  BuiltModel b(parts() + tetra10() + skin + "/SURF/PART/EXT/1\ns\n" + cells({4, 1}));
  // Sixteen small triangles, and the shell on one of the four faces.
  EXPECT_EQ(b.surface(1).size(), 17u);
}

TEST(ShellOnSolid, ATriangularFaceLooksForShellsOfThreeNodesOnly) {
  const std::string nodes =
      "/NODE\n" + node(1, 0, 0, 0) + node(2, 2, 0, 0) + node(3, 0, 2, 0) + node(4, 0, 0, 2);
  const std::string tetra = "/TETRA4/4\n" + cells({1, 1, 2, 3, 4});
  BuiltModel three(parts() + nodes + tetra + "/SH3N/1\n" + cells({7, 1, 2, 3}) +
                   "/SURF/PART/EXT/1\ns\n" + cells({4, 1}));
  EXPECT_EQ(three.surface(1).size(), 4u);
  BuiltModel four(parts() + nodes + tetra + "/SHELL/1\n" + cells({7, 1, 2, 3, 3}) +
                  "/SURF/PART/EXT/1\ns\n" + cells({4, 1}));
  EXPECT_EQ(four.surface(1).size(), 5u);
}

TEST(ShellOnSolid, ReplacesTheFaceIfItsPartIsListedToo) {
  const std::string skin = "/SHELL/1\n" + cells({1, 101, 102, 105, 104});
  BuiltModel b(parts() + cube_nodes() + cubes() + skin + "/SURF/PART/EXT/1\ns\n" + cells({4, 1}) +
               "/SURF/PART/EXT/2\ns\n" + cells({4}));
  EXPECT_EQ(b.surface(1).size(), 6u);
  EXPECT_EQ(b.selections().surface(1)->segments.back().carrier, Carrier::shell4);
  EXPECT_EQ(b.surface(2).size(), 6u);
  EXPECT_EQ(b.selections().surface(2)->segments.back().carrier, Carrier::solid);
}

TEST(ShellOnSolid, OfTwoShellsTheFirstAtTheFirstNodeOfTheFaceDecides) {
  // The bottom face starts with node 104. Shell 1 has it as its last node, shell 2 as its first.
  const std::string skins =
      "/SHELL/1\n" + cells({1, 101, 102, 105, 104}) + "/SHELL/2\n" + cells({2, 104, 105, 102, 101});
  BuiltModel b(parts() + cube_nodes() + cubes() + skins + "/SURF/PART/EXT/1\ns\n" + cells({4, 1}) +
               "/SURF/PART/EXT/2\ns\n" + cells({4, 2}));
  EXPECT_EQ(b.surface(1).size(), 7u) << "shell 2 is not listed: the face stays beside shell 1";
  EXPECT_EQ(b.surface(2).size(), 6u);
}

TEST(Line, EdgesOfASurfaceAreMergedAndSortedByTheirLaterNode) {
  BuiltModel b(parts() + quads() + "/SURF/PART/1\ns\n" + cells({1}) + "/LINE/SURF/1\nl\n" +
               cells({1}));
  EXPECT_EQ(b.line(1), (std::vector<Ids>{{1, 2}, {2, 3}, {1, 4}, {2, 5}, {4, 5}, {3, 6}, {5, 6}}));
}

TEST(Line, EdgeKeepsOnlyFreeEdges) {
  BuiltModel b(parts() + quads() + "/SURF/PART/1\ns\n" + cells({1}) + "/LINE/EDGE/1\nl\n" +
               cells({1}));
  EXPECT_EQ(b.line(1), (std::vector<Ids>{{1, 2}, {2, 3}, {1, 4}, {4, 5}, {3, 6}, {5, 6}}));
}

TEST(Line, SegmentsAreTakenAsGiven) {
  BuiltModel b(quads() + "/LINE/SEG/1\nl\n" + cells({1, 5, 2}) + cells({2, 1, 2}));
  EXPECT_EQ(b.line(1), (std::vector<Ids>{{5, 2}, {1, 2}}));
}

TEST(Line, PartsGiveTheirTrusses) {
  BuiltModel b(parts() + quads() + "/TRUSS/6\n" + cells({1, 9, 5}) + "/LINE/PART/1\nl\n" +
               cells({6, 1}));
  EXPECT_EQ(b.line(1), (std::vector<Ids>{{9, 5}}));
}

TEST(Line, EmptyLineIsWarning691) {
  BuiltModel b(parts() + quads() + "/LINE/PART/1\nl\n" + cells({1}));
  EXPECT_TRUE(b.line(1).empty());
  EXPECT_EQ(b.message(RuleId::DK154), 691);
}

TEST(Selections, IdThatNamesNothingGivesNoResult) {
  BuiltModel b(quads());
  EXPECT_EQ(b.selections().node_group(1), nullptr);
  EXPECT_EQ(b.selections().surface(1), nullptr);
  EXPECT_EQ(b.selections().line(1), nullptr);
}

TEST(Selections, FollowTheirModelWhenItMoves) {
  BuiltModel b(parts() + quads() + "/SURF/PART/1\ns\n" + cells({1}));
  const Model moved = std::move(b.model());
  EXPECT_EQ(moved.selections->surface(1)->segments.size(), 2u);
}

TEST(Submodel, OffsetsShiftOwnIdsAndReferences) {
  BuiltModel b(parts() + quads() + "//SUBMODEL/1\nsub\n" + cells({100, 1000}) + "/NODE\n" +
               node(1, 5, 5, 5) + "/GRNOD/NODE/7\ng\n" + cells({1}) + "//ENDSUB\n");
  EXPECT_EQ(b.group(107), (Ids{1001}));
}

}  // namespace
}  // namespace deck::test
