// One evaluation of all contacts of a scene: forces, energies, time steps, effects that ran.
#include "deck/cycle.hpp"

#include <algorithm>
#include <cmath>

#include "cycle/shared/contact_run.hpp"

namespace deck::cycle {
namespace {

using detail::NodeStiffness;

/// Contacts of one interface (TYPE19) add stiffness at shared nodes, so the interface allows a
/// smaller step than each contact alone. The step goes to the contact with the largest share.
void limit_interfaces(const State& state, const std::vector<NodeStiffness>& by_contact,
                      SceneOutcome& out) {
  struct NodeSum {
    double all = 0.0, most = 0.0;
    std::size_t contact = 0;  ///< contact with the largest share
  };
  std::map<const InterBase*, std::vector<std::size_t>> interfaces;
  for (std::size_t i = 0; i < out.contacts.size(); ++i)
    interfaces[out.contacts[i].contact->inter].push_back(i);
  for (const auto& [inter, members] : interfaces) {
    if (members.size() == 1) continue;
    std::map<NodeIndex, NodeSum> sums;
    for (const std::size_t i : members)
      for (const auto& [n, s] : by_contact[i]) {
        NodeSum& sum = sums[n];
        sum.all += s;
        if (s > sum.most) sum = {sum.all, s, i};
      }
    for (const auto& [n, sum] : sums) {
      if (!(sum.most > 0.0 && state.mass[n] > 0.0)) continue;
      ContactOutcome& c = out.contacts[sum.contact];
      const double dt = step_scale * std::sqrt(2.0 * state.mass[n] / sum.all);
      if (!(dt < c.step.dt)) continue;
      c.step = {StepLimit::Source::nodal, dt, n};
      c.step_node = n;
    }
  }
}

/// Step of all contacts together: stiffnesses add up at nodes.
void limit_all(const State& state, const std::vector<NodeStiffness>& by_contact,
               SceneOutcome& out) {
  for (std::size_t i = 0; i < out.contacts.size(); ++i) {
    const ContactOutcome& c = out.contacts[i];
    if (c.step.source == StepLimit::Source::none || c.step.source == StepLimit::Source::nodal)
      continue;
    if (c.step.dt < out.contact_dt) {
      out.contact_dt = c.step.dt;
      out.contact_dt_source = c.step.source;
      out.limiting_contact = i;
      out.limiting_node = c.step_node;
    }
  }
  for (NodeIndex n = 0; n < state.mass.size(); ++n) {
    const double s = out.nodes.stiffness[n];
    if (!(s > 0.0 && state.mass[n] > 0.0)) continue;
    const double dt = step_scale * std::sqrt(2.0 * state.mass[n] / s);
    if (!(dt < out.contact_dt)) continue;
    out.contact_dt = dt;
    out.contact_dt_source = StepLimit::Source::nodal;
    out.limiting_node = n;
  }
  if (out.contact_dt_source != StepLimit::Source::nodal) return;
  // The stiffest contact at that node.
  double most = 0.0;
  for (std::size_t i = 0; i < by_contact.size(); ++i) {
    const auto it = std::lower_bound(by_contact[i].begin(), by_contact[i].end(),
                                     std::pair{out.limiting_node, 0.0});
    if (it == by_contact[i].end() || it->first != out.limiting_node || it->second <= most) continue;
    most = it->second;
    out.limiting_contact = i;
  }
}

}  // namespace

/// Memory of all contacts between evaluations.
struct CycleRun::Memory {
  explicit Memory(const Scene& scene)
      : unread(deck::detail::unread_at_nodes(*scene.model, true)), connectivity(*scene.model) {
    contacts.resize(scene.contacts.size());
    for (const Contact& c : scene.contacts) cards.push_back(make_card(scene, c));
    if (std::any_of(cards.begin(), cards.end(), [](const auto& card) { return card.ibc != 0; }))
      fixed = detail::fixed_translations(*scene.model);
  }
  std::vector<ContactCard> cards;
  std::vector<detail::ContactMemory> contacts;
  std::vector<std::uint8_t> fixed;
  std::map<NodeIndex, std::string> unread;
  Connectivity connectivity;
};

CycleRun::CycleRun(const Scene& scene, bool remember)
    : scene_(&scene), remember_(remember), memory_(std::make_unique<Memory>(scene)) {}
CycleRun::~CycleRun() = default;

std::size_t CycleRun::searches() const {
  std::size_t sum = 0;
  for (const detail::ContactMemory& m : memory_->contacts) sum += m.searches;
  return sum;
}

SceneOutcome CycleRun::evaluate(const Coordinates& x, const State& state,
                                const CycleOptions& options) {
  const Scene& scene = *scene_;
  Memory& memory = *memory_;
  const detail::RunContext run{
      scene, x, state, options, remember_, memory.fixed, memory.unread, memory.connectivity};
  SceneOutcome out;
  // Heat sums are allocated only if a contact adds to them: nodes are many.
  out.nodes.resize(scene.model->nodes.size(),
                   std::any_of(memory.cards.begin(), memory.cards.end(),
                               [](const ContactCard& card) { return card.ithe > 0; }));
  out.contacts.resize(scene.contacts.size());
  std::vector<NodeStiffness> stiffness(scene.contacts.size());
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    ContactOutcome& c = out.contacts[i];
    c.contact = &scene.contacts[i];
    c.card = memory.cards[i];
    if (options.change_card) options.change_card(c.card);
    stiffness[i] = detail::run_contact(run, memory.contacts[i], c, out.nodes);
    if (options.progress) options.progress(i + 1, scene.contacts.size());
  }
  for (NodeIndex n = 0; n < scene.model->nodes.size(); ++n) {
    double f2 = 0.0;
    for (std::size_t c = 0; c < 3; ++c) f2 += out.nodes.force[c][n] * out.nodes.force[c][n];
    if (const double f = std::sqrt(f2); f > out.largest_nodal_force) {
      out.largest_nodal_force = f;
      out.force_node = n;
    }
  }
  limit_interfaces(state, stiffness, out);
  limit_all(state, stiffness, out);
  out.structure = state.structure;
  return out;
}

