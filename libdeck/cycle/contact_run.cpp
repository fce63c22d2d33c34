// One contact in one evaluation: its pairs, what they remember, their forces and the sums at its
// nodes.
#include "cycle/contact_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "deck/cycle/sharing.hpp"
#include "deck/model/interfaces_fields.hpp"

namespace deck::cycle::detail {
namespace {

constexpr std::size_t most_listed = 20;

/// The nodes of one contact's pairs, numbered on their own, so that the work of a small contact
/// does not grow with the model.
class LocalNodes {
 public:
  /// `pairs` come with nodes of the model and leave with those of this contact.
  LocalNodes(PairList& pairs, const Coordinates& at, const State& state) {
    const std::size_t roles = pairs.kind == ContactKind::edge_edge ? 4 : 5;
    for (std::size_t r = 0; r < roles; ++r)
      node_.insert(node_.end(), pairs.node[r].begin(), pairs.node[r].end());
    std::sort(node_.begin(), node_.end());
    node_.erase(std::unique(node_.begin(), node_.end()), node_.end());
    for (std::size_t r = 0; r < roles; ++r)
      for (std::uint32_t& n : pairs.node[r])
        n = static_cast<std::uint32_t>(std::lower_bound(node_.begin(), node_.end(), n) -
                                       node_.begin());
    const std::vector<double>* x[] = {&at.x, &at.y, &at.z};
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
    const auto data = [](const std::vector<double>& v) { return v.empty() ? nullptr : v.data(); };
    for (std::size_t c = 0; c < 3; ++c) {
      s.position[c] = position_[c].data();
      s.velocity[c] = data(velocity_[c]);
    }
    s.mass = mass_.data();
    s.temperature = data(temperature_);
    return s;
  }

