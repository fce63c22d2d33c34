// TYPE24 and TYPE25: the steps from a card to contacts, one concept per file. Private to the stage.
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

#include "contact/shared/scene_parts.hpp"
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

/// Where a node or segment comes from.
constexpr std::uint8_t from_first = 1, from_second = 2, from_group = 4;

/// What the card asks for; flags with 1000 ("nothing") as 0.
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

/// A main segment. Sheets have one a side, the second behind all others.
struct Face {
  Quad nodes{};  ///< triangle: last two equal
  SegmentKind kind = SegmentKind::shell;
  std::uint8_t bits = 0;
  bool interior = false;            ///< between two solids: never searched
  Carrier carrier = Carrier::none;  ///< what decides gap and stiffness
  std::uint32_t element = no_index;
  std::uint32_t solid = no_index;            ///< behind a solid segment or coat, no_index: shells
  std::uint32_t opposite = no_index;         ///< the mirrored segment, or what it mirrors
  double stiffness = 0, back_stiffness = 0;  ///< of the segment, of the mirrored one
  double gap = 0;
  double own_gap = 0;        ///< half the thickness of its own shell, scaled
  double length = no_limit;  ///< Igap 3; TYPE24: characteristic length of solids
  bool triangle() const { return nodes[2] == nodes[3]; }
  bool solid_like() const { return kind == SegmentKind::solid || kind == SegmentKind::coat; }
  bool coat_like() const { return kind == SegmentKind::coat || kind == SegmentKind::coat_opposite; }
  bool sheet() const { return kind == SegmentKind::shell || kind == SegmentKind::shell_opposite; }
};

/// The first two and the last two nodes change places.
inline Quad mirrored(const Quad& n) {
  return n[2] == n[3] ? Quad{n[1], n[0], n[2], n[2]} : Quad{n[1], n[0], n[3], n[2]};
}
/// The side of a mirrored segment that lies on a side of the other, and the reverse.
constexpr std::uint32_t mirrored_side(std::uint32_t side) { return (4 - side) % 4; }

struct SideNode {
  NodeIndex node = no_index;
  std::uint8_t bits = 0;
  double gap = 0, length = no_limit;
};

/// A point that a TYPE24 puts on an edge of a segment, which is as its surface has it.
struct PointOnEdge {
  std::array<NodeIndex, 2> edge{};
  Segment segment;
  EdgePoint point;
};

/// The two sides of a contact under way. A segment has a number: that of its place in `faces`, or a
/// mirrored one, in their order, a number behind all these.
struct Sides {
  Settings set;
  std::vector<Face> faces;             ///< without the mirrored ones
  std::vector<std::uint32_t> mirrors;  ///< what each of those mirrors
  std::vector<SideNode> nodes;
  std::vector<PointOnEdge> points;  ///< TYPE24, Iedge: searched as further nodes
  std::vector<Edge> lines;          ///< TYPE25, Iedge: elements of a line with a surface's id
  std::vector<double> main_gap;     ///< by node: gap of a corner of segments; TYPE25
  double margin = 0;                ///< of the search
  double shortest = 0;              ///< side of all
  double largest = 0;               ///< gap that the solver's search expects
  bool solids = false;              ///< some segments are of solids, or coats
  int reoriented = 0;
  std::vector<std::uint32_t> crowded;

  std::uint32_t count() const { return static_cast<std::uint32_t>(faces.size() + mirrors.size()); }
  bool is_mirror(std::uint32_t i) const { return i >= faces.size(); }
  /// The segment that `i` mirrors, or its own number.
  std::uint32_t base(std::uint32_t i) const { return is_mirror(i) ? mirrors[i - faces.size()] : i; }
  Quad nodes_of(std::uint32_t i) const {
    return is_mirror(i) ? mirrored(faces[base(i)].nodes) : faces[i].nodes;
  }
  Face face(std::uint32_t i) const;
  /// Whether a contact between these is wanted: across the surfaces where there are two.
  bool across(std::uint8_t a, std::uint8_t b) const {
    if (set.level != 2) return true;
    return ((a & from_first) != 0 && (b & from_second) != 0) ||
           ((a & from_second) != 0 && (b & from_first) != 0);
  }
};

// segments.cpp
/// Segments and secondary nodes of the card; nothing where a side is missing.
void make_sides(SceneContext& context, Selections& selections, const InterBase& inter,
                Sides& sides);

// points24.cpp
/// Adds the points on the edges of a surface.
void make_points(const SceneContext& context, const SegmentList& segments, Sides& out);
/// As long as it lives the points of a contact are nodes behind all others, of the model and of the
/// contact, with the larger gap and side of the ends of their edge.
class PointsAsNodes {
 public:
  PointsAsNodes(Coordinates& x, Sides& sides);
  ~PointsAsNodes();
  PointsAsNodes(const PointsAsNodes&) = delete;
  PointsAsNodes& operator=(const PointsAsNodes&) = delete;
  std::size_t nodes() const { return nodes_; }  ///< of the contact, without them

