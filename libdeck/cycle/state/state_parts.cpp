// Areas, axes and conductivities, for heat and initial conditions.
#include "cycle/state/state_parts.hpp"

#include <cmath>

#include "contact/shared/scene_parts.hpp"
#include "deck/keyword/decode.hpp"

namespace deck::cycle::detail {

using deck::detail::at;

double shell_area(const Coordinates& x, ElementKind kind, const NodeIndex* n) {
  const Vec d = kind == ElementKind::shell4
                    ? cross(at(x, n[2]) - at(x, n[0]), at(x, n[3]) - at(x, n[1]))
                    : cross(at(x, n[1]) - at(x, n[0]), at(x, n[2]) - at(x, n[0]));
  return 0.5 * std::sqrt(dot(d, d));
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
