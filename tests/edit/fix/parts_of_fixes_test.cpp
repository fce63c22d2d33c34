// The pieces that fixes are made of, each against what can be seen or computed by hand: rounded
// numbers, states of pairs, neighbours and crossings of a mesh, what hangs together, bounds of
// moves.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/small_deck.hpp"
#include "edit/fix/common.hpp"
#include "edit/fix/nodes/depenetrate_bounds.hpp"
#include "edit/fix/nodes/depenetrate_mesh.hpp"
#include "edit/fix/nodes/depenetrate_rows.hpp"
#include "edit/fix/part_groups.hpp"
#include "edit/fix/type_rules.hpp"

namespace deck::test {
namespace {

using detail::FixMesh;
using detail::has_direction;
using detail::key_of;
using detail::state_of;
using detail::way_out;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Ids = std::vector<std::int64_t>;

TEST(RoundedNumbers, AreTheNearestOnTheirSide) {
  const auto down = [](double bound, int digits, int width = 20) {
    const auto r = detail::round_down(bound, digits, width);
    return r ? r->value : -1;
  };
  const auto up = [](double bound, int digits, int width = 20) {
    const auto r = detail::round_up(bound, digits, width);
    return r ? r->value : -1;
  };
  EXPECT_EQ(down(1.2356, 3), 1.23);
  EXPECT_EQ(up(1.2356, 3), 1.24);
  EXPECT_EQ(down(1.2344, 3), 1.23);
  EXPECT_EQ(up(1.2344, 3), 1.24);
  EXPECT_EQ(down(1.23, 3), 1.23) << "the bound itself is allowed";
  EXPECT_EQ(up(1.23, 3), 1.23);
  EXPECT_EQ(down(1.0001, 2), 1.0);
  EXPECT_EQ(up(9.99, 2), 10.0);
  EXPECT_EQ(down(0.099999, 2), 0.099);
  EXPECT_EQ(down(0.96, 1), 0.9);
  EXPECT_EQ(up(1.5e-7, 1), 2e-7);
  EXPECT_EQ(down(1.5e9, 1), 1e9);
  EXPECT_EQ(down(0, 3), -1);
  EXPECT_EQ(down(-1, 3), -1);
  // Fewer digits where the columns hold no more.
  EXPECT_EQ(down(123.456789, 9, 5), 123.4);
  EXPECT_EQ(up(123.456789, 9, 5), 123.5);
  EXPECT_EQ(detail::round_down(1.23, 3, 20, 1.23)->value, 1.22) << "below the number";
  EXPECT_EQ(detail::round_down(1.235, 3, 20, 1.24)->value, 1.23);
  EXPECT_EQ(detail::round_down(123.456789, 9, 5)->text, "123.4");
}

TEST(TypeRulesOfFixes, KnowWhichInactiATypeTakes) {
  for (const int type : {7, 10, 11, 24, 25}) EXPECT_EQ(detail::rules_of(type).type, type);
  EXPECT_EQ(detail::rules_of(24).usual_inacti, 5);
  EXPECT_EQ(detail::rules_of(7).usual_inacti, 6);
  EXPECT_TRUE(detail::rules_of(7).fpenmax);
  EXPECT_FALSE(detail::rules_of(11).fpenmax);
  EXPECT_EQ(detail::why_not_inacti(7, 6), "");
  EXPECT_NE(detail::why_not_inacti(7, -1), "");
  EXPECT_EQ(detail::why_not_inacti(25, -1), "");
}

/// A strip of two quads, a triangle on top of it, a truss to a far node, and a node of its own.
SmallDeck strip() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 22, 0, 0);
  d.node(6, 22, 10, 0).node(7, 5, 5, 3).node(8, 9, 5, 3).node(9, 7, 9, 3).node(10, 40, 0, 0);
  d.node(99, 50, 50, 50).shell_part(1, 1).shell_part(2, 1).truss_part(3, 1);
  d.shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3).shell3(2, 3, 7, 8, 9);
  d.bar("TRUSS", 3, 4, 5, 10).group("/SURF/PART/1", {1}).group("/GRNOD/PART/2", {2});
  return d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=4");
}

