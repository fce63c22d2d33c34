// Element quantities that masses and time steps share. Private to the stage.
#ifndef DECK_CYCLE_STATE_PARTS_HPP_
#define DECK_CYCLE_STATE_PARTS_HPP_

#include <optional>
#include <vector>

#include "deck/contact/scene.hpp"

namespace deck::cycle::detail {

/// Density of the material of an element's part; 0 where there is none.
double density_of(const deck::Model& model, ElementKind kind, std::uint32_t e);
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
/// Volume from the eight slots; the one-point rule makes tetrahedra 1.5 times larger than they are.
double solid_volume(const Coordinates& x, SolidShape shape, const NodeIndex* slots);
/// Mass of one shell, solid, truss or beam, by the formulas of make_state; 0 where a corner is
/// missing, and of other kinds.
double element_mass(const Scene& scene, ElementKind kind, std::uint32_t e);
/// What one element allows as time step (see structure_step); 1e30: any.
double element_step(const Scene& scene, ElementKind kind, std::uint32_t e);
/// Masses of springs: what their property gives, where its Ileng is 1 times their length.
class SpringMasses {
 public:
  explicit SpringMasses(const deck::Model& model);
  /// 0 where an end is missing, or the property gives no mass.
  double of(const Scene& scene, std::uint32_t spring) const;

 private:
  struct Mass {
    double value = 0.0;
    bool per_length = false;
  };
  std::vector<Mass> by_property_;
};
/// Axes of a skew that is fixed in space, as a map from local to global components.
std::optional<AffineMap> fixed_axes(const deck::Model& model, std::int64_t skew);

}  // namespace deck::cycle::detail

#endif  // DECK_CYCLE_STATE_PARTS_HPP_
