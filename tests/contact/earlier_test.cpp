// Penetrations beside those of an earlier run, the old search of ties, and the values of single
// elements: by hand.
#include "deck/contact/earlier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/shared/scene_parts.hpp"
#include "contact/small_deck.hpp"
#include "contact/tied_sheet.hpp"

namespace deck::test {
namespace {

// --- earlier runs

/// Contacts of interfaces 4 and 9 with a penetration of each secondary node.
struct Now {
  InterType7 four, nine;
  Model model;
  Scene scene;
  SceneView view;
  Now() {
    four.id = 4;
    nine.id = 9;
    scene.contacts.resize(2);
    scene.contacts[0].inter = &four;
    scene.contacts[1].inter = &nine;
  }
  Now& add(std::uint32_t contact, std::array<std::int64_t, 2> ids, double depth,
           std::array<double, 3> at) {
    auto& rows = scene.contacts[contact].penetrations;
    PenetrationRow row;
    row.depth = depth;
    rows.push_back(row);
    NamedPenetration p;
    p.contact = contact;
    p.row = static_cast<std::uint32_t>(rows.size() - 1);
    p.secondary = ids;
    p.at = at;
    view.deepest_per_node.push_back(static_cast<std::uint32_t>(view.penetrations.size()));
    view.penetrations.push_back(p);
    return *this;
  }
  GapsComparison beside(const EarlierGaps& earlier) { return compare_gaps(earlier, scene, view); }
};
EarlierGaps::Row was(std::int64_t inter, std::array<std::int64_t, 2> ids, double depth,
                     std::optional<std::array<double, 3>> at, double gap = 2) {
  return {inter, "primary", ids, depth, gap, at};
}
std::vector<std::uint32_t> partners(const GapsComparison& c) {
  std::vector<std::uint32_t> out;
  for (const auto& row : c.rows) out.push_back(row.earlier);
  return out;
}
using Places = std::vector<std::uint32_t>;

TEST(EarlierRows, ThatHaveIdsAndPlaceGoBeforePlacesAndThoseBeforeIds) {
  Now now;
  now.add(0, {1, 0}, 1, {0, 0, 0}).add(0, {2, 0}, 1, {5, 0, 0}).add(0, {3, 0}, 1, {9, 9, 9});
  EarlierGaps e;
  // Node 2 was at the place of node 1; node 20 was where node 2 is; node 3 was elsewhere.
  e.rows = {was(4, {2, 0}, 1, {{0, 0, 0}}), was(4, {1, 0}, 1, {{0, 0, 0}}),
            was(4, {20, 0}, 1, {{5, 0, 0}}), was(4, {3, 0}, 1, {{-9, 9, 9}})};
  const GapsComparison c = now.beside(e);
  EXPECT_EQ(partners(c), (Places{1, 2, 3}));
  EXPECT_EQ(c.solved, (Places{0}));
  for (const auto& row : c.rows) EXPECT_EQ(row.trend, Trend::same);
  EXPECT_EQ(c.rows[2].penetration, 2u);
}

TEST(EarlierRows, BelongToTheirInterfaceAndRole) {
  Now now;
  now.add(0, {1, 0}, 1, {0, 0, 0}).add(1, {1, 0}, 1, {0, 0, 0});
  EarlierGaps e;
  e.rows = {was(9, {1, 0}, 1, std::nullopt), was(4, {1, 0}, 1, std::nullopt)};
  EXPECT_EQ(partners(now.beside(e)), (Places{1, 0})) << "old documents have no places";
  e.rows = {was(7, {8, 0}, 1, {{0, 0, 0}}), was(9, {8, 0}, 1, {{0, 0, 0}})};
  EXPECT_EQ(partners(now.beside(e)), (Places{0, 1})) << "the same interface before another one";
  for (auto& row : e.rows) row.role = "edges";
  EXPECT_EQ(partners(now.beside(e)), (Places{no_index, no_index}));
  EXPECT_EQ(now.beside(e).solved, (Places{0, 1}));
}

TEST(EarlierRows, OfEdgesMayHaveTheirNodesTheOtherWayRound) {
  Now now;
  now.add(0, {3, 7}, 1, {0, 0, 0}).add(0, {8, 5}, 1, {1, 0, 0});
  EarlierGaps e;
  e.rows = {was(4, {5, 8}, 1, std::nullopt), was(4, {7, 3}, 1, std::nullopt)};
  EXPECT_EQ(partners(now.beside(e)), (Places{1, 0}));
}

TEST(EarlierRows, AreAtTheSamePlaceWithinAMillionthOfTheGap) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      for (const auto& [share, found] : {std::pair(0.99e-6, true), std::pair(1.01e-6, false)})
        for (const double origin : {0.0, 17.3, -1e3}) {
          Now now;
          std::array<double, 3> at{origin, origin, origin};
          now.add(0, {1, 0}, 1, at);
          at[axis] += sign * share * 2;
          EarlierGaps e;
          e.rows = {was(4, {55, 0}, 1, at)};
          EXPECT_EQ(partners(now.beside(e))[0] == 0, found) << axis << ' ' << origin;
        }
}

TEST(EarlierTrends, ChangeBeyondAMillionth) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::tuple<double, double, Trend> cases[] = {{2.0, 2.0, Trend::same},
                                                     {2.0 * (1 + 0.99e-6), 2.0, Trend::same},
                                                     {2.0 * (1 + 1.01e-6), 2.0, Trend::worse},
                                                     {2.0 * (1 - 0.99e-6), 2.0, Trend::same},
                                                     {2.0 * (1 - 1.01e-6), 2.0, Trend::better},
                                                     {infinity, 1e200, Trend::same},
                                                     {1e200, 3.0, Trend::worse},
                                                     {3.0, 1e200, Trend::better}};
  for (const auto& [depth, before, trend] : cases) {
    Now now;
    now.add(0, {1, 0}, depth, {0, 0, 0}).add(0, {2, 0}, 1, {8, 8, 8});
    EarlierGaps e;
    e.rows = {was(4, {1, 0}, before, {{0, 0, 0}})};
    const GapsComparison c = now.beside(e);
    EXPECT_EQ(c.rows[0].trend, trend) << depth << ' ' << before;
    EXPECT_EQ(c.rows[1].trend, Trend::fresh);
    EXPECT_EQ(c.rows[1].earlier, no_index);
    EXPECT_EQ(c.count(Trend::fresh), 1u);
    EXPECT_EQ(c.count(trend), 1u);
  }
  EXPECT_EQ(std::string(to_string(Trend::fresh)) + to_string(Trend::worse) +
                to_string(Trend::same) + to_string(Trend::better),
            "newworsesamebetter");
}

