// Heat inputs of a contact's pairs: exchange areas from the mesh, conductivity from /HEAT/MAT.
#include <algorithm>
#include <cmath>

#include "contact/scene_parts.hpp"
#include "cycle/adapter_parts.hpp"
#include "cycle/state_parts.hpp"

namespace deck::cycle {
namespace detail {

using deck::detail::at;
using deck::detail::cross;
using deck::detail::dot;
using deck::detail::Vec;

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

void edge_widths(const Contact& contact, ContactPairs& out) {
  const auto width = [](const ContactEdge& e) { return e.shell > 0.0 ? e.shell : e.section; };
  for (const CandidatePair& p : out.at) {
    out.edge_width[0].push_back(width(contact.secondary_edges[p.secondary]));
    out.edge_width[1].push_back(width(contact.main_edges[p.main]));
  }
}

}  // namespace detail

namespace {

/// Conductivity of the material of a part at a temperature; 0 where nothing says it.
double conductivity(const deck::Model& model, const std::vector<detail::Conductivity>& laws,
                    std::uint32_t part, double temperature) {
  if (part == no_index || model.parts[part].mat == no_index) return 0.0;
  return laws[model.parts[part].mat](temperature);
}

std::uint32_t shell_part_at(const deck::Model& model, Connectivity& connectivity, NodeIndex n) {
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3})
    if (const auto list = connectivity.elements(kind, n); !list.empty())
      return model.family(kind).part[list[0]];
  return no_index;
}

}  // namespace

void add_conductivity(const Scene& scene, const deck::Contact& contact,
                      const std::vector<double>& temperature, ContactPairs& out) {
  const deck::Model& model = *scene.model;
  const auto laws = detail::conductivities(model);
  if (contact.kind == deck::ContactKind::edge_edge) {
    for (const CandidatePair& p : out.at) {
      const ContactEdge* edges[] = {&contact.secondary_edges[p.secondary],
                                    &contact.main_edges[p.main]};
      for (std::size_t r = 0; r < 4; ++r) {
        const ContactEdge& e = *edges[r / 2];
        out.edge_conductivity[r].push_back(
            conductivity(model, laws, detail::part_of(model, e.carrier, e.element),
                         temperature[e.nodes[r % 2]]));
      }
    }
    return;
  }
  Connectivity connectivity(model);
  for (const CandidatePair& p : out.at) {
    const NodeIndex n = contact.secondary[p.secondary].node;
    out.conductivity.push_back(
        conductivity(model, laws, shell_part_at(model, connectivity, n), temperature[n]));
  }
}

}  // namespace deck::cycle
