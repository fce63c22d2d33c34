// The steps that write the HTML report, one per file. Private to the stage.
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contact/shared/scene_parts.hpp"
#include "deck/report.hpp"
#include "deck/verdict.hpp"
#include "report/html/stream.hpp"
#include "report/record.hpp"

namespace deck {
struct Mesh;  // model/shared/mesh.hpp
}  // namespace deck

namespace deck::detail {

/// The viewer as compiled in (generated at build): script and style sheet; empty script: none,
/// and `missing` says why.
struct ViewerBundle {
  std::string_view script, style, missing;
};
const ViewerBundle& viewer_bundle();

/// JSON as it may stand in a script element: '<' occurs in it only inside strings.
std::string script_safe(std::string_view json);

/// A block of packed bytes.
struct DataBlock {
  const char* id;
  std::function<std::string()> make;
  std::string text = {};
};

/// A value as the JSON of a block.
template <class T>
std::string block_json(const T& value) {
  std::string out;
  JsonWriter json(out);
  write_value(json, value);
  return out;
}

/// Numbers the nodes that occur in the page in the order of the model.
class PageNodes {
 public:
  explicit PageNodes(std::size_t nodes) : used_(nodes, 0) {}
  void use(NodeIndex n) {
    if (n < used_.size()) used_[n] = 1;
  }
  bool used(NodeIndex n) const { return n < used_.size() && used_[n] != 0; }
  void number();  ///< after the last use()
  std::uint32_t operator[](NodeIndex n) const { return number_[n]; }
  const std::vector<NodeIndex>& list() const { return list_; }

 private:
  std::vector<std::uint8_t> used_;
  std::vector<std::uint32_t> number_;
  std::vector<NodeIndex> list_;
};

/// Positions of the marks that are set, ascending.
inline std::vector<std::uint32_t> marked(const std::vector<std::uint8_t>& marks) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < marks.size(); ++i)
    if (marks[i] != 0) out.push_back(i);
  return out;
}

/// Of more than `most` rows those with the largest `size`, these first.
template <class Row, class Size>
void keep_largest(std::vector<Row>& rows, std::size_t most, const Size& size) {
  if (rows.size() <= most) return;
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const Row& a, const Row& b) { return size(a) > size(b); });
  rows.resize(most);
}

/// Position in Interfaces::ordered.
inline std::size_t interface_position(const Scene& scene, const InterBase* inter) {
  const auto& order = scene.interfaces->ordered;
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), inter) - order.begin());
}

/// Position of its part in Model::parts, -1: no part.
inline std::int64_t part_position(const Model& model, const ElementName& e) {
  const std::uint32_t part = e.valid() ? model.family(e.kind).part[e.index] : no_index;
  return part == no_index ? -1 : std::int64_t{part};
}

// mesh.cpp — the picture
struct MeshGroup {
  ElementKind kind{};
  int corners = 0;                     ///< 2, 3 or 4
  std::vector<std::uint32_t> element;  ///< of each face or line, in its family
  std::vector<std::uint8_t> face;      ///< of solids: which of the six
};
struct MeshPart {
  std::uint32_t part = no_index;  ///< index into Model::parts, no_index: none
  std::vector<MeshGroup> groups;
};
/// Outer faces of solids part by part, shells, and one-dimensional elements.
std::vector<MeshPart> collect_mesh(const Model& model, PageNodes& nodes);
std::string mesh_block(const Model& model, const std::vector<MeshPart>& mesh,
                       const PageNodes& nodes);

// what is said about an element that is picked
struct ItemPlace {
  std::uint32_t file = Span::no_file;
  std::uint32_t line = 0;  ///< 0: not known, or beyond what 32 bits count
};
/// Calls take(item, place) for the items of a block, and gives the pages of its file back.
void each_item_place(const Deck& deck, std::span<const BulkBlock> runs,
                     const std::function<void(std::uint32_t, ItemPlace)>& take);
