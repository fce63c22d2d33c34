// Time steps, masses and stiffness of elements, nodes and parts, on decks of a few elements.
#include "model/shared/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/small_deck.hpp"
#include "model/mesh_elements.hpp"

namespace deck {
namespace {

using test::Built;
using test::SmallDeck;

// Of material 1 of SmallDeck.
constexpr double density = 1e-6;

SmallDeck square() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.shell_part(1, 2.0).shell(1, 1, 1, 2, 3, 4);
  d.group("/GRNOD/PART/1", {1});
  return d;
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

TEST(ElementStep, OfARigidMaterialLimitsNothingAndThoseOfOtherPartsAreNotGiven) {
  SmallDeck d = square();
  d.add("/MAT/LAW13/7\nrigid\n              1.e-06\n               200.0                  0.3\n");
  d.node(5, 20, 0, 0).node(6, 20, 10, 0);
  d.shell_part(2, 2.0, 0, 7).shell(2, 2, 2, 5, 6, 3);
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  const ElementFigures& shells = m.of(ElementKind::shell4);
  EXPECT_TRUE(std::isnan(shells.dt[0]));
  EXPECT_GE(shells.dt[1], 1e29);
  EXPECT_EQ(m.parts[1].not_computed, 0u);
  EXPECT_GT(shells.mass[1], 0.0);
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

/// Shell 1 of square() as the main segment, and a strip on top with node 11 above its middle.
SmallDeck tied_square(int spotflag, double height = 1.0) {
  SmallDeck d = square();
  d.node(11, 5, 5, height).node(12, 25, 5, height).node(13, 25, 15, height).node(14, 5, 15, height);
  d.shell_part(2, 1.0).shell(2, 2, 11, 12, 13, 14);
  d.group("/GRNOD/NODE/5", {11}).group("/SURF/PART/5", {1});
  return d.add("@/INTER/TYPE2/1 grnd_IDs=5 surf_IDm=5 Ignore=1 dsearch=2 Spotflag=" +
               std::to_string(spotflag));
}

TEST(Ties, ByPenaltyLeaveMassesAndTheStepsOfMainNodesAreNotGiven) {
  const Built b(tied_square(25));
  const Mesh& m = b.loaded.mesh();
  EXPECT_GT(m.nodes.mass[b.model.nodes.map.find(11)], 0.0);
  EXPECT_TRUE(std::isnan(m.nodes.dt[b.model.nodes.map.find(1)]));
  ASSERT_EQ(m.left_out.size(), 1u);
  EXPECT_EQ(m.left_out[0].count, 4u);
}

TEST(RigidElement, GivesTheMainNodeMassAndStiffnessOnAnArm) {
  SmallDeck d = square();
  d.node(99, 5, 5, 0);
  const Built before(d);
  const Built b(d.add("/RBE2/1\nr\n        99   111 111         0         1"));
  const NodeFigures was = make_mesh(before.model).nodes, now = make_mesh(b.model).nodes;
  const NodeIndex main = b.model.nodes.map.find(99), n = b.model.nodes.map.find(1);
  EXPECT_NEAR(now.mass[main], 4.0 * was.mass[n], 1e-18);
  EXPECT_NEAR(now.stiffness[main], 4.0 * was.stiffness[n], 1e-9);
  EXPECT_NEAR(now.inertia[main], 4.0 * (was.inertia[n] + 2.0 * was.mass[n] * 50.0), 1e-15);
  EXPECT_EQ(now.stiffness[n], 1e-20);
}

TEST(Damping, RaisesTheStiffnessBySquareOfItsFactor) {
  const Built plain(square());
  const Built b(square().add("@/DAMP/1 Beta=1000 grnod_id=1"));
  const NodeFigures was = make_mesh(plain.model).nodes, now = make_mesh(b.model).nodes;
  // No more than the shortest step of the group counts: 1 step, 1 / (sqrt(2) - 1)^2.
  const double f = 1.0 / ((std::sqrt(2.0) - 1.0) * (std::sqrt(2.0) - 1.0));
  EXPECT_NEAR(now.stiffness[0], f * was.stiffness[0], 1e-9 * was.stiffness[0]);
  EXPECT_NEAR(now.dt[0], was.dt[0] / std::sqrt(f), 1e-12);
}

TEST(MovingWall, MakesTheMassOfItsNodeUnknown) {
  SmallDeck d = square();
  d.node(99, 5, 5, -9).add("@/RWALL/PLANE/1 node_ID=99 Mass=3 grnd_ID1=1");
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  EXPECT_TRUE(std::isnan(m.nodes.mass[b.model.nodes.map.find(99)]));
  ASSERT_EQ(m.left_out.size(), 1u);
}

/// Step of the shell of square() of another material.
double step(const std::string& material, const std::string& more = "") {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.add(material).shell_part(1, 2.0, 0, 7).shell(1, 1, 1, 2, 3, 4).add(more);
  const Built b(d);
  const Mesh m = make_mesh(b.model);
  EXPECT_EQ(m.left_out.empty(), !std::isnan(m.of(ElementKind::shell4).dt[0]));
  return m.of(ElementKind::shell4).dt[0];
}

TEST(ElementStep, OfRubberTakesItsModulusFromTheSumOfItsShearModuli) {
  const double e = 2 * 8 * 1.4;
  test::expect_near(
      step("/MAT/LAW62/7\nm\n               1e-06\n                 0.4         2         0\n"
           "                   3                   5\n                   2                   4"),
      10 / std::sqrt(e / (1 - 0.16) / 1e-6));
}

TEST(ElementStep, OfRubberIsNotGivenWithAReferenceGeometry) {
  const std::string geometry =
      "/XREF/1\nx\n        10\n         1                   0                   0"
      "                   0";
  const std::string rubber = "@/MAT/LAW42/7 Rho_I=1e-6 Nu=0.4 mu_1=3 alpha_1=2";
  const double v = 0.03, shear = 0.5 * 3 * 2;  // of the membrane damping; of the ground
  test::expect_near(step(rubber), 10 * test::damp(v) / std::sqrt(shear * 1.4 / (1 - 0.16) / 1e-6));
  EXPECT_TRUE(std::isnan(step(rubber, geometry)));
  test::expect_near(step("@/MAT/LAW1/7 Rho_I=7.8e-6 E=210 Nu=0.3", geometry),
                    10 / std::sqrt(210 / 7.8e-6));
}

}  // namespace
}  // namespace deck