 private:
  std::vector<double> pick(const std::vector<double>& from) const {
    if (from.empty()) return {};
    std::vector<double> to(node_.size());
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[node_[i]];
    return to;
  }
  std::vector<NodeIndex> node_;
  std::array<std::vector<double>, 3> position_, velocity_;
  std::vector<double> mass_, temperature_;
};

/// Stiffness, residual penetration, friction memory and ties of the pairs, as remembered.
PairInputs recall(const ContactPairs& pairs, const ContactCard& card, const ContactMemory& memory) {
  PairInputs in;
  in.k0 = pairs.k0;
  in.zero.assign(pairs.size(), 0.0);
  const auto off = [](const std::vector<std::uint8_t>& list, std::uint32_t i) {
    return i < list.size() && list[i] != 0;
  };
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (off(memory.off, pairs.at[i].secondary) || off(memory.main_off, pairs.at[i].main))
      in.k0[i] = 0.0;
  if (!memory.started) {
    in.p0 = pairs.p0;
    return in;
  }
  in.p0 = in.zero;
  if (card.kind == ContactKind::edge_edge) {
    for (std::size_t i = 0; !memory.used[0].empty() && i < pairs.size(); ++i)
      in.p0[i] = memory.used[0][pairs.at[i].secondary] + memory.used[1][pairs.at[i].main];
  }
  if (memory.pairs.empty()) return in;
  for (auto& a : in.ft) a = in.zero;
  for (auto& a : in.tie) a = in.zero;
  auto known = memory.pairs.begin();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    while (known != memory.pairs.end() && known->at < pairs.at[i]) ++known;
    if (known == memory.pairs.end() || known->at != pairs.at[i]) continue;
    if (card.kind != ContactKind::edge_edge) in.p0[i] = known->p0;
    for (std::size_t c = 0; c < 3; ++c) in.ft[c][i] = known->ft[c];
    for (std::size_t c = 0; c < 8; ++c) in.tie[c][i] = known->tie[c];
  }
  return in;
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

/// Whether the pair is one for the solver in this cycle: nearer than its gap, or than what
/// radiation and curved surfaces add to it.
bool kept(const KernelPlan& plan, const PacketView& view, const PacketResult& r, std::size_t i) {
  const ContactCard& card = plan.card;
  if (card.icurv != 0 && card.kind == ContactKind::node_segment)
    return (r.status[i] & status_kept) != 0;
  const double reach = card.ithe > 0 && card.kind == ContactKind::node_segment ? card.drad : 0.0;
  return r.distance[i] < std::max(view.gap[i], reach);
}

/// Edges give their gap back by themselves, from the most that one of their pairs still needs.
void begin_edge_cycle(const Contact& contact, ContactMemory& m) {
  if (!m.started) {
    const auto stored = [](const std::vector<ContactEdge>& list) {
      std::vector<double> p;
      for (const ContactEdge& e : list) p.push_back(e.stored_penetration);
      return p;
    };
    m.used = {stored(contact.secondary_edges), stored(contact.main_edges)};
  } else {
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t i = 0; i < m.used[side].size(); ++i)
        m.used[side][i] = std::min(m.used[side][i], m.most[side][i]);
  }
  for (std::size_t side = 0; side < 2; ++side) m.most[side].assign(m.used[side].size(), 0.0);
}

/// Keeps what the next evaluation starts from. The friction memory is that of the pair alone,
/// before neighbours share a force.
void remember(const KernelPlan& plan, const ContactPairs& pairs, const PacketView& view,
              const PacketResult& r, ContactMemory& m) {
  const ContactCard& card = plan.card;
  const bool reduced = card.inacti == 5 || card.inacti == 6;
  const bool edges = card.kind == ContactKind::edge_edge;
  const bool rubs = contains(plan.writes, Field::friction_memory);
  const bool ties = contains(plan.writes, Field::tie_record);
  m.pairs.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    PairMemory p{pairs.at[i]};
    bool something = false;
    const bool near = kept(plan, view, r, i);
    if (near && reduced && edges) {
      const double depth = std::max(0.0, pairs.gap[i] - r.distance[i]);
      const double needs = depth > 0.0 ? edge_residual(card, depth, pairs.gap[i]) : 0.0;
      double& s = m.most[0][p.at.secondary];
      double& t = m.most[1][p.at.main];
      s = std::max(s, needs);
      t = std::max(t, needs);
    } else if (near && reduced) {
      p.p0 = r.p0[i];
      something = p.p0 != 0.0;
    }
    for (std::size_t c = 0; near && rubs && c < 3; ++c) {
      p.ft[c] = r.ft[c][i];
      something = something || p.ft[c] != 0.0;
    }
    if (ties && r.tie[0][i] != 0.0) {
      for (std::size_t c = 0; c < 8; ++c) p.tie[c] = r.tie[c][i];
      something = true;
    }
    if (something) m.pairs.push_back(p);
  }
}

void collect_pairs(const KernelPlan& plan, const ContactPairs& pairs, const PacketView& view,
                   const PacketResult& r, const CycleOptions& options, ContactOutcome& out) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool near = kept(plan, view, r, i);
    out.pairs_in_reach += near || options.margin == 0.0;
    // Without stiffness: at start-up, or because of this cycle's step or depth.
    const bool taken = (r.status[i] & status_gap_closed) != 0 ||
                       ((r.status[i] & status_step_deleted) != 0 && !(r.k_nodal[i] > 0.0));
    out.pairs_switched_off += near && (view.k0[i] == 0.0 || taken);
    out.gap_closed += (r.status[i] & status_gap_closed) != 0;
    out.pairs_tied += (r.status[i] & status_tied) != 0;
    const bool was_tied = view.tie[0][i] != 0.0;
    if ((r.status[i] & status_tied) != 0 && !was_tied) out.ties.push_back({pairs.at[i], true});
    if ((r.status[i] & status_released) != 0) out.ties.push_back({pairs.at[i], false});
    // A live tie without a force carries the mark 1e-30.
    const bool mark = out.card.kind == ContactKind::tied && size_of(r, i) < 2e-30;
    const double f = mark ? 0.0 : size_of(r, i);
    if (!(f > 0.0 || (near && r.penetration[i] > 0.0))) continue;
    PairOutcome p = outcome_of(pairs, r, i);
    p.k0 = view.k0[i];
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

