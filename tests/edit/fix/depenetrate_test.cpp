// Tests of moving nodes out of gaps. Over 600 lines: independent tests of one strategy.
#include "edit/shared/depenetrate.hpp"

#include <functional>

#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

MoveNodesOptions all_may_move() {
  MoveNodesOptions o;
  o.most_moved = 1;
  return o;
}

PenetrationFix moved(const Built& b, const MoveNodesOptions& options = all_may_move()) {
  auto fix = move_nodes(context_of(b), options);
  EXPECT_TRUE(fix.ok()) << fix.error().message;
  expect_within_depth(b, *fix, options.clearance);
  return std::move(*fix);
}

/// All penetrations go, nothing new comes, and a second run has nothing to do.
void expect_solved(const SmallDeck& d, bool ties = false) {
  const Built before(d);
  ASSERT_FALSE(oracle_penetrations(before).empty()) << "the scene shows nothing";
  ASSERT_TRUE(oracle_crossings(before).empty());
  MoveNodesOptions o = all_may_move();
  o.ties = ties;
  const PenetrationFix fix = moved(before, o);
  const auto after = expect_harmless(before, fix, ties);
  EXPECT_EQ(oracle_penetrations(*after).size(), 0U);
  EXPECT_EQ(oracle_crossings(*after).size(), 0U);
  EXPECT_TRUE(fix.complete);
  EXPECT_TRUE(fix.refused.empty());
  const PenetrationFix second = moved(*after, o);
  EXPECT_TRUE(second.rewrite.edits.empty());
  EXPECT_TRUE(second.complete);
}

const char* const node_cards[] = {
    "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0",
    "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=1",
    "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=2 Fscalegap=1.2 Gapmax=0.9",
    "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=3 Gapmin=0.7",
    "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0 Inacti=3",
};
const char* const edge_cards[] = {
    "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1.0",
    "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Igap=1",
    "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0",
    "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Igap=1 Gapmin=0.5",
};

TEST(MoveNodes, SeparatesRandomPlatesForNodeContacts) {
  for (const char* card : node_cards)
    for (unsigned seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      expect_solved(two_plates(seed, 0.35 + 0.1 * seed, card));
    }
}

TEST(MoveNodes, TiesComeApartOnlyWhereThatIsAskedFor) {
  const char* card = "@/INTER/TYPE10/1 grnd_IDs=1 surf_IDm=1 Gap=1.0";
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SmallDeck d = two_plates(seed, 0.35 + 0.1 * seed, card);
    expect_solved(d, true);
    const Built before(d);
    const PenetrationFix fix = moved(before);
    EXPECT_TRUE(fix.rewrite.edits.empty());
    EXPECT_TRUE(fix.complete) << "a tie is no penetration";
    EXPECT_TRUE(fix.interfaces.empty());
    EXPECT_EQ(fix.tied_pairs, oracle_penetrations(before).size());
  }
}

TEST(MoveNodes, WhatIsTiedStaysTiedWhereOtherContactsAreTreated) {
  // The same plates tied with a gap of 0.75 and in contact with one of 0.9: moving the nodes out
  // of the contact would take them off their ties.
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Built before(two_plates(seed, 0.6,
                                  "@/INTER/TYPE10/1 grnd_IDs=1 surf_IDm=1 Gap=0.75\n"
                                  "@/INTER/TYPE7/2 grnd_IDs=1 surf_IDm=1 Gapmin=0.9"));
    const PenetrationFix fix = moved(before);
    expect_harmless(before, fix);
    EXPECT_FALSE(fix.complete);
    bool said = false;
    for (const FixRefusal& r : fix.refused)
      said |= r.reason.find("would change what is tied") != std::string::npos;
    EXPECT_TRUE(said);
  }
}

TEST(MoveNodes, SeparatesRandomPlatesForEdgeContacts) {
  for (const char* card : edge_cards)
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      expect_solved(two_plates(seed, 0.35 + 0.1 * seed, card));
    }
}

TEST(MoveNodes, OpensFoldedShellsInSelfContact) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.7",
                           "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=1 Gapmin=1.65"})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      expect_solved(hairpin(seed, card));
    }
}

TEST(MoveNodes, FreesACornerThatTouchesSeveralSegments) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0",
                           "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0"})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      expect_solved(box_corner(seed, card));
    }
}

TEST(MoveNodes, SeparatesSolids) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=0.8",
                           "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=0.8"})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      expect_solved(two_blocks(seed, 0.2 + 0.1 * seed, card));
    }
}

