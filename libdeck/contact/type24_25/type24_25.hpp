// TYPE24 and TYPE25: steps from a card to contacts.
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "contact/shared/scene_steps.hpp"
#include "contact/type24_25/edge_rule.hpp"
#include "contact/type24_25/facet_rule.hpp"
#include "contact/type24_25/through_rule.hpp"
#include "deck/contacts.hpp"

namespace deck::detail::type24_25 {

constexpr double no_limit = 1e30;  ///< the solver's "no limit"

/// Unit vector, divided as the solver does; the null vector stays null.
inline Vec unit_of(const Vec& v) {
  const double l = norm(v);
  return l > 0 ? Vec{v.x / l, v.y / l, v.z / l} : Vec{};
}

/// Sources of a node or segment, as bits.
constexpr std::uint8_t from_first = 1, from_second = 2, from_group = 4;

/// Settings of the card; flags with 1000 ("off") are 0.
struct Settings {
  int type = 25, level = 0, istf = 0, igap = 1, igap0 = 0, ishape = 1, inacti = 0, iedge = 0;
  int ivis2 = 0, irem_i2 = 0, ipen0 = 0;
  double factor = 1;     ///< Stfac, < 0 with Istf 1
  double cos_edge = -1;  ///< of 180 degrees less Edge_angle
  double scale = 1, cap_s = no_limit, cap_m = no_limit, mesh_fraction = 0;
  double thick_s = 0, thick_s_scale = 1, thick_m = 0, thick_m_scale = 1;  ///< Igap 5
  double ipen_max = 0;                                                    ///< TYPE24
  bool local() const { return type == 25 && igap == 3; }
  int solid_edges() const { return iedge / 10; }
  int shell_edges() const { return iedge % 10; }
};
Settings settings_of(const InterBase& inter, const std::vector<WhatIf>& what_if);

using Quad = std::array<NodeIndex, 4>;

/// A main segment. Sheets have two, one per side; the second ones follow all others.
struct Face {
  Quad nodes{};  ///< triangle: last two equal
  SegmentKind kind = SegmentKind::shell;
  std::uint8_t bits = 0;
  bool interior = false;            ///< between two solids: not searched
  Carrier carrier = Carrier::none;  ///< decides gap and stiffness
  std::uint32_t element = no_index;
  std::uint32_t solid = no_index;            ///< behind a solid segment or coat; shells: no_index
  std::uint32_t opposite = no_index;         ///< the mirrored segment, or the one it mirrors
  double stiffness = 0, back_stiffness = 0;  ///< of the segment, of the mirrored one
  double gap = 0;
  double own_gap = 0;        ///< half the thickness of its own shell, scaled
  double length = no_limit;  ///< Igap 3; TYPE24: characteristic length of solids
  bool triangle() const { return nodes[2] == nodes[3]; }
  bool solid_like() const { return kind == SegmentKind::solid || kind == SegmentKind::coat; }
  bool coat_like() const { return kind == SegmentKind::coat || kind == SegmentKind::coat_opposite; }
  bool sheet() const { return kind == SegmentKind::shell || kind == SegmentKind::shell_opposite; }
};

/// Swaps the first two and the last two nodes.
inline Quad mirrored(const Quad& n) {
  return n[2] == n[3] ? Quad{n[1], n[0], n[2], n[2]} : Quad{n[1], n[0], n[3], n[2]};
}
/// Side of a mirrored segment for a side of the other, and the reverse.
constexpr std::uint32_t mirrored_side(std::uint32_t side) { return (4 - side) % 4; }

struct SideNode {
  NodeIndex node = no_index;
  std::uint8_t bits = 0;
  double gap = 0, length = no_limit;
};

/// A point of a TYPE24 on an edge of a segment.
struct PointOnEdge {
  std::array<NodeIndex, 2> edge{};
  Segment segment;
  EdgePoint point;
};

/// Both sides of a contact being built. Number of a segment: its position in `faces`; mirrored
/// segments follow in their order.
struct Sides {
  Settings set;
  std::vector<Face> faces;             ///< without mirrored ones
  std::vector<std::uint32_t> mirrors;  ///< per mirrored segment: its original
  std::vector<SideNode> nodes;
  std::vector<PointOnEdge> points;  ///< TYPE24, Iedge: searched as further nodes
  std::vector<Edge> lines;          ///< TYPE25, Iedge: elements of a line with a surface's id
  std::vector<double> main_gap;     ///< by node: gap as a corner of segments; TYPE25
  double margin = 0;                ///< of the search
  double shortest = 0;              ///< shortest side of all
  double largest = 0;               ///< largest gap that the solver's search expects
  bool solids = false;              ///< some segments are of solids or coats
  int reoriented = 0;
  std::vector<std::uint32_t> crowded;

