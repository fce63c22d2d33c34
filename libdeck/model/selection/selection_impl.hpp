// Implementation of Selections: definitions, id lists, results, resolvers (selection_*.cpp).
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
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

#include "base/shared/vec.hpp"
#include "deck/model.hpp"
#include "model/model_build.hpp"
#include "model/shared/buckets.hpp"
#include "model/shared/faces.hpp"
#include "model/shared/families.hpp"

namespace deck::detail {

struct BoxVolume {
  enum class Type { none, rectangle, cylinder, sphere } type = Type::none;
  /// Rectangle: two corners in skew axes. Cylinder: base, end. Sphere: centre.
  Vec p, q;
  std::array<Vec, 3> axes{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};  ///< of the skew
  bool global = true;                                                 ///< global axes
  double diameter = 0;
  std::vector<const BoxVolume*> members;  ///< box of boxes
  std::vector<bool> subtracted;           ///< per member: listed with a negative id

  /// True inside and on the boundary.
  bool contains(double x, double y, double z) const;
};

}  // namespace deck::detail

namespace deck {

namespace detail {

struct IdRef {
  std::int64_t id = 0;  ///< submodel offset applied; 0: node 0 of a blank cell
  Span span;
};
/// Ids first, first + increment, ... up to last, submodel offset applied.
struct IdRange {
  std::int64_t first = 0, last = 0, increment = 1;
  bool contains(std::int64_t id) const {
    return id >= first && id <= last && (id - first) % increment == 0;
  }
};
/// An id list; positive ids are evaluated first.
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
/// Sorts and removes duplicates.
void normalise(Indices& v);
/// Difference of sorted lists.
Indices without(const Indices& all, const Indices& some);
/// Intersection of sorted lists.
Indices common(const Indices& a, const Indices& b);
/// Appends the elements of the runs.
void append(Indices& v, std::span<const ElementRun> runs);

/// The segment of a shell.
Segment shell_segment(const Elements& shells, std::uint32_t e, bool reversed);

/// Selection of one or more /SET clauses.
struct SetGroup {
  static constexpr std::size_t families = 8;
  std::array<Indices, families> elements;  ///< ascending, by ElementKind
  Indices reversed4, reversed3;            ///< shells with reversed normals, ascending
  Indices all_faces;                       ///< solids with all their faces, ascending
  Indices named;                           ///< nodes of node clauses, ascending
  std::vector<Segment> rows;               ///< SEG rows with three or four nodes
  std::vector<Edge> row_edges;             ///< SEG rows with two nodes
  bool external = false;                   ///< option E
  /// True: all solids of the model count as neighbours of its faces. False for clauses of parts and
  /// solids: only their own members do.
  bool against_all = false;
  /// True if adding it changes nothing.
  bool empty() const { return !external && size() == 0; }
  std::size_t size() const;  ///< members in units of 32-bit numbers
};
/// A /SET during evaluation. Each group is projected separately, because exterior faces and edges
/// are searched per group. `own` has all clauses of parts, and everything after a removal or
/// intersection. `others` are shared with the sets they come from, without duplicates.
struct SetState {
  SetGroup own;
  std::vector<const SetGroup*> others;
  /// During construction: `others` as a set, empty until needed; and how often it was searched.
  std::unordered_set<const SetGroup*> known;
  std::size_t scans = 0;
  /// Calls f(group) for all groups in order.
  template <class F>
  void for_each_group(F&& f) const {
    if (!own.empty()) f(own);
    for (const SetGroup* group : others) f(*group);
  }
  Indices parts;    ///< ascending
  Indices removed;  ///< nodes removed by name, ascending
};

/// Cache for the segments of the last group, used by all projections of a set during a call.
struct SegmentsOfGroup {
  const SetGroup* group = nullptr;
  std::vector<Segment> segments;
};

}  // namespace detail

struct Selections::Impl {
  using BoxVolume = detail::BoxVolume;
  using Definition = detail::Definition;
  using FamilyName = detail::FamilyName;
  using IdList = detail::IdList;
  using IdRange = detail::IdRange;
  using IdRef = detail::IdRef;
  using Indices = detail::Indices;
  using SetGroup = detail::SetGroup;
  using SetState = detail::SetState;

