// Curved main surfaces: sphere, cylinder and bicubic interpolation (Icurv 1 to 3), and Iadm.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cycle/kernel/block.hpp"

namespace deck::cycle::detail {
namespace {

/// Quantities of a pair that curvature changes.
struct CurvedPair {
  double penetration;
  double distance;
  bool keep;
  Vec normal;
};

bool is_triangle(const PacketView& view, std::size_t i) {
  return view.triangle != nullptr && view.triangle[i] != 0;
}

void sphere(const Vec& centre, const Vec& node, const std::array<Vec, 4>& x, double gap,
            CurvedPair& c) {
  double radius = norm(x[0] - centre);
  for (const Vec& corner : x) radius = std::min(radius, norm(corner - centre));
  const Vec r = node - centre;
  const double rs = norm(r);
  const double z = rs - radius + gap;
  c.normal = -1.0 * unit(r);
  if (z < 0.0) {
    c.keep = false;
  } else if (z < c.penetration) {
    c.penetration = z;
  }
}

void cylinder(const Vec& a, const Vec& b, const Vec& node, const std::array<Vec, 4>& x, double gap,
              CurvedPair& c) {
  const Vec axis = unit(b - a);
  const auto radial = [&](const Vec& p) {
    const Vec q = p - a;
    return q - dot(q, axis) * axis;
  };
  double radius = norm(radial(x[0]));
  for (const Vec& corner : x) radius = std::min(radius, norm(radial(corner)));
  const Vec r = radial(node);
  const double rs = norm(r);
  const double z = rs - radius + gap;
  if (z < 0.0) {
    c.keep = false;
    return;
  }
  if (z < c.penetration) {
    c.penetration = z;
    c.normal = -1.0 * unit(r);
    return;
  }
  if (rs - radius - gap > 0.0) {
    c.keep = false;
    return;
  }
  int signs = 0;  // a side of length 0 gives 0 and does not count
  for (std::size_t k = 0; k < 4; ++k) {
    const double triple = dot(r, cross(x[k] - node, x[(k + 1) % 4] - node));
    signs |= triple > 0.0 ? 1 : (triple < 0.0 ? 2 : 0);
  }
  if (signs != 3) {
    c.penetration = gap + radius - rs;
    c.normal = unit(r);
  }
}

/// A cubic over an edge, normal to the nodal normals at both ends.
struct EdgeCubic {
  Vec point, tangent, normal;

  EdgeCubic(const Vec& p, const Vec& np, const Vec& q, const Vec& nq, double xi) {
    const double length = norm(q - p);
    const Vec e = unit(q - p);
    const Vec sum = np + nq;
    const Vec t = unit(sum - dot(sum, e) * e);
    double dp = slope(np, e, t), dq = slope(nq, e, t);
    dp /= std::max(1.0, std::abs(dp));
    dq /= std::max(1.0, std::abs(dq));
    const double u = 0.5 * (1.0 + xi);
    const double rise = ((dp + dq) * u * u - (dq + 2.0 * dp) * u + dp) * u * length;
    point = p + (u * length) * e + rise * t;
    tangent = e + (3.0 * (dp + dq) * u * u - 2.0 * (dq + 2.0 * dp) * u + dp) * t;
    const Vec blend = (1.0 - u) * np + u * nq;
    normal = blend - (dot(blend, tangent) / std::max(1e-300, dot(tangent, tangent))) * tangent;
  }

 private:
  static double slope(const Vec& n, const Vec& e, const Vec& t) {
    const double up = dot(n, t);
    return up != 0.0 ? -dot(n, e) / up : 0.0;  // a normal along the edge has no slope
  }
};

/// A ratio of two weights, computed from the larger denominator.
double weight_ratio(double num, double den, double other_num, double other_den) {
  if (den < 1e-4) return other_num / std::max(1e-20, other_den);
  return num / std::max(1e-20, den);
}

void bicubic(const std::array<Vec, 4>& nodal, const Vec& node, const std::array<Vec, 4>& x,
             const std::array<double, 4>& h, double gap, CurvedPair& c) {
  const double low_r = weight_ratio(h[1] - h[0], h[1] + h[0], h[2] - h[3], h[2] + h[3]);
  const double high_r = weight_ratio(h[2] - h[3], h[2] + h[3], h[1] - h[0], h[1] + h[0]);
  const double low_s = weight_ratio(h[3] - h[0], h[3] + h[0], h[2] - h[1], h[2] + h[1]);
  const double high_s = weight_ratio(h[2] - h[1], h[2] + h[1], h[3] - h[0], h[3] + h[0]);
  const double a = high_r - low_r, b = high_s - low_s;
  const double r = (2.0 * (high_r + low_r) + (high_s + low_s) * a) / (4.0 - a * b);
  const double s = (2.0 * (high_s + low_s) + (high_r + low_r) * b) / (4.0 - a * b);
  const EdgeCubic e12(x[0], nodal[0], x[1], nodal[1], r), e43(x[3], nodal[3], x[2], nodal[2], r);
  const EdgeCubic e14(x[0], nodal[0], x[3], nodal[3], s), e23(x[1], nodal[1], x[2], nodal[2], s);
  const EdgeCubic along_s(e12.point, e12.normal, e43.point, e43.normal, s);
  const EdgeCubic along_r(e14.point, e14.normal, e23.point, e23.normal, r);
  const Vec normal = unit(cross(along_r.tangent, along_s.tangent));
  const double d = dot(normal, node - 0.5 * (along_s.point + along_r.point));
  c.normal = (d < 0.0 ? -1.0 : 1.0) * normal;
  c.penetration = gap - std::abs(d);
  c.distance = std::abs(d);
  if (c.penetration < 0.0) c.keep = false;
}

}  // namespace

double bicubic_allowance(const PacketView& view, std::size_t i) {
  if (is_triangle(view, i)) return 0.0;
  const std::array<Vec, 4> x = corners(view, i);
  double worst = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec edge = x[(k + 1) % 4] - x[k];
    const double l2 = dot(edge, edge);
    for (const std::size_t end : {k, (k + 1) % 4}) {
      const Vec n = at(view.normal[end], i);
      const double along2 = dot(n, edge) * dot(n, edge);
      const double rest = dot(n, n) * l2 - along2;
      if (rest > 0.0) worst = std::max(worst, along2 * l2 / rest);
    }
  }
  return 0.5 * std::sqrt(worst);
}

