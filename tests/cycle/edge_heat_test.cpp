// Heat between edges: contact areas, conduction and radiation in closed form, balance of both
// sides, and the exchange of a whole deck.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cycle/plates.hpp"
#include "cycle/shared/heat.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using namespace testing;

ContactCard edge_card(int form = 1) {
  ContactCard card;
  card.kind = ContactKind::edge_edge;
  card.viss = 0.0;
  card.ithe = 1;
  card.ithe_form = form;
  card.kthe = 500.0;
  card.tint = 700.0;
  return card;
}

/// Edge along x from 0 to 10, and one of length 8 over its quarter point, turned by `angle`.
Pair crossing(double distance, double angle = std::numbers::pi / 2) {
  const Vec half{4 * std::cos(angle), 4 * std::sin(angle), 0}, centre{2.5, 0, -distance};
  Pair p;
  p.x = {Vec{0, 0, 0}, Vec{10, 0, 0}, centre - half, centre + half, Vec{}};
  p.k0 = 1e4;
  p.gap = 1.0;
  p.edge_width = {0.5, 0.8};
  return p;
}

double secondary_heat(const Outcome& r) { return r.all.heat[0][0] + r.all.heat[1][0]; }
double main_heat(const Outcome& r) { return r.all.heat[2][0] + r.all.heat[3][0]; }

TEST(EdgeHeat, AreaIsTheRhombusOfTwoStripsUpToTheWholeShorterEdge) {
  const auto area = [](double angle) {
    const Pair p = crossing(0.5, angle);
    EdgeHeatState s;
    for (std::size_t r = 0; r < 4; ++r) s.position[r] = p.x[r];
    s.width = p.edge_width;
    return edge_contact_area(edge_card(), s);
  };
  EXPECT_NEAR(area(std::numbers::pi / 2), 0.5 * 0.8, 1e-14);
  EXPECT_NEAR(area(std::numbers::pi / 6), 0.5 * 0.8 / 0.5, 1e-14);
  EXPECT_NEAR(area(0.0), 8 * 0.5, 1e-14);
  EXPECT_NEAR(area(1e-4), 8 * 0.5, 1e-14);
  EdgeHeatState s;
  s.position = {Vec{0, 0, 0}, Vec{3, 4, 0}, Vec{1, 0, 1}, Vec{1, 1, 1}};
  s.width = {0.5, 0.8};
  EXPECT_NEAR(edge_contact_area(edge_card(0), s), 5 * 0.5, 1e-14);
}

TEST(EdgeHeat, ConductionSplitsByTheWeightsOfBothEdges) {
  for (const Model model : {Model::reference, Model::robust}) {
    Pair p = crossing(0.6);
    p.temperature = {300, 340, 500, 520, 0};
    p.edge_conductivity = {20, 60, 10, 30};
    ContactCard card = edge_card();
    card.thermal_speed_up = 100;  // edges know none
    const Outcome r = testing::run(card, p, 1e-3, 1e-3, model);
    // Weights 0.75, 0.25 and 0.5, 0.5; lambda (0.75 20 + 0.25 60 + 20) / 2.
    const double ts = 310, tm = 510, lambda = 25, area = 0.4;
    const double width = 0.6 - 1.0 + 0.9;
    const double h = 1 / (1 / 500.0 + width / lambda), q = area * h * (tm - ts) * 1e-3;
    EXPECT_NEAR(r.all.heat[0][0], 0.75 * q, 1e-14);
    EXPECT_NEAR(r.all.heat[1][0], 0.25 * q, 1e-14);
    EXPECT_NEAR(r.all.heat[2][0], -0.5 * q, 1e-14);
    EXPECT_NEAR(r.all.heat[3][0], -0.5 * q, 1e-14);
    EXPECT_NEAR(r.all.conductance[0], area * h, 1e-13);
  }
}

