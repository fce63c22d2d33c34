// Contacts of a deck: search of pairs, scene, gaps, initial penetrations, ties, crossed elements.
// Over 600 lines, because rows of all these name one another's items by position: whoever includes
// one part needs the others.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deck/model.hpp"
#include "deck/point3.hpp"
#include "deck/text.hpp"

namespace deck {

// Pair search: all node-segment and edge-edge pairs closer than their gap plus a margin, from plain
// arrays.

// Formula of the distance.
enum class Form : std::uint8_t {
  reference,  // the solver's formula, with its absolute floors 1e-30 and 1e-20
  robust      // exact closest point, relative guards only
};

/// Origin of the minimum gap of a contact.
enum class GapminOrigin : std::uint8_t {
  card,
  mean_thickness,     ///< mean over segments of shells
  minimum_thickness,  ///< minimum over segments of shells
  scaled_thickness,   ///< the minimum, multiplied by Fscalegap
  half_edge,          ///< half of the shortest main side, which was smaller
  solid_edge,         ///< no shells: a tenth of the shortest main side
  both_sides,         ///< TYPE11: mean of the defaults of both sides
};
const char* to_string(GapminOrigin origin);

// Rule for the gap of a pair in TYPE7, 10, 11, 19.
enum class GapRule {
  constant,    // Igap 0 or 1000: one gap for the whole interface
  sum,         // Igap 1, 2: gap_s + gap_m; both already multiplied by Fscalegap
  sum_limited  // Igap 3: gap_s + gap_m, at most length_s + length_m
};

// Pair gap. Lengths in the model's unit. `gapmin` is the gap itself for GapRule::constant.
//   sum:         max(gapmin, min(gapmax, gap_s + gap_m))            (gapmin wins over gapmax)
//   sum_limited: max(gapmin, min(gapmax, min(gap_s + gap_m, length_s + length_m)))
// TYPE11 has no gapmax: leave it infinite.
struct PairGap {
  GapRule rule = GapRule::constant;
  double gapmin = 0.0;
  double gapmax = std::numeric_limits<double>::infinity();

  static PairGap constant(double gap) { return {GapRule::constant, gap}; }

  // Rule of the effective Igap: 0 and 1000 constant, 3 limited, any other value sum.
  static PairGap from_igap(int igap, double gapmin,
                           double gapmax = std::numeric_limits<double>::infinity()) {
    if (igap == 0 || igap == 1000) return {GapRule::constant, gapmin, gapmax};
    return {igap == 3 ? GapRule::sum_limited : GapRule::sum, gapmin, gapmax};
  }

  // The gap of a pair. The lengths are used by sum_limited only; 1e30 or infinity: no limit.
  double operator()(double gap_s, double gap_m,
                    double length_s = std::numeric_limits<double>::infinity(),
                    double length_m = std::numeric_limits<double>::infinity()) const {
    if (rule == GapRule::constant) return gapmin;
    double gap = gap_s + gap_m;
    if (rule == GapRule::sum_limited) gap = std::min(gap, length_s + length_m);
    return std::max(std::min(gap, gapmax), gapmin);
  }

