// Nodes over shared edges and corners are pushed once, by the right segment, without jumps.
#include "cycle/shared/contact_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "contact/small_deck.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using namespace testing;

/// Quads by corner numbers over a list of points; one node above.
struct Surface {
  std::vector<Vec> points;
  std::vector<std::array<std::uint32_t, 4>> quads;

  struct Push {
    Vec force{};  ///< on the node
    double stiffness = 0.0, energy = 0.0;
    std::size_t contacts = 0;
  };
  Push push(const Vec& node, Model model = Model::robust) const {
    std::vector<Pair> pairs;
    PairList list;
    for (const auto& q : quads) {
      Pair p;
      p.x = {node, points[q[0]], points[q[1]], points[q[2]], points[q[3]]};
      p.triangle = q[2] == q[3];
      p.k0 = 1e5;
      p.gap = 1.0;
      pairs.push_back(p);
      list.node[0].push_back(1000);
      for (std::size_t c = 0; c < 4; ++c) list.node[c + 1].push_back(q[c]);
    }
    const Packet packet(pairs);
    PacketResult r;
    evaluate(make_plan(testing::elastic_card(), model), packet.view(), r);
    if (model == Model::robust) apply_shares(pair_shares(list, r), r);
    Push out;
    for (std::size_t i = 0; i < r.size; ++i) {
      out.force = out.force + Vec{-r.force[0][i], -r.force[1][i], -r.force[2][i]};
      out.stiffness += r.k_nodal[i];
      out.energy += r.elastic_energy[i];
      out.contacts += (r.status[i] & status_contact) != 0;
    }
    return out;
  }
};

/// 3 by 3 squares of side 10 in z = 0, some cut into triangles.
Surface flat_mesh(bool triangles) {
  Surface s;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) s.points.push_back({10.0 * i, 10.0 * j, 0});
  for (std::uint32_t j = 0; j < 3; ++j)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = 4 * j + i;
      if (triangles && (i + j) % 2 == 0) {
        s.quads.push_back({a, a + 1, a + 5, a + 5});
        s.quads.push_back({a, a + 5, a + 4, a + 4});
      } else {
        s.quads.push_back({a, a + 1, a + 5, a + 4});
      }
    }
  return s;
}

TEST(SharedEdges, ANodeOverAFlatMeshIsPushedOnceWhereverItIs) {
  for (const bool triangles : {false, true}) {
    const Surface s = flat_mesh(triangles);
    std::vector<Vec> nodes = {{10, 5, .4},  {9.7, 5, .4}, {10, 10, .4},     {10.2, 9.9, .4},
                              {15, 10, .4}, {5, 5, .4},   {10, 1.0 / 3, .4}};
    std::mt19937_64 rng(5);
    std::uniform_real_distribution<double> u(5.0, 25.0);
    for (int i = 0; i < 300; ++i) nodes.push_back({u(rng), u(rng), 0.4});
    for (int i = 0; i < 100; ++i) nodes.push_back({20, u(rng), 0.4});
    for (const Vec& node : nodes) {
      const Surface::Push p = s.push(node);
      // kappa 5e4, gap 1, penetration 0.6: the single force of the worked vectors.
      EXPECT_NEAR(p.force[0], 0.0, 1e-9) << node[0] << " " << node[1];
      EXPECT_NEAR(p.force[1], 0.0, 1e-9) << node[0] << " " << node[1];
      EXPECT_NEAR(p.force[2], 75000.0, 1e-8) << node[0] << " " << node[1];
      EXPECT_NEAR(p.stiffness, 5e4 / 0.16, 1e-8);
    }
  }
}

/// Two squares that meet in the edge x = 0, both falling off by `slope` on either side.
Surface roof(double slope) {
  const double c = 10 * std::cos(slope), z = -10 * std::sin(slope);
  return {{{0, -5, 0}, {0, 5, 0}, {-c, 5, z}, {-c, -5, z}, {c, -5, z}, {c, 5, z}},
          {{0, 1, 2, 3}, {0, 4, 5, 1}}};
}

