// Element quantities that masses and time steps share. Private to the stage.
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
/// Volume from the eight slots; the one-point rule makes tetrahedra 1.5 times larger than they are.
double solid_volume(const Coordinates& x, SolidShape shape, const NodeIndex* slots);
/// What the parts of a model give the elements of one kind; looked up once, asked for every
/// element.
class OfParts {
 public:
  struct Row {
    double density = 0.0;  ///< of the material, of any law
    double young = 0.0, bulk = 0.0;
    double thickness = 0.0, section = 0.0;  ///< of the property
    bool moving = false;                    ///< has a material that is neither void nor rigid
  };
  explicit OfParts(const deck::Model& model);
  /// Of a part index; of no_index, zeros.
  const Row& operator[](std::uint32_t part) const {
    return part < rows_.size() - 1 ? rows_[part] : rows_.back();
  }

 private:
  std::vector<Row> rows_;  ///< one a part, and zeros
};

/// Masses of the shells, solids, trusses or beams of a scene, by the formulas of make_state.
class ElementMasses {
 public:
  ElementMasses(const Scene& scene, ElementKind kind);
  /// 0 where a corner is missing, and of other kinds.
  double operator()(std::uint32_t e) const;

 private:
  const Scene& scene_;
  ElementKind kind_;
  const Elements& family_;
  OfParts parts_;
  std::size_t own_thicknesses_;  ///< how many elements have one that counts
};

/// What the elements of one kind allow as time step (see structure_step).
class ElementSteps {
 public:
  ElementSteps(const Scene& scene, ElementKind kind);
  /// 1e30: any.
  double operator()(std::uint32_t e) const;

 private:
  double shell4(std::uint32_t e) const;
  double shell3(std::uint32_t e) const;
  double solid(std::uint32_t e) const;
  double line(std::uint32_t e) const;

  const Scene& scene_;
  ElementKind kind_;
  const Elements& family_;
  OfParts parts_;
};
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