  // Part of one side in an upper bound of the gap: operator() <= share(side_s) + share(side_m),
  // except for round-off of the sum. A search can inflate each side by its share.
  double share(double side_gap) const {
    const double half = 0.5 * gapmin;
    if (rule == GapRule::constant) return half;
    return std::max(std::min(side_gap, gapmax), half);
  }
};

// Node coordinates, one array per axis, equal lengths, finite values.
struct NodeArrays {
  std::span<const double> x, y, z;
};

struct CandidatePair {
  std::uint32_t secondary = 0;  // position in the list of secondary nodes or edges
  std::uint32_t main = 0;       // position in the list of main segments or edges
  friend auto operator<=>(const CandidatePair&, const CandidatePair&) = default;
};

// Node-to-segment input. Spans of gaps, lengths and stiffness are as long as their list or empty
// (gap 0, length infinite, stiffness not 0).
struct NodeSegmentInput {
  NodeArrays nodes;
  std::span<const std::uint32_t> secondary;  // node positions; duplicates allowed
  std::span<const double> secondary_gap;
  std::span<const double> secondary_length;                // gs_l, GapRule::sum_limited only
  std::span<const double> secondary_stiffness;             // exactly 0: the node is left out
  std::span<const std::array<std::uint32_t, 4>> segments;  // triangle: last two nodes equal
  std::span<const double> segment_gap;
  std::span<const double> segment_length;     // gm_l, GapRule::sum_limited only
  std::span<const double> segment_stiffness;  // exactly 0: the segment is left out
};

// Edge-to-edge input, with the conventions of NodeSegmentInput.
struct EdgeEdgeInput {
  NodeArrays nodes;
  std::span<const std::array<std::uint32_t, 2>> secondary;
  std::span<const double> secondary_gap;
  std::span<const double> secondary_length;
  std::span<const double> secondary_stiffness;
  std::span<const std::array<std::uint32_t, 2>> main;
  std::span<const double> main_gap;
  std::span<const double> main_length;
  std::span<const double> main_stiffness;
};

struct SearchOptions {
  PairGap gap;
  double drad = 0.0;                             // radiation distance: lower limit of the pair gap
  double margin = 0.0;                           // added to the pair gap
  Form form = Form::reference;                   // formula of the distance
  int threads = 1;                               // 0: one per core. Does not change the result
  std::size_t max_pairs = std::size_t{1} << 31;  // the search stops above this number
};

struct SearchResult {
  std::vector<CandidatePair> pairs;  // sorted by secondary, then main; no duplicates
  bool complete = true;              // false: more than max_pairs exist; `pairs` is empty then
  std::size_t tested = 0;            // pairs whose distance was computed
};

// Returns all pairs with distance < max(drad, gap(secondary, main)) + margin; the distance is the
// smallest of the sub-triangles of the segment (closest_on_segment). Leaves out pairs whose node
// belongs to the segment, and items of stiffness 0. Misses no pair, whatever the mesh grading.
// Expected time O((n + m) log(n + m) + pairs).
SearchResult find_node_segment_pairs(const NodeSegmentInput& input, const SearchOptions& options);

// Returns all pairs of edges closer than that without a common node (closest_between_edges).
SearchResult find_edge_edge_pairs(const EdgeEdgeInput& input, const SearchOptions& options);

// Margin of the solver for its candidate count: 0.2 (single precision) times the mean edge length
// of the segments; triangles, too, count as four edges.
double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments);

// Ties: for each /INTER/TYPE2 the secondary nodes that the solver ties at start-up, their main
// segments, and the nodes that it does not tie, with reasons.

/// One secondary node of a tie.
struct TiedNode {
  NodeIndex node = no_index;
  /// True if neither its interface nor anything else ties it.
  bool lost() const { return !tied && removed_by == 0; }
  std::uint32_t segment = no_index;  ///< position in Tie::main; no_index: none found
  /// Position on the segment, -1 to 1, axes in the order of its corners. Triangles with Spotflag
  /// 27: weights of corners 1 and 2.
  double s = 0, t = 0;
  double distance = 0;  ///< as the solver stores it: search distance - (search distance - distance)
  double search = 0;    ///< search distance of the solver; 0: no segment was examined
  /// For a node without segment: the nearest segment and its distance in the solver's measure.
  /// no_index: none, or no search.
  std::uint32_t nearest = no_index;
  double nearest_distance = 0;
  /// Range of search distances that the other shells at the node would give with this (else the
  /// nearest) segment. The solver uses the thickness of one shell, chosen by corner numbers.
  double least_search = 0, most_search = 0;
  bool missed = false;  ///< a segment is within reach, but outside the solver's search box
  int message = 0;      ///< solver message that lists the node: 1071 1078 1079 1157 1158 1872 1873
  int removed_by = 0;   ///< 1630 (the same tie exists already), 1209 (condensed mid node)
  bool tied = false;
  bool penalty = false;  ///< penalty formulation: Spotflag 25, 26 always; 27, 28 after message 1179
};

