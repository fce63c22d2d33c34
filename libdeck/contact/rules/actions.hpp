// Initial penetration of a pair in the solver's arithmetic; actions of Inacti and Fpenmax.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/shared/vec.hpp"
#include "contact/shared/closest.hpp"
#include "deck/contacts.hpp"

namespace deck::detail {

/// Figures of one pair, in contact or not, from closest_on_segment().
inline PenetrationRow measured_row(const SegmentClosest<double>& closest, double gap) {
  const auto pene = penetration(closest, gap);
  PenetrationRow row;
  row.depth = pene.value;
  row.gap = gap;
  row.distance = closest.sub[static_cast<std::size_t>(pene.sub)].distance;
  row.normal = {pene.normal.x, pene.normal.y, pene.normal.z};
  row.on_surface = pene.on_surface;
  return row;
}

/// From closest_between_edges().
inline PenetrationRow measured_row(const EdgeClosest<double>& closest, double gap) {
  PenetrationRow row;
  row.gap = gap;
  row.distance = closest.distance;
  row.depth = gap - closest.distance;
  row.on_surface = !(closest.distance > 0);
  if (!row.on_surface)
    row.normal = {closest.vector.x / closest.distance, closest.vector.y / closest.distance,
                  closest.vector.z / closest.distance};
  row.weight_s = closest.weight_s;
  row.weight_m = closest.weight_m;
  return row;
}

/// Coordinates that Inacti 3 may change.
struct MovableNodes {
  std::span<double> x, y, z;
  Vec at(std::uint32_t n) const { return {x[n], y[n], z[n]}; }
  void put(std::uint32_t n, Vec v) const { x[n] = v.x, y[n] = v.y, z[n] = v.z; }
};

/// The solver measures a group of candidates before it acts on any of them; the next group sees
/// moved nodes (Inacti 3). Keeps the positions of a group's nodes at its start.
class CandidateGroup {
 public:
  /// Counts a candidate. True if it begins a new group: act on the old one first.
  bool begins_another();
  /// Call before acting on a group.
  void start() { seen_.clear(); }
  /// Position of `node` at the start of the group; its present one if new in the group.
  Vec start_of(const MovableNodes& x, std::uint32_t node);

 private:
  std::size_t count_ = 0;
  std::vector<std::pair<std::uint32_t, Vec>> seen_;
};

/// Acts on a penetration of `node`: sets action and figures of the row; Inacti 3 moves the node.
void act_on_node(int inacti, double fpenmax, PenetrationRow& row, const MovableNodes& x,
                 std::uint32_t node, CandidateGroup& group);

/// Acts on a TYPE24 or TYPE25. Both store a permanent reduction; a TYPE25 stores none with -1, and
/// with Inacti 0 only penetrations too small to count are stored.
void act_on_type24_25(int type, int inacti, PenetrationRow& row);

/// Solver error for a node exactly on a segment; 0: none.
int on_surface_error(int type, int itied, double fpenmax, int inacti);

/// Acts on a penetration of two edges. With Inacti 5 and 6 the stores of both edges grow; the
/// remaining gap is known after the last pair (complete_edge_row).
void act_on_edges(int inacti, PenetrationRow& row, double& secondary_store, double& main_store);
void complete_edge_row(PenetrationRow& row, double secondary_store, double main_store);

}  // namespace deck::detail
