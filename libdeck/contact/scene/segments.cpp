// Main segments from surface segments: repaired, oriented outward, with their carriers.
#include <algorithm>

#include "base/shared/parallel.hpp"
#include "contact/shared/scene_steps.hpp"
#include "model/shared/faces.hpp"

namespace deck::detail {
namespace {

using Quad = std::array<NodeIndex, 4>;

bool solid_contains(const Model& model, std::uint32_t e, const Quad& segment) {
  const Elements& solids = model.solid8;
  if (contains_all(solids.of(e), 8, segment)) return true;
  // Segments may have mid-side nodes of quadratic solids.
  if (e >= solids.extra.size() || solids.extra[e] == no_index) return false;
  NodeIndex all[20];
  int count = 0;
  for (int i = 0; i < 8; ++i) all[count++] = solids.of(e)[i];
  for (int i = 0; i < extra_node_count(solids.shape[e]); ++i)
    all[count++] = solids.extra_nodes[solids.extra[e] + static_cast<std::uint32_t>(i)];
  return contains_all(all, count, segment);
}

/// True if a solid has all nodes of a quadrangle but not as a face: solids overlap there.
bool inside_a_solid(SceneContext& c, const SolidsOfSegment& having, const Quad& segment) {
  if (having.count == 0 || segment[2] == segment[3]) return false;
  const Elements& solids = c.model.solid8;
  const auto inside = [&](std::uint32_t e) {
    return contains_all(solids.of(e), 8, segment) && !has_face_of(solids.of(e), segment);
  };
  if (having.count <= 2) return inside(having.first) || inside(having.last);
  const auto& around = c.connectivity.elements(ElementKind::solid8, segment[0]);
  return std::any_of(around.begin(), around.end(), inside);
}

/// True if the area is 0 or opposite corners have opposite normals (solver error 558).
bool degenerate(const Coordinates& c, const Quad& n) {
  Vec mean;
  for (const NodeIndex i : n) mean = mean + at(c, i);
  mean = 0.25 * mean;
  Vec r[4];
  for (std::size_t i = 0; i < 4; ++i) r[i] = at(c, n[i]) - mean;
  const Vec a1 = cross(r[0], r[1]), a2 = cross(r[1], r[2]);
  const Vec a3 = n[2] == n[3] ? Vec{} : cross(r[2], r[3]);
  const Vec a4 = cross(r[3], r[0]);
  const Vec sum = a1 + a2 + a3 + a4;
  return dot(sum, a1) == 0 && dot(sum, a3) == 0;
}

/// A range of main segments with its findings: positions in `main`.
struct Piece {
  std::vector<Segment> room;
  std::vector<MainSegment> main;
  std::vector<std::uint32_t> degenerate, no_carrier, crowded, inside_solids;
  int repaired = 0, reoriented = 0;