double curvature_allowance(const ContactCard& card, const PacketView& view, std::size_t i) {
  if (card.icurv == 3) return bicubic_allowance(view, i);
  double extent = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = view.position[1][axis][i], high = low;
    for (std::size_t corner = 2; corner < 5; ++corner) {
      low = std::min(low, view.position[corner][axis][i]);
      high = std::max(high, view.position[corner][axis][i]);
    }
    extent = std::max(extent, high - low);
  }
  return 0.5 * extent;
}

void mark_kept(const PacketView& view, std::size_t begin, std::size_t n, int width,
               const GeometryBlock& g, PacketResult& out) {
  const auto w = static_cast<std::size_t>(width);
  for (std::size_t slot = 0; slot < (n + w - 1) / w * w; ++slot) {
    const std::size_t first = begin + slot / w * w;
    const std::size_t i = (first + w <= view.size ? first : view.size - w) + slot % w;
    if (g.keep[slot] != 0.0) out.status[i] |= status_kept;
  }
}

void apply_curvature(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                     std::size_t n, int width, GeometryBlock& g) {
  const auto w = static_cast<std::size_t>(width);
  const ContactCard& card = plan.card;
  const double drad = card.ithe > 0 ? card.drad : 0.0;
  for (std::size_t slot = 0; slot < (n + w - 1) / w * w; ++slot) {
    const std::size_t first = begin + slot / w * w;
    const std::size_t i = (first + w <= view.size ? first : view.size - w) + slot % w;
    const std::array<Vec, 4> x = corners(view, i);
    const Vec node = at(view.position[0], i);
    const double gap = view.gap[i];
    // Beyond the gap the solver keeps pairs on curved surfaces, with damping and friction.
    const double reach = std::max(gap + curvature_allowance(card, view, i), drad);
    CurvedPair c{g.penetration[slot],
                 g.distance[slot],
                 g.distance[slot] < reach,
                 {g.normal[0][slot], g.normal[1][slot], g.normal[2][slot]}};
    const std::array<double, 4> h{g.raw[0][slot], g.raw[1][slot], g.raw[2][slot], g.raw[3][slot]};
    if (card.icurv == 1) {
      sphere(to_vec(card.curv_node1), node, x, gap, c);
    } else if (card.icurv == 2) {
      cylinder(to_vec(card.curv_node1), to_vec(card.curv_node2), node, x, gap, c);
    } else if (card.icurv == 3 && !is_triangle(view, i) && c.keep) {
      std::array<Vec, 4> nodal;
      for (std::size_t k = 0; k < 4; ++k) nodal[k] = at(view.normal[k], i);
      bicubic(nodal, node, x, h, gap, c);
    }
    if (!c.keep) c.penetration = 0.0;
    g.penetration[slot] = std::max(0.0, c.penetration);
    // The law uses the remaining gap: the distance follows the curved surface.
    if (card.icurv != 3) c.distance = std::max(0.0, gap - g.penetration[slot]);
    g.distance[slot] = c.distance;
    g.keep[slot] = c.keep ? 1.0 : 0.0;
    g.normal[0][slot] = c.normal.x;
    g.normal[1][slot] = c.normal.y;
    g.normal[2][slot] = c.normal.z;
  }
}

void apply_criteria(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                    std::size_t end, PacketResult& out) {
  const ContactCard& card = plan.card;
  const double cosine = std::cos(card.angladm * std::numbers::pi / 180.0);
  const auto radius = [](const Vec& e, const Vec& turn) {
    const double length = norm(e);
    return length / std::max(1e-20, std::abs(dot(turn, unit(e))));
  };
  const double limit = card.ithe > 0 ? card.drad : 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    if (!(out.distance[i] < std::max(view.gap[i], limit))) {  // not a pair
      for (auto& c : out.criteria) c[i] = 0.0;
      continue;
    }
    const std::array<Vec, 4> x = corners(view, i);
    std::array<Vec, 4> n;
    for (std::size_t c = 0; c < 4; ++c) n[c] = unit(at(view.normal[c], i));
    const double r1 = radius((x[1] + x[2]) - (x[0] + x[3]), (n[1] + n[2]) - (n[0] + n[3]));
    double r2 = radius((x[2] + x[3]) - (x[0] + x[1]), (n[2] + n[3]) - (n[0] + n[1]));
    if (card.nradm > 0.0) r2 /= card.nradm;  // the solver scales this direction only
    const Vec face = unit(cross(x[2] - x[0], x[3] - x[1]));
    double least = 1.0;
    for (const Vec& corner : n) least = std::min(least, dot(face, corner));
    out.criteria[0][i] = std::min(r1, r2);
    const double room = card.padm * out.effective_gap[i];
    if (card.iadm == 2) out.criteria[1][i] = room > 0.0 ? out.penetration[i] / room : 0.0;
    out.criteria[2][i] = least / std::max(1e-20, cosine);
  }
}

}  // namespace deck::cycle::detail
