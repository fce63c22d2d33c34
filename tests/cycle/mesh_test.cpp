// Time steps, masses and stiffness of elements, nodes and parts, on decks of a few elements.
#include "deck/model/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/small_deck.hpp"

namespace deck {
namespace {

using test::Built;
using test::SmallDeck;

// Material 1 of SmallDeck: E 200, nu 0.3, density 1e-6.
constexpr double density = 1e-6, young = 200.0, poisson = 0.3;
const double rod_speed = std::sqrt(young / density);

SmallDeck square() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.shell_part(1, 2.0).shell(1, 1, 1, 2, 3, 4);
  d.group("/GRNOD/PART/1", {1});
  return d;
}

TEST(ElementStep, OfASquareShellIsItsSideOverTheSpeedOfARod) {
  const Built b(square());
  const Mesh m = make_mesh(b.model);
  // Side 10; area over diagonal is less.
  EXPECT_NEAR(m.of(ElementKind::shell4).dt[0], 10.0 / rod_speed, 1e-15);
  EXPECT_EQ(m.total.slowest.element, 0u);
  EXPECT_TRUE(m.left_out.empty());
}

TEST(ElementStep, OfATriangleIsItsSmallestHeight) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 0, 10, 0);
  d.shell_part(1, 2.0).shell3(1, 1, 1, 2, 3);
  d.group("/GRNOD/PART/1", {1});
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  EXPECT_NEAR(m.of(ElementKind::shell3).dt[0], 100.0 / std::sqrt(200.0) / rod_speed, 1e-15);
}

TEST(ElementStep, OfACubeHasTheLinearViscosityOfItsProperty) {
  SmallDeck d = square();
  for (int k = 0; k < 8; ++k)
    d.node(10 + k, (k % 4 == 1 || k % 4 == 2) ? 50 : 40, k % 4 >= 2 ? 10 : 0, k >= 4 ? 10 : 0);
  d.solid_part(2).brick(2, 3, {10, 11, 12, 13, 14, 15, 16, 17});
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  const double bulk = young / (3 * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
  const double c = std::sqrt((bulk + 4.0 / 3.0 * shear) / density), q = 0.05 * c;
  const double dt = 10.0 / (q + std::sqrt(q * q + c * c));
  EXPECT_NEAR(m.of(ElementKind::solid8).dt[0], dt, 1e-14);
  // A quarter of the mass over the square of the step, at every node.
  const NodeIndex n = b.model.nodes.map.find(10);
  EXPECT_NEAR(m.nodes.stiffness[n], 0.25 * density * 1000.0 / (dt * dt), 1e-9);
  EXPECT_NEAR(m.nodes.dt[n], dt, 1e-14);
}

TEST(ElementStep, OfVoidLimitsNothingAndGivesMassOnly) {
  SmallDeck d = square();
  d.node(21, 30, 0, 0).node(22, 40, 0, 0).node(23, 40, 10, 0).node(24, 30, 10, 0);
  d.void_part(2, 2.0).shell(2, 2, 21, 22, 23, 24);
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  const NodeIndex n = b.model.nodes.map.find(21);
  EXPECT_EQ(m.of(ElementKind::shell4).dt[1], no_step);
  EXPECT_EQ(m.nodes.stiffness[n], 1e-20);
  EXPECT_DOUBLE_EQ(m.nodes.mass[n], density * 2.0 * 100.0 / 4.0);
}

TEST(ElementStep, OfASpringIsTheRootOfMassOverStiffness) {
  SmallDeck d = square();
  d.node(31, 60, 0, 0).node(32, 64, 0, 0);
  d.spring_part(2, 4.0).bar("SPRING", 2, 9, 31, 32);
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  EXPECT_NEAR(m.of(ElementKind::spring).dt[0], 0.5, 1e-15);  // mass 1, stiffness 4
}

TEST(ElementStep, IsNotGuessedForALawThatIsNotEstablished) {
  SmallDeck d = square();
  d.node(41, 60, 0, 0).node(42, 70, 0, 0).node(43, 70, 10, 0).node(44, 60, 10, 0);
  d.add("/MAT/LAW151/7\nfluids\n");
  d.shell_part(3, 1.0, 0, 7).shell(3, 5, 41, 42, 43, 44);
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  EXPECT_TRUE(std::isnan(m.of(ElementKind::shell4).dt[1]));
  EXPECT_EQ(m.total.not_computed, 1u);
  ASSERT_FALSE(m.left_out.empty());
}

TEST(PartSums, AreMassCentreAndInertiaOfNodes) {
  const Built b(square());
  const Mesh m = make_mesh(b.model);
  const PartFigures& part = m.parts[0];
  const double mass = density * 2.0 * 100.0;
  EXPECT_NEAR(part.mass, mass, 1e-18);
  EXPECT_NEAR(part.centre[0], 5.0, 1e-12);
  EXPECT_NEAR(part.centre[1], 5.0, 1e-12);
  // The nodes have A / 9 + t^2 / 12 of their own.
  const double own = mass * (100.0 / 9.0 + 4.0 / 12.0);
  EXPECT_NEAR(part.inertia[0], mass * 25.0 + own, 1e-15);
  EXPECT_NEAR(part.inertia[2], mass * 50.0 + own, 1e-15);
  EXPECT_NEAR(m.total.mass, part.mass, 1e-18);
}

TEST(RigidBody, TakesTheStiffnessOfItsNodesToTheMainNode) {
  SmallDeck d = square();
  d.node(99, 5, 5, 0);
  d.add("@/RBODY/1 node_ID=99 grnd_ID=1");
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  const NodeIndex main = b.model.nodes.map.find(99), corner = b.model.nodes.map.find(1);
  EXPECT_NEAR(m.nodes.mass[main], density * 2.0 * 100.0, 1e-18);
  EXPECT_EQ(m.nodes.dt[corner] < no_step, m.nodes.inertia[corner] != 0.0);
  EXPECT_GT(m.nodes.stiffness[main], 1.0);
  EXPECT_LT(m.nodes.stiffness[corner], 1e-19);
}

TEST(Mesh, IsTheSameForAnyNumberOfThreads) {
  SmallDeck d = square();
  d.node(31, 60, 0, 0).node(32, 64, 0, 0);
  d.spring_part(2, 4.0).bar("SPRING", 2, 9, 31, 32);
  const Built b(d);
  MeshOptions four;
  four.threads = 4;
  const Mesh one = make_mesh(b.model), other = make_mesh(b.model, four);
  EXPECT_EQ(one.nodes.stiffness, other.nodes.stiffness);
  EXPECT_EQ(one.parts[0].inertia, other.parts[0].inertia);
}

}  // namespace
}  // namespace deck
