// The solver's rules that are not what its manual says, one test per line of
// tools/docs/differences.md: both models follow each of them, with the same coefficient.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/small_deck.hpp"
#include "cycle/shared/heat.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using namespace testing;

constexpr Model models[] = {Model::reference, Model::robust};

/// A node in the middle of a triangle, 0.4 above it within a gap of 1: both models see the same.
Pair inside() { return triangle_pair({2, 3, 0.4}); }

/// Edges that cross at a distance within a gap of 1.
Pair crossing(double distance) {
  Pair p;
  p.x = {Vec{-5, 0, distance}, Vec{5, 0, distance}, Vec{0, -5, 0}, Vec{0, 5, 0}, Vec{}};
  p.k0 = 1e5;
  p.edge_width = {0.5, 0.8};
  return p;
}

ContactCard edge_card() {
  ContactCard card = elastic_card();
  card.kind = ContactKind::edge_edge;
  return card;
}

double normal(const Outcome& r) { return -r.all.normal_force[0]; }

TEST(SolverRules, HalfOfTheStiffnessActs) {
  for (const Model m : models)
    EXPECT_NEAR(normal(testing::run(elastic_card(), inside(), 0, 0, m)), 0.5e5 * 0.6 / 0.4, 1e-8);
}

TEST(SolverRules, StminAndStmaxBoundTheStiffnessBeforeItIsHalved) {
  ContactCard card = elastic_card();
  card.istf = 4;
  card.stmax = 50;
  for (const Model m : models) {
    Pair p = inside();
    p.k0 = pair_stiffness(card, 500, 400, m);
    EXPECT_NEAR(normal(testing::run(card, p, 0, 0, m)), 25 * 0.6 / 0.4, 1e-12);
  }
}

TEST(SolverRules, IstfOneTakesAllOfStfacForNodesAndAQuarterForEdges) {
  ContactCard card = elastic_card();
  card.istf = 1;
  card.stfac = 8e4;
  for (const Model m : models)
    EXPECT_NEAR(normal(testing::run(card, inside(), 0, 0, m)), 8e4 * 0.6 / 0.4, 1e-8);
  card.kind = ContactKind::edge_edge;
  for (const Model m : models) {
    Pair p = crossing(0.9);
    p.k0 = pair_stiffness(card, 1e5, 1e5, m);
    EXPECT_NEAR(normal(testing::run(card, p, 0, 0, m)), 2e4 * 0.9 * 0.1 / 0.8, 1e-9);
  }
}

TEST(SolverRules, EdgesWorkWithNineTenthsOfTheGapAndAreRemovedAtATenthOfIt) {
  for (const Model m : models) {
    EXPECT_NEAR(normal(testing::run(edge_card(), crossing(0.5), 0, 0, m)), 5e4 * 0.9 * 0.5 / 0.4,
                1e-8);
    const Outcome closed = testing::run(edge_card(), crossing(0.099), 0, 0, m);
    EXPECT_EQ(normal(closed), 0.0);
    EXPECT_NE(closed.all.status[0] & status_gap_closed, 0);
  }
}

TEST(SolverRules, TheDashpotKnowsTheMassOfTheNodeAloneAndMayPull) {
  ContactCard card;
  Pair p = triangle_pair({2, 3, 0.999});
  p.m = {2e-3, 1e-9, 1e-9, 1e-9, 1e-9};
  p.v[0] = {0, 0, 100};
  const double kappa = 5e4, phi = 1 / 0.999;
  const double c = 0.05 * std::sqrt(2 * kappa * phi * 2e-3);
  for (const Model m : models) {
    const double pull = -normal(testing::run(card, p, 1e-6, 1e-6, m));
    EXPECT_GT(pull, 0.0);
    EXPECT_NEAR(pull, c * 100 - kappa * phi * 1e-3, 1e-7);
  }
}

