// Contacts: search of pairs, the scene (all contacts with gaps and initial penetrations), ties,
// crossed elements, views with ids. Over 600 lines: one public header has the whole concept.
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

// Finds every node-segment and every edge-edge pair that is closer than its gap plus a margin.
// Works on plain arrays; knows nothing of decks or interfaces.

// The formulas of the distance.
enum class Form : std::uint8_t {
  reference,  // the published solver's, with its absolute floors 1e-30 and 1e-20
  robust      // exact closest point, relative guards only, residual form of the distance
};

/// The origin of the minimum gap of a contact.
enum class GapminOrigin : std::uint8_t {
  card,
  mean_thickness,     ///< mean over shell-carried segments
  minimum_thickness,  ///< minimum over shell-carried segments
  scaled_thickness,   ///< the minimum, multiplied by Fscalegap
  half_edge,          ///< half the shortest main side was smaller
  solid_edge,         ///< no shells: a tenth of the shortest main side
  both_sides,         ///< TYPE11: mean of the two sides' defaults
};
const char* to_string(GapminOrigin origin);

// How the gap of a pair is formed (reference solver, TYPE7/10/11/19).
enum class GapRule {
  constant,    // Igap 0 or 1000: one gap for the whole interface
  sum,         // Igap 1, 2 (Fscalegap already multiplied into the two sides): gap_s + gap_m
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

  // From the effective value of the Igap flag: 0/1000 constant, 3 limited, anything else sum.
  static PairGap from_igap(int igap, double gapmin,
                           double gapmax = std::numeric_limits<double>::infinity()) {
    if (igap == 0 || igap == 1000) return {GapRule::constant, gapmin, gapmax};
    return {igap == 3 ? GapRule::sum_limited : GapRule::sum, gapmin, gapmax};
  }

  // The gap of a pair. The two lengths only matter for sum_limited; 1e30, infinity: no limit.
  double operator()(double gap_s, double gap_m,
                    double length_s = std::numeric_limits<double>::infinity(),
                    double length_m = std::numeric_limits<double>::infinity()) const {
    if (rule == GapRule::constant) return gapmin;
    double gap = gap_s + gap_m;
    if (rule == GapRule::sum_limited) gap = std::min(gap, length_s + length_m);
    return std::max(std::min(gap, gapmax), gapmin);
  }

  // Share of one side in an upper bound of the pair gap: operator() <= share(side_s) +
  // share(side_m), up to the rounding of that sum. Lets a search inflate the two sides apart.
  double share(double side_gap) const {
    const double half = 0.5 * gapmin;
    if (rule == GapRule::constant) return half;
    return std::max(std::min(side_gap, gapmax), half);
  }
};

// Node coordinates, one array per axis, all of the same length. Finite numbers only.
struct NodeArrays {
  std::span<const double> x, y, z;
};

struct CandidatePair {
  std::uint32_t secondary = 0;  // position in the list of secondary nodes (or secondary edges)
  std::uint32_t main = 0;       // position in the list of main segments (or main edges)
  friend auto operator<=>(const CandidatePair&, const CandidatePair&) = default;
};

// Node-to-segment input. Every span of gaps, lengths or stiffnesses may be empty: gap 0, length
// infinite, stiffness not 0. Otherwise it is as long as the list it describes.
struct NodeSegmentInput {
  NodeArrays nodes;
  std::span<const std::uint32_t> secondary;  // node positions; duplicates allowed
  std::span<const double> secondary_gap;
  std::span<const double> secondary_length;                // gs_l, GapRule::sum_limited only
  std::span<const double> secondary_stiffness;             // exactly 0: the node takes no part
  std::span<const std::array<std::uint32_t, 4>> segments;  // triangle: last two nodes equal
  std::span<const double> segment_gap;
  std::span<const double> segment_length;     // gm_l, GapRule::sum_limited only
  std::span<const double> segment_stiffness;  // exactly 0: the segment takes no part
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
  double drad = 0.0;            // radiation distance: the pair gap is at least this long
  double margin = 0.0;          // added to the pair gap
  Form form = Form::reference;  // which distance decides
  int threads = 1;              // 0: one per core. The result does not depend on it
  std::size_t max_pairs = std::size_t{1} << 31;  // give up beyond this many pairs
};

