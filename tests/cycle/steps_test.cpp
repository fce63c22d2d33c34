// Steps of prescribed motion: what contacts remember from one evaluation to the next, and which
// nodes and pairs leave an interface.
#include "deck/cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "cycle/plates.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;
using testing::with_step;

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
                        });
  }
  static SceneOptions scene_options() {
    SceneOptions o = testing::with_stiffness();
    o.candidates = false;
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
};

const char* const plain = "@/INTER/TYPE7/1 grnd_IDs=2 surf_IDm=1 Gapmin=1";

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

TEST(Steps, AnApproachOverManyStepsIsFoundByTheSearch) {
  const Stepped r(over(40.5, plain), with_step(0.1), 410, {0, 0, -1});
  std::size_t first = 0;
  while (first < r.forces.size() && r.forces[first].normal_abs == 0.0) ++first;
  EXPECT_EQ(first, 396u) << "height 40.5 - 39.6 = 0.9";
  EXPECT_GT(r.outcome.searches, 5u);
  EXPECT_LT(r.outcome.searches, 100u);
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
  // Out to 0.699, then in again: the gap has grown with it, so the way in pushes.
  const Built b(over(0.5, std::string(plain) + " Inacti=5"), Stepped::scene_options());
  std::vector<double> force;
  static_cast<void>(run_steps(
      b.scene, make_state(b.scene), with_step(1e-3), 400,
      [&](std::size_t k, Coordinates& x, State&, CycleOptions&) {
        const double up = 0.001 * static_cast<double>(k < 200 ? k : 400 - k);
        for (const std::int64_t id : {11, 12, 13, 14}) x.z[b.model.nodes.map.find(id)] = 0.5 + up;
      },
      [&](std::size_t, const SceneOutcome& s, const Coordinates&) {
        force.push_back(s.contacts.at(0).totals.normal_abs);
      }));
  EXPECT_EQ(force.at(0), 0.0);
  EXPECT_EQ(force.at(50), 0.0) << "what was taken off the gap is remembered";
  EXPECT_GT(force.at(399), 0.0);
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
  for (std::size_t k = 0; k < a.forces.size(); ++k)
    EXPECT_EQ(std::tie(a.forces[k].normal, a.forces[k].tangential),
              std::tie(b.forces[k].normal, b.forces[k].tangential));
  EXPECT_NE(a.forces.back().normal_abs, 0.0);
}

// Lines, events and searches by hand.

/// The plates with a height of the upper one in each step.
struct Heights {
  std::unique_ptr<Built> built;
  StepsOutcome outcome;
  std::vector<std::vector<PairOutcome>> pairs;
  Heights(const std::string& card, const std::vector<double>& heights, bool moving = true) {
    const double dt = 0.5;
    built = testing::plates_in_contact(card, heights[0]);
    CycleOptions options;
    options.keep_pairs = true;
    options.time = 7;
    options.dt1 = options.dt12 = dt;
    const auto move = [&](std::size_t k, Coordinates& x, State& state, CycleOptions& o) {
      o.time = 7 + 10 * static_cast<double>(k);
      if (state.velocity[2].empty())
        for (auto& v : state.velocity) v.resize(x.z.size(), 0.0);
      for (const std::int64_t id : {11, 12, 13, 14}) {
        const NodeIndex n = built->model.nodes.map.find(id);
        x.z[n] = heights[k];
        state.velocity[2][n] = k == 0 || !moving ? 0 : (heights[k] - heights[k - 1]) / dt;
      }
    };
    const auto look = [&](std::size_t, const SceneOutcome& r, const Coordinates&) {
      pairs.push_back(r.contacts.at(0).pairs);
    };
    outcome =
        run_steps(built->scene, make_state(built->scene), options, heights.size(), move, look);
  }
};

