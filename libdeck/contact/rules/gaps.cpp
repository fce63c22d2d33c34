// Gaps of a contact: default Gapmin, gaps of nodes and segments, the limits of Igap 3.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/scene/scene_parts.hpp"

namespace deck::detail {
namespace {

constexpr double never = 1e30;  // the solver's "no limit"

/// Shortest side of one segment between distinct nodes; infinity if there is none.
double shortest_side(const Coordinates& c, const std::array<NodeIndex, 4>& n) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    const NodeIndex a = n[i], b = n[(i + 1) % 4];
    if (a == b) continue;
    const double l = distance(c, a, b);
    if (l > 0) shortest = std::min(shortest, l);
  }
  return shortest;
}

/// Length of the shortest truss, beam or spring at a node; infinity if there is none.
double shortest_line_element(SceneContext& c, NodeIndex node) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = c.model.family(kind);
    for (const std::uint32_t e : c.connectivity.elements(kind, node)) {
      const NodeIndex* n = family.of(e);
      if (n[0] != node && n[1] != node) continue;
      if (n[0] == no_index || n[1] == no_index) continue;
      const double l = distance(c.scene.coordinates, n[0], n[1]);
      if (l > 0) shortest = std::min(shortest, l);
    }
  }
  return shortest;
}

/// Half thickness of the thickest thing attached to a node, before Fscalegap.
double node_half_thickness(SceneContext& c, NodeIndex node) {
  double half = 0;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3})
    for (const std::uint32_t e : c.connectivity.elements(kind, node))
      half = std::max(half, 0.5 * gap_thickness(c.model, kind, e));
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = c.model.family(kind);
    for (const std::uint32_t e : c.connectivity.elements(kind, node)) {
      const NodeIndex* n = family.of(e);
      if (n[0] != node && n[1] != node) continue;  // a beam's third node only orients it
      const double part = part_thickness(c.model, kind, e);
      if (part > 0)
        half = std::max(half, 0.5 * part);
      else if (kind != ElementKind::spring)
        half = std::max(half, 0.5 * section_thickness(c.model, kind, e));
    }
  }
  return half;
}

struct DefaultGap {
  double value = 0;
  GapminOrigin origin = GapminOrigin::solid_edge;
};

DefaultGap default_gapmin(const Contact& contact, bool variable) {
  double sum = 0, smallest = std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  for (const MainSegment& m : contact.main) {
    if (m.carrier != Carrier::shell4 && m.carrier != Carrier::shell3) continue;
    const double t = variable ? contact.gap_scale * m.thickness : m.thickness;
    sum += t;
    smallest = std::min(smallest, t);
    ++count;
  }
  const double l = std::isfinite(contact.shortest_side) ? contact.shortest_side : 0;
  if (count == 0) return {0.1 * l, GapminOrigin::solid_edge};
  const double t = variable ? smallest : sum / static_cast<double>(count);
  const GapminOrigin origin = !variable                ? GapminOrigin::mean_thickness
                              : contact.gap_scale != 1 ? GapminOrigin::scaled_thickness
                                                       : GapminOrigin::minimum_thickness;
  return 0.5 * l < t ? DefaultGap{0.5 * l, GapminOrigin::half_edge} : DefaultGap{t, origin};
}

}  // namespace

