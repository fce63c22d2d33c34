// The strategy tie: dsearch grows to what the untied nodes need, and no farther; what holds a node
// elsewhere is respected. And no other strategy takes a TYPE2 apart.
#include "contact/tied_sheet.hpp"
#include "edit/fix/harm.hpp"
#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SceneOptions with_ties() {
  SceneOptions options;
  options.ties = true;
  return options;
}

PenetrationFix tied(const Built& b, std::optional<double> reach = {}) {
  TieOptions options;
  options.reach = reach;
  auto fix = tie_nodes(context_of(b), options);
  EXPECT_TRUE(fix.ok()) << (fix.ok() ? "" : fix.error().message);
  return std::move(*fix);
}

/// Ids of the nodes that a tie holds.
std::vector<std::int64_t> tied_ids(const Built& b, std::int64_t id = 1) {
  std::vector<std::int64_t> out;
  for (const Tie& tie : b.scene.ties)
    if (tie.inter->id == id)
      for (const TiedNode& n : tie.nodes)
        if (n.tied) out.push_back(b.model.node_id(n.node));
  return out;
}

std::vector<std::int64_t> tied_after(const Built& b, const PenetrationFix& fix,
                                     std::int64_t id = 1) {
  return tied_ids(Built(text_after(b, fix), with_ties()), id);
}

std::string reason_of(const PenetrationFix& fix, std::int64_t node) {
  for (const FixRefusal& r : fix.refused)
    if (r.nodes == std::vector<std::int64_t>{node}) return r.reason;
  return {};
}

double new_dsearch(const PenetrationFix& fix) {
  if (fix.ties.empty() || fix.ties[0].changes.empty()) return 0;
  EXPECT_EQ(fix.ties[0].changes[0].field, "dsearch");
  return fix.ties[0].changes[0].new_value;
}

TEST(TieFix, RaisesDsearchToWhatTheNodesNeedAndRoundsItUp) {
  const Built b(sheet({{5, 5, 1}, {15, 15, 3.21}, {25, 25, 3}}).add(tie_card({.dsearch = 2})));
  const PenetrationFix fix = tied(b);
  EXPECT_TRUE(fix.complete);
  ASSERT_EQ(fix.ties.size(), 1u);
  EXPECT_EQ(fix.ties[0].before.lost(), 2u);
  EXPECT_EQ(fix.ties[0].after.lost(), 0u);
  EXPECT_DOUBLE_EQ(fix.ties[0].needed, 3.21);
  EXPECT_EQ(new_dsearch(fix), 3.3);
  ASSERT_EQ(fix.ties[0].nodes.size(), 2u);
  EXPECT_EQ(fix.ties[0].nodes[0].node, 102);
  EXPECT_THAT(tied_after(b, fix), ElementsAre(101, 102, 103));
  EXPECT_TRUE(tied(Built(text_after(b, fix))).rewrite.edits.empty()) << "nothing is left to do";
}

TEST(TieFix, RoundsUpAndKeepsTheDigitsOfSmallLengths) {
  for (const auto& [height, dsearch, now] :
       {std::tuple{3.0, 2.0, 3.1}, {0.00321, 0.002, 0.0033}, {3.0, 0.0, 3.1}}) {
    // Ignore 3 without dsearch: 0.6 times the thickness of 2, so 1.2.
    const Built b(sheet({{5, 5, height}})
                      .add(tie_card({.ignore = dsearch == 0 ? 3 : 1, .dsearch = dsearch})));
    const PenetrationFix fix = tied(b);
    EXPECT_DOUBLE_EQ(new_dsearch(fix), now);
    EXPECT_THAT(tied_after(b, fix), ElementsAre(101));
  }
}

/// The tie is in metres, the deck in millimetres: so are the cell and the figures.
TEST(TieFix, TheCellIsWrittenInTheUnitsOfItsBlock) {
  TieCard in_metres{.dsearch = 0.002};
  std::string card = tie_card(in_metres);
  card.insert(card.find('\n'), "/3");
  const Built b(sheet({{5, 5, 3.21}})
                    .add("/UNIT/3\nm\n                  kg                   m                   s")
                    .add(card));
  const PenetrationFix fix = tied(b);
  ASSERT_EQ(fix.ties.size(), 1u);
  EXPECT_DOUBLE_EQ(fix.ties[0].needed, 3.21);
  EXPECT_DOUBLE_EQ(fix.ties[0].changes.at(0).old_value, 2);
  EXPECT_DOUBLE_EQ(new_dsearch(fix), 3.3);
  EXPECT_EQ(fix.rewrite.edits.size(), 1u);
  EXPECT_THAT(text_after(b, fix), HasSubstr("              0.0033\n"));
  EXPECT_THAT(tied_after(b, fix), ElementsAre(101));
}

