// Completes contacts in parallel: first shared tables, then contacts, with separate findings.
#include "contact/scene/complete_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <span>
#include <vector>

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

constexpr ElementKind lines[] = {ElementKind::truss, ElementKind::beam, ElementKind::spring};
constexpr ElementKind areas[] = {ElementKind::solid8, ElementKind::shell4, ElementKind::shell3};

/// Builds the tables that a contact shares with others, before several threads read them.
void prepare_tables(SceneContext& c, const PendingContact& pending, const Contact& contact) {
  const std::lock_guard lock(c.tables->building);
  const auto prepare = [&](std::span<const ElementKind> families) {
    for (const ElementKind kind : families) c.connectivity.prepare(kind);
  };
  const bool edges = contact.kind == ContactKind::edge_edge;
  if (edges || (pending.surface && !pending.surface->segments.is_from_shells())) prepare(areas);
  if (edges || contact.igap != 0) prepare(lines);
  if (!edges && contact.igap != 0 && !contact.secondary.empty())
    shell_half_thickness(
        {c.model, c.connectivity, *c.tables, c.scene.coordinates, c.options.threads});
  if (edges || !c.options.nodal_stiffness || contact.istf < 2) return;
  prepare(lines);
  prepare(std::span(areas).first(1));
  shell_stiffness_at_nodes(c);
}

void complete(SceneContext& c, const NotEvaluated& not_evaluated, PendingContact& pending,
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

std::size_t size_of(const PendingContact& pending, const Contact& contact) {
  std::size_t size =
      (pending.surface ? pending.surface->segments.size() : 0) + contact.secondary.size();
  for (const EdgeSource* from : {&pending.secondary, &pending.main}) {
    if (from->edges != nullptr) size += from->edges->size();
    if (from->surface) size += 2 * from->surface->segments.size();
  }
  return size;
}

void complete_contact(const SceneContext& c, const NotEvaluated& not_evaluated,
                      PendingContact& pending, int threads) {
  SceneOptions options = c.options;
  options.threads = threads;
  SceneContext own{c.model, c.connectivity, c.scene,     pending.found,
                   options, c.tables,       c.all_placed};
  Contact& contact = c.scene.contacts[pending.place];
  prepare_tables(own, pending, contact);
  complete(own, not_evaluated, pending, contact);
}

}  // namespace deck::detail
