// The model of a deck: nodes, elements, parts; groups, surfaces, lines; interfaces with their
// effective values. Over 600 lines, because one public header has the whole concept.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/text.hpp"

namespace deck {

// Arrays with 32-bit indices in the solver's order: nodes file by file and by id, elements file by
// file, by part and id; parts, properties and materials file by file and by id. Ids have 64 bits.
// All values are in working units.

using NodeIndex = std::uint32_t;
inline constexpr std::uint32_t no_index = 0xffffffffu;

/// Map from id to index. Lookup is O(1) for dense ids, O(log n) otherwise.
class IdMap {
 public:
  /// `ids[i]` gets index i. Of equal ids the first wins; duplicates() has the others.
  void build(const std::vector<std::int64_t>& ids);
  std::uint32_t find(std::int64_t id) const;  ///< no_index if absent
  const std::vector<std::uint32_t>& duplicates() const { return duplicates_; }

 private:
  std::int64_t base_ = 0;
  std::vector<std::uint32_t> dense_;                            // base_ + i -> index
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;  // for sparse ids
  std::vector<std::uint32_t> duplicates_;
};

struct Nodes {
  std::vector<std::int64_t> id;
  std::vector<double> x, y, z;
  IdMap map;
  std::size_t size() const { return id.size(); }
};

enum class ElementKind : std::uint8_t {
  shell4,
  shell3,
  solid8,
  quad,
  tria,
  truss,
  beam,
  spring,
};

/// Shapes of solids. As in the solver, all have eight slots; degenerate ones repeat nodes (tetra n1
/// n1 n2 n2 n4 n3 n3 n4, penta n1 n2 n3 n1 n4 n5 n6 n4).
enum class SolidShape : std::uint8_t { brick8, tetra4, penta6, tetra10, brick20, thick16 };

/// One family of elements with `width` nodes per element.
struct Elements {
  ElementKind kind{};
  int width = 0;
  std::vector<std::int64_t> id;
  std::vector<std::uint32_t> part;   ///< index into Model::parts, no_index: part missing
  std::vector<NodeIndex> nodes;      ///< width per element; no_index: node missing
  std::vector<double> thickness;     ///< shells: own thickness, 0 where absent (may be empty)
  std::vector<SolidShape> shape;     ///< solids only
  std::vector<std::uint32_t> extra;  ///< solids: first mid node in extra_nodes; no_index: none
  std::vector<NodeIndex> extra_nodes;
  std::vector<std::uint32_t> block;  ///< index into Model::element_blocks
  IdMap map;
  std::size_t size() const { return id.size(); }
  const NodeIndex* of(std::size_t e) const {
    return nodes.data() + e * static_cast<std::size_t>(width);
  }
};

struct Part {
  std::int64_t id = 0;
  std::string title;
  std::int64_t prop_id = 0, mat_id = 0, subset_id = 0;
  std::uint32_t prop = no_index, mat = no_index;  ///< indices, no_index: missing
  double thickness = 0;                           ///< contact thickness, 0: none
  std::int32_t submodel = -1;                     ///< index into Deck::submodels
  Span span;                                      ///< header
};

struct Property {
  std::int64_t id = 0;
  std::string title, type;  ///< canonical keyword, e.g. "/PROP/SHELL"
  int number = -1;          ///< TYPEn, -1 unknown
  double thickness = 0;     ///< shells
  double area = 0;          ///< truss, beam, integrated beam
  std::array<double, 3>
      stiffness{};    ///< springs: K (types 4, 12: first; 8, 13: x y z) divided by their scale
  int icontrol = 0;   ///< solids
  bool known = true;  ///< false: thickness, area and stiffness are not read; 0 says nothing
  Span span;
  const Block* block = nullptr;
};

struct Material {
  std::int64_t id = 0;
  std::string title, type;  ///< canonical keyword
  int law = -1;
  double density = 0;
  double young = 0;             ///< E used for contact stiffness; 0: none
  double bulk = 0;              ///< B used for contact stiffness of solids; 0: none
  bool stiffness_known = true;  ///< false: the contact stiffness of the law is unknown
  bool thermal = false;         ///< a /HEAT/MAT refers to it
  Span span;
  const Block* block = nullptr;
};

/// Source of an effective value.
enum class Origin : std::uint8_t {
  card,
  default_block,  ///< /DEFAULT/INTER
  built_in,
  derived,  ///< from other values or from /FRICTION
  geometry  ///< from the mesh: 0 until `resolve` (deck/contacts.hpp) sets it
};
/// "card", "default-block", "built-in", "derived" (also for geometry).
const char* to_string(Origin origin);

/// A field of an interface: value on the card, effective value, origin.
template <class T>
struct Effective {
  T value{};
  T input{};               ///< as read from the card (working units); meaningful if has_input
  bool has_input = false;  ///< false: blank cell or no such cell in this version
  Origin origin = Origin::built_in;
  Span span;  ///< the columns on the card, or of the default card

