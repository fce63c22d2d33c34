// One cycle of all contacts of a scene: forces, energies, time steps, and which effects ran.
#include "deck/cycle/scene_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "deck/cycle/sharing.hpp"

namespace deck::cycle {
namespace {

constexpr std::size_t most_listed = 20;
constexpr double step_factor = 0.9;

/// The nodes of one contact's pairs, numbered on their own, so that the work of a small contact
/// does not grow with the model.
class LocalNodes {
 public:
  LocalNodes(PairList& pairs, const Scene& scene, const State& state) {
    const std::size_t roles = pairs.kind == ContactKind::edge_edge ? 4 : 5;
    for (std::size_t r = 0; r < roles; ++r)
      node_.insert(node_.end(), pairs.node[r].begin(), pairs.node[r].end());
    std::sort(node_.begin(), node_.end());
    node_.erase(std::unique(node_.begin(), node_.end()), node_.end());
    for (std::size_t r = 0; r < roles; ++r)
      for (std::uint32_t& n : pairs.node[r])
        n = static_cast<std::uint32_t>(std::lower_bound(node_.begin(), node_.end(), n) -
                                       node_.begin());
    const std::vector<double>* x[] = {&scene.coordinates.x, &scene.coordinates.y,
                                      &scene.coordinates.z};
    for (std::size_t c = 0; c < 3; ++c) {
      position_[c] = pick(*x[c]);
      velocity_[c] = pick(state.velocity[c]);
    }
    mass_ = pick(state.mass);
    temperature_ = pick(state.temperature);
  }
  std::size_t size() const { return node_.size(); }
  NodeIndex global(std::size_t local) const { return node_[local]; }
  const std::vector<double>& mass() const { return mass_; }
  const std::array<std::vector<double>, 3>& velocity() const { return velocity_; }
  NodalState arrays() const {
    NodalState s;
    for (std::size_t c = 0; c < 3; ++c) {
      s.position[c] = position_[c].data();
      s.velocity[c] = velocity_[c].data();
    }
    s.mass = mass_.data();
    s.temperature = temperature_.data();
    return s;
  }

