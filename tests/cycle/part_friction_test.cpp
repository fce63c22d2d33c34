// /FRICTION in whole decks: coefficients by pairs of parts for nodes and edges, and by direction.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "cycle/plates.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {
namespace {

using deck::test::Built;
using deck::test::SmallDeck;

/// Friction ratio of a pair that slides in x, y or between: |Ft| / |Fn| of the first pair
/// of each contact, and the tangential force on the main side.
struct Slide {
  double coefficient = 0.0;
  std::array<double, 3> tangential{};
};
std::vector<Slide> slide(const SmallDeck& d, const std::array<double, 3>& velocity,
                         Model model = Model::robust) {
  const Built b(d);
  const SceneOutcome r = run_cycle(b.scene, make_state(b.scene, {{2, velocity}, {3, velocity}}),
                                   testing::with_step(1e-3, model));
  std::vector<Slide> out;
  for (const ContactOutcome& c : r.contacts) {
    Slide s;
    s.tangential = c.totals.tangential;
    const auto& t = s.tangential;
    s.coefficient = std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]) / c.totals.normal_abs;
    out.push_back(s);
  }
  return out;
}

/// A plate (part 1) with a node of part 2 and one of part 3 above, each in an interface of its own.
SmallDeck plate(const std::string& friction) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 100, 0, 0).node(3, 100, 100, 0).node(4, 0, 100, 0);
  d.node(11, 40, 50, 0.6).node(12, 40, 60, 9).node(13, 45, 55, 9);
  d.node(21, 60, 50, 0.6).node(22, 60, 60, 9).node(23, 65, 55, 9);
  d.shell_part(1, 1.0).shell_part(2, 1.0).shell_part(3, 1.0);
  d.shell(1, 1, 1, 2, 3, 4).shell3(2, 2, 11, 12, 13).shell3(3, 3, 21, 22, 23);
  d.group("/GRNOD/NODE/1", {11}).group("/GRNOD/NODE/2", {21}).group("/SURF/PART/2", {1});
  d.add(friction);
  d.add("@/INTER/TYPE7/1 grnd_IDs=1 surf_IDm=2 Gapmin=1 fric_ID=5");
  return d.add("@/INTER/TYPE7/2 grnd_IDs=2 surf_IDm=2 Gapmin=1 fric_ID=5");
}

TEST(PartFriction, NodesTakeTheCoefficientOfTheirPairOfParts) {
  for (const char* order : {"part_ID1=1 part_ID2=2", "part_ID1=2 part_ID2=1"}) {
    const SmallDeck d =
        plate("@/FRICTION/5 C1=0.0 Fric=0.3 C1_pair=0.0 Fric_pair=0.1 " + std::string(order));
    const auto s = slide(d, {1e5, 0, 0});
    ASSERT_EQ(s.size(), 2u);
    EXPECT_NEAR(s[0].coefficient, 0.1, 1e-12) << order;
    EXPECT_NEAR(s[1].coefficient, 0.3, 1e-12) << order;
  }
}

/// Two rails of trusses (part 1) with one truss of part 2 and one of part 3 across.
SmallDeck rails(const std::string& friction) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 100, 0, 0);
  d.node(11, 40, -50, 0.5).node(12, 40, 50, 0.5).node(21, 60, -50, 0.5).node(22, 60, 50, 0.5);
  for (int p = 1; p <= 3; ++p) d.truss_part(p, 0.25);
  d.bar("TRUSS", 1, 1, 1, 2).bar("TRUSS", 2, 2, 11, 12).bar("TRUSS", 3, 3, 21, 22);
  d.segments("/LINE/SEG/1", {{1, 2}}).segments("/LINE/SEG/2", {{11, 12}});
  d.segments("/LINE/SEG/3", {{21, 22}}).add(friction);
  d.add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Gapmin=1 fric_ID=5");
  return d.add("@/INTER/TYPE11/2 line_IDs=3 line_IDm=1 Gapmin=1 fric_ID=5");
}

TEST(PartFriction, EdgesTakeTheCoefficientOfTheirPairOfParts) {
  for (const Model model : {Model::reference, Model::robust})
    for (const double other : {0.3, 0.0}) {  // of pairs that are not named
      const SmallDeck d = rails(fmt::sprintf(
          "@/FRICTION/5 C1=0.0 Fric=%g part_ID1=1 part_ID2=2 C1_pair=0.0 Fric_pair=0.1", other));
      const auto s = slide(d, {1e6, 0, 0}, model);
      ASSERT_EQ(s.size(), 2u);
      EXPECT_NEAR(s[0].coefficient, 0.1, 1e-12);
      EXPECT_NEAR(s[1].coefficient, other, 1e-12);
    }
}

