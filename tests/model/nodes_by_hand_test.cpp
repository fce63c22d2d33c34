// By hand: noise on coordinates, merged nodes, transforms.
#include <cmath>

#include "lint/shared/example.hpp"
#include "model/selection_deck.hpp"

namespace deck::test {
namespace {

/// A model of an example's text.
struct Made : BuiltModel {
  explicit Made(const std::string& text)
      : BuiltModel(example_text("@version 2024\n" + text, SchemaSet::built_in())) {}
};

// ---- noise -------------------------------------------------------------------------------------

TEST(Noise, MovesEveryCoordinateByTheSolversNumbers) {
  std::string nodes = "/NODE\n";
  for (int n = 1; n <= 4; ++n) nodes += node(n, 10 * n, 20 * n, 30 * n);
  Made m(nodes + "@/RANDOM Noise=0.5\n");
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
    EXPECT_NEAR(m.model().nodes.x[n], 10 * at + moved[3 * n], 1e-13);
    EXPECT_NEAR(m.model().nodes.y[n], 20 * at + moved[3 * n + 1], 1e-13);
    EXPECT_NEAR(m.model().nodes.z[n], 30 * at + moved[3 * n + 2], 1e-13);
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
    Made m("/NODE\n" + node(1, 1, 2, 3) + node(2, 1, 0, 1) + node(3, 4, 6, 7) +
           "/GRNOD/NODE/1\ng\n" + cells({1}) + cards + "\n");
    return std::array{m.model().nodes.x[0], m.model().nodes.y[0], m.model().nodes.z[0]};
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