/// Ties repeated by a later interface (solver warning 1630).
struct RepeatedTies {
  std::int64_t interface_id = 0;  ///< the earlier interface
  std::uint32_t count = 0;
};

/// An /INTER/TYPE2 at start-up.
struct Tie {
  const InterType2* inter = nullptr;
  int spotflag = 0;  ///< effective; 0 is the standard formulation (5)
  int ignore = 0;    ///< effective; 0: the solver stops at an untied node
  /// Search distance of all nodes; 0: each pair has its own (Ignore 2 and 3 without dsearch).
  double search_distance = 0;
  std::vector<std::array<NodeIndex, 4>>
      main;                     ///< after re-orientation by the solver; triangle: last repeated
  std::vector<TiedNode> nodes;  ///< ascending node id
  std::vector<RepeatedTies> repeated;
  std::vector<NodeIndex> main_and_tied;  ///< tied main nodes (error 556)
  std::string not_evaluated;             ///< reason; empty: it was evaluated
};

struct TieCounts {
  std::size_t nodes = 0;      ///< secondary nodes
  std::size_t tied = 0;       ///< tied at the end of start-up
  std::size_t not_found = 0;  ///< no segment within reach
  std::size_t dropped = 0;    ///< found, then dropped
  std::size_t elsewhere = 0;  ///< removed because something else ties them: 1630, 1209
  std::size_t outside = 0;    ///< tied to a segment outside of its border
  std::size_t lost() const { return not_found + dropped; }
};
TieCounts count_ties(const Tie& tie);

// Scene: all interfaces as elementary contacts (node to segment, edge to edge) with segments, gaps
// and stiffness as the solver forms them at start-up, and the initial penetrations with the effect
// of Inacti and Fpenmax on each.

/// The solver's action on one initial penetration.
enum class PenetrationAction : std::uint8_t {
  none,
  node_stiffness_zero,     ///< Inacti 1, or Fpenmax exceeded
  segment_stiffness_zero,  ///< Inacti 2
  node_moved,              ///< Inacti 3
  gap_reduced,             ///< Inacti 5, 6
  edge_stiffness_zero,     ///< TYPE11: Inacti 1, 2; with 5, 6 if deeper than 99.5 % of the gap
  ignored,                 ///< TYPE24, 25: Inacti 0
  offset_stored,           ///< TYPE24, 25: Inacti 5, subtracted from all later penetrations
  initial_force,           ///< TYPE24, 25: Inacti -1, a force in the first cycle
  removed_tied,            ///< TYPE24, 25: the node is tied, Irem_i2
  error_611,  ///< the node is exactly on the segment: the solver stops (Inacti 3, 5, 6)
  error_612,  ///< as error_611, but with Inacti 0
};
inline constexpr std::size_t penetration_actions = 12;  ///< number of enumerators
/// True if the solver stops at this penetration.
inline bool stops_solver(PenetrationAction action) {
  return action == PenetrationAction::error_611 || action == PenetrationAction::error_612;
}
/// Words for reports, singular or plural: "nothing", "gap reduced", "edges switched off", ...
const char* action_words(PenetrationAction action, std::size_t pairs = 2);
const char* to_string(PenetrationAction action);  ///< "none", "node-stiffness-zero", ...

