// Options with kinematic conditions, as on their cards. Private to the mesh.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "deck/model.hpp"
#include "model/shared/kinematics.hpp"

namespace deck::detail {

/// Phase in which the solver books a condition; within a phase by kind, file and id.
enum class Turn : std::uint8_t { before_ties, walls_and_bodies, ties, joints, late_ties };

struct ConditionCard {
  ConditionType type = ConditionType::bcs;
  Turn turn = Turn::before_ties;
  int rank = 0;  ///< by kind of option: ascending within a phase
  const Block* block = nullptr;
  std::int64_t id = 0;
  std::vector<NodeIndex> nodes;  ///< nodes with the condition, without duplicates
  std::uint8_t directions = 0;   ///< TX TY TZ RX RY RZ, lowest bit first
  std::int64_t system = 0;
  bool twice = false;              ///< ties whose conflicts the solver counts twice
  bool lagrange = false;           ///< constrains all freedoms by multipliers
  bool sensor = false;             ///< rigid bodies
  bool penalty = false;            ///< walls
  NodeIndex main = no_index;       ///< rigid bodies, RBE2
  std::vector<NodeIndex> leaders;  ///< independent nodes of RBE3
};

struct Refusal {
  int message = 0;
  NodeIndex node = no_index;
  std::uint32_t first = 0, second = 0;
  bool ends = false;  ///< an error after which the check ends
};

struct ConditionCards {
  std::vector<ConditionCard> cards;
  std::vector<LeftOut> left_out;
  std::vector<std::size_t> penalty_elements;  ///< RBE3 changed to a penalty
  bool ikrem = false;                         ///< of the last rigid body; applies to all
  std::vector<char> condensed;                ///< mid-side nodes that are not counted; empty: none

  std::vector<std::size_t> order(Turn turn) const;
  bool excluded(ConditionType type, NodeIndex n) const;
  /// Errors of rigid elements and bodies that depend on one another; sets penalty_elements.
  std::vector<Refusal> refusals(const Model& model);
};

ConditionCards read_condition_cards(const Model& model, const std::vector<TiedNodes>* ties);

struct RigidBody {
  std::int64_t id = 0;
  const Block* block = nullptr;
  NodeIndex main = no_index;
  std::vector<NodeIndex> nodes;  ///< secondary nodes without duplicates and main node
  bool lagrange = false;         ///< /RBODY/LAGMUL
  std::int64_t sensor = 0;
  int ikrem = 0, centre = 1;  ///< ICoG
  bool spherical = false;
  double mass = 0;
  std::array<double, 6> inertia{};  ///< xx yy zz xy yz xz on the card
};

/// /RBE2
struct RigidElement {
  const Block* block = nullptr;
  NodeIndex main = no_index;
  std::vector<NodeIndex> nodes;  ///< secondary nodes without duplicates and main node
  std::uint8_t directions = 0;   ///< TX TY TZ RX RY RZ, lowest bit first
  std::int64_t skew = 0;
};

/// All rigid bodies in the solver's order.
std::vector<RigidBody> rigid_bodies(const Model& model);
std::optional<RigidElement> rigid_element(const Model& model, const Block& block);

}  // namespace deck::detail
