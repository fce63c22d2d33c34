// Densities, areas, volumes, masses of springs and conductivities, for masses, time steps and heat.
#include "cycle/state/state_parts.hpp"

#include <cmath>

#include "contact/scene/scene_parts.hpp"
#include "deck/keyword/decode.hpp"

namespace deck::cycle::detail {

using deck::detail::at;

namespace {

bool complete(const NodeIndex* n, int count) {
  for (int c = 0; c < count; ++c)
    if (n[c] == no_index) return false;
  return true;
}

int corners_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::shell4:
      return 4;
    case ElementKind::shell3:
      return 3;
    case ElementKind::solid8:
      return 8;
    case ElementKind::truss:
    case ElementKind::beam:
      return 2;
    default:
      return 0;
  }
}

}  // namespace

OfParts::OfParts(const deck::Model& model) : rows_(model.parts.size() + 1) {
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    Row& row = rows_[p];
    if (part.mat != no_index) {
      const Material& m = model.materials[part.mat];
      row.density = m.density;
      row.young = m.young;
      row.bulk = m.bulk;
      row.moving = m.law != 0 && m.law != 13;
    }
    if (part.prop != no_index) {
      row.thickness = model.properties[part.prop].thickness;
      row.section = model.properties[part.prop].area;
    }
  }
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

ElementMasses::ElementMasses(const Scene& scene, ElementKind kind)
    : scene_(scene),
      kind_(kind),
      family_(scene.model->family(kind)),
      parts_(*scene.model),
      own_thicknesses_(scene.model->intthick_v5 ? 0 : family_.thickness.size()) {}

double ElementMasses::operator()(std::uint32_t e) const {
  const NodeIndex* n = family_.of(e);
  const int corners = corners_of(kind_);
  if (corners == 0 || !complete(n, corners)) return 0;
  const OfParts::Row& part = parts_[family_.part[e]];
  const Coordinates& x = scene_.coordinates;
  if (corners == 8) return part.density * solid_volume(x, family_.shape[e], n);
  if (corners == 2) return part.density * part.section * deck::detail::distance(x, n[0], n[1]);
  const double own = e < own_thicknesses_ ? family_.thickness[e] : 0;
  return part.density * (own != 0 ? own : part.thickness) * shell_area(x, kind_, n);
}

SpringMasses::SpringMasses(const deck::Model& model) : by_property_(model.properties.size()) {
  if (model.deck == nullptr || model.spring.size() == 0) return;
  for (std::size_t p = 0; p < by_property_.size(); ++p) {
    const Block* block = model.properties[p].block;
    if (block == nullptr || block->opaque) continue;
    const DecodedBlock d = decode(*model.deck, *block);
    if (const Cell* cell = d.find("Mass"))
      by_property_[p] = {working_value(*model.deck, d, *cell), d.integer("Ileng") == 1};
  }
}

double SpringMasses::of(const Scene& scene, std::uint32_t spring) const {
  const Elements& springs = scene.model->spring;
  const NodeIndex* n = springs.of(spring);
  const std::uint32_t part = springs.part[spring];
  if (n[0] == no_index || n[1] == no_index || part == no_index) return 0.0;
  const std::uint32_t property = scene.model->parts[part].prop;
  if (property == no_index) return 0.0;
  const Mass& mass = by_property_[property];
  if (!mass.per_length) return mass.value;
  const Vec d = at(scene.coordinates, n[1]) - at(scene.coordinates, n[0]);
  return mass.value * std::sqrt(dot(d, d));
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

std::vector<Conductivity> conductivities(const deck::Model& model) {
  std::vector<Conductivity> out(model.materials.size());
  if (model.deck == nullptr) return out;
  const Deck& deck = *model.deck;
  CardSchema cards[2];
  const auto cell = [](const char* name, int first, Dimension dimension) {
    deck::Field f;
    f.name = name;
    f.first = first;
    f.last = first + 19;
    f.type = FieldType::real;
    f.dimension = dimension;
    return f;
  };
  const Dimension a{1, 1, -3, -1}, b{1, 1, -3, -2};
  cards[0].fields = {cell("A", 41, a), cell("B", 61, b)};
  cards[1].fields = {cell("T1", 1, {0, 0, 0, 1}), cell("A", 21, a), cell("B", 41, b)};
  for (const Block& block : deck.blocks) {
    if (!block.header.starts_with("/HEAT/MAT/") || block.opaque || !block.id.present) continue;
    const auto it = model.material_of_id.find(block.id.value + deck.offset_of(block, "mat"));
    if (it == model.material_of_id.end()) continue;
    DecodedBlock d;
    d.block = &block;
    LineCursor lines(deck.sources, block);
    for (const CardSchema& card : cards)
      if (const Line line = lines.next(); line.valid())
        d.cards.push_back(decode_line(deck, block, card, line, nullptr));
    const auto value = [&](std::size_t card, std::size_t k) {
      return d.cards.size() > card ? working_value(deck, d, d.cards[card].cells[k]) : 0.0;
    };
    const double melting = value(1, 0);
    out[it->second] = {value(0, 0), value(0, 1), value(1, 1), value(1, 2),
                       melting > 0.0 ? melting : 1e30};
  }
  return out;
}

}  // namespace deck::cycle::detail
