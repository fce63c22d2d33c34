// The steps that find the ties of a TYPE2, one concept per file. Private to the stage.
#pragma once
#include <memory>
#include <vector>

#include "contact/shared/scene_parts.hpp"
#include "deck/contacts.hpp"
#include "model/shared/mesh.hpp"

namespace deck::detail {

using Corners = std::array<NodeIndex, 4>;

inline bool is_triangle(const Corners& c) { return c[2] == c[3]; }
/// Spotflags of ties by penalty.
inline bool is_penalty(int spotflag) { return spotflag >= 25 && spotflag <= 28; }

// distance.cpp
/// Distance of a node from a segment, and its place there, as the solver measures them.
struct Projection {
  double s = 0, t = 0;
  double depth = 0;  ///< search distance - distance, at least 0; 0: not within reach
};
/// `weights`: on triangles s and t are the weights of corners 1 and 2 (Spotflag 27).
Projection project(const Coordinates& x, NodeIndex node, const Corners& segment, double reach,
                   bool weights);

/// The distance by itself.
double distance_from(const Coordinates& x, NodeIndex node, const Corners& segment);

// distance.cpp
/// Answers which of some segments is nearest to a node that is no corner of it.
class NearestSegments {
 public:
  NearestSegments(const Coordinates& x, const std::vector<Corners>& segments);
  struct Found {
    std::uint32_t segment = no_index;  ///< no_index: there is none
    double distance = 0;
  };
  Found of(NodeIndex node) const;

 private:
  /// Its first half is the next box; `second` is 0 in leaves.
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
/// Position of every shell in the solver's own order of elements of its kind.
struct ElementOrder {
  std::vector<std::uint32_t> shell4, shell3;
};
ElementOrder element_order(const Model& model, Connectivity& connectivity);

// thickness.cpp
/// Thicknesses that search distances of single pairs are made of.
class TieThickness {
 public:
  explicit TieThickness(SceneContext& context) : c_(context) {}
  /// Of one of the shells at a node; which one is the solver's choice. 0: there is none.
  double of_node(NodeIndex node);
  /// Least and largest thickness of the shells that the solver chooses among.
  std::pair<double, double> range_at(NodeIndex node);
  /// Largest thickness of all shells at some nodes, as the solver widens boxes by.
  double largest_at(const std::vector<NodeIndex>& nodes);
  /// Of the shell (with `solids`: or the solid) under a segment. 0: there is none.
  double of_segment(const Corners& segment, bool solids);

 private:
  const ElementOrder& order();
  double widening_thickness(ElementKind kind, std::uint32_t e);
  void list_own_thicknesses();
  SceneContext& c_;
  std::unique_ptr<ElementOrder> order_;
  bool own_listed_ = false;
  std::vector<double> own_;  ///< own thicknesses: 4-node, then 3-node shells, in the solver's order
};

// surfaces.cpp
/// Corners in ascending order, each once: the same segment however it is written.
std::vector<NodeIndex> corner_set(const Corners& c);
/// Main segments and secondary nodes of surface-to-surface input.
void join_surfaces(const Coordinates& x, double dsearch, const std::vector<Corners>& first,
                   const std::vector<Corners>& second, Tie& tie);

// choose.cpp
/// Finds the segment of every node (Isearch 2) and what becomes of it.
void search_ties(SceneContext& context, TieThickness& thickness, Tie& tie);

// old_search.cpp
/// The same for Isearch 1: the segment around the nearest main node, at any distance.
void search_ties_by_nearest_node(const Coordinates& x, Tie& tie);

// conditions.cpp
/// What the ties and other conditions of the deck do to one another: repeated ties, main nodes
/// that are secondary, ties that become penalties, condensed mid nodes.
void resolve_tie_conflicts(SceneContext& context, std::vector<Tie>& ties);

// ties.cpp
/// Root of the mean square of all sides, as far as the solver looks by itself; a triangle has a
/// fourth side of length 0.
double mean_side(const Coordinates& x, const std::vector<Corners>& segments);
/// The ties of all /INTER/TYPE2, in the solver's order, with the nodes where they are; found once.
const std::vector<Tie>& ties_of(SceneContext& context);
/// Those of the interfaces that SceneOptions::only names. The others have their effect on them.
std::vector<Tie> wanted_ties(SceneContext& context);
/// The same for a scene that was made without ties.
std::vector<Tie> ties_of(const Scene& scene, const SceneOptions& options);
/// True if some contact may move nodes at the start.
bool moves_nodes(const Interfaces& interfaces);
/// What a tie holds, as the mesh needs it.
TiedNodes tied_nodes_of(const Tie& tie);

}  // namespace deck::detail
