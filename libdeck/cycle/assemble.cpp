// Sums pair forces and stiffnesses into the nodes.
#include "deck/cycle.hpp"

#include <algorithm>
#include <cmath>

namespace deck::cycle {
namespace {

void pick(const double* from, const std::vector<std::uint32_t>& index, std::vector<double>& to) {
  to.resize(index.size());
  for (std::size_t i = 0; i < index.size(); ++i) to[i] = from[index[i]];
}

/// Share of the pair force (main side) that a role receives.
double force_share(ContactKind kind, const PacketResult& r, std::size_t pair, std::size_t role) {
  if (kind == ContactKind::edge_edge) {
    return role < 2 ? -r.weights[role][pair] : r.weights[role][pair];
  }
  return role == 0 ? -1.0 : r.weights[role - 1][pair];
}

/// Triangles repeat corner 3 as corner 4.
bool is_repeated(const PairList& pairs, std::size_t pair, std::size_t role) {
  return role == 4 && !pairs.triangle.empty() && pairs.triangle[pair] != 0;
}

std::size_t roles_of(const PairList& pairs) { return pairs.kind == ContactKind::edge_edge ? 4 : 5; }

/// Marks a node by the status bits of one of its pairs.
void mark_node(const KernelPlan& plan, std::int64_t status, bool secondary, std::size_t n,
               NodalSums& sums) {
  if ((status & status_contact) != 0) sums.contact[n] = 1;
  if (!secondary) return;
  if ((status & (status_gap_closed | status_step_deleted)) != 0) sums.removed[n] = 1;
  if ((status & status_bc_release) != 0)
    sums.released[n] |= static_cast<std::uint8_t>(plan.card.ibc & 7);
}

}  // namespace

void PacketBuffer::gather(const NodalState& nodes, const PairList& pairs, Field needs) {
  size_ = pairs.size();
  triangle_ = pairs.triangle;
  const std::size_t roles = roles_of(pairs);
  for (std::size_t role = 0; role < roles; ++role) {
    const auto& index = pairs.node[role];
    for (std::size_t c = 0; c < 3; ++c) {
      if (contains(needs, Field::position)) pick(nodes.position[c], index, of_.position[role][c]);
      if (contains(needs, Field::velocity)) {
        if (nodes.velocity[c] != nullptr)
          pick(nodes.velocity[c], index, of_.velocity[role][c]);
        else if (role == 0)
          of_.velocity[0][c].assign(size_, 0.0);  // all roles share it, see view()
      }
    }
    const Field mass = role == 0 ? Field::mass_secondary : Field::mass_main;
    const bool edge_mass = role == 1 && pairs.kind == ContactKind::edge_edge;
    if (contains(needs, edge_mass ? Field::mass_secondary : mass)) {
      pick(nodes.mass, index, of_.mass[role]);
    }
    if (!contains(needs, Field::temperature)) continue;
    if (nodes.temperature != nullptr)
      pick(nodes.temperature, index, of_.temperature[role]);
    else
      of_.temperature[role].assign(size_, 0.0);
  }
}

PacketView PacketBuffer::view() const {
  PacketView v;
  v.size = size_;
  v.point_at(of_);
  for (std::size_t role = 1; role < (of_.position[4][0].empty() ? 4 : 5); ++role)
    for (std::size_t c = 0; c < 3; ++c)
      if (v.velocity[role][c] == nullptr) v.velocity[role][c] = v.velocity[0][c];
  v.triangle = triangle_.empty() ? nullptr : triangle_.data();
  return v;
}

void NodalSums::resize(std::size_t nodes, bool heated) {
  for (auto& f : force) f.assign(nodes, 0.0);
  stiffness.assign(nodes, 0.0);
  for (auto* a : {&heat, &conductance}) a->assign(heated ? nodes : 0, 0.0);
  for (auto* a : {&contact, &removed, &released}) a->assign(nodes, 0);
}

void assemble(const KernelPlan& plan, const PairList& pairs, const PacketResult& r,
              NodalSums& sums) {
  const bool heated = contains(plan.writes, Field::heat);
  const ContactKind kind = plan.card.kind;
  for (std::size_t pair = 0; pair < r.size; ++pair)
    for (std::size_t role = 0; role < roles_of(pairs); ++role) {
      if (is_repeated(pairs, pair, role)) continue;
      const std::size_t n = pairs.node[role][pair];
      const double share = force_share(kind, r, pair, role);
      const bool secondary = role < (kind == ContactKind::edge_edge ? 2u : 1u);
      for (std::size_t c = 0; c < 3; ++c) sums.force[c][n] += share * r.force[c][pair];
      sums.stiffness[n] += std::abs(share) * r.k_nodal[pair];
      mark_node(plan, r.status[pair], secondary, n, sums);
      if (!heated) continue;
      sums.heat[n] += r.heat[role][pair];
      if (secondary || plan.card.ithe_form == 1)
        sums.conductance[n] += std::abs(share) * r.conductance[pair];
    }
}

StepLimit step_limit(const Totals& t, const NodalSums& sums, const double* mass, double factor,
                     double velocity_limit) {
  StepLimit limit;
  const auto propose = [&](StepLimit::Source source, double dt, std::size_t index) {
    if (dt < limit.dt) limit = {source, dt, index};
  };
  propose(StepLimit::Source::kinematic, t.dt_kinematic, t.dt_kinematic_pair);
  for (std::size_t n = 0; mass != nullptr && n < sums.stiffness.size(); ++n) {
    if (sums.stiffness[n] > 0.0 && mass[n] > 0.0) {
      propose(StepLimit::Source::nodal, factor * std::sqrt(2.0 * mass[n] / sums.stiffness[n]), n);
    }
  }
  propose(StepLimit::Source::velocity, velocity_limit, SIZE_MAX);
  return limit;
}

double velocity_step(double gap, const std::array<double, 3>& secondary_min,
                     const std::array<double, 3>& secondary_max,
                     const std::array<double, 3>& main_min, const std::array<double, 3>& main_max) {
  double v2 = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double v =
        std::max({secondary_max[c] - main_min[c], main_max[c] - secondary_min[c], 0.0});
    v2 += v * v;
  }
  return v2 > 0.0 ? 0.9 * gap / std::sqrt(v2) : 1e30;
}

}  // namespace deck::cycle