 private:
  Coordinates& x_;
  Sides& s_;
  std::size_t places_, nodes_;
};

// gaps.cpp
void set_gaps(SceneContext& context, Sides& sides);
void set_stiffness(SceneContext& context, Sides& sides);

/// How the segments of a TYPE25 hang together: for each of its sides the segment across it, corners
/// that belong together, and the direction of every side. What is around a pair of nodes does not
/// depend on the rest, and is found when it is asked for. May be asked by several threads.
class Topology {
 public:
  Topology(const Coordinates& x, const Sides& sides);

  struct Across {
    std::uint32_t face = no_index, side = 0;
    bool free() const { return face == no_index; }
  };
  using Vertex = BorderCorner;  ///< corners of segments that hang together over sides
  Across across(std::uint32_t face, std::uint32_t side) const;
  /// Outward where the side is free; in single precision, as the solver has it.
  Vec direction(std::uint32_t face, std::uint32_t side) const {
    return direction(face, side, across(face, side));
  }
  Vec direction(std::uint32_t face, std::uint32_t side, const Across& other) const;
  Vertex vertex(std::uint32_t face, std::uint32_t corner) const;
  bool on_border(std::uint32_t face, std::uint32_t corner) const;
  /// Mean direction of the facets around a corner, in single precision.
  Vec normal(std::uint32_t face, std::uint32_t corner) const;

 private:
  /// A side that leads from a node to another; face no_index: none.
  struct DirectedSide {
    NodeIndex to = no_index;
    std::uint32_t face = no_index, side = 0;
  };
  struct FreeEnd {
    std::uint32_t face = no_index, side = 0;
  };
  /// Calls use(side) for all that leave a node.
  template <class F>
  void each_leaving(NodeIndex n, F&& use) const {
    for (std::uint32_t i = first_[n]; i < first_[n + 1]; ++i) {
      const std::uint32_t face = sides_[i] / 4, side = sides_[i] % 4;
      use(DirectedSide{s_.faces[face].nodes[(side + 1) % 4], face, side});
    }
  }
  bool simple(std::uint32_t i, std::uint32_t j, NodeIndex a, NodeIndex b) const;
  bool closed_around(NodeIndex n) const;
  bool find_closed(NodeIndex n) const;
  Across among_many(std::uint32_t face, std::uint32_t side, NodeIndex a, NodeIndex b) const;
  /// From a corner through the segments around it, from each over the side that leaves the corner
  /// (or ends in it), to the free one; none: the corner is inside. visit(segment, corner) for each.
  template <class Visit>
  FreeEnd walk(std::uint32_t face, std::uint32_t corner, bool onward, const Visit& visit) const;
  FreeEnd walk(std::uint32_t face, std::uint32_t corner, bool onward) const;

  const Coordinates& x_;
  const Sides& s_;
  std::vector<std::uint32_t> first_;  ///< by node: where the sides that leave it are
  std::vector<std::uint32_t>
      sides_;  ///< four times a segment that is no mirrored one, and its side
  enum class Closed : std::uint8_t { unknown, no, yes };
  mutable std::vector<std::atomic<Closed>> closed_;  ///< by node, as far as it was asked for
};

/// One node and one segment of a TYPE25.
struct PairFigures {
  double penetration = 0, gap = 0;
  double distance_squared = 0, behind = 0;  ///< behind > 0: the node is behind the facet
  Vec normal;                               ///< of the facet
  bool beside = false, excluded = false;
  bool doubtful = false;      ///< whether it counts, or penetrates, may be round-off
  bool other_facets = false;  ///< another facet may be the one that counts
};
// pair25.cpp
constexpr unsigned all_facets = 0xf;
/// Smallest squared distance of a node and the facets of a segment.
double facet_distance_squared(const Coordinates& x, const Face& face, NodeIndex node,
                              unsigned facets = all_facets);
/// Of a sheet the node is behind, no more than that. `facets`: bit mask of those that may be the
/// nearest, or nearly so. `slack`: what round-off may make of a length; < 0: nobody asks for
/// doubts.
PairFigures evaluate_pair(const Coordinates& x, const Sides& sides, const Topology& topology,
                          const SideNode& node, std::uint32_t face, unsigned facets = all_facets,
                          double slack = -1);
FacetRule facet_rule(const Coordinates& x, const Sides& sides, const Topology& topology,
                     const SideNode& node, std::uint32_t face);

