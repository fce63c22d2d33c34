// Gaps of a contact from its elements: thicknesses, sides, limits of Igap 3. Rules: contact/rules.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/shared/parallel.hpp"
#include "contact/shared/scene_steps.hpp"

namespace deck::detail {
namespace {

constexpr double no_limit = 1e30;  // infinity of the solver

/// Length of the shortest truss, beam or spring at a node; infinity if none.
double shortest_line_element(const GapInputs& c, NodeIndex node) {
  if (c.shortest_lines != nullptr) return (*c.shortest_lines)[node];
  double shortest = std::numeric_limits<double>::infinity();
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = c.model.family(kind);
    for (const std::uint32_t e : c.connectivity.elements(kind, node)) {
      const NodeIndex* n = family.of(e);
      if (n[0] != node && n[1] != node) continue;
      if (n[0] == no_index || n[1] == no_index) continue;
      const double l = distance(c.coordinates, n[0], n[1]);
      if (l > 0) shortest = std::min(shortest, l);
    }
  }
  return shortest;
}

/// Limits of gaps by the mesh (Igap 3) of the items of both sides; 1e30 for a node on no segment.
void mesh_limits(const GapInputs& c, const Contact& contact, std::vector<double>& secondary,
                 std::vector<double>& main) {
  const Coordinates& x = c.coordinates;
  const auto limit = [&](double side, const auto& nodes) {
    for (const NodeIndex n : nodes) side = std::min(side, shortest_line_element(c, n));
    return contact.mesh_fraction * side;
  };
  const auto edge_limit = [&](const ContactEdge& e) {
    return limit(distance(x, e.nodes[0], e.nodes[1]), e.nodes);
  };
  for (const ContactEdge& e : contact.secondary_edges) secondary.push_back(edge_limit(e));
  for (const ContactEdge& e : contact.main_edges) main.push_back(edge_limit(e));
  if (contact.kind == ContactKind::edge_edge) return;
  main.resize(contact.main.size());
  parallel_pieces(c.threads, main.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<NodeIndex, 4>& on = contact.main[i].nodes;
      main[i] = limit(std::min(shortest_side({x.x, x.y, x.z}, on), no_limit), on);
    }
  });
  std::vector<double> at_node(x.x.size(), no_limit);
  for (std::size_t i = 0; i < main.size(); ++i)
    for (const NodeIndex n : contact.main[i].nodes) at_node[n] = std::min(at_node[n], main[i]);
  for (const SecondaryNode& s : contact.secondary) secondary.push_back(at_node[s.node]);
}

/// Half of the largest thickness at a node, before Fscalegap; `shells`: shell_half_thickness().
double node_half_thickness(const GapInputs& c, const std::vector<double>& shells, NodeIndex node) {
  return std::max(shells[node], line_half_thickness(c, node));
}

/// Bounds over some items.
struct Extremes {
  double shortest = std::numeric_limits<double>::infinity(), thickest = 0;
  void add(const Extremes& other) {
    shortest = std::min(shortest, other.shortest);
    thickest = std::max(thickest, other.thickest);
  }
};

/// Calls set(item, extremes) for all items on several threads; returns the extremes of all.
template <class Item, class Set>
Extremes set_each(int threads, std::vector<Item>& items, const Set& set) {
  std::vector<Extremes> parts(pieces_of(threads, items.size()));
  parallel_pieces(threads, items.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    Extremes found;  // local: neighbours in `parts` share a cache line
    for (std::size_t i = begin; i < end; ++i) set(items[i], found);
    parts[part] = found;
  });
  Extremes all;
  for (const Extremes& part : parts) all.add(part);
  return all;
}

}  // namespace

