// The mesh around moved nodes: who is next to whom, which elements cross, which turn inside out.
// Private to the stage.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "deck/contact/scene.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {

class FixMesh {
 public:
  /// Edges of shells, solids, trusses and beams; faces of shells, exterior faces of solids and the
  /// main segments of the scene.
  explicit FixMesh(const Scene& scene);

  /// Nodes that share an element edge with `n`, ascending.
  std::span<const NodeIndex> neighbours(NodeIndex n) const { return neighbours_.row(n); }
  /// True if a path along element edges no longer than `limit` leads from `from` to one of `to`.
  bool connected_within(const Coordinates& x, NodeIndex from, std::span<const NodeIndex> to,
                        double limit) const;
  /// Part of the first element of a node; no_index: none.
  std::uint32_t part_of(NodeIndex n) const { return part_[n]; }
  /// Nodes whose first part is this one.
  std::uint32_t nodes_of_part(std::uint32_t part) const { return part_nodes_[part]; }

  /// An edge and a face that cross.
  using Crossed = std::pair<std::uint32_t, std::uint32_t>;
  /// Those that touch one of `nodes`, sorted.
  std::vector<Crossed> crossings(const Coordinates& x, std::span<const NodeIndex> nodes,
                                 int threads) const;
  std::vector<Crossed> all_crossings(const Coordinates& x, int threads) const;
  std::vector<NodeIndex> nodes_of(const Crossed& crossing) const;

  /// Nodes of the elements touching `nodes` that are turned inside out at a corner at `now` but not
  /// at `before`.
  std::vector<NodeIndex> inverted(const Coordinates& before, const Coordinates& now,
                                  std::span<const NodeIndex> nodes) const;
  /// Nodes, one of them of `nodes`, of element edges that are shorter at `now` than `least` of
  /// their length `before`.
  std::vector<NodeIndex> shortened(const Coordinates& before, const Coordinates& now,
                                   std::span<const NodeIndex> nodes, double least) const;

 private:
  void collect_faces(const Scene& scene);
  void collect_edges();
  std::vector<bool> marks_of(std::span<const NodeIndex> nodes) const;
  const Model& model_;
  std::vector<std::array<NodeIndex, 2>> edges_;
  std::vector<std::array<NodeIndex, 4>> faces_;
  IndexRows neighbours_;
  std::vector<std::uint32_t> part_, part_nodes_;
};

}  // namespace deck::detail
