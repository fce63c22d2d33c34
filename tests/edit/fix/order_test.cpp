// Fixes compared and put together: scores, the best one, and one report of several, from figures
// that are written out here.
#include <gtest/gtest.h>

#include "deck/edit/fix.hpp"

namespace deck {
namespace {

using Ids = std::vector<std::int64_t>;

FixCount pairs(std::uint64_t n, std::uint64_t untreated = 0) { return {n, n, untreated, 0, 0.5}; }

TieCounts lost(std::size_t n) {
  TieCounts out;
  out.nodes = 20;
  out.not_found = n > 1 ? n - 1 : n;
  out.dropped = n > 1 ? 1 : 0;
  return out;
}

PenetrationFix fix_of(const char* strategy, std::vector<FixedInterface> interfaces) {
  PenetrationFix out;
  out.strategy = strategy;
  out.interfaces = std::move(interfaces);
  return out;
}

std::array<std::uint64_t, 4> figures(const FixScore& s) {
  return {s.solved, s.left, s.not_treated, s.all()};
}

TEST(FixScores, CountPairsThatAreSolvedLeftAndNotTreated) {
  PenetrationFix fix = fix_of("move-nodes", {{1, 7, "", pairs(10), pairs(3), {}},
                                             {2, 7, "", pairs(6), pairs(5), {}},
                                             {3, 7, "", pairs(2), pairs(4), {}}});
  EXPECT_EQ(figures(score_of(fix)), (std::array<std::uint64_t, 4>{8, 12, 0, 20}));
  fix.refused = {{2, {9}, 0.5, "held", 0}};
  EXPECT_EQ(figures(score_of(fix)), (std::array<std::uint64_t, 4>{8, 7, 5, 20}));
  fix.ties = {{8, "", 1, lost(5), lost(2), 0, {}, {}}, {9, "", 1, lost(3), lost(4), 0, {}, {}}};
  EXPECT_EQ(figures(score_of(fix)), (std::array<std::uint64_t, 4>{11, 7, 11, 29}));
}

TEST(FixScores, OfFlagsCountPairsWithoutTreatment) {
  for (const char* strategy : {"inacti", "fpenmax"})
    EXPECT_EQ(figures(score_of(fix_of(strategy, {{1, 7, "", pairs(10, 8), pairs(10, 1), {}}}))),
              (std::array<std::uint64_t, 4>{7, 1, 0, 8}));
  EXPECT_EQ(figures(score_of(fix_of("tie", {{1, 7, "", pairs(10, 8), pairs(10, 1), {}}}))),
            (std::array<std::uint64_t, 4>{0, 10, 0, 10}));
}

TEST(FixScores, TheBestLeavesLeastAndOfEqualsTheFirst) {
  const auto leaves = [](const char* name, std::uint64_t n) {
    return fix_of(name, {{1, 7, "", pairs(10), pairs(n), {}}});
  };
  std::vector<PenetrationFix> all{leaves("a", 4), leaves("b", 3), leaves("c", 3), leaves("d", 9)};
  EXPECT_EQ(best_of(all), &all[1]);
  all[1] = leaves("b", 10);
  EXPECT_EQ(best_of(all), &all[2]);
  EXPECT_EQ(best_of({leaves("a", 10)}), nullptr) << "it solves nothing";
  std::vector<PenetrationFix> ties{leaves("tie", 0), leaves("a", 9)};
  EXPECT_EQ(best_of(ties), &ties[1]) << "ties are asked for by themselves";
  EXPECT_EQ(best_of({}), nullptr);
}

TEST(FixReports, OfNoProposalTakenIsTheDeckAsItIs) {
  PenetrationFix gap =
      fix_of("reduce-gap", {{2, 7, "two", pairs(6), pairs(1), {{"Gapmin", "", "", 1, 0}}},
                            {1, 7, "one", pairs(3), pairs(0), {}}});
  PenetrationFix move = fix_of("move-nodes", {{2, 7, "again", pairs(7), pairs(0), {}},
                                              {3, 7, "three", pairs(4), pairs(0), {}}});
  PenetrationFix tie = fix_of("tie", {{4, 7, "", pairs(9), pairs(9), {}}});
  gap.crossings_before = 5;
  move.crossings_before = 8;
  gap.tied_pairs = 1;
  gap.tied_nodes = 2;
  move.tied_pairs = 11;
  move.tied_nodes = 12;
  tie.tied_pairs = tie.tied_nodes = 99;
  tie.ties = {{21, "tie", 1.5, lost(5), lost(2), 0.5, {{1, {}, 0}}, {{"dsearch", "", "", 0, 1}}}};
  const PenetrationFix now = unchanged({gap, move, tie});
  ASSERT_EQ(now.interfaces.size(), 3u);
  Ids ids;
  for (const FixedInterface& i : now.interfaces) {
    ids.push_back(i.id);
    EXPECT_EQ(i.before.pairs, i.after.pairs);
    EXPECT_TRUE(i.changes.empty());
  }
  EXPECT_EQ(ids, (Ids{1, 2, 3}));
  EXPECT_EQ(now.interfaces[1].title, "two") << "of the first that lists it";
  EXPECT_EQ(now.interfaces[1].before.pairs, 6u);
  EXPECT_EQ(now.crossings_before, 8u);
  EXPECT_EQ(now.crossings_after, 8u);
  EXPECT_EQ(now.tied_pairs, 11u);
  EXPECT_EQ(now.tied_nodes, 12u);
  ASSERT_EQ(now.ties.size(), 1u);
  EXPECT_EQ(now.ties[0].id, 21);
  EXPECT_EQ(now.ties[0].title, "tie");
  EXPECT_EQ(now.ties[0].reach, 1.5);
  EXPECT_EQ(now.ties[0].after.lost(), 5u);
  EXPECT_TRUE(now.ties[0].nodes.empty() && now.ties[0].changes.empty());
  EXPECT_FALSE(now.complete);
  PenetrationFix none = fix_of("reduce-gap", {});
  EXPECT_TRUE(unchanged({none, none}).complete);
  none.refused = {{1, {}, 0, "too many", 0}};
  EXPECT_FALSE(unchanged({fix_of("inacti", {}), none}).complete);
  none.refused.clear();
  none.crossings_before = 1;
  EXPECT_FALSE(unchanged({none}).complete);
  none.crossings_before = 0;
  none.ties = tie.ties;
  EXPECT_FALSE(unchanged({none}).complete);
}

TEST(FixReports, OfSeveralBeginWithTheFirstAndEndWithTheLast) {
  PenetrationFix gap =
      fix_of("reduce-gap", {{2, 7, "two", pairs(6), pairs(4), {{"Gapmin", "2", "1", 2, 1}}},
                            {3, 7, "three", pairs(5), pairs(2), {}}});
  PenetrationFix move =
      fix_of("move-nodes", {{1, 7, "one", pairs(9), pairs(8), {}},
                            {2, 7, "two", pairs(4), pairs(1), {{"Igap", "", "2", 1, 2}}}});
  PenetrationFix tie = fix_of("tie", {{4, 7, "", pairs(9), pairs(9), {}}});
  gap.iterations = 2;
  move.iterations = 5;
  gap.crossings_before = 7;
  gap.crossings_after = 99;
  move.crossings_before = 6;
  move.crossings_after = 3;
  move.moved = {{51, 1, {1, 0, 0}, 1}};
  gap.tied_pairs = 11;
  gap.tied_nodes = 12;
  move.tied_pairs = 13;
  gap.refused = {{1, {1}, 0, "first", 0}};
  move.refused = {{1, {2}, 0, "second", 0}};
  tie.refused = {{21, {3}, 0, "of a tie", 0}};
  gap.actions.resize(3);
  move.actions.resize(1);
  tie.ties = {{21, "tie", 1.5, lost(5), lost(2), 0.5, {}, {}}};
  gap.complete = false;
  move.complete = tie.complete = true;
  const PenetrationFix all = combined({gap, move, tie});
  EXPECT_EQ(all.strategy, "reduce-gap,move-nodes,tie");
  EXPECT_EQ(all.iterations, 7);
  EXPECT_EQ(all.crossings_before, 7u);
  EXPECT_EQ(all.crossings_after, 3u) << "only moves change them";
  ASSERT_EQ(all.moved.size(), 1u);
  ASSERT_EQ(all.interfaces.size(), 3u);
  EXPECT_EQ(all.interfaces[0].id, 1);
  EXPECT_EQ(all.interfaces[1].before.pairs, 6u);
  EXPECT_EQ(all.interfaces[1].after.pairs, 1u);
  ASSERT_EQ(all.interfaces[1].changes.size(), 2u);
  EXPECT_EQ(all.interfaces[1].changes[1].field, "Igap");
  EXPECT_EQ(all.interfaces[2].before.pairs, 5u);
  EXPECT_EQ(all.interfaces[2].after.pairs, 0u) << "the second step does not list it any more";
  EXPECT_EQ(all.tied_pairs, 11u);
  EXPECT_EQ(all.tied_nodes, 12u);
  EXPECT_EQ(all.actions.size(), 1u);
  ASSERT_EQ(all.refused.size(), 2u);
  EXPECT_EQ(all.refused[0].reason, "second");
  EXPECT_EQ(all.refused[1].reason, "of a tie");
  ASSERT_EQ(all.ties.size(), 1u);
  EXPECT_TRUE(all.complete) << "what the first left, the second has solved";
  move.complete = false;
  EXPECT_FALSE(combined({gap, move, tie}).complete);
  move.complete = true;
  tie.complete = false;
  EXPECT_FALSE(combined({gap, move, tie}).complete);
  EXPECT_EQ(combined({tie}).interfaces.size(), 0u);
}

}  // namespace
}  // namespace deck