  const Model* model = nullptr;
  const SchemaSet* schemas = nullptr;
  Findings found;

  std::map<std::string, detail::DefinitionTable, std::less<>> tables;
  std::set<std::pair<std::string, std::int64_t>> open;  ///< being resolved

  // Projections of a /SET under its id, if no group, surface or line has that id.
  std::map<std::int64_t, NodeSet> node_groups;
  std::map<std::int64_t, Surface> surfaces;
  std::map<std::int64_t, LineSet> lines;
  std::array<std::map<std::int64_t, Indices>, 8> element_groups;  ///< by ElementKind
  std::map<std::int64_t, Indices> part_groups;
  std::map<std::int64_t, std::vector<ShellRun>> run_surfaces;  ///< see outline()
  std::map<std::int64_t, SetGeneral> sets;
  std::map<std::int64_t, SetState> set_states;
  std::deque<SetGroup> clause_groups;  ///< targets of SetState::others
  std::map<std::int64_t, BoxVolume> boxes;

  // ---- built once, when first needed ------------------------------------------------------------
  std::array<PartElements, SetGroup::families> part_elements_cache;
  std::array<bool, SetGroup::families> part_elements_ready{};
  const PartElements& elements_of_parts(ElementKind kind);
  /// Parts with elements of no family (SPH particles, /XELEM); built once.
  std::optional<std::vector<bool>> parts_with_unread;
  /// Reports that elements of these parts are left out of a node or line list (DK164).
  void report_unread(const Block& block, const Indices& parts);
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
  std::uint64_t most_members = 0;  ///< of one list, with repetitions
  std::uint64_t bytes_held = 0;    ///< of all results
  bool all_held = true;            ///< false: members were left out because of Limits
  /// True if `count` more items of `size` bytes fit into the limit; otherwise reports once.
  bool fits(std::size_t count, std::size_t size, const Block& block);
  /// fits(), and adds the bytes.
  bool reserve_bytes(std::size_t count, std::size_t size, const Block& block);
  /// Counts a result; empties it if it does not fit.
  template <class List>
  void keep(List& list, const Block& block) {
    if (!reserve_bytes(list.size(), sizeof(typename List::value_type), block)) List().swap(list);
    if (list.capacity() / 2 > list.size()) list.shrink_to_fit();
  }

  Impl(const Model& m, const SchemaSet& s, const Limits& l);
  const Deck& deck() const { return *model->deck; }