struct SearchResult {
  std::vector<CandidatePair> pairs;  // sorted by secondary, then main; no duplicates
  bool complete = true;              // false: more than max_pairs exist; `pairs` is empty then
  std::size_t structure_bytes = 0;   // largest size of the search structure, pairs not counted
  std::size_t tested = 0;            // pairs whose distance was computed
};

// All pairs with distance < max(drad, gap(secondary, main)) + margin, where the distance is the
// smallest of the segment's sub-triangle distances (closest_on_segment). Pairs whose node belongs
// to the segment are left out, and so is everything of stiffness 0. No pair is ever missed,
// whatever the mesh grading. Expected time O((n + m) log(n + m) + pairs).
SearchResult find_node_segment_pairs(const NodeSegmentInput& input, const SearchOptions& options);

// All pairs of edges without a common node nearer than that (closest_between_edges).
SearchResult find_edge_edge_pairs(const EdgeEdgeInput& input, const SearchOptions& options);

// Rule of the reference solver for the margin of its candidate count: 0.2 (as a single-precision
// number) times the mean edge length of the segments, four edges each, also for triangles.
double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 4>> segments);
// This margin for two lists of edges: the mean length is taken over both lists.
double candidate_margin(const NodeArrays& nodes,
                        std::span<const std::array<std::uint32_t, 2>> secondary,
                        std::span<const std::array<std::uint32_t, 2>> main);

// Ties: for each /INTER/TYPE2, the secondary nodes that the solver ties at start-up and their main
// segments; the nodes that it does not tie, and the reasons.

/// One secondary node of a tie.
struct TiedNode {
  NodeIndex node = no_index;
  /// Nothing of its interface holds it, and nothing else does instead.
  bool lost() const { return !tied && removed_by == 0; }
  std::uint32_t segment = no_index;  ///< position in Tie::main; no_index: none was found
  /// Place on the segment, -1 to 1 within it, in the order of its corners. Triangles with
  /// Spotflag 27: weights of corners 1 and 2.
  double s = 0, t = 0;
  double distance = 0;  ///< as the solver stores it: search distance - (search distance - distance)
  double search = 0;    ///< distance within which the solver looked; 0: no segment was examined
  /// Without a segment: the one that is nearest as the solver measures, and how far it is.
  /// no_index: there is none, or it was not looked for.
  std::uint32_t nearest = no_index;
  double nearest_distance = 0;
  /// Search distances that other shells at the node would give with this segment (the nearest where
  /// none was found): by its corner numbers the solver takes the thickness of one.
  double least_search = 0, most_search = 0;
  bool missed = false;  ///< a segment was in reach, but the solver's box for it was too small
  int message = 0;      ///< solver message that lists the node: 1071 1078 1079 1157 1158 1872 1873
  int removed_by = 0;   ///< 1630 (the same tie exists already), 1209 (condensed mid node)
  bool tied = false;
  bool penalty = false;  ///< treated by penalty: Spotflag 25, 26 always; 27, 28 after message 1179
};

/// Ties that a later interface repeats (solver warning 1630).
struct RepeatedTies {
  std::int64_t interface_id = 0;  ///< the earlier interface
  std::uint32_t count = 0;
};