TEST(StepLines, HaveTheFiguresOfTheirEvaluation) {
  const Heights h("@/INTER/TYPE7/1", {0.6, 0.8, 1.5, 0.5}, false);  // at rest: no damping
  ASSERT_EQ(h.outcome.lines.size(), 4u);
  const double k0 = h.pairs[0].at(0).k0;
  const double depths[] = {0.4, 0.2, 0, 0.5}, left[] = {0.6, 0.8, 1, 0.5};
  for (std::size_t k = 0; k < 4; ++k) {
    const StepLine& line = h.outcome.lines[k];
    const StepContact& c = line.contacts.at(0);
    EXPECT_EQ(line.time, 7 + 10 * static_cast<double>(k));
    EXPECT_EQ(line.dt1, 0.5);
    EXPECT_TRUE(c.active);
    EXPECT_EQ(std::tuple(c.pairs_with_force, c.pairs_tied, c.removed),
              std::tuple(k == 2 ? 0u : 4u, 0u, 0u));
    const double force = 4 * 0.5 * k0 * depths[k] / left[k];
    EXPECT_NEAR(c.force_sum, force, 1e-9 * force + 1e-12) << k;
    EXPECT_NEAR(c.normal[2], -force, 1e-9 * force + 1e-12) << k;
    // The potential of the law: K/2 (d - 1 - ln d) for a gap of 1.
    const double energy = 4 * 0.5 * k0 * (left[k] - 1 - std::log(left[k]));
    EXPECT_NEAR(c.elastic_energy, energy, 1e-9 * energy + 1e-12) << k;
    EXPECT_NEAR(c.tangential[0], 0, 1e-9 * force + 1e-12);
  }
  EXPECT_TRUE(h.outcome.events.empty());
  EXPECT_EQ(h.outcome.coordinates.z[h.built->model.nodes.map.find(11)], 0.5);
}

TEST(StepEvents, OfTiesNameThePairWhenItTiesAndWhenItLetsGo) {
  // From outside the gap down by 0.12 and 0.1, up by 0.15 and 0.15: there the force turns.
  const Heights h("@/INTER/TYPE10/1 VISs=0", {1.02, 0.9, 0.8, 0.95, 1.1});
  ASSERT_EQ(h.outcome.events.size(), 8u);
  for (std::uint32_t k = 0; k < 8; ++k) {
    const StepEvent& e = h.outcome.events[k];
    const bool ties = k < 4;
    EXPECT_EQ(std::tuple(e.step, e.time, e.contact, e.kind, e.at.secondary, e.at.main),
              std::tuple(ties ? std::size_t{1} : 4, ties ? 17.0 : 47.0, 0u,
                         ties ? StepEvent::Kind::tied : StepEvent::Kind::let_go, k % 4, 0u));
  }
  const std::size_t tied[] = {0, 4, 4, 4, 0};
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(h.outcome.lines[k].contacts[0].pairs_tied, tied[k]) << k;
}

TEST(StepEvents, OfRemovalsComeOnceAndAreCountedOn) {
  const Heights h("@/INTER/TYPE7/1 dtmin=1000", {0.6, 0.6, 0.6});
  ASSERT_EQ(h.outcome.events.size(), 4u);
  for (std::uint32_t s = 0; s < 4; ++s) {
    const StepEvent& e = h.outcome.events[s];
    EXPECT_EQ(
        std::tuple(e.step, e.kind, e.at.secondary, e.at.main, e.because),
        std::tuple(std::size_t{0}, StepEvent::Kind::removed, s, 0u, Removal::Because::nodal_step));
  }
  for (const StepLine& line : h.outcome.lines) EXPECT_EQ(line.contacts[0].removed, 4u);
  EXPECT_GT(h.outcome.lines[0].contacts[0].force_sum, 0) << "the force of its last cycle stays";
  EXPECT_EQ(h.outcome.lines[1].contacts[0].force_sum, 0);
}

TEST(SearchesOverSteps, AreMadeAgainWhenTheMarginIsUsedUp) {
  const auto searches = [](double margin) {
    const auto b = testing::plates_in_contact("@/INTER/TYPE7/1", 3);
    CycleOptions options;
    options.margin = margin;
    const auto move = [&](std::size_t k, Coordinates& x, State&, CycleOptions&) {
      for (const std::int64_t id : {11, 12, 13, 14})
        x.z[b->model.nodes.map.find(id)] = 3 - 0.25 * static_cast<double>(k);
    };
    return run_steps(b->scene, make_state(b->scene), options, 9, move).searches;
  };
  // Moves of 0, 0.25, ... 2 from the first place: a margin that is reached is used up.
  EXPECT_EQ(searches(0.5), 5u);   // at 0, 0.5, 1, 1.5 and 2
  EXPECT_EQ(searches(0.51), 3u);  // at 0, 0.75 and 1.5
  EXPECT_EQ(searches(5), 1u);
}

