// Gaps and stiffness of a TYPE24 or TYPE25: of secondary nodes and corners of segments, limits by
// the mesh, reach of the search.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/shared/parallel.hpp"
#include "contact/search/sweep.hpp"
#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

/// Calls use(a, b) for the sides of a segment with nonzero length.
template <class F>
void for_each_side(const Face& f, F&& use) {
  for (std::size_t k = 0; k < 4; ++k) {
    const NodeIndex a = f.nodes[k], b = f.nodes[(k + 1) % 4];
    if (a != b) use(a, b);
  }
}

/// Nodes on sides of exactly one segment before mirroring. The solver counts a triangle's first two
/// sides and its null side: the neighbour across the last side then has a border.
std::vector<std::uint8_t> border_nodes(const Sides& s, std::size_t nodes) {
  std::vector<std::pair<NodeIndex, NodeIndex>> sides;
  for (const Face& f : s.faces) {
    for (std::size_t k = 0; k < (f.triangle() ? 2 : 4); ++k) {
      const NodeIndex a = f.nodes[k], b = f.nodes[(k + 1) % 4];
      if (a != b) sides.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::uint8_t> border(nodes, 0);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end] == sides[i]) ++end;
    if (end == i + 1) border[sides[i].first] = border[sides[i].second] = 1;
    i = end;
  }
  return border;
}

/// TYPE24 treats one surface at a time, with two peculiarities of the solver's scan: of three equal
/// sides the third is a border, and comparing restarts after a null side.
void add_border24(const Sides& s, std::uint8_t bits, std::vector<std::uint8_t>& border) {
  std::vector<std::pair<NodeIndex, NodeIndex>> sides;
  for (const Face& f : s.faces) {
    if ((f.bits & bits) == 0) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = f.nodes[k], b = f.nodes[(k + 1) % 4];
      sides.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size();) {
    if (sides[i].first == sides[i].second) {
      ++i;
      continue;
    }
    if (i + 1 < sides.size() && sides[i + 1] == sides[i]) {
      i += 2;
      continue;
    }
    border[sides[i].first] = 1;
    border[sides[i].second] = 1;
    ++i;
  }
}

double shortest_side(const Coordinates& x, const Face& f) {
  double out = std::numeric_limits<double>::infinity();
  for_each_side(f, [&](NodeIndex a, NodeIndex b) { out = std::min(out, distance(x, a, b)); });
  return out;
}
double longest_side(const Coordinates& x, const Face& f) {
  double out = 0;
  for_each_side(f, [&](NodeIndex a, NodeIndex b) { out = std::max(out, distance(x, a, b)); });
  return out;
}

double area_of(const Coordinates& x, const Face& f) {
  return 0.5 *
         norm(cross(at(x, f.nodes[2]) - at(x, f.nodes[0]), at(x, f.nodes[3]) - at(x, f.nodes[1])));
}

void set_secondary_gaps(const GapInputs& around, const std::vector<double>& half, Sides& s) {
  const Settings& set = s.set;
  std::vector<std::uint8_t> on_sheet(half.size(), set.level == 3 ? 1 : 0);
  for (const Face& f : s.faces)
    if (f.kind != SegmentKind::solid)
      for (const NodeIndex n : f.nodes) on_sheet[n] = 1;
  const bool own = set.type == 25 && set.igap == 5 && set.thick_s > 0;
  const double scale = own ? set.thick_s_scale : set.scale;
  const Model& model = around.model;
  const bool lines = model.truss.size() + model.beam.size() + model.spring.size() > 0;
  for (SideNode& n : s.nodes) {
    double w = 0;
    if (on_sheet[n.node] != 0 && half[n.node] > 0) w = own ? 0.5 * set.thick_s : half[n.node];
    const double line = lines ? line_half_thickness(around, n.node) : 0;
    if (line > 0) w = std::max(w, own ? 0.5 * set.thick_s : line);
    n.gap = std::min(scale * w, set.cap_s);
  }
  if (set.level == 3 || (set.type == 25 ? set.igap0 != 1 : set.igap0 <= 0)) return;
  std::vector<std::uint8_t> border;
  if (set.type == 25) {
    border = border_nodes(s, half.size());
  } else {
    border.assign(half.size(), 0);
    add_border24(s, from_second, border);
    add_border24(s, from_first, border);
  }
  for (SideNode& n : s.nodes)
    if (border[n.node] != 0) n.gap = set.type == 25 ? 0 : 1e-20;
}