  std::uint32_t count() const { return static_cast<std::uint32_t>(faces.size() + mirrors.size()); }
  bool is_mirror(std::uint32_t i) const { return i >= faces.size(); }
  /// Original of segment `i`, or `i` itself.
  std::uint32_t base(std::uint32_t i) const { return is_mirror(i) ? mirrors[i - faces.size()] : i; }
  Quad nodes_of(std::uint32_t i) const {
    return is_mirror(i) ? mirrored(faces[base(i)].nodes) : faces[i].nodes;
  }
  Face face(std::uint32_t i) const;
  /// True if a contact between these is wanted: with two surfaces, across them.
  bool across(std::uint8_t a, std::uint8_t b) const {
    if (set.level != 2) return true;
    return ((a & from_first) != 0 && (b & from_second) != 0) ||
           ((a & from_second) != 0 && (b & from_first) != 0);
  }
};

// segments.cpp
/// Segments and secondary nodes of the card; nothing if a side is missing.
void make_sides(SceneContext& context, Selections& selections, const InterBase& inter,
                Sides& sides);

// points24.cpp
/// Adds the points on the edges of a surface.
void make_points(const SceneContext& context, const SegmentList& segments, Sides& out);
/// While this lives, the points of a contact are nodes behind all others, of model and contact,
/// with the larger gap and side of their edge's ends.
class PointsAsNodes {
 public:
  PointsAsNodes(Coordinates& x, Sides& sides);
  ~PointsAsNodes();
  PointsAsNodes(const PointsAsNodes&) = delete;
  PointsAsNodes& operator=(const PointsAsNodes&) = delete;
  std::size_t nodes() const { return nodes_; }  ///< number without points

 private:
  Coordinates& x_;
  Sides& s_;
  std::size_t places_, nodes_;
};

// gaps.cpp
void set_gaps(SceneContext& context, Sides& sides);
void set_stiffness(SceneContext& context, Sides& sides);

/// Connections of a TYPE25's segments: the segment across each side, shared corners, direction of
/// every side. Each is computed on first use. Thread-safe.
class Topology {
 public:
  Topology(const Coordinates& x, const Sides& sides);

  struct Across {
    std::uint32_t face = no_index, side = 0;
    bool free() const { return face == no_index; }
  };
  using Vertex = BorderCorner;  ///< a corner shared by connected segments
  Across across(std::uint32_t face, std::uint32_t side) const;
  /// Outward if the side is free; in single precision, as in the solver.
  Vec direction(std::uint32_t face, std::uint32_t side) const {
    return direction(face, side, across(face, side));
  }
  Vec direction(std::uint32_t face, std::uint32_t side, const Across& other) const;
  Vertex vertex(std::uint32_t face, std::uint32_t corner) const;
  bool on_border(std::uint32_t face, std::uint32_t corner) const;
  /// Mean direction of the facets at a corner, in single precision.
  Vec normal(std::uint32_t face, std::uint32_t corner) const;

 private:
  /// A side from a node to another; face no_index: none.
  struct DirectedSide {
    NodeIndex to = no_index;
    std::uint32_t face = no_index, side = 0;
  };
  struct FreeEnd {
    std::uint32_t face = no_index, side = 0;
  };
  /// Calls use(side) for all sides that start at a node.
  template <class F>
  void for_each_leaving(NodeIndex n, F&& use) const {
    for (std::uint32_t i = first_[n]; i < first_[n + 1]; ++i) {
      const std::uint32_t face = sides_[i] / 4, side = sides_[i] % 4;
      use(DirectedSide{s_.faces[face].nodes[(side + 1) % 4], face, side});
    }
  }
  bool simple(std::uint32_t i, std::uint32_t j, NodeIndex a, NodeIndex b) const;
  bool closed_around(NodeIndex n) const;
  bool find_closed(NodeIndex n) const;
  Across among_many(std::uint32_t face, std::uint32_t side, NodeIndex a, NodeIndex b) const;
  /// Walks around a corner through its segments, over the side that starts (or ends) there, to the
  /// free side; none if the corner is inside. Calls visit(segment, corner).
  template <class Visit>
  FreeEnd walk(std::uint32_t face, std::uint32_t corner, bool onward, const Visit& visit) const;
  FreeEnd walk(std::uint32_t face, std::uint32_t corner, bool onward) const;