  // ---- definitions and lists (selection.cpp)
  const Definition* definition(std::string_view kind, std::int64_t id) const;
  /// The definition of an id, else the projection of the set of that id; nullptr: unknown id, or it
  /// is being resolved (`circle` reports that). Results are `kept`. Functions:
  /// from_cards(definition, decoded block), from_set(state, its block).
  template <class List, class FromCards, class FromSet>
  const List* resolved(std::map<std::int64_t, List>& kept, std::string_view kind, std::int64_t id,
                       int circle, const FromCards& from_cards, const FromSet& from_set) {
    if (const auto it = kept.find(id); it != kept.end()) return &it->second;
    const Definition* def = definition(kind, id);
    if (def == nullptr) {
      const SetState* state = set_state(id);
      if (state == nullptr) return nullptr;
      return &kept.emplace(id, from_set(*state, *definition("set", id)->block)).first->second;
    }
    if (recursive(kind, id, *def->block, circle)) return nullptr;
    const auto guard = open.emplace(kind, id).first;
    List list = from_cards(*def, decode(deck(), *def->block));
    open.erase(guard);
    return &kept.emplace(id, std::move(list)).first->second;
  }
  /// Ids of the block's list, of the kind of the schema's field.
  IdList id_list(const DecodedBlock& d) const;
  /// Ranges of /GENE (pairs) and /GEN_INCR (triples) with positive increment.
  std::vector<IdRange> id_ranges(const DecodedBlock& d, std::string_view kind) const;
  void report(detail::FindingDraft f) { detail::report(found, std::move(f)); }
  void report(const Block& block, RuleId rule, std::string message, Overrides overrides = {}) {
    report(detail::finding_about(block, rule, std::move(message), std::move(overrides)));
  }
  /// Results of get(id) for the ids of a list; unknown ids go to `missing`.
  template <class Get>
  static auto named(const std::vector<IdRef>& refs, std::vector<IdRef>& missing, const Get& get) {
    std::vector<decltype(get(std::int64_t{}))> out;
    for (const IdRef& ref : refs) {
      if (auto found = get(ref.id))
        out.push_back(std::move(found));
      else
        missing.push_back(ref);
    }
    return out;
  }
  /// Members of the groups get(id), concatenated as far as they fit.
  template <class Get>
  Indices joined(const std::vector<IdRef>& refs, std::vector<IdRef>& missing, const Block& block,
                 const Get& get) {
    Indices out;
    for (const IdRef& ref : refs) {
      const Indices* group = get(ref.id);
      if (group == nullptr)
        missing.push_back(ref);
      else if (fits(out.size() + group->size(), sizeof out[0], block))
        out.insert(out.end(), group->begin(), group->end());
    }
    return out;
  }
  /// Reports missing members of a list in one finding.
  void report_missing(RuleId rule, const Block& block, const std::string& what,
                      std::vector<IdRef> missing, int number);
  /// True if (kind, id) is already being resolved, which is reported.
  bool recursive(std::string_view kind, std::int64_t id, const Block& from, int number);

  // ---- nodes (selection_nodes.cpp)
  NodeIndex node(std::int64_t id) const { return model->find_node(id); }
  /// Appends nodes without a mark of this generation.
  void start_marks();
  void mark(NodeIndex n, std::vector<NodeIndex>& out);
  const NodeSet* node_group(std::int64_t id);
  std::vector<NodeIndex> resolve_nodes(const Definition& def, const DecodedBlock& d);
  std::vector<NodeIndex> nodes_by_id(const Definition& def, const DecodedBlock& d);
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
  /// +1, -1 or 0 per part for a list of the given type (PART, MAT, PROP, SUBSET, SUBMODEL).
  std::vector<std::int8_t> part_tags(const Block& block, std::string_view type, const IdList& list);
  /// Parts of one id of this type; empty: unknown id.
  Indices parts_of(std::string_view type, std::int64_t id, bool& known) const;
  static bool is_part_type(std::string_view type);
  const Indices* element_group(const FamilyName& name, std::int64_t id);
  Indices resolve_elements(const FamilyName& name, const Definition& def, const DecodedBlock& d);
  const Indices* part_group(std::int64_t id);
  Indices resolve_part_group(const Definition& def, const DecodedBlock& d);
  /// Elements with all nodes (BOX2: any node) in one of the boxes.
  Indices elements_in_boxes(const Block& block, const std::vector<IdRef>& ids, ElementKind kind,
                            bool any_node, int missing_number);
  Indices elements_in_box(const BoxVolume& box, ElementKind kind, bool any_node) const;
  std::int64_t element_id(Carrier carrier, std::uint32_t e) const;

