// Worked numeric vectors of the kernel's rules, to ten digits: geometry, law, damping, friction,
// edges, ties, gap reduction, stiffness, heat, curvature.
#include <gtest/gtest.h>

#include "cycle/shared/heat.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using namespace testing;

TEST(Geometry, FlatQuadNearItsDiagonalTiltsTheReferenceNormal) {
  const Outcome r = run(elastic_card(), quad_pair({6, 3.2, 0.4}));
  expect_digits(r.normal(), {-0.2171253081, -0.2171253081, 0.9516896559});
  expect_digits(r.weights(), {0.2764556191, 0.3900000000, 0.2235443809, 0.1100000000});
  expect_digits(-1.0 * r.force(), {-16284.39811, -16284.39811, 71376.72419});
  const Outcome robust = run(elastic_card(), quad_pair({6, 3.2, 0.4}), 0, 0, Model::robust);
  expect_digits(-1.0 * robust.force(), {0, 0, 75000});
}

TEST(Geometry, FlatQuadBetweenFanTriangles) {
  const Outcome r = run(elastic_card(), quad_pair({6, 5.7, 0.4}));
  expect_digits(r.normal(), {0.1628333313, -0.1628333313, 0.9731241506});
  expect_digits(r.weights(), {0.1650000000, 0.2578449781, 0.3350000000, 0.2421550219});
}

TEST(Geometry, WarpedQuadNodeOutsideAnEdge) {
  Pair p;
  p.x = {Vec{5.2, -0.3, 0.7}, Vec{0, 0, 0}, Vec{10, 0, 0.5}, Vec{10, 10, 0}, Vec{0, 10, 0.5}};
  p.gap = 1.2;
  p.k0 = 1e5;
  const Outcome r = run(elastic_card(), p);
  expect_digits(r.all.penetration[0], 0.6679124067);
  expect_digits(r.normal(), {-0.04124346711, -0.5638169425, 0.8248693423});
  expect_digits(r.weights(), {0.4778054863, 0.5221945137, 0, 0});
}

TEST(Geometry, TriangleInteriorEdgeAndCorner) {
  const Outcome inside = run(elastic_card(), triangle_pair({2, 3, 0.6}));
  expect_digits(inside.weights(), {0.5, 0.2, 0.3, 0});
  expect_digits(inside.normal(), {0, 0, 1});
  const Outcome edge = run(elastic_card(), triangle_pair({6, 5, 0.3}));
  expect_digits(edge.all.penetration[0], 0.2318854252);
  expect_digits(edge.normal(), {0.6509445549, 0.6509445549, 0.3905667329});
  expect_digits(edge.weights(), {0, 0.55, 0.45, 0});
  const Outcome corner = run(elastic_card(), triangle_pair({-0.2, -0.1, 0.3}));
  expect_digits(corner.normal(), {-0.5345224838, -0.2672612419, 0.8017837257});
  expect_digits(corner.weights(), {1, 0, 0, 0});
}

TEST(ElasticLaw, StiffensHyperbolically) {
  const struct {
    double pi, fn, k_tan, energy;
  } rows[] = {{0.4, -33333.33333, 138888.8889, 5541.281188},
              {0.9, -450000, 5000000, 70129.25465},
              {0.999, -4.995e7, 5e10, 295437.7639}};
  for (const auto& row : rows) {
    const Outcome r = run(elastic_card(), triangle_pair({2, 3, 1.0 - row.pi}));
    expect_digits(r.all.normal_force[0], row.fn);
    expect_digits(r.all.k_nodal[0], row.k_tan);
    expect_digits(r.all.elastic_energy[0], row.energy);
  }
}

TEST(ElasticLaw, TheNodeIsDroppedAtTheMidSurface) {
  for (const Model model : {Model::reference, Model::robust}) {
    const Outcome closed = run(elastic_card(), triangle_pair({2, 3, 0.5e-10}), 0, 0, model);
    EXPECT_EQ(closed.all.normal_force[0], 0.0);
    EXPECT_NE(closed.all.status[0] & status_gap_closed, 0);
    const Outcome open = run(elastic_card(), triangle_pair({2, 3, 2e-10}), 0, 0, model);
    EXPECT_LT(open.all.normal_force[0], -5e12);
    EXPECT_EQ(open.all.status[0] & status_gap_closed, 0);
  }
}

ContactCard damped() {
  ContactCard card;
  card.visf = 1.0;
  return card;
}

Pair moving(const Vec& v) {
  Pair p = triangle_pair({2, 3, 0.6});
  p.v[0] = v;
  p.m[0] = 2e-3;
  return p;
}

