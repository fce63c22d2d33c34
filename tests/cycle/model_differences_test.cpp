// What differs between the robust model and the reference: arithmetic only, with the figures that
// tools/docs/differences.md quotes. Everything else is the same in both, see solver_rules_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cycle/support.hpp"

namespace deck::cycle {
namespace {

using namespace testing;

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

TEST(ModelDifferences, TheWorkOfTheDashpotIsBookedInTheRobustModelOnly) {
  ContactCard card;
  Pair p = testing::triangle_pair({2, 3, 0.4});
  p.v[0] = {0, 0, -10};
  const Outcome a = testing::run(card, p, 1e-6, 1e-6);
  const Outcome b = testing::run(card, p, 1e-6, 1e-6, robust);
  const Outcome still = testing::run(testing::elastic_card(), p, 1e-6, 1e-6, robust);
  EXPECT_EQ(a.all.damping_energy[0], 0.0);
  EXPECT_NEAR(b.all.damping_energy[0],
              1e-6 * (b.all.normal_force[0] - still.all.normal_force[0]) * -10, 1e-15);
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

}  // namespace
}  // namespace deck::cycle
