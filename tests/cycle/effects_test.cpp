// Effects one by one where no worked vector covers them: temperature friction, laws on real pairs,
// release of ties, TYPE19 as a sum, and arrays that nothing asked for lying on unmapped pages.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "accuracy/shared/effect_cost.hpp"
#include "contact/small_deck.hpp"
#include "cycle/plates.hpp"
#include "cycle/support.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using namespace testing;

/// A pair that slides fast enough to be at its friction limit.
Pair sliding_pair(double speed = 5e4) {
  Pair p = testing::quad_pair({5, 4, 0.6});
  p.v[0] = {speed, 0, 0};
  p.temperature = {400, 600, 600, 600, 600};
  return p;
}

double coefficient(const Outcome& r) {
  const Vec ft = r.force() - r.all.normal_force[0] * r.normal();
  return testing::norm(ft) / std::abs(r.all.normal_force[0]);
}

TEST(FrictionTemperature, ScalesWithTheMeanTemperatureOfBothSides) {
  ContactCard card;
  card.fric = 0.2;
  card.ithe = 1;
  card.tint = 800;
  card.fct_idf = Curve{{0, 1000}, {1.0, 3.0}};
  for (const Model m : {Model::reference, Model::robust})
    for (const int form : {0, 1}) {
      card.ithe_form = form;
      const double mean = form == 0 ? (400 + 800) / 2 : (400 + 600) / 2;
      EXPECT_NEAR(coefficient(testing::run(card, sliding_pair(), 1e-6, 1e-6, m)),
                  0.2 * (1 + mean / 500), 1e-12);
    }
  card.fric = 0.0;  // the function alone
  EXPECT_NEAR(coefficient(testing::run(card, sliding_pair(), 1e-6, 1e-6)), 2.0, 1e-11);
}

TEST(FrictionLaw, OfAPairTakesItsPressureAndSpeed) {
  for (const int law : {1, 2, 3, 4}) {
    ContactCard card;
    card.fric = 0.1;
    card.ifric = law;
    if (law == 1) card.c = {1e-5, 1e-6, 1e-9, 1e-9, 1e-12, 0};
    if (law == 2) card.c = {1e-8, -1e-6, 1e-5, -1e-6, 0.05, -1e-5};
    if (law == 3) card.c = {0.2, 0.15, 0.3, 0.1, 1e4, 9e4};
    if (law == 4) card.c = {0.3, 1e-5};
    const Outcome r = testing::run(card, sliding_pair(), 1e-6, 1e-6);
    const double pressure = -r.all.normal_force[0] / 100.0;
    const double mu = friction_coefficient(law, 0.1, card.c, pressure, 5e4);
    EXPECT_NE(mu, 0.1) << law;
    EXPECT_NEAR(coefficient(r), mu, 1e-12) << law;
  }
}

TEST(Tie, Type7LetsGoOnItsOwnSideOutsideTheGapUnlessItMayNot) {
  ContactCard card;
  Pair p = testing::quad_pair({5, 5, 1.5});  // gap 1: outside
  p.tie = {-450000, 3, 4, 0.25, 0.25, 0.25, 0.9, 0.1};
  card.itied = 1;
  EXPECT_EQ(testing::run(card, p, 1e-6, 1e-6).all.status[0], status_released);
  card.itied = 2;
  EXPECT_EQ(testing::run(card, p, 1e-6, 1e-6).all.status[0], status_tied | status_contact);
  // Through the surface and out on the other side: held even by ITIED 1.
  p.tie[7] = -0.1;
  card.itied = 1;
  EXPECT_EQ(testing::run(card, p, 1e-6, 1e-6).all.status[0], status_tied | status_contact);
}

TEST(Tie, Type10RemembersAPairThatDoesNotMoveYet) {
  ContactCard card;
  card.kind = ContactKind::tied;
  Pair p = testing::quad_pair({5, 5, 0.4});
  const Outcome still = testing::run(card, p, 1e-6, 1e-6);
  EXPECT_EQ(still.all.tie[0][0], 1e-30);
  EXPECT_EQ(still.all.status[0], status_tied | status_contact);
  p.x[0][2] = 1.4;  // outside the gap there is nothing to remember
  EXPECT_EQ(testing::run(card, p, 1e-6, 1e-6).all.tie[0][0], 0.0);
}

// Whole decks.

/// Two plates whose corners and edges lie close.
deck::test::SmallDeck corner_plates() {
  deck::test::SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(11, 7, 7, 0.5).node(12, 17, 6, 0.6).node(13, 16, 17, 0.7).node(14, 6, 16, 0.6);
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  d.shell(1, 1, 1, 2, 3, 4).shell(2, 2, 11, 12, 13, 14);
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
  d.group("/GRNOD/PART/1", {1}).group("/GRNOD/PART/2", {2});
  return d.group("/LINE/SURF/1", {1}).group("/LINE/SURF/2", {2});
}

