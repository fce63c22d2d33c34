// Masses, velocities and temperatures of a deck at the start, on decks of a few elements; masses
// also against those that the reference solver recorded.
#include "deck/cycle/scene_cycle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <sstream>

#include "contact/small_deck.hpp"
#include "replay/replay.hpp"
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

TEST(Masses, QuadsGiveAQuarterToEachNode) {
  const Built b(elements());
  const State s = make_state(b.scene);
  for (int id = 1; id <= 4; ++id) EXPECT_DOUBLE_EQ(mass(b, s, id), 1e-6 * 2 * 100 / 4);
}

TEST(Masses, TrianglesGiveByTheirAngles) {
  const Built b(elements());
  const State s = make_state(b.scene);
  EXPECT_DOUBLE_EQ(mass(b, s, 5), 1e-6 * 2 * 50 / 2);  // 90 of 180 degrees
  EXPECT_DOUBLE_EQ(mass(b, s, 6), 1e-6 * 2 * 50 / 4);
  EXPECT_DOUBLE_EQ(mass(b, s, 7), 1e-6 * 2 * 50 / 4);
}

TEST(Masses, SpringsPerUnitLengthWeighByTheirLength) {
  for (const char* per_length : {"0", "1"}) {
    SmallDeck d = elements();
    d.node(31, 60, 0, 0).node(32, 64, 3, 0);
    d.add("/PROP/SPRING/9\nspring\n" + std::string(17, ' ') + "0.5" + std::string(50, ' ') +
          std::string(9, ' ') + per_length + "\n" + std::string(17, ' ') + "1.0\n");
    d.add("/PART/9\nspring\n         9         0         0");
    d.add("/SPRING/9\n        90        31        32");
    const Built b(d);
    const State s = make_state(b.scene);
    EXPECT_DOUBLE_EQ(mass(b, s, 31), 0.25 * (*per_length == '1' ? 5 : 1));
    EXPECT_DOUBLE_EQ(mass(b, s, 32), mass(b, s, 31));
  }
}

TEST(Masses, BricksGiveAnEighthToEachNode) {
  const Built b(elements());
  const State s = make_state(b.scene);
  for (int id = 10; id <= 17; ++id) EXPECT_DOUBLE_EQ(mass(b, s, id), 1e-6 * 1000 / 8);
}

/// A block of 2 x 2 x 2 whose mid-side nodes are `middles` of the twelve edges; ids from 1 and 21.
SmallDeck with_middles(const char* keyword, const std::vector<std::array<int, 3>>& middles) {
  SmallDeck d;
  d.solid_part(1).shell_part(2, 1).group("/GRNOD/PART/1", {1});
  const auto cell = [](int id) {
    const std::string text = std::to_string(id);
    return std::string(10 - text.size(), ' ') + text;
  };
  std::string card = std::string(keyword) + "/1\n" + cell(7);
  for (int k = 0; k < 8; ++k) {
    d.node(1 + k, (k % 4 == 1 || k % 4 == 2) ? 2 : 0, k % 4 >= 2 ? 2 : 0, k >= 4 ? 2 : 0);
    card += cell(1 + k);
  }
  const std::size_t first = middles.size() == 12 ? 8 : 4;
  for (std::size_t k = 0; k < middles.size(); ++k) {
    d.node(21 + static_cast<int>(k), middles[k][0], middles[k][1], middles[k][2]);
    card += (k == 0 || k == first ? "\n" : "") + cell(21 + static_cast<int>(k));
  }
  // A shell far away, so that there is something to touch.
  d.node(91, 0, 0, 50).node(92, 2, 0, 50).node(93, 2, 2, 50).node(94, 0, 2, 50);
  d.shell(2, 90, 91, 92, 93, 94);
  return d.add(card);
}

