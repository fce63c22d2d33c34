// Time histories: which variables, objects and lists the reference solver refuses.
#include <gtest/gtest.h>

#include "lint/support.hpp"

namespace deck::test {
namespace {

/// Messages of the findings of a rule, with their severity: "error 69".
std::vector<std::string> messages_of(const Linted& run, RuleId rule) {
  std::vector<std::string> out;
  for (const Finding& d : run.result.findings)
    if (d.rule == rule)
      out.push_back(std::string(d.severity == Severity::error ? "error" : "warning") + " " +
                    std::to_string(d.reference ? d.reference->number : 0));
  return out;
}

using Messages = std::vector<std::string>;

/// A history, its lines, a rule and what it finds: "error 69", in their order.
struct History {
  std::string keyword, lines;
  RuleId rule;
  Messages found = {};
};

void expect_found(const std::vector<History>& rows) {
  for (const History& row : rows) {
    const Linted run = lint_example("/TH/" + row.keyword + "/1\nhistory\n" + row.lines);
    EXPECT_EQ(messages_of(run, row.rule), row.found) << row.keyword << "\n"
                                                     << row.lines << run.list();
  }
}

TEST(HistoryVariables, AreWordsOfTheirHistory) {
  using enum RuleId;
  expect_found(
      {{"SHEL", "       FOO      EMIN        12\n         1\n", DK650, {"error 260", "error 260"}},
       {"SHEL", "       FOO      EMIN        12\n         1\n", DK651},  // EMIN is one
       {"INTER", "||FN||    |FX|\n", DK650},
       {"BRIC", "EPS_12_3  SX1U2\n", DK650},
       {"SHEL", "DX\n", DK650, {"warning 0"}},  // of another history
       {"NODE", "REAC\n", DK650, {"warning 0"}},
       {"NODE", "DX,FOO\n", DK650},
       {"NODE", "&word\n", DK650},
       {"NODE", "DEF\n", DK651}});  // no object is legal
  for (const char* lines : {" DEF\n         1\n", "ALL\n", "USR5      SIG_1     SX_12\n",
                            "E1        E2\nK1        K2\n         1\n", "def\n"})
    expect_found({{"SHEL", lines, DK650}, {"SHEL", lines, DK651}});
  for (const char* keyword : {"NODE", "PART", "SENSOR", "SECTIO"})
    expect_found({{keyword, "", DK651, {"error 1109"}}});
}

TEST(HistoryVariables, MissingTitleMakesIdsVariables) {
  const Linted bad = lint_example("/TH/SHEL/1\n       DEF\n         1         0     first\n");
  EXPECT_EQ(messages_of(bad, RuleId::DK650).size(), 3u) << bad.list();
  EXPECT_EQ(messages_of(bad, RuleId::DK651), Messages{"error 1109"}) << bad.list();
}

TEST(HistoryObjects, ThatAreMissingHaveTheMessageOfTheirKind) {
  using enum RuleId;
  for (const char* keyword :
       {"SHEL", "SHELL", "SH3N", "BRIC", "QUAD", "TRUSS", "BEAM", "SPRING", "SPHCEL"})
    expect_found({{keyword, "DEF\n        99\n", DK652, {"error 69"}}});
  // A line that begins with a letter is one of ids where ids have begun.
  for (const char* line : {"\n", "                    name\n", "text\n", "         0\n"})
    expect_found({{"SHEL", std::string("DEF\n         1\n") + line, DK652, {"error 69"}}});
  const std::string axes =
      "fixed\n                 0.0                 0.0                 0.0\n"
      "                 0.0                 1.0                 0.0\n"
      "                 0.0                 0.0                 1.0\n";
  const std::string skew = "DEF\n         1         7\n";
  const std::string again = "IE\n         1         2\n/TH/PART/2\nagain\nMASS\n";
  expect_found({
      {"NODE", "DEF\n        99\n", DK652, {"error 78"}},
      {"NODE", "DEF\n        99\n#include absent.inc\n", DK652},
      {"NODE", skew, DK652, {"error 434"}},
      {"NODE", skew + "/SKEW/FIX/7\n" + axes, DK652},
      {"NODE", skew + "/FRAME/FIX/7\n" + axes, DK652},
      {"PART", "DEF\n         1        98        99\n", DK652, {"warning 1610", "warning 1610"}},
      {"PART", "DEF\n         1         0         0\n", DK652, {"warning 1610"}},  // written zeros
      {"PART", "DEF\n         1                   2\n", DK652},  // a blank cell is no id
      {"PART", "DEF\n         0        99\n", DK652},            // 0 first means all parts
      {"SECTIO", "DEF\n        99\n", DK652, {"warning 257"}},
      {"GAUGE", "DEF\n        99\n", DK652},  // nobody counts them
      {"PART", again + "         2         1\n", DK653, {"error 553", "error 553"}},
      {"PART", "DEF\n         1\n         1\n", DK653, {"error 553"}},
      {"PART", again + "        99\n", DK653},
      {"PART", again + "         0         1\n", DK653},
  });
}

}  // namespace
}  // namespace deck::test
