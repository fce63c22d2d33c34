// Moving nodes. The mesh around them: who is next to whom, which elements cross, which turn inside
// out. Ways out of penetrations: the direction and length that each asks for, the displacements of
// nodes that solve many of them together, how far a node may go, and translations of whole bodies.
// Private to the stage.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact/shared/scene_parts.hpp"
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

/// Positions in a scene's lists: a pair that is looked at again in the next pass.
struct PairAt {
  std::uint32_t contact = 0, secondary = 0, main = 0;
  friend auto operator<=>(const PairAt&, const PairAt&) = default;
};

/// Nodes of a pair, whatever the order of its lists: secondary (edge: two), then main, each sorted.
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

/// Nodes of a pair with the share each has in the vector from main to secondary.
struct PairState {
  std::array<NodeIndex, 6> nodes{};
  std::array<double, 6> weights{};  ///< secondary positive, main negative
  int count = 0;
  int secondary_count = 1;
  Vec normal;  ///< unit, main to secondary; zero at distance 0
  double distance = 0, gap = 0;
  double depth() const { return gap - distance; }
};
/// Evaluates one pair with the solver's own formulas.
PairState state_of(const Scene& scene, const Coordinates& x, const PairAt& at);

/// False where the vector of a pair is so short that it is rounding.
bool has_direction(const PairState& state);

/// The way out of a pair: its normal; at distance 0 away from a solid, or to the side where the
/// nodes next to the secondary one are.
Vec way_out(const Scene& scene, const FixMesh& mesh, const Coordinates& x, const PairAt& at,
            const PairState& state);

/// A pair as it is with the nodes where they are now.
struct PairNow {
  PairAt at;
  PairState state;
};
/// Of pairs by contact and secondary node those within two gaps, deepest first, without those that
/// the closest pair of the same secondary node says better.
std::vector<const PairNow*> strictest(const std::vector<PairNow>& pairs);

/// Why a pair is no task for moving nodes; empty: it is one.
std::string why_not_movable(const FixMesh& mesh, const Coordinates& x, const PairState& state);
/// Secondary nodes that are inside a solid, judged by their closest solid segment, per contact.
std::vector<bool> inside_solids(const Scene& scene, std::uint32_t contact);

/// A wish: the pair's vector has to grow by `by` along `normal`.
struct Wish {
  PairState state;
  Vec normal;
  double by = 0;  ///< negative: it may shrink by that much
  bool main_gives_way = true;
};

/// Moves of nodes, each once, ascending.
using NodeMoves = std::vector<std::pair<NodeIndex, Vec>>;

/// The smallest displacements (sum of squares) that fulfil the wishes, approached in `sweeps`
/// passes over them in the order given; nodes with held[n] != 0 stay. Where wishes contradict each
/// other the result is a compromise.
NodeMoves solve_wishes(const std::vector<Wish>& wishes, const std::vector<std::uint8_t>& held,
                       int sweeps);

/// How far and which way a node may move: out of the penetrations it is in, along their normals,
/// and by no more than the depth that it repairs there.
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

/// A penetration of a body that moves as a whole: it is free where the translation is `needs` long
/// along `normal` (unit), and it must never move against it.
struct WayOut {
  Vec normal;
  double needs = 0;
  bool wanted = true;  ///< it counts; else it must only get no deeper
};

struct Translation {
  Vec by;
  std::size_t frees = 0;  ///< of those that are wanted
};

/// Translations no longer than `longest` that move against no normal, those that free more first,
/// of equals the shortest; at most `most`, and none that frees nothing. Components are rounded to
/// three digits, away from zero.
std::vector<Translation> translations_for(const std::vector<WayOut>& ways, double longest,
                                          std::size_t most);

}  // namespace deck::detail
