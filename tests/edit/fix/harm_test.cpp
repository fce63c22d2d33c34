// What a fix may not do: StateBefore sees deeper and new penetrations, ties that come and ties that
// go.
#include "edit/fix/harm.hpp"

#include <gtest/gtest.h>

#include "edit/fix/common.hpp"
#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

using detail::Harm;
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

std::vector<Harm> harm(double before, double after, const FixOptions& options = {}) {
  const Built a(node_over_plate(before)), b(node_over_plate(after));
  return StateBefore(a.scene, options).harm(b.scene);
}

TEST(Harm, WhatIsDeeperOrNewIsHarm) {
  ASSERT_EQ(harm(0.8, 0.7).size(), 1u);
  EXPECT_NEAR(harm(0.8, 0.7)[0].before, 0.2, 1e-12);
  EXPECT_NEAR(harm(0.8, 0.7)[0].after, 0.3, 1e-12);
  ASSERT_EQ(harm(1.5, 0.9).size(), 1u);
  EXPECT_EQ(harm(1.5, 0.9)[0].before, 0);
  EXPECT_TRUE(harm(0.8, 0.9).empty());
  EXPECT_TRUE(harm(0.8, 1.5).empty());
}

TEST(Harm, ATieMayNotComeNorGoButItsDepthIsFree) {
  ASSERT_EQ(harm(0.4, 0.6).size(), 1u) << "off its tie, though out of the contact";
  EXPECT_TRUE(harm(0.4, 0.6)[0].tie);
  const auto came = harm(0.6, 0.4);
  ASSERT_EQ(came.size(), 2u);
  EXPECT_TRUE(came[0].tie) << "ties come first";
  EXPECT_FALSE(came[1].tie) << "and the contact is deeper";
  EXPECT_TRUE(harm(0.3, 0.4).empty());
}

TEST(Harm, TreatedTiesArePenetrationsLikeOthers) {
  FixOptions options;
  options.ties = true;
  EXPECT_TRUE(harm(0.4, 0.6, options).empty());
  EXPECT_EQ(harm(0.4, 0.3, options).size(), 2u);
}

TEST(Harm, AFixThatHarmsIsTakenBackAndSaysWhy) {
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

}  // namespace
}  // namespace deck::test
