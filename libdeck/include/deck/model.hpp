// Model: nodes, elements, parts; groups, surfaces, lines; interfaces with their effective values.
// Over 600 lines: one public header has the whole concept.
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

// Model: the deck as arrays. Nodes and elements are structures of arrays with 32-bit indices in the
// order of the reference solver: file by file, nodes by id, elements by part and id; so are parts,
// properties and materials (by id). Ids are 64-bit; all values in working units.

using NodeIndex = std::uint32_t;
inline constexpr std::uint32_t no_index = 0xffffffffu;

/// id -> index; built once, then constant time for dense ids and logarithmic otherwise.
class IdMap {
 public:
  /// `ids[i]` belongs to index i. Duplicates: the first one wins; they are returned by
  /// duplicates().
  void build(const std::vector<std::int64_t>& ids);
  std::uint32_t find(std::int64_t id) const;  ///< no_index if absent
  const std::vector<std::uint32_t>& duplicates() const { return duplicates_; }

 private:
  std::int64_t base_ = 0;
  std::vector<std::uint32_t> dense_;                            // base_ + i -> index
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;  // used where ids are sparse
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

/// Solids as the reference solver stores them: eight slots, degenerate ones repeat nodes
/// (tetra n1 n1 n2 n2 n4 n3 n3 n4, penta n1 n2 n3 n1 n4 n5 n6 n4).
enum class SolidShape : std::uint8_t { brick8, tetra4, penta6, tetra10, brick20, thick16 };

/// One family of elements; `width` node slots per element.
struct Elements {
  ElementKind kind{};
  int width = 0;
  std::vector<std::int64_t> id;
  std::vector<std::uint32_t> part;  ///< index into Model::parts, no_index: part missing
  std::vector<NodeIndex> nodes;     ///< width per element; no_index: node missing
  std::vector<double> thickness;    ///< shells: own thickness, 0 where absent (may be empty)
  std::vector<SolidShape> shape;    ///< solids only
  std::vector<std::uint32_t>
      extra;  ///< solids only: first slot in extra_nodes (10/20/16-node mid nodes), no_index: none
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
  bool stiffness_known = true;  ///< false: the law's contact stiffness is not established
  bool thermal = false;         ///< a /HEAT/MAT refers to it
  Span span;
  const Block* block = nullptr;
};

/// The source of an effective value.
enum class Origin : std::uint8_t {
  card,
  default_block,  ///< /DEFAULT/INTER
  built_in,
  derived,  ///< follows from other values or from /FRICTION
  geometry  ///< follows from the mesh: 0 until `resolve` (deck/contacts.hpp) fills it in
};
/// "card", "default-block", "built-in", "derived"; what follows from the mesh is "derived" too.
const char* to_string(Origin origin);

/// A field of an interface: what the card says, what the solver uses, and why.
template <class T>
struct Effective {
  T value{};
  T input{};               ///< as read from the card (working units); meaningful if has_input
  bool has_input = false;  ///< false: blank cell or no such cell in this version
  Origin origin = Origin::built_in;
  Span span;  ///< the columns on the card, or of the default card

