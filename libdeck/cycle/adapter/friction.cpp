// /FRICTION by pairs of parts, assigned to the pairs of a contact.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "contact/shared/scene_steps.hpp"
#include "cycle/adapter/effect_inputs.hpp"
#include "cycle/kernel/block.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "model/shared/families.hpp"

namespace deck::cycle {
namespace {

/// Part of a node: that of its last shell, else solid, beam, truss, spring. A recorded run with
/// nodes between two parts shows that the later element counts.
std::uint32_t part_at(const deck::Model& model, Connectivity& connectivity, NodeIndex node) {
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                 ElementKind::beam, ElementKind::truss, ElementKind::spring}) {
    const auto list = connectivity.elements(kind, node);
    if (!list.empty()) return model.family(kind).part[list[list.size() - 1]];
  }
  return no_index;
}

/// /FRICTION by pairs of parts: entry by (smaller, larger) part index.
std::map<std::pair<std::uint32_t, std::uint32_t>, const FrictionPair*> part_pairs(
    const deck::Model& model, const Friction& friction) {
  const auto parts = [&](std::int64_t group, std::int64_t part) {
    std::vector<std::uint32_t> list;
    if (group != 0 && model.selections != nullptr)
      if (const auto* members = model.selections->part_group(group)) list = *members;
    if (const auto it = model.part_of_id.find(part); part != 0 && it != model.part_of_id.end())
      list.push_back(it->second);
    return list;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, const FrictionPair*> table;
  for (const FrictionPair& pair : friction.pairs) {
    const auto second = parts(pair.grpart_ID2, pair.part_ID2);
    for (const std::uint32_t a : parts(pair.grpart_ID1, pair.part_ID1))
      for (const std::uint32_t b : second) table.emplace(std::minmax(a, b), &pair);
  }
  return table;
}

}  // namespace

