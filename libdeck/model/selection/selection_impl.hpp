// Inside of Selections: where definitions are, the lists they hold, the results kept, and the
// resolvers, which are spread over the selection_*.cpp files by kind.
#pragma once
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "deck/model/selection.hpp"
#include "model/model_build.hpp"
#include "model/selection/boxes.hpp"
#include "model/shared/connectivity.hpp"
#include "model/shared/faces.hpp"

namespace deck {

namespace detail {

struct IdRef {
  std::int64_t id = 0;  ///< above 0, submodel offset applied
  Span span;
};
/// Ids first, first + increment … up to last, submodel offset applied.
struct IdRange {
  std::int64_t first = 0, last = 0, increment = 1;
  bool holds(std::int64_t id) const {
    return id >= first && id <= last && (id - first) % increment == 0;
  }
};
/// An id list: positive ids first, whatever their order on the card.
struct IdList {
  std::vector<IdRef> positive, negative;
};

/// One definition: /KIND/TYPE/OPTION/id.
struct Definition {
  const Block* block = nullptr;
  std::string_view type, option;
};

struct DefinitionTable {
  std::map<std::int64_t, std::vector<Definition>> by_id;  ///< several only for /SET/COLLECT
  std::vector<std::int64_t> order;
};

using Indices = std::vector<std::uint32_t>;
/// Sorts and removes repetitions.
void normalise(Indices& v);
/// Adds the elements of the runs behind the others.
void append(Indices& v, std::span<const ElementRun> runs);

/// How elements of a family name themselves in groups.
struct FamilyName {
  ElementKind kind;
  std::string_view group;    ///< "grshel"
  std::string_view keyword;  ///< "GRSHEL"
  std::string_view member;   ///< type keyword of the id list: "SHEL"
  std::string_view id_kind;  ///< for the submodel offset
  Carrier carrier;
};
const std::vector<FamilyName>& family_names();
const FamilyName& family_name(ElementKind kind);
/// The segment of a shell.
Segment shell_segment(const Elements& shells, std::uint32_t e, bool reversed);
/// Nodes that carry the element: for beams and springs without the orientation nodes.
int carrying_nodes(ElementKind kind);

/// What one or more clauses of a /SET select.
struct SetGroup {
  static constexpr std::size_t families = 8;
  std::array<Indices, families> elements;  ///< ascending, by ElementKind
  Indices reversed4, reversed3;            ///< shells whose normal is turned, ascending
  Indices all_faces;                       ///< solids with all their faces, ascending
  Indices named;                           ///< nodes named as such, ascending
  std::vector<Segment> rows;               ///< SEG rows with three or four nodes
  std::vector<Edge> row_edges;             ///< SEG rows with two nodes
  bool external = false;                   ///< option E
  /// Faces of its solids are held against every solid of the model: so for all clauses but those
  /// of parts and of solids, whose own members are the only neighbours.
  bool against_all = false;
  /// True if it changes nothing wherever it is added.
  bool empty() const;
  std::size_t size() const;  ///< members, counted as 32-bit numbers
};
/// A /SET while its clauses are evaluated. Every group has projections of its own: exterior faces
/// and edges are looked for within a group. `own` holds all clauses of parts, and everything that
/// is left after a removal or an intersection. The others are shared with the sets they come from,
/// each held once however often it is referred to: a projection merges what comes twice.
struct SetState {
  SetGroup own;
  std::vector<const SetGroup*> others;
  std::unordered_set<const SetGroup*> known;  ///< the same, while the set is built
  /// Calls f(group) for all groups in order.
  template <class F>
  void each_group(F&& f) const {
    f(own);
    for (const SetGroup* group : others) f(*group);
  }
  Indices parts;    ///< ascending
  Indices removed;  ///< nodes taken away by name, ascending
};

/// The segments of one group: those of the group asked for last, mostly the only one of its set,
/// of which all projections are made. For the time of a call.
struct SegmentsOfGroup {
  const SetGroup* group = nullptr;
  std::vector<Segment> segments;
};

}  // namespace detail

struct Selections::Impl {
  const Model* model = nullptr;
  const SchemaSet* schemas = nullptr;
  Diagnostics found;

