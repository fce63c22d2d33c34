// Contact decisions of whole decks: where the solver's arithmetic and exact arithmetic do not
// agree, what is listed and what the solver does all the same.
#include <gtest/gtest.h>

#include "contact/exactness.hpp"

namespace deck::test {
namespace {

SceneOptions with(Accuracy accuracy) {
  SceneOptions o;
  o.accuracy = accuracy;
  return o;
}

// A node above a tilted quad with unit normal (2, -2, 1)/3.
SmallDeck tilted(double side, double height, const char* card) {
  SmallDeck d = tilted_sheet(side, 2);
  d.node(101, 7 * side + 5 + 2 * height, 7 - 2 * height, -7 + height);
  return d.segments("/SURF/SEG/1", {{1, 2, 3, 4}}).group("/GRNOD/NODE/2", {101}).add(card);
}

TEST(Decisions, ATouchThatOnlyRoundOffTurnsIntoContactIsMarked) {
  const SmallDeck d = tilted(17, 1, "@/INTER/TYPE7/1 Gapmin=3 Inacti=6");
  const Built b(d);
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 1u);
  EXPECT_FALSE(c.penetrations[0].in_contact);
  EXPECT_LT(c.penetrations[0].depth, 1e-14);
  EXPECT_EQ(c.penetrations[0].action, PenetrationAction::gap_reduced);
  const DecisionReport& r = b.scene.decisions;
  EXPECT_EQ(r.fallback, 1u);
  EXPECT_EQ(r.contact_differs, 1u);
  ASSERT_EQ(r.differences.size(), 1u);
  EXPECT_FALSE(r.differences[0].exact);
  EXPECT_EQ(r.differences[0].exact_distance, 3.0);
  EXPECT_LT(r.differences[0].solver_distance, 3.0);
  EXPECT_EQ(r.differences[0].action, PenetrationAction::gap_reduced);
}

TEST(Decisions, EachAccuracyKeepsItsPromise) {
  const SmallDeck d = tilted(17, 1, "@/INTER/TYPE7/1 Gapmin=3 Inacti=6");
  const Built reference(d, with(Accuracy::reference)), exact(d, with(Accuracy::exact));
  ASSERT_EQ(reference.contact().penetrations.size(), 1u);
  EXPECT_TRUE(reference.contact().penetrations[0].in_contact);
  EXPECT_EQ(reference.scene.decisions.differences.size(), 0u);
  EXPECT_EQ(exact.contact().penetrations.size(), 0u);
  EXPECT_EQ(exact.scene.decisions.contact_differs, 1u);
  EXPECT_EQ(exact.scene.decisions.exact, 1u);
}

// The reference takes the wrong edge of a triangle without area: 30.1 instead of 15.9.
TEST(Decisions, AContactThatTheSolverMissesIsFound) {
  SmallDeck d;
  d.node(1, -2, 1, 0).node(2, -15, -11, 0).node(3, 11, 13, 0).node(101, 3, -16, 0);
  d.shell_part(1, 2).shell3(1, 1, 1, 2, 3);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 3}}).group("/GRNOD/NODE/2", {101});
  d.add("@/INTER/TYPE7/1 Gapmin=20 Inacti=1");
  const Built b(d);
  const Contact& c = b.contact();
  ASSERT_EQ(c.penetrations.size(), 1u);
  EXPECT_NEAR(c.penetrations[0].distance, 15.883, 1e-3);
  EXPECT_NEAR(c.penetrations[0].depth, 4.117, 1e-3);
  EXPECT_EQ(c.penetrations[0].action, PenetrationAction::none);
  EXPECT_FALSE(c.secondary[0].off);
  ASSERT_EQ(b.scene.decisions.differences.size(), 1u);
  EXPECT_TRUE(b.scene.decisions.differences[0].exact);
  EXPECT_GT(b.scene.decisions.differences[0].solver_distance, 30.0);
  EXPECT_EQ(Built(d, with(Accuracy::reference)).contact().penetrations.size(), 0u);
}

TEST(Decisions, ANodeExactlyOnASegmentThatTheSolverSeesBesideIt) {
  const Built b(tilted(11, 0, "@/INTER/TYPE7/1 Gapmin=1"));
  const DecisionReport& r = b.scene.decisions;
  ASSERT_EQ(b.contact().penetrations.size(), 1u);
  // The solver does not stop: its distance is not 0.
  EXPECT_FALSE(b.contact().penetrations[0].on_surface);
  EXPECT_EQ(r.surface_differs, 1u);
  ASSERT_EQ(r.differences.size(), 1u);
  EXPECT_TRUE(r.differences[0].surface && r.differences[0].exact);
  EXPECT_EQ(r.differences[0].exact_distance, 0.0);
  EXPECT_TRUE(b.contact().penetrations[0].in_contact);
  EXPECT_EQ(r.contact_differs, 0u);
}

}  // namespace
}  // namespace deck::test
