// Thickness, section area, moduli and volume of single elements, as gaps and stiffnesses need them.
#include <algorithm>
#include <cmath>

#include "contact/shared/scene_parts.hpp"

namespace deck::detail {
namespace {

const Part* part_of(const Model& model, const Elements& family, std::uint32_t e) {
  const std::uint32_t p = family.part[e];
  return p == no_index ? nullptr : &model.parts[p];
}
const Property* property_of(const Model& model, const Elements& family, std::uint32_t e) {
  const Part* part = part_of(model, family, e);
  return part == nullptr || part->prop == no_index ? nullptr : &model.properties[part->prop];
}
const Material* material_of(const Model& model, const Elements& family, std::uint32_t e) {
  const Part* part = part_of(model, family, e);
  return part == nullptr || part->mat == no_index ? nullptr : &model.materials[part->mat];
}
double stiffness_thickness(const Model& model, const Elements& family, std::uint32_t e) {
  if (!model.intthick_v5 && e < family.thickness.size())
    if (const double own = family.thickness[e]; own != 0) return own;
  const Property* p = property_of(model, family, e);
  return p == nullptr ? 0 : p->thickness;
}

}  // namespace

double part_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  const Part* part = part_of(model, model.family(kind), e);
  return part == nullptr ? 0 : part->thickness;
}

double gap_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  const Elements& family = model.family(kind);
  if (!model.intthick_v5)
    if (const Part* part = part_of(model, family, e); part != nullptr && part->thickness != 0)
      return part->thickness;
  return stiffness_thickness(model, family, e);
}

double stiffness_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  return stiffness_thickness(model, model.family(kind), e);
}

double young_of(const Model& model, ElementKind kind, std::uint32_t e) {
  const Material* m = material_of(model, model.family(kind), e);
  return m == nullptr ? 0 : m->young;
}

double bulk_of(const Model& model, std::uint32_t solid) {
  const Material* m = material_of(model, model.solid8, solid);
  if (m == nullptr) return 0;
  const Property* p = property_of(model, model.solid8, solid);
  if (p == nullptr || p->icontrol != 1) return m->bulk;
  return 2 * m->bulk * (m->law == 1 ? 5 : m->law == 62 ? 100 : 1);
}

double section_area(const Model& model, ElementKind kind, std::uint32_t e) {
  const Property* p = property_of(model, model.family(kind), e);
  return p == nullptr ? 0 : p->area;
}

double section_thickness(const Model& model, ElementKind kind, std::uint32_t e) {
  return std::sqrt(section_area(model, kind, e));
}

double spring_stiffness(const Model& model, std::uint32_t spring) {
  const Property* p = property_of(model, model.spring, spring);
  if (p == nullptr) return 0;
  const auto& k = p->stiffness;
  if (p->number == 8 || p->number == 13 || p->number == 23)
    return std::fmax(k[0], std::fmax(k[1], k[2]));
  return k[0];
}

double solid_volume(const Coordinates& x, const NodeIndex* n) {
  if (std::find(n, n + 8, no_index) != n + 8) return 0;  // a node is missing: reported on reading
  const Vec a = at(x, n[6]) - at(x, n[0]), b = at(x, n[7]) - at(x, n[1]);
  const Vec c = at(x, n[4]) - at(x, n[2]), d = at(x, n[5]) - at(x, n[3]);
  const Vec ad = a + d, bc = b + c;
  const Vec j1 = ad - bc;
  const Vec j2 = a + b - c - d;  // in this order: search distances of ties hang on its last bit
  const Vec j3 = ad + bc;
  return std::fabs(dot(j1, cross(j2, j3))) / 64;
}

}  // namespace deck::detail
