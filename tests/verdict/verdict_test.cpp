// The verdict of a deck: its level, its sentences, its counts, and the exit code that follows.
#include "deck/verdict.hpp"

#include "deck/text.hpp"
#include "report/inspected.hpp"
#include "verdict/shared/of_interface.hpp"

namespace deck::test {
namespace {

/// A plate of one element, and three free nodes over it, of which `apart` are further away.
std::string tie(const std::string& card, double height = 0.4, double far = 0.4) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 3, 3, height).node(12, 6, 3, height).node(13, 3, 6, far);
  d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {11, 12, 13});
  return d.add("@/INTER/" + card).text();
}

Verdict of(const std::string& text) {
  const Inspected d(text);
  d.loaded.findings();
  return verdict_of(d.deck, d.scene, d.view);
}

std::string text_of(const Verdict& v, std::string_view what) {
  for (const VerdictSentence& s : v.sentences)
    if (s.what == what) return s.text;
  return {};
}

TEST(Verdict, TiePairsAreTiedContactPairsPenetrate) {
  const struct {
    std::string text;
    VerdictLevel level;
    std::size_t pairs, tied, untied;
    const char *what, *sentence;
  } cases[] = {{plates(), VerdictLevel::penetrates, 4, 0, 0, "ties", ""},
               // ITIED acts in the Engine, where a time step gets too small.
               {tie("TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1 ITIED=1 dtmin=1.e-9"),
                VerdictLevel::penetrates, 3, 0, 0, "ties", ""},
               {tie("TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=1"), VerdictLevel::clean, 0, 3, 0, "ties",
                "3 pairs tied (3 nodes)."},
               {tie("TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=1", 0.4, 1.5), VerdictLevel::untied, 0, 2,
                1, "untied", "1 of 3 nodes of TYPE10 1 is not tied."},
               {tie("TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=1", 1.5, 1.5), VerdictLevel::untied, 0, 0,
                3, "untied", "TYPE10 1 ties none of its 3 nodes."}};
  for (const auto& c : cases) {
    const Verdict v = of(c.text);
    EXPECT_EQ(v.level, c.level) << v.text;
    EXPECT_EQ(v.count("pairs"), c.pairs) << v.text;
    EXPECT_EQ(v.count("tied_pairs"), c.tied) << v.text;
    EXPECT_EQ(v.count("untied_nodes"), c.untied) << v.text;
    EXPECT_EQ(text_of(v, c.what), c.sentence);
  }
}

// Behind faces of solids there is a depth, and no gap that it could be a share of.
TEST(Verdict, ADepthWithoutAGapIsNoShareOfOne) {
  SmallDeck d;
  const double x[4] = {0, 10, 10, 0}, y[4] = {0, 0, 10, 10};
  for (int i = 0; i < 4; ++i) d.node(1 + i, x[i], y[i], 0).node(5 + i, x[i], y[i], 10);
  d.node(101, 5, 5, 9.5).solid_part(1).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  d.group("/SURF/PART/EXT/1", {1}).group("/GRNOD/NODE/2", {101});
  const Verdict v = of(d.add("@/INTER/TYPE25/1 surf_ID2=1 grnd_IDs=2 Inacti=5").text());
  EXPECT_EQ(v.text, "1 initial penetration on 1 node, deepest 0.5 mm.");
}

TEST(Verdict, NothingFoundIsClean) {
  Plates p;
  p.card = "Gapmin=0.1";
  const Verdict v = of(plates(p));
  EXPECT_EQ(v.level, VerdictLevel::clean) << v.text;
  EXPECT_EQ(v.text, "No initial penetration in 1 contact.");
}

TEST(Verdict, ANodeOnASegmentStopsTheSolverTiedOrNot) {
  for (const char* card :
       {"TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=1", "TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1"}) {
    const Verdict v = of(tie(card, 0.4, 0));
    EXPECT_EQ(v.level, VerdictLevel::stops) << v.text;
    EXPECT_EQ(v.count("solver_errors"), 1u);
    EXPECT_EQ(exit_code_of(v), 1);
  }
}

