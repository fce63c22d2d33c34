// Masses, velocities and temperatures of all nodes, gathered from elements, added masses and
// initial conditions.
#include "deck/cycle/state.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "contact/scene/scene_parts.hpp"
#include "cycle/state/state_parts.hpp"
#include "deck/keyword/decode.hpp"
#include "deck/model/selection.hpp"
#include "deck/text/number.hpp"

namespace deck::cycle {
namespace {

using deck::detail::at;

bool complete(const NodeIndex* n, int count) {
  return std::find(n, n + count, no_index) == n + count;
}

/// Shares of a triangle's corners: their angles (measured on the reference solver's masses).
std::array<double, 4> corner_shares(const Coordinates& x, const NodeIndex* n) {
  std::array<double, 4> share{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec a = at(x, n[(c + 1) % 3]) - at(x, n[c]), b = at(x, n[(c + 2) % 3]) - at(x, n[c]);
    const Vec s = cross(a, b);
    share[c] = std::atan2(std::sqrt(dot(s, s)), dot(a, b)) / std::numbers::pi;
  }
  return share;
}

void add_shells(const Scene& scene, ElementKind kind, std::vector<double>& mass) {
  const Elements& family = scene.model->family(kind);
  const int corners = kind == ElementKind::shell4 ? 4 : 3;
  const detail::ElementMasses mass_of(scene, kind);
  for (std::uint32_t e = 0; e < family.size(); ++e) {
    const NodeIndex* n = family.of(e);
    if (!complete(n, corners)) continue;
    const double m = mass_of(e);
    const std::array<double, 4> share = kind == ElementKind::shell4
                                            ? std::array<double, 4>{0.25, 0.25, 0.25, 0.25}
                                            : corner_shares(scene.coordinates, n);
    for (std::size_t c = 0; c < static_cast<std::size_t>(corners); ++c) mass[n[c]] += share[c] * m;
  }
}

/// Shares of a solid's mass: the eight slots, and the mid-side nodes where the shape has some.
void add_solids(const Scene& scene, std::vector<double>& mass) {
  const Elements& family = scene.model->solid8;
  const detail::ElementMasses mass_of(scene, ElementKind::solid8);
  for (std::uint32_t e = 0; e < family.size(); ++e) {
    const NodeIndex* n = family.of(e);
    if (!complete(n, 8)) continue;
    const SolidShape shape = family.shape[e];
    const double m = mass_of(e);
    const bool has_extra = e < family.extra.size() && family.extra[e] != no_index;
    double slot = 0.125, middle = 0.0;
    int middles = 0;
    if (has_extra && shape == SolidShape::tetra10) {
      constexpr double q = 4 * 3.0 / 14 + 6;  // every corner fills two slots
      slot = 0.5 * (3.0 / 14) / q;
      middle = 1 / q;
      middles = 6;
    } else if (has_extra && shape == SolidShape::brick20) {
      constexpr double q = 8 * 3.0 / 14 + 12;
      slot = (3.0 / 14) / q;
      middle = 1 / q;
      middles = 12;
    } else if (has_extra && shape == SolidShape::thick16) {
      slot = 1.0 / 32;
      middle = 3.0 / 32;
      middles = 8;
    }
    for (int c = 0; c < 8; ++c) mass[n[c]] += slot * m;
    for (int c = 0; c < middles; ++c) {
      const NodeIndex extra = family.extra_nodes[family.extra[e] + static_cast<std::uint32_t>(c)];
      if (extra != no_index) mass[extra] += middle * m;
    }
  }
}

void add_lines(const Scene& scene, std::vector<double>& mass) {
  for (const ElementKind kind : {ElementKind::truss, ElementKind::beam}) {
    const Elements& family = scene.model->family(kind);
    const detail::ElementMasses mass_of(scene, kind);
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const NodeIndex* n = family.of(e);
      if (!complete(n, 2)) continue;
      const double half = 0.5 * mass_of(e);
      mass[n[0]] += half;
      mass[n[1]] += half;
    }
  }
  const Elements& springs = scene.model->spring;
  const detail::SpringMasses spring_masses(*scene.model);
  for (std::uint32_t e = 0; e < springs.size(); ++e) {
    const NodeIndex* n = springs.of(e);
    if (!complete(n, 2)) continue;
    const double half = 0.5 * spring_masses.of(scene, e);
    mass[n[0]] += half;
    mass[n[1]] += half;
  }
}

/// A real or integer cell of a card that no schema describes.
deck::Field cell_field(const char* name, int first, int last, FieldType type,
                       Dimension dimension = {}) {
  deck::Field f;
  f.name = name;
  f.first = first;
  f.last = last;
  f.type = type;
  f.dimension = dimension;
  return f;
}

/// From here on the state has a velocity for every node.
void give_velocities(const Scene& scene, State& state) {
  for (auto& v : state.velocity) v.resize(scene.model->nodes.size(), 0.0);
}

/// Reads what the deck says about the state.
class InitialConditions {
 public:
  InitialConditions(const Scene& scene, State& state)
      : deck_(*scene.model->deck), scene_(scene), state_(state) {}