/// An /INTER/TYPE2 at start-up.
struct Tie {
  const InterType2* inter = nullptr;
  int spotflag = 0;  ///< effective; 0 is the standard formulation (5)
  int ignore = 0;    ///< effective; 0: the solver stops where a node is not tied
  /// Distance within which all nodes look for a segment; 0: that of each pair (Ignore 2, 3).
  double search_distance = 0;
  std::vector<std::array<NodeIndex, 4>>
      main;                     ///< as the solver turns them; triangle: last repeated
  std::vector<TiedNode> nodes;  ///< ascending node id
  std::vector<RepeatedTies> repeated;
  std::vector<NodeIndex> main_and_tied;  ///< main nodes that a tie holds as secondary (error 556)
  std::string not_evaluated;             ///< why nothing was looked for; empty: it was
};

struct TieCounts {
  std::size_t nodes = 0;      ///< secondary nodes
  std::size_t tied = 0;       ///< in the interface at the end
  std::size_t not_found = 0;  ///< without a segment within reach
  std::size_t dropped = 0;    ///< found, and dropped again
  std::size_t elsewhere = 0;  ///< taken out because something else holds them: 1630, 1209
  std::size_t outside = 0;    ///< tied to a segment beyond whose rim they lie
  std::size_t lost() const { return not_found + dropped; }
};
TieCounts count_ties(const Tie& tie);

/// "3 of 412 nodes are not tied", "412 nodes are tied", "not evaluated: why".
std::string holds_text(const Tie& tie);
/// The nodes that are not simply tied, by reason, as text for a table; "-": there are none.
std::string losses_text(const Tie& tie);

/// Why a node is not tied, or how it is: one sentence; and in a few words for a table.
std::string why_text(const Tie& tie, const TiedNode& node);
std::string short_reason(const Tie& tie, const TiedNode& node);

// Scene: the interfaces of a deck as elementary contacts — node to segment and edge to edge — with
// segments, gaps and stiffness as the reference solver forms them at start-up, and the initial
// penetrations with what Inacti and Fpenmax do about each of them.

/// The solver's action on one initial penetration.
enum class PenetrationAction : std::uint8_t {
  none,
  node_stiffness_zero,     ///< Inacti 1, or Fpenmax exceeded
  segment_stiffness_zero,  ///< Inacti 2
  node_moved,              ///< Inacti 3
  gap_reduced,             ///< Inacti 5, 6
  edge_stiffness_zero,     ///< TYPE11: Inacti 1, 2, or deeper than 99.5 % of the gap with 5, 6
  ignored,                 ///< TYPE24, 25: Inacti 0
  offset_stored,           ///< TYPE24, 25: Inacti 5, taken off the penetration from then on
  initial_force,           ///< TYPE24, 25: Inacti -1, a force from the start
  removed_tied,            ///< TYPE24, 25: a tie holds the node, Irem_i2
  error_611,  ///< the node is exactly on the segment: the solver stops (Inacti 3, 5, 6)
  error_612,  ///< as error_611, but with Inacti 0
};
inline constexpr std::size_t penetration_actions = 12;  ///< how many there are
/// The solver stops at this penetration.
inline bool stops_solver(PenetrationAction action) {
  return action == PenetrationAction::error_611 || action == PenetrationAction::error_612;
}
/// For people, of one or of several: "nothing", "gap reduced", "edges switched off", ...
const char* action_words(PenetrationAction action, std::size_t pairs = 2);
const char* to_string(PenetrationAction action);  ///< "none", "node-stiffness-zero", ...

struct PenetrationRow {
  std::uint32_t secondary = 0, main = 0;  ///< positions in the contact's lists
  double depth = 0;                       ///< gap - distance
  double gap = 0;                         ///< pair gap
  double distance = 0;
  std::array<double, 3> normal{};  ///< unit, main to secondary; zero when on_surface
  bool on_surface = false;
  /// Accuracy::robust: false where the pair is no nearer than its gap, and only the round-off of
  /// the solver's formula makes a penetration of it. The solver acts on it all the same.
  bool in_contact = true;
  PenetrationAction action = PenetrationAction::none;
  bool has_gap0 = false;
  double p0 = 0, gap0 = 0;            ///< Inacti 5, 6: stored penetration and gap left
                                      ///< (TYPE24, 25: what is stored, no gap left)
  std::array<double, 3> moved_by{};   ///< Inacti 3
  double weight_s = 0, weight_m = 0;  ///< edge pairs: weights of the first nodes
};