  // ---- surfaces (selection_surfaces.cpp)
  const Surface* surface(std::int64_t id);
  std::vector<Segment> resolve_surface(const Definition& def, const DecodedBlock& d,
                                       bool& analytical);
  std::vector<Segment> segments_by_nodes(const Block& block, const DecodedBlock& d);
  /// `tags`: see part_tags().
  std::vector<Segment> segments_of_parts(const Definition& def,
                                         const std::vector<std::int8_t>& tags);
  std::vector<Segment> segments_in_boxes(const Definition& def, const DecodedBlock& d);
  std::vector<Segment> segments_of_groups(const Definition& def, const DecodedBlock& d);
  std::vector<Segment> segments_of_surfaces(const Block& block, const DecodedBlock& d);
  std::vector<Segment> difference_of_surfaces(const Block& block, const DecodedBlock& d);
  void add_shells(const Elements& shells, const Indices& members, bool reversed,
                  std::vector<Segment>& out) const;
  void add_solids(const Block& block, std::string_view option, Indices solids,
                  std::vector<Segment>& out);
  /// Reports faces left out by /SURF/GRBRIC under shells outside of the surface.
  void report_lost_faces(const Block& block, const std::vector<detail::LostFace>& lost);
  /// Cuts a plain triangle on the face of a 10-node tetrahedron.
  void add_plain_segment(const Segment& s, std::vector<Segment>& out);
  void sort_segments(std::vector<Segment>& segments) const;
  const std::vector<Segment>* listed_surface(const Block& block, const IdRef& ref,
                                             std::vector<IdRef>& missing);

  // ---- surfaces by runs of elements (selection_surfaces.cpp)
  std::optional<SurfaceOutline> outline(std::int64_t id);
  /// Runs equal to segments_of_parts() after sort_segments(); nullopt: not possible.
  std::optional<std::vector<ShellRun>> shell_runs(const std::vector<std::int8_t>& tags);
  /// Stores the segments of a surface found by outline().
  void keep_runs(std::int64_t id);

  // ---- lines (selection_lines.cpp)
  const LineSet* line(std::int64_t id);
  std::vector<Edge> resolve_line(const Definition& def, const DecodedBlock& d);
  std::vector<Edge> listed_edges(const Block& block, const DecodedBlock& d);
  std::vector<Edge> edges_of(const SegmentList& segments, bool free_only) const;
  void add_line_elements(ElementKind kind, const Indices& members, std::vector<Edge>& out) const;

  // ---- boxes (boxes.cpp)
  const BoxVolume* box(std::int64_t id, const Block& from, int missing_number);
  /// A blank line in place of a list of boxes names box 0.
  void need_boxes(const IdList& list, const DecodedBlock& d, int missing_number);
  void fill_box(BoxVolume& b, const Definition& def, const DecodedBlock& d);
  void collect_boxes(BoxVolume& b, const Block& block, const DecodedBlock& d);
  void report_box(const Block& block, std::string what, std::string help, int number);
  std::array<double, 3> box_point(NodeIndex n) const;
  /// Ascending.
  Indices nodes_in(const BoxVolume& box) const;

  // ---- sets (sets.cpp, selection_set_views.cpp)
  const SetGeneral* set(std::int64_t id);
  const SetState* set_state(std::int64_t id);
  using LastGroup = detail::SegmentsOfGroup;
  std::vector<Segment> group_segments(const SetGroup& group);
  const std::vector<Segment>& group_segments(const SetGroup& group, LastGroup& last);
  std::vector<Edge> group_edges(const SetGroup& group, LastGroup& last);
  Indices group_nodes(const SetGroup& group, LastGroup& last);
  template <class Item, class Get>
  std::vector<Item> of_groups(const SetState& state, const Block& block, const Get& get);
  std::vector<NodeIndex> set_node_list(const SetState& state, const Block& block, LastGroup& last);
  std::vector<Segment> set_segment_list(const SetState& state, const Block& block, LastGroup& last);
  std::vector<Edge> set_edge_list(const SetState& state, const Block& block, LastGroup& last);
  /// Adds groups that the set does not have.
  void share_groups(SetState& set, const std::vector<const SetGroup*>& groups, const Block& block);
  std::string set_title(const Block& block) const;
  /// Sorts by nodes and merges equal segments (edges) of one element.
  void merge_segments(std::vector<Segment>& segments) const;
  void merge_edges(std::vector<Edge>& edges) const;
};

}  // namespace deck
