// Kinematic conditions on nodes: which nodes a wall takes, which conditions conflict, and which are
// refused (kinematics.md).
#include <gtest/gtest.h>

#include <algorithm>

#include "contact/small_deck.hpp"
#include "model/mesh/condition_cards.hpp"
#include "model/shared/kinematics.hpp"

namespace deck::test {
namespace {

using detail::ConditionCard;
using detail::ConditionCards;
using Ids = std::vector<std::int64_t>;

/// Nodes 1 to 4 of a shell, 5 to 9 free; groups 1 {1, 2}, 2 {2, 3}, 3 {5}, 4 {1, 2, 3, 4}.
std::string cards(const std::string& more) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 5, 5, 9).node(6, 5, 5, 8).node(7, 1, 1, 0.5).node(8, 3, 4, 12).node(9, 3, 4, 2);
  d.shell_part(1, 2.0).shell(1, 1, 1, 2, 3, 4).group("/SURF/PART/1", {1});
  d.group("/GRNOD/NODE/1", {1, 2}).group("/GRNOD/NODE/2", {3, 2}).group("/GRNOD/NODE/3", {5});
  d.group("/GRNOD/NODE/4", {1, 2, 3, 4});
  return d.add(more).text();
}

struct Conditions {
  explicit Conditions(const std::string& more)
      : built(cards(more)), read(detail::read_condition_cards(built.model, nullptr)) {}
  Ids nodes(std::size_t i) const { return ids(read.cards.at(i).nodes); }
  Ids ids(const std::vector<NodeIndex>& list) const {
    Ids out;
    for (const NodeIndex n : list) out.push_back(built.model.node_id(n));
    return out;
  }
  const ConditionCard& card(std::size_t i = 0) const { return read.cards.at(i); }
  Built built;
  ConditionCards read;
};

TEST(ConditionCards, OfWallsHaveTheNodesOfTheirGroupAndOfTheirReach) {
  const auto nodes = [](const std::string& card) { return Conditions(card).nodes(0); };
  // A plane at z = 1 that looks up: heights above it are 7, 8, 11 and 1; the others lie below.
  const std::string plane = "@/RWALL/PLANE/1 ZM=1 ZM1=2 ";
  EXPECT_EQ(nodes(plane + "grnd_ID1=4"), (Ids{1, 2, 3, 4}));
  EXPECT_EQ(nodes(plane + "grnd_ID1=4 grnd_ID2=2"), (Ids{1, 4}));
  EXPECT_EQ(nodes(plane + "d=1"), Ids{9});
  EXPECT_EQ(nodes(plane + "d=0.999"), Ids{});
  EXPECT_EQ(nodes(plane + "d=7"), (Ids{6, 9}));
  EXPECT_EQ(nodes(plane + "d=8 grnd_ID1=1"), (Ids{1, 2, 5, 6, 9}));
  EXPECT_EQ(nodes("@/RWALL/PLANE/1 ZM=2 ZM1=3 d=0.5"), Ids{9}) << "a node in the plane";
  // The place of a moving wall is that of its node, which is none of its own.
  EXPECT_EQ(nodes("@/RWALL/PLANE/1 node_ID=9 ZM1=9 XM1=3 YM1=4 d=6"), Ids{6});
  // A ball about (3, 4, 7) of radius 4: node 9 is 5 away, node 8 too, node 6 is 3.
  EXPECT_EQ(nodes("@/RWALL/SPHER/1 XM=3 YM=4 ZM=7 Diameter=8 d=1"), (Ids{8, 9}));
  EXPECT_EQ(nodes("@/RWALL/SPHER/1 XM=3 YM=4 ZM=7 Diameter=8 d=0.99"), Ids{});
  // A cylinder along z through the origin of radius 4: nodes 8 and 9 are 5 away from the axis.
  EXPECT_EQ(nodes("@/RWALL/CYL/1 ZM1=3 Diameter=8 d=1"), (Ids{8, 9}));
  EXPECT_EQ(nodes("@/RWALL/CYL/1 ZM1=3 Diameter=8 d=0.99"), Ids{});
  const Conditions other("@/RWALL/PARAL/1 ZM=1 XM1=1 ZM1=1 YM2=1 ZM2=1 d=9 grnd_ID1=1");
  EXPECT_EQ(other.nodes(0), (Ids{1, 2}));
  ASSERT_EQ(other.read.left_out.size(), 1u);
  EXPECT_EQ(other.read.left_out[0].count, 1u);
  EXPECT_TRUE(Conditions(plane + "d=1").read.left_out.empty());
  const Conditions two(plane + "grnd_ID1=1\n@/RWALL/PLANE/2 ZM=1 ZM1=2 grnd_ID1=1");
  EXPECT_EQ(two.card(0).type, ConditionType::rwall);
  EXPECT_EQ(two.card(0).directions, 1);
  EXPECT_NE(two.card(0).system, two.card(1).system);
  EXPECT_FALSE(two.card(0).penalty);
}

