// Element quantities that heat and initial conditions share. Private to the stage.
#pragma once
#include <optional>
#include <vector>

#include "deck/contact/scene.hpp"

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

}  // namespace deck::cycle::detail