  std::map<std::string, detail::DefinitionTable, std::less<>> tables;
  std::set<std::pair<std::string, std::int64_t>> open;  ///< being resolved now

  std::map<std::int64_t, NodeSet> node_groups;
  std::map<std::int64_t, Surface> surfaces;
  std::map<std::int64_t, std::vector<ShellRun>> run_surfaces;  ///< see outline()
  std::map<std::int64_t, LineSet> lines;
  std::map<std::int64_t, SetGeneral> sets;
  std::map<std::int64_t, detail::SetState> set_states;
  std::deque<detail::SetGroup> clause_groups;  ///< what SetState::others points to, beside `own`
  std::map<std::int64_t, detail::BoxVolume> boxes;
  std::map<std::pair<std::string, std::int64_t>, detail::Indices> element_groups;
  std::map<std::int64_t, detail::Indices> part_groups;
  // Views of sets as other kinds.
  std::map<std::int64_t, NodeSet> set_nodes;
  std::map<std::int64_t, Surface> set_surfaces;
  std::map<std::int64_t, LineSet> set_lines;

  // ---- built once, when first needed ------------------------------------------------------------
  std::array<PartElements, detail::SetGroup::families> part_elements_cache;
  std::array<bool, detail::SetGroup::families> part_elements_ready{};
  const PartElements& elements_of_parts(ElementKind kind);
  /// Parts with elements that no family holds (SPH particles, /XELEM); built once.
  std::optional<std::vector<bool>> parts_with_unread;
  /// Says of a list of nodes or lines that what these parts have besides is left out (DK164).
  void report_unread(const Block& block, const detail::Indices& parts);
  std::unique_ptr<detail::ShellCover> shell_cover;
  detail::ShellCover& cover();
  std::unique_ptr<detail::SolidFaces> all_solid_faces;
  detail::SolidFaces& solid_faces();
  std::unique_ptr<detail::KeyTable> tetra_faces;             ///< faces of 10-node tetrahedra
  std::vector<std::pair<std::uint32_t, int>> tetra_face_of;  ///< solid and face per key
  std::vector<std::uint8_t> stamp;                           ///< per node, see mark()
  std::uint8_t generation = 0;

  void sort_nodes(std::vector<NodeIndex>& nodes) const;

  Limits limits;
  std::uint64_t most_members = 0;  ///< of one list, repetitions included
  std::uint64_t bytes_held = 0;    ///< by all results together
  bool all_held = true;            ///< false: something was left out for want of Limits
  /// True if `count` more items of `size` bytes may be held; otherwise that is reported once.
  bool fits(std::size_t count, std::size_t size, const Block& block);
  /// The same, and counts them as held.
  bool hold(std::size_t count, std::size_t size, const Block& block);
  /// Counts a result as held; empties it if there is no room.
  template <class List>
  void keep(List& list, const Block& block) {
    if (!hold(list.size(), sizeof(typename List::value_type), block)) List().swap(list);
    if (list.capacity() / 2 > list.size()) list.shrink_to_fit();
  }

  Impl(const Model& m, const SchemaSet& s, const Limits& l);
  const Deck& deck() const { return *model->deck; }

  // ---- definitions and lists (selection.cpp)
  // ------------------------------------------------------
  const detail::Definition* definition(std::string_view kind, std::int64_t id) const;
  std::int64_t own_id(const Block& block, std::string_view kind) const;
  std::int64_t shift(const Block& block, std::string_view kind, std::int64_t id) const;
  /// Ids of the block's list; their kind is that of the schema's field.
  detail::IdList id_list(const DecodedBlock& d) const;
  /// Ranges of /GENE (pairs) and /GEN_INCR (triples) with an increment above 0.
  std::vector<detail::IdRange> id_ranges(const DecodedBlock& d, std::string_view kind) const;
  void report(detail::Finding f) { detail::report(found, std::move(f)); }
  /// Members of a list that do not exist, in one finding per list.
  void report_missing(RuleId rule, const Block& block, const std::string& what,
                      const std::vector<detail::IdRef>& missing, int number);
  /// True if (kind, id) is being resolved already, which is reported.
  bool recursive(std::string_view kind, std::int64_t id, const Block& from, int number);

