// `deck accuracy`: JSON, tables, charts and the page of a measurement that is written out here.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "accuracy/shared/motion.hpp"
#include "contact/small_deck.hpp"
#include "report/accuracy_chart.hpp"
#include "report/html/accuracy_choices.hpp"
#include "report/shared/accuracy.hpp"

namespace deck::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

TierResult tier_of(const char* name, const char* what, double ns, std::uint64_t wrong,
                   double error = 0) {
  TierResult t;
  t.name = name;
  t.what = what;
  t.samples = 4000;
  t.ns_per_pair = ns;
  t.spread = 0.01;
  t.decision_errors = wrong;
  t.max_relative_error = error;
  t.max_scaled_error = error / 2;
  t.max_ulp = 4 * error;
  return t;
}

FamilyResult family_of(int id, const char* tier, std::uint64_t wrong, bool edges = false) {
  FamilyResult f;
  f.id = id;
  f.name = "kind " + std::to_string(id);
  f.expected = "expected " + std::to_string(id);
  f.tier = tier;
  f.samples = 200;
  f.decision_errors = wrong;
  f.non_finite = wrong / 2;
  f.max_relative_error = 0.25;
  f.max_ulp = 0.5;
  f.has_example = wrong > 0;
  f.example.edges = edges;
  f.example.triangle = !edges;
  for (std::size_t k = 0; k < 5; ++k) f.example.x[k] = {static_cast<double>(k), k + 0.5, k + 0.25};
  f.example.gap = 1.5;
  f.got = 1.25;
  f.exact = 1.75;
  f.exact_closer = edges;
  return f;
}

/// Four words of --accuracy on the hard cases.
AccuracyReport hard_report() {
  AccuracyReport r;
  r.scene = "hard-cases";
  r.tiers = {tier_of("reference", "gaps", 50, 400), tier_of("fast", "gaps", 20, 100),
             tier_of("robust", "gaps", 40, 0), tier_of("exact", "gaps", 20000, 0)};
  for (TierResult& t : r.tiers) t.rewritten = 800;
  r.tiers[0].invariance_violations = 80;
  r.tiers[1].invariance_violations = 3;
  r.kinds = {family_of(3, "reference", 40), family_of(5, "reference", 1, true),
             family_of(3, "fast", 19),      family_of(5, "fast", 0, true),
             family_of(3, "robust", 0),     family_of(5, "robust", 0, true),
             family_of(3, "exact", 0),      family_of(5, "exact", 0, true)};
  r.families = {family_of(3, "reference", 40), family_of(5, "robust", 8, true),
                family_of(5, "float", 190, true)};
  r.stages = {{"filter", 900, 10}, {"double-double", 90, 100}, {"exact", 10, 1100}};
  return r;
}

/// The same of a deck: whole runs.
AccuracyReport deck_report() {
  AccuracyReport r;
  r.scene = "deck";
  for (const auto& [name, seconds, wrong] : {std::tuple("reference", 0.25, 7),
                                             {"fast", 0.2, 4},
                                             {"robust", 0.201, 0},
                                             {"exact", 9.0, 0}}) {
    TierResult t = tier_of(name, "gaps", 1e9 * seconds / 50, static_cast<std::uint64_t>(wrong));
    t.samples = 50;
    t.seconds = seconds;
    r.tiers.push_back(t);
  }
  return r;
}

AccuracyContext context_of(const AccuracyReport* hard = nullptr) {
  AccuracyContext c;
  c.processor = "a processor";
  c.command = "deck accuracy";
  c.hard = hard;
  if (hard != nullptr) c.path = "a_0000.rad";
  return c;
}

Json points(std::size_t count) {
  Json out = Json::array();
  for (std::size_t k = 0; k < count; ++k)
    out.push_back({static_cast<double>(k), k + 0.5, k + 0.25});
  return out;
}

void count_failures(TierResult& t) {
  t.feature_errors = 10;
  t.non_finite = 11;
  t.rewritten = 12;
  t.invariance_violations = 13;
  t.jumps = 14;
  t.fallback_share = 0.375;
}

TEST(AccuracyJson, HasEveryFigureOfTiersFamiliesAndStages) {
  AccuracyReport r = hard_report();
  TierResult t = tier_of("float", "distance", 3.5, 9, 0.125);
  t.seconds = 1.25;
  count_failures(t);
  t.exact_share = 0.625;
  t.dominated = true;
  r.tiers = {t};
  const Json all = Json::parse(accuracy_json(r, context_of()));
  EXPECT_EQ(all["schema"], Json({{"id", "deck/accuracy"}, {"version", 1}}));
  EXPECT_EQ(all["scene"], "hard-cases");
  EXPECT_EQ(all["machine"], Json({{"processor", "a processor"},
                                  {"compiler", accuracy_compiler()},
                                  {"command", "deck accuracy"}}));
  EXPECT_FALSE(all.contains("deck"));
  EXPECT_EQ(all["advice"], Json::array()) << "there are no decisions to choose by";
  EXPECT_EQ(all["choices"], Json::array());
  EXPECT_FALSE(all.contains("motion"));
  EXPECT_EQ(all["tiers"], Json::array({{{"name", "float"},
                                        {"what", "distance"},
                                        {"samples", 4000},
                                        {"ns_per_pair", 3.5},
                                        {"spread", 0.01},
                                        {"seconds", 1.25},
                                        {"max_relative_error", 0.125},
                                        {"max_ulp", 0.5},
                                        {"max_scaled_error", 0.0625},
                                        {"decision_errors", 9},
                                        {"feature_errors", 10},
                                        {"non_finite", 11},
                                        {"rewritten", 12},
                                        {"invariance_violations", 13},
                                        {"jumps", 14},
                                        {"fallback_share", 0.375},
                                        {"exact_share", 0.625},
                                        {"dominated", true}}}));
  const Json family = {{"id", 3},
                       {"name", "kind 3"},
                       {"tier", "reference"},
                       {"samples", 200},
                       {"max_relative_error", 0.25},
                       {"max_ulp", 0.5},
                       {"decision_errors", 40},
                       {"non_finite", 20},
                       {"expected", "expected 3"},
                       {"example",
                        {{"kind", "node_segment"},
                         {"triangle", true},
                         {"points", points(5)},
                         {"gap", 1.5},
                         {"distance", 1.25},
                         {"exact_distance", 1.75}}}};
  ASSERT_EQ(all["families"].size(), 3u);
  EXPECT_EQ(all["families"][0], family);
  EXPECT_EQ(all["families"][1]["example"]["kind"], "edge_edge");
  EXPECT_EQ(all["families"][1]["example"]["points"], points(4));
  EXPECT_EQ(all["stages"], Json({{{"name", "filter"}, {"pairs", 900}, {"ns_per_pair", 10.0}},
                                 {{"name", "double-double"}, {"pairs", 90}, {"ns_per_pair", 100.0}},
                                 {{"name", "exact"}, {"pairs", 10}, {"ns_per_pair", 1100.0}}}));
}

