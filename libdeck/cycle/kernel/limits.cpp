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

double length(Vec v) { return std::sqrt(dot(v, v)); }

struct Elastic {
  double density = 0.0, young = 0.0, bulk = 0.0;
};

Elastic elastic_of(const deck::Model& model, ElementKind kind, std::uint32_t e) {
  const std::uint32_t part = model.family(kind).part[e];
  if (part == no_index || model.parts[part].mat == no_index) return {};
  const Material& m = model.materials[model.parts[part].mat];
  if (m.law == 0 || m.law == 13) return {};  // void and rigid materials allow any step
  return {m.density, m.young, m.bulk};
}

/// Poisson's ratio from both moduli, within what is physical.
double poisson(const Elastic& m) {
  if (m.bulk <= 0.0 || m.young <= 0.0) return 0.3;
  return std::clamp((3.0 * m.bulk - m.young) / (6.0 * m.bulk), 0.0, 0.495);
}

double shell_step(const Scene& scene, ElementKind kind, std::uint32_t e) {
  const NodeIndex* n = scene.model->family(kind).of(e);
  const std::size_t corners = kind == ElementKind::shell4 ? 4 : 3;
  const Elastic m = elastic_of(*scene.model, kind, e);
  if (m.density <= 0.0 || m.young <= 0.0) return 1e30;
  double longest = 0.0;
  for (std::size_t a = 0; a < corners; ++a) {
    if (n[a] == no_index) return 1e30;
    for (std::size_t b = a + 1; b < corners; ++b) {
      if (n[b] == no_index) return 1e30;
      longest =
          std::max(longest, length(at(scene.coordinates, n[b]) - at(scene.coordinates, n[a])));
    }
  }
  if (!(longest > 0.0)) return 1e30;
  // A triangle's height; a quad's side: area over diagonal is 0.7 of it for a square.
  const double area = detail::shell_area(scene.coordinates, kind, n);
  const double l = (corners == 4 ? std::sqrt(2.0) : 2.0) * area / longest;
  const double nu = poisson(m);
  return factor * l / std::sqrt(m.young / (m.density * (1.0 - nu * nu)));
}

double solid_step(const Scene& scene, std::uint32_t e) {
  static constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  const Elements& family = scene.model->solid8;
  const NodeIndex* n = family.of(e);
  if (std::find(n, n + 8, no_index) != n + 8) return 1e30;
  const Elastic m = elastic_of(*scene.model, ElementKind::solid8, e);
  if (m.density <= 0.0) return 1e30;
  const Coordinates& x = scene.coordinates;
  double largest = 0.0;
  for (const auto& f : faces) {
    const auto p = [&](int k) { return at(x, n[f[static_cast<std::size_t>(k)]]); };
    largest = std::max(largest, 0.5 * length(cross(p(2) - p(0), p(3) - p(1))));
  }
  const SolidShape shape = family.shape[e];
  const bool tetra = shape == SolidShape::tetra4 || shape == SolidShape::tetra10;
  const double volume = detail::solid_volume(x, shape, n);
  if (!(largest > 0.0 && volume > 0.0)) return 1e30;
  const double nu = poisson(m);
  double modulus = m.young > 0.0 ? m.young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) : m.bulk;
  modulus = std::max(modulus, m.bulk);
  if (!(modulus > 0.0)) return 1e30;
  double l = (tetra ? 3.0 : 1.0) * volume / largest;
  if (shape == SolidShape::tetra10 || shape == SolidShape::brick20) l *= 0.5;
  return factor * l / std::sqrt(modulus / m.density);
}

double line_step(const Scene& scene, ElementKind kind, std::uint32_t e) {
  const NodeIndex* n = scene.model->family(kind).of(e);
  const Elastic m = elastic_of(*scene.model, kind, e);
  if (n[0] == no_index || n[1] == no_index || m.density <= 0.0 || m.young <= 0.0) return 1e30;
  const double l = length(at(scene.coordinates, n[1]) - at(scene.coordinates, n[0]));
  return l > 0.0 ? factor * l / std::sqrt(m.young / m.density) : 1e30;
}

}  // namespace

double detail::element_step(const Scene& scene, ElementKind kind, std::uint32_t e) {
  switch (kind) {
    case ElementKind::shell4:
    case ElementKind::shell3:
      return shell_step(scene, kind, e);
    case ElementKind::solid8:
      return solid_step(scene, e);
    case ElementKind::truss:
    case ElementKind::beam:
      return line_step(scene, kind, e);
    default:
      return 1e30;
  }
}

StructureStep structure_step(const Scene& scene) {
  StructureStep best;
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                 ElementKind::truss, ElementKind::beam})
    for (std::uint32_t e = 0; e < scene.model->family(kind).size(); ++e)
      if (const double dt = detail::element_step(scene, kind, e); dt < best.dt)
        best = {dt, kind, e};
  return best;
}

}  // namespace deck::cycle
