// What `deck fix` reports: every figure of a repair, written out here, in JSON and in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/inspected.hpp"
#include "report/shared/fix.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

FixCount fix_count(std::uint64_t first, double deepest) {
  return {first, first + 1, first + 2, first + 3, deepest};
}

TieCounts tie_count(std::size_t first) {
  TieCounts n;
  n.nodes = first;
  n.tied = first + 1;
  n.not_found = first + 2;
  n.dropped = first + 3;
  n.elsewhere = first + 4;
  n.outside = first + 5;
  return n;
}

/// A repair in which no two figures are the same.
PenetrationFix whole_fix(const char* strategy = "reduce-gap") {
  PenetrationFix fix;
  fix.strategy = strategy;
  fix.interfaces = {{11, 7, "first", fix_count(20, 0.5), fix_count(30, 0.25), {}},
                    {12, 25, "second", fix_count(40, 0.75), fix_count(0, 0), {}}};
  fix.interfaces[0].changes = {{"Gapmin", "1.25", "0.9", 1.25, 0.9}, {"Igap", "", "2", 1, 2}};
  fix.moved = {{101, 3, {0.5, -1.5, 2.5}, 3.5}, {102, 0, {0.125, 0, 0}, 0.125}};
  fix.refused = {{11, {7, 8}, 0.0625, "an edge", 0}, {12, {9}, 0, "far away", 40.5}};
  fix.actions = {{11,
                  {1},
                  {2, 3, 4, 5},
                  0.3,
                  0.7,
                  PenetrationAction::none,
                  PenetrationAction::gap_reduced,
                  true,
                  0.4}};
  fix.ties = {{21, "a tie", 6.5, tie_count(50), tie_count(60), 5.5, {{71, {1, 2, 3, 3}, 4.5}}, {}},
              {22, "another", 7.5, tie_count(70), tie_count(80), 0, {}, {}}};
  fix.ties[0].changes = {{"dsearch", "", "6", 0, 6}};
  fix.crossings_before = 5;
  fix.crossings_after = 4;
  fix.tied_pairs = 64;
  fix.tied_nodes = 28;
  fix.iterations = 13;
  fix.complete = true;
  return fix;
}

Json count_of(int first, double deepest) {
  return {{"pairs", first},
          {"nodes", first + 1},
          {"untreated", first + 2},
          {"on_surface", first + 3},
          {"deepest", deepest}};
}

Json ties_of(int first) {
  return {{"nodes", first},       {"tied", first + 1},      {"not_found", first + 2},
          {"dropped", first + 3}, {"elsewhere", first + 4}, {"outside", first + 5}};
}

const Json interfaces_of_whole = Json::array({{{"id", 11},
                                               {"type", 7},
                                               {"title", "first"},
                                               {"before", count_of(20, 0.5)},
                                               {"after", count_of(30, 0.25)},
                                               {"changes", Json::array({{{"field", "Gapmin"},
                                                                         {"old_text", "1.25"},
                                                                         {"new_text", "0.9"},
                                                                         {"old_value", 1.25},
                                                                         {"new_value", 0.9}},
                                                                        {{"field", "Igap"},
                                                                         {"old_text", ""},
                                                                         {"new_text", "2"},
                                                                         {"old_value", 1.0},
                                                                         {"new_value", 2.0}}})}},
                                              {{"id", 12},
                                               {"type", 25},
                                               {"title", "second"},
                                               {"before", count_of(40, 0.75)},
                                               {"after", count_of(0, 0)},
                                               {"changes", Json::array()}}});

const Json ties_of_whole = Json::array(
    {{{"id", 21},
      {"title", "a tie"},
      {"reach", 6.5},
      {"before", ties_of(50)},
      {"after", ties_of(60)},
      {"needed", 5.5},
      {"nodes", Json::array({{{"node", 71}, {"segment", Json({1, 2, 3, 3})}, {"distance", 4.5}}})},
      {"changes", Json::array({{{"field", "dsearch"},
                                {"old_text", ""},
                                {"new_text", "6"},
                                {"old_value", 0.0},
                                {"new_value", 6.0}}})}},
     {{"id", 22},
      {"title", "another"},
      {"reach", 7.5},
      {"before", ties_of(70)},
      {"after", ties_of(80)},
      {"needed", nullptr},
      {"nodes", Json::array()},
      {"changes", Json::array()}}});

