// Tools to move nodes: the mesh around them (neighbours, crossing and inverted elements); direction
// and length that each penetration needs, displacements that solve many of them, limits of nodes,
// translations of bodies.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact/shared/scene_steps.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {

class FixMesh {
 public:
  /// Edges of shells, solids, trusses and beams; faces of shells, exterior faces of solids and the
  /// main segments of the scene.
  explicit FixMesh(const Scene& scene);

  /// Nodes that share an element edge with `n`, ascending.
  std::span<const NodeIndex> neighbours(NodeIndex n) const { return neighbours_.row(n); }
  /// True if a path along element edges, at most `limit` long, leads from `from` to one of `to`.
  bool connected_within(const Coordinates& x, NodeIndex from, std::span<const NodeIndex> to,
                        double limit) const;
  /// Part of the first element of a node; no_index if none.
  std::uint32_t part_of(NodeIndex n) const { return part_[n]; }
  /// Number of nodes whose first part this is.
  std::uint32_t nodes_of_part(std::uint32_t part) const { return part_nodes_[part]; }

  /// An edge and a face that cross.
  using Crossed = std::pair<std::uint32_t, std::uint32_t>;
  /// Crossings that touch one of `nodes`, sorted.
  std::vector<Crossed> crossings(const Coordinates& x, std::span<const NodeIndex> nodes,
                                 int threads) const;
  std::vector<Crossed> all_crossings(const Coordinates& x, int threads) const;
  std::vector<NodeIndex> nodes_of(const Crossed& crossing) const;

  /// Nodes of elements touching `nodes` with a corner that is inverted at `now` but not at
  /// `before`.
  std::vector<NodeIndex> inverted(const Coordinates& before, const Coordinates& now,
                                  std::span<const NodeIndex> nodes) const;
  /// Nodes of element edges that touch `nodes` and are shorter at `now` than `least` times their
  /// length at `before`.
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

/// Positions in a scene's lists; valid for all passes.
struct PairAt {
  std::uint32_t contact = 0, secondary = 0, main = 0;
  friend auto operator<=>(const PairAt&, const PairAt&) = default;
};

/// Nodes of a pair: secondary (edge: two), then main, each sorted.
struct PairKey {
  std::uint32_t contact = 0;
  std::array<NodeIndex, 2> secondary{};
  std::array<NodeIndex, 4> main{};
  // Not all standard libraries compare arrays three ways.
  friend bool operator<(const PairKey& a, const PairKey& b) {
    return std::tie(a.contact, a.secondary, a.main) < std::tie(b.contact, b.secondary, b.main);
  }
};
PairKey key_of(const Scene& scene, const PairAt& at);

/// Nodes of a pair with their weights in the vector from main to secondary.
struct PairState {
  std::array<NodeIndex, 6> nodes{};
  std::array<double, 6> weights{};  ///< secondary positive, main negative
  int count = 0;
  int secondary_count = 1;
  Vec normal;  ///< unit, main to secondary; zero at distance 0
  double distance = 0, gap = 0;
  double depth() const { return gap - distance; }
};
/// Evaluates one pair with the solver's formulas.
PairState state_of(const Scene& scene, const Coordinates& x, const PairAt& at);

/// False if the vector of a pair is so short that it is round-off.
bool has_direction(const PairState& state);

/// Way out of a pair: its normal; at distance 0 away from a solid, or to the side of the secondary
/// node's neighbours.
Vec way_out(const Scene& scene, const FixMesh& mesh, const Coordinates& x, const PairAt& at,
            const PairState& state);

struct PairNow {
  PairAt at;
  PairState state;
};
/// Per contact and secondary node the pairs within two gaps, deepest first, without those for which
/// the node's closest pair is stricter.
std::vector<const PairNow*> strictest(const std::vector<PairNow>& pairs);

/// Reason why moving nodes cannot solve a pair; empty if it can.
std::string why_not_movable(const FixMesh& mesh, const Coordinates& x, const PairState& state);
/// By secondary node: true if inside a solid, judged by its closest solid segment.
std::vector<bool> inside_solids(const Scene& scene, std::uint32_t contact);

/// The pair's vector shall grow by `by` along `normal`.
struct Wish {
  PairState state;
  Vec normal;
  double by = 0;  ///< negative: it may shrink by that much
  bool main_gives_way = true;
};

/// Moves of nodes, each once, ascending.
using NodeMoves = std::vector<std::pair<NodeIndex, Vec>>;

/// Smallest displacements (sum of squares) that fulfil the wishes, approximated by `sweeps` passes
/// in the given order; nodes with held[n] != 0 stay. Contradicting wishes give a compromise.
NodeMoves solve_wishes(const std::vector<Wish>& wishes, const std::vector<std::uint8_t>& held,
                       int sweeps);

/// Limits of a node's move: along the normals of its penetrations, at most by the depth that it
/// repairs there.
class DepthBounds {
 public:
  /// A penetration before any move: `normal` leads from main to secondary; secondary nodes may move
  /// by `reach` along it, main nodes against it.
  void add(const PairKey& key, const PairState& state, const Vec& normal, double reach);

  bool contains(NodeIndex n) const { return nodes_.contains(n); }
  /// Penetrations of a node, without redundant ones.
  const std::vector<PairKey>& pairs_of(NodeIndex n) const { return nodes_.at(n).pairs; }
  double reach_of(NodeIndex n) const { return nodes_.at(n).reach; }
  /// Closest point to `wanted` that the node may reach: a sum of nonnegative multiples of its
  /// normals, none longer than the reach.
  struct Place {
    Vec by;
    bool at_bound = false;
  };
  std::vector<Place> allowed(const NodeMoves& wanted, int threads) const;

 private:
  struct NodeBound {
    double reach = 0;
    std::vector<Vec> directions;  ///< unit, all different
    std::vector<PairKey> pairs;
  };
  static Place closest_place(const NodeBound& bound, const Vec& wanted);
  std::unordered_map<NodeIndex, NodeBound> nodes_;
};

/// A penetration of a moving body. It is free if the translation is `needs` long along `normal`
/// (unit); no translation may go against `normal`.
struct WayOut {
  Vec normal;
  double needs = 0;
  bool wanted = true;  ///< shall become free; else must not get deeper
};

struct Translation {
  Vec by;
  std::size_t frees = 0;  ///< number of wanted ones
};

/// Translations of at most `longest` that go against no normal, sorted by freed pairs, then by
/// length; at most `most`, without useless ones. Components are rounded to three digits, away from
/// zero.
std::vector<Translation> translations_for(const std::vector<WayOut>& ways, double longest,
                                          std::size_t most);

}  // namespace deck::detail
