// Tables and totals of a scene for all outputs. Nodes, edges and pairs are counted separately.
#include "deck/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/rules/actions.hpp"
#include "contact/shared/node_elements.hpp"
#include "model/shared/families.hpp"

namespace deck {
namespace {

constexpr ElementKind families_in_view[] = {ElementKind::shell4, ElementKind::shell3,
                                            ElementKind::solid8, ElementKind::beam,
                                            ElementKind::truss,  ElementKind::spring};

ElementName name_of(const Model& model, ElementKind kind, std::uint32_t e) {
  const Elements& family = model.family(kind);
  const std::uint32_t part = family.part[e];
  return {kind, e, family.id[e], part == no_index ? 0 : model.parts[part].id};
}

double ratio(const PenetrationRow& row) { return row.gap > 0 ? row.depth / row.gap : 0; }

bool without_element(const Contact& contact) {
  const auto lone = [](const ContactEdge& e) { return e.carrier == Carrier::none; };
  return !contact.no_carrier.empty() ||
         std::any_of(contact.main_edges.begin(), contact.main_edges.end(), lone) ||
         std::any_of(contact.secondary_edges.begin(), contact.secondary_edges.end(), lone);
}

template <class T>
std::uint64_t distinct(std::vector<T>& items) {
  if (!std::is_sorted(items.begin(), items.end())) std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
  return items.size();
}

/// Counts rows, and their distinct nodes and edges.
class Tally {
 public:
  void add(const Contact& contact, const PenetrationRow& row) {
    const bool stops = stops_solver(row.action);
    if (stops) stopped_.add(contact, row);
    if (contact.is_tied_contact()) return tied_.add(contact, row);
    all_.add(contact, row);
    if (row.on_surface) on_segment_.add(contact, row);
    totals_.acted += row.action != PenetrationAction::none && !stops;
    totals_.round_off += !row.in_contact;
    totals_.max_depth = std::max(totals_.max_depth, row.depth);
    totals_.max_ratio = std::max(totals_.max_ratio, ratio(row));
  }
  ContactTotals totals() {
    totals_.count = all_.counts();
    totals_.tied = tied_.counts();
    totals_.on_segment = on_segment_.counts();
    totals_.solver_errors = stopped_.counts().nodes;
    return totals_;
  }

 private:
  struct Items {
    std::uint64_t pairs = 0;
    std::vector<NodeIndex> nodes = {};
    std::vector<std::array<NodeIndex, 2>> edges = {};