TEST(MoveNodes, SeparatesRods) {
  for (const char* card : {"@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=0.9",
                           "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Igap=1"})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      expect_solved(two_grids_of_rods(seed, card));
    }
}

TEST(MoveNodes, SpreadsAStackOfSheets) {
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0",
                           "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=1 Igap=1"})
    for (unsigned seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
      expect_solved(stack_of_sheets(seed, 3, card));
      // Of five the outer ones would have to move farther than they are deep.
      const Built tall(stack_of_sheets(seed, 5, card));
      const PenetrationFix fix = moved(tall);
      expect_harmless(tall, fix);
      EXPECT_FALSE(fix.complete);
    }
}

TEST(MoveNodes, SolvesTwoInterfacesThatShareNodes) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    expect_solved(two_plates(seed, 0.5,
                             "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=0.9\n"
                             "@/INTER/TYPE11/2 line_IDs=1 line_IDm=2 Gapmin=1.1"));
}

TEST(MoveNodes, TakesNodesAtDistanceZeroToTheSideOfTheirNeighbours) {
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  add_sheet(d, 1, 1, 3, 3, [](int i, int j) { return P{2.0 * i, 2.0 * j, 0}; });
  // A roof whose ridge lies on the plate.
  add_sheet(d, 2, 101, 2, 2, [](int i, int j) {
    return P{1.5 + 1.4 * i, 1.3 + 1.4 * j, i == 1 ? 0.0 : 1.6};
  });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0");
  const Built before(d);
  const PenetrationFix fix = moved(before);
  const auto after = expect_harmless(before, fix);
  EXPECT_TRUE(oracle_penetrations(*after).empty());
  for (const MovedNode& m : fix.moved) EXPECT_GT(m.part == 2 ? m.by[2] : -m.by[2], 0) << m.id;
}

TEST(MoveNodes, CoincidentPlatesComeApartAsAWhole) {
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  add_sheet(d, 1, 1, 3, 3, [](int i, int j) { return P{2.0 * i, 2.0 * j, 0}; });
  add_sheet(d, 2, 101, 3, 3, [](int i, int j) { return P{2.0 * i + 0.4, 2.0 * j + 0.3, 0}; });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0");
  const Built before(d);
  const auto after = expect_harmless(before, moved(before));
  EXPECT_TRUE(oracle_penetrations(*after).empty());
  EXPECT_TRUE(oracle_crossings(*after).empty());
}

TEST(MoveNodes, NodesOnNodesComeApart) {
  // Every upper node is where a lower one is, and every edge where one is.
  for (const char* card : {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0",
                           "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1.0"}) {
    SCOPED_TRACE(card);
    SmallDeck d;
    d.shell_part(1, 1.0).shell_part(2, 1.0);
    for (const int first : {1, 101})
      add_sheet(d, first / 100 + 1, first, 3, 3, [](int i, int j) {
        return P{2.0 * i, 2.0 * j, 0.1 * i};
      });
    d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
    d.group("/LINE/SURF/1", {1}).group("/LINE/SURF/2", {2});
    const Built before(d.add(card));
    const PenetrationFix fix = moved(before);
    const auto after = expect_harmless(before, fix);
    EXPECT_EQ(fix.complete, oracle_penetrations(*after).empty());
    for (const FixRefusal& r : fix.refused) EXPECT_FALSE(r.reason.empty());
  }
}

