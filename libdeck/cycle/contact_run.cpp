// Evaluates one contact once. Input: positions, and the memory of the evaluation before. Output:
// forces, energies and steps of pairs and nodes, and the memory for the next evaluation.
// Steps: search pairs again if nodes may have come nearer than the margin; cut the pairs into
// pieces of about `pairs_at_once`; per piece gather inputs, run the kernel (cycle/kernel), share
// forces between neighbours (robust model), keep memory, and sum into the nodes. Pieces are summed
// in their order: results do not depend on threads. Cost: linear in the pairs.
#include "cycle/shared/contact_run.hpp"

#include <algorithm>
#include <cmath>

#include "base/shared/parallel.hpp"
#include "cycle/adapter/effect_inputs.hpp"

namespace deck::cycle::detail {
namespace {

constexpr std::size_t most_listed = 20;

bool has_other_tie(const ContactMemory& memory, CandidatePair at) {
  return std::binary_search(memory.tied_elsewhere.begin(), memory.tied_elsewhere.end(), at);
}

/// Inputs of pairs [begin, end) from `known`, the memory of the evaluation before: stiffness,
/// residual penetration, friction memory, ties.
PairInputs recall_inputs(const ContactPairs& pairs, std::size_t begin, std::size_t end,
                         const ContactCard& card, const ContactMemory& memory,
                         const std::vector<PairMemory>& known) {
  const std::size_t count = end - begin;
  const auto piece = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(begin),
                               all.begin() + static_cast<std::ptrdiff_t>(end));
  };
  PairInputs in;
  in.k0 = piece(pairs.k0);
  in.zero.assign(count, 0.0);
  const auto off = [](const std::vector<std::uint8_t>& list, std::uint32_t i) {
    return i < list.size() && list[i] != 0;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const CandidatePair at = pairs.at[begin + i];
    if (off(memory.off, at.secondary) || off(memory.main_off, at.main) || has_other_tie(memory, at))
      in.k0[i] = 0.0;
  }
  if (!memory.started) {
    in.p0 = piece(pairs.p0);
    return in;
  }
  in.p0 = in.zero;
  if (card.kind == ContactKind::edge_edge) {
    for (std::size_t i = 0; !memory.used[0].empty() && i < count; ++i)
      in.p0[i] =
          memory.used[0][pairs.at[begin + i].secondary] + memory.used[1][pairs.at[begin + i].main];
  }
  if (known.empty()) return in;
  for (auto& a : in.ft_old) a = in.zero;
  for (auto& a : in.tie) a = in.zero;
  auto next =
      std::lower_bound(known.begin(), known.end(), pairs.at[begin],
                       [](const PairMemory& m, const CandidatePair& p) { return m.at < p; });
  for (std::size_t i = 0; i < count; ++i) {
    const CandidatePair at = pairs.at[begin + i];
    while (next != known.end() && next->at < at) ++next;
    if (next == known.end() || next->at != at) continue;
    if (card.kind != ContactKind::edge_edge) in.p0[i] = next->p0;
    for (std::size_t c = 0; c < 3; ++c) in.ft_old[c][i] = next->ft[c];
    for (std::size_t c = 0; c < 8; ++c) in.tie[c][i] = next->tie[c];
  }
  return in;
}

/// A range of pairs with inputs and results.
struct PairPiece {
  std::size_t begin = 0;
  PairList list;
  PairInputs in;
  PacketBuffer buffer;
  PacketView view;
  PacketResult result;
  std::vector<double> shares;  ///< robust model only
};

/// A piece ends with the secondary item in which it exceeds this number of pairs.
constexpr std::size_t pairs_at_once = 4096;

/// True if pairs of different secondary items can share a force: by common nodes.
bool share_across(const ContactPairs& pairs) {
  if (pairs.nodes.kind == ContactKind::edge_edge) return true;
  std::vector<NodeIndex> nodes;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (i == 0 || pairs.at[i].secondary != pairs.at[i - 1].secondary)
      nodes.push_back(pairs.nodes.node[0][i]);
  if (!std::is_sorted(nodes.begin(), nodes.end())) std::sort(nodes.begin(), nodes.end());
  return std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end();
}