const std::vector<double>& shell_half_thickness(const GapInputs& c) {
  std::vector<double>& half = c.tables.half_thickness;
  if (!half.empty()) return half;
  half.assign(c.model.nodes.size(), 0);
  // Every thread writes to its own nodes; most elements lie among those of one thread.
  parallel_parts(c.threads, half.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    const auto mine = [&](NodeIndex n) { return n >= begin && n < end; };  // never no_index
    for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
      const Elements& family = c.model.family(kind);
      for (std::uint32_t e = 0; e < family.size(); ++e) {
        const NodeIndex* n = family.of(e);
        const NodeIndex* const last = n + family.width;
        if (std::none_of(n, last, mine)) continue;
        const double own = 0.5 * gap_thickness(c.model, kind, e);
        for (; n < last; ++n)
          if (mine(*n)) half[*n] = std::max(half[*n], own);
      }
    }
  });
  return half;
}

double half_of_line(const Model& model, ElementKind kind, std::uint32_t e) {
  const double part = part_thickness(model, kind, e);
  if (part > 0) return 0.5 * part;
  return kind == ElementKind::spring ? 0 : 0.5 * section_thickness(model, kind, e);
}

double line_half_thickness(const GapInputs& c, NodeIndex node) {
  double half = 0;
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = c.model.family(kind);
    for (const std::uint32_t e : c.connectivity.elements(kind, node)) {
      const NodeIndex* n = family.of(e);
      if (n[0] != node && n[1] != node) continue;  // the third node of a beam only orients it
      half = std::max(half, half_of_line(c.model, kind, e));
    }
  }
  return half;
}

ThicknessSamples shell_thickness(const Model& model, const Contact& contact) {
  ThicknessSamples out;
  for (const MainSegment& m : contact.main)
    if (is_on_shell(m)) out.add(contact_thickness(model, m));
  return out;
}

EdgeSide edge_side(const Coordinates& x, const std::vector<ContactEdge>& edges) {
  EdgeSide out;
  double shortest = std::numeric_limits<double>::infinity();
  for (const ContactEdge& e : edges) {
    shortest = std::min(shortest, shortest_side({x.x, x.y, x.z}, e.nodes));
    // An edge of a shell that is also a truss or beam counts twice.
    if (e.shell > 0) out.thickness.add(e.shell);
    if (e.section > 0) out.thickness.add(e.section);
  }
  if (std::isfinite(shortest)) out.shortest = shortest;
  return out;
}

void set_gaps(SceneContext& c, Contact& contact, double gapmin_input) {
  const Coordinates& x = c.scene.coordinates;
  const int threads = effective_threads(c.options.threads);
  const GapInputs around{c.model, c.connectivity, *c.tables, x, threads};
  const NodeArrays arrays{x.x, x.y, x.z};
  const bool variable = contact.igap != 0;
  const double scale = contact.gap_scale;
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring})
    if (variable) c.connectivity.prepare(kind);
  const auto set_segment = [&](MainSegment& m, Extremes& found) {
    if (variable && is_on_shell(m)) m.gap = segment_gap(contact_thickness(c.model, m), scale);
    found.add({shortest_side(arrays, m.nodes), m.gap});
  };
  const Extremes main = set_each(threads, contact.main, set_segment);
  contact.shortest_side = std::isfinite(main.shortest) ? main.shortest : 0;
  const DefaultGap gapmin =
      gapmin_input > 0 ? DefaultGap{gapmin_input, GapminOrigin::card}
                       : default_gap(shell_thickness(c.model, contact), contact.shortest_side,
                                     variable && contact.type != 10, scale);
  contact.gapmin = gapmin.value;
  contact.gapmin_origin = gapmin.origin;
  const std::vector<double>* const shells =
      variable && !contact.secondary.empty() ? &shell_half_thickness(around) : nullptr;
  const auto set_node = [&](SecondaryNode& s, Extremes& found) {
    if (variable) s.gap = node_gap(node_half_thickness(around, *shells, s.node), scale);
    found.thickest = std::max(found.thickest, s.gap);
  };
  const Extremes secondary = set_each(threads, contact.secondary, set_node);
  if (contact.igap == 3)
    mesh_limits(around, contact, contact.secondary_length, contact.main_length);
  const auto longest = [](const std::vector<double>& lengths) {
    return std::accumulate(lengths.begin(), lengths.end(), 0.0,
                           [](double a, double b) { return std::max(a, b); });
  };
  contact.gap_rule = PairGap::from_igap(contact.igap, contact.gapmin, contact.gapmax);
  contact.max_gap = largest_gap(contact.igap, contact.gapmin, contact.gapmax,
                                {main.thickest, secondary.thickest, longest(contact.main_length),
                                 longest(contact.secondary_length)});
}

