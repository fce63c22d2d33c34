// The lists of findings by stage: what is joined, in which order, how often, and what is counted.
#include "front/findings.hpp"

#include <gtest/gtest.h>

#include "deck/rule_id.hpp"
#include "lint/shared/example.hpp"

namespace deck::test {
namespace {

using detail::FindingLists;
using Messages = std::vector<std::string>;

Finding finding(RuleId rule, const std::string& message, std::uint64_t offset = 1,
                std::uint32_t file = 0) {
  Finding d;
  d.rule = rule;
  d.message = message;
  d.span.file = file;
  d.span.offset = offset;
  return d;
}

Messages messages(const Findings& d) {
  Messages out;
  for (const Finding& f : d.all()) out.push_back(f.message);
  return out;
}

/// Every list has a finding of its own.
FindingLists all_stages(int per_rule = 10) {
  Findings reading;
  reading.report(finding(RuleId::DK100, "deck"));
  FindingLists lists(reading, per_rule);
  lists.of(Stage::model).report(finding(RuleId::DK101, "model"));
  lists.of(Stage::interfaces).report(finding(RuleId::DK102, "interfaces"));
  lists.of(Stage::cells).report(finding(RuleId::DK103, "cells"));
  lists.of(Stage::scene).report(finding(RuleId::DK104, "scene"));
  lists.of_mesh().report(finding(RuleId::DK150, "mesh"));
  lists.add(finding(RuleId::DK151, "added"));
  return lists;
}

TEST(FindingLists, AreJoinedUpToAStageInTheirOrder) {
  const FindingLists lists = all_stages();
  EXPECT_EQ(messages(lists.joined(Stage::deck)), (Messages{"deck", "added"}));
  EXPECT_EQ(messages(lists.joined(Stage::model)), (Messages{"deck", "model", "added"}));
  EXPECT_EQ(messages(lists.joined(Stage::interfaces)),
            (Messages{"deck", "model", "interfaces", "added"}));
  EXPECT_EQ(messages(lists.joined(Stage::cells)),
            (Messages{"deck", "model", "interfaces", "mesh", "cells", "added"}));
  EXPECT_EQ(messages(lists.joined(Stage::scene)), messages(lists.joined(Stage::cells)))
      << "that of a scene is given";
}

TEST(FindingLists, TakeThoseOfTheSceneThatIsGiven) {
  FindingLists lists = all_stages();
  Findings scene;
  scene.report(finding(RuleId::DK152, "another scene"));
  const Messages wanted{"deck", "model", "interfaces", "mesh", "another scene", "cells", "added"};
  EXPECT_EQ(messages(lists.joined(Model{}, scene)), wanted);
  EXPECT_EQ(messages(lists.of(Stage::scene)), Messages{"scene"});
  lists.forget_scene();
  EXPECT_EQ(messages(lists.of(Stage::scene)), Messages{});
  EXPECT_EQ(messages(lists.joined(Model{}, scene)), wanted);
}

TEST(FindingLists, SayEachFindingOnceAndTwoThatDifferTwice) {
  Findings reading;
  reading.report(finding(RuleId::DK100, "a"));
  FindingLists lists(reading, 10);
  lists.of(Stage::model).report(finding(RuleId::DK100, "a"));
  lists.of(Stage::model).report(finding(RuleId::DK101, "a"));
  lists.of(Stage::model).report(finding(RuleId::DK100, "b"));
  lists.of(Stage::interfaces).report(finding(RuleId::DK100, "a", 2));
  lists.of(Stage::interfaces).report(finding(RuleId::DK100, "a", 1, 1));
  lists.of(Stage::interfaces).report(finding(RuleId::DK101, "a"));
  lists.add(finding(RuleId::DK100, "b"));
  const Findings all = lists.joined(Stage::cells);
  EXPECT_EQ(messages(all), (Messages{"a", "a", "b", "a", "a"}));
  EXPECT_EQ(all.counts(),
            (std::map<RuleId, std::uint64_t>{{RuleId::DK100, 4}, {RuleId::DK101, 1}}));
}

TEST(FindingLists, CountOnWhatWasOnlyCounted) {
  Findings reading(2);
  for (std::uint64_t i = 0; i < 5; ++i) reading.report(finding(RuleId::DK100, "r", i));
  FindingLists lists(reading, 3);
  for (std::uint64_t i = 10; i < 17; ++i)
    lists.of(Stage::model).report(finding(RuleId::DK100, "m", i));
  const Findings all = lists.joined(Stage::deck);
  EXPECT_EQ(all.all().size(), 2u);
  EXPECT_EQ(all.counts().at(RuleId::DK100), 5u);
  const Findings both = lists.joined(Stage::model);
  EXPECT_EQ(messages(both), (Messages{"r", "r"})) << "five are more than its limit";
  EXPECT_EQ(both.counts().at(RuleId::DK100), 12u);
}

/// A deck with these lines.
Deck deck_of(const std::string& text) {
  auto deck =
      read_deck_text("cells_0000.rad", example_deck("@bare\n" + text, SchemaSet::built_in()).main,
                     SchemaSet::built_in());
  EXPECT_TRUE(deck.ok());
  return std::move(*deck);
}

/// The lines with errors in their cells, counted from 1.
std::vector<std::uint32_t> bad_lines(const Deck& deck, int threads = 1) {
  FindingLists lists(Findings{}, 1000);
  EXPECT_TRUE(lists.wants_cells());
  lists.read_cells(deck, threads);
  EXPECT_FALSE(lists.wants_cells());
  std::vector<std::uint32_t> out;
  for (const Finding& d : lists.of(Stage::cells).all()) {
    EXPECT_EQ(d.severity, Severity::error);
    out.push_back(static_cast<std::uint32_t>(d.id));
  }
  return out;
}

TEST(Cells, AreReadOfOptionsThatContactsDependOn) {
  // A blank group has no cell; a node, a curve and a load are none of theirs.
  const std::string text =
      "/GRNOD/NODE/1\ng\n        x1\n/SURF/PART/2\ns\n         1\n/PART/3\np\n        x1\n"
      "/FUNCT/4\nf\n                  x1                   2\n/NODE\n         1                  "
      "x1\n"
      "/PROP/TYPE1/5\np\n        zz\n/MAT/LAW1/6\nm\n                 x.1\n";
  EXPECT_EQ(bad_lines(deck_of(text)), (std::vector<std::uint32_t>{1, 3, 5, 6}));
}

TEST(Cells, OfManyOptionsAreReadInTheirOrderByAnyNumberOfThreads) {
  for (const std::uint32_t n : {15u, 16u, 17u, 32u, 33u}) {
    std::string text;
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 1; i <= n; ++i) {
      text += "/GRNOD/NODE/" + std::to_string(i) + "\ng\n        x1\n";
      wanted.push_back(i);
    }
    const Deck deck = deck_of(text);
    EXPECT_EQ(bad_lines(deck), wanted);
    EXPECT_EQ(bad_lines(deck, 3), wanted);
  }
}

}  // namespace
}  // namespace deck::test
