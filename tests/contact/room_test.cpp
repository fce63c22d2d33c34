// What is made of contacts with more pairs or penetrations than there is room for.
#include <gtest/gtest.h>

#include <string>

#include "contact/published.hpp"
#include "deck/contacts.hpp"

namespace deck::test {
namespace {

SceneOptions with_room(std::uint64_t bytes) {
  SceneOptions o;
  o.limits.pair_bytes = bytes;
  return o;
}

/// A quad of 3 by 4 and a triangle of 3, 4 and 5 with nodes over them; the surface has both.
SmallDeck quad_and_triangle(int nodes) {
  SmallDeck d;
  d.node(1, 0, 0, 0).node(2, 3, 0, 0).node(3, 3, 4, 0).node(4, 0, 4, 0);
  d.node(5, 100, 0, 0).node(6, 103, 0, 0).node(7, 100, 4, 0);
  std::vector<int> ids;
  for (int k = 0; k < nodes; ++k) {
    ids.push_back(101 + k);
    d.node(101 + k, 1.5 + 0.001 * k, 2, 0.5);
  }
  d.shell_part(1, 1).shell(1, 1, 1, 2, 3, 4).shell3(1, 2, 5, 6, 7);
  d.segments("/SURF/SEG/1", {{1, 2, 3, 4}, {5, 6, 7, 7}}).group("/GRNOD/NODE/2", ids);
  return d.add("@/INTER/TYPE7/1 Gapmin=13");
}

TEST(RoomForPairs, IsThatOfFourCopiesOfEach) {
  const std::uint64_t least = 5 * 4 * sizeof(CandidatePair);
  const SmallDeck d = quad_and_triangle(5);
  const Built enough(d, with_room(least));
  EXPECT_TRUE(enough.contact().evaluated);
  EXPECT_EQ(enough.contact().penetrations.size(), 5u);
  EXPECT_EQ(enough.contact().candidates, 5u);
  const Built less(d, with_room(least - 1));
  EXPECT_FALSE(less.contact().evaluated);
  EXPECT_EQ(less.contact().penetrations.size(), 0u);
  EXPECT_EQ(less.contact().candidates, 0u);
}

TEST(RoomForPenetrations, OfNodesIsLookedAtAfterEachGroupOf128Candidates) {
  const SmallDeck d = quad_and_triangle(130);
  const std::uint64_t group = 128 * sizeof(PenetrationRow);
  ASSERT_GT(group, 130 * 4 * sizeof(CandidatePair)) << "the pairs themselves have room";
  EXPECT_EQ(Built(d, with_room(group)).contact().penetrations.size(), 130u);
  const Built less(d, with_room(group - 1));
  EXPECT_FALSE(less.contact().evaluated);
  EXPECT_EQ(less.contact().penetrations.size(), 0u);
  EXPECT_EQ(less.contact().candidates, 0u);
  EXPECT_TRUE(Built(quad_and_triangle(128), with_room(group - 1)).contact().evaluated);
}

TEST(RoomForPenetrations, OfEdgesIsThatOfAllOfThem) {
  const SmallDeck d = published_edges().add("@/INTER/TYPE11/1 line_IDs=2 line_IDm=1 Inacti=5");
  const Built all(d);
  const std::size_t count = all.contact().penetrations.size();
  ASSERT_GE(count, 2u);
  EXPECT_EQ(Built(d, with_room(count * sizeof(PenetrationRow))).contact().penetrations.size(),
            count);
  const Built less(d, with_room(count * sizeof(PenetrationRow) - 1));
  EXPECT_FALSE(less.contact().evaluated);
  EXPECT_EQ(less.contact().penetrations.size(), 0u);
  EXPECT_EQ(less.contact().candidates, 0u);
}

}  // namespace
}  // namespace deck::test
