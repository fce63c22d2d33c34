// Values of pairs by hand: normals of corners, criteria of adaptive meshing, the time step of a
// pair, ties by the time step, friction by directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/small_deck.hpp"
#include "cycle/kernel/effects.hpp"
#include "cycle/plates.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using test::Built;
using testing::Pair;
using testing::Vec;

// --- values of pairs

TEST(PairValues, OfQuadsAndTrianglesWithTheirNormals) {
  // A quad of 10 by 10 in z = 0 and a triangle beside it that rises.
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 16, 0, 8);
  d.node(11, 5, 5, 0.5).node(12, 12, 3, 3);
  d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4).shell3(1, 2, 2, 5, 3);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}, {2, 5, 3, 3}}).group("/GRNOD/NODE/2", {11, 12});
  d.add("@/INTER/TYPE7/1 Gapmin=1");
  const Built b(d);
  ContactCard card = make_card(b.scene, b.contact());
  PairSearch all;
  all.margin = 100;
  const auto found = [&](int icurv, int iadm) {
    card.icurv = icurv;
    card.iadm = iadm;
    return make_pairs(b.scene, b.contact(), card, Model::reference, 1, all);
  };
  const ContactPairs p = found(0, 0);
  ASSERT_EQ(p.size(), 4u);
  EXPECT_TRUE(p.normal[0][0].empty());
  const auto id = [&](std::size_t role, std::size_t k) {
    return b.model.node_id(p.nodes.node[role][k]);
  };
  const std::array<int, 5> nodes[] = {
      {11, 1, 2, 3, 4}, {11, 2, 5, 3, 3}, {12, 1, 2, 3, 4}, {12, 2, 5, 3, 3}};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t role = 0; role < 5; ++role) EXPECT_EQ(id(role, k), nodes[k][role]) << k;
    EXPECT_EQ(p.nodes.triangle[k], k % 2) << k;
    EXPECT_EQ(p.gap[k], 1);
    EXPECT_EQ(p.p0[k], 0);
  }
  // Facet normals: (0, 0, 200) of the quad; the triangle's diagonals are (0, 10, 0), (-6, 10, -8).
  const Vec quad{0, 0, 200}, tri{-80, 0, 60};
  using testing::operator+;
  using testing::operator*;
  const auto check = [&](const ContactPairs& pairs, const std::array<Vec, 6>& sums) {
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const Vec& wanted = sums[static_cast<std::size_t>(nodes[k][corner + 1])];
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(pairs.normal[corner][c].at(k), wanted[c], 1e-12) << k << ' ' << corner;
      }
  };
  check(found(3, 0), {Vec{}, quad, quad + tri, quad + tri, quad, tri});
  // Iadm: each facet counts the same, the repeated corner of a triangle twice.
  const Vec q{0, 0, 1}, t{-0.8, 0, 0.6};
  check(found(0, 1), {Vec{}, q, q + t, q + 2.0 * t, q, t});
}

// --- whole evaluations