  /// The value without the mesh; T{} if the geometry decides it, resolved or not.
  T before_geometry() const { return origin == Origin::geometry ? T{} : value; }
};

/// Kind of a segment's carrier; the reference solver's sort key.
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

/// A resolved node group, surface or line. `found` is false where the id names nothing.
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

/// A block of elements or nodes, to get from an index back to the line in the file. One whose rows
/// do not ascend by id is given as several runs, which follow each other as the rows do.
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
  /// Coordinates before the /TRANSFORM of node groups; nullptr if there are none. Boxes use them.
  std::shared_ptr<const Coordinates> before_transforms;
  /// /CNODE nodes that are another node: (node, the other one), ascending. Elements refer to the
  /// other one already.
  std::vector<std::pair<NodeIndex, NodeIndex>> merged_nodes;
  /// Node of an id, merged ones followed; no_index if absent.
  NodeIndex find_node(std::int64_t node_id) const;
  std::vector<AffineMap>
      submodel_motions;                    ///< per Deck::submodels: its own /TRANSFORM, in sequence
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
  /// Node id for people; 0 for no node.
  std::int64_t node_id(NodeIndex n) const { return n == no_index ? 0 : nodes.id[n]; }
  /// The line that defines a node or element (re-read from the source when a person asks).
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

/// Builds the model. Findings (unreadable cells, unknown nodes, missing parts, duplicates …: rules
/// DK0xx, DK1xx) go to `findings`. The deck must outlive the model.
Model build_model(const Deck& deck, const SchemaSet& schemas, Findings& findings,
                  const ModelOptions& options = {});

// Selections: node groups, surfaces, lines, element groups, boxes and sets, resolved on demand to
// nodes, segments and edges exactly as the reference solver orders them.

/// Shells of a part that follow each other, as segments of a surface.
struct ShellRun {
  ElementKind kind{};       ///< shell4 or shell3
  bool reversed = false;    ///< with their normals turned
  std::uint32_t first = 0;  ///< element of the family
  std::size_t end = 0;      ///< segments of the surface up to the last of this run
};

/// The segments of a surface in their order. Those of shells of parts follow from the elements and
/// are formed where they are looked at, others are held. Valid as long as the selections and their
/// model; may be read by several threads.
class SegmentList {
 public:
  SegmentList(const Model& model, const std::vector<Segment>& held)
      : model_(&model), held_(&held), size_(held.size()) {}
  SegmentList(const Model& model, const std::vector<ShellRun>& runs)
      : model_(&model), runs_(&runs), size_(runs.empty() ? 0 : runs.back().end) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// They are all shells, and follow from the elements.
  bool held_by_elements() const { return runs_ != nullptr; }
  /// Segments begin ... end-1; `room` is written where they are not held.
  std::span<const Segment> some(std::size_t begin, std::size_t end,
                                std::vector<Segment>& room) const;
  /// Calls f(position of the first, segments) for all of them, some at a time.
  template <class F>
  void each_piece(F&& f) const {
    std::vector<Segment> room;
    for (std::size_t begin = 0; begin < size_; begin += piece_size) {
      const std::size_t end = std::min(size_, begin + piece_size);
      f(begin, some(begin, end, room));
    }
  }
  /// Calls f(segment) for all of them.
  template <class F>
  void each(F&& f) const {
    each_piece([&](std::size_t, std::span<const Segment> piece) {
      for (const Segment& s : piece) f(s);
    });
  }
  /// The first segment for which holds(segment); nullopt: none.
  template <class Holds>
  std::optional<Segment> find(Holds&& holds) const {
    std::vector<Segment> room;
    for (std::size_t begin = 0; begin < size_; begin += piece_size)
      for (const Segment& s : some(begin, std::min(size_, begin + piece_size), room))
        if (holds(s)) return s;
    return std::nullopt;
  }
  static constexpr std::size_t piece_size = 4096;

 private:
  const Model* model_;
  const std::vector<Segment>* held_ = nullptr;
  const std::vector<ShellRun>* runs_ = nullptr;
  std::size_t size_;
};

/// The segments of a surface (see Selections::outline), and its kind.
struct SurfaceOutline {
  SegmentList segments;
  bool analytical = false;
};

class Selections {
 public:
  /// Collects the definitions of `model`'s deck; nothing is resolved yet. The model must stay at
  /// its address (build_model's own selections follow their model when it is moved).
  Selections(const Model& model, const SchemaSet& schemas, const Limits& limits = {});
  /// For what is resolved from now on.
  void set_limits(const Limits& limits);
  /// False: members were left out because the results would need more than
  /// Limits::selection_bytes (DK332).
  bool complete() const;
  ~Selections();
  Selections(const Selections&) = delete;
  Selections& operator=(const Selections&) = delete;

  /// Group / surface / line of that id; if there is none, the projection of the set of that id.
  /// nullptr: the id names nothing. Results are kept. Not thread safe.
  const NodeSet* node_group(std::int64_t id);
  const Surface* surface(std::int64_t id);
  /// As surface(), but segments that follow from elements are not stored; nullopt: the id names
  /// nothing.
  std::optional<SurfaceOutline> outline(std::int64_t id);
  const LineSet* line(std::int64_t id);
  const SetGeneral* set(std::int64_t id);
  /// Elements of an element group: kind is "grshel", "grsh3n", "grbric", "grquad", "grtria",
  /// "grtrus", "grbeam" or "grspri"; indices in group order.
  const std::vector<std::uint32_t>* element_group(std::string_view kind, std::int64_t id);
  /// Parts of a /GRPART, or of the set of that id; indices into Model::parts, ascending.
  const std::vector<std::uint32_t>* part_group(std::int64_t id);
  /// True if the id is that of a plain /GRNOD, /SURF, /LINE (not a set).
  bool is_plain(std::string_view kind, std::int64_t id) const;
  /// Definition of an id, for "defined here" notes: kind is "grnod", "surf", "line", "set", "box",
  /// ...
  std::optional<Span> where(std::string_view kind, std::int64_t id) const;
  /// All ids of a kind in order of definition.
  std::vector<std::int64_t> ids(std::string_view kind) const;

