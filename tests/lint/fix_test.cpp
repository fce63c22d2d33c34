// Fixes: what they write, that nothing else changes, and that the finding is gone afterwards.
#include "lint/shared/fix.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "lint/support.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

std::string fixed(const Linted& run, bool unsafe = false) {
  const FixResult r = apply_fixes(run.deck->sources, run.result.findings, unsafe);
  return r.files.empty() ? std::string(run.deck->sources[0].bytes()) : r.files[0].text;
}

class EveryFix : public testing::TestWithParam<std::string> {};

std::vector<std::string> fixable_ids() {
  std::vector<std::string> ids;
  for (const Rule& r : all_rules())
    if (r.fixable != Fixable::no && !r.bad.empty()) ids.emplace_back(id_text(r.id));
  return ids;
}

TEST_P(EveryFix, RemovesItsFinding) {
  const Rule& rule = *find_rule(GetParam());
  LintOptions only;
  only.select = {std::string(id_text(rule.id))};
  // An unused suppression is one only where the suppressed rule runs as well.
  if (rule.id == RuleId::DK091) only.select.emplace_back("DK221");
  const Linted before = lint_example(rule.bad, only);
  ASSERT_TRUE(before.fires(rule.id));
  std::size_t with_fix = 0;
  for (const Finding& d : before.result.findings)
    if (d.rule == rule.id && d.fix) ++with_fix;
  if (rule.fixable == Fixable::safe) {
    EXPECT_GT(with_fix, 0u) << before.list();
  }
  if (with_fix == 0) return;
  const Linted after = lint_text(fixed(before, true), only);
  EXPECT_LT(after.count(rule.id), before.count(rule.id)) << fixed(before, true);
}

TEST_P(EveryFix, EndsLinesAsTheFileDoes) {
  std::string text = example_deck(find_rule(GetParam())->bad, SchemaSet::built_in()).main;
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 2))
    text.insert(at, "\r");
  const std::string after = fixed(lint_text(text), true);
  for (std::size_t at = after.find('\n'); at != after.npos; at = after.find('\n', at + 1))
    ASSERT_TRUE(at > 0 && after[at - 1] == '\r') << after.substr(0, at + 1);
}

TEST_P(EveryFix, SafeOnesLeaveTheEffectiveValuesAlone) {
  const Rule& rule = *find_rule(GetParam());
  // What it is about is that values have no effect; the fix gives it back to them.
  if (rule.id == RuleId::DK511) return;
  const Linted before = lint_example(rule.bad);
  const std::string text = fixed(before);
  const SchemaSet& schemas = SchemaSet::built_in();
  auto one = read_deck_text("a", std::string(before.deck->sources[0].bytes()), schemas);
  auto two = read_deck_text("b", text, schemas);
  ASSERT_TRUE(one);
  ASSERT_TRUE(two);
  Findings ignored;
  const Model model_one = build_model(*one, schemas, ignored);
  const Model model_two = build_model(*two, schemas, ignored);
  const Interfaces a = read_interfaces(*one, model_one, ignored);
  const Interfaces b = read_interfaces(*two, model_two, ignored);
  ASSERT_EQ(a.ordered.size(), b.ordered.size());
  const auto values = [](const auto& list) {
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto& inter : list)
      inter.for_each([&](std::string_view name, const auto& e) {
        // Inacti of a tied contact and Iedge are printed and never used.
        if (inter.type == 10 && name == "Inacti") return;
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(e.value)>>) {
          const double v = static_cast<double>(e.value);
          out.emplace_back(std::string(name), std::to_string(v == 1000 ? 0 : v));
        } else {
          out.emplace_back(std::string(name), e.value);
        }
      });
    return out;
  };
  EXPECT_EQ(values(a.type7), values(b.type7));
  EXPECT_EQ(values(a.type10), values(b.type10));
  EXPECT_EQ(values(a.type11), values(b.type11));
  EXPECT_EQ(values(a.type19), values(b.type19));
}

INSTANTIATE_TEST_SUITE_P(Fixes, EveryFix, testing::ValuesIn(fixable_ids()),
                         [](const auto& one) { return one.param; });