const Json crossings_of_whole = {{"before", 5}, {"after", 4}};

const Json refused_of_whole = Json::array({{{"interface", 11},
                                            {"nodes", Json({7, 8})},
                                            {"depth", 0.0625},
                                            {"distance", nullptr},
                                            {"reason", "an edge"}},
                                           {{"interface", 12},
                                            {"nodes", Json::array({9})},
                                            {"depth", 0.0},
                                            {"distance", 40.5},
                                            {"reason", "far away"}}});

/// What is said of one of several strategies. Solved: the 40 pairs of interface 12; not treated:
/// the 30 pairs of interface 11 and the 125 and 165 nodes of the ties, of all of which something
/// was refused.
Json step_of_whole() {
  return {{"strategy", "reduce-gap"},
          {"complete", true},
          {"crossings", crossings_of_whole},
          {"interfaces", interfaces_of_whole},
          {"ties", ties_of_whole},
          {"moved", Json({101, 102})},
          {"not_treated", 2},
          {"score", {{"solved", 40}, {"left", 0}, {"not_treated", 320}}}};
}

Json written(const PenetrationFix& fix, const std::vector<PenetrationFix>& steps = {}) {
  static const Inspected d(plates());
  Json all = Json::parse(fix_json(d.loaded, fix, "in-place", steps));
  EXPECT_EQ(all["schema"], Json({{"id", "deck/fix"}, {"version", 1}}));
  EXPECT_EQ(all["deck"]["path"], "test_0000.rad");
  EXPECT_EQ(all["examined"], 1);
  EXPECT_EQ(all["not_examined"], Json::array());
  EXPECT_EQ(all["verdict"]["counts"]["pairs"], 4);
  for (const char* head : {"schema", "tool", "deck", "examined", "not_examined", "verdict"})
    EXPECT_EQ(all.erase(head), 1u) << head;
  return all;
}

TEST(FixJson, HasEveryFigureOfARepair) {
  const Json expected = {
      {"strategy", "reduce-gap"},
      {"written", "in-place"},
      {"complete", true},
      {"iterations", 13},
      {"tied", {{"pairs", 64}, {"nodes", 28}}},
      {"crossings", crossings_of_whole},
      {"interfaces", interfaces_of_whole},
      {"ties", ties_of_whole},
      {"moved",
       Json::array({{{"node", 101}, {"part", 3}, {"by", Json({0.5, -1.5, 2.5})}, {"distance", 3.5}},
                    {{"node", 102},
                     {"part", nullptr},
                     {"by", Json({0.125, 0.0, 0.0})},
                     {"distance", 0.125}}})},
      {"actions", Json::array({{{"interface", 11},
                                {"secondary", Json::array({1})},
                                {"main", Json({2, 3, 4, 5})},
                                {"depth", 0.3},
                                {"gap", 0.7},
                                {"before", "none"},
                                {"after", "gap-reduced"},
                                {"solver_stops", true},
                                {"gap_left", 0.4}}})},
      {"not_treated", refused_of_whole}};
  EXPECT_EQ(written(whole_fix()), expected);
  EXPECT_EQ(written(whole_fix(), {whole_fix()}), expected) << "one strategy is no list of steps";
}

TEST(FixJson, OfSeveralStrategiesHasEveryStep) {
  const Json two = written(whole_fix(), {whole_fix(), whole_fix()});
  EXPECT_EQ(two["steps"], Json::array({step_of_whole(), step_of_whole()}));
  EXPECT_FALSE(two.contains("proposals"));
}

