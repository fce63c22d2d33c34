// Kinematic conditions: what holds the freedoms of nodes (boundary conditions, rigid bodies, ties,
// walls ...), in the order in which the reference solver books them, and which bookings conflict.
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

/// An option of the deck that puts a condition on nodes.
struct ConditionSource {
  ConditionType type = ConditionType::bcs;
  const Block* block = nullptr;
  std::int64_t id = 0;
};

/// Two conditions that want the same freedom of a node.
struct KinematicConflict {
  NodeIndex node = no_index;
  std::uint8_t direction = 0;            ///< 0 to 5: TX TY TZ RX RY RZ, 6: all
  std::uint32_t later = 0, earlier = 0;  ///< positions in Kinematics::sources
  bool counted = true;                   ///< false: on a node with a rigid wall and a rigid body
};

/// Nodes that a rigid wall loses because something else holds them.
struct WallCorrection {
  std::uint32_t wall = 0;        ///< in Kinematics::sources
  std::vector<NodeIndex> nodes;  ///< ascending
};

/// A node that is secondary in two rigid bodies.
struct SharedBody {
  NodeIndex node = no_index;
  std::uint32_t first = 0, second = 0;  ///< in Kinematics::sources
  bool sensor = false;                  ///< one of the bodies has one: a warning, not an error
};

/// Something that the solver refuses or turns into something else, with its message.
struct ForbiddenCondition {
  int message = 0;
  NodeIndex node = no_index;
  std::uint32_t first = 0, second = 0;  ///< in Kinematics::sources
};

struct Kinematics {
  std::vector<ConditionSource> sources;
  std::uint64_t conflicts = 0;              ///< the number of message 312
  std::vector<KinematicConflict> bookings;  ///< that conflict, in their order; those of ties once
  std::vector<WallCorrection> walls;
  std::vector<SharedBody> shared;
  std::vector<ForbiddenCondition> forbidden;
  bool stops = false;  ///< an error ends the check before anything is listed
  std::vector<LeftOut> left_out;

  /// Types on a node as bits, after the corrections.
  std::vector<std::uint16_t> types;
  /// Nodes that the solver lists with several types, ascending.
  std::vector<NodeIndex> several;

  /// Conditions of one node: positions in `sources`, in the order of booking.
  std::span<const std::uint32_t> of(NodeIndex n) const {
    return {entries.data() + first[n], entries.data() + first[n + 1]};
  }
  std::vector<std::uint32_t> first, entries;  ///< rows by node
};

/// `ties`: what /INTER/TYPE2 hold; nullptr: not known, all their secondary nodes are booked.
Kinematics read_kinematics(const Model& model, const std::vector<TiedNodes>* ties = nullptr);

}  // namespace deck
