// The gap of one node-segment or edge-edge pair, from the gaps of its two sides.
// One small value type for every Igap, so that search and penetration use the same number.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace deck {

/// Where the minimum gap of a contact came from.
enum class GapminOrigin : std::uint8_t {
  card,
  mean_thickness,     ///< mean over shell-carried segments
  minimum_thickness,  ///< minimum over shell-carried segments
  scaled_thickness,   ///< the minimum, multiplied by Fscalegap
  half_edge,          ///< half the shortest main side was smaller
  solid_edge,         ///< no shells: a tenth of the shortest main side
  both_sides,         ///< TYPE11: mean of the two sides' defaults
};
const char* to_string(GapminOrigin origin);

// How the gap of a pair is formed (reference solver, TYPE7/10/11/19).
enum class GapRule {
  constant,    // Igap 0 or 1000: one gap for the whole interface
  sum,         // Igap 1, 2 (Fscalegap already multiplied into the two sides): gap_s + gap_m
  sum_limited  // Igap 3: gap_s + gap_m, at most length_s + length_m
};

// Pair gap. Lengths in the model's unit. `gapmin` is the gap itself for GapRule::constant.
//   sum:         max(gapmin, min(gapmax, gap_s + gap_m))            (gapmin wins over gapmax)
//   sum_limited: max(gapmin, min(gapmax, min(gap_s + gap_m, length_s + length_m)))
// TYPE11 has no gapmax: leave it infinite.
struct PairGap {
  GapRule rule = GapRule::constant;
  double gapmin = 0.0;
  double gapmax = std::numeric_limits<double>::infinity();

  static PairGap constant(double gap) { return {GapRule::constant, gap}; }

  // From the effective value of the Igap flag: 0/1000 constant, 3 limited, anything else sum.
  static PairGap from_igap(int igap, double gapmin,
                           double gapmax = std::numeric_limits<double>::infinity()) {
    if (igap == 0 || igap == 1000) return {GapRule::constant, gapmin, gapmax};
    return {igap == 3 ? GapRule::sum_limited : GapRule::sum, gapmin, gapmax};
  }

  // The gap of a pair. The two lengths only matter for sum_limited (gs_l of a node that is on no
  // main segment is 1e30 in the reference solver; infinity works as well).
  double operator()(double gap_s, double gap_m,
                    double length_s = std::numeric_limits<double>::infinity(),
                    double length_m = std::numeric_limits<double>::infinity()) const {
    if (rule == GapRule::constant) return gapmin;
    double gap = gap_s + gap_m;
    if (rule == GapRule::sum_limited) gap = std::min(gap, length_s + length_m);
    return std::max(std::min(gap, gapmax), gapmin);
  }

  // Share of one side in an upper bound of the pair gap: operator() <= share(side_s) +
  // share(side_m), up to the rounding of that sum. Lets a search inflate the two sides apart.
  double share(double side_gap) const {
    const double half = 0.5 * gapmin;
    if (rule == GapRule::constant) return half;
    return std::max(std::min(side_gap, gapmax), half);
  }
};

}  // namespace deck
