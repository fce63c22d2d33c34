// Rounded numbers, edges that pass through faces, and bounds of moves, against closed forms.
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
  EXPECT_THAT(m.mesh.crossings(m.x, seven, 1), IsEmpty());
}

TEST(BoundsOfMoves, AreSharesOfNormalsWithinTheReach) {
  detail::DepthBounds bounds;
  detail::PairState state;
  state.nodes = {4, 7};
  state.count = 2;
  bounds.add({}, state, {0, 0, 1}, 2);
  bounds.add({}, state, {0, 0, 1}, 3);
  EXPECT_TRUE(bounds.contains(4));
  EXPECT_FALSE(bounds.contains(5));
  EXPECT_EQ(bounds.reach_of(4), 3) << "the larger one";
  EXPECT_EQ(bounds.pairs_of(4).size(), 2u);
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
    const std::size_t axes = 1 + n % 3;
    const double sign = n % 2 == 0 ? 1 : -1, reach = 2 + n % 3;
    const std::array<double, 3> asked{3.0 * (n % 5) - 6, 2.0 * (n % 7) - 6, 4.0 * (n % 3) - 3};
    wanted.emplace_back(n, Vec{asked[0], asked[1], asked[2]});
    std::array<double, 3> by = asked;
    double farthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
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