TEST(TieFix, NodesOutOfReachStayAndAreNamed) {
  const Built b(sheet({{5, 5, 3}, {15, 15, 8}, {15, 15, 30}}).add(tie_card({.dsearch = 2})));
  const PenetrationFix near = tied(b, 5.0);
  EXPECT_FALSE(near.complete);
  EXPECT_THAT(tied_after(b, near), ElementsAre(101));
  EXPECT_THAT(reason_of(near, 102), HasSubstr("farther away than 5 (--reach)"));
  EXPECT_THAT(reason_of(near, 103), HasSubstr("--reach"));
  // By itself as far as the mean side, 10.
  EXPECT_THAT(tied_after(b, tied(b)), ElementsAre(101, 102));
}

TEST(TieFix, AKeptNodeFartherAwayDecidesToo) {
  // By pair the thick shell holds 102 at 2.3 away, and the thin ones lose 101 at 1.5.
  SmallDeck d = sheet({{5, 5, 1.5}, {105, 5, 2.3}});
  for (int k = 0; k < 4; ++k) d.node(201 + k, 100 + 10.0 * (k % 2), 10.0 * (k / 2), 0);
  d.shell_part(2, 6).shell(2, 100, 201, 202, 204, 203).group("/SURF/PART/5", {1, 2});
  const Built b(d.add(tie_card({.surf = 5, .ignore = 3})), with_ties());
  ASSERT_THAT(tied_ids(b), ElementsAre(102));
  const PenetrationFix fix = tied(b);
  EXPECT_DOUBLE_EQ(fix.ties.at(0).needed, 1.5);
  EXPECT_EQ(new_dsearch(fix), 2.4);
  EXPECT_THAT(tied_after(b, fix), ElementsAre(101, 102));
}

TEST(TieFix, NodesBeyondTheRimAreNotHelped) {
  const Built b(sheet({{5, 5, 3}, {38, 15, 1}}).add(tie_card({.dsearch = 2})));
  const PenetrationFix fix = tied(b);
  EXPECT_THAT(tied_after(b, fix), ElementsAre(101));
  EXPECT_THAT(reason_of(fix, 102), HasSubstr("beyond the rim"));
  // Penalty ties with Ignore 1000 drop such a node again.
  const Built drop(sheet({{5, 5, 3}, {38, 15, 1}})
                       .add(tie_card({.ignore = 1000, .spotflag = 25, .dsearch = 2})));
  const PenetrationFix of_drop = tied(drop);
  EXPECT_THAT(tied_after(drop, of_drop), ElementsAre(101));
  EXPECT_THAT(reason_of(of_drop, 102), HasSubstr("beyond the rim"));
}

TEST(TieFix, WhatHoldsANodeElsewhereIsNotTied) {
  // 102, which a rigid body has, is nearer than 103.
  SmallDeck d = sheet({{5, 5, 3}, {15, 15, 4}, {25, 25, 5}, {40, 40, 40}});
  d.group("/GRNOD/NODE/8", {102}).add(tie_card({.dsearch = 2}));
  d.add("/RBODY/7\nbody\n       104                                                           8");
  const Built b(d);
  const PenetrationFix fix = tied(b, 6.0);
  EXPECT_THAT(tied_after(b, fix), ElementsAre(101));
  EXPECT_EQ(reason_of(fix, 102), "/RBODY/7 holds it");
  EXPECT_THAT(reason_of(fix, 103), HasSubstr("would also tie node 102, 4 from its segment"));
  EXPECT_THAT(reason_of(fix, 104), HasSubstr("--reach"));
}