/// Begins of the pieces, and the end. All pairs of a secondary item are in one piece, because the
/// item leaves the interface with all of them; so are pairs that share forces.
std::vector<std::size_t> bounds_of_pieces(const ContactPairs& pairs, bool shared) {
  std::vector<std::size_t> bounds{0};
  if (pairs.size() > pairs_at_once && !(shared && share_across(pairs)))
    for (std::size_t i = pairs_at_once; i < pairs.size(); ++i) {
      if (i < bounds.back() + pairs_at_once || pairs.at[i].secondary == pairs.at[i - 1].secondary)
        continue;
      bounds.push_back(i);
    }
  bounds.push_back(pairs.size());
  return bounds;
}

/// Copies nodes and kinds of pairs [begin, end).
void copy_pairs(const PairList& all, std::size_t begin, std::size_t end, PairList& out) {
  const auto copy = [&](const auto& from, auto& to) {
    to.clear();
    if (from.empty()) return;
    to.assign(from.begin() + static_cast<std::ptrdiff_t>(begin),
              from.begin() + static_cast<std::ptrdiff_t>(end));
  };
  out.kind = all.kind;
  for (std::size_t r = 0; r < all.node.size(); ++r) copy(all.node[r], out.node[r]);
  copy(all.triangle, out.triangle);
}

NodalState nodal_state(const RunContext& run) {
  const auto data = [](const std::vector<double>& v) { return v.empty() ? nullptr : v.data(); };
  NodalState s;
  s.position = {run.x.x.data(), run.x.y.data(), run.x.z.data()};
  for (std::size_t c = 0; c < 3; ++c) s.velocity[c] = data(run.state.velocity[c]);
  s.mass = run.state.mass.data();
  s.temperature = data(run.state.temperature);
  return s;
}

PairOutcome outcome_of(const CandidatePair& at, const PairPiece& piece, std::size_t i) {
  const PacketResult& r = piece.result;
  PairOutcome p;
  p.at = at;
  for (std::size_t k = 0; k < 4; ++k) p.weights[k] = r.weights[k][i];
  for (std::size_t c = 0; c < 3; ++c) p.force[c] = r.force[c][i];
  p.normal_force = r.normal_force[i];
  p.penetration = r.penetration[i];
  p.gap = r.effective_gap[i];
  p.distance = r.distance[i];
  p.k0 = piece.view.k0[i];
  p.k_nodal = r.k_nodal[i];
  p.status = r.status[i];
  return p;
}

double size_of(const PacketResult& r, std::size_t i) {
  return std::sqrt(r.force[0][i] * r.force[0][i] + r.force[1][i] * r.force[1][i] +
                   r.force[2][i] * r.force[2][i]);
}

/// Remaining distance to the mid-surface, as a share of the gap.
double gap_left(const PairOutcome& p) {
  return p.gap > 0.0 ? (p.gap - p.penetration) / p.gap : 1.0;
}

/// True if the solver keeps the pair in this cycle: nearer than its gap, or than the reach of
/// radiation or of a curved surface.
bool is_kept(const KernelPlan& plan, const PacketView& view, const PacketResult& r, std::size_t i) {
  const ContactCard& card = plan.card;
  if (card.icurv != 0 && card.kind == ContactKind::node_segment)
    return (r.status[i] & status_kept) != 0;
  const double reach = card.ithe > 0 && card.kind == ContactKind::node_segment ? card.drad : 0.0;
  return r.distance[i] < std::max(view.gap[i], reach);
}

/// The gap of an edge grows back to the largest reduction that one of its pairs still needs.
void reduce_edge_gaps(const Contact& contact, ContactMemory& m) {
  if (!m.started) {
    m.used = {contact.secondary_stored, contact.main_stored};
    m.used[0].resize(contact.secondary_edges.size());
    m.used[1].resize(contact.main_edges.size());
  } else {
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t i = 0; i < m.used[side].size(); ++i)
        m.used[side][i] = std::min(m.used[side][i], m.most[side][i]);
  }
  for (std::size_t side = 0; side < 2; ++side) m.most[side].assign(m.used[side].size(), 0.0);
}

