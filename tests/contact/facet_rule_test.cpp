// The facet rule of TYPE25 against exact arithmetic: the families of hard cases, places that the
// solver's round-off judges wrongly, and meshes that lie on each other's lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include "accuracy/shared/accuracy.hpp"
#include "contact/modern/parts.hpp"
#include "contact/search/sweep.hpp"
#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

using namespace detail::modern;

/// A node and a sheet of one segment, seen from both sides.
struct OneSegment {
  Coordinates x;
  Sides sides;
  OneSegment(const PairSample& p, int ishape, double share) {
    for (const auto& at : p.x) {
      x.x.push_back(at.x);
      x.y.push_back(at.y);
      x.z.push_back(at.z);
    }
    sides.set.level = 3;
    sides.set.ishape = ishape;
    Face face;
    face.nodes = {0, 1, 2, p.triangle ? 2U : 3U};
    face.opposite = 1;
    face.stiffness = face.back_stiffness = 1;
    face.gap = (1 - share) * p.gap;
    sides.faces = {face};
    sides.mirrors = {0};
    sides.main_gap.assign(5, face.gap);
    sides.nodes = {{4, 0, share * p.gap, never}};
  }
  sweep::NearDistance near() const {
    const std::vector<std::uint32_t> nodes{4};
    const std::vector<Quad> segments{sides.faces[0].nodes};
    NodeSegmentInput in;
    in.nodes = {x.x, x.y, x.z};
    in.secondary = nodes;
    in.segments = segments;
    sweep::NearDistance out;
    const CandidatePair pair{0, 0};
    sweep::kernels().distances(in, std::span(&pair, 1), &out);
    return out;
  }
};

/// Whether double arithmetic finds a penetration; nullopt: it does not know.
std::optional<bool> judged(const OneSegment& one, const Topology& t) {
  const sweep::NearDistance near = one.near();
  bool found = false;
  for (std::uint32_t face = 0; face < 2; ++face) {
    if ((face == 0 ? near.side : -near.side) < 0) continue;
    const unsigned m = near.nearest;
    const unsigned facets = face == 0 ? m : (m & 5U) | (m >> 2 & 2U) | (m << 2 & 8U);
    const PairFigures p =
        evaluate_pair(one.x, one.sides, t, one.sides.nodes[0], face, facets, near.slack);
    if (p.doubtful) return std::nullopt;
    if (p.behind > 0 || p.excluded) continue;
    found = found || p.penetration > 0;
  }
  return found;
}

TEST(FacetRule, HardCasesAreJudgedAsExactArithmeticDoes) {
  std::size_t families = 0, all = 0, sure = 0;
  for (const HardFamily& family : hard_families()) {
    ++families;
    std::size_t of_family = 0;
    for (const PairSample& p : hard_cases(family.id, 40)) {
      if (p.edges || !(p.gap > 0) || !std::isfinite(p.gap)) continue;
      for (const int ishape : {1, 2}) {
        const OneSegment one(p, ishape, ishape == 1 ? 0.5 : 0.25);
        const Topology t(one.x, one.sides, 1);
        std::vector<FacetRule> rules;
        for (std::uint32_t face = 0; face < 2; ++face)
          rules.push_back(facet_rule(one.x, one.sides, t, one.sides.nodes[0], face));
        if (!std::all_of(rules.begin(), rules.end(), is_finite)) continue;
        const std::optional<bool> quick = judged(one, t);
        ++all;
        ++of_family;
        const auto exact = exact_choice(rules, quick.value_or(false));
        if (!quick) continue;
        ++sure;
        EXPECT_EQ(*quick, exact && exact->penetrates) << family.name << " " << of_family;
      }
    }
  }
  EXPECT_GE(families, 40u);
  EXPECT_GT(all, 1000u);
  EXPECT_GT(sure, all / 10) << "the quick way knows something";
  std::cout << sure << " of " << all << " decided without exact numbers\n";
}

// Plainly inside and plainly outside, in exact arithmetic.
TEST(FacetRule, PlacesAroundASheetExactly) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0);
  d.node(101, 5, 5, 1.4).node(102, 10.8, 5, 0.2).node(103, 10.3, 5, 0.5).node(104, 5, 5, 2);
  d.shell_part(1, 2).shell_part(2, 1.5).shell(1, 1, 1, 2, 3, 4);
  for (int i = 0; i < 4; ++i) {
    d.node(201 + 2 * i, 0, 0, 200 + i).node(202 + 2 * i, 1, 0, 300 + i);
    d.shell3(2, 101 + i, 101 + i, 201 + 2 * i, 202 + 2 * i);
  }
  d.group("/GRNOD/NODE/1", {101, 102, 103, 104}).group("/SURF/PART/2", {1});
  d.add("@/INTER/TYPE25/1 surf_ID2=2 grnd_IDs=1 Inacti=5");
  SceneOptions o;
  o.accuracy = Accuracy::exact;
  const Built b(d, o);
  ASSERT_EQ(b.contact().penetrations.size(), 2u);
  EXPECT_NEAR(b.row(b.contact(), 101)->depth, 0.35, 1e-12);
  EXPECT_NEAR(b.row(b.contact(), 103)->depth, 0.45, 1e-7);
  EXPECT_GT(b.scene.decisions.exact, 0u);
}

