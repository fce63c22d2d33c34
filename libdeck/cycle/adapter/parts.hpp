// What only some effects want to know about a contact's pairs, each filled into ContactPairs on its
// own. Private to the stage.
#pragma once
#include "contact/shared/node_elements.hpp"
#include "cycle/state/state_parts.hpp"
#include "deck/cycle/adapter.hpp"

namespace deck::cycle::detail {

/// Area of each secondary node: its share of the shells around it, 0 where there are none.
void node_areas(const Scene& scene, const Contact& contact, ContactPairs& out);
/// Widths of both edges for heat, of the mesh at the start. What carries the last edge of a side
/// rules for all of them: half the root of the area that its shells give to it (half the thickness
/// more where it has one shell only), shares of faces of solids, or sections of beams and trusses.
/// As in the solver edges of solids count only when their second node is in the second slot, and
/// take the sum of areas for the width, so nearly all are 0.
void edge_widths(const Scene& scene, const Contact& contact, ContactPairs& out);

/// /FRICTION by pairs of parts: coefficient, tangential damping, constants of the law, and both
/// directions where there are orthotropic pairs. Parts that no pair names, and pairs that are not
/// listed, take the default values. The first direction is that of /FRIC_ORIENT for the part of the
/// main segment, else the first axis of the segment.
void pair_friction(const Scene& scene, const Contact& contact, ContactPairs& out);
/// Whether a /FRICTION has pairs with coefficients by direction.
bool orthotropic(const Friction& friction);

/// Conductivity of the shell at a node (its first), by temperature; 0 where nothing says it.
class NodeConductivity {
 public:
  explicit NodeConductivity(const deck::Model& model)
      : model_(&model), connectivity_(model), laws_(conductivities(model)) {}
  double operator()(NodeIndex node, double temperature);

 private:
  const deck::Model* model_;
  Connectivity connectivity_;
  std::vector<Conductivity> laws_;
};

}  // namespace deck::cycle::detail
