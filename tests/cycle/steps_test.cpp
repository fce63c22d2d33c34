// Steps of prescribed motion: what contacts remember from one evaluation to the next, and what is
// said about nodes that leave an interface.
#include "deck/cycle/steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/small_deck.hpp"
#include "report/shared/cycle.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;

/// A plate of four shells (part 1) and one shell (part 2) over its middle at a height; node group 2
/// is the upper one, surface 1 the plate.
SmallDeck over(double height, const std::string& card = {}) {
  SmallDeck d;
  for (int i = 0; i < 9; ++i) d.node(i + 1, 10.0 * (i % 3), 10.0 * (i / 3), 0);
  d.node(11, 3, 3, height).node(12, 8, 3, height).node(13, 8, 8, height).node(14, 3, 8, height);
  d.shell_part(1, 1.0).shell_part(2, 1.0);
  d.shell(1, 1, 1, 2, 5, 4).shell(1, 2, 2, 3, 6, 5).shell(1, 3, 4, 5, 8, 7).shell(1, 4, 5, 6, 9, 8);
  d.shell(2, 5, 11, 12, 13, 14);
  d.group("/GRNOD/PART/2", {2}).group("/SURF/PART/1", {1});
  return card.empty() ? d : d.add(card);
}

struct Stepped {
  explicit Stepped(const SmallDeck& d, CycleOptions o, std::size_t steps, std::array<double, 3> v)
      : built(d, scene_options()), state(make_state(built.scene, {{2, v}})), options(std::move(o)) {
    outcome = run_steps(built.scene, state, options, steps, {},
                        [&](std::size_t, const SceneOutcome& r, const Coordinates&) {
                          forces.push_back(r.contacts.at(0).totals);
                          ties.push_back(r.contacts.at(0).pairs_tied);
                        });
  }
  static SceneOptions scene_options() {
    SceneOptions o;
    o.candidates = false;
    o.nodal_stiffness = true;
    return o;
  }
  [[nodiscard]] std::size_t events(StepEvent::Kind kind) const {
    return static_cast<std::size_t>(
        std::count_if(outcome.events.begin(), outcome.events.end(),
                      [&](const StepEvent& e) { return e.kind == kind; }));
  }
  Built built;
  State state;
  CycleOptions options;
  StepsOutcome outcome;
  std::vector<Totals> forces;
  std::vector<std::size_t> ties;
};

CycleOptions with_step(double dt, Model model = Model::robust) {
  CycleOptions o;
  o.dt1 = o.dt12 = dt;
  o.model = model;
  return o;
}

const char* const plain = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1";

TEST(Steps, TheFirstIsTheOneCycleCheck) {
  const Stepped one(over(0.5, plain), with_step(1e-3), 1, {0, 0, -1});
  const SceneOutcome alone = run_cycle(one.built.scene, one.state, one.options);
  EXPECT_EQ(one.outcome.last.contacts.at(0).totals.normal, alone.contacts.at(0).totals.normal);
  EXPECT_GT(alone.contacts[0].pairs_with_force, 0u);
  EXPECT_EQ(one.outcome.lines.size(), 1u);
}

TEST(Steps, TheSpringOfFrictionGrowsWithThePathUntilItSlips) {
  const std::string card = std::string(plain) + " Fric=0.2 Iform=2";
  for (const Model model : {Model::reference, Model::robust}) {
    const Stepped r(over(0.5, card), with_step(1e-5, model), 30, {1, 0, 0});
    const auto t = [&](std::size_t k) { return std::abs(r.forces.at(k).tangential[0]); };
    // On a quad the reference tilts its normal a little with every step.
    const double tilt = model == Model::reference ? 1e-5 : 1e-12;
    EXPECT_NEAR(t(4), 5 * t(0), tilt * t(4));
    EXPECT_NEAR(t(9), 10 * t(0), tilt * t(9));
    EXPECT_GT(t(0), 0.0);
  }
  const Stepped fast(over(0.5, card), with_step(1e-2), 30, {1, 0, 0});
  EXPECT_NEAR(std::abs(fast.forces.back().tangential[0]), 0.2 * fast.forces.back().normal_abs,
              1e-9 * fast.forces.back().normal_abs);
}

