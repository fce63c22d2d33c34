// Materials and properties by law and type, parts and what is said of them, curves, options of the
// run, merged nodes, noise and coordinates.
#include <cmath>
#include <set>

#include "lint/shared/example.hpp"
#include "model/selection_deck.hpp"

namespace deck::test {
namespace {

/// A model of an example's text.
struct Made {
  explicit Made(const std::string& text)
      : deck(std::make_unique<Result<Deck>>(read_deck_text(
            "made_0000.rad", example_deck("@bare\n" + text, SchemaSet::built_in()).main,
            SchemaSet::built_in()))),
        model(build_model(**deck, SchemaSet::built_in(), found)) {}
  std::string message(RuleId rule) const {
    for (const Diagnostic& d : found.all())
      if (d.rule == rule) return d.message;
    return {};
  }
  Diagnostics found;
  std::unique_ptr<Result<Deck>> deck;
  Model model;
};

// ---- materials ---------------------------------------------------------------------------------

struct Stiffness {
  double young, bulk;
  bool known;
};

void expect_stiffness(const std::string& keyword, const std::string& fields, const Stiffness& s,
                      int law) {
  const Made m("@/MAT/" + keyword + "/1 Rho_I=3 " + fields + "\n");
  ASSERT_EQ(m.model.materials.size(), 1u) << keyword;
  const Material& got = m.model.materials[0];
  EXPECT_NEAR(got.young, s.young, 1e-12 * s.young) << keyword << fields;
  EXPECT_NEAR(got.bulk, s.bulk, 1e-12 * std::abs(s.bulk)) << keyword << fields;
  EXPECT_EQ(got.stiffness_known, s.known) << keyword << fields;
  EXPECT_EQ(got.law, law) << keyword;
}

TEST(MaterialStiffness, FollowsTheLaw) {
  const double bulk = 210 / (3 * (1 - 0.5));
  for (const char* law : {"0", "1", "2", "3", "4", "13", "22", "23", "24", "36", "43", "44", "65"})
    expect_stiffness("LAW" + std::string(law), "E=210 Nu=0.25", {210, bulk, true}, std::stoi(law));
  expect_stiffness("LAW70", "E=210 Nu=0.25", {210, bulk, false}, 70);
  expect_stiffness("LAW1", "E=210 Nu=0.5", {210, 210 / (3 * (1 - 0.998)), true}, 1);
  expect_stiffness("LAW35", "E=210 Nu=0.25", {210, 210, true}, 35);
  expect_stiffness("LAW38", "E=210 Nu=0.25", {210, 210, true}, 38);
  expect_stiffness("LAW21", "E=210 Nu=0.25 K=70", {210, 70, true}, 21);
  expect_stiffness("LAW33", "E=210", {0, 210, true}, 33);
  expect_stiffness("LAW59", "E=210 G=90", {210, 70, true}, 59);
  expect_stiffness("LAW59", "E=90 G=210", {210, 70, true}, 59);
  expect_stiffness("LAW34", "K=100 G0=30", {9 * 100 * 30 / 330.0, 100, true}, 34);
  expect_stiffness("LAW34", "K=100", {0, 100, false}, 34);  // the line of G0 is missing
  expect_stiffness("LAW28", "E11=5 E22=9 E33=7", {0, 9, false}, 28);
  expect_stiffness("LAW12", "E11=5 E22=9 E33=7 G12=8", {9, 9, false}, 12);
  expect_stiffness("LAW58", "E1=5 E2=9", {9, 9, false}, 58);
  expect_stiffness("LAW19", "E11=40 E22=90 Nu12=0.3",
                   {90 / (1 - 0.09 * 90 / 40), 90 / (1 - 0.09 * 90 / 40), true}, 19);
  expect_stiffness("LAW42", "Nu=0.4 mu_1=3 alpha_1=2 mu_5=5 alpha_5=4", {26 * 1.4, 26, true}, 42);
  expect_stiffness("LAW42", "mu_1=3 alpha_1=2", {6, 6, false}, 42);
  for (const char* law : {"5", "6", "11", "37", "51", "69"})
    expect_stiffness("LAW" + std::string(law), "", {0, 0, false}, std::stoi(law));
  expect_stiffness("PLAS_ZERIL", "E=210 Nu=0.25", {210, bulk, true}, 2);
  expect_stiffness("K-EPS", "", {0, 0, false}, 6);
  expect_stiffness("B-K-EPS", "", {0, 0, false}, 11);
}

TEST(MaterialStiffness, IsThatOfTheStateEquationWhereThereIsOne) {
  const auto of = [](const std::string& more) {
    const Made m("@/MAT/LAW3/1 Rho_I=3 E=210 Nu=0.25\n" + more);
    return std::tuple(m.model.materials.at(0).bulk, m.model.materials.at(0).stiffness_known,
                      m.message(RuleId::DK118));
  };
  using Row = std::tuple<double, bool, std::string>;
  EXPECT_EQ(of("@/EOS/POLYNOMIAL/1 C1=50\n"), Row(50, true, ""));
  EXPECT_EQ(of("@/EOS/POLYNOMIAL/2 C1=50\n"),
            Row(140, true, "/EOS/POLYNOMIAL belongs to material 2, which does not exist"));
  EXPECT_EQ(of("@/HEAT/MAT/2 T0=1\n"),
            Row(140, true, "/HEAT/MAT belongs to material 2, which does not exist"));
  EXPECT_FALSE(Made("@/MAT/LAW1/1 E=1\n").model.has_thermal_material);
}

// ---- properties --------------------------------------------------------------------------------

TEST(Properties, HaveTheirNumberThicknessAreaAndStiffness) {
  const auto of = [](const std::string& text) {
    const Made m(text + "\n");
    EXPECT_EQ(m.model.properties.size(), 1u) << text;
    return m.model.properties.at(0);
  };
  const Property shell = of("@/PROP/TYPE1/5 Thick=2");
  EXPECT_EQ(shell.id, 5);
  EXPECT_EQ(shell.number, 1);
  EXPECT_EQ(shell.type, "/PROP/SHELL");
  EXPECT_EQ(shell.thickness, 2);
  EXPECT_EQ(of("@/PROP/TYPE2/5 Area=3").area, 3);
  EXPECT_EQ(of("@/PROP/TYPE14/5").number, 14);
  EXPECT_EQ(of("/PROP/FLUID/5\nf\n\n").number, 14);
  using Three = std::array<double, 3>;
  EXPECT_EQ(of("@/PROP/TYPE4/5 K=12 A=3").stiffness, (Three{4, 0, 0}));
  EXPECT_EQ(of("@/PROP/TYPE4/5 K=12").stiffness, (Three{12, 0, 0}));
  EXPECT_EQ(of("@/PROP/TYPE12/5 K=12 A=3").stiffness, (Three{4, 0, 0}));
  const std::string three = " K1=12 A1=3 K2=20 A2=4 K3=30";
  EXPECT_EQ(of("@/PROP/TYPE8/5" + three).stiffness, (Three{4, 5, 30}));
  EXPECT_EQ(of("@/PROP/TYPE13/5" + three).stiffness, (Three{4, 5, 30}));
  EXPECT_EQ(of("@/PROP/TYPE25/5" + three).stiffness, (Three{4, 5, 0}));
  EXPECT_EQ(of("@/PROP/TYPE3/5 Area=7").stiffness, (Three{0, 0, 0}));
}

// ---- parts -------------------------------------------------------------------------------------

std::string shells(const std::string& more) {
  return grid_nodes() + "@/MAT/LAW1/1 E=1\n@/PROP/TYPE1/1 Thick=1\n@/PROP/TYPE1/2\n" + more;
}
std::string part(int id, int prop, int mat, int subset = 0) {
  return "/PART/" + std::to_string(id) + "\np\n" + cells({prop, mat, subset});
}

TEST(PartFindings, NameWhatIsMissing) {
  const auto said = [](const std::string& more) {
    std::vector<std::string> out;
    const Made m(shells(more));
    for (const Diagnostic& d : m.found.all())
      out.push_back(std::string(id_text(d.rule)) + " " + d.message);
    return out;
  };
  using Lines = std::vector<std::string>;
  const std::string elements = "/SHELL/7\n" + cells({1, 1, 2, 5, 4}) + cells({2, 2, 3, 6, 5});
  EXPECT_EQ(said(part(7, 1, 1) + elements), Lines{});
  EXPECT_EQ(said(part(7, 9, 1) + elements),
            Lines{"DK102 part 7 refers to property 9, which does not exist"});
  EXPECT_EQ(said(part(7, 1, 9)), Lines{"DK103 part 7 refers to material 9, which does not exist"});
  EXPECT_EQ(said(part(7, 1, 0)), Lines{}) << "no element needs it";
  EXPECT_EQ(said(part(7, 1, 0) + elements),
            Lines{"DK103 part 7 has elements but names no material"});
  EXPECT_EQ(said(part(7, 1, 1, 4)), Lines{"DK108 part 7 names subset 4, which does not exist"});
  EXPECT_EQ(said(part(7, 2, 1) + elements),
            Lines{"DK106 2 shells of part 7 have no thickness: neither on the element nor in "
                  "property 2; the first is element 1"});
  EXPECT_EQ(said(part(7, 1, 1) + "/SHELL/7\n" + cells({1, 1, 2, 5, 5}) + cells({2, 2, 3, 6, 6})),
            Lines{"DK107 2 shells of part 7 have the same third and fourth node; the first is "
                  "element 1"});
  EXPECT_EQ(said(part(7, 1, 1) + "/SHELL/7\n" + cells({1, 1, 1, 5, 4}) + cells({2, 2, 3, 3, 5}) +
                 cells({3, 5, 6, 9, 5}) + cells({4, 5, 6, 5, 8})),
            Lines{"DK136 3 shells of part 7 name a node twice; the first is element 1"});
  EXPECT_EQ(
      said("/SUBSET/3\ns\n" + cells({4, 3})),
      (Lines{"DK108 subset 3 lists subset 4, which does not exist", "DK111 the deck has no part"}));
}

TEST(PartFindings, OfSpringsNeedNoMaterialUnlessTheyNameOne) {
  const auto fires = [](const std::string& prop, int mat) {
    const Made m(shells("@/PROP/" + prop + "/3 Mass=1\n" + part(7, 3, mat) + "/SPRING/7\n" +
                        cells({1, 1, 2})));
    return !m.message(RuleId::DK103).empty();
  };
  for (const char* prop : {"TYPE4", "TYPE8", "TYPE12", "TYPE13", "TYPE25"})
    EXPECT_FALSE(fires(prop, 0)) << prop;
  EXPECT_FALSE(fires("TYPE4", 9)) << "springs alone do not look for it";
}

TEST(PartFindings, OfShellsWithOtherThicknessAreNone) {
  const auto fires = [](const std::string& prop) {
    return !Made(shells(prop + part(7, 3, 1) + "/SHELL/7\n" + cells({1, 1, 2, 5, 4})))
                .message(RuleId::DK106)
                .empty();
  };
  EXPECT_TRUE(fires("@/PROP/TYPE9/3\n"));
  EXPECT_FALSE(fires("@/PROP/TYPE9/3 Thick=1\n"));
  for (const char* type : {"0", "17", "51"})
    EXPECT_FALSE(fires("@/PROP/TYPE" + std::string(type) + "/3\n")) << type;
}

TEST(PartFindings, OfRepeatedIdsAreNamedUnlessTheyAreZero) {
  EXPECT_EQ(Made("/PART/7\np\n/PART/7\np\n").message(RuleId::DK100), "/PART 7 is defined twice");
  EXPECT_EQ(Made("/PART/0\np\n/PART/0\np\n").message(RuleId::DK100), "");
}

// ---- curves and options of the run -------------------------------------------------------------

TEST(Curves, AreScaledAndShifted) {
  const std::string points =
      "                   1                   2\n\n"
      "                   3                   5\n";
  const Made m("/FUNCT/4\nf\n" + points + "/FUNCT/5\ng\n" + points +
               "@/MOVE_FUNCT/5 Ascale_x=2 Ascale_y=3 Ashift_x=10 Ashift_y=20\n/FUNCT/6\nh\n" +
               points + "@/MOVE_FUNCT/6 Ashift_x=10\n@/MOVE_FUNCT/9 Ashift_x=10\n");
  const auto of = [&](std::int64_t id) {
    const Curve& c = m.model.curves.at(id);
    return std::pair(c.x, c.y);
  };
  using Points = std::pair<std::vector<double>, std::vector<double>>;
  EXPECT_EQ(of(4), (Points{{1, 3}, {2, 5}})) << "a blank line is no point";
  EXPECT_EQ(of(5), (Points{{12, 16}, {26, 35}}));
  EXPECT_EQ(of(6), (Points{{11, 13}, {2, 5}}));
  EXPECT_EQ(m.model.curves.size(), 3u);
  EXPECT_EQ(m.model.curves.at(4).title, "f");
}

TEST(RunOptions, SetOneFlagEach) {
  const auto flags = [](const std::string& text) {
    const Made made(text);
    const Model& m = made.model;
    return std::array{m.two_dimensional,      m.intthick_v5, m.implicit,
                      m.has_monitored_volume, m.has_ale,     m.has_adaptive_mesh,
                      m.has_acoustics,        m.has_random};
  };
  using Flags = std::array<bool, 8>;
  const auto only = [](std::size_t i) {
    Flags f{};
    if (i < f.size()) f[i] = true;
    return f;
  };
  EXPECT_EQ(flags("\n"), only(9));
  EXPECT_EQ(flags("@/ANALY N2D3D=1\n"), only(0));
  EXPECT_EQ(flags("@/ANALY N2D3D=0\n"), only(9));
  EXPECT_EQ(flags("/INTTHICK/V5\n"), only(1));
  EXPECT_EQ(flags("/IMPLICIT\n"), only(2));
  EXPECT_EQ(flags("/MONVOL/GAS/1\nm\n"), only(3));
  EXPECT_EQ(flags("/ALE/MAT/1\n"), only(4));
  EXPECT_EQ(flags("/EULER/MAT/1\n"), only(4));
  EXPECT_EQ(flags("/ADMESH/GLOBAL\n"), only(5));
  EXPECT_EQ(flags("/CAA\n"), only(6));
  EXPECT_EQ(flags("@/RANDOM Noise=0.5\n"), only(7));
  EXPECT_EQ(flags("@/RANDOM Noise=0\n"), only(9));
  EXPECT_EQ(flags("@/RANDOM Noise=0.5 Seed=0.25\n"), only(9));
  EXPECT_EQ(Made("@/RANDOM Noise=0.5 Seed=0.25\n").message(RuleId::DK119),
            "/RANDOM with a seed: deck does not reproduce the noise");
}

TEST(RunOptions, OtherEntitiesAreKnownByTheirIds) {
  const Made m(
      "/SENSOR/TIME/4\ns\n                   1\n@/SKEW/FIX/5 Y_Y=1 Z_Z=1\n"
      "/FRICTION/6\nf\n\n\n\n@/RBODY/7 node_ID=1\n/SUBSET/8\ns\n" +
      cells({9, 10}) + "/SUBSET/9\ns\n\n/SUBSET/10\ns\n\n");
  EXPECT_EQ(m.model.sensors.size() + m.model.skews.size() + m.model.frictions.size() +
                m.model.rbodies.size(),
            4u);
  EXPECT_TRUE(m.model.sensors.contains(4) && m.model.skews.contains(5) &&
              m.model.frictions.contains(6) && m.model.rbodies.contains(7));
  EXPECT_EQ(m.model.subset_children,
            (std::map<std::int64_t, std::vector<std::int64_t>>{{8, {9, 10}}, {9, {}}, {10, {}}}));
}

TEST(Noise, MovesEveryCoordinateByTheSolversNumbers) {
  std::string nodes = "/NODE\n";
  for (int n = 1; n <= 4; ++n) nodes += node(n, 10 * n, 20 * n, 30 * n);
  const Made m(nodes + "@/RANDOM Noise=0.5\n");
  // r' = (25173 r + 13849) mod 65536 from 0 on: 13849, 54226, 49995 ...
  std::uint64_t r = 0;
  std::vector<double> moved;
  for (int i = 0; i < 12; ++i) {
    r = (25173 * r + 13849) % 65536;
    moved.push_back(0.5 * (2 * static_cast<double>(r) / 65536 - 1));
  }
  EXPECT_NEAR(moved[0], 0.5 * (2 * 13849.0 / 65536 - 1), 1e-15);
  for (std::size_t n = 0; n < 4; ++n) {
    const double at = static_cast<double>(n + 1);
    EXPECT_NEAR(m.model.nodes.x[n], 10 * at + moved[3 * n], 1e-13);
    EXPECT_NEAR(m.model.nodes.y[n], 20 * at + moved[3 * n + 1], 1e-13);
    EXPECT_NEAR(m.model.nodes.z[n], 30 * at + moved[3 * n + 2], 1e-13);
  }
}

// ---- nodes -------------------------------------------------------------------------------------

TEST(Coordinates, ThatAreTooLargeAreNamedWithTheirAxis) {
  const auto said = [](double x, double y, double z) {
    const Made m("/NODE\n" + node(1, 0, 0, 0) + node(7, x, y, z));
    return m.message(RuleId::DK334) + m.message(RuleId::DK333);
  };
  EXPECT_EQ(said(1e75, -1e75, 1), "");
  EXPECT_EQ(said(1.1e75, 1, 1),
            "node 7: X is 1.1e+75 in working units, too large for distances to be computed");
  EXPECT_EQ(said(1, -2e76, 1e76),
            "node 7: Y is -2e+76 in working units, too large for distances to be computed");
  EXPECT_EQ(said(1, 2e76, -3e76),
            "node 7: Z is -3e+76 in working units, too large for distances to be computed");
}

TEST(ConnectionNodes, AreTheNearestNodeWithinTheTolerance) {
  const auto merged = [](double tolerance, const std::vector<double>& at) {
    std::string text = "/NODE\n" + node(1, 0, 0, 0) + node(2, 1, 0, 0) + node(3, 1, 1, 0);
    char header[32];
    std::snprintf(header, sizeof header, "/CNODE/%g\n", tolerance);
    text += header + node(9, at[0], at[1], at[2]);
    BuiltModel m(text);
    return m.model().node_id(m.model().find_node(9));
  };
  EXPECT_EQ(merged(0.5, {0.4, 0, 0}), 1);
  EXPECT_EQ(merged(0.5, {0.6, 0, 0}), 2);
  EXPECT_EQ(merged(0.5, {0.5, 0, 0}), 1) << "of two at one distance the first";
  EXPECT_EQ(merged(0.5, {1, 0.5, 0}), 2);
  EXPECT_EQ(merged(0.5, {1, 0, 0.5}), 2) << "at the tolerance";
  EXPECT_EQ(merged(0.5, {1, 0, 0.5001}), 9);
  EXPECT_EQ(merged(0.5, {-0.3, -0.3, -0.2}), 1);
  EXPECT_EQ(merged(0, {1, 1, 0}), 3);
  EXPECT_EQ(merged(0, {1, 1, 1e-9}), 9);
}

TEST(ConnectionNodes, FollowOneAnotherToTheLast) {
  BuiltModel m(parts() + "/NODE\n" + node(1, 0, 0, 0) + node(2, 10, 0, 0) + node(3, 0, 10, 0) +
               "/CNODE/1\n" + node(11, 0.5, 0, 0) + node(12, 1.25, 0, 0) + "/CNODE/1\n" +
               node(21, 1.75, 0, 0) + "/SH3N/1\n" + cells({1, 11, 2, 3}) + cells({2, 21, 2, 3}) +
               "/GRNOD/NODE/1\ng\n" + cells({11, 12, 21}));
  EXPECT_EQ(m.model().node_id(m.model().find_node(11)), 1);
  EXPECT_EQ(m.model().node_id(m.model().find_node(12)), 12) << "11 is no node of its own any more";
  EXPECT_EQ(m.model().node_id(m.model().find_node(21)), 12);
  EXPECT_EQ(m.model().node_id(m.model().shell3.of(0)[0]), 1);
  EXPECT_EQ(m.model().node_id(m.model().shell3.of(1)[0]), 12);
  EXPECT_EQ(m.group(1), (Ids{1, 12}));
}

// ---- transforms --------------------------------------------------------------------------------

TEST(AffineMaps, OfTransformsInGeneralPosition) {
  // Node 1 at (1, 2, 3); the axis runs from (1, 0, 1) along (1, 2, 2) / 3.
  const auto moved = [](const std::string& cards) {
    const Made m("/NODE\n" + node(1, 1, 2, 3) + node(2, 1, 0, 1) + node(3, 4, 6, 7) +
                 "/GRNOD/NODE/1\ng\n" + cells({1}) + cards + "\n");
    return std::array{m.model.nodes.x[0], m.model.nodes.y[0], m.model.nodes.z[0]};
  };
  const auto near = [](const std::array<double, 3>& got, const std::array<double, 3>& wanted) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-12) << i;
  };
  // Rodrigues: v = (0, 2, 2), n = (1, 2, 2) / 3, n.v = 8/3, n x v = (0, -2, 2) / 3 ... by hand.
  const double n[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3}, v[3] = {0, 2, 2};
  const double dot = 8.0 / 3;
  const double across[3] = {n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2],
                            n[0] * v[1] - n[1] * v[0]};
  const double angle = 25 * std::acos(-1.0) / 180, c = std::cos(angle), s = std::sin(angle);
  std::array<double, 3> turned{1, 0, 1}, mirrored{1, 2, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    turned[i] += c * v[i] + (1 - c) * dot * n[i] + s * across[i];
    mirrored[i] -= 2 * dot * n[i];
  }
  const std::string axis = "X1=1 Y1=0 Z1=1 X2=2 Y2=2 Z2=3";
  near(moved("@/TRANSFORM/ROT/1 GR_NODE=1 " + axis + " Angle=25"), turned);
  near(moved("@/TRANSFORM/SYM/1 GR_NODE=1 " + axis), mirrored);
  near(moved("@/TRANSFORM/ROT/1 GR_NODE=1 node_ID1=2 node_ID2=3 Angle=0"), {1, 2, 3});
  near(moved("@/TRANSFORM/TRA/1 GR_NODE=1 node_ID1=2 node_ID2=3"), {4, 8, 9});
  near(moved("@/TRANSFORM/TRA/1 GR_NODE=1 TX=1 TY=-2 TZ=5"), {2, 0, 8});
  near(moved("@/TRANSFORM/SCA/1 GR_NODE=1 FX=2 FY=3 FZ=5"), {2, 6, 15});
  near(moved("@/TRANSFORM/SCA/1 GR_NODE=1 FX=2 FY=3 FZ=5 node_ID1=2"), {1, 6, 11});
  near(moved("@/TRANSFORM/MATRIX/1 GR_NODE=1 M11=1 M12=2 M13=3 M21=4 M22=5 M23=6 M31=7 M32=8 "
             "M33=9 TX=100 TY=200 TZ=300"),
       {114, 232, 350});
  // Two in a row, and a map of a submodel put together.
  near(moved("@/TRANSFORM/TRA/1 GR_NODE=1 TX=1 TY=-2 TZ=5\n@/TRANSFORM/SCA/2 GR_NODE=1 FX=2 FY=3 "
             "FZ=5"),
       {4, 0, 40});
}

