// Heat between the two sides of a pair: conduction, radiation and friction heat.
#include "cycle/shared/heat.hpp"

#include <algorithm>
#include <cmath>

#include "cycle/kernel/block.hpp"

namespace deck::cycle {
namespace {

/// Area of a segment, and distance of the node from its plane, signed by its orientation.
struct SegmentPlane {
  double area;
  double distance;
};

SegmentPlane plane_of(const HeatState& s) {
  std::array<Vec, 5> x;
  for (std::size_t c = 0; c < 5; ++c) x[c] = to_vec(s.position[c]);
  const Vec n = cross(x[1] - x[3], x[2] - x[4]);
  const Vec centre = 0.25 * (x[1] + x[2] + x[3] + x[4]);
  const double size = norm(n);
  return {0.5 * size, dot(centre - x[0], n) / std::max(1e-15, size)};
}

/// Heat exchange coefficient: Kthe, or Kthe times a function of pressure.
double exchange(const ContactCard& card, double force, double area) {
  if (!card.fct_idk) return card.kthe != 0.0 ? card.kthe : 1e-30;
  const double scale = card.kthe != 0.0 ? card.kthe : 1.0;
  const double pressure = area > 0.0 ? card.ascalek * force / area : 0.0;
  return scale * std::max(1e-30, (*card.fct_idk)(pressure));
}

}  // namespace

HeatFlow pair_heat(const ContactCard& card, const HeatState& s) {
  HeatFlow flow;
  const SegmentPlane plane = plane_of(s);
  const double area = s.area != 0.0 ? s.area : plane.area;
  const bool both = card.ithe_form == 1;
  const double ts = s.temperature[0];
  double tm = card.tint;
  if (both) {
    tm = 0.0;
    for (std::size_t c = 0; c < 4; ++c) tm += s.weight[c] * s.temperature[c + 1];
  }
  const double tau = s.dt1 * card.thermal_speed_up;
  const double away = std::abs(plane.distance);
  double h;
  if (card.frad != 0.0 && s.gap <= away && away <= card.drad) {
    h = card.frad * (tm * tm + ts * ts) * (tm + ts);  // the solver reports no conductance
  } else {
    h = exchange(card, std::abs(s.normal_force), area);
    if (!both && s.conductivity > 0.0) {
      // The solver counts the gap as a resistance only on one side of the segment.
      const double width = std::max(plane.distance, 0.0);
      h = 1.0 / (width / s.conductivity + 1.0 / h);
    }
    flow.conductance = area * h * card.thermal_speed_up;
  }
  const double q = area * (tm - ts) * tau * h;
  flow.q[0] = q + card.fheats * s.friction_heat;
  if (!both && card.fct_idk) flow.q[0] = q;  // the solver omits friction heat here
  if (both) {
    for (std::size_t c = 0; c < 4; ++c) {
      flow.q[c + 1] = s.weight[c] * (card.fheatm * s.friction_heat) - s.weight[c] * q;
    }
  }
  return flow;
}

double edge_contact_area(const ContactCard& card, const EdgeHeatState& s) {
  const Vec es = to_vec(s.position[1]) - to_vec(s.position[0]);
  const Vec em = to_vec(s.position[3]) - to_vec(s.position[2]);
  const double ls = norm(es), lm = norm(em);
  if (card.ithe_form != 1) return ls * s.width[0];
  const double both = ls * lm;
  const double sine = both > 0.0 ? norm(cross(es, em)) / both : 0.0;
  return std::min(std::min(ls, lm) * std::min(s.width[0], s.width[1]),
                  s.width[0] * s.width[1] / std::max(1e-30, sine));
}

HeatFlow pair_heat(const ContactCard& card, const EdgeHeatState& s) {
  HeatFlow flow;
  const bool both = card.ithe_form == 1;
  const auto mean = [&](const std::array<double, 4>& v, std::size_t first) {
    return s.weight[first] * v[first] + s.weight[first + 1] * v[first + 1];
  };
  const double ts = mean(s.temperature, 0);
  const double tm = both ? mean(s.temperature, 2) : card.tint;
  const double area = s.area < 0.0 ? edge_contact_area(card, s) : s.area;
  const double beyond = s.distance - s.gap;
  double h = 0.0;
  if (beyond > 0.0) {
    if (card.frad == 0.0 || !(beyond <= card.drad)) return flow;
    h = card.frad * (tm * tm + ts * ts) * (tm + ts);
  } else {
    h = exchange(card, s.normal_force, area);  // signed: negative under pressure
    const double width = std::max(beyond + s.effective_gap, 0.0);
    double conductivity = mean(s.conductivity, 0);
    if (both) conductivity = 0.5 * (conductivity + mean(s.conductivity, 2));
    if (conductivity > 0.0) {
      h = 1.0 / (width / conductivity + 1.0 / h);
    } else if (width > 0.0) {
      return flow;  // no conductivity: nothing passes a gap
    }
    flow.conductance = area * h;
  }
  // The thermal speed-up factor is not applied between edges.
  const double q = area * (tm - ts) * s.dt1 * h;
  for (std::size_t r = 0; r < 2; ++r) {
    flow.q[r] = s.weight[r] * q;
    if (both) flow.q[r + 2] = -(s.weight[r + 2] * q);
  }
  return flow;
}

namespace detail {

void apply_edge_heat(const KernelPlan& plan, const PacketView& view, std::size_t begin,
                     std::size_t end, PacketResult& out) {
  for (std::size_t i = begin; i < end; ++i) {
    EdgeHeatState s;
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = 0; c < 3; ++c) s.position[r][c] = view.position[r][c][i];
      s.temperature[r] = view.temperature[r][i];
      s.weight[r] = out.weights[r][i];
      if (view.edge_conductivity[r] != nullptr) s.conductivity[r] = view.edge_conductivity[r][i];
    }
    s.width = {view.edge_width[0][i], view.edge_width[1][i]};
    s.normal_force = out.normal_force[i];
    s.distance = out.distance[i];
    s.gap = view.gap[i];
    s.effective_gap = out.effective_gap[i];
    s.dt1 = view.dt1;
    const HeatFlow flow = pair_heat(plan.card, s);
    for (std::size_t r = 0; r < 5; ++r) out.heat[r][i] = flow.q[r];
    out.conductance[i] = flow.conductance;
  }
}

