// How far and which way a node may move: out of the penetrations it is in, along their normals, and
// by no more than the depth that it repairs there. Private to the stage.
#pragma once
#include <unordered_map>
#include <vector>

#include "edit/fix/nodes/depenetrate_rows.hpp"

namespace deck::detail {

class DepthBounds {
 public:
  /// A penetration as it is before anything moves: `normal` leads from main to secondary, its nodes
  /// may move by `reach`, the secondary ones along it, the main ones against it.
  void add(const PairKey& key, const PairState& state, const Vec& normal, double reach);

  bool contains(NodeIndex n) const { return nodes_.contains(n); }
  /// The penetrations that a node is in; none of one that follows.
  const std::vector<PairKey>& pairs_of(NodeIndex n) const { return nodes_.at(n).pairs; }
  double reach_of(NodeIndex n) const { return nodes_.at(n).reach; }
  /// The closest to `wanted` that a node may be away from its place: a sum of shares of its
  /// normals, none negative, and along none of them farther than its reach.
  struct Place {
    Vec by;
    bool at_bound = false;
  };
  std::vector<Place> allowed(const NodeMoves& wanted, int threads) const;

 private:
  struct Bound {
    double reach = 0;
    std::vector<Vec> directions;  ///< unit, all different
    std::vector<PairKey> pairs;
  };
  static Place closest_place(const Bound& bound, const Vec& wanted);
  std::unordered_map<NodeIndex, Bound> nodes_;
};

}  // namespace deck::detail