void set_gaps(SceneContext& c, Contact& contact, double gapmin_input) {
  const Coordinates& x = c.scene.coordinates;
  const bool variable = contact.igap != 0;
  const double scale = contact.igap >= 2 ? contact.gap_scale : 1;
  contact.gap_scale = scale;
  double shortest = std::numeric_limits<double>::infinity();
  double thickest_main = 0, thickest_node = 0, longest_main = 0, longest_node = 0;
  for (MainSegment& m : contact.main) {
    const double side = shortest_side(x, m.nodes);
    shortest = std::min(shortest, side);
    const bool shell = m.carrier == Carrier::shell4 || m.carrier == Carrier::shell3;
    if (shell && m.element != no_index)
      m.thickness = gap_thickness(
          c.model, m.carrier == Carrier::shell4 ? ElementKind::shell4 : ElementKind::shell3,
          m.element);
    if (variable && shell) m.gap = scale * 0.5 * m.thickness;
    if (contact.igap == 3) {
      double l = side;
      for (const NodeIndex n : m.nodes) l = std::min(l, shortest_line_element(c, n));
      m.length = contact.mesh_fraction * std::min(l, never);
      longest_main = std::max(longest_main, m.length);
    }
    thickest_main = std::max(thickest_main, m.gap);
  }
  contact.shortest_side = std::isfinite(shortest) ? shortest : 0;
  if (gapmin_input > 0) {
    contact.gapmin = gapmin_input;
    contact.gapmin_origin = GapminOrigin::card;
  } else {
    const DefaultGap d = default_gapmin(contact, variable && contact.type != 10);
    contact.gapmin = d.value;
    contact.gapmin_origin = d.origin;
  }
  std::vector<double> node_length;
  if (contact.igap == 3) {
    node_length.assign(x.x.size(), never);
    for (const MainSegment& m : contact.main)
      for (const NodeIndex n : m.nodes) node_length[n] = std::min(node_length[n], m.length);
  }
  for (SecondaryNode& s : contact.secondary) {
    if (variable) s.gap = scale * node_half_thickness(c, s.node);
    if (contact.igap == 3) {
      s.length = node_length[s.node];
      longest_node = std::max(longest_node, s.length);
    }
    thickest_node = std::max(thickest_node, s.gap);
  }
  contact.gap_rule = PairGap::from_igap(contact.igap, contact.gapmin, contact.gapmax);
  double sum = thickest_main + thickest_node;
  if (contact.igap == 3) sum = std::min(sum, longest_main + longest_node);
  contact.max_gap =
      variable ? std::min(std::max(sum, contact.gapmin), contact.gapmax) : contact.gapmin;
}

void set_edge_gaps(SceneContext& c, Contact& contact, double gapmin_input) {
  const Coordinates& x = c.scene.coordinates;
  const bool variable = contact.igap != 0;
  double side_default[2] = {0, 0};
  double side_gap[2] = {0, 0};
  double shortest_of_both = std::numeric_limits<double>::infinity();
  std::vector<ContactEdge>* const sides[2] = {&contact.main_edges, &contact.secondary_edges};
  for (int s = 0; s < 2; ++s) {
    double shortest = std::numeric_limits<double>::infinity();
    double sum = 0, smallest = std::numeric_limits<double>::infinity();
    std::size_t samples = 0;
    const auto sample = [&](double t) {
      sum += t;
      smallest = std::min(smallest, t);
      ++samples;
    };
    for (ContactEdge& e : *sides[s]) {
      const double l = distance(x, e.nodes[0], e.nodes[1]);
      if (l > 0) shortest = std::min(shortest, l);
      // An edge that is both a shell side and a truss or beam counts twice.
      if (e.shell > 0) sample(e.shell);
      if (e.section > 0) sample(e.section);
      if (variable) e.gap = 0.5 * std::max(e.shell, e.section);
      if (contact.igap == 3) {
        double limit = l;
        for (const NodeIndex n : e.nodes) limit = std::min(limit, shortest_line_element(c, n));
        e.length = contact.mesh_fraction * limit;
      }
      side_gap[s] = std::max(side_gap[s], e.gap);
    }
    const double half = 0.5 * (std::isfinite(shortest) ? shortest : 0);
    if (samples == 0)
      side_default[s] = 0.2 * half;
    else
      side_default[s] = std::min(half, variable ? smallest : sum / static_cast<double>(samples));
    shortest_of_both = std::min(shortest_of_both, shortest);
  }
  contact.shortest_side = std::isfinite(shortest_of_both) ? shortest_of_both : 0;
  if (gapmin_input > 0) {
    contact.gapmin = gapmin_input;
    contact.gapmin_origin = GapminOrigin::card;
  } else {
    contact.gapmin = 0.5 * (side_default[0] + side_default[1]);
    contact.gapmin_origin = GapminOrigin::both_sides;
  }
  contact.gap_rule =
      PairGap::from_igap(contact.igap, contact.gapmin, std::numeric_limits<double>::infinity());
  contact.max_gap = std::max(side_gap[0] + side_gap[1], contact.gapmin);
}

void set_radiation_distance(Contact& contact, bool thermal, double drad_input) {
  if (!thermal) return;
  contact.drad = drad_input == 0 ? std::max(contact.max_gap, contact.shortest_side)
                                 : std::max(drad_input, contact.max_gap);
}

}  // namespace deck::detail
