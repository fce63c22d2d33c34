// Masses, velocities and temperatures of a deck at the start, on decks of a few elements; masses
// also against those that the reference solver recorded.
#include "deck/cycle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "contact/small_deck.hpp"
#include "replay/replay.hpp"
#include "replay/table.hpp"
#include "where.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;

/// One quad, one right-angled triangle and one brick, each with nodes of its own. Density 1e-6.
SmallDeck elements() {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(5, 20, 0, 0).node(6, 30, 0, 0).node(7, 20, 10, 0);
  for (int k = 0; k < 8; ++k)
    d.node(10 + k, (k % 4 == 1 || k % 4 == 2) ? 50 : 40, k % 4 >= 2 ? 10 : 0, k >= 4 ? 10 : 0);
  d.shell_part(1, 2.0).solid_part(2);
  d.shell(1, 1, 1, 2, 3, 4).shell3(1, 2, 5, 6, 7);
  d.brick(2, 3, {10, 11, 12, 13, 14, 15, 16, 17});
  d.group("/GRNOD/PART/1", {1});
  return d;
}

double mass(const Built& b, const State& s, std::int64_t id) {
  return s.mass[b.model.nodes.map.find(id)];
}

TEST(Masses, OfElementsGoToTheirNodesTrianglesByTheirAngles) {
  const Built b(elements());
  const State s = make_state(b.scene);
  for (int id = 1; id <= 4; ++id) EXPECT_DOUBLE_EQ(mass(b, s, id), 1e-6 * 2 * 100 / 4);
  EXPECT_DOUBLE_EQ(mass(b, s, 5), 1e-6 * 2 * 50 / 2);  // 90 of 180 degrees
  for (int id = 6; id <= 7; ++id) EXPECT_DOUBLE_EQ(mass(b, s, id), 1e-6 * 2 * 50 / 4);
  for (int id = 10; id <= 17; ++id) EXPECT_DOUBLE_EQ(mass(b, s, id), 1e-6 * 1000 / 8);
}

TEST(Masses, SpringsPerUnitLengthWeighByTheirLength) {
  for (const int per_length : {0, 1}) {
    SmallDeck d = elements();
    d.node(31, 60, 0, 0).node(32, 64, 3, 0);
    d.add(fmt::sprintf("/PROP/SPRING/9\nspring\n%20g%60d\n%20g\n", 0.5, per_length, 1.0));
    d.add("/PART/9\nspring\n         9         0         0");
    d.add("/SPRING/9\n        90        31        32");
    const Built b(d);
    const State s = make_state(b.scene);
    EXPECT_DOUBLE_EQ(mass(b, s, 31), 0.25 * (per_length == 1 ? 5 : 1));
    EXPECT_DOUBLE_EQ(mass(b, s, 32), mass(b, s, 31));
  }
}

/// A block of 2 x 2 x 2 with nodes 1 to 8 and, from 21 on, one at the middle of each of its edges;
/// a SHEL16 has none between its faces. A shell far away, so that there is something to touch.
SmallDeck with_middles(const std::string& keyword) {
  SmallDeck d;
  d.solid_part(1).shell_part(2, 1).group("/GRNOD/PART/1", {1});
  const auto corner = [](int k) {
    return std::array{k % 4 == 1 || k % 4 == 2 ? 2 : 0, k % 4 >= 2 ? 2 : 0, k >= 4 ? 2 : 0};
  };
  std::string card = keyword + "/1\n" + fmt::sprintf("%10d", 7);
  for (int k = 0; k < 8; ++k) {
    d.node(1 + k, corner(k)[0], corner(k)[1], corner(k)[2]);
    card += fmt::sprintf("%10d", 1 + k);
  }
  std::vector<std::array<int, 2>> edges;
  for (int k = 0; k < 4; ++k) edges.push_back({k, (k + 1) % 4});
  for (int k = 0; k < 4 && keyword == "/BRIC20"; ++k) edges.push_back({k, k + 4});
  for (int k = 0; k < 4; ++k) edges.push_back({4 + k, 4 + (k + 1) % 4});
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto a = corner(edges[k][0]), b = corner(edges[k][1]);
    const int id = 21 + static_cast<int>(k);
    d.node(id, 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]));
    card += (k == 0 || k == edges.size() - 4 ? "\n" : "") + fmt::sprintf("%10d", id);
  }
  d.node(91, 0, 0, 50).node(92, 2, 0, 50).node(93, 2, 2, 50).node(94, 0, 2, 50);
  return d.shell(2, 90, 91, 92, 93, 94).add(card);
}

TEST(Masses, BlocksWithMidSideNodesGiveMostToThese) {
  const double total = 1e-6 * 8, q = 8 * 3.0 / 14 + 12;
  const Built twenty(with_middles("/BRIC20")), sixteen(with_middles("/SHEL16"));
  const State a = make_state(twenty.scene), b = make_state(sixteen.scene);
  for (int k = 0; k < 8; ++k) {
    EXPECT_NEAR(mass(twenty, a, 1 + k), total * (3.0 / 14) / q, 1e-18);
    EXPECT_NEAR(mass(sixteen, b, 1 + k), total / 32, 1e-18);
    EXPECT_NEAR(mass(sixteen, b, 21 + k), total * 3 / 32, 1e-18);
  }
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(mass(twenty, a, 21 + k), total / q, 1e-18);
}