 private:
  std::vector<double> pick(const std::vector<double>& from) const {
    std::vector<double> to(node_.size());
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[node_[i]];
    return to;
  }
  std::vector<NodeIndex> node_;
  std::array<std::vector<double>, 3> position_, velocity_;
  std::vector<double> mass_, temperature_;
};

/// Points the view at the pairs' own arrays. What a fresh start does not know — friction memory,
/// ties — is zero.
void attach(PacketView& view, const ContactPairs& pairs, const std::vector<double>& zero) {
  const auto data = [](const std::vector<double>& v) { return v.empty() ? nullptr : v.data(); };
  view.k0 = data(pairs.k0);
  view.gap = data(pairs.gap);
  view.p0 = data(pairs.p0);
  view.ft_old = {zero.data(), zero.data(), zero.data()};
  view.tie.fill(zero.data());
  view.area = data(pairs.area);
  view.conductivity = data(pairs.conductivity);
  for (std::size_t k = 0; k < 2; ++k) {
    view.edge_width[k] = data(pairs.edge_width[k]);
    view.ortho_mu[k] = data(pairs.ortho_mu[k]);
    view.ortho_direction[k] = data(pairs.ortho_direction[k]);
  }
  for (std::size_t k = 0; k < 4; ++k) view.edge_conductivity[k] = data(pairs.edge_conductivity[k]);
  view.fric = data(pairs.fric);
  view.visf2 = data(pairs.visf2);
  for (std::size_t k = 0; k < 6; ++k) view.c[k] = data(pairs.c[k]);
  for (std::size_t k = 0; k < 6; ++k) view.c2[k] = data(pairs.c2[k]);
  view.directed = data(pairs.directed);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 3; ++c) view.normal[k][c] = data(pairs.normal[k][c]);
}

PairOutcome outcome_of(const ContactPairs& pairs, const PacketResult& r, std::size_t i) {
  PairOutcome p;
  p.at = pairs.at[i];
  for (std::size_t k = 0; k < 4; ++k) p.weights[k] = r.weights[k][i];
  for (std::size_t c = 0; c < 3; ++c) p.force[c] = r.force[c][i];
  p.normal_force = r.normal_force[i];
  p.penetration = r.penetration[i];
  p.gap = r.effective_gap[i];
  p.distance = r.distance[i];
  p.k0 = pairs.k0[i];
  p.k_nodal = r.k_nodal[i];
  p.status = r.status[i];
  return p;
}

double size_of(const PacketResult& r, std::size_t i) {
  return std::sqrt(r.force[0][i] * r.force[0][i] + r.force[1][i] * r.force[1][i] +
                   r.force[2][i] * r.force[2][i]);
}

/// Share of the gap that a pair has left before its mid-surface.
double left_of_gap(const PairOutcome& p) {
  return p.gap > 0.0 ? (p.gap - p.penetration) / p.gap : 1.0;
}

void collect_pairs(const ContactPairs& pairs, const PacketResult& r, const CycleOptions& options,
                   ContactOutcome& out) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs.k0[i] == 0.0) ++out.pairs_switched_off;
    const double f = size_of(r, i);
    if (!(f > 0.0 || r.penetration[i] > 0.0)) {
      out.gap_closed += (r.status[i] & status_gap_closed) != 0;
      continue;
    }
    const PairOutcome p = outcome_of(pairs, r, i);
    out.gap_closed += (p.status & status_gap_closed) != 0;
    out.pairs_with_force += f > 0.0;
    if (f > out.largest_force) {
      out.largest_force = f;
      out.largest = p;
    }
    if (left_of_gap(p) < options.near_singular && out.card.kind != ContactKind::tied) {
      ++out.near_singular_count;
      out.near_singular.push_back(p);
      if (out.near_singular.size() > 50 * most_listed) {
        std::stable_sort(
            out.near_singular.begin(), out.near_singular.end(),
            [](const auto& a, const auto& b) { return left_of_gap(a) < left_of_gap(b); });
        out.near_singular.resize(most_listed);
      }
    }
    if (options.keep_pairs) out.pairs.push_back(p);
  }
  std::stable_sort(out.near_singular.begin(), out.near_singular.end(),
                   [](const auto& a, const auto& b) { return left_of_gap(a) < left_of_gap(b); });
  if (out.near_singular.size() > most_listed) out.near_singular.resize(most_listed);
}

/// The interface-wide limit from the velocity ranges of all nodes of both sides.
double velocity_limit(const Contact& contact, const ContactCard& card, const State& state) {
  if (!state.moving) return 1e30;
  constexpr double big = 1e300;
  std::array<double, 3> low[2], high[2];
  for (std::size_t side = 0; side < 2; ++side) {
    low[side].fill(big);
    high[side].fill(-big);
  }
  const auto add = [&](std::size_t side, NodeIndex n) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[side][c] = std::min(low[side][c], state.velocity[c][n]);
      high[side][c] = std::max(high[side][c], state.velocity[c][n]);
    }
  };
  double least_s = big, least_m = big;
  for (const SecondaryNode& s : contact.secondary) {
    add(0, s.node);
    least_s = std::min(least_s, s.gap);
  }
  for (const MainSegment& m : contact.main) {
    for (const NodeIndex n : m.nodes) add(1, n);
    least_m = std::min(least_m, m.gap);
  }
  for (const ContactEdge& e : contact.secondary_edges) {
    for (const NodeIndex n : e.nodes) add(0, n);
    least_s = std::min(least_s, e.gap);
  }
  for (const ContactEdge& e : contact.main_edges) {
    for (const NodeIndex n : e.nodes) add(1, n);
    least_m = std::min(least_m, e.gap);
  }
  if (least_s == big || least_m == big) return 1e30;
  const double gap = contact.igap == 0 ? card.gapmin : std::max(least_s + least_m, card.gapmin);
  return velocity_step(gap, low[0], high[0], low[1], high[1]);
}

