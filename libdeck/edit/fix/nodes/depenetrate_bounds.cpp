// Projects moves of nodes on the directions out of their penetrations.
#include "edit/fix/nodes/depenetrate_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace deck::detail {
namespace {

constexpr int sweeps = 100;  // of the projection; one is exact for one direction
/// A move as deep along each of three faces at right angles is that much longer than deep.
const double sharpest_corner = std::sqrt(3.0);
constexpr double same_way = 1 - 1e-12;  // cosine of directions that are one

/// The point of the cone of `directions` that is closest to `wanted`, by shares that may shrink
/// again but not below 0.
Vec on_cone(const std::vector<Vec>& directions, const Vec& wanted) {
  std::vector<double> share(directions.size(), 0);
  Vec sum;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double change = 0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double next = std::max(0.0, share[k] + dot(wanted - sum, directions[k]));
      sum = sum + (next - share[k]) * directions[k];
      change = std::max(change, std::abs(next - share[k]));
      share[k] = next;
    }
    if (change <= 1e-12 * norm(wanted)) break;
  }
  return sum;
}

}  // namespace

void DepthBounds::add(const PairKey& key, const PairState& state, const Vec& normal, double reach) {
  for (int i = 0; i < state.count; ++i) {
    Bound& bound = nodes_[state.nodes[static_cast<std::size_t>(i)]];
    bound.reach = std::max(bound.reach, reach);
    bound.pairs.push_back(key);
    const Vec way = i < state.secondary_count ? normal : -1.0 * normal;
    if (std::none_of(bound.directions.begin(), bound.directions.end(),
                     [&](const Vec& known) { return dot(known, way) > same_way; }))
      bound.directions.push_back(way);
  }
}

void DepthBounds::follow(NodeIndex n, double reach) {
  Bound& bound = nodes_[n];
  if (bound.pairs.empty()) bound.reach = std::max(bound.reach, reach);
}

DepthBounds::Place DepthBounds::allowed(NodeIndex n, const Vec& wanted) const {
  const Bound& bound = nodes_.at(n);
  Place out;
  out.by = bound.directions.empty() ? wanted : on_cone(bound.directions, wanted);
  double farthest = norm(out.by) / (bound.directions.size() > 1 ? sharpest_corner : 1);
  for (const Vec& way : bound.directions) farthest = std::max(farthest, dot(way, out.by));
  out.at_bound = farthest >= bound.reach;
  if (farthest > bound.reach) out.by = (bound.reach / farthest) * out.by;
  return out;
}

}  // namespace deck::detail