TEST(EdgeHeat, TheInterfaceTemperatureFeedsTheSecondaryEdgeAlone) {
  Pair p = crossing(0.6);
  p.temperature = {300, 300, 900, 900, 0};
  p.edge_conductivity.fill(1e30);
  const Outcome r = testing::run(edge_card(0), p, 1e-3, 1e-3, Model::robust);
  EXPECT_NEAR(secondary_heat(r), 10 * 0.5 * 500 * 400 * 1e-3, 1e-10);
  EXPECT_EQ(main_heat(r), 0.0);
}

TEST(EdgeHeat, NothingPassesAGapWithoutConductivity) {
  Pair p = crossing(0.6);
  p.temperature = {300, 300, 500, 500, 0};
  for (const Model model : {Model::reference, Model::robust})
    EXPECT_EQ(secondary_heat(testing::run(edge_card(), p, 1.0, 1.0, model)), 0.0);
}

TEST(EdgeHeat, PressureFunctionSeesTheSignedForce) {
  ContactCard card = edge_card();
  card.kthe = 0.0;
  card.fct_idk = Curve{{0, 1e6}, {1.0, 3.0}};
  Pair p = crossing(0.6);
  p.edge_conductivity.fill(1e30);
  p.temperature = {300, 300, 400, 400, 0};
  for (const Model model : {Model::reference, Model::robust}) {
    const Outcome r = testing::run(card, p, 1.0, 1.0, model);
    const double pressure = r.all.normal_force[0] / 0.4;
    EXPECT_LT(pressure, 0.0);
    EXPECT_NEAR(secondary_heat(r), 0.4 * 100 * (1 + 2e-6 * pressure), 1e-10);
  }
}

TEST(EdgeHeat, RadiationFollowsTheFourthPowerUpToDrad) {
  ContactCard card = edge_card();
  card.frad = 4e-8;
  card.drad = 3.0;
  const auto q = [&](double distance, Model model) {
    Pair p = crossing(distance);
    p.temperature = {400, 400, 900, 900, 0};
    const Outcome r = testing::run(card, p, 0.5, 0.5, model);
    EXPECT_EQ(secondary_heat(r), -main_heat(r));
    return secondary_heat(r);
  };
  const double exact = 4e-8 * 0.4 * (std::pow(900.0, 4) - std::pow(400.0, 4)) * 0.5;
  for (const Model model : {Model::reference, Model::robust}) {
    EXPECT_NEAR(q(2.5, model), exact, 1e-12 * exact);
    EXPECT_NEAR(q(3.5, model), exact, 1e-12 * exact) << "Drad counts from the gap on";
    EXPECT_EQ(q(4.1, model), 0.0);
  }
}

TEST(EdgeHeat, SumsToNothingOverRandomPairsAndNodes) {
  const std::vector<Pair> pairs = testing::random_pairs(500, 21, true);
  const Packet packet(pairs);
  ContactCard card = edge_card();
  card.frad = 1e-8;
  card.drad = 3.0;
  for (const Model model : {Model::reference, Model::robust}) {
    PacketResult r;
    const KernelPlan plan = make_plan(card, model);
    evaluate(plan, packet.view(1e-3, 1e-3), r);
    double sum = 0.0, size = 0.0;
    for (std::size_t i = 0; i < r.size; ++i)
      for (const auto& role : r.heat) {
        sum += role[i];
        size += std::abs(role[i]);
      }
    EXPECT_GT(size, 1.0);
    EXPECT_LE(std::abs(sum), 1e-14 * size);
    PairList list;
    list.kind = ContactKind::edge_edge;
    for (std::uint32_t i = 0; i < 500; ++i)
      for (std::uint32_t k = 0; k < 4; ++k) list.node[k].push_back((7 * i + 13 * k) % 200);
    NodalSums nodes;
    nodes.resize(200);
    assemble(plan, list, r, nodes);
    double at_nodes = 0.0, conductance = 0.0, given = 0.0;
    for (const double q : nodes.heat) at_nodes += q;
    for (const double c : nodes.conductance) conductance += c;
    for (const double c : r.conductance) given += 2.0 * c;  // to both edges
    EXPECT_LE(std::abs(at_nodes), 1e-14 * size);
    EXPECT_NEAR(conductance, given, 1e-12 * given);
  }
}

