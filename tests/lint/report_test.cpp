// The writers of lint results: places, carets, escapes, bounds.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/shared/shown_text.hpp"
#include "lint/support.hpp"
#include "report/shared/findings.hpp"

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

/// Findings written out here about the third line of a deck.
struct Written {
  explicit Written(const std::string& line)
      : deck(std::move(*read_deck_text("a_0000.rad", "#RADIOSS STARTER\n/TITLE\n" + line + "\n",
                                       SchemaSet::built_in()))) {
    at = deck.sources[0].bytes().find(line, 20);
  }
  Finding& find(std::size_t first, std::size_t length, Severity severity = Severity::warning) {
    Finding d;
    d.rule = RuleId::DK201;
    d.severity = severity;
    d.message = "m" + std::to_string(result.findings.size());
    d.span = {0, static_cast<std::uint32_t>(length), at + first};
    result.findings.push_back(d);
    return result.findings.back();
  }
  std::string text(HumanOptions options = {}) const {
    options.quiet = true;
    return lint_human({{"a_0000.rad", &deck, &result, ""}}, options);
  }
  Deck deck;
  std::size_t at = 0;
  LintResult result;
};

// Cuts mark a long card, which keeps ten characters after the caret.
TEST(HumanReport, LongLinesAreCutAroundTheCaret) {
  std::string line;
  for (int k = 0; k < 6000; ++k) line += static_cast<char>('a' + k % 26 - (k % 7 == 0 ? 32 : 0));
  struct Case {
    std::size_t size, first, length, width;  // of the line, the finding and the terminal
    std::size_t begin, shown, carets;        // of the line
  };
  const Case cases[] = {
      {300, 100, 3, 60, 59, 54, 3},      // both ends cut: 54 characters and two marks
      {300, 5, 3, 60, 0, 55, 3},         // only the end
      {300, 297, 3, 60, 246, 54, 3},     // only the begin
      {56, 50, 2, 60, 0, 56, 2},         // just fits
      {57, 2, 1, 60, 0, 55, 1},          // just does not
      {57, 44, 1, 60, 1, 54, 1},         // one behind what has to be shown
      {57, 45, 1, 60, 2, 55, 1},         // with the last character the end fits
      {300, 100, 100, 60, 100, 54, 54},  // more carets than fit
      {300, 100, 3, 0, 5, 108, 3},       // no terminal: 110 columns
      {300, 100, 3, 10, 95, 18, 3},      // 20 columns at least
      {6000, 3000, 3, 60, 2959, 54, 3},  // of a very long line 2000 before it are looked at
      {6000, 5999, 1, 60, 5946, 54, 1}};
  for (const Case& c : cases) {
    SCOPED_TRACE(std::to_string(c.size) + " " + std::to_string(c.first));
    Written w(line.substr(0, c.size));
    w.find(c.first, c.length);
    const bool before = c.begin > 0, behind = c.begin + c.shown < c.size;
    EXPECT_EQ(w.text({.width = c.width}),
              "warning[DK201]: m0\n --> a_0000.rad:3:" + std::to_string(c.first + 1) +
                  "\n  |\n3 | " + (before ? "…" : "") + line.substr(c.begin, c.shown) +
                  (behind ? "…" : "") + "\n  | " +
                  std::string((before ? 1 : 0) + c.first - c.begin, ' ') +
                  std::string(c.carets, '^') + "\n  |\n\n");
  }
}

TEST(HumanReport, TheCaretLeavesOutTheBlanksOfACell) {
  const std::string line = "     ab   cd     e";
  const std::tuple<std::size_t, std::size_t, std::size_t, std::size_t> cases[] = {
      {0, 10, 5, 2}, {5, 2, 5, 2},   {6, 4, 6, 1},  {0, 3, 0, 3},
      {7, 3, 7, 3},  {0, 18, 5, 13}, {18, 5, 18, 1}};
  for (const auto& [first, length, caret, carets] : cases) {
    Written w(line);
    w.find(first, length);
    EXPECT_NE(w.text().find("\n3 | " + line + "\n  | " + std::string(caret, ' ') +
                            std::string(carets, '^') + "\n  |\n"),
              std::string::npos)
        << w.text();
  }
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

}  // namespace
}  // namespace deck::test
