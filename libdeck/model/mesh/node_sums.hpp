// Masses and stiffness of nodes as elements add to them, and what rigid bodies, added masses, ties
// and damping make of them. Private to the mesh.
#pragma once
#include <vector>

#include "deck/model/mesh.hpp"
#include "model/mesh/mesh_parts.hpp"
#include "model/mesh/rigid_bodies.hpp"

namespace deck::detail {

class NodeSums {
 public:
  NodeSums(const Model& model, NodeFigures& to);
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
  void rigid_elements();
  void ties();
  void damping();
  void steps();
  void forget(NodeIndex n, std::uint64_t& count);

  const Model& model_;
  NodeFigures& to_;
  std::vector<RigidBody> bodies_;
  std::vector<char> on_body_;
};

}  // namespace deck::detail
