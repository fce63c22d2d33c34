// The cards that put kinematic conditions on nodes: which nodes, which directions, in which system
// and order; and what is booked, refused and taken back (kinematics.md).
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

TEST(ConditionCards, OfBoundaryConditionsHaveTheirFlagsAndSkew) {
  const Conditions c(
      "@/SKEW/FIX/7 Y_Y=1 Z_Z=1\n@/BCS/3 Ty=1 OmegaX=1 OmegaZ=1 grnod_ID=2\n"
      "@/BCS/5 Tx=1 Tz=1 OmegaY=1 skew_ID=7 grnod_ID=1");
  ASSERT_EQ(c.read.cards.size(), 2u);
  EXPECT_EQ(c.card(0).directions, 0b101010);
  EXPECT_EQ(c.card(1).directions, 0b010101);
  EXPECT_EQ(c.nodes(0), (Ids{2, 3}));
  EXPECT_EQ(c.nodes(1), (Ids{1, 2}));
  EXPECT_EQ(c.card(0).id, 3);
  EXPECT_EQ(c.card(1).id, 5);
  EXPECT_EQ(c.card(0).system, 1);
  EXPECT_NE(c.card(1).system, 1);
  for (const ConditionCard& card : c.read.cards) {
    EXPECT_EQ(card.type, ConditionType::bcs);
    EXPECT_EQ(card.turn, detail::Turn::before_ties);
    EXPECT_FALSE(card.lagrange || card.twice || card.penalty || card.sensor);
  }
}

TEST(ConditionCards, OfImposedMotionsHaveOneDirection) {
  const std::string function = "/FUNCT/1\nf\n                   0                   1\n";
  const char* names[] = {"X", "Y", "Z", "XX", "YY", "ZZ"};
  for (int i = 0; i < 6; ++i)
    for (const auto& [keyword, dir, group, first] :
         {std::tuple("IMPVEL", "Dir", "grnod_ID", "funct_IDT"),
          {"IMPDISP", "DIR", "Gnod_id", "Ifunct"},
          {"IMPACC", "Dir", "grnod_ID", "funct_IDT"}}) {
      const Conditions c("@/" + std::string(keyword) + "/4 " + first + "=1 " + dir + "=" +
                         names[i] + " " + group + "=2\n" + function);
      ASSERT_EQ(c.read.cards.size(), 1u) << keyword;
      EXPECT_EQ(c.card().directions, 1 << i) << keyword << names[i];
      EXPECT_EQ(c.nodes(0), (Ids{2, 3}));
      EXPECT_EQ(c.card().type, ConditionType::imposed);
      EXPECT_EQ(c.card().system, 1);
    }
  const Conditions none("@/IMPVEL/4 funct_IDT=1 grnod_ID=2\n" + function);
  EXPECT_TRUE(none.read.cards.empty()) << "without a direction";
  const Conditions lower("@/IMPVEL/4 funct_IDT=1 Dir=zz grnod_ID=2\n" + function);
  EXPECT_EQ(lower.card().directions, 1 << 5);
}

TEST(ConditionCards, SystemsAreThoseOfSkewsAndFrames) {
  const std::string axes = "@/SKEW/FIX/7 Y_Y=1 Z_Z=1\n@/FRAME/FIX/7 Y_Y=1 Z_Z=1\n";
  const auto system = [&](const std::string& card) {
    return Conditions(axes + card).card().system;
  };
  const auto velocity = [&](const std::string& more) {
    return system("@/IMPVEL/4 funct_IDT=1 Dir=X grnod_ID=2 " + more);
  };
  EXPECT_EQ(velocity(""), 1);
  EXPECT_EQ(velocity("skew_ID=7"), system("@/BCS/1 Tx=1 skew_ID=7 grnod_ID=1"));
  EXPECT_EQ(velocity("skew_ID=7"), system("@/IMPDISP/1 DIR=X Iskew=7 Gnod_id=1"));
  EXPECT_NE(velocity("skew_ID=7"), 1);
  EXPECT_NE(velocity("frame_ID=7"), velocity("skew_ID=7")) << "a frame is no skew";
  EXPECT_NE(velocity("frame_ID=7"), 1);
  EXPECT_EQ(velocity("frame_ID=7 skew_ID=7"), velocity("frame_ID=7"));
}