struct PenetrationRow {
  std::uint32_t secondary = 0, main = 0;  ///< positions in the contact's lists
  double depth = 0;                       ///< gap - distance
  double gap = 0;                         ///< pair gap
  double distance = 0;
  std::array<double, 3> normal{};  ///< unit, main to secondary; zero when on_surface
  bool on_surface = false;
  /// Accuracy::robust: false if only round-off of the solver's formula makes this a penetration.
  /// The solver acts on it nevertheless.
  bool in_contact = true;
  PenetrationAction action = PenetrationAction::none;
  bool has_gap0 = false;
  double p0 = 0, gap0 = 0;  ///< Inacti 5, 6: stored penetration, remaining gap (TYPE24, 25: 0)
  std::array<double, 3> moved_by{};   ///< Inacti 3
  double weight_s = 0, weight_m = 0;  ///< edge pairs: weights of the first node of each edge
};

/// Other values for one interface, evaluated without reading the deck again.
struct WhatIf {
  std::int64_t interface_id = 0;
  std::optional<double> Gapmin, Fscalegap, Gapmax, Fpenmax, mesh_size;
  std::optional<int> Igap, Inacti, Irem_gap;
};

enum class ContactKind : std::uint8_t { node_segment, edge_edge };
/// Part of an interface that a contact is. A TYPE19 has up to three.
enum class ContactRole : std::uint8_t { primary, reversed, edges };

const char* to_string(ContactKind kind);  ///< "node_segment", "edge_edge"
const char* to_string(ContactRole role);  ///< "primary", "reversed", "edges"

/// One main segment; the arrays of a Contact are parallel to `main`.
struct MainSegment {
  std::array<NodeIndex, 4> nodes{};  ///< after repair and re-orientation; triangle: last two equal
  Carrier carrier = Carrier::none;   ///< kind of the element that determines gap and stiffness
  bool off = false;                  ///< switched off by Inacti 2; `stiffness` is unchanged
  std::uint32_t element = no_index;
  double stiffness = 0;  ///< as stored at start-up, without the factor 1/2 (constant: |Stfac|)
  double gap = 0;        ///< half thickness times Fscalegap; 0 for solids
};
struct SecondaryNode {
  NodeIndex node = no_index;
  bool off = false;       ///< switched off by Inacti = 1 or Fpenmax
  double multiplier = 1;  ///< factor of the stiffness, as stored at start-up
  double gap = 0;
};
struct ContactEdge {
  std::array<NodeIndex, 2> nodes{};
  Carrier carrier = Carrier::none;
  bool off = false;  ///< switched off by Inacti; `stiffness` is unchanged
  std::uint32_t element = no_index;
  double stiffness = 0, gap = 0;
  double shell = 0;    ///< contact thickness of its shell, 0: none
  double section = 0;  ///< sqrt(area) of its truss or beam, 0: none
};

/// TYPE24 and TYPE25: kind of a main segment. A shell has one segment per side.
enum class SegmentKind : std::uint8_t { solid, shell, shell_opposite, coat, coat_opposite };
const char* to_string(SegmentKind kind);  ///< "solid", "shell", "shell-opposite", "coat", ...

/// TYPE25: an edge that passes through a main segment of a solid near one of its sides.
struct EdgeThroughSegment {
  std::uint32_t edge = 0, main = 0;  ///< positions in the edges of the interface and in `main`
  int side = 0;                      ///< 1 to 4: the side from this corner to the next
  double depth = 0;
};

/// TYPE24 with Iedge: a point that the solver adds on an edge as a secondary node without id.
struct EdgePoint {
  std::string_view place;  ///< "quarter" or "three-quarters" from the edge's first node, "inner"
  std::array<double, 3> at{};
};

/// Arithmetic for the decision about contact, and for the values.
enum class Accuracy : std::uint8_t {
  fast,       ///< plain double, closest point by the robust formula
  reference,  ///< plain double, the reference solver's formula
  robust,     ///< filtered, always correct; values by the reference formula
  exact       ///< rational numbers; values rounded once
};
const char* to_string(Accuracy accuracy);  ///< "fast", "reference", "robust", "exact"

