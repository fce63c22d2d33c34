// Every field of an interface that forces depend on, from the deck to the kernel's card; and what
// the deck says beside interfaces: sensors, materials, skews, dead elements, several contacts.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/small_deck.hpp"
#include "cycle/plates.hpp"
#include "cycle/state/state_parts.hpp"
#include "deck/cycle/adapter.hpp"
#include "deck/cycle/scene_cycle.hpp"
#include "deck/cycle/steps.hpp"

namespace deck::cycle {
namespace {

using test::Built;

/// What fields of adaptive meshing and of heat exchange act with.
const char* const meshing = "/ADMESH/GLOBAL\n         1\n";
const char* const warm = "/HEAT/MAT/1\n               300.0                 1.0\n";
const char* const functions =
    "/FUNCT/31\nf\n                 0.0                 1.0\n                 2.0                 "
    "5.0\n"
    "/FUNCT/32\nf\n                 0.0                 3.0\n                 4.0                 "
    "7.0\n";

std::unique_ptr<Built> with(const std::string& interface, const std::string& more = "") {
  test::SmallDeck d = testing::plates(0.6);
  if (!more.empty()) d.add(more);
  d.add(interface);
  SceneOptions o;
  o.nodal_stiffness = true;
  return std::make_unique<Built>(d, o);
}

TEST(CardOfType7, HasEveryFieldOfTheDeck) {
  const auto b = with(
      "@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1.5 Istf=4 Stmin=3 Stmax=500 Igap=0 "
      "Fpenmax=0.75 Inacti=6 VISs=0.125 Fric=0.375 Ifric=2 C1=1 C2=2 C3=3 C4=4 C5=5 "
      "C6=6 Iform=2 Ifiltr=3 Xfreq=0.5 Icurv=2 node_ID1=2 node_ID2=3 Iadm=2 NRadm=7 Padm=0.875 "
      "Angladm=30 Ithe=1 Ithe_form=1 Kthe=9 fct_IDK=31 AscaleK=1.25 Tint=300 Frad=0.0625 Drad=2.5 "
      "Fheats=0.1 Fheatm=0.2 fct_IDF=32 AscaleF=1.75 Tstart=0.01 Tstop=0.02 dtmin=0.001 ITIED=2 "
      "IBCX=1 IBCY=1 Idel=2",
      std::string(functions) + meshing + warm);
  const ContactCard c = make_card(b->scene, b->contact());
  EXPECT_EQ(c.kind, ContactKind::node_segment);
  EXPECT_EQ(std::tuple(c.istf, c.stmin, c.stmax, c.igap, c.gapmin, c.fpenmax, c.inacti),
            std::tuple(4, 3.0, 500.0, 0, 1.5, 0.75, 6));
  EXPECT_EQ(std::tuple(c.viss, c.visf, c.fric, c.ifric, c.iform, c.ifiltr, c.xfreq),
            std::tuple(0.125, 0.0, 0.375, 2, 2, 3, 0.5));
  EXPECT_EQ(c.c, (std::array<double, 6>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(c.icurv, 2);
  EXPECT_EQ(c.curv_node1, (std::array<double, 3>{10, 0, 0}));
  EXPECT_EQ(c.curv_node2, (std::array<double, 3>{10, 10, 0}));
  EXPECT_EQ(std::tuple(c.iadm, c.nradm, c.padm, c.angladm), std::tuple(2, 7.0, 0.875, 30.0));
  EXPECT_EQ(std::tuple(c.ithe, c.ithe_form, c.kthe, c.ascalek, c.tint, c.frad, c.drad, c.fheats,
                       c.fheatm, c.ascalef),
            std::tuple(1, 1, 9.0, 1.25, 300.0, 0.0625, 2.5, 0.1, 0.2, 1.75));
  ASSERT_TRUE(c.fct_idk && c.fct_idf);
  EXPECT_EQ(c.fct_idk->y, (std::vector<double>{1, 5}));
  EXPECT_EQ(c.fct_idf->x, (std::vector<double>{0, 4}));
  EXPECT_EQ(c.fct_idf->y, (std::vector<double>{3, 7}));
  EXPECT_EQ(std::tuple(c.tstart, c.tstop, c.dtmin, c.itied, c.ibc, c.ibag, c.idel),
            std::tuple(0.01, 0.02, 0.001, 2, 6, 0, 2));
  EXPECT_FALSE(c.sensor_time.has_value());
  EXPECT_FALSE(c.fric_id || c.fric_orthotropic);
}

TEST(CardOfType7, HasTheDefaultsOfWhatIsBlank) {
  const auto b = with("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1");
  const ContactCard c = make_card(b->scene, b->contact());
  EXPECT_EQ(std::tuple(c.iadm, c.nradm, c.padm, c.angladm), std::tuple(0, 3.0, 1.0, 0.0));
  EXPECT_EQ(std::tuple(c.ithe, c.ithe_form, c.kthe, c.ascalek, c.ascalef),
            std::tuple(0, 0, 0.0, 1.0, 1.0));
  EXPECT_FALSE(c.fct_idk || c.fct_idf);
  EXPECT_EQ(std::tuple(c.icurv, c.ibc, c.ibag, c.idel, c.itied, c.iform),
            std::tuple(0, 0, 0, 0, 0, 1));
  // With Iadm 1 the criteria of the card are not read.
  const auto adapts =
      with("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Iadm=1 NRadm=7 Padm=0.875 Angladm=30",
           meshing);
  const ContactCard a = make_card(adapts->scene, adapts->contact());
  EXPECT_EQ(std::tuple(a.iadm, a.nradm, a.padm, a.angladm), std::tuple(1, 1.0, 1.0, 0.0));
  const auto viscous = with("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Fric=0.2 VISF=0.25");
  EXPECT_EQ(make_card(viscous->scene, viscous->contact()).visf, 0.25);
  // A function of the temperature without a coefficient scales 1.
  const auto scaled =
      with("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Ithe=1 fct_IDF=32", functions);
  EXPECT_EQ(make_card(scaled->scene, scaled->contact()).fric, 1.0);
  const auto missing = with("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Ithe=1 fct_IDF=39");
  EXPECT_EQ(make_card(missing->scene, missing->contact()).fric, 0.0);
  EXPECT_FALSE(make_card(missing->scene, missing->contact()).fct_idf.has_value());
}

TEST(CardOfType7, PutsACurveWhoseNodesAreMissingAtTheOrigin) {
  const auto b =
      with("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Icurv=1 node_ID1=3 node_ID2=99");
  const ContactCard c = make_card(b->scene, b->contact());
  EXPECT_EQ(c.icurv, 1);
  EXPECT_EQ(c.curv_node1, (std::array<double, 3>{10, 10, 0}));
  EXPECT_EQ(c.curv_node2, (std::array<double, 3>{0, 0, 0}));
}

TEST(CardOfType10, HasStiffnessDampingTimesAndRebound) {
  const auto b = with(
      "@/INTER/TYPE10/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 Stfac=0.75 VISs=0.125 Tstart=0.01 "
      "Tstop=0.02 ITIED=1 Idel=1");
  const ContactCard c = make_card(b->scene, b->contact());
  EXPECT_EQ(c.kind, ContactKind::tied);
  EXPECT_EQ(std::tuple(c.stfac, c.viss, c.tstart, c.tstop, c.itied, c.idel),
            std::tuple(0.75, 0.125, 0.01, 0.02, 1, 1));
}

TEST(SensorTimes, AreThoseOfSensorsByTimeAndNeverOfOthers) {
  const auto time = [](const std::string& sensor, const std::string& id) {
    const auto b = with("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 sens_ID=" + id, sensor);
    return make_card(b->scene, b->contact()).sensor_time;
  };
  const std::string sensors =
      "@/SENSOR/TIME/4 Tdelay=0.25\n@/SENSOR/TIME/5 Tdelay=0.5\n@/SENSOR/DIST/6 node_ID1=1 "
      "node_ID2=2";
  EXPECT_EQ(time(sensors, "4"), 0.25);
  EXPECT_EQ(time(sensors, "5"), 0.5);
  EXPECT_EQ(time(sensors, "6"), 1e30);
  EXPECT_EQ(time(sensors, "7"), std::nullopt);
  EXPECT_EQ(time(sensors, "0"), std::nullopt);
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

TEST(SeveralContacts, LimitTheStepAtTheFirstNodeToo) {
  const auto b = twice("", "");
  State state = make_state(b->scene);
  state.mass[0] = 1e-12;
  const SceneOutcome r = run_cycle(b->scene, state, {});
  EXPECT_EQ(r.limiting_node, 0u);
  EXPECT_DOUBLE_EQ(r.contact_dt, 0.9 * std::sqrt(2e-12 / r.nodes.stiffness[0]));
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
  CycleOptions options;
  options.dt1 = options.dt12 = 0.5;
  const SceneOutcome r = run_cycle(b->scene, state, options);
  // Each node has a quarter of its shell of 32: Q = A (50 - 150) dt Kthe.
  for (const NodeIndex n : upper) EXPECT_NEAR(r.nodes.heat[n], 8 * -100 * 0.5 * (2 + 3), 1e-9);
  EXPECT_NEAR(r.contacts[0].heat_secondary, 4 * 8 * -100 * 0.5 * 2, 1e-9);
  EXPECT_NEAR(r.contacts[1].heat_main, 4 * 8 * 100 * 0.5 * 3, 1e-9);
  double all = 0;
  for (const double q : r.nodes.heat) all += q;
  EXPECT_NEAR(all, 0, 1e-9);
  double conducts = 0;
  for (const double c : r.nodes.conductance) conducts += c;
  EXPECT_NEAR(conducts, 2 * 4 * 8 * (2 + 3), 1e-9);
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

TEST(SeveralContacts, ProgressCountsThem) {
  const auto b = twice("", "");
  CycleOptions options;
  std::vector<std::pair<std::size_t, std::size_t>> calls;
  options.progress = [&](std::size_t done, std::size_t all) { calls.emplace_back(done, all); };
  static_cast<void>(run_cycle(b->scene, make_state(b->scene), options));
  EXPECT_EQ(calls, (std::vector<std::pair<std::size_t, std::size_t>>{{1, 2}, {2, 2}}));
  calls.clear();
  static_cast<void>(run_steps(b->scene, make_state(b->scene), options, 2, {}, {}));
  EXPECT_EQ(calls,
            (std::vector<std::pair<std::size_t, std::size_t>>{{1, 4}, {2, 4}, {3, 4}, {4, 4}}));
}

TEST(SeveralContacts, AreSummedByInterface) {
  std::vector<ContactOutcome> c(3);
  InterType7 inter;
  inter.id = 42;
  std::vector<Contact> contacts(3);
  std::vector<const ContactOutcome*> list;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto v = static_cast<double>(k);
    contacts[k].inter = &inter;
    c[k].contact = &contacts[k];
    c[k].active = k == 1;
    c[k].pairs_in_reach = 3 + k;
    c[k].pairs_with_force = 1 + k;
    c[k].largest_force = k == 1 ? 9 : 2;
    c[k].totals.total_abs = 10 + v;
    c[k].totals.elastic_energy = 20 + v;
    c[k].totals.friction_energy = 30 + v;
    c[k].totals.damping_energy = 40 + v;
    c[k].largest_acceleration = k == 1 ? 70 : 50 + v;
    c[k].acceleration_node = static_cast<NodeIndex>(60 + k);
    c[k].step = {StepLimit::Source::nodal, k == 2 ? 1e-4 : 1e-3, 0};
    c[k].step_node = static_cast<NodeIndex>(80 + k);
    c[k].gap_closed = 1 + k;
    c[k].near_singular_count = 4 + k;
    list.push_back(&c[k]);
  }
  StructureStep structure;
  structure.dt = 5e-4;
  const InterfaceSummary s = summarize(list, structure);
  EXPECT_EQ(s.id, 42);
  EXPECT_EQ(s.inter, &inter);
  EXPECT_TRUE(s.active);
  EXPECT_EQ(std::tuple(s.pairs_in_reach, s.pairs_with_force, s.gap_closed, s.near_singular),
            std::tuple(12u, 6u, 6u, 15u));
  EXPECT_EQ(std::tuple(s.largest_pair_force, s.force_sum, s.elastic_energy, s.friction_energy,
                       s.damping_energy),
            std::tuple(9.0, 33.0, 63.0, 93.0, 123.0));
  EXPECT_EQ(std::tuple(s.largest_acceleration, s.acceleration_node), std::tuple(70.0, 61u));
  EXPECT_EQ(std::tuple(s.contact_dt, s.contact_dt_source, s.contact_dt_node, s.structure_dt),
            std::tuple(1e-4, StepLimit::Source::nodal, 82u, 5e-4));
}

// --- sums of pieces

TEST(TotalsOfPieces, AddEveryMemberAndKeepTheSmallestStep) {
  Totals a, b;
  int n = 0;
  const auto fill = [&](Totals& t) {
    for (auto* three : {&t.normal, &t.tangential, &t.moment})
      for (double& v : *three) v = ++n;
    for (double* v : {&t.normal_abs, &t.total_abs, &t.elastic_energy, &t.friction_energy,
                      &t.damping_energy, &t.friction_heat})
      *v = ++n;
    t.contacts = static_cast<std::size_t>(++n);
  };
  fill(a);
  fill(b);
  a.dt_kinematic = 3;
  a.dt_kinematic_pair = 7;
  b.dt_kinematic = 2;
  b.dt_kinematic_pair = 8;
  Totals sum = a;
  sum.add(b);
  for (const auto member : {&Totals::normal, &Totals::tangential, &Totals::moment})
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ((sum.*member)[c], (a.*member)[c] + (b.*member)[c]);
  for (const auto member :
       {&Totals::normal_abs, &Totals::total_abs, &Totals::elastic_energy, &Totals::friction_energy,
        &Totals::damping_energy, &Totals::friction_heat})
    EXPECT_EQ(sum.*member, a.*member + b.*member);
  EXPECT_EQ(sum.contacts, a.contacts + b.contacts);
  EXPECT_EQ(std::tuple(sum.dt_kinematic, sum.dt_kinematic_pair), std::tuple(2.0, std::size_t{8}));
  Totals same = b;
  same.add(a);
  EXPECT_EQ(same.dt_kinematic_pair, 8u);
  a.dt_kinematic = 2;  // the first of two
  a.add(b);
  EXPECT_EQ(a.dt_kinematic_pair, 7u);
}

// --- skews and materials

TEST(FixedSkew, HasItsAxesAtRightAnglesOfLengthOne) {
  const auto axes = [](const std::string& values) {
    const auto b = with(
        "/SKEW/FIX/7\ns\n                 0.0                 0.0                 0.0\n" + values);
    return detail::fixed_axes(b->model, 7);
  };
  const auto row = [](const char* y, const char* z) { return std::string(y) + "\n" + z; };
  // Y = (0, 2, 0), Z = (0, 1, 3): X = Y x Z = (6, 0, 0), Z becomes (0, 0, 1).
  const auto straight = axes(row("                 0.0                 2.0                 0.0",
                                 "                 0.0                 1.0                 3.0"));
  ASSERT_TRUE(straight.has_value());
  EXPECT_EQ(straight->matrix, (std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
  // Y = (0, 0, 5), Z = (4, 0, 1): X = (0, 20, 0) / 20, Z = X x Y = (1, 0, 0).
  const auto turned = axes(row("                 0.0                 0.0                 5.0",
                               "                 4.0                 0.0                 1.0"));
  ASSERT_TRUE(turned.has_value());
  EXPECT_EQ(turned->matrix, (std::array<double, 9>{0, 0, 1, 1, 0, 0, 0, 1, 0}));
  // Along each other, or of no length: no axes.
  for (const auto& bad : {row("                 0.0                 2.0                 0.0",
                              "                 0.0                 3.0                 0.0"),
                          row("                 0.0                 0.0                 0.0",
                              "                 0.0                 3.0                 0.0"),
                          row("                 0.0                 2.0                 0.0",
                              "                 0.0                 0.0                 0.0")})
    EXPECT_FALSE(axes(bad).has_value()) << bad;
}

TEST(ConductivityOfMaterials, ChangesItsLawAtTheMeltingTemperature) {
  const auto b = with(
      "/HEAT/MAT/1\n"
      "               300.0                 1.0                 2.0                0.25\n"
      "              1000.0                 3.0                 0.5\n"
      "/HEAT/MAT/9\n"
      "               300.0                 1.0                 7.0                 7.0\n");
  const auto laws = detail::conductivities(b->model);
  ASSERT_EQ(laws.size(), b->model.materials.size());
  const auto& law = laws.at(b->model.material_of_id.at(1));
  EXPECT_DOUBLE_EQ(law(400), 2 + 0.25 * 400);
  EXPECT_DOUBLE_EQ(law(999), 2 + 0.25 * 999);
  EXPECT_DOUBLE_EQ(law(1200), 3 + 0.5 * 1200);
  const auto solid = with(
      "/HEAT/MAT/1\n"
      "               300.0                 1.0                 2.0                0.25\n");
  EXPECT_DOUBLE_EQ(detail::conductivities(solid->model).at(0)(1e20), 2 + 0.25e20);
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
  SceneOptions o;
  o.nodal_stiffness = true;
  const Built b(d, o);
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
    options.dead[0] = {kinds[k], element + 1, 0.5};
    EXPECT_TRUE(run_cycle(b.scene, state, options).contacts[0].removed.empty()) << k;
  }
  CycleOptions all;
  for (std::size_t k = 0; k < 6; ++k) all.dead.push_back({kinds[k], k == 0 ? 1u : 0u, 0.0});
  EXPECT_EQ(run_cycle(b.scene, state, all).contacts[0].removed.size(), 6u);
}

}  // namespace
}  // namespace deck::cycle
