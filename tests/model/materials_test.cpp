// Materials: which E and B contact stiffness is formed with, law by law.
#include <cmath>

#include "model/selection_deck.hpp"

namespace deck::test {
namespace {

struct Moduli {
  double young, bulk;
  bool known;
};
Moduli moduli(const std::string& law, const std::string& lines, const std::string& more = "") {
  BuiltModel b("/MAT/" + law + "/1\nm\n" + lines + more);
  const Material& m = b.model().materials.at(0);
  return {m.young, m.bulk, m.stiffness_known};
}

TEST(Material, IsotropicElasticity) {
  const Moduli m = moduli("ELAST", reals({7.8e-6}) + reals({210, 0.3}));
  EXPECT_DOUBLE_EQ(m.young, 210);
  EXPECT_DOUBLE_EQ(m.bulk, 210 / (3 * (1 - 2 * 0.3)));
  EXPECT_TRUE(m.known);
}

TEST(Material, IncompressibleElasticityTakes0499) {
  const Moduli m = moduli("LAW1", reals({7.8e-6}) + reals({210, 0.5}));
  EXPECT_DOUBLE_EQ(m.bulk, 210 / (3 * (1 - 2 * 0.499)));
}

TEST(Material, VoidHasItsModulusInTheFirstLine) {
  const Moduli m = moduli("VOID", reals({1e-6, 5, 0.25}));
  EXPECT_DOUBLE_EQ(m.young, 5);
  EXPECT_DOUBLE_EQ(m.bulk, 5 / 1.5);
}

TEST(Material, VoidWithoutLineHasNoStiffness) {
  const Moduli m = moduli("VOID", "");
  EXPECT_EQ(m.young, 0);
  EXPECT_TRUE(m.known);
}

TEST(Material, IncompressibleVoidIsNotReported) {
  EXPECT_FALSE(moduli("VOID", reals({1e-6, 5, 0.5})).known);
}

TEST(Material, FabricTakesTheLargerDirectionWithoutLateralContraction) {
  const Moduli m = moduli("FABRI", reals({1e-6}) + reals({4, 2, 0.3}));
  EXPECT_DOUBLE_EQ(m.young, 4 / (1 - 0.3 * (0.3 * 2 / 4)));
  EXPECT_DOUBLE_EQ(m.bulk, m.young);
  EXPECT_TRUE(m.known);
}

/// E1, B1, E2, B2: the second modulus stands behind the softening of the first.
TEST(Material, FabricWithSofteningTakesTheLargerModulus) {
  EXPECT_DOUBLE_EQ(moduli("FABR_A", reals({1e-6}) + reals({4, 0.5, 6, 0.5})).young, 6);
  EXPECT_DOUBLE_EQ(moduli("FABR_A", reals({1e-6}) + reals({4, 9, 2, 9})).young, 4);
}

TEST(Material, FoamHasNoShellModulus) {
  const Moduli m = moduli("FOAM_PLAS", reals({1e-6}) + reals({3}));
  EXPECT_EQ(m.young, 0);
  EXPECT_DOUBLE_EQ(m.bulk, 3);
}

TEST(Material, ViscousFoamTakesItsModulusForBoth) {
  const Moduli m = moduli("FOAM_VISC", reals({1e-6}) + reals({3, 0.1}));
  EXPECT_DOUBLE_EQ(m.young, 3);
  EXPECT_DOUBLE_EQ(m.bulk, 3);
}

TEST(Material, OgdenTakesTwiceTheShearModulusForBulk) {
  const Moduli m =
      moduli("OGDEN", reals({1e-6}) + reals({0.495}) + reals({0.5, -0.1}) + "\n" + reals({2, -3}));
  EXPECT_DOUBLE_EQ(m.bulk, 0.5 * 2 + 0.1 * 3);
  EXPECT_DOUBLE_EQ(m.young, 1.3 * 1.495);
  EXPECT_TRUE(m.known);
}

TEST(Material, OgdenWithViscosityTakesTheTrueBulkModulus) {
  std::string line = reals({0.4});
  line.pop_back();
  line.resize(80, ' ');
  const Moduli m =
      moduli("LAW42", reals({1e-6}) + line + "         1\n" + reals({0.5}) + "\n" + reals({2}));
  EXPECT_DOUBLE_EQ(m.bulk, 1.4 / (3 * (1 - 0.8)));
}

TEST(Material, HyperfoamSumsItsModuli) {
  std::string line = reals({0.2});
  line.pop_back();
  const Moduli m =
      moduli("LAW62", reals({1e-6}) + line + cells({2, 0}) + reals({3, 1}) + reals({2, 4}));
  EXPECT_DOUBLE_EQ(m.young, 8 * 1.2);
  EXPECT_DOUBLE_EQ(m.bulk, 8 * (1.0 / 3 + 0.2 / 0.6));
}

TEST(Material, LawWithoutRuleIsMarked) {
  EXPECT_FALSE(moduli("LAW69", reals({1e-6}) + "\n").known);
  EXPECT_FALSE(moduli("GAS", "\n").known);
}

TEST(Material, EquationOfStateOverridesTheBulkModulus) {
  const Moduli m = moduli("HYD_JCOOK", reals({1e-6}) + reals({210, 0.3}),
                          "/EOS/POLYNOMIAL/1\ne\n" + reals({0, 150, 0}));
  // Only a bulk modulus that was read may be reported.
  EXPECT_TRUE(!m.known || m.bulk == 150);
}

TEST(Material, EquationOfStateWithoutMaterialIsReported) {
  BuiltModel b("/EOS/POLYNOMIAL/3\ne\n" + reals({0, 150, 0}));
  EXPECT_EQ(b.findings(RuleId::DK118), 1u);
}

TEST(Material, HeatDataMakeItThermal) {
  BuiltModel b("/MAT/ELAST/1\nm\n" + reals({1}) + reals({1, 0.3}) + "/HEAT/MAT/1\n" +
               reals({1, 2}));
  EXPECT_TRUE(b.model().materials[0].thermal);
  EXPECT_TRUE(b.model().has_thermal_material);
}

TEST(Material, ValuesAreInWorkingUnits) {
  BuiltModel b("/MAT/ELAST/1\nm\n" + reals({7800}) + reals({210e9, 0.3}), "kg m s");
  EXPECT_NEAR(b.model().materials[0].density / 7.8e-6, 1, 1e-14);
  EXPECT_NEAR(b.model().materials[0].young / 210, 1, 1e-14);
}

}  // namespace
}  // namespace deck::test
