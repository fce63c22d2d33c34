// The measurement behind `deck accuracy` and its reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "deck/report/accuracy.hpp"

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

const TierResult& tier(const AccuracyReport& report, const std::string& name) {
  return *std::find_if(report.tiers.begin(), report.tiers.end(),
                       [&](const TierResult& t) { return t.name == name && t.what == "distance"; });
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

TEST(Accuracy, FamiliesHaveOneRowPerTier) {
  const AccuracyReport r = small_report();
  ASSERT_EQ(r.families.size(), 8u);
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

TEST(AccuracyReports, CsvLinesHaveTheColumnsOfTheHeading) {
  const AccuracyReport report = small_report();
  std::istringstream lines(accuracy_csv(report));
  std::string line;
  std::getline(lines, line);
  const auto commas = std::count(line.begin(), line.end(), ',');
  std::size_t rows = 0;
  for (; std::getline(lines, line); ++rows) {
    bool quoted = false;
    std::ptrdiff_t found = 0;
    for (const char c : line) {
      quoted ^= c == '"';
      found += c == ',' && !quoted;
    }
    EXPECT_EQ(found, commas) << line;
  }
  EXPECT_EQ(rows, report.tiers.size() + report.families.size());
}

TEST(AccuracyReports, ChartMarksEveryTierAndFetchesNothing) {
  const AccuracyReport r = small_report();
  AccuracyContext context;
  context.path = "a<b>.rad";
  const std::string svg = accuracy_svg(r, context), html = accuracy_html(r, context);
  std::size_t marks = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1))
    ++marks;
  EXPECT_EQ(marks, r.tiers.size());
  EXPECT_EQ(svg.find("a<b>"), std::string::npos);
  EXPECT_NE(html.find("a&lt;b&gt;.rad"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos);
  EXPECT_EQ(html.find("href="), std::string::npos);
}

}  // namespace
}  // namespace deck