/// Other values for one interface, to see what they would do; the deck is not read again.
struct WhatIf {
  std::int64_t interface_id = 0;
  std::optional<double> Gapmin, Fscalegap, Gapmax, Fpenmax, mesh_size;
  std::optional<int> Igap, Inacti, Irem_gap;
};

enum class ContactKind : std::uint8_t { node_segment, edge_edge };
/// Which part of its interface a contact is. TYPE19 gives up to three.
enum class ContactRole : std::uint8_t { primary, reversed, edges };

const char* to_string(ContactKind kind);  ///< "node_segment", "edge_edge"
const char* to_string(ContactRole role);  ///< "primary", "reversed", "edges"

/// One main segment. Arrays of a Contact are parallel to each other.
struct MainSegment {
  std::array<NodeIndex, 4> nodes{};  ///< after repair and re-orientation; triangle: last two equal
  Carrier carrier = Carrier::none;   ///< the element that decides gap and stiffness
  std::uint32_t element = no_index;
  double stiffness = 0;  ///< as stored at start-up: no 1/2; constant stiffness stores |Stfac|
  double gap = 0;        ///< half thickness times Fscalegap; 0 for solids
  double thickness = 0;  ///< contact thickness of the carrying shell, 0 for solids
  double length = 0;     ///< Igap 3: mesh-size limit of this segment
  bool off = false;      ///< switched off by Inacti = 2; `stiffness` stays what it was
};
struct SecondaryNode {
  NodeIndex node = no_index;
  double multiplier = 1;  ///< of the stiffness, as stored at start-up
  bool off = false;       ///< switched off by Inacti = 1 or Fpenmax
  double gap = 0;
  double length = 0;           ///< Igap 3 limit; 1e30 for nodes on no main segment
  double nodal_stiffness = 0;  ///< filled where Istf 2..5 needs it
};
struct ContactEdge {
  std::array<NodeIndex, 2> nodes{};
  Carrier carrier = Carrier::none;
  std::uint32_t element = no_index;
  double stiffness = 0, gap = 0, length = 0;
  double shell = 0;               ///< contact thickness of the shell that carries it, 0: none
  double section = 0;             ///< sqrt(area) of the truss or beam that carries it, 0: none
  bool off = false;               ///< switched off by Inacti; `stiffness` stays what it was
  double stored_penetration = 0;  ///< Inacti 5, 6: what the solver takes off every pair gap
};

/// TYPE24 and TYPE25: what a main segment is. A shell has one segment a side.
enum class SegmentKind : std::uint8_t { solid, shell, shell_opposite, coat, coat_opposite };
const char* to_string(SegmentKind kind);  ///< "solid", "shell", "shell-opposite", "coat", ...

/// TYPE25: an edge that passes through a main segment of a solid beside one of its sides.
struct EdgeThroughSegment {
  std::uint32_t edge = 0, main = 0;  ///< positions in the edges of the interface, and in `main`
  int side = 0;                      ///< 1 to 4: from that corner of the segment to the next
  double depth = 0;
};

/// TYPE24 with Iedge: a point that the solver puts on an edge, as a secondary node without an id.
struct EdgePoint {
  std::string_view place;  ///< "quarter" or "three-quarters" from the edge's first node, "inner"
  std::array<double, 3> at{};
};

/// Which arithmetic decides that a pair is in contact, and gives its figures.
enum class Accuracy : std::uint8_t {
  fast,       ///< plain double, closest point by the robust formula
  reference,  ///< plain double, the reference solver's formula
  robust,     ///< never decides wrongly, filtered; figures are the reference formula's
  exact       ///< rationals; figures rounded once
};
const char* to_string(Accuracy accuracy);  ///< "fast", "reference", "robust", "exact"

