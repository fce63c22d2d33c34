// The rule of TYPE24 against exact arithmetic: the families of hard cases, penetrations that only
// round-off rejects; and both types on meshes at random.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "accuracy/shared/accuracy.hpp"
#include "contact/exactness.hpp"
#include "contact/type24_25/patch_rule.hpp"

namespace deck::test {
namespace {

using namespace detail::type24_25;

/// A node and one segment of a sheet, seen from both sides, or of a solid.
std::vector<PatchRule> rules_of(const PairSample& p, bool solid, double share) {
  PatchRule r;
  r.node = p.x[4];
  for (std::size_t k = 0; k < 4; ++k) r.corner[k] = p.x[k];
  if (p.triangle) r.corner[3] = r.corner[2];
  r.node_gap = share * p.gap;
  r.segment_gap = (1 - share) * p.gap;
  r.accepted = r.limit = 0.75 * p.gap;
  r.solid = solid;
  r.never_blocks = solid && share > 0;
  if (solid) {
    r.by_direction = true;
    r.direction = {0.6, 0, -0.8};
    if (share == 0) r.segment_gap = 0, r.accepted = r.limit = p.gap;
    return {r};
  }
  PatchRule back = r;
  const auto& c = r.corner;
  back.corner =
      p.triangle ? std::array{c[1], c[0], c[2], c[2]} : std::array{c[1], c[0], c[3], c[2]};
  return {r, back};
}

TEST(PatchRule, HardCasesAreJudgedAsExactArithmeticDoes) {
  Judged judged;
  EXPECT_GE(hard_families().size(), 40u);
  for (const HardFamily& family : hard_families()) {
    for (const PairSample& p : hard_cases(family.id, 10)) {
      if (p.edges || !(p.gap > 0)) continue;
      for (const int kind : {0, 1, 2}) {  // sheet, solid, solid without a gap
        const auto rules = rules_of(p, kind > 0, kind == 1 ? 0.25 : kind == 2 ? 0 : 0.5);
        if (!is_finite(rules.front())) continue;
        for (const bool nearest : {true, false}) {
          const PatchChoice quick = choose_pair(rules, nearest, true);
          judged.add(quick.penetrates, quick.doubtful,
                     exact_node(rules, nearest, quick.pair).penetrates,
                     family.name + std::to_string(kind) + (nearest ? " nearest" : ""));
        }
      }
    }
  }
  judged.expect(1000, 5);
}

/// Up to three segments around a place, of sheets and solids with all that may be true of them.
/// `nearest`: with Inacti; without, parts and directions do not matter and nothing blocks.
std::vector<PatchRule> any_rules(std::mt19937& random, bool nearest) {
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return Vec{number(random), number(random), number(random)}; };
  const auto one_of = [&](unsigned count) { return random() % count == 0; };
  std::vector<PatchRule> out(1 + random() % 3);
  const double gap = 0.3, accepted = nearest && one_of(2) ? 0.4 : 1e30;
  for (PatchRule& r : out) {
    const Vec u = Vec{3, 0, 0} + 0.6 * vector(), v = Vec{0, 3, 0} + 0.6 * vector();
    const Vec o = 0.5 * vector();
    r.corner = {o - u - v, o + u - v, o + u + v + 0.3 * vector(), o - u + v};
    if (one_of(4)) r.corner[3] = r.corner[2];
    if (one_of(2)) std::swap(r.corner[1], r.corner[3]);
    r.solid = one_of(2);
    r.node_gap = gap;
    r.segment_gap = one_of(2) ? 0.5 : 0;
    r.accepted = accepted;
    r.limit = nearest ? accepted : 0.6;
    r.own_solid = one_of(6);
    r.rejects_part = nearest && one_of(6);
    r.never_blocks = !nearest || one_of(2);
    r.by_direction = nearest && r.solid && one_of(2);
    r.direction = vector();
  }
  return out;
}

TEST(PatchRule, NodesAreInDoubtWhereRoundOffDecides) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> along(-4, 4), up(-1.5, 1.5);
  std::size_t met = 0, doubtful = 0, plain = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const bool nearest = scene % 4 != 0;
    std::vector<PatchRule> rules = any_rules(random, nearest);
    const auto put = [&](const Vec& p) {
      for (PatchRule& r : rules) r.node = p;
    };
    const auto seen = [&](const Vec& p) {
      put(p);
      const PatchChoice c = choose_pair(rules, nearest, false);
      return std::pair(c.penetrates, c.penetrates ? c.pair : 0);
    };
    const auto expect_exact = [&](const Vec& p) {
      put(p);
      const PatchChoice quick = choose_pair(rules, nearest, true);
      if (quick.doubtful) return true;
      EXPECT_EQ(quick.penetrates, exact_node(rules, nearest, quick.pair).penetrates) << scene;
      return false;
    };
    Vec a{along(random), along(random), up(random)}, b{along(random), along(random), up(random)};
    plain += expect_exact(a) + expect_exact(b);
    const auto of_a = seen(a);
    if (seen(b) == of_a) continue;
    for (int step = 0; step < 60; ++step) {
      const Vec middle = 0.5 * (a + b);
      (seen(middle) == of_a ? a : b) = middle;
    }
    for (const Vec& p : {a, b}) {
      doubtful += expect_exact(p);
      ++met;
    }
  }
  EXPECT_LT(plain, 40u) << "few of 800 places at random are in doubt";
  EXPECT_GT(met, 100u);
  EXPECT_GT(doubtful, met / 4);
}