  void read() {
    for (const Block& block : deck_.blocks)
      if (block.header.starts_with("/HEAT/MAT/") && !block.opaque) material_temperature(block);
    for (const Block& block : deck_.blocks) {
      if (block.schema == nullptr || block.opaque) continue;
      const std::string_view header = block.header;
      if (header.starts_with("/ADMAS")) {
        added_mass(block);
      } else if (block.schema->keyword == "/INIVEL/TRA") {
        velocity(block, decode(deck_, block));
      } else if (header.starts_with("/INIVEL/T+G")) {
        velocity(block, decode_as(block, velocity_card()));
      } else if (block.schema->keyword == "/INITEMP") {
        temperature(block);
      } else if (header.starts_with("/REFSTA") || header.starts_with("/XREF") ||
                 header.starts_with("/EREF")) {
        left_out(block, "masses are those of the deck's own geometry, not of the reference state");
      } else if (header.starts_with("/INIVEL") && !header.starts_with("/INIVEL/ROT") &&
                 !header.starts_with("/INIVEL/GRID")) {
        left_out(block, "this type of initial velocity is not evaluated");
      }
    }
  }

 private:
  static CardSchema velocity_card() {
    CardSchema card;
    const Dimension speed{0, 1, -1, 0};
    card.fields = {cell_field("Vx", 1, 20, FieldType::real, speed),
                   cell_field("Vy", 21, 40, FieldType::real, speed),
                   cell_field("Vz", 41, 60, FieldType::real, speed),
                   cell_field("grnod_ID", 61, 70, FieldType::integer),
                   cell_field("skew_ID", 71, 80, FieldType::integer)};
    return card;
  }

  /// The first data line behind the title, by the columns of `card`. The card is kept: cells point
  /// to its fields.
  DecodedBlock decode_as(const Block& block, CardSchema card) {
    cards_.push_back(std::make_unique<CardSchema>(std::move(card)));
    DecodedBlock d;
    d.block = &block;
    LineCursor lines(deck_.sources, block);
    if (block.schema != nullptr && block.schema->has_title) lines.next();
    for (Line line = lines.next(); line.valid(); line = lines.next())
      d.cards.push_back(decode_line(deck_, block, *cards_.back(), line, nullptr));
    return d;
  }

  double value(const DecodedBlock& d, std::string_view name) const {
    const Cell* cell = d.find(name);
    return cell == nullptr ? 0.0 : working_value(deck_, d, *cell);
  }

  const NodeSet* group(const Block& block, std::int64_t id) {
    if (id == 0 || scene_.model->selections == nullptr) return nullptr;
    return scene_.model->selections->node_group(id + deck_.offset_of(block, "grnod"));
  }

  void left_out(const Block& block, const std::string& why) {
    state_.not_evaluated.push_back(std::string(block.header) + " (" +
                                   deck_.sources.where(block.header_span) + "): " + why);
  }

  void velocity(const Block& block, const DecodedBlock& d) {
    const NodeSet* nodes = group(block, d.integer("grnod_ID"));
    if (nodes == nullptr) {
      left_out(block, "its node group does not exist");
      return;
    }
    std::array<double, 3> v{value(d, "Vx"), value(d, "Vy"), value(d, "Vz")};
    if (const std::int64_t skew = d.integer("skew_ID"); skew != 0) {
      const auto axes = detail::fixed_axes(*scene_.model, skew + deck_.offset_of(block, "skew"));
      if (!axes) {
        left_out(block, "its skew is not fixed in space, or does not exist");
        return;
      }
      v = axes->turn(v);
    }
    give_velocities(scene_, state_);
    for (const NodeIndex n : nodes->nodes)
      if (n != no_index)
        for (std::size_t c = 0; c < 3; ++c) state_.velocity[c][n] = v[c];
  }

  void temperature(const Block& block) {
    const DecodedBlock d = decode(deck_, block);
    const NodeSet* nodes = group(block, d.integer("grnod_ID"));
    if (nodes == nullptr) {
      left_out(block, "its node group does not exist");
      return;
    }
    const double t = value(d, "T0");
    give_temperatures();
    for (const NodeIndex n : nodes->nodes)
      if (n != no_index) state_.temperature[n] = t;
    state_.heated = true;
  }

  void give_temperatures() { state_.temperature.resize(scene_.model->nodes.size(), 0.0); }

