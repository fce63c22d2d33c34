// Kinematic conditions of nodes (boundary conditions, rigid bodies, ties, walls ...) in the
// solver's booking order, and their conflicts.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "deck/model.hpp"
#include "model/shared/mesh.hpp"

namespace deck {

enum class ConditionType : std::uint8_t {
  bcs,
  imposed,  ///< velocity, displacement, acceleration
  rlink,
  rbe2,
  rbe3,
  lagmul,
  rwall,
  rbody,
  tied,
  cyl_joint,
};
inline constexpr std::size_t condition_types = 10;
/// "BCS", "IMPOSED", "RLINK", "RBE2", "RBE3", "LAGMUL", "RWALL", "RBODY", "TIED", "CYL_JOINT"
const char* to_string(ConditionType type);

/// An option of the deck with conditions on nodes.
struct ConditionSource {
  ConditionType type = ConditionType::bcs;
  const Block* block = nullptr;
  std::int64_t id = 0;
};

/// Two conditions on one freedom of a node.
struct KinematicConflict {
  NodeIndex node = no_index;
  std::uint8_t direction = 0;            ///< 0 to 5: TX TY TZ RX RY RZ, 6: all
  std::uint32_t later = 0, earlier = 0;  ///< positions in Kinematics::sources
  bool counted = true;                   ///< false: node with a rigid wall and a rigid body
};

/// Nodes that a rigid wall loses to other conditions.
struct WallCorrection {
  std::uint32_t wall = 0;        ///< in Kinematics::sources
  std::vector<NodeIndex> nodes;  ///< ascending
};

/// A node that is secondary in two rigid bodies.
struct SharedBody {
  NodeIndex node = no_index;
  std::uint32_t first = 0, second = 0;  ///< in Kinematics::sources
  bool sensor = false;                  ///< one body has a sensor: a warning, not an error
};

/// A condition that the solver refuses or changes, with its message.
struct ForbiddenCondition {
  int message = 0;
  NodeIndex node = no_index;
  std::uint32_t first = 0, second = 0;  ///< in Kinematics::sources
};

struct Kinematics {
  std::vector<ConditionSource> sources;
  std::uint64_t conflicts = 0;              ///< number in message 312
  std::vector<KinematicConflict> bookings;  ///< conflicts in booking order; those of ties once
  std::vector<WallCorrection> walls;
  std::vector<SharedBody> shared;
  std::vector<ForbiddenCondition> forbidden;
  bool stops = false;  ///< an error ends the check without a list
  std::vector<LeftOut> left_out;

  /// Types of a node as bits, after the corrections.
  std::vector<std::uint16_t> types;
  /// Nodes that the solver lists with several types, ascending.
  std::vector<NodeIndex> several;

  /// Conditions of one node: positions in `sources`, in booking order.
  std::span<const std::uint32_t> of(NodeIndex n) const {
    return {entries.data() + first[n], entries.data() + first[n + 1]};
  }
  std::vector<std::uint32_t> first, entries;  ///< rows by node
};

/// `ties`: nodes of /INTER/TYPE2; nullptr: unknown, all secondary nodes are booked.
Kinematics read_kinematics(const Model& model, const std::vector<TiedNodes>* ties = nullptr);

}  // namespace deck
