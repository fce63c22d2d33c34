// The engine: suppressions, baseline, selection, order, bounds, what was not checked.
#include <gtest/gtest.h>

#include "lint/shared/config.hpp"
#include "lint/support.hpp"
#include "report/shared/diagnostics.hpp"

namespace deck::test {
namespace {

constexpr const char* negative = "@/INTER/TYPE7/1 Stfac=-1.0\n";

TEST(Suppression, InFrontOfTheHeaderCoversTheBlockBehindIt) {
  const Linted run =
      lint_example(std::string("# decklint: ignore[DK221] reason=a test\n") + negative);
  EXPECT_FALSE(run.fires(RuleId::DK221)) << run.list();
  EXPECT_EQ(run.result.suppressed, 1u);
  EXPECT_FALSE(run.fires(RuleId::DK091));
}

TEST(Suppression, InsideABlockCoversTheWholeBlock) {
  const std::string text = example_deck(negative, SchemaSet::built_in()).main;
  const auto at = text.find("example\n", text.find("/INTER/TYPE7/1"));
  const Linted run = lint_text(
      std::string(text).insert(at + 8, "# decklint: ignore[DK2] reason=a prefix works too\n"));
  EXPECT_FALSE(run.fires(RuleId::DK221)) << run.list();
  EXPECT_EQ(run.result.suppressed, 1u);
}

TEST(Suppression, IsFoundWhereTwoStretchesOfALargeFileMeet) {
  const std::string text = example_deck(negative, SchemaSet::built_in()).main;
  const std::string comment = "# decklint: ignore[DK221] reason=a test\n";
  const auto at = text.find("/INTER/TYPE7/1");
  constexpr std::size_t stretch = std::size_t{8} << 20;
  const std::size_t colon = comment.find(':');
  for (const std::size_t place : {stretch - 1, stretch, stretch + 3}) {
    std::string filler(place - colon - at, '#');
    for (std::size_t i = 99; i < filler.size(); i += 100) filler[i] = '\n';
    filler.back() = '\n';
    const Linted run = lint_text(std::string(text).insert(at, filler + comment));
    EXPECT_EQ(run.result.suppressed, 1u) << place;
  }
}

TEST(Suppression, DoesNotReachTheNextBlock) {
  const Linted run = lint_example(std::string("# decklint: ignore[DK221] reason=a test\n") +
                                  "@/INTER/TYPE7/2 Fric=0.1\n" + negative);
  EXPECT_TRUE(run.fires(RuleId::DK221));
  EXPECT_TRUE(run.fires(RuleId::DK091)) << "the suppression covers nothing";
}

TEST(Suppression, WithoutReasonHasNoEffectAndIsAFinding) {
  const Linted run = lint_example(std::string("# decklint: ignore[DK221]\n") + negative);
  EXPECT_TRUE(run.fires(RuleId::DK221));
  EXPECT_TRUE(run.fires(RuleId::DK090));
  EXPECT_EQ(run.result.suppressed, 0u);
}

TEST(Suppression, OfAFileStandsAtItsTop) {
  std::string text = example_deck(negative, SchemaSet::built_in()).main;
  const std::string comment = "# decklint: ignore-file[DK221] reason=a test\n";
  const Linted top = lint_text(std::string(text).insert(text.find("/BEGIN"), comment));
  EXPECT_FALSE(top.fires(RuleId::DK221)) << top.list();
  const Linted late = lint_text(std::string(text).insert(text.find("/INTER"), comment));
  EXPECT_TRUE(late.fires(RuleId::DK221));
  EXPECT_TRUE(late.fires(RuleId::DK093));
}

TEST(Suppression, OfARuleThatIsSwitchedOffIsNotCalledUnused) {
  LintOptions options;
  options.ignore = {"DK221"};
  const Linted run = lint_example(
      std::string("# decklint: ignore[DK221] reason=a test\n") + "@/INTER/TYPE7/1\n", options);
  EXPECT_FALSE(run.fires(RuleId::DK091)) << run.list();
}

TEST(Selection, SelectAndIgnoreTakeIdsAndPrefixes) {
  LintOptions only;
  only.select = {"DK221"};
  const Linted a = lint_example(negative, only);
  ASSERT_EQ(a.result.diagnostics.size(), 1u) << a.list();
  EXPECT_EQ(a.result.diagnostics[0].rule, RuleId::DK221);
  LintOptions without;
  without.ignore = {"DK2"};
  EXPECT_FALSE(lint_example(negative, without).fires(RuleId::DK221));
}

TEST(Selection, SeverityOverrideWithTheLongestSelectorWins) {
  LintOptions options;
  options.severity = {{"DK2", Severity::info}, {"DK221", Severity::warning}};
  const Linted run = lint_example(negative, options);
  ASSERT_TRUE(run.fires(RuleId::DK221));
  EXPECT_EQ(run.find(RuleId::DK221)->severity, Severity::warning);
}

TEST(Selection, PerFileIgnoresFollowTheGlob) {
  LintOptions options;
  options.per_file_ignores = {{"*_0000.rad", {"DK221"}}};
  EXPECT_FALSE(lint_example(negative, options).fires(RuleId::DK221));
  options.per_file_ignores = {{"*.inc", {"DK221"}}};
  EXPECT_TRUE(lint_example(negative, options).fires(RuleId::DK221));
}

constexpr const char* two_negative = "@/INTER/TYPE7/1 Stfac=-1.0 Gapmin=-0.5\n";

TEST(Selection, OfAFieldTakesThatFieldAlone) {
  const auto fields = [](const Linted& run) {
    std::string out;
    for (const Diagnostic& d : run.result.diagnostics)
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
  only.diagnostics_per_rule = 1;
  const Linted run = lint_example(std::string(negative) + two_negative, only);
  ASSERT_EQ(run.result.diagnostics.size(), 1u) << run.list();
  EXPECT_EQ(run.result.diagnostics[0].field, "Gapmin");
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

/// Baselines that were written before the rules became one.
TEST(FormerIds, KeepTheirFingerprints) {
  const auto print = [](const char* example) {
    const Linted run = lint_example(example);
    for (std::size_t i = 0; i < run.result.diagnostics.size(); ++i)
      if (!run.result.diagnostics[i].field.empty()) return run.result.fingerprints[i];
    return std::string();
  };
  EXPECT_EQ(print("@/INTER/TYPE7/1 Istf=7\n"), "aa938647f5703a2d");
  EXPECT_EQ(print("@/INTER/TYPE7/1 Igap=9\n"), "b164de3499dcbf3e");
  EXPECT_EQ(print(negative), "b9e13d04dd7fdf4b");
  EXPECT_EQ(print("@/INTER/TYPE7/1 Igap=2 %mesh_size=0.4\n"), "de43601330fefe7c");
}

/// A deck whose only finding is a negative Stfac, in a folder of its own.
class Baselines : public testing::Test {
 protected:
  std::string deck(const std::string& name, std::string_view example) const {
    return folder_.write(name, example_deck(example, SchemaSet::built_in()).main);
  }
  Linted lint(const std::string& path, const std::string& baseline = {}) const {
    LintOptions options;
    options.select = {"DK221"};
    if (!baseline.empty()) {
      const auto parsed = parse_baseline(baseline, file_);
      EXPECT_TRUE(parsed) << parsed.error().message;
      if (const auto* entries = parsed->find(path))
        for (const auto& [key, entry] : *entries) options.baseline.emplace(key, entry.count);
    }
    return lint_file(path, options);
  }
  std::string baseline_of(const std::vector<std::string>& paths) const {
    std::vector<Linted> linted;
    std::vector<BaselinedDeck> decks;
    for (const std::string& path : paths) linted.push_back(lint(path));
    for (std::size_t i = 0; i < paths.size(); ++i)
      decks.push_back({paths[i], linted[i].deck, &linted[i].result});
    return write_baseline(decks, file_);
  }
  Folder folder_;
  std::string file_ = folder_.path() + "/settings/baseline.json";
};

TEST_F(Baselines, HideTheFindingsOfTheirDeckWhereverTheCardMoves) {
  const std::string path = deck("old_0000.rad", negative);
  const std::string baseline = baseline_of({path});
  EXPECT_NE(baseline.find("../old_0000.rad"), std::string::npos) << baseline;
  EXPECT_EQ(baseline.find(folder_.path()), std::string::npos) << "paths are relative";
  const Linted again = lint(path, baseline);
  EXPECT_TRUE(again.result.diagnostics.empty()) << again.list();
  EXPECT_EQ(again.result.baselined, 1u);
  EXPECT_TRUE(again.result.stale.empty());
  // Lines above move the card, but not its fingerprint; a changed value is a new finding.
  deck("old_0000.rad", std::string("# a comment\n/TITLE\nx\n") + negative);
  EXPECT_FALSE(lint(path, baseline).fires(RuleId::DK221));
  deck("old_0000.rad", "@/INTER/TYPE7/1 Stfac=-2.0\n");
  EXPECT_TRUE(lint(path, baseline).fires(RuleId::DK221));
}

TEST_F(Baselines, HideNothingInADeckThatWasNeverInThem) {
  const std::string baseline = baseline_of({deck("old_0000.rad", negative)});
  EXPECT_TRUE(lint(deck("new_0000.rad", negative), baseline).fires(RuleId::DK221));
}

TEST_F(Baselines, CountPerDeck) {
  const std::string a = deck("a_0000.rad", negative), b = deck("b_0000.rad", negative);
  const std::string baseline = baseline_of({a, b});
  EXPECT_FALSE(lint(a, baseline).fires(RuleId::DK221));
  EXPECT_FALSE(lint(b, baseline).fires(RuleId::DK221));
  // The same card once more: one finding more than this deck may have.
  deck("a_0000.rad", std::string(negative) + negative);
  EXPECT_EQ(lint(a, baseline).count(RuleId::DK221), 1u);
}

TEST_F(Baselines, ListWhatDoesNotOccurAnyMore) {
  const std::string path = deck("old_0000.rad", negative);
  const std::string baseline = baseline_of({path});
  deck("old_0000.rad", "@/INTER/TYPE7/1 Stfac=1.0\n");
  const Linted run = lint(path, baseline);
  ASSERT_EQ(run.result.stale.size(), 1u);
  EXPECT_EQ(run.result.stale.begin()->first.first, path);
  EXPECT_EQ(run.result.stale.begin()->second, 1u);
}

TEST_F(Baselines, AreRefusedWhereTheyAreNone) {
  const auto refused = [](std::string_view text) {
    const auto parsed = parse_baseline(text, "b.json");
    return parsed ? std::string() : parsed.error().message;
  };
  EXPECT_NE(refused("{}"), "");
  EXPECT_NE(refused("not json"), "");
  EXPECT_NE(refused(R"({"schema":5,"decks":{}})"), "");
  EXPECT_NE(refused(R"({"schema":"deck.baseline/1","findings":{}})").find("older version"),
            std::string::npos);
  EXPECT_NE(
      refused(R"({"schema":"deck.baseline/2","decks":{"a":[{"count":-1}]}})").find("entry 1 of a"),
      std::string::npos);
  EXPECT_EQ(refused(R"({"schema":"deck.baseline/2","decks":{}})"), "");
}

TEST(Order, FollowsFileLineColumnRule) {
  const Linted run = lint_example(std::string(negative) + "@/INTER/TYPE7/2 Istf=7 Fric=-1.0\n");
  const auto& all = run.result.diagnostics;
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

TEST(Order, NoFindingAppearsTwice) {
  const Linted run = lint_example("@/INTER/TYPE7/1 Istf=two\n");
  EXPECT_EQ(run.count(RuleId::DK020), 1u) << run.list();
}

TEST(Floods, AreCountedBeyondTheBound) {
  std::string text;
  for (int i = 1; i <= 40; ++i) text += "@/INTER/TYPE7/" + std::to_string(i) + " Stfac=-1.0\n";
  LintOptions options;
  options.diagnostics_per_rule = 5;
  const Linted run = lint_example(text, options);
  EXPECT_EQ(run.count(RuleId::DK221), 5u);
  EXPECT_EQ(run.result.counts.at(RuleId::DK221), 40u);
  EXPECT_EQ(run.result.dropped.at(RuleId::DK221), 35u);
  EXPECT_GE(run.result.warnings, 40u);
}

TEST(NotChecked, NamesWhatWasLeftOutAndWhy) {
  const Linted run = lint_example("/NONSENSE/4\nsomething\n#include nowhere.inc\n");
  std::string all;
  for (const NotChecked& n : run.result.not_checked) all += n.what + ": " + n.why + "\n";
  EXPECT_NE(all.find("/NONSENSE"), std::string::npos) << all;
  EXPECT_NE(all.find("nowhere.inc"), std::string::npos) << all;
  EXPECT_NE(all.find("Engine"), std::string::npos) << all;
  EXPECT_NE(all.find("geometry"), std::string::npos) << all;
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

TEST(ShiftedCard, KeepsWhatStopsTheSolver) {
  // A line too many in front of the sides: the values of the card are not to be trusted, but the
  // main surface that is missing now stops the run.
  const Linted run = lint_example(
      "/INTER/TYPE7/1\nexample\n\n         2         1\n\n\n"
      "                 1.0                 0.2                 0.5\n"
      "       000                             6\n\n");
  ASSERT_TRUE(run.fires(RuleId::DK243)) << run.list();
  EXPECT_EQ(run.find(RuleId::DK243)->severity, Severity::warning);
  ASSERT_TRUE(run.fires(RuleId::DK181)) << run.list();
  EXPECT_EQ(run.find(RuleId::DK181)->severity, Severity::error);
}

TEST(NegativeReference, IsAnErrorWhereTheSolverLooksForTheId) {
  EXPECT_EQ(lint_example("@/INTER/TYPE7/1 grnd_IDs=-2\n").find(RuleId::DK187)->severity,
            Severity::error);
  const Linted sensor = lint_example("@/INTER/TYPE7/1 sens_ID=-3\n");
  EXPECT_EQ(sensor.find(RuleId::DK187)->severity, Severity::error);
  EXPECT_EQ(sensor.find(RuleId::DK187)->reference->number, 1010);
  for (const char* card : {"@/INTER/TYPE7/1 fric_ID=-5\n", "@/INTER/TYPE7/1 fct_IDF=-1\n"}) {
    const Linted run = lint_example(card);
    ASSERT_TRUE(run.fires(RuleId::DK187)) << card;
    EXPECT_EQ(run.find(RuleId::DK187)->severity, Severity::warning) << card;
    EXPECT_FALSE(run.find(RuleId::DK187)->reference) << card;
  }
}

TEST(InterfaceId, ZeroIsAnIdOfItsOwn) {
  const Linted run = lint_example("@/INTER/TYPE7/0\n@/INTER/TYPE7/1\n");
  EXPECT_FALSE(run.fires(RuleId::DK179)) << run.list();
  EXPECT_TRUE(lint_example("@/INTER/TYPE7/0\n@/INTER/TYPE7/0\n").fires(RuleId::DK179));
}

TEST(InterfaceId, IsNotTheCommentBehindTheHeader) {
  const Linted run = lint_example(
      "/INTER/TYPE7/2   # note\nexample\n         2         1\n"
      "\n\n                 1.0\n\n\n@/INTER/TYPE7/1\n");
  EXPECT_FALSE(run.fires(RuleId::DK179)) << run.list();
}

TEST(MissingId, ShowsWhatStandsInItsPlace) {
  for (const std::string id : {"-1", "1.5", "left"}) {
    const Linted r = lint_text("#RADIOSS STARTER\n/BEGIN\nx\n      2020         0\n/SURF/PART/" +
                               id + "\ntitle\n         1\n/END\n");
    const Diagnostic* d = r.find(RuleId::DK049);
    ASSERT_NE(d, nullptr) << id << '\n' << r.list();
    EXPECT_EQ(d->message, "'" + id + "' in the header of /SURF/PART is not an id");
    EXPECT_EQ(r.deck->sources.text(d->span), id);
  }
}

TEST(MissingId, IsAlsoAWrittenZeroButNoParameter) {
  const auto fires = [](const std::string& id) {
    return lint_text(
               "#RADIOSS STARTER\n/BEGIN\nx\n      2020         0\n/PARAMETER/GLOBAL/INT/1\n"
               "one\none                1\n/SURF/PART/" +
               id + "\ntitle\n         1\n/END\n")
        .fires(RuleId::DK049);
  };
  EXPECT_TRUE(fires("0"));
  EXPECT_TRUE(fires("000"));
  EXPECT_FALSE(fires("001"));
  EXPECT_FALSE(fires("&one"));
}

TEST(BlankLine, StopsTheSolverAmongElementsAndNotAmongNodes) {
  const Linted shells = lint_example(
      "/SHELL/1\n         9         1         2         3         4\n\n"
      "        10         1         2         3         4\n");
  ASSERT_TRUE(shells.fires(RuleId::DK036)) << shells.list();
  EXPECT_EQ(shells.find(RuleId::DK036)->severity, Severity::error);
  EXPECT_EQ(shells.find(RuleId::DK036)->reference->number, 760);
  const Linted end =
      lint_example("/SHELL/1\n         9         1         2         3         4\n\n# end\n\n");
  ASSERT_TRUE(end.fires(RuleId::DK036)) << end.list();
  EXPECT_EQ(end.find(RuleId::DK036)->severity, Severity::warning);
  const Linted nodes = lint_example(
      "/NODE\n\n        21                 0.0                 0.0                 9.0\n");
  ASSERT_TRUE(nodes.fires(RuleId::DK036)) << nodes.list();
  EXPECT_EQ(nodes.find(RuleId::DK036)->severity, Severity::warning);
}

TEST(ByteOrderMark, IsRemovedByASafeFix) {
  const Linted run = lint_example(rule_of(RuleId::DK033).bad);
  for (const RuleId rule : {RuleId::DK001, RuleId::DK033}) {
    ASSERT_TRUE(run.fires(rule)) << run.list();
    const Diagnostic* d = run.find(rule);
    ASSERT_TRUE(d->fix) << id_text(rule);
    EXPECT_TRUE(d->fix->safe);
    ASSERT_EQ(d->fix->edits.size(), 1u);
    EXPECT_EQ(run.deck->sources.text(d->fix->edits[0].span), "\xef\xbb\xbf");
    EXPECT_EQ(d->fix->edits[0].text, "");
  }
}

TEST(Memory, SecondNumberIsAReal) {
  const std::string card = "/MEMORY\n    400000                           .66\n";
  EXPECT_FALSE(lint_example(card).fires(RuleId::DK020)) << lint_example(card).list();
  EXPECT_TRUE(
      lint_example("/MEMORY\n       .66                           .66\n").fires(RuleId::DK020));
}

TEST(KindOfEntity, SaysWhatTheIdBelongsTo) {
  const Linted run = lint_example("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1\n");
  ASSERT_TRUE(run.fires(RuleId::DK171)) << run.list();
  EXPECT_NE(run.find(RuleId::DK171)->message.find("/SURF"), std::string::npos);
  EXPECT_NE(run.find(RuleId::DK171)->help.find("/GRNOD/SURF"), std::string::npos);
  EXPECT_FALSE(run.fires(RuleId::DK170));
}

TEST(MissingLine, NamesTheFlagThatAsksForIt) {
  const Linted run = lint_example(rule_of(RuleId::DK240).bad);
  ASSERT_TRUE(run.fires(RuleId::DK240));
  EXPECT_NE(run.find(RuleId::DK240)->message.find("Ifric = 1"), std::string::npos)
      << run.find(RuleId::DK240)->message;
}

TEST(UnknownKeyword, HasASlashTooManyUnlessItIsASubmodel) {
  const Linted run = lint_example("//INTER/TYPE7/1\nexample\n         2         1\n");
  ASSERT_TRUE(run.fires(RuleId::DK040)) << run.list();
  EXPECT_NE(run.find(RuleId::DK040)->message.find("did you mean /INTER/TYPE7"), std::string::npos);
  EXPECT_FALSE(lint_example("//SUBMODEL/1\nt\n\n/TITLE\nx\n//ENDSUB\n").fires(RuleId::DK040));
}

TEST(Config, ReadsEveryKey) {
  const auto config = parse_lint_config(
      "select = [\"DK2\"]\nignore = [\"DK221\"]\nfail-on = \"warning\"\nbaseline = \"base.json\"\n"
      "[severity]\n\"DK265:VISF\" = \"error\"\n[per-file-ignores]\n\"*.inc\" = [\"DK0\"]\n",
      "/some/where/.decklint.toml");
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->select, std::vector<std::string>{"DK2"});
  EXPECT_EQ(config->ignore, std::vector<std::string>{"DK221"});
  EXPECT_EQ(config->fail_on, "warning");
  EXPECT_EQ(config->baseline, "/some/where/base.json");
  EXPECT_EQ(config->severity.at("DK265:VISF"), Severity::error);
  ASSERT_EQ(config->per_file_ignores.size(), 1u);
  EXPECT_EQ(config->per_file_ignores[0].first, "*.inc");
}

TEST(Config, RefusesKeysThatStartWithWhatNoKeyCanStartWith) {
  for (const char* text :
       {"[*b*]\n", "[", "[[*]]\n", "select = []\n[\nDK104 = \"error\"\n[x]\n", "[ ,", "*=1\n"}) {
    const auto config = parse_lint_config(text, "c.toml");
    ASSERT_FALSE(config.ok()) << text;
    EXPECT_EQ(config.error().message.find("c.toml"), 0u) << config.error().message;
  }
}

TEST(Glob, MatchesNamesPathsAndDepth) {
  EXPECT_TRUE(glob_match("*.rad", "x.rad"));
  EXPECT_TRUE(glob_match("*.rad", "deep/er/x.rad"));
  EXPECT_FALSE(glob_match("*.rad", "x.inc"));
  EXPECT_TRUE(glob_match("lib/*.inc", "model/lib/x.inc"));
  EXPECT_FALSE(glob_match("lib/*.inc", "model/lib/sub/x.inc"));
  EXPECT_TRUE(glob_match("lib/**/*.inc", "lib/a/b/x.inc"));
  EXPECT_TRUE(glob_match("lib/**/*.inc", "lib/x.inc"));
  EXPECT_TRUE(glob_match("x?.rad", "x1.rad"));
  EXPECT_FALSE(glob_match("x?.rad", "x/.rad"));
}

/// The definition of a match, branch by branch: exponential, so for short texts only.
bool matches(std::string_view p, std::string_view s) {
  if (p.empty()) return s.empty();
  if (p[0] == '*') {
    const bool deep = p.starts_with("**");
    p.remove_prefix(deep ? 2 : 1);
    if (deep && p.starts_with('/') && matches(p.substr(1), s)) return true;
    for (std::size_t i = 0; i <= s.size(); ++i) {
      if (matches(p, s.substr(i))) return true;
      if (i < s.size() && !deep && s[i] == '/') return false;
    }
    return false;
  }
  if (s.empty() || (p[0] == '?' ? s[0] == '/' : p[0] != s[0])) return false;
  return matches(p.substr(1), s.substr(1));
}

bool matches_anywhere(std::string_view p, std::string_view s) {
  if (matches(p, s)) return true;
  if (p.find('/') == std::string_view::npos)
    return s.rfind('/') != std::string_view::npos && matches(p, s.substr(s.rfind('/') + 1));
  for (std::size_t at = s.find('/'); at != std::string_view::npos; at = s.find('/', at + 1))
    if (matches(p, s.substr(at + 1))) return true;
  return false;
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
      ASSERT_EQ(glob_match(pattern, path), matches_anywhere(pattern, path))
          << pattern << " " << path;
}

TEST(Glob, ManyStarsTakeNoMoreThanTheLengthOfPatternAndPath) {
  std::string pattern;
  for (int i = 0; i < 200; ++i) pattern += "*a";
  EXPECT_FALSE(glob_match(pattern + "b", std::string(4000, 'a')));
  EXPECT_TRUE(glob_match(pattern, std::string(4000, 'a')));
  EXPECT_FALSE(glob_match("**/" + pattern + "/b", std::string(2000, 'a') + "/c"));
}

TEST(Config, KeysOfVeryManyPartsAreRefusedWithTheLine) {
  std::string key = "a";
  for (int i = 0; i < 200'000; ++i) key += ".a";
  for (const std::string& text : {"\n" + key + " = 1\n", "\n[" + key + "]\n",
                                  "\nx = {" + key + " = 1}\n", "\ny = \"'\" \n" + key + " = 1\n"}) {
    const auto config = parse_lint_config(text, "c.toml");
    ASSERT_FALSE(config);
    EXPECT_NE(config.error().message.find("dotted parts"), std::string::npos)
        << config.error().message;
  }
  const auto line = parse_lint_config("# a.b\n\n" + key + " = 1\n", "c.toml");
  EXPECT_NE(line.error().message.find("c.toml:3"), std::string::npos) << line.error().message;
}

TEST(Config, OnlyRegularFilesOfBoundedSizeAreRead) {
  EXPECT_FALSE(read_config_file("/dev/zero", 1000));
  const Folder folder;
  const std::string file = folder.write("c.toml", std::string(1001, '#'));
  EXPECT_FALSE(read_config_file(file, 1000));
  EXPECT_TRUE(read_config_file(file, 1001));
  EXPECT_FALSE(parse_baseline(R"({"schema":5,"decks":{}})", "b.json"));
}

}  // namespace
}  // namespace deck::test
