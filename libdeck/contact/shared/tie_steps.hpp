// Steps that find the ties of a TYPE2.
#pragma once
#include <memory>
#include <vector>

#include "contact/shared/scene_steps.hpp"
#include "deck/contacts.hpp"
#include "model/shared/mesh.hpp"

namespace deck::detail {

using Corners = std::array<NodeIndex, 4>;

inline bool is_triangle(const Corners& c) { return c[2] == c[3]; }
/// Spotflags of ties by penalty.
inline bool is_penalty(int spotflag) { return spotflag >= 25 && spotflag <= 28; }

// distance.cpp
/// Distance of a node from a segment and its position there, by the solver's formula.
struct Projection {
  double s = 0, t = 0;
  double depth = 0;  ///< search distance - distance, at least 0; 0: out of reach
};
/// `weights`: s and t of a triangle are the weights of corners 1 and 2 (Spotflag 27).
Projection project(const Coordinates& x, NodeIndex node, const Corners& segment, double reach,
                   bool weights);

double distance_from(const Coordinates& x, NodeIndex node, const Corners& segment);

// distance.cpp
/// Finds the nearest of some segments that does not contain the node.
class NearestSegments {
 public:
  NearestSegments(const Coordinates& x, const std::vector<Corners>& segments);
  struct Found {
    std::uint32_t segment = no_index;  ///< no_index if none
    double distance = 0;
  };
  Found of(NodeIndex node) const;

 private:
  /// The first child is the next box, `second` the other; 0 in leaves.
  struct TreeBox {
    Vec low, high;
    std::uint32_t begin, end, second;
  };
  std::uint32_t split(std::uint32_t begin, std::uint32_t end);
  const Coordinates& x_;
  const std::vector<Corners>& segments_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec> centres_;
  std::vector<TreeBox> boxes_;
};

// element_order.cpp
/// Position of every shell in the solver's order of its kind.
struct ElementOrder {
  std::vector<std::uint32_t> shell4, shell3;
};
ElementOrder element_order(const Model& model, Connectivity& connectivity);

// thickness.cpp
/// Thicknesses for search distances of single pairs.
class TieThickness {
 public:
  explicit TieThickness(SceneContext& context)
      : unread(unread_at_nodes(context.model, false)), c_(context) {}
  const std::map<NodeIndex, std::string> unread;  ///< where the thickness is not known, and why
  /// Thickness of the shell that the solver chooses at a node; 0 if none.
  double of_node(NodeIndex node);
  /// Least and largest thickness of the solver's possible choices.
  std::pair<double, double> range_at(NodeIndex node);
  /// Largest shell thickness at some nodes, by which the solver widens boxes.
  double largest_at(const std::vector<NodeIndex>& nodes);
  /// Thickness of the shell (with `solids`: or solid) under a segment; 0 if none.
  double of_segment(const Corners& segment, bool solids);

 private:
  const ElementOrder& order();
  double widening_thickness(ElementKind kind, std::uint32_t e);
  void list_own_thicknesses();
  SceneContext& c_;
  std::unique_ptr<ElementOrder> order_;
  bool own_listed_ = false;
  std::vector<double> own_;  ///< own thicknesses in the solver's order: 4-node, then 3-node shells
};

// surfaces.cpp
/// Distinct corners, ascending: equal for any order of the nodes.
std::vector<NodeIndex> corner_set(const Corners& c);
/// Main segments and secondary nodes of surface-to-surface input.
void join_surfaces(const Coordinates& x, double dsearch, const std::vector<Corners>& first,
                   const std::vector<Corners>& second, Tie& tie);

// choose.cpp
/// Finds the segment and the state of every node (Isearch 2).
void search_ties(SceneContext& context, TieThickness& thickness, Tie& tie);

// old_search.cpp
/// As search_ties, for Isearch 1: a segment at the nearest main node, at any distance.
void search_ties_by_nearest_node(const Coordinates& x, Tie& tie);

// conditions.cpp
/// Interaction of ties with each other and with other conditions: repeated ties, main nodes that
/// are tied, ties that become penalties, condensed mid nodes.
void resolve_tie_conflicts(SceneContext& context, std::vector<Tie>& ties);

// ties.cpp
/// Root mean square of all sides; a triangle counts a fourth side of length 0.
double mean_side(const Coordinates& x, const std::vector<Corners>& segments);
/// Ties of all /INTER/TYPE2, in the solver's order, at the present positions; found once.
const std::vector<Tie>& ties_of(SceneContext& context);
/// Ties of the interfaces in SceneOptions::only. The others still act on them.
std::vector<Tie> wanted_ties(SceneContext& context);
/// For a scene made without ties.
std::vector<Tie> ties_of(const Scene& scene, const SceneOptions& options);
/// True if a contact may move nodes at the start.
bool moves_nodes(const Interfaces& interfaces);
/// Nodes of a tie, in the form of the mesh.
TiedNodes tied_nodes_of(const Tie& tie);

}  // namespace deck::detail
