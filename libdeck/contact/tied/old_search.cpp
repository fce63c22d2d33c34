// Old search of ties (Isearch 1): every node gets a segment at its nearest main node, at any
// distance. Cost: n log n for sorting main nodes along x, then a walk outwards per node.
#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <map>

#include "contact/shared/tie_steps.hpp"

namespace deck::detail {
namespace {

struct MainNodes {
  std::vector<NodeIndex> nodes;  ///< ascending
  std::map<NodeIndex, std::vector<std::uint32_t>> segments;
};

MainNodes main_nodes(const Tie& tie) {
  MainNodes out;
  for (std::uint32_t m = 0; m < tie.main.size(); ++m)
    for (std::size_t k = 0; k < (is_triangle(tie.main[m]) ? 3U : 4U); ++k)
      out.segments[tie.main[m][k]].push_back(m);
  for (const auto& [node, unused] : out.segments) out.nodes.push_back(node);
  return out;
}

/// Nearest main nodes, searched outwards along x from the position of the node.
class NearestNodes {
 public:
  NearestNodes(const Coordinates& x, const std::vector<NodeIndex>& nodes) : x_(x) {
    for (std::uint32_t i = 0; i < nodes.size(); ++i) along_.push_back({x.x[nodes[i]], i, nodes[i]});
    std::sort(along_.begin(), along_.end());
  }
  /// Among equally near ones the last.
  std::pair<NodeIndex, double> of(const Vec& p) const {
    const SortedNode* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](const SortedNode& e) {
      const double dx = e.x - p.x;
      if (dx * dx > least) return false;
      const Vec d = at(x_, e.node) - p;
      const double far = dot(d, d);
      if (far < least || (far == least && (best == nullptr || best->order < e.order))) {
        least = far;
        best = &e;
      }
      return true;
    };
    const auto middle = std::lower_bound(along_.begin(), along_.end(), SortedNode{p.x, 0, 0});
    for (auto up = middle; up != along_.end() && look(*up); ++up) {
    }
    for (auto down = middle; down != along_.begin() && look(*std::prev(down)); --down) {
    }
    return {best->node, least};
  }

 private:
  struct SortedNode {
    double x;
    std::uint32_t order;  ///< among all main nodes
    NodeIndex node;
    auto operator<=>(const SortedNode&) const = default;
  };
  const Coordinates& x_;
  std::vector<SortedNode> along_;
};

/// Smallest barycentric weight of p in the triangle at corner k of a segment.
double smallest_weight(const Coordinates& x, const Corners& c, std::size_t k, const Vec& p) {
  const std::size_t corners = is_triangle(c) ? 3 : 4;
  const Vec a = at(x, c[k]), b = at(x, c[(k + 1) % corners]);
  const Vec d = at(x, c[(k + corners - 1) % corners]);
  const Vec n = cross(b - a, d - a);
  const double area = dot(n, n);
  if (area == 0) return -1;
  const double wb = dot(n, cross(p - a, d - a)) / area, wd = dot(n, cross(b - a, p - a)) / area;
  return std::min({1 - wb - wd, wb, wd});
}

/// Position of p on a segment as a ratio of areas around its centre.
void set_place(const Coordinates& x, const Corners& c, const Vec& p, TiedNode& out) {
  const Vec centre = 0.25 * (at(x, c[0]) + at(x, c[1]) + at(x, c[2]) + at(x, c[3]));
  Vec a[4], sum;
  for (std::size_t k = 0; k < 4; ++k) {
    a[k] = cross(at(x, c[k]) - centre, at(x, c[(k + 1) % 4]) - centre);
    sum = sum + a[k];
  }
  const double size = norm(sum);
  if (size <= 1e-19) return;  // solver error 85
  const Vec n = unit(sum);
  double whole[4], part[4];
  for (std::size_t k = 0; k < 4; ++k) {
    whole[k] = dot(n, a[k]);
    part[k] = dot(n, cross(at(x, c[k]) - p, at(x, c[(k + 1) % 4]) - p));
  }
  const double below = whole[1] * part[3] + part[1] * whole[3];
  if (std::fabs(below) / (0.5 * size) > 1e-10)
    out.s = (whole[1] * part[3] - part[1] * whole[3]) / below;
  if (!is_triangle(c)) {
    const double t = part[0] * whole[2] + whole[0] * part[2];
    if (t != 0) out.t = (part[0] * whole[2] - whole[0] * part[2]) / t;
  } else if (whole[0] != 0) {
    out.t = (part[0] - whole[0]) / whole[0];
    const double near = 0.02 * whole[0];
    const auto on = [&](double v) { return v <= 0 && v >= -near; };
    if (on(part[1]) && on(part[3]))
      out.s = 0;
    else if (on(part[1]))
      out.s = 1;
    else if (on(part[3]))
      out.s = -1;
  }
  constexpr double outside = 1.02;
  if (std::fabs(out.s) > outside || std::fabs(out.t) > outside) return;
  out.s = std::clamp(out.s, -1.0, 1.0);
  out.t = std::clamp(out.t, -1.0, 1.0);
}

}  // namespace

void search_ties_by_nearest_node(const Coordinates& x, Tie& tie) {
  const MainNodes main = main_nodes(tie);
  if (main.nodes.empty()) return;
  const NearestNodes all(x, main.nodes);
  for (TiedNode& n : tie.nodes) {
    const Vec p = at(x, n.node);
    auto [nearest, least] = all.of(p);
    const auto look = [&, &nearest = nearest, &least = least](NodeIndex m) {
      const Vec d = at(x, m) - p;
      if (const double far = dot(d, d); far <= least) {
        nearest = m;
        least = far;
      }
    };
    const std::vector<std::uint32_t>& around = main.segments.at(nearest);
    for (const std::uint32_t m : around)
      for (const NodeIndex corner : tie.main[m]) look(corner);
    double best = 0;
    for (const std::uint32_t m : main.segments.at(nearest)) {
      const Corners& c = tie.main[m];
      const auto k = static_cast<std::size_t>(std::find(c.begin(), c.end(), nearest) - c.begin());
      const double weight = smallest_weight(x, c, k, p);
      if (n.segment == no_index || weight > best) {
        n.segment = m;
        best = weight;
      }
      if (weight >= 0) break;
    }
    n.tied = true;
    set_place(x, tie.main[n.segment], p, n);
    Vec foot;
    const double w[] = {(1 - n.s) * (1 - n.t) / 4, (1 + n.s) * (1 - n.t) / 4,
                        (1 + n.s) * (1 + n.t) / 4, (1 - n.s) * (1 + n.t) / 4};
    for (std::size_t k = 0; k < 4; ++k) foot = foot + w[k] * at(x, tie.main[n.segment][k]);
    n.distance = norm(p - foot);
  }
}

}  // namespace deck::detail
