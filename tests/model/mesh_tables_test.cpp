// Moduli and speeds of materials by law, for time steps: the formulas of time_step.md, section 1.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/small_deck.hpp"
#include "lint/support.hpp"
#include "model/mesh/mesh_parts.hpp"

namespace deck::test {
namespace {

using detail::MaterialFigures;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

LoadedDeck deck_of(const std::string& text) {
  auto deck =
      read_deck_text("tables_0000.rad", example_deck("@bare\n" + text, SchemaSet::built_in()).main,
                     SchemaSet::built_in());
  EXPECT_TRUE(deck.ok());
  LoadOptions how;
  how.geometry = false;
  return LoadedDeck::from(std::move(*deck), how);
}

void expect_same(double got, double wanted, const std::string& of) {
  if (std::isnan(wanted))
    EXPECT_TRUE(std::isnan(got)) << of << ": " << got;
  else
    EXPECT_NEAR(got, wanted, 1e-12 * std::abs(wanted)) << of;
}

/// The moduli that stand in the square of each speed: density is 2.
struct Moduli {
  double shell = unknown, solid = unknown, stored = unknown, plate = unknown;
};

void expect_moduli(const std::string& text, const Moduli& wanted) {
  const LoadedDeck d = deck_of(text);
  const auto figures = detail::material_figures(d.model());
  ASSERT_EQ(figures.size(), 1u) << text;
  const MaterialFigures& m = figures[0];
  const auto modulus = [](double speed) { return speed * speed * 2; };
  expect_same(modulus(m.shell_speed), wanted.shell, "shell " + text);
  expect_same(modulus(m.solid_speed), wanted.solid, "solid " + text);
  expect_same(modulus(m.stored_speed), wanted.stored, "stored " + text);
  expect_same(m.plate_modulus, wanted.plate, "plate " + text);
}

constexpr double e = 210, nu = 0.25, g = e / (2 * (1 + nu)), bulk = e / (3 * (1 - 2 * nu)),
                 plate = e / (1 - nu * nu);

std::string law(const char* number, const std::string& fields = "E=210 Nu=0.25") {
  return "@/MAT/LAW" + std::string(number) + "/1 Rho_I=2 " + fields + "\n";
}

TEST(MaterialFigures, OfElasticLawsFollowFromTheirTwoConstants) {
  const double solid = bulk + 4.0 / 3 * g;
  for (const char* number : {"1", "0", "13", "65"})
    expect_moduli(law(number), {e, solid, e, plate});
  expect_moduli(law("36"), {plate, solid, e, plate});
  expect_moduli(law("38"), {plate, solid, e, e});
  expect_moduli(law("23"), {e, bulk + 1.333 * g, e, plate});
  expect_moduli(law("24"), {e, unknown, e, plate});
  expect_moduli(law("35"), {plate, e + 4.0 / 3 * g, e, plate});
  expect_moduli(law("33", "E=210"), {e, e, e, e});
  expect_moduli(law("58", "E1=30 E2=210"), {e, e / 3 + 4.0 / 3 * e / 2, e, e});
  expect_moduli(law("58", "E1=210 E2=30"), {e, e / 3 + 4.0 / 3 * e / 2, e, e});
  expect_moduli(law("5", ""), {unknown, unknown, 0, unknown});
  expect_moduli(law("0", ""), {0, unknown, 0, 0});
}

TEST(MaterialFigures, OfBulkAndShearModulusBecomeTheTwoConstants) {
  const double k = 100, shear = 30;
  const double young = 9 * k * shear / (3 * k + shear),
               poisson = (3 * k - 2 * shear) / (6 * k + 2 * shear);
  expect_moduli(law("34", "K=100 G0=30"),
                {young / (1 - poisson * poisson), k + 4.0 / 3 * shear, young, young});
}

TEST(MaterialFigures, OfRubberHaveHalfTheSumOfTheirProducts) {
  const double ground = 0.5 * (3 * 2 + 5 * 4 + 7 * -1.5), v = 0.4;
  const double young = 2 * ground * (1 + v), twice = 2 * ground;
  expect_moduli(
      law("42", "Nu=0.4 mu_1=3 alpha_1=2 mu_2=5 alpha_2=4 mu_5=7 alpha_5=-1.5"),
      {ground * (1 + v) / (1 - v * v), twice * (1 + v) / (3 * (1 - 2 * v)) + 4.0 / 3 * twice, young,
       young / (1 - v * v)});
}

TEST(MaterialFigures, OfLayersHaveTheLargerModulusOfThePlane) {
  const double n = 0.3;
  for (const auto& [e1, e2] : {std::pair(40., 90.), {90., 40.}}) {
    const double m = std::max(e1, e2) / (1 - n * n * e2 / e1);
    const std::string moduli = "E11=" + std::to_string(e1) + " E22=" + std::to_string(e2);
    expect_moduli(law("19", moduli + " Nu12=0.3 G12=7"), {m, unknown, m, m});
    expect_moduli(law("25", moduli + " NU12=0.3 G12=7"), {m, m, m, m});
    expect_moduli(law("15", moduli), {unknown, unknown, unknown, unknown});
  }
  const LoadedDeck d = deck_of(law("25", "E11=40 E22=90 NU12=0.3 G12=7"));
  EXPECT_EQ(detail::material_figures(d.model())[0].shear, 7);
}

TEST(MaterialFigures, OfOrthotropicSolidsHaveTheLargestEntryOfTheirStiffness) {
  // The stiffness is the inverse of the matrix of compliance.
  const auto largest = [](double e1, double e2, double e3, double shear) {
    const double n12 = 0.2, n23 = 0.15, n31 = 0.1;
    const double s11 = 1 / e1, s22 = 1 / e2, s33 = 1 / e3, s12 = -n12 / e1, s23 = -n23 / e2,
                 s31 = -n31 / e3;
    const double det =
        s11 * s22 * s33 + 2 * s12 * s23 * s31 - s11 * s23 * s23 - s22 * s31 * s31 - s33 * s12 * s12;
    return std::max({(s22 * s33 - s23 * s23) / det, (s11 * s33 - s31 * s31) / det,
                     (s11 * s22 - s12 * s12) / det, shear});
  };
  for (const auto& [e1, e2, e3] : {std::array{50., 20., 30.}, {20., 50., 30.}, {20., 30., 50.}})
    for (int at = 0; at < 4; ++at) {
      const char* shears[] = {"G12", "G23", "G31"};
      std::string fields = "E11=" + std::to_string(e1) + " E22=" + std::to_string(e2) +
                           " E33=" + std::to_string(e3) + " ";
      for (int i = 0; i < 3; ++i) fields += std::string(shears[i]) + "=" + (i == at ? "90 " : "3 ");
      const double wanted = largest(e1, e2, e3, at < 3 ? 90 : 3);
      for (const auto& [number, names] : {std::pair("12", "nu12=0.2 nu23=0.15 nu31=0.1"),
                                          {"14", "NU12=0.2 NU23=0.15 NU31=0.1"}}) {
        const LoadedDeck d = deck_of(law(number, fields + names));
        const auto m = detail::material_figures(d.model());
        expect_same(m[0].solid_speed * m[0].solid_speed * 2, wanted, fields);
      }
    }
}

TEST(MaterialFigures, OfFluidsTakeTheBulkModulusOfTheirStateEquation) {
  const auto eos = [](const std::string& kind, const std::string& fields, const char* id = "1") {
    return "@/EOS/" + kind + "/" + id + " " + fields + "\n";
  };
  const double shear = 4.0 / 3 * g;
  for (const char* number : {"3", "4"}) {
    expect_moduli(law(number) + eos("POLYNOMIAL", "C1=50"), {e, 50 + 1.333 * g, e, plate});
    expect_moduli(law(number), {e, unknown, e, plate});
  }
  expect_moduli(law("6", "") + eos("POLYNOMIAL", "C1=-50"), {unknown, 50, 0, unknown});
  const auto solid = [&](const std::string& more, double wanted) {
    expect_moduli(law("36") + more, {plate, wanted, e, plate});
  };
  solid(eos("POLYNOMIAL", "C1=50", "7"), bulk + shear);  // of another material
  solid(eos("POLYNOMIAL", "C1=50"), 50 + shear);
  solid(eos("POLYNOMIAL", "C1=50 E0=3"), 50 + shear);
  solid(eos("POLYNOMIAL", "C1=50 C4=3 C5=2"), 50 + shear);
  solid(eos("POLYNOMIAL", "C1=50 C4=3 E0=3"), unknown);
  solid(eos("POLYNOMIAL", "C1=50 C5=3 E0=3"), unknown);
  solid(eos("POLYNOMIAL", "C2=50"), unknown);
  solid("/EOS/LINEAR/1\ne\n", unknown);
  expect_moduli(law("21", "E=210 Nu=0.25 K=40 B=60"), {e, 60 + 1.333 * g, e, plate});
  expect_moduli(law("21", "E=210 Nu=0.25 K=80 B=60"), {e, 80 + 1.333 * g, e, plate});
}

TEST(MaterialFigures, OfFoamHaveTheSteepestOfTheirCurves) {
  const std::string curves =
      "/FUNCT/7\nf\n                   0                   0\n                   1"
      "                  10\n                   3                  50\n"
      "                   4                  40\n"
      "/FUNCT/8\nf\n                   0                   0\n                   2"
      "                 100\n";
  const auto young = [&](const std::string& fields) {
    const LoadedDeck d = deck_of(law("70", "E=30 Nu=0.25 " + fields) + curves);
    return detail::material_figures(d.model()).at(0).young;
  };
  expect_same(young("Nload=1 funcID_id=7 Fscale_load=2"), 40, "20 times 2");
  expect_same(young("Nload=1 funcID_id=7"), 30, "20 is below E");
  expect_same(young("Nload=1 funcID_id=8"), 50, "");
  expect_same(young("Nload=1 funcID_id=7 Nunload=1 funcID_id_2=8 Fscale_unload=3"), 150, "");
  expect_same(young("Nload=1 funcID_id=99"), 30, "no such curve");
}

}  // namespace
}  // namespace deck::test
