// Rigid bodies and rigid elements as their cards name them. Shared by the mesh and the kinematic
// conditions.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
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

/// /RBE2
struct RigidElement {
  const Block* block = nullptr;
  NodeIndex main = no_index;
  std::vector<NodeIndex> nodes;  ///< secondary ones, each once, without the main node
  std::uint8_t directions = 0;   ///< TX TY TZ RX RY RZ, from the lowest bit
  std::int64_t skew = 0;
};

/// In the solver's order.
std::vector<RigidBody> rigid_bodies(const Model& model);
std::optional<RigidElement> rigid_element(const Model& model, const Block& block);

}  // namespace deck::detail