/// A pair about which the solver's arithmetic and exact arithmetic disagree.
struct DecisionDifference {
  std::uint32_t contact = 0, secondary = 0, main = 0;  ///< positions in the scene and its lists
  bool surface = false;  ///< true: about "exactly on the segment"; false: about "in contact"
  bool exact = false;    ///< exact result; the solver has the opposite
  double gap = 0, solver_distance = 0, exact_distance = 0;
  PenetrationAction action = PenetrationAction::none;  ///< the solver's action on the pair
};

/// Statistics of the contact decisions of a scene.
struct DecisionReport {
  Accuracy mode = Accuracy::robust;
  std::uint64_t pairs = 0;                                 ///< decided
  std::uint64_t fallback = 0;                              ///< needed more than double precision
  std::uint64_t exact = 0;                                 ///< needed integers or rationals
  std::uint64_t contact_differs = 0, surface_differs = 0;  ///< only with robust and exact
  std::vector<DecisionDifference> differences;             ///< the first differences
};

/// One elementary contact.
struct Contact {
  const InterBase* inter = nullptr;
  ContactKind kind = ContactKind::node_segment;
  ContactRole role = ContactRole::primary;
  int type = 7;           ///< 7, 10, 11, 24 or 25: the type whose rules it follows
  bool dropped = false;   ///< TYPE19 edges: no edges, the solver drops the part
  bool evaluated = true;  ///< false: too many pairs, or coordinates are not finite

  // Effective options; 1000 is 0 here.
  int istf = 0, igap = 0, inacti = 0, irem_gap = 1, itied = 0;
  double factor = 1;  ///< < 0: constant stiffness |factor|
  double stmin = 0, stmax = 1e30, fpenmax = 0, gap_scale = 1, mesh_fraction = 0;

  PairGap gap_rule;
  double gapmin = 0, gapmax = 1e30, drad = 0;
  GapminOrigin gapmin_origin = GapminOrigin::card;
  double max_gap = 0;        ///< upper limit of pair gaps in the solver's search
  double shortest_side = 0;  ///< of all main segments (or of both line sets)

  std::vector<SecondaryNode> secondary;  ///< node_segment
  std::vector<MainSegment> main;
  std::vector<ContactEdge> secondary_edges;  ///< edge_edge
  std::vector<ContactEdge> main_edges;

  // One value per secondary or main item; empty if the contact has none.
  std::vector<double> secondary_length, main_length;  ///< Igap 3: limit; 1e30: on no main segment
  std::vector<double> secondary_stored, main_stored;  ///< edges, Inacti 5, 6: taken from pair gaps
  std::vector<double> nodal_stiffness;                ///< of secondary nodes: Istf 2 to 5

  std::uint64_t candidates = 0;     ///< pairs within gap + margin; edge pairs: within gap
  std::uint64_t removed_pairs = 0;  ///< candidates removed by Irem_gap 2
  std::vector<PenetrationRow> penetrations;

  // TYPE24 and TYPE25 only.
  std::vector<SegmentKind> segment_kinds;  ///< parallel to `main`
  /// Per secondary edge, then per main edge: 1 solids, 2 other, 3 of a line, -1 carrier.
  std::vector<std::int8_t> edge_kinds;
  std::vector<EdgeThroughSegment> edges_through_segments;  ///< the last rows of `penetrations`
  std::vector<PenetrationRow> uncounted;  ///< edge pairs that the solver finds but does not count
  /// TYPE24 with Iedge: one per secondary edge. Main edges are sides of the segments in `main`.
  std::vector<EdgePoint> points;
  double largest_accepted = 0;  ///< TYPE24: largest depth that counts as a penetration

  int repaired_segments = 0;                          ///< solver warning 106
  int degenerate_segments = 0;                        ///< solver error 558
  int reoriented_segments = 0;                        ///< solver warning 3025
  std::vector<std::uint32_t> degenerate, no_carrier;  ///< positions in `main`
  /// Positions in `main`: segments in more than two solids (solver warning 3062); quadrangular
  /// faces of solids whose nodes all belong to another solid without this face.
  std::vector<std::uint32_t> crowded, inside_solids;