TEST(FixJson, WithoutAStrategyHasProposals) {
  const Json one = written(whole_fix(""), {whole_fix()});
  EXPECT_EQ(one["strategy"], Json());
  EXPECT_EQ(one["proposals"], Json::array({step_of_whole()}));
  EXPECT_FALSE(one.contains("steps"));
  EXPECT_EQ(written(whole_fix("")).at("proposals"), Json::array());
}

TEST(FixJson, OfTheRepairInAPageHasWhatIsLeftAndWhatToCallNext) {
  EXPECT_EQ(Json::parse(repair_json(whole_fix(), {{"does this", "deck a"}, {"does that", "deck b"}},
                                    "--- a")),
            Json({{"strategy", "reduce-gap"},
                  {"crossings", crossings_of_whole},
                  {"not_treated", refused_of_whole},
                  {"next", Json::array({{{"does", "does this"}, {"command", "deck a"}},
                                        {{"does", "does that"}, {"command", "deck b"}}})},
                  {"patch", "--- a"}}));
}

/// Cells of the line of a table that begins with `first`, by two or more blanks between them.
std::vector<std::string> cells_of(const std::string& text, const std::string& first) {
  std::size_t at = 0;
  for (; at < text.size(); at = text.find('\n', at) + 1) {
    const std::string line = text.substr(at, text.find('\n', at) - at);
    std::vector<std::string> cells;
    for (std::size_t i = line.find_first_not_of(' '); i < line.size();) {
      const std::size_t end = std::min(line.find("  ", i), line.size());
      cells.push_back(line.substr(i, end - i));
      i = std::min(line.find_first_not_of(' ', end), line.size());
    }
    if (!cells.empty() && cells[0] == first) return cells;
    if (text.find('\n', at) == std::string::npos) break;
  }
  return {};
}

using Cells = std::vector<std::string>;

TEST(FixText, HasARowPerInterfaceWithWhatChanged) {
  const std::string text = fix_text(whole_fix());
  EXPECT_EQ(cells_of(text, "11"), (Cells{"11", "TYPE7", "20", "30", "0.5", "0.25",
                                         "Gapmin 1.25 -> 0.9, Igap (1) -> 2", "first"}));
  EXPECT_EQ(cells_of(text, "12"), (Cells{"12", "TYPE25", "40", "0", "0.75", "0", "-", "second"}));
  EXPECT_EQ(cells_of(text, "21"),
            (Cells{"21", "50", "105", "125", "6.5", "5.5", "dsearch (by pair) -> 6", "a tie"}));
  EXPECT_EQ(cells_of(text, "22"), (Cells{"22", "70", "145", "165", "7.5", "-", "-", "another"}));
  EXPECT_THAT(text, HasSubstr("\n64 pairs tied (28 nodes), as before\n"));
}

TEST(FixText, OfFlagsHasARowPerInterfaceWithWhatIsUntreated) {
  const std::string text = fix_text(whole_fix("inacti"));
  EXPECT_EQ(cells_of(text, "11"), (Cells{"11", "TYPE7", "30", "22", "32", "0.25",
                                         "Gapmin 1.25 -> 0.9, Igap (1) -> 2", "first"}));
  EXPECT_EQ(cells_of(text, "12"), (Cells{"12", "TYPE25", "0", "42", "2", "0", "-", "second"}));
  EXPECT_EQ(cells_of(fix_text(whole_fix("fpenmax")), "12"), cells_of(text, "12"));
}

