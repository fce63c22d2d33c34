// Model: the deck as arrays. Nodes and elements are structures of arrays with 32-bit indices in the
// order of the reference solver: file by file, nodes by id, elements by part and id; so are parts,
// properties and materials (by id). Ids are 64-bit; all values in working units.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword/deck.hpp"
#include "deck/keyword/decode.hpp"

namespace deck {

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
      stiffness{};   ///< springs: K (types 4, 12: first; 8, 13: x y z) divided by their scale
  int icontrol = 0;  ///< solids
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

/// Where an effective value came from.
enum class Origin : std::uint8_t {
  card,
  default_block,  ///< /DEFAULT/INTER
  built_in,
  derived,  ///< follows from other values or from /FRICTION
  geometry  ///< follows from the mesh: 0 until `resolve` (deck/contact/scene.hpp) fills it in
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

  /// What is known without the mesh; T{} where the geometry decides, resolved or not.
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

/// Resolves references lazily and keeps the results; see selection.hpp.
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
/// DK0xx, DK1xx) go to `diagnostics`. The deck must outlive the model.
Model build_model(const Deck& deck, const SchemaSet& schemas, Diagnostics& diagnostics,
                  const ModelOptions& options = {});

}  // namespace deck
