// Time step, mass and stiffness of trusses, beams and springs.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/mesh/mesh_parts.hpp"

namespace deck::detail {
namespace {

constexpr double tiny = 1e-15;
constexpr double free_step = 1e20;  ///< of a spring without stiffness and damping

/// Equivalent nodal stiffness of a spring with mass, stiffness and damping.
double nodal_stiffness(double m, double k, double c) {
  if (m == 0.0) return k;
  const double root = std::sqrt(c * c + k * m) + c;
  return root * root / m;
}

/// Largest stiffness and damping of several freedoms.
SpringFreedom largest(const PropertyFigures& p, std::size_t first, std::size_t last) {
  SpringFreedom out;
  for (std::size_t i = first; i < last; ++i) {
    out.k = std::max(out.k, p.freedom[i].k);
    out.c = std::max(out.c, p.freedom[i].c);
  }
  return out;
}

/// Types with mass and inertia and several directions.
void general_spring(const PropertyFigures& p, double l, double length, ElementOutcome& out) {
  const double m = p.spring_mass * l, j = p.spring_inertia * l;
  SpringFreedom move, turn;
  if (p.type == 25) {
    move = largest(p, 0, 2);
    turn = largest(p, 2, 4);
    turn.k += p.freedom[1].k * length * length;
    turn.c += p.freedom[1].c * length * length;
  } else {
    move = largest(p, 0, 3);
    turn = largest(p, 3, 6);
    if (p.type == 13) {
      const SpringFreedom across = largest(p, 1, 3);
      turn.k += across.k * length * length;
      turn.c += across.c * length * length;
    }
  }
  for (SpringFreedom* f : {&move, &turn}) {
    f->k /= l;
    f->c /= l;
  }
  const auto step = [](double mass, const SpringFreedom& f) {
    if (f.k + f.c < tiny) return 1.0 / std::sqrt(tiny);
    return mass / (std::sqrt(f.c * f.c + f.k * mass) + f.c);
  };
  out.dt = std::min(step(m, move), step(j, turn));
  out.mass = m;
  out.inertia = j;
  out.stiffness = nodal_stiffness(m, move.k, move.c);
  out.rotational = nodal_stiffness(p.type == 13 ? j : 0.5 * j, turn.k, turn.c);
}

/// Types 4, 12: one direction.
void plain_spring(const PropertyFigures& p, double l, ElementOutcome& out) {
  const double m = p.spring_mass * l, k = p.freedom[0].k / l;
  const double c = p.type == 4 ? p.freedom[0].c : p.freedom[0].c / l;
  double dt = free_step;
  if (k > 0.0 && c > 0.0)
    dt = p.type == 12 ? m / (2.0 * std::sqrt(c * c + k * m) + c)
                      : m / (std::sqrt(c * c + k * m) + c);
  else if (k > 0.0)
    dt = std::sqrt(m / k);
  else if (c > 0.0)
    dt = m / c;
  out.dt = std::min(dt, 0.5 * m / std::max(tiny, c));
  out.mass = m;
  // Pulley: the ends have a quarter of the mass each, the second node half.
  out.stiffness = nodal_stiffness(p.type == 12 ? 0.5 * m : m, k, c);
  out.middle_stiffness = nodal_stiffness(m, k, c);
}

}  // namespace

void truss_outcome(const PartRow& row, double length, ElementOutcome& out) {
  const MaterialFigures& m = row.material;
  const double a = row.property.area;
  out.mass = m.density * a * length;
  out.share = {0.5, 0.5};
  if (row.rigid) return;
  out.dt = length / std::sqrt(m.young / m.reference_density);
  out.stiffness = m.young * a / length;
}

void beam_outcome(const PartRow& row, double length, ElementOutcome& out) {
  const MaterialFigures& m = row.material;
  const PropertyFigures& p = row.property;
  out.mass = m.density * p.area * length;
  out.share = {0.5, 0.5};
  if (row.rigid) return;
  const double damp =
      damping_factor(std::numbers::sqrt2 * std::max(p.beam_membrane, p.beam_bending));
  if (p.type != 3) {
    out.dt = damp * length / m.stored_speed;
    out.stiffness = p.area * m.young / (length * damp * damp);
    out.inertia = out.rotational = not_known;
    return;
  }
  const double large = std::max({p.iyy, p.izz, 1e-20}), small = std::min(p.iyy, p.izz);
  const double a = p.area * length * length / (12.0 * large), s = 1.2 * m.young / m.shear;
  const double f = out.beam_factor = std::max(1.0, length / (a + s));
  out.dt = damp * length / (m.stored_speed * std::sqrt(f));
  const double phi = small / large * s / a, k_phi = (4.0 + phi) / (1.0 + phi);
  const double half = 0.5 * m.density * length;
  double j = 1.2 * half * p.area * (1.2 * length) * (1.2 * length) / 12.0 + half * large;
  if (a < 1.0) j *= std::max(1.0, k_phi / (1.0 + a));
  out.inertia = 2.0 * std::max(j, half * p.ixx);
  const double l = length * damp * damp;
  out.stiffness = f * p.area * m.young / l;
  out.rotational = std::max(m.shear * p.ixx, k_phi * m.young * large) / l;
}

void spring_outcome(const PartRow& row, double length, bool on_body, ElementOutcome& out) {
  const PropertyFigures& p = row.property;
  const double l = p.per_length ? length : 1.0;
  out.share = {0.5, 0.5};
  if (p.type == 12) out.share = {0.25, 0.5, 0.25};
  bool known = true;
  for (const SpringFreedom& f : p.freedom) known = known && f.known;
  const bool general = p.type == 8 || p.type == 13 || p.type == 25;
  if (p.type == 4 || p.type == 12) {
    plain_spring(p, l, out);
  } else if (general) {
    general_spring(p, l, length, out);
  } else {
    out.dt = out.mass = out.stiffness = out.inertia = out.rotational = not_known;
    out.why = "this type of spring is not evaluated";
    if (p.type == 23 && on_body) out.dt = no_step;
    return;
  }
  if (!known) {
    out.dt = out.stiffness = out.rotational = not_known;
    out.why = "a function of the spring's speed enters, or a function is missing";
  }
  if (on_body && general) out.dt = no_step;
}

}  // namespace deck::detail
