// The measurement behind `deck accuracy`: what each arithmetic keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "accuracy/shared/motion.hpp"
#include "accuracy/tiers.hpp"
#include "contact/shared/filtered.hpp"
#include "report/shared/accuracy.hpp"

namespace deck {
namespace {

AccuracyReport small_report() {
  std::vector<PairSample> samples;
  for (const int family : {1, 17, 25, 30}) {
    const auto some = hard_cases(family, 50);
    samples.insert(samples.end(), some.begin(), some.end());
  }
  AccuracyOptions options;
  options.repeats = 1;
  return measure_accuracy(samples, options);
}

const TierResult& tier(const AccuracyReport& report, const std::string& name,
                       const std::string& what = "distance") {
  const auto found =
      std::find_if(report.tiers.begin(), report.tiers.end(),
                   [&](const TierResult& t) { return t.name == name && t.what == what; });
  if (found != report.tiers.end()) return *found;
  ADD_FAILURE() << "no tier " << name << ", " << what;
  static const TierResult none;
  return none;
}

TEST(Accuracy, TiersRankAsTheirArithmetic) {
  const AccuracyReport r = small_report();
  EXPECT_EQ(r.scene, "hard-cases");
  EXPECT_GT(tier(r, "float").max_relative_error, tier(r, "double").max_relative_error);
  // At an offset of 1e9 the textbook subtraction loses what the residual form keeps.
  EXPECT_GT(tier(r, "double").max_scaled_error, tier(r, "double-residual").max_scaled_error);
  EXPECT_GT(tier(r, "double-residual").decision_errors, 0u);
  EXPECT_EQ(tier(r, "robust").decision_errors, 0u);
  EXPECT_EQ(tier(r, "robust").max_ulp, 0.0);
  EXPECT_EQ(tier(r, "robust").non_finite, 0u);
}

TEST(Accuracy, CertifiedTiersDecideAllAlike) {
  const AccuracyReport r = small_report();
  for (const char* name : {"robust", "interval", "epeck", "exact"}) {
    EXPECT_EQ(tier(r, name).decision_errors, 0u) << name;
    EXPECT_EQ(tier(r, name).non_finite, 0u) << name;
  }
  EXPECT_EQ(tier(r, "epeck").max_ulp, 0.0);
  EXPECT_EQ(tier(r, "robust", "gaps").decision_errors, 0u);
  EXPECT_GT(tier(r, "reference", "gaps").decision_errors, 0u);
}

TEST(Accuracy, AnotherPartAtTheSameDistanceIsNoError) {
  // Two edges on one line meet in many points: every part that is as near as the nearest is right.
  std::vector<PairSample> samples;
  for (int i = 0; i < 40; ++i) {
    PairSample s;
    s.edges = true;
    s.x = {Point3<double>{1000.0 + i, 7, 0}, Point3<double>{1010.0 + i, 7, 0},
           Point3<double>{1002.0, 7, 1}, Point3<double>{1030.0, 7, 1}};
    s.gap = 2;
    samples.push_back(s);
  }
  for (const TierResult& t : measure_accuracy(samples).tiers) {
    if (t.what == "distance" && t.name != "float") {
      EXPECT_EQ(t.feature_errors, 0u) << t.name;
    }
  }
}

TEST(Accuracy, RobustAnswersDoNotNoticeHowAPairIsWritten) {
  const AccuracyReport r = small_report();
  for (const char* what : {"distance", "gaps"}) {
    EXPECT_EQ(tier(r, "robust", what).rewritten, 200u);
    EXPECT_EQ(tier(r, "robust", what).invariance_violations, 0u);
    EXPECT_GT(tier(r, "reference", what).invariance_violations, 0u);
  }
  EXPECT_EQ(tier(r, "robust").jumps, 0u);
  EXPECT_GT(tier(r, "double").jumps, 0u);
  EXPECT_EQ(tier(r, "epeck").rewritten, 0u);
}

TEST(Accuracy, RobustForceKeepsTwelveDigits) {
  const AccuracyReport r = small_report();
  EXPECT_EQ(tier(r, "robust", "force").decision_errors, 0u);
  EXPECT_LT(tier(r, "robust", "force").max_relative_error, 4e-12);
  EXPECT_GT(tier(r, "double", "force").max_relative_error, 1e-6);
  // The law alone, without hard geometry: the kernel of the cycle stage has nearly all digits.
  std::vector<PairSample> easy;
  for (int k = 1; k < 9; ++k) {
    PairSample s;
    s.x = {Point3<double>{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.4, 0.1 * k}};
    s.gap = 1.0;
    easy.push_back(s);
  }
  const AccuracyReport plain = measure_accuracy(easy, {});
  EXPECT_EQ(plain.scene, "deck");
  EXPECT_EQ(tier(plain, "kernel", "force").decision_errors, 0u);
  EXPECT_LT(tier(plain, "kernel", "force").max_relative_error, 1e-14);
  EXPECT_LT(tier(plain, "exact", "force").ns_per_pair, 1e9);
}

TEST(Accuracy, FamiliesGiveAnExampleOfTheirWrongDecisions) {
  const AccuracyReport r = small_report();
  int shown = 0;
  for (const FamilyResult& f : r.families) {
    if (f.decision_errors == 0) continue;
    ASSERT_TRUE(f.has_example);
    const PairSample& s = f.example;
    const bool closer = s.edges ? is_closer_than(s.x[0], s.x[1], s.x[2], s.x[3], s.gap)
                                : is_closer_than(s.x[4], s.corners(), s.triangle, s.gap);
    EXPECT_NE(f.got < s.gap, closer);
    EXPECT_EQ(f.exact_closer, closer);
    EXPECT_EQ(f.example.family, f.id);
    ++shown;
  }
  EXPECT_GT(shown, 0);
  EXPECT_NE(accuracy_examples(r).find("0x"), std::string::npos);
  EXPECT_EQ(accuracy_examples({}), "");
}

TEST(Accuracy, WholeDecksAreHeldAgainstTheExactOnes) {
  AccuracyReport report;
  report.tiers.push_back({"robust", "gaps"});
  const auto scene = [](Accuracy accuracy) {
    Scene s;
    s.decisions.pairs = 4;
    s.decisions.fallback = accuracy == Accuracy::exact ? 4 : 1;
    s.contacts.resize(1);
    PenetrationRow row;
    row.distance = accuracy == Accuracy::reference ? 1.5 : 1.0;
    s.contacts[0].penetrations.push_back(row);
    if (accuracy != Accuracy::fast) {
      row.secondary = 1;
      row.in_contact = accuracy != Accuracy::robust;
      s.contacts[0].penetrations.push_back(row);
    }
    return s;
  };
  measure_gaps(scene, {3}, report);
  ASSERT_EQ(report.tiers.size(), 4u);
  EXPECT_EQ(tier(report, "exact", "gaps").decision_errors, 0u);
  EXPECT_EQ(tier(report, "robust", "gaps").decision_errors, 1u);
  EXPECT_EQ(tier(report, "fast", "gaps").decision_errors, 1u);
  EXPECT_EQ(tier(report, "reference", "gaps").decision_errors, 0u);
  EXPECT_EQ(tier(report, "reference", "gaps").max_relative_error, 0.5);
  EXPECT_EQ(tier(report, "robust", "gaps").fallback_share, 0.25);
}

TEST(Accuracy, StagesOfTheRobustDecisionHoldEveryPairOnce) {
  const AccuracyReport r = small_report();
  ASSERT_EQ(r.stages.size(), 3u);
  std::uint64_t pairs = 0;
  for (const StageResult& s : r.stages) {
    pairs += s.pairs;
    EXPECT_EQ(s.ns_per_pair > 0, s.pairs > 0) << s.name;
  }
  const TierResult& robust = tier(r, "robust", "gaps");
  EXPECT_EQ(pairs, robust.samples);
  EXPECT_NEAR(static_cast<double>(r.stages[2].pairs) / static_cast<double>(pairs),
              robust.exact_share, 1e-12);
}

TEST(Accuracy, FamiliesHaveOneRowPerTier) {
  const AccuracyReport r = small_report();
  const auto distances = std::count_if(r.tiers.begin(), r.tiers.end(),
                                       [](const TierResult& t) { return t.what == "distance"; });
  ASSERT_EQ(r.families.size(), 4u * static_cast<std::size_t>(distances));
  for (const FamilyResult& f : r.families) EXPECT_EQ(f.samples, 50u);
}

TEST(Accuracy, NoPairsNoTiers) {
  EXPECT_TRUE(measure_accuracy({}).tiers.empty());
  EXPECT_EQ(accuracy_text({}, {}), "No pairs to measure.\n");
}

TEST(AccuracyMotion, TheReferenceFormulaJumpsAndTheExactOneDoesNot) {
  const HardMotion m = hard_motion();
  ASSERT_EQ(m.lines.size(), 4u);
  const auto& [reference, fast, robust, exact] =
      std::tie(m.lines[0], m.lines[1], m.lines[2], m.lines[3]);
  EXPECT_EQ(reference.jumps, std::vector<std::size_t>{47});
  EXPECT_EQ(robust.jumps, (std::vector<std::size_t>{47, 77}));
  EXPECT_TRUE(fast.jumps.empty() && exact.jumps.empty());
  FilterCounters unused;
  for (std::size_t k = 0; k <= 100; ++k) {
    PairSample s;
    s.triangle = true;
    s.gap = m.gap;
    s.x = {m.corners[0], m.corners[1], m.corners[2], m.corners[2],
           m.from + (static_cast<double>(k) / 100.0) * (m.to - m.from)};
    EXPECT_NEAR(exact.depth[k], m.gap - accuracy::exact(s, unused).value, 1e-15) << k;
    const double force = accuracy::exact_force(s, unused).value;
    EXPECT_NEAR(exact.force[k], force, 1e-14 * force) << k;
    EXPECT_NEAR(fast.force[k], force, 1e-12 * force) << k;
    // Figures of the reference formula where it sees a contact, else exact ones.
    EXPECT_EQ(robust.depth[k], (reference.depth[k] > 0 ? reference : exact).depth[k]) << k;
  }
  EXPECT_LT(reference.force[47], 0.1 * exact.force[47]);
  EXPECT_EQ(motion_sentences(m).size(), 2u);
}

}  // namespace
}  // namespace deck