TEST(Steps, ATiedContactTiesAtTheFirstTouchAndPullsBack) {
  const std::string card = "@/INTER/TYPE10/1 grnd_IDs=2 surf_IDm=1 Gap=1 Itied=1";
  const Stepped r(over(1.25, card), with_step(0.1), 10, {0, 0, -1});
  EXPECT_EQ(r.events(StepEvent::Kind::tied), 4u);
  EXPECT_EQ(r.outcome.events.front().step, 3u) << "1.25 - 0.3 is the first height within the gap";
  EXPECT_EQ(r.ties.at(2), 0u);
  EXPECT_EQ(r.ties.back(), 4u);
}

TEST(Steps, AnApproachOverManyStepsIsFoundByTheSearch) {
  const Stepped r(over(40.5, plain), with_step(0.1), 410, {0, 0, -1});
  std::size_t first = 0;
  while (first < r.forces.size() && r.forces[first].normal_abs == 0.0) ++first;
  EXPECT_EQ(first, 396u) << "height 40.5 - 39.6 = 0.9";
  EXPECT_GT(r.outcome.searches, 5u);
  EXPECT_LT(r.outcome.searches, 100u);
}

TEST(Steps, ANodeBelowDtminIsGoneFromTheNextStepOn) {
  const std::string card = std::string(plain) + " dtmin=1000";
  const Stepped r(over(0.5, card), with_step(1e-4), 3, {0, 0, -1});
  EXPECT_EQ(r.events(StepEvent::Kind::removed), 4u);
  for (const StepEvent& e : r.outcome.events) EXPECT_EQ(e.step, 0u);
  EXPECT_EQ(r.forces.at(1).normal_abs, 0.0);
  EXPECT_EQ(r.outcome.lines.back().contacts.at(0).removed, 4u);
}

TEST(Steps, BoundaryConditionsAreReleasedAtTheFirstPenetrationOnce) {
  SmallDeck d = over(1.15, std::string(plain) + " IBCX=1 IBCY=1");
  d.add("/BCS/1\nb\n   111 000         0         3").group("/GRNOD/NODE/3", {11, 12});
  const Stepped r(d, with_step(0.1), 5, {0, 0, -1});
  ASSERT_EQ(r.events(StepEvent::Kind::released), 2u);
  EXPECT_EQ(r.outcome.events.front().step, 2u);
  EXPECT_EQ(r.outcome.events.front().release.before, 7);
  EXPECT_EQ(r.outcome.events.front().release.after, 1);
}

TEST(Steps, InactiFiveGivesTheGapBackWhenANodeMovesAway) {
  const Stepped r(over(0.5, std::string(plain) + " Inacti=5"), with_step(1e-3), 200, {0, 0, 1});
  EXPECT_EQ(r.forces.front().normal_abs, 0.0);
  EXPECT_EQ(r.forces.at(50).normal_abs, 0.0) << "what was taken off the gap is remembered";
  // Out to 0.699, then in again: the gap has grown with it, so the way in pushes.
  CycleOptions o = with_step(1e-3);
  const Built b(over(0.5, std::string(plain) + " Inacti=5"), Stepped::scene_options());
  double deepest = 0.0;
  const StepsOutcome turned = run_steps(
      b.scene, make_state(b.scene), o, 400,
      [&](std::size_t k, Coordinates& x, State&, CycleOptions&) {
        const double up =
            k < 200 ? 0.001 * static_cast<double>(k) : 0.4 - 0.001 * static_cast<double>(k);
        for (const std::int64_t id : {11, 12, 13, 14}) x.z[b.model.nodes.map.find(id)] = 0.5 + up;
      },
      [&](std::size_t k, const SceneOutcome& s, const Coordinates&) {
        if (k == 399) deepest = s.contacts.at(0).totals.normal_abs;
      });
  EXPECT_GT(deepest, 0.0);
  EXPECT_EQ(turned.lines.front().contacts.at(0).force_sum, 0.0);
}

TEST(Steps, ATornElementTakesItsSegmentAway) {
  const std::string card = std::string(plain) + " Idel=1";
  CycleOptions o = with_step(1e-3);
  Built b(over(0.5, card), Stepped::scene_options());
  o.dead = {{ElementKind::shell4, 0, 2.5e-3}};  // the segment below
  std::vector<std::size_t> pushing;
  static_cast<void>(run_steps(b.scene, make_state(b.scene), o, 5, {},
                              [&](std::size_t, const SceneOutcome& r, const Coordinates&) {
                                pushing.push_back(r.contacts.at(0).pairs_with_force);
                              }));
  EXPECT_EQ(pushing, (std::vector<std::size_t>{4, 4, 4, 0, 0}));
}