TEST(ConditionCards, OfRigidLinksAndElementsHaveTheirNodes) {
  const Conditions link("@/RLINK/6 Tx=1 grnd_ID=2");
  EXPECT_EQ(link.card().type, ConditionType::rlink);
  EXPECT_EQ(link.card().directions, 0b111111) << "whatever its flags";
  EXPECT_EQ(link.card().system, 0);
  EXPECT_EQ(link.nodes(0), (Ids{2, 3}));
  // Node, flags in columns 14 to 20, skew, group.
  const Conditions rbe2(
      "/RBE2/6\nr\n         5   101 010         0         4\n/RBE2/8\nr\n"
      "         2   010 001         7         2\n@/SKEW/FIX/7 Y_Y=1 Z_Z=1");
  ASSERT_EQ(rbe2.read.cards.size(), 2u);
  EXPECT_EQ(rbe2.card(0).type, ConditionType::rbe2);
  EXPECT_EQ(rbe2.card(0).directions, 0b010101);
  EXPECT_EQ(rbe2.card(0).system, 0);
  EXPECT_EQ(rbe2.ids({rbe2.card(0).main}), Ids{5});
  EXPECT_EQ(rbe2.nodes(0), (Ids{1, 2, 3, 4}));
  EXPECT_EQ(rbe2.card(1).directions, 0b100010);
  EXPECT_GT(rbe2.card(1).system, 1);
  EXPECT_EQ(rbe2.nodes(1), Ids{3}) << "without its main node";
  const Conditions rbe3("@/RBE3/9 node_IDr=5 N_set=1 WT=1 grnd_ID=4");
  EXPECT_EQ(rbe3.card().type, ConditionType::rbe3);
  EXPECT_EQ(rbe3.card().directions, 0b111111);
  EXPECT_EQ(rbe3.nodes(0), Ids{5});
  EXPECT_EQ(rbe3.ids(rbe3.card().leaders), (Ids{1, 2, 3, 4}));
}

TEST(ConditionCards, OfMultipliersHoldAllFreedoms) {
  const Conditions c(
      "/MPC/3\nm\n         7         1         0                   1\n"
      "         6         1         0                   1\n"
      "/BCS/LAGMUL/4\nb\n   111 000         0         2\n"
      "/RWALL/LAGMUL/5\nw\n         0         0         4         3\n"
      "/RBODY/LAGMUL/6\nr\n         5         0         0         0                   0         "
      "1\n");
  ASSERT_EQ(c.read.cards.size(), 4u);
  EXPECT_EQ(c.nodes(0), (Ids{6, 7}));
  EXPECT_EQ(c.nodes(2), (Ids{1, 2, 3, 4}));
  for (const ConditionCard& card : c.read.cards) {
    EXPECT_EQ(card.type, ConditionType::lagmul);
    EXPECT_TRUE(card.lagrange);
    EXPECT_EQ(card.directions, 0b111111);
  }
  EXPECT_EQ(c.card(3).turn, detail::Turn::walls_and_bodies);
  EXPECT_EQ(c.nodes(3), (Ids{1, 2, 5})) << "the main node too";
}

TEST(ConditionCards, OfBodiesHaveTheirNodesAndTheLastIkrem) {
  const auto ikrem = [](int first, int second) {
    return Conditions("@/RBODY/1 node_ID=5 grnd_ID=1 Ikrem=" + std::to_string(first) +
                      "\n@/RBODY/2 node_ID=6 grnd_ID=2 sens_ID=4 Ikrem=" + std::to_string(second))
        .read.ikrem;
  };
  EXPECT_FALSE(ikrem(1, 0));
  EXPECT_TRUE(ikrem(0, 1));
  const Conditions c("@/RBODY/1 node_ID=5 grnd_ID=1\n@/RBODY/2 node_ID=2 grnd_ID=2 sens_ID=4");
  EXPECT_EQ(c.nodes(0), (Ids{1, 2}));
  EXPECT_EQ(c.nodes(1), Ids{3});
  EXPECT_FALSE(c.card(0).sensor);
  EXPECT_TRUE(c.card(1).sensor);
  EXPECT_EQ(c.card(0).directions, 0b111111);
  EXPECT_EQ(c.ids({c.card(0).main}), Ids{5});
}

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

TEST(ConditionCards, OfTiesHoldAllNodesWhereItIsNotKnownWhich) {
  const auto card = [](const char* flag) {
    return Conditions("@/INTER/TYPE2/3 grnd_IDs=2 surf_IDm=1 Spotflag=" + std::string(flag));
  };
  for (const char* flag : {"0", "1", "5", "20", "27", "28"}) {
    const Conditions c = card(flag);
    ASSERT_EQ(c.read.cards.size(), 1u) << flag;
    const bool late = std::string(flag).starts_with("27") || std::string(flag) == "28";
    EXPECT_EQ(c.card().turn, late ? detail::Turn::late_ties : detail::Turn::ties);
    EXPECT_EQ(c.card().twice, !late);
    EXPECT_EQ(c.card().directions, 0b111111);
    EXPECT_EQ(c.card().id, 3);
    EXPECT_EQ(c.nodes(0), (Ids{2, 3}));
    ASSERT_EQ(c.read.left_out.size(), 1u);
    EXPECT_EQ(c.read.left_out[0].count, 2u);
  }
  for (const char* flag : {"25", "26"}) EXPECT_TRUE(card(flag).read.cards.empty()) << flag;
}