/// Secondary nodes and edges that leave the interface after this evaluation, each once.
void collect_removals(const ContactPairs& pairs, const PacketResult& r, ContactMemory& m,
                      ContactOutcome& out) {
  for (const Removal& gone : out.removed) m.off[gone.secondary] = 1;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if ((r.status[i] & (status_gap_closed | status_step_deleted)) == 0) continue;
    const std::uint32_t s = pairs.at[i].secondary;
    if (m.off[s] != 0) continue;
    m.off[s] = 1;
    out.removed.push_back({s, (r.status[i] & status_gap_closed) != 0 ? Removal::Because::mid_surface
                              : r.k_nodal[i] > 0.0                   ? Removal::Because::nodal_step
                                                   : Removal::Because::kinematic_step});
  }
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
    if (!all.heat.empty()) {
      all.heat[g] += sums.heat[n];
      all.conductance[g] += sums.conductance[n];
    }
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

/// Iadm: the sharpest radius at every node of a pair, depth and angle at secondary nodes.
void collect_criteria(const KernelPlan& plan, const PairList& pairs, const LocalNodes& nodes,
                      const PacketView& view, const PacketResult& r, ContactOutcome& out) {
  if (plan.card.iadm == 0 || plan.card.kind != ContactKind::node_segment) return;
  std::vector<NodeCriteria> all(nodes.size());
  for (std::size_t i = 0; i < r.size; ++i) {
    if (!kept(plan, view, r, i) || !(r.criteria[0][i] > 0.0)) continue;
    for (std::size_t role = 0; role < 5; ++role) {
      NodeCriteria& c = all[pairs.node[role][i]];
      c.radius = std::min(c.radius, r.criteria[0][i]);
    }
    NodeCriteria& c = all[pairs.node[0][i]];
    c.penetration = std::max(c.penetration, r.criteria[1][i]);
    if (plan.card.iadm == 2) c.angle = std::min(c.angle, r.criteria[2][i]);
  }
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (all[n].radius >= 1e30) continue;
    all[n].node = nodes.global(n);
    out.criteria.push_back(all[n]);
  }
}

/// IBC: fixed translations that are free from now on.
void collect_releases(const LocalNodes& nodes, const NodalSums& sums,
                      std::vector<std::uint8_t>& fixed, ContactOutcome& out) {
  for (std::size_t n = 0; !fixed.empty() && n < nodes.size(); ++n) {
    std::uint8_t& code = fixed[nodes.global(n)];
    const auto after = static_cast<std::uint8_t>(code & ~sums.released[n]);
    if (after == code) continue;
    out.released.push_back({nodes.global(n), code, after});
    code = after;
  }
}

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

/// Why a curved main side cannot be computed with; empty if it can.
std::string curvature_problem(const Scene& scene, const Contact& contact, const ContactCard& card) {
  if (card.kind != ContactKind::node_segment || (card.icurv != 1 && card.icurv != 2)) return {};
  std::array<std::int64_t, 2> id{};
  visit_interface(*contact.inter, [&](const auto& inter) {
    inter.for_each([&](std::string_view name, const auto& e) {
      if constexpr (std::is_same_v<std::decay_t<decltype(e)>, EffectiveInt>) {
        if (name == "node_ID1") id[0] = e.value;
        if (name == "node_ID2") id[1] = e.value;
      }
    });
  });
  for (int k = 0; k < card.icurv; ++k)
    if (scene.model->nodes.map.find(id[static_cast<std::size_t>(k)]) == no_index)
      return "node_ID" + std::to_string(k + 1) + " = " +
             std::to_string(id[static_cast<std::size_t>(k)]) +
             " is no node: the curved surface has no place, nothing was evaluated";
  if (card.icurv == 2 && card.curv_node1 == card.curv_node2)
    return "node_ID1 and node_ID2 are one point: a cylinder (Icurv = 2) has no axis then, nothing "
           "was "
           "evaluated";
  return {};
}

/// Before the first evaluation: who takes no part from the beginning.
void begin(const RunContext& run, const Contact& contact, ContactMemory& m) {
  const bool edges = contact.kind == deck::ContactKind::edge_edge;
  m.off.assign(
      std::max<std::size_t>(1, edges ? contact.secondary_edges.size() : contact.secondary.size()),
      0);
  if (edges || contact.type != 7) return;
  bool drops = false;
  visit_interface(*contact.inter, [&](const auto& inter) {
    if constexpr (requires { inter.Irem_i2; }) drops = inter.Irem_i2.value == 1;
  });
  if (!drops) return;
  const std::vector<std::uint8_t> tied = tied_secondary_nodes(*run.scene.model);
  for (std::size_t i = 0; i < contact.secondary.size(); ++i) {
    if (tied[contact.secondary[i].node] == 0) continue;
    m.off[i] = 1;
    ++m.tied_elsewhere;
  }
}

