// Finds every node-segment and every edge-edge pair that is closer than its gap plus a margin.
// Works on plain arrays; knows nothing of decks or interfaces.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "deck/base/point3.hpp"

namespace deck {

// Which formulas are used.
enum class Form : std::uint8_t {
  reference,  // the published solver's, with its absolute floors 1e-30 and 1e-20
  robust      // exact closest point, relative guards only, residual form of the distance
};

// The part of a segment that holds its closest point. Index (0-based):
// face: sub-triangle; edge: i joins corner i and i+1; corner: i; spoke: joins the centre and
// corner i; centre: 0. A triangle has no spokes and no centre; its edges are 0, 1, 2 as well.
enum class Feature : std::uint8_t { face, edge, corner, spoke, centre };

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

// Node coordinates, one array per axis, all of the same length. Finite numbers only.
struct NodeArrays {
  std::span<const double> x, y, z;
};

// One result. Both members are positions in the input lists, not node numbers.
struct CandidatePair {
  std::uint32_t secondary = 0;  // position in the list of secondary nodes (or secondary edges)
  std::uint32_t main = 0;       // position in the list of main segments (or main edges)
  friend bool operator==(const CandidatePair&, const CandidatePair&) = default;
  friend auto operator<=>(const CandidatePair&, const CandidatePair&) = default;
};

// Node-to-segment input. Every span of gaps, lengths or stiffnesses may be empty: gap 0, length
// infinite, stiffness not 0. Otherwise it is as long as the list it describes.
struct NodeSegmentInput {
  NodeArrays nodes;
  std::span<const std::uint32_t> secondary;  // node positions; duplicates allowed
  std::span<const double> secondary_gap;
  std::span<const double> secondary_length;                // gs_l, GapRule::sum_limited only
  std::span<const double> secondary_stiffness;             // exactly 0: the node takes no part
  std::span<const std::array<std::uint32_t, 4>> segments;  // triangle: last two nodes equal
  std::span<const double> segment_gap;
  std::span<const double> segment_length;     // gm_l, GapRule::sum_limited only
  std::span<const double> segment_stiffness;  // exactly 0: the segment takes no part
};

// Edge-to-edge input; the same conventions.
struct EdgeEdgeInput {
  NodeArrays nodes;
  std::span<const std::array<std::uint32_t, 2>> secondary;
  std::span<const double> secondary_gap;
  std::span<const double> secondary_length;
  std::span<const double> secondary_stiffness;
  std::span<const std::array<std::uint32_t, 2>> main;
  std::span<const double> main_gap;
  std::span<const double> main_length;
  std::span<const double> main_stiffness;
};

struct SearchOptions {
  PairGap gap;
  double drad = 0.0;            // radiation distance: the pair gap is at least this long
  double margin = 0.0;          // added to the pair gap
  Form form = Form::reference;  // which distance decides
  int threads = 1;              // 0: one per core. The result does not depend on it
  std::size_t max_pairs = std::size_t{1} << 31;  // give up beyond this many pairs
};

struct SearchResult {
  std::vector<CandidatePair> pairs;  // sorted by secondary, then main; no duplicates
  bool complete = true;              // false: more than max_pairs exist; `pairs` is empty then
  std::size_t structure_bytes = 0;   // largest size of the search structure, pairs not counted
  std::size_t tested = 0;            // pairs whose distance was computed
};

// All pairs with distance < max(drad, gap(secondary, main)) + margin, where the distance is the
// smallest of the segment's sub-triangle distances (closest_on_segment). Pairs whose node belongs
// to the segment are left out, and so is everything of stiffness 0. No pair is ever missed,
// whatever the mesh grading. Expected time O((n + m) log(n + m) + pairs).
SearchResult find_node_segment_pairs(const NodeSegmentInput& input, const SearchOptions& options);

// All pairs of edges without a common node with distance^2 < (max(drad, gap) + margin)^2
// (closest_between_edges).
SearchResult find_edge_edge_pairs(const EdgeEdgeInput& input, const SearchOptions& options);

// Rule of the reference solver for the margin of its candidate count: 0.2 (as a single-precision
// number) times the mean edge length of the segments, four edges each, also for triangles.
double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments);
// The same for two lists of edges: mean length over both lists.
double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 2>> secondary,
                        std::span<const std::array<std::uint32_t, 2>> main);

}  // namespace deck