  /// Edges of a surface as /LINE/SURF (all) or /LINE/EDGE (free) would give them.
  std::vector<Edge> edges_of(std::span<const Segment> segments, bool free_only) const;
  /// Nodes of a surface, unique, in the reference solver's internal order: ascending ids.
  std::vector<NodeIndex> nodes_of(const SegmentList& segments) const;

  /// Resolves everything that is defined, so that findings() is complete.
  void resolve_all();
  /// Findings so far (missing members, recursion, empty results: rules DK1xx).
  Findings& findings();

  /// For Model: the model has moved to this address.
  void rebind(const Model& model);

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace deck

#include "deck/interface_fields.hpp"  // the fields of every type, generated from the schemas

namespace deck {

// The contact interfaces as plain structs. Every field of /INTER/TYPE2, 7, 10, 11, 19, 24, 25 has
// its effective value (the one that the solver uses), its origin, and the value on the card.

/// The differences between interface types, one row per type. A side has the field that names it
/// and the kind of entity that the id refers to, in the words of the schemas.
struct InterfaceTraits {
  struct Side {
    std::string_view field, refers_to;
  };
  int type;
  std::string_view keyword;
  Side secondary, main;
  std::string_view gap;  ///< field of the minimum gap; empty: there is none
};

/// Members of every interface.
struct InterBase {
  std::int64_t id = 0;
  int type = 0;  ///< 2, 7, 10, 11, 19, 24, 25
  std::string title;
  const Block* block = nullptr;
  Span span;              ///< header
  bool resolved = false;  ///< values of Origin::geometry are filled in (deck/contacts.hpp)
};

/// An interface with its fields, which are those of its schema (deck/interface_fields.hpp).
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

/// A tie. Its fields mean something else than those of contacts, so it is in no list with them.
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

/// Segments against nodes, of one surface or of two; no minimum gap: gaps follow the thicknesses.
struct InterType24 : InterFields<Type24Fields> {
  static constexpr InterfaceTraits traits{
      24, "/INTER/TYPE24", {"surf_ID1", "surf"}, {"surf_ID2", "surf"}, ""};
};

/// As TYPE24, but penetrations follow the neighbours of the segments. Current models use it.
struct InterType25 : InterFields<Type25Fields> {
  static constexpr InterfaceTraits traits{
      25, "/INTER/TYPE25", {"surf_ID1", "surf"}, {"surf_ID2", "surf"}, ""};
};

/// /DEFAULT/INTER/TYPEn: the non-zero fields.
struct DefaultInter {
  int type = 0;
  std::vector<std::pair<std::string, Effective<std::int64_t>>> values;
  Span span;
  const Effective<std::int64_t>* find(std::string_view field) const;
};

/// One /FRICTION: global values, then part pairs.
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

/// The contacts and ties of a deck. `ordered` and `all` point into the lists, so it can be moved,
/// not copied.
struct Interfaces {
  std::vector<InterType7> type7;
  std::vector<InterType10> type10;
  std::vector<InterType11> type11;
  std::vector<InterType19> type19;
  std::vector<InterType24> type24;
  std::vector<InterType25> type25;
  std::vector<InterType2> type2;       ///< ties; not in `ordered`
  std::vector<DefaultInter> defaults;  ///< honoured ones only, at most one of a type
  std::vector<Friction> frictions;
  /// All contacts in the solver's order (file by file, then by id), as in the lists above.
  std::vector<const InterBase*> ordered;
  /// `ordered` and the ties: all interfaces whose cards are read as values.
  std::vector<const InterBase*> all;
  /// The first with this id, contact or tie; nullptr: there is none.
  const InterBase* find(std::int64_t id) const {
    for (const InterBase* inter : all)
      if (inter->id == id) return inter;
    return nullptr;
  }
  const Friction* friction(std::int64_t id) const;
  /// The default block that interfaces of this type take; nullptr if there is none.
  const DefaultInter* defaults_of(int type) const;