TEST(MoveNodes, WhatLiesAtOnePlaceIsRefusedWithoutATry) {
  SmallDeck d;
  d.shell_part(1, 1.0);
  for (int n = 1; n <= 40; ++n) d.node(n, 50, 0.1, -7);
  for (int e = 0; e < 10; ++e) d.shell(1, 1 + e, 4 * e + 1, 4 * e + 2, 4 * e + 3, 4 * e + 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/1", {1});
  const Built before(d.add(node_cards[0]));
  const PenetrationFix fix = moved(before);
  EXPECT_TRUE(fix.rewrite.edits.empty());
  EXPECT_FALSE(fix.complete);
  EXPECT_EQ(fix.iterations, 0);
  ASSERT_EQ(fix.refused.size(), 40U);
  for (const FixRefusal& r : fix.refused)
    EXPECT_THAT(r.reason, ::testing::HasSubstr("at one place"));
}

// ---- what holds nodes -------------------------------------------------------------------------

const char* const plain = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0";

TEST(MoveNodes, NodesOfLockedPartsStay) {
  const Built before(two_plates(1, 0.6, plain));
  MoveNodesOptions o = all_may_move();
  o.lock = {1};
  const PenetrationFix fix = moved(before, o);
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
  ASSERT_FALSE(fix.moved.empty());
  for (const MovedNode& m : fix.moved) EXPECT_EQ(m.part, 2);
}

TEST(MoveNodes, OnlyNodesOfChosenPartsMove) {
  const Built before(two_plates(2, 0.6, plain));
  MoveNodesOptions o = all_may_move();
  o.move = {1};
  o.clearance = 0.01;  // rough plates: along the first normal not all of the way is gained
  const PenetrationFix fix = moved(before, o);
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
  for (const MovedNode& m : fix.moved) EXPECT_EQ(m.part, 1);
}

TEST(MoveNodes, MainSidesStayIfOnlySecondaryNodesMayMove) {
  const Built before(two_plates(3, 0.6, plain));
  MoveNodesOptions o = all_may_move();
  o.secondary_only = true;
  o.clearance = 0.01;
  const PenetrationFix fix = moved(before, o);
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
  for (const MovedNode& m : fix.moved) EXPECT_EQ(m.part, 2);
}

TEST(MoveNodes, EverythingLockedLeavesTheDeckAloneAndSaysWhy) {
  const Built before(two_plates(1, 0.6, plain));
  MoveNodesOptions o = all_may_move();
  o.lock = {1, 2};
  const PenetrationFix fix = moved(before, o);
  EXPECT_TRUE(fix.rewrite.edits.empty());
  EXPECT_FALSE(fix.complete);
  ASSERT_FALSE(fix.refused.empty());
  for (const FixRefusal& r : fix.refused)
    EXPECT_THAT(r.reason, ::testing::HasSubstr("locked part"));
}

/// A plate of one shell at `height` over the middle of a large segment at 0, gap 1.
SmallDeck one_over_one(double height, const std::string& cards = "") {
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  add_sheet(d, 1, 1, 2, 2, [](int i, int j) { return P{4.0 * i, 4.0 * j, 0}; });
  add_sheet(d, 2, 101, 1, 1, [&](int i, int j) {
    return P{1.25 + 1.5 * i, 1.375 + 1.25 * j, height};
  });
  if (!cards.empty()) d.add(cards);
  return d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1}).add(plain);
}

TEST(MoveNodes, ANodeInsideASolidIsNotPushedThroughItsFace) {
  for (const double z : {9.5, 10.5}) {
    SmallDeck d;
    d.solid_part(1);
    for (int k = 0; k < 8; ++k)
      d.node(k + 1, k % 4 == 1 || k % 4 == 2 ? 10 : 0, k % 4 >= 2 ? 10 : 0, k < 4 ? 0 : 10);
    d.brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8}).node(100, 5.5, 4.25, z);
    d.group("/GRNOD/NODE/1", {100}).group("/SURF/PART/EXT/1", {1}).add(plain);
    const Built before(d);
    MoveNodesOptions o = all_may_move();
    o.secondary_only = true;
    const PenetrationFix fix = moved(before, o);
    EXPECT_EQ(fix.complete, z > 10);
    if (z > 10) {
      ASSERT_EQ(fix.moved.size(), 1u);
      EXPECT_NEAR(fix.moved[0].by[2], 0.5, 0.001);
    } else {
      ASSERT_EQ(fix.refused.size(), 1u);
      EXPECT_EQ(fix.refused[0].reason,
                "the node is inside a solid: the way out is not the way to its surface; separate "
                "the parts first");
    }
  }
}

TEST(MoveNodes, CardsWithParametersLockAndWithCommasAreRefused) {
  for (const char* line : {"1,1,1,1,1,1,0,9", "   111 111         0    &group"}) {
    const Built before(
        one_over_one(0.6, std::string("/PARAMETER/GLOBAL/INTEGER/1\np\ngroup              9\n"
                                      "/GRNOD/NODE/9\nheld\n       101\n/BCS/1\nfixed\n") +
                              line));
    MoveNodesOptions o = all_may_move();
    o.lock_boundary_conditions = true;
    const auto fix = move_nodes(context_of(before), o);
    EXPECT_EQ(fix.ok(), line[0] == ' ');
    if (!fix)
      EXPECT_THAT(fix.error().message, ::testing::HasSubstr(": commas are not understood here"));
    else
      for (const MovedNode& m : fix->moved) EXPECT_NE(m.id, 101);
  }
}