TEST(Steps, ANodeWithoutAnyElementLeftLeavesWithIdel) {
  CycleOptions o = with_step(1e-3);
  for (const bool negative : {false, true}) {
    Built b(over(0.5, std::string(plain) + (negative ? " Idel=-1" : " Idel=1")),
            Stepped::scene_options());
    o.dead = {{ElementKind::shell4, 4, 0.0}};  // the shell of the nodes themselves
    const StepsOutcome r = run_steps(b.scene, make_state(b.scene), o, 3);
    EXPECT_EQ(r.lines.back().contacts.at(0).removed, negative ? 0u : 4u);
    EXPECT_EQ(r.lines.back().contacts.at(0).pairs_with_force, negative ? 4u : 0u);
  }
}

TEST(Steps, DoNotDependOnThreads) {
  const std::string card = std::string(plain) + " Fric=0.2 Iform=2 Inacti=5";
  CycleOptions o = with_step(1e-2);
  const Stepped a(over(0.9, card), o, 40, {0.3, 0.2, -0.5});
  o.threads = 3;
  const Stepped b(over(0.9, card), o, 40, {0.3, 0.2, -0.5});
  for (std::size_t k = 0; k < a.forces.size(); ++k) {
    EXPECT_EQ(a.forces[k].normal, b.forces[k].normal);
    EXPECT_EQ(a.forces[k].tangential, b.forces[k].tangential);
  }
  EXPECT_NE(a.forces.back().normal_abs, 0.0);
}

// One evaluation.

std::string text_of(const Built& b, const SceneOutcome& r, const State& s) {
  CycleInput input;
  input.path = "deck";
  input.deck = &b.deck;
  input.scene = &b.scene;
  input.state = &s;
  input.outcome = &r;
  return cycle_text(input);
}

TEST(Removal, ByDtminIsSaidWithItsNodesAndCounted) {
  const Built b(over(0.5, std::string(plain) + " dtmin=1000"), Stepped::scene_options());
  const State s = make_state(b.scene, {{2, {0, 0, -1}}});
  const SceneOutcome r = run_cycle(b.scene, s, with_step(1e-4));
  EXPECT_EQ(r.contacts.at(0).removed.size(), 4u);
  EXPECT_EQ(r.contacts[0].pairs_with_force, 0u);
  EXPECT_EQ(r.contacts[0].pairs_switched_off, 4u);
  const std::string text = text_of(b, r, s);
  EXPECT_NE(text.find("dtmin is above the time step of 4 nodes"), std::string::npos) << text;
  EXPECT_NE(text.find("node 11, node 12, node 13"), std::string::npos) << text;
}

TEST(Cylinder, WithoutAnAxisIsNotComputed) {
  const Built b(over(0.5, std::string(plain) + " Icurv=2 node_ID1=11 node_ID2=11"),
                Stepped::scene_options());
  const State s = make_state(b.scene);
  const SceneOutcome r = run_cycle(b.scene, s, {});
  EXPECT_FALSE(r.contacts.at(0).complete);
  EXPECT_EQ(r.contacts[0].pairs_with_force, 0u);
  ASSERT_FALSE(r.contacts[0].notes.empty());
  EXPECT_NE(r.contacts[0].notes.back().find("no axis"), std::string::npos);
}

TEST(Criteria, ATrianglesLastCornerCountsTwiceInTheNormalsOfIadm) {
  // A flat square, beside it a triangle folded up about their common side 2-3.
  for (const bool last : {false, true}) {
    SmallDeck d;
    d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(5, 17, 5, 7);
    d.node(9, 5, 5, 0.5);
    d.shell_part(1, 1.0).shell(1, 1, 1, 2, 3, 4);
    // The same triangle, with node 3 as the second or the last corner.
    last ? d.shell3(1, 2, 2, 5, 3) : d.shell3(1, 2, 5, 3, 2);
    d.group("/GRNOD/NODE/2", {9}).group("/SURF/PART/1", {1}).add("/ADMESH/GLOBAL\n         1");
    d.add(std::string(plain) + " Iadm=1");
    const Built b(d, Stepped::scene_options());
    const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), {});
    const deck::Contact& c = b.scene.contacts.at(0);
    ASSERT_EQ(c.main.size(), 2u);
    const ContactPairs pairs = make_pairs(b.scene, c, make_card(b.scene, c), Model::reference);
    ASSERT_EQ(pairs.size(), 1u);
    // Of node 3: (0, 0, 1) and once or twice the triangle's.
    const double once = std::sqrt(0.5), share = last ? 2.0 : 1.0;
    const std::size_t corner = 2;
    EXPECT_NEAR(pairs.normal[corner][0].at(0), -share * once, 1e-12);
    EXPECT_NEAR(pairs.normal[corner][2].at(0), 1 + share * once, 1e-12);
    ASSERT_EQ(r.contacts.at(0).criteria.size(), 5u) << "the node and four corners";
    EXPECT_LT(r.contacts[0].criteria.front().radius, 1e3);
  }
}