TEST(Damping, ApproachIsStifferThanSeparation) {
  const Outcome in = run(damped(), moving({0, 0, -20}), 1e-6, 1e-6);
  expect_digits(in.all.normal_force[0], -33357.33023);
  expect_digits(in.all.k_nodal[0], 23570226.04);
  expect_digits(in.all.dt_kinematic[0], 0.015);
  const Outcome away = run(damped(), moving({0, 0, 20}), 1e-6, 1e-6);
  expect_digits(away.all.normal_force[0], -33315.07591);
  expect_digits(away.all.k_nodal[0], 18257418.58);
}

TEST(Damping, IsNoneWithoutVissAlsoWhereFrictionNeedsTheVelocities) {
  ContactCard card = damped();
  card.viss = 0.0;
  card.fric = 0.2;
  const Outcome still = run(card, moving({0, 0, 0}), 1e-6, 1e-6);
  EXPECT_LT(still.all.normal_force[0], 0.0);
  for (const double v : {-20.0, 20.0})
    EXPECT_EQ(run(card, moving({0, 0, v}), 1e-6, 1e-6).all.normal_force[0],
              still.all.normal_force[0])
        << v;
}

TEST(FrictionViscous, SticksThenSlips) {
  ContactCard card = damped();
  card.fric = 0.2;
  const Outcome stick = run(card, moving({30, -40, -20}), 1e-6, 1e-6);
  expect_digits(stick.force(), {707.1067812, -942.8090416, -33357.33023});
  // Booked is dt1 V.Ft: here V has no part along Ft but the sliding.
  expect_digits(stick.all.friction_energy[0], 0.0589255651);
  const Outcome slip = run(card, moving({3000, -4000, -20}), 1e-6, 1e-6);
  expect_digits(slip.force(), {4002.879627, -5337.172836, -33357.33023});
  expect_digits(slip.all.friction_energy[0], 33.35733023);
  expect_digits(slip.all.friction_heat[0], 33.35733023);
}

TEST(FrictionViscous, SplitsToTheNodesAndSumsToNothing) {
  ContactCard card = damped();
  card.fric = 0.2;
  const testing::Packet packet({moving({30, -40, -20})});
  const KernelPlan plan = make_plan(card);
  PacketResult r;
  evaluate(plan, packet.view(1e-6, 1e-6), r);
  PairList pairs;
  pairs.node = {std::vector<std::uint32_t>{0}, {1}, {2}, {3}, {3}};
  pairs.triangle = {1};
  NodalSums sums;
  sums.resize(4);
  assemble(plan, pairs, r, sums);
  const double main[3][3] = {{353.5533906, -471.4045208, -16678.66511},
                             {141.4213562, -188.5618083, -6671.466046},
                             {212.1320344, -282.8427125, -10007.19907}};
  for (std::size_t n = 0; n < 3; ++n) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(sums.force[c][n + 1], main[n][c], 1e-8 * std::abs(main[n][c]));
    }
  }
  // Impulse and moment of one step, and the moment that the split leaves.
  const Totals t = totals(plan, packet.view(1e-6, 1e-6), r);
  EXPECT_NEAR(1e-6 * t.normal[2], -0.03335733023, 1e-11);
  EXPECT_NEAR(1e-6 * t.total_abs, 0.03337814208, 1e-11);
  const double moment[3] = {-0.09912918165, 0.06742176724, -0.004006938427};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(1e-6 * t.moment[c], moment[c], 1e-10);
}

Pair edges(const Vec& s1, const Vec& s2, const Vec& m1, const Vec& m2) {
  Pair p;
  p.x = {s1, s2, m1, m2, Vec{}};
  p.k0 = 48000;
  return p;
}

ContactCard edge_card() {
  ContactCard card = elastic_card();
  card.kind = ContactKind::edge_edge;
  return card;
}

TEST(EdgeGeometry, SkewAndClamped) {
  Pair p = edges({0, 0, 0}, {10, 0, 0}, {3, -4, .6}, {5, 6, .8});
  const Outcome skew = run(edge_card(), p);
  expect_digits(skew.weights()[0], 0.6202718912);
  expect_digits(skew.weights()[2], 0.6013594562);
  expect_digits(skew.all.distance[0], 0.6798640408);
  const Outcome end = run(edge_card(), edges({0, 0, 0}, {4, 0, 0}, {4.5, .2, .3}, {9, 5, .3}));
  EXPECT_EQ(end.weights()[0], 0.0);
  EXPECT_EQ(end.weights()[2], 1.0);
  expect_digits(end.all.distance[0], 0.6164414003);
}

