// Fixes compared: scores and the best one.
#include <gtest/gtest.h>

#include "deck/edit.hpp"

namespace deck {
namespace {

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
  return {s.solved, s.left, s.not_treated, s.treated_already};
}

TEST(FixScores, CountPairsThatAreSolvedLeftAndNotTreated) {
  PenetrationFix fix = fix_of("move-nodes", {{1, 7, "", pairs(10), pairs(3), {}},
                                             {2, 7, "", pairs(6), pairs(5), {}},
                                             {3, 7, "", pairs(2), pairs(4), {}}});
  EXPECT_EQ(figures(score_of(fix)), (std::array<std::uint64_t, 4>{8, 12, 0, 0}));
  fix.refused = {{2, {9}, 0.5, "held", 0}};
  EXPECT_EQ(figures(score_of(fix)), (std::array<std::uint64_t, 4>{8, 7, 5, 0}));
  fix.ties = {{8, "", 1, lost(5), lost(2), 0, {}, {}}, {9, "", 1, lost(3), lost(4), 0, {}, {}}};
  EXPECT_EQ(figures(score_of(fix)), (std::array<std::uint64_t, 4>{11, 7, 11, 0}));
}

TEST(FixScores, OfFlagsNameThePairsThatTheSolverTreatsAlready) {
  for (const char* strategy : {"inacti", "fpenmax"})
    EXPECT_EQ(figures(score_of(fix_of(strategy, {{1, 7, "", pairs(10, 8), pairs(10, 1), {}}}))),
              (std::array<std::uint64_t, 4>{7, 1, 0, 2}));
  EXPECT_EQ(figures(score_of(fix_of("tie", {{1, 7, "", pairs(10, 8), pairs(10, 1), {}}}))),
            (std::array<std::uint64_t, 4>{0, 10, 0, 0}));
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

}  // namespace
}  // namespace deck
