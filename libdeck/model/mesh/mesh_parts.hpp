// What materials and properties say about time steps, and the formulas by kind of element. Private
// to the mesh.
#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/shared/vec.hpp"
#include "model/shared/mesh.hpp"

namespace deck::detail {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Places of all nodes.
struct Places {
  const double *x, *y, *z;
  Vec at(NodeIndex n) const { return {x[n], y[n], z[n]}; }
};

struct MaterialFigures {
  int law = -1;
  double density = 0, reference_density = 0, young = 0, poisson = 0, shear = 0;
  double shell_speed = not_known, solid_speed = not_known, stored_speed = not_known;
  double plate_modulus = not_known;  ///< the modulus that shells' nodal stiffness is formed with
  double fixed_step = 0;             ///< of solids of this law; 0: none
  double tetra_ratio = not_known;    ///< 2 G / (B + 4/3 G)
};

/// One direction of a spring.
struct SpringFreedom {
  double k = 0, c = 0;
  bool known = true;
};

struct PropertyFigures {
  int type = -1;
  double thickness = 0, area = 0, membrane = 0, numeric = 0;  ///< dm, dn
  int ishell = 0, ish3n = 2, isolid = 1, itetra10 = 0, inpts = 0, icstr = 0;
  double qb = 0.05, lambda = 0, mu = 0;
  bool viscosity_blank = false;      ///< qa and qb are both blank
  double iyy = 0, izz = 0, ixx = 0;  ///< beams
  double beam_membrane = 0, beam_bending = 0;
  double spring_mass = 0, spring_inertia = 0;
  bool per_length = false;
  std::array<SpringFreedom, 6> freedom{};  ///< springs
  std::vector<std::uint32_t> layers;       ///< materials of layers
};

/// What an element takes from its part.
struct PartRow {
  MaterialFigures material;
  PropertyFigures property;
  double thickness = 0;       ///< where the element has none
  bool rigid = false;         ///< void: limits nothing
  const char* why = nullptr;  ///< no step of its elements is established, for this reason
};

/// What one element gives.
struct ElementOutcome {
  double dt = no_step, mass = 0, length = 0;
  double inertia = 0;                    ///< of the element, to be shared like the mass
  double stiffness = 0, rotational = 0;  ///< of every node
  std::array<double, 8> share{};         ///< of the mass, by slot
  /// Of nodes in the middle of sides; of pulleys, of the second node.
  double middle_share = 0, middle_stiffness = 0;
  double beam_factor = 1;     ///< Mesh::beam_factors
  const char* why = nullptr;  ///< why dt is not known
};

std::vector<MaterialFigures> material_figures(const Model& model);
std::vector<PropertyFigures> property_figures(const Model& model);
std::vector<PartRow> part_rows(const Model& model);

void shell4_outcome(const PartRow& row, double thickness, const std::array<Vec, 4>& x,
                    ElementOutcome& out);
void shell3_outcome(const PartRow& row, double thickness, const std::array<Vec, 3>& x,
                    ElementOutcome& out);
/// `x`: the eight slots; `middle`: the six points of a tetrahedron's sides, nullptr: none.
void solid_outcome(const PartRow& row, SolidShape shape, const std::array<Vec, 8>& x,
                   const std::array<Vec, 6>* middle, ElementOutcome& out);
/// `axisymmetric`: about z, per radian; else masses of plane elements are not known.
void quad_outcome(const PartRow& row, const std::array<Vec, 4>& x, bool axisymmetric,
                  ElementOutcome& out);
void truss_outcome(const PartRow& row, double length, ElementOutcome& out);
void beam_outcome(const PartRow& row, double length, ElementOutcome& out);
/// `on_body`: an end is a secondary node of a rigid body.
void spring_outcome(const PartRow& row, double length, bool on_body, ElementOutcome& out);

/// sqrt(1 + v^2) - v
double damping_factor(double v);
/// Step of solids and quads from a length and a size (edge of a cube of its volume).
double bulk_step(const PartRow& row, double length, double size);

}  // namespace deck::detail