TEST(Masses, AddedMassGoesToEveryNodeOrIsSpread) {
  SmallDeck d = elements();
  d.group("/GRNOD/NODE/2", {1, 2});
  d.add("/ADMAS/0/1\nm\n                 0.5         2");
  d.add("/ADMAS/1/2\nm\n                 0.5         2");
  const Built b(d);
  const State s = make_state(b.scene);
  EXPECT_DOUBLE_EQ(mass(b, s, 1), 5e-5 + 0.5 + 0.25);
  EXPECT_DOUBLE_EQ(mass(b, s, 3), 5e-5);
}

TEST(Velocities, OfNodeGroupsAlsoInASkewAndOfPartsOnRequest) {
  const std::string values =
      "/1\nv\n                 1.0                 2.0                 3.0         1";
  // Local Y of the skew is global Z, local Z is global X: local X is global Y.
  const std::pair<std::string, std::array<double, 3>> cases[] = {
      {"/INIVEL/TRA" + values, {1, 2, 3}},
      {"/INIVEL/T+G" + values, {1, 2, 3}},
      {"@/SKEW/FIX/7 Z_Y=1 X_Z=1\n/INIVEL/TRA" + values + "         7", {3, 1, 2}}};
  for (const auto& [cards, wanted] : cases) {
    const Built b(elements().add(cards));
    const NodeIndex shell = b.model.nodes.map.find(1), solid = b.model.nodes.map.find(10);
    const State s = make_state(b.scene), t = make_state(b.scene, {{2, {0, 0, -5}}});
    EXPECT_TRUE(s.moving);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_DOUBLE_EQ(s.velocity[c].at(shell), wanted[c]) << cards;
      EXPECT_EQ(s.velocity[c].at(solid), 0.0);
    }
    EXPECT_EQ(t.velocity[2][solid], -5.0);
    EXPECT_EQ(t.velocity[2][shell], wanted[2]);
  }
}

TEST(Velocities, OfAMissingGroupAreLeftOutAndSaid) {
  SmallDeck d = elements();
  d.add("/INIVEL/TRA/1\nv\n                 1.0                 2.0                 3.0        99");
  const Built b(d);
  const State s = make_state(b.scene);
  EXPECT_FALSE(s.moving);
  for (const auto& v : s.velocity) EXPECT_TRUE(v.empty()) << "no memory where there is nothing";
  ASSERT_EQ(s.not_evaluated.size(), 1u);
}

TEST(Temperatures, OfNodeGroupsOverThoseOfMaterials) {
  SmallDeck d = elements();
  d.add("/HEAT/MAT/1\n               293.0                 1.0");
  d.add("/INITEMP/1\nt\n               400.0         1");
  const Built b(d);
  const State s = make_state(b.scene);
  EXPECT_TRUE(s.heated);
  EXPECT_EQ(s.temperature[b.model.nodes.map.find(1)], 400.0);
  EXPECT_EQ(s.temperature[b.model.nodes.map.find(10)], 293.0);
}

TEST(StructureStep, IsNineTenthsOfTheSmallestElementStep) {
  const Built b(elements());
  const StructureStep step = make_state(b.scene).structure;
  // Triangle: height over the longest side; c^2 = E / rho.
  const double c = std::sqrt(200.0 / 1e-6);
  EXPECT_EQ(step.kind, ElementKind::shell3);
  EXPECT_NEAR(step.dt, 0.9 * (100.0 / std::sqrt(200.0)) / c, 1e-12);
}

/// Largest relative difference of nodal masses from those in a set of records.
double mass_difference(const std::filesystem::path& deck_file, const std::filesystem::path& file) {
  const auto deck = read_deck(deck_file.string(), SchemaSet::built_in());
  std::ifstream in(file, std::ios::binary);
  const auto text = states_text(std::string{std::istreambuf_iterator<char>(in), {}});
  detail::Table table;
  std::string error;
  if (!deck || !text || !table.read(*text, error)) return INFINITY;
  Findings findings;
  const deck::Model model = build_model(*deck, SchemaSet::built_in(), findings);
  const Interfaces interfaces = read_interfaces(*deck, model, findings);
  SceneOptions options;
  options.penetrations = options.candidates = false;
  const State state = make_state(build_scene(model, interfaces, findings, options));
  double worst = 0;
  for (const auto& [node, m] : {std::pair{"node", "ms"}, std::pair{"n1", "m1"},
                                std::pair{"n2", "m2"}, std::pair{"n3", "m3"}})
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const double recorded = table.column(m)[row];
      const NodeIndex n = model.nodes.map.find(static_cast<std::int64_t>(table.column(node)[row]));
      if (n != no_index && recorded > 0)
        worst = std::max(worst, std::fabs(state.mass[n] / recorded - 1));
    }
  return worst;
}

TEST(Masses, AreThoseOfTheReferenceSolver) {
  const std::filesystem::path base = test::shared_dir() / "oracle/kernel";
  if (!std::filesystem::is_directory(base)) GTEST_SKIP() << base << " is not there (DECK_CORPUS)";
  for (const auto& [set, deck] :
       {std::pair{"eng_BOULE1V4", "BOULE1V4"}, std::pair{"eng_BOXBEAM", "BOXBEAM"},
        std::pair{"eng_FOAM_V10", "FOAM_V10"}, std::pair{"eng_TRITUBV4", "TRITUBV4"},
        std::pair{"kern_base", "FRICT41"}})
    EXPECT_LT(mass_difference(base / set / (std::string(deck) + "_0000.rad"),
                              base / set / "node_segment.csv.gz"),
              1e-9)
        << set;
}

}  // namespace
}  // namespace deck::cycle