/// Forces, steps and accelerations at the nodes of one contact, and into the sums of all.
void collect_nodes(const LocalNodes& nodes, const NodalSums& sums, ContactOutcome& out,
                   NodalSums& all) {
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const NodeIndex g = nodes.global(n);
    double f2 = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      all.force[c][g] += sums.force[c][n];
      f2 += sums.force[c][n] * sums.force[c][n];
    }
    all.stiffness[g] += sums.stiffness[n];
    all.heat[g] += sums.heat[n];
    all.conductance[g] += sums.conductance[n];
    all.contact[g] |= sums.contact[n];
    all.removed[g] |= sums.removed[n];
    all.released[g] |= sums.released[n];
    if (!(f2 > 0.0)) continue;
    if (!(nodes.mass()[n] > 0.0)) {
      ++out.massless_nodes;
      continue;
    }
    const double a = std::sqrt(f2) / nodes.mass()[n];
    if (a > out.largest_acceleration) {
      out.largest_acceleration = a;
      out.acceleration_node = g;
    }
  }
}

void sum_heat(const PacketResult& r, ContactOutcome& out) {
  const std::size_t secondary = out.card.kind == ContactKind::edge_edge ? 2 : 1;
  for (std::size_t i = 0; i < r.size; ++i)
    for (std::size_t k = 0; k < 5; ++k)
      (k < secondary ? out.heat_secondary : out.heat_main) += r.heat[k][i];
}

using NodeStiffness = std::vector<std::pair<NodeIndex, double>>;

/// False for cards with values that no arithmetic survives, such as a gap of 1e300.
bool sane(const ContactCard& card, const Contact& contact) {
  for (const double v :
       {card.gapmin, card.stfac, card.viss, card.visf, card.fric, card.drad, contact.max_gap})
    if (!(std::abs(v) < 1e30)) return false;
  return true;
}

/// What the card asks for and this evaluation leaves out.
void note_gaps(const State& state, ContactOutcome& out) {
  if (out.card.ithe > 0 && !state.heated)
    out.notes.emplace_back("the deck gives no initial temperature: all are 0");
}

/// Evaluates one contact; returns the stiffness it gives to its nodes.
NodeStiffness run_contact(const Scene& scene, const State& state, const CycleOptions& options,
                          ContactOutcome& out, NodalSums& all) {
  const Contact& contact = *out.contact;
  if (contact.dropped) return {};
  const KernelPlan plan = make_plan(out.card, options.model, options.plan);
  out.effects = plan.account;
  out.composition = plan.composition;
  out.isa = plan.isa;
  note_gaps(state, out);
  if (!sane(out.card, contact)) {
    out.notes.emplace_back("the card has values out of range: nothing was evaluated");
    out.complete = false;
    return {};
  }
  if (!contact.evaluated) {
    out.notes.emplace_back("start-up could not be evaluated, see the findings: no forces either");
    out.complete = false;
    return {};
  }
  out.active = is_active(out.card, options.time);
  if (!out.active) return {};
  ContactPairs pairs = make_pairs(scene, contact, out.card, options.model, options.threads);
  out.complete = pairs.complete;
  if (!pairs.complete)
    out.notes.emplace_back(
        "too many pairs are within reach for the memory allowed (--max-memory): nothing was "
        "evaluated");
  if (out.card.ithe > 0) add_conductivity(scene, contact, state.temperature, pairs);
  out.pairs_in_reach = pairs.size();
  const double from_velocity = velocity_limit(contact, out.card, state);
  if (pairs.size() == 0) {
    if (from_velocity < 1e30) out.step = {StepLimit::Source::velocity, from_velocity, SIZE_MAX};
    return {};
  }
  const LocalNodes nodes(pairs.nodes, scene, state);
  PacketBuffer buffer;
  buffer.gather(nodes.arrays(), pairs.nodes, plan.needs | Field::position);
  PacketView view = buffer.view();
  const std::vector<double> zero(pairs.size(), 0.0);
  attach(view, pairs, zero);
  view.dt1 = options.dt1;
  view.dt12 = options.dt12;
  PacketResult result;
  evaluate(plan, view, result, static_cast<unsigned>(std::max(1, options.threads)));
  if (options.model == Model::robust && out.card.kind != ContactKind::tied && out.card.itied == 0)
    apply_shares(pair_shares(pairs.nodes, result), result);
  out.totals = totals(plan, view, result);
  if (out.card.ithe > 0) sum_heat(result, out);
  collect_pairs(pairs, result, options, out);
  NodalSums sums;
  sums.resize(nodes.size());
  assemble(plan, Incidence(pairs.nodes, nodes.size()), result, sums,
           static_cast<unsigned>(std::max(1, options.threads)));
  collect_nodes(nodes, sums, out, all);
  out.step = step_limit(out.totals, sums, nodes.mass().data(), step_factor, from_velocity);
  if (out.step.source == StepLimit::Source::nodal)
    out.step_node = nodes.global(out.step.index);
  else if (out.step.source == StepLimit::Source::kinematic)
    out.step_node = nodes.global(pairs.nodes.node[0][out.step.index]);
  NodeStiffness stiffness;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (sums.stiffness[n] > 0.0) stiffness.emplace_back(nodes.global(n), sums.stiffness[n]);
  return stiffness;
}

