// The time step that the elements alone would allow: a simple estimate to hold contact steps
// against.
#include <algorithm>
#include <array>
#include <cmath>

#include "contact/scene/scene_parts.hpp"
#include "cycle/state/state_parts.hpp"
#include "deck/cycle/state.hpp"

namespace deck::cycle {
namespace {

using deck::detail::at;

constexpr double factor = 0.9;

/// Poisson's ratio from both moduli, within what is physical.
double poisson(const detail::OfParts::Row& m) {
  if (m.bulk <= 0.0 || m.young <= 0.0) return 0.3;
  return std::clamp((3.0 * m.bulk - m.young) / (6.0 * m.bulk), 0.0, 0.495);
}

/// True if a shell of that part limits the time step at all.
bool thin(const detail::OfParts::Row& m) { return m.moving && m.density > 0.0 && m.young > 0.0; }

double square(const Vec& a, const Vec& b) {
  const Vec d = b - a;
  return dot(d, d);
}

/// Of a shell: `area` is so many times its area that over its longest edge or diagonal it is a
/// length.
double thin_step(const detail::OfParts::Row& m, double area, double longest) {
  if (!(longest > 0.0)) return 1e30;
  const double nu = poisson(m);
  return factor * (area / longest) / std::sqrt(m.young / (m.density * (1.0 - nu * nu)));
}

}  // namespace

namespace detail {

ElementSteps::ElementSteps(const Scene& scene, ElementKind kind)
    : scene_(scene), kind_(kind), family_(scene.model->family(kind)), parts_(*scene.model) {}

double ElementSteps::operator()(std::uint32_t e) const {
  switch (kind_) {
    case ElementKind::shell4:
      return shell4(e);
    case ElementKind::shell3:
      return shell3(e);
    case ElementKind::solid8:
      return solid(e);
    case ElementKind::truss:
    case ElementKind::beam:
      return line(e);
    default:
      return 1e30;
  }
}

double ElementSteps::shell4(std::uint32_t e) const {
  const NodeIndex* n = family_.of(e);
  const OfParts::Row& m = parts_[family_.part[e]];
  if (!thin(m) || n[0] == no_index || n[1] == no_index || n[2] == no_index || n[3] == no_index)
    return 1e30;
  const Coordinates& x = scene_.coordinates;
  const Vec p0 = at(x, n[0]), p1 = at(x, n[1]), p2 = at(x, n[2]), p3 = at(x, n[3]);
  const Vec across = p2 - p0, other = p3 - p1;
  const double longest =
      std::sqrt(std::max({0.0, dot(across, across), dot(other, other), square(p0, p1),
                          square(p1, p2), square(p2, p3), square(p3, p0)}));
  // Area over diagonal is 0.7 of a square's side.
  return thin_step(m, std::sqrt(2.0) * (0.5 * norm(cross(across, other))), longest);
}

double ElementSteps::shell3(std::uint32_t e) const {
  const NodeIndex* n = family_.of(e);
  const OfParts::Row& m = parts_[family_.part[e]];
  if (!thin(m) || n[0] == no_index || n[1] == no_index || n[2] == no_index) return 1e30;
  const Coordinates& x = scene_.coordinates;
  const Vec p0 = at(x, n[0]), a = at(x, n[1]) - p0, b = at(x, n[2]) - p0;
  const double longest =
      std::sqrt(std::max({0.0, dot(a, a), dot(b, b), square(at(x, n[1]), at(x, n[2]))}));
  return thin_step(m, 2.0 * (0.5 * norm(cross(a, b))), longest);  // its height
}

double ElementSteps::solid(std::uint32_t e) const {
  static constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  const OfParts::Row& m = parts_[family_.part[e]];
  if (!m.moving || m.density <= 0.0) return 1e30;
  const NodeIndex* n = family_.of(e);
  if (std::find(n, n + 8, no_index) != n + 8) return 1e30;
  const Coordinates& x = scene_.coordinates;
  double largest = 0.0;
  for (const auto& f : faces) {
    const auto p = [&](int k) { return at(x, n[f[static_cast<std::size_t>(k)]]); };
    largest = std::max(largest, 0.5 * norm(cross(p(2) - p(0), p(3) - p(1))));
  }
  const SolidShape shape = family_.shape[e];
  const bool tetra = shape == SolidShape::tetra4 || shape == SolidShape::tetra10;
  const double volume = solid_volume(x, shape, n);
  if (!(largest > 0.0 && volume > 0.0)) return 1e30;
  const double nu = poisson(m);
  double modulus = m.young > 0.0 ? m.young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) : m.bulk;
  modulus = std::max(modulus, m.bulk);
  if (!(modulus > 0.0)) return 1e30;
  double l = (tetra ? 3.0 : 1.0) * volume / largest;
  if (shape == SolidShape::tetra10 || shape == SolidShape::brick20) l *= 0.5;
  return factor * l / std::sqrt(modulus / m.density);
}

double ElementSteps::line(std::uint32_t e) const {
  const NodeIndex* n = family_.of(e);
  const OfParts::Row& m = parts_[family_.part[e]];
  if (n[0] == no_index || n[1] == no_index || !m.moving || m.density <= 0.0 || m.young <= 0.0)
    return 1e30;
  const double l = deck::detail::distance(scene_.coordinates, n[0], n[1]);
  return l > 0.0 ? factor * l / std::sqrt(m.young / m.density) : 1e30;
}

}  // namespace detail

StructureStep structure_step(const Scene& scene) {
  StructureStep best;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                 ElementKind::truss, ElementKind::beam}) {
    const detail::ElementSteps step(scene, kind);
    const std::size_t count = scene.model->family(kind).size();
    for (std::uint32_t e = 0; e < count; ++e)
      if (const double dt = step(e); dt < best.dt) best = {dt, kind, e};
  }
  return best;
}

}  // namespace deck::cycle
