// Distance of a node from a main segment of a tie by the solver's formula: it decides the ties,
// even if it is not the true distance.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "contact/shared/tie_steps.hpp"

namespace deck::detail {
namespace {

constexpr double smallest = 1e-20;  // the solver's guard against division by zero

struct EdgeFoot {
  double at = 0;  ///< from the first end (0) to the second (1)
  double distance = 0;
};

EdgeFoot foot_on_edge(const Vec& p, const Vec& u, const Vec& v) {
  const Vec along = v - u;
  const double a = std::clamp(dot(p - u, along) / std::max(smallest, dot(along, along)), 0.0, 1.0);
  // The foot as a point of the model: its round-off decides between segments at the edge.
  const Vec foot = u + a * along;
  return {a, norm(p - foot)};
}

/// One sub-triangle with apex a: distance and the weights of b and c.
struct SubTriangle {
  double distance = 0, beta = 0, gamma = 0;
};

SubTriangle project_on_part(const Vec& p, const Vec& a, const Vec& b, const Vec& c, bool quad) {
  Vec n = cross(b - a, c - a);
  const double size = std::max(smallest, norm(n));
  n = {n.x / size, n.y / size, n.z / size};
  const double height = dot(n, p - a);
  const Vec foot = p - height * n;
  SubTriangle out;
  out.beta = dot(n, cross(c - foot, a - foot)) / size;
  out.gamma = dot(n, cross(a - foot, b - foot)) / size;
  const double alpha = 1 - out.beta - out.gamma;
  if (alpha < 0) {
    out.distance = foot_on_edge(p, b, c).distance;
  } else if (out.beta < 0) {
    const EdgeFoot e = foot_on_edge(p, c, a);
    out.distance = e.distance;
    if (quad) {
      out.beta = 0;
      out.gamma = 1 - e.at;
    }
  } else if (out.gamma < 0) {
    const EdgeFoot e = foot_on_edge(p, a, b);
    out.distance = e.distance;
    if (quad) {
      out.beta = e.at;
      out.gamma = 0;
    }
  } else {
    out.distance = std::fabs(height);
  }
  return out;
}

Projection on_triangle(const Vec& p, const std::array<Vec, 4>& x, double reach, bool weights) {
  const SubTriangle part = project_on_part(p, x[2], x[0], x[1], false);
  Projection out;
  out.depth = std::max(0.0, reach - part.distance);
  if (weights) {
    out.s = part.beta;
    out.t = part.gamma;
    return out;
  }
  constexpr double near_corner = 1e-10;
  out.t = 1 - 2 * part.beta - 2 * part.gamma;
  if (out.t < 1 - near_corner)
    out.s = (part.gamma - part.beta) / (part.gamma + part.beta);
  else if (part.beta < -near_corner)
    out.s = 2;
  else if (part.gamma < -near_corner)
    out.s = -2;
  return out;
}

Projection on_quad(const Vec& p, const std::array<Vec, 4>& x, double reach) {
  const Vec centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
  Projection out;
  bool first = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const SubTriangle part = project_on_part(p, centre, x[k], x[(k + 1) % 4], true);
    const double depth = std::max(0.0, reach - part.distance);
    if (!first && depth <= out.depth) continue;
    first = false;
    out.depth = depth;
    const double b = part.beta, c = part.gamma;
    const std::array<double, 2> place[] = {
        {c - b, -b - c}, {b + c, c - b}, {b - c, b + c}, {-b - c, b - c}};
    out.s = place[k][0];
    out.t = place[k][1];
  }
  return out;
}

std::array<Vec, 4> corners_of(const Coordinates& x, const Corners& c) {
  return {at(x, c[0]), at(x, c[1]), at(x, c[2]), at(x, c[3])};
}

constexpr std::uint32_t leaf_size = 8;

double along(const Vec& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

double square_outside(double x, double low, double high) {
  const double d = std::max({0.0, low - x, x - high});
  return d * d;
}

bool holds(const Corners& c, NodeIndex node) {
  return std::find(c.begin(), c.end(), node) != c.end();
}

}  // namespace

double distance_from(const Coordinates& x, NodeIndex node, const Corners& segment) {
  const std::array<Vec, 4> c = corners_of(x, segment);
  const Vec p = at(x, node);
  if (is_triangle(segment)) return project_on_part(p, c[2], c[0], c[1], false).distance;
  const Vec centre = 0.25 * (c[0] + c[1] + c[2] + c[3]);
  double least = project_on_part(p, centre, c[0], c[1], true).distance;
  for (std::size_t k = 1; k < 4; ++k)
    least = std::min(least, project_on_part(p, centre, c[k], c[(k + 1) % 4], true).distance);
  return least;
}

Projection project(const Coordinates& x, NodeIndex node, const Corners& segment, double reach,
                   bool weights) {
  const std::array<Vec, 4> corners = corners_of(x, segment);
  const Vec p = at(x, node);
  return is_triangle(segment) ? on_triangle(p, corners, reach, weights)
                              : on_quad(p, corners, reach);
}

NearestSegments::NearestSegments(const Coordinates& x, const std::vector<Corners>& segments)
    : x_(x), segments_(segments), order_(segments.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  centres_.reserve(segments.size());
  for (const Corners& c : segments)
    centres_.push_back(0.25 * (at(x, c[0]) + at(x, c[1]) + at(x, c[2]) + at(x, c[3])));
  if (!segments.empty()) split(0, static_cast<std::uint32_t>(segments.size()));
}

/// Adds the box of a range of the order and its children; returns its index.
std::uint32_t NearestSegments::split(std::uint32_t begin, std::uint32_t end) {
  const auto here = static_cast<std::uint32_t>(boxes_.size());
  TreeBox box{at(x_, segments_[order_[begin]][0]), at(x_, segments_[order_[begin]][0]), begin, end,
              0};
  for (std::uint32_t i = begin; i < end; ++i)
    for (const NodeIndex n : segments_[order_[i]]) {
      const Vec p = at(x_, n);
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  boxes_.push_back(box);
  if (end - begin <= leaf_size) return here;
  const Vec size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(along(centres_[a], axis), a) <
                            std::pair(along(centres_[b], axis), b);
                   });
  split(begin, middle);
  const std::uint32_t second = split(middle, end);
  boxes_[here].second = second;
  return here;
}