// Whole decks.

/// Two trusses of section 0.25 that cross at a distance of 0.5, the upper one 100 degrees hotter.
deck::test::SmallDeck trusses(const std::string& fields) {
  deck::test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 5, -5, 0.5).node(4, 5, 5, 0.5);
  d.truss_part(1, 0.25).truss_part(2, 0.25);
  d.bar("TRUSS", 1, 1, 1, 2).bar("TRUSS", 2, 2, 3, 4);
  d.add(
      "/HEAT/MAT/1\n               300.0                 1.0                 2.0"
      "                0.01");
  d.group("/GRNOD/PART/3", {2});
  d.add("/INITEMP/1\nt\n               400.0         3");
  d.segments("/LINE/SEG/1", {{1, 2}}).segments("/LINE/SEG/2", {{3, 4}});
  d.add("@/INTER/TYPE11/1 line_IDs=1 line_IDm=2 Gapmin=1 Ithe=1 Kthe=0.5 " + fields);
  return d;
}

TEST(EdgeHeat, OfADeckTakesSectionsAndConductivityFromTheElements) {
  const deck::test::Built b(trusses("Ithe_form=1"));
  const CycleOptions options = testing::with_step(1e-3);
  const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), options);
  ASSERT_EQ(r.contacts.at(0).pairs_in_reach, 1u);
  // Widths are the root of the side of 0.5; conductivity 2 + 0.01 T, mean of 5 and 6; the way is
  // what nine tenths of the gap leave.
  const double h = 1 / (1 / 0.5 + 0.4 / 5.5), q = 0.5 * h * 100 * 1e-3;
  EXPECT_NEAR(r.contacts[0].heat_secondary, q, 1e-14);
  EXPECT_NEAR(r.contacts[0].heat_main, -q, 1e-14);
  double sum = 0.0;
  for (const double x : r.nodes.heat) sum += x;
  EXPECT_NEAR(sum, 0.0, 1e-16);
}

TEST(HeatExchange, NodesOfADeckTakeTheConductivityOfTheirShells) {
  deck::test::SmallDeck d = testing::plates(-0.6);  // the nodes are behind the segment
  d.add(
      "/HEAT/MAT/1\n               300.0                 1.0                 2.0"
      "                0.01");
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Ithe=1 Kthe=0.5 Tint=500");
  const deck::test::Built b(d);
  const CycleOptions options = testing::with_step(1e-3);
  const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), options);
  // 32 of area, conductivity 2 + 0.01 T = 5 over the distance of 0.6.
  EXPECT_NEAR(r.contacts.at(0).heat_secondary, 32 * 200 * 1e-3 / (0.6 / 5 + 1 / 0.5), 1e-12);
  EXPECT_EQ(r.contacts[0].heat_main, 0.0);
}

TEST(EdgeHeat, OfADeckRadiatesBeyondTheGap) {
  deck::test::SmallDeck d = trusses("Ithe_form=1 Frad=1e-10 Drad=4");
  d.node(5, 0, 0, -2).node(6, 10, 0, -2);
  d.bar("TRUSS", 1, 3, 5, 6).segments("/LINE/SEG/3", {{5, 6}});
  d.add(
      "@/INTER/TYPE11/2 line_IDs=3 line_IDm=2 Gapmin=1 Ithe=1 Kthe=0.5 Ithe_form=1 Frad=1e-10 "
      "Drad=4");
  const deck::test::Built b(d);
  const CycleOptions options = testing::with_step(1e-3);
  const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), options);
  const double q = 1e-10 * 0.5 * (std::pow(400.0, 4) - std::pow(300.0, 4)) * 1e-3;
  EXPECT_NEAR(r.contacts.at(1).heat_secondary, q, 1e-12 * q);
  EXPECT_EQ(r.contacts[1].pairs_with_force, 0u);
}

}  // namespace
}  // namespace deck::cycle
