// Settings of a card, gaps of both sides of a contact, its default gap and its largest pair gap.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "base/shared/vec.hpp"
#include "deck/contacts.hpp"

namespace deck::detail {

// Settings about gaps and penetrations, and rules of interface parts on them, without decks.

constexpr double no_gap_limit = 1e30;  ///< the solver's "no limit"

/// From card and defaults; 1000 ("explicitly off") is 0.
struct CardSettings {
  int igap = 0, inacti = 0, irem_gap = 1;
  double gapmin = 0;  ///< 0: from the mesh
  double gap_scale = 1, gapmax = no_gap_limit, fpenmax = 0;
  double mesh_fraction = 0.4, drad = 0;
  bool thermal = false;
};

/// Applies changes that cards of that type hand on to their contacts.
void apply(const WhatIf& change, int interface_type, CardSettings& card);
/// Value of a cell that may be blank.
double mesh_fraction_of(double cell);

/// Rules of a TYPE19's node-to-surface parts, and of its edge part.
void adapt_to_type19_nodes(CardSettings& card);
void adapt_to_type19_edges(CardSettings& card, double edge_scale_gap);

/// Factor of the thicknesses, and largest gap; edges have neither.
double gap_scale_of(const CardSettings& card, bool edges);
double gapmax_of(const CardSettings& card, bool edges);

/// Thicknesses for a default gap.
struct ThicknessSamples {
  std::size_t count = 0;
  double sum = 0;
  double smallest = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();
  void add(double thickness);
};

struct DefaultGap {
  double value = 0;
  GapminOrigin origin = GapminOrigin::solid_edge;
};

/// For a node-to-surface contact. `shells`: contact thickness of every segment on a shell;
/// `shortest_side`: of all segments, 0 if none; `scale`: see gap_scale_of.
DefaultGap default_gap(const ThicknessSamples& shells, double shortest_side, bool variable,
                       double scale);

/// One side of a line contact: thickness of shells and sections, shortest edge (0 if none).
struct EdgeSide {
  ThicknessSamples thickness;
  double shortest = 0;
};
double shortest_of_both(const EdgeSide& main, const EdgeSide& secondary);
DefaultGap default_edge_gap(const EdgeSide& main, const EdgeSide& secondary, bool variable);

/// Shortest side between distinct points of a segment or edge; infinity if none.
template <std::size_t N>
double shortest_side(const NodeArrays& x, const std::array<std::uint32_t, N>& item) {
  const auto at = [&](std::uint32_t n) { return Vec{x.x[n], x.y[n], x.z[n]}; };
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < N; ++k) {
    const double l = norm(at(item[(k + 1) % N]) - at(item[k]));
    if (l > 0 && l < shortest) shortest = l;
  }
  return shortest;
}
/// Shortest side of a list; 0 if none.
template <std::size_t N>
double shortest_side(const NodeArrays& x, std::span<const std::array<std::uint32_t, N>> items) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& item : items) shortest = std::min(shortest, shortest_side(x, item));
  return shortest < std::numeric_limits<double>::infinity() ? shortest : 0;
}

/// Contribution of one item to the gaps of its pairs with Igap > 0.
inline double segment_gap(double thickness, double scale) { return scale * 0.5 * thickness; }
inline double node_gap(double half_thickness, double scale) { return scale * half_thickness; }
inline double edge_gap(double thickness) { return 0.5 * thickness; }

/// Largest gap and largest mesh-size limit of the items of both sides.
struct SideExtremes {
  double thickest_main = 0, thickest_secondary = 0, longest_main = 0, longest_secondary = 0;
};
/// Upper bound of pair gaps, used by the solver's search.
double largest_gap(int igap, double gapmin, double gapmax, const SideExtremes& sides);
double largest_edge_gap(double gapmin, const SideExtremes& sides);

/// Reach of radiation of a pair; 0 without heat exchange. `drad` 0: default.
double radiation_distance(bool thermal, double drad, double largest_gap, double shortest_side);

}  // namespace deck::detail
