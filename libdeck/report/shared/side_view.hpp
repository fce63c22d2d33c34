// Side view of one pair as SVG, to scale: main side with half thickness, gap, node with half
// thickness, depth, action of the solver. The page draws the same in TypeScript
// (tools/viewer/src/sections/sideview.ts), because its settings change without a program;
// tests/browser compares both drawings.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/text.hpp"

namespace deck {

/// "57/30-38-44-31" or "11-12/30-31": secondary node or edge, and main segment or edge by its nodes
/// in any order.
struct PairName {
  std::vector<std::int64_t> secondary, main;
};
Result<PairName> parse_pair(std::string_view text);

struct FoundPair {
  std::size_t contact = 0;
  std::size_t row = 0;  ///< of its penetrations
};
/// Penetration with this name in `interface` (0: any). Error (config): none, or in several
/// interfaces; the message says which.
Result<FoundPair> find_pair(const Scene& scene, const PairName& name, std::int64_t interface = 0);

/// Lengths normal to the main side; `at`: node above the surface, negative below.
struct PairHeights {
  double gap = 0, depth = 0, at = 0, distance = 0;
  double main = 0, secondary = 0;  ///< half thicknesses; TYPE24, TYPE25: resulting gaps
};
PairHeights pair_heights(const Scene& scene, const FoundPair& pair);

/// "depth 0.35 = gap 1.25 - distance 0.9".
std::string pair_equation(const PairHeights& heights);

/// Two lines: name of the pair, equation.
std::string side_view_text(const Scene& scene, const FoundPair& pair);

/// The drawing. Attributes: data-gap, data-depth, data-distance, and data-scale (units of the
/// drawing per length).
std::string side_view_svg(const Scene& scene, const FoundPair& pair);

}  // namespace deck
