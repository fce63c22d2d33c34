// How much the robust model differs from the reference, case by case: the figures that plan.hpp
// quotes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cycle/support.hpp"
#include "deck/cycle/heat.hpp"

namespace deck::cycle {
namespace {

using testing::elastic_card;
using testing::Outcome;
using testing::Pair;
using testing::quad_pair;
using testing::Vec;
using testing::operator-;
using testing::operator*;

constexpr Model reference = Model::reference, robust = Model::robust;

double size(const Outcome& r) { return testing::norm(r.force()); }

TEST(ModelDifferences, BlendedNormalOnAFlatSquare) {
  double tilt = 0.0, side = 0.0;
  for (double x = 0.25; x < 10.0; x += 0.25) {
    for (double y = 0.25; y < 10.0; y += 0.25) {
      const Outcome r = testing::run(elastic_card(), quad_pair({x, y, 0.4}));
      const Vec n = r.normal();
      tilt = std::max(tilt, std::acos(n[2]) * 180 / std::numbers::pi);
      side = std::max(side, std::hypot(n[0], n[1]));
      const Vec m = testing::run(elastic_card(), quad_pair({x, y, 0.4}), 0, 0, robust).normal();
      EXPECT_LT(testing::norm(m - Vec{0, 0, 1}), 1e-14);
    }
  }
  std::printf("blended normal: tilt up to %.1f degrees, side force %.2f\n", tilt, side);
  EXPECT_NEAR(tilt, 25.0, 0.5);
  EXPECT_NEAR(side, 0.43, 0.005);
}

TEST(ModelDifferences, DistanceInsteadOfGapMinusPenetration) {
  const Pair p = quad_pair({5, 4, 2e-8});
  const double exact = 5e4 * (1 - 2e-8) / 2e-8;
  const double off = std::abs(size(testing::run(elastic_card(), p)) - exact) / exact;
  EXPECT_GT(off, 1e-10);
  EXPECT_LT(off, 5e-9);
  EXPECT_LT(std::abs(size(testing::run(elastic_card(), p, 0, 0, robust)) - exact) / exact, 1e-15);
  // Ten times closer the robust law is its own tangent.
  const double tangent = size(testing::run(elastic_card(), quad_pair({5, 4, 2e-9}), 0, 0, robust));
  EXPECT_NEAR(tangent, 5e4 * (1e8 + 1e16 * (1e-8 - 2e-9)), 1e-6 * tangent);
  Pair small = quad_pair({5, 4, 5e-11});
  small.gap = 1e-6;
  EXPECT_NEAR(size(testing::run(elastic_card(), small)) /
                  size(testing::run(elastic_card(), small, 0, 0, robust)),
              0.5, 1e-4);
}

TEST(ModelDifferences, ANodeOnTheSurface) {
  const Pair p = testing::triangle_pair({2, 3, 0});
  EXPECT_EQ(size(testing::run(elastic_card(), p)), 0.0);
  EXPECT_GT(testing::run(elastic_card(), p, 0, 0, robust).force()[2], -1e300);
  EXPECT_LT(testing::run(elastic_card(), p, 0, 0, robust).force()[2], 0.0);
}

TEST(ModelDifferences, DashpotOfBothMasses) {
  ContactCard card;
  const auto share = [&](const Vec& at) {
    Pair p = quad_pair(at);
    p.v[0] = {0, 0, 1e-4};  // apart: the linear dashpot alone
    const auto c = [&](Model m) {
      Pair still = p;
      still.v[0] = {};
      return (testing::run(card, p, 1e-6, 1e-6, m).all.normal_force[0] -
              testing::run(card, still, 1e-6, 1e-6, m).all.normal_force[0]);
    };
    return c(robust) / c(reference);
  };
  EXPECT_NEAR(share({5, 5, 0.4}), std::sqrt(0.8), 1e-4);
  EXPECT_NEAR(share({0, 0, 0.4}), std::sqrt(0.5), 1e-4);
}

TEST(ModelDifferences, FrictionUnderTensionAndItsStiffness) {
  ContactCard card;
  card.fric = 0.3;
  Pair pulled = quad_pair({5, 5, 0.999});
  pulled.m[0] = 2e-3;
  pulled.v[0] = {1e5, 0, 1e3};  // the dashpot of the reference pulls
  const Outcome r = testing::run(card, pulled, 1e-6, 1e-6);
  EXPECT_GT(r.all.normal_force[0], 0.0);
  EXPECT_GT(std::abs(r.force()[0]), 0.0);
  EXPECT_EQ(testing::run(card, pulled, 1e-6, 1e-6, robust).force()[0], 0.0);
  card = elastic_card();
  card.fric = 0.5;
  card.iform = 2;
  Pair p = quad_pair({5, 5, 1 - 1e-6});
  p.v[0] = {1e-6, 0, 0};
  EXPECT_NEAR(testing::run(card, p, 1e-6, 1e-6, robust).memory()[0] /
                  testing::run(card, p, 1e-6, 1e-6).memory()[0],
              0.5, 1e-5);
}

TEST(ModelDifferences, MemoryInATurnedPlane) {
  ContactCard card = elastic_card();
  card.fric = 0.5;
  card.iform = 2;
  Pair p = quad_pair({5, 5, 0.4});
  const double a = std::numbers::pi / 6;
  p.ft = {std::cos(a), 0, std::sin(a)};  // of a plane turned by 30 degrees
  EXPECT_NEAR(testing::norm(testing::run(card, p, 1e-6, 1e-6).memory()), std::cos(a), 1e-12);
  EXPECT_NEAR(testing::norm(testing::run(card, p, 1e-6, 1e-6, robust).memory()), 1.0, 1e-12);
}

TEST(ModelDifferences, FilterByFrequency) {
  ContactCard card;
  card.fric = 0.2;
  card.ifiltr = 3;
  card.xfreq = 1000;
  Pair p = quad_pair({5, 5, 0.4});
  p.v[0] = {1e5, 0, 0};
  ContactCard plain = card;
  plain.ifiltr = 0;
  const auto share = [&](Model m) {
    return testing::run(card, p, 1e-6, 1e-6, m).memory()[0] /
           testing::run(plain, p, 1e-6, 1e-6, m).force()[0];
  };
  EXPECT_NEAR(share(reference), 1.0, 1e-12);
  EXPECT_NEAR(share(robust), 2 * std::numbers::pi * 1e-3, 1e-9);
}

TEST(ModelDifferences, NoForceAtADistance) {
  ContactCard card;
  card.fric = 0.2;
  card.ithe = 1;
  card.drad = 3.0;
  Pair p = quad_pair({5, 5, 2.0});  // gap 1
  p.v[0] = {10, 0, -10};
  EXPECT_GT(size(testing::run(card, p, 1e-6, 1e-6)), 0.0);
  EXPECT_EQ(size(testing::run(card, p, 1e-6, 1e-6, robust)), 0.0);
}

TEST(ModelDifferences, AGapUsedUp) {
  ContactCard card = elastic_card();
  card.inacti = 5;
  Pair p = quad_pair({5, 5, 1e-3});
  p.p0 = 1.0;  // all of the gap
  const double f = size(testing::run(card, p, 0, 0, robust));
  EXPECT_EQ(f, 0.0);
}

TEST(ModelDifferences, ParallelEdgesAndTheirOrderOfNodes) {
  ContactCard card = elastic_card();
  card.kind = ContactKind::edge_edge;
  const auto place = [&](bool swapped, Model m) {
    Pair p;
    p.x = {Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{2, .5, 0}, Vec{8, .5, 0}, Vec{}};
    if (swapped) std::swap(p.x[2], p.x[3]);
    p.k0 = 1e5;
    const auto h = testing::run(card, p, 0, 0, m).weights();
    return 10 * h[1];
  };
  EXPECT_NEAR(std::abs(place(false, reference) - place(true, reference)), 6.0, 1e-12);
  EXPECT_NEAR(place(false, robust), 5.0, 1e-12);
  EXPECT_NEAR(place(true, robust), 5.0, 1e-12);
}

TEST(ModelDifferences, NineTenthsOfTheGapOfEdges) {
  ContactCard card = elastic_card();
  card.kind = ContactKind::edge_edge;
  Pair p;
  p.x = {Vec{-5, 0, 0.5}, Vec{5, 0, 0.5}, Vec{0, -5, 0}, Vec{0, 5, 0}, Vec{}};
  p.k0 = 1e5;
  EXPECT_NEAR(size(testing::run(card, p)) / size(testing::run(card, p, 0, 0, robust)), 1.125,
              1e-12);
  card.istf = 1;
  card.stfac = 8e4;
  EXPECT_NEAR(pair_stiffness(card, 1e5, 1e5, robust) / pair_stiffness(card, 1e5, 1e5), 4.0, 1e-12);
}

TEST(ModelDifferences, ConductionByTheOrientationOfTheSegment) {
  ContactCard card;
  card.ithe = 1;
  card.kthe = 500;
  card.tint = 700;
  HeatState s;
  s.position = {Vec{2, 3, -6e-4}, Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{0, 10, 0}, Vec{0, 10, 0}};
  s.temperature = {350, 600, 620, 650, 650};
  s.weight = {0.5, 0.2, 0.3, 0.0};
  s.area = 2e-4;
  s.dt1 = 1e-6;
  s.conductivity = 45;
  HeatState turned = s;
  turned.position = {Vec{2, 3, -6e-4}, Vec{0, 10, 0}, Vec{10, 0, 0}, Vec{0, 0, 0}, Vec{0, 0, 0}};
  turned.weight = {0.3, 0.2, 0.5, 0.0};
  EXPECT_NEAR(pair_heat(card, turned).q[0] / pair_heat(card, s).q[0], 1 + 500 * 6e-4 / 45, 1e-9);
  EXPECT_NEAR(pair_heat(card, turned, robust).q[0], pair_heat(card, s, robust).q[0], 1e-18);
}

}  // namespace
}  // namespace deck::cycle
