// Curved main sides (Icurv 1 to 3) on top of the facet geometry.
#pragma once
#include <cstddef>

#include "deck/cycle/packet.hpp"

namespace deck::cycle::detail {

/// How far the bicubic surface of pair i may leave its facet: added to the gap for weights and
/// search. 0 for a triangle, which keeps its facet.
double bicubic_allowance(const PacketView& view, std::size_t i);
/// How far beyond its gap a pair is kept: for Icurv 1 and 2 half the largest extent of its segment.
double curvature_allowance(const ContactCard& card, const PacketView& view, std::size_t i);

}  // namespace deck::cycle::detail
