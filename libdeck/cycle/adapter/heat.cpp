// Heat inputs of a contact's pairs: exchange areas from the mesh, conductivity from /HEAT/MAT.
#include <algorithm>
#include <cmath>
#include <map>

#include "contact/shared/scene_parts.hpp"
#include "cycle/adapter/parts.hpp"
#include "cycle/state/state_parts.hpp"

namespace deck::cycle {
namespace detail {

using deck::detail::at;

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
          const bool quad = kind == ElementKind::shell4;
          // A shell with a node that does not exist has no area.
          if (std::find(n, n + (quad ? 4 : 3), no_index) != n + (quad ? 4 : 3)) continue;
          const Vec d = quad ? cross(at(x, n[2]) - at(x, n[0]), at(x, n[3]) - at(x, n[1]))
                             : cross(at(x, n[1]) - at(x, n[0]), at(x, n[2]) - at(x, n[0]));
          a += std::sqrt(dot(d, d)) / (quad ? 8.0 : 6.0);
        }
      }
    }
    out.area.push_back(a);
  }
}

namespace {

/// Widths of the edges of one side.
class Widths {
 public:
  explicit Widths(const Scene& scene) : scene_(&scene), connectivity_(*scene.model) {}

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

  /// Share of a face of a solid that goes to each of its nodes; slots count from 1.
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

  /// Only edges whose second node is in the second slot count; the areas are not made a width.
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

  /// The solver's formula for beams and trusses, whose dimension is the root of a length.
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
  Widths widths(scene);
  const std::vector<double> secondary = widths.of(contact.secondary_edges);
  const std::vector<double> main = widths.of(contact.main_edges);
  for (const CandidatePair& p : out.at) {
    out.edge_width[0].push_back(secondary[p.secondary]);
    out.edge_width[1].push_back(main[p.main]);
  }
}

namespace {

/// Conductivity of the material of a part at a temperature; 0 where nothing says it.
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