TEST(ConditionCards, OfTiesHoldTheNodesThatAreKnown) {
  const Built b(
      cards("@/INTER/TYPE2/3 grnd_IDs=4 surf_IDm=1\n@/INTER/TYPE2/4 grnd_IDs=4 "
            "surf_IDm=1"));
  std::vector<TiedNodes> ties(2);
  ties[0].block = b.interfaces.type2[0].block;
  ties[1].block = b.interfaces.type2[1].block;
  const auto row = [&](std::int64_t node, bool penalty) {
    TiedNodes::Row r;
    r.node = b.model.find_node(node);
    r.penalty = penalty;
    return r;
  };
  ties[0].rows = {row(9, false), row(7, true), row(8, false), row(8, false)};
  ties[1].spotflag = 27;
  ties[1].rows = {row(6, false)};
  const auto read = [&] { return detail::read_condition_cards(b.model, &ties); };
  const auto ids = [&](const ConditionCard& c) {
    Ids out;
    for (const NodeIndex n : c.nodes) out.push_back(b.model.node_id(n));
    return out;
  };
  ConditionCards c = read();
  ASSERT_EQ(c.cards.size(), 2u);
  EXPECT_EQ(ids(c.cards[0]), (Ids{8, 9}));
  EXPECT_EQ(ids(c.cards[1]), Ids{6});
  EXPECT_EQ(c.cards[1].turn, detail::Turn::late_ties);
  EXPECT_TRUE(c.left_out.empty());
  ties[0].evaluated = false;
  c = read();
  EXPECT_EQ(ids(c.cards[0]), (Ids{1, 2, 3, 4}));
  EXPECT_EQ(c.left_out.size(), 1u);
}

TEST(ConditionCards, OfFluidTiesAndCylindersHaveTheirNodes) {
  const Conditions c(
      "@/INTER/TYPE12/3 surf_IDs=1 surf_IDm=1\n@/CYL_JOINT/4 node_ID1=6 node_ID2=5 "
      "grnd_ID=1");
  ASSERT_EQ(c.read.cards.size(), 2u);
  EXPECT_EQ(c.nodes(0), (Ids{1, 2, 3, 4}));
  EXPECT_EQ(c.card(0).directions, 0b000111);
  EXPECT_EQ(c.card(0).type, ConditionType::tied);
  EXPECT_EQ(c.nodes(1), (Ids{1, 2, 5, 6}));
  EXPECT_EQ(c.card(1).directions, 0b111111);
  EXPECT_EQ(c.card(1).turn, detail::Turn::joints);
}

TEST(ConditionCards, AreOrderedByKindAndThenByTheDeck) {
  const Conditions c(
      "@/RLINK/1 grnd_ID=1\n@/IMPACC/2 funct_IDT=1 Dir=X grnod_ID=1\n"
      "@/IMPVEL/3 funct_IDT=1 Dir=X grnod_ID=1\n@/BCS/4 Tx=1 grnod_ID=1\n"
      "@/RBODY/5 node_ID=5 grnd_ID=1\n@/IMPDISP/6 DIR=X Gnod_id=1\n"
      "@/BCS/7 Tx=1 grnod_ID=1\n@/RWALL/PLANE/8 grnd_ID1=1 ZM=-5 ZM1=0\n"
      "@/RBE3/9 node_IDr=6 N_set=1 WT=1 grnd_ID=4\n"
      "/RBE2/10\nr\n         7   111 111         0         1\n");
  const auto ids = [&](detail::Turn turn) {
    Ids out;
    for (const std::size_t i : c.read.order(turn)) out.push_back(c.card(i).id);
    return out;
  };
  EXPECT_EQ(ids(detail::Turn::before_ties), (Ids{4, 7, 3, 6, 2, 1, 10, 9}));
  EXPECT_EQ(ids(detail::Turn::walls_and_bodies), (Ids{8, 5}));
  EXPECT_EQ(ids(detail::Turn::ties), Ids{});
}