TEST(SolverRules, FrictionIsLimitedByTheSizeOfTheForceAlsoWhenItPulls) {
  ContactCard card;
  card.fric = 0.3;
  Pair p = triangle_pair({2, 3, 0.999});
  p.m[0] = 2e-3;
  p.v[0] = {1e5, 0, 1e3};
  for (const Model m : models) {
    const Outcome r = testing::run(card, p, 1e-6, 1e-6, m);
    EXPECT_GT(r.all.normal_force[0], 0.0);
    EXPECT_NEAR(std::abs(r.force()[0]), 0.3 * r.all.normal_force[0], 1e-9);
  }
}

TEST(SolverRules, TheSpringOfIformTwoIsTwiceTheStiffnessOfTheNormalForce) {
  ContactCard card = elastic_card();
  card.fric = 0.5;
  card.iform = 2;
  Pair p = triangle_pair({2, 3, 1 - 1e-6});
  p.v[0] = {1e-6, 0, 0};
  for (const Model m : models)
    EXPECT_NEAR(testing::run(card, p, 1e-6, 1e-6, m).memory()[0], 1e5 * 1e-12, 1e-20);
}

TEST(SolverRules, TheSpringOfIformTwoBetweenEdgesIsTheStabilisedStiffness) {
  ContactCard card = edge_card();
  card.fric = 0.5;
  card.iform = 2;
  Pair p = crossing(0.5);
  p.v[0] = p.v[1] = {1e-3, 0, 0};
  for (const Model m : models) {
    const Outcome r = testing::run(card, p, 1e-6, 1e-6, m);
    EXPECT_NEAR(r.memory()[0], 0.5 * r.all.k_nodal[0] * 1e-3 * 1e-6, 1e-15);
  }
}

TEST(SolverRules, TheOldFrictionForceIsProjectedNotTurned) {
  ContactCard card = elastic_card();
  card.fric = 0.5;
  card.iform = 2;
  Pair p = inside();
  const double a = std::numbers::pi / 6;
  p.ft = {std::cos(a), 0, std::sin(a)};  // of a plane turned by 30 degrees
  for (const Model m : models)
    EXPECT_NEAR(testing::norm(testing::run(card, p, 1e-6, 1e-6, m).memory()), std::cos(a), 1e-12);
}

/// The share of a new force that a filter lets through, at a step of 1e-6.
double filter_share(int ifiltr, double xfreq, Model m) {
  ContactCard card;
  card.fric = 0.2;
  card.ifiltr = ifiltr;
  card.xfreq = xfreq;
  Pair p = inside();
  p.v[0] = {1e5, 0, 0};
  ContactCard plain = card;
  plain.ifiltr = 0;
  return testing::run(card, p, 1e-6, 1e-6, m).memory()[0] /
         testing::run(plain, p, 1e-6, 1e-6, m).force()[0];
}

TEST(SolverRules, IfiltrTwoTakesTwoPiOverXfreq) {
  for (const Model m : models)
    EXPECT_NEAR(filter_share(2, 20, m), 2 * std::numbers::pi / 20, 1e-12);
}

TEST(SolverRules, IfiltrThreeDoesNothing) {
  for (const Model m : models) EXPECT_NEAR(filter_share(3, 1000, m), 1.0, 1e-12);
}

TEST(SolverRules, TheFilterComesAfterTheLimitOfFriction) {
  ContactCard card;
  card.fric = 0.2;
  card.ifiltr = 1;
  card.xfreq = 0.25;
  Pair p = inside();
  p.v[0] = {1e5, 0, 0};
  p.ft = {1e9, 0, 0};
  for (const Model m : models) {
    const Outcome r = testing::run(card, p, 1e-6, 1e-6, m);
    const double cap = 0.2 * normal(r);
    EXPECT_NEAR(r.memory()[0], 0.25 * cap + 0.75e9, 1e-3) << "beyond the limit";
  }
}

