// The elastic contact force of one pair in several arithmetics, and the kernel of the cycle stage
// on the same pairs. The law is that of the robust model, F = K/2 g (g - d) / d with a linear
// branch below d = 1e-8 g; the reference's own arithmetic subtracts twice and drops the node there.
#include <cmath>
#include <limits>

#include "accuracy/tiers.hpp"
#include "contact/shared/dd.hpp"
#include "deck/cycle/kernel.hpp"

namespace deck::accuracy {
namespace {

// Force for K0 = 1, from the depth where it is known better than gap - distance. In ratios: small
// numbers must not meet in a product.
template <class T>
T law(const T& gap, const T& distance, const T& depth) {
  const T half(0.5), floor(linear_below), share = distance / gap;
  if (share >= floor) return half * depth / share;
  return half * gap * ((T(1) - floor) / floor + (floor - share) / (floor * floor));
}

enum class Way : std::uint8_t { residual, local, textbook, reference };

template <class T, Way way>
Outcome force(const PairSample& s, FilterCounters&) {
  constexpr Form F = way == Way::reference ? Form::reference : Form::robust;
  std::array<Point3<T>, 5> x;
  for (std::size_t k = 0; k < 5; ++k) {
    x[k] = cast<T>(way == Way::local ? s.x[k] - s.x[0] : s.x[k]);
    if constexpr (std::is_same_v<T, float>) {
      if (std::isfinite(deck::largest_component(x[k]))) continue;
      Outcome none;
      none.value = std::numeric_limits<double>::quiet_NaN();
      return none;
    }
  }
  T d;
  if (s.edges) {
    const auto c = closest_between_edges<F>(x[0], x[1], x[2], x[3]);
    d = c.distance;
    if constexpr (way == Way::textbook) {
      d = deck::length(c.weight_s * x[0] + (T(1) - c.weight_s) * x[1] - c.weight_m * x[2] -
                       (T(1) - c.weight_m) * x[3]);
    }
  } else {
    const auto c = closest_on_segment<F>(x[4], {x[0], x[1], x[2], x[3]}, s.triangle);
    d = c.distance();
    if constexpr (way == Way::textbook) {
      Point3<T> q = c.weights[0] * x[0];
      for (std::size_t k = 1; k < 4; ++k) q = q + c.weights[k] * x[k];
      d = deck::length(x[4] - q);
    }
  }
  const T gap(s.gap), depth = gap - d;
  Outcome out;
  if (!(depth > T(0)) || !(gap > T(0))) return out;
  if constexpr (way == Way::reference) {
    const T left = gap - depth;
    if (left / gap < T(1e-10)) return out;
    out.value = static_cast<double>(T(0.5) * (gap / std::max(T(1e-10), left)) * depth);
  } else {
    out.value = static_cast<double>(law(gap, d, depth));
  }
  out.closer = true;
  return out;
}

Outcome robust_force(const PairSample& s, FilterCounters& counters) {
  const FilteredDepth f = s.edges
                              ? filtered_depth(s.x[0], s.x[1], s.x[2], s.x[3], s.gap, &counters)
                              : filtered_depth(s.x[4], s.corners(), s.triangle, s.gap, &counters);
  Outcome out;
  out.closer = f.depth > 0.0;
  if (out.closer) out.value = law(s.gap, f.distance, f.depth);
  return out;
}

const Tier tiers_of_forces[] = {
    {"float", "force", force<float, Way::residual>},
    {"float-local", "force", force<float, Way::local>},
    {"double", "force", force<double, Way::textbook>},
    {"double-residual", "force", force<double, Way::residual>},
    {"reference", "force", force<double, Way::reference>},
    {"double-double", "force", force<DoubleDouble, Way::residual>},
    {"robust", "force", robust_force},
    {"exact", "force", exact_force, true, true},
};

// Pairs of one kind as the arrays of a packet.
struct Packet {
  bool edges = false;
  std::vector<std::size_t> at;  // positions in the samples
  std::array<std::array<std::vector<double>, 3>, 5> x;
  std::vector<double> gap, k0;
  std::vector<std::uint8_t> triangle;

  void add(std::size_t index, const PairSample& s) {
    at.push_back(index);
    // Roles of node-segment pairs: the node comes first.
    for (std::size_t role = 0; role < 5; ++role) {
      const Point3<double>& p = s.x[edges ? role : (role + 4) % 5];
      x[role][0].push_back(p.x);
      x[role][1].push_back(p.y);
      x[role][2].push_back(p.z);
    }
    gap.push_back(s.gap);
    k0.push_back(1.0);
    triangle.push_back(s.triangle);
  }
  cycle::PacketView view() const {
    cycle::PacketView v;
    v.size = at.size();
    for (std::size_t role = 0; role < 5; ++role)
      for (std::size_t c = 0; c < 3; ++c) v.position[role][c] = x[role][c].data();
    v.gap = gap.data();
    v.k0 = k0.data();
    v.triangle = triangle.data();
    return v;
  }
};

}  // namespace

double elastic_force(double gap, double distance, double depth) {
  return law(gap, distance, depth);
}

double force_slope(double distance, double gap) {
  const double rho = std::max(distance / gap, linear_below);
  return 0.5 / (rho * rho);
}

std::span<const Tier> force_tiers() { return tiers_of_forces; }

KernelRun run_kernel(std::span<const PairSample> samples, int repeats) {
  KernelRun out;
  out.outcomes.resize(samples.size());
  Packet packets[2];
  packets[1].edges = true;
  for (std::size_t k = 0; k < samples.size(); ++k)
    packets[samples[k].edges ? 1 : 0].add(k, samples[k]);
  double total = 0.0;
  for (const Packet& packet : packets) {
    if (packet.at.empty()) continue;
    cycle::ContactCard card;
    card.kind = packet.edges ? cycle::ContactKind::edge_edge : cycle::ContactKind::node_segment;
    card.viss = 0.0;
    const cycle::KernelPlan plan = cycle::make_plan(card, cycle::Model::robust);
    const cycle::PacketView view = packet.view();
    cycle::PacketResult result;
    double best = std::numeric_limits<double>::infinity();
    for (int r = 0; r < std::max(1, repeats); ++r) {
      const double start = thread_nanoseconds();
      cycle::evaluate(plan, view, result);
      best = std::min(best, thread_nanoseconds() - start);
    }
    total += best;
    for (std::size_t k = 0; k < packet.at.size(); ++k) {
      // The force itself where it follows the law of this table. Between edges the solver's law is
      // singular at a tenth of the gap, and on the surface it drops the node: there what enters the
      // law is judged, depth and distance.
      const double depth = result.penetration[k], gap = packet.gap[k];
      const bool own = !packet.edges && result.normal_force[k] != 0.0;
      const double p = own ? depth : std::max(0.0, gap - result.distance[k]);
      out.outcomes[packet.at[k]].value = own       ? -result.normal_force[k]
                                         : p > 0.0 ? law(gap, result.distance[k], p)
                                                   : 0.0;
      out.outcomes[packet.at[k]].closer = p > 0.0;
    }
  }
  out.ns_per_pair = samples.empty() ? 0.0 : total / static_cast<double>(samples.size());
  return out;
}

}  // namespace deck::accuracy