TEST(TieFix, ASecondTieOfTheNodeIsIntention) {
  // Group 9 lies between two sheets, and each of two ties takes its own half of it.
  SmallDeck d = sheet({{5, 5, 1}, {15, 15, 4}});
  for (int k = 0; k < 4; ++k) d.node(201 + k, 30.0 * (k % 2), 30.0 * (k / 2), 5);
  d.shell_part(2, 2).shell(2, 100, 201, 202, 204, 203).group("/SURF/PART/2", {2});
  d.add(tie_card({.id = 1, .surf = 1, .dsearch = 2}));
  d.add(tie_card({.id = 2, .surf = 2, .dsearch = 2}));
  const PenetrationFix fix = tied(Built(d));
  EXPECT_TRUE(fix.rewrite.edits.empty());
  EXPECT_EQ(reason_of(fix, 102), "interface 2 ties it already");
  EXPECT_EQ(reason_of(fix, 101), "interface 1 ties it already");
}

TEST(TieFix, OneOfTwoTiesTakesANodeThatBothLose) {
  const Built b(sheet({{5, 5, 3}})
                    .add(tie_card({.id = 1, .dsearch = 2}))
                    .add(tie_card({.id = 2, .dsearch = 1})));
  const PenetrationFix fix = tied(b);
  EXPECT_THAT(tied_after(b, fix, 1), ElementsAre(101));
  EXPECT_THAT(tied_after(b, fix, 2), IsEmpty());
  EXPECT_EQ(reason_of(fix, 101), "interface 1 ties it already");
}

TEST(TieFix, BoundaryConditionsHoldAKinematicTieOnly) {
  for (const int spotflag : {5, 25, 27}) {
    SmallDeck d = sheet({{5, 5, 3}});
    d.add(tie_card({.spotflag = spotflag, .dsearch = 2}));
    d.add("/BCS/4\nfixed\n   111 000         0         9");
    const Built b(d);
    const PenetrationFix fix = tied(b);
    EXPECT_EQ(tied_after(b, fix).size(), spotflag == 5 ? 0u : 1u) << spotflag;
    if (spotflag == 5) {
      EXPECT_EQ(reason_of(fix, 101), "/BCS/4 holds it");
    }
  }
}

TEST(TieFix, NeverMakesTheSolverStop) {
  // Node 101 is a corner of a segment that interface 2 uses; 102 would be tied to a segment whose
  // corner 1 interface 3 holds.
  SmallDeck d = sheet({{15, 15, 3}, {5, 5, 3}});
  d.node(301, 20, 15, 3).node(302, 20, 20, 3).node(303, 15, 20, 3).node(304, 17, 17, 3.5);
  for (int k = 0; k < 4; ++k) d.node(401 + k, 4.0 * (k % 2) - 2, 4.0 * (k / 2) - 2, 1);
  d.shell_part(2, 1).shell(2, 100, 101, 301, 302, 303).group("/SURF/PART/2", {2});
  d.shell_part(3, 1).shell(3, 101, 401, 402, 404, 403).group("/SURF/PART/3", {3});
  d.group("/GRNOD/NODE/7", {304}).group("/GRNOD/NODE/6", {1});
  d.add(tie_card({.id = 1, .grnd = 9, .surf = 1, .dsearch = 2}));
  d.add(tie_card({.id = 2, .grnd = 7, .surf = 2, .dsearch = 2}));
  d.add(tie_card({.id = 3, .grnd = 6, .surf = 3, .dsearch = 2}));
  const Built b(d, with_ties());
  ASSERT_THAT(tied_ids(b, 2), ElementsAre(304));
  ASSERT_THAT(tied_ids(b, 3), ElementsAre(1));
  const PenetrationFix fix = tied(b);
  EXPECT_TRUE(fix.rewrite.edits.empty());
  EXPECT_THAT(reason_of(fix, 101), HasSubstr("by interface 2: the solver would stop (556)"));
  EXPECT_THAT(reason_of(fix, 102), HasSubstr("node 1 of its segment is tied by interface 3"));
}

TEST(TieFix, SaysWhatItDoesNotHandle) {
  const auto reason = [](const TieCard& card) {
    const PenetrationFix fix = tied(Built(sheet({{5, 5, 3}}).add(tie_card(card))));
    EXPECT_TRUE(fix.rewrite.edits.empty());
    EXPECT_FALSE(fix.complete);
    return fix.refused.empty() ? std::string() : fix.refused[0].reason;
  };
  EXPECT_THAT(reason({.ignore = 5, .dsearch = 2}), HasSubstr("Ignore 5"));
  EXPECT_THAT(reason({.dsearch = 2, .isearch = 3}), HasSubstr("not evaluated"));
}

