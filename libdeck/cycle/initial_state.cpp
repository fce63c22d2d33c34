// Masses, velocities and temperatures of nodes: of elements, added masses, initial conditions.
#include "deck/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "contact/shared/scene_steps.hpp"
#include "cycle/adapter/effect_inputs.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"
#include "model/shared/mesh.hpp"

namespace deck::cycle {
namespace {

using deck::detail::at;

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

/// Allocates a velocity for every node.
void allocate_velocities(const Scene& scene, State& state) {
  for (auto& v : state.velocity) v.resize(scene.model->nodes.size(), 0.0);
}

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
      if (block.schema->keyword == "/INIVEL/TRA") {
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

  /// First data line behind the title, by the columns of `card`. `cards_` owns the card.
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
    allocate_velocities(scene_, state_);
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
    allocate_temperatures();
    for (const NodeIndex n : nodes->nodes)
      if (n != no_index) state_.temperature[n] = t;
    state_.heated = true;
  }

  void allocate_temperatures() { state_.temperature.resize(scene_.model->nodes.size(), 0.0); }

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
    allocate_temperatures();
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
  allocate_velocities(scene, state);
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

void from_mesh(const Scene& scene, const EngineFiles* engine, int threads, State& state) {
  MeshOptions how;
  how.threads = threads;
  how.coordinates = &scene.coordinates;
  how.engine = engine;
  Mesh mesh = make_mesh(*scene.model, how);
  state.mass = std::move(mesh.nodes.lumped_mass);
  // An unknown mass counts as 0.
  for (double& m : state.mass)
    if (std::isnan(m)) m = 0.0;
  if (mesh.total.slowest.element != no_index)
    state.structure = {step_scale * mesh.total.dt, mesh.total.slowest.kind,
                       mesh.total.slowest.element};
  for (const LeftOut& left : mesh.left_out)
    if (left.what.starts_with("/ADMAS")) state.not_evaluated.push_back(left.what + ": " + left.why);
}

}  // namespace

State make_state(const Scene& scene, const std::vector<PartVelocity>& velocities,
                 const EngineFiles* engine, int threads) {
  State state;
  const deck::Model& model = *scene.model;
  from_mesh(scene, engine, threads, state);
  if (model.deck != nullptr) InitialConditions(scene, state).read();
  for (const PartVelocity& wish : velocities) try_velocity(scene, wish, state);
  for (const auto& v : state.velocity)
    state.moving =
        state.moving || std::any_of(v.begin(), v.end(), [](double x) { return x != 0.0; });
  return state;
}

}  // namespace deck::cycle