struct Meshed {
  explicit Meshed(const SmallDeck& d)
      : b(d), mesh(b.scene), x{b.model.nodes.x, b.model.nodes.y, b.model.nodes.z} {}
  NodeIndex n(std::int64_t id) const { return b.model.find_node(id); }
  Ids ids(std::span<const NodeIndex> nodes) const {
    Ids out;
    for (const NodeIndex i : nodes) out.push_back(b.model.node_id(i));
    return out;
  }
  Coordinates moved(std::int64_t id, double dx, double dy, double dz) const {
    Coordinates out = x;
    out.x[n(id)] += dx;
    out.y[n(id)] += dy;
    out.z[n(id)] += dz;
    return out;
  }
  Built b;
  FixMesh mesh;
  Coordinates x;
};

TEST(FixMeshOf, KnowsNeighboursAndParts) {
  const Meshed m(strip());
  EXPECT_THAT(m.ids(m.mesh.neighbours(m.n(2))), ElementsAre(1, 3, 5));
  EXPECT_THAT(m.ids(m.mesh.neighbours(m.n(1))), ElementsAre(2, 4));
  EXPECT_THAT(m.ids(m.mesh.neighbours(m.n(5))), ElementsAre(2, 6, 10));
  EXPECT_THAT(m.ids(m.mesh.neighbours(m.n(7))), ElementsAre(8, 9));
  EXPECT_THAT(m.ids(m.mesh.neighbours(m.n(99))), IsEmpty());
  const auto part = [&](std::int64_t id) {
    const std::uint32_t p = m.mesh.part_of(m.n(id));
    return p == no_index ? 0 : m.b.model.parts[p].id;
  };
  EXPECT_EQ(part(2), 1);
  EXPECT_EQ(part(5), 1) << "shells come before trusses";
  EXPECT_EQ(part(8), 2);
  EXPECT_EQ(part(10), 3);
  EXPECT_EQ(part(99), 0);
  const auto nodes = [&](std::int64_t id) {
    return m.mesh.nodes_of_part(m.b.model.part_of_id.at(id));
  };
  EXPECT_EQ(nodes(1), 6u);
  EXPECT_EQ(nodes(2), 3u);
  EXPECT_EQ(nodes(3), 1u);
}

TEST(FixMeshOf, FindsPathsWithinALength) {
  const Meshed m(strip());
  const std::vector<NodeIndex> to{m.n(6), m.n(10)};
  // 1 - 2 - 5 - 6 is 10 + 12 + 10 long, 1 - 2 - 5 - 10 is 10 + 12 + 18, 1 - 4 - 3 - 6 is 32, too.
  EXPECT_TRUE(m.mesh.connected_within(m.x, m.n(1), to, 32));
  EXPECT_FALSE(m.mesh.connected_within(m.x, m.n(1), to, 31.99));
  EXPECT_TRUE(m.mesh.connected_within(m.x, m.n(10), to, 0)) << "it is one of them";
  EXPECT_FALSE(m.mesh.connected_within(m.x, m.n(7), to, 1e9));
}