/// A pair about which the solver's arithmetic and exact arithmetic do not agree.
struct DecisionDifference {
  std::uint32_t contact = 0, secondary = 0, main = 0;  ///< positions in the scene and its lists
  bool surface = false;  ///< about "exactly on the segment"; false: about "in contact"
  bool exact = false;    ///< what is true; the solver's arithmetic says the opposite
  double gap = 0, solver_distance = 0, exact_distance = 0;
  PenetrationAction action = PenetrationAction::none;  ///< what the solver does all the same
};

/// How the contact decisions of a scene were taken.
struct DecisionReport {
  Accuracy mode = Accuracy::robust;
  std::uint64_t pairs = 0;                                 ///< decided
  std::uint64_t fallback = 0;                              ///< needed more than double
  std::uint64_t exact = 0;                                 ///< needed integers or rationals
  std::uint64_t contact_differs = 0, surface_differs = 0;  ///< counted with robust and exact only
  std::vector<DecisionDifference> differences;             ///< the first of them
};

/// One elementary contact.
struct Contact {
  const InterBase* inter = nullptr;
  ContactKind kind = ContactKind::node_segment;
  ContactRole role = ContactRole::primary;
  int type = 7;           ///< 7, 10, 11, 24 or 25: whose rules it follows
  bool dropped = false;   ///< TYPE19 edges: no edges, the solver drops the part
  bool evaluated = true;  ///< false: too many pairs, or coordinates that are no numbers; whether
                          ///< anything penetrates is not known then

  // Effective options, 1000 already turned into 0.
  int istf = 0, igap = 0, inacti = 0, irem_gap = 1, itied = 0;
  double factor = 1;  ///< < 0: constant stiffness |factor|
  double stmin = 0, stmax = 1e30, fpenmax = 0, gap_scale = 1, mesh_fraction = 0;

  PairGap gap_rule;
  double gapmin = 0, gapmax = 1e30, drad = 0;
  GapminOrigin gapmin_origin = GapminOrigin::card;
  double max_gap = 0;        ///< largest pair gap that the solver's search expects
  double shortest_side = 0;  ///< of all main segments (or of both line sets)

  std::vector<SecondaryNode> secondary;  ///< node_segment
  std::vector<MainSegment> main;
  std::vector<ContactEdge> secondary_edges;  ///< edge_edge
  std::vector<ContactEdge> main_edges;

  std::uint64_t candidates = 0;     ///< pairs within gap + margin; edge pairs: within gap
  std::uint64_t removed_pairs = 0;  ///< candidates taken out by Irem_gap = 2
  std::vector<PenetrationRow> penetrations;

  // TYPE24 and TYPE25 only.
  std::vector<SegmentKind> segment_kinds;  ///< parallel to `main`
  /// Of the secondary edges, and as many main ones: 1 solids, 2 other, 3 of a line, -1 carrier.
  std::vector<std::int8_t> edge_kinds;
  std::vector<EdgeThroughSegment> edges_through_segments;  ///< the last rows of `penetrations`
  std::vector<PenetrationRow> uncounted;  ///< edge pairs that the solver finds and does not count
  /// TYPE24 with Iedge: of each secondary edge. Main edges are sides of the segments in `main`.
  std::vector<EdgePoint> points;
  double largest_accepted = 0;  ///< TYPE24: deepest penetration that counts

  int repaired_segments = 0;                          ///< solver warning 106
  int degenerate_segments = 0;                        ///< solver error 558
  int reoriented_segments = 0;                        ///< solver warning 3025
  std::vector<std::uint32_t> degenerate, no_carrier;  ///< positions in `main`
  /// Positions in `main` of plain segments in more than two solids (solver warning 3062), and of
  /// quadrangular faces of solids whose nodes all belong to a solid without that face.
  std::vector<std::uint32_t> crowded, inside_solids;