TEST(AccuracyJson, HasTheChoicesWithTheirKinds) {
  const AccuracyReport hard = hard_report(), report = deck_report();
  const AccuracyContext context = context_of(&hard);
  const Json all = Json::parse(accuracy_json(report, context));
  const std::vector<AccuracyChoice> choices = accuracy_choices_of(report, context);
  ASSERT_EQ(all["choices"].size(), 4u);
  const char* const names[] = {"reference", "fast", "robust", "exact"};
  const int wrong[] = {400, 100, 0, 0}, on_deck[] = {7, 4, 0, 0}, other[] = {80, 3, 0, 0};
  const int right[] = {0, 1, 2, 2};
  const double seconds[] = {0.25, 0.2, 0.201, 9.0}, ns[] = {50, 20, 40, 20000};
  for (std::size_t i = 0; i < 4; ++i) {
    const Json& c = all["choices"][i];
    const TimeRatio &d = choices[i].deck->ratio, &h = choices[i].hard.ratio;
    EXPECT_EQ(c["accuracy"], names[i]);
    EXPECT_EQ(c["deck"], Json({{"seconds", seconds[i]},
                               {"ratio", d.value},
                               {"ratio_spread", d.spread},
                               {"measurable", !d.unmeasurable()},
                               {"wrong", on_deck[i]},
                               {"pairs", 50}}));
    EXPECT_DOUBLE_EQ(d.value, seconds[i] / 0.2);
    EXPECT_EQ(c["hard_cases"], Json({{"ns_per_pair", ns[i]},
                                     {"ratio", h.value},
                                     {"ratio_spread", h.spread},
                                     {"measurable", !h.unmeasurable()},
                                     {"wrong", wrong[i]},
                                     {"pairs", 4000},
                                     {"rewritten", 800},
                                     {"other_answers", other[i]},
                                     {"kinds_right", right[i]},
                                     {"kinds", 2}}));
    EXPECT_DOUBLE_EQ(h.value, ns[i] / 20);
    ASSERT_EQ(c["kinds"].size(), 2u);
  }
  EXPECT_EQ(all["choices"][2]["deck"]["measurable"], false) << "half a percent apart";
  EXPECT_EQ(all["choices"][3]["deck"]["measurable"], true);
  const Json kind = all["choices"][0]["kinds"][1];
  EXPECT_EQ(kind["id"], 5);
  EXPECT_EQ(kind["name"], "kind 5");
  EXPECT_EQ(kind["pairs"], 200);
  EXPECT_EQ(kind["wrong"], 1);
  EXPECT_EQ(kind["in_contact"], true);
  EXPECT_EQ(kind["expected"], "expected 5");
  EXPECT_EQ(kind["example"]["points"], points(4));
  EXPECT_EQ(all["choices"][2]["kinds"][0]["example"], Json());
  EXPECT_EQ(Json::parse(accuracy_json(hard, context_of()))["choices"][0]["deck"], Json());
}

TEST(AccuracyJson, HasTheMotionOfANodeOverASliver) {
  const Json motion = Json::parse(accuracy_json(hard_report(), context_of()))["motion"];
  const HardMotion m = hard_motion();
  const auto point = [](const Point3<double>& p) { return Json({p.x, p.y, p.z}); };
  EXPECT_EQ(motion["corners"],
            Json({point(m.corners[0]), point(m.corners[1]), point(m.corners[2])}));
  EXPECT_EQ(motion["from"], point(m.from));
  EXPECT_EQ(motion["to"], point(m.to));
  EXPECT_EQ(motion["gap"], m.gap);
  EXPECT_EQ(motion["way"], m.way);
  ASSERT_EQ(motion["lines"].size(), m.lines.size());
  for (std::size_t i = 0; i < m.lines.size(); ++i)
    EXPECT_EQ(motion["lines"][i], Json({{"accuracy", to_string(m.lines[i].accuracy)},
                                        {"depth", m.lines[i].depth},
                                        {"force", m.lines[i].force},
                                        {"jumps", m.lines[i].jumps}}));
  EXPECT_EQ(motion["sentences"], Json(motion_sentences(m)));
}

// ---- text -----------------------------------------------------------------------------------

