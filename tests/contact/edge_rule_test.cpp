// The rule of TYPE25 for edges of sheets against exact arithmetic: the families of hard cases, free
// edges with their ends moved, and a touch that only round-off turns into contact.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "accuracy/shared/accuracy.hpp"
#include "contact/modern/edge_rule.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

using namespace detail::modern;

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
  std::size_t families = 0, all = 0, sure = 0, differ = 0;
  for (const HardFamily& family : hard_families()) {
    ++families;
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
        const ExactEdgePair exact = exact_edge_pair(r);
        ++all;
        differ += (quick.penetration > 0) != exact.penetrates ? 1 : 0;
        if (quick.doubtful) continue;
        ++sure;
        EXPECT_EQ(quick.penetration > 0, exact.penetrates) << family.name;
      }
    }
  }
  EXPECT_GE(families, 40u);
  EXPECT_GT(all, 500u);
  EXPECT_GT(differ, 0u) << "there are hard cases among them";
  EXPECT_GT(sure, all / 5) << "the quick way knows something";
  std::cout << sure << " of " << all << " decided without exact numbers, double wrong in " << differ
            << "\n";
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
    const SmallDeck d = crossing_edges(9 + 0.1 * k);
    const Built b(d);
    decided += b.scene.decisions.exact;
    const Contact& edges = b.contact(1, ContactRole::edges);
    std::size_t in_contact = 0;
    for (const PenetrationRow& r : edges.penetrations) {
      in_contact += r.in_contact ? 1 : 0;
      differ += r.in_contact ? 0 : 1;
    }
    SceneOptions o;
    o.accuracy = Accuracy::exact;
    const Built exact(d, o);
    EXPECT_EQ(exact.contact(1, ContactRole::edges).penetrations.size(), in_contact) << k;
    o.accuracy = Accuracy::reference;
    const Built plain(d, o);
    std::size_t acts = 0;
    for (const PenetrationRow& r : edges.penetrations)
      acts += r.action == PenetrationAction::none ? 0 : 1;
    EXPECT_EQ(plain.contact(1, ContactRole::edges).penetrations.size(), acts) << k;
  }
  EXPECT_GT(decided, 0u);
  EXPECT_GT(differ, 0u);
}

}  // namespace
}  // namespace deck::test