  /// The value before `resolve`: T{} if the mesh determines it.
  T before_geometry() const { return origin == Origin::geometry ? T{} : value; }
};

/// Kind of the element that carries a segment; the solver sorts by these numbers.
enum class Carrier : std::uint8_t {
  none = 0,
  solid = 1,
  quad = 2,
  shell4 = 3,
  truss = 4,
  beam = 5,
  spring = 6,
  shell3 = 7,
};

/// Four node indices; triangles repeat the third node.
struct Segment {
  std::array<NodeIndex, 4> nodes{};
  Carrier carrier = Carrier::none;
  std::uint32_t element = no_index;  ///< index in the carrier's family
};

/// Two node indices.
struct Edge {
  std::array<NodeIndex, 2> nodes{};
  Carrier carrier = Carrier::none;
  std::uint32_t element = no_index;
};

/// A resolved node group, surface or line.
struct NodeSet {
  std::int64_t id = 0;
  std::string title;
  std::vector<NodeIndex> nodes;
  Span span;
};
struct Surface {
  std::int64_t id = 0;
  std::string title;
  std::vector<Segment> segments;
  bool analytical = false;
  Span span;
};
struct LineSet {
  std::int64_t id = 0;
  std::string title;
  std::vector<Edge> edges;
  Span span;
};
/// /SET/GENERAL, /SET/COLLECT: three projections of one selection.
struct SetGeneral {
  std::int64_t id = 0;
  std::string title;
  std::vector<NodeIndex> nodes;
  std::vector<Segment> segments;
  std::vector<Edge> edges;
  std::vector<std::uint32_t> parts;
  Span span;
};

struct Curve {
  std::int64_t id = 0;
  std::string title;
  std::vector<double> x, y;
  Span span;
};

/// A block of elements or nodes, for the way from an index to the line in the file. A block whose
/// ids do not ascend is several runs.
struct BulkBlock {
  const Block* block = nullptr;
  std::uint32_t first = 0, count = 0;  ///< index range in the family
};

/// Coordinates of all nodes.
struct Coordinates {
  std::vector<double> x, y, z;
};

/// x' = matrix x + shift; matrix by rows.
struct AffineMap {
  std::array<double, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> shift{};
  std::array<double, 3> apply(const std::array<double, 3>& p) const;
  std::array<double, 3> turn(const std::array<double, 3>& direction) const;  ///< without the shift
};

/// Resolves references lazily and keeps the results; see Selections below.
class Selections;

struct ModelData {
  const Deck* deck = nullptr;
  Nodes nodes;
  std::vector<BulkBlock> node_blocks, element_blocks;
  Elements shell4, shell3, solid8, quad, tria, truss, beam, spring;
  std::vector<Part> parts;
  std::vector<Property> properties;
  std::vector<Material> materials;
  std::map<std::int64_t, std::uint32_t> part_of_id, property_of_id, material_of_id;
  std::map<std::int64_t, std::vector<std::int64_t>> subset_children;  ///< child subset ids
  std::map<std::int64_t, Curve> curves;
  std::map<std::int64_t, Span> sensors, frictions, skews, submodels, rbodies;
  bool intthick_v5 = false;      ///< /INTTHICK/V5
  bool two_dimensional = false;  ///< /ANALY N2D != 0
  bool implicit = false;
  bool has_monitored_volume = false, has_ale = false, has_sol2sph = false,
       has_adaptive_mesh = false, has_acoustics = false;
  bool has_thermal_material = false;
  double random_noise = 0;  ///< /RANDOM amplitude, working units
  bool has_random = false;
  /// Coordinates before /TRANSFORM blocks of node groups; nullptr: no such block. Boxes use them.
  std::shared_ptr<const Coordinates> before_transforms;
  /// /CNODE nodes merged with another node: (node, other node), ascending. Elements refer to the
  /// other node already.
  std::vector<std::pair<NodeIndex, NodeIndex>> merged_nodes;
  /// Node of an id, after merging; no_index if absent.
  NodeIndex find_node(std::int64_t node_id) const;
  std::vector<AffineMap>
      submodel_motions;  ///< per Deck::submodels: its own /TRANSFORM blocks, combined in order
  std::shared_ptr<Selections> selections;  ///< of this model; set by build_model
};

/// The deck as arrays. Movable; its selections move with it.
struct Model : ModelData {
  Model() = default;
  Model(Model&& other) noexcept;
  Model& operator=(Model&& other) noexcept;