TEST(AccuracyText, HasARowPerWordWithWrongAnswersAndTimes) {
  const AccuracyReport hard = hard_report();
  const std::string text = accuracy_text(deck_report(), context_of(&hard));
  EXPECT_TRUE(text.starts_with("a_0000.rad\nKeep robust")) << text;
  EXPECT_THAT(text, ContainsRegex("\nreference +0\\.25 s +7 = 14 % +2\\.5 x +400 = 10 % +80 = 10 % "
                                  "+0 of 2\n"));
  EXPECT_THAT(text,
              ContainsRegex("\nfast +0\\.20 s +4 = 8 % +1\\.00 x +100 = 2 % +3 = 0\\.4 % +1 of "
                            "2\n"));
  EXPECT_THAT(text, ContainsRegex("\nrobust +0\\.20 s +0 +2\\.0 x +0 +0 +2 of 2\n"));
  EXPECT_THAT(text, ContainsRegex("\nexact +9\\.00 s +0 +1000 x +0 +0 +2 of 2\n"));
  EXPECT_THAT(text, HasSubstr("\nOn this deck: the whole of deck gaps, 50 pairs.\nHard cases: 4000 "
                              "pairs made to break arithmetic"));
  EXPECT_THAT(text, HasSubstr("\nTwo answers: of 800 pairs written in other ways"));
  EXPECT_THAT(text, HasSubstr("\na processor; " + accuracy_compiler() + "\n(--verbose:"));
  const std::string alone = accuracy_text(hard, context_of());
  EXPECT_TRUE(alone.starts_with("Keep robust"));
  EXPECT_THAT(alone, Not(HasSubstr("On this deck")));
  EXPECT_THAT(alone, ContainsRegex("\nfast +1\\.00 x +100 = 2 %"));
}

TEST(AccuracyText, SaysWhereThereIsNothingToMeasure) {
  AccuracyReport none;
  none.scene = "deck";
  const AccuracyReport hard = hard_report();
  EXPECT_TRUE(
      accuracy_text(none, context_of(&hard)).starts_with("a_0000.rad: no pair to decide\n"));
  EXPECT_EQ(accuracy_text(none, context_of()), "No pairs to measure.\n");
}

TEST(AccuracyText, OfExpertsHasEveryTierAndWhatFails) {
  AccuracyReport r = hard_report();
  TierResult t = tier_of("float", "distance", 30, 9, 0.125);
  count_failures(t);
  t.exact_share = 0.0005;
  t.dominated = true;
  TierResult plain = tier_of("double", "distance", 20, 0, 2e-7);
  plain.max_ulp = std::numeric_limits<double>::infinity();
  TierResult force = tier_of("robust", "force", 20, 0, 12345);
  force.rewritten = 5;
  r.tiers.insert(r.tiers.end(), {t, plain, force});
  const std::string text = accuracy_text(r, context_of(), false, 0, true);
  EXPECT_THAT(text, HasSubstr("\nNumber types and formulas, 4000 pairs of the hard cases\n"));
  EXPECT_THAT(text, Not(HasSubstr("(--verbose")));
  const auto row = [&](const char* pattern) {
    EXPECT_THAT(text, ContainsRegex(std::string("\n") + pattern + "\n"));
  };
  row("float +distance +30 +1\\.50 +0\\.125 +0\\.5 +6\\.2e-02 +9 +10 +11 +13 +14 +37\\.5 % "
      "+5\\.0e-02 "
      "% +dominated");
  row("double +distance +20 +1\\.00 +2\\.0e-07 +inf +1\\.0e-07 +0 +0 +0 +- +- +0 +0");
  row("reference +gaps +50 +2\\.50 +- +- +- +400 +- +0 +80 +- +0 +0");
  row("robust +force +20 +1\\.23e\\+04 .*");
  EXPECT_THAT(text, HasSubstr("\nKinds of hard cases (reference; robust only where it fails):\n"));
  row(" +3 +kind 3 +reference +0\\.25 +40 +20 +expected 3");
  row(" +5 +kind 5 +robust +0\\.25 +8 +4 +expected 5");
  EXPECT_THAT(text, Not(ContainsRegex("kind 5 +float")));
  r.families[1].decision_errors = 0;
  EXPECT_THAT(accuracy_text(r, context_of(), false, 0, true), Not(ContainsRegex("kind 5 +robust")));
  r.families[1].max_ulp = 1.5;
  EXPECT_THAT(accuracy_text(r, context_of(), false, 0, true), ContainsRegex("kind 5 +robust"));
}

TEST(AccuracyText, ExamplesCanBeTypedInAgain) {
  AccuracyReport r = hard_report();
  r.families[0].got = 1.25;
  EXPECT_EQ(accuracy_examples(r),
            "Examples of wrong decisions:\n"
            " 3 kind 3, reference: gap 1.5, distance 1.25, exactly 1.75\n   triangle, node last "
            "(0x0p+0, 0x1p-1, 0x1p-2) (0x1p+0, 0x1.8p+0, 0x1.4p+0) (0x1p+1, 0x1.4p+1, 0x1.2p+1) "
            "(0x1.8p+1, 0x1.cp+1, 0x1.ap+1) (0x1p+2, 0x1.2p+2, 0x1.1p+2)\n"
            " 5 kind 5, robust: gap 1.5, distance 1.25, exactly 1.75\n   edges "
            "(0x0p+0, 0x1p-1, 0x1p-2) (0x1p+0, 0x1.8p+0, 0x1.4p+0) (0x1p+1, 0x1.4p+1, 0x1.2p+1) "
            "(0x1.8p+1, 0x1.cp+1, 0x1.ap+1)\n");
  for (FamilyResult& f : r.families) f.decision_errors = f.non_finite = 0;
  EXPECT_EQ(accuracy_examples(r), "");
  r.families[0].non_finite = 1;
  r.families[0].example.triangle = false;
  EXPECT_THAT(accuracy_examples(r), HasSubstr("\n   quad, node last (0x0p+0"));
}

// ---- the page -------------------------------------------------------------------------------

