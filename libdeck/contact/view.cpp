#include "deck/contact/view.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "contact/node_elements.hpp"

namespace deck {
namespace {

constexpr ElementKind families[] = {ElementKind::shell4, ElementKind::shell3, ElementKind::solid8,
                                    ElementKind::beam,   ElementKind::truss,  ElementKind::spring};

ElementName name_of(const Model& model, ElementKind kind, std::uint32_t e) {
  const Elements& family = model.family(kind);
  const std::uint32_t part = family.part[e];
  return {kind, e, family.id[e], part == no_index ? 0 : model.parts[part].id};
}

std::optional<ElementKind> kind_of(Carrier carrier) {
  switch (carrier) {
    case Carrier::solid:
      return ElementKind::solid8;
    case Carrier::shell4:
      return ElementKind::shell4;
    case Carrier::shell3:
      return ElementKind::shell3;
    case Carrier::truss:
      return ElementKind::truss;
    case Carrier::beam:
      return ElementKind::beam;
    case Carrier::spring:
      return ElementKind::spring;
    default:
      return std::nullopt;
  }
}

}  // namespace

const Elements* elements_of(const Model& model, Carrier carrier) {
  const auto kind = kind_of(carrier);
  return kind ? &model.family(*kind) : nullptr;
}

ElementName carrier_name(const Model& model, Carrier carrier, std::uint32_t e) {
  const auto kind = kind_of(carrier);
  return kind && e != no_index ? name_of(model, *kind, e) : ElementName{};
}

namespace {

/// The element a node is named after: the first family that has one, smallest index.
ElementName element_at(const Model& model, Connectivity& connectivity, NodeIndex node) {
  for (const ElementKind kind : families) {
    const auto list = connectivity.elements(kind, node);
    if (!list.empty()) return name_of(model, kind, list[0]);
  }
  return {};
}

double ratio(const PenetrationRow& row) { return row.gap > 0 ? row.depth / row.gap : 0; }

}  // namespace

int on_surface_error(const Contact& contact) {
  if (contact.kind == ContactKind::edge_edge || contact.fpenmax != 0 || contact.inacti == 1 ||
      contact.inacti == 2)
    return 0;
  if (contact.type == 10 && contact.itied != 0) return 0;
  return contact.inacti == 0 ? 612 : 611;
}

SceneView make_view(const Scene& scene) {
  SceneView view;
  const Model& model = *scene.model;
  Connectivity connectivity(model);
  view.contacts.resize(scene.contacts.size());
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    ContactTotals& t = view.contacts[c];
    std::set<std::uint32_t> distinct;
    for (std::uint32_t r = 0; r < contact.penetrations.size(); ++r) {
      const PenetrationRow& row = contact.penetrations[r];
      NamedPenetration p;
      p.contact = c;
      p.row = r;
      if (contact.kind == ContactKind::node_segment) {
        const NodeIndex n = contact.secondary[row.secondary].node;
        const MainSegment& m = contact.main[row.main];
        p.secondary = {model.node_id(n), 0};
        for (std::size_t k = 0; k < 4; ++k) p.main[k] = model.node_id(m.nodes[k]);
        p.secondary_element = element_at(model, connectivity, n);
        p.main_element = carrier_name(model, m.carrier, m.element);
        p.at = {model.nodes.x[n], model.nodes.y[n], model.nodes.z[n]};
      } else {
        const ContactEdge& s = contact.secondary_edges[row.secondary];
        const ContactEdge& m = contact.main_edges[row.main];
        p.secondary = {model.node_id(s.nodes[0]), model.node_id(s.nodes[1])};
        p.main = {model.node_id(m.nodes[0]), model.node_id(m.nodes[1]), 0, 0};
        p.secondary_element = carrier_name(model, s.carrier, s.element);
        p.main_element = carrier_name(model, m.carrier, m.element);
        const double h = row.weight_s;
        const Nodes& x = model.nodes;
        const auto mix = [&](const std::vector<double>& a) {
          return h * a[s.nodes[0]] + (1 - h) * a[s.nodes[1]];
        };
        p.at = {mix(x.x), mix(x.y), mix(x.z)};
      }
      distinct.insert(row.secondary);
      ++t.pairs;
      t.on_surface += row.on_surface;
      t.solver_errors += row.on_surface && on_surface_error(contact) != 0;
      t.acted += row.action != PenetrationAction::none;
      t.max_depth = std::max(t.max_depth, row.depth);
      t.max_ratio = std::max(t.max_ratio, ratio(row));
      view.penetrations.push_back(p);
    }
    t.nodes = distinct.size();
    view.total.pairs += t.pairs;
    view.total.nodes += t.nodes;
    view.total.on_surface += t.on_surface;
    view.total.solver_errors += t.solver_errors;
    view.total.acted += t.acted;
    view.total.max_depth = std::max(view.total.max_depth, t.max_depth);
    view.total.max_ratio = std::max(view.total.max_ratio, t.max_ratio);
  }
  const auto row_of = [&](const NamedPenetration& p) -> const PenetrationRow& {
    return scene.contacts[p.contact].penetrations[p.row];
  };
  std::stable_sort(view.penetrations.begin(), view.penetrations.end(),
                   [&](const NamedPenetration& a, const NamedPenetration& b) {
                     return row_of(a).depth > row_of(b).depth;
                   });
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < view.penetrations.size(); ++i) {
    const NamedPenetration& p = view.penetrations[i];
    if (seen.emplace(p.contact, row_of(p).secondary).second) view.deepest_per_node.push_back(i);
    pairs[{p.secondary_element.part, p.main_element.part}].push_back(i);
  }
  for (const auto& [parts, list] : pairs) {
    PartPair pair;
    pair.secondary = parts.first;
    pair.main = parts.second;
    pair.pairs = list.size();
    pair.worst = list.front();
    std::set<std::pair<std::uint32_t, std::uint32_t>> nodes;
    double sum = 0;
    for (const std::uint32_t i : list) {
      const PenetrationRow& row = row_of(view.penetrations[i]);
      sum += row.depth;
      pair.on_surface += row.on_surface;
      pair.max_ratio = std::max(pair.max_ratio, ratio(row));
      nodes.emplace(view.penetrations[i].contact, row.secondary);
    }
    pair.nodes = nodes.size();
    pair.max_depth = row_of(view.penetrations[list.front()]).depth;
    pair.mean_depth = sum / static_cast<double>(list.size());
    // Nearest-rank percentile; the list runs from deep to shallow.
    pair.p95_depth = row_of(view.penetrations[list[list.size() / 20]]).depth;
    view.part_pairs.push_back(pair);
  }
  std::stable_sort(view.part_pairs.begin(), view.part_pairs.end(),
                   [](const PartPair& a, const PartPair& b) { return a.max_depth > b.max_depth; });
  return view;
}

}  // namespace deck