TEST(SharedEdges, OverAConvexEdgeTheForceTurnsWithoutAJump) {
  const Surface s = roof(0.5);
  Vec last{};
  double most = 0.0;
  const int steps = 4000;
  // Half a circle of radius 0.5 around the edge: the distance is 0.5 in the wedge between both
  // normals, and smaller beyond it.
  for (int i = 0; i <= steps; ++i) {
    const double a = std::numbers::pi * (0.25 + 0.5 * i / steps);
    const Surface::Push p = s.push({0.5 * std::cos(a), 0.3, 0.5 * std::sin(a)});
    if (i > 0) {
      Vec jump = p.force + (-1.0) * last;
      most = std::max(most, testing::norm(jump));
    }
    EXPECT_GE(p.contacts, 1u);
    last = p.force;
  }
  // F is 5e4 in the wedge; it turns by pi/2 over all steps and grows a little beyond.
  EXPECT_LT(most, 2.5e5 * (std::numbers::pi / 2) / steps);
}

TEST(SharedEdges, InASharpValleyBothSidesPush) {
  const Surface s = roof(-std::numbers::pi / 4);  // a groove of 90 degrees
  const Surface::Push p = s.push({0, 0.3, 0.5 * std::sqrt(2.0)});
  EXPECT_EQ(p.contacts, 2u);
  EXPECT_NEAR(p.force[2], 2 * 5e4 * std::sqrt(0.5), 1e-6);  // each 5e4 at 45 degrees
  EXPECT_NEAR(p.force[0], 0.0, 1e-8);
}

TEST(SharedEdges, APairSwitchedOffClaimsNothing) {
  // Two squares side by side; the one under the node has no stiffness.
  std::vector<Pair> pairs(2);
  PairList list;
  for (std::uint32_t q = 0; q < 2; ++q) {
    const double x = 10.0 * q;
    pairs[q].x = {Vec{9.7, 5, .4}, Vec{x, 0, 0}, Vec{x + 10, 0, 0}, Vec{x + 10, 10, 0},
                  Vec{x, 10, 0}};
    pairs[q].k0 = q == 0 ? 0.0 : 1e5;
    const std::uint32_t n[] = {100, q, q + 1, q + 11, q + 10};
    for (std::size_t r = 0; r < 5; ++r) list.node[r].push_back(n[r]);
  }
  PacketResult r;
  const Packet packet(pairs);
  evaluate(make_plan(testing::elastic_card(), Model::robust), packet.view(), r);
  EXPECT_EQ(pair_shares(list, r), (std::vector<double>{1.0, 1.0}));
}

TEST(SharedEdges, EdgesThatMeetAtANodeShareTheirForce) {
  // A polyline of two secondary edges over a main edge that passes below their common node, and
  // one below the first edge.
  const auto shares = [](double x) {
    std::vector<Pair> pairs(2);
    PairList list;
    list.kind = ContactKind::edge_edge;
    for (std::uint32_t e = 0; e < 2; ++e) {
      pairs[e].x = {Vec{-10.0 + 10 * e, 0, 0.5}, Vec{10.0 * e, 0, 0.5}, Vec{x, -5, 0}, Vec{x, 5, 0},
                    Vec{}};
      pairs[e].k0 = 1e5;
      const std::uint32_t n[] = {e, e + 1, 10, 11};
      for (std::size_t r = 0; r < 4; ++r) list.node[r].push_back(n[r]);
    }
    ContactCard card = testing::elastic_card();
    card.kind = ContactKind::edge_edge;
    const Packet packet(pairs);
    PacketResult r;
    evaluate(make_plan(card, Model::robust), packet.view(), r);
    return pair_shares(list, r);
  };
  EXPECT_EQ(shares(0.0), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(shares(-0.2), (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(shares(0.2), (std::vector<double>{0.0, 1.0}));
}

TEST(SharedEdges, OfADeckCountOnceInTheRobustModel) {
  deck::test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 20, 0, 0).node(6, 20, 10, 0).node(11, 10, 5, 0.6).node(12, 9.9, 2, 0.6);
  d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
  d.group("/GRNOD/NODE/1", {11, 12}).group("/SURF/PART/2", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1");
  const deck::test::Built b(d);
  CycleOptions options;
  const SceneOutcome once = run_cycle(b.scene, make_state(b.scene), options);
  const double single = 100.0 * 0.4 / 0.6;
  EXPECT_NEAR(once.contacts.at(0).totals.normal_abs, 2 * single, 1e-10);
  options.model = Model::reference;
  const SceneOutcome twice = run_cycle(b.scene, make_state(b.scene), options);
  EXPECT_GT(twice.contacts.at(0).totals.normal_abs, 3.5 * single);
}

}  // namespace
}  // namespace deck::cycle