TEST(EdgeForce, SkewEdgesWithDampingAndFriction) {
  ContactCard card;
  card.kind = ContactKind::edge_edge;
  card.fric = 0.25;
  card.visf = 1.0;
  expect_digits(pair_stiffness(card, 8e4, 1.2e5), 48000);
  Pair p = edges({0, 0, 0}, {10, 0, 0}, {3, -4, .6}, {5, 6, .8});
  p.v = {Vec{0, 5, 8}, Vec{1, 0, 12}, Vec{0, 0, -3}, Vec{0, 1, -2}, Vec{}};
  p.m = {1e-3, 1.5e-3, 2e-3, 2.5e-3, 0};
  const Outcome r = run(card, p, 1e-6, 1e-6);
  expect_digits(r.all.penetration[0], 0.3201359592);
  expect_digits(r.all.normal_force[0], -11932.27086);
  expect_digits(r.all.elastic_energy[0], 1630.908659);
  expect_digits(r.all.k_nodal[0], 23459330.76);
  expect_digits(r.force(), {4.454083651, -204.0661920, 11930.57575});
  expect_digits(r.all.dt_kinematic[0], 0.02403321511);
  p.v = {Vec{0, 0, -9e6}, Vec{0, 0, -9e6}, Vec{}, Vec{}, Vec{}};
  EXPECT_EQ(run(card, p, 1e-6, 1e-6).all.normal_force[0], 0.0);  // separation never pulls
}

ContactCard tied_card(int itied) {
  ContactCard card;
  card.kind = ContactKind::tied;
  card.itied = itied;
  return card;
}

TEST(Tie, Type10RidesThenReboundsOrHolds) {
  for (const int itied : {0, 1}) {
    Pair p = quad_pair({6, 3.2, 0.4});
    p.k0 = 2e4;
    p.m[0] = 2e-3;
    const Vec v[] = {{1, 2, -5}, {1, 2, -1}, {-3, 0, 4}, {0, 0, 9}};
    const Vec stored[] = {{-1, 0.4242640687, 0.1414213562},
                          {-1.2, 0.8485281374, 0.2828427125},
                          {-0.4, 0.4242640687, 0.7071067812}};
    const Vec force[] = {{0.6472135955, 1.294427191, -3.236067977},
                         {0.8472135955, 1.694427191, -1.647213595},
                         {-1.541640786, 0.8, 1.388854382}};
    double elastic = 0.0, damping = 0.0;
    const double e[] = {3.0e-5, 5.6e-5, 2.1e-5, itied == 0 ? 3.0e-6 : 6.6e-5};
    const double d[] = {1.341640786e-4, 1.609968944e-4, 2.728002933e-4, 6.350433056e-4};
    for (std::size_t c = 0; c < 4; ++c) {
      p.v[0] = v[c];
      const Outcome r = run(tied_card(itied), p, 1e-5, 1e-5);
      elastic += r.all.elastic_energy[0];
      damping += r.all.damping_energy[0];
      EXPECT_NEAR(elastic, e[c], 1e-13);
      EXPECT_NEAR(damping, d[c], 1e-12);
      const Vec now{r.all.tie[0][0], r.all.tie[1][0], r.all.tie[2][0]};
      if (c < 3) {
        expect_digits(now, stored[c]);
        expect_digits(r.force(), force[c]);
        expect_digits(r.all.k_nodal[0], 109442.7191);
      } else if (itied == 0) {
        EXPECT_EQ(now[0], -1e-30);
        EXPECT_EQ(testing::norm(r.force()), 0.0);
        EXPECT_EQ(r.all.status[0], status_released);
      } else {
        expect_digits(now, {1.4, 0.4242640687, 0.7071067812});
        expect_digits(r.all.normal_force[0], 5.424922360);
      }
      for (std::size_t k = 0; k < 6; ++k) p.tie[k] = r.all.tie[k][0];
    }
  }
}

TEST(Tie, Type7LiveTieIsAStiffSpringInThreeDirections) {
  ContactCard card;
  card.itied = 2;
  Pair p = quad_pair({5, 5, 0.1});
  p.m[0] = 2e-3;
  p.v[0] = {0, 0, 0};
  p.tie = {-450000, 0, 0, 0.25, 0.25, 0.25, 0.9, 0.1};
  // The frame: t1 along the diagonal, t2 = n x t1.
  const double h = std::sqrt(0.5);
  p.v[0] = {2 * h, 2 * h, -3};
  const Outcome r = run(card, p, 1e-6, 1e-6);
  expect_digits(r.all.tie[0][0], -450015);
  expect_digits(r.all.tie[1][0], 10);
  expect_digits(r.all.normal_force[0], -450021.7082);
  expect_digits(r.all.k_nodal[0], 9472135.955);
  expect_digits(r.force(), {14.47213595 * h, 14.47213595 * h, -450021.7082});
}