/// Texts of the cells of the row that begins with `begin`.
std::vector<std::string> html_cells(const std::string& page, const std::string& begin) {
  std::vector<std::string> out;
  const auto at = page.find(begin);
  if (at == page.npos) return out;
  const std::string row = page.substr(at, page.find("</tr>", at) - at);
  for (auto td = row.find("<td"); td != row.npos; td = row.find("<td", td + 1)) {
    const auto from = row.find('>', td) + 1;
    out.push_back(row.substr(from, row.find("</td>", td) - from));
  }
  return out;
}

TEST(AccuracyPage, HasARowPerWordWithBarsAsLongAsTheTimes) {
  const AccuracyReport hard = hard_report();
  const std::string page = accuracy_html(deck_report(), context_of(&hard));
  // Scales end at 1.6 times the largest but exact: 0.4 s and 80 ns.
  const auto bar = [](const char* width, const char* more = "") {
    return std::string("<span class=\"bar") + more + "\" style=\"width:" + width + "%\"></span>";
  };
  using Cells = std::vector<std::string>;
  EXPECT_EQ(html_cells(page, "<tr data-accuracy=\"reference\">"),
            (Cells{bar("62.5") + "<b class=\"seconds\">0.25 s</b> <small>1.25 &times; "
                                 "<code>fast</code></small>",
                   "<b>7</b> <small>of 50 = 14 %</small>",
                   bar("62.5") + "<b>50 ns</b> <small>2.5 &times; <code>fast</code></small>",
                   "<b>400</b> <small>of 4000 = 10 %</small>",
                   "<b>80</b> <small>of 800 = 10 %</small>"}));
  EXPECT_EQ(
      html_cells(page, "<tr data-accuracy=\"fast\">"),
      (Cells{bar("50.0") + "<b class=\"seconds\">0.20 s</b> <small>1 &times;</small>",
             "<b>4</b> <small>of 50 = 8 %</small>",
             bar("25.0") + "<b>20 ns</b> <small>1 &times;</small>",
             "<b>100</b> <small>of 4000 = 2 %</small>", "<b>3</b> <small>of 800 = 0.4 %</small>"}));
  const std::vector<AccuracyChoice> choices = accuracy_choices_of(deck_report(), context_of(&hard));
  char spread[32];
  std::snprintf(spread, sizeof spread, "%.0f", std::ceil(100 * choices[2].deck->ratio.spread));
  EXPECT_EQ(html_cells(page, "<tr data-accuracy=\"robust\" class=\"default\">"),
            (Cells{bar("50.2") +
                       "<b class=\"seconds\">0.20 s</b> <small>no measurable difference "
                       "(&plusmn;" +
                       spread + " %)</small>",
                   "<b class=\"ok\">0</b> <small>of 50</small>",
                   bar("50.0") + "<b>40 ns</b> <small>2.0 &times; <code>fast</code></small>",
                   "<b class=\"ok\">0</b> <small>of 4000</small>",
                   "<b class=\"ok\">0</b> <small>of 800</small>"}));
  EXPECT_EQ(html_cells(page, "<tr data-accuracy=\"exact\">")[0],
            bar("100.0", " cut") +
                "<b class=\"seconds\">9.00 s</b> <small>45 &times; <code>fast</code></small>");
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\"><code>robust</code> <small>default</small></th>"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\"><code>fast</code></th>"));
  EXPECT_THAT(page, HasSubstr("<td data-label=\"Wrong, hard cases\" class=\"bad\"><b>400</b>"));
  EXPECT_THAT(page, HasSubstr("<td data-label=\"Wrong, deck\"><b class=\"ok\">0</b>"));
  EXPECT_THAT(page,
              HasSubstr("This deck: the whole of deck gaps, reading included. Hard cases: 4000 "
                        "pairs made to break arithmetic. Other answer: of 800 pairs"));
  const std::string alone = accuracy_html(hard, context_of());
  EXPECT_EQ(html_cells(alone, "<tr data-accuracy=\"fast\">").size(), 3u);
  EXPECT_THAT(alone, Not(HasSubstr("This deck")));
}

TEST(AccuracyPage, MarksEveryKindByHowOftenItIsWrong) {
  AccuracyReport hard = hard_report();
  const auto strips = [&] {
    return detail::accuracy_first_screen(accuracy_choices(hard, nullptr));
  };
  const std::string page = strips();
  EXPECT_THAT(page, HasSubstr("<div class=\"strip\" data-accuracy=\"reference\"><span "
                              "class=\"who\"><code>reference</code> <b>0 of 2</b> kinds</span>"));
  // 40 of 200 wrong is a fifth; 1 of 200 is under a tenth.
  EXPECT_THAT(page,
              HasSubstr("<button type=\"button\" class=\"l2\" data-kind=\"3\" "
                        "aria-label=\"kind 3, reference: 40 wrong of 200\" title=\"kind 3: 40 "
                        "wrong of 200\"></button><button type=\"button\" class=\"l1\" "
                        "data-kind=\"5\" tabindex=\"-1\" aria-label=\"kind 5, reference: 1 "
                        "wrong of 200\" title=\"kind 5: 1 wrong of 200\"></button></span>"));
  EXPECT_THAT(page, HasSubstr("class=\"l1\" data-kind=\"3\" aria-label=\"kind 3, fast"));
  EXPECT_THAT(page, HasSubstr("class=\"l0\" data-kind=\"3\" aria-label=\"kind 3, robust"));
  hard.kinds[0].decision_errors = 20;
  EXPECT_THAT(strips(), HasSubstr("class=\"l2\" data-kind=\"3\" aria-label=\"kind 3, reference"));
  hard.kinds[0].decision_errors = 19;
  EXPECT_THAT(strips(), HasSubstr("class=\"l1\" data-kind=\"3\" aria-label=\"kind 3, reference"));
  EXPECT_THAT(detail::accuracy_first_screen({}), HasSubstr("were not measured"));
}

