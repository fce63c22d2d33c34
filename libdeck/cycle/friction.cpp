// Friction coefficients by law, and the limit surface of orthotropic friction.
#include <algorithm>
#include <cmath>

#include "cycle/effects.hpp"
#include "cycle/vector.hpp"
#include "deck/cycle/kernel.hpp"

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
        // A first critical speed of 0 has no rising branch: start at its end.
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

std::array<double, 2> orthotropic_return(double f1, double f2, double mu1, double mu2, double fn,
                                         Model model) {
  const double force = std::abs(fn);
  if (mu1 <= 1e-30) f1 = 0.0;
  if (mu2 <= 1e-30) f2 = 0.0;
  const double a = mu1 * force, b = mu2 * force;  // half axes
  const double r1 = a > 0.0 ? f1 / a : 0.0, r2 = b > 0.0 ? f2 / b : 0.0;
  const double level = r1 * r1 + r2 * r2;
  if (force == 0.0) return {0.0, 0.0};
  if (level <= 1.0) return {f1, f2};
  if (model == Model::robust || a <= 0.0 || b <= 0.0) {
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

/// Material direction of a pair in the tangent plane of the contact.
Vec material_direction(const PacketView& view, std::size_t i, const Vec& n) {
  const Vec x1 = at(view.position[1], i), x2 = at(view.position[2], i);
  const Vec x3 = at(view.position[3], i), x4 = at(view.position[4], i);
  const bool triangle = view.triangle != nullptr && view.triangle[i] != 0;
  const Vec a = triangle ? x2 - x1 : (x2 + x3) - (x1 + x4);
  const Vec b = triangle ? x3 - x1 : (x3 + x4) - (x1 + x2);
  const Vec e3 = unit(cross(a, b));
  const double ratio = norm(b) > 0.0 ? norm(a) / norm(b) : 0.0;
  const Vec e1 = unit(a + ratio * cross(b, e3));
  const Vec t = view.ortho_direction[0][i] * e1 + view.ortho_direction[1][i] * cross(e3, e1);
  return unit(t - dot(t, n) * n);
}

}  // namespace

void orthotropic_slip(const PacketView& view, std::size_t pair, const double (&normal)[3],
                      double normal_force, Model model, double (&ft)[3]) {
  const Vec n{normal[0], normal[1], normal[2]}, trial{ft[0], ft[1], ft[2]};
  const Vec t1 = material_direction(view, pair, n), t2 = cross(n, t1);
  const auto f = orthotropic_return(dot(trial, t1), dot(trial, t2), view.ortho_mu[0][pair],
                                    view.ortho_mu[1][pair], normal_force, model);
  const Vec back = f[0] * t1 + f[1] * t2;
  ft[0] = back.x;
  ft[1] = back.y;
  ft[2] = back.z;
}

}  // namespace detail
}  // namespace deck::cycle