TEST(FixMeshOf, FindsEdgesThatPassThroughFaces) {
  const Meshed m(strip());
  EXPECT_THAT(m.mesh.all_crossings(m.x, 1), IsEmpty());
  const Coordinates below = m.moved(7, 0, 0, -4);
  const auto all = m.mesh.all_crossings(below, 1);
  ASSERT_EQ(all.size(), 2u) << "both edges of node 7";
  std::set<std::set<std::int64_t>> nodes;
  for (const auto& c : all) {
    const Ids ids = m.ids(m.mesh.nodes_of(c));
    nodes.insert({ids.begin(), ids.end()});
  }
  EXPECT_EQ(nodes, (std::set<std::set<std::int64_t>>{{1, 2, 3, 4, 7, 8}, {1, 2, 3, 4, 7, 9}}));
  const std::vector<NodeIndex> seven{m.n(7)}, eight{m.n(8)}, six{m.n(6)};
  EXPECT_EQ(m.mesh.crossings(below, seven, 1), all);
  EXPECT_EQ(m.mesh.crossings(below, eight, 1).size(), 1u);
  EXPECT_THAT(m.mesh.crossings(below, six, 1), IsEmpty());
  std::vector<FixMesh::Crossed> kept;
  m.mesh.update_crossings(below, seven, 1, kept);
  EXPECT_EQ(kept, all);
  m.mesh.update_crossings(m.x, seven, 1, kept);
  EXPECT_THAT(kept, IsEmpty());
}

TEST(FixMeshOf, FindsNeighboursThatCameTooClose) {
  const Meshed m(strip());
  const Coordinates now = m.moved(5, -6, 0, 0);  // 2 - 5 is 6 instead of 12
  const std::vector<NodeIndex> five{m.n(5)};
  const auto shortened = [&](double least) {
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    for (const auto& [a, b] : m.mesh.shortened(m.x, now, five, least, 1))
      out.emplace_back(m.b.model.node_id(a), m.b.model.node_id(b));
    return out;
  };
  EXPECT_THAT(shortened(0.51), ElementsAre(std::pair(5, 2)));
  EXPECT_THAT(shortened(0.5), IsEmpty()) << "exactly half is not less";
}

TEST(FixMeshOf, ListsMovesById) {
  const Meshed m(strip());
  Coordinates now = m.moved(10, 3, 4, 12);
  now.z[m.n(99)] += 2;
  const std::vector<MovedNode> all = moved_list(m.b.model, m.mesh, {m.n(99), m.n(10)}, m.x, now);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].id, 10);
  EXPECT_EQ(all[0].part, 3);
  EXPECT_EQ(all[0].by, (std::array<double, 3>{3, 4, 12}));
  EXPECT_EQ(all[0].distance, 13);
  EXPECT_EQ(all[1].id, 99);
  EXPECT_EQ(all[1].part, 0);
}

TEST(PairStates, OfANodeAreItsDistanceNormalAndShares) {
  const Meshed m(strip());
  const Contact& c = m.b.scene.contacts.at(0);
  std::uint32_t s = 0;
  while (m.b.model.node_id(c.secondary[s].node) != 7) ++s;
  const detail::PairAt at{0, s, 0};
  const detail::PairState state = state_of(m.b.scene, m.x, at);
  EXPECT_EQ(state.count, 5);
  EXPECT_EQ(state.secondary_count, 1);
  EXPECT_EQ(state.distance, 3);
  EXPECT_EQ(state.gap, 4);
  EXPECT_EQ(state.depth(), 1);
  EXPECT_EQ((std::array{state.normal.x, state.normal.y, state.normal.z}),
            (std::array{0.0, 0.0, 1.0}));
  EXPECT_EQ(state.weights[0], 1);
  // In the middle of the quad: a quarter each, against.
  for (std::size_t k = 1; k < 5; ++k) EXPECT_NEAR(state.weights[k], -0.25, 1e-12);
  const detail::PairKey key = key_of(m.b.scene, at);
  EXPECT_EQ(key.contact, 0u);
  EXPECT_EQ(key.secondary[0], m.n(7));
  EXPECT_TRUE(std::is_sorted(key.main.begin(), key.main.end()));
  detail::PairState on = state;
  on.distance = 4e-6;
  EXPECT_FALSE(has_direction(on)) << "a millionth of the gap is rounding";
  on.distance = 4.1e-6;
  EXPECT_TRUE(has_direction(on));
  EXPECT_EQ(way_out(m.b.scene, m.mesh, m.x, at, state).z, 1);
  // On the surface the way is to the side of the neighbours, above or below.
  for (const double side : {1.0, -1.0}) {
    Coordinates flat = m.x;
    flat.z[m.n(7)] = 0;
    flat.z[m.n(8)] = flat.z[m.n(9)] = 3 * side;
    EXPECT_EQ(way_out(m.b.scene, m.mesh, flat, at, state_of(m.b.scene, flat, at)).z, side);
  }
}