// ---- bookings ----------------------------------------------------------------------------------

/// (node, direction, later, earlier, counted) of every conflict, with the ids of the options.
using Booked = std::tuple<std::int64_t, int, std::int64_t, std::int64_t, bool>;
std::vector<Booked> booked(const std::string& more, std::uint64_t* counted = nullptr) {
  const Built b(cards(more));
  const Kinematics k = read_kinematics(b.model);
  std::vector<Booked> out;
  for (const KinematicConflict& c : k.bookings)
    out.emplace_back(b.model.node_id(c.node), c.direction, k.sources[c.later].id,
                     k.sources[c.earlier].id, c.counted);
  if (counted != nullptr) *counted = k.conflicts;
  return out;
}
using Rows = std::vector<Booked>;

TEST(Bookings, ConflictInADirectionOrInAnotherSystemOfItsHalf) {
  const std::string skew = "@/SKEW/FIX/7 Y_Y=1 Z_Z=1\n";
  EXPECT_EQ(booked("@/BCS/1 Tx=1 OmegaZ=1 grnod_ID=1\n@/IMPVEL/2 funct_IDT=1 Dir=Y grnod_ID=2"),
            Rows{});
  EXPECT_EQ(booked("@/BCS/1 Tx=1 Ty=1 grnod_ID=1\n@/IMPVEL/2 funct_IDT=1 Dir=Y grnod_ID=2"),
            (Rows{{2, 1, 2, 1, true}}));
  EXPECT_EQ(booked(skew + "@/BCS/1 Tx=1 grnod_ID=1\n@/IMPVEL/2 funct_IDT=1 Dir=Y skew_ID=7 "
                          "grnod_ID=2"),
            (Rows{{2, 1, 2, 1, true}}))
      << "another system";
  EXPECT_EQ(booked(skew + "@/BCS/1 Tx=1 grnod_ID=1\n@/IMPVEL/2 funct_IDT=1 Dir=YY skew_ID=7 "
                          "grnod_ID=2"),
            Rows{})
      << "the other half";
  EXPECT_EQ(booked("@/BCS/1 OmegaY=1 grnod_ID=1\n@/RLINK/2 grnd_ID=2"),
            (Rows{{2, 3, 2, 1, true}, {2, 4, 2, 1, true}, {2, 5, 2, 1, true}}));
}

TEST(Bookings, NameTheLastOptionThatBookedTheDirection) {
  EXPECT_EQ(booked("@/BCS/1 Tx=1 grnod_ID=1\n@/BCS/2 Ty=1 grnod_ID=1\n"
                   "@/IMPVEL/3 funct_IDT=1 Dir=X grnod_ID=3\n"
                   "@/IMPVEL/4 funct_IDT=1 Dir=X grnod_ID=2"),
            (Rows{{2, 0, 4, 1, true}}));
  // In a direction that nobody has, the last one of the same half.
  EXPECT_EQ(booked("@/SKEW/FIX/7 Y_Y=1 Z_Z=1\n@/BCS/1 Tx=1 grnod_ID=1\n@/BCS/2 Ty=1 grnod_ID=1\n"
                   "@/IMPVEL/3 funct_IDT=1 Dir=Z skew_ID=7 grnod_ID=2"),
            (Rows{{2, 2, 3, 1, true}}))
      << "of the oldest booking of that half";
}

TEST(Bookings, OfMultipliersConflictWithHalvesThatArePartlyBooked) {
  const std::string mpc = "/MPC/3\nm\n         2         1         0                   1\n";
  EXPECT_EQ(booked(mpc), Rows{});
  EXPECT_EQ(booked("@/BCS/1 Tx=1 grnod_ID=1\n" + mpc), (Rows{{2, 6, 3, 1, true}}));
  EXPECT_EQ(booked("@/BCS/1 OmegaX=1 grnod_ID=1\n" + mpc), (Rows{{2, 6, 3, 1, true}}));
  EXPECT_EQ(booked("@/BCS/1 Tx=1 Ty=1 Tz=1 grnod_ID=1\n" + mpc), Rows{}) << "full";
  EXPECT_EQ(booked("@/BCS/1 Tx=1 OmegaX=1 OmegaY=1 OmegaZ=1 grnod_ID=1\n" + mpc + mpc).size(), 1u)
      << "it fills both halves";
}