  /// T0 of a /HEAT/MAT for all nodes of its material's elements.
  void material_temperature(const Block& block) {
    LineCursor lines(deck_.sources, block);
    const Line line = lines.next();
    if (!line.valid() || !block.id.present) return;
    const RealCell t = read_real(line.text.substr(0, 20));
    const std::int64_t id = block.id.value + deck_.offset_of(block, "mat");
    const auto mat = scene_.model->material_of_id.find(id);
    if (t.status != NumberStatus::ok || mat == scene_.model->material_of_id.end()) return;
    state_.heated = true;
    give_temperatures();
    for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                   ElementKind::truss, ElementKind::beam}) {
      const Elements& family = scene_.model->family(kind);
      const int count = kind == ElementKind::beam ? 2 : family.width;
      for (std::uint32_t e = 0; e < family.size(); ++e) {
        const std::uint32_t part = family.part[e];
        if (part == no_index || scene_.model->parts[part].mat != mat->second) continue;
        for (int c = 0; c < count; ++c)
          if (const NodeIndex n = family.of(e)[c]; n != no_index) state_.temperature[n] = t.value;
      }
    }
  }

  /// /ADMAS/type/id: 0 gives the mass to every node of the group, 1 spreads it evenly.
  void added_mass(const Block& block) {
    const std::string_view rest = block.header.substr(std::string_view("/ADMAS").size());
    const char type = rest.size() > 1 && (rest.size() == 2 || rest[2] == '/') ? rest[1] : '?';
    if (type != '0' && type != '1') {
      left_out(block, "only types 0 and 1 of added mass are evaluated");
      return;
    }
    CardSchema card;
    card.fields = {cell_field("Mass", 1, 20, FieldType::real, Dimension{1, 0, 0, 0}),
                   cell_field("grnod_ID", 21, 30, FieldType::integer)};
    const DecodedBlock d = decode_as(block, std::move(card));
    for (const DecodedCard& line : d.cards) {
      const NodeSet* nodes = group(block, line.cells[1].integer);
      if (nodes == nullptr || nodes->nodes.empty()) {
        left_out(block, "its node group does not exist");
        continue;
      }
      const double factor =
          conversion_factor(units(block), deck_.begin.working, Dimension{1, 0, 0, 0});
      double m = line.cells[0].real * factor;
      if (type == '1') m /= static_cast<double>(nodes->nodes.size());
      for (const NodeIndex n : nodes->nodes)
        if (n != no_index) state_.mass[n] += m;
    }
  }

  /// Units of a block whose header carries more than an id: those of its submodel or of the deck.
  const UnitSystem& units(const Block& block) const {
    if (block.submodel >= 0) {
      const auto& own = deck_.submodels[static_cast<std::size_t>(block.submodel)].units;
      if (own) return *own;
    }
    return deck_.begin.input;
  }

  const Deck& deck_;
  const Scene& scene_;
  State& state_;
  std::vector<std::unique_ptr<CardSchema>> cards_;
};

void try_velocity(const Scene& scene, const PartVelocity& wish, State& state) {
  const deck::Model& model = *scene.model;
  const auto it = model.part_of_id.find(wish.part);
  if (it == model.part_of_id.end()) {
    state.not_evaluated.push_back("velocity of part " + std::to_string(wish.part) +
                                  ": there is no such part");
    return;
  }
  give_velocities(scene, state);
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                 ElementKind::truss, ElementKind::beam, ElementKind::spring}) {
    const Elements& family = model.family(kind);
    const auto set = [&](NodeIndex n) {
      if (n != no_index)
        for (std::size_t c = 0; c < 3; ++c) state.velocity[c][n] = wish.velocity[c];
    };
    // The third node of a beam or spring only orients it.
    const bool line = kind == ElementKind::beam || kind == ElementKind::spring;
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      if (family.part[e] != it->second) continue;
      const int count = line ? 2 : family.width;
      for (int c = 0; c < count; ++c) set(family.of(e)[c]);
      if (kind != ElementKind::solid8 || e >= family.extra.size() || family.extra[e] == no_index)
        continue;
      for (int c = 0; c < extra_node_count(family.shape[e]); ++c)
        set(family.extra_nodes[family.extra[e] + static_cast<std::uint32_t>(c)]);
    }
  }
}

}  // namespace

State make_state(const Scene& scene, const std::vector<PartVelocity>& velocities) {
  State state;
  const deck::Model& model = *scene.model;
  state.mass.assign(model.nodes.size(), 0.0);
  add_shells(scene, ElementKind::shell4, state.mass);
  add_shells(scene, ElementKind::shell3, state.mass);
  add_solids(scene, state.mass);
  add_lines(scene, state.mass);
  if (model.deck != nullptr) InitialConditions(scene, state).read();
  for (const PartVelocity& wish : velocities) try_velocity(scene, wish, state);
  for (const auto& v : state.velocity)
    state.moving =
        state.moving || std::any_of(v.begin(), v.end(), [](double x) { return x != 0.0; });
  return state;
}

}  // namespace deck::cycle
