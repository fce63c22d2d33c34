// Scene: the interfaces of a deck as elementary contacts — node to segment and edge to edge — with
// segments, gaps and stiffness as the reference solver forms them at start-up, and the initial
// penetrations with what Inacti and Fpenmax do about each of them.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contact/search.hpp"
#include "deck/contact/ties.hpp"
#include "deck/model/interfaces.hpp"
#include "deck/model/model.hpp"
#include "deck/text/source.hpp"

namespace deck {

/// What the solver does about one initial penetration.
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
  error_612,  ///< the same with Inacti 0
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
  Feature feature = Feature::face;
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
  std::vector<std::int8_t> edge_kinds;     ///< parallel to the edges: 1 solids, 2 other, -1 carrier
  std::vector<EdgeThroughSegment> edges_through_segments;
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
  bool ties() const { return kind == ContactKind::node_segment && type == 10; }
  bool main_empty() const {
    return kind == ContactKind::edge_edge ? main_edges.empty() : main.empty();
  }
  bool secondary_empty() const {
    return kind == ContactKind::edge_edge ? secondary_edges.empty() : secondary.empty();
  }
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
  /// Called with (contacts done, contacts in all); may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// Builds all contacts of the model: expansion of TYPE19, segments, gaps, stiffness, penetrations
/// and Inacti, in the reference solver's order (Inacti 3 moves nodes that later contacts see).
Scene build_scene(const Model& model, const Interfaces& interfaces, Diagnostics& diagnostics,
                  const SceneOptions& options = {});

/// Fills in every value of Origin::geometry from the first contact of its interface in `scene`,
/// which was built from `interfaces` (without WhatIf, or the values are those of other settings; a
/// scene without penetrations will do). Interfaces that have no contact there stay unresolved.
void resolve(Interfaces& interfaces, const Scene& scene);

/// True if some value waits for `resolve`.
bool waits_for_geometry(const Interfaces& interfaces);

/// The first part of an interface that is not dropped; nullptr if there is none.
const Contact* first_contact(const Scene& scene, const InterBase& inter);

/// What one contact makes of a field of Origin::geometry. The parts of a TYPE19 may differ.
double geometry_value(const Contact& contact, std::string_view field);

}  // namespace deck
