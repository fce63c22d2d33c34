// One contact point, one force: pairs of neighbouring segments or edges that meet the other side at
// the same edge or corner share its force instead of adding up. Part of the robust model; works on
// finished packets, as single pairs know nothing of one another.
#pragma once
#include <vector>

#include "deck/cycle/assemble.hpp"

namespace deck::cycle {

/// Share of each pair, 0 to 1. A pair whose closest point lies on an edge or corner of its segment
/// (its edges) yields to pairs of the same secondary side that contain this edge or corner: it
/// counts nothing where one of them comes closer elsewhere, and 1/n where n pairs meet in the same
/// point. So a node over a flat mesh is pushed once wherever it is, and over a convex edge the
/// force turns without a jump. In an obtuse valley, where both sides push by right, a side lets go
/// at once when the node's foot on it leaves the segment. Pairs without contact have the share 1.
///
/// Weights below 1e-12 count as 0, distances as equal within 1e-12 of themselves: the numbers come
/// from different segments with different roundings.
[[nodiscard]] std::vector<double> pair_shares(const PairList& pairs, const PacketResult& result);

/// Multiplies what adds up at the nodes: forces, stiffness, energies, heat. A pair with the share 0
/// is no contact any more and limits no step; its penetration stays.
void apply_shares(const std::vector<double>& share, PacketResult& result);

}  // namespace deck::cycle
