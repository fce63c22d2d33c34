// Time histories: which variables, objects and lists the reference solver refuses.
#include <gtest/gtest.h>

#include "lint/support.hpp"

namespace deck::test {
namespace {

/// Messages of the findings of a rule, with their severity: "error 69".
std::vector<std::string> messages_of(const Linted& run, RuleId rule) {
  std::vector<std::string> out;
  for (const Diagnostic& d : run.result.diagnostics)
    if (d.rule == rule)
      out.push_back(std::string(d.severity == Severity::error ? "error" : "warning") + " " +
                    std::to_string(d.reference ? d.reference->number : 0));
  return out;
}

using Messages = std::vector<std::string>;

Linted history(const std::string& keyword, const std::string& lines) {
  return lint_example("/TH/" + keyword + "/1\nhistory\n" + lines);
}

TEST(HistoryVariables, EachUnknownWordIsError260) {
  const Linted bad = history("SHEL", "       FOO      EMIN        12\n         1\n");
  EXPECT_EQ(messages_of(bad, RuleId::DK650), (Messages{"error 260", "error 260"})) << bad.list();
  EXPECT_FALSE(bad.fires(RuleId::DK651)) << "EMIN is a variable";
}

TEST(HistoryVariables, MissingTitleMakesIdsVariables) {
  const Linted bad = lint_example("/TH/SHEL/1\n       DEF\n         1         0     first\n");
  EXPECT_EQ(messages_of(bad, RuleId::DK650).size(), 3u) << bad.list();
  EXPECT_EQ(messages_of(bad, RuleId::DK651), Messages{"error 1109"}) << bad.list();
}

TEST(HistoryVariables, GroupsNumbersAndFurtherLinesAreKnown) {
  for (const char* lines : {" DEF\n         1\n", "ALL\n", "USR5      SIG_1     SX_12\n",
                            "E1        E2\nK1        K2\n         1\n", "def\n"}) {
    const Linted good = history("SHEL", lines);
    EXPECT_FALSE(good.fires(RuleId::DK650)) << lines << good.list();
    EXPECT_FALSE(good.fires(RuleId::DK651)) << lines << good.list();
  }
  EXPECT_FALSE(history("INTER", "||FN||    |FX|\n").fires(RuleId::DK650));
  EXPECT_FALSE(history("BRIC", "EPS_12_3  SX1U2\n").fires(RuleId::DK650));
}

TEST(HistoryVariables, VariableOfAnotherHistoryIsAWarning) {
  EXPECT_EQ(messages_of(history("SHEL", "DX\n"), RuleId::DK650), Messages{"warning 0"});
  EXPECT_EQ(messages_of(history("NODE", "REAC\n"), RuleId::DK650), Messages{"warning 0"});
}

TEST(HistoryVariables, CommaAndParameterAreNotJudged) {
  for (const char* lines : {"DX,FOO\n", "&word\n"})
    EXPECT_FALSE(history("NODE", lines).fires(RuleId::DK650)) << lines;
}

TEST(HistoryVariables, NoneAtAllIsError1109) {
  for (const char* keyword : {"NODE", "PART", "SENSOR", "SECTIO"})
    EXPECT_EQ(messages_of(history(keyword, ""), RuleId::DK651), Messages{"error 1109"}) << keyword;
  EXPECT_FALSE(history("NODE", "DEF\n").fires(RuleId::DK651)) << "no object is legal";
}

TEST(HistoryObjects, MissingElementIsError69AndNodeError78) {
  for (const char* keyword :
       {"SHEL", "SHELL", "SH3N", "BRIC", "QUAD", "TRUSS", "BEAM", "SPRING", "SPHCEL"})
    EXPECT_EQ(messages_of(history(keyword, "DEF\n        99\n"), RuleId::DK652),
              Messages{"error 69"})
        << keyword;
  EXPECT_EQ(messages_of(history("NODE", "DEF\n        99\n"), RuleId::DK652), Messages{"error 78"});
}

TEST(HistoryObjects, LineWithoutAnIdIsAnObjectThatIsMissing) {
  for (const char* line : {"\n", "                    name\n", "text\n", "         0\n"}) {
    const Linted bad = history("SHEL", "DEF\n         1\n" + std::string(line));
    // A line that begins with a letter is one of ids where ids have begun.
    EXPECT_EQ(messages_of(bad, RuleId::DK652), Messages{"error 69"}) << line << bad.list();
  }
}

TEST(HistoryObjects, SkewOfANodeMayBeAFrame) {
  const std::string row = "DEF\n         1         7\n";
  EXPECT_EQ(messages_of(history("NODE", row), RuleId::DK652), Messages{"error 434"});
  const std::string axes =
      "fixed\n                 0.0                 0.0                 0.0\n"
      "                 0.0                 1.0                 0.0\n"
      "                 0.0                 0.0                 1.0\n";
  for (const char* keyword : {"/SKEW/FIX/7\n", "/FRAME/FIX/7\n"})
    EXPECT_FALSE(history("NODE", row + keyword + axes).fires(RuleId::DK652)) << keyword;
}

TEST(HistoryObjects, MissingPartIsWarning1610AndWrittenZerosCount) {
  EXPECT_EQ(messages_of(history("PART", "DEF\n         1        98        99\n"), RuleId::DK652),
            (Messages{"warning 1610", "warning 1610"}));
  const Linted zeros = history("PART", "DEF\n         1         0         0\n");
  EXPECT_EQ(messages_of(zeros, RuleId::DK652), Messages{"warning 1610"}) << zeros.list();
  EXPECT_FALSE(history("PART", "DEF\n         1                   2\n").fires(RuleId::DK652))
      << "a blank cell is no id";
  EXPECT_FALSE(history("PART", "DEF\n         0        99\n").fires(RuleId::DK652))
      << "0 first means all parts";
}

TEST(HistoryObjects, MissingIncludeMayHoldThem) {
  EXPECT_FALSE(history("NODE", "DEF\n        99\n#include absent.inc\n").fires(RuleId::DK652));
}

TEST(HistoryObjects, NothingIsClaimedWhereNobodyCounts) {
  EXPECT_FALSE(history("SECTIO", "DEF\n        99\n").fires(RuleId::DK652));
}

TEST(HistoryObjects, PartInTwoHistoriesIsError553) {
  const std::string first = "IE\n         1         2\n", again = "/TH/PART/2\nagain\nMASS\n";
  EXPECT_EQ(messages_of(history("PART", first + again + "         2         1\n"), RuleId::DK653),
            (Messages{"error 553", "error 553"}));
  EXPECT_FALSE(history("PART", first + again + "        99\n").fires(RuleId::DK653));
  EXPECT_FALSE(history("PART", first + again + "         0         1\n").fires(RuleId::DK653));
}

TEST(HistoryObjects, BlankAfterTheSlashIsNoKeyword) {
  EXPECT_EQ(SchemaSet::built_in().match("/ TRUSS/23"), nullptr);
  EXPECT_NE(SchemaSet::built_in().match("/TRUSS/ 23"), nullptr);
}

}  // namespace
}  // namespace deck::test