TEST(Fix, RemovesAControlCharacterBehindTheFirstSlash) {
  const std::string head = "#RADIOSS STARTER\n/BEGIN\nexample\n      2022         0\n/";
  LintOptions only;
  only.select = {"DK052"};
  const Linted run = lint_text(head + "\x01 mm\n/END\n", only);
  EXPECT_EQ(run.count(RuleId::DK052), 1u) << run.list();
  EXPECT_EQ(fixed(run, true), head + "mm\n/END\n");
}

TEST(SafeFixes, RemoveNoBlankInsideAKeywordLine) {
  LintOptions only;
  only.select = {"DK052"};
  const Linted same = lint_example("/TITLE\n /TITLE\nexample\n", only);
  ASSERT_EQ(same.count(RuleId::DK052), 1u) << same.list();
  EXPECT_TRUE(same.result.findings[0].fix->safe);
  // Without the blank this line may be another keyword.
  const Linted other = lint_example("/GRNOD /NODE/8\nexample\n         1\n", only);
  ASSERT_EQ(other.count(RuleId::DK052), 1u) << other.list();
  EXPECT_FALSE(other.result.findings[0].fix->safe);
}

TEST(SafeFixes, MoveNoCellOfALineWithCommas) {
  // Blanks part cells beside commas: without the 0 the 3 would be the first cell.
  LintOptions only;
  only.select = {"DK028"};
  const auto fixable = [&](const char* line) {
    const Linted run = lint_example(
        "/INTER/TYPE10/1\nexample\n         2         1\n\n" + std::string(line) + "\n", only);
    EXPECT_GE(run.count(RuleId::DK028), 1u) << line << run.list();
    return std::any_of(run.result.findings.begin(), run.result.findings.end(),
                       [](const Finding& d) { return d.fix && d.fix->safe; });
  };
  EXPECT_FALSE(fixable("0  3  0  1,2"));
  EXPECT_TRUE(fixable("0, 3, 0, 1"));
}

TEST(SafeFixes, MakeNoKeywordOfALine) {
  LintOptions only;
  only.select = {"DK265"};
  const auto fixable = [&](const char* viss) {
    const Linted run = lint_example("/INTER/TYPE10/1\nexample\n         2         1\n\n" +
                                        std::string(30, ' ') + "         6" + viss + "\n",
                                    only);
    EXPECT_EQ(run.count(RuleId::DK265), 1u) << run.list();
    return run.count(RuleId::DK265) == 1 && run.find(RuleId::DK265)->fix.has_value();
  };
  EXPECT_TRUE(fixable("                 0.1"));
  EXPECT_FALSE(fixable("                   /")) << "it would be the first text of the line";
}

TEST(SafeFixes, WriteNoDefaultIntoABlockOfOtherUnits) {
  // The default of Stfac is 1 in working units; here 1.0 on the card would be 1e-6 of them.
  const std::string deck =
      "#RADIOSS STARTER\n/BEGIN\nrun\n      2022         0\n" +
      std::string("                  kg                  mm                   s\n") +
      "                  kg                  mm                  ms\n"
      "/INTER/TYPE7/1\ncontact\n         2         1         1\n\n\n\n\n\n/END\n";
  LintOptions only;
  only.select = {"DK219"};
  const Linted other = lint_text(deck, only);
  ASSERT_EQ(other.count(RuleId::DK219), 1u) << other.list();
  EXPECT_FALSE(other.result.findings[0].fix.has_value());
  std::string same = deck;
  same.replace(same.find("   s\n"), 5, "  ms\n");
  const Linted own = lint_text(same, only);
  ASSERT_EQ(own.count(RuleId::DK219), 1u) << own.list();
  EXPECT_TRUE(own.result.findings[0].fix.has_value());
}

TEST(CellWriterEdit, KeepsTheLengthOfTheLineAndAlignsRight) {
  const Linted run = lint_text("#RADIOSS STARTER\n/BEGIN\nabcdefghij0123456789tail\n/END\n");
  const SourceSet& sources = run.deck->sources;
  const auto at = static_cast<std::uint64_t>(sources[0].bytes().find("abc"));
  const TextEdit e = CellWriter::edit(sources, {0, 1, at}, 11, 20, "42");
  EXPECT_EQ(e.span.offset, at + 10);
  EXPECT_EQ(e.span.length, 10u);
  EXPECT_EQ(e.text, "        42");
}

