// /SET: clauses, options and the three projections.
#include "model/selection_deck.hpp"

#include <algorithm>

namespace deck::test {
namespace {

std::string model() {
  return parts() + grid_nodes() + "/SHELL/1\n" + cells({1, 1, 2, 5, 4}) + cells({2, 2, 3, 6, 5}) +
         "/SHELL/2\n" + cells({3, 4, 5, 8, 7}) + cells({4, 5, 6, 9, 8}) + cube_nodes() + cubes();
}

TEST(Set, NodesContinueOnLinesWithBlankKeyword) {
  BuiltModel b(model() + set(1, clause("NODE", {9, 1, 2, 3, 4, 5, 6, 7, 8, 101, 102})));
  EXPECT_EQ(b.group(1), (Ids{1, 2, 3, 4, 5, 6, 7, 8, 9, 101, 102}));
}

TEST(Set, NamesNodesSurfaceAndLineOfOneSelection) {
  BuiltModel b(model() + set(1, clause("PART", {1})));
  EXPECT_EQ(b.group(1), (Ids{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(b.surface(1), (std::vector<Ids>{{1, 2, 5, 4}, {2, 3, 6, 5}}));
  // Edges of sets are sorted by their earlier node.
  EXPECT_EQ(b.line(1), (std::vector<Ids>{{1, 2}, {1, 4}, {2, 3}, {2, 5}, {3, 6}, {4, 5}, {5, 6}}));
}

TEST(Set, PlainGroupOfTheSameIdComesFirst) {
  BuiltModel b(model() + set(1, clause("PART", {1})) + "/GRNOD/NODE/1\ng\n" + cells({9}));
  EXPECT_EQ(b.group(1), (Ids{9}));
  EXPECT_TRUE(b.selections().is_plain("grnod", 1));
  EXPECT_FALSE(b.selections().is_plain("surf", 1));
}

TEST(Set, SolidsGiveExteriorFacesAndAllOfThemWithOptionA) {
  BuiltModel b(model() + set(1, clause("PART", {4, 5})) + set(2, clause("PART_A", {4, 5})));
  EXPECT_EQ(b.surface(1).size(), 10u);
  EXPECT_EQ(b.surface(2).size(), 12u);
}

TEST(Set, ClausesOfPartsAreSeenTogether) {
  BuiltModel b(model() + set(1, clause("PART", {4}) + clause("PART", {5})));
  EXPECT_EQ(b.surface(1).size(), 10u);
}

TEST(Set, OnlyPartsAndSolidsAreAmongThemselvesOtherClausesSeeTheWholeModel) {
  // The first of two cubes with a common face: as a part or a solid it has six faces, in a box its
  // neighbour outside the set counts.
  const std::string box =
      "/BOX/RECTA/1\nbox\n         0\n" + reals({-0.5, -0.5, -0.5}) + reals({1.5, 1.5, 1.5});
  BuiltModel b(model() + box + set(1, clause("PART", {4})) + set(2, clause("SOLID", {1})) +
               set(3, clause("BOX", {1})) + set(4, clause("SUBS", {2})));
  const auto solids = [&](std::int64_t id) {
    const auto& all = b.selections().surface(id)->segments;
    return std::count_if(all.begin(), all.end(),
                         [](const Segment& s) { return s.carrier == Carrier::solid; });
  };
  EXPECT_EQ(solids(1), 6);
  EXPECT_EQ(solids(2), 6);
  EXPECT_EQ(solids(3), 5);
  EXPECT_EQ(solids(4), 10);
}

TEST(Set, AShellOnAFaceOfASolidReplacesTheFace) {
  const std::string skin = "/SHELL/1\n" + cells({11, 101, 102, 105, 104});
  BuiltModel b(parts() + cube_nodes() + cubes() + skin + set(1, clause("PART", {4, 1})) +
               set(2, clause("PART", {4})));
  EXPECT_EQ(b.surface(1).size(), 6u);
  const auto& segments = b.selections().surface(1)->segments;
  EXPECT_EQ(std::count_if(segments.begin(), segments.end(),
                          [](const Segment& s) { return s.carrier == Carrier::shell4; }),
            1);
  EXPECT_EQ(b.surface(2).size(), 6u);
}

TEST(Set, EdgesOfDifferentClausesAreNotMerged) {
  BuiltModel b(model() + "/SH3N/3\n" + cells({1, 1, 2, 8}) +
               set(1, clause("SH3N", {1}) + clause("SHELL", {1})));
  EXPECT_EQ(b.line(1), (std::vector<Ids>{{1, 2}, {1, 2}, {1, 4}, {1, 8}, {2, 5}, {2, 8}, {4, 5}}));
}

TEST(Set, SegmentsAreSortedByTheirAscendingNodesTrianglesFirst) {
  BuiltModel b(model() + set(1, clause("SEG", {1, 9, 8, 5, 6}) + clause("", {2, 2, 1, 4, 5}) +
                                    clause("", {3, 8, 7, 4})));
  EXPECT_EQ(b.surface(1), (std::vector<Ids>{{8, 7, 4, 4}, {2, 1, 4, 5}, {9, 8, 5, 6}}));
}

TEST(Set, SegmentRowWithTwoNodesIsALine) {
  BuiltModel b(model() + set(1, clause("SEG", {1, 9, 8})));
  EXPECT_TRUE(b.surface(1).empty());
  EXPECT_EQ(b.line(1), (std::vector<Ids>{{9, 8}}));
}

TEST(Set, OptionDeletesFromWhatPrecedes) {
  BuiltModel b(model() + set(1, clause("PART", {1, 2}) + clause("SHELL_D", {1, 4})));
  EXPECT_EQ(b.surface(1), (std::vector<Ids>{{2, 3, 6, 5}, {4, 5, 8, 7}}));
  EXPECT_EQ(b.group(1), (Ids{2, 3, 4, 5, 6, 7, 8}));
}

TEST(Set, OptionIntersects) {
  BuiltModel b(model() + set(1, clause("PART", {1}) + clause("PART_I", {2})) +
               set(2, clause("PART", {1, 2}) + clause("SHELL_I", {2, 3})));
  EXPECT_EQ(b.group(1), (Ids{4, 5, 6}));
  EXPECT_TRUE(b.surface(1).empty());
  EXPECT_EQ(b.surface(2).size(), 2u);
}

TEST(Set, OptionReversesNormals) {
  BuiltModel b(model() + set(1, clause("SHELL_O", {1})));
  EXPECT_EQ(b.surface(1), (std::vector<Ids>{{4, 5, 2, 1}}));
}

TEST(Set, OptionGeneratesIdsWithIncrement) {
  BuiltModel b(model() + set(1, clause("NODE_G", {1, 9, 4, 101, 102, 1})));
  EXPECT_EQ(b.group(1), (Ids{1, 5, 9, 101, 102}));
}

TEST(Set, OptionExternalKeepsFreeEdges) {
  BuiltModel b(model() + set(1, clause("PART_E", {1})));
  EXPECT_EQ(b.line(1).size(), 6u);
}

TEST(Set, OptionExternalLeavesTheNodesOfTheSurface) {
  BuiltModel b(model() + set(1, clause("PART_E", {1})));
  EXPECT_EQ(b.group(1), (Ids{1, 2, 3, 4, 5, 6}));
}

TEST(Set, SubsetAndWholeModel) {
  BuiltModel b(model() + set(1, clause("SUBS", {2})) + set(2, clause("ALL", {})));
  EXPECT_EQ(b.group(1).size(), 12u);
  EXPECT_EQ(b.group(2).size(), 21u);
}

TEST(Set, SetsOfSetsAndTheirCircles) {
  BuiltModel b(model() + set(1, clause("SET", {2}) + clause("NODE", {9})) +
               set(2, clause("NODE", {1})) + set(3, clause("SET", {4})) +
               set(4, clause("SET", {3})));
  EXPECT_EQ(b.group(1), (Ids{1, 9}));
  b.group(3);
  EXPECT_GE(b.findings(RuleId::DK152), 1u);
}

// Each set lists the one before it twice, through two others: 2^40 ways from the last to the first.
TEST(Set, IsHeldOnceHoweverManyWaysLeadToIt) {
  std::string text = model() + set(1, clause("NODE", {1}));
  for (int k = 1; k <= 40; ++k) {
    text += set(3 * k, clause("SET", {3 * k - 2}) + clause("SHELL", {1}));
    text += set(3 * k - 1, clause("SET", {3 * k - 2}));
    text += set(3 * k + 1, clause("SET", {3 * k, 3 * k - 1}));
  }
  BuiltModel b(text);
  EXPECT_EQ(b.group(121), (Ids{1, 2, 4, 5}));
  EXPECT_EQ(b.surface(121), (std::vector<Ids>{{1, 2, 5, 4}}));
  EXPECT_EQ(b.findings(RuleId::DK332), 0u);
}

TEST(Set, AChainOfSetsTakesRoomOnlyForWhatTheyHold) {
  std::string text = model() + set(1, clause("NODE", {9}));
  for (int k = 2; k <= 240; ++k)
    text += set(k, clause("SET", {k - 1}) + clause("NODE", {k % 9 + 1}));
  BuiltModel b(text);
  EXPECT_EQ(b.group(240), (Ids{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(SelectionBounds, WhatExceedsTheMemoryIsLeftOutWithOneFinding) {
  std::string text = model();
  for (int k = 1; k <= 60; ++k)
    text += "/SURF/SURF/" + std::to_string(k) + "\ns\n" + cells({k + 100, k + 1});
  for (int k = 1; k <= 60; ++k)
    text += "/SURF/SURF/" + std::to_string(k + 100) + "\ns\n" + cells({k + 1});
  text += "/SURF/PART/61\ns\n" + cells({1});
  BuiltModel b(text);
  Limits limits;
  limits.selection_bytes = 1 << 20;
  Selections bounded(b.model(), SchemaSet::built_in(), limits);
  bounded.resolve_all();
  EXPECT_FALSE(bounded.complete());
  EXPECT_EQ(bounded.diagnostics().counts().at(RuleId::DK332), 1u);
  Selections small(b.model(), SchemaSet::built_in(), limits);
  EXPECT_EQ(small.surface(55)->segments.size(), 2u << 6);
  EXPECT_TRUE(small.complete());
}

TEST(Set, CollectGathersAllDefinitionsOfTheId) {
  BuiltModel b(model() + "/SET/COLLECT/1\na\n" + clause("NODE", {1}) + "/SET/COLLECT/1\nb\n" +
               clause("NODE", {2}));
  EXPECT_EQ(b.group(1), (Ids{1, 2}));
  EXPECT_EQ(b.findings(RuleId::DK167), 0u);
}

TEST(Set, MissingSetIsWarning1902AndTheOthersCount) {
  BuiltModel b(model() + set(1, clause("SET", {2, 77})) + set(2, clause("NODE", {1})));
  EXPECT_EQ(b.group(1), (Ids{1}));
  EXPECT_EQ(b.message(RuleId::DK161), 1902);
}

TEST(Set, UnknownClauseIsMessage1906) {
  BuiltModel b(model() + set(1, clause("NOODE", {1})));
  b.group(1);
  EXPECT_EQ(b.message(RuleId::DK160), 1906);
}

TEST(Set, ClauseOfAKindTheModelLacksIsWarning2007) {
  BuiltModel b(model() + set(1, clause("BEAM", {1})));
  b.group(1);
  EXPECT_EQ(b.message(RuleId::DK163), 2007);
}

TEST(Set, WhatIsNotEvaluatedIsSaid) {
  BuiltModel b(model() + set(1, clause("PART_B", {1}) + clause("RBODY", {1})));
  b.group(1);
  EXPECT_EQ(b.findings(RuleId::DK164), 2u);
}

}  // namespace
}  // namespace deck::test
