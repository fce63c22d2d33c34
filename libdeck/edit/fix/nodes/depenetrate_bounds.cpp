// Projects moves of nodes on the directions out of their penetrations.
#include "edit/fix/nodes/depenetrate_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/shared/parallel.hpp"

namespace deck::detail {
namespace {

constexpr int sweeps = 100;  // of the projection; one is exact for one direction
/// A move as deep along each of three faces at right angles is that much longer than deep.
const double sharpest_corner = std::sqrt(3.0);
constexpr double same_way = 1 - 1e-12;  // cosine of directions that are one

// Two lanes are what every processor has; four of them are under way at a time.
typedef double ConeLanes __attribute__((vector_size(16)));
typedef long long ConeMask __attribute__((vector_size(16)));
constexpr std::size_t cone_parts = 4, cones_at_once = 2 * cone_parts;

/// Nodes with as many directions each. What one does with its cone waits for one sum after the
/// other: eight side by side take hardly longer than one. Who has done makes room for the next.
class Cones {
 public:
  /// For all nodes below `count`: take(node, p), where p is the point of the cone of
  /// directions_of(node) closest to wanted_of(node), by shares that may shrink again but not below
  /// 0.
  template <class DirectionsOf, class WantedOf, class Take>
  void project(std::size_t count, const DirectionsOf& directions_of, const WantedOf& wanted_of,
               const Take& take) {
    directions_.assign(directions_of(0).size(), {});
    std::array<std::size_t, cones_at_once> node{};
    std::array<int, cones_at_once> swept{};
    std::size_t next = 0, at_work = 0;
    const auto load = [&](std::size_t lane) {
      open_[lane / 2][lane % 2] = next < count ? -1 : 0;
      if (next == count) return;
      set(lane, directions_of(next), wanted_of(next));
      node[lane] = next++;
      swept[lane] = 0;
      ++at_work;
    };
    for (std::size_t lane = 0; lane < cones_at_once; ++lane) load(lane);
    while (at_work > 0) {
      sweep();
      for (std::size_t lane = 0; lane < cones_at_once; ++lane) {
        const std::size_t part = lane / 2, k = lane % 2;
        if (open_[part][k] == 0) continue;
        if (++swept[lane] < sweeps && !(change_[part][k] <= enough_[part][k])) continue;
        take(node[lane], sum_.at(lane));
        --at_work;
        load(lane);
      }
    }
  }

 private:
  void set(std::size_t lane, const std::vector<Vec>& directions, const Vec& wanted) {
    for (std::size_t k = 0; k < directions.size(); ++k) {
      directions_[k].at.set(lane, directions[k]);
      directions_[k].share[lane / 2][lane % 2] = 0;
    }
    wanted_.set(lane, wanted);
    sum_.set(lane, {});
    enough_[lane / 2][lane % 2] = 1e-12 * norm(wanted);
  }
  void sweep() {
    const ConeLanes zero{};
    const ConeMask without_sign = ConeMask{} + 0x7fffffffffffffff;
    for (ConeLanes& part : change_) part = zero;
    const auto step = [&](Direction& d, std::size_t i) {
      const ConeLanes x = d.at.x[i], y = d.at.y[i], z = d.at.z[i];
      const ConeLanes along = (wanted_.x[i] - sum_.x[i]) * x + (wanted_.y[i] - sum_.y[i]) * y +
                              (wanted_.z[i] - sum_.z[i]) * z;
      const ConeLanes share = d.share[i] + along;
      const ConeLanes next = share > zero ? share : zero;
      const ConeLanes by = next - d.share[i];
      sum_.x[i] += by * x;
      sum_.y[i] += by * y;
      sum_.z[i] += by * z;
      const auto size = reinterpret_cast<ConeLanes>(reinterpret_cast<ConeMask>(by) & without_sign);
      change_[i] = change_[i] < size ? size : change_[i];
      d.share[i] = next;
    };
    const auto steps = [&]<std::size_t... part>(Direction & d, std::index_sequence<part...>) {
      (step(d, part), ...);
    };
    for (Direction& d : directions_) steps(d, std::make_index_sequence<cone_parts>{});
  }

  struct Vectors {
    ConeLanes x[cone_parts]{}, y[cone_parts]{}, z[cone_parts]{};
    void set(std::size_t i, const Vec& v) {
      x[i / 2][i % 2] = v.x;
      y[i / 2][i % 2] = v.y;
      z[i / 2][i % 2] = v.z;
    }
    Vec at(std::size_t i) const { return {x[i / 2][i % 2], y[i / 2][i % 2], z[i / 2][i % 2]}; }
  };
  struct Direction {
    Vectors at;
    ConeLanes share[cone_parts]{};
  };
  std::vector<Direction> directions_;
  Vectors wanted_, sum_;
  ConeLanes enough_[cone_parts]{}, change_[cone_parts]{};
  ConeMask open_[cone_parts]{};
};

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
  const auto directions = [&](std::uint32_t i) -> const std::vector<Vec>& {
    return nodes_.at(wanted[i].first).directions;
  };
  std::vector<std::vector<std::uint32_t>> by_count;  // nodes of as many directions, in their order
  for (std::uint32_t i = 0; i < wanted.size(); ++i) {
    const std::size_t count = directions(i).size();
    if (count >= by_count.size()) by_count.resize(count + 1);
    by_count[count].push_back(i);
  }
  std::vector<std::uint32_t> order;
  order.reserve(wanted.size());
  for (const auto& nodes : by_count) order.insert(order.end(), nodes.begin(), nodes.end());
  std::vector<Place> out(wanted.size());
  parallel_pieces(threads, order.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    Cones cones;
    for (std::size_t i = begin; i < end;) {
      const std::size_t first = i, count = directions(order[i]).size();
      while (i < end && directions(order[i]).size() == count) ++i;
      const auto take = [&](std::size_t k, const Vec& by) {
        const std::uint32_t at = order[first + k];
        out[at] = within(nodes_.at(wanted[at].first), by);
      };
      const auto wanted_of = [&](std::size_t k) { return wanted[order[first + k]].second; };
      if (count == 0)
        for (std::size_t k = 0; first + k < i; ++k) take(k, wanted_of(k));
      else
        cones.project(
            i - first,
            [&](std::size_t k) -> const std::vector<Vec>& { return directions(order[first + k]); },
            wanted_of, take);
    }
  });
  return out;
}

DepthBounds::Place DepthBounds::within(const Bound& bound, const Vec& by) {
  Place out;
  out.by = by;
  double farthest = norm(out.by) / (bound.directions.size() > 1 ? sharpest_corner : 1);
  for (const Vec& way : bound.directions) farthest = std::max(farthest, dot(way, out.by));
  out.at_bound = farthest >= bound.reach;
  if (farthest > bound.reach) out.by = (bound.reach / farthest) * out.by;
  return out;
}

}  // namespace deck::detail
