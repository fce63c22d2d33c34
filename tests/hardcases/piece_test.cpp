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

TEST(PieceDistance, OfASegmentBracketsTheExactOne) {
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

TEST(PieceDistance, OfTwoEdgesBracketsTheExactOne) {
  Dice dice;
  int proved = 0;
  for (int i = 0; i < pairs; ++i) {
    const P at = place_of(i);
    const std::array<P, 4> x{dice.around(at, 1), dice.around(at, 1), dice.around(at, 2),
                             dice.around(at, 2)};
    const filter::EdgePair pair(x);
    const auto piece = filter::piece_distance(pair, filter::closest_of(pair));
    if (!piece) continue;
    ++proved;
    const double exact = exact_closest_between_edges(x[0], x[1], x[2], x[3]).distance;
    for (const double gap : {std::nextafter(exact, 0.0), exact, std::nextafter(exact, 10.0)}) {
      const filter::Answer answer = piece->closer_than(gap);
      const int sign = exact_compare_distance(x[0], x[1], x[2], x[3], gap);
      ASSERT_FALSE(answer == filter::Answer::yes && sign >= 0) << i;
      ASSERT_FALSE(answer == filter::Answer::no && sign < 0) << i;
    }
  }
  EXPECT_GT(proved, 0.97 * pairs);
}

}  // namespace
}  // namespace deck
