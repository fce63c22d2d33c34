// The front door: a loaded deck owns what it is made of.
#include <gtest/gtest.h>

#include "deck/deck.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

std::string sample(const char* name) { return (source_dir() / "samples" / name).string(); }

TEST(Load, GivesEffectiveValues) {
  const auto loaded = load(sample("too_close_0000.rad"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->interfaces().type7.size(), 1u);
  EXPECT_EQ(loaded->interfaces().type7.front().Gapmin.value, 1.25);
  EXPECT_FALSE(waits_for_geometry(loaded->interfaces()));
}

TEST(Load, MovingMovesNoneOfTheParts) {
  auto first = load(sample("too_close_0000.rad"));
  ASSERT_TRUE(first) << first.error().message;
  const InterBase* inter = first->interfaces().ordered.front();
  const Model* model = &first->model();
  LoadedDeck moved = std::move(*first);
  EXPECT_EQ(moved.interfaces().ordered.front(), inter);
  EXPECT_EQ(&moved.model(), model);
  EXPECT_EQ(moved.model().deck, &moved.deck());
  EXPECT_EQ(
      &moved.deck().blocks[static_cast<std::size_t>(inter->block - moved.deck().blocks.data())],
      inter->block);
  auto second = load(sample("clean_plates_0000.rad"));
  ASSERT_TRUE(second) << second.error().message;
  moved = std::move(*second);
  Diagnostics findings;
  const Scene scene = moved.scene(findings);
  EXPECT_EQ(scene.model, &moved.model());
  EXPECT_FALSE(scene.contacts.empty());
}

TEST(Load, AMissingDeckIsAnErrorWithItsName) {
  const auto loaded = load("/nowhere/none_0000.rad");
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().message.find("none_0000.rad"), std::string::npos);
}

}  // namespace
}  // namespace deck::test