  /// Gap of a pair, by positions in its lists, before `secondary_stored` and `main_stored`.
  double pair_gap(std::uint32_t of_secondary, std::uint32_t of_main) const;
  /// True if its pairs are ties: a TYPE10 ties at start-up every node within the gap. Ties are in
  /// `penetrations`, as in the solver's list, but are not counted or repaired as penetrations.
  /// ITIED of a TYPE7 ties nothing at start-up: it acts in the Engine when a time step is below
  /// dtmin.
  bool is_tied_contact() const { return kind == ContactKind::node_segment && type == 10; }
  bool main_empty() const { return main.empty() && main_edges.empty(); }
  bool secondary_empty() const { return secondary.empty() && secondary_edges.empty(); }
};

struct Scene {
  const Model* model = nullptr;
  const Interfaces* interfaces = nullptr;
  Coordinates coordinates;                 ///< after the moves of Inacti 3
  std::vector<Contact> contacts;           ///< in the solver's processing order
  std::vector<Tie> ties;                   ///< of /INTER/TYPE2; filled with SceneOptions::ties
  Examined examined = Examined::contacts;  ///< contacts_and_ties if ties were requested
  bool judged = false;       ///< true: penetrations were searched (SceneOptions::penetrations)
  DecisionReport decisions;  ///< of the penetrations
  Limits limits;             ///< of SceneOptions; used by functions that evaluate the scene
};

struct SceneOptions {
  int threads = 1;
  bool candidates = true;  ///< also count candidates (a wider search)
  bool penetrations = true;
  bool ties = false;                     ///< also find the ties of /INTER/TYPE2
  Accuracy accuracy = Accuracy::robust;  ///< arithmetic for contact decisions
  bool nodal_stiffness = false;          ///< fill Contact::nodal_stiffness (needed for forces)
  std::vector<std::int64_t> only;        ///< interface ids to build; empty: all
  std::vector<WhatIf> what_if;
  Limits limits;  ///< contacts above pair_bytes are not evaluated, with a finding
  std::function<bool()> exact_over;  ///< returns true: decide the remaining pairs as `robust`
  std::function<void(std::size_t, std::size_t)> progress;  ///< (contacts done, all); may be empty
};

/// Builds all contacts in the solver's order: parts of TYPE19, segments, gaps, stiffness,
/// penetrations, Inacti. Inacti 3 moves nodes, which changes later contacts.
Scene build_scene(const Model& model, const Interfaces& interfaces, Findings& findings,
                  const SceneOptions& options = {});

/// Sets every value of Origin::geometry from the first contact of its interface. `scene` must be
/// built from `interfaces`, without WhatIf; penetrations are not needed. Interfaces without a
/// contact in the scene stay unresolved.
void resolve(Interfaces& interfaces, const Scene& scene);

/// True if some value needs `resolve`.
bool waits_for_geometry(const Interfaces& interfaces);

/// The first contact of an interface that is not dropped; nullptr: none.
const Contact* first_contact(const Scene& scene, const InterBase& inter);

/// Value of a field of Origin::geometry for one contact. Contacts of a TYPE19 may differ.
double geometry_value(const Contact& contact, std::string_view field);

// Crossed elements: edges that pass through main segments, which penetration depths do not show.
// The decision is exact. The solver has no such check.

/// Returns the pairs (secondary: edge, main: segment) where the edge passes through the segment,
/// sorted. A quad is the triangles (1 2 3) and (1 3 4). An edge passes through a triangle if its
/// ends are strictly on both sides of the plane and it meets the closed triangle. Not counted:
/// touching, edges in the plane, edges with a node of the segment. Exact for finite coordinates.
/// `threads` does not change the result.
std::vector<CandidatePair> find_crossing_pairs(
    const NodeArrays& nodes, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const std::array<std::uint32_t, 4>> segments, int threads = 1);

