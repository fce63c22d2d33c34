// Pages of a team's own rules: what is wrong with a page is said with its place, and nothing that a
// page can hold takes the program down.
#include <gtest/gtest.h>

#include "folder.hpp"
#include "lint/shared/config.hpp"
#include "lint/shared/example.hpp"

namespace deck::test {
namespace {

using Pages = std::vector<std::pair<std::string, std::string>>;  ///< name, text

const std::string sound =
    "---\nid: X101\nname: our-stiffness\ntitle: \"Istf is not 4\"\nseverity: warning\n"
    "when: flag(Istf) != 4\nat: Istf\nmessage: \"{name}: {show Istf}\"\n"
    "fix: {Istf: 4, safe: true, title: write Istf 4}\n---\n"
    "- **What is wrong.** Istf.\n- **Fires on.** `@/INTER/TYPE7/1 Istf=1000`\n"
    "- **Stays silent on.** `@/INTER/TYPE7/1 Istf=4`\n";

/// The page with `to` in the place of `from`.
std::string with(const std::string& from, const std::string& to) {
  std::string out = sound;
  return out.replace(out.find(from), from.size(), to);
}

Result<std::vector<RulePage>> read(const Pages& pages) {
  const Folder folder;
  for (const auto& [name, text] : pages) folder.write(name, text);
  return read_rules(folder.path());
}

/// What is said of the page, from its place on.
std::string refusal(const std::string& text) {
  const auto pages = read({{"X101.md", text}});
  if (pages) return "it was read";
  const std::string& message = pages.error().message;
  const auto place = message.find("X101.md:");
  return place == message.npos ? message : message.substr(place + 8);
}

TEST(TeamRules, PageIsReadWithWhatFollowsFromIt) {
  const auto pages = read({{"X101.md", sound}});
  ASSERT_TRUE(pages) << pages.error().message;
  const Rule& rule = pages->front().rule;
  EXPECT_EQ(id_text(rule.id), "X101");
  EXPECT_EQ(rule.types, (std::vector<int>{7, 11, 19, 24, 25}));  // TYPE10 has no Istf
  EXPECT_EQ(rule.fixable, Fixable::safe);
}

TEST(TeamRules, FormThatIsBrokenIsNamedWithItsPlace) {
  std::string cases = "cases:\n- if: input(Igap) == 1\n- if: input(Igap) = 2\n";
  const std::pair<std::string, std::string> rows[] = {
      {"", "1:1: expected '---'"},
      {std::string("\x7f\x45\x4c\x46\0\1", 6), "1:1: expected text in UTF-8"},
      {with("Istf.", "\xff"), "11:22: expected text in UTF-8"},
      {with("X101", "DK104"), "2:5: 'id' is 'DK104'"},
      {with("X101", "X1"), "2:5: 'id' is 'X1', expected X001 to X999"},
      {with("our-", "Our-"), "3:7: 'name' is 'Our-stiffness', expected words"},
      {with("not 4\"", "not 4"), "4:8: 'title' is '\"Istf is not 4', expected a text in quotes"},
      {with("warning", "loud"), "5:11: 'severity' is 'loud', expected error, warning or info"},
      {with("when", "if"), "6:5: 'if' is"},
      {with("when: ", "wen: "), "6:6: 'wen' is"},
      {with("!= 4", "!= "), "6:7: when: expected a number, a function or '(' at ''"},
      {with("flag(Istf", "flg(Istf"), "6:7: when: expected a number, a function or '(' at 'flg"},
      {with("flag(Istf", "flag(Isft"), "6:7: no interface of its types has a field Isft"},
      {with("at: Istf", "at: Isft"), "7:5: no interface of its types has a field Isft"},
      {with("{show Istf}\"", "{show Istf}"), "8:10: 'message' is"},
      {with("{show Istf}", "{show Istf"), "8:10: message: expected a '}' for each '{'"},
      {with("{show Istf}", "{shw Istf}"), "8:10: message: expected {name}"},
      {with("Istf: 4,", "Istf: four,"), "9:6: expected a text for the cell, not 'four'"},
      {with("Istf: 4,", "Istf: 40000000000,"), "9:6: expected a text for the cell"},
      {with("safe: true, ", ""), "9:6: fix: expected {FIELD"},
      {with("at: ", "types: 8\nat: "), "7:8: expected types of interfaces"},
      {with("at: ", "covers: X101\nat: "), "7:9: expected ids of other rules"},
      {with("at: ", "covers: DK000\nat: "), "7:9: expected ids of other rules"},
      {with("at: ", "covers: DK370\nat: "), "7:9: expected ids of other rules"},
      {with("at: ", "fields: Igap\nat: "), "8:5: expected one of the 'fields'"},
      {with("at: ", "found_by: geometry\nat: "), "7:11: 'found_by' is 'geometry'"},
      {with("at: ", "severity: info\nat: "), "7:1: expected 'severity' only once"},
      {with("at: ", "was: DK202 Igap\nat: "), "7:6: 'was' is"},
      {with("---\n- **W", cases + "---\n- **W"), "12:7: if: expected 'and', 'or' or the end"},
      {with("Istf.", "Istf.\n- **More.** x"), "12:1: expected no text behind"},
      {with("\n- **Stays", "\n```\n- **Stays"), "13:1: "},
      {with("our-stiffness", "renard-curve-without-c6"), "it was read"},
      {with("our-stiffness", "unknown-flag-value"), "3:7: expected another name"},
  };
  for (const auto& [text, expected] : rows)
    EXPECT_TRUE(refusal(text).starts_with(expected)) << refusal(text) << "\n" << expected;
}

TEST(TeamRules, ConditionsAreBounded) {
  const auto refused = [](const std::string& when) {
    return refusal(with("flag(Istf) != 4", when)) != "it was read";
  };
  std::string sides = "self_contact", sum = "1";
  for (int i = 0; i < 60; ++i) sides += "+self_contact";
  while (sum.size() < 900) sum += "+1";
  EXPECT_TRUE(refused(std::string(500, '(') + "1" + std::string(400, ')')));
  EXPECT_TRUE(refused(std::string(100000, '(')));
  EXPECT_TRUE(refused(sides)) << "each looks at all nodes";
  EXPECT_FALSE(refused(sum));
  std::string cases = "cases:\n";
  while (cases.size() < 30000) cases += "- if: " + sum + "\n";
  EXPECT_TRUE(refusal(with("---\n- **W", cases + "---\n- **W")).find("steps") != std::string::npos);
  EXPECT_NE(refusal(sound + std::string(1 << 17, '\n')), "it was read");
}

TEST(TeamRules, IdsNamesAndCirclesOfSeveralPagesAreRefused) {
  const auto second = [](const std::string& name, const std::string& covers) {
    return "---\nid: X102\nname: " + name + "\ntitle: \"t\"\nseverity: info\ncovers: " + covers +
           "\nwhen: 1\nat: Igap\nmessage: \"m\"\n---\n";
  };
  const std::string covering = with("at: ", "covers: X102\nat: ");
  const auto both = read({{"X101.md", covering}, {"X102.md", second("our-gap", "DK201")}});
  EXPECT_TRUE(both) << both.error().message;
  EXPECT_FALSE(read({{"X101.md", covering}, {"X102.md", second("our-gap", "X101")}}));
  EXPECT_FALSE(read({{"X101.md", sound}, {"X102.md", second("our-stiffness", "DK201")}}));
  EXPECT_FALSE(read({{"X101.md", sound}, {"copy.md", sound}}));
  EXPECT_FALSE(read({{"X102.md", sound}}))
      << "the name of a file that is an id is that of the page";
  EXPECT_FALSE(read({})) << "no page";
}

TEST(TeamRules, ExampleThatBreaksItsPromiseIsNamed) {
  const auto pages = read({{"X101.md", with("Istf=1000", "Istf=4")}});
  ASSERT_TRUE(pages);
  const auto rules = use_rules(*pages);
  const auto broken = broken_examples(*pages);
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_NE(broken[0].find("X101.md:12:1: the rule does not report this"), std::string::npos);
}

TEST(TeamRules, AreRulesWhileTheyAreInForceOnly) {
  const std::size_t before = all_rules().size();
  {
    const auto rules = use_rules(*read({{"X101.md", sound}}));
    EXPECT_EQ(all_rules().size(), before + 1);
    ASSERT_NE(find_rule("X101"), nullptr);
    EXPECT_TRUE(known_selector("X1"));
    EXPECT_EQ(to_selector("our-stiffness"), "X101");
  }
  EXPECT_EQ(find_rule("X101"), nullptr);
  EXPECT_FALSE(known_selector("X1"));
}

}  // namespace
}  // namespace deck::test