    void add(const Contact& contact, const PenetrationRow& row) {
      ++pairs;
      if (contact.kind == ContactKind::node_segment) {
        nodes.push_back(contact.secondary[row.secondary].node);
        return;
      }
      const auto& [a, b] = contact.secondary_edges[row.secondary].nodes;
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
    ItemCounts counts() { return {pairs, distinct(nodes), distinct(edges)}; }
  };
  Items all_, tied_, on_segment_, stopped_;
  ContactTotals totals_;
};

NamedPenetration named(const Scene& scene, Connectivity& connectivity, std::uint32_t c,
                       std::uint32_t r) {
  const Model& model = *scene.model;
  const Contact& contact = scene.contacts[c];
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
    return p;
  }
  const ContactEdge& s = contact.secondary_edges[row.secondary];
  const ContactEdge& m = contact.main_edges[row.main];
  p.secondary = {model.node_id(s.nodes[0]), model.node_id(s.nodes[1])};
  p.main = {model.node_id(m.nodes[0]), model.node_id(m.nodes[1]), 0, 0};
  for (std::size_t k = 0; k < 4 && !contact.points.empty(); ++k)
    p.main[k] = model.node_id(contact.main[row.main].nodes[k]);
  p.secondary_element = carrier_name(model, s.carrier, s.element);
  p.main_element = carrier_name(model, m.carrier, m.element);
  const double h = row.weight_s;
  const Nodes& x = model.nodes;
  const auto mix = [&](const std::vector<double>& a) {
    return h * a[s.nodes[0]] + (1 - h) * a[s.nodes[1]];
  };
  p.at = {mix(x.x), mix(x.y), mix(x.z)};
  if (!contact.points.empty()) p.at = contact.points[row.secondary].at;
  return p;
}

/// `list`: positions in view.penetrations, deepest first.
PartPair part_pair(const Scene& scene, const SceneView& view, std::int64_t secondary,
                   std::int64_t main, const std::vector<std::uint32_t>& list) {
  Tally tally;
  PartPair pair;
  pair.secondary = secondary;
  pair.main = main;
  pair.worst = list.front();
  double sum = 0;
  const auto row_of = [&](std::uint32_t i) -> const PenetrationRow& {
    return scene.contacts[view.penetrations[i].contact].penetrations[view.penetrations[i].row];
  };
  for (const std::uint32_t i : list) {
    sum += row_of(i).depth;
    tally.add(scene.contacts[view.penetrations[i].contact], row_of(i));
  }
  const ContactTotals totals = tally.totals();
  pair.count = totals.count;
  pair.on_segment = totals.on_segment;
  pair.max_ratio = totals.max_ratio;
  pair.max_depth = row_of(list.front()).depth;
  pair.mean_depth = sum / static_cast<double>(list.size());
  // Nearest-rank percentile of a list sorted from deep to shallow.
  pair.p95_depth = row_of(list[list.size() / 20]).depth;
  return pair;
}

struct RowPlace {
  double depth = 0;
  std::uint32_t contact = 0, row = 0;
};

/// All rows: penetrations, then ties; each deepest first, then by contact and row.
std::vector<RowPlace> rows_by_depth(const Scene& scene, std::size_t& penetrations) {
  std::vector<RowPlace> places;
  const auto add = [&](bool ties) {
    const std::size_t begin = places.size();
    for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
      if (scene.contacts[c].is_tied_contact() != ties) continue;
      for (std::uint32_t r = 0; r < scene.contacts[c].penetrations.size(); ++r)
        places.push_back({scene.contacts[c].penetrations[r].depth, c, r});
    }
    std::stable_sort(places.begin() + static_cast<std::ptrdiff_t>(begin), places.end(),
                     [](const RowPlace& a, const RowPlace& b) { return a.depth > b.depth; });
  };
  add(false);
  penetrations = places.size();
  add(true);
  return places;
}

/// Deepest penetration of each secondary node or edge.
void find_deepest(const Scene& scene, const std::vector<RowPlace>& places, SceneView& view) {
  std::vector<std::vector<std::uint8_t>> seen;  // by contact and secondary item
  for (const Contact& c : scene.contacts)
    seen.emplace_back(c.penetrations.empty() ? 0 : c.secondary.size(), 0);
  // Lists of edges may repeat an edge.
  std::set<std::tuple<std::uint32_t, NodeIndex, NodeIndex>> edges;
  for (std::uint32_t i = 0; i < view.penetrations.size(); ++i) {
    const RowPlace& p = places[i];
    const Contact& c = scene.contacts[p.contact];
    const std::uint32_t secondary = c.penetrations[p.row].secondary;
    if (c.kind == ContactKind::edge_edge) {
      const auto& [a, b] = c.secondary_edges[secondary].nodes;
      if (!edges.emplace(p.contact, std::min(a, b), std::max(a, b)).second) continue;
    } else if (std::exchange(seen[p.contact][secondary], std::uint8_t{1}) != 0) {
      continue;
    }
    view.deepest_per_node.push_back(i);
  }
}

void pair_parts(const Scene& scene, SceneView& view) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>> pairs;
  auto last = pairs.end();  // rows of a pair of parts mostly follow each other
  for (std::uint32_t i = 0; i < view.penetrations.size(); ++i) {
    const NamedPenetration& p = view.penetrations[i];
    const std::pair parts(p.secondary_element.part, p.main_element.part);
    if (last == pairs.end() || last->first != parts) last = pairs.try_emplace(parts).first;
    last->second.push_back(i);
  }
  for (const auto& [parts, list] : pairs)
    view.part_pairs.push_back(part_pair(scene, view, parts.first, parts.second, list));
}

}  // namespace

const Elements* elements_of(const Model& model, Carrier carrier) {
  const auto kind = detail::family_of_carrier(carrier);
  return kind ? &model.family(*kind) : nullptr;
}

ElementName carrier_name(const Model& model, Carrier carrier, std::uint32_t e) {
  const auto kind = detail::family_of_carrier(carrier);
  return kind && e != no_index ? name_of(model, *kind, e) : ElementName{};
}

ElementName element_at(const Model& model, Connectivity& connectivity, NodeIndex node) {
  for (const ElementKind kind : families_in_view) {
    const std::uint32_t e = connectivity.first(kind, node);
    if (e != no_index) return name_of(model, kind, e);
  }
  return {};
}