TEST(CellWriterEdit, GrowsALineThatIsTooShort) {
  const Linted run = lint_text("#RADIOSS STARTER\n/BEGIN\nabc\n/END\n");
  const SourceSet& sources = run.deck->sources;
  const auto at = static_cast<std::uint64_t>(sources[0].bytes().find("abc"));
  const TextEdit e = CellWriter::edit(sources, {0, 0, at}, 11, 20, "42");
  EXPECT_EQ(e.span.offset, at + 3);
  EXPECT_EQ(e.span.length, 0u);
  EXPECT_EQ(e.text, "               42");
  const TextEdit clipped = CellWriter::edit(sources, {0, 0, at}, 1, 10, "42");
  EXPECT_EQ(clipped.span.offset, at);
  EXPECT_EQ(clipped.span.length, 3u);
  EXPECT_EQ(clipped.text, "        42");
}

Finding with_edit(Span span, std::string text, bool safe = true) {
  Finding d;
  d.rule = RuleId::DK010;
  d.span = span;
  d.fix = Fix{"test", safe, {{span, std::move(text)}}};
  return d;
}

TEST(MissingEnd, IsAppendedSafelyOnlyBehindAWholeLine) {
  const std::string deck = "#RADIOSS STARTER\n/BEGIN\nx\n      2020         0\n/NODE\n         1";
  const Linted whole = lint_text(deck + "\n"), cut = lint_text(deck);
  const auto fixed = [](const Linted& r, bool unsafe) {
    return apply_fixes(r.deck->sources, r.result.findings, unsafe).files;
  };
  ASSERT_EQ(fixed(whole, false).size(), 1u) << whole.list();
  EXPECT_EQ(fixed(whole, false).front().text, deck + "\n/END\n");
  EXPECT_TRUE(fixed(cut, false).empty());
  ASSERT_EQ(fixed(cut, true).size(), 1u) << cut.list();
  EXPECT_EQ(fixed(cut, true).front().text, deck + "\n/END\n");
  EXPECT_NE(cut.find(RuleId::DK010)->message.find("within a line"), std::string::npos);
}

TEST(ApplyFixes, ComeToAnEndOnEverySample) {
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "samples")) {
    if (!entry.path().string().ends_with("_0000.rad")) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    int rounds = 0;
    for (; rounds < 10; ++rounds) {
      const Linted run = lint_text(text);
      const FixResult fixed = apply_fixes(run.deck->sources, run.result.findings, true);
      if (fixed.files.empty()) break;
      text = fixed.files.front().text;
    }
    EXPECT_LT(rounds, 10) << entry.path() << ": one fix undoes another";
  }
}

TEST(ApplyFixes, TakesTheFirstOfTwoThatOverlap) {
  SourceSet sources;
  sources.add(Source::from_bytes("x", "0123456789"));
  const FixResult r = apply_fixes(sources,
                                  {with_edit({0, 4, 2}, "A"), with_edit({0, 2, 5}, "B"),
                                   with_edit({0, 1, 6}, "C"), with_edit({0, 0, 10}, "D")},
                                  false);
  ASSERT_EQ(r.files.size(), 1u);
  EXPECT_EQ(r.files[0].text, "01AC789D");
  EXPECT_EQ(r.applied, 3u);
  EXPECT_EQ(r.skipped, 1u);
}

TEST(ApplyFixes, LeavesUnsafeOnesUnlessAsked) {
  SourceSet sources;
  sources.add(Source::from_bytes("x", "0123456789"));
  const std::vector<Finding> all = {with_edit({0, 1, 2}, "A", false)};
  EXPECT_TRUE(apply_fixes(sources, all, false).files.empty());
  EXPECT_EQ(apply_fixes(sources, all, true).files[0].text, "01A3456789");
}

/// Two decks in a folder, and what they agree to fix.
class FixedTogether : public testing::Test {
 protected:
  static constexpr const char* suppressed_ =
      "# decklint: ignore[DK221] reason=known\n/INTER/TYPE7/1\nx\n         1         1\n\n\n\n\n";
  static std::string main_deck(const std::string& more) {
    return "#RADIOSS STARTER\n/BEGIN\nx\n      2022         0\n" + more + "/END\n";
  }
  AgreedFixes agree(const std::vector<const Linted*>& decks, bool unsafe) const {
    std::vector<FixedDeck> list;
    for (const Linted* d : decks) list.push_back({&d->deck->sources, &d->result.findings});
    return agree_on_fixes(list, unsafe);
  }
  Linted lint(const std::string& path) const {
    LintOptions only;
    only.select = {"DK091", "DK221"};
    return lint_file(path, only);
  }
  Folder folder_;
};