TEST(SearchesOverSteps, LookTenStepsAheadButNotBeyondGapAndShortestSide) {
  // Velocity 1, steps of 0.01: a margin of 0.1; with steps of 10 it is 1 + 10.
  const auto searches = [](double dt, std::size_t steps) {
    const auto b = testing::plates_in_contact("@/INTER/TYPE7/1", 300);
    CycleOptions options;
    options.dt1 = options.dt12 = dt;
    return run_steps(b->scene, make_state(b->scene, {{2, {0, 0, -1}}}), options, steps).searches;
  };
  EXPECT_EQ(searches(1.0 / 128, 21), 3u) << "at 0, 10 and 20";
  EXPECT_EQ(searches(8, 5), 3u) << "at 0, 16 and 32: one step of 8 is below 11, two are not";
}

// One evaluation.

TEST(Cylinder, WithoutAnAxisIsNotComputed) {
  const Built b(over(0.5, std::string(plain) + " Icurv=2 node_ID1=11 node_ID2=11"),
                Stepped::scene_options());
  const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), {});
  EXPECT_FALSE(r.contacts.at(0).complete);
  EXPECT_EQ(r.contacts[0].pairs_with_force, 0u);
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
    const deck::Contact& c = b.scene.contacts.at(0);
    const ContactPairs pairs = make_pairs(b.scene, c, make_card(b.scene, c), Model::reference);
    ASSERT_EQ(pairs.size(), 1u);
    // Of node 3: (0, 0, 1) and once or twice the triangle's.
    const double once = std::sqrt(0.5), share = last ? 2.0 : 1.0;
    EXPECT_NEAR(pairs.normal[2][0].at(0), -share * once, 1e-12);
    EXPECT_NEAR(pairs.normal[2][2].at(0), 1 + share * once, 1e-12);
  }
}

TEST(IremI2, DropsThePairsBetweenATiedNodeAndTheSegmentsOfItsTie) {
  struct Case {
    std::vector<int> tied;
    int surface;
    std::size_t left;
  };
  const Case cases[] = {{{11, 12}, 1, 2},  // to the main side of the contact
                        {{11, 12}, 3, 4},  // to a plate of its own, on the other side
                        {{1}, 2, 0}};      // a node of the main side, to the secondary plate
  for (const Case& c : cases)
    for (const int flag : {1, 3}) {
      SmallDeck d = over(0.5, std::string(plain) + " Irem_i2=" + std::to_string(flag));
      d.node(21, 0, 0, 2).node(22, 10, 0, 2).node(23, 10, 10, 2).node(24, 0, 10, 2);
      d.shell_part(3, 1.0).shell(3, 9, 21, 22, 23, 24).group("/SURF/PART/3", {3});
      d.group("/SURF/PART/2", {2}).group("/GRNOD/NODE/3", c.tied);
      d.add("/INTER/TYPE2/9\nt\n         3" + fmt::sprintf("%10d", c.surface));
      const Built b(d, Stepped::scene_options());
      const SceneOutcome r = run_cycle(b.scene, make_state(b.scene), {});
      EXPECT_EQ(r.contacts.at(0).pairs_with_force, flag == 1 ? c.left : 4u) << c.surface;
    }
}

TEST(Account, EffectsThatNeverActAreOffWithTheReason) {
  ContactCard card;
  card.fric = 0.2;
  const auto expect = [&](const char* name, bool on, const char* reason = "") {
    for (const EffectState& e : effect_plan(card)) {
      if (e.name != name) continue;
      EXPECT_EQ(e.on, on) << name;
      EXPECT_NE(e.reason.find(reason), std::string::npos) << e.reason;
    }
  };
  card.itied = 1;
  expect("tie-on-time-step", false, "dtmin = 0");
  card.dtmin = 1e-3;
  expect("tie-on-time-step", true);
  card.ithe = 1;
  card.fheatm = 0.5;
  expect("friction-heat", false, "is lost");
  card.ithe_form = 1;
  expect("friction-heat", true);
  for (const auto& [ifiltr, xfreq] : {std::pair(3, 100.0), {1, 1.0}, {1, 0.3}}) {
    card.ifiltr = ifiltr;
    card.xfreq = xfreq;
    expect("friction-filter", xfreq == 0.3);
  }
  card.ascalef = 2;
  expect("friction-temperature-scale", false, "never");
}

}  // namespace
}  // namespace deck::cycle