  Elements& family(ElementKind kind) { return this->*families[static_cast<std::size_t>(kind)]; }
  const Elements& family(ElementKind kind) const {
    return this->*families[static_cast<std::size_t>(kind)];
  }
  /// Id of a node; 0 for no_index.
  std::int64_t node_id(NodeIndex n) const { return n == no_index ? 0 : nodes.id[n]; }
  /// The line that defines a node or element; found by reading its block again.
  Span node_span(NodeIndex n) const;
  Span element_span(ElementKind kind, std::uint32_t e) const;

 private:
  /// By kind.
  static constexpr Elements ModelData::*families[] = {
      &ModelData::shell4, &ModelData::shell3, &ModelData::solid8, &ModelData::quad,
      &ModelData::tria,   &ModelData::truss,  &ModelData::beam,   &ModelData::spring};
};

struct ModelOptions {
  int threads = 1;
  Limits limits;
};

/// Builds the model. The deck must outlive it. Findings (unreadable cells, unknown nodes, missing
/// parts, duplicates: rules DK0xx, DK1xx) go to `findings`.
Model build_model(const Deck& deck, const SchemaSet& schemas, Findings& findings,
                  const ModelOptions& options = {});

// Selections: groups, surfaces, lines, boxes and sets, resolved on demand to nodes, segments and
// edges in the solver's order.

/// Consecutive shells of a part as segments of a surface.
struct ShellRun {
  ElementKind kind{};       ///< shell4 or shell3
  bool reversed = false;    ///< with reversed normals
  std::uint32_t first = 0;  ///< first element in the family
  std::size_t end = 0;      ///< number of segments of the surface up to the end of this run
};

/// The segments of a surface in order. A list is stored, or formed on demand from the shells of
/// parts. Valid as long as the Selections and the Model. Safe for concurrent reading.
class SegmentList {
 public:
  SegmentList(const Model& model, const std::vector<Segment>& held)
      : model_(&model), held_(&held), size_(held.size()) {}
  SegmentList(const Model& model, const std::vector<ShellRun>& runs)
      : model_(&model), runs_(&runs), size_(runs.empty() ? 0 : runs.back().end) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// True if the list is formed on demand, from shells only.
  bool is_from_shells() const { return runs_ != nullptr; }
  /// Segments begin ... end-1. `room` is the storage if they are formed on demand.
  std::span<const Segment> some(std::size_t begin, std::size_t end,
                                std::vector<Segment>& room) const;
  /// Calls f(position of the first, segments) for consecutive portions of the list.
  template <class F>
  void for_each_piece(F&& f) const {
    std::vector<Segment> room;
    for (std::size_t begin = 0; begin < size_; begin += piece_size) {
      const std::size_t end = std::min(size_, begin + piece_size);
      f(begin, some(begin, end, room));
    }
  }
  /// Calls f(segment) for all segments.
  template <class F>
  void for_each(F&& f) const {
    for_each_piece([&](std::size_t, std::span<const Segment> piece) {
      for (const Segment& s : piece) f(s);
    });
  }
  /// The first segment for which matches(segment) is true; nullopt: none.
  template <class Matches>
  std::optional<Segment> find(Matches&& matches) const {
    std::vector<Segment> room;
    for (std::size_t begin = 0; begin < size_; begin += piece_size)
      for (const Segment& s : some(begin, std::min(size_, begin + piece_size), room))
        if (matches(s)) return s;
    return std::nullopt;
  }
  static constexpr std::size_t piece_size = 4096;

