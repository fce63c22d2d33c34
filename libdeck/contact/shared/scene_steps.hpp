// Steps that turn an interface into contacts.
#pragma once
#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/shared/vec.hpp"
#include "contact/rules/gaps.hpp"
#include "contact/shared/node_elements.hpp"
#include "deck/contacts.hpp"
#include "deck/model.hpp"

namespace deck::detail {

/// Shells at each node, empty until first use; volumes of solids, 0 until first use.
struct ElementTables {
  explicit ElementTables(std::size_t solids = 0) : volume(solids) {}
  std::vector<double> half_thickness;       ///< of the thickest shell, before Fscalegap
  std::vector<double> stiffness;            ///< sum of all
  std::vector<std::uint32_t> count;         ///< terms of that sum
  std::vector<std::atomic<double>> volume;  ///< valid while no node moves
  std::mutex building;                      ///< of tables for several contacts
};

/// Data that all contacts of a scene share.
struct SceneContext {
  const Model& model;
  Connectivity& connectivity;
  Scene& scene;
  Findings& findings;
  const SceneOptions& options;
  std::shared_ptr<ElementTables> tables = std::make_shared<ElementTables>(model.solid8.size());
  bool all_placed = false;                    ///< every node has a position that stays valid
  std::optional<std::vector<Tie>> ties = {};  ///< of all /INTER/TYPE2: ties_of()
};

/// A model with positions of its nodes: input of gaps.
struct GapInputs {
  const Model& model;
  Connectivity& connectivity;
  ElementTables& tables;
  const Coordinates& coordinates;
  int threads = 1;
  /// shortest_line_elements() of them, valid while no node moves; may be nullptr.
  const std::vector<double>* shortest_lines = nullptr;
};

inline Vec at(const Coordinates& c, NodeIndex n) { return {c.x[n], c.y[n], c.z[n]}; }
inline double distance(const Coordinates& c, NodeIndex a, NodeIndex b) {
  return norm(at(c, b) - at(c, a));
}

// scene.cpp
/// Settings of the card before the rules of its parts apply. Fields that Igap disables keep their
/// value for a what-if with another Igap.
CardSettings card_settings(const InterBase& inter);

// segments.cpp — clean-up, orientation, carriers (reference solver: surface clean-up)
/// Turns surface segments into main segments: repairs repeated nodes, finds carriers of plain
/// segments, orients faces of single solids outward, marks degenerate ones.
void make_main_segments(SceneContext& context, const SegmentList& segments, Contact& contact);

/// First matching rule of the solver's repair (warning 106). True if something changed.
bool repair(std::array<NodeIndex, 4>& segment);
/// Solids that contain all nodes of a segment.
struct SolidsOfSegment {
  std::uint32_t first = no_index, last = no_index;
  std::uint32_t best = no_index;  ///< with the largest user id
  int count = 0;
};
SolidsOfSegment solids_of(SceneContext& context, const std::array<NodeIndex, 4>& segment);
/// Thickest shell with all nodes of a segment; among equals the stiffest.
struct ShellOfSegment {
  ElementKind kind{};
  std::uint32_t element = no_index;
};
ShellOfSegment shell_of(SceneContext& context, const std::array<NodeIndex, 4>& segment);
/// Orients the segment away from the centroid of its solid. True if reversed.
bool orient_outward(SceneContext& context, std::uint32_t solid, std::array<NodeIndex, 4>& segment);

// stiffness.cpp — sections and materials of elements
/// Contact thickness of a shell (kind shell4 or shell3).
double gap_thickness(const Model& model, ElementKind kind, std::uint32_t e);
bool is_on_shell(const MainSegment& segment);
/// That of the shell which carries a segment, or of the thickest element at an edge; 0: none.
double contact_thickness(const Model& model, const MainSegment& segment);
inline double contact_thickness(const Model&, const ContactEdge& edge) {
  return std::max(edge.shell, edge.section);
}
/// Thickness in the main stiffness of TYPE7 and TYPE10, without the part thickness.
double stiffness_thickness(const Model& model, ElementKind kind, std::uint32_t e);
double young_of(const Model& model, ElementKind kind, std::uint32_t e);
double bulk_of(const Model& model, std::uint32_t solid);
/// sqrt(area) of a truss or beam.
double section_thickness(const Model& model, ElementKind kind, std::uint32_t e);
double section_area(const Model& model, ElementKind kind, std::uint32_t e);
double part_thickness(const Model& model, ElementKind kind, std::uint32_t e);
/// Absolute one-point volume of a hexahedron from its eight slots.
double solid_volume(const Coordinates& x, const NodeIndex* slots);
double solid_volume(SceneContext& context, std::uint32_t solid);
double spring_stiffness(const Model& model, std::uint32_t spring);
/// By node: why the thickness or section of an element there, or (`stiffness`) what it gives to the
/// stiffness of a contact, is not known: its property or law is known by name only.
std::map<NodeIndex, std::string> unread_at_nodes(const Model& model, bool stiffness);

// penetrations.cpp
/// Reports (DK336) many coincident secondary nodes that touch the main side.
void report_one_place(SceneContext& context, const Contact& contact);

// stiffness.cpp
void set_main_stiffness(SceneContext& context, Contact& contact);
void set_edge_stiffness(SceneContext& context, std::vector<ContactEdge>& edges,
                        const Contact& contact);
/// K_s of every secondary node (Istf 2..5).
void set_nodal_stiffness(SceneContext& context, Contact& contact);
/// Its input from shells.
const ElementTables& shell_stiffness_at_nodes(SceneContext& context);

// gaps.cpp
void set_gaps(SceneContext& context, Contact& contact, double gapmin_input);
void set_edge_gaps(SceneContext& context, Contact& contact, double gapmin_input);
/// Contributions of the items to gaps before any factor, and limits by Igap 3, whatever Igap the
/// card has; 0 for a TYPE10. Parallel to the contact's lists.
struct PlainSides {
  std::vector<double> half_thickness;  ///< of secondary nodes; edges store their own
  std::vector<double> secondary_length, main_length;
  double shortest_side = 0;            ///< as Contact::shortest_side, at the positions of `around`
  EdgeSide secondary_side, main_side;  ///< edges: input of their default gap
};
PlainSides plain_sides(const GapInputs& around, const Contact& contact);
/// By node: length of the shortest truss, beam or spring; infinity if none.
std::vector<double> shortest_line_elements(const Model& model, const Coordinates& x);
/// Half thickness of the thickest shell at each node; 0 if none.
const std::vector<double>& shell_half_thickness(const GapInputs& around);
/// Half thickness of a truss, beam or spring; of the thickest one at a node; 0 if none.
double half_of_line(const Model& model, ElementKind kind, std::uint32_t e);
double line_half_thickness(const GapInputs& around, NodeIndex node);
/// Input of default gaps: thickness of the main shells; one side of a line contact.
ThicknessSamples shell_thickness(const Model& model, const Contact& contact);
EdgeSide edge_side(const Coordinates& x, const std::vector<ContactEdge>& edges);

// penetrations.cpp
/// `decisions`: of this contact; the caller sets its position.
void find_penetrations(SceneContext& context, Contact& contact, DecisionReport& decisions);
void find_edge_penetrations(SceneContext& context, Contact& contact, DecisionReport& decisions);

}  // namespace deck::detail
