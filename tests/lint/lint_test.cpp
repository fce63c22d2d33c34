// The engine: suppressions, selection, order, bounds, what was not checked.
#include <gtest/gtest.h>

#include <set>

#include "lint/plain_glob.hpp"
#include "lint/shared/config.hpp"
#include "lint/support.hpp"
#include "report/shared/findings.hpp"

namespace deck::test {
namespace {

constexpr const char* negative = "@/INTER/TYPE7/1 Stfac=-1.0\n";

const std::string known = "# decklint: ignore[DK221] reason=a test\n";

TEST(Suppression, CoversItsBlockOrItsFileAndNothingElse) {
  // Where the comment goes in, what it says, which rules fire then, and how many it hides.
  struct Row {
    const char *before, *comment;
    std::set<RuleId> fire;
    std::size_t hidden;
  };
  using enum RuleId;
  const Row rows[] = {
      {"/INTER/TYPE7/1", "ignore[DK221] reason=a test", {}, 1},
      {"example\n", "ignore[DK2] reason=a prefix works too", {}, 1},  // inside of the block
      {"/FUNCT", "ignore[DK221] reason=the block before", {DK221, DK091}, 0},
      {"/INTER/TYPE7/1", "ignore[DK221]", {DK221, DK090}, 0},
      {"/BEGIN", "ignore-file[DK221] reason=at its top", {}, 1},
      {"/INTER/TYPE7/1", "ignore-file[DK221] reason=too late", {DK221, DK093}, 0},
  };
  const std::string text = example_deck(negative, SchemaSet::built_in()).main;
  for (const Row& row : rows) {
    const auto at = text.find(row.before, row.before[0] == 'e' ? text.find("/INTER") : 0);
    ASSERT_NE(at, text.npos) << row.before;
    const auto line = row.before[0] == 'e' ? text.find('\n', at) + 1 : at;
    const Linted run =
        lint_text(std::string(text).insert(line, "# decklint: " + std::string(row.comment) + "\n"));
    for (const RuleId rule : {DK221, DK090, DK091, DK093})
      EXPECT_EQ(run.fires(rule), row.fire.contains(rule)) << row.comment << run.list();
    EXPECT_EQ(run.result.suppressed, row.hidden) << row.comment;
  }
}

TEST(Suppression, IsFoundWhereTwoStretchesOfALargeFileMeet) {
  const std::string text = example_deck(negative, SchemaSet::built_in()).main;
  const auto at = text.find("/INTER/TYPE7/1");
  constexpr std::size_t stretch = std::size_t{8} << 20;
  const std::size_t colon = known.find(':');
  for (const std::size_t place : {stretch - 1, stretch, stretch + 3}) {
    std::string filler(place - colon - at, '#');
    for (std::size_t i = 99; i < filler.size(); i += 100) filler[i] = '\n';
    filler.back() = '\n';
    const Linted run = lint_text(std::string(text).insert(at, filler + known));
    EXPECT_EQ(run.result.suppressed, 1u) << place;
  }
}

TEST(Selection, FollowsIdsPrefixesAndGlobs) {
  LintOptions only, without, file;
  only.select = {"DK221"};
  const Linted a = lint_example(negative, only);
  ASSERT_EQ(a.result.findings.size(), 1u) << a.list();
  EXPECT_EQ(a.result.findings[0].rule, RuleId::DK221);
  without.ignore = {"DK2"};
  EXPECT_FALSE(lint_example(negative, without).fires(RuleId::DK221));
  file.per_file_ignores = {{"*_0000.rad", {"DK221"}}};
  EXPECT_FALSE(lint_example(negative, file).fires(RuleId::DK221));
  file.per_file_ignores = {{"*.inc", {"DK221"}}};
  EXPECT_TRUE(lint_example(negative, file).fires(RuleId::DK221));
  LintOptions severity;
  severity.severity = {{"DK2", Severity::info}, {"DK221", Severity::warning}};
  EXPECT_EQ(lint_example(negative, severity).find(RuleId::DK221)->severity, Severity::warning);
}

constexpr const char* two_negative = "@/INTER/TYPE7/1 Stfac=-1.0 Gapmin=-0.5\n";

TEST(Selection, OfAFieldTakesThatFieldAlone) {
  const auto fields = [](const Linted& run) {
    std::string out;
    for (const Finding& d : run.result.findings)
      if (d.rule == RuleId::DK221) out += finding_name(d) + " ";
    return out;
  };
  EXPECT_EQ(fields(lint_example(two_negative)), "DK221:Stfac DK221:Gapmin ");
  for (const char* stfac : {"DK221:Stfac", "DK223"}) {
    LintOptions only, without, file;
    only.select = without.ignore = {stfac};
    file.per_file_ignores = {{"*_0000.rad", {stfac}}};
    EXPECT_EQ(fields(lint_example(two_negative, only)), "DK221:Stfac ");
    EXPECT_EQ(fields(lint_example(two_negative, without)), "DK221:Gapmin ");
    EXPECT_EQ(fields(lint_example(two_negative, file)), "DK221:Gapmin ");
    const std::string comment = "# decklint: ignore[" + std::string(stfac) + "] reason=a test\n";
    EXPECT_EQ(fields(lint_example(comment + two_negative)), "DK221:Gapmin ");
    // A comment that hides nothing.
    EXPECT_TRUE(lint_example(comment + "@/INTER/TYPE7/1 Gapmin=-0.5\n").fires(RuleId::DK091));
  }
}

TEST(Selection, OfAFieldCountsNothingElse) {
  LintOptions only;
  only.select = {"DK221:Gapmin"};
  only.findings_per_rule = 1;
  const Linted run = lint_example(std::string(negative) + two_negative, only);
  ASSERT_EQ(run.result.findings.size(), 1u) << run.list();
  EXPECT_EQ(run.result.findings[0].field, "Gapmin");
  EXPECT_TRUE(run.result.dropped.empty());
}

TEST(Selection, ASeverityOfAFieldIsCloserThanThatOfItsRule) {
  for (const char* stfac : {"DK221:Stfac", "DK223"}) {
    LintOptions options;
    options.severity = {{"DK221", Severity::info}, {stfac, Severity::error}};
    const Linted run = lint_example(two_negative, options);
    EXPECT_EQ(run.result.errors, 1u) << run.list();
    EXPECT_EQ(run.find(RuleId::DK221)->severity, Severity::error);
  }
}

TEST(FormerIds, AreAnsweredWithTheFieldsThatTheyMean) {
  EXPECT_EQ(renamed_selector("DK202"), "DK202 is now DK201:Igap");
  EXPECT_EQ(renamed_selector("DK224"), "DK224 is now DK221:Fric, DK221:Fric_pair, DK221:Fric_dir2");
  for (const char* current : {"DK201", "DK201:Igap", "DK2", "all", "DK217", "DK999"})
    EXPECT_EQ(renamed_selector(current), "") << current;
  EXPECT_TRUE(known_selector("DK202"));
  EXPECT_TRUE(known_selector("DK201:Igap"));
  EXPECT_FALSE(known_selector("DK201:Gapmin"));
  const Linted run =
      lint_example(std::string("# decklint: ignore[DK223] reason=a test\n") + negative);
  ASSERT_TRUE(run.fires(RuleId::DK092)) << run.list();
  EXPECT_EQ(run.find(RuleId::DK092)->message, "DK223 is now DK221:Stfac");
  EXPECT_EQ(run.find(RuleId::DK092)->severity, Severity::info);
}

TEST(Order, FollowsFileLineColumnRule) {
  const Linted run = lint_example(std::string(negative) + "@/INTER/TYPE7/2 Istf=7 Fric=-1.0\n");
  const auto& all = run.result.findings;
  ASSERT_GT(all.size(), 2u);
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i - 1].span.file != all[i].span.file) {
      EXPECT_LT(all[i - 1].span.file, all[i].span.file);
      continue;
    }
    EXPECT_LE(all[i - 1].span.offset, all[i].span.offset);
    if (all[i - 1].span.offset == all[i].span.offset) {
      EXPECT_LE(all[i - 1].rule, all[i].rule);
    }
  }
}