TEST(LostTies, AreOfNodesThatWereTiedAndAreNot) {
  SmallDeck d = sheet({{5, 5, 1}, {5, 15, 1}, {5, 5, 900}, {15, 5, 900}});
  d.add(tie_card({.id = 1, .ignore = 1}));
  d.add("@/INTER/TYPE10/2 grnd_IDs=9 surf_IDm=1 Gap=2");
  d.add("@/INTER/TYPE7/3 grnd_IDs=9 surf_IDm=1 Gapmin=2");
  SceneOptions options;
  options.ties = true;
  const Built b(d, options);
  const SceneView view = make_view(b.scene);
  EarlierGaps e;
  e.untied[1] = {104};               // 103 was tied then
  e.tied[2] = {101, 103, 999};       // 104 was not
  e.tied[3] = {101, 102, 103, 104};  // no tie at all
  const GapsComparison c = compare_gaps(e, b.scene, view);
  ASSERT_EQ(c.lost_ties.size(), 2u);
  for (const auto& [inter, nodes] : c.lost_ties)
    EXPECT_EQ(nodes, (std::vector<std::int64_t>{103})) << inter->id;
  e.untied.clear();
  e.tied.clear();
  EXPECT_TRUE(compare_gaps(e, b.scene, view).lost_ties.empty());
}

// --- the old search of ties

TEST(OldSearch, TakesASegmentAtTheNearestNodeAndThePlaceOnIt) {
  struct Case {
    double x, y, z;
    std::uint32_t segment;
    double s, t, distance;
  };
  const Case cases[] = {
      {5, 5, 200, 0, 0, 0, 200},  // four nodes are as near: the highest id, its first
      {7, 6, 3, 0, 0.4, 0.2, 3},  // around node (10, 10) it is in the first segment
      {12, 6, 3, 1, -0.6, 0.2, 3},
      {8, 13, 3, 3, 0.6, -0.4, 3},
      {12, 13, -2, 4, -0.6, -0.4, 2},
      {23, 28, 2, 8, -0.4, 0.6, 2},
      {31, 15, 1, 5, 1.2, 0, 1},                     // beyond the rim: as far as it is
      {30.05, 15, 1, 5, 1, 0, std::hypot(0.05, 1)},  // by little: on the rim
      {15, -0.05, 1, 1, 0, -1, std::hypot(0.05, 1)}};
  std::vector<std::array<double, 3>> nodes;
  for (const Case& c : cases) nodes.push_back({c.x, c.y, c.z});
  SceneOptions options;
  options.ties = true;
  const Built b(sheet(nodes).add(tie_card({.isearch = 1})), options);
  const Tie& tie = b.scene.ties.at(0);
  ASSERT_EQ(tie.nodes.size(), std::size(cases));
  for (std::size_t k = 0; k < tie.nodes.size(); ++k) {
    const TiedNode& n = tie.nodes[k];
    EXPECT_TRUE(n.tied);
    EXPECT_EQ(n.segment, cases[k].segment) << k;
    EXPECT_NEAR(n.s, cases[k].s, 1e-12) << k;
    EXPECT_NEAR(n.t, cases[k].t, 1e-12) << k;
    EXPECT_NEAR(n.distance, cases[k].distance, 1e-9) << k;
  }
}