TEST(Bookings, OnNodesWithWallAndBodyAreNotCountedUnlessIkrem) {
  const std::string wall = "@/RWALL/PLANE/4 grnd_ID1=2 ZM=-5 ZM1=0\n";
  std::uint64_t counted = 99;
  const Rows rows = booked("@/RBODY/1 node_ID=5 grnd_ID=1\n" + wall, &counted);
  EXPECT_EQ(rows, (Rows{{2, 0, 1, 4, false}, {2, 1, 1, 4, false}, {2, 2, 1, 4, false}}));
  EXPECT_EQ(counted, 0u);
  const Rows kept = booked("@/RBODY/1 node_ID=5 grnd_ID=1 Ikrem=1\n" + wall, &counted);
  EXPECT_EQ(kept, (Rows{{2, 0, 1, 4, true}, {2, 1, 1, 4, true}, {2, 2, 1, 4, true}}));
  EXPECT_EQ(counted, 3u);
}

TEST(Bookings, OfTiesWithEarlierOnesAreCountedTwiceAndListedOnce) {
  const std::string tie = "@/INTER/TYPE2/3 grnd_IDs=2 surf_IDm=1";
  std::uint64_t counted = 0;
  EXPECT_EQ(booked("@/BCS/1 Tx=1 grnod_ID=1\n" + tie, &counted).size(), 3u);
  EXPECT_EQ(counted, 6u);
  EXPECT_EQ(booked("@/BCS/1 Tx=1 grnod_ID=1\n" + tie + " Spotflag=27", &counted).size(), 3u);
  EXPECT_EQ(counted, 3u) << "which comes after both passes";
  EXPECT_EQ(booked("@/RBODY/1 node_ID=5 grnd_ID=1\n" + tie, &counted).size(), 6u);
  EXPECT_EQ(counted, 6u) << "bodies come between the passes";
  EXPECT_EQ(
      booked("@/BCS/1 Tx=1 grnod_ID=1\n@/INTER/TYPE12/3 surf_IDs=1 surf_IDm=1", &counted).size(),
      6u);
  EXPECT_EQ(counted, 6u) << "fluids are booked once: two nodes, three translations";
}

/// What becomes of nodes: of each its types as bits, and who is listed with several.
struct Held {
  explicit Held(const std::string& more) : b(cards(more)), k(read_kinematics(b.model)) {}
  std::uint16_t types(std::int64_t node) const { return k.types[b.model.find_node(node)]; }
  Ids several() const {
    Ids out;
    for (const NodeIndex n : k.several) out.push_back(b.model.node_id(n));
    return out;
  }
  Ids sources(std::int64_t node) const {
    Ids out;
    for (const std::uint32_t s : k.of(b.model.find_node(node))) out.push_back(k.sources[s].id);
    return out;
  }
  Built b;
  Kinematics k;
};
std::uint16_t bits(std::initializer_list<ConditionType> types) {
  unsigned out = 0;
  for (const ConditionType t : types) out |= 1u << static_cast<unsigned>(t);
  return static_cast<std::uint16_t>(out);
}

TEST(Held, NodesHaveTheirTypesAndSourcesInTheOrderOfBooking) {
  const Held h(
      "@/RBODY/1 node_ID=5 grnd_ID=1\n@/BCS/2 Tx=1 grnod_ID=2\n@/BCS/3 Ty=1 grnod_ID=2\n"
      "@/RWALL/PLANE/4 grnd_ID1=4 ZM=-5 ZM1=0");
  EXPECT_EQ(h.types(1), bits({ConditionType::rbody})) << "which the wall loses";
  EXPECT_EQ(h.types(2), bits({ConditionType::rbody, ConditionType::bcs}));
  EXPECT_EQ(h.types(3), bits({ConditionType::bcs, ConditionType::rwall}));
  EXPECT_EQ(h.types(4), bits({ConditionType::rwall}));
  EXPECT_EQ(h.types(5), 0);
  EXPECT_EQ(h.sources(2), (Ids{2, 3, 4, 1}));
  EXPECT_EQ(h.sources(4), (Ids{4}));
  EXPECT_EQ(h.sources(5), (Ids{}));
  EXPECT_EQ(h.several(), (Ids{1, 2, 3})) << "node 1: noted when the body met the wall";
  ASSERT_EQ(h.k.walls.size(), 1u);
  EXPECT_EQ(h.k.sources[h.k.walls[0].wall].id, 4);
  EXPECT_EQ(h.k.walls[0].nodes.size(), 2u);
}