 private:
  const Model* model_;
  const std::vector<Segment>* held_ = nullptr;
  const std::vector<ShellRun>* runs_ = nullptr;
  std::size_t size_;
};

/// A surface as SegmentList (see Selections::outline).
struct SurfaceOutline {
  SegmentList segments;
  bool analytical = false;
};

class Selections {
 public:
  /// Collects the definitions of the deck; resolves nothing. The model must not move (build_model
  /// updates its own selections with rebind()).
  Selections(const Model& model, const SchemaSet& schemas, const Limits& limits = {});
  /// Limits for later calls.
  void set_limits(const Limits& limits);
  /// False if results lack members because of Limits::selection_bytes (DK332).
  bool complete() const;
  ~Selections();
  Selections(const Selections&) = delete;
  Selections& operator=(const Selections&) = delete;

  /// Resolves a group, surface or line; if there is none of that id, a set. nullptr: unknown id.
  /// The results are kept. Not thread-safe.
  const NodeSet* node_group(std::int64_t id);
  const Surface* surface(std::int64_t id);
  /// Like surface(), but does not store segments that follow from shells. nullopt: unknown id.
  std::optional<SurfaceOutline> outline(std::int64_t id);
  const LineSet* line(std::int64_t id);
  const SetGeneral* set(std::int64_t id);
  /// Elements of a group of kind "grshel", "grsh3n", "grbric", "grquad", "grtria", "grtrus",
  /// "grbeam" or "grspri"; indices in the order of the group.
  const std::vector<std::uint32_t>* element_group(std::string_view kind, std::int64_t id);
  /// Parts of a /GRPART or set; ascending indices into Model::parts.
  const std::vector<std::uint32_t>* part_group(std::int64_t id);
  /// True if the id is that of a /GRNOD, /SURF or /LINE, not of a set.
  bool is_plain(std::string_view kind, std::int64_t id) const;
  /// Place of a definition, for notes; kind is "grnod", "surf", "line", "set", "box", ...
  std::optional<Span> where(std::string_view kind, std::int64_t id) const;
  /// All ids of a kind in order of definition.
  std::vector<std::int64_t> ids(std::string_view kind) const;

  /// Edges of a surface as /LINE/SURF (all) or /LINE/EDGE (free) defines them.
  std::vector<Edge> edges_of(const SegmentList& segments, bool free_only) const;
  /// Unique nodes of a surface, ascending ids (the solver's order).
  std::vector<NodeIndex> nodes_of(const SegmentList& segments) const;

  /// Resolves all definitions, so that findings() is complete.
  void resolve_all();
  /// Findings so far: missing members, recursion, empty results (rules DK1xx).
  Findings& findings();

