// One force evaluation of whole decks of a few elements: forces, sums, steps, what is left out.
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/plates.hpp"
#include "deck/cycle.hpp"
#include "deck/rule_id.hpp"
#include "lint/shared/geometry.hpp"
#include "lint/support.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;
using testing::plates;
using testing::plates_in_contact;

std::unique_ptr<Built> scene_of(const std::string& fields, double distance) {
  return plates_in_contact("@/INTER/TYPE7/1 " + fields, distance);
}

SceneOutcome run(const Built& b, CycleOptions options = {},
                 const std::vector<PartVelocity>& velocities = {}) {
  return run_cycle(b.scene, make_state(b.scene, velocities), options);
}

CycleOptions keeping_pairs(Model model = Model::robust) {
  CycleOptions o;
  o.model = model;
  o.keep_pairs = true;
  return o;
}

TEST(FirstCycle, ForceFollowsTheElasticLaw) {
  // kappa = 200 / 2, gap 1, penetration 0.4: F = kappa g/(g-p) p.
  const auto b = scene_of("", 0.6);
  const SceneOutcome r = run(*b, keeping_pairs());
  ASSERT_EQ(r.contacts.size(), 1u);
  ASSERT_EQ(r.contacts[0].pairs.size(), 4u);
  EXPECT_EQ(r.contacts[0].pairs_with_force, 4u);
  for (const PairOutcome& p : r.contacts[0].pairs) {
    EXPECT_NEAR(p.force[2], -100.0 * 0.4 / 0.6, 1e-10);
    EXPECT_NEAR(p.penetration, 0.4, 1e-14);
    EXPECT_DOUBLE_EQ(p.k0, 200.0);
  }
  EXPECT_NEAR(r.contacts[0].totals.elastic_energy, 4 * 100.0 * (0.6 - 1 - std::log(0.6)), 1e-10);
}

TEST(FirstCycle, ANegativeStfacIsAConstantStiffnessWhateverIstfSays) {
  for (const char* istf : {"0", "4"}) {
    const auto b = scene_of(std::string("Stfac=-3 Istf=") + istf, 0.6);
    const SceneOutcome r = run(*b, keeping_pairs());
    ASSERT_EQ(r.contacts.size(), 1u);
    for (const PairOutcome& p : r.contacts[0].pairs)
      EXPECT_NEAR(p.force[2], -3 * 0.4 / 0.6, 1e-10) << istf;
  }
}

TEST(FirstCycle, ContactStepFollowsFromTangentStiffnessAndMass) {
  const auto b = scene_of("", 0.6);
  const SceneOutcome r = run(*b);
  // k_tan = kappa (g/d)^2; nodes of the small shell (side sqrt(32)) weigh rho t A / 4.
  const double k = 100.0 / (0.6 * 0.6), m = 1e-6 * 32 / 4;
  EXPECT_NEAR(r.contact_dt, 0.9 * std::sqrt(2 * m / k), 1e-12);
  EXPECT_EQ(r.contact_dt_source, StepLimit::Source::nodal);
  EXPECT_EQ(r.limiting_contact, 0u);
  EXPECT_EQ(b->model.node_id(r.limiting_node), 11);
  EXPECT_NEAR(r.contacts[0].largest_acceleration, 100.0 * 0.4 / 0.6 / m, 1e-3);
}

TEST(FirstCycle, AnInterfaceThatStartsLaterDoesNothingYet) {
  const auto b = scene_of("Tstart=0.5", 0.6);
  EXPECT_FALSE(run(*b).contacts[0].active);
  EXPECT_EQ(run(*b).largest_nodal_force, 0.0);
  CycleOptions later;
  later.time = 1.0;
  EXPECT_GT(run(*b, later).largest_nodal_force, 0.0);
}

TEST(FirstCycle, ReducedGapsAndDistantNodesPushNobody) {
  for (const auto& [fields, height, in_reach] :
       {std::tuple("Inacti=5", 0.6, 4u), {"Inacti=6", 0.6, 4u}, {"", 3.0, 0u}}) {
    const SceneOutcome r = run(*scene_of(fields, height), keeping_pairs(Model::reference));
    EXPECT_EQ(r.contacts[0].pairs_with_force, 0u) << fields;
    EXPECT_EQ(r.contacts[0].pairs_in_reach, in_reach) << fields;
    EXPECT_EQ(r.largest_nodal_force, 0.0);
  }
}

TEST(FirstCycle, ApproachAddsDampingAndLimitsTheStep) {
  const auto b = scene_of("", 0.6);
  const SceneOutcome still = run(*b);
  const SceneOutcome r = run(*b, {}, {{2, {0, 0, -500}}});
  EXPECT_GT(r.contacts[0].largest_force, still.contacts[0].largest_force);
  // Half the time to the mid-surface.
  EXPECT_NEAR(r.contacts[0].totals.dt_kinematic, 0.5 * 0.6 / 500, 1e-12);
}

