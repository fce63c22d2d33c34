// Tables and totals of a scene for all outputs. Nodes, edges and pairs are counted separately.
#include "deck/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/rules/actions.hpp"
#include "contact/shared/node_elements.hpp"
#include "contact/shared/reported.hpp"
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

/// The element that names a node, without id and part.
ElementName first_element(Connectivity& connectivity, NodeIndex node) {
  for (const ElementKind kind : families_in_view) {
    const std::uint32_t e = connectivity.first(kind, node);
    if (e != no_index) return {kind, e};
  }
  return {};
}

using Place = NamedPenetrations::Place;

/// Elements at the secondary node or edge and on the main side.
std::array<ElementName, 2> elements_at(const Model& model, const Contact& c, const Place& place) {
  const PenetrationRow& row = c.penetrations[place.row];
  if (c.kind == ContactKind::edge_edge) {
    const ContactEdge &s = c.secondary_edges[row.secondary], &m = c.main_edges[row.main];
    return {carrier_name(model, s.carrier, s.element), carrier_name(model, m.carrier, m.element)};
  }
  const MainSegment& m = c.main[row.main];
  return {place.element == no_index ? ElementName{} : name_of(model, place.kind, place.element),
          carrier_name(model, m.carrier, m.element)};
}

/// A row of a scene that is to be sorted by depth.
struct Row {
  double depth = 0;
  Place place;
  std::uint32_t pair = 0;  ///< of parts, by first occurrence
  bool deepest = false;    ///< of its contact's rows at this node or edge
};

/// `rows`: of one contact, in its order. Of equal depths the first is marked.
void mark_deepest(const Contact& c, std::span<Row> rows) {
  std::vector<Row*> deepest(c.secondary.size() + c.secondary_edges.size());
  std::map<std::array<NodeIndex, 2>, std::uint32_t> edges;  // lists of edges may repeat an edge
  for (Row& r : rows) {
    std::uint32_t at = c.penetrations[r.place.row].secondary;
    if (c.kind == ContactKind::edge_edge) {
      const auto& [a, b] = c.secondary_edges[at].nodes;
      at = edges.try_emplace({std::min(a, b), std::max(a, b)}, at).first->second;
    }
    if (deepest[at] == nullptr || deepest[at]->depth < r.depth) deepest[at] = &r;
  }
  for (Row* r : deepest)
    if (r != nullptr) r->deepest = true;
}

/// Lists of a view that depend on the order by depth. Rows are looked at in mesh order before they
/// are sorted.
class RowsByDepth {
 public:
  RowsByDepth(const Scene& scene, SceneView& view)
      : scene_(scene), connectivity_(*scene.model), view_(view) {}

  void list_ties() { sort_into(view_.ties, true); }
  void list_penetrations() {
    const std::vector<Row> rows = sort_into(view_.penetrations, false);
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
      if (rows[i].deepest) view_.deepest_per_node.push_back(i);
      add(rows[i].pair, i, rows[i].depth);
    }
    for (PartPair& p : view_.part_pairs) p.mean_depth /= static_cast<double>(p.count.pairs);
    std::sort(view_.part_pairs.begin(), view_.part_pairs.end(),
              [](const PartPair& a, const PartPair& b) {
                return std::tuple(b.max_depth, a.secondary, a.main) <
                       std::tuple(a.max_depth, b.secondary, b.main);
              });
  }

 private:
  std::vector<Row> sort_into(NamedPenetrations& out, bool ties) {
    std::vector<Row> rows;
    for (std::uint32_t c = 0; c < scene_.contacts.size(); ++c) {
      const Contact& contact = scene_.contacts[c];
      if (contact.is_tied_contact() != ties) continue;
      const std::size_t first = rows.size();
      for (std::uint32_t r = 0; r < contact.penetrations.size(); ++r) {
        const PenetrationRow& row = contact.penetrations[r];
        ElementName at;
        if (contact.kind == ContactKind::node_segment)
          at = first_element(connectivity_, contact.secondary[row.secondary].node);
        rows.push_back({row.depth, {c, r, at.kind, at.index}});
        if (!ties) rows.back().pair = pair_of(contact, rows.back().place);
      }
      if (!ties && rows.size() > first) mark_deepest(contact, std::span(rows).subspan(first));
    }
    if (!ties) count_pairs(rows);
    std::stable_sort(rows.begin(), rows.end(),
                     [](const Row& a, const Row& b) { return a.depth > b.depth; });
    out = {scene_.model, scene_.contacts, {}};
    out.places.reserve(rows.size());
    for (const Row& r : rows) out.places.push_back(r.place);
    return rows;
  }

  std::uint32_t pair_of(const Contact& contact, const Place& place) {
    const auto [secondary, main] = elements_at(*scene_.model, contact, place);
    const std::pair parts(secondary.part, main.part);
    if (last_ == pairs_.end() || last_->first != parts) {  // mostly those of the row before
      bool is_new = false;
      std::tie(last_, is_new) =
          pairs_.try_emplace(parts, static_cast<std::uint32_t>(view_.part_pairs.size()));
      if (is_new) view_.part_pairs.push_back({secondary.part, main.part, {}, {}});
    }
    return last_->second;
  }
  /// Figures of pairs of parts that do not depend on the order.
  void count_pairs(const std::vector<Row>& rows) {
    std::vector<Tally> tallies(view_.part_pairs.size());
    for (const Row& r : rows) {
      const Contact& c = scene_.contacts[r.place.contact];
      tallies[r.pair].add(c, c.penetrations[r.place.row]);
    }
    for (std::size_t i = 0; i < tallies.size(); ++i) {
      const ContactTotals totals = tallies[i].totals();
      PartPair& pair = view_.part_pairs[i];
      pair.count = totals.count;
      pair.on_segment = totals.on_segment;
      pair.max_ratio = totals.max_ratio;
    }
    seen_.assign(tallies.size(), 0);
  }
  /// Those that do.
  void add(std::uint32_t pair, std::uint32_t at, double depth) {
    PartPair& p = view_.part_pairs[pair];
    if (seen_[pair] == 0) {
      p.worst = at;
      p.max_depth = depth;
    }
    p.mean_depth += depth;  // the sum, first
    // Nearest-rank percentile of a list sorted from deep to shallow.
    if (seen_[pair]++ == p.count.pairs / 20) p.p95_depth = depth;
  }

  const Scene& scene_;
  Connectivity connectivity_;
  SceneView& view_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> pairs_;  // by parts
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t>::iterator last_ = pairs_.end();
  std::vector<std::uint64_t> seen_;  // rows by pair
};

