// The distance of a pair from the plane, line or corner that double found closest, in a few
// double-double operations: what most distances and decisions need beyond double. Private to the
// contact stage.
//
// Let q be any point of that plane or line. Its squared distance is the squared length of q less
// that of the part of q along the plane or line, which is small to the second order: double gives
// it well enough. And it is the distance of the whole pair where every other vertex lies beyond the
// plane through the closest point across its own direction: that, too, is proved in double, with
// room for all round-off.
#pragma once

#include <optional>

#include "contact/distance/filtered_bounds.hpp"

namespace deck::filter {

// A bracket of the squared distance.
struct PieceDistance {
  DoubleDouble squared;
  double error = 0.0;              // the exact square is within this of `squared`
  std::array<double, 2> weight{};  // edges, if asked for: of the first nodes, s and m, rounded once
  bool one_part = true;  // no other part of the pair is as close: the feature is certain too
  SegmentPiece piece;    // what it is the distance of; not of edges
  // The double nearest to the root, at the original scale, if the bracket tells.
  std::optional<double> rounded(int shift) const;
  Answer closer_than(double gap) const;
};

// `c`: what double says of the pair. Nothing where the proof fails.
std::optional<PieceDistance> piece_distance(const SegmentPair& pair,
                                            const SegmentClosest<double>& c);
std::optional<PieceDistance> piece_distance(const EdgePair& pair, const EdgeClosest<double>& c,
                                            bool weights = false);

}  // namespace deck::filter