TEST(FixText, ListsTheFarthestMovesFirst) {
  PenetrationFix fix = whole_fix();
  std::swap(fix.moved[0], fix.moved[1]);
  fix.moved.push_back({103, 3, {1, 2, -2}, 3});
  const std::string text = fix_text(fix);
  EXPECT_THAT(text, HasSubstr("\nmoved, by part: 1 of no part, 2 of part 3\n"));
  const auto first = text.find("101"), second = text.find("103"), third = text.find("102");
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_EQ(cells_of(text, "101"), (Cells{"101", "3", "3.5", "0.5", "-1.5", "2.5"}));
  EXPECT_EQ(cells_of(text, "102"), (Cells{"102", "-", "0.125", "0.125", "0", "0"}));
  EXPECT_THAT(text, Not(HasSubstr("more")));
  FixTextOptions few;
  few.rows = 1;
  const std::string cut = fix_text(fix, few);
  EXPECT_THAT(cut, HasSubstr("\nmoved, by part: 1 of no part and 1 more parts\n"));
  EXPECT_EQ(cells_of(cut, "103"), Cells{});
  EXPECT_THAT(cut, HasSubstr("  ... and 2 more (--json lists all)\n"));
}

TEST(FixText, GathersWhatWasNotTreatedByReason) {
  PenetrationFix fix = whole_fix();
  fix.refused = {{11, {7, 8}, 0.0625, "an edge", 0}, {11, {6}, 0.5, "an edge", 0},
                 {12, {9}, 0, "far", 40.5},          {12, {10}, 0, "far", 39},
                 {12, {}, 0, "all of it", 0},        {13, {1}, 0, "an edge", 0}};
  for (int i = 21; i < 25; ++i) fix.refused.push_back({11, {i}, 0, "an edge", 0});
  EXPECT_THAT(fix_text(fix),
              HasSubstr("\nnot treated:\n"
                        "  interface 11, 6 nodes or edges, up to 0.5 deep: an edge (7-8, 6, 21, "
                        "22, 23, ...)\n"
                        "  interface 12, 2 nodes, up to 40.5 away: far (9, 10)\n"
                        "  interface 12: all of it\n"
                        "  interface 13, 1 node or edge: an edge (1)\n"));
  fix.refused.pop_back();
  EXPECT_THAT(fix_text(fix), HasSubstr("(7-8, 6, 21, 22, 23)\n"));
  FixTextOptions few;
  few.rows = 2;
  EXPECT_THAT(fix_text(fix, few), HasSubstr("(9, 10)\n  ... and 2 more groups (--json lists all)"));
}

TEST(FixText, CountsWhatTheSolverWillDo) {
  PenetrationFix fix = whole_fix();
  FixAction off = fix.actions[0];
  off.after = PenetrationAction::node_stiffness_zero;
  fix.actions = {fix.actions[0], off, fix.actions[0]};
  fix.actions[2].interface_id = 10;
  fix.actions.push_back(fix.actions[0]);
  EXPECT_THAT(fix_text(fix),
              HasSubstr("\nthe solver will then:\n"
                        "  interface 10: reduce the gap for 1 pair\n"
                        "  interface 11: switch the node off for the whole interface for 1 pair\n"
                        "  interface 11: reduce the gap for 2 pairs\n"));
  FixTextOptions few;
  few.rows = 1;
  EXPECT_THAT(fix_text(fix, few),
              HasSubstr("for 1 pair\n  ... (--json lists every pair)\n\nnot treated"));
}

TEST(FixText, SaysHowManyCrossedElementsStay) {
  PenetrationFix fix = whole_fix();
  EXPECT_THAT(fix_text(fix), HasSubstr("\n4 crossed elements stay: no fix"));
  fix.crossings_after = 1;
  EXPECT_THAT(fix_text(fix), HasSubstr("\n1 crossed element stays: no fix"));
  fix.crossings_after = 0;
  EXPECT_THAT(fix_text(fix), Not(HasSubstr("crossed")));
}

TEST(FixVerdict, NamesFiguresBeforeAndAfterAndMoves) {
  PenetrationFix fix = whole_fix();
  fix.ties.clear();
  EXPECT_EQ(fix_verdict(fix),
            "reduce-gap: 60 penetrations before (deepest 0.75), 30 after (deepest 0.25); 2 nodes "
            "moved by up to 3.5 in 13 iterations");
  fix.iterations = 0;
  fix.moved.pop_back();
  fix.interfaces[0].before.pairs = 1;
  fix.interfaces[0].after.pairs = 0;
  fix.interfaces.pop_back();
  EXPECT_EQ(fix_verdict(fix),
            "reduce-gap: 1 penetration before (deepest 0.5), 0 after; 1 node moved by up to 3.5");
  fix.moved.clear();
  fix.strategy = "inacti";
  EXPECT_EQ(fix_verdict(fix), "inacti: 1 penetration, 22 without treatment before, 32 after");
}