TEST(AccuracyPage, SharesOfStagesAreThoseOfPairsAndTimes) {
  const std::string page = accuracy_html(hard_report(), context_of());
  // 900, 90 and 10 of 1000 pairs; 9000, 9000 and 11000 of 29000 ns.
  EXPECT_THAT(page, HasSubstr("Share of the pairs<div class=\"share\"><span class=\"s0\" "
                              "style=\"flex:0.900000\"></span><span class=\"s1\" "
                              "style=\"flex:0.090000\"></span><span class=\"s2\" "
                              "style=\"flex:0.010000\"></span></div>"));
  EXPECT_THAT(page, HasSubstr("Share of the time<div class=\"share\"><span class=\"s0\" "
                              "style=\"flex:0.310345\"></span><span class=\"s1\" "
                              "style=\"flex:0.310345\"></span><span class=\"s2\" "
                              "style=\"flex:0.379310\"></span></div>"));
  using Cells = std::vector<std::string>;
  EXPECT_EQ(html_cells(page, "<span class=\"swatch s0\">"),
            (Cells{"the filter in double is sure", "900", "90 %", "10", "31 %"}));
  EXPECT_EQ(html_cells(page, "<span class=\"swatch s2\">"),
            (Cells{"integers or rationals decide", "10", "1 %", "1100", "37.9 %"}));
  AccuracyReport none = hard_report();
  none.stages[0].pairs = 0;
  const std::string without = accuracy_html(none, context_of());
  EXPECT_THAT(without, Not(HasSubstr("<span class=\"s0\" style=\"flex")));
  none.stages.clear();
  EXPECT_THAT(accuracy_html(none, context_of()), Not(HasSubstr("Share of the pairs")));
}

TEST(AccuracyPage, OfExpertsHasTablesOfTiersAndAHeatMap) {
  AccuracyReport r = hard_report();
  TierResult t = tier_of("float", "distance", 30.25, 9, 0.125);
  t.non_finite = 11;
  t.rewritten = 12;
  t.invariance_violations = 3;
  t.fallback_share = 0.375;
  t.exact_share = 0.0625;
  TierResult huge = tier_of("double", "force", 1, 0, 2e6);
  r.tiers.insert(r.tiers.end(), {t, huge});
  const HardFamily* first = nullptr;
  for (const HardFamily& f : hard_families())
    if (f.sampled && first == nullptr) first = &f;
  ASSERT_NE(first, nullptr);
  r.families.clear();
  const std::uint64_t wrongs[] = {0, 9, 10, 50};
  for (const std::uint64_t wrong : wrongs) {
    FamilyResult f = family_of(first->id, "t", wrong);
    f.tier += std::to_string(wrong);
    f.non_finite = 0;
    r.families.push_back(f);
  }
  const std::string page = accuracy_html(r, context_of());
  using Cells = std::vector<std::string>;
  EXPECT_EQ(html_cells(page, "<tr><th class=\"l\" scope=\"row\">float</th>"),
            (Cells{"4000", "30.2", "9", "11", "0.125", "3 of 12", "37.5 %", "6.25 %"}));
  EXPECT_EQ(html_cells(page, "<tr><th class=\"l\" scope=\"row\">fast</th>"),
            (Cells{"4000", "20.0", "100", "0", "does not compute one", "3 of 800", "0 %", "0 %"}));
  EXPECT_EQ(html_cells(page, "<tr><th class=\"l\" scope=\"row\">double</th>")[4], "2.0e+06");
  EXPECT_EQ(html_cells(page, "<tr><th class=\"l\" scope=\"row\">double</th>")[5], "not asked");
  EXPECT_THAT(page, HasSubstr("<h3>Decision</h3>"));
  EXPECT_THAT(page, HasSubstr("<h3>Distance</h3>"));
  EXPECT_THAT(page, HasSubstr("<h3>Elastic force</h3>"));
  // Heat: none, under 5 %, under a quarter, more.
  const std::string id = std::to_string(first->id);
  EXPECT_THAT(page,
              HasSubstr("<td class=\"plain h0\" data-label=\"t0\" data-kind=\"" + id +
                        "\">0</td><td class=\"plain h1\" data-label=\"t9\" data-kind=\"" + id +
                        "\">9</td><td class=\"plain h2\" data-label=\"t10\" data-kind=\"" + id +
                        "\">10</td><td class=\"plain h3\" data-label=\"t50\" data-kind=\"" + id +
                        "\">50</td></tr>"));
  EXPECT_THAT(page, HasSubstr("<th>t0</th><th>t9</th><th>t10</th><th>t50</th></tr>"));
  r.families[1].non_finite = 1;
  EXPECT_THAT(accuracy_html(r, context_of()),
              HasSubstr("h2\" data-label=\"t9\" data-kind=\"" + id + "\">10</td>"));
  r.scene = "deck";
  EXPECT_THAT(accuracy_html(r, context_of()), Not(HasSubstr("Kinds of hard cases</h3>")));
}

