// A comparison of two decks as JSON, tables and a sentence, from changes that are written out here.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "deck/verdict.hpp"
#include "report/diff_rows.hpp"
#include "report/inspected.hpp"

namespace deck::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using Rows = std::vector<std::vector<std::string>>;

struct Compared {
  Compared() {
    Change gap;
    gap.kind = ChangeKind::changed;
    gap.group = "interface";
    gap.keyword = "/INTER/TYPE7";
    gap.id = 1;
    gap.id_b = 501;
    gap.title = "front";
    gap.field = "Gapmin";
    gap.old_value = 0.5;
    gap.new_value = 0.75;
    gap.evaluated = true;
    gap.effective_old = 0.625;
    gap.effective_new = std::int64_t{7};
    gap.why = "card";
    gap.a = a.scene.interfaces->ordered[0]->span;
    gap.b = gap.a;
    Change nodes;
    nodes.group = "group";
    nodes.keyword = "/GRNOD/NODE";
    nodes.id = 2;
    nodes.field = "nodes";
    nodes.old_value = std::int64_t{3};
    nodes.new_value = std::int64_t{4};
    for (std::int64_t id = 11; id < 20; ++id) nodes.gained.push_back(id);
    nodes.lost = {31, 32};
    nodes.altered = {41};
    Change moved;
    moved.kind = ChangeKind::moved;
    moved.group = "node";
    moved.keyword = "/NODE";
    moved.id = 5;
    moved.field = "position";
    moved.old_value = std::array{1.0, 2.0, 3.0};
    moved.new_value = std::array{3.0, 8.0, 6.0};
    moved.a = gap.a;
    Change added;
    added.kind = ChangeKind::added;
    added.group = "other";
    added.keyword = "/SENSOR/TIME";
    added.id = 7;
    Change removed = added;
    removed.kind = ChangeKind::removed;
    removed.id = 0;
    removed.keyword = "/EOS";
    Change field;
    field.group = "material";
    field.keyword = "/MAT/LAW1";
    field.id = 9;
    field.field = "name";
    field.old_value = std::string("old");
    diff.changes = {gap, nodes, moved, added, removed, field};
    diff.appeared = {{1, "primary", {51, 0}, 0, 0.5, 0, 1.5}};
    diff.worse = {{2, "edges", {52, 53}, 0.25, 0.75, 1.25, 1.75}};
    diff.better = {{3, "primary", {54, 0}, 0.875, 0.125, 2.25, 2.75},
                   {3, "primary", {55, 0}, 0.5, 0.25, 2.25, 2.75}};
    diff.gone = {{4, "primary", {56, 0}, 0.375, 0, 3.25, 0}};
    diff.same_penetrations = 6;
    diff.notes = {"a note"};
  }
  std::vector<DiffTable> tables(std::size_t rows = 0) const {
    return diff_tables(a.side(), b.side(), diff, rows);
  }
  Inspected a{plates()}, b{plates({.height = 0.3})};
  DeckDiff diff;
};

Json place_of(const Inspected& d) {
  const Position at = d.deck.sources.position(d.scene.interfaces->ordered[0]->span);
  return {{"file", "test_0000.rad"}, {"line", at.line}, {"column", at.column}};
}

