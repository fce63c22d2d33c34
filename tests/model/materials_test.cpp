// Materials: which E and B contact stiffness is formed with, law by law.

#include "model/selection_deck.hpp"

namespace deck::test {
namespace {

/// `line` of reals, filled up to 80 columns.
std::string to_80(std::string line) {
  line.pop_back();
  line.resize(80, ' ');
  return line;
}

TEST(Material, HasTheModuliOfItsLaw) {
  constexpr double any = -1;
  const std::string density = reals({1e-6});
  const double fabric = 4 / (1 - 0.3 * (0.3 * 2 / 4));
  struct Row {
    std::string law, lines;
    double young, bulk;
    bool known = true;
  };
  const Row rows[] = {
      {"ELAST", density + reals({210, 0.3}), 210, 210 / (3 * (1 - 2 * 0.3))},
      {"LAW1", density + reals({210, 0.5}), 210, 210 / (3 * (1 - 2 * 0.499))},
      {"VOID", reals({1e-6, 5, 0.25}), 5, 5 / 1.5},
      {"VOID", "", 0, any},
      {"VOID", reals({1e-6, 5, 0.5}), any, any, false},
      {"FABRI", density + reals({4, 2, 0.3}), fabric, fabric},
      // E1, B1, E2, B2: the second modulus stands behind the softening of the first.
      {"FABR_A", density + reals({4, 0.5, 6, 0.5}), 6, any, false},
      {"FABR_A", density + reals({4, 9, 2, 9}), 4, any, false},
      {"FOAM_PLAS", density + reals({3}), 0, 3},
      {"FOAM_VISC", density + reals({3, 0.1}), 3, 3},
      {"OGDEN", density + reals({0.495}) + reals({0.5, -0.1}) + "\n" + reals({2, -3}), 1.3 * 1.495,
       0.5 * 2 + 0.1 * 3},
      {"LAW42", density + to_80(reals({0.4})) + "         1\n" + reals({0.5}) + "\n" + reals({2}),
       any, 1.4 / (3 * (1 - 0.8))},
      {"LAW62",
       density + to_80(reals({0.2})).substr(0, 20) + cells({2, 0}) + reals({3, 1}) + reals({2, 4}),
       8 * 1.2, 8 * (1.0 / 3 + 0.2 / 0.6)},
      {"LAW69", density + "\n", any, any, false},
      {"GAS", "\n", any, any, false},
  };
  for (const Row& r : rows) {
    BuiltModel b("/MAT/" + r.law + "/1\nm\n" + r.lines);
    const Material& m = b.model().materials.at(0);
    EXPECT_EQ(m.stiffness_known, r.known) << r.law << r.lines;
    if (r.young != any) {
      EXPECT_DOUBLE_EQ(m.young, r.young) << r.law << r.lines;
    }
    if (r.bulk != any) {
      EXPECT_DOUBLE_EQ(m.bulk, r.bulk) << r.law << r.lines;
    }
  }
}

TEST(Material, OfOgdenHasTenTermsFromVersion2025On) {
  const std::string block = "/MAT/OGDEN/1\nm\n" + reals({1e-6}) + reals({0.495}) + reals({0.5}) +
                            reals({0.25}) + reals({2}) + reals({4});
  EXPECT_DOUBLE_EQ(BuiltModel(block, "kg mm ms", 2025).model().materials.at(0).young, 2 * 1.495);
  EXPECT_DOUBLE_EQ(BuiltModel(block, "kg mm ms", 2024).model().materials.at(0).young, 1.495);
}

TEST(Material, TakesOnlyABulkModulusOfAnEquationOfStateThatWasRead) {
  const std::string state = "/EOS/POLYNOMIAL/1\ne\n" + reals({0, 150, 0});
  BuiltModel b("/MAT/HYD_JCOOK/1\nm\n" + reals({1e-6}) + reals({210, 0.3}) + state);
  const Material& m = b.model().materials.at(0);
  EXPECT_TRUE(!m.stiffness_known || m.bulk == 150);
  EXPECT_EQ(BuiltModel(state).findings(RuleId::DK118), 1u) << "no such material";
}

TEST(Material, IsThermalWithHeatDataAndInWorkingUnits) {
  BuiltModel b(
      "/MAT/ELAST/1\nm\n" + reals({7800}) + reals({210e9, 0.3}) + "/HEAT/MAT/1\n" + reals({1, 2}),
      "kg m s");
  EXPECT_TRUE(b.model().materials[0].thermal);
  EXPECT_TRUE(b.model().has_thermal_material);
  EXPECT_NEAR(b.model().materials[0].density / 7.8e-6, 1, 1e-14);
  EXPECT_NEAR(b.model().materials[0].young / 210, 1, 1e-14);
}

}  // namespace
}  // namespace deck::test