TEST(AccuracyPage, HoldsItsDocumentChartsAndMotion) {
  const AccuracyReport r = hard_report();
  const std::string page = accuracy_html(r, context_of());
  EXPECT_TRUE(page.starts_with("<!doctype html>\n<html lang=\"en\">\n<head>\n"));
  EXPECT_TRUE(page.ends_with("</script>\n</body>\n</html>\n"));
  EXPECT_THAT(page, HasSubstr("<title>" + accuracy_title(r, context_of()) + "</title>"));
  EXPECT_THAT(page, HasSubstr("<small>the hard cases</small>"));
  const std::string mark = "id=\"accuracy-json\">";
  const auto at = page.find(mark) + mark.size();
  EXPECT_EQ(Json::parse(page.substr(at, page.find("</script>", at) - at)),
            Json::parse(accuracy_json(r, context_of())));
  EXPECT_THAT(page, HasSubstr("<figure tabindex=\"0\">" + accuracy_panel(r, "gaps")));
  EXPECT_THAT(page, HasSubstr("data-name=\"accuracy_gaps.svg\""));
  EXPECT_THAT(page, HasSubstr(motion_panel(hard_motion())));
  for (const std::string& sentence : motion_sentences(hard_motion(), "code"))
    EXPECT_THAT(page, HasSubstr("<p class=\"jump\">" + sentence + "</p>"));
  for (const std::string& line :
       {std::string("a processor"), accuracy_compiler(), std::string("deck accuracy")})
    EXPECT_THAT(page, HasSubstr("<p class=\"note\">" + line + "</p>"));
  AccuracyReport none;
  none.scene = "deck";
  const std::string empty = accuracy_html(none, context_of());
  EXPECT_THAT(empty, Not(HasSubstr("<section id=\"motion\">")));
  EXPECT_THAT(empty, Not(HasSubstr("For experts")));
  EXPECT_THAT(empty, Not(HasSubstr("Where robust spends")));
}

// ---- charts ---------------------------------------------------------------------------------

/// Elements of a drawing whose text begins so, each up to its end.
std::vector<std::string> elements(const std::string& svg, const std::string& begin) {
  std::vector<std::string> out;
  for (auto at = svg.find(begin); at != svg.npos; at = svg.find(begin, at + 1))
    out.push_back(svg.substr(at, svg.find('\n', at) - at));
  return out;
}

double number_of(const std::string& element, const std::string& name) {
  const auto at = element.find(" " + name + "='");
  return at == element.npos ? NAN : std::strtod(element.c_str() + at + name.size() + 3, nullptr);
}

/// Of a chart from 10 ns (x 84) to 100 us (x 890), on which a decade is 201.5 wide.
double chart_x(double ns) { return 84 + (std::log10(ns) - 1) / 4 * 806; }
/// Of wrong decisions from none, at -0.7 (y 372), to 1000 (y 34).
double chart_y(double wrong) {
  return 372 - ((wrong > 0 ? std::log10(wrong) : -0.7) + 0.7) / 3.7 * 338;
}