TEST(FixVerdict, OfTiesCountsNodesBeforeAndAfter) {
  // Lost are not found and dropped: 52 + 53 and 72 + 73 before, 62 + 63 and 82 + 83 after; beyond
  // a rim 65 - 55 and 85 - 75 more than before.
  PenetrationFix fix = whole_fix("tie");
  const std::string said =
      "tie: 250 of 120 nodes not tied before, 290 after; 20 of them tied beyond a rim";
  EXPECT_EQ(fix_verdict(fix), said);
  EXPECT_THAT(fix_verdict(whole_fix()), HasSubstr(" in 13 iterations; " + said));
  for (FixedTie& tie : fix.ties) tie.after.outside = tie.before.outside - 1;
  EXPECT_EQ(fix_verdict(fix), "tie: 250 of 120 nodes not tied before, 290 after");
  fix.ties.clear();
  EXPECT_EQ(fix_verdict(fix), "tie: nothing done");
  fix.refused.clear();
  EXPECT_EQ(fix_verdict(fix), "no node of a TYPE2 is untied: nothing to fix");
}

TEST(FixVerdict, WithoutInterfacesTellsWhetherAllWasEvaluated) {
  PenetrationFix fix = whole_fix();
  fix.interfaces.clear();
  fix.ties.clear();
  EXPECT_EQ(fix_verdict(fix), "no initial penetrations where they were evaluated");
  fix.refused.clear();
  EXPECT_EQ(fix_verdict(fix), "no initial penetrations: nothing to fix");
  // What was refused of a tie is about nodes of the tie, not about contacts.
  fix.ties = whole_fix().ties;
  fix.refused = {{21, {9}, 0, "far away", 40.5}};
  EXPECT_THAT(fix_verdict(fix), HasSubstr("no initial penetrations: nothing to fix; tie: "));
  fix.refused.push_back({23, {9}, 0, "far away", 40.5});
  EXPECT_THAT(fix_verdict(fix), HasSubstr("where they were evaluated; tie: "));
}

std::string proposed(const std::vector<PenetrationFix>& proposals) {
  return fix_proposals_text(proposals, [](std::string_view s) { return "CALL " + std::string(s); });
}

/// A strategy that leaves `left` of 5 pairs of an interface.
PenetrationFix leaving(const char* strategy, std::uint64_t left) {
  PenetrationFix fix;
  fix.strategy = strategy;
  fix.interfaces = {{1, 7, "i", {5, 5, 5, 0, 0.5}, {left, left, left, 0, 0.5}, {}}};
  fix.complete = left == 0;
  return fix;
}

TEST(FixProposals, CompareTheStrategiesAndCallTheBest) {
  std::vector<PenetrationFix> all{leaving("reduce-gap", 2), leaving("move", 1)};
  all[0].interfaces[0].changes = {{"Gapmin", "1", "0.5", 1, 0.5}};
  all[1].moved = {{101, 3, {3, 0, 0}, 3}, {102, 3, {4, 0, 0}, 4}};
  all[1].refused = {{1, {9}, 0.5, "held", 0}};
  const std::string text = proposed(all);
  EXPECT_THAT(text, HasSubstr("5 penetrations (deepest 0.5)\n\nwhat each strategy would do:\n"));
  for (const PenetrationFix& fix : all) {
    const FixScore s = score_of(fix);
    const Cells row = cells_of(text, fix.strategy);
    ASSERT_EQ(row.size(), 5u);
    EXPECT_EQ(
        (Cells{row[1], row[2], row[3]}),
        (Cells{std::to_string(s.solved), std::to_string(s.left), std::to_string(s.not_treated)}));
  }
  EXPECT_EQ(cells_of(text, "reduce-gap").back(), "Gapmin 1 -> 0.5");
  EXPECT_EQ(cells_of(text, "move").back(), "2 nodes moved by up to 4");
  EXPECT_THAT(text, HasSubstr("\nnot treated:\n  move, interface 1, 1 node or edge, up to 0.5 "
                              "deep: held (9)\n"));
  EXPECT_THAT(text, HasSubstr("\nto do it:\n  CALL move\n"));
  all[1].interfaces[0].after = all[0].interfaces[0].after = all[0].interfaces[0].before;
  EXPECT_THAT(proposed(all), HasSubstr("\nno strategy solves any of them\n"));
}

