// Tests of moving nodes out of gaps.
#include "edit/shared/depenetrate.hpp"

#include <functional>

#include "edit/fix/support.hpp"

namespace deck::test {
namespace {

const char* const plain = "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0";

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

/// Scenes from a seed, for each of these cards.
struct RandomScenes {
  std::function<SmallDeck(unsigned seed, const char* card)> scene;
  std::vector<const char*> cards;
};

TEST(MoveNodes, FreesRandomPlatesFoldsAndSolids) {
  const RandomScenes all[] = {
      {[](unsigned seed, const char* card) { return two_plates(seed, 0.35 + 0.1 * seed, card); },
       {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=1",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=2 Fscalegap=1.2 Gapmax=0.9",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Igap=3 Gapmin=0.7",
        "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.0 Inacti=3",
        "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1.0",
        "@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Igap=1",
        "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0",
        "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Igap=1 Gapmin=0.5"}},
      {[](unsigned seed, const char* card) { return two_plates(seed, 0.5, card); },
       {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=0.9\n"
        "@/INTER/TYPE11/2 line_IDs=1 line_IDm=2 Gapmin=1.1"}},
      {hairpin,
       {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=1.7",
        "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=1 Gapmin=1.65"}},
      {[](unsigned seed, const char* card) { return two_blocks(seed, 0.2 + 0.1 * seed, card); },
       {"@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=1 Gapmin=0.8",
        "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=0.8"}}};
  for (const RandomScenes& scenes : all)
    for (const char* card : scenes.cards)
      for (unsigned seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(card + (" seed " + std::to_string(seed)));
        expect_solved(scenes.scene(seed, card));
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
    EXPECT_TRUE(says(fix, "would change what is tied"));
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

TEST(MoveNodes, TakesNodesAtDistanceZeroToTheSideOfTheirNeighbours) {
  SmallDeck d;
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  add_sheet(d, 1, 1, 3, 3, [](int i, int j) { return P{2.0 * i, 2.0 * j, 0}; });
  // A roof whose ridge lies on the plate.
  add_sheet(d, 2, 101, 2, 2, [](int i, int j) {
    return P{1.5 + 1.4 * i, 1.3 + 1.4 * j, i == 1 ? 0.0 : 1.6};
  });
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1}).add(plain);
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
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/1", {1}).add(plain);
  const Built before(d);
  const auto after = expect_harmless(before, moved(before));
  EXPECT_TRUE(oracle_penetrations(*after).empty());
  EXPECT_TRUE(oracle_crossings(*after).empty());
}

TEST(MoveNodes, WhatLiesAtOnePlaceIsRefusedWithoutATry) {
  SmallDeck d;
  d.shell_part(1, 1.0);
  for (int n = 1; n <= 40; ++n) d.node(n, 50, 0.1, -7);
  for (int e = 0; e < 10; ++e) d.shell(1, 1 + e, 4 * e + 1, 4 * e + 2, 4 * e + 3, 4 * e + 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/PART/1", {1});
  const Built before(d.add(plain));
  const PenetrationFix fix = moved(before);
  EXPECT_TRUE(fix.rewrite.edits.empty());
  EXPECT_FALSE(fix.complete);
  EXPECT_EQ(fix.iterations, 0);
  ASSERT_EQ(fix.refused.size(), 40U);
  for (const FixRefusal& r : fix.refused)
    EXPECT_THAT(r.reason, ::testing::HasSubstr("at one place"));
}

// ---- what holds nodes -------------------------------------------------------------------------

TEST(MoveNodes, OnlyNodesMoveThatMay) {
  const auto expect_part = [](unsigned seed, std::int64_t part, const MoveNodesOptions& options) {
    const Built before(two_plates(seed, 0.6, plain));
    const PenetrationFix fix = moved(before, options);
    EXPECT_TRUE(oracle_penetrations(*expect_harmless(before, fix)).empty());
    ASSERT_FALSE(fix.moved.empty());
    for (const MovedNode& m : fix.moved) EXPECT_EQ(m.part, part);
  };
  MoveNodesOptions o = all_may_move();
  o.lock = {1};
  expect_part(1, 2, o);
  o = all_may_move();
  o.clearance = 0.01;  // rough plates: along the first normal not all of the way is gained
  o.move = {1};
  expect_part(2, 1, o);
  o.move = {};
  o.secondary_only = true;
  expect_part(3, 2, o);
}

TEST(MoveNodes, ANodeInsideASolidIsNotPushedThroughItsFace) {
  for (const double z : {9.5, 10.5}) {
    SmallDeck d;
    add_brick(d, 1, 1, 1, {0, 0, 0}, {10, 10, 10});
    d.solid_part(1).node(100, 5.5, 4.25, z);
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
  EXPECT_TRUE(says(fix, "--max-displacement"));
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
  EXPECT_TRUE(says(fix, "half as long") || says(fix, "inside out"));
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

TEST(MoveNodes, DoesNotDependOnTheNumberOfThreads) {
  const Built before(two_plates(2, 0.5, "@/INTER/TYPE19/1 surf_IDs=1 surf_IDm=2 Gapmin=1.0"));
  MoveNodesOptions o = all_may_move();
  const std::string one = text_after(before, moved(before, o));
  o.threads = 3;
  EXPECT_EQ(text_after(before, moved(before, o)), one);
}

}  // namespace
}  // namespace deck::test
