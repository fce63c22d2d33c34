// Values and counts of geometry rules. rules_test.cpp runs their examples.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "lint/support.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

TEST(CoordinatesWithoutBounds, LeaveTheContactUnevaluatedWithAFinding) {
  const Linted run = lint_geometry(
      "/UNIT/3\nkilometres\n                  kg                  km                  ms\n"
      "/NODE/3\n        21             1.e+305                 0.0                 0.0\n"
      "/NODE\n        22                 1.0                 1.0                 1.0\n"
      "/GRNOD/NODE/3\nboth\n        21        22\n@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=4\n");
  EXPECT_EQ(run.count(RuleId::DK333), 1u) << run.list();
  EXPECT_EQ(run.count(RuleId::DK380), 1u) << run.list();
  EXPECT_EQ(run.count(RuleId::DK301), 0u) << run.list();
}

TEST(GapWithoutBounds, LeavesTheContactUnevaluatedWithAFinding) {
  // In working units the gap is 1e400.
  const Linted run = lint_geometry(
      "/UNIT/3\nfar\n                  kg             1.e+206                  ms\n"
      "@/INTER/TYPE7/1/3 Gapmin=1e200\n");
  ASSERT_EQ(run.count(RuleId::DK380), 1u) << run.list();
  EXPECT_NE(run.find(RuleId::DK380)->message.find("not a finite number in working units"),
            std::string::npos);
  EXPECT_EQ(run.count(RuleId::DK301), 0u) << run.list();
}

TEST(InitialPenetrations, NameTheWarningWithWhichTheirTypeIsCounted) {
  // Inacti 5 everywhere. Of a TYPE25 whose nodes penetrate too, edges have the warning of the
  // nodes.
  const std::vector<std::pair<std::string, int>> types = {{"/INTER/TYPE24 ", 1186},
                                                          {"/INTER/TYPE25 ", 343}};
  std::set<std::string> seen;
  for (const char* name : {"coated_block", "airbag_fold"}) {
    auto deck = read_deck((source_dir() / "samples" / (std::string(name) + "_0000.rad")).string(),
                          SchemaSet::built_in());
    ASSERT_TRUE(deck);
    for (const Finding& d : lint_geometry_of(std::move(*deck)).result.findings) {
      if (d.rule != RuleId::DK301) continue;
      for (const auto& [type, warning] : types) {
        if (!d.message.starts_with(type)) continue;
        ASSERT_TRUE(d.reference) << d.message;
        EXPECT_EQ(d.reference->number, warning) << d.message;
        seen.insert(type + (d.message.find("(edges)") != std::string::npos ? "edges" : "nodes"));
      }
    }
  }
  EXPECT_EQ(seen.size(), 3u);
  EXPECT_EQ(lint_geometry("@/INTER/TYPE11/1 Gapmin=4").find(RuleId::DK301)->reference->number, 499);
}

TEST(OnSurface, MessageFollowsInacti) {
  const std::string node =
      "/NODE\n        21                 5.0                 5.0                 0.0\n"
      "/GRNOD/NODE/3\non\n        21\n@/INTER/TYPE7/1 grnd_IDs=3 Gapmin=1 Inacti=";
  EXPECT_EQ(lint_geometry(node + "6\n").find(RuleId::DK302)->reference->number, 611);
  EXPECT_EQ(lint_geometry(node + "0\n").find(RuleId::DK302)->reference->number, 612);
  EXPECT_FALSE(lint_geometry(node + "1\n").fires(RuleId::DK302));
  EXPECT_TRUE(lint_geometry(node + "1\n").fires(RuleId::DK303));
}

TEST(ShortSides, OfLinesBothListsCount) {
  const std::string lines =
      "/NODE\n        21                 5.0                 0.0                 9.0\n"
      "        22                 5.0                 1.0                 9.0\n"
      "/PROP/TRUSS/7\nbar\n                 1.0\n/PART/7\nbar\n         7         1         0\n"
      "/TRUSS/7\n         9        21        22\n/LINE/SEG/3\nbar\n         1        21        "
      "22\n";
  const Linted run = lint_geometry(lines + "@/INTER/TYPE11/1 line_IDs=3 Gapmin=1\n");
  ASSERT_EQ(run.count(RuleId::DK310), 1u) << run.list();
  EXPECT_EQ(run.find(RuleId::DK310)->message,
            "/INTER/TYPE11 1: Gapmin = 1 (from the card) is more than half of edge 21 22 (element "
            "9 of part 7), which is 1 long; this is so at 1 secondary edge of 1");
  EXPECT_EQ(lint_geometry(lines + "@/INTER/TYPE11/1 line_IDs=3 Gapmin=6\n").count(RuleId::DK310),
            2u);
}