  /// Its pairs are ties, not penetrations: a TYPE10 ties at the start what lies within the gap.
  /// They stand in `penetrations`, because the solver lists them there, and are counted, repaired,
  /// gated and coloured nowhere. ITIED of a TYPE7 ties nothing at the start: it acts in the Engine,
  /// where a time step falls below dtmin.
  bool is_tied_contact() const { return kind == ContactKind::node_segment && type == 10; }
  bool main_empty() const { return main.empty() && main_edges.empty(); }
  bool secondary_empty() const { return secondary.empty() && secondary_edges.empty(); }
};

struct Scene {
  const Model* model = nullptr;
  const Interfaces* interfaces = nullptr;
  Coordinates coordinates;        ///< after Inacti 3 moved nodes
  std::vector<Contact> contacts;  ///< in the solver's processing order
  std::vector<Tie> ties;          ///< of /INTER/TYPE2, where SceneOptions::ties asks for them
  Examined examined = Examined::contacts;  ///< with ties: they were asked for
  bool judged = false;       ///< penetrations were looked for (SceneOptions::penetrations)
  DecisionReport decisions;  ///< of the penetrations
  Limits limits;             ///< of SceneOptions, for what is made of the scene
};

struct SceneOptions {
  int threads = 1;
  bool candidates = true;  ///< also count candidates (needs the wider search)
  bool penetrations = true;
  bool ties = false;                     ///< also find the ties of /INTER/TYPE2
  Accuracy accuracy = Accuracy::robust;  ///< of the contact decisions
  bool nodal_stiffness = false;    ///< fill SecondaryNode::nodal_stiffness (needed for forces)
  std::vector<std::int64_t> only;  ///< interface ids to build; empty: all
  std::vector<WhatIf> what_if;
  Limits limits;  ///< pair_bytes: what lies beyond is not evaluated, with a finding
  std::function<bool()> exact_over;  ///< true: the rest is decided as `robust` does
  std::function<void(std::size_t, std::size_t)> progress;  ///< contacts done, of all; may be empty
};

/// Builds all contacts of the model: expansion of TYPE19, segments, gaps, stiffness, penetrations
/// and Inacti, in the reference solver's order (Inacti 3 moves nodes that later contacts see).
Scene build_scene(const Model& model, const Interfaces& interfaces, Findings& findings,
                  const SceneOptions& options = {});

/// Fills in every value of Origin::geometry from the first contact of its interface in `scene`,
/// which was built from `interfaces` (without WhatIf, or the values are those of other settings; a
/// scene without penetrations will do). Interfaces that have no contact there stay unresolved.
void resolve(Interfaces& interfaces, const Scene& scene);

/// True if some value waits for `resolve`.
bool waits_for_geometry(const Interfaces& interfaces);

/// The first part of an interface that is not dropped; nullptr if there is none.
const Contact* first_contact(const Scene& scene, const InterBase& inter);

/// The value that one contact gives a field of Origin::geometry. Contacts of a TYPE19 may differ.
double geometry_value(const Contact& contact, std::string_view field);

// Crossed elements: edges that pass through main segments. Penetration depths do not show them. The
// decision is exact; the reference solver has no such check.

/// All pairs (secondary: position of the edge, main: position of the segment) where the edge passes
/// through the segment, sorted. Quads are the two triangles (1 2 3) and (1 3 4). An edge passes
/// through a triangle if its ends lie strictly on either side of the plane and it meets the closed
/// triangle: mere touching and edges within the plane do not count, nor do edges that share a node
/// with the segment. Exact for all finite coordinates; does not depend on `threads`.
std::vector<CandidatePair> find_crossing_pairs(
    const NodeArrays& nodes, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const std::array<std::uint32_t, 4>> segments, int threads = 1);

