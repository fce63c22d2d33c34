// Tests of moving a whole part.
#include "edit/shared/depenetrate.hpp"

#include "edit/fix/nodes/ways_out.hpp"
#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

using detail::translations_for;
using detail::WayOut;

PenetrationFix moved(const Built& b, const MoveNodesOptions& options = {}) {
  auto fix = move_part(context_of(b), options);
  EXPECT_TRUE(fix.ok()) << fix.error().message;
  return std::move(*fix);
}

TEST(Translations, AreTheShortestThatFreeAll) {
  const auto one = translations_for({{{0, 0, 1}, 0.35, true}, {{0, 0, 1}, 0.2, true}}, 1, 5);
  ASSERT_FALSE(one.empty());
  EXPECT_EQ(one[0].frees, 2u);
  EXPECT_DOUBLE_EQ(one[0].by.z, 0.35);
  EXPECT_EQ(one[0].by.x, 0);
  // Two walls at a right angle: both needs at once.
  const auto corner = translations_for({{{1, 0, 0}, 0.3, true}, {{0, 1, 0}, 0.4, true}}, 1, 5);
  ASSERT_FALSE(corner.empty());
  EXPECT_EQ(corner[0].frees, 2u);
  EXPECT_DOUBLE_EQ(corner[0].by.x, 0.3);
  EXPECT_DOUBLE_EQ(corner[0].by.y, 0.4);
  // The bound lets one go.
  const auto bounded = translations_for({{{1, 0, 0}, 0.3, true}, {{0, 1, 0}, 0.4, true}}, 0.45, 5);
  ASSERT_FALSE(bounded.empty());
  EXPECT_EQ(bounded[0].frees, 1u);
  EXPECT_LE(norm(bounded[0].by), 0.45);
}

TEST(Translations, NeverGoAgainstANormal) {
  EXPECT_TRUE(translations_for({{{0, 0, 1}, 0.3, true}, {{0, 0, -1}, 0.1, true}}, 1, 5).empty());
  EXPECT_TRUE(translations_for({{{0, 0, 1}, 0.3, true}, {{0, 0, -1}, 0.1, false}}, 1, 5).empty());
  EXPECT_TRUE(translations_for({{{0, 0, 1}, 0.3, false}}, 1, 5).empty());
  EXPECT_TRUE(translations_for({{{0, 0, 1}, 0.3, true}}, 0.2, 5).empty());
}

TEST(MovePart, FreesPlatesAndBlocksByOneTranslation) {
  const std::pair<const char*, bool> cards[] = {
      {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0", true},
      {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=1", true},
      {"@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0", true},
      {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=0.8", false}};
  for (const auto& [card, plates] : cards)
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      const Built before(plates ? two_plates(seed, 0.35 + 0.1 * seed, card)
                                : two_blocks(seed, 0.2 + 0.1 * seed, card));
      ASSERT_FALSE(oracle_penetrations(before).empty());
      const PenetrationFix fix = moved(before);
      const auto after = expect_harmless(before, fix);
      EXPECT_TRUE(oracle_penetrations(*after).empty());
      EXPECT_TRUE(fix.complete);
      ASSERT_FALSE(fix.moved.empty());
      for (const MovedNode& n : fix.moved) {
        EXPECT_EQ(n.part, fix.moved.front().part);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(n.by[k], fix.moved.front().by[k], 1e-9);
      }
      const PenetrationFix second = moved(*after);
      EXPECT_TRUE(second.rewrite.edits.empty());
      EXPECT_TRUE(second.complete);
    }
}

TEST(MovePart, LeavesLockedPartsAndItsBound) {
  const char* card = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0";
  const Built before(two_plates(1, 0.5, card));
  MoveNodesOptions one;
  one.lock = {2};
  EXPECT_EQ(moved(before, one).moved.front().part, 1);
  one.lock = {1};
  EXPECT_EQ(moved(before, one).moved.front().part, 2);
  MoveNodesOptions both;
  both.lock = {1, 2};
  const PenetrationFix held = moved(before, both);
  EXPECT_TRUE(held.rewrite.edits.empty());
  EXPECT_FALSE(held.complete);
  EXPECT_TRUE(says(held, "locked part"));
  MoveNodesOptions near;
  near.most_displacement = 1e-3;
  const PenetrationFix bounded = moved(before, near);
  EXPECT_TRUE(bounded.rewrite.edits.empty());
  EXPECT_TRUE(says(bounded, "within the bound"));
  MoveNodesOptions unknown;
  unknown.lock = {77};
  EXPECT_FALSE(move_part(context_of(before), unknown).ok());
}

TEST(MovePart, KnowsWhatHangsTogether) {
  const Built folded(hairpin(1, "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.7"));
  const PenetrationFix self = moved(folded);
  EXPECT_TRUE(self.rewrite.edits.empty());
  EXPECT_TRUE(says(self, "no translation parts them"));
  const Built tied(two_plates(1, 0.6,
                              "@/INTER/TYPE10/1 grnd_IDs=1 surf_IDm=1 Gap=0.75\n"
                              "@/INTER/TYPE7/2 grnd_IDs=1 surf_IDm=1 Gapmin=0.9"));
  const PenetrationFix fix = moved(tied);
  expect_harmless(tied, fix);
  EXPECT_TRUE(fix.rewrite.edits.empty());
  EXPECT_TRUE(says(fix, "they hang together"));
}

TEST(MovePart, DoesNotPushOnePartIntoTheNext) {
  // Between two others a sheet has no room: nothing is done, or what is done harms nobody.
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const Built before(
        stack_of_sheets(seed, 3, "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0"));
    const PenetrationFix fix = moved(before);
    expect_harmless(before, fix);
  }
}

}  // namespace
}  // namespace deck::test
