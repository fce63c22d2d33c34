// Friction coefficients by law, and the limit surface of orthotropic friction.
#include <algorithm>
#include <cmath>

#include "cycle/kernel/effects.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle {

double friction_coefficient(int ifric, double mu0, const std::array<double, 6>& c, double pressure,
                            double speed) {
  const double p = pressure, v = speed;
  double mu = mu0;
  switch (ifric) {
    case 1:
      mu = mu0 + (c[0] + c[3] * p) * p + (c[1] + c[2] * p) * v + c[4] * v * v;
      break;
    case 2:
      mu = mu0 + c[0] * std::exp(c[1] * v) * p * p + c[2] * std::exp(c[3] * v) * p +
           c[4] * std::exp(c[5] * v);
      break;
    case 3:
      if (v <= c[4]) {
        // A first critical speed of 0 has no rising branch.
        const double q = c[4] > 0.0 ? v / c[4] : 1.0;
        mu = c[0] + (c[2] - c[0]) * q * (2.0 - q);
      } else if (v < c[5]) {
        const double q = (v - c[4]) / (c[5] - c[4]);
        mu = c[2] + (c[3] - c[2]) * (3.0 - 2.0 * q) * q * q;
      } else {
        const double drop = c[1] - c[3];
        mu = c[1] - drop / (1.0 + drop * (v - c[5]) * (v - c[5]));
      }
      break;
    case 4:
      mu = c[0] + (mu0 - c[0]) * std::exp(-c[1] * v);
      break;
    default:
      return mu0;
  }
  return std::max(mu, 1e-30);
}

std::array<double, 2> orthotropic_return(double f1, double f2, double mu1, double mu2, double fn) {
  const double force = std::abs(fn);
  if (mu1 <= 1e-30) f1 = 0.0;
  if (mu2 <= 1e-30) f2 = 0.0;
  const double a = mu1 * force, b = mu2 * force;  // half axes
  const double r1 = a > 0.0 ? f1 / a : 0.0, r2 = b > 0.0 ? f2 / b : 0.0;
  const double level = r1 * r1 + r2 * r2;
  if (force == 0.0) return {0.0, 0.0};
  if (level <= 1.0) return {f1, f2};
  if (a <= 0.0 || b <= 0.0) {
    const double scale = 1.0 / std::sqrt(level);
    return {f1 * scale, f2 * scale};
  }
  // One Newton step on sqrt(level) - 1 along its gradient, then to the ellipse at that angle.
  const double g1 = f1 / (a * a), g2 = f2 / (b * b);
  const double step = (level - std::sqrt(level)) / (g1 * g1 + g2 * g2);
  const double p1 = f1 - step * g1, p2 = f2 - step * g2;
  const double scale = 1.0 / std::sqrt(p1 * p1 / (a * a) + p2 * p2 / (b * b));
  return {std::copysign(std::abs(p1 * scale), f1), std::copysign(std::abs(p2 * scale), f2)};
}

namespace detail {
namespace {

struct Directions {
  Vec along, across;
};

/// Directions of a pair in the plane of its segment: given ones, or A and B in the segment's axes.
Directions directions_of(const PacketView& view, std::size_t i) {
  if (view.ortho_axis[0][0] != nullptr)
    return {at(view.ortho_axis[0], i), at(view.ortho_axis[1], i)};
  const Vec x1 = at(view.position[1], i), x2 = at(view.position[2], i);
  const Vec x3 = at(view.position[3], i), x4 = at(view.position[4], i);
  const bool triangle = view.triangle != nullptr && view.triangle[i] != 0;
  const SegmentAxes axes(x1, x2, x3, x4, triangle);
  const Vec e1 = axes.first, e2 = axes.second;
  const double p = view.ortho_direction[0][i], q = view.ortho_direction[1][i];
  return {p * e1 + q * e2, p * e2 + (-q) * e1};
}

/// Coefficient along a direction by the law of the card. Backward sliding counts as speed 0.
double directed_coefficient(const ContactCard& card, double mu0,
                            const std::array<const double*, 6>& columns, bool first,
                            std::size_t pair, double pressure, double speed) {
  if (card.ifric == 0) return mu0;
  std::array<double, 6> c = card.c;
  for (std::size_t k = 0; k < 6; ++k) {
    if (columns[k] != nullptr) c[k] = columns[k][pair];
  }
  // The solver exchanges two coefficients of law 4 along the first direction.
  if (card.ifric == 4 && first) std::swap(mu0, c[0]);
  return friction_coefficient(card.ifric, mu0, c, pressure, std::max(1e-30, speed));
}

}  // namespace

void orthotropic_slip(const ContactCard& card, const PacketView& view, std::size_t pair,
                      const SlipState& s, double (&ft)[3]) {
  const Vec trial{ft[0], ft[1], ft[2]};
  const Vec v{s.velocity[0], s.velocity[1], s.velocity[2]};
  const Directions d = directions_of(view, pair);
  const double mu1 = directed_coefficient(card, view.ortho_mu[0][pair], view.c, true, pair,
                                          s.pressure, dot(v, d.along));
  const double mu2 = directed_coefficient(card, view.ortho_mu[1][pair], view.c2, false, pair,
                                          s.pressure, dot(v, d.across));
  // A direction without friction is removed; the rest of the trial force decides.
  const double f1 = mu1 > 1e-30 ? dot(trial, d.along) : 0.0;
  const double f2 = mu2 > 1e-30 ? dot(trial, d.across) : 0.0;
  const auto f = orthotropic_return(f1, f2, mu1, mu2, s.fn);
  // Sticking keeps the whole trial force, also its part outside both directions.
  if (s.fn != 0.0 && f[0] == f1 && f[1] == f2) return;
  // The viscous form gives the radius of its ellipse the sign of the normal force.
  const double sense = !s.incremental && s.fn < 0.0 ? -1.0 : 1.0;
  const Vec back = sense * (f[0] * d.along + f[1] * d.across);
  ft[0] = back.x;
  ft[1] = back.y;
  ft[2] = back.z;
}

}  // namespace detail
}  // namespace deck::cycle