/// The step of all contacts together: nodes add up what every contact gives them.
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
    const double dt = step_factor * std::sqrt(2.0 * state.mass[n] / s);
    if (!(dt < out.contact_dt)) continue;
    out.contact_dt = dt;
    out.contact_dt_source = StepLimit::Source::nodal;
    out.limiting_node = n;
  }
  if (out.contact_dt_source != StepLimit::Source::nodal) return;
  // Of the contacts at that node, the one that stiffens it most.
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

SceneOutcome run_cycle(const Scene& scene, const State& state, const CycleOptions& options) {
  SceneOutcome out;
  out.nodes.resize(scene.model->nodes.size());
  out.contacts.resize(scene.contacts.size());
  std::vector<NodeStiffness> stiffness(scene.contacts.size());
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    ContactOutcome& c = out.contacts[i];
    c.contact = &scene.contacts[i];
    c.card = make_card(scene, *c.contact);
    stiffness[i] = run_contact(scene, state, options, c, out.nodes);
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
  limit_all(state, stiffness, out);
  out.structure = structure_step(scene);
  return out;
}

std::vector<InterfaceSummary> summarize(const Scene& scene, const SceneOutcome& outcome) {
  std::vector<InterfaceSummary> all;
  for (const InterBase* inter : scene.interfaces->ordered) {
    InterfaceSummary s;
    s.id = inter->id;
    s.inter = inter;
    s.structure_dt = outcome.structure.dt;
    bool found = false, active = false;
    for (const ContactOutcome& c : outcome.contacts) {
      if (c.contact->inter != inter) continue;
      found = true;
      active = active || c.active;
      s.pairs_with_force += c.pairs_with_force;
      s.largest_pair_force = std::max(s.largest_pair_force, c.largest_force);
      s.force_sum += c.totals.total_abs;
      s.elastic_energy += c.totals.elastic_energy;
      if (c.largest_acceleration > s.largest_acceleration) {
        s.largest_acceleration = c.largest_acceleration;
        s.acceleration_node = c.acceleration_node;
      }
      if (c.step.dt < s.contact_dt) {
        s.contact_dt = c.step.dt;
        s.contact_dt_source = c.step.source;
        s.contact_dt_node = c.step_node;
      }
      s.gap_closed += c.gap_closed;
      s.near_singular += c.near_singular_count;
    }
    s.active = active;
    if (found) all.push_back(s);
  }
  return all;
}

}  // namespace deck::cycle
