// Every rule fires on its own bad example and stays silent on its good one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <regex>
#include <set>

#include "contact/small_deck.hpp"
#include "lint/support.hpp"
#include "where.hpp"

namespace deck::test {
namespace {

/// Nodes 1 to 8 at three quadrangles on the side 2-3, each so many nodes after the one before.
SmallDeck three_leaves(int apart) {
  SmallDeck d;
  const int x[] = {0, 1, 1, 0, 2, 2, 1, 1}, y[] = {0, 0, 1, 1, 0, 1, 0, 1};
  for (int n = 0; n < 8; ++n) {
    d.node(1 + n * apart, x[n], y[n], n > 5);
    for (int k = 1; k < apart; ++k) d.node(1 + n * apart + k, 9, k, n);
  }
  return d;
}

TEST(FreeEdges, AreSidesOfOneSegmentHoweverFarApartTheirNodesAre) {
  for (const int apart : {1, 50}) {
    const auto id = [&](int n) { return 1 + (n - 1) * apart; };
    const std::vector<std::vector<int>> leaves = {
        {id(1), id(2), id(3), id(4)}, {id(2), id(5), id(6), id(3)}, {id(2), id(7), id(8), id(3)}};
    const auto said = [&](const std::vector<std::vector<int>>& segments) {
      SmallDeck d = three_leaves(apart);
      d.segments("/SURF/SEG/1", segments).group("/GRNOD/NODE/2", {id(1)});
      const Linted run = lint_text(d.add("@/INTER/TYPE7/1 Gapmin=1").text());
      const Finding* found = run.find(RuleId::DK916);
      return found == nullptr ? std::string() : found->message;
    };
    EXPECT_THAT(said(leaves), testing::HasSubstr(" 9 free edges")) << apart;
    EXPECT_THAT(said({leaves[0], leaves[1], leaves[2], leaves[0]}),
                testing::HasSubstr(" 6 free edges"))
        << apart;
    EXPECT_EQ(said({leaves[0], leaves[0]}), "") << apart;
  }
}

TEST(FreeEdges, AreCountedAroundANodeOfManySides) {
  SmallDeck d;
  d.node(1, 0, 0, 0);
  std::vector<std::vector<int>> fan;
  for (int n = 2; n <= 7; ++n) {
    d.node(n, std::cos(n), std::sin(n), 0);
    if (n > 2) fan.push_back({1, n - 1, n, n});
  }
  d.segments("/SURF/SEG/1", fan).group("/GRNOD/NODE/2", {1});
  const Linted run = lint_text(d.add("@/INTER/TYPE7/1 Gapmin=1").text());
  const Finding* found = run.find(RuleId::DK916);
  ASSERT_NE(found, nullptr);
  EXPECT_THAT(found->message, testing::HasSubstr(" 7 free edges")) << "five outside, two spokes";
}

class EveryRule : public testing::TestWithParam<std::string> {
 protected:
  const Rule& rule() const { return *find_rule(GetParam()); }
  /// With the contacts where the rule needs them.
  Linted lint(std::string_view example) const {
    return rule().stage == RuleStage::extra ? lint_geometry(example) : lint_example(example);
  }
};

std::vector<std::string> ids_with_examples() {
  std::vector<std::string> ids;
  for (const Rule& r : all_rules())  // gate_test.cpp asks those of the gate
    if (!r.bad.empty() && r.stage != RuleStage::gate) ids.emplace_back(id_text(r.id));
  return ids;
}

TEST_P(EveryRule, StaysSilentOnItsGoodExample) {
  const Linted run = lint(rule().good);
  EXPECT_FALSE(run.fires(rule().id))
      << example_deck(rule().good, SchemaSet::built_in()).main << run.list();
}

TEST_P(EveryRule, ExamplesNameFieldsThatExist) {
  for (const std::string_view text : {rule().bad, rule().good}) {
    const std::string deck = example_deck(text, SchemaSet::built_in()).main;
    EXPECT_EQ(deck.find("# unused:"), std::string::npos) << deck;
    EXPECT_EQ(deck.find("# no schema"), std::string::npos) << deck;
  }
}

TEST_P(EveryRule, FiresOnItsBadExampleAsItsPageSays) {
  const Linted run = lint(rule().bad);
  const Finding* d = run.find(rule().id);
  ASSERT_NE(d, nullptr) << example_deck(rule().bad, SchemaSet::built_in()).main << run.list();
  EXPECT_TRUE(d->span.valid());
  EXPECT_FALSE(d->message.empty());
  EXPECT_FALSE(d->help.empty() && d->reference_behaviour.empty());
  if (d->fix) {
    EXPECT_FALSE(d->fix->edits.empty());
    EXPECT_NE(rule().fixable, Fixable::no) << "the rule does not promise a fix";
  }
  const auto& all = run.result.findings;
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Finding& found) {
    return found.rule == rule().id && found.severity == rule().severity();
  }));
}