TEST(AffineMaps, WhatCannotBeMovedIsSaid) {
  const auto said = [](const std::string& cards) {
    return Made("/NODE\n" + node(1, 1, 2, 3) + node(2, 1, 0, 1) + "/GRNOD/NODE/1\ng\n" +
                cells({1}) + cards + "\n")
        .message(RuleId::DK110);
  };
  EXPECT_EQ(said("@/TRANSFORM/ROT/1 GR_NODE=1 X1=1 X2=1 Angle=5"),
            "/TRANSFORM/ROT 1: its two points coincide");
  EXPECT_EQ(said("@/TRANSFORM/TRA/1 GR_NODE=1 node_ID1=2 node_ID2=77"),
            "/TRANSFORM/TRA 1: node 77 does not exist");
  EXPECT_EQ(said("@/TRANSFORM/SCA/1 GR_NODE=1 FX=2 node_ID1=77"),
            "/TRANSFORM/SCA 1: node 77 does not exist");
  EXPECT_EQ(said("@/TRANSFORM/TRA/1 GR_NODE=9 TX=1"),
            "/TRANSFORM/TRA 1 moves node group 9, which does not exist");
  EXPECT_EQ(said("@/TRANSFORM/TRA/1 TX=1"), "/TRANSFORM/TRA 1 names no node group to move");
  EXPECT_EQ(said("@/TRANSFORM/TRA/1 SUBMODEL=9 TX=1"),
            "/TRANSFORM/TRA 1 moves submodel 9, which does not exist");
  EXPECT_EQ(said("@/TRANSFORM/TRA/1 GR_NODE=1 TX=1"), "");
}

}  // namespace
}  // namespace deck::test