  /// Sets the new address of a model that was moved.
  void rebind(const Model& model);

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace deck

#include "deck/interface_fields.hpp"  // the fields of every type, generated from the schemas

namespace deck {

// Interfaces as plain structs. Each field of /INTER/TYPE2, 7, 10, 11, 19, 24, 25 has its effective
// value, its origin, and the value on the card.

/// Differences between interface types, one row per type. A side has the name of its field and the
/// kind of entity that the id refers to.
struct InterfaceTraits {
  struct Side {
    std::string_view field, refers_to;
  };
  int type;
  std::string_view keyword;
  Side secondary, main;
  std::string_view gap;  ///< field of the minimum gap; empty: no such field
};

/// Members of every interface.
struct InterBase {
  std::int64_t id = 0;
  int type = 0;  ///< 2, 7, 10, 11, 19, 24, 25
  std::string title;
  const Block* block = nullptr;
  Span span;              ///< header
  bool resolved = false;  ///< values of Origin::geometry are set (`resolve`)
};

/// An interface with the fields of its schema (deck/interface_fields.hpp).
template <class Fields>
struct InterFields : InterBase, Fields {
  /// Calls f(name, field) for every field in the order of the card.
  template <class F>
  void for_each(F&& f) {
    Fields::visit(*this, f);
  }
  template <class F>
  void for_each(F&& f) const {
    Fields::visit(*this, f);
  }
};

/// A tie. Not in lists of contacts: its fields have other meanings.
struct InterType2 : InterFields<Type2Fields> {
  static constexpr InterfaceTraits traits{
      2, "/INTER/TYPE2", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "dsearch"};
};

struct InterType7 : InterFields<Type7Fields> {
  static constexpr InterfaceTraits traits{
      7, "/INTER/TYPE7", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "Gapmin"};
};

struct InterType10 : InterFields<Type10Fields> {
  static constexpr InterfaceTraits traits{
      10, "/INTER/TYPE10", {"grnd_IDs", "grnod"}, {"surf_IDm", "surf"}, "Gap"};
};

struct InterType11 : InterFields<Type11Fields> {
  static constexpr InterfaceTraits traits{
      11, "/INTER/TYPE11", {"line_IDs", "line"}, {"line_IDm", "line"}, "Gapmin"};
};

struct InterType19 : InterFields<Type19Fields> {
  static constexpr InterfaceTraits traits{
      19, "/INTER/TYPE19", {"surf_IDs", "surf"}, {"surf_IDm", "surf"}, "Gapmin"};
};

/// Segments against nodes, of one or two surfaces. No minimum gap: gaps follow the thickness.
struct InterType24 : InterFields<Type24Fields> {
  static constexpr InterfaceTraits traits{
      24, "/INTER/TYPE24", {"surf_ID1", "surf"}, {"surf_ID2", "surf"}, ""};
};

/// Like TYPE24, but penetrations depend on neighbouring segments. Current models use it.
struct InterType25 : InterFields<Type25Fields> {
  static constexpr InterfaceTraits traits{
      25, "/INTER/TYPE25", {"surf_ID1", "surf"}, {"surf_ID2", "surf"}, ""};
};

/// /DEFAULT/INTER/TYPEn: its non-zero fields.
struct DefaultInter {
  int type = 0;
  std::vector<std::pair<std::string, Effective<std::int64_t>>> values;
  Span span;
  const Effective<std::int64_t>* find(std::string_view field) const;
};

/// Values of a /FRICTION block, global or for two parts.
struct FrictionValues {
  std::array<double, 6> C{};
  double Fric = 0, VISF = 0;
};
struct FrictionPair {
  std::int64_t grpart_ID1 = 0, grpart_ID2 = 0, part_ID1 = 0, part_ID2 = 0;
  int Idir = 0;
  FrictionValues values, second;  ///< second: orthotropic direction, only if Idir = 1
  Span span;
};
struct Friction {
  std::int64_t id = 0;
  std::string title;
  std::int64_t Ifric = 0, Ifiltr = 0, Iform = 0;
  double Xfreq = 0;
  FrictionValues values;
  std::vector<FrictionPair> pairs;
  Span span;
};

/// The interfaces of a deck. Movable, not copyable: `ordered` and `all` point into the lists.
struct Interfaces {
  std::vector<InterType7> type7;
  std::vector<InterType10> type10;
  std::vector<InterType11> type11;
  std::vector<InterType19> type19;
  std::vector<InterType24> type24;
  std::vector<InterType25> type25;
  std::vector<InterType2> type2;       ///< ties; not in `ordered`
  std::vector<DefaultInter> defaults;  ///< those that the solver uses, at most one per type
  std::vector<Friction> frictions;
  /// All contacts in the solver's order: file by file, then by id.
  std::vector<const InterBase*> ordered;
  /// `ordered` and the ties.
  std::vector<const InterBase*> all;
  /// The first contact or tie with this id; nullptr: none.
  const InterBase* find(std::int64_t id) const {
    for (const InterBase* inter : all)
      if (inter->id == id) return inter;
    return nullptr;
  }
  const Friction* friction(std::int64_t id) const;
  /// The default block of an interface type; nullptr: none.
  const DefaultInter* defaults_of(int type) const;

  Interfaces() = default;
  Interfaces(Interfaces&&) = default;
  Interfaces& operator=(Interfaces&&) = default;
  Interfaces(const Interfaces&) = delete;
  Interfaces& operator=(const Interfaces&) = delete;
  ~Interfaces() = default;

