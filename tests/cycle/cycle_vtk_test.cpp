// VTK files of the force stage, read back by VTK itself and compared value by value.
#include <gtest/gtest.h>

#include "contact/small_deck.hpp"
#include "report/shared/cycle.hpp"
#include "report/vtk_reading.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;
using nlohmann::json;

/// Nodes over a plate, one of them free; two trusses that cross.
SmallDeck small_scene() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 1, 5, 0.6).node(12, 5, 1, 0.6).node(13, 9, 5, 0.6).node(14, 5, 9, 0.6);
  d.node(20, 3, 3, 0.5);
  d.node(201, -1, 0, 50).node(202, 1, 0, 50).node(203, 0, -1, 50.5).node(204, 0, 1, 50.5);
  d.shell_part(1, 1.0).shell_part(2, 1.0).truss_part(3, 0.09);
  d.shell(1, 7, 1, 2, 3, 4).shell(2, 8, 11, 12, 13, 14);
  d.bar("TRUSS", 3, 9, 201, 202).bar("TRUSS", 3, 10, 203, 204);
  d.group("/GRNOD/NODE/1", {11, 12, 13, 14, 20}).group("/SURF/PART/2", {1});
  d.segments("/LINE/SEG/1", {{201, 202}}).segments("/LINE/SEG/2", {{203, 204}});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1");
  return d.add("@/INTER/TYPE11/2 line_IDs=1 line_IDm=2 Gapmin=1");
}

struct Evaluated {
  Evaluated() {
    CycleOptions o;
    o.keep_pairs = true;
    outcome = run_cycle(built.scene, state, o);
    CycleInput i;
    i.deck = &built.deck;
    i.scene = &built.scene;
    i.state = &state;
    i.outcome = &outcome;
    read = deck::test::read_with_vtk(cycle_vtk(i));
  }
  Built built{small_scene()};
  State state = make_state(built.scene);
  SceneOutcome outcome;
  json read;  ///< null: there is no VTK
};

TEST(CycleVtk, PairsReadByVtk) {
  const Evaluated e;
  if (e.read.is_null()) GTEST_SKIP() << "no python3 with VTK (Debian: python3-vtk9)";
  const json& file = e.read["contact_pairs.vtp"];
  const json& data = file["point"];
  std::size_t i = 0;
  for (const ContactOutcome& c : e.outcome.contacts)
    for (const PairOutcome& p : c.pairs) {
      EXPECT_EQ(file["types"][i], 1) << "VTK_VERTEX";
      EXPECT_EQ(data["force"][i], json({-p.force[0], -p.force[1], -p.force[2]}));
      EXPECT_EQ(data["penetration"][i][0], p.penetration);
      EXPECT_EQ(data["left_of_gap"][i][0], (p.gap - p.penetration) / p.gap);
      const bool edges = c.card.kind == ContactKind::edge_edge;
      EXPECT_EQ(data["main_element"][i][0], edges ? 10 : 7);
      if (edges) {
        EXPECT_EQ(file["points"][i], json({0.0, 0.0, 50.0})) << "the point of contact";
        EXPECT_EQ(data["node"][i][0], 201);
        EXPECT_EQ(data["node2"][i][0], 202);
      } else {
        const NodeIndex n = c.contact->secondary[p.at.secondary].node;
        EXPECT_EQ(data["node"][i][0], e.built.model.node_id(n));
        EXPECT_EQ(file["points"][i], json({e.built.model.nodes.x[n], e.built.model.nodes.y[n],
                                           e.built.model.nodes.z[n]}));
      }
      ++i;
    }
  EXPECT_EQ(i, 6u) << "five nodes and one pair of edges";
  EXPECT_EQ(file["points"].size(), i);
}

TEST(CycleVtk, NodesReadByVtk) {
  const Evaluated e;
  if (e.read.is_null()) GTEST_SKIP() << "no python3 with VTK (Debian: python3-vtk9)";
  const json& file = e.read["contact_nodes.vtp"];
  const json& data = file["point"];
  ASSERT_EQ(file["points"].size(), 13u) << "every node of this deck takes part";
  for (std::size_t i = 0; i < file["points"].size(); ++i) {
    const NodeIndex n = e.built.model.find_node(data["node"][i][0].get<std::int64_t>());
    const NodalSums& s = e.outcome.nodes;
    EXPECT_EQ(data["force"][i], json({s.force[0][n], s.force[1][n], s.force[2][n]}));
    const double m = e.state.mass[n], f = data["force_size"][i][0];
    EXPECT_EQ(data["acceleration"][i][0], m > 0 ? f / m : 0.0);
    if (m == 0) {
      EXPECT_EQ(data["node"][i][0], 20) << "the only node without an element";
      EXPECT_EQ(data["dt"][i][0], 0.0);
    }
  }
}

}  // namespace
}  // namespace deck::cycle
