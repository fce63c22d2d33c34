// By hand: stiffness of materials, noise on coordinates, merged nodes, transforms.
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

// ---- noise -------------------------------------------------------------------------------------

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

}  // namespace
}  // namespace deck::test
