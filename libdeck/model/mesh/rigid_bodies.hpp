// Rigid bodies as their cards name them. Shared by the mesh and the kinematic conditions.
#pragma once
#include <array>
#include <vector>

#include "deck/model/model.hpp"

namespace deck::detail {

struct RigidBody {
  std::int64_t id = 0;
  const Block* block = nullptr;
  NodeIndex main = no_index;
  std::vector<NodeIndex> nodes;  ///< secondary ones, each once, without the main node
  bool lagrange = false;         ///< /RBODY/LAGMUL
  std::int64_t sensor = 0;
  int ikrem = 0, centre = 1;  ///< ICoG
  bool spherical = false;
  double mass = 0;
  std::array<double, 6> inertia{};  ///< xx yy zz xy yz xz of the card
};

/// In the order of the deck.
std::vector<RigidBody> rigid_bodies(const Model& model);

}  // namespace deck::detail
