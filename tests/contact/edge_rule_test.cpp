// The rule of TYPE25 for edges of sheets against exact arithmetic: the families of hard cases, free
// edges with their ends moved, and a touch that only round-off turns into contact.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "accuracy/shared/accuracy.hpp"
#include "contact/exactness.hpp"
#include "contact/shared/exact_number.hpp"
#include "contact/type24_25/edge_rule.hpp"
#include "contact/type24_25/through_rule.hpp"

namespace deck::test {
namespace {

using namespace detail::type24_25;

double single(double v) { return static_cast<double>(static_cast<float>(v)); }

/// A direction across an edge, in single precision, and what the border does at its ends.
void make_free(RuleEdge& e, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  const Vec along = unit(e.end[1] - e.end[0]), other{any(random), any(random), any(random)};
  const Vec beta = unit(cross(along, other));
  e.beta = {single(beta.x), single(beta.y), single(beta.z)};
  e.one_sided = true;
  for (Vec& b : e.border) {
    const double turn = any(random);
    b = {single(e.beta.x + turn * along.x), single(e.beta.y + turn * along.y),
         single(e.beta.z + turn * along.z)};
  }
}

TEST(EdgeRule, HardCasesAreJudgedAsExactArithmeticDoes) {
  Judged judged;
  EXPECT_GE(hard_families().size(), 40u);
  for (const HardFamily& family : hard_families()) {
    std::mt19937 random(static_cast<unsigned>(family.id));
    for (const PairSample& p : hard_cases(family.id, 60)) {
      if (!p.edges || !(p.gap > 0) || !std::isfinite(p.gap)) continue;
      EdgeRule inner;
      inner.secondary.end = {p.x[0], p.x[1]};
      inner.main.end = {p.x[2], p.x[3]};
      inner.secondary.gap = 0.25 * p.gap;
      inner.main.gap = 0.75 * p.gap;
      EdgeRule free = inner;
      make_free(free.main, random);
      EdgeRule moved = free;
      moved.main.recessed = true;
      moved.main.inward = 0.1 * p.gap;
      make_free(moved.secondary, random);
      for (const EdgeRule& r : {inner, free, moved}) {
        if (!is_finite(r)) continue;
        const EdgeFigures quick = evaluate_edges(r, true);
        judged.add(quick.penetration > 0, quick.doubtful, exact_edge_pair(r).penetrates,
                   family.name);
      }
    }
  }
  judged.expect(500, 5);
}

/// A direction of unit length in single precision.
Vec any_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  const Vec v = unit({any(random), any(random), any(random)});
  return {single(v.x), single(v.y), single(v.z)};
}

// Edges and faces of solids on a lattice, many in planes or parallel; each seen by both rules.
TEST(EdgeRule, EdgesThroughSolidsAreJudgedAsExactArithmeticDoes) {
  std::mt19937 random(7);
  std::size_t passes = 0, told = 0, all = 0, differ = 0;
  const auto root = [](const Rational& square) { return long_square_root(square); };
  const auto place = [&](double step) {
    const auto number = [&] {
      return step * static_cast<double>(static_cast<int>(random() % 7) - 3);
    };
    return Vec{number(), number(), number()};
  };
  for (int i = 0; i < 6000; ++i) {
    ThroughRule r;
    const double step = i % 3 == 0 ? 1 : i % 3 == 1 ? 0.1 : 1e3 / 7;
    for (Vec& v : r.corner) v = place(step);
    r.triangle = i % 4 == 0;
    if (r.triangle) r.corner[3] = r.corner[2];
    r.side = r.triangle ? 0 : static_cast<std::size_t>(i) % 4;
    r.edge = {place(step), place(step)};
    r.gap = r.margin = 0.5 * step;
    r.of_solids = i % 2 == 0;
    r.beta = any_direction(random);
    for (auto* pair : {&r.edge_normal, &r.side_normal})
      for (Vec& v : *pair) v = any_direction(random);
    std::uint64_t exact = 0;
    const bool quick = exact_through(r, false, exact).passes;
    told += exact == 0 ? 1 : 0;
    Rational depth(0);
    const bool truth = ThroughSide<Rational, decltype(root)>(r, root).passes(depth);
    EXPECT_EQ(quick, truth) << i;
    const ThroughFigures solver = evaluate_through(r), figures = exact_through(r, true, exact);
    EXPECT_EQ(figures.passes, truth) << i;
    differ += solver.passes != truth ? 1 : 0;
    if (solver.passes && truth) {
      EXPECT_NEAR(solver.depth, figures.depth, 1e-9 * step);
    }
    passes += truth ? 1 : 0;
    ++all;
  }
  EXPECT_GT(passes, 30u);
  EXPECT_GT(differ, 0u) << "there are hard cases among them";
  EXPECT_GT(told, all / 2) << "intervals know something";
}

/// Inner edges of two folded sheets, 3 apart along (2, -2, 1) / 3, with the sum of their gaps 3.
SmallDeck crossing_edges(double side) {
  const double x = 7 * side;
  SmallDeck d;
  // Each the middle of a folded sheet: an inner edge along (1, 2, 2) and (2, 1, -2).
  d.node(1, x - side, 3 - 2 * side, -5 - 2 * side).node(2, x + side, 3 + 2 * side, -5 + 2 * side);
  d.node(3, x + side, 3 - side, -5 - 4 * side).node(4, x - side - 3, 3 + side, -5 - 4 * side);
  d.node(11, x + 2 - 2 * side, 1 - side, -4 + 2 * side);
  d.node(12, x + 2 + 2 * side, 1 + side, -4 - 2 * side);
  d.node(13, x + 40 * side, 1 - 30 * side, -4).node(14, x + 40 * side, 1 - 30 * side, -4 + side);
  d.shell_part(1, 4).shell_part(2, 2);
  d.shell3(1, 1, 1, 2, 3).shell3(1, 2, 2, 1, 4).shell3(2, 3, 11, 12, 13).shell3(2, 4, 12, 11, 14);
  d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
  return d.add("@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5 Iedge=2");
}

TEST(EdgeRule, ATouchThatOnlyRoundOffTurnsIntoContactIsListed) {
  std::uint64_t differ = 0, decided = 0;
  for (int k = 0; k < 40; ++k) {
    const DecisionReport r = expect_agreeing(crossing_edges(9 + 0.1 * k), ContactRole::edges);
    decided += r.exact;
    differ += r.contact_differs;
  }
  EXPECT_GT(decided, 0u);
  EXPECT_GT(differ, 0u);
}

}  // namespace
}  // namespace deck::test
