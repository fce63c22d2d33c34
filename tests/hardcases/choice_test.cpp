// What each word of --accuracy costs: figures and texts from reports that are written by hand.
#include "accuracy/shared/choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace deck {
namespace {

TEST(SecondsText, HasTwoOrThreeDigitsAndTheUnitThatFits) {
  const std::pair<double, const char*> cases[] = {
      {0.0, "0 ns"},         {240e-9, "240 ns"},  {0.9994e-6, "999 ns"}, {0.9995e-6, "1.0 µs"},
      {1.5e-6, "1.5 µs"},    {9.94e-6, "9.9 µs"}, {0.00995e-3, "10 µs"}, {15e-6, "15 µs"},
      {0.9995e-3, "1.0 ms"}, {1.5e-3, "1.5 ms"},  {0.00995, "10 ms"},    {0.015, "15 ms"},
      {0.0995, "0.10 s"},    {0.15, "0.15 s"},    {0.65, "0.65 s"},      {9.94, "9.94 s"},
      {9.95, "10 s"},        {15.0, "15 s"},      {99.4, "99 s"},        {99.5, "2 min"},
      {170.0, "3 min"},      {3600.0, "60 min"},
  };
  for (const auto& [seconds, text] : cases) EXPECT_EQ(seconds_text(seconds), text) << seconds;
}

TEST(RatioText, HasTwoOrThreeDigits) {
  const std::pair<double, const char*> cases[] = {
      {0.98, "0.98"}, {1.99, "1.99"}, {1.995, "2.0"}, {2.54, "2.5"},
      {9.94, "9.9"},  {9.95, "10"},   {15.0, "15"},   {258.4, "258"},
  };
  for (const auto& [ratio, text] : cases) EXPECT_EQ(ratio_text(ratio), text) << ratio;
}

TEST(ShareText, SaysPercentAndNeverZeroOfSome) {
  const std::tuple<std::uint64_t, std::uint64_t, const char*> cases[] = {
      {0, 5, "0"},
      {5, 0, "0"},
      {3, 7, "43 %"},
      {19, 2000, "1 %"},
      {3, 1000, "0.3 %"},
      {7, 7, "100 %"},
      {1, 10000, "0.01 %"},
      {16, 100000, "0.02 %"},
      {1, 10001, "under 0.01 %"},
  };
  for (const auto& [part, all, text] : cases) EXPECT_EQ(share_text(part, all), text);
}

TEST(TimeRatio, IsMeasurableBeyondItsSpread) {
  EXPECT_TRUE((TimeRatio{1.25, 0.25}.unmeasurable()));
  EXPECT_TRUE((TimeRatio{0.75, 0.25}.unmeasurable()));
  EXPECT_FALSE((TimeRatio{1.25, std::nextafter(0.25, 0.0)}.unmeasurable()));
  EXPECT_FALSE((TimeRatio{0.75, std::nextafter(0.25, 0.0)}.unmeasurable()));
}

TierResult decision(Accuracy a, double ns, double spread, std::uint64_t wrong, double seconds) {
  TierResult t{to_string(a), "gaps"};
  t.samples = 700;
  t.ns_per_pair = ns;
  t.spread = spread;
  t.decision_errors = wrong;
  t.rewritten = 50 + wrong;
  t.invariance_violations = wrong / 2;
  t.seconds = seconds;
  return t;
}
AccuracyReport hard_report() {
  AccuracyReport r;
  r.scene = "hard-cases";
  r.tiers = {TierResult{"robust", "distance"}, decision(Accuracy::exact, 5000, 0.5, 0, 0),
             decision(Accuracy::fast, 20, 0.0625, 90, 0),
             decision(Accuracy::robust, 50, 0.125, 0, 0),
             decision(Accuracy::reference, 25, 0.03125, 7, 0)};
  for (const auto& [family, tier, wrong] :
       {std::tuple(1, "fast", 90), std::tuple(2, "fast", 0), std::tuple(1, "robust", 0),
        std::tuple(2, "reference", 4), std::tuple(3, "reference", 3), std::tuple(3, "fast", 0)}) {
    FamilyResult f;
    f.id = family;
    f.tier = tier;
    f.decision_errors = static_cast<std::uint64_t>(wrong);
    r.kinds.push_back(f);
  }
  return r;
}
AccuracyReport deck_report() {
  AccuracyReport r;
  r.scene = "deck";
  r.tiers = {decision(Accuracy::exact, 1, 0.25, 0, 8), decision(Accuracy::fast, 1, 0.125, 3, 0.5),
             decision(Accuracy::robust, 1, 0.0625, 0, 0.75),
             decision(Accuracy::reference, 1, 0.5, 2, 0)};
  return r;
}

TEST(AccuracyChoices, CompareTimesWithThoseOfFast) {
  const AccuracyReport hard = hard_report(), deck = deck_report();
  const auto choices = accuracy_choices(hard, &deck);
  ASSERT_EQ(choices.size(), 4u);
  struct Row {
    double ns, ratio, spread;
    std::uint64_t wrong, rewritten, other, kinds_right, kinds;
    std::vector<const FamilyResult*> families;
  };
  const auto& k = hard.kinds;
  const Row rows[] = {{25, 1.25, 0.09375, 7, 57, 3, 0, 2, {&k[3], &k[4]}},
                      {20, 1, 0.125, 90, 140, 45, 2, 3, {&k[0], &k[1], &k[5]}},
                      {50, 2.5, 0.1875, 0, 50, 0, 1, 1, {&k[2]}},
                      {5000, 250, 0.5625, 0, 50, 0, 0, 0, {}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& h = choices[i].hard;
    EXPECT_EQ(h.ns_per_pair, rows[i].ns) << i;
    EXPECT_EQ(h.ratio.value, rows[i].ratio) << i;
    EXPECT_EQ(h.ratio.spread, rows[i].spread) << i;
    EXPECT_EQ(h.wrong, rows[i].wrong) << i;
    EXPECT_EQ(h.pairs, 700u) << i;
    EXPECT_EQ(h.rewritten, rows[i].rewritten) << i;
    EXPECT_EQ(h.other_answers, rows[i].other) << i;
    EXPECT_EQ(h.kinds_right, rows[i].kinds_right) << i;
    EXPECT_EQ(h.kinds, rows[i].kinds) << i;
    EXPECT_EQ(choices[i].kinds, rows[i].families) << i;
  }
  // The reference took no time that a clock sees.
  EXPECT_FALSE(choices[0].deck.has_value());
  const std::tuple<double, double, double, std::uint64_t> on_deck[] = {
      {0.5, 1, 0.25, 3}, {0.75, 1.5, 0.1875, 0}, {8, 16, 0.375, 0}};
  for (std::size_t i = 1; i < 4; ++i) {
    ASSERT_TRUE(choices[i].deck.has_value()) << i;
    const auto& d = *choices[i].deck;
    EXPECT_EQ(std::tuple(d.seconds, d.ratio.value, d.ratio.spread, d.wrong), on_deck[i - 1]) << i;
    EXPECT_EQ(d.pairs, 700u) << i;
  }
}

TEST(AccuracyChoices, AreNoneWhereADecisionIsMissing) {
  const AccuracyReport whole = hard_report();
  for (std::size_t gone = 1; gone < whole.tiers.size(); ++gone) {
    AccuracyReport r = whole;
    r.tiers.erase(r.tiers.begin() + static_cast<std::ptrdiff_t>(gone));
    EXPECT_TRUE(accuracy_choices(r, nullptr).empty()) << gone;
  }
  AccuracyReport still = whole;
  for (TierResult& t : still.tiers) t.ns_per_pair = 0;
  EXPECT_EQ(accuracy_choices(still, nullptr)[2].hard.ratio.value, 1.0);
}

using Sentences = std::vector<std::string>;

TEST(AccuracyAdvice, NamesTheCostOnTheDeckAndOnHardPairs) {
  const AccuracyReport hard = hard_report();
  AccuracyReport deck = deck_report();
  const Sentences said = accuracy_advice(accuracy_choices(hard, &deck), "b");
  EXPECT_EQ(said,
            (Sentences{"Keep <b>robust</b>, the default: on this deck it takes 0.75 s, "
                       "<b>fast</b> 0.50 s.",
                       "Where pairs are hard it takes 2.5 times as long as <b>fast</b> and is "
                       "never wrong; <b>fast</b> is wrong in 13 % of these pairs, "
                       "<b>reference</b> in 1 %."}));
  // A spread of 12.5 and 6.25 % is 18.75 %, rounded up.
  deck.tiers[2].seconds = 0.5625;
  EXPECT_EQ(accuracy_advice(accuracy_choices(hard, &deck)).front(),
            "Keep robust, the default: on this deck it takes 0.56 s, fast 0.50 s: no measurable "
            "difference (±19 %).");
}

TEST(AccuracyAdvice, CountsHardPairsWhereThereIsNoDeck) {
  AccuracyReport hard = hard_report();
  EXPECT_EQ(accuracy_advice(accuracy_choices(hard, nullptr)).front(),
            "Keep robust, the default: it decides all 700 hard test pairs correctly.");
  hard.tiers[3].ns_per_pair = 20;
  EXPECT_EQ(accuracy_advice(accuracy_choices(hard, nullptr)).back().substr(0, 80),
            "Where pairs are hard it takes as long as fast (no measurable difference, ±19 %)");
}

TEST(AccuracyAdvice, AddsWrongPairsOfTheDeckAndOfTheHardCases) {
  AccuracyReport hard = hard_report(), deck = deck_report();
  hard.tiers[3].decision_errors = 2;
  deck.tiers[2].decision_errors = 3;
  const Sentences both = accuracy_advice(accuracy_choices(hard, &deck));
  EXPECT_EQ(both.front(),
            "This is an error of the program, please report it: robust decides 5 pairs wrongly: on "
            "this deck it takes 0.75 s, fast 0.50 s.");
  EXPECT_NE(both.back().find("and is wrong in 2 of 700; fast"), std::string::npos);
  hard.tiers[3].decision_errors = 1;
  EXPECT_EQ(accuracy_advice(accuracy_choices(hard, nullptr)).front(),
            "This is an error of the program, please report it: robust decides 1 pair wrongly.");
}

}  // namespace
}  // namespace deck