/// Gap of the corners of segments, by node.
void set_corner_gaps(const std::vector<double>& half, bool own, double scale, Sides& s) {
  const Settings& set = s.set;
  s.main_gap.resize(half.size());
  for (std::size_t n = 0; n < half.size(); ++n) {
    const double h = half[n] > 0 && own ? 0.5 * set.thick_m : half[n];
    s.main_gap[n] = std::min(std::max(0.0, scale * h), set.cap_m);
  }
  for (const Face& f : s.faces)
    if (f.kind == SegmentKind::solid)
      for (const NodeIndex n : f.nodes) s.main_gap[n] = 0;
}

void set_main_gaps(const Model& model, const std::vector<double>& half, Sides& s) {
  const Settings& set = s.set;
  const bool own = set.type == 25 && set.igap == 5 && set.thick_m > 0;
  const double scale = own ? set.thick_m_scale : set.scale;
  if (set.type == 25) set_corner_gaps(half, own, scale, s);
  for (Face& f : s.faces) {
    if (f.kind != SegmentKind::solid && f.element != no_index) {
      const double t = gap_thickness(model, *family_of_carrier(f.carrier), f.element);
      f.own_gap = scale * 0.5 * (own ? set.thick_m : t);
    }
    if (set.type == 24) {
      f.gap = std::min(f.own_gap, set.cap_m);
      continue;
    }
    f.gap = s.main_gap[f.nodes[0]];
    for (const NodeIndex n : f.nodes) f.gap = std::max(f.gap, s.main_gap[n]);
  }
}

/// Igap 3.
void set_lengths(const Coordinates& x, Sides& s) {
  const Settings& set = s.set;
  std::vector<double> at_node(x.x.size(), no_limit);
  for (Face& f : s.faces) {
    const double side = set.mesh_fraction * shortest_side(x, f);
    for (const NodeIndex n : f.nodes) at_node[n] = std::min(at_node[n], side);
    f.length = std::min(side, set.cap_m);  // of its opposite: 0
  }
  for (SideNode& n : s.nodes) n.length = std::min(at_node[n.node], set.cap_s);
}

double solid_stiffness(SceneContext& c, double f, double area, std::uint32_t solid) {
  const double volume = solid_volume(c, solid);
  return volume > 0 ? f * area * area * bulk_of(c.model, solid) / volume : 0;
}

double shell_stiffness(const Model& model, double f, ElementKind kind, std::uint32_t e) {
  return f * stiffness_thickness(model, kind, e) * young_of(model, kind, e);
}

/// Mean over the solids with all nodes of a segment.
double mean_solid_stiffness(SceneContext& c, double f, const Face& face, double area) {
  double sum = 0;
  int count = 0;
  const auto has_all = [&](const NodeIndex* slots) {
    return std::all_of(face.nodes.begin(), face.nodes.end(),
                       [&](NodeIndex n) { return std::find(slots, slots + 8, n) != slots + 8; });
  };
  for (const std::uint32_t e : c.connectivity.elements(ElementKind::solid8, face.nodes[0]))
    if (has_all(c.model.solid8.of(e))) {
      sum += solid_stiffness(c, f, area, e);
      ++count;
    }
  return count == 0 ? solid_stiffness(c, f, area, face.element) : sum / count;
}

