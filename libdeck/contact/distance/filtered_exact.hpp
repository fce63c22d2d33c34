// Contact decisions in CGAL's exact sums and products, given a guess of the parts that are closest:
// the usual exact ties (node on the plane, distance equal to the gap) without rationals.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "contact/shared/closest.hpp"

namespace deck {

// Which corners of a sub-triangle (centre, k, k+1) carry the guessed closest point; none set: this
// sub-triangle needs no proof of its own.
struct PartGuess {
  bool o = false, a = false, b = false;
};

// A plane, line or corner of a segment: through the corner `base`, along up to two directions. Each
// is the sum of the vectors from there to the corners whose bits are set; none: no direction.
struct SegmentPiece {
  std::uint8_t base = 0;
  std::array<std::uint8_t, 2> corners{};
};

// Whether the node points[4] is nearer to the piece than the gap, exactly. All points are finite.
bool is_closer_to_piece(const std::array<Point3<double>, 5>& points, const SegmentPiece& piece,
                        double gap);

// "distance < gap" proved exactly, or nothing if the guess does not prove it. A gap of 0 asks
// whether the distance is exactly 0. `points`:
// four corners, then the node; a triangle uses guess[0] only, with o, a, b = corners 3, 1, 2.
std::optional<bool> prove_closer(const std::array<Point3<double>, 5>& points, bool triangle,
                                 int best, const std::array<PartGuess, 4>& guess, double gap);

// The same for edges x[0]-x[1] and x[2]-x[3] with the guessed feature of each.
std::optional<bool> prove_closer(const std::array<Point3<double>, 4>& x, EdgeFeature secondary,
                                 EdgeFeature main, bool parallel, double gap);

}  // namespace deck