TEST(FixProposals, NameInterfacesTiesAndCrossedElements) {
  PenetrationFix fix = leaving("reduce-gap", 2);
  fix.interfaces.push_back(fix.interfaces[0]);
  fix.interfaces[1].id = 2;
  for (FixedInterface& i : fix.interfaces) i.changes = {{"Gapmin", "1", "0.5", 1, 0.5}};
  fix.crossings_before = fix.crossings_after = 3;
  fix.tied_pairs = 4;
  fix.tied_nodes = 1;
  const std::string text = proposed({fix});
  EXPECT_THAT(text, HasSubstr("10 penetrations (deepest 0.5), 3 crossed elements; 4 pairs tied (1 "
                              "node), left alone\n"));
  EXPECT_EQ(cells_of(text, "reduce-gap").back(), "Gapmin 1 -> 0.5, ... of 2 interfaces");
  EXPECT_THAT(text, HasSubstr("\n3 crossed elements stay: "));
  fix.crossings_before = fix.crossings_after = 0;
  fix.tied_pairs = 0;
  EXPECT_THAT(proposed({fix}), HasSubstr("10 penetrations (deepest 0.5)\n"));
}

TEST(FixProposals, OfNothingSayWhetherAllWasEvaluated) {
  PenetrationFix none;
  none.strategy = "reduce-gap";
  none.complete = true;
  EXPECT_EQ(proposed({none}), "no initial penetrations: nothing to fix\n");
  none.tied_pairs = none.tied_nodes = 2;
  EXPECT_EQ(proposed({none}), "no initial penetrations: nothing to fix; 2 pairs tied (2 nodes)\n");
  none.complete = false;
  none.refused = {{1, {}, 0, "too many pairs", 0}};
  EXPECT_EQ(proposed({none}),
            "no initial penetrations where they were evaluated\n\nnot treated:\n"
            "  interface 1: too many pairs\n");
}

TEST(FixProposals, OfTiesStandByThemselves) {
  PenetrationFix none, tie = whole_fix("tie");
  none.strategy = "reduce-gap";
  tie.interfaces.clear();
  tie.moved.clear();
  tie.refused = {{21, {9}, 0, "far", 40.5}};
  tie.crossings_before = tie.crossings_after = tie.tied_pairs = 0;
  tie.complete = false;
  for (FixedTie& t : tie.ties) t.after.not_found = t.after.dropped = 0;
  const std::string text = proposed({none, tie});
  EXPECT_THAT(text, HasSubstr("no initial penetrations: nothing to fix\n\n250 of 120 nodes of "
                              "TYPE2 are not tied\n"));
  EXPECT_EQ(cells_of(text, "21")[3], "0");
  EXPECT_THAT(text, HasSubstr("\nnot treated:\n  interface 21, 1 node, up to 40.5 away: far (9)"));
  EXPECT_THAT(text, HasSubstr("\nto tie them:\n  CALL tie\n"));
  for (FixedTie& t : tie.ties) t.after = t.before;
  EXPECT_THAT(proposed({none, tie}), Not(HasSubstr("to tie them")));
}

}  // namespace
}  // namespace deck::test