TEST(ConditionCards, OfOptionsThatAreNotBookedAreNamed) {
  const Conditions c("/GJOINT/GEAR/3\ng\n         1         2         3         4\n/NBCS/4\nn\n");
  EXPECT_TRUE(c.read.cards.empty());
  EXPECT_EQ(c.read.left_out.size(), 2u);
  for (const LeftOut& l : c.read.left_out) EXPECT_EQ(l.count, 1u);
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

TEST(Held, WallsWithIkremKeepNodesOfBodiesButNotThoseOfTies) {
  const Held h(
      "@/RBODY/1 node_ID=5 grnd_ID=1 Ikrem=1\n@/INTER/TYPE2/3 grnd_IDs=2 surf_IDm=1\n"
      "@/RWALL/PLANE/4 grnd_ID1=4 ZM=-5 ZM1=0");
  EXPECT_EQ(h.types(1), bits({ConditionType::rbody, ConditionType::rwall}));
  EXPECT_EQ(h.types(3), bits({ConditionType::tied}));
  ASSERT_EQ(h.k.walls.size(), 1u);
  EXPECT_EQ(h.k.walls[0].nodes.size(), 2u);
  EXPECT_TRUE(Held("@/RWALL/PLANE/4 grnd_ID1=4 ZM=-5 ZM1=0").k.walls.empty());
}

TEST(Held, TwoOptionsOfOneKindAreSeveral) {
  EXPECT_EQ(Held("@/BCS/1 Tx=1 grnod_ID=1\n@/BCS/2 Tx=1 grnod_ID=2").several(), Ids{2});
  EXPECT_EQ(Held("@/BCS/1 Tx=1 grnod_ID=1\n@/BCS/2 Ty=1 grnod_ID=2").several(), Ids{});
  EXPECT_EQ(Held("@/IMPVEL/1 funct_IDT=1 Dir=X grnod_ID=1\n@/IMPDISP/2 DIR=X Gnod_id=2").several(),
            Ids{})
      << "both are imposed motions, of two kinds";
  EXPECT_EQ(Held("@/BCS/1 grnod_ID=1\n@/RLINK/2 grnd_ID=1").types(1), bits({ConditionType::rlink}))
      << "no direction, no condition";
}

TEST(Held, NodesOfTwoBodiesAreShared) {
  const auto shared = [](const char* sensor) {
    const Held h("@/RBODY/1 node_ID=5 grnd_ID=1 " + std::string(sensor) +
                 "\n@/RBODY/2 node_ID=6 grnd_ID=2\n@/RBODY/3 node_ID=7 grnd_ID=2");
    std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t, bool>> out;
    for (const SharedBody& s : h.k.shared)
      out.emplace_back(h.b.model.node_id(s.node), h.k.sources[s.first].id, h.k.sources[s.second].id,
                       s.sensor);
    return out;
  };
  EXPECT_EQ(shared(""), (std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t, bool>>{
                            {2, 1, 2, false}, {2, 1, 3, false}, {3, 2, 3, false}}));
  EXPECT_EQ(shared("sens_ID=3"),
            (std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t, bool>>{
                {2, 1, 2, true}, {2, 1, 3, true}, {3, 2, 3, false}}));
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
}

TEST(Refused, APenaltyElementLosesItsCondition) {
  const std::string rbe3 = "@/RBE3/9 node_IDr=6 N_set=1 WT=1 grnd_ID=2\n";
  EXPECT_EQ(Held(rbe3).types(6), bits({ConditionType::rbe3}));
  EXPECT_EQ(Held(rbe3 + "@/INTER/TYPE2/3 grnd_IDs=2 surf_IDm=1").types(6), 0);
}

TEST(Refused, ASecondSkewOfABoundaryConditionIsNotBooked) {
  const std::string skews = "@/SKEW/FIX/7 Y_Y=1 Z_Z=1\n@/SKEW/FIX/8 Y_Y=1 Z_Z=1\n";
  const std::string one = skews + "@/BCS/1 Tx=1 skew_ID=7 grnod_ID=1\n";
  EXPECT_EQ(refused(one + "@/BCS/2 Ty=1 skew_ID=7 grnod_ID=2"), (Refused{{}, false}));
  EXPECT_EQ(refused(one + "@/BCS/2 Ty=1 skew_ID=8 grnod_ID=2"), (Refused{{{148, 2, 1, 2}}, false}));
  EXPECT_EQ(Held(one + "@/BCS/2 Ty=1 skew_ID=8 grnod_ID=2").sources(2), Ids{1});
  EXPECT_EQ(refused(one + "@/IMPVEL/2 funct_IDT=1 Dir=Y skew_ID=8 grnod_ID=2"),
            (Refused{{}, false}))
      << "another kind of option";
}

TEST(ConditionType, HasItsName) {
  const std::string_view names[] = {"BCS",    "IMPOSED", "RLINK", "RBE2", "RBE3",
                                    "LAGMUL", "RWALL",   "RBODY", "TIED", "CYL_JOINT"};
  for (std::size_t i = 0; i < condition_types; ++i)
    EXPECT_EQ(to_string(static_cast<ConditionType>(i)), names[i]);
}

}  // namespace
}  // namespace deck::test
