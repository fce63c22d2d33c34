// Effects that act where a plain contact would not: curved sides beyond the gap, time steps below
// dtmin, ties that let go, friction by direction, edges that exchange heat through widths.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/small_deck.hpp"
#include "cycle/adapter/parts.hpp"
#include "cycle/shared/heat.hpp"
#include "cycle/support.hpp"
#include "deck/cycle/scene_cycle.hpp"
#include "replay/replay.hpp"

namespace deck::cycle {
namespace {

using testing::Packet;
using testing::Pair;
using testing::Vec;

/// A node `height` above the middle of a square of side 10 at z = 0.
Pair above(double height, double side = 10.0) {
  Pair p;
  const double s = side;
  p.x = {Vec{s / 2, s / 2, height}, Vec{0, 0, 0}, Vec{s, 0, 0}, Vec{s, s, 0}, Vec{0, s, 0}};
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
  card.viss = 0.05;
  card.visf = 1.0;
  card.fric = 0.2;
  Pair p = above(3.0);
  p.v[0] = {0, 0, -4};
  const PacketResult r = evaluate_one(card, p);
  // kappa = 500, A = 2 kappa M, approached along -n: c = 0.05 sqrt(A) off the surface.
  EXPECT_EQ(r.penetration[0], 0.0);
  const double speed = 4.0, a = 2 * 500.0 * 2.0;
  const double expected = 0.05 * std::sqrt(a) * speed;
  EXPECT_NEAR(std::abs(r.force[2][0]), expected, 1e-9 * expected);
  EXPECT_GE(r.k_nodal[0], 500.0);
  for (const auto& h : r.weights) EXPECT_EQ(h[0], 0.0) << "a square gets nothing of it";
  // Half the extent of 10 is the end of it.
  Pair far = above(6.01);
  far.v[0] = p.v[0];
  EXPECT_EQ(evaluate_one(card, far).k_nodal[0], 0.0);
  // Without curvature a pair at 3 gaps is none.
  card.icurv = 0;
  EXPECT_EQ(evaluate_one(card, p).k_nodal[0], 0.0);
}

TEST(CurvedSide, DampsBeyondTheGapInTheRobustModelTooAndTheMainSideTakesIt) {
  ContactCard card;
  card.icurv = 1;
  card.curv_node1 = {5, 5, -100};
  Pair p = above(3.0);
  p.v[0] = {0, 0, -4};
  const PacketResult r = evaluate_one(card, p, 1e-3, Model::robust);
  EXPECT_EQ(r.penetration[0], 0.0);
  EXPECT_NEAR(std::abs(r.force[2][0]), 0.05 * std::sqrt(2 * 500.0 * 2.0) * 4.0, 1e-9);
  EXPECT_NEAR(r.weights[0][0] + r.weights[1][0] + r.weights[2][0] + r.weights[3][0], 1.0, 1e-15);
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

TEST(DirectedFriction, SlidingIsPushedAlongInTheViscousForm) {
  ContactCard card;
  card.viss = 0.0;
  card.fric_id = card.fric_orthotropic = true;
  Pair p = above(0.5);
  p.fric = 0.3;
  p.v[0] = {1e4, 0, 0};
  const PacketResult viscous = evaluate_one(card, p);
  // |Fn| = 500, mu 0.3 along x: the main side is dragged against the motion of the node.
  EXPECT_NEAR(viscous.force[0][0], -0.3 * 500.0, 1e-9);
  card.iform = 2;
  EXPECT_NEAR(evaluate_one(card, p).force[0][0], 0.3 * 500.0, 1e-9);
  card.iform = 1;
  EXPECT_NEAR(evaluate_one(card, p, 1e-3, Model::robust).force[0][0], -0.3 * 500.0, 1e-9);
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

TEST(EdgeWidth, IsHalfTheRootOfTheSharesOfItsShellsAndTheirHalfThicknessAtABorder) {
  deck::test::SmallDeck d;
  // Two squares of side 4 with a common edge (a border on the other sides), across them a bar.
  d.node(1, 0, 0, 0).node(2, 4, 0, 0).node(3, 4, 4, 0).node(4, 0, 4, 0);
  d.node(5, 8, 0, 0).node(6, 8, 4, 0).node(7, 2, 2, 0.5).node(8, 6, 2.5, 0.5);
  d.shell_part(1, 0.6).truss_part(2, 0.25);
  d.shell(1, 1, 1, 2, 3, 4).shell(2, 1, 2, 5, 6, 3).bar("TRUSS", 2, 9, 7, 8);
  d.segments("/LINE/SEG/1", {{2, 3}}).segments("/LINE/SEG/2", {{7, 8}});
  d.add(
      "/HEAT/MAT/1\n               300.0                 1.0                 2.0                 "
      "0.0");
  d.add("@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1 Ithe=1 Kthe=0.5");
  const deck::test::Built b(d);
  ContactPairs pairs;
  pairs.at.push_back({0, 0});
  detail::edge_widths(b.scene, b.scene.contacts.at(0), pairs);
  EXPECT_NEAR(pairs.edge_width[0].at(0), 0.5 * std::sqrt(16.0 / 4 + 16.0 / 4), 1e-14);
  // Trusses: the root of the mean of sqrt(area) at both ends.
  EXPECT_NEAR(pairs.edge_width[1].at(0), std::sqrt(0.5), 1e-14);
}

/// Two plates 0.6 apart, the upper one (part 2) of a material with conductivity 2 + 0.01 T.
deck::test::SmallDeck plates() {
  deck::test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 1, 5, 0.6).node(12, 5, 1, 0.6).node(13, 9, 5, 0.6).node(14, 5, 9, 0.6);
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  d.shell(1, 1, 1, 2, 3, 4).shell(2, 2, 11, 12, 13, 14);
  d.add(
      "/HEAT/MAT/1\n               300.0                 1.0                 2.0"
      "                0.01");
  d.group("/GRNOD/PART/1", {2}).group("/SURF/PART/2", {1});
  return d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Ithe=1 Kthe=0.5 Tint=500");
}

TEST(ReplayOfHeat, GapResistanceTakesTheConductivityOfTheSecondaryNodesShellFromTheDeck) {
  const deck::test::Built b(plates());
  // The node stands on the side where the gap counts: N = (x1-x3) x (x2-x4) points up, so below.
  const std::string csv =
      "cycle,interface,node,n1,n2,n3,n4,dt1,xs_x,xs_y,xs_z,x1_x,x1_y,x1_z,x2_x,x2_y,x2_z,x3_x,x3_y,"
      "x3_z,x4_x,x4_y,x4_z,Ts,T1,T2,T3,T4,area_s,Fn,E_fric,gap,H1,H2,H3,H4,Q_s,Q_1,Q_2,Q_3,Q_4\n"
      "0,1,11,1,2,3,4,1e-3,5,5,-0.6,0,0,0,10,0,0,10,10,0,0,10,0,400,0,0,0,0,8,-1,0,1,"
      "0.25,0.25,0.25,0.25,0,0,0,0,0\n";
  ReplayOptions options;
  options.csv = true;
  const ContactCard card = make_card(b.scene, b.scene.contacts.at(0));
  const auto heat = [&](const Scene* scene) {
    options.scene = scene;
    const ReplayReport r = replay(card, csv, options);
    EXPECT_EQ(r.error, "");
    const std::string line = r.csv.substr(r.csv.find('\n') + 1);
    return std::stod(line.substr(line.find(',') + 1));
  };
  const double area = 8.0, rise = 100.0, dt = 1e-3;
  EXPECT_NEAR(heat(&b.scene), area * rise * dt / (0.6 / (2 + 0.01 * 400) + 1 / 0.5), 1e-14);
  EXPECT_NEAR(heat(nullptr), area * rise * dt * 0.5, 1e-14) << "nothing known of the material";
}

TEST(EdgeHeat, KnowsNoThermalSpeedUp) {
  ContactCard card;
  card.kind = ContactKind::edge_edge;
  card.ithe = 1;
  card.kthe = 0.5;
  card.tint = 400.0;
  EdgeHeatState s;
  s.position = {{{0, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 0, 1}}};
  s.temperature.fill(300.0);
  s.weight = {0.5, 0.5, 0.5, 0.5};
  s.conductivity.fill(2.0);
  s.width = {1.0, 1.0};
  s.distance = 0.5;
  s.gap = 1.0;
  s.effective_gap = 0.9;
  s.dt1 = 1e-3;
  const HeatFlow slow = pair_heat(card, s);
  card.thermal_speed_up = 100.0;
  const HeatFlow fast = pair_heat(card, s);
  EXPECT_GT(slow.q[0], 0.0);
  EXPECT_EQ(fast.q[0], slow.q[0]);
  EXPECT_EQ(fast.conductance, slow.conductance);
}

}  // namespace
}  // namespace deck::cycle
