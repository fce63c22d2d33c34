// TYPE25, Iedge of two digits: edges that pass through segments of solids, beside which of their
// sides, and how deep.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/shared/parallel.hpp"
#include "contact/modern/parts.hpp"
#include "contact/search/sweep.hpp"

namespace deck::detail::modern {
namespace {

/// The nearest points of an edge and a side of a segment.
struct Meeting25 {
  double on_edge = 0, on_side = 0;  ///< weights of the first ends
  Vec apart;                        ///< from the side to the edge
};

/// False: on the straight lines they lie beyond the ends by more than the solver takes.
bool meet_lines(const std::array<Vec, 2>& s, const std::array<Vec, 2>& m, Meeting25& out) {
  const auto refused = [](double h) { return !(h >= -0.001 && h <= 1.03); };
  const auto clamped = [](double h) { return std::max(0.0, std::min(1.0, h)); };
  const Vec u = s[0] - s[1], v = m[0] - m[1], w = s[1] - m[1];
  const double uu = std::max(1e-30, dot(u, u)), vv = std::max(1e-30, dot(v, v)), uv = dot(u, v);
  const double det = std::max(1e-20, uu * vv - uv * uv);
  double h_m = (uu * dot(v, w) - uv * dot(u, w)) / det;
  if (refused(h_m)) return false;
  h_m = clamped(h_m);
  double h_s = (h_m * uv - dot(u, w)) / uu;
  if (refused(h_s)) return false;
  h_s = clamped(h_s);
  h_m = clamped((h_s * uv + dot(v, w)) / vv);
  out = {h_s, h_m, (s[1] + h_s * u) - (m[1] + h_m * v)};
  return true;
}

class ThroughSolids {
 public:
  ThroughSolids(const Coordinates& x, const Sides& s, const Topology& t,
                const std::vector<SideEdge>& edges)
      : x_(x), s_(s), t_(t), edges_(edges) {}

  /// Adds the sides of a segment that an edge passes through.
  void add(std::uint32_t edge, std::uint32_t face, std::vector<EdgeThroughSegment>& out) const {
    const SideEdge& e = edges_[edge];
    const Face& f = s_.faces[face];
    if (!s_.across(e.bits, f.bits)) return;
    for (const NodeIndex n : e.nodes)
      if (std::find(f.nodes.begin(), f.nodes.end(), n) != f.nodes.end()) return;
    std::array<Vec, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = at(x_, f.nodes[k]);
    const std::array<Vec, 2> ends{at(x_, e.nodes[0]), at(x_, e.nodes[1])};
    if (!boxes_meet(e, f, p, ends)) return;
    const Vec centre = f.triangle() ? p[2] : 0.25 * (p[0] + p[1] + p[2] + p[3]);
    // A triangle has its first facet only.
    for (std::uint32_t k = 0; k < (f.triangle() ? 1U : 4U); ++k) {
      const std::array<Vec, 2> side{p[k], p[(k + 1) % 4]};
      Meeting25 m;
      if (!meet_lines(ends, side, m)) continue;
      const Vec facet = cross(side[0] - centre, side[1] - centre);
      double depth = norm(m.apart);
      if (e.kind == 1 ? !behind_each_other(e, face, k, ends, side, m, depth)
                      : !inside(f, face, k, p, centre, facet, m.apart))
        continue;
      if (crosses(centre, side, facet, ends))
        out.push_back({edge, face, static_cast<int>(k + 1), depth});
    }
  }

 private:
  /// In the axes of the segment.
  bool boxes_meet(const SideEdge& e, const Face& f, const std::array<Vec, 4>& p,
                  const std::array<Vec, 2>& ends) const {
    const Vec up = unit_of(cross(p[2] - p[0], p[3] - p[1]));
    const Vec first = p[1] - p[0], along = unit_of(first - dot(first, up) * up);
    double gap = e.gap;
    if (s_.set.local()) gap = std::min(gap, f.length + e.length);
    for (const Vec& axis : {along, cross(up, along), up}) {
      double low = dot(axis, p[0]), high = low;
      for (const Vec& q : p) low = std::min(low, dot(axis, q)), high = std::max(high, dot(axis, q));
      const double by = 0.02 * (high - low) + gap + s_.margin;
      const double a = dot(axis, ends[0]), b = dot(axis, ends[1]);
      if (std::max(a, b) < low - by || std::min(a, b) > high + by) return false;
    }
    return true;
  }

