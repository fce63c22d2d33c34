// Irem_gap = 2: pairs close along the mesh are left out. A U-shaped strip in contact with itself.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/published.hpp"

namespace deck::test {
namespace {

TEST(CurvilinearRemoval, CountsOfThePublishedExample) {
  const Built b(bent_strip()
                    .add("@/INTER/TYPE7/1 Gapmin=1.2 Inacti=6")
                    .add("@/INTER/TYPE7/2 Gapmin=1.2 Inacti=6 Irem_gap=2")
                    .add("@/INTER/TYPE11/9 line_IDs=1 line_IDm=1 Gapmin=1.2 Irem_gap=2")
                    .add("@/INTER/TYPE11/10 line_IDs=1 line_IDm=1 Gapmin=1.2"));
  EXPECT_EQ(b.contact(1).candidates, 72u);
  EXPECT_EQ(b.contact(1).penetrations.size(), 52u);
  EXPECT_EQ(b.contact(2).candidates, 40u);
  EXPECT_EQ(b.contact(2).penetrations.size(), 20u);
  EXPECT_EQ(b.contact(9).penetrations.size(), 32u);
  EXPECT_EQ(b.contact(10).penetrations.size(), 180u);
}

TEST(CurvilinearRemoval, EveryRemovedPairIsNearAlongTheStrip) {
  const Built b(
      bent_strip().add("@/INTER/TYPE7/1 Gapmin=1.2").add("@/INTER/TYPE7/2 Gapmin=1.2 Irem_gap=2"));
  const Contact &all = b.contact(1), &kept = b.contact(2);
  // Paths along the strip from its column of nodes to that of the segment; diagonals shorten them
  // by less than the width allows, so columns give a lower bound.
  const double step[] = {1, 1, 1, std::hypot(0.6, 0.5), std::hypot(0.6, 0.6), 1, 1, 1};
  const auto column = [&](NodeIndex n) { return static_cast<int>(b.model.node_id(n) % 100) - 1; };
  const auto along = [&](int from, int to) {
    double sum = 0;
    for (int i = std::min(from, to); i < std::max(from, to); ++i) sum += step[i];
    return sum;
  };
  std::size_t removed = 0;
  for (const PenetrationRow& r : all.penetrations) {
    const NodeIndex n = all.secondary[r.secondary].node;
    if (b.row(kept, b.model.node_id(n), r.main) != nullptr) continue;
    ++removed;
    double nearest = 1e30;
    for (const NodeIndex m : all.main[r.main].nodes)
      nearest = std::min(nearest, along(column(n), column(m)));
    EXPECT_LE(nearest, std::sqrt(2.0) * 1.2 + 1e-12) << b.model.node_id(n);
  }
  EXPECT_EQ(removed, 32u);
}

TEST(CurvilinearRemoval, VariableGapUsesThePairGap) {
  // Pair gap 0.8 everywhere: reach 1.131 takes in one column of nodes beside each segment, while
  // the reach of a constant gap of 1.2 is 1.697.
  const Built b(bent_strip()
                    .add("@/INTER/TYPE7/1 Igap=1 Gapmin=0.1")
                    .add("@/INTER/TYPE7/2 Igap=1 Gapmin=0.1 Irem_gap=2"));
  const Contact &all = b.contact(1), &kept = b.contact(2);
  EXPECT_EQ(all.candidates, kept.candidates + kept.removed_pairs);
  EXPECT_GT(kept.removed_pairs, 0u);
  for (const PenetrationRow& r : kept.penetrations) EXPECT_NEAR(r.gap, 0.8, 1e-15);
}

TEST(CurvilinearRemoval, NoRingIsExpandedBelowTheShortestSide) {
  // sqrt(2) * 0.5 is less than the shortest side 0.78: nothing is removed.
  const Built b(bent_strip().add("@/INTER/TYPE7/1 Gapmin=0.5 Irem_gap=2"));
  EXPECT_EQ(b.contact().removed_pairs, 0u);
}

}  // namespace
}  // namespace deck::test
