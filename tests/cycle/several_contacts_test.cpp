// Several contacts of a deck: time steps, forces, heat and stiffness add up at common nodes. Axes
// of skews, and nodes of elements that are gone.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "contact/small_deck.hpp"
#include "cycle/adapter/effect_inputs.hpp"
#include "cycle/plates.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using test::Built;

const char* const warm = "/HEAT/MAT/1\n               300.0                 1.0\n";

std::unique_ptr<Built> with(const std::string& interface, const std::string& more = "") {
  test::SmallDeck d = testing::plates(0.6);
  if (!more.empty()) d.add(more);
  d.add(interface);
  return std::make_unique<Built>(d, testing::with_stiffness());
}

// --- several contacts

/// Plates under two interfaces, the second one with `fields`.
std::unique_ptr<Built> twice(const std::string& first, const std::string& second) {
  return with("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 " + first +
              "\n@/INTER/TYPE7/2 grnd_IDs=1 surf_IDm=2 Gapmin=1 " + second);
}

TEST(SeveralContacts, LimitTheStepTogether) {
  // Stiffness 1 and 3 in Istf 1: at each upper node K/2 / (0.6)^2 of both.
  const auto b = twice("Istf=1 Stfac=100", "Istf=1 Stfac=300");
  const State state = make_state(b->scene);
  const SceneOutcome r = run_cycle(b->scene, state, {});
  const NodeIndex upper = b->model.nodes.map.find(11);
  const double own = r.contacts[0].step.dt, other = r.contacts[1].step.dt;
  EXPECT_NEAR(own / other, std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(r.contact_dt, 0.9 * std::sqrt(2 * state.mass[upper] / r.nodes.stiffness[upper]),
              1e-12 * r.contact_dt);
  EXPECT_NEAR(r.contact_dt / other, std::sqrt(3.0 / 4.0), 1e-9);
  EXPECT_EQ(r.contact_dt_source, StepLimit::Source::nodal);
  EXPECT_EQ(r.limiting_contact, 1u) << "the one that stiffens the node most";
  const auto swapped = twice("Istf=1 Stfac=300", "Istf=1 Stfac=100");
  EXPECT_EQ(run_cycle(swapped->scene, make_state(swapped->scene), {}).limiting_contact, 0u);
  // Both push: forces of the nodes are sums, and so are the stiffnesses.
  EXPECT_NEAR(r.nodes.force[2][upper],
              -r.contacts[0].largest.force[2] - r.contacts[1].largest.force[2], 1e-9);
  EXPECT_NEAR(r.nodes.stiffness[upper],
              r.contacts[0].largest.k_nodal + r.contacts[1].largest.k_nodal, 1e-9);
}

TEST(SeveralContacts, AddTheirHeatAtTheNodes) {
  const std::string card = " grnd_IDs=1 surf_IDm=2 Gapmin=1 Ithe=1 Ithe_form=1 Kthe=";
  const auto b = with("@/INTER/TYPE7/1" + card + "2\n@/INTER/TYPE7/2" + card + "3", warm);
  State state = make_state(b->scene);
  state.heated = true;
  state.temperature.assign(b->model.nodes.size(), 50);
  std::vector<NodeIndex> upper;
  for (const std::int64_t id : {11, 12, 13, 14}) upper.push_back(b->model.nodes.map.find(id));
  for (const NodeIndex n : upper) state.temperature[n] = 150;
  const CycleOptions options = testing::with_step(0.5);
  const SceneOutcome r = run_cycle(b->scene, state, options);
  // Each node has a quarter of its shell of 32: Q = A (50 - 150) dt Kthe.
  for (const NodeIndex n : upper) EXPECT_NEAR(r.nodes.heat[n], 8 * -100 * 0.5 * (2 + 3), 1e-9);
  EXPECT_NEAR(r.contacts[1].heat_main, 4 * 8 * 100 * 0.5 * 3, 1e-9);
  const auto sum = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0);
  };
  EXPECT_NEAR(sum(r.nodes.heat), 0, 1e-9);
  EXPECT_NEAR(sum(r.nodes.conductance), 2 * 4 * 8 * (2 + 3), 1e-9);
}

TEST(SeveralContacts, AnApproachLimitsByTheContactWithTheSmallerGap) {
  const auto b = with(
      "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=0.5\n"
      "@/INTER/TYPE7/2 grnd_IDs=1 surf_IDm=2 Gapmin=0.25\n"
      "@/INTER/TYPE7/3 grnd_IDs=1 surf_IDm=2 Gapmin=0.375");
  const State state = make_state(b->scene, {{2, {0, 0, -100}}});
  const SceneOutcome r = run_cycle(b->scene, state, {});
  EXPECT_EQ(r.contact_dt_source, StepLimit::Source::velocity);
  EXPECT_DOUBLE_EQ(r.contact_dt, 0.9 * 0.25 / 100);
  EXPECT_EQ(r.limiting_contact, 1u);
  for (std::size_t k = 0; k < 3; ++k) {
    const double gap[] = {0.5, 0.25, 0.375};
    EXPECT_DOUBLE_EQ(r.contacts[k].step.dt, 0.9 * gap[k] / 100) << k;
    EXPECT_EQ(r.contacts[k].step.source, StepLimit::Source::velocity);
  }
}