namespace detail {

std::uint32_t part_of(const deck::Model& model, Carrier carrier, std::uint32_t element) {
  const auto family = deck::detail::family_of_carrier(carrier);
  return family && element != no_index ? model.family(*family).part[element] : no_index;
}

namespace {

Vec position(const Coordinates& x, NodeIndex n) { return {x.x[n], x.y[n], x.z[n]}; }

/// First direction that /FRIC_ORIENT gives a part: a vector, turned by an angle about the normal.
struct Orientation {
  Vec vector;
  double turn = 0.0;  ///< radians
};

std::map<std::uint32_t, Orientation> orientations(const deck::Model& model) {
  std::map<std::uint32_t, Orientation> table;
  if (model.deck == nullptr) return table;
  for (const Block& block : model.deck->blocks) {
    if (block.schema == nullptr || block.schema->keyword != "/FRIC_ORIENT") continue;
    const DecodedBlock d = decode(*model.deck, block);
    std::vector<std::uint32_t> parts;
    for (const DecodedCard& card : d.cards) {
      Orientation o;
      std::int64_t skew = 0;
      bool direction = false;
      for (const Cell& cell : card.cells) {
        const std::string& name = cell.field->name;
        const std::int64_t id = cell.integer == 0 || cell.field->ref.empty()
                                    ? cell.integer
                                    : cell.integer + model.deck->offset_of(block, cell.field->ref);
        if (name == "grpart_ID") parts.clear();
        if (name == "grpart_ID" && id != 0 && model.selections != nullptr)
          if (const auto* members = model.selections->part_group(id)) parts = *members;
        if (name == "part_ID" && id != 0)
          if (const auto it = model.part_of_id.find(id); it != model.part_of_id.end())
            parts.push_back(it->second);
        if (name == "Vx") o.vector.x = cell.real, direction = true;
        if (name == "Vy") o.vector.y = cell.real;
        if (name == "Vz") o.vector.z = cell.real;
        if (name == "phi") o.turn = cell.real * (std::numbers::pi / 180.0);
        if (name == "skew_ID") skew = id;
      }
      if (!direction) continue;
      if (skew != 0)
        if (const auto axes = fixed_axes(model, skew)) {
          const auto v = axes->turn({o.vector.x, o.vector.y, o.vector.z});
          o.vector = {v[0], v[1], v[2]};
        }
      for (const std::uint32_t part : parts) table.insert_or_assign(part, o);
    }
  }
  return table;
}

/// Unit components of an orientation in the axes of a segment; (1, 0) if normal to it.
std::array<double, 2> direction_in(const Coordinates& x, const MainSegment& m,
                                   const Orientation& o) {
  const bool triangle = m.nodes[2] == m.nodes[3];
  const SegmentAxes axes(position(x, m.nodes[0]), position(x, m.nodes[1]), position(x, m.nodes[2]),
                         position(x, m.nodes[3]), triangle);
  Vec v = o.vector - dot(o.vector, axes.normal) * axes.normal;
  const double size = norm(v);
  if (!(size > 1e-12 * norm(o.vector))) return {1.0, 0.0};
  v = (1.0 / size) * v;
  v = std::cos(o.turn) * v + std::sin(o.turn) * cross(axes.normal, v);
  return {dot(v, axes.first), dot(v, axes.second)};
}

}  // namespace

void pair_friction(const Scene& scene, const Contact& contact, ContactPairs& out) {
  std::int64_t id = 0;
  visit_interface(*contact.inter, [&](const auto& i) {
    if constexpr (requires { i.fric_ID; }) id = i.fric_ID.value;
  });
  const Friction* friction = scene.interfaces->friction(id);
  if (friction == nullptr) return;
  const auto table = part_pairs(*scene.model, *friction);
  Connectivity connectivity(*scene.model);
  const bool edges = contact.kind == deck::ContactKind::edge_edge;
  std::vector<std::uint32_t> node_part(contact.secondary.size(), no_index - 1);
  const auto secondary_part = [&](std::uint32_t i) {
    if (edges) {
      const ContactEdge& e = contact.secondary_edges[i];
      return part_of(*scene.model, e.carrier, e.element);
    }
    if (node_part[i] == no_index - 1)
      node_part[i] = part_at(*scene.model, connectivity, contact.secondary[i].node);
    return node_part[i];
  };
  const auto main_part = [&](std::uint32_t i) {
    if (edges)
      return part_of(*scene.model, contact.main_edges[i].carrier, contact.main_edges[i].element);
    return part_of(*scene.model, contact.main[i].carrier, contact.main[i].element);
  };
  const bool directed = has_orthotropic_pairs(*friction) && !edges;
  const auto oriented =
      directed ? orientations(*scene.model) : std::map<std::uint32_t, Orientation>{};
  for (const CandidatePair& p : out.at) {
    const auto it = table.find(std::minmax(secondary_part(p.secondary), main_part(p.main)));
    const FrictionPair* pair = it == table.end() ? nullptr : it->second;
    const FrictionValues& v = pair == nullptr ? friction->values : pair->values;
    out.fric.push_back(v.Fric);
    out.visf2.push_back(v.VISF);  // the solver does not square VISF here
    for (std::size_t k = 0; k < 6; ++k) out.c[k].push_back(v.C[k]);
    if (!directed) continue;
    const bool has_direction = pair != nullptr && pair->Idir == 1;
    const FrictionValues& across = has_direction ? pair->second : v;
    out.directed.push_back(has_direction ? 1.0 : 0.0);
    out.ortho_mu[0].push_back(v.Fric);
    out.ortho_mu[1].push_back(across.Fric);
    for (std::size_t k = 0; k < 6; ++k) out.c2[k].push_back(across.C[k]);
    const auto o = oriented.find(main_part(p.main));
    const auto along = !has_direction || o == oriented.end()
                           ? std::array<double, 2>{1.0, 0.0}
                           : direction_in(scene.coordinates, contact.main[p.main], o->second);
    for (std::size_t k = 0; k < 2; ++k) out.ortho_direction[k].push_back(along[k]);
  }
}

bool has_orthotropic_pairs(const Friction& friction) {
  return std::any_of(friction.pairs.begin(), friction.pairs.end(),
                     [](const FrictionPair& p) { return p.Idir == 1; });
}

}  // namespace detail
}  // namespace deck::cycle