TEST(MoveNodes, AnUnknownPartIsAnError) {
  const Built before(two_plates(1, 0.6, plain));
  MoveNodesOptions o;
  o.lock = {77};
  const auto fix = move_nodes(context_of(before), o);
  ASSERT_FALSE(fix.ok());
  EXPECT_EQ(fix.error().message, "the deck has no part 77");
}

TEST(MoveNodes, NoMoreNodesOfAPartMoveThanAllowed) {
  for (const double share : {0.05, 0.2, 0.5}) {
    const Built before(two_plates(1, 0.6, plain));
    MoveNodesOptions o;
    o.most_moved = share;
    const PenetrationFix fix = moved(before, o);
    expect_harmless(before, fix);
    std::map<std::int64_t, int> count;
    for (const MovedNode& m : fix.moved) ++count[m.part];
    EXPECT_LE(count[1], std::max(1.0, std::floor(share * 49)));
    EXPECT_LE(count[2], std::max(1.0, std::floor(share * 30)));
    EXPECT_EQ(fix.complete, fix.refused.empty());
  }
}

TEST(MoveNodes, APartThatItsShareStopsIsLeftAloneAndSaysWhatItNeeds) {
  const Built before(two_plates(1, 0.6, plain));
  const PenetrationFix fix = moved(before, MoveNodesOptions{});
  EXPECT_TRUE(fix.rewrite.edits.empty()) << "a few moved nodes would be a dent";
  EXPECT_TRUE(fix.moved.empty());
  ASSERT_FALSE(fix.refused.empty());
  for (const FixRefusal& r : fix.refused)
    EXPECT_THAT(r.reason,
                ::testing::MatchesRegex(
                    "secondary: stopped by --max-moved 10 %: needs [0-9.]+ % of part 2 "
                    "\\([0-9]+ of 30 nodes\\); nothing done; main: stopped by --max-moved 10 %: "
                    "needs [0-9.]+ % of part 1 \\([0-9]+ of 49 nodes\\); nothing done"));
}

TEST(MoveNodes, TheOtherPartGivesWayWhereOneIsStopped) {
  // One node of a large plate is in the gap of a small one, and that one's share is used up.
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  add_sheet(d, 1, 1, 1, 1, [](int i, int j) { return P{3.1 + 2.0 * i, 3.2 + 2.0 * j, 0}; });
  add_sheet(d, 2, 101, 4, 4, [](int i, int j) {
    return P{2.0 * i, 2.0 * j, i == 2 && j == 2 ? 0.8 : 1.5};
  });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1}).add(plain);
  const Built before(d);
  const PenetrationFix fix = moved(before, MoveNodesOptions{});
  const auto after = expect_harmless(before, fix);
  EXPECT_TRUE(oracle_penetrations(*after).empty());
  ASSERT_EQ(fix.moved.size(), 1u);
  EXPECT_EQ(fix.moved[0].id, 113);
  EXPECT_NEAR(fix.moved[0].distance, 0.2, 0.0011);
  EXPECT_EQ(fix.moved[0].by[0], 0);
  EXPECT_EQ(fix.moved[0].by[1], 0);
}

TEST(MoveNodes, NodesOfASheetBetweenTwoToolsDoNotMoveInItsPlane) {
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0).shell_part(3, 1.0);
  add_sheet(d, 1, 1, 2, 2, [](int i, int j) { return P{-1 + 4.0 * i, -1 + 4.0 * j, -0.95}; });
  add_sheet(d, 2, 101, 6, 6, [](int i, int j) { return P{1.0 * i, 1.0 * j, 0}; });
  add_sheet(d, 3, 301, 2, 2, [](int i, int j) { return P{-1 + 4.0 * i, -1 + 4.0 * j, 0.95}; });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1, 3}).add(plain);
  const Built before(d);
  for (const double share : {0.1, 0.5, 1.0}) {
    MoveNodesOptions o;
    o.most_moved = share;
    const PenetrationFix fix = moved(before, o);
    expect_harmless(before, fix);
    EXPECT_EQ(fix.complete, share == 1.0);
    for (const MovedNode& m : fix.moved) {
      EXPECT_EQ(m.by[0], 0) << m.id;
      EXPECT_EQ(m.by[1], 0) << m.id;
      EXPECT_LE(m.distance, 0.05 + 0.0011) << m.id;
    }
  }
}