NotCleanReason not_clean_reason(const Contact& contact) {
  if (contact.dropped) return NotCleanReason::none;
  if (contact.type >= 24 && contact.kind == ContactKind::edge_edge) return NotCleanReason::none;
  if (contact.main_empty()) return NotCleanReason::empty_main;
  if (contact.secondary_empty()) return NotCleanReason::empty_secondary;
  if (!is_type24_or_25(contact.type) && !(contact.gapmin > 0)) return NotCleanReason::no_gap;
  if (contact.degenerate_segments > 0) return NotCleanReason::no_area;
  if (without_element(contact)) return NotCleanReason::no_element;
  const bool idle = contact.kind == ContactKind::node_segment &&
                    std::all_of(contact.main.begin(), contact.main.end(),
                                [](const MainSegment& m) { return m.stiffness == 0; });
  return idle ? NotCleanReason::no_stiffness : NotCleanReason::none;
}

std::string_view to_string(NotCleanReason reason) {
  static constexpr std::string_view words[] = {"",        "empty_main", "empty_secondary", "no_gap",
                                               "no_area", "no_element", "no_stiffness"};
  return words[static_cast<std::size_t>(reason)];
}

int on_surface_error(const Contact& contact) {
  if (contact.kind == ContactKind::edge_edge) return 0;
  return detail::on_surface_error(contact.type, contact.itied, contact.fpenmax, contact.inacti);
}

double largest_bounded_gap(const Model& model) {
  double square = 0;
  for (const std::vector<double>* x : {&model.nodes.x, &model.nodes.y, &model.nodes.z}) {
    if (x->empty()) continue;
    const auto [low, high] = std::minmax_element(x->begin(), x->end());
    square += (*high - *low) * (*high - *low);
  }
  return square > 0 && square < 1e60 ? 10 * std::sqrt(square) : 1e30;
}

std::vector<std::uint32_t> untied_secondary(const Contact& contact) {
  std::vector<std::uint32_t> out;
  if (!contact.is_tied_contact() || !contact.evaluated) return out;
  std::vector<bool> tied(contact.secondary.size(), false);
  for (const PenetrationRow& row : contact.penetrations) tied[row.secondary] = true;
  for (std::uint32_t i = 0; i < tied.size(); ++i)
    if (!tied[i]) out.push_back(i);
  return out;
}

SceneView make_view(const Scene& scene, const std::vector<Crossing>* crossings, int threads) {
  threads = effective_threads(threads);
  SceneView view;
  std::vector<RowPlace> places;
  std::size_t penetrations = 0;  // of the places; ties follow them
  const auto order_places = [&] { places = rows_by_depth(scene, penetrations); };
  const auto count = [&] {
    Tally all;
    std::uint64_t untied = 0;
    for (const Contact& contact : scene.contacts) {
      Tally tally;
      for (const PenetrationRow& row : contact.penetrations) {
        tally.add(contact, row);
        all.add(contact, row);
      }
      view.contacts.push_back(tally.totals());
      ContactTotals& own = view.contacts.back();
      own.untied = untied_secondary(contact).size();
      untied += own.untied;
    }
    view.total = all.totals();
    view.total.untied = untied;
  };
  parallel_items(threads, 2, [&](std::size_t i) { i == 0 ? order_places() : count(); });
  if (crossings != nullptr) {
    view.total.crossed_elements = crossings->size();
    for (ContactTotals& t : view.contacts) t.crossed_elements = 0;
    for (const Crossing& x : *crossings) ++*view.contacts[x.contact].crossed_elements;
  }
  // Rows are named in mesh order.
  std::vector<std::uint32_t> in_order(places.size());
  std::vector<std::size_t> first_of_contact;
  for (std::size_t rows = 0; const Contact& c : scene.contacts) {
    first_of_contact.push_back(rows);
    rows += c.penetrations.size();
  }
  for (std::uint32_t i = 0; i < places.size(); ++i)
    in_order[first_of_contact[places[i].contact] + places[i].row] = i;
  Connectivity connectivity(*scene.model);
  // A few names need no array over all nodes and families; many names do.
  constexpr std::size_t many = 4096;
  const int namers = places.size() < many ? 1 : threads;
  if (namers > 1)
    for (const ElementKind kind : families_in_view) connectivity.prepare_first(kind, namers);
  view.penetrations.resize(penetrations);
  view.ties.resize(places.size() - penetrations);
  parallel_pieces(namers, in_order.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t at = in_order[k];
      (at < penetrations ? view.penetrations[at] : view.ties[at - penetrations]) =
          named(scene, connectivity, places[at].contact, places[at].row);
    }
  });
  parallel_items(threads, 2, [&](std::size_t i) {
    i == 0 ? find_deepest(scene, places, view) : pair_parts(scene, view);
  });
  std::stable_sort(view.part_pairs.begin(), view.part_pairs.end(),
                   [](const PartPair& a, const PartPair& b) { return a.max_depth > b.max_depth; });
  return view;
}

}  // namespace deck