// --- skews and materials

TEST(FixedSkew, HasItsAxesAtRightAnglesOfLengthOne) {
  using Three = std::array<double, 3>;
  const auto axes = [](const Three& y, const Three& z) {
    std::string card = "/SKEW/FIX/7\ns\n";
    for (const Three& v : {Three{}, y, z}) card += fmt::sprintf("%20g%20g%20g\n", v[0], v[1], v[2]);
    return detail::fixed_axes(with(card)->model, 7);
  };
  // X = Y x Z = (6, 0, 0), Z becomes (0, 0, 1).
  const auto straight = axes({0, 2, 0}, {0, 1, 3});
  ASSERT_TRUE(straight.has_value());
  EXPECT_EQ(straight->matrix, (std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
  // X = (0, 20, 0) / 20, Z = X x Y = (1, 0, 0).
  const auto turned = axes({0, 0, 5}, {4, 0, 1});
  ASSERT_TRUE(turned.has_value());
  EXPECT_EQ(turned->matrix, (std::array<double, 9>{0, 0, 1, 1, 0, 0, 0, 1, 0}));
  EXPECT_FALSE(axes({0, 2, 0}, {0, 3, 0}).has_value()) << "along each other";
  EXPECT_FALSE(axes({}, {0, 3, 0}).has_value()) << "of no length";
  EXPECT_FALSE(axes({0, 2, 0}, {}).has_value());
}

// --- elements that are gone

TEST(DeadElements, OfEveryKindTakeTheirNodesWithIdel) {
  // One node each of a quad, a triangle, a brick, a truss, a beam and a spring, over a plate.
  test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 1000, 0, 0).node(3, 1000, 1000, 0).node(4, 0, 1000, 0);
  d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4);
  std::vector<int> low;
  for (int k = 0; k < 6; ++k) {
    const int n = 100 + 10 * k;
    const double x = 100.0 + 100 * k;
    low.push_back(n);
    d.node(n, x, 500, 0.5).node(n + 1, x, 500, 20).node(n + 2, x + 10, 500, 20);
    d.node(n + 3, x, 510, 20).node(n + 4, x, 500, 40).node(n + 5, x + 10, 500, 40);
    d.node(n + 6, x, 510, 40).node(n + 7, x + 10, 510, 40);
  }
  d.shell_part(2, 1).solid_part(3).truss_part(4, 1).beam_part(5, 1).spring_part(6, 1);
  d.shell(2, 11, 100, 102, 105, 101).shell3(2, 12, 110, 112, 111);
  d.brick(3, 13, {120, 122, 127, 123, 121, 125, 126, 124});
  d.bar("TRUSS", 4, 14, 130, 131).bar("BEAM", 5, 15, 140, 141, 142).bar("SPRING", 6, 16, 150, 151);
  d.group("/GRNOD/NODE/1", low).group("/SURF/PART/2", {1});
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Idel=1");
  const Built b(d, testing::with_stiffness());
  const State state = make_state(b.scene);
  const ElementKind kinds[] = {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                               ElementKind::truss,  ElementKind::beam,   ElementKind::spring};
  ASSERT_EQ(b.contact().secondary.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    // The first shell is the plate itself: of its kind the second one.
    const std::uint32_t element = k == 0 ? 1 : 0;
    CycleOptions options;
    options.time = 0.5;
    options.dead = {{kinds[k], element, 0.5}};
    const SceneOutcome r = run_cycle(b.scene, state, options);
    ASSERT_EQ(r.contacts[0].removed.size(), 1u) << k;
    const NodeIndex gone = b.contact().secondary[r.contacts[0].removed[0].secondary].node;
    EXPECT_EQ(b.model.node_id(gone), low[k]) << k;
    EXPECT_EQ(r.contacts[0].removed[0].because, Removal::Because::no_element_left);
    options.dead[0].from = 0.75;
    EXPECT_TRUE(run_cycle(b.scene, state, options).contacts[0].removed.empty()) << k;
  }
  CycleOptions all;
  for (std::size_t k = 0; k < 6; ++k) all.dead.push_back({kinds[k], k == 0 ? 1u : 0u, 0.0});
  EXPECT_EQ(run_cycle(b.scene, state, all).contacts[0].removed.size(), 6u);
}

}  // namespace
}  // namespace deck::cycle