TEST(DiffDocument, HasEveryFigure) {
  Compared c;
  Verdict verdict;
  verdict.text = "said";
  DiffSide side = c.b.side();
  side.verdict = &verdict;
  const Json all = Json::parse(diff_json(c.a.side(), side, c.diff));
  EXPECT_EQ(all["schema"], Json({{"id", "deck/diff"}, {"version", 1}}));
  EXPECT_EQ(all["a"]["deck"]["path"], "test_0000.rad");
  EXPECT_EQ(all["b"]["deck"]["counts"]["nodes"], 8);
  EXPECT_FALSE(all["a"].contains("verdict"));
  EXPECT_EQ(all["b"]["verdict"]["text"], "said");
  EXPECT_EQ(all["equal"], false);
  EXPECT_EQ(all["text"], diff_verdict(c.diff));
  EXPECT_EQ(all["notes"], Json::array({"a note"}));
  ASSERT_EQ(all["changes"].size(), 6u);
  const Json place = place_of(c.a);
  EXPECT_EQ(
      all["changes"][0],
      Json({{"kind", "changed"},
            {"group", "interface"},
            {"entity", {{"keyword", "/INTER/TYPE7"}, {"id", 1}, {"id_b", 501}, {"title", "front"}}},
            {"field", "Gapmin"},
            {"old", 0.5},
            {"new", 0.75},
            {"effective_old", 0.625},
            {"effective_new", 7},
            {"why", "card"},
            {"a", place},
            {"b", place}}));
  EXPECT_EQ(all["changes"][1],
            Json({{"kind", "changed"},
                  {"group", "group"},
                  {"entity", {{"keyword", "/GRNOD/NODE"}, {"id", 2}, {"title", ""}}},
                  {"field", "nodes"},
                  {"old", 3},
                  {"new", 4},
                  {"gained", {11, 12, 13, 14, 15, 16, 17, 18, 19}},
                  {"lost", {31, 32}},
                  {"altered", Json::array({41})},
                  {"a", nullptr},
                  {"b", nullptr}}));
  EXPECT_EQ(all["changes"][2]["old"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(all["changes"][2]["new"], Json({3.0, 8.0, 6.0}));
  EXPECT_EQ(all["changes"][3]["kind"], "added");
  EXPECT_EQ(all["changes"][3]["field"], Json());
  EXPECT_EQ(all["changes"][4]["entity"],
            Json({{"keyword", "/EOS"}, {"id", nullptr}, {"title", ""}}));
  EXPECT_EQ(all["changes"][5]["old"], "old");
  EXPECT_EQ(all["changes"][5]["new"], Json());
  const auto row = [](int interface, const char* role, Json who, double d0, double d1, double g0,
                      double g1) {
    Json out = {{"interface", interface}, {"role", role},  {"depth_old", d0},
                {"depth_new", d1},        {"gap_old", g0}, {"gap_new", g1}};
    out.update(who);
    return out;
  };
  EXPECT_EQ(
      all["penetrations"],
      Json({{"new", Json::array({row(1, "primary", {{"node", 51}}, 0, 0.5, 0, 1.5)})},
            {"worse", Json::array({row(2, "edges", {{"edge", {52, 53}}}, 0.25, 0.75, 1.25, 1.75)})},
            {"better",
             {row(3, "primary", {{"node", 54}}, 0.875, 0.125, 2.25, 2.75),
              row(3, "primary", {{"node", 55}}, 0.5, 0.25, 2.25, 2.75)}},
            {"gone", Json::array({row(4, "primary", {{"node", 56}}, 0.375, 0, 3.25, 0)})},
            {"same", 6}}));
}

TEST(DiffDocument, HasATablePerKindOfChange) {
  const Compared c;
  const std::vector<DiffTable> all = c.tables();
  const std::string place = c.a.deck.sources.where(c.a.scene.interfaces->ordered[0]->span);
  const std::pair<std::string, Rows> expected[] = {
      {"Effective values",
       {{"/INTER/TYPE7/1 -> 501 front", "Gapmin", "0.5", "0.75", "0.625", "7", "card", place}}},
      {"Members",
       {{"/GRNOD/NODE/2", "nodes", "3", "4", "+9: 11 12 13 14 15 16 17 18 ...", "-2: 31 32",
         "1: 41"}}},
      {"Materials", {{"/MAT/LAW1/9", "name", "old", "-", ""}}},
      {"Other keywords", {{"added", "/SENSOR/TIME/7", ""}, {"removed", "/EOS", ""}}},
      {"Nodes moved", {{"5", "1.0 2.0 3.0", "3.0 8.0 6.0", "7", place}}},  // 2, 6 and 3 apart
      {"New penetrations", {{"1", "51", "-", "0.5", "-", "1.5"}}},
      {"Deeper penetrations", {{"2 edges", "52-53", "0.25", "0.75", "1.25", "1.75"}}},
      {"Shallower penetrations",
       {{"3", "54", "0.875", "0.125", "2.25", "2.75"}, {"3", "55", "0.5", "0.25", "2.25", "2.75"}}},
      {"Penetrations gone", {{"4", "56", "0.375", "-", "3.25", "-"}}}};
  ASSERT_EQ(all.size(), std::size(expected));
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].title, expected[i].first);
    EXPECT_EQ(all[i].rows, expected[i].second) << all[i].title;
    EXPECT_EQ(all[i].left_out, 0u);
    for (const auto& row : all[i].rows) EXPECT_EQ(row.size(), all[i].columns.size());
  }
}