NearestSegments::Found NearestSegments::of(NodeIndex node) const {
  Found best;
  if (boxes_.empty()) return best;
  const Vec p = at(x_, node);
  const auto outside = [&](const TreeBox& b) {
    return std::sqrt(square_outside(p.x, b.low.x, b.high.x) +
                     square_outside(p.y, b.low.y, b.high.y) +
                     square_outside(p.z, b.low.z, b.high.z));
  };
  std::vector<std::pair<double, std::uint32_t>> open{{outside(boxes_[0]), 0}};
  while (!open.empty()) {
    const auto [least, index] = open.back();
    open.pop_back();
    if (best.segment != no_index && least > best.distance) continue;
    const TreeBox& box = boxes_[index];
    if (box.second == 0) {
      for (std::uint32_t i = box.begin; i < box.end; ++i) {
        const std::uint32_t m = order_[i];
        if (holds(segments_[m], node)) continue;
        const double d = distance_from(x_, node, segments_[m]);
        if (best.segment == no_index || d < best.distance ||
            (d == best.distance && m < best.segment))
          best = {m, d};
      }
      continue;
    }
    std::pair<double, std::uint32_t> one{outside(boxes_[index + 1]), index + 1};
    std::pair<double, std::uint32_t> two{outside(boxes_[box.second]), box.second};
    if (one.first < two.first) std::swap(one, two);
    open.push_back(one);
    open.push_back(two);  // the nearer one comes first
  }
  return best;
}

}  // namespace deck::detail