  // ---- nodes (selection_nodes.cpp)
  // ------------------------------------------------------------------
  NodeIndex node(std::int64_t id) const { return model->find_node(id); }
  /// Appends the nodes that are not yet marked in this generation.
  void start_marks();
  void mark(NodeIndex n, std::vector<NodeIndex>& out);
  /// Puts the nodes of this generation into ascending order: `nodes` are all of them.
  void sort_marked(std::vector<NodeIndex>& nodes) const;
  const NodeSet* node_group(std::int64_t id);
  std::vector<NodeIndex> resolve_nodes(const detail::Definition& def, const DecodedBlock& d);
  std::vector<NodeIndex> nodes_by_id(const detail::Definition& def, const DecodedBlock& d);
  std::vector<NodeIndex> nodes_of_ranges(const DecodedBlock& d);
  std::vector<NodeIndex> nodes_of_parts(const Block& block, std::string_view type,
                                        const DecodedBlock& d);
  std::vector<NodeIndex> nodes_in_boxes(const Block& block, const DecodedBlock& d);
  std::vector<NodeIndex> nodes_of_groups(const Block& block, const DecodedBlock& d,
                                         bool keep_order);
  std::vector<NodeIndex> nodes_of_surfaces(const Block& block, const DecodedBlock& d);
  std::vector<NodeIndex> nodes_of_lines(const Block& block, const DecodedBlock& d);
  std::vector<NodeIndex> nodes_of_elements(const Block& block, const DecodedBlock& d,
                                           ElementKind kind);
  void add_element_nodes(const Elements& family, std::uint32_t e, std::vector<NodeIndex>& out);

  // ---- parts and elements (selection_elements.cpp)
  // -------------------------------------------------
  /// +1, -1 or 0 per part for a list of the given type (PART, MAT, PROP, SUBSET, SUBMODEL).
  std::vector<std::int8_t> part_tags(const Block& block, std::string_view type,
                                     const detail::IdList& list);
  /// Parts named by one id of that type; empty where the id names nothing.
  detail::Indices parts_of(std::string_view type, std::int64_t id, bool& known) const;
  static bool is_part_type(std::string_view type);
  const detail::Indices* element_group(const detail::FamilyName& name, std::int64_t id);
  detail::Indices resolve_elements(const detail::FamilyName& name, const detail::Definition& def,
                                   const DecodedBlock& d);
  const detail::Indices* part_group(std::int64_t id);
  detail::Indices resolve_part_group(const detail::Definition& def, const DecodedBlock& d);
  /// Elements of a family whose nodes are all (or, for BOX2, any of them) in one of the boxes.
  detail::Indices elements_in_boxes(const Block& block, const std::vector<detail::IdRef>& ids,
                                    ElementKind kind, bool any_node, int missing_number);
  detail::Indices elements_in_box(const detail::BoxVolume& box, ElementKind kind,
                                  bool any_node) const;
  std::int64_t element_id(Carrier carrier, std::uint32_t e) const;

  // ---- surfaces (selection_surfaces.cpp)
  // --------------------------------------------------------------
  const Surface* surface(std::int64_t id);
  std::vector<Segment> resolve_surface(const detail::Definition& def, const DecodedBlock& d,
                                       bool& analytical);
  std::vector<Segment> segments_by_nodes(const Block& block, const DecodedBlock& d);
  /// `tags`: see part_tags().
  std::vector<Segment> segments_of_parts(const detail::Definition& def,
                                         const std::vector<std::int8_t>& tags);
  std::vector<Segment> segments_in_boxes(const detail::Definition& def, const DecodedBlock& d);
  std::vector<Segment> segments_of_groups(const detail::Definition& def, const DecodedBlock& d);
  std::vector<Segment> segments_of_surfaces(const Block& block, const DecodedBlock& d);
  std::vector<Segment> difference_of_surfaces(const Block& block, const DecodedBlock& d);
  void add_shells(const Elements& shells, const detail::Indices& members, bool reversed,
                  std::vector<Segment>& out) const;
  void add_solids(const Block& block, std::string_view option, detail::Indices solids,
                  std::vector<Segment>& out);
  /// Faces that /SURF/GRBRIC leaves out under shells that are not in the surface.
  void report_lost_faces(const Block& block, const std::vector<detail::LostFace>& lost);
  /// Cuts a plain triangle that lies on the face of a 10-node tetrahedron.
  void add_plain_segment(const Segment& s, std::vector<Segment>& out);
  void sort_segments(std::vector<Segment>& segments) const;
  const std::vector<Segment>* listed_surface(const Block& block, const detail::IdRef& ref,
                                             std::vector<detail::IdRef>& missing);

