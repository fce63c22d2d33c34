// Ties: TYPE10, whose pairs tie on first contact, and TYPE7 with ITIED, whose pairs tie when their
// time step gets too small. A tie is stored in a frame of the segment's diagonals.
#include <algorithm>
#include <cmath>

#include "cycle/kernel/block.hpp"

namespace deck::cycle::detail {
namespace {

Vec relative_velocity(const PacketView& view, std::size_t i, const std::array<double, 4>& h) {
  Vec main = h[0] * at(view.velocity[1], i);
  for (std::size_t c = 1; c < 4; ++c) main = main + h[c] * at(view.velocity[c + 1], i);
  return at(view.velocity[0], i) - main;
}

void set_weights(PacketResult& out, std::size_t i, const std::array<double, 4>& h) {
  for (std::size_t c = 0; c < 4; ++c) out.weights[c][i] = h[c];
}

void set_force(PacketResult& out, std::size_t i, const Vec& f) {
  out.force[0][i] = f.x;
  out.force[1][i] = f.y;
  out.force[2][i] = f.z;
}

void set_normal(PacketResult& out, std::size_t i, const Vec& n) {
  out.normal[0][i] = n.x;
  out.normal[1][i] = n.y;
  out.normal[2][i] = n.z;
}

void tied_pair(const KernelPlan& plan, const PacketView& view, std::size_t i, double penetration,
               double distance, const std::array<double, 4>& fresh, PacketResult& out) {
  const std::array<double, 3> old{view.tie[0][i], view.tie[1][i], view.tie[2][i]};
  const bool live = old[0] != 0.0;
  std::array<double, 4> h = fresh;
  if (live) {
    h = {view.tie[3][i], view.tie[4][i], view.tie[5][i], 0.0};
    h[3] = 1.0 - h[0] - h[1] - h[2];
  }
  set_weights(out, i, h);
  out.penetration[i] = penetration;
  out.distance[i] = distance;
  out.effective_gap[i] = view.gap[i];
  const bool keep_far = plan.card.itied != 0 && live;
  if (penetration == 0.0 && !keep_far) {
    // Outside the gap a pair is dropped, unless it may never separate. A pair that still pulls in
    // its first cycle outside is evaluated below from its stored tie.
    if (!live) return;
  }
  const double k0 = view.k0[i];
  const Frame frame(corners(view, i));
  const Vec v = relative_velocity(view, i, h);
  const std::array<double, 3> rate{dot(v, frame.n), dot(v, frame.t1), dot(v, frame.t2)};
  const double c = plan.card.viss * std::sqrt(2.0 * k0 * view.mass[0][i]);
  std::array<double, 3> now{}, applied{};
  for (std::size_t j = 0; j < 3; ++j) {
    now[j] = old[j] + k0 * rate[j] * view.dt1;
    applied[j] = now[j] + c * rate[j];
  }
  out.damping_energy[i] = c * dot(v, v) * view.dt1;
  std::int64_t status = status_tied;
  if (plan.card.itied == 0 && old[0] * now[0] < 0.0) {
    // Rebound: separate. Inside the gap a marker keeps the sign of the old tie and its weights.
    now = {penetration > 0.0 ? std::copysign(1e-30, old[0]) : 0.0, 0.0, 0.0};
    applied = {};
    status = status_released;
  } else if (now[0] == 0.0 && penetration > 0.0) {
    now[0] = 1e-30;
  }
  if (status == status_tied) status |= status_contact;
  for (std::size_t j = 0; j < 3; ++j) {
    const double after = status == status_released ? 0.0 : now[j];
    out.elastic_energy[i] += 0.5 * view.dt1 * (old[j] + after) * rate[j];
  }
  set_force(out, i, frame.along(applied[0], applied[1], applied[2]));
  set_normal(out, i, frame.n);
  out.normal_force[i] = applied[0];
  out.k_nodal[i] = view.dt1 != 0.0 ? k0 + 2.0 * c / view.dt1 : k0;
  for (std::size_t j = 0; j < 3; ++j) {
    out.tie[j][i] = now[j];
    out.tie[j + 3][i] = h[j];
  }
  out.status[i] = status;
}

/// Returns false if the tie separates.
bool continue_tie(const KernelPlan& plan, const PacketView& view, std::size_t i,
                  PacketResult& out) {
  const ContactCard& card = plan.card;
  std::array<double, 4> h{view.tie[3][i], view.tie[4][i], view.tie[5][i], 0.0};
  h[3] = 1.0 - h[0] - h[1] - h[2];
  const std::array<Vec, 4> x = corners(view, i);
  const Frame frame(x);
  const double p0 = view.p0[i];
  const double pi = std::max(0.0, view.gap[i] - out.distance[i] - p0);
  const double ge = view.gap[i] - p0;
  const Vec point = h[0] * x[0] + h[1] * x[1] + h[2] * x[2] + h[3] * x[3];
  const double side = dot(at(view.position[0], i) - point, frame.n);
  set_weights(out, i, h);
  set_normal(out, i, frame.n);
  out.penetration[i] = pi;
  out.effective_gap[i] = ge;
  out.p0[i] = p0;
  out.friction_energy[i] = out.friction_heat[i] = 0.0;
  out.elastic_energy[i] = out.damping_energy[i] = 0.0;
  const double kappa = 0.5 * view.k0[i];  // half also with Istf 1
  const double room = ge - std::min(pi, view.tie[6][i]);
  const double phi =
      plan.model == Model::reference ? ge / std::max(1e-10, room) : ge / std::max(1e-8 * ge, room);
  const double kt = kappa * phi * phi;
  const double c = card.viss * std::sqrt(2.0 * kappa * phi * view.mass[0][i]);
  // A tie that separates still stiffens its nodes once and leaves weights, depth and side.
  out.k_nodal[i] = view.dt1 != 0.0 ? kt + 2.0 * c / view.dt1 : kt;
  for (std::size_t j = 3; j < 8; ++j) out.tie[j][i] = view.tie[j][i];
  if (card.itied == 1 && pi == 0.0 && side * view.tie[7][i] > 0.0) {
    for (std::size_t j = 0; j < 3; ++j) out.tie[j][i] = 0.0;
    return false;
  }
  const Vec v = relative_velocity(view, i, h);
  const std::array<double, 3> rate{dot(v, frame.n), dot(v, frame.t1), dot(v, frame.t2)};
  std::array<double, 3> applied{};
  for (std::size_t j = 0; j < 3; ++j) {
    const double old = view.tie[j][i];
    const double now = old + kt * rate[j] * view.dt1;
    out.tie[j][i] = now;
    applied[j] = now + c * rate[j];
    out.elastic_energy[i] += 0.5 * view.dt1 * (old + now) * rate[j];
  }
  set_force(out, i, frame.along(applied[0], applied[1], applied[2]));
  out.normal_force[i] = applied[0];
  out.damping_energy[i] = c * dot(v, v) * view.dt1;
  out.status[i] = status_tied | status_contact;
  return true;
}

/// Smallest nodal time step of the pair alone (factor 1).
double pair_nodal_step(const PacketView& view, std::size_t i, const PacketResult& out) {
  const double s = out.k_nodal[i];
  if (!(s > 0.0)) return 1e30;
  double dt = 1e30;
  if (view.mass[0][i] > 0.0) dt = std::sqrt(2.0 * view.mass[0][i] / s);
  for (std::size_t c = 0; c < 4; ++c) {
    const double share = std::abs(out.weights[c][i]) * s, m = view.mass[c + 1][i];
    if (share > 0.0 && m > 0.0) dt = std::min(dt, std::sqrt(2.0 * m / share));
  }
  return dt;
}

double edge_nodal_step(const PacketView& view, std::size_t i, const PacketResult& out) {
  const auto mass = [&](std::size_t a) {
    return out.weights[a][i] * view.mass[a][i] + out.weights[a + 1][i] * view.mass[a + 1][i];
  };
  const double m = std::min(mass(0), mass(2));
  return m > 0.0 ? std::sqrt(2.0 * m / out.k_nodal[i]) : 1e30;
}

void start_tie(const KernelPlan& plan, const PacketView& view, std::size_t i, PacketResult& out) {
  const double limit = plan.card.dtmin > 0.0 ? plan.card.dtmin : 1e-30;
  const double kinematic = out.dt_kinematic[i];
  for (std::size_t j = 0; j < 8; ++j) out.tie[j][i] = view.tie[j][i];  // a new tie overwrites it
  out.dt_kinematic[i] = 1e30;  // with ITIED no pair limits the step
  if ((out.status[i] & status_contact) == 0) return;
  if (kinematic > limit && pair_nodal_step(view, i, out) > limit) return;
  const std::array<Vec, 4> x = corners(view, i);
  const Frame frame(x);
  Vec point = out.weights[0][i] * x[0];
  for (std::size_t c = 1; c < 4; ++c) point = point + out.weights[c][i] * x[c];
  const double side = dot(at(view.position[0], i) - point, frame.n);
  const Vec n{out.normal[0][i], out.normal[1][i], out.normal[2][i]};
  const Vec f{out.force[0][i], out.force[1][i], out.force[2][i]};
  const Vec ft = f - out.normal_force[i] * n;
  const double ge = out.effective_gap[i], pi = out.penetration[i];
  const double kappa = plan.card.istf == 1 ? std::abs(plan.card.stfac) : 0.5 * view.k0[i];
  // Elastic part only, signed by the side from which the tie presses.
  const double d = plan.model == Model::reference ? std::max(1e-10, ge - pi)
                                                  : std::max(1e-8 * ge, out.distance[i]);
  const double elastic = -(kappa * (ge / d) * pi);
  out.tie[0][i] = elastic * std::copysign(1.0, side);
  out.tie[1][i] = dot(ft, frame.t1);
  out.tie[2][i] = dot(ft, frame.t2);
  for (std::size_t c = 0; c < 3; ++c) out.tie[c + 3][i] = out.weights[c][i];
  out.tie[6][i] = pi;
  out.tie[7][i] = side;
  out.status[i] |= status_tied;
}

}  // namespace

void force_tied_block(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                      std::size_t n, int width, const GeometryBlock& g, PacketResult& out) {
  const auto w = static_cast<std::size_t>(width);
  for (std::size_t slot = 0; slot < (n + w - 1) / w * w; ++slot) {
    const std::size_t first = begin + slot / w * w;
    const std::size_t i = (first + w <= view.size ? first : view.size - w) + slot % w;
    tied_pair(plan, view, i, g.penetration[slot], g.distance[slot],
              {g.weight[0][slot], g.weight[1][slot], g.weight[2][slot], g.weight[3][slot]}, out);
  }
}

void apply_step_deletion(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                         std::size_t end, PacketResult& out) {
  const ContactCard& card = plan.card;
  const bool edges = card.kind == ContactKind::edge_edge;
  for (std::size_t i = begin; i < end; ++i) {
    if (!(out.k_nodal[i] > 0.0)) continue;
    const double step = edges ? edge_nodal_step(view, i, out) : pair_nodal_step(view, i, out);
    if (card.step_factor * step <= card.dtmin) out.status[i] |= status_step_deleted;
  }
}

void apply_time_step_tie(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                         std::size_t end, PacketResult& out) {
  for (std::size_t i = begin; i < end; ++i) {
    if (view.tie[0][i] == 0.0) {
      start_tie(plan, view, i, out);
      continue;
    }
    out.dt_kinematic[i] = 1e30;
    if (continue_tie(plan, view, i, out)) continue;
    set_force(out, i, {});
    out.normal_force[i] = 0.0;
    out.status[i] = status_released;
  }
}

}  // namespace deck::cycle::detail