TEST(MoveNodes, NoNodeMovesFartherThanAllowed) {
  const Built before(two_plates(1, 0.5, plain));
  MoveNodesOptions o = all_may_move();
  o.most_displacement = 0.1;
  const PenetrationFix fix = moved(before, o);
  expect_harmless(before, fix);
  EXPECT_FALSE(fix.complete);
  for (const MovedNode& m : fix.moved) EXPECT_LE(m.distance, 0.1 * (1 + 1e-6));
  bool said = false;
  for (const FixRefusal& r : fix.refused)
    said |= r.reason.find("--max-displacement") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(MoveNodes, NodesOfRigidBodiesAndBoundaryConditionsStayOnRequest) {
  const std::string cards =
      "/GRNOD/NODE/8\nrigid\n      1001      1002      1003\n"
      "/GRNOD/NODE/9\nfixed\n      1004      1005      1006\n"
      "/RBODY/1\nbody\n      1007         0         0         0                 0.0         8\n"
      "/BCS/1\nfixed\n   111 111         0         9\n";
  const Built before(two_plates(1, 0.6, cards + plain));
  MoveNodesOptions o = all_may_move();
  o.lock_rigid_bodies = o.lock_boundary_conditions = true;
  const PenetrationFix fix = moved(before, o);
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
  for (const MovedNode& m : fix.moved) EXPECT_TRUE(m.id < 1001 || m.id > 1007) << m.id;
  bool free_moves = false;
  for (const MovedNode& m : moved(before).moved) free_moves |= m.id >= 1001 && m.id <= 1007;
  EXPECT_TRUE(free_moves);
}

TEST(MoveNodes, OnlyTheInterfacesAskedForAreTreated) {
  const Built before(two_plates(1, 0.6,
                                "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=0.7\n"
                                "@/INTER/TYPE7/2 grnd_IDs=1 surf_IDm=1 Gapmin=1.2"));
  MoveNodesOptions o = all_may_move();
  o.interfaces = {1};
  const auto after = expect_harmless(before, moved(before, o));
  for (const auto& [pair, depth] : oracle_penetrations(*after)) EXPECT_EQ(std::get<0>(pair), 2);
}

// ---- what cannot be solved --------------------------------------------------------------------

TEST(MoveNodes, NeighboursInAMeshTooFineForTheGapAreRefused) {
  SmallDeck d;
  d.shell_part(1, 1.0);
  add_sheet(d, 1, 1, 4, 4, [](int i, int j) { return P{1.0 * i, 1.0 * j, 0}; });
  d.group("/GRNOD/PART/1", {1}).group("/SURF/PART/1", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.5");
  const Built before(d);
  const PenetrationFix fix = moved(before);
  EXPECT_TRUE(fix.rewrite.edits.empty());
  ASSERT_FALSE(fix.refused.empty());
  for (const FixRefusal& r : fix.refused) EXPECT_THAT(r.reason, ::testing::HasSubstr("one mesh"));
}

TEST(MoveNodes, CrossedElementsAreNotTornApart) {
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  add_sheet(d, 1, 1, 3, 3, [](int i, int j) { return P{2.0 * i, 2.0 * j, 0}; });
  add_sheet(d, 2, 101, 2, 3, [](int i, int j) { return P{2.9, 0.7 + 1.4 * j, -0.7 + 1.1 * i}; });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0");
  const Built before(d);
  const auto crossings = oracle_crossings(before);
  ASSERT_FALSE(crossings.empty());
  const PenetrationFix fix = moved(before);
  EXPECT_EQ(oracle_crossings(*expect_harmless(before, fix)), crossings);
  EXPECT_FALSE(fix.complete);
  bool said = false;
  for (const FixRefusal& r : fix.refused)
    said |= r.reason.find("crossed elements") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(MoveNodes, ElementsAreNotPressedFlat) {
  // Edge to edge with a locked sheet: two columns of nodes would have to go to the same place.
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  add_sheet(d, 1, 1, 2, 4, [](int i, int j) { return P{2.0 * i, 2.0 * j, 0}; });
  add_sheet(d, 2, 101, 3, 3, [](int i, int j) {
    return P{4.3 + (i == 0 ? 0 : 0.4 + 2 * (i - 1)), 0.9 + 2.0 * j, 0.01 * (i % 2)};
  });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1}).add(plain);
  const Built before(d);
  ASSERT_FALSE(oracle_penetrations(before).empty());
  MoveNodesOptions o = all_may_move();
  o.lock = {1};
  const PenetrationFix fix = moved(before, o);
  expect_harmless(before, fix);
  EXPECT_FALSE(fix.complete);
  bool said = false;
  for (const FixRefusal& r : fix.refused)
    said |= r.reason.find("half as long") != std::string::npos ||
            r.reason.find("inside out") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(MoveNodes, ASheetBetweenTwoLockedSheetsHasNoRoom) {
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0).shell_part(3, 1.0);
  for (int k = 0; k < 3; ++k)
    add_sheet(d, k + 1, 1 + 100 * k, 3, 3, [k](int i, int j) {
      return P{2.0 * i + 0.1 * k, 2.0 * j, 0.5 * k};
    });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1, 3});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=0.8");
  const Built before(d);
  MoveNodesOptions o = all_may_move();
  o.lock = {1, 3};
  const PenetrationFix fix = moved(before, o);
  expect_harmless(before, fix);
  EXPECT_FALSE(fix.complete);
  EXPECT_FALSE(fix.refused.empty());
  // Where the outer sheets may give way there is room.
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, moved(before))).empty());
}

