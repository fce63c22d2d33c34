#include "cycle/state_parts.hpp"

#include <cmath>

#include "contact/scene_parts.hpp"
#include "deck/keyword/decode.hpp"

namespace deck::cycle::detail {

using deck::detail::at;
using deck::detail::cross;
using deck::detail::dot;
using deck::detail::Vec;

double density_of(const deck::Model& model, ElementKind kind, std::uint32_t e) {
  const std::uint32_t part = model.family(kind).part[e];
  if (part == no_index || model.parts[part].mat == no_index) return 0.0;
  return model.materials[model.parts[part].mat].density;
}

double shell_area(const Coordinates& x, ElementKind kind, const NodeIndex* n) {
  const Vec d = kind == ElementKind::shell4
                    ? cross(at(x, n[2]) - at(x, n[0]), at(x, n[3]) - at(x, n[1]))
                    : cross(at(x, n[1]) - at(x, n[0]), at(x, n[2]) - at(x, n[0]));
  return 0.5 * std::sqrt(dot(d, d));
}

double solid_volume(const Coordinates& x, SolidShape shape, const NodeIndex* slots) {
  const double v = deck::detail::solid_volume(x, slots);
  return shape == SolidShape::tetra4 || shape == SolidShape::tetra10 ? v / 1.5 : v;
}

std::vector<double> spring_masses(const deck::Model& model) {
  std::vector<double> mass(model.properties.size(), 0.0);
  if (model.deck == nullptr) return mass;
  for (std::size_t p = 0; p < mass.size(); ++p) {
    const Block* block = model.properties[p].block;
    if (block == nullptr || block->opaque) continue;
    const DecodedBlock d = decode(*model.deck, *block);
    if (const Cell* cell = d.find("Mass")) mass[p] = working_value(*model.deck, d, *cell);
  }
  return mass;
}

std::optional<AffineMap> fixed_axes(const deck::Model& model, std::int64_t skew) {
  for (const Block& block : model.deck->blocks) {
    if (block.schema == nullptr || block.schema->keyword != "/SKEW/FIX" || !block.id.present)
      continue;
    if (block.id.value + model.deck->offset_of(block, "skew") != skew) continue;
    const DecodedBlock d = decode(*model.deck, block);
    const Vec y{d.real("X_Y"), d.real("Y_Y"), d.real("Z_Y")};
    Vec z{d.real("X_Z"), d.real("Y_Z"), d.real("Z_Z")};
    // X = Y x Z; Z is made orthogonal to the two.
    Vec e1 = cross(y, z);
    z = cross(e1, y);
    const double l1 = std::sqrt(dot(e1, e1)), l2 = std::sqrt(dot(y, y)), l3 = std::sqrt(dot(z, z));
    if (!(l1 > 0.0 && l2 > 0.0 && l3 > 0.0)) return std::nullopt;
    AffineMap map;
    map.matrix = {e1.x / l1, y.x / l2,  z.x / l3, e1.y / l1, y.y / l2,
                  z.y / l3,  e1.z / l1, y.z / l2, z.z / l3};
    return map;
  }
  return std::nullopt;
}

}  // namespace deck::cycle::detail