  Interfaces() = default;
  Interfaces(Interfaces&&) = default;
  Interfaces& operator=(Interfaces&&) = default;
  Interfaces(const Interfaces&) = delete;
  Interfaces& operator=(const Interfaces&) = delete;
  ~Interfaces() = default;

  /// Calls f(list) for the list of every type of contact.
  template <class F>
  void each_list(F&& f) {
    f(type7), f(type10), f(type11), f(type19), f(type24), f(type25);
  }
  template <class F>
  void each_list(F&& f) const {
    f(type7), f(type10), f(type11), f(type19), f(type24), f(type25);
  }
};

inline constexpr std::array<const InterfaceTraits*, 6> interface_types{
    &InterType7::traits,  &InterType10::traits, &InterType11::traits,
    &InterType19::traits, &InterType24::traits, &InterType25::traits};
/// The row of an interface type; nullptr for types that are not read.
inline const InterfaceTraits* traits_of(int type) {
  for (const InterfaceTraits* t : interface_types)
    if (t->type == type) return t;
  return nullptr;
}
inline const InterfaceTraits& traits_of(const InterBase& inter) { return *traits_of(inter.type); }
/// TYPE24 and TYPE25: segments with two sides, penetrations that only the first cycle acts on.
inline bool is_type24_or_25(int type) { return type == 24 || type == 25; }
/// Sides of a TYPE24 or TYPE25: 1 nodes and segments of one surface, 2 of two surfaces, 3 a node
/// group and the second surface, 0 no side.
inline int level_of(std::int64_t surf_ID1, std::int64_t surf_ID2) {
  if (surf_ID1 == 0) return surf_ID2 == 0 ? 0 : 3;
  return surf_ID2 == 0 || surf_ID2 == surf_ID1 ? 1 : 2;
}

/// Decodes the interface blocks and forms the effective values in the reference solver's order of
/// evaluation. `model` supplies what some defaults depend on (thermal materials, adaptive meshing,
/// monitored volumes, number of nodes). What follows from the mesh (Origin::geometry) is left at 0:
/// `resolve` (deck/contacts.hpp) fills it in. Reading-level findings go to `findings`.
Interfaces read_interfaces(const Deck& deck, const Model& model, Findings& findings);

/// Calls f(contact) with the contact as its own type; `base` must be in Interfaces::ordered.
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

/// As visit_interface, also for ties: an element of Interfaces::all.
template <class F>
decltype(auto) visit_any_interface(const InterBase& base, F&& f) {
  if (base.type == InterType2::traits.type) return f(static_cast<const InterType2&>(base));
  return visit_interface(base, std::forward<F>(f));
}

/// Calls f(name, field) for every field of a contact or tie of whatever type.
template <class F>
void for_each_field(const InterBase& base, F&& f) {
  visit_any_interface(base, [&](const auto& inter) { inter.for_each(f); });
}

/// Interfaces of one keyword that are not examined.
struct NotExamined {
  std::string keyword;  ///< "/INTER/TYPE25"
  std::vector<std::int64_t> ids;
};

/// The interfaces that a verdict covers. Every output that says "clean" names them too.
struct Coverage {
  std::size_t examined = 0;               ///< contacts and, where they are examined, ties
  std::vector<NotExamined> not_examined;  ///< by keyword
  std::vector<std::string> missing;       ///< included files that were not read, as written

  bool complete() const { return missing.empty(); }
  bool nothing() const { return examined == 0; }
};

/// The interfaces that were examined: only contacts, or also the ties of /INTER/TYPE2.
enum class Examined : std::uint8_t { contacts, contacts_and_ties };
/// "TYPE7, 10, 11, 19, 24 and 25", with 2 if ties are examined.
std::string examined_types(Examined examined);
Coverage coverage_of(const Deck& deck, const Interfaces& interfaces,
                     Examined examined = Examined::contacts);

/// "3 interfaces of TYPE25 (ids 4, 5, 6), 1 interface of TYPE2 (id 9)"; empty: nothing was left
/// out.
std::string not_examined_text(const Coverage& coverage);
/// The text in place of a verdict: "No verdict: ..." for an incomplete model, "Nothing examined:
/// ..." if no interface was examined; else empty.
std::string coverage_lead(const Coverage& coverage);
/// The text behind a verdict: " Not examined: ...", or empty.
std::string coverage_tail(const Coverage& coverage);

}  // namespace deck