TEST(PairStates, OfEdgesHaveSharesOfBothEnds) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 2, -3, 1).node(4, 2, 9, 1).truss_part(1, 1);
  d.bar("TRUSS", 1, 1, 1, 2).bar("TRUSS", 1, 2, 3, 4);
  d.segments("/LINE/SEG/3", {{4, 3}}).segments("/LINE/SEG/4", {{2, 1}});
  const Meshed m(d.add("@/INTER/TYPE11/1 line_IDs=3 line_IDm=4 Gapmin=2.5"));
  const detail::PairState state = state_of(m.b.scene, m.x, {0, 0, 0});
  EXPECT_EQ(state.count, 4);
  EXPECT_EQ(state.secondary_count, 2);
  EXPECT_EQ(state.distance, 1);
  EXPECT_EQ(std::abs(state.normal.z), 1);
  // Node 3 is 3 before the crossing, node 4 is 9 behind it; node 1 is 2, node 2 is 8 away.
  std::map<std::int64_t, double> shares;
  for (std::size_t k = 0; k < 4; ++k) shares[m.b.model.node_id(state.nodes[k])] = state.weights[k];
  EXPECT_NEAR(shares[3], 0.75, 1e-12);
  EXPECT_NEAR(shares[4], 0.25, 1e-12);
  EXPECT_NEAR(shares[1], -0.8, 1e-12);
  EXPECT_NEAR(shares[2], -0.2, 1e-12);
  const detail::PairKey key = key_of(m.b.scene, {0, 0, 0});
  EXPECT_LT(key.secondary[0], key.secondary[1]);
  EXPECT_LT(key.main[0], key.main[1]);
  EXPECT_EQ(key.main[2], 0u);
}

/// Of one secondary node, a pair whose closest point lies on nodes of its nearest pair says nothing
/// new; what is two gaps away or farther says nothing at all.
TEST(PairStates, TheStrictestComeFirst) {
  const auto pair = [](std::uint32_t contact, std::uint32_t secondary, std::uint32_t main,
                       double distance, int secondaries, std::array<NodeIndex, 6> nodes) {
    detail::PairNow out;
    out.at = {contact, secondary, main};
    out.state.gap = 4;
    out.state.distance = distance;
    out.state.secondary_count = secondaries;
    out.state.count = secondaries == 1 ? 5 : 4;
    out.state.nodes = nodes;
    out.state.weights = {1, -0.5, -0.5, 0, 0, 0};
    return out;
  };
  const std::vector<detail::PairNow> pairs{
      pair(0, 0, 0, 2, 1, {9, 2, 1, 5, 6}),      // follows the next one
      pair(0, 0, 1, 1, 1, {9, 1, 2, 3, 4}),      //
      pair(0, 0, 2, 2.5, 1, {9, 2, 5, 7, 8}),    // node 5 is not of it
      pair(0, 1, 1, 8, 1, {10, 1, 2, 3, 4}),     // two gaps away
      pair(0, 2, 1, 7.75, 1, {11, 1, 2, 3, 4}),  //
      pair(1, 2, 1, 0.5, 1, {11, 1, 2, 3, 4}),   // of another contact
      pair(2, 0, 0, 1.25, 2, {20, 21, 1, 2}),    // edges: none follows
      pair(2, 0, 1, 1.75, 2, {20, 21, 2, 1})};
  std::vector<std::size_t> order;
  for (const detail::PairNow* p : strictest(pairs))
    order.push_back(static_cast<std::size_t>(p - pairs.data()));
  EXPECT_EQ(order, (std::vector<std::size_t>{5, 1, 6, 7, 2, 4}));
}

