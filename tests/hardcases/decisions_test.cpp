// Contact decisions of whole decks where the solver's arithmetic and exact arithmetic do not agree:
// what is listed and what the solver does all the same. The measurement behind `deck accuracy`.
#include <gtest/gtest.h>

#include <tuple>

#include "accuracy/shared/choice.hpp"
#include "contact/exactness.hpp"
#include "contact/shared/exact.hpp"
#include "contact/small_deck.hpp"

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

TEST(Decisions, ATouchThatOnlyRoundOffTurnsIntoContactIsWhatEachAccuracySays) {
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
  const Built reference(d, with(Accuracy::reference)), exact(d, with(Accuracy::exact));
  ASSERT_EQ(reference.contact().penetrations.size(), 1u);
  EXPECT_TRUE(reference.contact().penetrations[0].in_contact);
  EXPECT_EQ(reference.scene.decisions.differences.size(), 0u);
  EXPECT_EQ(exact.contact().penetrations.size(), 0u);
  EXPECT_EQ(exact.scene.decisions.contact_differs, 1u);
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

const std::vector<AccuracyChoice>& hard() {
  static const std::vector<AccuracyChoice> choices = [] {
    HardCaseOptions o;
    o.samples = 30, o.repeats = 1, o.rewritten_limit = 300;
    return measure_hard_cases(o);
  }();
  return choices;
}

TEST(Accuracy, RobustAndExactNeverDecideWronglyWhateverWayAPairIsWritten) {
  ASSERT_EQ(hard().size(), 4u);
  for (const AccuracyChoice& c : hard()) {
    const bool sure = c.accuracy == Accuracy::robust || c.accuracy == Accuracy::exact;
    EXPECT_EQ(c.hard.pairs, 37u * 30u);
    EXPECT_GT(c.hard.ns_per_pair, 0.0);
    EXPECT_EQ(c.hard.wrong == 0, sure) << to_string(c.accuracy);
    EXPECT_EQ(c.hard.other_answer == 0, sure) << to_string(c.accuracy);
    EXPECT_EQ(c.hard.kinds_never_wrong() == c.hard.kinds.size(), sure);
  }
}

// The solver's arithmetic sees this node within its gap of 3; its distance is 3.
TEST(Accuracy, WrongPairsOfADeckAreNamed) {
  test::SmallDeck d;
  d.node(1, 119, 3, -5).node(2, 136, 37, 29).node(3, 170, 54, -5).node(4, 153, 20, -39);
  d.node(101, 126, 5, -6).shell_part(1, 2).shell(1, 1, 1, 2, 3, 4);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}}).group("/GRNOD/NODE/2", {101});
  d.add("@/INTER/TYPE7/1 Gapmin=3 Inacti=6");
  std::vector<AccuracyChoice> choices = hard();
  const GapsRun run = [&](Accuracy accuracy, const std::function<bool()>& exact_over,
                          const std::function<void(const Scene&)>& look) {
    SceneOptions options;
    options.accuracy = accuracy;
    options.exact_over = exact_over;
    look(test::Built(d, options).scene);
  };
  const DeckPicture picture = measure_deck(run, {3, 0, 0}, choices);
  for (const AccuracyChoice& c : choices) {
    ASSERT_TRUE(c.deck) << to_string(c.accuracy);
    if (c.accuracy == Accuracy::fast) continue;
    EXPECT_EQ(c.deck->wrong.size(), c.accuracy == Accuracy::reference ? 1u : 0u);
  }
  const WrongPair& p = choices[0].deck->wrong.at(0);
  EXPECT_EQ(p.secondary, std::vector<std::int64_t>{101});
  EXPECT_EQ(p.main, (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(p.exact, 3.0);
  EXPECT_LT(p.computed, 3.0);
  EXPECT_FALSE(p.in_contact);
  EXPECT_EQ(picture.surface.size(), 1u);
  EXPECT_FALSE(picture.nearest);  // exactly, no pair is in contact
  EXPECT_FALSE(choices[3].deck->extrapolated);
  // Without time for exact arithmetic the answers are those of robust, and so the same.
  measure_deck(run, {3, 0, 0, 0}, choices);
  EXPECT_TRUE(choices[3].deck->extrapolated);
  EXPECT_EQ(choices[0].deck->wrong.size(), 1u);
}

TEST(Accuracy, ThisBuildAnswersAsTheRecordedOnes) {
  EXPECT_EQ(answer_digest().own, answer_digest().recorded);
}

TEST(AccuracyMotion, TheReferenceFormulaJumpsAndTheExactOneDoesNot) {
  const HardMotion m = hard_motion();
  ASSERT_EQ(m.lines.size(), 4u);
  const auto& [reference, fast, robust, exact] =
      std::tie(m.lines[0], m.lines[1], m.lines[2], m.lines[3]);
  EXPECT_EQ(reference.jumps, std::vector<std::size_t>{47});
  EXPECT_EQ(robust.jumps, (std::vector<std::size_t>{47, 77}));
  EXPECT_TRUE(fast.jumps.empty() && exact.jumps.empty());
  for (std::size_t k = 0; k <= 100; ++k) {
    const Point3<double> p = m.from + (static_cast<double>(k) / 100.0) * (m.to - m.from);
    const std::array corners{m.corners[0], m.corners[1], m.corners[2], m.corners[2]};
    const double distance = exact_closest_on_segment(p, corners, true).distance,
                 want = std::max(0.0, m.gap - distance);
    EXPECT_NEAR(exact.depth[k], want, 1e-15) << k;
    const double force = want > 0.0 ? 0.5 * m.gap * want / distance : 0.0;
    EXPECT_NEAR(exact.force[k], force, 1e-12 * force) << k;
    EXPECT_NEAR(fast.force[k], force, 1e-12 * force) << k;
    // Whether there is contact is decided exactly; the figures are the reference formula's.
    EXPECT_EQ(robust.depth[k] > 0.0, exact.depth[k] > 0.0) << k;
    EXPECT_EQ(robust.depth[k], (reference.depth[k] > 0 ? reference : exact).depth[k]) << k;
  }
  EXPECT_LT(reference.force[47], 0.1 * exact.force[47]);
}

}  // namespace
}  // namespace deck::test
