// The writers of lint results: places, carets, escapes, bounds.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/shared/columns.hpp"
#include "lint/support.hpp"
#include "report/shared/diagnostics.hpp"

namespace deck::test {
namespace {

std::vector<LintedDeck> one(const Linted& run) {
  return {{"deck_0000.rad", run.deck, &run.result, ""}};
}

LintOptions only(std::string rule) {
  LintOptions o;
  o.select = {std::move(rule)};
  return o;
}

TEST(HumanReport, PointsAtTheCell) {
  const Linted run = lint_example("@/INTER/TYPE7/1 Istf=7\n", only("DK201"));
  const std::string text = lint_human(one(run), {});
  EXPECT_NE(text.find("warning[DK201:Istf]: Istf of /INTER/TYPE7 1 is 7"), std::string::npos)
      << text;
  EXPECT_NE(text.find("         2         1         7\n"), std::string::npos) << text;
  EXPECT_NE(text.find("                             ^\n"), std::string::npos) << text;
  EXPECT_NE(text.find("= solver: "), std::string::npos);
  EXPECT_NE(text.find("= help: Write one of the legal values"), std::string::npos);
  EXPECT_NE(text.find("0 errors, 1 warning"), std::string::npos);
  EXPECT_NE(text.find("not checked:"), std::string::npos);
  EXPECT_EQ(text.find('\x1b'), std::string::npos) << "no colours unless asked for";
}

TEST(HumanReport, ColoursAndRulerOnRequest) {
  const Linted run = lint_example("@/INTER/TYPE7/1 Istf=7\n", only("DK201"));
  HumanOptions options;
  options.color = options.ruler = true;
  const std::string text = lint_human(one(run), options);
  EXPECT_NE(text.find("\x1b[1;33mwarning[DK201:Istf]"), std::string::npos);
  EXPECT_NE(text.find("....+....1....+....2"), std::string::npos);
}

TEST(HumanReport, CutsLongLinesAroundTheCaretAndFloodsPerRule) {
  std::string text = "/SKEW/FIX/1\naxes\n";
  for (int i = 0; i < 3; ++i) text += std::string(99, ' ') + "0" + std::string(400, 'x') + "\n";
  const Linted run = lint_example(text, only("DK012"));
  ASSERT_EQ(run.count(RuleId::DK012), 3u) << run.list();
  HumanOptions options;
  options.per_rule = 1;
  const std::string out = lint_human(one(run), options);
  EXPECT_NE(out.find("2 more findings of DK012"), std::string::npos) << out;
  for (std::size_t at = 0; at < out.size();) {
    const auto nl = out.find('\n', at);
    EXPECT_LT(nl - at, 260u) << out.substr(at, nl - at);
    at = nl + 1;
  }
}

/// Twenty interfaces with a flag that does not exist, and one error behind them.
std::string many_alike() {
  std::string text;
  for (int i = 1; i <= 20; ++i) text += "@/INTER/TYPE7/" + std::to_string(i) + " Istf=7 Gapmin=1\n";
  return text + "@/INTER/TYPE10/30 Inacti=5\n";
}

LintOptions these(std::vector<std::string> rules) {
  LintOptions o;
  o.select = std::move(rules);
  return o;
}

std::size_t count_of(const std::string& text, std::string_view what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(HumanReport, GroupsMoreThanThreeOfARule) {
  const Linted run = lint_example(many_alike(), these({"DK201"}));
  ASSERT_EQ(run.count(RuleId::DK201), 20u) << run.list();
  const std::string grouped = lint_human(one(run), {});
  EXPECT_EQ(count_of(grouped, "warning[DK201:Istf]"), 1u) << grouped;
  EXPECT_NE(grouped.find("19 more of DK201:Istf: "), std::string::npos) << grouped;
  EXPECT_NE(grouped.find(": Istf of /INTER/TYPE7 2 is 7"), std::string::npos) << grouped;
  EXPECT_NE(grouped.find("… and 10 more"), std::string::npos) << grouped;
  HumanOptions all;
  all.group = false;
  all.per_rule = 0;
  EXPECT_EQ(count_of(lint_human(one(run), all), "warning[DK201:Istf]"), 20u);
}

TEST(HumanReport, ThreeOfARuleAreShownInFull) {
  const Linted run = lint_example(
      "@/INTER/TYPE7/1 Istf=7\n@/INTER/TYPE7/2 Istf=7\n@/INTER/TYPE7/3 Istf=7\n", only("DK201"));
  EXPECT_EQ(count_of(lint_human(one(run), {}), "warning[DK201:Istf]"), 3u) << run.list();
}

TEST(HumanReport, ShowsErrorsBeforeWarnings) {
  const Linted run = lint_example(many_alike(), these({"DK201", "DK254"}));
  const std::string text = lint_human(one(run), {});
  ASSERT_NE(text.find("error[DK254]"), std::string::npos) << text;
  EXPECT_LT(text.find("error[DK254]"), text.find("warning[DK201:Istf]")) << text;
}

TEST(HumanReport, ManyDecksHaveOneListOfWhatWasNotCheckedAndOneTotal) {
  const Linted run = lint_example("@/INTER/TYPE7/1 Istf=7\n", only("DK201"));
  auto decks = one(run);
  decks.push_back(decks[0]);
  decks.push_back({"absent_0000.rad", nullptr, nullptr, "no such file"});
  const std::string text = lint_human(decks, {});
  EXPECT_EQ(count_of(text, "not checked:"), 1u) << text;
  EXPECT_NE(text.find("3 decks: 0 errors, 2 warnings; 0 without either; 1 could not be read\n"),
            std::string::npos)
      << text;
}

/// The columns at which the carets of a text begin, and the characters over them.
std::pair<std::string, std::string> card_and_caret(const std::string& text) {
  const auto caret = text.find('^');
  if (caret == text.npos) return {};
  const auto begin = text.rfind('\n', caret), card = text.rfind('\n', begin - 1);
  return {text.substr(card + 1, begin - card - 1),
          text.substr(begin + 1, text.find('\n', caret) - begin - 1)};
}

TEST(HumanReport, TheCaretIsUnderItsCellWhateverStandsBeforeAndBehindIt) {
  for (std::string before : {"1", "\xe8\xbb\x8a\xe4\xbd\x93", "\ta\xc3\xbc"})
    for (const std::size_t width : {0u, 40u, 60u, 80u}) {
      before.resize(10, ' ');  // bytes are columns of a card
      std::string line = before;
      for (int k = 0; k < 5; ++k) line += "         2";
      line += "       xyz         3         4         5";
      const Linted run = lint_example("/GRNOD/NODE/7\nnodes\n" + line + "\n", only("DK020"));
      const auto text = lint_human(one(run), {.group = false, .width = width});
      const auto at = text.find("'xyz'");
      ASSERT_NE(at, std::string::npos) << text;
      const auto [card, caret] = card_and_caret(text.substr(at));
      EXPECT_TRUE(width == 0 || display_width(card) <= width) << card;
      EXPECT_TRUE(width == 0 || display_width(caret) <= width) << caret;
      // What stands over the carets is what the finding is about.
      const std::size_t columns = display_width(caret.substr(0, caret.find('^')));
      std::size_t over = 0;
      while (display_width(card.substr(0, over)) < columns) ++over;
      EXPECT_EQ(card.substr(over, 3), "xyz") << card << "\n" << caret;
      EXPECT_TRUE(caret.ends_with(" ^^^")) << caret;
    }
}

TEST(HumanReport, ShowsBytesThatAreNoUtf8AsReplacementCharacters) {
  const Linted run = lint_example("/GRNOD/NODE/7\nnodes\n         1\xb5\n", only("DK020"));
  ASSERT_TRUE(run.fires(RuleId::DK020)) << run.list();
  EXPECT_NE(lint_human(one(run), {}).find("         1\xef\xbf\xbd\n"), std::string::npos);
}

TEST(JsonReport, HoldsWhatTheContractPromises) {
  const Linted run = lint_example("@/INTER/TYPE10/1 Inacti=5\n", only("DK254"));
  const auto json = nlohmann::json::parse(lint_json(one(run)));
  EXPECT_EQ(json["schema"]["id"], "deck/lint");
  EXPECT_EQ(json["tool"]["name"], "deck");
  EXPECT_EQ(json["deck"]["path"], "deck_0000.rad");
  ASSERT_EQ(json["diagnostics"].size(), 1u);
  const auto& d = json["diagnostics"][0];
  EXPECT_EQ(d["rule"], "DK254");
  EXPECT_EQ(d["severity"], "error");
  EXPECT_EQ(d["column"], 31);
  EXPECT_EQ(d["end_column"], 41);
  EXPECT_EQ(d["reference"]["message"], 1162);
  EXPECT_EQ(d["reference"]["severity"], "error");
  EXPECT_EQ(d["entity"]["keyword"], "/INTER/TYPE10");
  EXPECT_EQ(d["entity"]["id"], 1);
  EXPECT_EQ(d["fix"]["safe"], false);
  EXPECT_EQ(json["summary"]["errors"], 1);
  EXPECT_FALSE(json["not_checked"].empty());
}

TEST(JsonReport, SeveralDecksStandInAList) {
  const Linted run = lint_example("@/INTER/TYPE7/1\n");
  auto decks = one(run);
  decks.push_back(decks[0]);
  EXPECT_EQ(nlohmann::json::parse(lint_json(decks))["decks"].size(), 2u);
}

TEST(SarifReport, HasRulesRegionsFixesAndFingerprints) {
  const Linted run = lint_example("@/INTER/TYPE7/1 Ibag=1\n", only("DK258"));
  const auto json = nlohmann::json::parse(lint_sarif(one(run), SchemaSet::built_in()))["runs"][0];
  EXPECT_EQ(json["tool"]["driver"]["rules"].size(), all_rules().size());
  ASSERT_EQ(json["results"].size(), 1u);
  const auto& r = json["results"][0];
  EXPECT_EQ(json["tool"]["driver"]["rules"][r["ruleIndex"].get<std::size_t>()]["id"], "DK258");
  EXPECT_EQ(r["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "deck_0000.rad");
  EXPECT_EQ(r["locations"][0]["physicalLocation"]["region"]["startColumn"], 61);
  EXPECT_EQ(r["locations"][0]["logicalLocations"][0]["fullyQualifiedName"], "/INTER/TYPE7/1");
  EXPECT_EQ(r["partialFingerprints"]["deckFinding/v1"], run.result.fingerprints[0]);
  const auto& replacement = r["fixes"][0]["artifactChanges"][0]["replacements"][0];
  EXPECT_EQ(replacement["insertedContent"]["text"], "      1000");
  EXPECT_EQ(replacement["deletedRegion"]["startColumn"], 61);
  EXPECT_EQ(replacement["deletedRegion"]["endColumn"], 71);
}

TEST(SarifReport, NamesFilesByTheSourceRoot) {
  const Linted run = lint_example("@/INTER/TYPE7/1 Ibag=1\n", only("DK258"));
  auto decks = one(run);
  const auto artifact = [&](const std::string& root) {
    const auto json = nlohmann::json::parse(lint_sarif(decks, SchemaSet::built_in(), root));
    EXPECT_EQ(json["runs"][0]["originalUriBaseIds"]["%SRCROOT%"]["uri"], "file://" + root + "/");
    return json["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"];
  };
  namespace fs = std::filesystem;
  const fs::path here = fs::current_path();
  EXPECT_EQ(artifact(here.string())["uri"], "deck_0000.rad");
  EXPECT_EQ(artifact(here.string())["uriBaseId"], "%SRCROOT%");
  EXPECT_EQ(artifact(here.parent_path().string())["uri"],
            (here.filename() / "deck_0000.rad").string());
  const auto elsewhere = artifact("/no/such/folder");
  EXPECT_EQ(elsewhere["uri"], "file://" + (here / "deck_0000.rad").string());
  EXPECT_FALSE(elsewhere.contains("uriBaseId"));
}

TEST(SarifReport, SaysThatColumnsCountCharacters) {
  const Linted run = lint_example("@/INTER/TYPE7/1 Ibag=1\n", only("DK258"));
  const auto json = nlohmann::json::parse(lint_sarif(one(run), SchemaSet::built_in()));
  EXPECT_EQ(json["runs"][0]["columnKind"], "unicodeCodePoints");
}

TEST(SarifReport, SaysWhichDeckCouldNotBeRead) {
  const std::vector<LintedDeck> decks = {{"a b_0000.rad", nullptr, nullptr, "it is a folder"}};
  const auto run = nlohmann::json::parse(lint_sarif(decks, SchemaSet::built_in()))["runs"][0];
  EXPECT_EQ(run["invocations"][0]["executionSuccessful"], false);
  EXPECT_EQ(run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"],
            "it is a folder");
}

TEST(GithubReport, EscapesAndPutsTheWorstFirst) {
  const Linted run = lint_example("@/INTER/TYPE7/1 fric_ID=77 %mesh_size=0.5\n");
  const std::string text = lint_github(one(run));
  const auto error = text.find("::error file=deck_0000.rad,line=");
  const auto warning = text.find("::warning file=deck_0000.rad,line=");
  ASSERT_NE(error, std::string::npos) << text;
  ASSERT_NE(warning, std::string::npos) << text;
  EXPECT_LT(error, warning);
  EXPECT_NE(text.find("%25mesh_size"), std::string::npos);
  const std::vector<LintedDeck> bad = {{"a:b,c", nullptr, nullptr, "line\nbreak"}};
  EXPECT_EQ(lint_github(bad), "::error file=a%3Ab%2Cc,title=deck::line%0Abreak\n");
}

TEST(JunitReport, NamesOfCasesDoNotMoveWithTheirLines) {
  const auto names = [](const std::string& example) {
    const std::string text = lint_junit(one(lint_example(example, only("DK258"))));
    std::vector<std::string> out;
    for (auto at = text.find("<testcase name=\""); at != text.npos;
         at = text.find("<testcase name=\"", at + 1)) {
      const auto begin = at + 16;
      out.push_back(text.substr(begin, text.find('"', begin) - begin));
    }
    return out;
  };
  const std::string cards = "@/INTER/TYPE7/1 Ibag=1\n@/INTER/TYPE7/2 Ibag=1\n";
  const auto before = names(cards);
  EXPECT_EQ(before, (std::vector<std::string>{"DK258 /INTER/TYPE7/1", "DK258 /INTER/TYPE7/2"}));
  EXPECT_EQ(names("/TITLE\nseveral\n" + cards), before);
}

TEST(JunitReport, CountsFailuresAndEscapesMarkup) {
  const Linted run = lint_example("@/INTER/TYPE7/1 fric_ID=77 Inacti=5\n");
  const std::string text = lint_junit(one(run));
  EXPECT_NE(text.find("<failure type=\"error\""), std::string::npos);
  EXPECT_NE(text.find("<system-out>"), std::string::npos) << "notes are no failures";
  EXPECT_EQ(text.find("<failure type=\"warning\""), std::string::npos);
  const auto failures = static_cast<std::size_t>(run.result.errors);
  EXPECT_NE(text.find(" failures=\"" + std::to_string(failures) + "\""), std::string::npos)
      << "warnings are none either: " << text;
  const std::vector<LintedDeck> bad = {{"x", nullptr, nullptr, "<a> & \"b\""}};
  EXPECT_NE(lint_junit(bad).find("&lt;a&gt; &amp; &quot;b&quot;"), std::string::npos);
  LintOptions errors_only;
  errors_only.select = {"DK101"};
  const Linted clean = lint_example("", errors_only);
  EXPECT_NE(lint_junit(one(clean)).find("tests=\"1\" failures=\"0\""), std::string::npos)
      << lint_junit(one(clean));
}

TEST(GitlabReport, NumbersEqualFingerprints) {
  const Linted run = lint_example("@/FRICTION/6 C1=0.0\n@/FRICTION/6 C1=0.0\n", only("DK185"));
  const auto json = nlohmann::json::parse(lint_gitlab(one(run)));
  ASSERT_EQ(json.size(), 2u) << run.list();
  EXPECT_NE(json[0]["fingerprint"], json[1]["fingerprint"]);
  EXPECT_EQ(json[0]["location"]["path"], "deck_0000.rad");
}

TEST(RulesReport, FitsTheTerminalAndLosesNoTitle) {
  const std::string table = rules_table(false, 80);
  std::string words;
  for (std::size_t at = 0; at < table.size();) {
    const auto nl = std::min(table.find('\n', at), table.size());
    const std::string line = table.substr(at, nl - at);
    if (!line.starts_with("DK") && !line.ends_with("page of a rule.")) {
      EXPECT_LE(display_width(line), 80u) << line;
    }
    words += line.substr(std::min(line.find_first_not_of(' '), line.size())) + " ";
    at = nl + 1;
  }
  for (const Rule& r : all_rules()) EXPECT_NE(words.find(r.title), std::string::npos) << r.title;
}

TEST(RulesReport, TableAndJsonAgree) {
  const auto json = nlohmann::json::parse(rules_json());
  EXPECT_EQ(json["rules"].size(), all_rules().size());
  const std::string table = rules_table(false);
  for (const auto& r : json["rules"])
    EXPECT_NE(table.find(r["id"].get<std::string>()), std::string::npos);
}

}  // namespace
}  // namespace deck::test