void set_edge_gaps(SceneContext& c, Contact& contact, double gapmin_input) {
  const Coordinates& x = c.scene.coordinates;
  const GapInputs around{c.model, c.connectivity, *c.tables, x};
  const bool variable = contact.igap != 0;
  if (contact.igap == 3)
    mesh_limits(around, contact, contact.secondary_length, contact.main_length);
  const auto set_side = [&](std::vector<ContactEdge>& edges, double& thickest) {
    for (ContactEdge& e : edges) {
      if (variable) e.gap = edge_gap(contact_thickness(c.model, e));
      thickest = std::max(thickest, e.gap);
    }
  };
  SideExtremes extremes;
  set_side(contact.main_edges, extremes.thickest_main);
  set_side(contact.secondary_edges, extremes.thickest_secondary);
  const EdgeSide main = edge_side(x, contact.main_edges);
  const EdgeSide secondary = edge_side(x, contact.secondary_edges);
  contact.shortest_side = shortest_of_both(main, secondary);
  const DefaultGap gapmin = gapmin_input > 0 ? DefaultGap{gapmin_input, GapminOrigin::card}
                                             : default_edge_gap(main, secondary, variable);
  contact.gapmin = gapmin.value;
  contact.gapmin_origin = gapmin.origin;
  contact.gap_rule =
      PairGap::from_igap(contact.igap, contact.gapmin, std::numeric_limits<double>::infinity());
  contact.max_gap = largest_edge_gap(contact.gapmin, extremes);
}

std::vector<double> shortest_line_elements(const Model& model, const Coordinates& x) {
  std::vector<double> out(model.nodes.size(), std::numeric_limits<double>::infinity());
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = model.family(kind);
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const NodeIndex* n = family.of(e);
      if (n[0] == no_index || n[1] == no_index) continue;
      const double l = distance(x, n[0], n[1]);
      for (int k = 0; k < 2 && l > 0; ++k) out[n[k]] = std::min(out[n[k]], l);
    }
  }
  return out;
}

PlainSides plain_sides(const GapInputs& around, const Contact& contact) {
  const Coordinates& x = around.coordinates;
  PlainSides out;
  if (contact.type != 10) mesh_limits(around, contact, out.secondary_length, out.main_length);
  if (contact.kind == ContactKind::edge_edge) {
    out.secondary_side = edge_side(x, contact.secondary_edges);
    out.main_side = edge_side(x, contact.main_edges);
    out.shortest_side = shortest_of_both(out.main_side, out.secondary_side);
    return out;
  }
  double shortest = std::numeric_limits<double>::infinity();
  for (const MainSegment& m : contact.main)
    shortest = std::min(shortest, shortest_side({x.x, x.y, x.z}, m.nodes));
  out.shortest_side = std::isfinite(shortest) ? shortest : 0;
  out.half_thickness.resize(contact.secondary.size());
  out.secondary_length.resize(contact.secondary.size());
  out.main_length.resize(contact.main.size());
  if (contact.type == 10 || contact.secondary.empty()) return out;
  const std::vector<double>& shells = shell_half_thickness(around);
  for (std::size_t i = 0; i < contact.secondary.size(); ++i)
    out.half_thickness[i] = node_half_thickness(around, shells, contact.secondary[i].node);
  return out;
}

}  // namespace deck::detail