void apply_heat(const KernelPlan& plan, const PacketView& view, std::size_t begin, std::size_t end,
                PacketResult& out) {
  for (std::size_t i = begin; i < end; ++i) {
    const bool kept = plan.card.icurv != 0
                          ? (out.status[i] & status_kept) != 0
                          : out.distance[i] < std::max(view.gap[i], plan.card.drad);
    if (!kept) {
      for (auto& q : out.heat) q[i] = 0.0;
      out.conductance[i] = 0.0;
      continue;
    }
    HeatState s;
    for (std::size_t r = 0; r < 5; ++r) {
      for (std::size_t c = 0; c < 3; ++c) s.position[r][c] = view.position[r][c][i];
      s.temperature[r] = view.temperature[r][i];
    }
    for (std::size_t c = 0; c < 4; ++c) s.weight[c] = out.weights[c][i];
    s.area = view.area != nullptr ? view.area[i] : 0.0;
    s.normal_force = out.normal_force[i];
    s.friction_heat = out.friction_heat[i];
    s.gap = out.effective_gap[i];
    s.conductivity = view.conductivity != nullptr ? view.conductivity[i] : 0.0;
    s.dt1 = view.dt1;
    const HeatFlow flow = pair_heat(plan.card, s);
    for (std::size_t r = 0; r < 5; ++r) out.heat[r][i] = flow.q[r];
    out.conductance[i] = flow.conductance;
  }
}

}  // namespace detail
}  // namespace deck::cycle
