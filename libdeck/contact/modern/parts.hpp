// TYPE24 and TYPE25: the steps from a card to contacts, one concept per file. Private to the stage.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "contact/shared/scene_parts.hpp"

namespace deck::detail::modern {

constexpr double never = 1e30;  ///< the solver's "no limit"

/// Unit vector, divided as the solver does; the null vector stays null.
inline Vec unit_of(const Vec& v) {
  const double l = norm(v);
  return l > 0 ? Vec{v.x / l, v.y / l, v.z / l} : Vec{};
}

/// Sum of two directions of borders, which the solver has in single precision.
inline Vec sum_single(const Vec& a, const Vec& b) {
  const auto sum = [](double u, double v) {
    return static_cast<double>(static_cast<float>(u) + static_cast<float>(v));
  };
  return {sum(a.x, b.x), sum(a.y, b.y), sum(a.z, b.z)};
}

/// Where a node or segment comes from.
constexpr std::uint8_t from_first = 1, from_second = 2, from_group = 4;

/// What the card asks for; flags with 1000 ("nothing") as 0.
struct Settings {
  int type = 25, level = 0, istf = 0, igap = 1, igap0 = 0, ishape = 1, inacti = 0, iedge = 0;
  int ivis2 = 0, irem_i2 = 0, ipen0 = 0;
  double factor = 1;     ///< Stfac, < 0 with Istf 1
  double cos_edge = -1;  ///< of 180 degrees less Edge_angle
  double scale = 1, cap_s = never, cap_m = never, mesh_fraction = 0;
  double thick_s = 0, thick_s_scale = 1, thick_m = 0, thick_m_scale = 1;  ///< Igap 5
  double ipen_max = 0;                                                    ///< TYPE24
  bool local() const { return type == 25 && igap == 3; }
  int solid_edges() const { return iedge / 10 % 10; }
  int shell_edges() const { return iedge % 10; }
};
Settings settings_of(const InterBase& inter, const std::vector<WhatIf>& what_if);

/// A main segment. Sheets have one a side, the second behind all others.
struct Face {
  std::array<NodeIndex, 4> nodes{};  ///< triangle: last two equal
  SegmentKind kind = SegmentKind::shell;
  std::uint8_t bits = 0;
  bool interior = false;            ///< between two solids: never searched
  Carrier carrier = Carrier::none;  ///< what decides gap and stiffness
  std::uint32_t element = no_index;
  std::uint32_t solid = no_index;  ///< behind a solid segment or coat, no_index: shells
  std::uint32_t opposite = no_index;
  double stiffness = 0, gap = 0;
  double own_gap = 0;     ///< half the thickness of its own shell, scaled
  double length = never;  ///< Igap 3; TYPE24: characteristic length of solids
  std::array<double, 4> nodal_gap{};
  std::uint32_t part = no_index;  ///< TYPE24: tag
  bool triangle() const { return nodes[2] == nodes[3]; }
  bool solid_like() const { return kind == SegmentKind::solid || kind == SegmentKind::coat; }
  bool coat_like() const { return kind == SegmentKind::coat || kind == SegmentKind::coat_opposite; }
  bool opposite_side() const {
    return kind == SegmentKind::shell_opposite || kind == SegmentKind::coat_opposite;
  }
};

struct SideNode {
  NodeIndex node = no_index;
  std::uint8_t bits = 0;
  double gap = 0, length = never;
};

/// The two sides of a contact under way.
struct Sides {
  Settings set;
  std::vector<Face> faces;
  std::size_t undoubled = 0;  ///< faces before the mirrored ones
  std::vector<SideNode> nodes;
  double margin = 0;   ///< of the search
  double largest = 0;  ///< gap that the solver's search expects
  int reoriented = 0;
  std::vector<std::uint32_t> crowded;
  /// Position of the segment that `i` mirrors, or its own.
  std::uint32_t base(std::uint32_t i) const {
    return faces[i].opposite_side() ? faces[i].opposite : i;
  }
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

// gaps.cpp
void set_gaps(SceneContext& context, Sides& sides);
void set_stiffness(SceneContext& context, Sides& sides);

/// How the segments hang together: for each of its sides the segment across it.
struct Topology {
  static constexpr std::uint32_t free_side = no_index;
  std::vector<std::array<std::uint32_t, 4>> neighbour;
  std::vector<std::array<std::uint32_t, 4>> vertex;  ///< of each corner
  std::vector<std::array<Vec, 4>> direction;         ///< of each side: outward where it is free
  struct Vertex {
    bool border = false;
    Vec first, second;  ///< directions of free sides that end here; null: none
  };
  std::vector<Vertex> vertices;
  bool is_free(std::uint32_t face, std::size_t side) const {
    return neighbour[face][side] == free_side;
  }
};
// topology.cpp
Topology make_topology(const Coordinates& x, const std::vector<Face>& faces);

/// One node and one segment of a TYPE25.
struct PairFigures {
  double penetration = 0, gap = 0;
  double distance_squared = 0, behind = 0;  ///< behind > 0: the node is behind the facet
  Vec normal;                               ///< of the facet
  bool beside = false, excluded = false;
};
// pair25.cpp
/// Smallest squared distance of a node and the facets of a segment.
double facet_distance_squared(const Coordinates& x, const Face& face, NodeIndex node);
PairFigures evaluate_pair(const Coordinates& x, const Sides& sides, const Topology& topology,
                          const SideNode& node, std::uint32_t face);

/// What a node was found to penetrate.
struct NodePenetration {
  std::uint32_t node = 0, face = 0;  ///< positions
  double penetration = 0, gap = 0, distance = 0;
  Vec normal;
};
struct Found {
  std::vector<NodePenetration> penetrations;  ///< ascending nodes
  std::uint64_t candidates = 0, removed = 0;
  double largest_accepted = 0;
  bool complete = true;  ///< false: too many pairs
};
// nodes25.cpp
Found find_nodes25(SceneContext& context, const Sides& sides, const Topology& topology);
// nodes24.cpp
Found find_nodes24(SceneContext& context, Sides& sides);

/// An edge of a TYPE25.
struct SideEdge {
  std::array<NodeIndex, 2> nodes{};            ///< smaller id first
  std::uint32_t face = 0, side = 0;            ///< where it was found
  std::uint32_t across = Topology::free_side;  ///< position among the undoubled, or free
  std::int8_t kind = 2;                        ///< 1 between solids, -1 flat, 2 other
  std::uint8_t bits = 0;
  double stiffness = 0, gap = 0, length = never;
  bool free() const { return across == Topology::free_side; }
};
struct EdgePenetration {
  std::uint32_t secondary = 0, main = 0;
  double penetration = 0, gap = 0, distance = 0, weight_s = 0, weight_m = 0;
  Vec normal;
};
// edges25.cpp
std::vector<SideEdge> make_edges(SceneContext& context, const Sides& sides,
                                 const Topology& topology);
/// False: too many pairs.
bool find_edges25(SceneContext& context, const Sides& sides, const Topology& topology,
                  const std::vector<SideEdge>& edges, std::vector<EdgePenetration>& out);

// near_faces.cpp
/// The project's own search: the faces with a stiffness that a node may touch, by gaps of nodes and
/// faces (summed) and the margin of the sides. It gives a little more than the rule of the type,
/// which decides about each pair.
SearchResult near_faces(const SceneContext& context, const Sides& sides,
                        const std::vector<double>& node_gaps, const std::vector<double>& face_gaps,
                        const std::vector<double>& stiffness);

// ties.cpp
/// Which of the penetrations a tie (/INTER/TYPE2) of the deck holds already.
std::vector<bool> held_by_ties(SceneContext& context, const Sides& sides,
                               const std::vector<NodePenetration>& penetrations);

// contacts.cpp
/// The contacts of one TYPE24 or TYPE25: nodes and segments, then edges where the card wants them.
/// `evaluate` says whether what was made of the card can be computed.
void build_contacts(SceneContext& context, Selections& selections, const InterBase& inter,
                    const std::function<bool(Contact&)>& evaluate);

}  // namespace deck::detail::modern