  void clear() {
    for (auto* list : {&degenerate, &no_carrier, &crowded, &inside_solids}) list->clear();
    main.clear();
    repaired = reoriented = 0;
  }
};

void add_segment(SceneContext& c, int type, const Segment& segment, Piece& out) {
  MainSegment m;
  m.nodes = segment.nodes;
  m.carrier = segment.carrier;
  m.element = segment.element;
  if (std::find(m.nodes.begin(), m.nodes.end(), no_index) != m.nodes.end()) return;
  const auto here = static_cast<std::uint32_t>(out.main.size());
  out.repaired += repair(m.nodes);
  bool outward = false, inside = false;
  std::uint32_t solid = m.element;
  if (segment.carrier == Carrier::none) {
    const SolidsOfSegment found = solids_of(c, m.nodes);
    solid = found.best;
    outward = found.count == 1;
    if (found.count > 2) out.crowded.push_back(here);
    if (found.best != no_index) {
      m.carrier = Carrier::solid;
      m.element = found.best;
    }
    if (const ShellOfSegment shell = shell_of(c, m.nodes); shell.element != no_index) {
      m.carrier = shell.kind == ElementKind::shell4 ? Carrier::shell4 : Carrier::shell3;
      m.element = shell.element;
    }
    if (m.carrier == Carrier::none) out.no_carrier.push_back(here);
  } else if (segment.carrier == Carrier::solid) {
    const SolidsOfSegment found = solids_of(c, m.nodes);
    outward = found.count == 1;
    inside = !outward && inside_a_solid(c, found, m.nodes);
  }
  if (inside) out.inside_solids.push_back(here);
  // The solver does not count faces that it made itself.
  if (outward && solid != no_index && orient_outward(c, solid, m.nodes))
    out.reoriented += segment.carrier == Carrier::none;
  if (type == 7 && degenerate(c.scene.coordinates, m.nodes)) out.degenerate.push_back(here);
  out.main.push_back(m);
}

/// Builds tables for add_segment(): threads only read them.
void prepare(SceneContext& c, const SegmentList& segments) {
  const auto any = [&](Carrier carrier) {
    return segments.find([&](const Segment& s) { return s.carrier == carrier; }).has_value();
  };
  if (segments.is_from_shells()) return;
  const bool plain = any(Carrier::none);
  if (plain || any(Carrier::solid)) c.connectivity.prepare(ElementKind::solid8);
  if (!plain) return;
  c.connectivity.prepare(ElementKind::shell4);
  c.connectivity.prepare(ElementKind::shell3);
}

}  // namespace

bool repair(std::array<NodeIndex, 4>& n) {
  if (n[0] == n[3]) {
    n[3] = n[2];
    return true;
  }
  if (n[1] == n[2]) {
    n[2] = n[3];
    return true;
  }
  if (n[0] == n[1]) {
    n = {n[0], n[2], n[3], n[3]};
    return true;
  }
  return false;
}

SolidsOfSegment solids_of(SceneContext& c, const std::array<NodeIndex, 4>& segment) {
  SolidsOfSegment found;
  const Elements& family = c.model.solid8;
  for (const std::uint32_t e : c.connectivity.elements(ElementKind::solid8, segment[0])) {
    if (!solid_contains(c.model, e, segment)) continue;
    if (found.count++ == 0) found.first = e;
    found.last = e;
    if (found.best == no_index || family.id[e] > family.id[found.best]) found.best = e;
  }
  return found;
}

ShellOfSegment shell_of(SceneContext& c, const std::array<NodeIndex, 4>& segment) {
  ShellOfSegment best;
  double thickness = 0, young = 0;
  const auto look = [&](ElementKind kind, bool last_wins) {
    const Elements& family = c.model.family(kind);
    for (const std::uint32_t e : c.connectivity.elements(kind, segment[0])) {
      if (!contains_all(family.of(e), family.width, segment)) continue;
      const double t = stiffness_thickness(c.model, kind, e);
      const double y = young_of(c.model, kind, e);
      const bool better = best.element == no_index || t > thickness ||
                          (t == thickness && (y > young || (last_wins && y == young)));
      if (!better) continue;
      best = {kind, e};
      thickness = t;
      young = y;
    }
  };
  if (segment[2] == segment[3]) look(ElementKind::shell3, true);
  if (best.element == no_index) look(ElementKind::shell4, false);
  return best;
}

bool orient_outward(SceneContext& c, std::uint32_t solid, std::array<NodeIndex, 4>& n) {
  const Coordinates& x = c.scene.coordinates;
  Vec centre, middle;
  const NodeIndex* slots = c.model.solid8.of(solid);
  if (std::find(slots, slots + 8, no_index) != slots + 8) return false;
  for (int i = 0; i < 8; ++i) centre = centre + at(x, slots[i]);
  for (const NodeIndex i : n) middle = middle + at(x, i);
  const Vec to_centre = 0.125 * centre - 0.25 * middle;
  const Vec normal = cross(at(x, n[2]) - at(x, n[0]), at(x, n[3]) - at(x, n[1]));
  // The solver reverses if the normal points to the centroid or sideways.
  if (dot(normal, to_centre) < 0) return false;
  if (n[2] == n[3])
    std::swap(n[0], n[1]);
  else
    n = {n[3], n[2], n[1], n[0]};
  return true;
}

void make_main_segments(SceneContext& c, const SegmentList& segments, Contact& contact) {
  const int threads = effective_threads(c.options.threads);
  constexpr std::size_t at_once = 1024;
  prepare(c, segments);
  contact.main.reserve(segments.size());
  run_in_order<Piece>((segments.size() + at_once - 1) / at_once, threads,
                      [&](std::size_t k, Piece& out) {
                        out.clear();
                        const std::size_t end = std::min(segments.size(), (k + 1) * at_once);
                        for (const Segment& segment : segments.some(k * at_once, end, out.room))
                          add_segment(c, contact.type, segment, out);
                      },
                      [&](std::size_t, Piece& in) {
                        const auto before = static_cast<std::uint32_t>(contact.main.size());
                        const auto append = [&](std::vector<std::uint32_t>& all,
                                                const std::vector<std::uint32_t>& some) {
                          for (const std::uint32_t i : some) all.push_back(before + i);
                        };
                        append(contact.degenerate, in.degenerate);
                        append(contact.no_carrier, in.no_carrier);
                        append(contact.crowded, in.crowded);
                        append(contact.inside_solids, in.inside_solids);
                        contact.repaired_segments += in.repaired;
                        contact.reoriented_segments += in.reoriented;
                        contact.main.insert(contact.main.end(), in.main.begin(), in.main.end());
                      });
  contact.degenerate_segments = static_cast<int>(contact.degenerate.size());
}

}  // namespace deck::detail
