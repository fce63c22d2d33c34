// Worked numeric vectors of heat exchange, curved main sides and adaptivity criteria.
#include "cycle/shared/heat.hpp"

#include <gtest/gtest.h>

#include "cycle/support.hpp"

namespace deck::cycle {
namespace {

using testing::elastic_card;
using testing::expect_digits;
using testing::Outcome;
using testing::Pair;
using testing::quad_pair;
using testing::run;
using testing::Vec;

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

TEST(Heat, PressureFunctionRadiationAndFriction) {
  ContactCard card = heat_card(1);
  card.fct_idk = Curve{{0, 1e8, 3e8}, {0, 1, 1.5}};
  HeatState s = heat_state(0);
  s.normal_force = -33357.33023;
  expect_digits(pair_heat(card, s).q[0], 3.139140229e-5);
  card = heat_card(1);
  card.frad = 4e-8;
  card.drad = 1.0;
  expect_digits(pair_heat(card, heat_state(0.5)).q[0], 1.054448815e-6);
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

TEST(Curvature, CylinderTakesTheRadialPenetration) {
  ContactCard card = elastic_card();
  card.icurv = 2;
  card.curv_node2 = {0, 0, 1};
  Pair p;  // a chord of the cylinder of radius sqrt(82) about z
  p.x = {Vec{9.4, 0, 1}, Vec{9, -1, 0}, Vec{9, 1, 0}, Vec{9, 1, 2}, Vec{9, -1, 2}};
  p.gap = 0.5;
  p.k0 = 1e5;
  const Outcome outside = run(card, p);
  EXPECT_NEAR(outside.all.penetration[0], 0.5 + std::sqrt(82.0) - 9.4, 1e-12);
  expect_digits(outside.normal(), {1, 0, 0});
  p.x[0] = {8.7, 0, 1};
  const Outcome inside = run(card, p);
  EXPECT_NEAR(inside.all.penetration[0], 8.7 - std::sqrt(82.0) + 0.5, 1e-12);
  expect_digits(inside.normal(), {-1, 0, 0});
}

TEST(Curvature, BicubicSurfaceOverAFlatQuad) {
  ContactCard card = elastic_card();
  card.icurv = 3;
  Pair p = quad_pair({5.5, 5, .9});
  p.normal = {Vec{-.2, 0, 1}, Vec{.2, 0, 1}, Vec{.2, 0, 1}, Vec{-.2, 0, 1}};
  const Outcome r = run(card, p);
  expect_digits(r.normal(), {0.01031266832, 0, 0.9999468230});
  expect_digits(r.all.penetration[0], 0.5961943964);
  expect_digits(r.weights(), {.2371084791, .2628915209, .2628915209, .2371084791});
}

TEST(Curvature, BicubicSurfaceIsContinuousUpToEveryEdge) {
  ContactCard card = elastic_card();
  card.icurv = 3;
  const auto depth = [&](double x, double y) {
    Pair p = quad_pair({x, y, .8});
    p.normal = {Vec{-.2, -.1, 1}, Vec{.3, -.2, 1}, Vec{.2, .1, 1}, Vec{-.1, .2, 1}};
    return run(card, p).all.penetration[0];
  };
  // On an edge two weights are nothing; just inside they are small.
  const double inside = 0.004;
  EXPECT_NEAR(depth(3, 0), depth(3, inside), 1e-3);
  EXPECT_NEAR(depth(3, 10), depth(3, 10 - inside), 1e-3);
  EXPECT_NEAR(depth(0, 7), depth(inside, 7), 1e-3);
  EXPECT_NEAR(depth(10, 7), depth(10 - inside, 7), 1e-3);
}

TEST(Adaptivity, RadiusPenetrationAndAngle) {
  ContactCard card = elastic_card();
  card.iadm = 2;
  card.nradm = 3;
  card.padm = 0.5;
  card.angladm = 60;
  Pair p = quad_pair({5, 5, 0.6});
  p.normal = {Vec{-0.5, 0, 1}, Vec{0.5, 0, 1}, Vec{0.5, 0, 1}, Vec{-0.5, 0, 1}};
  const Outcome r = run(card, p);
  const double sine = 0.5 / std::sqrt(1.25);
  expect_digits(r.all.criteria[0][0], 5.0 / sine);
  expect_digits(r.all.criteria[1][0], 0.4 / 0.5);
  expect_digits(r.all.criteria[2][0], (1.0 / std::sqrt(1.25)) / 0.5);
}

}  // namespace
}  // namespace deck::cycle