TEST(MoveNodes, RodsDoNotPassThroughOneAnother) {
  // Too little room between two locked rods: the middle one must stay between them.
  for (const double height : {0.05, 0.2, 0.4}) {
    SmallDeck d;
    d.truss_part(1, 0.5).truss_part(2, 0.5);
    d.node(1, -3, 0, 0).node(2, 3, 0, 0).node(3, -3, 0.1, 0.5).node(4, 3, 0.1, 0.5);
    d.node(5, 0, -3, height).node(6, 0, 0.6, height).node(7, 0, 3, height);
    d.bar("TRUSS", 1, 1, 1, 2).bar("TRUSS", 1, 2, 3, 4);
    d.bar("TRUSS", 2, 3, 5, 6).bar("TRUSS", 2, 4, 6, 7);
    d.group("/LINE/PART/1", {1}).group("/LINE/PART/2", {2});
    d.add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Gapmin=0.9");
    const Built before(d);
    MoveNodesOptions o = all_may_move();
    o.lock = {1};
    const PenetrationFix fix = moved(before, o);
    const auto after = expect_harmless(before, fix);
    const auto z = [&](std::int64_t id) {
      return after->model.nodes.z[after->model.nodes.map.find(id)];
    };
    const double middle = z(5) + (z(6) - z(5)) * 3 / 3.6;
    EXPECT_GT(middle, 0);
    EXPECT_LT(middle, 0.5);
    EXPECT_FALSE(fix.complete);
    // With the outer rods free there is room.
    EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, moved(before))).empty());
  }
}

TEST(MoveNodes, CoordinatesThatComeThroughATransformAreLeftAlone) {
  const Built before(
      two_plates(1, 1.6,
                 "/TRANSFORM/TRA/1\ndown\n"
                 "         1                 0.0                 0.0                -1.0\n" +
                     std::string(plain)));
  ASSERT_FALSE(oracle_penetrations(before).empty());
  const PenetrationFix fix = moved(before);
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
  for (const MovedNode& m : fix.moved) EXPECT_EQ(m.part, 1);
}

// ---- how coordinates are written --------------------------------------------------------------

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// A plate over a tilted one: it moves along the normal, whose component along x is the slope.
TEST(MoveNodes, ComponentsThatHardlyCountStayAsWritten) {
  for (const double slope : {5e-4, 5e-3}) {
    SmallDeck d;
    d.shell_part(1, 1.0).shell_part(2, 1.0);
    add_sheet(d, 1, 1, 4, 4, [&](int i, int j) { return P{2.0 * i, 2.0 * j, slope * 2 * i}; });
    add_sheet(d, 2, 1001, 1, 1, [&](int i, int j) {
      return P{3.3 + i, 3.4 + j, 0.6 + slope * (3.3 + i)};
    });
    d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1});
    const Built before(d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0"));
    MoveNodesOptions options = all_may_move();
    options.secondary_only = true;
    const PenetrationFix fix = moved(before, options);
    EXPECT_TRUE(fix.complete);
    ASSERT_EQ(fix.moved.size(), 4U);
    for (const MovedNode& m : fix.moved) {
      EXPECT_LE(m.by[0], 0.0);
      EXPECT_EQ(m.by[0] == 0.0, slope < 1e-3) << m.by[0];
      EXPECT_EQ(m.by[1], 0.0);
      EXPECT_GE(m.by[2], 0.4 - 1e-3);
    }
    expect_harmless(before, fix);
  }
}

