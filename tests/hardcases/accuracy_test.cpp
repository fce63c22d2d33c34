// The measurement behind `deck accuracy` and its reports.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "accuracy/shared/motion.hpp"
#include "accuracy/shared/store.hpp"
#include "accuracy/tiers.hpp"
#include "base/shared/hash.hpp"
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

TEST(AccuracyReports, JsonHoldsEveryTierAndFamily) {
  const AccuracyReport r = small_report();
  AccuracyContext context;
  context.command = "deck accuracy \"x\"";
  const auto j = nlohmann::json::parse(accuracy_json(r, context));
  EXPECT_EQ(j["schema"]["id"], "deck/accuracy");
  EXPECT_EQ(j["tiers"].size(), r.tiers.size());
  EXPECT_EQ(j["families"].size(), r.families.size());
  EXPECT_EQ(j["machine"]["command"], context.command);
  EXPECT_FALSE(j.contains("deck"));
}

AccuracyReport deck_report(double fast, double robust, double spread) {
  AccuracyReport r;
  r.scene = "deck";
  for (const auto& [name, seconds] : {std::pair("exact", 9.0), std::pair("robust", robust),
                                      std::pair("reference", fast), std::pair("fast", fast)}) {
    TierResult t{name, "gaps"};
    t.samples = 100;
    t.seconds = seconds;
    t.spread = spread;
    r.tiers.push_back(t);
  }
  return r;
}

TEST(AccuracyChoices, AreNamedAndOrderedAsTheOptionIs) {
  const AccuracyReport hard = small_report();
  const auto choices = accuracy_choices(hard, nullptr);
  ASSERT_EQ(choices.size(), 4u);
  const Accuracy order[] = {Accuracy::reference, Accuracy::fast, Accuracy::robust, Accuracy::exact};
  for (std::size_t k = 0; k < 4; ++k) {
    const AccuracyChoice& c = choices[k];
    EXPECT_EQ(c.accuracy, order[k]);
    const TierResult& t = tier(hard, to_string(c.accuracy), "gaps");
    EXPECT_EQ(c.hard.wrong, t.decision_errors);
    EXPECT_EQ(c.hard.other_answers, t.invariance_violations);
    EXPECT_EQ(c.hard.rewritten, 200u);
    EXPECT_EQ(c.hard.kinds, 4u);
    std::uint64_t wrong = 0;
    for (const FamilyResult* f : c.kinds) wrong += f->decision_errors;
    EXPECT_EQ(wrong, c.hard.wrong);
    EXPECT_FALSE(c.deck.has_value());
  }
  EXPECT_EQ(choices[2].hard.kinds_right, 4u);
  EXPECT_EQ(choices[3].hard.other_answers, 0u);
  EXPECT_LT(choices[0].hard.kinds_right, 4u);
  EXPECT_TRUE(accuracy_choices({}, nullptr).empty());
  EXPECT_TRUE(accuracy_advice({}).empty());
}

TEST(AccuracyChoices, ARatioWithinItsSpreadIsNoMeasurableDifference) {
  const AccuracyReport hard = small_report();
  const AccuracyReport alike = deck_report(0.70, 0.66, 0.03), apart = deck_report(0.70, 1.4, 0.03);
  const auto said = [&](const AccuracyReport& deck) {
    return accuracy_advice(accuracy_choices(hard, &deck)).front();
  };
  EXPECT_NE(said(alike).find("no measurable difference (±6 %)"), std::string::npos);
  EXPECT_NE(said(alike).find("it takes 0.66 s, fast 0.70 s"), std::string::npos);
  EXPECT_EQ(said(apart).find("no measurable"), std::string::npos);
}

TEST(AccuracyChoices, AWrongAnswerOfRobustIsAnErrorOfTheProgram) {
  AccuracyReport hard = small_report();
  for (TierResult& t : hard.tiers) {
    if (t.name == "robust" && t.what == "gaps") t.decision_errors = 3;
  }
  const auto said = accuracy_advice(accuracy_choices(hard, nullptr));
  EXPECT_EQ(said.front().find("This is an error of the program"), 0u);
  EXPECT_NE(said.front().find("3 pairs"), std::string::npos);
}

TEST(AccuracyChoices, TheTextHasFourRowsAndTheRestWhenVerbose) {
  const AccuracyReport r = small_report();
  const std::string text = accuracy_text(r, {}, false, 80);
  EXPECT_NE(text.find("Keep robust, the default"), std::string::npos);
  EXPECT_EQ(text.find("double-residual"), std::string::npos);
  EXPECT_NE(accuracy_text(r, {}, false, 80, true).find("double-residual"), std::string::npos);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Keep") || line.find("optimised") != std::string::npos) continue;
    EXPECT_LE(line.size(), 80u) << line;
  }
}