TEST(AccuracyChart, MarksStandAtTheirTimeAndWrongDecisions) {
  const AccuracyReport r = hard_report();
  const std::string svg = accuracy_panel(r, "gaps");
  const std::vector<std::string> marks = elements(svg, "<circle");
  ASSERT_EQ(marks.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const TierResult& t = r.tiers[i];
    EXPECT_NEAR(number_of(marks[i], "cx"), chart_x(t.ns_per_pair), 0.051) << t.name;
    EXPECT_NEAR(number_of(marks[i], "cy"), chart_y(static_cast<double>(t.decision_errors)), 0.051);
  }
  EXPECT_THAT(marks[0], HasSubstr("<title>reference: 50 ns, 400 wrong</title>"));
  // robust is faster and better than reference; exact is slower and not better.
  EXPECT_THAT(marks[0], HasSubstr("class='dk-mark dk-hollow'"));
  EXPECT_THAT(marks[1], HasSubstr("class='dk-mark'"));
  EXPECT_THAT(marks[2], HasSubstr("class='dk-mark'"));
  EXPECT_THAT(marks[3], HasSubstr("class='dk-mark dk-hollow'"));
  const std::vector<std::string> ring = elements(svg, "<rect x=");
  ASSERT_EQ(ring.size(), 1u);
  EXPECT_NEAR(number_of(ring[0], "x"), chart_x(40) - 10, 0.051);
  EXPECT_NEAR(number_of(ring[0], "y"), chart_y(0) - 10, 0.051);
  // The line: down to fast, on to robust, down, on to the rim.
  char path[160];
  std::snprintf(path, sizeof path,
                "<path d='M%.1f 34.0 V%.1f H%.1f V%.1f H890.0' class='dk-frontier'/>", chart_x(20),
                chart_y(100), chart_x(40), chart_y(0));
  EXPECT_THAT(svg, HasSubstr(path));
  EXPECT_THAT(svg, HasSubstr(">robust (default)</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("is better than robust")));
}

TEST(AccuracyChart, AxesHaveDecadesAndCounts) {
  const std::string svg = accuracy_panel(hard_report(), "gaps");
  const auto text_at = [&](const std::string& content) {
    for (const std::string& t : elements(svg, "<text"))
      if (t.find(">" + content + "</text>") != t.npos)
        return std::pair(number_of(t, "x"), number_of(t, "y"));
    ADD_FAILURE() << content;
    return std::pair(0.0, 0.0);
  };
  const std::pair<const char*, double> times[] = {{"10 ns", 10},
                                                  {"100 ns", 100},
                                                  {"1 \xc2\xb5s", 1e3},
                                                  {"10 \xc2\xb5s", 1e4},
                                                  {"100 \xc2\xb5s", 1e5}};
  for (const auto& [name, ns] : times) {
    EXPECT_NEAR(text_at(name).first, chart_x(ns), 0.051) << name;
    EXPECT_NEAR(text_at(name).second, 390, 1e-9);
  }
  const std::pair<const char*, double> counts[] = {
      {"none", 0}, {"1", 1}, {"10", 10}, {"100", 100}, {"1000", 1000}};
  for (const auto& [name, wrong] : counts) {
    EXPECT_NEAR(text_at(name).first, 76, 1e-9) << name;
    EXPECT_NEAR(text_at(name).second, chart_y(wrong) + 4, 0.051) << name;
  }
  EXPECT_EQ(text_at("Contact decision"), (std::pair(84.0, 20.0)));
  EXPECT_EQ(text_at("time per pair"), (std::pair(487.0, 410.0)));
  EXPECT_EQ(text_at("wrong decisions of 4000"), (std::pair(18.0, 203.0)));
  EXPECT_THAT(svg, HasSubstr("transform='rotate(-90 18 203.0)'"));
  EXPECT_THAT(svg,
              HasSubstr("aria-label='Contact decision: wrong decisions of 4000 against time'"));
  EXPECT_THAT(svg, HasSubstr("viewBox='0 0 920 440' width='920' height='440'"));
  // Five decades, ticks at 2 and 5 of all but the last, five levels.
  EXPECT_EQ(elements(svg, "<line").size(), 5u + 8u + 5u);
  const auto lines = elements(svg, "<line");
  EXPECT_NEAR(number_of(lines[1], "x1"), chart_x(20), 0.051);
  EXPECT_NEAR(number_of(lines[1], "y1"), 367, 1e-9);
  EXPECT_NEAR(number_of(lines[2], "x1"), chart_x(50), 0.051);
  EXPECT_NEAR(number_of(lines[0], "y1"), 34, 1e-9);
  EXPECT_NEAR(number_of(lines[0], "y2"), 372, 1e-9);
}

TEST(AccuracyChart, OfErrorsHasPowersOfTenAndOneUlp) {
  AccuracyReport r;
  r.scene = "deck";
  r.tiers = {tier_of("double", "distance", 10, 0, 1e-6), tier_of("robust", "distance", 1000, 0, 0),
             tier_of("far", "distance", 100, 0, std::numeric_limits<double>::infinity())};
  const std::string svg = accuracy_panel(r, "distance");
  // 22 decades from 1e-18 at the bottom to 1e4 at the top; two decades of time.
  const auto y = [](double power) { return 372 - (power + 18) / 22 * 338; };
  const std::vector<std::string> marks = elements(svg, "<circle");
  ASSERT_EQ(marks.size(), 3u);
  EXPECT_NEAR(number_of(marks[0], "cy"), y(-6), 0.051);
  EXPECT_NEAR(number_of(marks[1], "cy"), y(-18), 0.051) << "exact results stand at the bottom";
  EXPECT_NEAR(number_of(marks[2], "cy"), y(4), 0.051);
  EXPECT_NEAR(number_of(marks[1], "cx"), 890, 0.051);
  EXPECT_NEAR(number_of(marks[2], "cx"), 487, 0.051);
  EXPECT_THAT(marks[0], HasSubstr("double: 10 ns, error 1e-06"));
  const auto ulp = elements(svg, "<line x1='84.0' y1='");
  bool found = false;
  for (const std::string& l : ulp)
    if (l.find("dk-ulp") != l.npos) {
      found = true;
      EXPECT_NEAR(number_of(l, "y1"), y(-52 * std::log10(2.0)), 0.051);
      EXPECT_NEAR(number_of(l, "x2"), 890, 1e-9);
    }
  EXPECT_TRUE(found);
  for (const char* level :
       {">exact<", ">10\xe2\x81\xbb\xc2\xb9\xe2\x81\xb6<", ">10\xe2\x81\xbb\xc2\xb9\xc2\xb2<",
        ">10\xe2\x81\xbb\xe2\x81\xb8<", ">10\xe2\x81\xbb\xe2\x81\xb4<", ">1<", ">more<", ">1 ulp<"})
    EXPECT_THAT(svg, HasSubstr(level));
  EXPECT_THAT(svg, Not(HasSubstr(">10\xe2\x81\xb4<"))) << "too near to the top";
  EXPECT_THAT(svg, HasSubstr(">worst relative error of the distance</text>"));
  EXPECT_THAT(svg, HasSubstr(">Distance</text>"));
  // Of hard cases the error is taken over the size of the pair, half of it here.
  r.scene = "hard-cases";
  const std::string scaled = accuracy_panel(r, "distance");
  EXPECT_NEAR(number_of(elements(scaled, "<circle")[0], "cy"), y(std::log10(5e-7)), 0.051);
  EXPECT_THAT(scaled, HasSubstr(">worst error of the distance / size of the pair</text>"));
  for (TierResult& t : r.tiers) t.what = "force";
  EXPECT_THAT(accuracy_panel(r, "force"),
              HasSubstr(">worst error of the distance / size of the pair, from the force</text>"));
  EXPECT_THAT(accuracy_panel(r, "force"), HasSubstr(">Elastic contact force</text>"));
  r.scene = "deck";
  EXPECT_THAT(accuracy_panel(r, "force"), HasSubstr(">worst relative error of the force</text>"));
  EXPECT_EQ(accuracy_panel(r, "distance"), "");
}

TEST(AccuracyChart, SaysWhyTheDefaultIsOneThatAnotherBeats) {
  AccuracyReport r = hard_report();
  r.tiers[1].decision_errors = 0;
  EXPECT_THAT(accuracy_panel(r, "gaps"),
              HasSubstr(">fast is better than robust on these pairs, but "
                        "proves none of its answers; robust proves each.<"));
  r.tiers[1].name = "exact";
  EXPECT_THAT(accuracy_panel(r, "gaps"),
              HasSubstr(">exact is better than robust on these pairs.<"));
  // Times within their spread are equal.
  r.tiers[1].ns_per_pair = 40 / 1.02 + 0.01;
  EXPECT_THAT(accuracy_panel(r, "gaps"), Not(HasSubstr("is better than robust")));
  r.tiers[1].ns_per_pair = 40 / 1.02 - 0.01;
  EXPECT_THAT(accuracy_panel(r, "gaps"), HasSubstr("exact is better than robust"));
}

TEST(AccuracyChart, LabelsStandClearOfMarksAndOfOneAnother) {
  AccuracyReport r;
  r.scene = "hard-cases";
  for (int i = 0; i < 12; ++i) r.tiers.push_back(tier_of("tier", "gaps", 1000 + 3 * i, 100));
  const std::string svg = accuracy_panel(r, "gaps");
  struct Box {
    double x, y, width, height;
  };
  std::vector<Box> labels, marks;
  for (const std::string& t : elements(svg, "<text"))
    if (t.find("dk-label") != t.npos)
      labels.push_back({number_of(t, "x"), number_of(t, "y") - 11, 28, 14});
  for (const std::string& c : elements(svg, "<circle"))
    marks.push_back({number_of(c, "cx") - 8, number_of(c, "cy") - 8, 16, 16});
  ASSERT_EQ(labels.size(), 12u);
  const auto meets = [](const Box& a, const Box& b) {
    const double eps = 0.15;  // coordinates are rounded to a tenth
    return a.x + eps < b.x + b.width && b.x + eps < a.x + a.width && a.y + eps < b.y + b.height &&
           b.y + eps < a.y + a.height;
  };
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(meets(labels[i], labels[k])) << i << " " << k;
    for (const Box& m : marks) EXPECT_FALSE(meets(labels[i], m)) << i;
    EXPECT_GE(labels[i].x, 84 - 0.1);
    EXPECT_LE(labels[i].x + 28, 890.1);
    EXPECT_GE(labels[i].y, 26 - 0.1);
    EXPECT_LE(labels[i].y + 14, 374.1);
  }
  // The first stands right beside its mark; those far away have a line to it.
  EXPECT_NEAR(labels[0].x, marks[0].x + 8 + 10, 40);
  EXPECT_FALSE(elements(svg, "<line").empty());
  EXPECT_THAT(svg, HasSubstr("dk-lead"));
}

TEST(AccuracyChart, ForcesOfAMotionAreDrawnStepByStep) {
  HardMotion m;
  const Accuracy order[] = {Accuracy::reference, Accuracy::fast, Accuracy::robust, Accuracy::exact};
  for (const Accuracy a : order) {
    HardMotion::Line line;
    line.accuracy = a;
    line.force.assign(101, 0.5);
    line.force[100] = a == Accuracy::reference ? 2.5 : 1.5;
    if (a == Accuracy::reference) line.jumps = {25};
    if (a == Accuracy::robust) line.jumps = {50};
    m.lines.push_back(line);
  }
  const std::string svg = motion_panel(m);
  // From 30 to 348 in 100 steps; from 226 up to 62 for a force of 3.
  const auto x = [](double step) { return 30 + step / 100 * 318; };
  const auto y = [](double force) { return 226 - force / 3 * 164; };
  EXPECT_THAT(svg, HasSubstr("viewBox='0 0 360 264'"));
  const auto lines = elements(svg, "<polyline");
  ASSERT_EQ(lines.size(), 4u);
  const char* const classes[] = {"dk-line dk-exact dk-wide", "dk-line dk-reference dk-wide",
                                 "dk-line dk-fast", "dk-line dk-robust"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_THAT(lines[i], HasSubstr(std::string("class='") + classes[i] + "'/>"));
    char first[32], last[32];
    std::snprintf(first, sizeof first, "points='%.1f,%.1f %.1f,", x(0), y(0.5), x(1));
    std::snprintf(last, sizeof last, " %.1f,%.1f ' class", x(100), y(i == 1 ? 2.5 : 1.5));
    EXPECT_THAT(lines[i], HasSubstr(first));
    EXPECT_THAT(lines[i], HasSubstr(last));
  }
  const auto rings = elements(svg, "<rect x=");
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_NEAR(number_of(rings[0], "x"), x(25) - 7, 0.051);
  EXPECT_NEAR(number_of(rings[0], "y"), y(0.5) - 7, 0.051);
  EXPECT_THAT(rings[0], HasSubstr("data-accuracy='reference' data-step='25'"));
  EXPECT_THAT(rings[1], HasSubstr("data-accuracy='robust' data-step='50'"));
  EXPECT_THAT(svg, HasSubstr(">step 50</text>"));
  EXPECT_THAT(svg, Not(HasSubstr(">step 25</text>")));
  const auto text_at = [&](const std::string& content) {
    for (const std::string& t : elements(svg, "<text"))
      if (t.find(">" + content + "</text>") != t.npos)
        return std::pair(number_of(t, "x"), number_of(t, "y"));
    ADD_FAILURE() << content;
    return std::pair(0.0, 0.0);
  };
  for (const int force : {0, 1, 2, 3}) {
    bool found = false;
    for (const std::string& t : elements(svg, "<text x='22.0'"))
      found = found || (t.find(">" + std::to_string(force) + "<") != t.npos &&
                        std::abs(number_of(t, "y") - y(force) - 4) < 0.051);
    EXPECT_TRUE(found) << force;
  }
  EXPECT_EQ(text_at("25").second, 244);
  EXPECT_NEAR(text_at("75").first, x(75), 0.051);
  EXPECT_EQ(text_at("100").first, 348);
  EXPECT_EQ(text_at("step"), (std::pair(189.0, 260.0)));
  // The key: a stroke of 20 and its name, 76 apart, reference 98.
  EXPECT_EQ(text_at("exact").first, 55);
  EXPECT_EQ(text_at("reference").first, 131);
  EXPECT_EQ(text_at("fast").first, 229);
  EXPECT_EQ(text_at("robust").first, 305);
  EXPECT_NEAR(text_at("step 50").first, x(50) + 8, 0.051);
  EXPECT_NEAR(text_at("step 50").second, y(0.5) - 9, 0.051);
}

}  // namespace
}  // namespace deck::test
