// Projects moves of nodes on the directions out of their penetrations.
#include "edit/fix/nodes/depenetrate_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "base/shared/parallel.hpp"

namespace deck::detail {
namespace {

constexpr int sweeps = 100;  // of the projection; one is exact for one direction
/// A move as deep along each of three faces at right angles is that much longer than deep.
const double sharpest_corner = std::sqrt(3.0);
constexpr double same_way = 1 - 1e-12;  // cosine of directions that are one

/// The point closest to `wanted` of all sums of shares of the directions, none negative (Hildreth's
/// method: a share may shrink again, but not below 0).
Vec project(const std::vector<Vec>& directions, const Vec& wanted) {
  std::vector<double> shares(directions.size(), 0);
  Vec sum;
  const double enough = 1e-12 * norm(wanted);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double change = 0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double next = std::max(0.0, shares[k] + dot(wanted - sum, directions[k]));
      const double by = next - shares[k];
      shares[k] = next;
      sum = sum + by * directions[k];
      change = std::max(change, std::abs(by));
    }
    if (change <= enough) break;
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
    // Nodes at one place are in many pairs without a direction: one stands for them all.
    const bool none = !(dot(way, way) > 0);
    if (std::none_of(bound.directions.begin(), bound.directions.end(), [&](const Vec& known) {
          return none ? !(dot(known, known) > 0) : dot(known, way) > same_way;
        }))
      bound.directions.push_back(way);
  }
}

std::vector<DepthBounds::Place> DepthBounds::allowed(const NodeMoves& wanted, int threads) const {
  std::vector<Place> out(wanted.size());
  parallel_pieces(threads, wanted.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      out[i] = closest_place(nodes_.at(wanted[i].first), wanted[i].second);
  });
  return out;
}

DepthBounds::Place DepthBounds::closest_place(const Bound& bound, const Vec& wanted) {
  Place out;
  out.by = project(bound.directions, wanted);
  double farthest = norm(out.by) / (bound.directions.size() > 1 ? sharpest_corner : 1);
  for (const Vec& way : bound.directions) farthest = std::max(farthest, dot(way, out.by));
  out.at_bound = farthest >= bound.reach;
  if (farthest > bound.reach) out.by = (bound.reach / farthest) * out.by;
  return out;
}

}  // namespace deck::detail
