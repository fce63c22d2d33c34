// Data of materials and properties for time steps; formulas per kind of element. Private.
#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/shared/vec.hpp"
#include "model/mesh/condition_cards.hpp"
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
  double plate_modulus = not_known;  ///< modulus for the nodal stiffness of shells
  double fixed_step = 0;             ///< step of solids of this law; 0: computed
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

/// Data of an element's part.
struct PartRow {
  MaterialFigures material;
  PropertyFigures property;
  double thickness = 0;       ///< for elements without their own
  bool rigid = false;         ///< void: does not limit the step
  const char* why = nullptr;  ///< reason why steps of its elements are unknown; nullptr: known
};

/// Results of one element.
struct ElementOutcome {
  double dt = no_step, mass = 0, length = 0;
  double inertia = 0;                    ///< shared like the mass
  double stiffness = 0, rotational = 0;  ///< per node
  std::array<double, 8> share{};         ///< share of the mass per slot
  /// For mid-side nodes, and the second node of pulleys.
  double middle_share = 0, middle_stiffness = 0;
  double beam_factor = 1;     ///< Mesh::beam_factors
  const char* why = nullptr;  ///< reason why dt is unknown
};

std::vector<MaterialFigures> material_figures(const Model& model);
std::vector<PropertyFigures> property_figures(const Model& model);
std::vector<PartRow> part_rows(const Model& model);

void shell4_outcome(const PartRow& row, double thickness, const std::array<Vec, 4>& x,
                    ElementOutcome& out);
void shell3_outcome(const PartRow& row, double thickness, const std::array<Vec, 3>& x,
                    ElementOutcome& out);
/// `x`: eight slots; `middle`: six mid-side points of a tetrahedron, or nullptr.
void solid_outcome(const PartRow& row, SolidShape shape, const std::array<Vec, 8>& x,
                   const std::array<Vec, 6>* middle, ElementOutcome& out);
/// `axisymmetric`: about z, per radian; otherwise masses of plane elements are unknown.
void quad_outcome(const PartRow& row, const std::array<Vec, 4>& x, bool axisymmetric,
                  ElementOutcome& out);
void truss_outcome(const PartRow& row, double length, ElementOutcome& out);
void beam_outcome(const PartRow& row, double length, ElementOutcome& out);
/// `on_body`: an end is a secondary node of a rigid body.
void spring_outcome(const PartRow& row, double length, bool on_body, ElementOutcome& out);

/// The node of an id in a block; no_index: none.
NodeIndex node_of(const Model& model, const Block& block, std::int64_t id);
/// The node group of an id in the block's submodel; nullptr: none.
const NodeSet* group_of(const Model& model, const Block& block, std::int64_t id);
/// The nodes of the block's tie; nullptr: unknown.
const TiedNodes* tie_of(const std::vector<TiedNodes>* ties, const Block& block);

/// Sums xx yy zz xy yz zx.
template <class Vectors>
std::array<double, 6> products(const Vectors& vectors) {
  std::array<double, 6> out{};
  for (const Vec& d : vectors) {
    out[0] += d.x * d.x;
    out[1] += d.y * d.y;
    out[2] += d.z * d.z;
    out[3] += d.x * d.y;
    out[4] += d.y * d.z;
    out[5] += d.z * d.x;
  }
  return out;
}

/// sqrt(1 + v^2) - v
double damping_factor(double v);
/// Adds m (d^2 1 - d d) to a tensor xx yy zz xy yz zx.
void add_point(std::array<double, 6>& tensor, double m, const Vec& d);
/// Step of solids and quads from length and size (edge of a cube of equal volume).
double bulk_step(const PartRow& row, double length, double size);

/// Values at the start for every node; stiffness up to this value counts as 0.
inline constexpr double no_stiffness = 1e-20;

class NodeSums {
 public:
  NodeSums(const Model& model, const MeshOptions& options, NodeFigures& to);
  /// True for secondary nodes of rigid bodies.
  bool on_body(NodeIndex n) const { return on_body_[n]; }
  void add(NodeIndex n, double mass, double stiffness) {
    to_.mass[n] += mass;
    to_.stiffness[n] += stiffness;
  }
  void add_rotation(NodeIndex n, double inertia, double stiffness) {
    to_.inertia[n] += inertia;
    to_.rotational_stiffness[n] += stiffness;
  }
  /// Call it after the last element.
  void complete(const Places& places);

  std::vector<LeftOut> left_out;

 private:
  void added_masses();
  void walls();
  void body(const RigidBody& body, const Places& places);
  void rigid_elements(const Places& places);
  void rigid_element(const RigidElement& element, const Places& places, std::uint64_t& left);
  void damping();
  void damp(const NodeSet& group, double alpha, double beta);
  double least_step() const;
  double step(std::size_t n) const;
  void steps();
  void forget(NodeIndex n, std::uint64_t& count);

  // Defined in node_ties.cpp.
  struct TieCounts {
    std::uint64_t penalty = 0, other = 0;  ///< nodes that are not evaluated
  };
  void ties(const std::vector<TiedNodes>* ties, const Places& places);
  void tie(const TiedNodes& tie, const Places& places, TieCounts& counts);
  void carry(const TiedNodes& tie, const TiedNodes::Row& row);
  void carry_moments(const TiedNodes& tie, const TiedNodes::Row& row, const Places& places);
  void forget_tie(const Block& block, std::uint64_t& count);
  void clear(NodeIndex n);

  const Model& model_;
  const MeshOptions& options_;
  NodeFigures& to_;
  std::vector<RigidBody> bodies_;
  std::vector<char> on_body_;
  std::uint64_t massless_ = 0;  ///< main nodes of bodies without mass
};

}  // namespace deck::detail