  // ---- surfaces by runs of elements (selection_runs.cpp)
  // ------------------------------------------------------------------
  std::optional<SurfaceOutline> outline(std::int64_t id);
  /// Runs that name the segments of segments_of_parts() in the order of sort_segments(); nullopt:
  /// they do not.
  std::optional<std::vector<ShellRun>> shell_runs(const std::vector<std::int8_t>& tags);
  /// Counts the segments as held, sorts them and keeps the surface.
  const Surface& finish_surface(Surface surface, const Block& block);
  /// The surface that outline() has found before, with its segments; nullptr: it has not.
  const Surface* surface_of_runs(std::int64_t id, const Block& block);

  // ---- lines (selection_lines.cpp)
  // ------------------------------------------------------------------
  const LineSet* line(std::int64_t id);
  std::vector<Edge> resolve_line(const detail::Definition& def, const DecodedBlock& d);
  std::vector<Edge> listed_edges(const Block& block, const DecodedBlock& d);
  std::vector<Edge> edges_of(const std::vector<Segment>& segments, bool free_only) const;
  void add_line_elements(ElementKind kind, const detail::Indices& members,
                         std::vector<Edge>& out) const;

  // ---- boxes (boxes.cpp)
  // ------------------------------------------------------------------------------
  const detail::BoxVolume* box(std::int64_t id, const Block& from, int missing_number);
  void fill_box(detail::BoxVolume& b, const detail::Definition& def, const DecodedBlock& d);
  void collect_boxes(detail::BoxVolume& b, const Block& block, const DecodedBlock& d);
  void report_box(const Block& block, std::string what, std::string help, int number);
  bool skew_axes(std::int64_t id, std::array<Vec, 3>& axes);
  std::array<double, 3> box_point(NodeIndex n) const;

  // ---- sets (sets.cpp, selection_set_views.cpp)
  // ---------------------------------------------------
  const SetGeneral* set(std::int64_t id);
  const detail::SetState* set_state(std::int64_t id);
  using LastGroup = detail::SegmentsOfGroup;
  std::vector<Segment> group_segments(const detail::SetGroup& group);
  const std::vector<Segment>& group_segments(const detail::SetGroup& group, LastGroup& last);
  std::vector<Edge> group_edges(const detail::SetGroup& group, LastGroup& last);
  detail::Indices group_nodes(const detail::SetGroup& group, LastGroup& last);
  std::vector<NodeIndex> set_node_list(const detail::SetState& state, const Block& block,
                                       LastGroup& last);
  std::vector<Segment> set_segment_list(const detail::SetState& state, const Block& block,
                                        LastGroup& last);
  std::vector<Edge> set_edge_list(const detail::SetState& state, const Block& block,
                                  LastGroup& last);
  /// Adds groups that the set does not hold yet.
  void share_groups(detail::SetState& set, const std::vector<const detail::SetGroup*>& groups,
                    const Block& block);
  /// Title and place of a set.
  std::pair<std::string, Span> set_heading(std::int64_t id) const;
  /// Sorts by nodes and merges what is the same segment (edge) of the same element.
  void merge_segments(std::vector<Segment>& segments) const;
  void merge_edges(std::vector<Edge>& edges) const;
};

}  // namespace deck
