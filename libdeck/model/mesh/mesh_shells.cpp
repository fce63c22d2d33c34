// Time step, mass and stiffness of shells with four and three nodes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/mesh/mesh_parts.hpp"
#include "model/model_build.hpp"

namespace deck::detail {

double damping_factor(double v) { return std::sqrt(1.0 + v * v) - v; }

namespace {

struct Flat {
  double x = 0, y = 0;
};
Flat operator-(Flat a, Flat b) { return {a.x - b.x, a.y - b.y}; }
Flat operator+(Flat a, Flat b) { return {a.x + b.x, a.y + b.y}; }
double squared(Flat a) { return a.x * a.x + a.y * a.y; }
double turn(Flat a, Flat b) { return a.x * b.y - a.y * b.x; }

/// Default membrane damping.
double default_damping(int law, int ishell, int type) {
  if (one_of(law, {15, 27, 65})) return 0.05;
  if (one_of(law, {19, 119})) return 0.25;
  if (one_of(law, {58, 158})) return ishell == 12 ? 0.2 : 0.075;
  if (one_of(law, {25, 123, 125, 127, 132})) return ishell == 24 ? 0.1 : 0.05;
  if (one_of(law, {42, 69})) return ishell == 12 ? 0.04 : 0.03;
  return ishell == 24 && (type == 1 || type == 9) ? 0.015 : 0.0;
}

double membrane_damping(const PartRow& row, bool quad) {
  const int law = row.material.law, ishell = row.property.ishell;
  if (one_of(law, {1, 2, 3, 22, 23})) return 0.0;
  if (law == 91 && (ishell == 12 || ishell == 24)) return 0.0;
  if (row.property.membrane != 0.0) return row.property.membrane;
  if (quad && ishell == 24 && (law == 19 || law == 119)) return 0.015;
  return default_damping(law, ishell, row.property.type);
}

/// Length of fully integrated and physically stabilised quadrangles, from centred points.
double batoz_length(const std::array<Flat, 4>& p, double area, double k) {
  const Flat a{0.5 * (p[0].x - p[2].x), 0.5 * (p[0].y - p[2].y)};
  const Flat b{0.5 * (p[1].x - p[3].x), 0.5 * (p[1].y - p[3].y)};
  const double a1 = std::max(squared(a), squared(b));
  const double a2 = std::max(std::abs(turn(p[1], p[3])), std::abs(turn(p[0], p[2]))) / area;
  const double c1 = std::sqrt(squared(b - a)), c2 = std::sqrt(squared(b + a));
  const double f1 = 1.0 + std::min(0.5, 0.25 * (std::max(c1, c2) / std::min(c1, c2) - 1.0));
  const double u =
      static_cast<double>(3.413f) * std::max(0.0, area / (c1 * c2) - static_cast<double>(0.7071f));
  const double f2 = static_cast<double>(0.78f) + static_cast<double>(0.22f) * u * u * u;
  return area / std::sqrt(2.0 * f1 * f2 * (k + a2) * a1);
}

}  // namespace

void shell4_outcome(const PartRow& row, double thickness, const std::array<Vec, 4>& x,
                    ElementOutcome& out) {
  const MaterialFigures& m = row.material;
  const int ishell = row.property.ishell;
  const Vec r = x[1] + x[2] - x[0] - x[3], s = x[2] + x[3] - x[0] - x[1];
  const Vec normal = cross(r, s);
  const double rs = norm(normal);
  const Vec e3 = unit(normal);
  const Vec e1 = unit(r + (norm(r) / norm(s)) * cross(s, e3)), e2 = cross(e3, e1);
  std::array<Flat, 4> p{};
  for (std::size_t i = 1; i < 4; ++i) {
    const Vec d = x[i] - x[0];
    p[i] = {dot(d, e1), dot(d, e2)};
  }
  const bool refined = ishell == 12 || ishell == 24;
  const double area = refined ? 0.25 * rs : 0.5 * norm(cross(x[2] - x[0], x[3] - x[1]));
  const double t = thickness;
  out.mass = m.density * t * area;
  out.share = {0.25, 0.25, 0.25, 0.25};
  out.inertia = out.mass * (area / (refined ? 12.0 : 9.0) + t * t / 12.0);
  if (row.rigid) return;
  const double d13 = squared(p[2] - p[0]), d24 = squared(p[3] - p[1]);
  double v = membrane_damping(row, true);
  if (refined) {
    const Flat c{0.25 * (p[0].x + p[1].x + p[2].x + p[3].x),
                 0.25 * (p[0].y + p[1].y + p[2].y + p[3].y)};
    for (Flat& q : p) q = q - c;
    out.length = batoz_length(p, area, ishell == 12 ? 4.0 / 3.0 : 1.25);
    const double dn = row.property.numeric;
    v = std::max(v, dn != 0.0 ? dn : ishell == 24 ? 0.015 : 0.0);
  } else {
    double shortest = std::min({squared(p[1] - p[0]), squared(p[2] - p[1]), squared(p[3] - p[0])});
    if (const double side = squared(p[3] - p[2]); side > 0.0)
      shortest = std::min({shortest, side, d13, d24});
    out.length = std::max(area / std::sqrt(std::max(d13, d24)), std::sqrt(shortest));
  }
  const double damp = damping_factor(v);
  out.dt = out.length * damp / m.shell_speed;
  if (refined) {
    const double l = out.length * damp;
    out.stiffness = 0.5 * t * area * m.plate_modulus / (l * l);
    out.rotational = out.stiffness * t * t / 12.0;
  } else {
    out.stiffness = 0.25 * std::max(d13, d24) * t * m.plate_modulus / (area * damp * damp);
    out.rotational = out.stiffness * (t * t + area) / 12.0;
  }
}

void shell3_outcome(const PartRow& row, double thickness, const std::array<Vec, 3>& x,
                    ElementOutcome& out) {
  const MaterialFigures& m = row.material;
  const double t = thickness;
  const double area = 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
  std::array<double, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec a = x[(i + 1) % 3] - x[i], b = x[(i + 2) % 3] - x[i];
    side[i] = dot(a, a);
    out.share[i] = std::atan2(norm(cross(a, b)), dot(a, b)) / std::numbers::pi;
  }
  out.mass = m.density * t * area;
  out.inertia = out.mass * (area / 4.5 + t * t / 12.0);
  if (row.rigid) return;
  double longest = std::max({side[0], side[1], side[2]});
  const bool dkt = row.property.ish3n == 30;
  if (dkt) longest *= 1.0 + 0.6 * (1.0 + m.poisson) * t * t / std::min({side[0], side[1], side[2]});
  out.length = 2.0 * area / std::sqrt(longest);
  const double damp = damping_factor(membrane_damping(row, false));
  out.dt = out.length * damp / m.shell_speed;
  if (dkt) return;
  const double l = out.length * damp;
  out.stiffness = area * t * m.plate_modulus / (l * l);
  out.rotational = out.stiffness * (t * t / 12.0 + 0.5 * area * m.shear / m.plate_modulus);
}

}  // namespace deck::detail
