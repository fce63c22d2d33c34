// Renumbering: the same model under other ids.
#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "contact/meshes.hpp"
#include "deck/edit.hpp"
#include "deck/model.hpp"
#include "edit/support.hpp"

namespace deck {
namespace {

using edit_test::Whole;
using testing::HasSubstr;
using testing::IsEmpty;

Rewrite numbered(const Whole& w, const std::vector<std::string>& texts, bool partial = false) {
  RenumberOptions options;
  options.partial = partial;
  for (const std::string& text : texts) options.rules.push_back(parse_renumber_rule(text).value());
  return renumber(w.context(), options);
}

test::SmallDeck plates() {
  test::SmallDeck d;
  for (int i = 0; i < 4; ++i) d.node(10 * (i + 1), i % 2 * 10.0, i / 2 * 10.0, 0.0);
  for (int i = 0; i < 4; ++i) d.node(50 + i, i % 2 * 9.0, i / 2 * 9.0, 1.0);
  d.shell_part(1, 1.5).shell_part(2, 2.5).shell(1, 7, 10, 20, 40, 30).shell(2, 9, 50, 51, 53, 52);
  return d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2}).group("/SURF/PART/2", {2});
}

TEST(RenumberRuleText, IsKindSignAndNumber) {
  EXPECT_EQ(parse_renumber_rule("node+1000")->value, 1000);
  EXPECT_EQ(parse_renumber_rule("part-5")->value, -5);
  EXPECT_TRUE(parse_renumber_rule("shell=1")->compact);
  for (const char* bad :
       {"", "node", "node+", "node+x", "nodes+1", "node=0", "node+99999999999", "node+1 2", "+5"})
    EXPECT_FALSE(parse_renumber_rule(bad).ok()) << bad;
}

TEST(Renumber, SmoothedSurfaceInThePlaceOfTheNodeGroupFollowsAsASurface) {
  const auto w = Whole::text(test::deck_of_version(
      2026,
      "/SURF/PART/1\ns\n         1\n/SURF/PART/2\ns\n         2\n/GRNOD/PART/2\ng\n"
      "         2\n" +
          test::card("/INTER/TYPE7", 1, 2026,
                     {{"grnd_IDs", "2"}, {"surf_IDm", "1"}, {"Ists", "1"}})));
  const auto after = w->after(numbered(*w, {"surf+100", "grnod+5000"}));
  EXPECT_EQ(after->interfaces.type7.at(0).grnd_IDs.value, 102) << after->main_text();
  EXPECT_EQ(after->interfaces.type7.at(0).surf_IDm.value, 101);
}

TEST(Renumber, SpringGroupOfAnActivationIsNoNodeGroup) {
  const auto w = Whole::text(plates().add("@/ACTIV/1 grspr_ID=52 grshel_ID=52\n").text());
  EXPECT_EQ(w->after(numbered(*w, {"grnod+5"}))->main_text(), [&] {
    std::string text = w->main_text();
    for (std::size_t at = 0; (at = text.find("/GRNOD/PART/2", at)) != std::string::npos; ++at)
      text.replace(at, 13, "/GRNOD/PART/7");
    return text;
  }());
}

TEST(Renumber, SubmodelsWriteIdsBelowTheirOffset) {
  const std::string body =
      "//SUBMODEL/1\ns\n      1000\n/NODE\n         1                 0.0\n/GRNOD/NODE/1\ng\n"
      "         1\n//ENDSUB\n/NODE\n         1                 5.0\n/GRNOD/NODE/1\ng\n         1\n";
  const auto w = Whole::text(test::deck_of_version(2024, body));
  ASSERT_EQ(w->model.nodes.id, (std::vector<std::int64_t>{1, 1001}));
  const auto after = w->after(numbered(*w, {"node+5"}));
  EXPECT_EQ(after->model.nodes.id, (std::vector<std::int64_t>{6, 1006}));
  EXPECT_EQ(after->model.selections->node_group(1001)->nodes.size(), 1u);
  EXPECT_TRUE(after->contains("//SUBMODEL/1\ns\n      1000\n/NODE\n         6"));
  // Compact ids would be smaller than the offset.
  EXPECT_FALSE(numbered(*w, {"node=1"}).refusals.empty());
}