void set_solid(SceneContext& c, const Settings& set, Face& face) {
  if (face.element == no_index) return;
  const double f = set.factor, area = area_of(c.scene.coordinates, face);
  if (!face.interior) {
    face.stiffness = solid_stiffness(c, f, area, face.element);
  } else {
    face.stiffness = -mean_solid_stiffness(c, f, face, area);
  }
  if (set.type == 24) return;
  if (const ShellOfSegment shell = shell_of(c, face.nodes); shell.element != no_index) {
    const double k = shell_stiffness(c.model, f, shell.kind, shell.element);
    face.stiffness = std::max(face.stiffness, k);
    if (f > 0 && face.stiffness > 0) face.interior = false;
  }
}

void set_sheet(SceneContext& c, const Settings& set, Face& face) {
  if (face.element == no_index) return;
  const double f = set.factor;
  double k = shell_stiffness(c.model, f, *family_of_carrier(face.carrier), face.element);
  face.back_stiffness = k;
  if (set.type == 25 && f < 0) k = std::max(f, k);
  if (face.kind == SegmentKind::coat && face.solid != no_index)
    k = std::max(k, solid_stiffness(c, f, area_of(c.scene.coordinates, face), face.solid));
  face.stiffness = k;
}

/// Search margin from the sides of all segments, mirrored ones included, summed in fixed order; and
/// the shortest side.
void set_margin(const Coordinates& x, int threads, Sides& s) {
  if (s.faces.empty()) return;
  const NodeArrays nodes{x.x, x.y, x.z};
  std::vector<std::array<double, 4>> sides(s.faces.size());
  std::vector<double> least(static_cast<std::size_t>(threads), no_limit);
  parallel_parts(threads, sides.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    double shortest = no_limit;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        const NodeIndex a = s.faces[i].nodes[k], b = s.faces[i].nodes[(k + 1) % 4];
        sides[i][k] = detail::edge_length(nodes, a, b);
        if (a != b) shortest = std::min(shortest, sides[i][k]);
      }
    least[part] = shortest;
  });
  s.shortest = *std::min_element(least.begin(), least.end());
  double sum = 0;
  for (const auto& of : sides)
    for (const double length : of) sum += length;
  for (const std::uint32_t i : s.mirrors)
    for (std::uint32_t k = 0; k < 4; ++k) sum += sides[i][mirrored_side(k)];
  s.margin = margin_of(sum, 4 * std::size_t{s.count()});
}

}  // namespace

void set_gaps(SceneContext& c, Sides& s) {
  const Coordinates& x = c.scene.coordinates;
  const GapInputs around{c.model, c.connectivity, *c.tables, x,
                         effective_threads(c.options.threads)};
  const std::vector<double>& half = shell_half_thickness(around);
  set_secondary_gaps(around, half, s);
  set_main_gaps(c.model, half, s);
  if (s.set.local()) set_lengths(x, s);
  if (s.set.type == 24)
    for (Face& f : s.faces)
      if (f.solid_like() && f.solid != no_index) {
        const double area = area_of(x, f);
        f.length = longest_side(x, f);
        if (area > 0) f.length = std::min(f.length, solid_volume(c, f.solid) / area);
      }
  double gap_s = 0, gap_m = 0, length_s = 0, length_m = 0;
  for (const Face& f : s.faces) {
    gap_m = std::max(gap_m, f.own_gap);
    length_m = std::max(length_m, f.length);
  }
  for (const SideNode& n : s.nodes) {
    gap_s = std::max(gap_s, n.gap);
    length_s = std::max(length_s, n.length);
  }
  s.largest = gap_s + gap_m;
  if (s.set.local()) s.largest = std::min(s.largest, length_s + length_m);
  set_margin(x, effective_threads(c.options.threads), s);
}

void set_stiffness(SceneContext& c, Sides& s) {
  for (Face& f : s.faces)
    f.kind == SegmentKind::solid ? set_solid(c, s.set, f) : set_sheet(c, s.set, f);
}

}  // namespace deck::detail::type24_25
