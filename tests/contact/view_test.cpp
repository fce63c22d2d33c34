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

TEST(SceneView, DeepestFirstWithNames) {
  const Built b(floor_and_lid());
  const SceneView v = make_view(b.scene);
  // 12 and 13 stand over the common edge and meet both quads.
  ASSERT_EQ(v.penetrations.size(), 6u);
  EXPECT_EQ(v.penetrations[0].secondary[0], 12);
  EXPECT_EQ(v.penetrations[1].secondary[0], 12);
  EXPECT_EQ(v.penetrations[2].secondary[0], 11);
  EXPECT_EQ(v.penetrations[3].secondary[0], 21);
  EXPECT_EQ(v.penetrations[0].secondary_element.id, 9);
  EXPECT_EQ(v.penetrations[0].secondary_element.part, 2);
  EXPECT_EQ(v.penetrations[0].main_element.id, 7);
  EXPECT_EQ(v.penetrations[1].main_element.id, 8);
  EXPECT_FALSE(v.penetrations[3].secondary_element.valid()) << "node 21 is on no element";
  EXPECT_EQ(v.penetrations[2].at, (std::array<double, 3>{4, 4, 0.5}));
}

TEST(SceneView, OneRowPerNodeIsTheDeepest) {
  const Built b(floor_and_lid());
  const SceneView v = make_view(b.scene);
  std::vector<std::int64_t> nodes;
  for (const std::uint32_t i : v.deepest_per_node) nodes.push_back(v.penetrations[i].secondary[0]);
  EXPECT_EQ(nodes, (std::vector<std::int64_t>{12, 11, 21, 13}));
}

// A list of edges can have an edge twice, also the other way round.
TEST(SceneView, AnEdgeThatIsListedTwiceIsOneRow) {
  Built b(published_edges().add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1"));
  const std::size_t once = make_view(b.scene).deepest_per_node.size();
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
  EXPECT_EQ(lid.secondary, 2);
  EXPECT_EQ(lid.main, 1);
  EXPECT_EQ(lid.count.pairs, 5u);
  EXPECT_EQ(lid.count.nodes, 3u);
  EXPECT_EQ(lid.count.edges, 0u);
  EXPECT_DOUBLE_EQ(lid.max_depth, 0.75);
  EXPECT_DOUBLE_EQ(lid.mean_depth, (0.75 + 0.75 + 0.5 + 0.25 + 0.25) / 5);
  EXPECT_DOUBLE_EQ(lid.p95_depth, 0.75);
  EXPECT_DOUBLE_EQ(lid.max_ratio, 0.75);
  EXPECT_EQ(v.part_pairs[1].secondary, 0) << "no part";
  EXPECT_EQ(v.total.count.pairs, 6u);
  EXPECT_EQ(v.total.count.nodes, 4u);
  EXPECT_EQ(v.total.on_segment.pairs, 0u);
  EXPECT_EQ(v.total.acted, 0u);
  EXPECT_DOUBLE_EQ(v.total.max_depth, 0.75);
}

TEST(SceneView, SolverErrorsAreNodesOnSegmentsOfCardsThatStop) {
  SmallDeck d = floor_and_lid();
  d.node(31, 3, 3, 0).group("/GRNOD/NODE/3", {31});
  d.add("@/INTER/TYPE7/2 grnd_IDs=3 Gapmin=1");
  d.add("@/INTER/TYPE7/3 grnd_IDs=3 Gapmin=1 Inacti=1");
  const Built b(d);
  const SceneView v = make_view(b.scene);
  EXPECT_EQ(v.contacts[1].solver_errors, 1u);
  EXPECT_EQ(v.contacts[2].on_segment.nodes, 1u);
  EXPECT_EQ(v.contacts[2].solver_errors, 0u);
  EXPECT_EQ(v.contacts[2].acted, 1u);
  EXPECT_EQ(v.total.on_segment.pairs, 2u);
  EXPECT_EQ(v.total.on_segment.nodes, 1u) << "one node, in two contacts";
  EXPECT_EQ(v.total.solver_errors, 1u);
}

TEST(SceneView, ANodeOnACommonEdgeIsOneNodeInTwoPairs) {
  SmallDeck d = floor_and_lid();
  d.node(31, 10, 5, 0).group("/GRNOD/NODE/3", {31});
  d.add("@/INTER/TYPE7/2 grnd_IDs=3 Gapmin=1");
  const Built b(d);
  const ContactTotals t = make_view(b.scene).contacts[1];
  EXPECT_EQ(t.on_segment.pairs, 2u);
  EXPECT_EQ(t.on_segment.nodes, 1u);
  EXPECT_EQ(t.solver_errors, 1u);
  EXPECT_EQ(t.count.nodes, 1u);
}

TEST(SceneView, EdgePairsAreNamedByTheirElements) {
  SmallDeck d;
  d.node(1, -1, 0, 0).node(2, 1, 0, 0).node(3, 0, -1, 0.5).node(4, 0, 1, 0.5);
  d.truss_part(1, 1).truss_part(2, 1).bar("TRUSS", 1, 5, 1, 2).bar("TRUSS", 2, 6, 3, 4);
  d.segments("/LINE/SEG/1", {{1, 2}}).segments("/LINE/SEG/2", {{3, 4}});
  const Built b(d.add("@/INTER/TYPE11/1 Gapmin=1"));
  const SceneView v = make_view(b.scene);
  ASSERT_EQ(v.penetrations.size(), 1u);
  const NamedPenetration& p = v.penetrations[0];
  EXPECT_EQ(p.secondary, (std::array<std::int64_t, 2>{3, 4}));
  EXPECT_EQ(p.main, (std::array<std::int64_t, 4>{1, 2, 0, 0}));
  EXPECT_EQ(p.secondary_element.id, 6);
  EXPECT_EQ(p.main_element.part, 1);
  EXPECT_EQ(p.at, (std::array<double, 3>{0, 0, 0.5}));
  EXPECT_EQ(v.total.count.edges, 1u);
  EXPECT_EQ(v.total.count.nodes, 0u) << "an edge is no node";
}

}  // namespace
}  // namespace deck::test