/// Whether the solver looks at a pair: by its own arithmetic, and without round-off.
struct PairConsidered {
  bool solver = false, exact = false;
  bool differs() const { return solver != exact; }
};

/// What a node was found to penetrate.
struct NodePenetration {
  std::uint32_t node = 0, face = 0;  ///< positions
  double penetration = 0, gap = 0, distance = 0;
  Vec normal;
  bool in_contact = true, solver_acts = true;  ///< in exact arithmetic, and in that of the solver
  double solver_distance = 0, exact_distance = 0;  ///< where the two differ
};
struct NodeSearch {
  std::vector<NodePenetration> penetrations;  ///< ascending nodes
  std::uint64_t candidates = 0, removed = 0;
  double largest_accepted = 0;
  bool complete = true;  ///< false: too many pairs
  DecisionReport decisions;
  /// What another thread found, for the nodes that follow.
  void add(NodeSearch part);
};
// nodes25.cpp
NodeSearch find_nodes25(SceneContext& context, const Sides& sides, const Topology& topology);
// nodes24.cpp
/// Nodes, then points on edges: the k-th point as the k-th node behind the last.
NodeSearch find_nodes24(SceneContext& context, Sides& sides);

/// An edge of a TYPE25.
struct SideEdge {
  std::array<NodeIndex, 2> nodes{};         ///< smaller id first
  std::uint32_t face = no_index, side = 0;  ///< where it was found
  std::uint32_t across = no_index;          ///< no mirrored one; no_index: the edge is free
  std::int8_t kind = 2;                     ///< 1 between solids, -1 flat, 2 other, 3 of a line
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
  bool in_contact = true, solver_acts = true;  ///< as of a NodePenetration
  double solver_distance = 0, exact_distance = 0;
};
// edges25.cpp
std::vector<SideEdge> make_edges(SceneContext& context, const Sides& sides,
                                 const Topology& topology);
/// False: too many pairs.
bool find_edges25(SceneContext& context, const Sides& sides, const Topology& topology,
                  const std::vector<SideEdge>& edges, std::vector<EdgePenetration>& out,
                  DecisionReport& decisions);

/// Of a secondary and a main edge.
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
/// What the search needs of a contact: of the nodes, and of segments that are no mirrored ones.
struct SearchLists {
  std::vector<std::uint32_t> nodes;
  std::vector<Quad> segments;
  std::vector<double> node_gaps, gaps;
  std::vector<double> searched;  ///< of segments: 0: no pairs with it are wanted
};
SearchLists search_lists(const Sides& sides);
NodeSegmentInput input_of(const Coordinates& x, const SearchLists& lists);
/// The segments near each node, from one search or two.
struct PairsByNode {
  SearchResult one, two;
  bool complete() const { return one.complete && two.complete; }
  /// Calls use(pairs) for each of the nodes begin ... end-1 that has any; ascending.
  template <class F>
  void each_node(std::size_t begin, std::size_t end, F&& use) const {
    std::vector<CandidatePair> both;
    using Pairs = std::span<const CandidatePair>;
    const auto from = [&](const SearchResult& r) {
      const CandidatePair first{static_cast<std::uint32_t>(begin), 0};
      const auto at = std::lower_bound(r.pairs.begin(), r.pairs.end(), first);
      return Pairs(r.pairs).subspan(static_cast<std::size_t>(at - r.pairs.begin()));
    };
    const auto take = [](Pairs& rest, std::uint32_t node) {
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
      const Pairs of_a = take(a, node), of_b = take(b, node);
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
/// TYPE25: the segments that a node may touch across the surfaces, by gaps of nodes and segments
/// (summed) and the margin of the sides. It gives a little more than the rule of the type, which
/// decides about each pair.
PairsByNode near_faces(const SceneContext& context, const Sides& sides, const SearchLists& lists);
/// TYPE24: the same of segments in whose box a node lies, which reaches beyond the segment by both
/// gaps and the margin; nodes of the group meet both surfaces.
PairsByNode nodes_in_boxes(const SceneContext& context, const Sides& sides,
                           const std::function<double(const Face&)>& margin);

// ties.cpp
/// Which of the penetrations a tie (/INTER/TYPE2) of the deck holds already.
std::vector<bool> held_by_ties(SceneContext& context, const Sides& sides,
                               std::span<const NodePenetration> penetrations);

// contacts.cpp
/// The contacts of one TYPE24 or TYPE25: nodes and segments, then edges where the card wants them.
/// `evaluate` says whether what was made of the card can be computed.
void build_contacts(SceneContext& context, Selections& selections, const InterBase& inter,
                    const std::function<bool(Contact&)>& evaluate);

}  // namespace deck::detail::type24_25