/// Searches the pairs again when the nodes may have come nearer than what was searched.
void refresh(const RunContext& run, const Contact& contact, const ContactCard& card,
             ContactMemory& m) {
  // Curved surfaces reach further where the mesh bends: their pairs are searched every time.
  const double moved = m.has_candidates ? m.searched.approach(run.x) : 0.0;
  const bool leaves = moved > 0.0 && (!(moved < run.options.margin) || card.icurv != 0);
  if (m.has_candidates && !leaves) {
    renew_normals(contact, card, run.x, m.candidates);
    return;
  }
  PairSearch search;
  search.at = &run.x;
  search.margin = run.options.margin;
  for (const PairMemory& p : m.pairs)
    if (p.tie[0] != 0.0) search.always.push_back(p.at);
  m.candidates =
      make_pairs(run.scene, contact, card, run.options.model, run.options.threads, search);
  if (card.ithe > 0) add_conductivity(run.scene, contact, run.state.temperature, m.candidates);
  m.has_candidates = true;
  ++m.searches;
  if (run.remember) m.searched.take(contact, run.x);
}

}  // namespace

void attach(PacketView& view, const ContactPairs& pairs, const PairInputs& in) {
  const auto data = [](const std::vector<double>& v) { return v.empty() ? nullptr : v.data(); };
  const auto or_zero = [&](const std::vector<double>& v) {
    return v.empty() ? in.zero.data() : v.data();
  };
  view.k0 = data(in.k0);
  view.gap = data(pairs.gap);
  view.p0 = data(in.p0);
  for (std::size_t c = 0; c < 3; ++c) view.ft_old[c] = or_zero(in.ft[c]);
  for (std::size_t c = 0; c < 8; ++c) view.tie[c] = or_zero(in.tie[c]);
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

void SearchedAt::take(const Contact& contact, const Coordinates& x) {
  for (auto& n : nodes_) n.clear();
  for (const SecondaryNode& s : contact.secondary) nodes_[0].push_back(s.node);
  for (const ContactEdge& e : contact.secondary_edges)
    nodes_[0].insert(nodes_[0].end(), e.nodes.begin(), e.nodes.end());
  for (const MainSegment& m : contact.main)
    nodes_[1].insert(nodes_[1].end(), m.nodes.begin(), m.nodes.end());
  for (const ContactEdge& e : contact.main_edges)
    nodes_[1].insert(nodes_[1].end(), e.nodes.begin(), e.nodes.end());
  const std::vector<double>* now[] = {&x.x, &x.y, &x.z};
  for (std::size_t side = 0; side < 2; ++side) {
    std::sort(nodes_[side].begin(), nodes_[side].end());
    nodes_[side].erase(std::unique(nodes_[side].begin(), nodes_[side].end()), nodes_[side].end());
    for (std::size_t c = 0; c < 3; ++c) {
      x_[side][c].clear();
      for (const NodeIndex n : nodes_[side]) x_[side][c].push_back((*now[c])[n]);
    }
  }
}

double SearchedAt::approach(const Coordinates& x) const {
  const std::vector<double>* now[] = {&x.x, &x.y, &x.z};
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    double low[2], high[2];
    for (std::size_t side = 0; side < 2; ++side) {
      low[side] = std::numeric_limits<double>::infinity();
      high[side] = -low[side];
      for (std::size_t i = 0; i < nodes_[side].size(); ++i) {
        const double moved = (*now[c])[nodes_[side][i]] - x_[side][c][i];
        if (!std::isfinite(moved)) return std::numeric_limits<double>::infinity();
        low[side] = std::min(low[side], moved);
        high[side] = std::max(high[side], moved);
      }
      if (nodes_[side].empty()) return 0.0;
    }
    const double most = std::max({high[0] - low[1], high[1] - low[0], 0.0});
    sum += most * most;
  }
  return std::sqrt(sum);
}