TEST(NotChecked, CountsRulesOnlyWhereSomeAreOff) {
  const auto rules_off = [](const LintOptions& options) {
    const Linted run = lint_example("@/INTER/TYPE7/1 Gapmin=1\n", options);
    for (const NotChecked& n : run.result.not_checked)
      if (n.why.find("--select") != std::string::npos) return n.what;
    return std::string();
  };
  EXPECT_EQ(rules_off({}), "");
  LintOptions options;
  options.ignore = {"DK201"};
  EXPECT_EQ(rules_off(options), "1 of " + std::to_string(all_rules().size()) + " rules");
}

TEST(UnusedEntities, NumbersInBlocksThatNobodyKnowsCountAsUse) {
  const std::string group = "@bare\n/GRNOD/NODE/5\nfive\n         1\n";
  EXPECT_TRUE(lint_example(group).fires(RuleId::DK188));
  EXPECT_FALSE(lint_example(group + "/NONSENSE/9\ntitle\n         5\n").fires(RuleId::DK188));
  EXPECT_TRUE(lint_example(group + "/NONSENSE/9\ntitle\n       5.0   7.8e-5        5x\n")
                  .fires(RuleId::DK188));
}

TEST(ExtraChecks, ReportThroughTheEngine) {
  const ExampleDeck example = example_deck("@/INTER/TYPE7/1\n", SchemaSet::built_in());
  auto deck = read_deck_text("x", example.main, SchemaSet::built_in());
  ASSERT_TRUE(deck);
  const Linted whole = linted(std::move(*deck));
  const ExtraCheck many = [](const LintContext& c, Reporter& r) {
    r.report(rule_of(RuleId::DK390), *c.contacts.at(0).block, c.contacts[0].block->header_span,
             "many");
    return std::vector<NotChecked>{{"the rest", "it is large"}};
  };
  const LintResult result = run_lint(whole.loaded, {}, {many});
  ASSERT_EQ(result.counts.count(RuleId::DK390), 1u);
  for (const NotChecked& n : result.not_checked)
    EXPECT_EQ(n.what.find("geometry"), std::string::npos);
  EXPECT_EQ(result.not_checked.at(0).what, "the rest");
}

