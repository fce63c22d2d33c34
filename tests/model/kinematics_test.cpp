// Bookings of kinematic conditions: which conflict, how many the solver counts, and what walls
// lose.
#include "model/shared/kinematics.hpp"

#include <gtest/gtest.h>

#include "contact/small_deck.hpp"

namespace deck {
namespace {

using test::Built;
using test::SmallDeck;

SmallDeck square() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(99, 5, 5, 9);
  d.node(98, 5, 5, 8);
  d.shell_part(1, 2.0).shell(1, 1, 1, 2, 3, 4);
  d.group("/GRNOD/NODE/1", {1, 2}).group("/GRNOD/NODE/2", {2, 3}).group("/GRNOD/NODE/3", {99});
  return d;
}

std::uint64_t conflicts(const SmallDeck& d) {
  const Built b(d);
  return read_kinematics(b.model).conflicts;
}

TEST(Conflicts, DifferentDirectionsOfOneSystemAreNone) {
  SmallDeck d = square();
  d.add("@/BCS/1 Tx=1 grnod_ID=1\n@/BCS/2 Ty=1 grnod_ID=2");
  EXPECT_EQ(conflicts(d), 0u);
}

TEST(Conflicts, TheSameDirectionTwiceIsOne) {
  SmallDeck d = square();
  d.add("@/BCS/1 Tx=1 grnod_ID=1\n@/BCS/2 Tx=1 grnod_ID=2");
  EXPECT_EQ(conflicts(d), 1u);
}

TEST(Conflicts, OneFixedDirectionOfABodyIsThree) {
  SmallDeck d = square();
  d.add("@/BCS/1 Tx=1 grnod_ID=2\n@/RBODY/1 node_ID=99 grnd_ID=1");
  const Built b(d);
  const Kinematics k = read_kinematics(b.model);
  EXPECT_EQ(k.conflicts, 3u);
  ASSERT_EQ(k.several.size(), 1u);
  EXPECT_EQ(b.model.node_id(k.several[0]), 2);
  ASSERT_EQ(k.bookings.size(), 3u);
  EXPECT_EQ(k.sources[k.bookings[0].earlier].type, ConditionType::bcs);
  EXPECT_EQ(k.sources[k.bookings[0].later].type, ConditionType::rbody);
  EXPECT_EQ(k.of(k.several[0]).size(), 2u);
}

TEST(Conflicts, AConditionOnTheMainNodeIsNone) {
  SmallDeck d = square();
  d.add("@/BCS/1 Tx=1 Ty=1 Tz=1 grnod_ID=3\n@/RBODY/1 node_ID=99 grnd_ID=1");
  EXPECT_EQ(conflicts(d), 0u);
}

TEST(Conflicts, ASharedNodeOfTwoBodiesIsSix) {
  SmallDeck d = square();
  d.add("@/RBODY/1 node_ID=99 grnd_ID=1\n@/RBODY/2 node_ID=98 grnd_ID=2");
  const Built b(d);
  const Kinematics k = read_kinematics(b.model);
  EXPECT_EQ(k.conflicts, 6u);
  ASSERT_EQ(k.shared.size(), 1u);
  EXPECT_EQ(b.model.node_id(k.shared[0].node), 2);
  EXPECT_FALSE(k.shared[0].sensor);
}

TEST(Conflicts, OfTiesWithWhatComesBeforeCountTwice) {
  SmallDeck d = square();
  d.node(11, 0, 0, 1).node(12, 10, 0, 1).node(13, 10, 10, 1).node(14, 0, 10, 1);
  d.shell_part(2, 2.0).shell(2, 2, 11, 12, 13, 14);
  d.group("/SURF/PART/5", {2});
  d.add("@/BCS/1 Tx=1 grnod_ID=1\n@/INTER/TYPE2/1 grnd_IDs=2 surf_IDm=5");
  EXPECT_EQ(conflicts(d), 6u);  // node 2: three translations, twice
}

TEST(Conflicts, OfTiesAreThoseOfNodesThatFindASegment) {
  for (const double height : {1.0, 5.0}) {
    SmallDeck d = square();
    d.node(11, 2, 2, height).group("/GRNOD/NODE/5", {11}).group("/SURF/PART/5", {1});
    d.add("@/BCS/1 Tx=1 grnod_ID=5");
    d.add("@/INTER/TYPE2/1 grnd_IDs=5 surf_IDm=5 Ignore=1 dsearch=2");
    const Built b(d);
    EXPECT_EQ(b.loaded.kinematics().conflicts, height < 2.0 ? 6u : 0u);
    EXPECT_EQ(b.loaded.kinematics().of(b.model.nodes.map.find(11)).size(), height < 2.0 ? 2u : 1u);
    EXPECT_TRUE(b.loaded.kinematics().left_out.empty());
  }
}

TEST(Walls, LoseNodesOfBodiesAndDoNotCountThem) {
  SmallDeck d = square();
  d.add("@/RBODY/1 node_ID=99 grnd_ID=1\n@/RWALL/PLANE/1 grnd_ID1=2 ZM=-5 ZM1=0");
  const Built b(d);
  const Kinematics k = read_kinematics(b.model);
  EXPECT_EQ(k.conflicts, 0u);
  ASSERT_EQ(k.walls.size(), 1u);
  ASSERT_EQ(k.walls[0].nodes.size(), 1u);
  EXPECT_EQ(b.model.node_id(k.walls[0].nodes[0]), 2);
}

TEST(Forbidden, TwoSkewsOfBoundaryConditionsOnANode) {
  SmallDeck d = square();
  d.add("@/SKEW/FIX/5 Y_Y=1 Z_Z=1");
  d.add("@/BCS/1 Tx=1 skew_ID=5 grnod_ID=1\n@/BCS/2 Ty=1 grnod_ID=2");
  const Built b(d);
  const Kinematics k = read_kinematics(b.model);
  EXPECT_EQ(k.conflicts, 0u);
  ASSERT_EQ(k.forbidden.size(), 1u);
  EXPECT_EQ(k.forbidden[0].message, 148);
}

}  // namespace
}  // namespace deck
