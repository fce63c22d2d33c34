// Initial penetration of one pair in the solver's own arithmetic, and what Inacti and Fpenmax do
// about it.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/shared/vec.hpp"
#include "contact/shared/closest.hpp"
#include "deck/contacts.hpp"

namespace deck::detail {

/// Figures of one pair, in contact or not; conventions of closest_on_segment.
template <Form F>
PenetrationRow measured_row(const Point3<double>& p, const std::array<Point3<double>, 4>& corners,
                            bool triangle, double gap) {
  const auto closest = closest_on_segment<F>(p, corners, triangle);
  const auto pene = penetration(closest, gap);
  PenetrationRow row;
  row.depth = pene.value;
  row.gap = gap;
  row.distance = closest.sub[static_cast<std::size_t>(pene.sub)].distance;
  row.normal = {pene.normal.x, pene.normal.y, pene.normal.z};
  row.on_surface = pene.on_surface;
  return row;
}

/// `x`: both nodes of the secondary, then of the main edge; conventions of closest_between_edges.
template <Form F>
PenetrationRow measured_row(const std::array<Point3<double>, 4>& x, double gap) {
  const auto closest = closest_between_edges<F>(x[0], x[1], x[2], x[3]);
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

/// The solver measures a whole group of candidates before it acts on any of them; nodes moved by
/// one group are seen by the next (Inacti 3). Keeps where the nodes of a group stood at its start.
class CandidateGroup {
 public:
  /// Counts a candidate. True: it begins another group, and the one before has to be acted upon.
  bool begins_another();
  /// Before a group is acted upon.
  void start() { seen_.clear(); }
  /// Where `node` stood; it stands there now unless the group has it already.
  Vec start_of(const MovableNodes& x, std::uint32_t node);

 private:
  std::size_t count_ = 0;
  std::vector<std::pair<std::uint32_t, Vec>> seen_;
};

/// What is done about a penetration of secondary node `node`: sets the row's action and figures,
/// and moves the node with Inacti 3.
void act_on_node(int inacti, double fpenmax, PenetrationRow& row, const MovableNodes& x,
                 std::uint32_t node, CandidateGroup& group);

/// The same of a TYPE24 or TYPE25, which store what is taken off from then on: a TYPE25 with -1
/// nothing, and neither without Inacti but for what is too small to count.
void act_on_modern(int type, int inacti, PenetrationRow& row);
/// Whether a TYPE24 or TYPE25 finds the same penetrations with either Inacti: only 0 looks
/// otherwise.
bool finds_the_same(int inacti, int other);

/// The solver's error for a node exactly on a segment; 0: it starts all the same.
int on_surface_error(int type, int itied, double fpenmax, int inacti);

/// What is done about a penetration of two edges. The stores of both edges grow with Inacti 5 and
/// 6; the gap left is known after the last pair: `finish_edge_row`.
void act_on_edges(int inacti, PenetrationRow& row, double& secondary_store, double& main_store);
void finish_edge_row(PenetrationRow& row, double secondary_store, double main_store);

}  // namespace deck::detail
