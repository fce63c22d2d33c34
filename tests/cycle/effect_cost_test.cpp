// What effects cost on a deck: which loops are held against each other, over which pairs, and what
// must hold before a time is told.
#include "accuracy/shared/effect_cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "accuracy/effect_cards.hpp"
#include "cycle/plates.hpp"
#include "report/shared/cycle.hpp"

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

TEST(EffectCost, EachEffectSaysWhatItIsHeldAgainst) {
  using Row = std::array<std::string, 3>;  // effect, what the other card says, why there is none
  const std::string nowhere = "acts outside the loop over pairs", loop = "the loop itself";
  const std::string search = "acts in the search, not in the loop over pairs";
  const std::string none = "needs a /FRICTION, which the deck does not name here";
  const Row rows[] = {
      {"elastic-normal", "", loop},
      {"tie", "", loop},
      {"stiffness-combination", "", search},
      {"fixed-stiffness", "Istf = 1", ""},
      {"variable-gap", "", search},
      {"gap-reduction", "Inacti = 0", ""},
      {"initial-penetration-action", "", search},
      {"penetration-limit", "", search},
      {"normal-damping", "VISs = 0", ""},
      {"friction-viscous", "no friction", ""},
      {"friction-incremental", "", "the other friction formulation is used"},
      {"friction-law", "Fric = 0.2, Ifric = 2", ""},
      {"friction-temperature", "Ithe = 1, a function fct_IDF", ""},
      {"friction-temperature-scale", "", nowhere},
      {"friction-filter", "Fric = 0.2, Ifiltr = 1, Xfreq = 0.3", ""},
      {"orthotropic-friction", "", none},
      {"part-pair-friction", "", none},
      {"heat-conduction", "Ithe = 1, Kthe = 1", ""},
      {"radiation", "Ithe = 1, Frad = 1e-8, Drad = Gapmin", ""},
      {"friction-heat", "Ithe = 1, Fric = 0.2, Fheats = 0.5", ""},
      {"curvature", "Icurv = 3", ""},
      {"adaptivity-criteria", "Iadm = 2", ""},
      {"contact-time-step", "", loop},
      {"time-step-deletion", "dtmin = 1e-300", ""},
      {"tie-on-time-step", "ITIED = 1, dtmin = 1e-300", ""},
      {"boundary-release", "IBC = 111", ""},
      {"contact-flag", "", nowhere},
      {"element-deletion", "", nowhere},
      {"activity-window", "", nowhere},
  };
  const Measured m = measure(scene_of("Fric=0.2 Inacti=6"));
  ASSERT_EQ(m.cost.effects.size(), std::size(rows));
  for (const Row& row : rows) {
    EXPECT_EQ(m[row[0]].other, row[1]) << row[0];
    EXPECT_EQ(m[row[0]].why_not, row[2]) << row[0];
    if (row[1].empty()) {
      EXPECT_EQ(m[row[0]].ns, 0.0) << row[0];
    }
  }
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

TEST(EffectCost, LooksFurtherForPairsUpToFiveTimesTheGap) {
  const auto at = [](double distance, bool loops_only) {
    EffectCostOptions how;
    how.loops_only = loops_only;
    return measure(scene_of("", distance), how).cost;
  };
  EXPECT_EQ(at(3.5, false).margin, 4.0);
  EXPECT_EQ(at(3.5, false).pairs, 4u);
  EXPECT_EQ(at(3.5, false).problem, "");
  EXPECT_EQ(at(30.0, false).problem, "no pair is within five times the gap");
  EXPECT_EQ(at(30.0, false).margin, 4.0);
  const ContactCost near = at(0.6, true), far = at(1.8, true);
  EXPECT_EQ(near.problem, "");
  EXPECT_GT(near.loop_ns, 0.0);
  EXPECT_GT(near.all_ns, 0.0);
  EXPECT_NE(near.all, "");
  EXPECT_EQ(near.flags_ns, 0.0);
  EXPECT_TRUE(near.effects.empty());
  EXPECT_EQ(far.margin, 0.0);
  EXPECT_EQ(far.pairs, 0u);
  EXPECT_EQ(far.loop_ns, 0.0);
}

TEST(EffectCost, AContactWithoutAWholeResultIsNotTimed) {
  Measured m = measure(scene_of(""));
  const auto problem = [&] {
    const auto costs = measure_effects(m.built->scene, m.state, m.outcome, {}, {1, 1, 0.0});
    EXPECT_EQ(costs.size(), 1u);
    EXPECT_EQ(costs[0].contact, 0u);
    return costs[0].problem;
  };
  EXPECT_EQ(problem(), "");
  m.outcome.contacts[0].complete = false;
  EXPECT_EQ(problem(), "not evaluated");
  m.outcome.contacts[0].complete = true;
  m.built->scene.contacts[0].evaluated = false;
  EXPECT_EQ(problem(), "not evaluated");
  m.built->scene.contacts[0].evaluated = true;
  m.built->scene.contacts[0].dropped = true;
  EXPECT_EQ(problem(), "not evaluated");
}

// --- cards that differ in one effect

using cycle::ContactCard;
using cycle::ContactKind;
using nlohmann::json;

json curve_json(const std::optional<cycle::Curve>& c) { return c ? json{c->x, c->y} : json(); }
json json_of(const ContactCard& c) {
  return {{"istf", c.istf},       {"inacti", c.inacti},
          {"viss", c.viss},       {"fric", c.fric},
          {"ifric", c.ifric},     {"c", c.c},
          {"iform", c.iform},     {"ifiltr", c.ifiltr},
          {"xfreq", c.xfreq},     {"fct_idf", curve_json(c.fct_idf)},
          {"fric_id", c.fric_id}, {"fric_orthotropic", c.fric_orthotropic},
          {"icurv", c.icurv},     {"iadm", c.iadm},
          {"ithe", c.ithe},       {"ithe_form", c.ithe_form},
          {"kthe", c.kthe},       {"fct_idk", curve_json(c.fct_idk)},
          {"frad", c.frad},       {"drad", c.drad},
          {"fheats", c.fheats},   {"fheatm", c.fheatm},
          {"dtmin", c.dtmin},     {"itied", c.itied},
          {"ibc", c.ibc}};
}
/// The members of `after` that are not those of `before`.
json changed(const ContactCard& before, const ContactCard& after) {
  const json a = json_of(before), b = json_of(after);
  json out = json::object();
  for (const auto& [key, value] : b.items())
    if (a.at(key) != value) out[key] = value;
  return out;
}
const cycle::EffectState& effect_of(const std::vector<cycle::EffectState>& account,
                                    const std::string& name) {
  return *std::find_if(account.begin(), account.end(),
                       [&](const cycle::EffectState& e) { return e.name == name; });
}
/// What of a card is changed for an effect that it has or has not; the reason where it cannot be.
json other(const ContactCard& card, const std::string& name) {
  const auto account = cycle::effect_plan(card);
  std::string why_not = "of an earlier call";
  const auto found = accuracy::other_card(card, effect_of(account, name), why_not);
  EXPECT_EQ(found.has_value(), why_not.empty()) << name;
  return found ? changed(card, found->card) : json(why_not);
}

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

TEST(EffectCards, GiveAnEffectTheValuesThatTheWordsName) {
  const json law = {1e-6, -1e-3, 1e-6, -1e-3, 1e-2, -1e-2};
  const json curve = {{0.0, 1000.0}, {1.0, 2.0}};
  const json given = {
      {"fixed-stiffness", {{"istf", 1}}},
      {"gap-reduction", {{"inacti", 6}}},
      {"normal-damping", {{"viss", 0.05}}},
      {"friction-viscous", {{"fric", 0.2}}},
      {"friction-incremental", {{"fric", 0.2}, {"iform", 2}}},
      {"friction-law", {{"fric", 0.2}, {"ifric", 2}, {"c", law}}},
      {"friction-temperature", {{"ithe", 1}, {"fct_idf", curve}}},
      {"friction-filter", {{"fric", 0.2}, {"ifiltr", 1}, {"xfreq", 0.3}}},
      {"heat-conduction", {{"ithe", 1}, {"ithe_form", 1}, {"kthe", 1.0}}},
      {"radiation", {{"ithe", 1}, {"ithe_form", 1}, {"frad", 1e-8}, {"drad", 0.75}}},
      {"friction-heat", {{"ithe", 1}, {"ithe_form", 1}, {"fric", 0.2}, {"fheats", 0.5}}},
      {"curvature", {{"icurv", 3}}},
      {"adaptivity-criteria", {{"iadm", 2}}},
      {"time-step-deletion", {{"dtmin", 1e-300}}},
      {"tie-on-time-step", {{"itied", 1}, {"dtmin", 1e-300}}},
      {"boundary-release", {{"ibc", 7}}},
  };
  for (const auto& [name, values] : given.items()) EXPECT_EQ(other(plain_card(), name), values);
  // A coefficient that is there stays; without a gap radiation reaches next to nothing.
  ContactCard rough = plain_card();
  rough.fric = 0.5;
  rough.gapmin = 0.0;
  for (const char* name : {"friction-law", "friction-filter", "friction-heat"})
    EXPECT_FALSE(other(rough, name).contains("fric")) << name;
  EXPECT_EQ(other(rough, "radiation").at("drad"), 1e-300);
  // The viscous form on a card of the other one.
  ContactCard spring = plain_card();
  spring.iform = 2;
  EXPECT_EQ(other(spring, "friction-viscous"), (json{{"fric", 0.2}, {"iform", 1}}));
}

TEST(EffectCards, TakeAnEffectAway) {
  const json taken = {
      {"fixed-stiffness", {{"istf", 0}}},
      {"gap-reduction", {{"inacti", 0}}},
      {"normal-damping", {{"viss", 0.0}}},
      {"friction-viscous", {{"fric", 0.0}, {"ifric", 0}, {"fct_idf", nullptr}}},
      {"friction-law", {{"ifric", 0}}},
      {"friction-temperature", {{"fct_idf", nullptr}}},
      {"friction-filter", {{"ifiltr", 0}}},
      {"heat-conduction", {{"kthe", 0.0}, {"fct_idk", nullptr}}},
      {"radiation", {{"frad", 0.0}, {"drad", 0.0}}},
      {"friction-heat", {{"fheats", 0.0}, {"fheatm", 0.0}}},
      {"curvature", {{"icurv", 0}}},
      {"adaptivity-criteria", {{"iadm", 0}}},
      {"time-step-deletion", {{"dtmin", 0.0}}},
      {"boundary-release", {{"ibc", 0}}},
  };
  for (const auto& [name, values] : taken.items()) EXPECT_EQ(other(rich_card(), name), values);
  ContactCard tied = rich_card();
  tied.itied = 2;
  EXPECT_EQ(other(tied, "tie-on-time-step"), (json{{"itied", 0}}));
  ContactCard spring = rich_card();
  spring.iform = 2;
  EXPECT_EQ(other(spring, "friction-incremental"), taken.at("friction-viscous"));
  ContactCard parts = rich_card();
  parts.fric_id = parts.fric_orthotropic = true;
  EXPECT_EQ(other(parts, "orthotropic-friction"), (json{{"fric_orthotropic", false}}));
  EXPECT_EQ(other(parts, "part-pair-friction"),
            (json{{"fric_id", false}, {"fric_orthotropic", false}}));
  EXPECT_EQ(other(parts, "friction-viscous").at("fric_id"), false);
  EXPECT_EQ(other(parts, "friction-viscous").at("fric_orthotropic"), false);
  parts.fric = 0.0;
  EXPECT_EQ(other(parts, "part-pair-friction").at("fric"), 0.2);
}

TEST(EffectCards, HeatExchangeEndsWithItsLastEffect) {
  ContactCard none = plain_card();
  none.ithe = 1;
  none.fric = 0.5;
  const auto with = [&](auto&& set) {
    ContactCard c = none;
    set(c);
    return c;
  };
  const ContactCard conducts = with([](ContactCard& c) { c.kthe = 2; });
  const ContactCard by_function = with([](ContactCard& c) {
    c.fct_idk = cycle::Curve{{0, 1}, {2, 3}};
  });
  const ContactCard radiates = with([](ContactCard& c) { c.frad = 1e-5, c.drad = 2; });
  const ContactCard rubs = with([](ContactCard& c) { c.fheats = 0.25; });
  EXPECT_EQ(other(conducts, "heat-conduction"), (json{{"kthe", 0.0}, {"ithe", 0}}));
  EXPECT_EQ(other(by_function, "heat-conduction"), (json{{"fct_idk", nullptr}, {"ithe", 0}}));
  EXPECT_EQ(other(radiates, "radiation"), (json{{"frad", 0.0}, {"drad", 0.0}, {"ithe", 0}}));
  EXPECT_EQ(other(rubs, "friction-heat"), (json{{"fheats", 0.0}, {"ithe", 0}}));
  // Each of the others keeps it.
  for (const auto& [keeps, set] : std::vector<std::pair<const char*, void (*)(ContactCard&)>>{
           {"kthe", [](ContactCard& c) { c.kthe = 2; }},
           {"fct_idk",
            [](ContactCard& c) {
              c.fct_idk = cycle::Curve{{0, 1}, {2, 3}};
            }},
           {"radiation", [](ContactCard& c) { c.frad = 1e-5, c.drad = 2; }}}) {
    ContactCard both = rubs;
    set(both);
    EXPECT_FALSE(other(both, "friction-heat").contains("ithe")) << keeps;
  }
  for (double ContactCard::*heat : {&ContactCard::fheats, &ContactCard::fheatm}) {
    ContactCard both = conducts;
    both.*heat = 0.25;
    EXPECT_FALSE(other(both, "heat-conduction").contains("ithe"));
  }
  // Half of what radiation needs is none.
  for (double ContactCard::*half : {&ContactCard::frad, &ContactCard::drad}) {
    ContactCard both = conducts;
    both.*half = 0.25;
    EXPECT_TRUE(other(both, "heat-conduction").contains("ithe"));
  }
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

TEST(EffectCards, SayWhyAnEffectCannotBeGiven) {
  const json type = "contacts of this type do not have this effect";
  const json friction = "needs a /FRICTION, which the deck does not name here";
  const json form = "the other friction formulation is used";
  ContactCard edge = plain_card(), tied = plain_card(), rubbing = plain_card();
  edge.kind = ContactKind::edge_edge;
  tied.kind = ContactKind::tied;
  rubbing.fric = 0.5;
  for (const char* name : {"fixed-stiffness", "friction-law", "friction-temperature",
                           "friction-filter", "orthotropic-friction", "friction-heat", "curvature",
                           "adaptivity-criteria", "tie-on-time-step", "boundary-release"})
    EXPECT_EQ(other(edge, name), type) << name;
  for (const char* name :
       {"gap-reduction", "normal-damping", "friction-viscous", "friction-incremental",
        "heat-conduction", "radiation", "time-step-deletion"})
    EXPECT_TRUE(other(edge, name).is_object()) << name;
  EXPECT_EQ(other(edge, "part-pair-friction"), friction);
  for (const char* name : {"gap-reduction", "friction-viscous", "curvature", "time-step-deletion"})
    EXPECT_EQ(other(tied, name), type) << name;
  EXPECT_EQ(other(plain_card(), "orthotropic-friction"), friction);
  EXPECT_EQ(other(rubbing, "friction-incremental"), form);
  EXPECT_EQ(other(plain_card(), "tie"), "the loop itself");
  rubbing.iform = 2;
  EXPECT_EQ(other(rubbing, "friction-viscous"), form);
  EXPECT_TRUE(other(rubbing, "friction-law").is_object());
  ContactCard ties = plain_card();
  ties.itied = 1;
  EXPECT_EQ(other(ties, "time-step-deletion"), "ITIED ties instead");
}

TEST(EffectCards, EverythingTogetherLeavesOutWhatExcludesAnother) {
  const accuracy::OtherCard all = accuracy::everything(plain_card());
  EXPECT_EQ(all.says,
            "Inacti = 6; VISs = 0.05; Fric = 0.2, Iform = 1; Fric = 0.2, Ifric = 2; Fric = 0.2, "
            "Ifiltr = 1, Xfreq = 0.3; Ithe = 1, Kthe = 1; Ithe = 1, Frad = 1e-8, Drad = Gapmin; "
            "Ithe = 1, Fric = 0.2, Fheats = 0.5; Icurv = 3; Iadm = 2; ITIED = 1, dtmin = 1e-300; "
            "IBC = 111");
  for (const cycle::EffectState& e : cycle::effect_plan(all.card)) {
    const bool left_out = e.name == "time-step-deletion" || e.name == "friction-temperature" ||
                          e.name == "fixed-stiffness" || e.name == "friction-incremental";
    if (all.says.find(e.field + " = ") != std::string::npos && !e.field.empty()) {
      EXPECT_EQ(e.on, !left_out && e.name != "stiffness-combination" &&
                          e.name != "initial-penetration-action")
          << e.name;
    }
  }
  ContactCard edge = plain_card();
  edge.kind = ContactKind::edge_edge;
  edge.iform = 2;
  edge.fric = 0.5;
  const accuracy::OtherCard of_edges = accuracy::everything(edge);
  EXPECT_EQ(of_edges.says,
            "Inacti = 6; VISs = 0.05; Ithe = 1, Kthe = 1; Ithe = 1, Frad = 1e-8, Drad = Gapmin");
  EXPECT_EQ(changed(edge, of_edges.card), (json{{"inacti", 6},
                                                {"viss", 0.05},
                                                {"ithe", 1},
                                                {"ithe_form", 1},
                                                {"kthe", 1.0},
                                                {"frad", 1e-8},
                                                {"drad", 0.75}}));
  EXPECT_EQ(accuracy::everything(rich_card()).says, "ITIED = 1, dtmin = 1e-300");
}

TEST(TakeEffect, TakesOneOrAGroupAndSaysWhetherItWasThere) {
  const auto taken = [](const std::string& name, ContactCard card) {
    const ContactCard before = card;
    const bool found = take_effect(name, card);
    const json out = changed(before, card);
    EXPECT_EQ(found, !out.empty()) << name;
    return out;
  };
  EXPECT_EQ(taken("curvature", rich_card()), (json{{"icurv", 0}}));
  EXPECT_EQ(taken("curvature", plain_card()), json::object());
  EXPECT_EQ(taken("no such effect", rich_card()), json::object());
  const json no_friction = {{"fric", 0.0}, {"ifric", 0}, {"fct_idf", nullptr}};
  EXPECT_EQ(taken("friction", rich_card()), no_friction);
  ContactCard spring = rich_card();
  spring.iform = 2;
  EXPECT_EQ(taken("friction", spring), no_friction);
  EXPECT_EQ(taken("heat", rich_card()), (json{{"kthe", 0.0},
                                              {"fct_idk", nullptr},
                                              {"frad", 0.0},
                                              {"drad", 0.0},
                                              {"fheats", 0.0},
                                              {"fheatm", 0.0},
                                              {"ithe", 0}}));
  ContactCard warm = plain_card();
  warm.ithe = 1;
  warm.kthe = 2;
  EXPECT_EQ(taken("heat", warm), (json{{"kthe", 0.0}, {"ithe", 0}}));
  // A loop that is timed gets a coefficient instead of /FRICTION; an evaluation keeps its own.
  ContactCard parts = plain_card();
  parts.fric_id = true;
  EXPECT_EQ(taken("part-pair-friction", parts), (json{{"fric_id", false}}));
}

TEST(TakeEffect, NamesTheGroupsAndThenEveryEffectOfTheLoop) {
  EXPECT_EQ(effects_to_take(), (std::vector<std::string>{"friction",
                                                         "heat",
                                                         "gap-reduction",
                                                         "fixed-stiffness",
                                                         "normal-damping",
                                                         "friction-viscous",
                                                         "friction-incremental",
                                                         "friction-law",
                                                         "friction-temperature",
                                                         "friction-filter",
                                                         "orthotropic-friction",
                                                         "part-pair-friction",
                                                         "heat-conduction",
                                                         "radiation",
                                                         "friction-heat",
                                                         "curvature",
                                                         "adaptivity-criteria",
                                                         "time-step-deletion",
                                                         "tie-on-time-step",
                                                         "boundary-release"}));
}

TEST(ActedNodes, ForcesAddUpToNothingAndStepsAreThoseOfTheNodes) {
  const Measured m = measure(scene_of(""));
  const auto nodes = cycle::acted_nodes(m.state, m.outcome);
  ASSERT_EQ(nodes.size(), 8u);
  double sum = 0, most = 0, smallest = 1e30;
  for (const cycle::ActedNode& n : nodes) {
    sum += n.force[2];
    most = std::max(most, std::abs(n.force[2]));
    smallest = std::min(smallest, n.dt);
    EXPECT_DOUBLE_EQ(n.dt, 0.9 * std::sqrt(2.0 * m.state.mass[n.node] / n.stiffness));
  }
  EXPECT_GT(most, 1.0);
  EXPECT_NEAR(sum, 0.0, 1e-9 * most);
  EXPECT_LE(m.outcome.contact_dt, smallest);
}

}  // namespace
}  // namespace deck