TEST(SolverRules, WithIformTwoTheFilterScalesTheSpring) {
  ContactCard card = elastic_card();
  card.fric = 0.5;
  card.iform = 2;
  card.ifiltr = 1;
  card.xfreq = 0.3;
  Pair p = inside();
  p.v[0] = {20, 0, 0};
  p.ft = {10, 0, 0};
  for (const Model m : models)
    EXPECT_NEAR(testing::run(card, p, 1e-6, 1e-6, m).memory()[0], 10 + 0.3 * 1e5 * 20e-6, 1e-12);
}

TEST(SolverRules, AscaleFIsInertAndTheWeightsAreThePairsOwn) {
  ContactCard card = elastic_card();
  card.fric = 0.2;
  card.iform = 2;
  card.ithe = card.ithe_form = 1;
  card.fct_idf = Curve{{0, 1000}, {1.0, 3.0}};
  card.ascalef = 0.5;
  Pair p = inside();
  p.v[0] = {1e9, 0, 0};
  p.temperature = {400, 600, 600, 600, 600};  // mean 500: 2
  for (const Model m : models) {
    const Outcome r = testing::run(card, p, 1e-6, 1e-6, m);
    EXPECT_NEAR(r.force()[0], 0.4 * normal(r), 1e-9);
  }
}

TEST(SolverRules, TheFrictionFunctionIsDeadWithoutHeatExchangeOrBesideATable) {
  ContactCard card;
  card.fric = 0.2;
  card.fct_idf = Curve{{0, 1000}, {1.0, 3.0}};
  const auto on = [&] {
    for (const EffectState& e : effect_plan(card))
      if (e.name == "friction-temperature") return e.on;
    return true;
  };
  EXPECT_FALSE(on());
  card.ithe = 1;
  EXPECT_TRUE(on());
  card.fric_id = true;
  EXPECT_FALSE(on());
}

TEST(SolverRules, ViscousOrthotropicFrictionPushesASlidingPairAlong) {
  ContactCard card = elastic_card();
  card.fric_id = card.fric_orthotropic = true;
  Pair p = inside();
  p.fric = 0.3;
  p.v[0] = {1e6, 0, 0};
  for (const Model m : models) {
    card.iform = 1;
    const double viscous = testing::run(card, p, 1e-3, 1e-3, m).force()[0];
    card.iform = 2;
    const double spring = testing::run(card, p, 1e-3, 1e-3, m).force()[0];
    EXPECT_LT(viscous * spring, 0.0);
    EXPECT_NEAR(viscous, -spring, 1e-6 * std::abs(spring));
  }
}

TEST(SolverRules, OrthotropicFrictionReturnsAlongTheGradientAndThenRadially) {
  ContactCard card = elastic_card();
  card.fric_id = card.fric_orthotropic = true;
  card.iform = 2;
  Pair p = triangle_pair({2, 3, 1 / 1.02});
  p.x[2] = {10, 0, 0};
  p.v[0] = {0.8, 0.3, 0};
  Outcome r[2];
  for (const Model m : models) {
    r[m == Model::robust] = testing::run(card, p, 1e-2, 1e-2, m);
    const Vec f = r[m == Model::robust].force();
    const double fn = normal(r[m == Model::robust]);
    EXPECT_NEAR(std::hypot(f[0] / (0.3 * fn), f[1] / (0.1 * fn)), 1.0, 1e-9);
    EXPECT_GT(f[0] / f[1], 1.05 * 0.8 / 0.3) << "not scaled down radially";
  }
  EXPECT_NEAR(r[0].force()[0], r[1].force()[0], 1e-9 * std::abs(r[0].force()[0]));
}

