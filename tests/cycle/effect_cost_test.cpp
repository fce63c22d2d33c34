// What effects cost on a deck: which loops are held against each other, over which pairs, and what
// must hold before a time is told.
#include "accuracy/shared/effect_cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "accuracy/effect_cards.hpp"
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

TEST(EffectCost, FrictionThatTheCardDoesNotAskForIsHeldAgainstSome) {
  const Measured m = measure(scene_of(""));
  EXPECT_FALSE(m["friction-viscous"].on);
  EXPECT_EQ(m["friction-viscous"].other, "Fric = 0.2, Iform = 1");
  EXPECT_GT(m["friction-viscous"].change, 1e-3);
}

TEST(EffectCost, AnEffectThatChangesNothingHereSaysSo) {
  // Temperatures are all 0: conduction moves heat, never a force.
  EXPECT_EQ(measure(scene_of(""))["heat-conduction"].change, 0.0);
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

TEST(EffectCost, NoMorePairsThanAskedForAreTimed) {
  EffectCostOptions how;
  how.most_pairs = 3;
  const Measured m = measure(scene_of(""), how);
  EXPECT_EQ(m.cost.pairs, 4u);
  EXPECT_EQ(m.cost.measured, 3u);
}

TEST(EffectCost, AContactThatIsNotActiveIsNotTimed) {
  EXPECT_EQ(measure(scene_of("Tstart=1")).cost.problem, "not active at this time");
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

// --- cards that differ in one effect

using cycle::ContactCard;
using cycle::ContactKind;

ContactCard plain_card() {
  ContactCard c;
  c.viss = 0.0;
  c.gapmin = 0.75;
  return c;
}
/// Every effect of a node-segment card that can be there with the others.
ContactCard rich_card() {
  ContactCard c;
  c.istf = 1;
  c.inacti = 5;
  c.viss = 0.125;
  c.fric = 0.375;
  c.ifric = 3;
  c.c = {1, 2, 3, 4, 5, 6};
  c.ifiltr = 2;
  c.xfreq = 8;
  c.ithe = c.ithe_form = 1;
  c.fct_idf = cycle::Curve{{0, 1}, {2, 3}};
  c.kthe = 3;
  c.fct_idk = cycle::Curve{{0, 4}, {5, 6}};
  c.frad = 1e-5;
  c.drad = 2;
  c.fheats = 0.25;
  c.fheatm = 0.5;
  c.icurv = 1;
  c.iadm = 1;
  c.dtmin = 1e-4;
  c.ibc = 5;
  return c;
}

TEST(EffectCards, GivingTurnsNothingElseOffAndTakingNothingElseOn) {
  for (const ContactKind kind :
       {ContactKind::node_segment, ContactKind::edge_edge, ContactKind::tied})
    for (ContactCard card : {plain_card(), rich_card()}) {
      card.kind = kind;
      const auto account = cycle::effect_plan(card);
      std::size_t found = 0;
      for (std::size_t k = 0; k < account.size(); ++k) {
        std::string why_not;
        const auto made = accuracy::other_card(card, account[k], why_not);
        if (!made) continue;
        ++found;
        EXPECT_NE(made->says, "") << account[k].name;
        const auto after = cycle::effect_plan(made->card);
        EXPECT_EQ(after[k].on, !account[k].on) << account[k].name;
        for (std::size_t j = 0; j < account.size(); ++j) {
          const bool tie_for_deletion =
              account[k].name == "tie-on-time-step" && account[j].name == "time-step-deletion";
          if (j == k || tie_for_deletion || after[j].on == account[j].on) continue;
          EXPECT_EQ(after[j].on, !account[k].on) << account[k].name << ": " << account[j].name;
        }
      }
      EXPECT_EQ(found > 0, kind != ContactKind::tied || card.viss > 0) << static_cast<int>(kind);
    }
}

}  // namespace
}  // namespace deck