TEST(CriteriaOfAnEvaluation, AreTheSharpestOfTheSegmentsOfEachNode) {
  // A ridge of two quads of different slopes, a node over each and one on the ridge.
  test::SmallDeck d;
  d.node(1, -8, 0, -2).node(2, 0, 0, 0).node(3, 0, 10, 0).node(4, -8, 10, -2);
  d.node(5, 6, 0, -3).node(6, 6, 10, -3);
  d.node(11, -4, 4, -0.6).node(12, 3, 6, -1.0).node(13, 0.1, 5, 0.5);
  d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4).shell(1, 2, 2, 5, 6, 3);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}, {2, 5, 6, 3}}).group("/GRNOD/NODE/2", {11, 12, 13});
  d.add("/ADMESH/GLOBAL\n         1");
  d.add("@/INTER/TYPE7/1 Gapmin=1 Iadm=2 NRadm=3 Padm=0.5 Angladm=20");
  const Built b(d, testing::with_stiffness());
  const SceneOutcome out = run_cycle(b.scene, make_state(b.scene), {});
  const ContactOutcome& c = out.contacts.at(0);
  // The same pairs, asked one by one.
  const ContactPairs pairs = make_pairs(b.scene, b.contact(), c.card, Model::reference);
  std::map<NodeIndex, NodeCriteria> wanted;
  ASSERT_GE(pairs.size(), 4u);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Pair p;
    for (std::size_t role = 0; role < 5; ++role) {
      const NodeIndex n = pairs.nodes.node[role][i];
      p.x[role] = {b.scene.coordinates.x[n], b.scene.coordinates.y[n], b.scene.coordinates.z[n]};
    }
    for (std::size_t k = 0; k < 4; ++k)
      p.normal[k] = {pairs.normal[k][0][i], pairs.normal[k][1][i], pairs.normal[k][2][i]};
    p.k0 = pairs.k0[i];
    p.gap = pairs.gap[i];
    const testing::Outcome r = testing::run(c.card, p);
    for (std::size_t role = 0; role < 5; ++role) {
      NodeCriteria& at = wanted[pairs.nodes.node[role][i]];
      at.radius = std::min(at.radius, r.all.criteria[0][0]);
      if (role > 0) continue;
      at.penetration = std::max(at.penetration, r.all.criteria[1][0]);
      at.angle = std::min(at.angle, r.all.criteria[2][0]);
    }
  }
  ASSERT_EQ(c.criteria.size(), wanted.size());
  auto it = wanted.begin();
  for (const NodeCriteria& got : c.criteria) {
    EXPECT_EQ(got.node, it->first);
    EXPECT_NEAR(got.radius, it->second.radius, 1e-9 * got.radius);
    EXPECT_NEAR(got.penetration, it->second.penetration, 1e-12);
    EXPECT_NEAR(got.angle, it->second.angle, 1e-12 * std::abs(got.angle));
    EXPECT_LT(got.radius, 1e30);
    ++it;
  }
  EXPECT_GT(c.criteria.back().penetration, 0);
}