TEST(GapReduction, InactiFiveAndSixFollowThePenetration) {
  const double p[] = {.40, .42, .45, .30, .28, .25, .50};
  const double p5[] = {0.4000000038, 0.4000000038, 0.4000000038, 0.3950000036,
                       0.3892500034, 0.3822875033, 0.3822875033};
  const double f5[] = {0, 1034.482556, 2727.272503, 0, 0, 0, 7271.248026};
  const double p6[] = {0.4300000036, 0.4300000036, 0.4300000036, 0.4252500034,
                       0.4197875033, 0.4131731281, 0.4131731281};
  const double f6[] = {0, 0, 1036.363443, 0, 0, 0, 5095.234164};
  for (const int inacti : {5, 6}) {
    ContactCard card = elastic_card();
    card.inacti = inacti;
    Pair pair = triangle_pair({});
    pair.p0 = 0.4 * (1 + 1e-8);  // what start-up leaves of a penetration of 0.4
    if (inacti == 6) pair.p0 += 0.05 * (1.0 - pair.p0);
    for (std::size_t c = 0; c < 7; ++c) {
      pair.x[0] = {2, 3, 1.0 - p[c]};
      const Outcome r = run(card, pair);
      EXPECT_NEAR(r.all.p0[0], (inacti == 5 ? p5 : p6)[c], 1e-10);
      // Ten digits of P0 leave seven of a small difference.
      EXPECT_NEAR(-r.all.normal_force[0], (inacti == 5 ? f5 : f6)[c], 2e-5);
      pair.p0 = r.all.p0[0];
    }
  }
}

TEST(PairStiffness, CombinesAndClamps) {
  ContactCard card;
  card.stmin = 10;
  card.stmax = 100;
  const auto k = [&](int istf, double main, double secondary) {
    card.istf = istf;
    return pair_stiffness(card, main, secondary);
  };
  EXPECT_EQ(k(0, 500, 1), 500);
  EXPECT_EQ(k(2, 40, 20), 30);
  EXPECT_EQ(k(3, 40, 20), 40);
  EXPECT_EQ(k(4, 40, 20), 20);
  EXPECT_EQ(k(5, 40, 40), 20);
  EXPECT_EQ(k(3, 400, 20), 100);
  EXPECT_EQ(k(4, 400, 2), 10);
}

HeatState heat_state(double delta) {
  HeatState s;
  s.position = {Vec{2, 3, -delta}, Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{0, 10, 0}, Vec{0, 10, 0}};
  s.temperature = {350, 600, 620, 650, 650};
  s.weight = {0.5, 0.2, 0.3, 0.0};
  s.area = 2e-4;
  s.dt1 = 1e-6;
  return s;
}

ContactCard heat_card(int form) {
  ContactCard card;
  card.ithe = 1;
  card.ithe_form = form;
  card.kthe = 500;
  card.tint = 700;
  return card;
}

TEST(Heat, ConductionBetweenSidesAndFromTheInterface) {
  const HeatFlow both = pair_heat(heat_card(1), heat_state(0));
  expect_digits(both.q, {2.69e-5, -1.345e-5, -5.38e-6, -8.07e-6, 0});
  expect_digits(both.conductance, 0.1);
  expect_digits(pair_heat(heat_card(0), heat_state(-6e-4)).q[0], 3.5e-5);
  HeatState s = heat_state(6e-4);
  s.conductivity = 45;
  const HeatFlow flow = pair_heat(heat_card(0), s);
  // The plane's normal points to +z, the centroid lies 6e-4 above the node.
  expect_digits(flow.q[0], 3.476821192e-5);
  expect_digits(flow.conductance, 0.09933774834);
}

TEST(Heat, PressureFunctionAndFriction) {
  ContactCard card = heat_card(1);
  card.fct_idk = Curve{{0, 1e8, 3e8}, {0, 1, 1.5}};
  HeatState s = heat_state(0);
  s.normal_force = -33357.33023;
  expect_digits(pair_heat(card, s).q[0], 3.139140229e-5);
  card = heat_card(1);
  card.kthe = 0;
  card.fheats = 0.4;
  card.fheatm = 0.5;
  s.friction_heat = 33.35733023;
  expect_digits(pair_heat(card, s).q, {13.34293209, 8.339332558, 3.335733023, 5.003599535, 0});
}

TEST(Curvature, SphereSeenFromInside) {
  ContactCard card = elastic_card();
  card.icurv = 1;
  Pair p;
  p.x = {Vec{8.6, .2, .8}, Vec{9, -1, 0}, Vec{9, 1, 0}, Vec{9, 1, 2}, Vec{9, -1, 2}};
  p.gap = 0.5;
  p.k0 = 1e5;
  const Outcome r = run(card, p);
  EXPECT_NEAR(r.all.penetration[0], 0.08405928844, 1e-10);
  expect_digits(r.normal(), {-0.9954343793, -0.02314963673, -0.09259854691});
  expect_digits(r.weights(), {0.25, 0.340824829, 0.25, 0.159175171});
}

}  // namespace
}  // namespace deck::cycle