/// Keeps the input of the next evaluation. The friction memory is the pair's own, from before
/// neighbours share a force.
void remember(const KernelPlan& plan, const ContactPairs& pairs, const PairPiece& piece,
              ContactMemory& m) {
  const PacketView& view = piece.view;
  const PacketResult& r = piece.result;
  const ContactCard& card = plan.card;
  const bool reduced = card.inacti == 5 || card.inacti == 6;
  const bool edges = card.kind == ContactKind::edge_edge;
  const bool has_friction = contains(plan.writes, Field::friction_memory);
  const bool ties = contains(plan.writes, Field::tie_record);
  for (std::size_t i = 0; i < r.size; ++i) {
    PairMemory p{pairs.at[piece.begin + i]};
    bool something = false;
    const bool near = is_kept(plan, view, r, i);
    if (near && reduced && edges) {
      const double depth = std::max(0.0, view.gap[i] - r.distance[i]);
      const double needs = depth > 0.0 ? edge_residual(card, depth, view.gap[i]) : 0.0;
      double& s = m.most[0][p.at.secondary];
      double& t = m.most[1][p.at.main];
      s = std::max(s, needs);
      t = std::max(t, needs);
    } else if (near && reduced) {
      p.p0 = r.p0[i];
      something = p.p0 != 0.0;
    }
    for (std::size_t c = 0; near && has_friction && c < 3; ++c) {
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

/// Keeps the pairs with the smallest remaining share of their gap, in ascending order.
void keep_nearest(std::vector<PairOutcome>& list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return gap_left(a) < gap_left(b); });
  if (list.size() > most_listed) list.resize(most_listed);
}

void collect_pairs(const KernelPlan& plan, const ContactPairs& pairs, const PairPiece& piece,
                   const CycleOptions& options, ContactOutcome& out) {
  const PacketView& view = piece.view;
  const PacketResult& r = piece.result;
  for (std::size_t i = 0; i < r.size; ++i) {
    const CandidatePair at = pairs.at[piece.begin + i];
    const bool near = is_kept(plan, view, r, i);
    out.pairs_in_reach += near || options.margin == 0.0;
    // no stiffness: closed at start-up, or removed by this cycle's step or depth
    const bool taken = (r.status[i] & status_gap_closed) != 0 ||
                       ((r.status[i] & status_step_deleted) != 0 && !(r.k_nodal[i] > 0.0));
    out.pairs_switched_off += near && (view.k0[i] == 0.0 || taken);
    out.gap_closed += (r.status[i] & status_gap_closed) != 0;
    out.pairs_tied += (r.status[i] & status_tied) != 0;
    const bool was_tied = view.tie[0][i] != 0.0;
    if ((r.status[i] & status_tied) != 0 && !was_tied) out.ties.push_back({at, true});
    if ((r.status[i] & status_released) != 0) out.ties.push_back({at, false});
    // a live tie without a force has the marker 1e-30
    const bool mark = out.card.kind == ContactKind::tied && size_of(r, i) < 2e-30;
    const double f = mark ? 0.0 : size_of(r, i);
    if (!(f > 0.0 || (near && r.penetration[i] > 0.0))) continue;
    const PairOutcome p = outcome_of(at, piece, i);
    out.pairs_with_force += f > 0.0;
    if (f > out.largest_force) {
      out.largest_force = f;
      out.largest = p;
    }
    if (gap_left(p) < options.near_singular && out.card.kind != ContactKind::tied) {
      ++out.near_singular_count;
      out.near_singular.push_back(p);
      if (out.near_singular.size() > 50 * most_listed) keep_nearest(out.near_singular);
    }
    if (options.keep_pairs) out.pairs.push_back(p);
  }
}

/// Collects secondary nodes and edges that leave the interface after this evaluation, each once.
void collect_removals(const ContactPairs& pairs, const PairPiece& piece, ContactMemory& m,
                      ContactOutcome& out) {
  const PacketResult& r = piece.result;
  for (std::size_t i = 0; i < r.size; ++i) {
    if ((r.status[i] & (status_gap_closed | status_step_deleted)) == 0) continue;
    const std::uint32_t s = pairs.at[piece.begin + i].secondary;
    if (m.off[s] != 0) continue;
    m.off[s] = 1;
    out.removed.push_back({s, (r.status[i] & status_gap_closed) != 0 ? Removal::Because::mid_surface
                              : r.k_nodal[i] > 0.0                   ? Removal::Because::nodal_step
                                                   : Removal::Because::kinematic_step});
  }
}

/// Adds results at the nodes of one contact to its outcome and to the sums of all contacts.
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
    if (!sums.heat.empty()) {
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

/// Iadm: smallest radius at every node of a pair, depth and angle at secondary nodes. `all` is
/// indexed by node of the contact.
void add_criteria(const KernelPlan& plan, const PairPiece& piece, std::vector<NodeCriteria>& all) {
  const PacketResult& r = piece.result;
  for (std::size_t i = 0; i < r.size; ++i) {
    if (!is_kept(plan, piece.view, r, i) || !(r.criteria[0][i] > 0.0)) continue;
    for (std::size_t role = 0; role < 5; ++role) {
      NodeCriteria& c = all[piece.list.node[role][i]];
      c.radius = std::min(c.radius, r.criteria[0][i]);
    }
    NodeCriteria& c = all[piece.list.node[0][i]];
    c.penetration = std::max(c.penetration, r.criteria[1][i]);
    if (plan.card.iadm == 2) c.angle = std::min(c.angle, r.criteria[2][i]);
  }
}

void collect_criteria(const LocalNodes& nodes, std::vector<NodeCriteria>& all,
                      ContactOutcome& out) {
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (all[n].radius >= 1e30) continue;
    all[n].node = nodes.global(n);
    out.criteria.push_back(all[n]);
  }
}

/// IBC: fixed translations that become free.
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

/// Notes effects of the card that this evaluation leaves out.
void note_gaps(const State& state, ContactOutcome& out) {
  if (out.card.ithe > 0 && !state.heated)
    out.notes.emplace_back("the deck gives no initial temperature: all are 0");
}

void note_other_ties(const ContactMemory& m, ContactOutcome& out) {
  if (m.tied_elsewhere.empty()) return;
  const auto count = std::count_if(m.candidates.at.begin(), m.candidates.at.end(),
                                   [&](const CandidatePair& at) { return has_other_tie(m, at); });
  if (count > 0)
    out.notes.push_back(std::to_string(count) + (count == 1 ? " pair lies" : " pairs lie") +
                        " around a tie of /INTER/TYPE2 and " + (count == 1 ? "is" : "are") +
                        " left out (Irem_i2 = 1)");
}

/// Searches pairs again if nodes may have come nearer than the searched distance.
void update_pairs(const RunContext& run, const Contact& contact, const ContactCard& card,
                  ContactMemory& m) {
  // Curved surfaces reach further than the margin where the mesh bends: search every time.
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
  if (run.remember) m.searched.record(contact, run.x);
}

}  // namespace