TEST(SolverRules, EdgesOfATwoSurfaceContactKnowFricOnlyAndReleaseNothing) {
  ContactCard card = edge_card();
  card.fric = 0.2;
  card.ifric = 1;
  card.c = {5, 5, 5, 5, 5, 5};
  card.ibc = 7;
  Pair p = crossing(0.5);
  p.v[0] = p.v[1] = {1e6, 0, 0};
  for (const Model m : models) {
    const Outcome r = testing::run(card, p, 1e-6, 1e-6, m);
    EXPECT_LE(std::abs(r.force()[0]), 0.2 * normal(r) * (1 + 1e-12));
    EXPECT_EQ(r.all.status[0] & status_bc_release, 0);
  }
  for (const EffectState& e : effect_plan(card))
    EXPECT_FALSE(e.on && (e.name == "boundary-release" || e.name == "friction-law")) << e.name;
}

TEST(SolverRules, ASensorAndTheTimesHoldTogether) {
  ContactCard card;
  card.tstart = 1.0;
  card.sensor_time = 0.5;
  EXPECT_FALSE(is_active(card, 0.6));
  EXPECT_TRUE(is_active(card, 1.0));
  card.sensor_time = 1.5;
  EXPECT_FALSE(is_active(card, 1.2));
}

TEST(SolverRules, ABlankDradIsNoRadiation) {
  deck::test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(9, 5, 5, 1.5);
  d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4);
  d.group("/GRNOD/NODE/2", {9}).group("/SURF/PART/1", {1});
  d.add(
      "/HEAT/MAT/1\n               300.0                 1.0                 2.0                 "
      "0.0");
  d.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1 Ithe=1 Kthe=1 Frad=1e-8 Tint=500");
  d.add("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=1 Gapmin=1 Ithe=1 Kthe=1 Frad=1e-8 Tint=500 Drad=3");
  const deck::test::Built b(d);
  EXPECT_GT(b.scene.contacts.at(0).drad, 0.0) << "start-up prints one";
  EXPECT_EQ(make_card(b.scene, b.scene.contacts.at(0)).drad, 0.0);
  EXPECT_EQ(make_card(b.scene, b.scene.contacts.at(1)).drad, 3.0);
}

TEST(SolverRules, BeyondTheGapButWithinDradAPairDampsAndRubs) {
  ContactCard card;
  card.fric = 0.2;
  card.ithe = 1;
  card.drad = 3.0;
  Pair p = triangle_pair({2, 3, 2.0});  // gap 1
  p.m[0] = 2e-3;
  p.v[0] = {10, 0, -10};
  Outcome r[2];
  for (const Model m : models) {
    r[m == Model::robust] = testing::run(card, p, 1e-6, 1e-6, m);
    EXPECT_GT(normal(r[m == Model::robust]), 0.0);
    EXPECT_NE(r[m == Model::robust].force()[0], 0.0);
  }
  EXPECT_NEAR(normal(r[0]), normal(r[1]), 1e-12 * normal(r[0]));
}

TEST(SolverRules, TheGapIsAResistanceOnOneSideOfTheSegmentOnly) {
  ContactCard card;
  card.ithe = 1;
  card.kthe = 500;
  card.tint = 700;
  HeatState s;
  s.position = {Vec{2, 3, -6e-4}, Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{0, 10, 0}, Vec{0, 10, 0}};
  s.temperature = {350, 600, 620, 650, 650};
  s.weight = {0.5, 0.2, 0.3, 0.0};
  s.area = 2e-4;
  s.dt1 = 1e-6;
  s.conductivity = 45;
  HeatState turned = s;
  turned.position = {Vec{2, 3, -6e-4}, Vec{0, 10, 0}, Vec{10, 0, 0}, Vec{0, 0, 0}, Vec{0, 0, 0}};
  turned.weight = {0.3, 0.2, 0.5, 0.0};
  EXPECT_NEAR(pair_heat(card, turned).q[0] / pair_heat(card, s).q[0], 1 + 500 * 6e-4 / 45, 1e-9);
}