TEST(DiffDocument, CutsLongTables) {
  Compared c;
  c.diff.changes[2].id_b = 505;
  const std::vector<DiffTable> all = c.tables(1);
  std::map<std::string, std::pair<std::size_t, std::size_t>> sizes;
  for (const DiffTable& t : all) sizes[t.title] = {t.rows.size(), t.left_out};
  EXPECT_EQ(sizes["Other keywords"], (std::pair<std::size_t, std::size_t>(1, 1)));
  EXPECT_EQ(sizes["Shallower penetrations"], (std::pair<std::size_t, std::size_t>(1, 1)));
  EXPECT_EQ(sizes["Nodes moved"], (std::pair<std::size_t, std::size_t>(1, 0)));
  DiffTextOptions options;
  options.rows = 1;
  const std::string text = diff_text(c.a.side(), c.b.side(), c.diff, options);
  EXPECT_TRUE(text.starts_with("test_0000.rad -> test_0000.rad\n" + diff_verdict(c.diff) +
                               "\nnote: a note\n"));
  EXPECT_TRUE(text.ends_with("\n\n" + diff_verdict(c.diff) + "\n"));
  EXPECT_THAT(text,
              ContainsRegex("\nOther keywords\n +change +what +place\n +added +/SENSOR/TIME/7\n"
                            "[^\n]*and 1 more \\(--rows N, --json\\)\n"));
  EXPECT_THAT(text, ContainsRegex("\nNodes moved\n.*\n +5 -> 505 +1\\.0 2\\.0 3\\.0"));
  const std::string markdown = diff_markdown(c.a.side(), c.b.side(), c.diff, options);
  EXPECT_THAT(markdown, HasSubstr("\n> a note\n"));
  EXPECT_THAT(markdown,
              HasSubstr("\n#### Other keywords\n\n| change | what | place |\n| --- | --- | "
                        "--- |\n| added | /SENSOR/TIME/7 |  |\n"));
  EXPECT_THAT(markdown, HasSubstr("and 1 more.\n"));
  options.rows = 2;
  EXPECT_THAT(diff_text(c.a.side(), c.b.side(), c.diff, options), Not(HasSubstr("more (--rows")));
}

TEST(DiffDocument, TheSentenceCountsEverything) {
  Compared c;
  EXPECT_EQ(
      diff_verdict(c.diff),
      "Different: 1 keyword added, 1 keyword removed, 1 effective value of a contact changed, 1 "
      "list of members changed, 1 other field changed, 1 node moved, 1 new penetration, 1 "
      "deeper, 2 shallower, 1 penetration gone.");
  const std::vector<Change> again = c.diff.changes;
  c.diff.changes.insert(c.diff.changes.end(), again.begin(), again.end());
  c.diff.gone.clear();
  c.diff.stops_a = true;
  EXPECT_EQ(
      diff_verdict(c.diff),
      "Different: the solver stops at the first deck, 2 keywords added, 2 keywords removed, 2 "
      "effective values of contacts changed, 2 lists of members changed, 2 other fields "
      "changed, 2 nodes moved, 1 new penetration, 1 deeper, 2 shallower.");
  DeckDiff same;
  EXPECT_EQ(diff_verdict(same), "Equal in meaning: no initial penetrations in either.");
  same.same_penetrations = 6;
  EXPECT_EQ(diff_verdict(same), "Equal in meaning, with the same 6 penetrating nodes and edges.");
  const Inspected a(plates());
  EXPECT_EQ(diff_text(a.side(), a.side(), same, {}),
            "test_0000.rad -> test_0000.rad\n" + diff_verdict(same) + "\n");
}

}  // namespace
}  // namespace deck::test