TEST(TieFix, ALineWithCommasThatEndsBeforeDsearchIsRefused) {
  const std::string head = "/INTER/TYPE2/1\ntie\n";
  const Built ends(sheet({{5, 5, 30}}).add(head + "9,1,1,5,0,2"));
  EXPECT_THAT(tied(ends, 40.0).refused.at(0).reason, HasSubstr("ends before dsearch"));
  const Built wide(sheet({{5, 5, 30}}).add(head + "9,1,1,5,0,2,0" + std::string(100, ' ')));
  EXPECT_THAT(tied(wide, 40.0).refused.at(0).reason, HasSubstr("ends before dsearch"));
  const Built full(sheet({{5, 5, 30}}).add(head + "9,1,1,5,0,2,0,," + std::string(84, ' ') + "2"));
  EXPECT_TRUE(tied(full, 40.0).rewrite.edits.empty()) << "31 would end past column 100";
  const Built has(sheet({{5, 5, 30}}).add(head + "9,1,1,5,0,2,0,,2.0"));
  const PenetrationFix fix = tied(has, 40.0);
  EXPECT_EQ(new_dsearch(fix), 31);
  EXPECT_THAT(tied_after(has, fix), ElementsAre(101));
}

/// Random nodes over the sheet: the deck after the fix ties what a plain look at all segments says.
TEST(TieFix, TiesExactlyWhatWasSaid) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-2, 32), height(-6, 6);
  for (int round = 0; round < 30; ++round) {
    std::vector<P> nodes;
    for (int k = 0; k < 40; ++k) nodes.push_back({place(random), place(random), height(random)});
    const int spotflag = std::array{5, 25, 27, 28}[static_cast<std::size_t>(round % 4)];
    const int ignore = std::array{1, 2, 3, 1000}[static_cast<std::size_t>(round / 4 % 4)];
    const double dsearch = round % 3 == 0 ? 0 : 1.0;
    if (ignore == 1000 && dsearch == 0) continue;  // finds all within 10
    const Built b(
        sheet(nodes).add(tie_card({.ignore = ignore, .spotflag = spotflag, .dsearch = dsearch})),
        with_ties());
    const PenetrationFix fix = tied(b, 3.0);
    const Built after(text_after(b, fix), with_ties());
    const std::vector<std::int64_t> was = tied_ids(b), is = tied_ids(after);
    std::set<std::int64_t> expected(was.begin(), was.end());
    for (const FixedTie& tie : fix.ties)
      for (const NewlyTied& n : tie.nodes) {
        EXPECT_LT(n.distance, 3.0);
        EXPECT_TRUE(expected.insert(n.node).second);
      }
    EXPECT_EQ(std::set<std::int64_t>(is.begin(), is.end()), expected);
    // Every node is tied now, or named with a reason.
    for (const TiedNode& n : after.scene.ties[0].nodes) {
      if (n.lost()) {
        EXPECT_FALSE(reason_of(fix, after.model.node_id(n.node)).empty());
      }
    }
    // Nodes straight over the sheet within reach are tied.
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const P& p = nodes[k];
      if (p[0] > 0 && p[0] < 30 && p[1] > 0 && p[1] < 30 && std::abs(p[2]) < 2.999) {
        EXPECT_TRUE(expected.contains(101 + static_cast<std::int64_t>(k))) << k;
      }
    }
  }
}

// ---- other strategies -------------------------------------------------------------------------

TEST(TieHarm, AType2MayNotComeOffNorTakeAnotherSegment) {
  const auto harm = [](const P& before, const P& after) {
    const std::string card = tie_card({.dsearch = 2});
    const Built a(sheet({before}).add(card), with_ties()), b(sheet({after}).add(card), with_ties());
    return detail::StateBefore(a.scene, {}).harm(b.scene);
  };
  EXPECT_TRUE(harm({5, 5, 1}, {6, 5, 1.5}).empty()) << "the same segment";
  ASSERT_EQ(harm({5, 5, 1}, {5, 5, 3}).size(), 1u);
  EXPECT_TRUE(harm({5, 5, 1}, {5, 5, 3})[0].tie);
  EXPECT_EQ(harm({5, 5, 3}, {5, 5, 1}).size(), 1u) << "tied, and was not";
  EXPECT_EQ(harm({9, 5, 1}, {11, 5, 1}).size(), 2u) << "another segment";
}

}  // namespace
}  // namespace deck::test