TEST(SolverRules, WithTintAndAPressureFunctionFrictionHeatIsLost) {
  ContactCard card;
  card.ithe = 1;
  card.fct_idk = Curve{{0, 1}, {1, 1}};
  card.fheats = 0.5;
  HeatState s;
  s.position = {Vec{2, 3, 0.4}, Vec{0, 0, 0}, Vec{10, 0, 0}, Vec{0, 10, 0}, Vec{0, 10, 0}};
  s.area = 1;
  s.dt1 = 1;
  s.friction_heat = 8;
  EXPECT_EQ(pair_heat(card, s).q[0], 0.0);
  card.fct_idk.reset();
  EXPECT_EQ(pair_heat(card, s).q[0], 4.0);
}

TEST(SolverRules, RadiationBetweenEdgesCountsDradFromTheGapOn) {
  ContactCard card = edge_card();
  card.ithe = card.ithe_form = 1;
  card.frad = 4e-8;
  card.drad = 3.0;
  for (const Model m : models) {
    Pair p = crossing(3.5);
    p.temperature = {400, 400, 900, 900, 0};
    EXPECT_GT(testing::run(card, p, 0.5, 0.5, m).all.heat[0][0], 0.0);
  }
}

TEST(SolverRules, ATieByTimeStepTakesHalfOfTheStiffnessAlsoWithIstfOne) {
  ContactCard card;
  card.itied = 2;
  card.istf = 1;
  card.stfac = 1e5;
  card.viss = 0.0;
  Pair p = triangle_pair({2, 3, 0.4});
  p.tie = {-100, 0, 0, 0.5, 0.2, 0.3, 0.0, 0.4};
  p.v[0] = {0, 0, -1};
  for (const Model m : models)
    EXPECT_NEAR(testing::run(card, p, 1e-6, 1e-6, m).all.tie[0][0], -100 - 0.5e5 * 1e-6, 1e-9);
}

TEST(SolverRules, InactiFiveGivesTheGapBackByTheCycleNotByTime) {
  ContactCard card = elastic_card();
  card.inacti = 5;
  Pair p = triangle_pair({2, 3, 0.7});
  p.p0 = 0.4;
  for (const Model m : models)
    for (const double dt : {1e-9, 1.0})
      EXPECT_NEAR(testing::run(card, p, dt, dt, m).all.p0[0], 0.95 * 0.4 + 0.05 * 0.3, 1e-15);
}

TEST(SolverRules, MomentsAreTakenOnTheFarSideOfTheNode) {
  for (const Model m : models) {
    PacketResult r;
    ContactCard rubbing = elastic_card();
    rubbing.fric = 0.5;
    rubbing.iform = 2;
    Pair p = inside();
    p.ft = {7, 0, 0};
    const testing::Packet sliding({p});
    const KernelPlan with = make_plan(rubbing, m);
    evaluate(with, sliding.view(1e-6, 1e-6), r);
    // (2, 3, 0.4 + 0.6) x (7, 0, Fn): the y part is 1.0 * 7 - 2 Fn.
    const double fn = r.normal_force[0];
    EXPECT_NEAR(totals(with, sliding.view(1e-6, 1e-6), r).moment[1], 7.0 - 2 * fn, 1e-8);
  }
}

// Where arithmetic cannot make a difference, nothing may differ: nodes over triangles and crossing
// edges, with every combination of effects.