  const Coordinates& x_;
  const Sides& s_;
  std::vector<std::uint32_t> first_;  ///< by node: range of its sides in `sides_`
  std::vector<std::uint32_t> sides_;  ///< 4 * segment + side, without mirrored ones
  enum class Closed : std::uint8_t { unknown, no, yes };
  mutable std::vector<std::atomic<Closed>> closed_;  ///< by node, computed on first use
};

struct PairFigures {
  double penetration = 0, gap = 0;
  double distance_squared = 0, behind = 0;  ///< behind > 0: the node is behind the facet
  Vec normal;                               ///< of the facet
  bool beside = false, excluded = false;
  bool doubtful = false;      ///< round-off may change if it counts or penetrates
  bool other_facets = false;  ///< round-off may choose another facet
};
// pair25.cpp
constexpr unsigned all_facets = 0xf;
/// Smallest squared distance of a node and the facets of a segment.
double facet_distance_squared(const Coordinates& x, const Face& face, NodeIndex node,
                              unsigned facets = all_facets);
/// For a node behind a sheet only that. `facets`: bit mask of those that are nearest within
/// round-off. `slack`: bound of the round-off of a length; < 0: no doubts wanted.
PairFigures evaluate_pair(const Coordinates& x, const Sides& sides, const Topology& topology,
                          const SideNode& node, std::uint32_t face, unsigned facets = all_facets,
                          double slack = -1);
FacetRule facet_rule(const Coordinates& x, const Sides& sides, const Topology& topology,
                     const SideNode& node, std::uint32_t face);

/// If the solver considers a pair: in its arithmetic, and without round-off.
struct PairConsidered {
  bool solver = false, exact = false;
  bool differs() const { return solver != exact; }
};

/// Penetration of a node.
struct NodePenetration {
  std::uint32_t node = 0, face = 0;  ///< positions
  double penetration = 0, gap = 0, distance = 0;
  Vec normal;
  bool in_contact = true, solver_acts = true;      ///< by exact arithmetic, and by the solver's
  double solver_distance = 0, exact_distance = 0;  ///< if they differ
};
struct NodeSearch {
  std::vector<NodePenetration> penetrations;  ///< ascending nodes
  std::uint64_t candidates = 0, removed = 0;
  double largest_accepted = 0;
  bool complete = true;  ///< false: too many pairs
  DecisionReport decisions;
  /// Appends the result of another thread for the following nodes.
  void add(NodeSearch part);
};
// nodes25.cpp
NodeSearch find_nodes25(SceneContext& context, const Sides& sides, const Topology& topology);
// nodes24.cpp
/// Nodes, then points on edges, numbered behind the last node.
NodeSearch find_nodes24(SceneContext& context, Sides& sides);

struct SideEdge {
  std::array<NodeIndex, 2> nodes{};         ///< smaller id first
  std::uint32_t face = no_index, side = 0;  ///< first segment with it
  std::uint32_t across = no_index;          ///< not a mirrored one; no_index: free edge
  std::int8_t kind = 2;                     ///< 1: between solids, -1: flat, 2: other, 3: of a line
  std::uint8_t bits = 0;
  Carrier carrier = Carrier::none;
  std::uint32_t element = no_index;
  double stiffness = 0, gap = 0, length = no_limit;
  bool free() const { return across == no_index; }
};
struct EdgePenetration {
  std::uint32_t secondary = 0, main = 0;
  double penetration = 0, gap = 0, distance = 0, weight_s = 0, weight_m = 0;
  Vec normal;
  bool in_contact = true, solver_acts = true;  ///< see NodePenetration
  double solver_distance = 0, exact_distance = 0;
};
// edges25.cpp
std::vector<SideEdge> make_edges(SceneContext& context, const Sides& sides,
                                 const Topology& topology);
/// False if there are too many pairs.
bool find_edges25(SceneContext& context, const Sides& sides, const Topology& topology,
                  const std::vector<SideEdge>& edges, std::vector<EdgePenetration>& out,
                  DecisionReport& decisions);

EdgeRule edge_rule(const Coordinates& x, const Sides& sides, const Topology& topology,
                   const SideEdge& secondary, const SideEdge& main);

// edges_solid25.cpp
ThroughRule through_rule(const Coordinates& x, const Sides& sides, const Topology& topology,
                         const SideEdge& edge, std::uint32_t face, std::uint32_t side);
/// Ascending by edge, segment and side.
std::vector<EdgeThroughSegment> edges_through_solids(const SceneContext& context,
                                                     const Sides& sides, const Topology& topology,
                                                     const std::vector<SideEdge>& edges,
                                                     DecisionReport& decisions);

// near_faces.cpp
/// Input of the pair search: nodes, and segments without mirrored ones.
struct SearchLists {
  std::vector<std::uint32_t> nodes;
  std::vector<Quad> segments;
  std::vector<double> node_gaps, gaps;
  std::vector<double> searched;  ///< of segments; 0: not wanted
};
SearchLists search_lists(const Sides& sides);
NodeSegmentInput input_of(const Coordinates& x, const SearchLists& lists);
/// Segments near each node, from one search or two.
struct PairsByNode {
  SearchResult one, two;
  bool complete() const { return one.complete && two.complete; }
  /// Calls use(pairs) for each of the nodes begin ... end-1 with pairs; ascending.
  template <class F>
  void for_each_node(std::size_t begin, std::size_t end, F&& use) const {
    std::vector<CandidatePair> both;
    using Pairs = std::span<const CandidatePair>;
    const auto from = [&](const SearchResult& r) {
      const CandidatePair first{static_cast<std::uint32_t>(begin), 0};
      const auto at = std::lower_bound(r.pairs.begin(), r.pairs.end(), first);
      return Pairs(r.pairs).subspan(static_cast<std::size_t>(at - r.pairs.begin()));
    };
    const auto take_front = [](Pairs& rest, std::uint32_t node) {
      std::size_t count = 0;
      while (count < rest.size() && rest[count].secondary == node) ++count;
      const Pairs taken = rest.first(count);
      rest = rest.subspan(count);
      return taken;
    };
    for (Pairs a = from(one), b = from(two); !a.empty() || !b.empty();) {
      const std::uint32_t node = a.empty()   ? b.front().secondary
                                 : b.empty() ? a.front().secondary
                                             : std::min(a.front().secondary, b.front().secondary);
      if (node >= end) return;
      const Pairs of_a = take_front(a, node), of_b = take_front(b, node);
      if (!of_a.empty() && !of_b.empty()) {
        both.clear();
        std::set_union(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                       std::back_inserter(both));
        use(Pairs(both));
      } else {
        use(of_a.empty() ? of_b : of_a);
      }
    }
  }
};
/// TYPE25: segments that a node may touch across the surfaces, by the sum of node and segment gaps
/// plus the margin. Superset of the rule, which decides each pair.
PairsByNode near_faces(const SceneContext& context, const Sides& sides, const SearchLists& lists);
/// TYPE24: segments whose box, extended by both gaps and the margin, contains a node; nodes of the
/// group meet both surfaces.
PairsByNode nodes_in_boxes(const SceneContext& context, const Sides& sides,
                           const std::function<double(const Face&)>& margin);

// ties.cpp
/// True for penetrations that a tie (/INTER/TYPE2) replaces.
std::vector<bool> tied_penetrations(SceneContext& context, const Sides& sides,
                                    std::span<const NodePenetration> penetrations);

// contacts.cpp
/// Makes the contacts of one TYPE24 or TYPE25: nodes and segments, then edges if the card has them.
/// `evaluate` returns if a contact can be computed.
void build_contacts(SceneContext& context, Selections& selections, const InterBase& inter,
                    const std::function<bool(Contact&)>& evaluate);

}  // namespace deck::detail::type24_25