TEST(FirstCycle, NodesWithoutVelocitiesAreNodesAtRest) {
  const auto b = scene_of("Fric=0.3 VISs=0.1 Ithe=1 Kthe=1 Tint=3", 0.6);
  State none = make_state(b->scene), rest = none;
  for (auto& v : rest.velocity) v.assign(b->model.nodes.size(), 0.0);
  rest.temperature.assign(b->model.nodes.size(), 0.0);
  const SceneOutcome r = run_cycle(b->scene, none, keeping_pairs());
  const SceneOutcome s = run_cycle(b->scene, rest, keeping_pairs());
  EXPECT_EQ(r.contacts[0].pairs_with_force, 4u);
  EXPECT_EQ(r.nodes.force, s.nodes.force);
  EXPECT_EQ(r.nodes.heat, s.nodes.heat);
  EXPECT_EQ(r.contact_dt, s.contact_dt);
}

TEST(FirstCycle, AnIcurvThatNoSurfaceHasIsNoCurvature) {
  const auto forces = [](const std::string& icurv) {
    return run(*scene_of("Icurv=" + icurv, 0.6)).nodes.force;
  };
  for (const char* icurv : {"4", "7", "-1", "2147483647"})
    EXPECT_EQ(forces(icurv), forces("0")) << icurv;
}

TEST(FirstCycle, WhatCannotBeEvaluatedHasNoForces) {
  struct Case {
    const char* gap;
    bool penetrations;
    std::uint64_t bytes;
  };
  const std::uint64_t enough = SceneOptions().limits.pair_bytes;
  for (const Case& c : {Case{"1e200", true, enough},   // beyond the range of the formulas
                        Case{"1", true, 64},           // start-up has no room for its pairs
                        Case{"1", false, 3 * 512}}) {  // room for three pairs of the four
    SceneOptions o;
    o.penetrations = c.penetrations;
    o.limits.pair_bytes = c.bytes;
    const Built b(
        plates(0.6).add(std::string("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=") + c.gap), o);
    EXPECT_EQ(b.findings.counts().contains(RuleId::DK390), c.bytes == 64);
    const SceneOutcome r = run(b);
    EXPECT_FALSE(r.contacts[0].complete) << c.gap << ' ' << c.bytes;
    EXPECT_EQ(r.largest_nodal_force, 0.0);
  }
}

TEST(FirstCycle, TheContactsOfAType19AllowOneStep) {
  SmallDeck d = plates(0.6);
  d.group("/SURF/PART/3", {2});
  d.add("@/INTER/TYPE19/1 surf_IDs=3 surf_IDm=2 Gapmin=1");
  const Built b(d, testing::with_stiffness());
  const SceneOutcome r = run(b);
  const auto all = summarize(b.scene, r);
  ASSERT_EQ(all.size(), 1u);
  // Nodes that are secondary in one of them and main in another are stiffened by both.
  EXPECT_EQ(all[0].contact_dt, r.contact_dt);
}

/// The upper plate has 400 degrees, the lower one 300.
TEST(FirstCycle, HeatGoesFromTheHotSideToTheCold) {
  for (const bool node_missing : {false, true}) {
    SmallDeck d = plates(0.6);
    if (node_missing) d.shell(2, 3, 11, 12, 13, 999).shell3(2, 4, 11, 12, 998);
    d.add("/HEAT/MAT/1\n               300.0                 1.0").group("/GRNOD/PART/3", {2});
    d.add("/INITEMP/1\nt\n               400.0         3");
    d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Ithe=1 Kthe=0.5 Ithe_form=1");
    const CycleOptions options = testing::with_step(1e-3);
    const SceneOutcome r = run(Built(d), options);
    // Four nodes with a quarter of 32 each, 0.5 per area and degree, 100 degrees.
    EXPECT_NEAR(r.contacts[0].heat_secondary, -0.5 * 32 * 100 * 1e-3, 1e-12) << node_missing;
    EXPECT_NEAR(r.contacts[0].heat_main, 0.5 * 32 * 100 * 1e-3, 1e-12);
  }
}

// The rules about the first force; lint_rules.cases has more.
TEST(CycleRules, FireOnTheirBadExampleIfAskedForAndNotOnTheGoodOne) {
  std::size_t rules = 0;
  for (const Rule& r : all_rules()) {
    if (id_number(r.id) / 100 != 4) continue;
    ++rules;
    EXPECT_TRUE(test::lint_geometry(r.bad).fires(r.id)) << id_text(r.id);
    EXPECT_FALSE(test::lint_example(r.bad).fires(r.id)) << id_text(r.id);
    const test::Linted good = test::lint_geometry(r.good);
    EXPECT_FALSE(good.fires(r.id)) << good.list();
    for (const Finding& d : good.result.findings)
      EXPECT_NE(d.severity, Severity::error) << id_text(d.rule) << " " << d.message;
  }
  EXPECT_GE(rules, 3u);
}

}  // namespace
}  // namespace deck::cycle
