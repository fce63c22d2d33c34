// The rule of TYPE24 against exact arithmetic: the families of hard cases, penetrations that only
// round-off rejects; and both types on meshes at random.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "accuracy/shared/accuracy.hpp"
#include "contact/exactness.hpp"
#include "contact/modern/patch_rule.hpp"

namespace deck::test {
namespace {

using namespace detail::modern;

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

TEST(PatchRule, PlacesBesideATriangleAreJudgedAsExactArithmeticDoes) {
  std::size_t sure = 0, all = 0;
  PatchRule r;
  r.corner = {Vec{1, 2, 0}, Vec{4, 2, 0}, Vec{1, 5, 0}, Vec{1, 5, 0}};
  r.accepted = r.limit = 1.5;
  for (const bool solid : {false, true})
    for (const bool blocks : {false, true})
      for (int i = -4; i <= 14; ++i)
        for (int j = -4; j <= 14; ++j)
          for (const double z : {-0.75, -0.1, 0.1, 0.75, 1.0, 1.25}) {
            r.solid = solid;
            r.never_blocks = !blocks;
            r.node_gap = r.segment_gap = 0.5;
            r.node = {0.5 * i, 0.5 * j, z};
            const PatchChoice quick = choose_pair({&r, 1}, true, true);
            ++all;
            if (quick.doubtful) continue;
            ++sure;
            EXPECT_EQ(quick.penetrates, exact_node({&r, 1}, true, 0).penetrates)
                << i << " " << j << " " << z;
          }
  EXPECT_GT(sure, all / 2);
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
