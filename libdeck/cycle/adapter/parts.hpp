// What only some effects want to know about a contact's pairs, each filled into ContactPairs on its
// own, and quantities of elements for heat and initial conditions. Private to the stage.
#pragma once
#include <optional>
#include <vector>

#include "contact/shared/node_elements.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle::detail {

/// The part that an element of a contact carrier belongs to.
std::uint32_t part_of(const deck::Model& model, Carrier carrier, std::uint32_t element);

/// Conductivity of a material as its /HEAT/MAT gives it: A + B T, from T1 on that of the liquid.
struct Conductivity {
  double solid_a = 0.0, solid_b = 0.0, liquid_a = 0.0, liquid_b = 0.0, melting = 1e30;
  double operator()(double t) const {
    return t < melting ? solid_a + solid_b * t : liquid_a + liquid_b * t;
  }
};
/// By material index, working units; zeros for materials without /HEAT/MAT.
std::vector<Conductivity> conductivities(const deck::Model& model);

/// Area of a shell (kind shell4 or shell3).
double shell_area(const Coordinates& x, ElementKind kind, const NodeIndex* n);
/// Axes of a skew that is fixed in space, as a map from local to global components.
std::optional<AffineMap> fixed_axes(const deck::Model& model, std::int64_t skew);

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
