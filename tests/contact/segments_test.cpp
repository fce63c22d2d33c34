// Main segments: repair, orientation, degeneracy, carriers.
#include <gtest/gtest.h>

#include "contact/small_deck.hpp"

namespace deck::test {
namespace {

using Ids = std::array<std::int64_t, 4>;

/// One quad shell, nodes 1-4, one free node 99 and the segments given.
SmallDeck plain(const std::vector<std::vector<int>>& segments) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(99, 5, 5, 50);
  d.shell_part(1, 2).shell(1, 1, 1, 2, 3, 4).segments("/SURF/SEG/1", segments);
  return d.group("/GRNOD/NODE/2", {99}).add("@/INTER/TYPE7/1 Gapmin=1");
}

std::vector<Ids> main_ids(const Built& b, const Contact& c) {
  std::vector<Ids> out;
  for (const MainSegment& m : c.main) out.push_back(b.ids(m.nodes));
  return out;
}

TEST(Repair, FirstMatchingRuleOnly) {
  const Built b(plain({{1, 2, 2, 4}, {1, 2, 3, 1}, {1, 1, 3, 4}, {1, 2, 3, 4}, {1, 2, 3, 3}}));
  const Contact& c = b.contact();
  const std::vector<Ids> expected = {
      {1, 2, 4, 4}, {1, 2, 3, 3}, {1, 3, 4, 4}, {1, 2, 3, 4}, {1, 2, 3, 3}};
  EXPECT_EQ(main_ids(b, c), expected);
  EXPECT_EQ(c.repaired_segments, 3);
  EXPECT_EQ(c.degenerate_segments, 0);
}

TEST(Degenerate, CrossedAndFlatSegmentsOfType7) {
  // Nodes 1 3 2 4 make a bow tie; 1 5 2 with node 5 between them has no area.
  SmallDeck d = plain({{1, 3, 2, 4}, {1, 2, 3, 4}, {1, 5, 2, 2}});
  d.node(5, 5, 0, 0).add("@/INTER/TYPE10/2 Gap=1");
  const Built b(d);
  EXPECT_EQ(b.contact(1).degenerate, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(b.contact(2).degenerate_segments, 0) << "TYPE10 is not checked";
}

/// Two stacked bricks (nodes 1-8 and 5-8, 15-18) and a single one (31-38).
SmallDeck bricks() {
  SmallDeck d;
  const double x[4] = {0, 2, 2, 0}, y[4] = {0, 0, 2, 2};
  for (int i = 0; i < 4; ++i) {
    d.node(1 + i, x[i], y[i], 0).node(5 + i, x[i], y[i], 2).node(15 + i, x[i], y[i], 4);
    d.node(31 + i, 50 + x[i], y[i], 0).node(35 + i, 50 + x[i], y[i], 2);
  }
  d.node(99, 0, 0, 50).solid_part(2);
  d.brick(2, 1, {1, 2, 3, 4, 5, 6, 7, 8}).brick(2, 2, {5, 6, 7, 8, 15, 16, 17, 18});
  d.brick(2, 4, {31, 32, 33, 34, 35, 36, 37, 38}).group("/GRNOD/NODE/2", {99});
  return d;
}

TEST(Orientation, FacesOfOneSolidPointOutwardSharedOnesAreLeftAlone) {
  SmallDeck d = bricks();
  d.segments("/SURF/SEG/1",
             {{1, 2, 3, 4}, {5, 6, 7, 8}, {4, 1, 2, 3}, {1, 4, 3, 2}, {31, 32, 33, 34}});
  const Built b(d.add("@/INTER/TYPE7/1"));
  const Contact& c = b.contact();
  const std::vector<Ids> expected = {
      {4, 3, 2, 1}, {5, 6, 7, 8}, {3, 2, 1, 4}, {1, 4, 3, 2}, {34, 33, 32, 31}};
  EXPECT_EQ(main_ids(b, c), expected);
  EXPECT_EQ(c.reoriented_segments, 3);
  // The face between the bricks belongs to the one with the larger id.
  EXPECT_EQ(c.main[1].carrier, Carrier::solid);
  EXPECT_EQ(b.model.solid8.id[c.main[1].element], 2);
}

TEST(Orientation, TriangleSwapsItsFirstTwoNodes) {
  SmallDeck d;
  d.node(21, 40, 0, 0).node(22, 43, 0, 0).node(23, 40, 3, 0).node(24, 40, 0, 3).node(99, 9, 9, 9);
  d.solid_part(3).tetra(3, 3, 21, 22, 23, 24).group("/GRNOD/NODE/2", {99});
  d.segments("/SURF/SEG/1", {{21, 22, 23, 23}, {21, 23, 22, 22}});
  const Built b(d.add("@/INTER/TYPE7/1"));
  const std::vector<Ids> expected = {{22, 21, 23, 23}, {21, 23, 22, 22}};
  EXPECT_EQ(main_ids(b, b.contact()), expected);
  EXPECT_EQ(b.contact().reoriented_segments, 1);
}

TEST(Carrier, ThickestShellThenLargerYoungsModulus) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 10, 0, 0).node(3, 10, 10, 0).node(4, 0, 10, 0).node(99, 5, 5, 50);
  d.elastic_material(2, 300).shell_part(1, 1).shell_part(2, 2).shell_part(3, 2, 0, 2);
  d.shell(1, 1, 1, 2, 3, 4).shell(2, 2, 2, 3, 4, 1).shell(3, 3, 3, 4, 1, 2);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}}).group("/GRNOD/NODE/2", {99});
  const Built b(d.add("@/INTER/TYPE7/1"));
  const MainSegment& m = b.contact().main.at(0);
  EXPECT_EQ(m.carrier, Carrier::shell4);
  EXPECT_EQ(b.model.shell4.id[m.element], 3);
  EXPECT_DOUBLE_EQ(m.stiffness, 600);
}

TEST(ShellOnSolid, OneSegmentWhereBothPartsAreSelected) {
  SmallDeck d = bricks();
  d.shell_part(1, 0.15).shell(1, 11, 35, 36, 37, 38);
  d.group("/SURF/PART/EXT/3", {2}).group("/SURF/PART/EXT/6", {1, 2});
  d.add("@/INTER/TYPE7/3 surf_IDm=3").add("@/INTER/TYPE7/6 surf_IDm=6");
  const Built b(d);
  EXPECT_EQ(b.contact(3).main.size(), 16u);
  EXPECT_EQ(b.contact(6).main.size(), 16u);
  EXPECT_EQ(b.main(b.contact(3), {35, 36, 37, 38})->carrier, Carrier::solid);
  EXPECT_EQ(b.main(b.contact(6), {35, 36, 37, 38})->carrier, Carrier::shell4);
}

}  // namespace
}  // namespace deck::test
