// What a fix may not do: StateBefore sees deeper and new penetrations, ties that come and ties that
// go. Fixes compared: scores and the best one.
#include <gtest/gtest.h>

#include "deck/edit.hpp"
#include "edit/fix/fix_scene.hpp"
#include "edit/fix/harm.hpp"
#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

using detail::HarmedPair;
using detail::StateBefore;
using detail::verify_harmless;

/// One node at `height` over a plate, tied within 0.5 and in contact within 1.
SmallDeck node_over_plate(double height) {
  SmallDeck d;
  d.shell_part(1, 1.0);
  add_sheet(d, 1, 1, 1, 1, [](int i, int j) { return P{4.0 * i, 4.0 * j, 0}; });
  d.node(100, 2.0, 2.0, height).group("/GRNOD/NODE/1", {100}).group("/SURF/PART/1", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0");
  return d.add("@/INTER/TYPE10/2 grnd_IDs=1 surf_IDm=1 Gap=0.5");
}

std::vector<HarmedPair> harm(double before, double after, const FixOptions& options = {}) {
  const Built a(node_over_plate(before)), b(node_over_plate(after));
  return StateBefore(a.scene, options).harm(b.scene);
}

TEST(HarmedPair, WhatIsDeeperOrNewIsHarm) {
  ASSERT_EQ(harm(0.8, 0.7).size(), 1u);
  EXPECT_NEAR(harm(0.8, 0.7)[0].before, 0.2, 1e-12);
  EXPECT_NEAR(harm(0.8, 0.7)[0].after, 0.3, 1e-12);
  ASSERT_EQ(harm(1.5, 0.9).size(), 1u);
  EXPECT_EQ(harm(1.5, 0.9)[0].before, 0);
  EXPECT_TRUE(harm(0.8, 0.9).empty());
  EXPECT_TRUE(harm(0.8, 1.5).empty());
}

TEST(HarmedPair, ATieMayNotComeNorGoButItsDepthIsFree) {
  ASSERT_EQ(harm(0.4, 0.6).size(), 1u) << "off its tie, though out of the contact";
  EXPECT_TRUE(harm(0.4, 0.6)[0].tie);
  const auto came = harm(0.6, 0.4);
  ASSERT_EQ(came.size(), 2u);
  EXPECT_TRUE(came[0].tie) << "ties come first";
  EXPECT_FALSE(came[1].tie) << "and the contact is deeper";
  EXPECT_TRUE(harm(0.3, 0.4).empty());
}

TEST(HarmedPair, TreatedTiesArePenetrationsLikeOthers) {
  FixOptions options;
  options.ties = true;
  EXPECT_TRUE(harm(0.4, 0.6, options).empty());
  EXPECT_EQ(harm(0.4, 0.3, options).size(), 2u);
}

TEST(HarmedPair, AFixThatHarmsIsTakenBackAndSaysWhy) {
  const Built a(node_over_plate(0.4)), b(node_over_plate(0.6));
  PenetrationFix fix;
  fix.rewrite.edits.push_back({});
  fix.complete = true;
  verify_harmless(fix, a.interfaces, {}, a.scene, b.scene);
  EXPECT_TRUE(fix.rewrite.edits.empty());
  EXPECT_FALSE(fix.complete);
  ASSERT_EQ(fix.refused.size(), 1u);
  EXPECT_EQ(fix.refused[0].reason,
            "nothing done: with the change interface 2, node 100 would come off its tie");
  PenetrationFix good;
  good.rewrite.edits.push_back({});
  verify_harmless(good, a.interfaces, {}, a.scene, a.scene);
  EXPECT_EQ(good.rewrite.edits.size(), 1u);
  EXPECT_EQ(good.tied_pairs, 1u);
}

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

std::array<std::uint64_t, 3> figures(const FixScore& s) {
  return {s.solved, s.not_treated, s.treated_already};
}

TEST(FixScores, CountPairsThatAreSolvedAndNotTreated) {
  PenetrationFix fix = fix_of("move-nodes", {{1, 7, "", pairs(10), pairs(3), {}},
                                             {2, 7, "", pairs(6), pairs(5), {}},
                                             {3, 7, "", pairs(2), pairs(4), {}}});
  EXPECT_EQ(figures(score_of(fix)), (std::array<std::uint64_t, 3>{8, 12, 0}));
  fix.ties = {{8, "", 1, lost(5), lost(2), 0, {}, {}}, {9, "", 1, lost(3), lost(4), 0, {}, {}}};
  EXPECT_EQ(figures(score_of(fix)), (std::array<std::uint64_t, 3>{11, 18, 0}));
}

TEST(FixScores, OfFlagsNameThePairsThatTheSolverTreatsAlready) {
  for (const char* strategy : {"inacti", "fpenmax"})
    EXPECT_EQ(figures(score_of(fix_of(strategy, {{1, 7, "", pairs(10, 8), pairs(10, 1), {}}}))),
              (std::array<std::uint64_t, 3>{7, 1, 2}));
  EXPECT_EQ(figures(score_of(fix_of("tie", {{1, 7, "", pairs(10, 8), pairs(10, 1), {}}}))),
            (std::array<std::uint64_t, 3>{0, 10, 0}));
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
}  // namespace deck::test
