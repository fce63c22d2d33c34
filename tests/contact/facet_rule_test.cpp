// The facet rule of TYPE25 against exact arithmetic: the families of hard cases, places that the
// solver's round-off judges wrongly, and meshes that lie on each other's lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "accuracy/shared/accuracy.hpp"
#include "contact/exactness.hpp"
#include "contact/search/sweep.hpp"
#include "contact/type24_25/type24_25.hpp"

namespace deck::test {
namespace {

using namespace detail::type24_25;

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
    sides.nodes = {{4, 0, share * p.gap, no_limit}};
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

void hold(const PairSample& p, int ishape, double share, const char* what, Judged& answers) {
  const OneSegment one(p, ishape, share);
  const Topology t(one.x, one.sides);
  std::vector<FacetRule> rules;
  for (std::uint32_t face = 0; face < 2; ++face)
    rules.push_back(facet_rule(one.x, one.sides, t, one.sides.nodes[0], face));
  if (!std::all_of(rules.begin(), rules.end(), [](const auto& r) { return is_finite(r); })) return;
  const std::optional<bool> quick = judged(one, t);
  const auto exact = exact_choice(rules, quick.value_or(false));
  answers.add(quick.value_or(false), !quick, exact && exact->penetrates, what);
}

TEST(FacetRule, HardCasesAreJudgedAsExactArithmeticDoes) {
  Judged answers;
  EXPECT_GE(hard_families().size(), 40u);
  for (const HardFamily& family : hard_families())
    for (const PairSample& p : hard_cases(family.id, 40)) {
      if (p.edges || !(p.gap > 0) || !std::isfinite(p.gap)) continue;
      for (const int ishape : {1, 2})
        hold(p, ishape, ishape == 1 ? 0.5 : 0.25, family.name, answers);
    }
  answers.expect(1000, 10);
}

// On the line from the centre through a corner, beyond it: the sign of a weight chooses the facet;
// and at the rim of the gap, beyond the border: the shape of the rim jumps at the corner.
TEST(FacetRule, RoundOffBeyondACornerIsADoubt) {
  Judged answers;
  const Vec tilted[] = {{0, 0, 1}, {2, 0, 1}, {2, 2, -1}, {0, 2, -1}};
  const double w = 0.1 + 0.2;
  const Vec bent[] = {{0, 0, -0.1}, {w, 0, -0.1}, {w, 0.2, -0.1}, {0, 0.2, 0.1}};
  const auto at = [](const Vec(&c)[4], const Vec& node, double gap) {
    return PairSample{{c[0], c[1], c[2], c[3], node}, false, false, gap};
  };
  hold(at(tilted, {2.75, 3.144457318174791, -1.355542681825209}, 2), 1, 0.5, "facet", answers);
  hold(at(bent, {0.3612852480268417, 0.31341106397986884, -0.2143221279597376}, 0.2), 1, 0.5, "rim",
       answers);
}

// On the limits of what the solver looks at, and one step of the last digit from them.
TEST(FacetRule, PairsOnTheLimitsOfTheSearchAreToldApart) {
  SearchRule r;
  r.corner = {Vec{0, 0, 0}, Vec{3, 0, 0}, Vec{3, 3, 0}, Vec{0, 3, 0}};
  r.box = r.cells = {0.1, 0.2, 0.3};  // more than 0.6, less than their sum in double
  const SearchGrid one_cell{{-10, -10, -10}, {20, 20, 20}, {1, 1, 1}};
  const auto looked = [&](double z) {
    r.node = {1.5, 1.5, z};
    return is_considered(r, one_cell);
  };
  EXPECT_GT(0.1 + 0.2 + 0.3, 0.6);
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(looked(sign * 0.6));
    EXPECT_FALSE(looked(sign * (0.1 + 0.2 + 0.3))) << "a distance is less than the reach";
    EXPECT_TRUE(is_in_box({1.5, 1.5, sign * 0.6}, r.corner, r.box));
  }
  r.most_gap = 0.25;
  EXPECT_TRUE(looked(0.54));
  EXPECT_FALSE(looked(0.55)) << "0.25 and a little less than 0.3";
  r.most_gap = 1e300;
  // Cells of thirds from 0 to 1: the box ends in the first, just short of the second.
  const SearchGrid thirds{{0, -10, -10}, {1, 20, 20}, {3, 1, 1}};
  r.corner = {Vec{0.1, 0, 0}, Vec{0.2, 0, 0}, Vec{0.2, 3, 0}, Vec{0.1, 3, 0}};
  r.box = {0.1, 0.2, 0.3};
  r.cells = {0, 0, 0.125};
  const auto in_cells = [&](double x) {
    r.node = {x, 1.5, 0};
    return is_considered(r, thirds);
  };
  EXPECT_TRUE(in_cells(1.0 / 3)) << "the double is less than a third";
  EXPECT_FALSE(in_cells(std::nextafter(1.0 / 3, 1.0)));
}

/// A node at the gap of 3 from a tilted sheet.
SmallDeck touching(double side) {
  SmallDeck d = tilted_sheet(side, 6);
  d.node(101, 7 * side + 5 + 2, 7 - 2, -7 + 1);
  d.group("/SURF/PART/1", {1}).group("/GRNOD/NODE/2", {101});
  return d.add("@/INTER/TYPE25/1 surf_ID2=1 grnd_IDs=2 Inacti=5");
}

TEST(FacetRule, ATouchThatOnlyRoundOffTurnsIntoContactIsListed) {
  std::uint64_t differ = 0;
  for (int side = 7; side < 60; ++side) {
    const DecisionReport report = expect_agreeing(touching(side));
    EXPECT_GT(report.exact, 0u);
    differ += report.contact_differs;
    for (const DecisionDifference& x : report.differences) {
      EXPECT_FALSE(x.exact);
      EXPECT_EQ(x.exact_distance, 3.0);
      EXPECT_LE(x.solver_distance, 3.0) << "or the gap is more, by round-off";
      EXPECT_EQ(x.action, PenetrationAction::offset_stored) << "the solver stores it";
    }
  }
  EXPECT_GT(differ, 0u);
}

// Nodes over corners, sides and diagonals of the other sheet: equally near segments and facets.
TEST(FacetRule, MeshesOnEachOthersLinesNeedNoExactNumbers) {
  for (const double raised : {0.6, 0.8}) {
    SmallDeck d;
    d.shell_part(1, 0.8).shell_part(2, 0.8);
    for (int sheet = 0; sheet < 2; ++sheet)
      add_sheet(d, sheet + 1, 1000 * sheet + 1, 1000 * sheet + 1, 12, 12, [&](int i, int j) {
        return std::array{i + 0.5 * sheet, j + 0.5 * sheet, raised * sheet};
      });
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