TEST(MoveNodes, KeepsCarriageReturns) {
  const Built before(replaced(two_plates(1, 0.6, plain).text(), "\n", "\r\n"));
  const PenetrationFix fix = moved(before);
  EXPECT_TRUE(fix.complete);
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
  for (const std::string& line : lines_of(text_after(before, fix)))
    EXPECT_TRUE(line.ends_with('\r')) << line;
}

TEST(MoveNodes, LinesWithCommasStayLinesWithCommas) {
  std::string text = two_plates(1, 0.6, plain).text();
  std::string out;
  bool nodes = false;
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with("/")) nodes = line.starts_with("/NODE");
    if (nodes && !line.starts_with("/")) {
      std::istringstream in(line);
      std::string id, x, y, z;
      in >> id >> x >> y >> z;
      out += id + "," + x + "," + y + "," + z + "\n";
    } else {
      out += line + "\n";
    }
  }
  const Built before(out);
  ASSERT_FALSE(oracle_penetrations(before).empty());
  const PenetrationFix fix = moved(before);
  EXPECT_TRUE(fix.complete);
  const std::string changed = text_after(before, fix);
  EXPECT_TRUE(oracle_penetrations(Built(changed)).empty());
  const auto a = lines_of(out), b = lines_of(changed);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(std::count(a[i].begin(), a[i].end(), ','), std::count(b[i].begin(), b[i].end(), ','));
}

TEST(MoveNodes, CoordinatesThatAreParametersAreLeftAlone) {
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  add_sheet(d, 1, 1, 3, 3, [](int i, int j) { return P{2.0 * i, 2.0 * j, 0}; });
  add_sheet(d, 2, 101, 1, 1, [](int i, int j) { return P{2.1 + i, 2.2 + j, 0.75}; });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1}).add(plain);
  const std::string parameter = "/PARAMETER/GLOBAL/REAL/1\nheight\nheight                  0.75\n";
  std::string text = replaced(d.text(), "                0.75", "             &height");
  text = replaced(text, "/NODE\n", parameter + "/NODE\n");
  const Built before(text);
  ASSERT_EQ(before.model.nodes.z[before.model.nodes.map.find(101)], 0.75);
  ASSERT_FALSE(oracle_penetrations(before).empty());
  const PenetrationFix fix = moved(before);
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
  for (const MovedNode& m : fix.moved) EXPECT_EQ(m.part, 1);
  MoveNodesOptions o = all_may_move();
  o.secondary_only = true;
  const PenetrationFix refused = moved(before, o);
  EXPECT_TRUE(refused.rewrite.edits.empty());
  EXPECT_THAT(refused.refused.at(0).reason, ::testing::HasSubstr("&parameter"));
}

TEST(MoveNodes, NodesUnderRandomNoiseMoveByTheirLines) {
  std::string text = two_plates(1, 0.6, plain).text();
  text = replaced(text, "/NODE\n", "/RANDOM\n               0.001\n/NODE\n");
  const Built before(text);
  ASSERT_TRUE(before.model.has_random);
  ASSERT_FALSE(oracle_penetrations(before).empty());
  const PenetrationFix fix = moved(before);
  EXPECT_TRUE(fix.complete);
  EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
}

TEST(MoveNodes, WritesIntoTheIncludeThatOwnsTheNode) {
  const std::string text = two_plates(1, 0.6, plain).text();
  const auto begin = text.find("/NODE\n"), end = text.find("\n/", begin) + 1;
  const std::map<std::string, std::string> files{
      {"main_0000.rad", text.substr(0, begin) + "#include nodes.inc\n" + text.substr(end)},
      {"nodes.inc", text.substr(begin, end - begin)}};
  LoadOptions how;
  how.read.overlay = &files;
  const auto loaded = load("main_0000.rad", how);
  ASSERT_TRUE(loaded.ok());
  MoveNodesOptions o = all_may_move();
  const auto fix = move_nodes(*loaded, o);
  ASSERT_TRUE(fix.ok()) << fix.error().message;
  EXPECT_TRUE(fix->complete);
  const auto changed = apply_rewrite(loaded->deck().sources, fix->rewrite);
  ASSERT_TRUE(changed.ok());
  ASSERT_EQ(changed->size(), 1U);
  EXPECT_EQ(changed->begin()->first, "nodes.inc");
  const Built after(
      replaced(files.at("main_0000.rad"), "#include nodes.inc\n", changed->begin()->second));
  EXPECT_TRUE(oracle_penetrations(after).empty());
}

