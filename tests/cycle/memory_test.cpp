// What an interface remembers and reports over steps: figures of lines and events by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/adapter/parts.hpp"
#include "cycle/plates.hpp"
#include "cycle/state/state_parts.hpp"
#include "cycle/support.hpp"
#include "deck/cycle/steps.hpp"

namespace deck::cycle {
namespace {

using test::Built;

// --- steps

/// The plates with a height of the upper one in each step.
struct Heights {
  std::unique_ptr<Built> built;
  StepsOutcome outcome;
  std::vector<std::vector<PairOutcome>> pairs;
  Heights(const std::string& card, const std::vector<double>& heights, bool moving = true) {
    const double dt = 0.5;
    built = testing::plates_in_contact(card, heights[0]);
    CycleOptions options;
    options.keep_pairs = true;
    options.time = 7;
    options.dt1 = options.dt12 = dt;
    const auto move = [&](std::size_t k, Coordinates& x, State& state, CycleOptions& o) {
      o.time = 7 + 10 * static_cast<double>(k);
      if (state.velocity[2].empty())
        for (auto& v : state.velocity) v.resize(x.z.size(), 0.0);
      for (const std::int64_t id : {11, 12, 13, 14}) {
        const NodeIndex n = built->model.nodes.map.find(id);
        x.z[n] = heights[k];
        state.velocity[2][n] = k == 0 || !moving ? 0 : (heights[k] - heights[k - 1]) / dt;
      }
    };
    const auto look = [&](std::size_t, const SceneOutcome& r, const Coordinates&) {
      pairs.push_back(r.contacts.at(0).pairs);
    };
    outcome =
        run_steps(built->scene, make_state(built->scene), options, heights.size(), move, look);
  }
};

TEST(StepLines, HaveTheFiguresOfTheirEvaluation) {
  const Heights h("@/INTER/TYPE7/1", {0.6, 0.8, 1.5, 0.5}, false);  // at rest: no damping
  ASSERT_EQ(h.outcome.lines.size(), 4u);
  const double k0 = h.pairs[0].at(0).k0;
  const double depths[] = {0.4, 0.2, 0, 0.5}, left[] = {0.6, 0.8, 1, 0.5};
  for (std::size_t k = 0; k < 4; ++k) {
    const StepLine& line = h.outcome.lines[k];
    const StepContact& c = line.contacts.at(0);
    EXPECT_EQ(line.time, 7 + 10 * static_cast<double>(k));
    EXPECT_EQ(line.dt1, 0.5);
    EXPECT_TRUE(c.active);
    EXPECT_EQ(std::tuple(c.pairs_with_force, c.pairs_tied, c.removed),
              std::tuple(k == 2 ? 0u : 4u, 0u, 0u));
    const double force = 4 * 0.5 * k0 * depths[k] / left[k];
    EXPECT_NEAR(c.force_sum, force, 1e-9 * force + 1e-12) << k;
    EXPECT_NEAR(c.normal[2], -force, 1e-9 * force + 1e-12) << k;
    // The potential of the law: K/2 (d - 1 - ln d) for a gap of 1.
    const double energy = 4 * 0.5 * k0 * (left[k] - 1 - std::log(left[k]));
    EXPECT_NEAR(c.elastic_energy, energy, 1e-9 * energy + 1e-12) << k;
    EXPECT_NEAR(c.tangential[0], 0, 1e-9 * force + 1e-12);
  }
  EXPECT_TRUE(h.outcome.events.empty());
  EXPECT_EQ(h.outcome.coordinates.z[h.built->model.nodes.map.find(11)], 0.5);
}

TEST(StepEvents, OfTiesNameThePairWhenItTiesAndWhenItLetsGo) {
  // From outside the gap down by 0.12 and 0.1, up by 0.15 and 0.15: there the force turns.
  const Heights h("@/INTER/TYPE10/1 VISs=0", {1.02, 0.9, 0.8, 0.95, 1.1});
  ASSERT_EQ(h.outcome.events.size(), 8u);
  for (std::uint32_t k = 0; k < 8; ++k) {
    const StepEvent& e = h.outcome.events[k];
    const bool ties = k < 4;
    EXPECT_EQ(std::tuple(e.step, e.time, e.contact, e.kind, e.at.secondary, e.at.main),
              std::tuple(ties ? std::size_t{1} : 4, ties ? 17.0 : 47.0, 0u,
                         ties ? StepEvent::Kind::tied : StepEvent::Kind::let_go, k % 4, 0u));
  }
  const std::size_t tied[] = {0, 4, 4, 4, 0};
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(h.outcome.lines[k].contacts[0].pairs_tied, tied[k]) << k;
}

TEST(StepEvents, OfRemovalsComeOnceAndAreCountedOn) {
  const Heights h("@/INTER/TYPE7/1 dtmin=1000", {0.6, 0.6, 0.6});
  ASSERT_EQ(h.outcome.events.size(), 4u);
  for (std::uint32_t s = 0; s < 4; ++s) {
    const StepEvent& e = h.outcome.events[s];
    EXPECT_EQ(
        std::tuple(e.step, e.kind, e.at.secondary, e.at.main, e.because),
        std::tuple(std::size_t{0}, StepEvent::Kind::removed, s, 0u, Removal::Because::nodal_step));
  }
  for (const StepLine& line : h.outcome.lines) EXPECT_EQ(line.contacts[0].removed, 4u);
  EXPECT_GT(h.outcome.lines[0].contacts[0].force_sum, 0) << "the force of its last cycle stays";
  EXPECT_EQ(h.outcome.lines[1].contacts[0].force_sum, 0);
}

TEST(SearchesOverSteps, AreMadeAgainWhenTheMarginIsUsedUp) {
  const auto searches = [](double margin) {
    const auto b = testing::plates_in_contact("@/INTER/TYPE7/1", 3);
    CycleOptions options;
    options.margin = margin;
    const auto move = [&](std::size_t k, Coordinates& x, State&, CycleOptions&) {
      for (const std::int64_t id : {11, 12, 13, 14})
        x.z[b->model.nodes.map.find(id)] = 3 - 0.25 * static_cast<double>(k);
    };
    return run_steps(b->scene, make_state(b->scene), options, 9, move).searches;
  };
  // Moves of 0, 0.25, ... 2 from the first place: a margin that is reached is used up.
  EXPECT_EQ(searches(0.5), 5u);   // at 0, 0.5, 1, 1.5 and 2
  EXPECT_EQ(searches(0.51), 3u);  // at 0, 0.75 and 1.5
  EXPECT_EQ(searches(5), 1u);
}

TEST(SearchesOverSteps, LookTenStepsAheadButNotBeyondGapAndShortestSide) {
  // Velocity 1, steps of 0.01: a margin of 0.1; with steps of 10 it is 1 + 10.
  const auto searches = [](double dt, std::size_t steps) {
    const auto b = testing::plates_in_contact("@/INTER/TYPE7/1", 300);
    CycleOptions options;
    options.dt1 = options.dt12 = dt;
    return run_steps(b->scene, make_state(b->scene, {{2, {0, 0, -1}}}), options, steps).searches;
  };
  EXPECT_EQ(searches(1.0 / 128, 21), 3u) << "at 0, 10 and 20";
  EXPECT_EQ(searches(8, 5), 3u) << "at 0, 16 and 32: one step of 8 is below 11, two are not";
}

}  // namespace
}  // namespace deck::cycle