TEST(ShortSides, AreMeasuredAgainstTheGapThere) {
  // Igap 1: the short sides belong to a thin shell, whose own gaps are small. The other side is
  // thin as well: no finding, though the largest gap of the interface exceeds half the side.
  const std::string mesh =
      "/NODE\n        21                30.0                 0.0                 0.0\n"
      "        22                32.0                 0.0                 0.0\n"
      "        23                32.0                10.0                 0.0\n"
      "        24                30.0                10.0                 0.0\n"
      "        31                30.0                 0.0                 9.0\n"
      "/PROP/SHELL/9\nthin\n         0\n\n         3                           0.5\n"
      "/PART/9\nthin\n         9         1         0\n"
      "/SHELL/9\n         9        21        22        23        24\n"
      "/SURF/PART/9\nall\n         1         9\n/GRNOD/NODE/9\nfree\n        31\n";
  const Linted run =
      lint_geometry(mesh + "@/INTER/TYPE7/1 surf_IDm=9 grnd_IDs=9 Igap=1 Gapmin=0.1\n");
  EXPECT_FALSE(run.fires(RuleId::DK310)) << run.list();
  EXPECT_TRUE(lint_geometry(mesh + "@/INTER/TYPE7/1 surf_IDm=9 grnd_IDs=9 Igap=1 Gapmin=1.25\n")
                  .fires(RuleId::DK310));
}

TEST(CrossedElements, OneFindingPerTwoPartsHoweverManyInterfacesHaveThem) {
  const Linted run = lint_geometry(
      "/NODE\n        21                 5.0                 2.0                -1.0\n"
      "        22                 5.0                 8.0                -1.0\n"
      "        23                 5.0                 5.0                 2.5\n"
      "/SH3N/2\n         9        21        22        23\n@/INTER/TYPE7/1 Gapmin=0.1\n"
      "@/INTER/TYPE7/2 Gapmin=0.2\n"
      "@/INTER/TYPE19/3 surf_IDs=2 surf_IDm=1 Gapmin=0.1\n");
  ASSERT_EQ(run.count(RuleId::DK328), 1u) << run.list();
  EXPECT_EQ(run.find(RuleId::DK328)->message,
            "/INTER/TYPE7 1: elements of part 1 and part 2 pass through each other in 2 places; "
            "edge 21 23 goes through 1 2 3 4");
}

TEST(GeometryRules, SameFindingsForAnyNumberOfThreads) {
  const std::string_view text = "@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1 Gapmin=6 Inacti=6\n";
  EXPECT_EQ(lint_geometry(text, {}, with_threads(1)).list(),
            lint_geometry(text, {}, with_threads(2)).list());
}

std::vector<std::string> not_checked(const Linted& run) {
  std::vector<std::string> out;
  for (const NotChecked& n : run.result.not_checked) out.push_back(n.what);
  return out;
}

TEST(QuickLook, SaysThatItLeavesOutALargeModel) {
  const std::string_view text = "@/INTER/TYPE7/1 Gapmin=4\n";
  const Linted small = lint_geometry(text, {.quick = QuickLook{}});
  EXPECT_TRUE(small.fires(RuleId::DK301)) << small.list();
  const Linted large = lint_geometry(text, {.quick = QuickLook{.items = 10}});
  EXPECT_FALSE(large.fires(RuleId::DK301)) << large.list();
  EXPECT_EQ(not_checked(large).front(), geometry_rules);
  EXPECT_EQ(not_checked(small).size() + 1, not_checked(large).size());
}

TEST(QuickLook, SaysThatItLeavesOutAContactWithManyPairs) {
  const std::string_view text = "@/INTER/TYPE7/1 Gapmin=4\n";
  const Linted run = lint_geometry(text, {.quick = QuickLook{.pair_bytes = 1}});
  EXPECT_FALSE(run.fires(RuleId::DK390)) << run.list();
  EXPECT_EQ(not_checked(run).front(), "/INTER/TYPE7 1: penetrations and forces");
  LoadOptions how;
  how.read.limits.pair_bytes = 1;
  EXPECT_TRUE(lint_geometry(text, {}, how).fires(RuleId::DK390)) << "where all is asked for";
}

TEST(QuickLook, NeedsNoContactInADeckWithoutAny) {
  const Linted run = lint_geometry("@bare\n", {.quick = QuickLook{.items = 0}});
  EXPECT_NE(not_checked(run).front(), geometry_rules);
}

TEST(GeometryRules, CanBeSuppressedLikeAnyOther) {
  const Linted run =
      lint_geometry("# decklint: ignore[DK301] reason=known\n@/INTER/TYPE7/1 Gapmin=4 Inacti=6\n");
  EXPECT_FALSE(run.fires(RuleId::DK301));
  EXPECT_GE(run.result.suppressed, 1u);
}

}  // namespace
}  // namespace deck::test