TEST(PatchRule, JudgesSegmentsOfSheetsAndSolids) {
  constexpr double t = tiny_penetration;
  PatchRule sheet, solid;
  sheet.accepted = 1;
  solid.solid = true;
  solid.limit = 1;
  const auto with = [](PatchRule r, bool PatchRule::*flag) {
    r.*flag = true;
    return r;
  };
  const PatchRule part = with(sheet, &PatchRule::rejects_part),
                  open = with(sheet, &PatchRule::never_blocks),
                  own = with(solid, &PatchRule::own_solid),
                  turned = with(solid, &PatchRule::by_direction);
  constexpr bool yes = true, no = false;
  const struct {
    PatchRule rule;
    double height;
    bool outside, same_way;
    double penetration;
    bool exists, blocks;
    double distance;  ///< 7: the distance of the place
  } rows[] = {
      {sheet, 1.5, no, no, 0.5, yes, yes, 0.5},
      {sheet, 1, no, yes, 1, yes, yes, 1},
      {sheet, 0.5, no, no, -1.5 - t, yes, no, 1.5},
      {sheet, -1.5, no, no, -0.5 - t, yes, yes, 3.5},
      {sheet, 2, no, no, 0, yes, yes, 7},
      {sheet, 3, no, no, -1, yes, yes, 7},
      {sheet, 1.5, yes, no, 0, no, yes, 7},
      {part, 1.5, no, no, -0.5 - t, yes, yes, 0.5},
      {part, 2, no, no, -t, yes, yes, 7},
      {part, 3, no, no, -1, yes, yes, 7},
      {open, 1.5, no, no, 0.5, yes, no, 0.5},
      {solid, 1.5, no, no, 0.5, yes, yes, 7},
      {solid, 1.5, no, yes, 0.5, yes, yes, 7},
      {solid, 1, no, no, -1 - t, yes, no, 7},
      {solid, -1, no, no, -3 - t, yes, no, 7},
      {solid, 3, no, no, -1, yes, yes, 7},
      {solid, 1.5, yes, no, -0.5 - t, yes, yes, 7},
      {solid, 3, yes, no, -1 - t, yes, yes, 7},
      {own, 1.5, no, no, -0.5 - t, yes, no, 7},
      {own, 2, no, no, -t, yes, no, 7},
      {own, 3, no, no, -1, yes, yes, 7},
      {own, 1.5, yes, no, -0.5 - t, yes, yes, 7},
      {turned, 1.5, no, no, 0.5, yes, yes, 7},
      {turned, 1.5, no, yes, -0.5 - t, yes, no, 7},
      {turned, 3, no, yes, -1, yes, yes, 7},
  };
  for (const auto& row : rows) {
    const PatchResult<double> r =
        judge_patch<double>(row.rule, 2, row.height, 7, row.outside, row.same_way);
    EXPECT_EQ(std::tuple(r.penetration, r.exists, r.blocks, r.distance),
              std::tuple(row.penetration, row.exists, row.blocks, row.distance))
        << &row - rows;
  }
}

/// A penetration; a segment that keeps farther ones away.
PatchResult<double> hit(double depth, double distance) {
  PatchResult<double> r;
  r.penetration = depth;
  r.distance = distance;
  return r;
}
PatchResult<double> block(double distance) { return hit(-1, distance); }

