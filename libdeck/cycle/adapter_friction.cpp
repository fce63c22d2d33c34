// /FRICTION by pairs of parts, handed to the pairs of a contact.
#include <algorithm>
#include <map>

#include "contact/scene_parts.hpp"
#include "cycle/adapter_parts.hpp"
#include "cycle/state_parts.hpp"
#include "deck/model/selection.hpp"

namespace deck::cycle {
namespace {

/// The part a node counts for: that of its first shell, then solid, beam, truss, spring.
std::uint32_t part_at(const deck::Model& model, Connectivity& connectivity, NodeIndex node) {
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                 ElementKind::beam, ElementKind::truss, ElementKind::spring}) {
    const auto list = connectivity.elements(kind, node);
    if (!list.empty()) return model.family(kind).part[list[0]];
  }
  return no_index;
}

/// /FRICTION by pairs of parts: which entry, by (smaller, larger) part index.
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
  if (element == no_index) return no_index;
  switch (carrier) {
    case Carrier::solid:
      return model.solid8.part[element];
    case Carrier::shell4:
      return model.shell4.part[element];
    case Carrier::shell3:
      return model.shell3.part[element];
    case Carrier::truss:
      return model.truss.part[element];
    case Carrier::beam:
      return model.beam.part[element];
    case Carrier::spring:
      return model.spring.part[element];
    default:
      return no_index;
  }
}

void pair_friction(const Scene& scene, const Contact& contact, Model model, ContactPairs& out) {
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
  const bool directed = orthotropic(*friction) && !edges;
  for (const CandidatePair& p : out.at) {
    const auto it = table.find(std::minmax(secondary_part(p.secondary), main_part(p.main)));
    const FrictionPair* pair = it == table.end() ? nullptr : it->second;
    const FrictionValues& v = pair == nullptr ? friction->values : pair->values;
    const double visf = v.VISF == 0.0 ? 1.0 : v.VISF;
    out.fric.push_back(v.Fric);
    // The reference solver does not square the factor of /FRICTION.
    out.visf2.push_back(model == Model::reference ? visf : visf * visf);
    for (std::size_t k = 0; k < 6; ++k) out.c[k].push_back(v.C[k]);
    if (!directed) continue;
    out.ortho_mu[0].push_back(v.Fric);
    out.ortho_mu[1].push_back(pair != nullptr && pair->Idir == 1 ? pair->second.Fric : v.Fric);
    out.ortho_direction[0].push_back(1.0);
    out.ortho_direction[1].push_back(0.0);
  }
}

bool orthotropic(const Friction& friction) {
  return friction.Ifric == 0 && std::any_of(friction.pairs.begin(), friction.pairs.end(),
                                            [](const FrictionPair& p) { return p.Idir == 1; });
}

}  // namespace detail
}  // namespace deck::cycle