double ten_model_sizes(const Model& model) {
  double square = 0;
  for (const std::vector<double>* x : {&model.nodes.x, &model.nodes.y, &model.nodes.z}) {
    if (x->empty()) continue;
    const auto [low, high] = std::minmax_element(x->begin(), x->end());
    square += (*high - *low) * (*high - *low);
  }
  return square > 0 && square < 1e60 ? 10 * std::sqrt(square) : 1e30;
}

}  // namespace

std::array<ElementName, 2> NamedPenetrations::elements(std::size_t i) const {
  return elements_at(*model, contacts[places[i].contact], places[i]);
}

NamedPenetration NamedPenetrations::operator[](std::size_t i) const {
  const Contact& c = contacts[places[i].contact];
  const PenetrationRow& row = c.penetrations[places[i].row];
  const Nodes& nodes = model->nodes;
  const auto [secondary, main] = elements(i);
  NamedPenetration p{places[i].contact, places[i].row, {}, {}, secondary, main, {}};
  const auto set_ids = [&](auto& ids, std::span<const NodeIndex> of) {
    for (std::size_t k = 0; k < of.size(); ++k) ids[k] = model->node_id(of[k]);
  };
  if (c.kind == ContactKind::node_segment) {
    const NodeIndex n = c.secondary[row.secondary].node;
    p.secondary[0] = model->node_id(n);
    set_ids(p.main, c.main[row.main].nodes);
    p.at = {nodes.x[n], nodes.y[n], nodes.z[n]};
    return p;
  }
  const auto& [a, b] = c.secondary_edges[row.secondary].nodes;
  set_ids(p.secondary, c.secondary_edges[row.secondary].nodes);
  if (!c.points.empty()) {
    set_ids(p.main, c.main[row.main].nodes);
    p.at = c.points[row.secondary].at;
    return p;
  }
  set_ids(p.main, c.main_edges[row.main].nodes);
  const double h = row.weight_s;
  const auto mix = [&, a = a, b = b](const std::vector<double>& x) {
    return h * x[a] + (1 - h) * x[b];
  };
  p.at = {mix(nodes.x), mix(nodes.y), mix(nodes.z)};
  return p;
}

const Elements* elements_of(const Model& model, Carrier carrier) {
  const auto kind = detail::family_of_carrier(carrier);
  return kind ? &model.family(*kind) : nullptr;
}

ElementName carrier_name(const Model& model, Carrier carrier, std::uint32_t e) {
  const auto kind = detail::family_of_carrier(carrier);
  return kind && e != no_index ? name_of(model, *kind, e) : ElementName{};
}

ElementName element_at(const Model& model, Connectivity& connectivity, NodeIndex node) {
  const ElementName first = first_element(connectivity, node);
  return first.valid() ? name_of(model, first.kind, first.index) : first;
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
    view.largest_gap = ten_model_sizes(*scene.model);
  };
  const auto order = [&] {
    RowsByDepth rows(scene, view);
    rows.list_ties();
    rows.list_penetrations();
  };
  parallel_items(threads, 2, [&](std::size_t i) { i == 0 ? order() : count(); });
  if (crossings != nullptr) {
    view.total.crossed_elements = crossings->size();
    for (ContactTotals& t : view.contacts) t.crossed_elements = 0;
    for (const Crossing& x : *crossings) ++*view.contacts[x.contact].crossed_elements;
  }
  return view;
}

}  // namespace deck