TEST(ExtraChecks, AreNotRunWhereNoRuleOfTheirsIsWanted) {
  const ExampleDeck example = example_deck("@/INTER/TYPE7/1\n", SchemaSet::built_in());
  auto deck = read_deck_text("x", example.main, SchemaSet::built_in());
  ASSERT_TRUE(deck);
  const Linted whole = linted(std::move(*deck));
  int runs = 0;
  const ExtraCheck counted = [&](const LintContext&, Reporter&) {
    ++runs;
    return std::vector<NotChecked>{};
  };
  LintOptions options;
  options.select = {"DK1", "DK2"};
  run_lint(whole.loaded, options, {counted});
  EXPECT_EQ(runs, 0);
  options.select = {"DK1", "DK401"};
  run_lint(whole.loaded, options, {counted});
  EXPECT_EQ(runs, 1);
}

TEST(Cards, AreJudgedAsTheSolverReadsThem) {
  using enum RuleId;
  const std::string shells = "/SHELL/1\n         9         1         2         3         4\n\n";
  const std::string memory = "/MEMORY\n    400000                           .66\n";
  expect_facts({
      // A line too many in front of the sides: what is missing now stops the run.
      {"/INTER/TYPE7/1\nexample\n\n         2         1\n\n\n"
       "                 1.0                 0.2                 0.5\n"
       "       000                             6\n\n",
       DK181, 3160},
      // The solver looks for the id of a side and of a sensor.
      {"@/INTER/TYPE7/1 sens_ID=-3\n", DK187, 1010},
      {"@/INTER/TYPE7/1 fric_ID=-5\n", DK187, fires_without_message},
      {"@/INTER/TYPE7/1 fct_IDF=-1\n", DK187, fires_without_message},
      // Zero is an id of its own, a comment behind the header is none.
      {"@/INTER/TYPE7/0\n@/INTER/TYPE7/1\n", DK179, silent},
      {"@/INTER/TYPE7/0\n@/INTER/TYPE7/0\n", DK179, 117},
      {"/INTER/TYPE7/2   # note\nexample\n         2         1\n"
       "\n\n                 1.0\n\n\n@/INTER/TYPE7/1\n",
       DK179, silent},
      // A blank line stops the solver among and behind elements, not among nodes and tetrahedra.
      {shells + "        10         1         2         3         4\n", DK036, 78},
      {shells + "# end\n", DK036, 78},
      {"/SPRING/1\n         9         1         2\n\n/TITLE\nx\n", DK036, 681},
      {"/TETRA4/1\n\n/TITLE\nx\n", DK036, fires_without_message},
      {"/NODE\n\n        21                 0.0                 0.0                 9.0\n", DK036,
       fires_without_message},
      // The second number is a real.
      {memory, DK020, silent},
      {memory.substr(0, 8) + "       .66                           .66\n", DK020, 100101},
      // TYPE25 and TYPE5 have fields of their own in columns 11 to 30 of that line.
      {"@/INTER/TYPE25/1 surf_ID1=1 IBCX=0 IVIS2=1\n", DK243, silent},
      {"//SUBMODEL/1\nt\n\n/TITLE\nx\n//ENDSUB\n", DK040, silent},
  });
}