  /// Calls f(list) for the list of each contact type.
  template <class F>
  void for_each_list(F&& f) {
    f(type7), f(type10), f(type11), f(type19), f(type24), f(type25);
  }
  template <class F>
  void for_each_list(F&& f) const {
    f(type7), f(type10), f(type11), f(type19), f(type24), f(type25);
  }
};

inline constexpr std::array<const InterfaceTraits*, 6> interface_types{
    &InterType7::traits,  &InterType10::traits, &InterType11::traits,
    &InterType19::traits, &InterType24::traits, &InterType25::traits};
/// The row of an interface type; nullptr: type without struct.
inline const InterfaceTraits* traits_of(int type) {
  for (const InterfaceTraits* t : interface_types)
    if (t->type == type) return t;
  return nullptr;
}
inline const InterfaceTraits& traits_of(const InterBase& inter) { return *traits_of(inter.type); }
/// True for TYPE24 and TYPE25: segments have two sides; initial penetrations act in the first cycle
/// only.
inline bool is_type24_or_25(int type) { return type == 24 || type == 25; }
/// Sides of a TYPE24 or TYPE25: 1 one surface, 2 two surfaces, 3 a node group and the second
/// surface, 0 no side.
inline int level_of(std::int64_t surf_ID1, std::int64_t surf_ID2) {
  if (surf_ID1 == 0) return surf_ID2 == 0 ? 0 : 3;
  return surf_ID2 == 0 || surf_ID2 == surf_ID1 ? 1 : 2;
}

/// Reads the interface blocks and computes the effective values in the solver's order. Some
/// defaults depend on `model` (thermal materials, adaptive meshing, monitored volumes, number of
/// nodes). Values from the mesh (Origin::geometry) are 0 until `resolve` (deck/contacts.hpp).
Interfaces read_interfaces(const Deck& deck, const Model& model, Findings& findings);

/// Calls f(contact) with the type of the contact; `base` must be in Interfaces::ordered.
template <class F>
decltype(auto) visit_interface(const InterBase& base, F&& f) {
  if (base.type == InterType7::traits.type) return f(static_cast<const InterType7&>(base));
  if (base.type == InterType10::traits.type) return f(static_cast<const InterType10&>(base));
  if (base.type == InterType11::traits.type) return f(static_cast<const InterType11&>(base));
  if (base.type == InterType19::traits.type) return f(static_cast<const InterType19&>(base));
  if (base.type == InterType24::traits.type) return f(static_cast<const InterType24&>(base));
  if (base.type == InterType25::traits.type) return f(static_cast<const InterType25&>(base));
  throw std::logic_error("visit_interface: not an element of Interfaces");
}

/// visit_interface for contacts and ties: `base` must be in Interfaces::all.
template <class F>
decltype(auto) visit_any_interface(const InterBase& base, F&& f) {
  if (base.type == InterType2::traits.type) return f(static_cast<const InterType2&>(base));
  return visit_interface(base, std::forward<F>(f));
}

/// Calls f(name, field) for all fields of a contact or tie.
template <class F>
void for_each_field(const InterBase& base, F&& f) {
  visit_any_interface(base, [&](const auto& inter) { inter.for_each(f); });
}

/// Interfaces of one keyword that are not examined.
struct NotExamined {
  std::string keyword;  ///< "/INTER/TYPE25"
  std::vector<std::int64_t> ids;
};

/// Interfaces that a verdict covers. Every output that says "clean" also lists the others.
struct Coverage {
  std::size_t examined = 0;               ///< contacts and, if examined, ties
  std::vector<NotExamined> not_examined;  ///< by keyword
  std::vector<std::string> missing;       ///< included files that were not read, as written

  bool complete() const { return missing.empty(); }
  bool nothing() const { return examined == 0; }
};

/// Examined interfaces: contacts only, or also the ties of /INTER/TYPE2.
enum class Examined : std::uint8_t { contacts, contacts_and_ties };
/// "TYPE7, 10, 11, 19, 24 and 25", with 2 if ties are examined.
std::string examined_types(Examined examined);
Coverage coverage_of(const Deck& deck, const Interfaces& interfaces,
                     Examined examined = Examined::contacts);

/// "3 interfaces of TYPE25 (ids 4, 5, 6), 1 interface of TYPE2 (id 9)"; empty: all were examined.
std::string not_examined_text(const Coverage& coverage);
/// Text in place of a verdict: "No verdict: ..." for an incomplete model, "Nothing examined: ..."
/// without examined interfaces; else empty.
std::string coverage_lead(const Coverage& coverage);
/// Text after a verdict: " Not examined: ...", or empty.
std::string coverage_tail(const Coverage& coverage);

}  // namespace deck
