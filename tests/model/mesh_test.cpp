// Time steps and masses of elements and nodes by hand: lengths over sound speeds.
#include "model/shared/mesh.hpp"

#include <fmt/printf.h>
#include <gtest/gtest.h>

#include <cmath>

#include "deck/front/loaded_deck.hpp"
#include "lint/shared/example.hpp"

namespace deck {
namespace {

constexpr double young = 210, nu = 0.3, density = 7.8e-6;
const double line_speed = std::sqrt(young / density);
const double solid_speed =
    std::sqrt((young / (3 * (1 - 2 * nu)) + 4.0 / 3.0 * young / (2 * (1 + nu))) / density);

/// Part 1 of this property and steel; nodes of a cube of side 10, 1 to 4 below and 5 to 8 above.
struct OnePart {
  OnePart(const std::string& property, const std::string& elements, const std::string& more = "",
          const std::string& material = "@/MAT/LAW1/1 Rho_I=7.8e-6 E=210 Nu=0.3")
      : loaded(read("@bare\n/NODE\n" + nodes() + material + "\n@/PROP/" + property +
                    "\n/PART/1\np\n         1         1\n" + elements + "\n" + more)),
        mesh(make_mesh(loaded.model())) {}
  static LoadedDeck read(const std::string& text) {
    auto deck = read_deck_text("one_part_0000.rad", example_deck(text, SchemaSet::built_in()).main,
                               SchemaSet::built_in());
    EXPECT_TRUE(deck.ok());
    LoadOptions options;
    options.geometry = false;
    return LoadedDeck::from(std::move(*deck), options);
  }
  static std::string nodes() {
    std::string out;
    for (int i = 0; i < 8; ++i) {
      const int x = i % 4 == 1 || i % 4 == 2 ? 10 : 0, y = i % 4 > 1 ? 10 : 0, z = i / 4 * 10;
      out += fmt::sprintf("%10d%20d%20d%20d\n", i + 1, x, y, z);
    }
    return out;
  }
  double step(ElementKind kind) const { return mesh.of(kind).dt.at(0); }
  double mass(ElementKind kind) const { return mesh.of(kind).mass.at(0); }
  LoadedDeck loaded;
  Mesh mesh;
};

void expect_near(double got, double wanted) { EXPECT_NEAR(got, wanted, 1e-12 * wanted); }

TEST(MeshSteps, ShellHasItsSideOverTheSpeedOfALine) {
  const OnePart m("TYPE1/1 Thick=2",
                  "/SHELL/1\n         1         1         2         3         4");
  expect_near(m.step(ElementKind::shell4), 10 / line_speed);
  expect_near(m.mass(ElementKind::shell4), 10 * 10 * 2 * density);
}

TEST(MeshSteps, ShellOfIshell24HasALengthOfItsOwn) {
  const OnePart m("TYPE1/1 Ishell=24 Thick=2",
                  "/SHELL/1\n         1         1         2         3         4");
  // Of a square of side l: |p| = |q| = l/sqrt(2), a2 = 0, c1 = c2 = l, f1 = 1.
  const double u = 3.413F * (1 - static_cast<double>(0.7071F));
  const double f2 = static_cast<double>(0.78F) + static_cast<double>(0.22F) * u * u * u;
  const double length = 100 / std::sqrt(2 * f2 * 1.25 * 50);
  expect_near(m.step(ElementKind::shell4),
              length * (std::sqrt(1 + 0.015 * 0.015) - 0.015) / line_speed);
}

TEST(MeshSteps, TriangleHasTwiceItsAreaOverItsLongestSide) {
  const OnePart m("TYPE1/1 Thick=2", "/SH3N/1\n         1         1         2         3");
  expect_near(m.step(ElementKind::shell3), 100 / std::sqrt(200) / line_speed);
  expect_near(m.mass(ElementKind::shell3), 50 * 2 * density);
}

TEST(MeshSteps, BrickHasItsSideOverTheSpeedOfASolidAndItsBulkViscosity) {
  const OnePart m("TYPE14/1",
                  "/BRICK/1\n         1         1         2         3         4         5         6"
                  "         7         8");
  expect_near(m.step(ElementKind::solid8), 10 / ((0.05 + std::sqrt(1.0025)) * solid_speed));
  expect_near(m.mass(ElementKind::solid8), 1000 * density);
}

TEST(MeshSteps, TetrahedronHasItsSmallestHeight) {
  const OnePart m("TYPE14/1", "/TETRA4/1\n         1         1         2         4         5");
  const double height = 10 / std::sqrt(3);  // over the face between the three other corners
  expect_near(m.step(ElementKind::solid8), height / ((0.05 + std::sqrt(1.0025)) * solid_speed));
  expect_near(m.mass(ElementKind::solid8), 1000.0 / 6 * density);
}

TEST(MeshSteps, TrussHasItsLengthOverTheSpeedOfALine) {
  const OnePart m("TYPE2/1 Area=3", "/TRUSS/1\n         1         1         2");
  expect_near(m.step(ElementKind::truss), 10 / line_speed);
  expect_near(m.mass(ElementKind::truss), 10 * 3 * density);
}

TEST(MeshSteps, RubberTakesItsModulusFromTheSumOfItsShearModuli) {
  const OnePart m(
      "TYPE1/1 Thick=2", "/SHELL/1\n         1         1         2         3         4", "",
      "/MAT/LAW62/1\nm\n               1e-06\n                 0.4         2         0\n"
      "                   3                   5\n                   2                   4");
  const double e = 2 * 8 * 1.4;
  expect_near(m.step(ElementKind::shell4), 10 / std::sqrt(e / (1 - 0.16) / 1e-6));
}

TEST(MeshSteps, NodesHaveAQuarterOfTheMassOfAShell) {
  const OnePart m("TYPE1/1 Thick=2",
                  "/SHELL/1\n         1         1         2         3         4");
  const NodeIndex first = m.loaded.model().find_node(1), other = m.loaded.model().find_node(5);
  expect_near(m.mesh.nodes.mass[first], 50 * density);
  EXPECT_EQ(m.mesh.nodes.dt[other], no_step) << "no element has it";
  EXPECT_LT(m.mesh.nodes.dt[first], no_step);
  EXPECT_EQ(m.mesh.total.slowest.element, 0u);
  expect_near(m.mesh.total.dt, m.step(ElementKind::shell4));
}

TEST(MeshSteps, AReferenceGeometryLeavesAPartOfRubberOut) {
  const std::string shell = "/SHELL/1\n         1         1         2         3         4";
  const std::string geometry =
      "/XREF/1\nx\n        10\n         1                   0                   0"
      "                   0";
  const std::string rubber = "@/MAT/LAW42/1 Rho_I=1e-6 Nu=0.4 mu_1=3 alpha_1=2";
  const OnePart plain("TYPE1/1 Thick=2", shell, "", rubber);
  const double v = 0.03, shear = 0.5 * 3 * 2;  // of the membrane damping; of the ground
  expect_near(plain.step(ElementKind::shell4),
              10 * (std::sqrt(1 + v * v) - v) / std::sqrt(shear * 1.4 / (1 - 0.16) / 1e-6));
  const OnePart shaped("TYPE1/1 Thick=2", shell, geometry, rubber);
  EXPECT_TRUE(std::isnan(shaped.step(ElementKind::shell4)));
  EXPECT_FALSE(shaped.mesh.left_out.empty());
  const OnePart steel("TYPE1/1 Thick=2", shell, geometry);
  expect_near(steel.step(ElementKind::shell4), 10 / line_speed);
}

}  // namespace
}  // namespace deck