TEST(AccuracyStore, IsReadBackBitForBitOrNotAtAll) {
  const AccuracyReport r = small_report();
  const std::string text = stored_accuracy(r, "key");
  const auto back = read_stored_accuracy(text, "key");
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(stored_accuracy(*back, "key"), text);
  AccuracyContext context;
  EXPECT_EQ(accuracy_json(*back, context), accuracy_json(r, context));
  EXPECT_FALSE(read_stored_accuracy(text, "another").has_value());
  EXPECT_FALSE(read_stored_accuracy("", "").has_value());
  for (std::size_t cut = 1; cut < text.size(); cut += text.size() / 50 + 1)
    EXPECT_FALSE(read_stored_accuracy(std::string_view(text).substr(0, text.size() - cut), "key"));
  std::string other = text;
  other[text.size() / 2] ^= 1;
  EXPECT_FALSE(read_stored_accuracy(other, "key").has_value());
}

TEST(AccuracyStore, EveryMemberHasItsOwnPlace) {
  AccuracyReport r;
  r.scene = "deck";
  r.tiers.push_back(
      {"a", "b", 3, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10, 11, 12, 13, 14, 15, 16.5, 17.5, true});
  r.tiers.push_back({"c", "d"});
  FamilyResult f{21, "e", "f", "g", 22, 23.5, 24.5, 25, 26, true, {}, 27.5, -0.0, true};
  for (std::size_t k = 0; k < 5; ++k) {
    const double v = 30 + 3 * static_cast<double>(k);
    f.example.x[k] = {v, v + 1, v + 2};
  }
  f.example.edges = true;
  f.example.gap = 50.5;
  f.example.family = 51;
  r.families.push_back(f);
  f.example.edges = f.has_example = f.exact_closer = false;
  f.example.triangle = true;
  r.kinds = {f, f};
  r.stages = {{"h", 61, 62.5}, {"i", 63, 64.5}, {"j", 65, 66.5}};
  const auto back = read_stored_accuracy(stored_accuracy(r, "key"), "key");
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->scene, "deck");
  ASSERT_EQ(back->tiers.size(), 2u);
  const auto members = [](const TierResult& t) {
    return std::tuple(t.name, t.what, t.samples, t.ns_per_pair, t.spread, t.seconds,
                      t.max_relative_error, t.max_ulp, t.max_scaled_error, t.decision_errors,
                      t.feature_errors, t.non_finite, t.rewritten, t.invariance_violations, t.jumps,
                      t.fallback_share, t.exact_share, t.dominated);
  };
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(members(back->tiers[k]), members(r.tiers[k]));
  const auto of_family = [](const FamilyResult& m) {
    std::vector<double> x;
    for (const auto& p : m.example.x) x.insert(x.end(), {p.x, p.y, p.z});
    return std::tuple(m.id, m.name, m.expected, m.tier, m.samples, m.max_relative_error, m.max_ulp,
                      m.decision_errors, m.non_finite, m.has_example, m.got, std::signbit(m.exact),
                      m.exact_closer, m.example.edges, m.example.triangle, m.example.gap,
                      m.example.family, x);
  };
  ASSERT_EQ(back->families.size(), 1u);
  ASSERT_EQ(back->kinds.size(), 2u);
  EXPECT_EQ(of_family(back->families[0]), of_family(r.families[0]));
  EXPECT_EQ(of_family(back->kinds[1]), of_family(r.kinds[1]));
  ASSERT_EQ(back->stages.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(back->stages[k].name, r.stages[k].name);
    EXPECT_EQ(back->stages[k].pairs, r.stages[k].pairs);
    EXPECT_EQ(back->stages[k].ns_per_pair, r.stages[k].ns_per_pair);
  }
}

/// The text with the mark at its end that says that it is whole.
std::string sealed(const std::string& text) {
  return text + fmt::format("end {:016x}\n", content_hash(text));
}

TEST(AccuracyStore, RowsThatAreNotItsOwnAreRefused) {
  const auto read = [](const std::string& rows) {
    return read_stored_accuracy(sealed("key\ndeck\n" + rows), "key");
  };
  ASSERT_TRUE(read("").has_value());
  EXPECT_EQ(read("")->scene, "deck");
  ASSERT_TRUE(read("stage\tfilter\t3\t0\n").has_value());
  EXPECT_EQ(read("stage\tfilter\t3\t0\n")->stages.at(0).pairs, 3u);
  for (const char* rows :
       {"\n", "page\tfilter\t3\t0\n", "stage\tfilter\t3\t0\t0\n", "stage\tfilter\t3x\t0\n",
        "stage\tfilter\tx\t0\n", "stage\tfilter\t3\n", "stage\tfilter\t3\tx\n",
        "stage\tfilter\tx\t0\nstage\tfilter\t3\t0\n", "tier\tfilter\t3\t0\n"})
    EXPECT_FALSE(read(rows).has_value()) << rows;
}