TEST(MissingId, ShowsWhatStandsInItsPlace) {
  const auto lint = [](const std::string& id) {
    return lint_text(
        "#RADIOSS STARTER\n/BEGIN\nx\n      2020         0\n/PARAMETER/GLOBAL/INT/1\n"
        "one\none                1\n/SURF/PART/" +
        id + "\ntitle\n         1\n/END\n");
  };
  for (const std::string id : {"-1", "1.5", "left", "0", "000"}) {
    const Linted r = lint(id);
    const Finding* d = r.find(RuleId::DK049);
    ASSERT_NE(d, nullptr) << id << '\n' << r.list();
    EXPECT_EQ(r.deck->sources.text(d->span), id);
  }
  for (const std::string id : {"001", "&one"}) EXPECT_FALSE(lint(id).fires(RuleId::DK049)) << id;
}

TEST(ByteOrderMark, IsRemovedByASafeFix) {
  const Linted run = lint_example(rule_of(RuleId::DK033).bad);
  for (const RuleId rule : {RuleId::DK001, RuleId::DK033}) {
    ASSERT_TRUE(run.fires(rule)) << run.list();
    const Finding* d = run.find(rule);
    ASSERT_TRUE(d->fix) << id_text(rule);
    EXPECT_TRUE(d->fix->safe);
    ASSERT_EQ(d->fix->edits.size(), 1u);
    EXPECT_EQ(run.deck->sources.text(d->fix->edits[0].span), "\xef\xbb\xbf");
    EXPECT_EQ(d->fix->edits[0].text, "");
  }
}

/// All texts of up to `length` of these letters.
std::vector<std::string> words(std::string_view letters, std::size_t length) {
  std::vector<std::string> out{""};
  for (std::size_t i = 0; i < out.size(); ++i)
    if (out[i].size() < length)
      for (const char letter : letters) out.push_back(out[i] + letter);
  return out;
}

TEST(Glob, AgreesWithItsDefinitionOnAllShortPatternsAndPaths) {
  const auto paths = words("a/b", 5);
  for (const std::string& pattern : words("a*/?", 5))
    for (const std::string& path : paths)
      ASSERT_EQ(glob_match(pattern, path), plain_glob(pattern, path)) << pattern << " " << path;
}

}  // namespace
}  // namespace deck::test