TEST_F(FixedTogether, ASuppressionInAnIncludeIsNoSafeFix) {
  folder_.write("inter.inc", suppressed_);
  const Linted a = lint(folder_.write("a_0000.rad", main_deck("#include inter.inc\n")));
  ASSERT_TRUE(a.fires(RuleId::DK091));
  EXPECT_TRUE(agree({&a}, false).wanted[0].empty());
  EXPECT_EQ(agree({&a}, true).wanted[0].size(), 1u);
  const Linted b = lint(folder_.write("b_0000.rad", main_deck(suppressed_)));
  EXPECT_EQ(agree({&b}, false).wanted[0].size(), 1u) << "in the main file it is one";
}

TEST_F(FixedTogether, ASharedFileIsFixedOnlyAsAllDecksWantIt) {
  folder_.write("common/inter.inc", suppressed_);
  const Linted a = lint(folder_.write("a/a_0000.rad", main_deck("#include ../common/inter.inc\n")));
  const Linted b = lint(folder_.write("b/b_0000.rad", main_deck("#include ../common/inter.inc\n")));
  const AgreedFixes both = agree({&a, &b}, true);
  EXPECT_EQ(both.wanted[0].size(), 1u);
  EXPECT_EQ(both.wanted[1].size(), 1u);
  // The third deck includes the file by another name and needs what the others do not.
  std::filesystem::create_symlink("inter.inc", folder_.path() + "/common/link.inc");
  Linted c = lint(folder_.write("c/c_0000.rad", main_deck("#include ../common/link.inc\n")));
  c.result.findings.clear();
  const AgreedFixes three = agree({&a, &b, &c}, true);
  EXPECT_TRUE(three.wanted[0].empty());
  EXPECT_TRUE(three.wanted[1].empty());
  ASSERT_EQ(three.withheld.size(), 2u);
  EXPECT_EQ(three.withheld[0].other, 2u);
}

TEST(UnifiedDiff, IsEmptyForEqualTexts) { EXPECT_EQ(unified_diff("x", "a\nb\n", "a\nb\n"), ""); }

TEST(UnifiedDiff, ShowsContextAndJoinsNearChanges) {
  const std::string before = "1\n2\n3\n4\n5\n6\n7\n8\n9\n";
  const std::string after = "1\n2\nX\n4\n5\n6\n7\nY\n9\n";
  EXPECT_EQ(unified_diff("d/x", before, after),
            "--- a/d/x\n+++ b/d/x\n@@ -1,9 +1,9 @@\n 1\n 2\n-3\n+X\n 4\n 5\n 6\n 7\n-8\n+Y\n 9\n");
}

/// The patch, given to git, makes the file what the fix makes it.
void expect_git_applies(const std::string& before, const std::string& after) {
  const Folder folder;
  folder.write("x.rad", before);
  folder.write("p.diff", unified_diff("x.rad", before, after));
  const std::string command = "cd '" + folder.path() + "' && git apply p.diff 2>error.txt";
  ASSERT_EQ(std::system(command.c_str()), 0) << folder.read("p.diff") << folder.read("error.txt");
  EXPECT_EQ(folder.read("x.rad"), after);
}

TEST(UnifiedDiff, AppliesWithGit) {
  if (std::system("git --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "git is not installed";
  std::string lines;
  for (int i = 0; i < 60; ++i) lines += "line " + std::to_string(i) + "\n";
  std::string changed = lines;
  changed.replace(changed.find("line 5\n"), 7, "line five\nand more\n");
  changed.erase(changed.find("line 40\n"), 8);
  expect_git_applies(lines, changed);
  expect_git_applies(lines, "first\n" + lines);
  expect_git_applies(lines, lines + "/END\n");
  expect_git_applies("no end of line", "no end of line\n/END\n");
  expect_git_applies("a\r\nb\r\nc\r\n", "a\r\nX\r\nc\r\n/END\r\n");
  expect_git_applies("x\n" + lines, lines);
}

}  // namespace
}  // namespace deck::test
