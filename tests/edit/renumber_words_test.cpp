// Renumbering in words: what is refused and why, what is noted, and how many ids changed where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../contact/small_deck.hpp"
#include "deck/edit/convert.hpp"
#include "edit/units_support.hpp"

namespace deck {
namespace {

using edit_test::Whole;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Rewrite numbered(const Whole& w, const std::vector<std::string>& texts, bool partial = false) {
  RenumberOptions options;
  options.partial = partial;
  for (const std::string& text : texts) options.rules.push_back(parse_renumber_rule(text).value());
  return renumber(w.context(), options);
}
Rewrite renamed(const Whole& w, const char* kind, std::int64_t id, std::int64_t now) {
  RenumberOptions options;
  options.rules = {{kind, false, now, id}};
  return renumber(w.context(), options);
}

/// Nodes 10, 20, 30, 40 with shell 7 of part 1, nodes 50 to 53 with shell 9 of part 2.
test::SmallDeck plates() {
  test::SmallDeck d;
  for (int i = 0; i < 4; ++i) d.node(10 * (i + 1), i % 2 * 10.0, i / 2 * 10.0, 0.0);
  for (int i = 0; i < 4; ++i) d.node(50 + i, i % 2 * 9.0, i / 2 * 9.0, 1.0);
  return d.shell_part(1, 1.5)
      .shell_part(2, 2.5)
      .shell(1, 7, 10, 20, 40, 30)
      .shell(2, 9, 50, 51, 53, 52);
}

std::string reason(std::string_view rule) {
  const auto r = parse_renumber_rule(rule);
  return r ? "none" : r.error().message;
}

TEST(RenumberRuleWords, SayWhatIsWrong) {
  const std::string rest = "; expected for example node+1000, part-50 or shell=1";
  EXPECT_EQ(reason("node"), "'node': no +, - or =" + rest);
  EXPECT_EQ(reason("nodes+1"), "'nodes+1': unknown kind" + rest);
  EXPECT_EQ(reason("+5"), "'+5': unknown kind" + rest);
  for (const std::string bad : {"node+", "node+x", "node+1 2", "node+1x", "node+-1", "node=-1",
                                "node+2147483648", "node+99999999999999999999"}) {
    SCOPED_TRACE(bad);
    EXPECT_EQ(reason(bad), "'" + bad + "': no id behind the sign" + rest);
  }
  EXPECT_EQ(reason("node=0"), "'node=0': the first id must be 1 or more" + rest);
  EXPECT_EQ(reason(std::string(70, 'x')), "'" + std::string(60, 'x') + "': no +, - or =" + rest);
}

TEST(RenumberRuleWords, AreReadAsTheyStand) {
  const auto spaced = parse_renumber_rule(" node + 1000 ");
  ASSERT_TRUE(spaced.ok());
  EXPECT_EQ(spaced->kind, "node");
  EXPECT_EQ(spaced->value, 1000);
  EXPECT_FALSE(spaced->compact);
  EXPECT_EQ(spaced->only, 0);
  EXPECT_EQ(parse_renumber_rule("part-2147483647")->value, -2147483647);
  EXPECT_EQ(parse_renumber_rule("mat+0")->value, 0);
  EXPECT_EQ(parse_renumber_rule("shell=1")->value, 1);
  EXPECT_TRUE(parse_renumber_rule("shell=1")->compact);
}

TEST(RenumberRuleWords, KnowEveryKind) {
  for (const std::string kind :
       {"shell",  "sh3n",   "solid",   "quad",     "tria",     "truss",  "beam",   "spring",
        "grnod",  "grshel", "grsh3n",  "grtria",   "grbric",   "grquad", "grtrus", "grbeam",
        "grspri", "grpart", "surf",    "line",     "set",      "node",   "part",   "prop",
        "mat",    "subset", "box",     "funct",    "sensor",   "skew",   "frame",  "inter",
        "all",    "group",  "element", "friction", "transform"})
    EXPECT_EQ(reason(kind + "+1"), "none") << kind;
  for (const std::string kind : {"brick", "tetra4", "elements", "al", "", "NODE"})
    EXPECT_THAT(reason(kind + "+1"), HasSubstr("unknown kind")) << kind;
}

TEST(RenumberRefusals, OfOneIdSayWhichAndWhy) {
  const auto w = Whole::text(plates().text());
  EXPECT_THAT(renamed(*w, "node", 11, 12).refusals, ElementsAre("renumber: there is no node 11"));
  EXPECT_THAT(renamed(*w, "node", 10, 20).refusals,
              ElementsAre("renumber: node 10 would become 20, which exists"));
  EXPECT_THAT(renamed(*w, "node", 10, 0).refusals,
              ElementsAre("renumber: node 10 would become 0, which is no legal id"));
  EXPECT_THAT(renamed(*w, "node", 10, 2147483648).refusals,
              ElementsAre("renumber: node 10 would become 2147483648, which is no legal id"));
  EXPECT_THAT(renamed(*w, "wheel", 10, 12).refusals, ElementsAre("renumber: unknown kind 'wheel'"));
  EXPECT_TRUE(renamed(*w, "node", 11, 12).bad_request);
  const Rewrite good = renamed(*w, "node", 10, 1);
  EXPECT_FALSE(good.bad_request);
  EXPECT_THAT(good.refusals, IsEmpty());
  EXPECT_THAT(good.notes, ElementsAre("node: 1 id, 10 becomes 1"));
}

TEST(RenumberRefusals, OfAllIdsSayWhatTheyWouldReach) {
  const auto w = Whole::text(plates().text());
  EXPECT_THAT(numbered(*w, {"node+2147483647"}).refusals,
              ElementsAre("renumber: node ids would reach 2147483700; the largest possible one is "
                          "2147483647"));
  EXPECT_THAT(numbered(*w, {"node=2147483641"}).refusals,
              ElementsAre("renumber: node ids would reach 2147483648; the largest possible one is "
                          "2147483647"));
  EXPECT_THAT(numbered(*w, {"node=2147483640"}).refusals, IsEmpty());
  EXPECT_THAT(numbered(*w, {"node+2147483594"}).refusals, IsEmpty());
  EXPECT_THAT(numbered(*w, {"node-10"}).refusals,
              ElementsAre("renumber: node id 10 would become 0"));
  EXPECT_THAT(numbered(*w, {"element+1", "shell+2"}).refusals,
              ElementsAre("renumber: two rules for shell"));
  EXPECT_THAT(numbered(*w, {"group+1", "line=2"}).refusals,
              ElementsAre("renumber: two rules for line"));
}

TEST(RenumberNotes, NameEveryKindThatChanges) {
  const auto w = Whole::text(plates().group("/GRNOD/PART/2", {2}).text());
  EXPECT_THAT(numbered(*w, {"node+5", "shell=1", "part-0"}).notes,
              ElementsAre("node: 8 ids, 10 becomes 15", "shell: 2 ids, 7 becomes 1"));
  // Materials and properties have the numbers of their parts here: nothing to change.
  EXPECT_THAT(numbered(*w, {"all=1"}).notes,
              ElementsAre("grnod: 1 ids, 2 becomes 1", "node: 8 ids, 10 becomes 1",
                          "shell: 2 ids, 7 becomes 1"));
  EXPECT_THAT(numbered(*w, {"all+3"}).notes,
              ElementsAre("grnod: 1 ids, 2 becomes 5", "mat: 1 ids, 1 becomes 4",
                          "node: 8 ids, 10 becomes 13", "part: 2 ids, 1 becomes 4",
                          "prop: 2 ids, 1 becomes 4", "shell: 2 ids, 7 becomes 10"));
}

TEST(RenumberNotes, CountTheIdsOfEveryBlock) {
  const auto w = Whole::text(plates().group("/GRNOD/NODE/3", {50, 51}).text());
  std::vector<std::string> shells;
  for (const LossEntry& e : numbered(*w, {"node+5", "shell+1"}).losses) {
    EXPECT_EQ(e.loss, Loss::kept);
    shells.push_back(e.keyword + ": " + e.note);
  }
  EXPECT_THAT(shells, testing::Contains("/GRNOD/NODE: 2 ids changed"));
  EXPECT_THAT(shells, testing::Contains("/SHELL: 5 ids changed").Times(2));
  EXPECT_THAT(numbered(*w, {"grnod+1"}).losses, testing::SizeIs(1));
  EXPECT_EQ(numbered(*w, {"grnod+1"}).losses.at(0).note, "1 id changed");
}

/// The reasons of what stays as it is.
std::vector<std::string> open_reasons(const Whole& w, const std::vector<std::string>& rules) {
  std::vector<std::string> out;
  for (const LossEntry& e : numbered(w, rules, true).losses)
    if (e.loss == Loss::undecided) out.push_back(e.field + ": " + e.note);
  return out;
}

TEST(RenumberOpen, ReasonsOfCellsAndHeaders) {
  const auto made = Whole::text(
      plates()
          .add("/PARAMETER/GLOBAL/INTEGER/1\np\nn                 50\n/GRNOD/NODE/4\ng\n        &n")
          .text());
  EXPECT_THAT(open_reasons(*made, {"node+1000"}),
              ElementsAre(HasSubstr("the id is made by a parameter")));
  const auto dangling = Whole::text(plates().group("/GRNOD/NODE/4", {3, 50}).text());
  EXPECT_THAT(open_reasons(*dangling, {"node=1"}),
              ElementsAre(HasSubstr("3 is not defined, and another node would get that id")));
  const auto bare = Whole::text(plates().add("/INTER/TYPE7\ni\n         0         0").text());
  EXPECT_THAT(open_reasons(*bare, {"inter+5"}),
              ElementsAre("id: the header has no id; it counts as 1"));
}

TEST(RenumberOpen, RangesSayWhyTheyCannotStay) {
  const auto range = [](const char* keyword, const std::vector<int>& ids) {
    return Whole::text(plates().group(keyword, ids).text());
  };
  EXPECT_THAT(open_reasons(*range("/GRNOD/GENE/4", {11, 19}), {"node=1"}),
              ElementsAre(HasSubstr("the range holds no id and has no new place")));
  EXPECT_THAT(open_reasons(*range("/GRNOD/GEN_INCR/4", {10, 40, 20}), {"node=1"}),
              ElementsAre(HasSubstr("a range with an increment does not stay one")));
  EXPECT_THAT(open_reasons(*range("/GRNOD/GENE/4", {5, 30}), {"node-5"}),
              ElementsAre(HasSubstr("the new range is not legal")));
  EXPECT_THAT(open_reasons(*range("/GRNOD/GENE/4", {5, 30}), {"node-4"}), IsEmpty());
  EXPECT_THAT(open_reasons(*range("/GRNOD/GENE/4", {10, 2147483640}), {"node+8"}),
              ElementsAre(HasSubstr("the new range is not legal")));
}

TEST(RenumberRanges, WithAnIncrementOneIdStaysInOrOut) {
  // 10, 30 are of the range, 20 and 40 are not.
  const auto w = Whole::text(plates().group("/GRNOD/GEN_INCR/4", {10, 40, 20}).text());
  EXPECT_THAT(renamed(*w, "node", 20, 25).refusals, IsEmpty());
  EXPECT_EQ(renamed(*w, "node", 20, 25).edits.size(), 2u);  // node and shell
  EXPECT_THAT(renamed(*w, "node", 30, 35).refusals,
              ElementsAre(HasSubstr("the range does not stay the same with the new id")));
  // The first one would move the whole range.
  EXPECT_THAT(renamed(*w, "node", 10, 12).refusals, testing::SizeIs(1));
}

TEST(RenumberRanges, TheFirstIdMovesTheBegin) {
  const auto w = Whole::text(plates().group("/GRNOD/GENE/4", {10, 30}).text());
  const auto after = w->after(renamed(*w, "node", 10, 5));
  EXPECT_TRUE(after->contains("/GRNOD/GENE/4\ng\n         5        30")) << after->main_text();
}

TEST(RenumberLines, OneIdThatCannotChangeKeepsTheOthersOfItsLine) {
  // 3 is nobody's and would become a node: its line stays, the next one follows.
  const auto w = Whole::text(
      plates().add("/GRNOD/NODE/4\ng\n         3        50\n        51        52").text());
  const Rewrite r = numbered(*w, {"node=1"}, true);
  const auto after = w->after(r);
  EXPECT_TRUE(after->contains("g\n         3        50\n         6         7\n"))
      << after->main_text();
}

TEST(RenumberLines, FreeFormatMayNotGrowBeyondItsColumns) {
  // 98 columns: two more digits fit, a third does not.
  std::string ids;
  while (ids.size() + 3 <= 98) ids += ids.empty() ? "50" : ",50";
  ids += std::string(98 - ids.size(), ' ');
  ids.back() = ',';
  const auto w = Whole::text(plates().add("/GRNOD/NODE/4\ng\n" + ids).text());
  EXPECT_THAT(open_reasons(*w, {"node+100"}), testing::Each(HasSubstr("longer than 100 columns")));
  EXPECT_THAT(open_reasons(*w, {"node+5"}), IsEmpty());
}

TEST(RenumberUndescribed, ANumberMayBeAnyKindThatChanges) {
  const auto w = Whole::text(plates().add("/NEWTHING/2\n        51        -9").text());
  EXPECT_THAT(
      open_reasons(*w, {"node+1000"}),
      ElementsAre(": the keyword is not described (completely), and 51 may be the node that "
                  "gets another id"));
  // Its sign does not matter.
  EXPECT_THAT(open_reasons(*w, {"shell+1000"}),
              ElementsAre(": the keyword is not described (completely), and -9 may be the shell "
                          "that gets another id"));
  EXPECT_THAT(open_reasons(*w, {"part+1000"}), ElementsAre(HasSubstr("and 2 may be the part")));
  EXPECT_THAT(open_reasons(*w, {"grnod+1000"}), IsEmpty());
  // Ids that stay are no reason: only node 10 changes, or none does.
  EXPECT_THAT(renamed(*w, "node", 10, 11).refusals, IsEmpty());
  EXPECT_THAT(renamed(*w, "node", 51, 60).refusals, testing::SizeIs(1));
}

TEST(RenumberUndescribed, SomeKeywordsNameNoIds) {
  for (const char* keyword : {"/ANALY", "/DEF_SHELL", "/DEF_SOLID", "/IOFLAG", "/SPMD", "/RANDOM",
                              "/AMS", "/CAA", "/UPWIND"}) {
    const auto w = Whole::text(plates().add(std::string(keyword) + "\n        50").text());
    EXPECT_THAT(numbered(*w, {"node+1000", "part+7"}).refusals, IsEmpty()) << keyword;
  }
}

TEST(RenumberItems, ShellsFollowTheirNodesAndTheirOwnIds) {
  const auto w = Whole::text(plates().text());
  const auto after = w->after(numbered(*w, {"shell+2", "node+1"}));
  EXPECT_TRUE(after->contains("         9        11        21        41        31"))
      << after->main_text();
  EXPECT_TRUE(after->contains("        11        51        52        54        53"));
  EXPECT_EQ(after->model.nodes.id, (std::vector<std::int64_t>{11, 21, 31, 41, 51, 52, 53, 54}));
}

TEST(RenumberItems, ElementsOfTwoLinesAndBlankLinesBetween) {
  test::SmallDeck d;
  for (int i = 0; i < 20; ++i) d.node(i + 1, i % 3 * 1.0, i / 3 % 3 * 1.0, i / 9 * 1.0);
  const std::string lines =
      "       100         1         2         3         4         5         6         7         8\n"
      "         9        10        11        12        13        14        15        16        17  "
      "      18        19        20\n";
  const auto w = Whole::text(d.add("/BRIC20/1\n" + lines).text());
  const auto after = w->after(numbered(*w, {"node+500", "solid+1000"}));
  const std::string text = after->main_text();
  const auto at = text.find("/BRIC20/1\n");
  ASSERT_NE(at, std::string::npos);
  EXPECT_THAT(text.substr(at), HasSubstr("      1100       501       502")) << text;
}

}  // namespace
}  // namespace deck
