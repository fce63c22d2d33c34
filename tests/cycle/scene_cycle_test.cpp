// One force evaluation of whole decks of a few elements: forces, sums, steps, what is left out.
#include "deck/cycle/scene_cycle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cycle/plates.hpp"
#include "deck/text/rule_id.hpp"
#include "report/shared/cycle.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;
using testing::plates;
using testing::plates_in_contact;

std::unique_ptr<Built> scene_of(const std::string& fields, double distance) {
  return plates_in_contact("@/INTER/TYPE7/1 " + fields, distance);
}

/// The upper plate of 400 degrees above the lower one of 300.
void exchange_heat(SmallDeck& d) {
  d.elastic_material(2, 200.0);
  d.add("/HEAT/MAT/1\n               300.0                 1.0");
  d.group("/GRNOD/PART/3", {2});
  d.add("/INITEMP/1\nt\n               400.0         3");
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Ithe=1 Kthe=0.5 Ithe_form=1");
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

TEST(FirstCycle, ForcesAtTheNodesAddUpToNothing) {
  const auto b = scene_of("", 0.6);
  const SceneOutcome r = run(*b, keeping_pairs(Model::reference));
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (const double f : r.nodes.force[c]) sum += f;
    EXPECT_NEAR(sum, 0.0, 1e-11);
  }
  EXPECT_GT(r.largest_nodal_force, 0.0);
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

TEST(FirstCycle, NothingInReachGivesNoForceAndNoLimit) {
  const auto b = scene_of("", 3.0);
  const SceneOutcome r = run(*b);
  EXPECT_EQ(r.contacts[0].pairs_in_reach, 0u);
  EXPECT_EQ(r.largest_nodal_force, 0.0);
  EXPECT_EQ(r.contact_dt, 1e30);
}

TEST(FirstCycle, AnInterfaceThatStartsLaterDoesNothingYet) {
  const auto b = scene_of("Tstart=0.5", 0.6);
  EXPECT_FALSE(run(*b).contacts[0].active);
  EXPECT_EQ(run(*b).largest_nodal_force, 0.0);
  CycleOptions later;
  later.time = 1.0;
  EXPECT_TRUE(run(*b, later).contacts[0].active);
  EXPECT_GT(run(*b, later).largest_nodal_force, 0.0);
}

TEST(FirstCycle, ReducedGapsPushNobody) {
  for (const char* inacti : {"Inacti=5", "Inacti=6"}) {
    const auto b = scene_of(inacti, 0.6);
    const SceneOutcome r = run(*b, keeping_pairs(Model::reference));
    EXPECT_EQ(r.contacts[0].pairs_with_force, 0u) << inacti;
    EXPECT_EQ(r.contacts[0].pairs_in_reach, 4u) << inacti;
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

TEST(FirstCycle, PairsNearTheMidSurfaceAreListed) {
  const auto b = scene_of("", 0.01);
  const SceneOutcome r = run(*b);
  EXPECT_EQ(r.contacts[0].near_singular_count, 4u);
  EXPECT_EQ(r.contacts[0].near_singular.size(), 4u);
  EXPECT_EQ(run(*scene_of("", 0.6)).contacts[0].near_singular_count, 0u);
}

TEST(FirstCycle, DoesNotDependOnThreads) {
  const auto b = scene_of("Fric=0.3", 0.6);
  CycleOptions one = keeping_pairs(), many = keeping_pairs();
  many.threads = 5;
  const std::vector<PartVelocity> v{{2, {10, 0, -20}}};
  const SceneOutcome r = run(*b, one, v), s = run(*b, many, v);
  ASSERT_EQ(r.contacts[0].pairs.size(), s.contacts[0].pairs.size());
  for (std::size_t i = 0; i < r.contacts[0].pairs.size(); ++i)
    EXPECT_EQ(r.contacts[0].pairs[i].force, s.contacts[0].pairs[i].force);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(r.nodes.force[c], s.nodes.force[c]);
  EXPECT_EQ(r.contact_dt, s.contact_dt);
}

TEST(FirstCycle, ValuesOutOfRangeAreNotEvaluated) {
  SmallDeck d = plates(0.6);
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1e200");
  const Built b(d);
  const SceneOutcome r = run(b);
  EXPECT_FALSE(r.contacts[0].complete);
  EXPECT_EQ(r.contacts[0].notes.size(), 1u);
  EXPECT_EQ(r.largest_nodal_force, 0.0);
}

TEST(FirstCycle, AnIcurvThatNoSurfaceHasIsNoCurvature) {
  const auto forces = [](const std::string& icurv) {
    const auto b = scene_of("Icurv=" + icurv, 0.6);
    return run(*b).nodes.force;
  };
  for (const char* icurv : {"4", "7", "-1", "2147483647"})
    EXPECT_EQ(forces(icurv), forces("0")) << icurv;
}

TEST(FirstCycle, AContactThatCouldNotBeEvaluatedHasNoForces) {
  SmallDeck d = plates(0.6);
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1");
  SceneOptions o;
  o.limits.pair_bytes = 64;
  const Built b(d, o);
  EXPECT_FALSE(b.contact().evaluated);
  EXPECT_EQ(b.diagnostics.counts().at(RuleId::DK390), 1u);
  const SceneOutcome r = run(b);
  EXPECT_FALSE(r.contacts[0].complete);
  EXPECT_EQ(r.largest_nodal_force, 0.0);
}

TEST(FirstCycle, PairsBeyondTheMemoryAreNotEvaluated) {
  SmallDeck d = plates(0.6);
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1");
  SceneOptions o;
  o.penetrations = false;
  o.limits.pair_bytes = 3 * 512;  // for three pairs of the four
  const Built b(d, o);
  const SceneOutcome r = run(b);
  EXPECT_FALSE(r.contacts[0].complete);
  EXPECT_EQ(r.contacts[0].notes.size(), 1u);
  EXPECT_EQ(r.largest_nodal_force, 0.0);
}

TEST(FirstCycle, AShellWithAMissingNodeExchangesNoHeat) {
  SmallDeck d = plates(0.6);
  d.shell(2, 3, 11, 12, 13, 999).shell3(2, 4, 11, 12, 998);
  exchange_heat(d);
  SceneOptions o;
  o.nodal_stiffness = true;
  const Built b(d, o);
  CycleOptions options;
  options.dt1 = options.dt12 = 1e-3;
  EXPECT_NEAR(run(b, options).contacts[0].heat_secondary, -0.5 * 32 * 100 * 1e-3, 1e-12);
}

TEST(FirstCycle, HeatGoesFromTheHotSideToTheCold) {
  SmallDeck d = plates(0.6);
  exchange_heat(d);
  SceneOptions o;
  o.nodal_stiffness = true;
  const Built b(d, o);
  CycleOptions options;
  options.dt1 = options.dt12 = 1e-3;
  const SceneOutcome r = run(b, options);
  // Four nodes with a quarter of 32 each, 0.5 per area and degree, 100 degrees.
  EXPECT_NEAR(r.contacts[0].heat_secondary, -0.5 * 32 * 100 * 1e-3, 1e-12);
  EXPECT_NEAR(r.contacts[0].heat_main, 0.5 * 32 * 100 * 1e-3, 1e-12);
}

}  // namespace
}  // namespace deck::cycle
