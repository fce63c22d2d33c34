// Distances from the one plane, line or corner that is closest: what they claim to have proved,
// held against exact rationals on ordinary pairs, and that ordinary pairs need nothing else.
#include "contact/distance/filtered_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/search_scenes.hpp"
#include "contact/shared/exact.hpp"

namespace deck {
namespace {

using P = Point3<double>;

struct Dice : scenes::Dice {
  Dice() : scenes::Dice(7) {}
  P around(const P& centre, double by) {
    return {centre.x + uniform(-by, by), centre.y + uniform(-by, by), centre.z + uniform(-by, by)};
  }
};

constexpr int pairs = 6000;
// Quads, triangles and edges of about unit size, at the origin or a thousand units from it.
P place_of(int i) { return i % 2 == 0 ? P{0, 0, 0} : P{1234.5, -0.75, 310}; }

struct Segment {
  std::array<P, 4> corners;
  P node;
  bool triangle;
  Segment(Dice& dice, int i) : triangle(i % 3 == 0) {
    const P at = place_of(i);
    const std::array<P, 4> square{P{at.x - 1, at.y - 1, at.z}, P{at.x + 1, at.y - 1, at.z},
                                  P{at.x + 1, at.y + 1, at.z}, P{at.x - 1, at.y + 1, at.z}};
    for (std::size_t k = 0; k < 4; ++k) corners[k] = dice.around(square[k], 0.5);
    if (triangle) corners[3] = corners[2];
    node = dice.around(at, i % 5 == 0 ? 4.0 : 1.0);
  }
};

TEST(PieceDistance, OfASegmentIsTheExactOneWithItsFeature) {
  Dice dice;
  int proved = 0;
  for (int i = 0; i < pairs; ++i) {
    const Segment s(dice, i);
    const filter::SegmentPair pair(s.node, s.corners, s.triangle);
    const auto c = closest_on_segment<Form::robust>(s.node, s.corners, s.triangle);
    const auto piece = filter::piece_distance(pair, c);
    if (!piece) continue;
    ++proved;
    const ExactSegment exact = exact_closest_on_segment(s.node, s.corners, s.triangle);
    ASSERT_EQ(piece->rounded(0).value_or(exact.distance), exact.distance) << i;
    ASSERT_EQ(c.feature, exact.feature) << i;
    ASSERT_EQ(c.feature_index, exact.feature_index) << i;
    for (const double gap : {std::nextafter(exact.distance, 0.0), exact.distance,
                             std::nextafter(exact.distance, 10.0)}) {
      const filter::Answer answer = piece->closer_than(gap);
      const int sign = exact_compare_distance(s.node, s.corners, s.triangle, gap);
      ASSERT_FALSE(answer == filter::Answer::yes && sign >= 0) << i;
      ASSERT_FALSE(answer == filter::Answer::no && sign < 0) << i;
    }
  }
  EXPECT_GT(proved, 0.97 * pairs);
}

TEST(PieceDistance, OfTwoEdgesIsTheExactOneWithItsWeights) {
  Dice dice;
  int proved = 0, rounded = 0;
  for (int i = 0; i < pairs; ++i) {
    const P at = place_of(i);
    const std::array<P, 4> x{dice.around(at, 1), dice.around(at, 1), dice.around(at, 2),
                             dice.around(at, 2)};
    const filter::EdgePair pair(x);
    const auto c = filter::closest_of(pair);
    const auto piece = filter::piece_distance(pair, c, true);
    if (!piece) continue;
    ++proved;
    const ExactEdges exact = exact_closest_between_edges(x[0], x[1], x[2], x[3]);
    ASSERT_EQ(piece->rounded(0).value_or(exact.distance), exact.distance) << i;
    rounded += piece->rounded(0).has_value();
    ASSERT_EQ(c.feature_s, exact.feature_s) << i;
    ASSERT_EQ(c.feature_m, exact.feature_m) << i;
    using D = DoubleDouble;
    const auto wide = [&x](std::size_t k) { return filter::lift<D>(x[k]); };
    const auto w = closest_between_edges<Form::robust>(wide(0), wide(1), wide(2), wide(3));
    ASSERT_EQ(piece->weight[0], w.weight_s.hi()) << i;
    ASSERT_EQ(piece->weight[1], w.weight_m.hi()) << i;
  }
  EXPECT_GT(proved, 0.97 * pairs);
  EXPECT_GT(rounded, 0.97 * pairs);
}

// A corner written twice, so that two features are equally close: the distance is still proved, but
// which of them is closest is not.
TEST(PieceDistance, SaysWhereAnotherPartIsAsClose) {
  const std::array<P, 4> corners{P{0, 0, 0}, P{1, 0, 0}, P{1, 1, 0}, P{0, 0, 0}};
  const P node{-1, -0.5, 1};
  const filter::SegmentPair pair(node, corners, false);
  const auto c = closest_on_segment<Form::robust>(node, corners, false);
  const auto piece = filter::piece_distance(pair, c);
  ASSERT_TRUE(piece);
  EXPECT_FALSE(piece->one_part);
  EXPECT_EQ(piece->rounded(0), 1.5);
}

}  // namespace
}  // namespace deck
