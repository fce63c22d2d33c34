// Completes contacts in parallel: first shared tables, then contacts, with separate findings.
#include "contact/scene/complete_contacts.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <vector>

#include "base/shared/parallel.hpp"
#include "base/shared/side_by_side.hpp"
#include "contact/shared/closest.hpp"

namespace deck::detail {
namespace {

void set_edges(const Selections& selections, const EdgeSource& from,
               std::vector<ContactEdge>& out) {
  std::vector<Edge> of_segments;
  if (from.surface) of_segments = selections.edges_of(from.surface->segments, from.free_only);
  const std::vector<Edge>& edges = from.edges != nullptr ? *from.edges : of_segments;
  out.reserve(edges.size());
  for (const Edge& e : edges) {
    if (e.nodes[0] == e.nodes[1] || e.nodes[0] == no_index || e.nodes[1] == no_index) continue;
    ContactEdge edge;
    edge.nodes = e.nodes;
    out.push_back(edge);
  }
}

/// Needed beside the largest gap, which hides NaN.
bool gaps_are_finite(const Contact& c) {
  const auto finite = [](const auto& list) {
    return std::all_of(list.begin(), list.end(),
                       [](const auto& item) { return std::isfinite(item.gap); });
  };
  return std::isfinite(c.max_gap) && std::isfinite(c.gapmin) && finite(c.secondary) &&
         finite(c.main) && finite(c.secondary_edges) && finite(c.main_edges);
}

void complete_contact(SceneContext& c, const NotEvaluated& not_evaluated, PendingContact& pending,
                      Contact& contact) {
  const bool edges = contact.kind == ContactKind::edge_edge;
  if (edges) {
    set_edges(*c.model.selections, pending.secondary, contact.secondary_edges);
    set_edges(*c.model.selections, pending.main, contact.main_edges);
    contact.dropped = contact.role == ContactRole::edges && pending.complete &&
                      (contact.secondary_empty() || contact.main_empty());
    if (contact.dropped) {
      contact.secondary_edges.clear();
      contact.main_edges.clear();
      return;
    }
    set_edge_stiffness(c, contact.main_edges, contact);
    set_edge_stiffness(c, contact.secondary_edges, contact);
    set_edge_gaps(c, contact, pending.gapmin);
  } else {
    if (pending.surface) make_main_segments(c, pending.surface->segments, contact);
    set_main_stiffness(c, contact);
    set_gaps(c, contact, pending.gapmin);
  }
  contact.drad =
      radiation_distance(pending.thermal, pending.drad, contact.max_gap, contact.shortest_side);
  if (c.options.penetrations) {
    pending.failure =
        check_evaluation(c, not_evaluated, pending.card_reason, pending.complete, contact);
    const auto find = edges ? find_edge_penetrations : find_penetrations;
    if (contact.evaluated) find(c, contact, pending.decisions);
  }
  report_one_place(c, contact);
  if (!edges && c.options.nodal_stiffness && contact.istf >= 2) set_nodal_stiffness(c, contact);
}

constexpr ElementKind lines[] = {ElementKind::truss, ElementKind::beam, ElementKind::spring};
constexpr ElementKind areas[] = {ElementKind::solid8, ElementKind::shell4, ElementKind::shell3};

/// Shared tables, built before several threads read them.
struct Common {
  std::array<bool, 8> families{};
  bool half_thickness = false, nodal_stiffness = false;

  void want(std::span<const ElementKind> some) {
    for (const ElementKind kind : some) families[static_cast<std::size_t>(kind)] = true;
  }
  void want_for(const SceneOptions& options, const PendingContact& pending,
                const Contact& contact) {
    const bool edges = contact.kind == ContactKind::edge_edge;
    if (edges || (pending.surface && !pending.surface->segments.is_from_shells())) want(areas);
    if (edges || contact.igap != 0) want(lines);
    half_thickness |= !edges && contact.igap != 0 && !contact.secondary.empty();
    if (edges || !options.nodal_stiffness || contact.istf < 2) return;
    want(lines);
    want(std::span(areas).first(1));
    nodal_stiffness = true;
  }
  void prepare(SceneContext& c, int threads) const {
    parallel_items(threads, families.size(), [&](std::size_t kind) {
      if (families[kind]) c.connectivity.prepare(static_cast<ElementKind>(kind));
    });
    if (half_thickness)
      shell_half_thickness({c.model, c.connectivity, *c.tables, c.scene.coordinates, threads});
    if (nodal_stiffness) shell_stiffness_at_nodes(c);
  }
};

}  // namespace

EvaluationFailure check_evaluation(const SceneContext& c, const NotEvaluated& not_evaluated,
                                   const std::string& card_reason, bool complete,
                                   Contact& contact) {
  contact.evaluated = false;
  const std::string why =
      card_reason.empty() ? not_evaluated.reason_in_nodes(contact) : card_reason;
  if (!why.empty()) return {why, Severity::warning, true};
  NodeIndex lost = no_index;
  const auto look = [&](NodeIndex n) {
    if (!is_finite(at(c.scene.coordinates, n))) lost = n;
  };
  if (!c.all_placed) for_each_node(contact, look);
  if (lost != no_index)
    return {"node " + std::to_string(c.model.nodes.id[lost]) +
            " has a coordinate that is not a finite number"};
  if (std::string cell = unusable_cell(*c.model.deck, *contact.inter); !cell.empty())
    return {std::move(cell), Severity::error, true};
  if (!gaps_are_finite(contact)) return {"the gap is not a finite number"};
  contact.evaluated = complete;
  return {};
}

void complete_contacts(SceneContext& c, const NotEvaluated& not_evaluated,
                       std::vector<PendingContact>& pending,
                       const std::function<void(std::size_t)>& progress) {
  const int threads = effective_threads(c.options.threads);
  SceneOptions alone = c.options;
  alone.threads = 1;
  std::vector<std::size_t> sizes;
  Common common;
  for (const PendingContact& p : pending) {
    const Contact& contact = c.scene.contacts[p.place];
    sizes.push_back((p.surface ? p.surface->segments.size() : 0) + contact.secondary.size());
    for (const EdgeSource* from : {&p.secondary, &p.main}) {
      if (from->edges != nullptr) sizes.back() += from->edges->size();
      if (from->surface) sizes.back() += 2 * from->surface->segments.size();
    }
    common.want_for(c.options, p, contact);
  }
  if (pending.size() > 1) common.prepare(c, threads);
  std::atomic<std::size_t> completed{0};
  side_by_side(threads, sizes, [&](std::size_t i, const Share& share) {
    PendingContact& p = pending[i];
    SceneContext own{
        c.model,  c.connectivity, c.scene, p.found, share.threads > 1 ? c.options : alone,
        c.tables, c.all_placed};
    complete_contact(own, not_evaluated, p, c.scene.contacts[p.place]);
    const std::size_t so_far = ++completed;
    if (share.worker == 0 && so_far < pending.size()) progress(so_far);
  });
}

}  // namespace deck::detail