TEST(MoveNodes, AFileIncludedTwiceIsLeftAlone) {
  SmallDeck d;
  d.shell_part(1, 1.0);
  add_sheet(d, 1, 1, 3, 3, [](int i, int j) { return P{2.0 * i, 2.0 * j, 0}; });
  d.group("/GRNOD/PART/1", {1002}).group("/SURF/PART/1", {1}).add(plain);
  d.add(
      "//SUBMODEL/1\none\n      1000      1000      1000      1000      1000      1000\n"
      "#include plate.inc\n//ENDSUB\n"
      "//SUBMODEL/2\ntwo\n      2000      2000      2000      2000      2000      2000\n"
      "#include plate.inc\n//ENDSUB");
  SmallDeck plate;
  plate.shell_part(2, 1.0);
  add_sheet(plate, 2, 101, 1, 1, [](int i, int j) { return P{2.1 + i, 2.2 + j, 0.75}; });
  std::string part = plate.text();
  part = part.substr(part.find("/NODE"));
  part = part.substr(0, part.find("/END"));
  const std::map<std::string, std::string> files{{"twice_0000.rad", d.text()}, {"plate.inc", part}};
  LoadOptions how;
  how.read.overlay = &files;
  const auto loaded = load("twice_0000.rad", how);
  ASSERT_TRUE(loaded.ok());
  ASSERT_EQ(loaded->deck().sources.size(), 3U);
  MoveNodesOptions o = all_may_move();
  const auto fix = move_nodes(*loaded, o);
  ASSERT_TRUE(fix.ok()) << fix.error().message;
  ASSERT_FALSE(fix->moved.empty());
  for (const MovedNode& m : fix->moved) EXPECT_EQ(m.part, 1);
  EXPECT_TRUE(fix->complete);
}

// ---- samples ----------------------------------------------------------------------------------

std::unique_ptr<Built> read_sample(const std::string& name) {
  const auto source = Source::open(sample(name), Limits{});
  EXPECT_TRUE(source.ok());
  return std::make_unique<Built>(std::string((*source)->bytes()));
}

TEST(MoveNodes, SolvesTheSamples) {
  for (const char* name : {"too_close", "inacti_variants", "crossing_edges", "two_surfaces",
                           "solid_and_skin", "hot_contact"}) {
    SCOPED_TRACE(name);
    const auto before = read_sample(name);
    const auto after = expect_harmless(*before, moved(*before));
    EXPECT_TRUE(oracle_penetrations(*after).empty());
    EXPECT_TRUE(moved(*after).rewrite.edits.empty());
  }
}

TEST(MoveNodes, WritesInTheUnitsAndSubmodelsOfTheLines) {
  const auto before = read_sample("units_and_parameters");
  ASSERT_FALSE(oracle_penetrations(*before).empty());
  const PenetrationFix fix = moved(*before);
  EXPECT_TRUE(fix.complete);
  EXPECT_TRUE(oracle_penetrations(Built(text_after(*before, fix))).empty());
}

TEST(MoveNodes, LeavesOnlyTheCrossedWebOfTheCrashBox) {
  const auto before = read_sample("crash_box");
  const PenetrationFix fix = moved(*before);
  const auto after = expect_harmless(*before, fix);
  for (const auto& [pair, depth] : oracle_penetrations(*after))
    EXPECT_TRUE(std::get<0>(pair) == 2 || ties(*before, std::get<0>(pair)));
  for (const FixRefusal& r : fix.refused) EXPECT_EQ(r.interface_id, 2);
  EXPECT_EQ(fix.tied_pairs, 64u);
  EXPECT_EQ(fix.tied_nodes, 28u);
}

TEST(MoveNodes, DoesNotDependOnTheNumberOfThreads) {
  const Built before(two_plates(2, 0.5, "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0"));
  MoveNodesOptions o = all_may_move();
  const std::string one = text_after(before, moved(before, o));
  o.threads = 3;
  EXPECT_EQ(text_after(before, moved(before, o)), one);
}

}  // namespace
}  // namespace deck::test
