// Effects that act where a plain contact would not: curved sides beyond the gap, time steps below
// dtmin, ties that let go, pairs without a direction of friction, edges with widths for heat.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/small_deck.hpp"
#include "cycle/adapter/effect_inputs.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using test::Built;
using testing::Packet;
using testing::Pair;

/// A node `height` above the middle of a square of side 10 at z = 0.
Pair above(double height) {
  Pair p = testing::quad_pair({5, 5, height});
  p.k0 = 1000.0;
  p.m.fill(2.0);
  return p;
}

PacketResult evaluate_one(const ContactCard& card, const Pair& p, double dt1 = 1e-3,
                          Model model = Model::reference) {
  PacketResult r;
  const Packet packet({p});
  evaluate(make_plan(card, model), packet.view(dt1, dt1), r);
  return r;
}

TEST(CurvedSide, KeepsPairsBeyondTheGapThatDampAndRubWithoutPenetration) {
  ContactCard card;
  card.icurv = 1;
  card.curv_node1 = {5, 5, -100};  // far below: the node is outside the sphere's inner gap
  card.fric = 0.2;
  Pair p = above(3.0);
  p.v[0] = {0, 0, -4};
  for (const Model model : {Model::reference, Model::robust}) {
    const PacketResult r = evaluate_one(card, p, 1e-3, model);
    // kappa = 500, A = 2 kappa M, approached along -n: c = 0.05 sqrt(A) off the surface.
    EXPECT_EQ(r.penetration[0], 0.0);
    EXPECT_NEAR(std::abs(r.force[2][0]), 0.05 * std::sqrt(2 * 500.0 * 2.0) * 4.0, 1e-9);
    EXPECT_GE(r.k_nodal[0], 500.0);
    // A square of the reference gets nothing of it.
    const double taken = r.weights[0][0] + r.weights[1][0] + r.weights[2][0] + r.weights[3][0];
    EXPECT_NEAR(taken, model == Model::robust ? 1.0 : 0.0, 1e-15);
  }
  // Half the extent of 10 is the end of it.
  Pair far = above(6.01);
  far.v[0] = p.v[0];
  EXPECT_EQ(evaluate_one(card, far).k_nodal[0], 0.0);
  card.icurv = 0;
  EXPECT_EQ(evaluate_one(card, p).k_nodal[0], 0.0) << "without curvature a pair at 3 gaps is none";
}

TEST(StepDeletion, ANodalStepBelowDtminFlagsTheNodeAndKeepsTheForce) {
  ContactCard card;
  card.viss = 0.0;
  Pair p = above(0.5);
  const PacketResult free = evaluate_one(card, p);
  ASSERT_NE(free.force[2][0], 0.0);
  // 0.9 sqrt(2 m / S) of the secondary node; the corners have a quarter of the stiffness.
  const double step = 0.9 * std::sqrt(2.0 * 2.0 / free.k_nodal[0]);
  card.dtmin = 0.999 * step;
  EXPECT_EQ(evaluate_one(card, p).status[0] & status_step_deleted, 0);
  card.dtmin = 1.001 * step;
  const PacketResult flagged = evaluate_one(card, p);
  EXPECT_NE(flagged.status[0] & status_step_deleted, 0);
  EXPECT_EQ(flagged.force[2][0], free.force[2][0]);
  // Main nodes count too: a light corner.
  card.dtmin = 0.999 * step;
  p.m[3] = 0.1;
  EXPECT_NE(evaluate_one(card, p).status[0] & status_step_deleted, 0);
}

TEST(StepDeletion, AKinematicStepBelowDtminTakesTheForceAway) {
  ContactCard card;
  card.viss = 0.0;
  Pair p = above(0.5);
  p.v[0] = {0, 0, -10};
  card.dtmin = 1.001 * 0.5 * 0.5 / 10;
  p.m.fill(1e9);  // nodal steps are long
  const PacketResult r = evaluate_one(card, p);
  EXPECT_NE(r.status[0] & status_step_deleted, 0);
  EXPECT_EQ(r.force[2][0], 0.0);
}

TEST(TieOnTimeStep, LettingGoLeavesWeightsDepthAndSideAndStiffensOnceMore) {
  ContactCard card;
  card.itied = 1;
  card.dtmin = 1e-3;
  Pair p = above(2.0);
  p.tie = {-5.0, 1.0, 2.0, 0.3, 0.3, 0.2, 0.4, 0.6};
  const PacketResult r = evaluate_one(card, p);
  EXPECT_NE(r.status[0] & status_released, 0);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(r.force[c][0], 0.0);
    EXPECT_EQ(r.tie[c][0], 0.0);
  }
  for (std::size_t k = 3; k < 8; ++k) EXPECT_EQ(r.tie[k][0], p.tie[k]) << k;
  // phi_T = 1 without penetration: K0 / 2 + 2 C / dt1 with C = xi sqrt(K0 m).
  const double c = card.viss * std::sqrt(1000.0 * 2.0);
  EXPECT_NEAR(r.k_nodal[0], 500.0 + 2 * c / 1e-3, 1e-9 * r.k_nodal[0]);
  // A record without a tie is handed on until a new tie overwrites it.
  p.tie = {0, 0, 0, 0.3, 0.3, 0.2, 0.4, 0.6};
  const PacketResult later = evaluate_one(card, p);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(later.tie[k][0], p.tie[k]) << k;
}