TEST(Held, NodesOfRigidBodiesInEveryDirection) {
  EXPECT_EQ(booked("@/BCS/1 Tx=1 grnod_ID=2\n@/RBODY/4 node_ID=5 grnd_ID=1"),
            (Rows{{2, 0, 4, 1, true}, {2, 1, 4, 1, true}, {2, 2, 4, 1, true}}));
  EXPECT_EQ(booked("@/BCS/1 Tx=1 Ty=1 Tz=1 grnod_ID=3\n@/RBODY/4 node_ID=5 grnd_ID=1"), Rows{})
      << "a condition on the main node";
  const Held two("@/RBODY/1 node_ID=5 grnd_ID=1\n@/RBODY/2 node_ID=6 grnd_ID=2");
  EXPECT_EQ(two.k.conflicts, 6u);
  ASSERT_EQ(two.k.shared.size(), 1u);
  EXPECT_EQ(two.b.model.node_id(two.k.shared[0].node), 2);
  EXPECT_FALSE(two.k.shared[0].sensor);
}

TEST(Held, NodesOfTiesThatFindASegment) {
  for (const int node : {7, 6}) {  // 0.5 and 8 above the shell
    const Built b(cards("/GRNOD/NODE/5\ng\n         " + std::to_string(node) +
                        "\n@/BCS/1 Tx=1 grnod_ID=5\n@/INTER/TYPE2/1 grnd_IDs=5 surf_IDm=1 "
                        "Ignore=1 dsearch=2"));
    const Kinematics& k = b.loaded.kinematics();
    EXPECT_EQ(k.conflicts, node == 7 ? 6u : 0u);
    EXPECT_EQ(k.of(b.model.find_node(node)).size(), node == 7 ? 2u : 1u);
    EXPECT_TRUE(k.left_out.empty());
  }
}

/// (message, node, the two options) of everything that is refused; and whether it ends the check.
std::pair<std::vector<std::tuple<int, std::int64_t, std::int64_t, std::int64_t>>, bool> refused(
    const std::string& more) {
  const Held h(more);
  std::vector<std::tuple<int, std::int64_t, std::int64_t, std::int64_t>> out;
  for (const ForbiddenCondition& f : h.k.forbidden)
    out.emplace_back(f.message, h.b.model.node_id(f.node), h.k.sources[f.first].id,
                     h.k.sources[f.second].id);
  return {out, h.k.stops};
}
using Refused =
    std::pair<std::vector<std::tuple<int, std::int64_t, std::int64_t, std::int64_t>>, bool>;

TEST(Refused, RigidElementsThatHangOnOneAnother) {
  const auto rbe2 = [](int id, int main, int group) {
    char text[96];
    std::snprintf(text, sizeof text, "/RBE2/%d\nr\n%10d   111 111         0%10d\n", id, main,
                  group);
    return std::string(text);
  };
  EXPECT_EQ(refused(rbe2(1, 5, 1)), (Refused{{}, false}));
  EXPECT_EQ(refused(rbe2(1, 2, 3) + "@/INTER/TYPE2/3 grnd_IDs=2 surf_IDm=1"),
            (Refused{{{1036, 2, 1, 3}}, true}));
  EXPECT_EQ(refused(rbe2(1, 6, 1) + "@/RBODY/4 node_ID=6 grnd_ID=3"),
            (Refused{{{807, 6, 1, 4}}, true}));
  EXPECT_EQ(refused(rbe2(1, 6, 1) + "@/RBODY/4 node_ID=2 grnd_ID=3"),
            (Refused{{{806, 2, 4, 1}}, true}));
  const std::string rbe3 = "@/RBE3/9 node_IDr=6 N_set=1 WT=1 grnd_ID=2\n";
  EXPECT_EQ(refused(rbe3), (Refused{{}, false}));
  EXPECT_EQ(refused("@/RBE3/9 node_IDr=5 N_set=1 WT=1 grnd_ID=2\n@/BCS/1 Tx=1 grnod_ID=3"),
            (Refused{{{3115, 5, 9, 1}}, false}));
  EXPECT_EQ(refused(rbe3 + rbe2(1, 7, 4)), (Refused{{{3100, 2, 9, 1}}, false}))
      << "one of its nodes is enough";
  EXPECT_EQ(refused(rbe3 + "@/INTER/TYPE2/3 grnd_IDs=2 surf_IDm=1"),
            (Refused{{{3096, 2, 9, 3}}, false}));
  EXPECT_EQ(refused("@/SKEW/FIX/7 Y_Y=1 Z_Z=1\n@/BCS/1 Tx=1 skew_ID=7 grnod_ID=1\n"
                    "@/BCS/2 Ty=1 grnod_ID=2"),
            (Refused{{{148, 2, 1, 2}}, false}))
      << "two skews";
}

}  // namespace
}  // namespace deck::test
