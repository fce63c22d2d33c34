// Heat inputs of a contact's pairs: exchange areas from the mesh, conductivity from /HEAT/MAT, axes
// that are fixed in space.
#include <algorithm>
#include <cmath>
#include <map>

#include "contact/shared/scene_steps.hpp"
#include "cycle/adapter/effect_inputs.hpp"
#include "deck/keyword.hpp"

namespace deck::cycle {
namespace detail {

using deck::detail::at;

double shell_area(const Coordinates& x, ElementKind kind, const NodeIndex* n) {
  const Vec d = kind == ElementKind::shell4
                    ? cross(at(x, n[2]) - at(x, n[0]), at(x, n[3]) - at(x, n[1]))
                    : cross(at(x, n[1]) - at(x, n[0]), at(x, n[2]) - at(x, n[0]));
  return 0.5 * std::sqrt(dot(d, d));
}

std::optional<AffineMap> fixed_axes(const deck::Model& model, std::int64_t skew) {
  for (const Block& block : model.deck->blocks) {
    if (block.schema == nullptr || block.schema->keyword != "/SKEW/FIX" || !block.id.present)
      continue;
    if (block.id.value + model.deck->offset_of(block, "skew") != skew) continue;
    const DecodedBlock d = decode(*model.deck, block);
    const Vec y{d.real("X_Y"), d.real("Y_Y"), d.real("Z_Y")};
    Vec z{d.real("X_Z"), d.real("Y_Z"), d.real("Z_Z")};
    // X = Y x Z; then Z is orthogonal to both.
    Vec e1 = cross(y, z);
    z = cross(e1, y);
    const double l1 = std::sqrt(dot(e1, e1)), l2 = std::sqrt(dot(y, y)), l3 = std::sqrt(dot(z, z));
    if (!(l1 > 0.0 && l2 > 0.0 && l3 > 0.0)) return std::nullopt;
    AffineMap map;
    map.matrix = {e1.x / l1, y.x / l2,  z.x / l3, e1.y / l1, y.y / l2,
                  z.y / l3,  e1.z / l1, y.z / l2, z.z / l3};
    return map;
  }
  return std::nullopt;
}

std::vector<Conductivity> conductivities(const deck::Model& model) {
  std::vector<Conductivity> out(model.materials.size());
  if (model.deck == nullptr) return out;
  const Deck& deck = *model.deck;
  CardSchema cards[2];
  const auto cell = [](const char* name, int first, Dimension dimension) {
    deck::Field f;
    f.name = name;
    f.first = first;
    f.last = first + 19;
    f.type = FieldType::real;
    f.dimension = dimension;
    return f;
  };
  const Dimension a{1, 1, -3, -1}, b{1, 1, -3, -2};
  cards[0].fields = {cell("A", 41, a), cell("B", 61, b)};
  cards[1].fields = {cell("T1", 1, {0, 0, 0, 1}), cell("A", 21, a), cell("B", 41, b)};
  for (const Block& block : deck.blocks) {
    if (!block.header.starts_with("/HEAT/MAT/") || block.opaque || !block.id.present) continue;
    const auto it = model.material_of_id.find(block.id.value + deck.offset_of(block, "mat"));
    if (it == model.material_of_id.end()) continue;
    DecodedBlock d;
    d.block = &block;
    LineCursor lines(deck.sources, block);
    for (const CardSchema& card : cards)
      if (const Line line = lines.next(); line.valid())
        d.cards.push_back(decode_line(deck, block, card, line, nullptr));
    const auto value = [&](std::size_t card, std::size_t k) {
      return d.cards.size() > card ? working_value(deck, d, d.cards[card].cells[k]) : 0.0;
    };
    const double melting = value(1, 0);
    out[it->second] = {value(0, 0), value(0, 1), value(1, 1), value(1, 2),
                       melting > 0.0 ? melting : 1e30};
  }
  return out;
}

void node_areas(const Scene& scene, const Contact& contact, ContactPairs& out) {
  Connectivity connectivity(*scene.model);
  const Coordinates& x = scene.coordinates;
  std::vector<double> area(contact.secondary.size(), -1.0);
  for (const CandidatePair& p : out.at) {
    double& a = area[p.secondary];
    if (a < 0.0) {
      a = 0.0;
      const NodeIndex node = contact.secondary[p.secondary].node;
      for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
        for (const std::uint32_t e : connectivity.elements(kind, node)) {
          const NodeIndex* n = scene.model->family(kind).of(e);
          const std::ptrdiff_t corners = kind == ElementKind::shell4 ? 4 : 3;
          // A shell with a node that does not exist has no area.
          if (std::find(n, n + corners, no_index) == n + corners)
            a += shell_area(x, kind, n) / static_cast<double>(corners);
        }
      }
    }
    out.area.push_back(a);
  }
}

namespace {

class EdgeWidths {
 public:
  explicit EdgeWidths(const Scene& scene) : scene_(&scene), connectivity_(*scene.model) {}

  std::vector<double> of(const std::vector<ContactEdge>& edges) {
    std::vector<double> out;
    if (edges.empty()) return out;
    const Carrier rule = edges.back().carrier;
    out.reserve(edges.size());
    for (const ContactEdge& e : edges) {
      if (rule == Carrier::shell4 || rule == Carrier::shell3)
        out.push_back(on_shells(e));
      else if (rule == Carrier::solid)
        out.push_back(on_solids(e));
      else
        out.push_back(on_lines(e, rule));
    }
    return out;
  }