TEST(Renumber, CommasShortLinesAndCarriageReturnsStay) {
  const std::pair<const char*, const char*> texts[] = {
      {"/NODE\n1,12.5,-3.0,4\n2 , 1,1,1\n/GRNOD/NODE/1\ng\n1,2\n",
       "/NODE\n1001,12.5,-3.0,4\n1002 , 1,1,1\n/GRNOD/NODE/1\ng\n1001,1002\n"},
      {"/NODE\r\n1\r\n# 1\r\n         2    \r\n/SUBSET/1\r\nt\r\n\r\n",
       "/NODE\r\n1001\r\n# 1\r\n      1002    \r\n/SUBSET/1\r\nt\r\n\r\n"}};
  for (const auto& [before, now] : texts) {
    const auto w = Whole::text(test::deck_of_version(2024, before));
    EXPECT_EQ(w->after(numbered(*w, {"node+1000"}))->main_text(), test::deck_of_version(2024, now));
  }
}

TEST(Renumber, FileIncludedUnderTwoOffsetsMustAgree) {
  const Whole::Files files{
      {"main_0000.rad",
       test::deck_of_version(2024,
                             "//SUBMODEL/1\ns\n      1000\n#include a.inc\n//ENDSUB\n"
                             "#include a.inc\n")},
      {"a.inc", "/NODE\n         1                 0.0\n"}};
  const auto w = Whole::read("main_0000.rad", files);
  ASSERT_EQ(w->model.nodes.size(), 2u);
  const auto after = w->after(numbered(*w, {"node+5"}));
  EXPECT_EQ(after->model.nodes.id, (std::vector<std::int64_t>{1006, 6}));
  EXPECT_FALSE(numbered(*w, {"node=1001"}).refusals.empty());
}

/// The reasons of what stays as it is.
std::vector<std::string> open_reasons(const Whole& w, const std::vector<std::string>& rules) {
  std::vector<std::string> out;
  for (const LossEntry& e : numbered(w, rules, true).losses)
    if (e.loss == Loss::undecided) out.push_back(e.field + ": " + e.note);
  return out;
}

TEST(Renumber, OneIdThatCannotChangeKeepsTheOthersOfItsLine) {
  // 3 is nobody's and would become a node: its line stays, the next one follows.
  const auto w = Whole::text(
      plates().add("/GRNOD/NODE/4\ng\n         3        50\n        51        52").text());
  const Rewrite r = numbered(*w, {"node=1"}, true);
  const auto after = w->after(r);
  EXPECT_TRUE(after->contains("g\n         3        50\n         6         7\n"))
      << after->main_text();
}

TEST(Renumber, FreeFormatMayNotGrowBeyondItsColumns) {
  // 98 columns: two more digits fit, a third does not.
  std::string ids;
  while (ids.size() + 3 <= 98) ids += ids.empty() ? "50" : ",50";
  ids += std::string(98 - ids.size(), ' ');
  ids.back() = ',';
  const auto w = Whole::text(plates().add("/GRNOD/NODE/4\ng\n" + ids).text());
  EXPECT_THAT(open_reasons(*w, {"node+100"}), testing::Each(HasSubstr("longer than 100 columns")));
  EXPECT_THAT(open_reasons(*w, {"node+5"}), IsEmpty());
}

TEST(Renumber, ElementsOfSeveralLines) {
  test::SmallDeck d;
  for (int i = 0; i < 20; ++i) d.node(i + 1, i % 3 * 1.0, i / 3 % 3 * 1.0, i / 9 * 1.0);
  const std::string lines =
      "       100         1         2         3         4         5         6         7         8\n"
      "         9        10        11        12        13        14        15        16\n"
      "        17        18        19        20\n";
  const auto w = Whole::text(d.add("/BRIC20/1\n" + lines).text());
  const auto after = w->after(numbered(*w, {"node+500", "solid+1000"}));
  const std::string text = after->main_text();
  const auto at = text.find("/BRIC20/1\n");
  ASSERT_NE(at, std::string::npos);
  EXPECT_THAT(text.substr(at), HasSubstr("      1100       501       502")) << text;
}

