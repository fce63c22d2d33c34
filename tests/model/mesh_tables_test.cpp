// What materials and properties say about time steps: moduli and speeds by law, formulations and
// springs by their cards. The formulas are those of time_step.md, sections 1, 2 and 5.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/small_deck.hpp"
#include "lint/support.hpp"
#include "model/mesh/mesh_parts.hpp"

namespace deck::test {
namespace {

using detail::MaterialFigures;
using detail::PropertyFigures;
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

TEST(MaterialFigures, HaveTheReferenceDensityWhereThereIsOne) {
  const LoadedDeck d = deck_of(
      "@/MAT/LAW1/1 Rho_I=4 Rho_0=2 E=210 Nu=0.25\n@/MAT/LAW1/2 Rho_I=4 E=210 Nu=0.5\n"
      "@/MAT/LAW36/3 Rho_I=4 E=210 Nu=0.25\n");
  const auto m = detail::material_figures(d.model());
  ASSERT_EQ(m.size(), 3u);
  EXPECT_EQ(m[0].law, 1);
  EXPECT_EQ(m[0].density, 4);
  EXPECT_EQ(m[0].reference_density, 2);
  EXPECT_EQ(m[0].young, 210);
  EXPECT_EQ(m[0].poisson, 0.25);
  expect_same(m[0].shear, g, "shear");
  expect_same(m[0].stored_speed, std::sqrt(210.0 / 2), "speed");
  expect_same(m[0].tetra_ratio, 2 * g / (bulk + 4.0 / 3 * g), "ratio");
  EXPECT_EQ(m[0].fixed_step, 0);
  EXPECT_EQ(m[1].reference_density, 4);
  EXPECT_EQ(m[1].poisson, 0.499) << "which is below a half";
  EXPECT_EQ(m[2].law, 36);
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

TEST(MaterialFigures, OfHoneycombsHaveTheLargestModulus) {
  const char* names[] = {"E11", "E22", "E33", "G12", "G23", "G31"};
  for (const char* number : {"28", "50", "68"})
    for (int largest = 0; largest < 6; ++largest) {
      std::string fields;
      for (int i = 0; i < 6; ++i) {
        std::string name = names[i];
        if (std::string(number) != "50" && i > 2) name.insert(1, "_");
        fields += name + "=" + (i == largest ? "50 " : "2 ");
      }
      const LoadedDeck d = deck_of(law(number, fields));
      const auto m = detail::material_figures(d.model());
      expect_same(m[0].solid_speed, 5, number + fields);
      EXPECT_TRUE(std::isnan(m[0].shell_speed));
    }
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

TEST(MaterialFigures, OfSomeLawsHaveAFixedStepOrNoDensity) {
  const auto of = [](const std::string& text) {
    return detail::material_figures(deck_of(text).model()).at(0);
  };
  EXPECT_EQ(of(law("11", "")).fixed_step, 1000);
  for (const char* number : {"59", "83", "116", "117"})
    EXPECT_EQ(of(law(number, "")).fixed_step, 1e20) << number;
  EXPECT_EQ(of(law("51", "Iform=6")).fixed_step, 1e20);
  EXPECT_EQ(of(law("51", "Iform=1")).fixed_step, 0);
  for (const char* number : {"37", "51", "151"}) {
    EXPECT_TRUE(std::isnan(of("@/MAT/LAW" + std::string(number) + "/1\n").density)) << number;
    EXPECT_TRUE(std::isnan(of("@/MAT/LAW" + std::string(number) + "/1\n").solid_speed));
  }
  EXPECT_EQ(of(law("36")).density, 2);
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

// ---- properties --------------------------------------------------------------------------------

PropertyFigures property(const std::string& text) {
  const LoadedDeck d = deck_of(text);
  const auto all = detail::property_figures(d.model());
  EXPECT_EQ(all.size(), 1u);
  return all.at(0);
}

TEST(PropertyFigures, OfShellsHaveTheirFormulationOrThatOfTheDeck) {
  const auto of = [](const std::string& fields, const std::string& defaults = "") {
    const PropertyFigures p = property("@/PROP/TYPE1/1 Thick=2 " + fields + "\n" + defaults);
    EXPECT_EQ(p.type, 1);
    EXPECT_EQ(p.thickness, 2);
    return std::array{p.ishell, p.ish3n};
  };
  using Pair = std::array<int, 2>;
  EXPECT_EQ(of(""), (Pair{0, 2}));
  EXPECT_EQ(of("Ishell=3 Ish3n=30"), (Pair{3, 30}));
  EXPECT_EQ(of("Ishell=22"), (Pair{24, 2}));
  EXPECT_EQ(of("Ishell=23"), (Pair{24, 2}));
  EXPECT_EQ(of("", "@/DEF_SHELL Ishell=12 Ish3n=30"), (Pair{12, 30}));
  EXPECT_EQ(of("", "@/DEF_SHELL Ishell=12"), (Pair{12, 2}));
  EXPECT_EQ(of("Ishell=4 Ish3n=1", "@/DEF_SHELL Ishell=12 Ish3n=30"), (Pair{4, 1}));
  const PropertyFigures p = property("@/PROP/TYPE1/1 dm=0.3 dn=0.4\n");
  EXPECT_EQ(p.membrane, 0.3);
  EXPECT_EQ(p.numeric, 0.4);
}

TEST(PropertyFigures, OfSolidsHaveTheirFormulationAndViscosity) {
  const PropertyFigures p = property(
      "@/PROP/TYPE14/1 Isolid=17 Itetra10=2 Inpts=222 qa=1.2 qb=0.06 Lambda_V=0.1 Mu_V=0.2\n");
  EXPECT_EQ(p.type, 14);
  EXPECT_EQ(p.isolid, 17);
  EXPECT_EQ(p.itetra10, 2);
  EXPECT_EQ(p.inpts, 222);
  EXPECT_EQ(p.qb, 0.06);
  EXPECT_EQ(p.lambda, 0.1);
  EXPECT_EQ(p.mu, 0.2);
  EXPECT_FALSE(p.viscosity_blank);
  const PropertyFigures blank = property("@/PROP/TYPE14/1\n@/DEF_SOLID Isolid=24 Itetra10=3\n");
  EXPECT_EQ(blank.isolid, 24);
  EXPECT_EQ(blank.itetra10, 3);
  EXPECT_EQ(blank.qb, 0.05);
  EXPECT_TRUE(blank.viscosity_blank);
  EXPECT_EQ(property("@/PROP/TYPE14/1\n").isolid, 0);
  EXPECT_FALSE(property("@/PROP/TYPE14/1 qa=1\n").viscosity_blank);
  EXPECT_FALSE(property("@/PROP/TYPE14/1 qb=1\n").viscosity_blank);
  const PropertyFigures thick = property("@/PROP/TYPE20/1 Isolid=14 Inpts=232 Icstr=10\n");
  EXPECT_EQ(thick.isolid, 14);
  EXPECT_EQ(thick.inpts, 232);
  EXPECT_EQ(thick.icstr, 10);
}

TEST(PropertyFigures, OfBeamsHaveTheirSection) {
  const PropertyFigures p = property("@/PROP/TYPE3/1 dm=0.1 df=0.2 Area=5 Iyy=7 Izz=8 Ixx=9\n");
  EXPECT_EQ(p.area, 5);
  EXPECT_EQ(p.iyy, 7);
  EXPECT_EQ(p.izz, 8);
  EXPECT_EQ(p.ixx, 9);
  EXPECT_EQ(p.beam_membrane, 0.1);
  EXPECT_EQ(p.beam_bending, 0.2);
  const PropertyFigures blank = property("@/PROP/TYPE3/1 Area=5 Iyy=7 Izz=8 Ixx=9\n");
  EXPECT_EQ(blank.beam_membrane, 0);
  EXPECT_EQ(blank.beam_bending, 0.01);
}

const std::string slope_six =
    "/FUNCT/7\nf\n                   0                   0\n                   1"
    "                   6\n                   2                   8\n"
    "                   2                   9\n";

TEST(PropertyFigures, OfSpringsOfOneDirectionHaveTheSteeperOfStiffnessAndCurve) {
  const auto of = [](const std::string& fields, const char* type = "4") {
    const PropertyFigures p =
        property("@/PROP/TYPE" + std::string(type) + "/1 Mass=5 " + fields + "\n" + slope_six);
    EXPECT_EQ(p.spring_mass, 5);
    EXPECT_EQ(p.freedom[1].k, 0);
    return std::tuple(p.freedom[0].k, p.freedom[0].c, p.freedom[0].known, p.per_length);
  };
  using Row = std::tuple<double, double, bool, bool>;
  EXPECT_EQ(of("K=3 C=2"), Row(3, 2, true, false));
  EXPECT_EQ(of("K=3 C=2 Ileng=1"), Row(3, 2, true, true));
  EXPECT_EQ(of("K=3 A=2"), Row(6, 0, true, false));
  EXPECT_EQ(of("K=3 fct_ID11=7"), Row(6, 0, true, false));
  EXPECT_EQ(of("K=3 fct_ID11=7 AScale1=5"), Row(30, 0, true, false));
  EXPECT_EQ(of("K=8 A=2 fct_ID11=7"), Row(16, 0, true, false));
  EXPECT_EQ(of("K=3 fct_ID11=9"), Row(3, 0, false, false)) << "no such curve";
  EXPECT_EQ(of("K=3 fct_ID21=7"), Row(3, 0, false, false)) << "of the speed";
  EXPECT_EQ(of("K=3 fct_ID41=7"), Row(3, 0, false, false));
  EXPECT_EQ(of("K=3 C1=2", "12"), Row(3, 2, true, false));
  EXPECT_EQ(of("K=3 fct_ID11=7 AScale1=5", "12"), Row(30, 0, true, false));
}

TEST(PropertyFigures, OfSpringsOfSeveralDirectionsHaveOneRowEach) {
  for (const auto& [type, count] : {std::pair("8", 6), {"13", 6}, {"25", 4}}) {
    std::string fields = " Mass=5 Inertia=11";
    for (int i = 1; i <= count; ++i) {
      const std::string n = std::to_string(i);
      fields += " K" + n + "=" + n + "00 C" + n + "=" + n + " A" + n + "=2";
    }
    const PropertyFigures p = property("@/PROP/TYPE" + std::string(type) + "/1" + fields + "\n");
    EXPECT_EQ(p.spring_inertia, 11);
    for (int i = 0; i < 6; ++i) {
      const auto& f = p.freedom[static_cast<std::size_t>(i)];
      EXPECT_EQ(f.k, i < count ? 200 * (i + 1) : 0) << type;
      EXPECT_EQ(f.c, i < count ? i + 1 : 0) << type;
      EXPECT_TRUE(f.known);
    }
  }
  const PropertyFigures p =
      property("@/PROP/TYPE8/1 Mass=5 K3=2 fct_ID13=7 Ascale3=4\n" + slope_six);
  EXPECT_EQ(p.freedom[2].k, 24);
}

// ---- rows of parts -----------------------------------------------------------------------------

const std::string steel = "@/MAT/LAW1/1 Rho_I=2 E=210 Nu=0.25\n@/PROP/TYPE1/1 Thick=3\n";

std::string part_card(int id, int prop, int mat) {
  char text[64];
  std::snprintf(text, sizeof text, "/PART/%d\np\n%10d%10d\n", id, prop, mat);
  return text;
}

/// Why elements of the first part have no step; "": they have.
std::string why(const std::string& text) {
  const LoadedDeck d = deck_of(text);
  const auto rows = detail::part_rows(d.model());
  return rows.at(0).why == nullptr ? "" : rows.at(0).why;
}

TEST(PartRows, SayWhyThereIsNoStep) {
  EXPECT_EQ(why(steel + part_card(1, 1, 1)), "");
  EXPECT_EQ(why(steel + part_card(1, 9, 1)), "the part has no property");
  EXPECT_EQ(why(steel + part_card(1, 1, 9)), "the part has no material");
  for (const char* type :
       {"4", "8", "12", "13", "25", "26", "27", "32", "33", "35", "36", "44", "45", "46"})
    EXPECT_EQ(why("@/PROP/TYPE" + std::string(type) + "/1\n" + part_card(1, 1, 0)), "") << type;
  for (const char* type : {"3", "2", "14", "23", "43"})
    EXPECT_EQ(why("@/PROP/TYPE" + std::string(type) + "/1\n" + part_card(1, 1, 0)),
              "the part has no material")
        << type;
  const std::string rigid = "@/MAT/LAW13/2 Rho_I=2 E=210 Nu=0.25\n" + part_card(2, 1, 2);
  EXPECT_EQ(why(steel + part_card(1, 1, 1) + rigid), "a material of law 13 is in the deck");
  EXPECT_EQ(why("@/MAT/LAW13/1 Rho_I=2 E=210 Nu=0.25\n@/PROP/TYPE1/1\n" + part_card(1, 1, 1)), "");
}

TEST(PartRows, OfSomeLawsHaveNoStepWithAReferenceGeometry) {
  const std::string geometry =
      "/XREF/1\nx\n        10\n         1                   0"
      "                   0                   0\n";
  const std::string reason = "a reference geometry enters";
  for (const auto& [number, fields] : {std::pair("19", "E11=40 E22=90 Nu12=0.3 G12=7"),
                                       {"58", "E1=30 E2=20"},
                                       {"35", "E=210"},
                                       {"38", "E=210"},
                                       {"42", "Nu=0.4 mu_1=3 alpha_1=2"},
                                       {"70", "E=210"}}) {
    const std::string text = law(number, fields) + "@/PROP/TYPE1/1\n" + part_card(1, 1, 1);
    EXPECT_EQ(why(text), "") << number;
    EXPECT_EQ(why(text + geometry), reason) << number;
    EXPECT_EQ(why(text + "/XREF/2\nx\n        10\n"), "") << "of another part";
    EXPECT_EQ(why(text + "/EREF/SHELL/2\n         1\n"), reason) << number;
  }
  EXPECT_EQ(why(steel + part_card(1, 1, 1) + geometry), "");
}

TEST(PartRows, AReferenceStateCountsWhereItsFileIsThere) {
  const Folder folder;
  const auto reason = [&](const std::string& name) {
    const std::string text =
        example_deck("@bare\n" + law("42", "Nu=0.4 mu_1=3 alpha_1=2") + "@/PROP/TYPE1/1\n" +
                         part_card(1, 1, 1) + "/REFSTA\n" + name + "\n",
                     SchemaSet::built_in())
            .main;
    const auto d = load(folder.write("d_0000.rad", text));
    EXPECT_TRUE(d);
    const auto rows = detail::part_rows(d->model());
    return rows.at(0).why == nullptr ? std::string() : std::string(rows.at(0).why);
  };
  folder.write("state.ref", "\n");
  EXPECT_EQ(reason("none.ref"), "");
  EXPECT_EQ(reason("  state.ref"), "a reference geometry enters");
}

TEST(PartRows, TakeFiguresOfTheirCardsAndKnowWhatIsRigid) {
  const LoadedDeck d = deck_of(
      steel + "@/MAT/LAW0/2 Rho_I=5\n@/MAT/LAW13/3 Rho_I=7\n@/PROP/TYPE0/4 Thick=6\n" +
      part_card(11, 1, 1) + part_card(12, 1, 2) + part_card(13, 1, 3) + part_card(14, 4, 1));
  const auto rows = detail::part_rows(d.model());
  ASSERT_EQ(rows.size(), 4u);
  const double densities[] = {2, 5, 7, 2}, thickness[] = {3, 3, 3, 6};
  const bool rigid[] = {false, true, true, true};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i].material.density, densities[i]);
    EXPECT_EQ(rows[i].thickness, thickness[i]);
    EXPECT_EQ(rows[i].rigid, rigid[i]) << i;
  }
}

}  // namespace
}  // namespace deck::test
