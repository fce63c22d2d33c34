// Gaps of a contact from its elements: thicknesses, sides, limits of Igap 3. Rules: contact/rules.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

/// Limit of a gap by the mesh (Igap 3): of a segment, of an edge, over all nodes of segments.
double segment_limit(const GapInputs& c, const MainSegment& m, double side, double fraction) {
  for (const NodeIndex n : m.nodes) side = std::min(side, shortest_line_element(c, n));
  return fraction * std::min(side, no_limit);
}
double edge_limit(const GapInputs& c, const ContactEdge& e, double fraction) {
  double limit = distance(c.coordinates, e.nodes[0], e.nodes[1]);
  for (const NodeIndex n : e.nodes) limit = std::min(limit, shortest_line_element(c, n));
  return fraction * limit;
}
template <class LengthAt>
std::vector<double> node_limits(std::size_t nodes, const std::vector<MainSegment>& main,
                                const LengthAt& length_at) {
  std::vector<double> out(nodes, no_limit);
  for (std::size_t i = 0; i < main.size(); ++i)
    for (const NodeIndex n : main[i].nodes) out[n] = std::min(out[n], length_at(i));
  return out;
}

/// Half of the largest thickness at a node, before Fscalegap; `shells`: shell_half_thickness().
double node_half_thickness(const GapInputs& c, const std::vector<double>& shells, NodeIndex node) {
  return std::max(shells[node], line_half_thickness(c, node));
}

/// Bounds of gaps over some items.
struct Extremes {
  double shortest = std::numeric_limits<double>::infinity();
  SideExtremes sides;
  void add(const Extremes& other) {
    shortest = std::min(shortest, other.shortest);
    for (double SideExtremes::*const most :
         {&SideExtremes::thickest_main, &SideExtremes::thickest_secondary,
          &SideExtremes::longest_main, &SideExtremes::longest_secondary})
      sides.*most = std::max(sides.*most, other.sides.*most);
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

ThicknessSamples shell_thickness(const Contact& contact) {
  ThicknessSamples out;
  for (const MainSegment& m : contact.main)
    if (m.carrier == Carrier::shell4 || m.carrier == Carrier::shell3) out.add(m.thickness);
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
    const double side = shortest_side(arrays, m.nodes);
    found.shortest = std::min(found.shortest, side);
    const bool shell = m.carrier == Carrier::shell4 || m.carrier == Carrier::shell3;
    if (shell && m.element != no_index)
      m.thickness = gap_thickness(c.model, *family_of_carrier(m.carrier), m.element);
    if (variable && shell) m.gap = segment_gap(m.thickness, scale);
    if (contact.igap == 3) {
      m.length = segment_limit(around, m, side, contact.mesh_fraction);
      found.sides.longest_main = std::max(found.sides.longest_main, m.length);
    }
    found.sides.thickest_main = std::max(found.sides.thickest_main, m.gap);
  };
  const Extremes of_main = set_each(threads, contact.main, set_segment);
  const double shortest = of_main.shortest;
  contact.shortest_side = std::isfinite(shortest) ? shortest : 0;
  const DefaultGap gapmin = gapmin_input > 0
                                ? DefaultGap{gapmin_input, GapminOrigin::card}
                                : default_gap(shell_thickness(contact), contact.shortest_side,
                                              variable && contact.type != 10, scale);
  contact.gapmin = gapmin.value;
  contact.gapmin_origin = gapmin.origin;
  std::vector<double> node_length;
  if (contact.igap == 3)
    node_length = node_limits(x.x.size(), contact.main,
                              [&](std::size_t i) { return contact.main[i].length; });
  const std::vector<double>* const shells =
      variable && !contact.secondary.empty() ? &shell_half_thickness(around) : nullptr;
  const auto set_node = [&](SecondaryNode& s, Extremes& found) {
    if (variable) s.gap = node_gap(node_half_thickness(around, *shells, s.node), scale);
    if (contact.igap == 3) {
      s.length = node_length[s.node];
      found.sides.longest_secondary = std::max(found.sides.longest_secondary, s.length);
    }
    found.sides.thickest_secondary = std::max(found.sides.thickest_secondary, s.gap);
  };
  Extremes all = set_each(threads, contact.secondary, set_node);
  all.add(of_main);
  contact.gap_rule = PairGap::from_igap(contact.igap, contact.gapmin, contact.gapmax);
  contact.max_gap = largest_gap(contact.igap, contact.gapmin, contact.gapmax, all.sides);
}

void set_edge_gaps(SceneContext& c, Contact& contact, double gapmin_input) {
  const Coordinates& x = c.scene.coordinates;
  const GapInputs around{c.model, c.connectivity, *c.tables, x};
  const bool variable = contact.igap != 0;
  const auto set_side = [&](std::vector<ContactEdge>& edges, double& thickest) {
    for (ContactEdge& e : edges) {
      if (variable) e.gap = edge_gap(std::max(e.shell, e.section));
      if (contact.igap == 3) e.length = edge_limit(around, e, contact.mesh_fraction);
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
  const NodeArrays arrays{x.x, x.y, x.z};
  const double fraction = contact.mesh_fraction;
  const bool variable = contact.type != 10;
  PlainSides out;
  if (contact.kind == ContactKind::edge_edge) {
    for (const auto& [edges, lengths] : {std::pair{&contact.secondary_edges, &out.secondary_length},
                                         std::pair{&contact.main_edges, &out.main_length}})
      for (const ContactEdge& e : *edges) lengths->push_back(edge_limit(around, e, fraction));
    out.secondary_side = edge_side(x, contact.secondary_edges);
    out.main_side = edge_side(x, contact.main_edges);
    out.shortest_side = shortest_of_both(out.main_side, out.secondary_side);
    return out;
  }
  double shortest = std::numeric_limits<double>::infinity();
  out.main_length.reserve(contact.main.size());
  for (const MainSegment& m : contact.main) {
    const double side = shortest_side(arrays, m.nodes);
    shortest = std::min(shortest, side);
    out.main_length.push_back(variable ? segment_limit(around, m, side, fraction) : 0);
  }
  out.shortest_side = std::isfinite(shortest) ? shortest : 0;
  out.half_thickness.reserve(contact.secondary.size());
  const std::vector<double>* const shells =
      variable && !contact.secondary.empty() ? &shell_half_thickness(around) : nullptr;
  for (const SecondaryNode& s : contact.secondary)
    out.half_thickness.push_back(variable ? node_half_thickness(around, *shells, s.node) : 0);
  out.secondary_length.assign(contact.secondary.size(), 0);
  if (!variable) return out;
  const std::vector<double> limits =
      node_limits(x.x.size(), contact.main, [&](std::size_t i) { return out.main_length[i]; });
  for (std::size_t i = 0; i < contact.secondary.size(); ++i)
    out.secondary_length[i] = limits[contact.secondary[i].node];
  return out;
}

}  // namespace deck::detail