/// Two sheets of shells, solids and beams between them, with ids at random, in five contacts.
std::string random_contacts(std::mt19937& random) {
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  test::SmallDeck d;
  constexpr int side = 4;
  std::vector<int> node_id;
  for (int i = 0; i < 2 * side * side; ++i)
    node_id.push_back((node_id.empty() ? 1 : node_id.back()) + 1 + pick(7));
  std::shuffle(node_id.begin(), node_id.end(), random);
  for (int i = 0; i < 2 * side * side; ++i)
    d.node(node_id[static_cast<std::size_t>(i)], i % side * 10.0 + 0.01 * pick(99),
           i / side % side * 10.0, i / (side * side) * 1.0);
  d.shell_part(3, 1.5).shell_part(5, 2.5).solid_part(8).beam_part(9, 2);
  int id = 10;
  const auto n = [&](int i) { return node_id[static_cast<std::size_t>(i)]; };
  for (int k = 0; k < 2; ++k)
    for (int y = 0; y + 1 < side; ++y)
      for (int x = 0; x + 1 < side; ++x) {
        const int i = x + side * y + side * side * k;
        id += 1 + pick(3);
        d.shell(k == 0 ? 3 : 5, id, n(i), n(i + 1), n(i + 1 + side), n(i + side));
        if (k == 0 && pick(3) == 0)
          d.brick(
              8, id,
              {n(i), n(i + 1), n(i + 1 + side), n(i + side), n(i + side * side),
               n(i + 1 + side * side), n(i + 1 + side + side * side), n(i + side + side * side)});
        if (pick(4) == 0) d.bar("BEAM", 9, id, n(i), n(i + 1), n(i + side));
      }
  d.group("/SURF/PART/4", {3}).group("/SURF/PART/EXT/6", {3, 8}).group("/GRNOD/PART/4", {5, 9});
  d.group("/GRNOD/GENE/7", {n(1), n(1) + 40}).group("/LINE/EDGE/2", {4}).group("/LINE/SURF/3", {6});
  d.add(fmt::sprintf("/SET/GENERAL/44\nset\nPART               5\nNODE_D    %10d\n", n(20)));
  d.add("@/INTER/TYPE7/11 grnd_IDs=4 surf_IDm=6 Igap=" + std::to_string(pick(4)) + " Inacti=5");
  d.add("@/INTER/TYPE7/12 grnd_IDs=7 surf_IDm=4 Igap=1 Inacti=6");
  d.add("@/INTER/TYPE7/13 grnd_IDs=44 surf_IDm=4 Igap=1");
  d.add("@/INTER/TYPE11/14 line_IDs=2 line_IDm=3 Igap=1");
  d.add("@/INTER/TYPE19/15 surf_IDs=4 surf_IDm=44 Igap=1");
  return d.text();
}

/// The scene of a random model is the same modulo the map of ids.
TEST(Renumber, SceneIsTheSameModuloTheMap) {
  std::mt19937 random(23);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 40; ++round) {
    const auto w = Whole::text(random_contacts(random));
    const std::vector<std::vector<std::string>> choices{
        {"all+1000"},
        {"node=1", "element=1", "part+3", "inter=1"},
        {"node+" + std::to_string(pick(500)), "shell=77", "solid+5", "group+9", "part=1"},
        {"all=5"}};
    const auto& chosen = choices[static_cast<std::size_t>(round) % choices.size()];
    const Rewrite r = numbered(*w, chosen);
    if (!r.refusals.empty()) {
      // Sets and groups compacted into the same numbers hide one another.
      ASSERT_EQ(chosen[0], "all=5") << r.refusals[0];
      continue;
    }
    EXPECT_EQ(edit_test::changed_figure(*w, *w->after(r), "--renumber"), "");
    if (::testing::Test::HasFailure()) FAIL() << "round " << round << " " << chosen[0];
  }
}

}  // namespace
}  // namespace deck
