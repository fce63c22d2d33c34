// What effects cost on a deck: each is measured or says why not, and by how much it changes forces.
#include "accuracy/shared/effect_cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cycle/plates.hpp"

namespace deck {
namespace {

using test::Built;

struct Measured {
  std::unique_ptr<Built> built;
  cycle::State state;
  cycle::SceneOutcome outcome;
  ContactCost cost;
  const EffectCost& operator[](const std::string& name) const {
    const auto it = std::find_if(cost.effects.begin(), cost.effects.end(),
                                 [&](const EffectCost& e) { return e.name == name; });
    if (it == cost.effects.end()) throw std::out_of_range(name);
    return *it;
  }
};

Measured measure(const std::string& fields) {
  Measured m;
  m.built = cycle::testing::plates_in_contact("@/INTER/TYPE7/1 " + fields, 0.6);
  m.state = cycle::make_state(m.built->scene, {{2, {3.0, 0.0, -1.0}}});
  cycle::CycleOptions options;
  options.dt1 = options.dt12 = 1e-6;
  EffectCostOptions how;
  how.repeats = 3;
  how.least_ns = 1e3;
  m.outcome = cycle::run_cycle(m.built->scene, m.state, options);
  m.cost = measure_effects(m.built->scene, m.state, m.outcome, options, how).at(0);
  return m;
}

TEST(EffectCost, EveryEffectOfTheAccountIsMeasuredOrSaysWhyNot) {
  const Measured m = measure("Fric=0.2 Inacti=6");
  EXPECT_EQ(m.cost.problem, "");
  const auto& account = m.outcome.contacts.at(0).effects;
  ASSERT_EQ(m.cost.effects.size(), account.size());
  std::size_t measured = 0;
  for (std::size_t i = 0; i < account.size(); ++i) {
    const EffectCost& e = m.cost.effects[i];
    EXPECT_EQ(e.name, account[i].name);
    EXPECT_EQ(e.on, account[i].on) << e.name;
    EXPECT_NE(e.why_not.empty(), e.other.empty()) << e.name;
    if (!e.why_not.empty()) continue;
    ++measured;
    EXPECT_TRUE(std::isfinite(e.ns)) << e.name;
    EXPECT_LE(e.low, e.ns) << e.name;
    EXPECT_LE(e.ns, e.high) << e.name;
  }
  EXPECT_GE(measured, 12u);
}

TEST(EffectCost, AChangeIsTheLargestDifferenceOverTheLargestForce) {
  // A slow slip under a small coefficient: friction is mu Fn, across to Fn.
  const Measured m = measure("Fric=0.001");
  EXPECT_NEAR(m["friction-viscous"].change, 0.001 / std::sqrt(1 + 1e-6), 1e-12);
  // Istf 1 with Stfac 1 is a stiffness of 1 instead of thousands: nearly all of the force goes.
  EXPECT_GT(m["fixed-stiffness"].change, 0.9);
  EXPECT_LT(m["fixed-stiffness"].change, 1.0);
  EXPECT_EQ(m["boundary-release"].change, 0.0);
}

}  // namespace
}  // namespace deck
