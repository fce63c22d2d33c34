// Depth and direction of one penetration where the nodes are now, and which nodes may give way.
#include "edit/fix/nodes/depenetrate_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/shared/closest.hpp"
#include "edit/fix/type_rules.hpp"

namespace deck::detail {
namespace {

constexpr double noise = 1e-6;        // of the gap: a vector this short has no direction
constexpr double least_share = 1e-3;  // of a pair's weights, squared, on nodes that may move

Vec segment_normal(const Coordinates& x, const std::array<NodeIndex, 4>& n) {
  if (n[2] == n[3]) return cross(at(x, n[1]) - at(x, n[0]), at(x, n[2]) - at(x, n[0]));
  return cross(at(x, n[2]) - at(x, n[0]), at(x, n[3]) - at(x, n[1]));
}

PairState segment_state(const Contact& c, const Coordinates& x, const PairAt& pair) {
  const SecondaryNode& s = c.secondary[pair.secondary];
  const MainSegment& m = c.main[pair.main];
  const bool triangle = m.nodes[2] == m.nodes[3];
  const std::array<Vec, 4> corners{at(x, m.nodes[0]), at(x, m.nodes[1]), at(x, m.nodes[2]),
                                   at(x, m.nodes[3])};
  const auto closest = closest_on_segment<Form::reference>(at(x, s.node), corners, triangle);
  PairState out;
  out.gap = c.gap_rule(s.gap, m.gap, s.length, m.length);
  const auto& sub = closest.closest();
  out.distance = sub.distance;
  if (sub.distance > 0) out.normal = (1 / sub.distance) * sub.vector;
  out.nodes[0] = s.node;
  out.weights[0] = 1;
  out.count = 1;
  for (std::size_t k = 0; k < (triangle ? 3U : 4U); ++k) {
    out.nodes[static_cast<std::size_t>(out.count)] = m.nodes[k];
    out.weights[static_cast<std::size_t>(out.count++)] = -closest.weights[k];
  }
  return out;
}

PairState edge_state(const Contact& c, const Coordinates& x, const PairAt& pair) {
  const ContactEdge& s = c.secondary_edges[pair.secondary];
  const ContactEdge& m = c.main_edges[pair.main];
  const auto closest = closest_between_edges<Form::reference>(at(x, s.nodes[0]), at(x, s.nodes[1]),
                                                              at(x, m.nodes[0]), at(x, m.nodes[1]));
  PairState out;
  out.gap = c.gap_rule(s.gap, m.gap, s.length, m.length);
  out.distance = closest.distance;
  if (out.distance > 0) out.normal = (1 / out.distance) * closest.vector;
  out.nodes = {s.nodes[0], s.nodes[1], m.nodes[0], m.nodes[1], 0, 0};
  out.weights = {
      closest.weight_s, 1 - closest.weight_s, -closest.weight_m, -(1 - closest.weight_m), 0, 0};
  out.count = 4;
  out.secondary_count = 2;
  return out;
}

/// A direction for a pair at distance 0.
Vec direction_on_surface(const Scene& scene, const FixMesh& mesh, const Coordinates& x,
                         const PairAt& place, const PairState& state) {
  const Contact& c = scene.contacts[place.contact];
  Vec n;
  if (c.kind == ContactKind::node_segment) {
    n = segment_normal(x, c.main[place.main].nodes);
  } else {
    const auto& s = c.secondary_edges[place.secondary].nodes;
    const auto& m = c.main_edges[place.main].nodes;
    n = cross(at(x, s[1]) - at(x, s[0]), at(x, m[1]) - at(x, m[0]));
  }
  const double l = norm(n);
  if (!(l > 0)) return {};
  n = (1 / l) * n;
  if (c.kind == ContactKind::node_segment && c.main[place.main].carrier == Carrier::solid) return n;
  // The neighbours decide, each by how far it is off the plane. Where all are in it any side will
  // do, if only it is the same for all: the one of the normal.
  double side = 0, reach = 0;
  const Vec origin = at(x, state.nodes[static_cast<std::size_t>(state.secondary_count)]);
  for (int i = 0; i < state.secondary_count; ++i)
    for (const NodeIndex next : mesh.neighbours(state.nodes[static_cast<std::size_t>(i)])) {
      const Vec off = at(x, next) - origin;
      side += dot(off, n);
      reach += norm(off);
    }
  return side < -1e-6 * reach ? -1.0 * n : n;
}

/// True if the closest point of a pair lies on nodes that `nearest`, the closest pair of the same
/// secondary node, has too: that pair is then the stricter one, and its direction the better.
bool follows(const PairState& pair, const PairState& nearest) {
  const auto end = nearest.nodes.begin() + nearest.count;
  for (int i = 1; i < pair.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (pair.weights[k] != 0 && std::find(nearest.nodes.begin() + 1, end, pair.nodes[k]) == end)
      return false;
  }
  return true;
}

}  // namespace

PairKey key_of(const Scene& scene, const PairAt& at) {
  const Contact& c = scene.contacts[at.contact];
  PairKey key;
  key.contact = at.contact;
  if (c.kind == ContactKind::node_segment) {
    key.secondary = {c.secondary[at.secondary].node, 0};
    key.main = c.main[at.main].nodes;
    std::sort(key.main.begin(), key.main.end());
    return key;
  }
  key.secondary = c.secondary_edges[at.secondary].nodes;
  std::sort(key.secondary.begin(), key.secondary.end());
  const auto& m = c.main_edges[at.main].nodes;
  key.main = {std::min(m[0], m[1]), std::max(m[0], m[1]), 0, 0};
  return key;
}

PairState state_of(const Scene& scene, const Coordinates& x, const PairAt& at) {
  const Contact& c = scene.contacts[at.contact];
  return c.kind == ContactKind::node_segment ? segment_state(c, x, at) : edge_state(c, x, at);
}

bool has_direction(const PairState& state) { return state.distance > noise * state.gap; }

Vec way_out(const Scene& scene, const FixMesh& mesh, const Coordinates& x, const PairAt& at,
            const PairState& state) {
  return has_direction(state) ? state.normal : direction_on_surface(scene, mesh, x, at, state);
}

std::vector<const PairNow*> strictest(const std::vector<PairNow>& pairs) {
  std::vector<std::pair<double, std::size_t>> order;  // negative depth, position
  for (std::size_t i = 0; i < pairs.size();) {
    std::size_t end = i, nearest = i;
    for (; end < pairs.size() && pairs[end].at.contact == pairs[i].at.contact &&
           pairs[end].at.secondary == pairs[i].at.secondary;
         ++end)
      if (pairs[end].state.distance < pairs[nearest].state.distance) nearest = end;
    for (std::size_t k = i; k < end; ++k) {
      const PairState& state = pairs[k].state;
      const bool node = state.secondary_count == 1;
      if (node && k != nearest && follows(state, pairs[nearest].state)) continue;
      if (state.depth() > -state.gap) order.emplace_back(-state.depth(), k);
    }
    i = end;
  }
  std::sort(order.begin(), order.end());
  std::vector<const PairNow*> out;
  out.reserve(order.size());
  for (const auto& [depth, k] : order) out.push_back(&pairs[k]);
  return out;
}

std::string why_not_movable(const FixMesh& mesh, const Coordinates& x, const PairState& state) {
  const auto begin = state.nodes.begin();
  const std::vector<NodeIndex> main(begin + state.secondary_count, begin + state.count);
  for (int i = 0; i < state.secondary_count; ++i)
    if (mesh.connected_within(x, state.nodes[static_cast<std::size_t>(i)], main,
                              std::sqrt(2.0) * state.gap))
      return "both sides are one mesh, less than 1.42 gaps apart along it: the gap is too large "
             "for this mesh; reduce it, or set Irem_gap to 2";
  return {};
}

std::vector<bool> inside_solids(const Scene& scene, std::uint32_t contact) {
  const Contact& c = scene.contacts[contact];
  if (c.kind != ContactKind::node_segment)
    return std::vector<bool>(c.secondary_edges.size(), false);
  std::vector<bool> inside(c.secondary.size(), false);
  std::vector<double> closest(c.secondary.size(), std::numeric_limits<double>::infinity());
  for (const PenetrationRow& row : c.penetrations) {
    if (is_modern(c.type)) {
      // One row a node, with the normal of the face: behind it no gap leaves the node free.
      inside[row.secondary] = !(free_gap(c, row) > 0);
      continue;
    }
    if (row.on_surface || !(row.distance < closest[row.secondary])) continue;
    closest[row.secondary] = row.distance;
    const MainSegment& m = c.main[row.main];
    const Vec n = segment_normal(scene.coordinates, m.nodes);
    const double along = dot(n, {row.normal[0], row.normal[1], row.normal[2]});
    inside[row.secondary] = m.carrier == Carrier::solid && along < -0.1 * norm(n);
  }
  return inside;
}

NodeMoves solve_wishes(const std::vector<Wish>& wishes, const std::vector<std::uint8_t>& held,
                       int sweeps) {
  std::vector<std::uint32_t> index(held.size(), no_index);  // by node
  std::uint32_t count_of_nodes = 0;
  for (const Wish& w : wishes)
    for (int i = 0; i < w.state.count; ++i) {
      std::uint32_t& at = index[w.state.nodes[static_cast<std::size_t>(i)]];
      if (at == no_index) at = count_of_nodes++;
    }
  std::vector<Vec> move(count_of_nodes);
  struct Row {
    std::array<std::uint32_t, 6> at{};
    std::array<double, 6> weight{}, give{};
    double scale = 0;
  };
  std::vector<Row> rows(wishes.size());
  for (std::size_t r = 0; r < wishes.size(); ++r) {
    const Wish& w = wishes[r];
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(w.state.count); ++i) {
      const NodeIndex n = w.state.nodes[i];
      const bool main = static_cast<int>(i) >= w.state.secondary_count;
      rows[r].at[i] = index[n];
      rows[r].weight[i] = w.state.weights[i];
      const bool free = held[n] == 0 && (!main || w.main_gives_way);
      rows[r].give[i] = free ? w.state.weights[i] : 0;
      sum += rows[r].give[i] * rows[r].weight[i];
    }
    // Where only a far corner of a side can give way nothing it may do moves the pair.
    rows[r].scale = sum > least_share ? 1 / sum : 0;
  }
  // Hildreth's method: a multiplier per wish that may shrink again, but not below 0.
  std::vector<double> multiplier(wishes.size(), 0);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool changed = false;
    for (std::size_t r = 0; r < wishes.size(); ++r) {
      if (rows[r].scale == 0) continue;
      const Wish& w = wishes[r];
      const auto count = static_cast<std::size_t>(w.state.count);
      double have = 0;
      for (std::size_t i = 0; i < count; ++i)
        have += rows[r].weight[i] * dot(w.normal, move[rows[r].at[i]]);
      const double next = std::max(0.0, multiplier[r] + (w.by - have) * rows[r].scale);
      const double change = next - multiplier[r];
      if (change == 0) continue;
      multiplier[r] = next;
      changed |= std::abs(change) > 1e-5 * w.state.gap;
      for (std::size_t i = 0; i < count; ++i) {
        if (rows[r].give[i] == 0) continue;
        Vec& m = move[rows[r].at[i]];
        m = m + (change * rows[r].give[i]) * w.normal;
      }
    }
    if (!changed) break;
  }
  NodeMoves out;
  for (NodeIndex n = 0; n < index.size(); ++n)
    if (const std::uint32_t i = index[n]; i != no_index && dot(move[i], move[i]) > 0)
      out.emplace_back(n, move[i]);
  return out;
}

}  // namespace deck::detail