TEST(PartGroupsOf, JoinElementsBodiesAndTies) {
  SmallDeck d;
  const auto sheet = [&](int part, double z) {
    const int n = 10 * part;
    d.node(n + 1, 0, 0, z).node(n + 2, 9, 0, z).node(n + 3, 9, 9, z).node(n + 4, 0, 9, z);
    d.shell_part(part, 1).shell(part, part, n + 1, n + 2, n + 3, n + 4);
  };
  for (int part = 1; part <= 9; ++part) sheet(part, 10 * part);
  d.node(99, 0, 0, 99).node(98, 0, 0, 98).truss_part(20, 1).bar("TRUSS", 20, 20, 13, 21);
  d.group("/GRNOD/NODE/50", {31, 42}).group("/SURF/PART/5", {5}).group("/GRNOD/NODE/6", {61});
  // A node of part 6 tied to part 5, which is 10 below it.
  d.add("@/RBODY/7 node_ID=98 grnd_ID=50").add("@/INTER/TYPE2/1 grnd_IDs=6 surf_IDm=5 dsearch=11");
  d.group("/SURF/PART/8", {8}).group("/GRNOD/NODE/9", {91});
  d.add("@/INTER/TYPE10/2 grnd_IDs=9 surf_IDm=8 Gap=11");
  const Built b(d);
  const auto group = [&](const FixOptions& options) {
    const detail::PartGroups groups(b.loaded, b.scene, options);
    std::vector<std::string> names;
    for (const int id : {11, 21, 31, 42, 51, 61, 71, 81, 91, 99})
      names.push_back(groups.name_of(groups.of(b.model.find_node(id))));
    return names;
  };
  const std::string together = " (they hang together)";
  EXPECT_THAT(group({}), ElementsAre("parts 1, 2, 20" + together, "parts 1, 2, 20" + together,
                                     "parts 3, 4" + together, "parts 3, 4" + together,
                                     "parts 5, 6" + together, "parts 5, 6" + together, "part 7",
                                     "parts 8, 9" + together, "parts 8, 9" + together, "node 99"));
  FixOptions treated;
  treated.ties = true;
  EXPECT_EQ(group(treated)[7], "part 8") << "pairs of a TYPE10 that are treated join nothing";
  const detail::PartGroups groups(b.loaded, b.scene, {});
  const std::vector<NodeIndex> nodes = groups.nodes_of(groups.of(b.model.find_node(11)));
  Ids ids;
  for (const NodeIndex n : nodes) ids.push_back(b.model.node_id(n));
  EXPECT_THAT(ids, ElementsAre(11, 12, 13, 14, 21, 22, 23, 24));
}

TEST(PartGroupsOf, NameFivePartsAndHowManyMore) {
  SmallDeck d;
  for (int part = 1; part <= 7; ++part) d.node(part, part, 0, 0).truss_part(part, 1);
  d.node(8, 8, 0, 0);
  for (int part = 1; part <= 7; ++part) d.bar("TRUSS", part, part, part, part + 1);
  const Built b(d);
  const detail::PartGroups groups(b.loaded, b.scene, {});
  EXPECT_EQ(groups.name_of(groups.of(0)), "parts 1, 2, 3, 4, 5 and 2 more (they hang together)");
}

