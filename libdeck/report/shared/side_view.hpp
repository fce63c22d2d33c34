// The side view of one pair as SVG, to scale: main side with its half thickness, gap, node with its
// half, depth, and what the solver does about it.
//
// The page draws the same (tools/viewer/src/sections/sideview.ts) because its settings change while
// no program is there; tests/browser holds both drawings against each other.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/text.hpp"

namespace deck {

/// "57/30-38-44-31" or "11-12/30-31": a node or edge, and a segment or main edge by its nodes, in
/// any order.
struct PairName {
  std::vector<std::int64_t> secondary, main;
};
Result<PairName> parse_pair(std::string_view text);

struct FoundPair {
  std::size_t contact = 0;
  std::size_t row = 0;  ///< of its penetrations
};
/// The penetration of this name, of `interface` (0: any). Error (config): none, or pairs of several
/// interfaces; the message says which.
Result<FoundPair> find_pair(const Scene& scene, const PairName& name, std::int64_t interface = 0);

/// Lengths across the main side; `at`: the node above the surface, negative below it.
struct PairHeights {
  double gap = 0, depth = 0, at = 0, distance = 0;
  double main = 0, secondary = 0;  ///< half thicknesses; of TYPE24 and TYPE25 the gaps they give
};
PairHeights pair_heights(const Scene& scene, const FoundPair& pair);

/// "depth 0.35 = gap 1.25 - distance 0.9".
std::string pair_equation(const PairHeights& heights);

/// Two lines for people: which pair, and its equation.
std::string side_view_text(const Scene& scene, const FoundPair& pair);

/// The drawing, with its lengths as data-gap, data-depth and data-distance, and data-scale in units
/// of the drawing per length.
std::string side_view_svg(const Scene& scene, const FoundPair& pair);

}  // namespace deck