TEST(Masses, BlocksWithMidSideNodesGiveMostToThese) {
  const double total = 1e-6 * 8;
  const Built twenty(with_middles("/BRIC20", {{1, 0, 0},
                                              {2, 1, 0},
                                              {1, 2, 0},
                                              {0, 1, 0},
                                              {0, 0, 1},
                                              {2, 0, 1},
                                              {2, 2, 1},
                                              {0, 2, 1},
                                              {1, 0, 2},
                                              {2, 1, 2},
                                              {1, 2, 2},
                                              {0, 1, 2}}));
  const State a = make_state(twenty.scene);
  const double q = 8 * 3.0 / 14 + 12;
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(mass(twenty, a, 1 + k), total * (3.0 / 14) / q, 1e-18);
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(mass(twenty, a, 21 + k), total / q, 1e-18);
  const Built sixteen(with_middles(
      "/SHEL16",
      {{1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2}}));
  const State b = make_state(sixteen.scene);
  for (int k = 0; k < 8; ++k) {
    EXPECT_NEAR(mass(sixteen, b, 1 + k), total / 32, 1e-18);
    EXPECT_NEAR(mass(sixteen, b, 21 + k), total * 3 / 32, 1e-18);
  }
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

TEST(Velocities, OfNodeGroupsAndPartsOnRequest) {
  SmallDeck d = elements();
  d.add("/INIVEL/TRA/1\nv\n                 1.0                 2.0                 3.0         1");
  const Built b(d);
  const NodeIndex shell = b.model.nodes.map.find(1), solid = b.model.nodes.map.find(10);
  const State s = make_state(b.scene);
  EXPECT_TRUE(s.moving);
  EXPECT_EQ(s.velocity[0][shell], 1.0);
  EXPECT_EQ(s.velocity[2][shell], 3.0);
  EXPECT_EQ(s.velocity[0][solid], 0.0);
  const State t = make_state(b.scene, {{2, {0, 0, -5}}});
  EXPECT_EQ(t.velocity[2][solid], -5.0);
  EXPECT_EQ(t.velocity[2][shell], 3.0);
}

TEST(Velocities, TranslationAndGridCountAsTranslation) {
  SmallDeck d = elements();
  d.add("/INIVEL/T+G/1\nv\n                 1.0                 2.0                 3.0         1");
  const Built b(d);
  EXPECT_EQ(make_state(b.scene).velocity[1][b.model.nodes.map.find(1)], 2.0);
}

TEST(Velocities, ASkewTurnsThem) {
  SmallDeck d = elements();
  // Local Y is global Z, local Z is global X: local X is global Y.
  d.add(
      "@/SKEW/FIX/7 Z_Y=1 X_Z=1\n"
      "/INIVEL/TRA/1\nv\n                 1.0                 2.0                 3.0         1"
      "         7");
  const Built b(d);
  const State s = make_state(b.scene);
  const NodeIndex n = b.model.nodes.map.find(1);
  EXPECT_DOUBLE_EQ(s.velocity[1][n], 1.0);
  EXPECT_DOUBLE_EQ(s.velocity[2][n], 2.0);
  EXPECT_DOUBLE_EQ(s.velocity[0][n], 3.0);
}

TEST(Velocities, AndTemperaturesTakeNoMemoryWhereTheDeckGivesNone) {
  const Built b(elements());
  const State s = make_state(b.scene);
  for (const auto& v : s.velocity) EXPECT_TRUE(v.empty());
  EXPECT_TRUE(s.temperature.empty());
}

TEST(Velocities, AMissingGroupIsSaid) {
  SmallDeck d = elements();
  d.add("/INIVEL/TRA/1\nv\n                 1.0                 2.0                 3.0        99");
  const Built b(d);
  const State s = make_state(b.scene);
  EXPECT_FALSE(s.moving);
  ASSERT_EQ(s.not_evaluated.size(), 1u);
  EXPECT_NE(s.not_evaluated[0].find("node group"), std::string::npos);
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
  auto deck = read_deck(deck_file.string(), SchemaSet::built_in());
  if (!deck) return INFINITY;
  Diagnostics diagnostics;
  const deck::Model model = build_model(*deck, SchemaSet::built_in(), diagnostics);
  const Interfaces interfaces = read_interfaces(*deck, model, diagnostics);
  SceneOptions options;
  options.penetrations = options.candidates = false;
  const State state = make_state(build_scene(model, interfaces, diagnostics, options));
  std::ifstream in(file, std::ios::binary);
  const auto text = states_text(std::string{std::istreambuf_iterator<char>(in), {}});
  if (!text) return INFINITY;
  std::istringstream lines(*text);
  std::string line, cell;
  std::getline(lines, line);
  std::map<std::string, std::size_t> column;
  for (std::istringstream header(line); std::getline(header, cell, ',');)
    column.emplace(cell, column.size());
  double worst = 0;
  while (std::getline(lines, line)) {
    std::vector<std::string> row;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) row.push_back(cell);
    for (const auto& [node, m] : {std::pair{"node", "ms"}, std::pair{"n1", "m1"},
                                  std::pair{"n2", "m2"}, std::pair{"n3", "m3"}}) {
      const double recorded = std::stod(row[column.at(m)]);
      const NodeIndex n = model.nodes.map.find(std::stoll(row[column.at(node)]));
      if (n != no_index && recorded > 0)
        worst = std::max(worst, std::fabs(state.mass[n] / recorded - 1));
    }
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