TEST(AccuracyReports, DecisionsAloneGiveTheSameChoices) {
  std::vector<PairSample> samples = hard_cases(1, 30);
  AccuracyOptions options;
  options.repeats = 1;
  options.decisions_only = true;
  std::uint64_t last = 0;
  options.progress = [&](std::uint64_t done, std::uint64_t all) {
    EXPECT_LE(done, all);
    last = done;
  };
  const AccuracyReport few = measure_accuracy(samples, options);
  EXPECT_GT(last, 3u);
  EXPECT_EQ(few.tiers.size(), 4u);
  EXPECT_TRUE(few.families.empty());
  const AccuracyReport all = measure_accuracy(samples, {1});
  for (const TierResult& t : few.tiers)
    EXPECT_EQ(t.decision_errors, tier(all, t.name, "gaps").decision_errors) << t.name;
}

TEST(AccuracyReports, TheDefaultIsNotDrawnAsBeatenWithoutAReason) {
  const AccuracyReport hard = small_report();
  AccuracyContext context;
  context.path = "a.rad";
  context.hard = &hard;
  AccuracyReport slower = deck_report(0.7, 1.4, 0.0);
  for (TierResult& t : slower.tiers) t.ns_per_pair = 1e6 * t.seconds;
  const std::string page = accuracy_html(slower, context);
  EXPECT_EQ(page.find("dk-hollow'><title>robust"), std::string::npos);
  EXPECT_NE(page.find("is better than robust on these pairs, but proves none"), std::string::npos);
  AccuracyReport alike = deck_report(0.70, 0.71, 0.03);
  for (TierResult& t : alike.tiers) t.ns_per_pair = 1e6 * t.seconds;
  EXPECT_EQ(accuracy_html(alike, context).find("better than robust"), std::string::npos);
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

TEST(AccuracyReports, ChartMarksEveryTierAndFetchesNothing) {
  const AccuracyReport r = small_report();
  AccuracyContext context;
  context.path = "a<b>.rad";
  const std::string html = accuracy_html(r, context);
  std::size_t marks = 0;
  for (std::size_t at = html.find("<circle cx"); at != std::string::npos;
       at = html.find("<circle cx", at + 1))
    ++marks;
  EXPECT_EQ(marks, r.tiers.size());
  EXPECT_EQ(html.find("<b>.rad"), std::string::npos);
  EXPECT_NE(html.find("a&lt;b&gt;.rad"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos);
  EXPECT_EQ(html.find("href="), std::string::npos);
}

TEST(AccuracyReports, ChartPutsTimesAndLabelsWhereTheAxesAre) {
  // Two tiers of one kind: the slower one stands to the right, both between the axes.
  AccuracyReport r = small_report();
  std::vector<TierResult> kept;
  for (const TierResult& t : r.tiers)
    if (t.what == "distance" && kept.size() < 2) kept.push_back(t);
  ASSERT_EQ(kept.size(), 2u);
  kept[0].ns_per_pair = 20;
  kept[1].ns_per_pair = 2000;
  r.tiers = kept;
  const std::string html = accuracy_html(r, {});
  const auto chart = html.find("<svg xmlns", html.find("For experts"));
  ASSERT_NE(chart, std::string::npos);
  const std::string svg = html.substr(chart, html.find("</svg>", chart) - chart);
  const auto number = [&](std::size_t from, const std::string& name) {
    const auto at = svg.find(name + "='", from);
    return at == std::string::npos ? -1.0 : std::stod(svg.substr(at + name.size() + 2));
  };
  const auto first = svg.find("<circle"), second = svg.find("<circle", first + 1);
  ASSERT_NE(second, std::string::npos);
  const double x0 = number(first, "cx"), x1 = number(second, "cx");
  const double width = number(svg.find("<svg"), "width");
  EXPECT_GT(x0, 0);
  EXPECT_LT(x0, x1);
  EXPECT_LT(x1, width);
  // The label of the upright axis is turned about its own place.
  const auto turned = svg.find("rotate(-90 18 ");
  ASSERT_NE(turned, std::string::npos);
  const double about = std::stod(svg.substr(turned + 14));
  const auto element = svg.rfind("<text", turned);
  EXPECT_NEAR(number(element, " y"), about, 0.1);
}

}  // namespace
}  // namespace deck
