// Inputs of single effects for a contact's pairs, each written into ContactPairs separately, and
// quantities of elements for heat and initial conditions.
#pragma once
#include <optional>
#include <vector>

#include "contact/shared/node_elements.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle::detail {

/// The part that an element of a contact carrier belongs to.
std::uint32_t part_of(const deck::Model& model, Carrier carrier, std::uint32_t element);

/// Conductivity by /HEAT/MAT: A + B T, above T1 with the constants of the liquid.
struct Conductivity {
  double solid_a = 0.0, solid_b = 0.0, liquid_a = 0.0, liquid_b = 0.0, melting = 1e30;
  double operator()(double t) const {
    return t < melting ? solid_a + solid_b * t : liquid_a + liquid_b * t;
  }
};
/// By material index, in working units; zeros without /HEAT/MAT.
std::vector<Conductivity> conductivities(const deck::Model& model);

/// Area of a shell (kind shell4 or shell3).
double shell_area(const Coordinates& x, ElementKind kind, const NodeIndex* n);
/// Map from local to global components of a skew fixed in space.
std::optional<AffineMap> fixed_axes(const deck::Model& model, std::int64_t skew);

/// Area of each secondary node: its share of adjacent shells; 0 without shells.
void node_areas(const Scene& scene, const Contact& contact, ContactPairs& out);
/// Widths of both edges for heat, in the initial mesh. The carrier of a side's last edge decides
/// for all: half the root of the area of its shells (plus half the thickness for a single shell),
/// shares of faces of solids, or sections of beams and trusses. As in the solver, edges of solids
/// count only if their second node is in the second slot, and the sum of areas serves as width:
/// nearly all are 0.
void edge_widths(const Scene& scene, const Contact& contact, ContactPairs& out);

/// /FRICTION by pairs of parts: coefficient, tangential damping, law constants, and both directions
/// if there are orthotropic pairs. Pairs not listed there have the default values. The first
/// direction is /FRIC_ORIENT of the main segment's part, else the first axis of the segment.
void pair_friction(const Scene& scene, const Contact& contact, ContactPairs& out);
/// True if a /FRICTION has pairs with directional coefficients.
bool has_orthotropic_pairs(const Friction& friction);

/// Conductivity of the first shell at a node, by temperature; 0 if the deck does not give it.
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