TEST(Verdict, WhatAGateFindsIsNoErrorOfTheDeck) {
  Inspected d(plates());
  for (const RuleId rule : gate_rules) {
    Finding finding;
    finding.rule = rule;
    finding.severity = Severity::error;
    d.loaded.report(finding);
  }
  EXPECT_EQ(d.loaded.findings().counts().size(), std::size(gate_rules));
  EXPECT_EQ(verdict_of(d.deck, d.scene, d.view).count("errors"), 0u);
}

TEST(Verdict, AnErrorOfTheDeckStopsTheSolver) {
  const Verdict v = of(plates() + "");
  EXPECT_NE(v.level, VerdictLevel::stops);
  Plates p;
  p.card = "Gapmin=0.5 Stfac=l.0";
  const Verdict bad = of(plates(p));
  EXPECT_EQ(bad.level, VerdictLevel::stops) << bad.text;
  EXPECT_TRUE(bad.stops_before_pairs);
}

TEST(Verdict, AnInterfaceThatIsNotExaminedIsSaid) {
  Plates p;
  p.card = "Gapmin=0.1\n/INTER/TYPE23/9\nother\n         1         2";
  const Verdict v = of(plates(p));
  EXPECT_EQ(v.level, VerdictLevel::not_examined) << v.text;
  EXPECT_EQ(v.count("interfaces_not_examined"), 1u);
  EXPECT_EQ(exit_code_of(v), 0);
  EXPECT_EQ(exit_code_of(v, {.require_examined = true}), 1);
}

TEST(Verdict, AnInterfaceHasTheLevelOfTheDeckWithItAlone) {
  Plates p;
  p.card = "Gapmin=0.1";
  for (const std::string& text :
       {plates(), plates(p), tie("TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=1", 0.4, 1.5),
        tie("TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1", 0.4, 0),
        tie("TYPE7/1 grnd_IDs=9 surf_IDm=1 Gapmin=1\n/GRNOD/NODE/9\nempty\n")}) {
    const Inspected d(text);
    ASSERT_EQ(d.interfaces.ordered.size(), 1u) << text;
    const InterfaceVerdict own = verdict_of_interface(d.scene, d.view, *d.interfaces.ordered[0]);
    const Verdict all = of(text);
    EXPECT_EQ(own.level, all.count("errors") > 0 ? VerdictLevel::not_examined : all.level)
        << all.text;
    EXPECT_EQ(own.max_depth, d.view.total.max_depth);
    EXPECT_EQ(own.max_ratio, d.view.total.max_ratio);
  }
}

TEST(Verdict, AnInterfaceIsNotBlamedForAnother) {
  const std::string text = tie("TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1\n" +
                               std::string("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Gapmin=0.1"));
  const Inspected d(text);
  ASSERT_EQ(d.interfaces.ordered.size(), 2u);
  const auto level = [&](std::size_t i) {
    return verdict_of_interface(d.scene, d.view, *d.interfaces.ordered[i]).level;
  };
  EXPECT_EQ(level(0), VerdictLevel::penetrates);
  EXPECT_EQ(level(1), VerdictLevel::clean);
}

TEST(Verdict, ATieHasTheLevelOfItsNodes) {
  for (const auto& [card, far, level] :
       {std::tuple("TYPE2/1 grnd_IDs=2 surf_IDm=1 dsearch=1", 0.4, VerdictLevel::clean),
        std::tuple("TYPE2/1 grnd_IDs=2 surf_IDm=1 dsearch=1 Ignore=1", 9., VerdictLevel::untied),
        std::tuple("TYPE2/1 grnd_IDs=2 surf_IDm=1 dsearch=1", 9., VerdictLevel::stops)}) {
    const Inspected d(tie(card, 0.4, far));
    ASSERT_EQ(d.loaded.ties().size(), 1u);
    EXPECT_EQ(level_of_tie(d.loaded.ties()[0]), level) << card;
  }
}

}  // namespace
}  // namespace deck::test