TEST(PartFriction, DirectionsOfAnOrthotropicPairFollowTheSegment) {
  const SmallDeck d = plate(
      "@/FRICTION/5 C1=0.0 Fric=0.3 part_ID1=1 part_ID2=2 Idir=1 C1_pair=0.0 Fric_pair=0.4 "
      "C1_dir2=0.0 Fric_dir2=0.1");
  // The first axis of the plate is x.
  EXPECT_NEAR(slide(d, {1e5, 0, 0}).at(0).coefficient, 0.4, 1e-12);
  EXPECT_NEAR(slide(d, {0, 1e5, 0}).at(0).coefficient, 0.1, 1e-12);
  const Slide across = slide(d, {1e5, 1e5, 0}).at(0);
  const double size = std::hypot(across.tangential[0], across.tangential[1]);
  EXPECT_NEAR(
      across.coefficient * std::hypot(across.tangential[0] / 0.4, across.tangential[1] / 0.1), size,
      1e-9 * size)
      << "on the ellipse";
  // The other pair of parts has no directions.
  for (const std::array<double, 3>& v : {std::array{1e5, 0.0, 0.0}, std::array{0.0, 1e5, 0.0}})
    EXPECT_NEAR(slide(d, v).at(1).coefficient, 0.3, 1e-12);
}

/// The plate with 0.4 along the first direction and 0.1 across, the direction given by lines of
/// /FRIC_ORIENT for part 1.
std::array<double, 2> along_x_and_y(const std::string& before, const std::string& owner,
                                    const std::array<double, 3>& v, int skew, double phi) {
  char line[128];
  std::snprintf(line, sizeof line, "%20g%20g%20g%10d%20g", v[0], v[1], v[2], skew, phi);
  const SmallDeck d = plate(
      "@/FRICTION/5 C1=0.0 Fric=0.3 part_ID1=1 part_ID2=2 Idir=1 C1_pair=0.0 Fric_pair=0.4 "
      "C1_dir2=0.0 Fric_dir2=0.1\n" +
      before + "/FRIC_ORIENT/9\ndirections\n" + owner + "\n" + line);
  return {slide(d, {1e5, 0, 0}).at(0).coefficient, slide(d, {0, 1e5, 0}).at(0).coefficient};
}

TEST(FrictionOrientation, OfAPartIsTheVectorInItsSegmentTurnedByPhi) {
  const std::string part = "         0         1", group = "         7         0";
  // y' is -x and z' is z: x' is y.
  const std::string skew =
      "/SKEW/FIX/3\naxes\n                   0                   0                   0\n"
      "                  -1                   0                   0\n"
      "                   0                   0                   1\n";
  const std::string with = "/GRPART/PART/7\nparts\n         1         2\n",
                    without = "/GRPART/PART/7\nparts\n         2         3\n";
  struct Case {
    std::string before, owner;
    std::array<double, 3> vector;
    int skew;
    double phi;
    bool along_x;  ///< the first direction is x, otherwise y
  };
  const Case cases[] = {
      {"", part, {1, 0, 0}, 0, 0, true},     {"", part, {0, 3, 0}, 0, 0, false},
      {"", part, {0, 1, 5}, 0, 0, false},  // only what lies in the segment counts
      {"", part, {0, 0, 1}, 0, 0, true},   // along the normal: the first axis of the segment stays
      {"", part, {1, 0, 0}, 0, 90, false},   {"", part, {1, 1, 0}, 0, 45, false},
      {"", part, {1, 1, 0}, 0, -45, true},   {skew, part, {1, 0, 0}, 3, 0, false},
      {with, group, {0, 1, 0}, 0, 0, false}, {without, group, {0, 1, 0}, 0, 0, true}};
  for (const Case& c : cases) {
    const auto got = along_x_and_y(c.before, c.owner, c.vector, c.skew, c.phi);
    EXPECT_NEAR(got[0], c.along_x ? 0.4 : 0.1, 1e-9) << &c - cases;
    EXPECT_NEAR(got[1], c.along_x ? 0.1 : 0.4, 1e-9) << &c - cases;
  }
}

}  // namespace
}  // namespace deck::cycle