TEST(PatchRule, OfTheSegmentsOfANodeTheNearestDecides) {
  PatchState<double> state(true, 1);
  PatchResult<double> passive = block(0.1), missing = hit(0.5, 0.1);
  passive.blocks = false;
  missing.exists = false;
  const std::tuple<PatchResult<double>, bool, bool> steps[] =
      {{hit(1.5, 0.2), false, false},  // deeper than what is accepted
       {hit(1, 4), true, true},        {hit(0.5, 4), false, true},
       {hit(0.5, 3), true, true},      {hit(0.4, 2.5), true, true},
       {block(2.5), false, true},      {passive, false, true},
       {missing, false, true},         {block(2.25), false, false},
       {hit(0.5, 2.25), false, false}, {hit(0.5, 2), true, true},
       {hit(5e-9, 1.5), false, false},  // as good as nothing: it blocks
       {hit(0.5, 1.5), false, false},  {hit(2e-8, 1.25), true, true}};
  for (const auto& [result, taken, found] : steps) {
    EXPECT_EQ(state.accept(result), taken) << &result - &std::get<0>(steps[0]);
    EXPECT_EQ(state.found(), found);
  }
}

TEST(PatchRule, WithInacti0TheSmallestPenetrationBeforeAnyBlockDecides) {
  PatchState<double> blocked(false, 1e30);
  EXPECT_FALSE(blocked.accept(block(2)));
  EXPECT_FALSE(blocked.accept(hit(0.5, 1)));
  EXPECT_FALSE(blocked.found());
  PatchState<double> state(false, 1e30);
  const std::pair<PatchResult<double>, bool> steps[] = {
      {hit(0.5, 9), true}, {hit(0.6, 1), false}, {hit(0.5, 1), false}, {hit(0.4, 9), true},
      {block(0.4), false}, {hit(0.35, 1), true}, {block(0.3), false},  {hit(0.1, 0.1), false}};
  for (const auto& [result, taken] : steps) {
    EXPECT_EQ(state.accept(result), taken) << result.penetration;
    EXPECT_TRUE(state.found());
  }
}

/// A node 1.5 over a tilted sheet with the gap 3: its penetration is the deepest that counts.
SmallDeck deepest(double side) {
  SmallDeck d = tilted_sheet(side, 6);
  const double x = 7 * side;
  d.node(101, x + 1.5 * side + 1, 3 + 1.5 * side - 1, -5 + 0.5);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101});
  return d.add("@/INTER/TYPE24/1 surf_ID2=1 grnd_IDs=2 Inacti=5");
}

TEST(PatchRule, ADeepPenetrationThatOnlyRoundOffRejectsIsListed) {
  std::uint64_t differ = 0, decided = 0;
  for (int k = 0; k < 60; ++k) {
    const DecisionReport report = expect_agreeing(deepest(7 + 0.1 * k));
    decided += report.exact;
    differ += report.contact_differs;
    for (const DecisionDifference& x : report.differences) {
      EXPECT_NEAR(x.exact_distance, 1.5, 1e-9);
      EXPECT_NEAR(x.solver_distance, x.exact_distance, 1e-9);
    }
  }
  EXPECT_GT(decided, 0u);
  EXPECT_GT(differ, 0u);
}

TEST(PatchRule, MeshesOnALatticeAreJudgedAsExactArithmeticDoes) {
  std::size_t found = 0, decided = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SmallDeck d = on_a_lattice(seed);
    d.add("@/INTER/TYPE24/1 surf_ID1=1 surf_ID2=2 Inacti=5");
    d.add("@/INTER/TYPE24/2 surf_ID1=3 Inacti=5 Ipen0=1");
    d.add("@/INTER/TYPE24/3 surf_ID1=3");
    d.add("@/INTER/TYPE25/4 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=2");
    d.add("@/INTER/TYPE25/5 surf_ID1=3 Inacti=5 Iedge=2 Igap0=1 Ishape=2");
    d.add("@/INTER/TYPE25/6 surf_ID1=1 surf_ID2=2 Inacti=5 IVIS2=-1");
    SceneOptions o;
    const Built robust(d, o);
    o.accuracy = Accuracy::exact;
    const Built exact(d, o);
    decided += robust.scene.decisions.exact;
    ASSERT_EQ(robust.scene.contacts.size(), 8u);
    for (std::size_t c = 0; c < robust.scene.contacts.size(); ++c) {
      const auto a = in_contact(robust.scene.contacts[c]);
      EXPECT_EQ(a, in_contact(exact.scene.contacts[c])) << seed << " " << c;
      EXPECT_FALSE(a.empty());
      found += a.size();
    }
  }
  EXPECT_GT(found, 200u);
  EXPECT_GT(decided, 0u);
}

}  // namespace
}  // namespace deck::test