SceneOutcome run_cycle(const Scene& scene, const State& state, const CycleOptions& options) {
  return CycleRun(scene, false).evaluate(scene.coordinates, state, options);
}

std::vector<ActedNode> acted_nodes(const State& state, const SceneOutcome& outcome) {
  std::vector<ActedNode> out;
  const NodalSums& sums = outcome.nodes;
  for (NodeIndex n = 0; n < sums.stiffness.size(); ++n) {
    ActedNode a{n, {sums.force[0][n], sums.force[1][n], sums.force[2][n]}, sums.stiffness[n]};
    const bool pushed = a.force[0] != 0.0 || a.force[1] != 0.0 || a.force[2] != 0.0;
    if (!pushed && a.stiffness == 0.0) continue;
    if (a.stiffness > 0.0 && state.mass[n] > 0.0)
      a.dt = step_scale * std::sqrt(2.0 * state.mass[n] / a.stiffness);
    out.push_back(a);
  }
  return out;
}

InterfaceSummary summarize(const std::vector<const ContactOutcome*>& contacts,
                           const StructureStep& structure) {
  InterfaceSummary s;
  s.structure_dt = structure.dt;
  for (const ContactOutcome* c : contacts) {
    s.inter = c->contact->inter;
    s.id = s.inter->id;
    s.active = s.active || c->active;
    s.pairs_in_reach += c->pairs_in_reach;
    s.pairs_with_force += c->pairs_with_force;
    s.largest_pair_force = std::max(s.largest_pair_force, c->largest_force);
    s.force_sum += c->totals.total_abs;
    s.elastic_energy += c->totals.elastic_energy;
    s.friction_energy += c->totals.friction_energy;
    s.damping_energy += c->totals.damping_energy;
    if (s.acceleration_node == no_index || c->largest_acceleration > s.largest_acceleration) {
      s.largest_acceleration = c->largest_acceleration;
      s.acceleration_node = c->acceleration_node;
    }
    if (c->step.dt < s.contact_dt) {
      s.contact_dt = c->step.dt;
      s.contact_dt_source = c->step.source;
      s.contact_dt_node = c->step_node;
    }
    s.gap_closed += c->gap_closed;
    s.near_singular += c->near_singular_count;
  }
  return s;
}

std::vector<InterfaceSummary> summarize(const Scene& scene, const SceneOutcome& outcome) {
  std::vector<InterfaceSummary> all;
  for (const InterBase* inter : scene.interfaces->ordered) {
    std::vector<const ContactOutcome*> contacts;
    for (const ContactOutcome& c : outcome.contacts)
      if (c.contact->inter == inter) contacts.push_back(&c);
    if (!contacts.empty()) all.push_back(summarize(contacts, outcome.structure));
  }
  return all;
}

}  // namespace deck::cycle