/// One edge of an element through one main segment of a contact.
struct Crossing {
  std::uint32_t contact = 0;        ///< Scene::contacts
  std::array<NodeIndex, 2> edge{};  ///< smaller index first
  ElementKind edge_kind{};          ///< the element that has the edge: of several the first one
  std::uint32_t edge_element = no_index;
  std::uint32_t main = 0;  ///< Contact::main
};

/// Crossed elements of all node-to-segment contacts, the secondary side against the main side:
/// edges of shells, solids, trusses and beams whose nodes are both secondary, through main
/// segments. An edge and the four nodes of a segment are listed once, in the first contact that has
/// both. Springs are left out: they join what they pass through. Ordered by contact, edge, segment.
/// Positions are those of Scene::coordinates.
std::vector<Crossing> find_crossings(const Scene& scene, int threads = 1);

// Views of a scene for people: every penetration with its node, element and part ids, one row per
// node (the deepest), part pairs sorted by depth, and totals for the verdict.

/// An element as a person names it.
struct ElementName {
  ElementKind kind{};
  std::uint32_t index = no_index;
  std::int64_t id = 0, part = 0;
  bool valid() const { return index != no_index; }
};

/// The elements among which the element of such a carrier is counted; nullptr: no element.
const Elements* elements_of(const Model& model, Carrier carrier);

/// One penetration with names instead of positions.
struct NamedPenetration {
  std::uint32_t contact = 0, row = 0;       ///< Scene::contacts, Contact::penetrations
  std::array<std::int64_t, 2> secondary{};  ///< node id (second 0), or the two nodes of an edge
  std::array<std::int64_t, 4> main{};       ///< segment nodes, or edge nodes and zeros
  ElementName secondary_element, main_element;
  std::array<double, 3> at{};  ///< secondary node (edge: closest point), working units
};

/// Distinct secondary nodes, distinct edges, and pairs. The three overlap: do not add them.
struct ItemCounts {
  std::uint64_t pairs = 0, nodes = 0, edges = 0;
};

struct PartPair {
  std::int64_t secondary = 0, main = 0;  ///< part ids, 0: no part
  ItemCounts count, on_segment;
  double max_depth = 0, mean_depth = 0, p95_depth = 0, max_ratio = 0;
  std::uint32_t worst = 0;  ///< index into Named view
};

struct ContactTotals {
  ItemCounts count;          ///< what penetrates; ties do not
  ItemCounts tied;           ///< what is tied (Contact::ties)
  std::uint64_t untied = 0;  ///< nodes of TYPE10 that no segment is within reach of
  ItemCounts on_segment;     ///< what of it lies exactly on a segment
  std::optional<std::uint64_t> crossed_elements;  ///< crossings listed; nullopt: not looked for
  std::uint64_t solver_errors = 0;                ///< nodes for which the solver stops: 611, 612
  std::uint64_t acted = 0;                        ///< pairs on which Inacti or Fpenmax do something
  std::uint64_t round_off = 0;                    ///< pairs with PenetrationRow::in_contact false
  double max_depth = 0, max_ratio = 0;
};

struct SceneView {
  /// Without ties; deepest first, equals by contact and row.
  std::vector<NamedPenetration> penetrations;
  std::vector<NamedPenetration> ties;  ///< rows of contacts that tie, in the same order
  std::vector<std::uint32_t>
      deepest_per_node;                 ///< indices into penetrations: of each contact one per
                                        ///< secondary node or edge, also where it is listed twice
  std::vector<PartPair> part_pairs;     ///< deepest first
  std::vector<ContactTotals> contacts;  ///< parallel to Scene::contacts
  ContactTotals total;                  ///< a node or edge in several contacts counts once
};

/// Forms all views; this is where penetrations are counted, for every medium. `crossings` is what
/// find_crossings gave for the scene. The same view for any number of threads.
SceneView make_view(const Scene& scene, const std::vector<Crossing>* crossings = nullptr,
                    int threads = 1);

/// Positions in `secondary` of the nodes that a contact that ties does not tie; of all others, and
/// where it was not evaluated, none.
std::vector<std::uint32_t> untied_secondary(const Contact& contact);