NodeStiffness run_contact(const RunContext& run, ContactMemory& m, ContactOutcome& out,
                          NodalSums& all) {
  const Contact& contact = *out.contact;
  const CycleOptions& options = run.options;
  if (contact.dropped) return {};
  if (!m.plan) m.plan = make_plan(out.card, options.model, options.plan);
  const KernelPlan& plan = *m.plan;
  out.effects = plan.account;
  out.composition = plan.composition;
  out.isa = plan.isa;
  note_gaps(run.state, out);
  const auto refuse = [&](const std::string& why) {
    out.notes.push_back(why);
    out.complete = false;
    return NodeStiffness{};
  };
  if (!sane(out.card, contact))
    return refuse("the card has values out of range: nothing was evaluated");
  if (!contact.evaluated)
    return refuse("start-up could not be evaluated, see the findings: no forces either");
  if (const std::string why = curvature_problem(run.scene, contact, out.card); !why.empty())
    return refuse(why);
  out.active = is_active(out.card, options.time);
  if (m.off.empty()) begin(run, contact, m);
  if (m.tied_elsewhere > 0)
    out.notes.push_back(std::to_string(m.tied_elsewhere) +
                        (m.tied_elsewhere == 1 ? " secondary node is" : " secondary nodes are") +
                        " tied by /INTER/TYPE2 and left out of this interface (Irem_i2 = 1)");
  if (!out.active) return {};
  follow_dead_elements(run, contact, out.card.idel, m, out.removed);
  refresh(run, contact, out.card, m);
  const ContactPairs& pairs = m.candidates;
  out.complete = pairs.complete;
  if (!pairs.complete)
    out.notes.emplace_back(
        "too many pairs are within reach for the memory allowed (--max-memory): nothing was "
        "evaluated");
  const double from_velocity = velocity_limit(contact, out.card, run.state);
  if (pairs.size() == 0) {
    if (from_velocity < 1e30) out.step = {StepLimit::Source::velocity, from_velocity, SIZE_MAX};
    return {};
  }
  const bool edge_gaps = out.card.kind == ContactKind::edge_edge &&
                         (out.card.inacti == 5 || out.card.inacti == 6) && run.remember;
  if (edge_gaps) begin_edge_cycle(contact, m);
  const PairInputs in = recall(pairs, out.card, m);
  PairList list = pairs.nodes;
  const LocalNodes nodes(list, run.x, run.state);
  PacketBuffer buffer;
  buffer.gather(nodes.arrays(), list, plan.needs | Field::position);
  PacketView view = buffer.view();
  attach(view, pairs, in);
  view.dt1 = options.dt1;
  view.dt12 = options.dt12;
  PacketResult result;
  evaluate(plan, view, result, static_cast<unsigned>(std::max(1, options.threads)));
  if (run.remember) remember(plan, pairs, view, result, m);
  m.started = true;
  collect_removals(pairs, result, m, out);
  if (options.model == Model::robust && out.card.kind != ContactKind::tied && out.card.itied == 0)
    apply_shares(pair_shares(list, result), result);
  out.totals = totals(plan, view, result);
  if (out.card.ithe > 0) sum_heat(result, out);
  collect_pairs(plan, pairs, view, result, options, out);
  collect_criteria(plan, list, nodes, view, result, out);
  NodalSums sums;
  sums.resize(nodes.size());
  assemble(plan, Incidence(list, nodes.size()), result, sums,
           static_cast<unsigned>(std::max(1, options.threads)));
  collect_nodes(nodes, sums, out, all);
  collect_releases(nodes, sums, run.fixed, out);
  out.step = step_limit(out.totals, sums, nodes.mass().data(), step_factor, from_velocity);
  if (out.step.source == StepLimit::Source::nodal)
    out.step_node = nodes.global(out.step.index);
  else if (out.step.source == StepLimit::Source::kinematic)
    out.step_node = nodes.global(list.node[0][out.step.index]);
  NodeStiffness stiffness;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (sums.stiffness[n] > 0.0) stiffness.emplace_back(nodes.global(n), sums.stiffness[n]);
  return stiffness;
}

}  // namespace deck::cycle::detail