TEST(OldSearch, PlacesOnATriangleAreOverTheirFoot) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 0, 10, 0);
  const double places[][3] = {{2, 3, 4}, {6, 1, 2}, {1, 7, 3}, {3, 3, -5}};
  std::vector<int> group;
  const auto add = [&](double x, double y, double z) {
    group.push_back(101 + static_cast<int>(group.size()));
    d.node(group.back(), x, y, z);
  };
  for (const auto& p : places) add(p[0], p[1], p[2]);
  add(5.05, 5.05, 1);  // beside the long side
  add(-0.05, 4, 1);    // beside the left one
  d.shell_part(1, 2).shell3(1, 1, 1, 2, 3).group("/SURF/PART/1", {1}).group("/GRNOD/NODE/9", group);
  SceneOptions options;
  options.ties = true;
  const Built b(d.add(tie_card({.isearch = 1})), options);
  const Tie& tie = b.scene.ties.at(0);
  ASSERT_EQ(tie.nodes.size(), 6u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(tie.nodes[k].distance, std::abs(places[k][2]), 1e-9) << k;
    EXPECT_LT(std::abs(tie.nodes[k].s), 1) << k;
  }
  // On the side: s is its end, t from the height over the base.
  EXPECT_NEAR(tie.nodes[4].s, 1, 1e-12);
  EXPECT_NEAR(tie.nodes[4].t, 0.01, 1e-12);
  EXPECT_NEAR(tie.nodes[4].distance, std::hypot(0.1, 1), 1e-9);
  EXPECT_NEAR(tie.nodes[5].s, -1, 1e-12);
  EXPECT_NEAR(tie.nodes[5].t, -0.2, 1e-12);
  EXPECT_NEAR(tie.nodes[5].distance, std::hypot(0.05, 1), 1e-9);
}

// --- single elements

TEST(SingleElements, HaveTheValuesOfTheirPartPropertyAndMaterial) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 2, 0, 0).node(3, 2, 3, 0).node(4, 0, 3, 0);
  d.node(5, 0, 0, 5).node(6, 2, 0, 5).node(7, 2, 3, 5).node(8, 0, 3, 5);
  d.shell_part(1, 2, 0.75).shell_part(2, 3).solid_part(3).spring_part(4, 7);
  d.shell(1, 1, 1, 2, 3, 4).shell(2, 2, 1, 2, 6, 5).shell(2, 3, 1, 4, 8, 5, 1.5);
  d.brick(3, 4, {1, 2, 3, 4, 5, 6, 7, 8}).bar("SPRING", 4, 5, 1, 7);
  Built b(d);
  using namespace detail;
  const ElementKind shell = ElementKind::shell4;
  EXPECT_EQ(std::tuple(part_thickness(b.model, shell, 0), gap_thickness(b.model, shell, 0),
                       stiffness_thickness(b.model, shell, 0)),
            std::tuple(0.75, 0.75, 2.0));
  EXPECT_EQ(std::tuple(part_thickness(b.model, shell, 1), gap_thickness(b.model, shell, 1),
                       stiffness_thickness(b.model, shell, 1)),
            std::tuple(0.0, 3.0, 3.0));
  EXPECT_EQ(std::tuple(gap_thickness(b.model, shell, 2), stiffness_thickness(b.model, shell, 2)),
            std::tuple(1.5, 1.5));
  auto& model = const_cast<Model&>(b.model);
  model.intthick_v5 = true;  // the property alone
  EXPECT_EQ(std::tuple(gap_thickness(model, shell, 0), gap_thickness(model, shell, 2)),
            std::tuple(2.0, 3.0));
  model.intthick_v5 = false;

  EXPECT_DOUBLE_EQ(solid_volume(b.scene.coordinates, b.model.solid8.of(0)), 30);
  const double bulk = bulk_of(b.model, 0);
  EXPECT_DOUBLE_EQ(bulk, 200 / 1.2);
  Property& solid = model.properties[model.parts[model.solid8.part[0]].prop];
  Material& material = model.materials[model.parts[model.solid8.part[0]].mat];
  solid.icontrol = 1;
  for (const auto& [law, factor] : {std::pair(1, 10.0), std::pair(62, 200.0), std::pair(2, 2.0)}) {
    material.law = law;
    EXPECT_DOUBLE_EQ(bulk_of(b.model, 0), factor * bulk) << law;
  }
  solid.icontrol = 2;
  EXPECT_DOUBLE_EQ(bulk_of(b.model, 0), bulk);

  Property& spring = model.properties[model.parts[model.spring.part[0]].prop];
  for (std::size_t largest = 0; largest < 3; ++largest) {
    spring.stiffness = {3, 4, 5};
    spring.stiffness[largest] = 9;
    for (int number = 0; number < 30; ++number) {
      spring.number = number;
      const bool general = number == 8 || number == 13 || number == 23;
      EXPECT_EQ(spring_stiffness(b.model, 0), general || largest == 0 ? 9 : 3) << number;
    }
  }
}

}  // namespace
}  // namespace deck::test
