// Masses and stiffness of nodes as elements add to them, and what rigid bodies, added masses, ties
// and damping make of them. Private to the mesh.
#pragma once
#include <vector>

#include "model/mesh/mesh_parts.hpp"
#include "model/mesh/rigid_bodies.hpp"
#include "model/shared/mesh.hpp"

namespace deck::detail {

/// Where every node starts, and what is no stiffness.
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
  /// After the last element.
  void finish(const Places& places);

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

  // node_ties.cpp
  struct TieCounts {
    std::uint64_t penalty = 0, other = 0;  ///< nodes that are not computed
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