  /// An edge of solids: the two lie behind one another, seen along the normals of both.
  bool behind_each_other(const SideEdge& e, std::uint32_t face, std::uint32_t k,
                         const std::array<Vec, 2>& ends, const std::array<Vec, 2>& side,
                         const Meeting25& m, double& depth) const {
    const Vec s = unit_of(ends[1] - ends[0]), d = unit_of(side[1] - side[0]);
    if (std::fabs(dot(s, d)) > 0.999) return false;
    const Vec across = unit_of(cross(s, d));
    const Vec apart = dot(m.apart, across) * across;
    depth = norm(apart);
    const Vec normal_m = between(t_.normal(face, k), t_.normal(face, (k + 1) % 4), m.on_side);
    const std::uint32_t next = (e.side + 1) % 4;
    const bool forward = s_.nodes_of(e.face)[e.side] == e.nodes[0];
    const Vec normal_s = between(t_.normal(e.face, forward ? e.side : next),
                                 t_.normal(e.face, forward ? next : e.side), m.on_edge);
    const double on_m = dot(apart, normal_m), on_s = -dot(apart, normal_s);
    return on_m <= 1e-4 * depth && on_s <= 1e-4 * depth && std::fabs(on_m) > 0.2 * depth &&
           std::fabs(on_s) > 0.2 * depth;
  }
  static Vec between(const Vec& first, const Vec& second, double weight) {
    return weight * first + (1 - weight) * second;
  }

  /// Another edge: within the angle of the two facets at the side.
  bool inside(const Face& f, std::uint32_t face, std::uint32_t k, const std::array<Vec, 4>& p,
              const Vec& centre, const Vec& facet, const Vec& apart) const {
    const Vec beta = t_.direction(face, k), a = -1.0 * facet;
    const Vec b = (2 * dot(a, beta)) * beta - a;
    const Vec other = f.triangle() ? p[(k + 2) % 4] : centre;
    const bool in_a = dot(apart, a) > 0, in_b = dot(apart, b) > 0;
    return dot(other - p[k], b) >= 0 ? in_a && in_b : in_a || in_b;
  }

  static bool crosses(const Vec& centre, const std::array<Vec, 2>& side, const Vec& facet,
                      const std::array<Vec, 2>& ends) {
    const double a = dot(facet, ends[0] - centre), b = dot(facet, ends[1] - centre);
    if (!(a * b <= 0) || a == b) return false;
    const Vec q = ends[0] + (a / (a - b)) * (ends[1] - ends[0]) - centre;
    const double size = std::max(1e-30, dot(facet, facet));
    const double first = dot(facet, cross(q, side[1] - centre)) / size;
    const double second = dot(facet, cross(side[0] - centre, q)) / size;
    return first >= -0.1 && second >= -0.1 && first + second <= 1.01;
  }

  const Coordinates& x_;
  const Sides& s_;
  const Topology& t_;
  const std::vector<SideEdge>& edges_;
};

}  // namespace

std::vector<EdgeThroughSegment> edges_through_solids(const SceneContext& c, const Sides& s,
                                                     const Topology& t,
                                                     const std::vector<SideEdge>& edges) {
  std::vector<EdgeThroughSegment> out;
  const Coordinates& x = c.scene.coordinates;
  const NodeArrays nodes{x.x, x.y, x.z};
  const int threads = effective_threads(c.options.threads);
  // An edge passes through a facet within a tenth of its size.
  const auto box_of = [&](std::uint32_t i) {
    Box box;
    for (const NodeIndex n : s.faces[i].nodes)
      box.add({{x.x[n], x.y[n], x.z[n]}, {x.x[n], x.y[n], x.z[n]}});
    const double by = 0.25 * box.size();
    for (std::size_t k = 0; k < 3; ++k) box.low[k] -= by, box.high[k] += by;
    return box;
  };
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < s.faces.size(); ++i)
    if (s.faces[i].kind == SegmentKind::solid && !s.faces[i].interior && s.faces[i].stiffness != 0)
      order.push_back(i);
  if (order.empty()) return out;
  sweep::put_in_order(order, box_of, threads);
  constexpr std::size_t width = BoxBlock::width, at_once = 512;
  std::vector<BoxBlock> blocks((order.size() + width - 1) / width);
  for (std::size_t i = 0; i < order.size(); ++i) blocks[i / width].set(i % width, box_of(order[i]));
  const BoxTree tree(std::move(blocks), threads);
  const ThroughSolids rule(x, s, t, edges);
  std::vector<Box> boxes;
  std::vector<sweep::Meeting> near;
  for (std::size_t first = 0; first < edges.size(); first += at_once) {
    boxes.clear();
    near.clear();
    for (std::size_t i = first; i < std::min(edges.size(), first + at_once); ++i)
      boxes.push_back(sweep::edge_box(nodes, edges[i].nodes, 0));
    sweep::kernels().meetings(tree, boxes, near);
    for (const sweep::Meeting& m : near)
      if (const auto edge = static_cast<std::uint32_t>(first + m.box); edges[edge].kind >= 1)
        rule.add(edge, order[m.leaf], out);
  }
  std::sort(out.begin(), out.end(), [](const EdgeThroughSegment& a, const EdgeThroughSegment& b) {
    return std::tie(a.edge, a.main, a.side) < std::tie(b.edge, b.main, b.side);
  });
  return out;
}

}  // namespace deck::detail::modern
