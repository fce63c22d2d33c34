// Views of a scene: names, one row per node, part pairs, totals.
#include <gtest/gtest.h>

#include "contact/published.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

/// A floor of two quads (part 1) and a lid of one (part 2) above it, some corners nearer.
SmallDeck floor_and_lid() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 20, 0, 0);
  d.node(4, 0, 10, 0).node(5, 10, 10, 0).node(6, 20, 10, 0);
  d.node(11, 4, 4, 0.5).node(12, 10, 4, 0.25).node(13, 10, 8, 0.75).node(14, 4, 8, 5);
  d.node(21, 5, 5, 0.625);
  d.shell_part(1, 2).shell_part(2, 2);
  d.shell(1, 7, 1, 2, 5, 4).shell(1, 8, 2, 3, 6, 5).shell(2, 9, 11, 12, 13, 14);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {11, 12, 13, 14, 21});
  return d.add("@/INTER/TYPE7/1 Gapmin=1");
}

TEST(SceneView, ListsTheDeepestFirstWithNamesAndOneRowPerNode) {
  const Built b(floor_and_lid());
  const SceneView v = make_view(b.scene);
  std::vector<std::int64_t> nodes, deepest;
  for (const NamedPenetration& p : v.penetrations) nodes.push_back(p.secondary[0]);
  for (const std::uint32_t i : v.deepest_per_node) deepest.push_back(nodes[i]);
  // 12 and 13 stand over the common edge and meet both quads.
  EXPECT_EQ(nodes, (std::vector<std::int64_t>{12, 12, 11, 21, 13, 13}));
  EXPECT_EQ(deepest, (std::vector<std::int64_t>{12, 11, 21, 13}));
  EXPECT_EQ(v.penetrations[0].secondary_element.id, 9);
  EXPECT_EQ(v.penetrations[0].main_element.id, 7);
  EXPECT_EQ(v.penetrations[1].main_element.id, 8);
  EXPECT_FALSE(v.penetrations[3].secondary_element.valid()) << "node 21 is on no element";
  EXPECT_EQ(v.penetrations[2].at, (std::array<double, 3>{4, 4, 0.5}));
}

// A list of edges can have an edge twice, also the other way round.
TEST(SceneView, AnEdgeThatIsListedTwiceIsOneRow) {
  Built b(published_edges().add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1"));
  const SceneView view = make_view(b.scene);
  const NamedPenetration& deepest = view.penetrations[0];
  EXPECT_EQ(deepest.secondary, (std::array<std::int64_t, 2>{11, 12}));
  EXPECT_EQ(deepest.main, (std::array<std::int64_t, 4>{1, 2, 0, 0}));
  EXPECT_EQ(std::tuple(deepest.secondary_element.id, deepest.main_element.id), std::tuple(2, 1));
  EXPECT_EQ(view.total.count.nodes, 0u) << "an edge is no node";
  const std::size_t once = view.deepest_per_node.size();
  Contact& c = b.scene.contacts.at(0);
  PenetrationRow row = c.penetrations.at(0);
  ContactEdge edge = c.secondary_edges[row.secondary];
  std::swap(edge.nodes[0], edge.nodes[1]);
  row.secondary = static_cast<std::uint32_t>(c.secondary_edges.size());
  c.secondary_edges.push_back(edge);
  c.penetrations.push_back(row);
  EXPECT_EQ(make_view(b.scene).deepest_per_node.size(), once);
}

TEST(SceneView, PartPairsAndTotals) {
  const Built b(floor_and_lid());
  const SceneView v = make_view(b.scene);
  ASSERT_EQ(v.part_pairs.size(), 2u);
  const PartPair& lid = v.part_pairs[0];
  EXPECT_EQ(std::tuple(lid.secondary, lid.main, lid.count.pairs, lid.count.nodes, lid.count.edges),
            std::tuple(2, 1, 5u, 3u, 0u));
  EXPECT_DOUBLE_EQ(lid.max_depth, 0.75);
  EXPECT_DOUBLE_EQ(lid.mean_depth, (0.75 + 0.75 + 0.5 + 0.25 + 0.25) / 5);
  EXPECT_DOUBLE_EQ(lid.p95_depth, 0.75);
  EXPECT_EQ(v.part_pairs[1].secondary, 0) << "no part";
  EXPECT_EQ(v.total.count.pairs, 6u);
  EXPECT_EQ(v.total.count.nodes, 4u);
}

TEST(SceneView, SolverErrorsAreNodesOnSegmentsOfCardsThatStop) {
  SmallDeck d = floor_and_lid();
  d.node(31, 10, 5, 0).group("/GRNOD/NODE/3", {31});  // on the edge of both quads
  d.add("@/INTER/TYPE7/2 grnd_IDs=3 Gapmin=1");
  d.add("@/INTER/TYPE7/3 grnd_IDs=3 Gapmin=1 Inacti=1");
  const Built b(d);
  const SceneView v = make_view(b.scene);
  EXPECT_EQ(v.contacts[1].solver_errors, 1u);
  EXPECT_EQ(v.contacts[2].on_segment.nodes, 1u);
  EXPECT_EQ(v.contacts[2].solver_errors, 0u);
  EXPECT_EQ(v.contacts[2].acted, 2u);
  EXPECT_EQ(v.contacts[1].on_segment.pairs, 2u);
  EXPECT_EQ(v.total.on_segment.pairs, 4u);
  EXPECT_EQ(v.total.on_segment.nodes, 1u) << "one node, in two contacts";
  EXPECT_EQ(v.total.solver_errors, 1u);
}

}  // namespace
}  // namespace deck::test