TEST(EdgesGiveBackTheirGap, ByHalfOfTheDepthOfEachCycle) {
  // Two edges that cross, 0.7 apart with a gap of 1: 0.15 is stored for each.
  test::SmallDeck d;
  d.node(1, -5, 0, 0).node(2, 5, 0, 0).node(3, -5, 9, 0).node(4, 5, 9, 0);
  d.node(11, 0, -5, 0.7).node(12, 0, 5, 0.7).node(13, 9, -5, 0.7).node(14, 9, 5, 0.7);
  d.shell_part(1, 1).shell(1, 1, 1, 2, 4, 3).shell(1, 2, 11, 12, 14, 13);
  d.segments("/LINE/SEG/1", {{11, 12}}).segments("/LINE/SEG/2", {{1, 2}});
  d.add("@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1 Inacti=5");
  const Built b(d, testing::with_stiffness());
  const double distances[] = {0.7, 0.9, 0.7, 0.95, 0.5};
  std::vector<double> depth;
  const auto place = [&](std::size_t k, Coordinates& x, State&, CycleOptions& options) {
    options.keep_pairs = true;
    for (const std::int64_t id : {11, 12, 13, 14}) x.z[b.model.nodes.map.find(id)] = distances[k];
  };
  const auto look = [&](std::size_t, const SceneOutcome& r, const Coordinates&) {
    const auto& pairs = r.contacts.at(0).pairs;
    depth.push_back(pairs.empty() ? 0.0 : pairs[0].penetration);
  };
  static_cast<void>(run_steps(b.scene, make_state(b.scene), {}, 5, place, look));
  // Taken off each time: no more than before, and than half of the last depth for each edge.
  double off = 0.15, wanted[5];
  for (std::size_t k = 0; k < 5; ++k) {
    if (k > 0) off = std::min(off, 0.5 * std::max(0.0, 1 - distances[k - 1]));
    wanted[k] = std::max(0.0, 1 - distances[k] - 2 * off);
  }
  ASSERT_EQ(depth.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(depth[k], wanted[k], 1e-9) << k;
  EXPECT_NEAR(wanted[4], 0.45, 1e-12);
}

// --- limits of single pairs, and ties

/// A pair is deleted where dtmin reaches its time step of half of `limit`, and not before.
void expect_limit(ContactCard card, const Pair& p, double limit) {
  card.step_factor = 0.5;
  for (const double off : {1e-12, -1e-12}) {
    card.dtmin = 0.5 * limit * (1 + off);
    const auto status = testing::run(card, p).all.status[0];
    EXPECT_EQ((status & status_step_deleted) != 0, off > 0) << limit;
  }
}

TEST(PairStepLimit, IsThatOfTheLightestNodeOfThePairAlone) {
  const ContactCard card = testing::elastic_card();
  Pair p = testing::quad_pair({4, 3, 0.6});
  for (std::size_t light = 0; light < 5; ++light) {
    p.k0 = light == 0 ? 0.25 : 1e5;  // a soft pair has a step, too
    p.m = {1, 1, 1, 1, 1};
    p.m[light] = 1e-4;
    const testing::Outcome free = testing::run(card, p);
    double least = 1e30;
    for (std::size_t r = 0; r < 5; ++r) {
      const double share = r == 0 ? 1 : free.weights()[r - 1];
      least = std::min(least, std::sqrt(2 * p.m[r] / (share * free.all.k_nodal[0])));
    }
    expect_limit(card, p, least);
  }
}

TEST(PairStepLimit, OfEdgesIsThatOfTheLighterMeanMass) {
  ContactCard card = testing::elastic_card();
  card.kind = ContactKind::edge_edge;
  Pair p;
  // The first at a quarter of its length, the second at five eighths.
  p.x = {Vec{-2, 0, 0.6}, Vec{6, 0, 0.6}, Vec{0, -5, 0}, Vec{0, 3, 0}, Vec{}};
  p.k0 = 1e5;
  for (const std::array<double, 5>& m :
       {std::array<double, 5>{2, 3, 50, 70, 1}, std::array<double, 5>{20, 30, 5, 7, 1}}) {
    p.m = m;
    const double k = testing::run(card, p).all.k_nodal[0];
    const double mass = std::min(0.75 * m[0] + 0.25 * m[1], 0.375 * m[2] + 0.625 * m[3]);
    expect_limit(card, p, std::sqrt(2 * mass / k));
  }
}

TEST(TiesByTimeStep, BeginWithTheElasticForceOfTheirSideWhereverTheSegmentLies) {
  ContactCard card = testing::elastic_card();
  card.itied = 1;
  card.stfac = 3e4;
  for (const Model model : {Model::reference, Model::robust})
    for (const double height : {0.0, 3.0, -40.0})
      for (const double side : {1.0, -1.0})
        for (const int istf : {0, 1}) {
          card.istf = istf;
          card.dtmin = 1e3;
          Pair p = testing::quad_pair({4, 3, side * 0.6});
          for (Vec& x : p.x) x[2] += height;
          const testing::Outcome r = testing::run(card, p, 0, 0, model);
          const double kappa = istf == 1 ? 3e4 : 0.5 * p.k0;
          EXPECT_NE(r.all.status[0] & status_tied, 0);
          EXPECT_NEAR(r.all.tie[0][0], -side * kappa * 0.4 / 0.6, 1e-6) << istf << ' ' << height;
          for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(r.all.tie[c + 3][0], r.weights()[c]);
          EXPECT_NEAR(r.all.tie[6][0], 0.4, 1e-12);
          // Where the weights point to the node is as far as the height.
          EXPECT_NEAR(r.all.tie[7][0], side * 0.6, 1e-12) << height;
          EXPECT_EQ(r.all.dt_kinematic[0], 1e30);
          card.dtmin = 1e-12;
          EXPECT_EQ(testing::run(card, p, 0, 0, model).all.status[0] & status_tied, 0);
        }
}

TEST(TiesByTimeStep, KeepTheirWeightsAndTheDepthTheyBeganWith) {
  ContactCard card = testing::elastic_card();
  card.itied = 2;
  card.dtmin = 1e-9;
  for (const Model model : {Model::reference, Model::robust}) {
    Pair p = testing::quad_pair({4, 3, 1.2});
    p.gap = 2;
    p.tie = {-30, 4, 5, 0.25, 0.375, 0.125, 0.5, 1};
    const testing::Outcome r = testing::run(card, p, 0, 0, model);
    EXPECT_EQ(r.weights(), (std::array<double, 4>{0.25, 0.375, 0.125, 0.25}));
    EXPECT_NEAR(r.all.penetration[0], 0.8, 1e-12);
    // Room for 2 less the smaller of both depths: K/2 (2 / 1.5)^2.
    EXPECT_NEAR(r.all.k_nodal[0], 0.5 * p.k0 * 16 / 9, 1e-9 * p.k0);
    // At rest the tie pulls as before.
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(r.all.tie[c][0], p.tie[c]);
    EXPECT_EQ(r.all.normal_force[0], -30);
    // A depth of all of the gap: the robust model leaves a hundred-millionth of it.
    p.x[0] = {4, 3, 1e-13};
    p.tie[6] = 2;
    const double room = model == Model::robust ? 2e-8 : 1e-10;
    EXPECT_NEAR(testing::run(card, p, 0, 0, model).all.k_nodal[0] * room * room / (2 * p.k0), 1,
                1e-3);
  }
}

// --- friction by directions

TEST(DirectedCoefficients, TakeTheConstantsOfTheirPair) {
  Pair p = testing::quad_pair({5, 5, 0.6});
  p.ortho_mu = {0.3, 0.1};
  p.ortho_direction = {0.6, 0.8};
  const testing::Packet packet({p});
  const auto slip = [&](ContactCard card, const std::array<double, 6>* along,
                        const std::array<double, 6>* across, Vec v) {
    PacketView view = packet.view();
    for (std::size_t k = 0; k < 6; ++k) {
      if (along != nullptr) view.c[k] = &(*along)[k];
      if (across != nullptr) view.c2[k] = &(*across)[k];
    }
    detail::SlipState s{{0, 0, 1}, {v[0], v[1], v[2]}, -100, 2, true};
    double ft[3] = {70, 20, 0};
    detail::orthotropic_slip(card, view, 0, s, ft);
    return Vec{ft[0], ft[1], ft[2]};
  };
  const std::array<double, 6> first{0.01, 0.002, 0.0005, 0.003, 0.0025, 0.004};
  const std::array<double, 6> second{0.02, 0.001, 0.0015, 0.002, 0.0045, 0.006};
  const Vec v{1, 3, 0};
  for (const int law : {1, 2, 4}) {
    ContactCard card;
    card.ifric = law;
    card.c = first;
    // Along (0.6, 0.8), across (-0.8, 0.6).
    const double v1 = 0.6 + 0.8 * 3, v2 = -0.8 + 0.6 * 3;
    // Law 4 takes two of its constants the other way round along the first direction.
    std::array<double, 6> turned = first;
    double mu0 = 0.3;
    if (law == 4) std::swap(mu0, turned[0]);
    const double mu1 = friction_coefficient(law, mu0, turned, 2, v1);
    const double mu2 = friction_coefficient(law, 0.1, second, 2, v2);
    const double f1 = 0.6 * 70 + 0.8 * 20, f2 = -0.8 * 70 + 0.6 * 20;
    const auto f = orthotropic_return(f1, f2, mu1, mu2, -100);
    const Vec got = slip(card, &first, &second, v);
    EXPECT_NEAR(got[0], 0.6 * f[0] - 0.8 * f[1], 1e-9) << law;
    EXPECT_NEAR(got[1], 0.8 * f[0] + 0.6 * f[1], 1e-9) << law;
    // Without constants of the pair those of the card hold for both directions.
    EXPECT_EQ(slip(card, nullptr, nullptr, v), slip(card, &first, &first, v)) << law;
    EXPECT_NE(slip(card, nullptr, &second, v), slip(card, nullptr, nullptr, v)) << law;
  }
}

}  // namespace
}  // namespace deck::cycle