TEST(BoundsOfMoves, AreSharesOfNormalsWithinTheReach) {
  detail::DepthBounds bounds;
  detail::PairState state;
  state.nodes = {4, 7};
  state.count = 2;
  bounds.add({}, state, {0, 0, 1}, 2);
  bounds.add({}, state, {0, 0, 1}, 3);
  bounds.follow(9, 1.5);
  bounds.follow(4, 99);
  EXPECT_TRUE(bounds.contains(4));
  EXPECT_FALSE(bounds.contains(5));
  EXPECT_EQ(bounds.reach_of(4), 3) << "the larger one; what is in a pair does not follow";
  EXPECT_EQ(bounds.reach_of(9), 1.5);
  EXPECT_EQ(bounds.pairs_of(4).size(), 2u);
  EXPECT_EQ(bounds.pairs_of(9).size(), 0u);
  const auto place = [&](NodeIndex n, Vec wanted) {
    return bounds.allowed({{n, wanted}}, 1).at(0);
  };
  // The secondary node may go up, the main one down, by 3 at most.
  EXPECT_EQ(place(4, {1, 1, 2}).by.z, 2);
  EXPECT_EQ(place(4, {1, 1, 2}).by.x, 0);
  EXPECT_FALSE(place(4, {0, 0, 2}).at_bound);
  EXPECT_EQ(place(4, {0, 0, 5}).by.z, 3);
  EXPECT_TRUE(place(4, {0, 0, 5}).at_bound);
  EXPECT_EQ(place(4, {0, 0, -2}).by.z, 0);
  EXPECT_EQ(place(7, {0, 0, -2}).by.z, -2);
  EXPECT_EQ(place(7, {0, 0, 2}).by.z, 0);
}

/// Of directions at right angles each gives its own share; what is left is made as short as
/// allowed: along each direction the reach, and in a corner of several the root of 3 times as much.
TEST(BoundsOfMoves, OfManyNodesAtOnceAreThoseOfEach) {
  detail::DepthBounds bounds;
  detail::NodeMoves wanted;
  std::vector<std::array<double, 3>> expected;
  std::vector<bool> at_bound;
  for (NodeIndex n = 0; n < 37; ++n) {
    const std::size_t axes = n % 4;
    const double sign = n % 2 == 0 ? 1 : -1, reach = 2 + n % 3;
    const std::array<double, 3> asked{3.0 * (n % 5) - 6, 2.0 * (n % 7) - 6, 4.0 * (n % 3) - 3};
    wanted.emplace_back(n, Vec{asked[0], asked[1], asked[2]});
    if (axes == 0) bounds.follow(n, reach);
    std::array<double, 3> by = asked;
    double farthest = 0;
    for (std::size_t k = 0; k < 3 && axes > 0; ++k) {
      by[k] = k < axes ? sign * std::max(0.0, sign * asked[k]) : 0;
      farthest = std::max(farthest, std::abs(by[k]));
      if (k >= axes) continue;
      detail::PairState state;
      state.nodes[0] = n;
      state.count = state.secondary_count = 1;
      bounds.add({}, state, {k == 0 ? sign : 0, k == 1 ? sign : 0, k == 2 ? sign : 0}, reach);
    }
    const double length = std::sqrt(by[0] * by[0] + by[1] * by[1] + by[2] * by[2]);
    farthest = std::max(farthest, length / (axes > 1 ? std::sqrt(3.0) : 1));
    if (farthest > reach)
      for (double& v : by) v *= reach / farthest;
    expected.push_back(by);
    at_bound.push_back(farthest >= reach);
  }
  EXPECT_GT(std::count(at_bound.begin(), at_bound.end(), true), 9);
  EXPECT_GT(std::count(at_bound.begin(), at_bound.end(), false), 9);
  for (const int threads : {1, 3}) {
    const auto places = bounds.allowed(wanted, threads);
    ASSERT_EQ(places.size(), expected.size());
    for (std::size_t n = 0; n < places.size(); ++n) {
      SCOPED_TRACE(n);
      EXPECT_NEAR(places[n].by.x, expected[n][0], 1e-12);
      EXPECT_NEAR(places[n].by.y, expected[n][1], 1e-12);
      EXPECT_NEAR(places[n].by.z, expected[n][2], 1e-12);
      EXPECT_EQ(places[n].at_bound, at_bound[n]);
    }
  }
}

}  // namespace
}  // namespace deck::test