SceneOutcome run_deck(const deck::test::SmallDeck& d, const CycleOptions& options) {
  const deck::test::Built b(d, testing::with_stiffness());
  return run_cycle(b.scene, make_state(b.scene), options);
}

TEST(Type19, IsTheSumOfTwoSurfaceContactsAndOneOfEdges) {
  deck::test::SmallDeck one = corner_plates(), three = corner_plates();
  one.add("@/INTER/TYPE19/1 surf_IDs=2 surf_IDm=1 Gapmin=1 Istf=2");
  three.add("@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1 Istf=2");
  three.add("@/INTER/TYPE7/2 grnd_IDs=1 surf_IDm=2 Gapmin=1 Istf=2");
  three.add("@/INTER/TYPE11/3 line_IDs=2 line_IDm=1 Gapmin=1 Istf=2");
  for (const Model model : {Model::reference, Model::robust}) {
    CycleOptions options;
    options.model = model;
    const SceneOutcome a = run_deck(one, options), b = run_deck(three, options);
    ASSERT_EQ(a.contacts.size(), 3u);
    ASSERT_EQ(b.contacts.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(a.contacts[k].pairs_with_force, 0u) << k;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t n = 0; n < a.nodes.force[c].size(); ++n)
        EXPECT_NEAR(a.nodes.force[c][n], b.nodes.force[c][n], 1e-12 * a.largest_nodal_force);
  }
}

// Arrays nobody asked for.

/// A page that must not be touched.
class Unmapped {
 public:
  Unmapped() : page_(mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {}
  ~Unmapped() {
    if (page_ != MAP_FAILED) munmap(page_, size);
  }
  Unmapped(const Unmapped&) = delete;
  Unmapped& operator=(const Unmapped&) = delete;
  [[nodiscard]] bool ready() const { return page_ != MAP_FAILED; }
  [[nodiscard]] const double* at() const { return static_cast<const double*>(page_); }

 private:
  static constexpr std::size_t size = 1 << 20;
  void* page_;
};

/// Points everything that is not among the needs of a plan to the forbidden page.
void forbid(PacketView& w, Field needs, const double* page) {
  const auto off = [&](Field f) { return !contains(needs, f); };
  for (std::size_t r = 0; r < 5; ++r) {
    if (off(Field::velocity)) w.velocity[r].fill(page);
    if (off(r == 0 ? Field::mass_secondary : Field::mass_main)) w.mass[r] = page;
    if (off(Field::temperature)) w.temperature[r] = page;
  }
  if (off(Field::residual_penetration)) w.p0 = page;
  if (off(Field::friction_memory)) w.ft_old.fill(page);
  if (off(Field::tie_record)) w.tie.fill(page);
  if (off(Field::temperature)) {
    w.area = w.conductivity = page;
    w.edge_width.fill(page);
    w.edge_conductivity.fill(page);
  }
  if (off(Field::pair_friction)) {
    w.fric = w.visf2 = page;
    w.c.fill(page);
    w.ortho_mu.fill(page);
    w.ortho_direction.fill(page);
  }
  if (off(Field::nodal_normals))
    for (auto& n : w.normal) n.fill(page);
}

TEST(Needs, WhatNoEffectAskedForMayLieOnUnmappedPages) {
  const Unmapped page;
  if (!page.ready()) GTEST_SKIP() << "no unmapped page to be had";
  for (const ContactKind kind : {ContactKind::node_segment, ContactKind::edge_edge}) {
    const Packet packet(testing::random_pairs(200, 33, kind == ContactKind::edge_edge));
    for (int bits = 0; bits < 32; ++bits) {
      ContactCard card;
      card.kind = kind;
      card.viss = (bits & 1) != 0 ? 0.05 : 0.0;
      card.fric = (bits & 2) != 0 ? 0.3 : 0.0;
      card.iform = (bits & 4) != 0 ? 2 : 1;
      card.inacti = (bits & 8) != 0 ? 6 : 0;
      card.ithe = card.ithe_form = (bits & 16) != 0 ? 1 : 0;
      card.kthe = 10.0;
      for (const Model model : {Model::reference, Model::robust}) {
        const KernelPlan plan = make_plan(card, model);
        PacketView view = packet.view(1e-5, 1e-5);
        PacketResult all, least;
        evaluate(plan, view, all);
        forbid(view, plan.needs, page.at());
        evaluate(plan, view, least);
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t i = 0; i < all.size; ++i)
            ASSERT_EQ(std::bit_cast<std::uint64_t>(all.force[c][i]),
                      std::bit_cast<std::uint64_t>(least.force[c][i]))
                << bits;
        EXPECT_EQ(all.heat, least.heat);
        EXPECT_EQ(all.k_nodal, least.k_nodal);
      }
    }
  }
}

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
  how.least_pairs = 1;
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
}  // namespace deck::cycle
