// Card values of an interface as its contacts take them: other settings, TYPE19, factors and
// limits.
#include "contact/rules/settings.hpp"

namespace deck::detail {
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

}  // namespace deck::detail
