// Baselines: what is written is read, what is accepted is hidden, and nothing else.
#include "lint/shared/baseline.hpp"

#include <gtest/gtest.h>

#include "lint/shared/geometry.hpp"
#include "lint/support.hpp"

namespace deck::test {
namespace {

constexpr const char* negative = "@/INTER/TYPE7/1 Stfac=-1.0\n";

class Baselines : public testing::Test {
 protected:
  std::string deck(const std::string& name, std::string_view example) const {
    return folder_.write(name, example_deck(example, SchemaSet::built_in()).main);
  }
  Linted lint(const std::string& path, const Baseline* baseline = nullptr) const {
    LintOptions options;
    options.select = {"DK221"};
    if (baseline != nullptr) options.baseline = *baseline->findings_of(path);
    return lint_file(path, options);
  }
  Baseline accepted(const std::vector<std::string>& paths) const {
    Baseline out(file_, Baseline::Kind::lint);
    for (const std::string& path : paths) {
      const Linted run = lint(path);
      out.accept(path, *run.deck, run.result);
    }
    const auto read = Baseline::parse(out.text(), file_, Baseline::Kind::lint);
    EXPECT_TRUE(read);
    EXPECT_EQ(read->text(), out.text());
    return *read;
  }
  Folder folder_;
  std::string file_ = folder_.path() + "/settings/baseline.json";
};

TEST_F(Baselines, HideAFindingWhoseTextOrLineChanged) {
  const std::string path = deck("old_0000.rad", negative);
  const Baseline baseline = accepted({path});
  EXPECT_EQ(baseline.text(), R"({"deck":"../old_0000.rad","rule":"DK221","file":"../old_0000.rad",)"
                             R"("entity":"/INTER/TYPE7/1","field":"Stfac","value":null})"
                             "\n");
  deck("old_0000.rad", "# a comment\n/TITLE\nx\n@/INTER/TYPE7/1 Stfac=-2.0\n");
  const Linted again = lint(path, &baseline);
  EXPECT_TRUE(again.result.findings.empty()) << again.list();
  EXPECT_EQ(again.result.baselined, 1u);
  EXPECT_TRUE(again.result.stale.empty());
  deck("old_0000.rad", "@/INTER/TYPE7/1 Fric=-2.0\n");
  EXPECT_TRUE(lint(path, &baseline).fires(RuleId::DK221)) << "another field";
}

TEST_F(Baselines, AcceptAsManyAsThereWere) {
  const std::string path = deck("a_0000.rad", std::string(negative) + negative);
  const Baseline baseline = accepted({path});
  deck("a_0000.rad", std::string(negative) + negative + negative);
  EXPECT_EQ(lint(path, &baseline).count(RuleId::DK221), 1u);
  deck("a_0000.rad", negative);
  const Linted fewer = lint(path, &baseline);
  ASSERT_EQ(fewer.result.stale.size(), 1u);
  EXPECT_EQ(fewer.result.stale.begin()->second, 1u);
}

TEST_F(Baselines, ReplaceTheEntriesOfTheDeckGiven) {
  const std::string a = deck("a_0000.rad", negative), b = deck("b_0000.rad", negative);
  Baseline baseline = accepted({b, a});
  const std::string both = baseline.text();
  EXPECT_LT(both.find("a_0000"), both.find("b_0000"));
  deck("a_0000.rad", "@/INTER/TYPE7/1 Stfac=1.0\n");
  const Linted clean = lint(a);
  baseline.accept(a, *clean.deck, clean.result);
  EXPECT_EQ(baseline.text(), accepted({b}).text());
}

TEST_F(Baselines, HideNoNumberThatGotWorse) {
  const auto linted_with = [&](double gap, const AcceptedFindings& known) {
    LintOptions options;
    options.select = {"DK301"};
    options.baseline = known;
    const std::string path =
        deck("a_0000.rad", "@/INTER/TYPE7/1 Inacti=6 Gapmin=" + std::to_string(gap) + "\n");
    LoadOptions how;
    auto loaded = load(path, how);
    EXPECT_TRUE(loaded);
    Linted out(std::move(*loaded));
    out.result = run_lint(out.loaded, options,
                          {[](const LintContext& c, Reporter& r) { return check_geometry(c, r); }});
    return out;
  };
  const Linted first = linted_with(4, {});
  ASSERT_TRUE(first.fires(RuleId::DK301));
  Baseline baseline(file_, Baseline::Kind::lint);
  const std::string path = folder_.path() + "/a_0000.rad";
  baseline.accept(path, *first.deck, first.result);
  const AcceptedFindings known = *baseline.findings_of(path);
  EXPECT_FALSE(linted_with(3.5, known).fires(RuleId::DK301)) << "less deep";
  const Linted worse = linted_with(4.5, known);
  EXPECT_TRUE(worse.fires(RuleId::DK301));
  EXPECT_TRUE(worse.result.stale.empty()) << "it still occurs";
}

TEST_F(Baselines, OfGapsListPenetrationsAndNodesThatAreNotTied) {
  Baseline baseline("/d/base.json", Baseline::Kind::gaps);
  const auto read = Baseline::parse(
      R"({"deck":"a_0000.rad","interface":3,"kind":"edges","ids":[8,9],"depth":0.5,"gap":1.25})"
      "\n"
      R"({"deck":"a_0000.rad","interface":4,"kind":"untied","ids":[7],"depth":null,"gap":null})"
      "\n",
      "/d/base.json", Baseline::Kind::gaps);
  ASSERT_TRUE(read);
  const auto gaps = read->gaps_of("/d/a_0000.rad");
  ASSERT_TRUE(gaps);
  ASSERT_EQ(gaps->rows.size(), 1u);
  EXPECT_EQ(gaps->rows[0].secondary, (std::array<std::int64_t, 2>{8, 9}));
  EXPECT_EQ(gaps->rows[0].role, "edges");
  EXPECT_EQ(gaps->rows[0].depth, 0.5);
  EXPECT_TRUE(gaps->untied.at(4).contains(7));
  EXPECT_TRUE(gaps->accepts);
  EXPECT_EQ(read->gaps_of("/d/b_0000.rad")->deck_path, "");
}

TEST_F(Baselines, AreRefusedWhereTheyAreNone) {
  const auto refused = [](std::string_view text) {
    const auto read = Baseline::parse(text, "b.json", Baseline::Kind::lint);
    return read ? std::string() : read.error().message;
  };
  EXPECT_EQ(refused(""), "");
  EXPECT_NE(refused("not json"), "");
  EXPECT_NE(refused("[]\n"), "");
  EXPECT_NE(refused(R"({"deck":5})"), "");
  for (const char* earlier : {R"({"schema": "deck.baseline/2", "decks": {}})",
                              "{\n \"schema\": {\"id\": \"deck/gaps\", \"version\": 1}\n}"})
    EXPECT_NE(refused(earlier).find("deck lint DECK... --write-baseline b.json"),
              std::string::npos);
  const auto wrong =
      Baseline::parse(R"({"deck":"a_0000.rad","interface":1})", "b.json", Baseline::Kind::lint);
  ASSERT_TRUE(wrong);
  EXPECT_FALSE(wrong->findings_of("a_0000.rad"));
}

}  // namespace
}  // namespace deck::test