void attach(PacketView& view, const ContactPairs& pairs, const PairInputs& in, std::size_t begin) {
  view.point_at(pairs, begin);
  for (const double*& p : view.ft_old) p = in.zero.data();
  for (const double*& p : view.tie) p = in.zero.data();
  view.point_at(in);
}

static std::string initial_forces_text(const Contact& contact) {
  const auto n = std::count_if(
      contact.penetrations.begin(), contact.penetrations.end(),
      [](const PenetrationRow& r) { return r.action == PenetrationAction::initial_force; });
  return n == 0 ? std::string() : "; pairs with a force from the start: " + std::to_string(n);
}

NodeStiffness run_contact(const RunContext& run, ContactMemory& m, ContactOutcome& out,
                          NodalSums& all) {
  const Contact& contact = *out.contact;
  const CycleOptions& options = run.options;
  if (contact.dropped) return {};
  if (is_type24_or_25(contact.type)) {
    out.notes.push_back("forces of TYPE" + std::to_string(contact.type) + " are not computed" +
                        initial_forces_text(contact));
    out.complete = false;
    return {};
  }
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
  if (!has_usable_values(out.card, contact))
    return refuse("the card has values out of range: nothing was evaluated");
  if (!contact.evaluated)
    return refuse("the start-up could not be evaluated (see the findings), so there are no forces");
  if (const std::string why = curvature_problem(run.scene, contact, out.card); !why.empty())
    return refuse(why);
  if (const std::string why = stiffness_problem(run, contact); !why.empty()) {
    out.stiffness_known = false;
    return refuse(why);
  }
  out.active = is_active(out.card, options.time);
  if (m.off.empty()) begin(run, contact, m);
  if (!out.active) return {};
  follow_dead_elements(run, contact, out.card.idel, m, out.removed);
  update_pairs(run, contact, out.card, m);
  const ContactPairs& pairs = m.candidates;
  note_other_ties(m, out);
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
  if (edge_gaps) reduce_edge_gaps(contact, m);
  for (const Removal& gone : out.removed) m.off[gone.secondary] = 1;
  const bool shared =
      options.model == Model::robust && out.card.kind != ContactKind::tied && out.card.itied == 0;
  const int threads = std::max(1, options.threads);
  const std::vector<PairMemory> known = std::move(m.pairs);
  m.pairs.clear();
  const std::vector<std::size_t> bounds = bounds_of_pieces(pairs, shared);
  const std::size_t pieces = bounds.size() - 1;
  const LocalNodes nodes(pairs.nodes, run.state.mass);
  const NodalState at = nodal_state(run);
  NodalSums sums;
  sums.resize(nodes.size(), contains(plan.writes, Field::heat));
  std::vector<NodeCriteria> criteria;
  if (out.card.iadm != 0 && out.card.kind == ContactKind::node_segment)
    criteria.resize(nodes.size());
  RunningTotals totals(plan);
  const auto work = [&](std::size_t k, PairPiece& piece) {
    piece.begin = bounds[k];
    piece.in = recall_inputs(pairs, bounds[k], bounds[k + 1], out.card, m, known);
    copy_pairs(pairs.nodes, bounds[k], bounds[k + 1], piece.list);
    piece.buffer.gather(at, piece.list, plan.needs | Field::position);
    piece.view = piece.buffer.view();
    attach(piece.view, pairs, piece.in, piece.begin);
    piece.view.dt1 = options.dt1;
    piece.view.dt12 = options.dt12;
    piece.result.resize(0);  // results of the piece before
    evaluate(plan, piece.view, piece.result, static_cast<unsigned>(pieces > 1 ? 1 : threads));
    if (shared) piece.shares = pair_shares(piece.list, piece.result);
    nodes.localise(piece.list);
  };
  const auto collect = [&](std::size_t, PairPiece& piece) {
    if (run.remember) remember(plan, pairs, piece, m);
    collect_removals(pairs, piece, m, out);
    if (shared) apply_shares(piece.shares, piece.result);
    totals.add(piece.view, piece.result);
    if (out.card.ithe > 0) sum_heat(piece.result, out);
    collect_pairs(plan, pairs, piece, options, out);
    if (!criteria.empty()) add_criteria(plan, piece, criteria);
    assemble(plan, piece.list, piece.result, sums);
  };
  run_in_order<PairPiece>(pieces, threads, work, collect);
  m.started = true;
  out.totals = totals.all();
  keep_nearest(out.near_singular);
  collect_criteria(nodes, criteria, out);
  collect_nodes(nodes, sums, out, all);
  collect_releases(nodes, sums, run.fixed, out);
  out.step = step_limit(out.totals, sums, nodes.mass().data(), step_scale, from_velocity);
  if (out.step.source == StepLimit::Source::nodal)
    out.step_node = nodes.global(out.step.index);
  else if (out.step.source == StepLimit::Source::kinematic)
    out.step_node = pairs.nodes.node[0][out.step.index];
  NodeStiffness stiffness;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (sums.stiffness[n] > 0.0) stiffness.emplace_back(nodes.global(n), sums.stiffness[n]);
  return stiffness;
}

}  // namespace deck::cycle::detail
