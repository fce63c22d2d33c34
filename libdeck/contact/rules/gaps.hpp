// Settings of a card, gaps of the two sides of a contact, its default gap, and the largest gap that
// its pairs can have.
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

// What a card says about gaps and initial penetrations, and what the parts of its interface make of
// it. These rules know nothing of decks.

constexpr double no_gap_limit = 1e30;  ///< the solver's "no limit"

/// As the card and the defaults have it; flags with 1000 ("explicitly nothing") as 0.
struct CardSettings {
  int igap = 0, inacti = 0, irem_gap = 1;
  double gapmin = 0;  ///< 0: follows from the mesh
  double gap_scale = 1, gapmax = no_gap_limit, fpenmax = 0;
  double mesh_fraction = 0.4, drad = 0;
  bool thermal = false;
};

/// Takes over what the card of that type hands on to its contacts; the rest has no effect there.
void apply(const WhatIf& change, int interface_type, CardSettings& card);
/// The value of a cell that may be blank.
double mesh_fraction_of(double cell);

/// What the node-to-surface parts of a TYPE19 make of its card, and its edge part.
void adapt_to_type19_nodes(CardSettings& card);
void adapt_to_type19_edges(CardSettings& card, double edge_scale_gap);

/// Factor of the thicknesses and largest gap; edges know neither.
double gap_scale_of(const CardSettings& card, bool edges);
double gapmax_of(const CardSettings& card, bool edges);

/// Thicknesses that a default gap is formed of.
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

/// Of a node-to-surface contact. `shells`: contact thickness of every segment that a shell carries;
/// `shortest_side` of all segments, 0 if there is none; `scale` as `gap_scale_of` gives it.
DefaultGap default_gap(const ThicknessSamples& shells, double shortest_side, bool variable,
                       double scale);

/// One side of a line contact: thickness of its shells and sections, and its shortest edge (0:
/// none).
struct EdgeSide {
  ThicknessSamples thickness;
  double shortest = 0;
};
double shortest_of_both(const EdgeSide& main, const EdgeSide& secondary);
DefaultGap default_edge_gap(const EdgeSide& main, const EdgeSide& secondary, bool variable);

/// Shortest side between distinct places of a segment or an edge; infinity if there is none.
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
/// The same of a list; 0 if there is none.
template <std::size_t N>
double shortest_side(const NodeArrays& x, std::span<const std::array<std::uint32_t, N>> items) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& item : items) shortest = std::min(shortest, shortest_side(x, item));
  return shortest < std::numeric_limits<double>::infinity() ? shortest : 0;
}

/// What one item brings to the gaps of its pairs if Igap is not 0.
inline double segment_gap(double thickness, double scale) { return scale * 0.5 * thickness; }
inline double node_gap(double half_thickness, double scale) { return scale * half_thickness; }
inline double edge_gap(double thickness) { return 0.5 * thickness; }

/// Largest gap and largest mesh-size limit among the items of both sides.
struct SideExtremes {
  double thickest_main = 0, thickest_secondary = 0, longest_main = 0, longest_secondary = 0;
};
/// Largest pair gap that the solver's search expects.
double largest_gap(int igap, double gapmin, double gapmax, const SideExtremes& sides);
double largest_edge_gap(double gapmin, const SideExtremes& sides);

/// How far the heat of a pair radiates; 0 without heat exchange. `drad` 0: by default.
double radiation_distance(bool thermal, double drad, double largest_gap, double shortest_side);

}  // namespace deck::detail