/// A node at the gap of 3 from a tilted sheet with the normal (2, -2, 1) / 3.
SmallDeck touching(double side) {
  const double x = 7 * side;
  SmallDeck d;
  d.node(1, x, 3, -5).node(2, x + side, 3 + 2 * side, -5 + 2 * side);
  d.node(3, x + 3 * side, 3 + 3 * side, -5).node(4, x + 2 * side, 3 + side, -5 - 2 * side);
  d.node(101, x + 5 + 2, 7 - 2, -7 + 1);
  d.shell_part(1, 6).shell(1, 1, 1, 2, 3, 4);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101});
  return d.add("@/INTER/TYPE25/1 surf_ID2=1 grnd_IDs=2 Inacti=5");
}

TEST(FacetRule, ATouchThatOnlyRoundOffTurnsIntoContactIsListed) {
  int differ = 0;
  for (int side = 7; side < 60; ++side) {
    const SmallDeck d = touching(side);
    const Built b(d);
    for (const PenetrationRow& r : b.contact().penetrations) EXPECT_FALSE(r.in_contact) << side;
    const DecisionReport& report = b.scene.decisions;
    EXPECT_EQ(report.contact_differs, b.contact().penetrations.size());
    EXPECT_GT(report.exact, 0u);
    differ += static_cast<int>(report.contact_differs);
    for (const DecisionDifference& x : report.differences) {
      EXPECT_FALSE(x.exact);
      EXPECT_EQ(x.exact_distance, 3.0);
      EXPECT_LE(x.solver_distance, 3.0) << "or the gap is more, by round-off";
      EXPECT_EQ(x.action, PenetrationAction::offset_stored) << "the solver stores it";
    }
    SceneOptions o;
    o.accuracy = Accuracy::exact;
    EXPECT_EQ(Built(d, o).contact().penetrations.size(), 0u) << side;
    o.accuracy = Accuracy::reference;
    EXPECT_EQ(Built(d, o).contact().penetrations.size(), b.contact().penetrations.size());
  }
  EXPECT_GT(differ, 0);
}

// Nodes over corners, sides and diagonals of the other sheet: equally near segments and facets.
TEST(FacetRule, MeshesOnEachOthersLinesNeedNoExactNumbers) {
  for (const double raised : {0.6, 0.8}) {
    SmallDeck d;
    for (int sheet = 0; sheet < 2; ++sheet)
      for (int i = 0; i < 13; ++i)
        for (int j = 0; j < 13; ++j)
          d.node(1000 * sheet + 13 * i + j + 1, i + 0.5 * sheet, j + 0.5 * sheet, raised * sheet);
    d.shell_part(1, 0.8).shell_part(2, 0.8);
    for (int sheet = 0; sheet < 2; ++sheet)
      for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) {
          const int a = 1000 * sheet + 13 * i + j + 1;
          d.shell(sheet + 1, a, a, a + 13, a + 14, a + 1);
        }
    d.group("/SURF/PART/1", {1}).group("/SURF/PART/2", {2});
    d.add("@/INTER/TYPE25/1 surf_ID1=1 surf_ID2=2 Inacti=5");
    const Built b(d);
    SceneOptions o;
    o.accuracy = Accuracy::exact;
    const Built exact(d, o);
    ASSERT_EQ(b.contact().penetrations.size(), exact.contact().penetrations.size());
    for (std::size_t i = 0; i < b.contact().penetrations.size(); ++i) {
      EXPECT_TRUE(b.contact().penetrations[i].in_contact);
      EXPECT_EQ(b.contact().penetrations[i].secondary, exact.contact().penetrations[i].secondary);
    }
    EXPECT_EQ(b.contact().penetrations.empty(), raised == 0.8);
    // At the gap only borders need them.
    EXPECT_LE(2 * b.scene.decisions.exact, raised == 0.8 ? b.scene.decisions.pairs : 0) << raised;
  }
}

}  // namespace
}  // namespace deck::test