/// One edge of an element through one main segment of a contact.
struct Crossing {
  std::uint32_t contact = 0;        ///< Scene::contacts
  std::array<NodeIndex, 2> edge{};  ///< smaller index first
  ElementKind edge_kind{};          ///< the first element with this edge
  std::uint32_t edge_element = no_index;
  std::uint32_t main = 0;  ///< Contact::main
};

/// Returns the crossed elements of all node-to-segment contacts: edges of shells, solids, trusses
/// and beams with two secondary nodes, through main segments. An edge and a segment are listed
/// once, in the first contact with both. Springs are left out: they connect parts through others.
/// Order: contact, edge, segment. Uses Scene::coordinates.
std::vector<Crossing> find_crossings(const Scene& scene, int threads = 1);

// Views of a scene: penetrations with ids of nodes, elements and parts; the deepest per node; part
// pairs by depth; totals for the verdict.

/// Kind, id and part of an element.
struct ElementName {
  ElementKind kind{};
  std::uint32_t index = no_index;
  std::int64_t id = 0, part = 0;
  bool valid() const { return index != no_index; }
};

/// One penetration with ids.
struct NamedPenetration {
  std::uint32_t contact = 0, row = 0;       ///< Scene::contacts, Contact::penetrations
  std::array<std::int64_t, 2> secondary{};  ///< node id (second 0), or the two nodes of an edge
  std::array<std::int64_t, 4> main{};       ///< segment nodes, or edge nodes and zeros
  ElementName secondary_element, main_element;
  std::array<double, 3> at{};  ///< secondary node (edge: closest point), working units
};

/// Rows of a scene; each is named where it is read. Refers to the scene's model and contacts.
struct NamedPenetrations {
  struct Place {
    std::uint32_t contact = 0, row = 0;
    ElementKind kind{};  ///< of the element at the secondary node
    std::uint32_t element = no_index;
  };
  struct Iterator {
    const NamedPenetrations* of;
    std::size_t i;
    NamedPenetration operator*() const { return (*of)[i]; }
    Iterator& operator++() { return ++i, *this; }
    bool operator==(const Iterator&) const = default;
  };
  const Model* model = nullptr;
  std::span<const Contact> contacts;
  std::vector<Place> places;

  NamedPenetration operator[](std::size_t i) const;
  std::array<ElementName, 2> elements(std::size_t i) const;  ///< secondary, main
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }
  std::size_t size() const { return places.size(); }
  bool empty() const { return places.empty(); }
};

/// Distinct secondary nodes, distinct edges, and pairs. The three overlap: do not add them.
struct ItemCounts {
  std::uint64_t pairs = 0, nodes = 0, edges = 0;
};

struct PartPair {
  std::int64_t secondary = 0, main = 0;  ///< part ids, 0: no part
  ItemCounts count, on_segment;
  double max_depth = 0, mean_depth = 0, p95_depth = 0, max_ratio = 0;
  std::uint32_t worst = 0;  ///< index of the deepest into SceneView::penetrations
};

struct ContactTotals {
  ItemCounts count;          ///< penetrations without ties
  ItemCounts tied;           ///< ties (Contact::is_tied_contact)
  std::uint64_t untied = 0;  ///< nodes of TYPE10 without a segment within reach
  ItemCounts on_segment;     ///< penetrations at distance 0
  std::optional<std::uint64_t> crossed_elements;  ///< nullopt: not searched
  std::uint64_t solver_errors = 0;                ///< nodes at which the solver stops: 611, 612
  std::uint64_t acted = 0;                        ///< pairs that Inacti or Fpenmax changes
  std::uint64_t round_off = 0;                    ///< pairs with PenetrationRow::in_contact false
  double max_depth = 0, max_ratio = 0;
};

