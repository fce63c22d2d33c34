// Rules of gaps: of both sides, default, largest.
#include "contact/rules/gaps.hpp"

#include <algorithm>

namespace deck {

const char* to_string(GapminOrigin origin) {
  switch (origin) {
    case GapminOrigin::card:
      return "card";
    case GapminOrigin::mean_thickness:
      return "mean thickness of the main shells";
    case GapminOrigin::minimum_thickness:
      return "smallest thickness of the main shells";
    case GapminOrigin::scaled_thickness:
      return "Fscalegap times the smallest thickness of the main shells";
    case GapminOrigin::half_edge:
      return "half the shortest main side";
    case GapminOrigin::solid_edge:
      return "a tenth of the shortest main side";
    case GapminOrigin::both_sides:
      return "mean of the defaults of both sides";
  }
  return "card";
}

namespace detail {
namespace {

double default_of_side(const EdgeSide& side, bool variable) {
  const double half = 0.5 * side.shortest;
  const ThicknessSamples& t = side.thickness;
  if (t.count == 0) return 0.2 * half;
  return std::min(half, variable ? t.smallest : t.sum / static_cast<double>(t.count));
}

}  // namespace

void ThicknessSamples::add(double thickness) {
  ++count;
  sum += thickness;
  smallest = std::min(smallest, thickness);
  largest = std::max(largest, thickness);
}

DefaultGap default_gap(const ThicknessSamples& shells, double shortest_side, bool variable,
                       double scale) {
  if (shells.count == 0) return {0.1 * shortest_side, GapminOrigin::solid_edge};
  // Smallest scaled thickness.
  const double smallest = scale * (scale < 0 ? shells.largest : shells.smallest);
  const double t = variable ? smallest : shells.sum / static_cast<double>(shells.count);
  const double half = 0.5 * shortest_side;
  if (half < t) return {half, GapminOrigin::half_edge};
  return {t, !variable    ? GapminOrigin::mean_thickness
             : scale != 1 ? GapminOrigin::scaled_thickness
                          : GapminOrigin::minimum_thickness};
}

double shortest_of_both(const EdgeSide& main, const EdgeSide& secondary) {
  if (main.shortest == 0) return secondary.shortest;
  return secondary.shortest == 0 ? main.shortest : std::min(main.shortest, secondary.shortest);
}

DefaultGap default_edge_gap(const EdgeSide& main, const EdgeSide& secondary, bool variable) {
  return {0.5 * (default_of_side(main, variable) + default_of_side(secondary, variable)),
          GapminOrigin::both_sides};
}

double largest_gap(int igap, double gapmin, double gapmax, const SideExtremes& sides) {
  if (igap == 0) return gapmin;
  double sum = sides.thickest_main + sides.thickest_secondary;
  if (igap == 3) sum = std::min(sum, sides.longest_main + sides.longest_secondary);
  return std::min(std::max(sum, gapmin), gapmax);
}

double largest_edge_gap(double gapmin, const SideExtremes& sides) {
  return std::max(sides.thickest_main + sides.thickest_secondary, gapmin);
}

double radiation_distance(bool thermal, double drad, double largest_gap, double shortest_side) {
  if (!thermal) return 0;
  return drad == 0 ? std::max(largest_gap, shortest_side) : std::max(drad, largest_gap);
}

namespace {

int unless_nothing(int value) { return value == 1000 ? 0 : value; }

}  // namespace

double mesh_fraction_of(double cell) { return cell != 0 ? cell : 0.4; }

void apply(const WhatIf& change, int interface_type, CardSettings& card) {
  if (change.Gapmin) card.gapmin = *change.Gapmin;
  if (interface_type == 10) return;
  if (change.Fscalegap) card.gap_scale = *change.Fscalegap;
  if (change.Gapmax) card.gapmax = *change.Gapmax;
  if (change.Fpenmax && interface_type == 7) card.fpenmax = *change.Fpenmax;
  if (change.mesh_size) card.mesh_fraction = mesh_fraction_of(*change.mesh_size);
  if (change.Igap) card.igap = unless_nothing(*change.Igap);
  if (change.Inacti) card.inacti = unless_nothing(*change.Inacti);
  if (change.Irem_gap) card.irem_gap = *change.Irem_gap == 0 ? 1 : *change.Irem_gap;
}

void adapt_to_type19_nodes(CardSettings& card) {
  if (card.igap != 4) return;  // undocumented: variable gap with curvilinear removal
  card.igap = 2;
  card.irem_gap = 2;
}

void adapt_to_type19_edges(CardSettings& card, double edge_scale_gap) {
  if (card.igap == 4) card.irem_gap = 2;
  card.igap = card.igap == 2 ? 1 : card.igap == 4 ? 0 : card.igap;
  if (edge_scale_gap != 0) card.gapmin *= edge_scale_gap;
}

double gap_scale_of(const CardSettings& card, bool edges) {
  return !edges && card.igap >= 2 && card.gap_scale != 0 ? card.gap_scale : 1;
}

double gapmax_of(const CardSettings& card, bool edges) {
  return !edges && card.igap >= 2 && card.gapmax != 0 ? card.gapmax : no_gap_limit;
}

}  // namespace detail
}  // namespace deck