TEST(DirectedFriction, PairsWithoutDirectionKeepTheirOwnLimit) {
  ContactCard card;
  card.viss = 0.0;
  card.iform = 2;
  card.fric_id = card.fric_orthotropic = true;
  Pair p = above(0.5);
  p.fric = 0.2;
  p.v[0] = {0, 1e6, 0};
  const Packet packet({p});
  PacketView view = packet.view(1e-3, 1e-3);
  const double isotropic = 0.0;
  view.directed = &isotropic;
  PacketResult r;
  evaluate(make_plan(card, Model::reference), view, r);
  EXPECT_NEAR(r.force[1][0], 0.2 * 500.0, 1e-9) << "not the 0.1 across the direction";
}

// --- widths of edges for heat

double width(const Built& b, Carrier rule, std::int64_t first, std::int64_t second) {
  Contact c;
  c.kind = deck::ContactKind::edge_edge;
  ContactEdge e;
  e.nodes = {b.model.nodes.map.find(first), b.model.nodes.map.find(second)};
  e.carrier = Carrier::none;
  ContactEdge last = e;
  last.carrier = rule;  // it rules for all edges of its side
  c.secondary_edges = {e, last};
  c.main_edges = {last};
  ContactPairs pairs;
  pairs.at = {{0, 0}};
  detail::edge_widths(b.scene, c, pairs);
  EXPECT_EQ(pairs.edge_width[0], pairs.edge_width[1]);
  return pairs.edge_width[0].at(0);
}

TEST(EdgeWidth, OnSolidsAreSumsOfSharesOfTheirFaces) {
  // A block of 2 by 3 by 5 and a wedge of the same sizes.
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 2, 0, 0).node(3, 2, 3, 0).node(4, 0, 3, 0);
  d.node(5, 0, 0, 5).node(6, 2, 0, 5).node(7, 2, 3, 5).node(8, 0, 3, 5);
  d.node(11, 50, 0, 0).node(12, 52, 0, 0).node(13, 50, 3, 0);
  d.node(15, 50, 0, 5).node(16, 52, 0, 5).node(17, 50, 3, 5);
  d.solid_part(1).brick(1, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  d.brick(1, 2, {11, 12, 13, 13, 15, 16, 17, 17});
  const Built b(d);
  const auto at = [&](int first, int second) { return width(b, Carrier::solid, first, second); };
  // Faces of 6, 10 and 15; a quarter of each to each of its corners.
  EXPECT_DOUBLE_EQ(at(1, 2), 2 * (6 + 15 + 10) / 4.0);
  EXPECT_DOUBLE_EQ(at(3, 2), (6 + 10 + 15 + 10) / 4.0);
  EXPECT_DOUBLE_EQ(at(6, 2), (6 + 10) / 4.0);
  for (const auto& [first, second] :
       {std::pair(2, 1), std::pair(4, 3), std::pair(5, 6), std::pair(8, 2)})
    EXPECT_EQ(at(first, second), 0) << first;
  // The front of the wedge is a triangle of area 3, a third of it each.
  EXPECT_DOUBLE_EQ(at(11, 12), 2 * (1 + 15 / 4.0 + 10 / 4.0));
}

TEST(EdgeWidth, IsHalfTheRootOfTheSharesOfItsShellsAndTheirHalfThicknessAtABorder) {
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 8, 0).node(4, 0, 8, 0).node(5, 16, 0, 0);
  d.shell_part(1, 1.5).shell(1, 1, 1, 2, 3, 4).shell3(1, 2, 2, 5, 3);
  const Built b(d);
  const auto at = [&](int first, int second) { return width(b, Carrier::shell4, first, second); };
  EXPECT_DOUBLE_EQ(at(1, 2), 0.5 * std::sqrt(80 / 4.0) + 0.75);
  EXPECT_DOUBLE_EQ(at(5, 3), 0.5 * std::sqrt(24 / 3.0) + 0.75);
  EXPECT_DOUBLE_EQ(at(2, 3), 0.5 * std::sqrt(80 / 4.0 + 24 / 3.0));
  EXPECT_EQ(width(b, Carrier::shell3, 2, 3), at(2, 3));
  EXPECT_EQ(at(1, 5), 0);
}

TEST(EdgeWidth, OnLinesIsTheRootOfTheMeanSectionAtTheirEnds) {
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 20, 0, 0).node(4, 0, 9, 0);
  d.node(11, 0, 50, 0).node(12, 10, 50, 0).node(13, 20, 50, 0);
  d.truss_part(1, 4).truss_part(2, 9).beam_part(3, 16).beam_part(4, 25);
  d.bar("TRUSS", 1, 1, 1, 2).bar("TRUSS", 2, 2, 2, 3);
  d.bar("BEAM", 3, 3, 11, 12, 4).bar("BEAM", 4, 4, 12, 13, 4);
  const Built b(d);
  // Sections of 2 and 3, of 4 and 5: the one in the middle has both elements.
  EXPECT_DOUBLE_EQ(width(b, Carrier::truss, 1, 2), std::sqrt((2 + 2 + 3) / 3.0));
  EXPECT_DOUBLE_EQ(width(b, Carrier::truss, 2, 3), std::sqrt((2 + 3 + 3) / 3.0));
  EXPECT_DOUBLE_EQ(width(b, Carrier::beam, 11, 12), std::sqrt((4 + 4 + 5) / 3.0));
  EXPECT_EQ(width(b, Carrier::truss, 11, 12), 0);
}

}  // namespace
}  // namespace deck::cycle