 private:
  /// Elements of a family that have both nodes of the edge.
  std::vector<std::uint32_t> around(ElementKind kind, const ContactEdge& e) {
    std::vector<std::uint32_t> out;
    const Elements& family = scene_->model->family(kind);
    for (const std::uint32_t element : connectivity_.elements(kind, e.nodes[0])) {
      const NodeIndex* n = family.of(element);
      if (std::find(n, n + family.width, e.nodes[1]) != n + family.width &&
          std::find(n, n + family.width, no_index) == n + family.width)
        out.push_back(element);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  double on_shells(const ContactEdge& e) {
    double area = 0.0, thickness = 0.0;
    std::size_t count = 0;
    for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
      for (const std::uint32_t shell : around(kind, e)) {
        const NodeIndex* n = scene_->model->family(kind).of(shell);
        area += shell_area(scene_->coordinates, kind, n) / (kind == ElementKind::shell4 ? 4 : 3);
        ++count;
        const std::uint32_t part = scene_->model->family(kind).part[shell];
        if (part == no_index || scene_->model->parts[part].prop == no_index) continue;
        thickness = scene_->model->properties[scene_->model->parts[part].prop].thickness;
      }
    }
    const double width = 0.5 * std::sqrt(area);
    return count == 1 ? width + 0.5 * thickness : width;
  }

  /// Share of each node in the area of a solid's face; slots count from 1.
  double share(const NodeIndex* n, std::array<int, 4> slots) const {
    std::array<Vec, 4> x;
    std::array<NodeIndex, 4> node{};
    for (std::size_t i = 0; i < 4; ++i) {
      node[i] = n[slots[i] - 1];
      x[i] = at(scene_->coordinates, node[i]);
    }
    std::sort(node.begin(), node.end());
    const auto distinct = std::unique(node.begin(), node.end()) - node.begin();
    const Vec d = cross(x[2] - x[0], x[3] - x[1]);
    return distinct < 3 ? 0.0 : 0.5 * std::sqrt(dot(d, d)) / static_cast<double>(distinct);
  }

  /// As in the solver, counts only edges whose second node is in the second slot, and sums areas.
  double on_solids(const ContactEdge& e) {
    double sum = 0.0;
    for (const std::uint32_t solid : around(ElementKind::solid8, e)) {
      const NodeIndex* n = scene_->model->solid8.of(solid);
      if (n[1] != e.nodes[1]) continue;
      const double front = share(n, {1, 2, 3, 4}), top = share(n, {4, 3, 7, 8});
      const double side = share(n, {1, 2, 6, 5});
      if (n[0] == e.nodes[0]) sum += 2.0 * (front + share(n, {1, 4, 8, 5}) + side);
      if (n[2] == e.nodes[0]) sum += (front + top) + (share(n, {2, 3, 7, 6}) + top);
      if (n[5] == e.nodes[0]) sum += share(n, {5, 6, 7, 8}) + side;
    }
    return sum;
  }

  /// Formula of the solver for beams and trusses. Its unit is the root of a length.
  double on_lines(const ContactEdge& e, Carrier rule) {
    const ElementKind kind = rule == Carrier::beam ? ElementKind::beam : ElementKind::truss;
    double sum = 0.0;
    std::size_t count = 0;
    for (const NodeIndex end : e.nodes)
      for (const std::uint32_t line : connectivity_.elements(kind, end)) {
        sum += deck::detail::section_thickness(*scene_->model, kind, line);
        ++count;
      }
    return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
  }

  const Scene* scene_;
  Connectivity connectivity_;
};

}  // namespace

void edge_widths(const Scene& scene, const Contact& contact, ContactPairs& out) {
  EdgeWidths widths(scene);
  const std::vector<double> secondary = widths.of(contact.secondary_edges);
  const std::vector<double> main = widths.of(contact.main_edges);
  for (const CandidatePair& p : out.at) {
    out.edge_width[0].push_back(secondary[p.secondary]);
    out.edge_width[1].push_back(main[p.main]);
  }
}

namespace {

/// Conductivity of a part's material at a temperature; 0 if the deck does not give it.
double conductivity(const deck::Model& model, const std::vector<detail::Conductivity>& laws,
                    std::uint32_t part, double temperature) {
  if (part == no_index || model.parts[part].mat == no_index) return 0.0;
  return laws[model.parts[part].mat](temperature);
}

std::uint32_t shell_part_at(const deck::Model& model, Connectivity& connectivity, NodeIndex n) {
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3})
    if (const std::uint32_t e = connectivity.first(kind, n); e != no_index)
      return model.family(kind).part[e];
  return no_index;
}

}  // namespace

double NodeConductivity::operator()(NodeIndex node, double temperature) {
  return conductivity(*model_, laws_, shell_part_at(*model_, connectivity_, node), temperature);
}

}  // namespace detail

void add_conductivity(const Scene& scene, const deck::Contact& contact,
                      const std::vector<double>& temperature, ContactPairs& out) {
  const deck::Model& model = *scene.model;
  const auto temperature_at = [&](NodeIndex n) {
    return temperature.empty() ? 0.0 : temperature[n];
  };
  if (contact.kind == deck::ContactKind::edge_edge) {
    const auto laws = detail::conductivities(model);
    for (const CandidatePair& p : out.at) {
      const ContactEdge* edges[] = {&contact.secondary_edges[p.secondary],
                                    &contact.main_edges[p.main]};
      for (std::size_t r = 0; r < 4; ++r) {
        const ContactEdge& e = *edges[r / 2];
        out.edge_conductivity[r].push_back(
            detail::conductivity(model, laws, detail::part_of(model, e.carrier, e.element),
                                 temperature_at(e.nodes[r % 2])));
      }
    }
    return;
  }
  detail::NodeConductivity of_node(model);
  for (const CandidatePair& p : out.at) {
    const NodeIndex n = contact.secondary[p.secondary].node;
    out.conductivity.push_back(of_node(n, temperature_at(n)));
  }
}

}  // namespace deck::cycle
