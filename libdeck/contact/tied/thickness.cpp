// Thicknesses of nodes and segments of a tie; chooses among their elements as the solver does.
#include <algorithm>

#include "contact/shared/tie_steps.hpp"
#include "model/shared/faces.hpp"

namespace deck::detail {
namespace {

/// Slot of the node in the element.
int corner_of(const Elements& family, std::uint32_t e, NodeIndex node) {
  int corner = -1;
  for (int k = 0; k < family.width; ++k)
    if (family.of(e)[k] == node) corner = k;
  return corner;
}

double property_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  const std::uint32_t part = model.family(kind).part[e];
  if (part == no_index || model.parts[part].prop == no_index) return 0;
  return model.properties[model.parts[part].prop].thickness;
}

/// Part, own, property thickness: the first that is not 0.
double shell_thickness_of(const Model& model, ElementKind kind, std::uint32_t e) {
  if (const double t = part_thickness(model, kind, e); t != 0) return t;
  const Elements& family = model.family(kind);
  if (e < family.thickness.size() && family.thickness[e] != 0) return family.thickness[e];
  return property_thickness(model, kind, e);
}

}  // namespace

const ElementOrder& TieThickness::order() {
  if (order_ == nullptr)
    order_ = std::make_unique<ElementOrder>(element_order(c_.model, c_.connectivity));
  return *order_;
}

double TieThickness::of_node(NodeIndex node) {
  for (const ElementKind kind : {ElementKind::shell3, ElementKind::shell4}) {
    const auto around = c_.connectivity.elements(kind, node);
    if (around.empty()) continue;
    const Elements& family = c_.model.family(kind);
    std::uint32_t best = around.front();
    int place = corner_of(family, best, node);
    for (const std::uint32_t e : around.subspan(1)) {
      const int here = corner_of(family, e, node);
      if (here < place) continue;
      if (here == place) {
        const auto& rank = kind == ElementKind::shell4 ? order().shell4 : order().shell3;
        if (rank[e] < rank[best]) continue;
      }
      best = e;
      place = here;
    }
    return shell_thickness_of(c_.model, kind, best);
  }
  return 0;
}

std::pair<double, double> TieThickness::range_at(NodeIndex node) {
  for (const ElementKind kind : {ElementKind::shell3, ElementKind::shell4}) {
    const auto around = c_.connectivity.elements(kind, node);
    if (around.empty()) continue;
    double least = shell_thickness_of(c_.model, kind, around.front()), most = least;
    for (const std::uint32_t e : around.subspan(1)) {
      const double t = shell_thickness_of(c_.model, kind, e);
      least = std::min(least, t);
      most = std::max(most, t);
    }
    return {least, most};
  }
  return {0, 0};
}

/// The solver reads the own thickness of a 3-node shell from a list that begins with all 4-node
/// shells: usually it gets that of another shell.
double TieThickness::widening_thickness(ElementKind kind, std::uint32_t e) {
  const Model& m = c_.model;
  if (kind == ElementKind::shell4) return shell_thickness_of(m, kind, e);
  if (const double t = part_thickness(m, kind, e); t != 0) return t;
  if (!own_listed_) list_own_thicknesses();
  const double t = own_.empty() ? 0 : own_[order().shell3[e]];
  return t != 0 ? t : property_thickness(m, kind, e);
}

void TieThickness::list_own_thicknesses() {
  own_listed_ = true;
  const Elements& quads = c_.model.shell4;
  const Elements& triangles = c_.model.shell3;
  const auto has_some = [](const Elements& f) {
    return std::any_of(f.thickness.begin(), f.thickness.end(), [](double t) { return t != 0; });
  };
  if (!has_some(quads) && !has_some(triangles)) return;
  own_.resize(quads.size() + triangles.size());
  for (std::uint32_t e = 0; e < quads.thickness.size(); ++e)
    own_[order().shell4[e]] = quads.thickness[e];
  for (std::uint32_t e = 0; e < triangles.thickness.size(); ++e)
    own_[quads.size() + order().shell3[e]] = triangles.thickness[e];
}

double TieThickness::largest_at(const std::vector<NodeIndex>& nodes) {
  double largest = 0;
  for (const NodeIndex n : nodes)
    for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3})
      for (const std::uint32_t e : c_.connectivity.elements(kind, n))
        largest = std::max(largest, widening_thickness(kind, e));
  return largest;
}

double TieThickness::of_segment(const Corners& segment, bool solids) {
  const Model& m = c_.model;
  const auto best_shell = [&](ElementKind kind) {
    std::uint32_t best = no_index;
    const Elements& family = m.family(kind);
    for (const std::uint32_t e : c_.connectivity.elements(kind, segment[0])) {
      if (!contains_all(family.of(e), family.width, segment)) continue;
      if (best == no_index) {
        best = e;
        continue;
      }
      const double t = property_thickness(m, kind, e), than = property_thickness(m, kind, best);
      const double y = young_of(m, kind, e), young = young_of(m, kind, best);
      if (t < than || (t == than && y < young)) continue;
      if (t == than && y == young) {
        const auto& rank = kind == ElementKind::shell4 ? order().shell4 : order().shell3;
        const auto place = [&](std::uint32_t i) {
          return std::pair(corner_of(family, i, segment[0]), rank[i]);
        };
        const bool last = kind == ElementKind::shell3;  // 4-node shells: the first
        if (last ? place(e) < place(best) : place(best) < place(e)) continue;
      }
      best = e;
    }
    return best;
  };
  if (is_triangle(segment))
    if (const std::uint32_t e = best_shell(ElementKind::shell3); e != no_index)
      return shell_thickness_of(m, ElementKind::shell3, e);
  if (const std::uint32_t e = best_shell(ElementKind::shell4); e != no_index)
    return shell_thickness_of(m, ElementKind::shell4, e);
  if (!solids) return 0;
  std::uint32_t solid = no_index;
  for (const std::uint32_t e : c_.connectivity.elements(ElementKind::solid8, segment[0])) {
    const SolidShape shape = m.solid8.shape[e];
    if (shape != SolidShape::brick8 && shape != SolidShape::tetra4 && shape != SolidShape::penta6)
      continue;
    if (!contains_all(m.solid8.of(e), 8, segment)) continue;
    if (solid == no_index || m.solid8.id[e] > m.solid8.id[solid]) solid = e;
  }
  if (solid == no_index) return 0;
  const Coordinates& x = c_.scene.coordinates;
  const double area = 0.5 * norm(cross(at(x, segment[2]) - at(x, segment[0]),
                                       at(x, segment[3]) - at(x, segment[1])));
  return solid_volume(x, m.solid8.of(solid)) / area;
}

}  // namespace deck::detail