ContactCard random_card(std::mt19937_64& rng, bool edges) {
  const auto one_of = [&](int n) { return static_cast<int>(rng() % static_cast<unsigned>(n)); };
  ContactCard card;
  card.kind = edges ? ContactKind::edge_edge : ContactKind::node_segment;
  card.istf = one_of(2);
  card.stfac = 7e4;
  card.viss = one_of(2) * 0.05;
  card.visf = one_of(2) * 0.7;
  card.fric = one_of(3) * 0.2;
  card.iform = 1 + one_of(2);
  card.inacti = one_of(2) * 5;
  card.ithe = one_of(2);
  card.ithe_form = one_of(2);
  card.kthe = 400.0;
  card.tint = 350.0;
  card.frad = 1e-8;
  card.drad = one_of(2) * 2.5;
  if (one_of(2) == 1) card.fct_idk = Curve{{0, 1e6}, {1.0, 2.0}};
  if (edges) return card;
  card.ifric = one_of(5);
  card.c = {1e-4, 1e-4, 1e-6, 1e-6, 20.0, 60.0};
  if (card.ifric == 1) card.c[4] = 1e-6;
  if (card.ifric == 2) card.c = {1e-8, -1e-6, 1e-5, -1e-6, 0.05, -1e-5};
  card.ifiltr = one_of(4);
  card.xfreq = card.ifiltr == 1 ? 0.3 : 40.0;
  if (one_of(2) == 1) card.fct_idf = Curve{{0, 1000}, {1.0, 2.0}};
  card.ascalef = 3.0;
  card.fheats = 0.3;
  card.fheatm = 0.2;
  card.fric_id = one_of(3) == 0;
  card.fric_orthotropic = card.fric_id && one_of(2) == 0;
  card.ibc = one_of(8);
  card.dtmin = one_of(3) == 0 ? 1e-4 : 0.0;
  card.itied = card.dtmin > 0.0 ? one_of(3) : 0;
  return card;
}

void expect_close(const std::vector<double>& a, const std::vector<double>& b, double size,
                  const std::string& what) {
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], 1e-8 * (std::abs(a[i]) + size)) << what << " of pair " << i;
}

TEST(SolverRules, EveryEffectIsTheSameInBothModelsWhereArithmeticIs) {
  std::mt19937_64 rng(5);
  for (int round = 0; round < 400; ++round) {
    const bool edges = round % 4 == 3;
    const ContactCard card = random_card(rng, edges);
    std::vector<Pair> pairs = testing::random_pairs(24, 1000 + static_cast<unsigned>(round), edges);
    std::erase_if(pairs, [&](Pair& p) {
      const bool triangle = !edges;
      if (triangle) {
        p.triangle = true;
        p.x[4] = p.x[3];
      }
      const double d = testing::run(elastic_card(), p).all.distance[0];
      return d < 0.15 * p.gap || std::abs(d - p.gap) < 1e-3;  // conditioning, not rules
    });
    const testing::Packet packet(pairs);
    PacketResult r[2];
    for (const Model m : models)
      evaluate(make_plan(card, m), packet.view(1e-5, 1.1e-5), r[m == Model::robust]);
    SCOPED_TRACE(round);
    const auto same = [&](auto member, double size, const char* what) {
      expect_close(r[0].*member, r[1].*member, size, what);
    };
    same(&PacketResult::normal_force, 1e-3, "normal force");
    same(&PacketResult::k_nodal, 1e-3, "nodal stiffness");
    same(&PacketResult::penetration, 1e-6, "penetration");
    same(&PacketResult::effective_gap, 1e-9, "gap");
    same(&PacketResult::elastic_energy, 1e-3, "elastic energy");
    same(&PacketResult::friction_energy, 1e-6, "friction energy");
    same(&PacketResult::friction_heat, 1e-6, "friction heat");
    same(&PacketResult::conductance, 1e-6, "conductance");
    same(&PacketResult::dt_kinematic, 1e-9, "kinematic step");
    for (std::size_t c = 0; c < 3; ++c) {
      expect_close(r[0].force[c], r[1].force[c], 1e-2, "force");
      expect_close(r[0].ft[c], r[1].ft[c], 1e-2, "friction memory");
    }
    for (std::size_t k = 0; k < 8; ++k) expect_close(r[0].tie[k], r[1].tie[k], 1e-2, "tie");
    for (std::size_t k = 0; k < 5; ++k) expect_close(r[0].heat[k], r[1].heat[k], 1e-6, "heat");
    for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(r[0].status[i], r[1].status[i]) << i;
    if (HasFailure()) break;
  }
}

}  // namespace
}  // namespace deck::cycle
