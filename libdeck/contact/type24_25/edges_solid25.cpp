// TYPE25, Iedge of two digits: edges that pass through segments of solids, the side of the segment
// next to them, and the depth.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "base/shared/parallel.hpp"
#include "contact/search/sweep.hpp"
#include "contact/shared/scene_steps.hpp"
#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

/// True if the edge certainly lies on one side of the facet, as most do.
bool stays_beside(const ThroughRule& r) {
  double size = std::max(largest_component(r.edge[0]), largest_component(r.edge[1]));
  for (const Vec& v : r.corner) size = std::max(size, largest_component(v));
  Vec centre = r.corner[2];
  if (!r.triangle) centre = 0.25 * (r.corner[0] + r.corner[1] + r.corner[2] + r.corner[3]);
  const Vec first = r.corner[r.side] - centre, second = r.corner[(r.side + 1) % 4] - centre;
  // Error of differences: 2^-50 of the coordinates; of the normal: that times the sides.
  const double sides = std::max(largest_component(first), largest_component(second)),
               off = 0x1p-43 * size * size * sides;
  const Vec normal = cross(first, second);
  const double a = dot(normal, r.edge[0] - centre), b = dot(normal, r.edge[1] - centre);
  return off > 0x1p-700 && size < 0x1p300 && ((a > off && b > off) || (a < -off && b < -off));
}

ThroughRule rule_of(const Coordinates& x, const Sides& s, const SideEdge& e, const Face& f) {
  ThroughRule r;
  r.edge = {at(x, e.nodes[0]), at(x, e.nodes[1])};
  for (std::size_t k = 0; k < 4; ++k) r.corner[k] = at(x, f.nodes[k]);
  r.triangle = f.triangle();
  r.gap = s.set.local() ? std::min(e.gap, f.length + e.length) : e.gap;
  r.margin = s.margin;
  r.of_solids = e.kind == 1;
  return r;
}

void set_directions(const Sides& s, const Topology& t, const SideEdge& e, std::uint32_t face,
                    ThroughRule& r) {
  const auto side = static_cast<std::uint32_t>(r.side);
  if (!r.of_solids) {
    r.beta = t.direction(face, side);
    return;
  }
  r.side_normal = {t.normal(face, side), t.normal(face, (side + 1) % 4)};
  const std::uint32_t next = (e.side + 1) % 4;
  const bool forward = s.nodes_of(e.face)[e.side] == e.nodes[0];
  r.edge_normal = {t.normal(e.face, forward ? e.side : next),
                   t.normal(e.face, forward ? next : e.side)};
}

class ThroughSolids {
 public:
  ThroughSolids(const Coordinates& x, const Sides& s, const Topology& t,
                const std::vector<SideEdge>& edges, Accuracy accuracy, DecisionReport& decisions)
      : x_(x), s_(s), t_(t), edges_(edges), accuracy_(accuracy), decisions_(decisions) {}

  /// Adds the sides of a segment next to which an edge passes through.
  void add(std::uint32_t edge, std::uint32_t face, std::vector<EdgeThroughSegment>& out) const {
    const SideEdge& e = edges_[edge];
    const Face& f = s_.faces[face];
    if (!s_.across(e.bits, f.bits)) return;
    for (const NodeIndex n : e.nodes)
      if (std::find(f.nodes.begin(), f.nodes.end(), n) != f.nodes.end()) return;
    ThroughRule r = rule_of(x_, s_, e, f);
    // A triangle has one facet.
    for (std::uint32_t k = 0; k < (f.triangle() ? 1U : 4U); ++k) {
      r.side = k;
      if (stays_beside(r)) continue;
      set_directions(s_, t_, e, face, r);
      const ThroughFigures found = decided(r);
      if (found.passes) out.push_back({edge, face, static_cast<int>(k + 1), found.depth});
    }
  }

 private:
  /// By the chosen accuracy; depth of the solver if it finds one, too.
  ThroughFigures decided(const ThroughRule& r) const {
    const ThroughFigures solver = evaluate_through(r);
    if (accuracy_ < Accuracy::robust || !is_finite(r)) return solver;
    ++decisions_.pairs;
    const bool figures = accuracy_ == Accuracy::exact || !solver.passes;
    std::uint64_t beyond_double = 0;
    const ThroughFigures exact = exact_through(r, figures, beyond_double);
    decisions_.fallback += beyond_double;
    decisions_.exact += beyond_double;
    if (exact.passes != solver.passes) ++decisions_.contact_differs;
    return exact.passes && !figures ? solver : exact;
  }

  const Coordinates& x_;
  const Sides& s_;
  const Topology& t_;
  const std::vector<SideEdge>& edges_;
  Accuracy accuracy_;
  DecisionReport& decisions_;
};

}  // namespace

ThroughRule through_rule(const Coordinates& x, const Sides& s, const Topology& t,
                         const SideEdge& edge, std::uint32_t face, std::uint32_t side) {
  ThroughRule r = rule_of(x, s, edge, s.faces[face]);
  r.side = side;
  set_directions(s, t, edge, face, r);
  return r;
}

ThroughFigures evaluate_through(const ThroughRule& rule) {
  const auto root = [](double v) { return std::sqrt(v); };
  ThroughFigures out;
  out.passes = ThroughSide<double, decltype(root)>(rule, root).passes(out.depth);
  return out;
}

std::vector<EdgeThroughSegment> edges_through_solids(const SceneContext& c, const Sides& s,
                                                     const Topology& t,
                                                     const std::vector<SideEdge>& edges,
                                                     DecisionReport& decisions) {
  std::vector<EdgeThroughSegment> out;
  const Coordinates& x = c.scene.coordinates;
  const NodeArrays nodes{x.x, x.y, x.z};
  const int threads = effective_threads(c.options.threads);
  // An edge may pass through a facet up to a tenth of its size beside it.
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
  constexpr std::size_t at_once = 512;
  const auto box_at = [&](std::size_t i) { return box_of(order[i]); };
  const BoxTree tree(order.size(), box_at, threads);
  const Accuracy accuracy = c.all_placed ? c.options.accuracy : Accuracy::reference;
  const ThroughSolids rule(x, s, t, edges, accuracy, decisions);
  std::vector<Box> boxes;
  std::vector<sweep::Meeting> near;
  for (std::size_t first = 0; first < edges.size(); first += at_once) {
    boxes.clear();
    near.clear();
    for (std::size_t i = first; i < std::min(edges.size(), first + at_once); ++i)
      boxes.push_back(sweep::box_of_nodes(nodes, edges[i].nodes, 0));
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

}  // namespace deck::detail::type24_25