/// The element behind a segment or edge; not valid for carriers without an element.
ElementName carrier_name(const Model& model, Carrier carrier, std::uint32_t element);

/// Ten times the model's size: a gap beyond it is no gap, but unbounded. Working units.
double largest_bounded_gap(const Model& model);

/// Why a contact with 0 penetrations is not reported as clean.
enum class NotCleanReason {
  none,
  empty_main,       ///< nothing on a side: there can be no pair
  empty_secondary,  ///< the solver goes on where a node group is there, but empty
  no_gap,           ///< the solver stops (785, 786)
  no_area,          ///< a main segment without area: the solver stops (558)
  no_element,       ///< a segment or edge that belongs to no element: the solver stops (481, 482)
  no_stiffness,     ///< no main segment has stiffness: the solver searches none of them
};

/// The first reason that applies to a contact; `none` if the solver drops the contact.
NotCleanReason not_clean_reason(const Contact& contact);
std::string_view to_string(NotCleanReason reason);  ///< its name; empty: none

/// Solver error for a node exactly on a segment: 611, 612, or 0 where the options avoid it.
int on_surface_error(const Contact& contact);

/// Initial penetrations as an earlier `deck gaps --json` has them.
struct GapBaseline {
  struct Row {
    std::int64_t interface_id = 0;
    std::string role;                         ///< "primary", "reversed", "edges"
    std::array<std::int64_t, 2> secondary{};  ///< node (second 0) or the two nodes of an edge
    double depth = 0, gap = 0;                ///< lengths, also for edges
    std::optional<std::array<double, 3>> at;  ///< as NamedPenetration::at; old documents lack it
  };
  std::string path;                ///< of the JSON file, as given
  std::string deck_path;           ///< of the deck it describes; empty: the file holds others only
  std::vector<std::string> decks;  ///< of which the file holds anything, in its order
  std::vector<Row> rows;           ///< deepest row of every secondary node or edge
  /// Ids of nodes by interface: those that a TYPE10 ties, and those that a TYPE2 does not tie.
  std::map<std::int64_t, std::set<std::int64_t>> tied, untied;
  bool accepts = false;  ///< a baseline: what it does not list is new, nodes that are not tied too
};

/// Ids of nodes that a TYPE10 or TYPE2 should hold and does not, of the ties that were evaluated.
std::map<const InterBase*, std::vector<std::int64_t>> untied_nodes(const Scene& scene);

/// Depths that differ by less than this share of them are the same: what another order of the same
/// sums changes lies ten decades below, what a person changes above.
inline constexpr double same_depth = 1e-6;

enum class Trend : std::uint8_t { fresh, worse, same, better };
const char* to_string(Trend trend);  ///< "new", "worse", "same", "better"

/// The penetrations of a scene beside those of an earlier run.
struct GapsComparison {
  struct Row {
    std::uint32_t penetration = 0;  ///< SceneView::penetrations: the deepest of its node or edge
    Trend trend = Trend::fresh;
    std::uint32_t earlier = no_index;  ///< GapBaseline::rows; no_index: it is new
  };
  std::vector<Row> rows;  ///< parallel to SceneView::deepest_per_node
  /// GapBaseline::rows that penetrate no more, in their order; of contacts that were evaluated.
  std::vector<std::uint32_t> solved;
  /// Nodes, by id, that an interface tied in the earlier run and does not tie now.
  std::map<const InterBase*, std::vector<std::int64_t>> lost_ties;

  std::uint64_t count(Trend trend) const;
};

/// Rows belong together that have the same ids at the same place; else those at the same place
/// (ids were changed, a millionth of the gap is the same place); else those with the same ids
/// (nodes were moved). O(n log n) in the rows.
GapsComparison compare_gaps(const GapBaseline& earlier, const Scene& scene, const SceneView& view);

}  // namespace deck