TEST(IremI2, DropsThePairsOfATiedNodeWithTheSegmentsAroundItsTie) {
  for (const int flag : {1, 3}) {
    SmallDeck d = over(0.5, std::string(plain) + " Irem_i2=" + std::to_string(flag));
    d.add("/INTER/TYPE2/9\nt\n         3         1").group("/GRNOD/NODE/3", {11, 12});
    const Built b(d, Stepped::scene_options());
    const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), {});
    EXPECT_EQ(r.contacts.at(0).pairs_with_force, flag == 1 ? 2u : 4u);
  }
}

TEST(IremI2, KeepsThePairsOfATiedNodeWithOtherSegments) {
  // The nodes are tied to a plate of its own, on the other side.
  for (const int flag : {1, 3}) {
    SmallDeck d = over(0.5, std::string(plain) + " Irem_i2=" + std::to_string(flag));
    d.node(21, 0, 0, 2).node(22, 10, 0, 2).node(23, 10, 10, 2).node(24, 0, 10, 2);
    d.shell_part(3, 1.0).shell(3, 9, 21, 22, 23, 24).group("/SURF/PART/3", {3});
    d.add("/INTER/TYPE2/9\nt\n         3         3").group("/GRNOD/NODE/3", {11, 12});
    const Built b(d, Stepped::scene_options());
    const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), {});
    EXPECT_EQ(r.contacts.at(0).pairs_with_force, 4u) << flag;
  }
}

TEST(IremI2, DropsThePairsOfSegmentsAtATiedNodeWithTheCornersOfItsTie) {
  // Node 1 of the main side is tied to the plate of the secondary nodes.
  for (const int flag : {1, 3}) {
    SmallDeck d = over(0.5, std::string(plain) + " Irem_i2=" + std::to_string(flag));
    d.add("/INTER/TYPE2/9\nt\n         3         2").group("/GRNOD/NODE/3", {1});
    d.group("/SURF/PART/2", {2});
    const Built b(d, Stepped::scene_options());
    const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), {});
    EXPECT_EQ(r.contacts.at(0).pairs_with_force, flag == 1 ? 0u : 4u);
  }
}

TEST(Account, EffectsThatNeverActAreOffWithTheReason) {
  ContactCard card;
  card.fric = 0.2;
  const auto row = [&](const std::string& name) {
    for (const EffectState& e : effect_plan(card))
      if (e.name == name) return e;
    return EffectState{};
  };
  card.itied = 1;
  EXPECT_FALSE(row("tie-on-time-step").on);
  EXPECT_NE(row("tie-on-time-step").reason.find("dtmin = 0"), std::string::npos);
  card.dtmin = 1e-3;
  EXPECT_TRUE(row("tie-on-time-step").on);
  card.ithe = 1;
  card.fheatm = 0.5;
  EXPECT_FALSE(row("friction-heat").on);
  EXPECT_NE(row("friction-heat").reason.find("is lost"), std::string::npos);
  card.ithe_form = 1;
  EXPECT_TRUE(row("friction-heat").on);
  card.ifiltr = 3;
  card.xfreq = 100;
  EXPECT_FALSE(row("friction-filter").on);
  card.ifiltr = 1;
  card.xfreq = 1.0;
  EXPECT_FALSE(row("friction-filter").on);
  card.xfreq = 0.3;
  EXPECT_TRUE(row("friction-filter").on);
  card.ascalef = 2;
  EXPECT_FALSE(row("friction-temperature-scale").on);
  EXPECT_NE(row("friction-temperature-scale").reason.find("never"), std::string::npos);
}

}  // namespace
}  // namespace deck::cycle