TEST_P(EveryRule, ThatNeedsContactsIsNotCheckedWithoutThem) {
  if (rule().stage == RuleStage::extra) {
    EXPECT_FALSE(lint_example(rule().bad).fires(rule().id));
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, EveryRule, testing::ValuesIn(ids_with_examples()),
                         [](const auto& one) { return one.param; });

std::string line_and_column(const Linted& run, const Span& span) {
  const auto at = run.deck->sources[span.file].position(span.offset);
  return std::to_string(at.line) + ":" + std::to_string(at.column);
}

/// Where the bad example of each rule is found: "rule line:column" in the order of the rules
/// (DECK_RECORD=1 renews the record).
TEST(ExamplePlaces, AreThoseOfTheRecord) {
  std::string found;
  std::size_t width = 0;
  for (const Rule& rule : all_rules()) {
    if (rule.bad.empty() || rule.stage == RuleStage::gate) continue;
    const bool geometry = rule.stage == RuleStage::extra;
    const Linted run = geometry ? lint_geometry(rule.bad) : lint_example(rule.bad);
    std::string item(id_text(rule.id));
    for (const Finding& d : run.result.findings)
      if (d.rule == rule.id) item += " " + line_and_column(run, d.span);
    const bool breaks = width > 0 && width + item.size() > 96;
    if (width > 0) found += breaks ? ";\n" : "; ";
    width = (breaks ? 0 : width + 2) + item.size();
    found += item;
  }
  const auto path = source_dir() / "tests/lint/example_places.txt";
  std::ifstream in(path);
  const std::string wanted{std::istreambuf_iterator<char>(in), {}};
  if (found + "\n" != wanted && std::getenv("DECK_RECORD") != nullptr)
    std::ofstream(path) << found << '\n';
  else
    EXPECT_EQ(found + "\n", wanted);
}

/// A data line with a NUL byte cannot be written into the rule table.
TEST(NulByte, FiresInDataAndNotInCleanData) {
  const std::string clean =
      example_deck("/GRNOD/NODE/7\nnodes\n         1         2\n", SchemaSet::built_in()).main;
  std::string broken = clean;
  broken[broken.find("         1         2") + 12] = '\0';
  EXPECT_TRUE(lint_text(broken).fires(RuleId::DK014)) << lint_text(broken).list();
  EXPECT_FALSE(lint_text(clean).fires(RuleId::DK014));
}

/// A keyword that somebody adds can reach DK165, or a control character in a header.
TEST(UnknownCombination, FiresForAnAddedSurfaceKeyword) {
  SchemaSet schemas = SchemaSet::built_in();
  ASSERT_TRUE(schemas.add_json("extra", R"({"keyword": "/SURF/CLOUD", "kind": "surf",
      "doc": "A surface of no known kind.", "cards": []})"));
  const auto fires = [&](const std::string& block) {
    const std::string text = example_deck(block, schemas).main;
    auto deck = read_deck_text("deck_0000.rad", text, schemas);
    const LintResult r = run_lint(linted(std::move(*deck), with_schemas(schemas)).loaded);
    return r.counts.count(RuleId::DK165) > 0;
  };
  EXPECT_TRUE(fires("/SURF/CLOUD/9\nnothing\n"));
  EXPECT_FALSE(fires("/SURF/PART/9\nlower\n         1\n"));
}

TEST(UnknownCombination, OfALineHasTheMessageOfLines) {
  const Linted run = lint_example("/LINE/SURF\x1d/9\nodd\n         1\n");
  ASSERT_TRUE(run.fires(RuleId::DK165)) << run.list();
  EXPECT_EQ(run.find(RuleId::DK165)->reference->number, 688);
}

TEST(RuleTable, HasBothExamplesExceptWhereAnotherTestBringsThem) {
  const std::set<RuleId> others = {RuleId::DK014, RuleId::DK165, RuleId::DK332, RuleId::DK380,
                                   RuleId::DK390};
  for (const Rule& r : all_rules()) {
    EXPECT_EQ(r.bad.empty(), r.good.empty()) << id_text(r.id);
    EXPECT_EQ(r.bad.empty(), others.contains(r.id)) << id_text(r.id);
  }
}

TEST(RuleTable, WhatTheSolverOnlyWarnsAboutIsNoError) {
  for (const Rule& r : all_rules())
    if (r.severity() == Severity::error && !r.messages.empty()) {
      EXPECT_EQ(r.messages.front().severity, Severity::error) << id_text(r.id);
    }
}

/// The reference solver checks hardly any flag: it runs on, so the finding must not stop a deck.
TEST(RuleTable, FlagsAndSignsOutOfRangeAreWarnings) {
  for (const Rule& r : all_rules()) {
    const int id = id_number(r.id);
    if ((id >= 201 && id <= 218) || (id >= 221 && id <= 236)) {
      EXPECT_EQ(r.severity(), Severity::warning) << id;
    }
  }
}

/// The compiler knows which ids there are, as long as nobody writes one as text.
TEST(RuleTable, NoSourceSpellsAnIdAsText) {
  const std::regex id("^[^\n/]*\"DK[0-9]{2}", std::regex::multiline);
  int files = 0;
  for (const char* folder : {"libdeck", "tools/cli"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(test::source_dir() / folder)) {
      const auto name = entry.path().extension();
      if (name != ".cpp" && name != ".hpp") continue;
      ++files;
      std::ifstream in(entry.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      std::smatch found;
      EXPECT_FALSE(std::regex_search(text, found, id)) << found.str() << " in " << entry.path();
    }
  EXPECT_GT(files, 100);
}

TEST(ElementsOnTheSameNodes, AreThoseThatEveryPairOfThemGives) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    SmallDeck d;
    d.shell_part(1, 1);
    std::vector<int> ids = {1, 2, 3, 4, 5, 6, 7};
    for (const int n : ids) d.node(n, n, n * n, n * n * n);
    std::vector<std::set<int>> before;
    int repeated = 0;
    for (int e = 1; e <= 40; ++e) {
      std::shuffle(ids.begin(), ids.end(), random);
      d.shell(1, e, ids[0], ids[1], ids[2], ids[3]);
      const std::set<int> nodes(ids.begin(), ids.begin() + 4);
      repeated += std::find(before.begin(), before.end(), nodes) != before.end() ? 1 : 0;
      before.push_back(nodes);
    }
    const Linted run = lint_text(d.text());
    const Finding* found = run.find(RuleId::DK617);
    ASSERT_NE(found, nullptr);
    EXPECT_TRUE(found->message.starts_with(std::to_string(repeated) + " shells on the same nodes"))
        << found->message << ", not " << repeated;
  }
}

TEST(RuleTable, FamiliesFollowTheLeadingDigit) {
  EXPECT_EQ(family_of(RuleId::DK001), "syntax, columns, version");
  EXPECT_EQ(family_of(RuleId::DK250), "contact options");
  EXPECT_TRUE(selects("DK2", RuleId::DK250));
  EXPECT_TRUE(selects("all", RuleId::DK250));
  EXPECT_FALSE(selects("DK25", RuleId::DK217));
  EXPECT_FALSE(selects("", RuleId::DK217));
  EXPECT_TRUE(known_selector("DK5"));
  EXPECT_FALSE(known_selector("DK7"));
}

/// 1e30 is what the solver itself takes for "no bound"; writing it down changes nothing.
TEST(BoundsOfContacts, ThatBoundNothingAreNoFinding) {
  const auto fires = [](const char* card, RuleId rule) { return lint_example(card).fires(rule); };
  EXPECT_FALSE(fires("@/INTER/TYPE7/1 Igap=1000 Gapmin=1.0 Gapmax=1e30", RuleId::DK265));
  EXPECT_TRUE(fires("@/INTER/TYPE7/1 Igap=1000 Gapmin=1.0 Gapmax=1e3", RuleId::DK265));
  EXPECT_FALSE(fires("@/INTER/TYPE7/1 Istf=4 Stmax=1e30", RuleId::DK296));
  EXPECT_TRUE(fires("@/INTER/TYPE7/1 Istf=4 Stmax=1e3", RuleId::DK296));
}

}  // namespace
}  // namespace deck::test
