// What a card says about gaps and initial penetrations, and what the parts of its interface make of
// it. These rules know nothing of decks; the page of the HTML report follows them (what_if.ts).
#pragma once
#include "deck/contact/what_if.hpp"

namespace deck::detail {

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

}  // namespace deck::detail
