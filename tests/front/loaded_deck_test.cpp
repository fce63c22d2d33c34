// The front door: a loaded deck owns what it is made of.
#include <gtest/gtest.h>

#include <filesystem>

#include "deck/deck.hpp"
#include "deck/model/selection.hpp"
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

TEST(Load, LeavesTheGapsOfTheMeshOpenWhereGeometryIsNotAskedFor) {
  std::string waiting;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "samples")) {
    LoadOptions options;
    options.geometry = false;
    const auto open = load(entry.path().string(), options);
    if (!open || !waits_for_geometry(open->interfaces())) continue;
    waiting = entry.path().filename().string();
    const auto resolved = load(entry.path().string());
    ASSERT_TRUE(resolved);
    EXPECT_FALSE(waits_for_geometry(resolved->interfaces())) << waiting;
  }
  EXPECT_FALSE(waiting.empty()) << "no sample has a gap that follows from its mesh";
}

TEST(Load, TheLimitsHoldForSelections) {
  LoadOptions options;
  options.read.limits.selection_bytes = 1;
  auto loaded = load(sample("too_close_0000.rad"), options);
  ASSERT_TRUE(loaded) << loaded.error().message;
  loaded->model().selections->resolve_all();
  EXPECT_FALSE(loaded->model().selections->complete());
}

TEST(Load, AMissingDeckIsAnErrorWithItsName) {
  const auto loaded = load("/nowhere/none_0000.rad");
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().message.find("none_0000.rad"), std::string::npos);
}

}  // namespace
}  // namespace deck::test
