// Decisions about which exact arithmetic and that of the solver differ, from figures that are
// written out here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "contact/small_deck.hpp"
#include "report/accuracy_decisions.hpp"

namespace deck::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// A node over a triangle and an edge over an edge, with one difference each.
struct Decided {
  Decided() : b(deck()) {
    DecisionReport& r = b.scene.decisions;
    r.mode = Accuracy::robust;
    r.pairs = 4000;
    r.fallback = 50;
    r.exact = 7;
    r.contact_differs = 2;
    r.surface_differs = 3;
    DecisionDifference node, edge;
    node.contact = position(1);
    node.surface = true;
    node.exact = true;
    node.gap = 1.5;
    node.solver_distance = 0.25;
    node.exact_distance = 0.125;
    node.action = PenetrationAction::gap_reduced;
    edge.contact = position(2);
    edge.exact = false;
    edge.gap = 2.5;
    edge.solver_distance = std::numeric_limits<double>::quiet_NaN();
    edge.exact_distance = 2.75;
    r.differences = {node, edge};
  }
  static SmallDeck deck() {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 0, 10, 0).node(9, 2, 3, 0.5);
    d.node(11, 5, -5, 0.5).node(12, 5, 5, 0.5).shell_part(1, 2).shell3(1, 1, 1, 2, 3);
    d.truss_part(2, 1).bar("TRUSS", 2, 2, 11, 12).group("/SURF/PART/1", {1});
    d.group("/GRNOD/NODE/2", {9}).segments("/LINE/SEG/3", {{11, 12}});
    d.segments("/LINE/SEG/4", {{1, 2}});
    return d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1.5")
        .add("@/INTER/TYPE11/2 line_IDs=3 line_IDm=4 Gapmin=2.5");
  }
  std::uint32_t position(std::int64_t id) const {
    std::uint32_t i = 0;
    while (b.scene.contacts.at(i).inter->id != id) ++i;
    return i;
  }
  Json json() const {
    std::string text;
    JsonWriter j(text);
    j.begin_object();
    write_decisions(j, b.scene);
    j.end_object();
    return Json::parse(text)["accuracy"];
  }
  std::string text(std::size_t rows = 10, bool always = false) const {
    return decisions_text(b.scene, rows, always, false, 0);
  }
  Built b;
};

TEST(Decisions, OfJsonHaveEveryDifference) {
  EXPECT_EQ(Decided().json(), Json({{"mode", "robust"},
                                    {"pairs", 4000},
                                    {"fallback", 50},
                                    {"exact", 7},
                                    {"decisions_differing", 2},
                                    {"surface_differing", 3},
                                    {"differences", Json::array({{{"interface", 1},
                                                                  {"role", "primary"},
                                                                  {"node", 9},
                                                                  {"segment", Json({1, 2, 3, 3})},
                                                                  {"about", "on_surface"},
                                                                  {"exact", true},
                                                                  {"solver", false},
                                                                  {"gap", 1.5},
                                                                  {"solver_distance", 0.25},
                                                                  {"exact_distance", 0.125},
                                                                  {"action", "gap-reduced"}},
                                                                 {{"interface", 2},
                                                                  {"role", "primary"},
                                                                  {"edge", Json({11, 12})},
                                                                  {"main_edge", Json({1, 2})},
                                                                  {"about", "contact"},
                                                                  {"exact", false},
                                                                  {"solver", true},
                                                                  {"gap", 2.5},
                                                                  {"solver_distance", nullptr},
                                                                  {"exact_distance", 2.75},
                                                                  {"action", "none"}}})}}));
}

TEST(Decisions, OfPlainDoubleKnowNoDifferences) {
  Decided d;
  for (const Accuracy mode : {Accuracy::fast, Accuracy::reference}) {
    d.b.scene.decisions.mode = mode;
    EXPECT_EQ(d.json()["decisions_differing"], Json());
    EXPECT_EQ(d.json()["surface_differing"], Json());
    EXPECT_EQ(d.text(),
              std::string("Decisions (") + to_string(mode) + "): 4000 pairs in plain double.\n");
  }
  d.b.scene.decisions.mode = Accuracy::exact;
  EXPECT_EQ(d.json()["surface_differing"], 3);
}

TEST(Decisions, OfTextCountAndListTheDifferences) {
  // 50 of 4000 pairs are 1.25 %, shown with two digits.
  const std::string text = Decided().text();
  EXPECT_THAT(text, HasSubstr("Decisions (robust): 4000 pairs, 50 (1.2 %) needed more than double, "
                              "7 exact arithmetic. The solver's arithmetic decides 5 otherwise: 2 "
                              "about contact, 3 about nodes exactly on a segment.\n"));
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    lines.push_back(text.substr(at, text.find('\n', at) - at));
  ASSERT_EQ(lines.size(), 5u) << text;
  EXPECT_THAT(lines[2], ::testing::MatchesRegex(
                            " *1  9 +1 2 3 +lies on it +1\\.5 +0\\.125 +0\\.25 +gap-reduced"));
  EXPECT_THAT(lines[3], ::testing::MatchesRegex(
                            " *2  11-12 +1 2 +not in contact +2\\.5 +2\\.75 +no number +none"));
  EXPECT_THAT(lines[4], HasSubstr("and 3 more (--json)"));
  EXPECT_THAT(Decided().text(1), HasSubstr("and 4 more (--json)"));
  EXPECT_THAT(Decided().text(1), Not(HasSubstr("no number")));
  EXPECT_THAT(Decided().text(0), Not(HasSubstr("more (--json)")));
}

TEST(Decisions, NameBothAnswersOfBothQuestions) {
  Decided d;
  auto& all = d.b.scene.decisions.differences;
  all[0].exact = false;
  all[1].exact = true;
  EXPECT_THAT(d.text(), HasSubstr("does not lie on it"));
  EXPECT_THAT(d.text(), HasSubstr("  in contact"));
  all.resize(2);
  d.b.scene.decisions.surface_differs = 0;
  EXPECT_THAT(d.text(), Not(HasSubstr("more (--json)"))) << "all two are shown";
}

TEST(Decisions, AreTextOnlyWhereTheyChangeAContactOrAreAskedFor) {
  Decided d;
  DecisionReport& r = d.b.scene.decisions;
  r.contact_differs = 0;
  EXPECT_EQ(d.text(), "");
  EXPECT_THAT(d.text(10, true), HasSubstr("decides 3 otherwise: 0 about contact, 3 about"));
  r.surface_differs = 0;
  EXPECT_EQ(d.text(10, true),
            "Decisions (robust): 4000 pairs, 50 (1.2 %) needed more than double, 7 exact "
            "arithmetic. The solver's arithmetic decides all of them alike.\n");
  r.contact_differs = 1;
  r.pairs = 0;
  EXPECT_EQ(d.text(10, true), "") << "there is no pair to speak of";
}

}  // namespace
}  // namespace deck::test