std::string elements_block(const Model& model, const std::vector<MeshPart>& mesh);

// contacts.cpp — penetrations, and the pairs that settings can be tried on
struct PageContact {
  std::vector<CandidatePair> near;   ///< within about three gaps: who touches whom
  std::vector<CandidatePair> pairs;  ///< what the page carries
  std::vector<double> distance;      ///< of these
  /// Distances that stand in for that of a pair where they give the same depth, by pair.
  std::vector<std::pair<std::uint32_t, double>> others;
  std::vector<std::uint32_t> rows;     ///< penetrations that the page shows, in their order
  std::vector<std::uint32_t> pair_of;  ///< of each of these: position in `pairs`
  double reach = 0;                    ///< all pairs nearer than that are carried
  const char* fixed = "";              ///< why the page tries no other settings; empty: it does
  bool complete = true;                ///< false: of too many penetrations only the deepest
  PlainSides plain;
};
struct PageContacts {
  std::vector<PageContact> contacts;        ///< parallel to the scene's
  std::optional<Coordinates> before_moves;  ///< where Inacti 3 has moved nodes of the scene
  std::vector<NodeIndex> of_ties;  ///< nodes of ties whose coordinates the page needs as well
  /// All nodes where the deck has them.
  const Coordinates& start(const Scene& scene) const {
    return before_moves ? *before_moves : scene.coordinates;
  }
};
PageContacts collect_contacts(const HtmlInput& input, PageNodes& nodes);
/// Two blocks that can be made side by side: the nodes, segments and edges of all contacts, and the
/// contacts one by one, after which `page` is empty.
struct ContactBlocks {
  std::function<std::string()> shared, contacts;
};
ContactBlocks contact_blocks(const HtmlInput& input, PageContacts& page, const PageNodes& nodes);

// touches.cpp — who touches whom
struct Touch {
  int secondary = -1, main = -1;          ///< positions in Model::parts, -1: no part
  std::vector<std::uint32_t> interfaces;  ///< positions in Interfaces::ordered, ascending
  std::size_t pairs = 0;                  ///< penetrating
  double depth = 0;                       ///< of the deepest
};
/// Part pairs with a pair within the page's reach, or a penetration; by secondary, then main.
std::vector<Touch> collect_touches(const HtmlInput& input, const PageContacts& page);
/// As SVG: the deepest 60 parts of each side.
std::string touches_drawing(const HtmlInput& input, const std::vector<Touch>& touches);

// page_data.cpp — JSON of the blocks deck-meta and deck-earlier
std::string meta_json(const HtmlInput& input, const PageContacts& page,
                      const std::vector<Touch>& touches);
std::string earlier_json(const HtmlInput& input);
/// What is said of the deck: with its forces where the page is about them.
Verdict page_verdict(const HtmlInput& input);

// blocks.cpp — blocks that only some pages have
/// Their JSON.
void block_forms(SchemaDefinitions& definitions);
// lines from nodes of ties to segments, and the nodes that are not tied
/// Marks the nodes of all ties. Given back are those that the picture does not show by itself (no
/// element has them) or that a line ends at which is looked at closely: of nodes that are not tied.
std::vector<NodeIndex> use_nodes(const Scene& scene, PageNodes& nodes);
bool has_ties(const Scene& scene);
std::string ties_block(const Scene& scene, const PageNodes& nodes);
// colours of time steps
/// Smallest step, end of the scale and largest step, then a byte for each node of the page: 0 where
/// no element has a step, else 1 at the end of the scale and beyond to 255 at the smallest, in
/// equal ratios.
std::string steps_block(const Model& model, const Mesh& mesh, const PageNodes& nodes);
/// What became of an earlier run, moved nodes, a repair, crossed elements, the first cycle. Marks
/// their nodes; both arguments must outlive the blocks, which are made when nodes have numbers.
std::vector<DataBlock> optional_blocks(const HtmlInput& input, PageNodes& nodes);

}  // namespace deck::detail
