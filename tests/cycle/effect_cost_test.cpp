// What effects cost on a deck: which loops are held against each other, over which pairs, and what
// must hold before a time is told.
#include "accuracy/shared/effect_cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cycle/plates.hpp"

namespace deck {
namespace {

using test::Built;

std::unique_ptr<Built> scene_of(const std::string& fields, double distance = 0.6,
                                const std::string& type = "TYPE7") {
  return cycle::testing::plates_in_contact("@/INTER/" + type + "/1 " + fields, distance);
}

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

Measured measure(std::unique_ptr<Built> built, EffectCostOptions how = {}) {
  Measured m;
  m.built = std::move(built);
  m.state = cycle::make_state(m.built->scene, {{2, {3.0, 0.0, -1.0}}});
  cycle::CycleOptions options;
  options.dt1 = options.dt12 = 1e-6;
  how.repeats = 3;
  how.least_ns = 1e3;
  m.outcome = cycle::run_cycle(m.built->scene, m.state, options);
  m.cost = measure_effects(m.built->scene, m.state, m.outcome, options, how).at(0);
  return m;
}

TEST(EffectCost, EveryEffectOfTheAccountIsMeasuredOrSaysWhyNot) {
  const Measured m = measure(scene_of("Fric=0.2 Inacti=6"));
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

TEST(EffectCost, FrictionThatTheCardAsksForIsHeldAgainstNoneAndMovesForces) {
  const Measured m = measure(scene_of("Fric=0.2"));
  EXPECT_TRUE(m["friction-viscous"].on);
  EXPECT_EQ(m["friction-viscous"].other, "no friction");
  EXPECT_GT(m["friction-viscous"].change, 1e-3);
  // The other form excludes it.
  EXPECT_FALSE(m["friction-incremental"].why_not.empty());
}

TEST(EffectCost, EverythingCostsMoreThanWhatIsAskedFor) {
  const Measured m = measure(scene_of(""), {3, 16384, 1e6});
  EXPECT_GT(m.cost.loop_ns, 0.0);
  EXPECT_GT(m.cost.flags_ns, 0.0);
  EXPECT_GT(m.cost.all_ns, m.cost.loop_ns);
  for (const char* said : {"Inacti = 6", "Fric = 0.2", "Ifric = 2", "Ithe = 1", "Icurv = 3"})
    EXPECT_NE(m.cost.all.find(said), std::string::npos) << said << " in " << m.cost.all;
}

TEST(EffectCost, WithoutAPairInItsGapFurtherOnesAreTimed) {
  const Measured near = measure(scene_of("")), far = measure(scene_of("", 1.8)),
                 none = measure(scene_of("", 50.0));
  EXPECT_EQ(near.cost.margin, 0.0);
  EXPECT_EQ(near.cost.pairs, 4u);
  EXPECT_EQ(far.cost.margin, 1.0);
  EXPECT_EQ(far.cost.pairs, 4u);
  EXPECT_GT(far.cost.loop_ns, 0.0);
  EXPECT_EQ(far["friction-viscous"].change, 0.0);
  EXPECT_EQ(none.cost.pairs, 0u);
  EXPECT_NE(none.cost.problem, "");
  EXPECT_TRUE(none.cost.effects.empty());
}

TEST(EffectCost, AChangeIsTheLargestDifferenceOverTheLargestForce) {
  // A slow slip under a small coefficient: friction is mu Fn, across to Fn.
  const Measured m = measure(scene_of("Fric=0.001"));
  EXPECT_NEAR(m["friction-viscous"].change, 0.001 / std::sqrt(1 + 1e-6), 1e-12);
  // Istf 1 with Stfac 1 is a stiffness of 1 instead of thousands: nearly all of the force goes.
  EXPECT_GT(m["fixed-stiffness"].change, 0.9);
  EXPECT_LT(m["fixed-stiffness"].change, 1.0);
  EXPECT_EQ(m["boundary-release"].change, 0.0);
}

}  // namespace
}  // namespace deck
