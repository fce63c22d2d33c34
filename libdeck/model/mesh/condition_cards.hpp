// The options that put kinematic conditions on nodes, as their cards say. Private to the mesh.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "deck/model.hpp"
#include "model/shared/kinematics.hpp"

namespace deck::detail {

/// When the solver books a condition; within a turn by kind, then by file and id.
enum class Turn : std::uint8_t { before_ties, walls_and_bodies, ties, joints, late_ties };

struct ConditionCard {
  ConditionType type = ConditionType::bcs;
  Turn turn = Turn::before_ties;
  int rank = 0;  ///< of the kind of option: ascending within a turn
  const Block* block = nullptr;
  std::int64_t id = 0;
  std::vector<NodeIndex> nodes;  ///< that get the condition, each once
  std::uint8_t directions = 0;   ///< TX TY TZ RX RY RZ, from the lowest bit
  std::int64_t system = 0;
  bool twice = false;              ///< ties whose conflicts the solver counts twice
  bool lagrange = false;           ///< holds all freedoms by multipliers
  bool sensor = false;             ///< rigid bodies
  bool penalty = false;            ///< walls
  bool forced = false;             ///< RBE3 that may not become a penalty
  NodeIndex main = no_index;       ///< rigid bodies, RBE2
  std::vector<NodeIndex> leaders;  ///< independent nodes of RBE3
};

struct Refusal {
  int message = 0;
  NodeIndex node = no_index;
  std::uint32_t first = 0, second = 0;
  bool ends = false;  ///< an error that ends the check
};

struct ConditionCards {
  std::vector<ConditionCard> cards;
  std::vector<LeftOut> left_out;
  std::vector<std::size_t> penalty_elements;  ///< RBE3 that became a penalty
  bool ikrem = false;                         ///< of the last rigid body: holds for all
  std::vector<char> condensed;                ///< middle nodes that do not count; empty: none

  std::vector<std::size_t> order(Turn turn) const;
  bool taken_out(ConditionType type, NodeIndex n) const;
  /// Rigid elements and bodies that hang on one another; fills penalty_elements.
  std::vector<Refusal> refusals(const Model& model);
};

ConditionCards read_condition_cards(const Model& model, const std::vector<TiedNodes>* ties);

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