struct SceneView {
  /// Without ties; deepest first, then by contact and row.
  NamedPenetrations penetrations;
  NamedPenetrations ties;                       ///< rows of tied contacts, in the same order
  std::vector<std::uint32_t> deepest_per_node;  ///< in penetrations: of a contact's node or edge
  double largest_gap = 0;  ///< ten times the model's size; larger gaps are treated as unbounded
  std::vector<PartPair> part_pairs;     ///< deepest first
  std::vector<ContactTotals> contacts;  ///< parallel to Scene::contacts
  ContactTotals total;                  ///< counts a node or edge of several contacts once
};

/// Builds the view; all outputs count penetrations with it. `crossings` is the result of
/// find_crossings for this scene. `threads` does not change the result.
SceneView make_view(const Scene& scene, const std::vector<Crossing>* crossings = nullptr,
                    int threads = 1);

/// Positions in `secondary` of the untied nodes of a tied contact. Empty for other contacts and for
/// contacts that were not evaluated.
std::vector<std::uint32_t> untied_secondary(const Contact& contact);

/// Why a contact with 0 penetrations is not reported as clean.
enum class NotCleanReason {
  none,
  empty_main,       ///< a side is empty: no pair is possible
  empty_secondary,  ///< as empty_main; the solver continues if the node group exists but is empty
  no_gap,           ///< the solver stops (785, 786)
  no_area,          ///< a main segment without area: the solver stops (558)
  no_element,       ///< a segment or edge that belongs to no element: the solver stops (481, 482)
  no_stiffness,     ///< no main segment has stiffness: the solver ignores them all
};

/// The first reason that applies to a contact; `none` if the solver drops the contact.
NotCleanReason not_clean_reason(const Contact& contact);
std::string_view to_string(NotCleanReason reason);  ///< name; empty for none

/// Initial penetrations of an earlier `deck gaps --json`.
struct GapBaseline {
  struct Row {
    std::int64_t interface_id = 0;
    std::string role;                         ///< "primary", "reversed", "edges"
    std::array<std::int64_t, 2> secondary{};  ///< node (second 0) or the two nodes of an edge
    double depth = 0, gap = 0;                ///< lengths, also for edges
    std::optional<std::array<double, 3>> at;  ///< NamedPenetration::at; missing in old documents
  };
  std::string path;                ///< path of the JSON file, as given
  std::string deck_path;           ///< path of its deck; empty: the file has other decks only
  std::vector<std::string> decks;  ///< all decks of the file, in its order
  std::vector<Row> rows;           ///< the deepest row of every secondary node or edge
  /// Node ids by interface: tied by a TYPE10; not tied by a TYPE2.
  std::map<std::int64_t, std::set<std::int64_t>> tied, untied;
  bool accepts = false;  ///< a baseline: what it does not list is new
};

/// Ids of nodes that an evaluated TYPE10 or TYPE2 should tie and does not.
std::map<const InterBase*, std::vector<std::int64_t>> untied_nodes(const Scene& scene);

enum class Trend : std::uint8_t { added, worse, same, better };
const char* to_string(Trend trend);  ///< "new", "worse", "same", "better"

/// The penetrations of a scene compared with an earlier run.
struct GapsComparison {
  struct Row {
    std::uint32_t penetration = 0;  ///< the deepest of its node or edge
    Trend trend = Trend::added;
    std::uint32_t earlier = no_index;  ///< into GapBaseline::rows; no_index: new
  };
  std::vector<Row> rows;  ///< parallel to SceneView::deepest_per_node
  /// GapBaseline::rows of evaluated contacts that no longer penetrate, in their order.
  std::vector<std::uint32_t> solved;
  /// Ids of nodes that an interface tied in the earlier run and does not tie now.
  std::map<const InterBase*, std::vector<std::int64_t>> lost_ties;

  std::uint64_t count(Trend trend) const;
};

/// Matches rows with equal ids and place; then rows at the same place (within a millionth of the
/// gap; ids were changed); then rows with equal ids (nodes were moved). O(n log n).
GapsComparison compare_gaps(const GapBaseline& earlier, const Scene& scene, const SceneView& view);

}  // namespace deck
