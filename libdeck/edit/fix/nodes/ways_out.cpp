// Depth and direction of one penetration at present positions, nodes that may move, and the
// smallest moves for many penetrations.
// solve_wishes uses Hildreth's method for: minimise the sum of squared moves so that each pair
// grows by its wish along its normal. Sweep over the wishes; each one pulls its nodes by what is
// still missing, and may later give back at most what it has pulled. Cost: wishes times sweeps.
#include "edit/fix/nodes/ways_out.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/shared/parallel.hpp"
#include "contact/shared/closest.hpp"
#include "edit/fix/fix_scene.hpp"

namespace deck::detail {
namespace {

constexpr double noise = 1e-6;        // of the gap: shorter vectors have no direction
constexpr double least_share = 1e-3;  // sum of squared weights of a pair on nodes that may move

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
  out.gap = c.pair_gap(pair.secondary, pair.main);
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
  out.gap = c.pair_gap(pair.secondary, pair.main);
  out.distance = closest.distance;
  if (out.distance > 0) out.normal = (1 / out.distance) * closest.vector;
  out.nodes = {s.nodes[0], s.nodes[1], m.nodes[0], m.nodes[1], 0, 0};
  out.weights = {
      closest.weight_s, 1 - closest.weight_s, -closest.weight_m, -(1 - closest.weight_m), 0, 0};
  out.count = 4;
  out.secondary_count = 2;
  return out;
}

/// Direction of a pair at distance 0.
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
  // The neighbours decide, weighted by distance from the plane. If all are in the plane, the normal
  // decides, so that all nodes go to one side.
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

/// True if the closest point of a pair lies on nodes that `nearest`, the closest pair of this
/// secondary node, has too: `nearest` then is the stricter pair with the better direction.
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
    if (is_type24_or_25(c.type)) {
      // One row per node, with the normal of the face: behind it no gap frees the node.
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
  std::vector<Vec> move(held.size());  // by node
  struct Row {
    std::array<double, 6> give{};
    double scale = 0, multiplier = 0;
  };
  std::vector<Row> rows(wishes.size());
  for (std::size_t r = 0; r < wishes.size(); ++r) {
    const PairState& state = wishes[r].state;
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(state.count); ++i) {
      const bool main = static_cast<int>(i) >= state.secondary_count;
      const bool free = held[state.nodes[i]] == 0 && (!main || wishes[r].main_gives_way);
      rows[r].give[i] = free ? state.weights[i] : 0;
      sum += rows[r].give[i] * state.weights[i];
    }
    // If only a far corner of a side can move, its moves do not help.
    rows[r].scale = sum > least_share ? 1 / sum : 0;
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool changed = false;
    for (std::size_t r = 0; r < wishes.size(); ++r) {
      auto& [give, scale, multiplier] = rows[r];
      if (scale == 0) continue;
      const Wish& w = wishes[r];
      const auto count = static_cast<std::size_t>(w.state.count);
      double have = 0;
      for (std::size_t i = 0; i < count; ++i)
        have += w.state.weights[i] * dot(w.normal, move[w.state.nodes[i]]);
      const double next = std::max(0.0, multiplier + (w.by - have) * scale);
      const double change = next - multiplier;
      if (change == 0) continue;
      multiplier = next;
      changed |= std::abs(change) > 1e-5 * w.state.gap;
      for (std::size_t i = 0; i < count; ++i) {
        Vec& m = move[w.state.nodes[i]];
        if (give[i] != 0) m = m + (change * give[i]) * w.normal;
      }
    }
    if (!changed) break;
  }
  NodeMoves out;
  for (NodeIndex n = 0; n < move.size(); ++n)
    if (dot(move[n], move[n]) > 0) out.emplace_back(n, move[n]);
  return out;
}

// ---- bounds of moves ---------------------------------------------------------------------------

namespace {

constexpr int most_projections = 100;  // one is exact for one direction
/// A move by the depth along each of three orthogonal faces is this factor longer.
const double sharpest_corner = std::sqrt(3.0);
constexpr double same_way = 1 - 1e-12;  // cosine of equal directions

/// The point closest to `wanted` among sums of nonnegative multiples of the directions.
Vec project(const std::vector<Vec>& directions, const Vec& wanted) {
  std::vector<double> shares(directions.size(), 0);
  Vec sum;
  const double enough = 1e-12 * norm(wanted);
  for (int sweep = 0; sweep < most_projections; ++sweep) {
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
    NodeBound& bound = nodes_[state.nodes[static_cast<std::size_t>(i)]];
    bound.reach = std::max(bound.reach, reach);
    bound.pairs.push_back(key);
    const Vec way = i < state.secondary_count ? normal : -1.0 * normal;
    // Coincident nodes have many pairs without direction: keep one.
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

DepthBounds::Place DepthBounds::closest_place(const NodeBound& bound, const Vec& wanted) {
  Place out;
  out.by = project(bound.directions, wanted);
  double farthest = norm(out.by) / (bound.directions.size() > 1 ? sharpest_corner : 1);
  for (const Vec& way : bound.directions) farthest = std::max(farthest, dot(way, out.by));
  out.at_bound = farthest >= bound.reach;
  if (farthest > bound.reach) out.by = (bound.reach / farthest) * out.by;
  return out;
}

// ---- translations ------------------------------------------------------------------------------

namespace {

constexpr double same_normal = 1e-3;       // normals closer than this are equal
constexpr double least_along = 0.05;       // share of a translation along a normal it frees
constexpr double against = 1e-9;           // along a normal: only round-off
constexpr double least_part = 1e-3;        // share of a translation: smaller components are 0
constexpr std::size_t most_normals = 400;  // directions tried alone
constexpr std::size_t most_paired = 24;    // and in pairs
constexpr int most_pulls = 400;

/// Merges ways with equal normals; the largest need counts.
std::vector<WayOut> distinct(const std::vector<WayOut>& ways) {
  std::map<std::array<long long, 3>, WayOut> out;
  for (const WayOut& way : ways) {
    const auto cell = [](double x) { return std::llround(x / same_normal); };
    const auto [it, is_new] =
        out.try_emplace({cell(way.normal.x), cell(way.normal.y), cell(way.normal.z)}, way);
    if (!is_new && way.needs > it->second.needs) it->second = way;
  }
  std::vector<WayOut> list;
  for (const auto& [key, way] : out) list.push_back(way);
  std::stable_sort(list.begin(), list.end(),
                   [](const WayOut& a, const WayOut& b) { return a.needs > b.needs; });
  return list;
}

/// Shortest translation that meets every way's need, as far as the sweeps come.
Vec shortest(const std::vector<WayOut>& ways) {
  std::vector<double> pulled(ways.size(), 0);
  Vec u{};
  for (int sweep = 0; sweep < most_pulls; ++sweep)
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const double step = std::max(ways[i].needs - dot(ways[i].normal, u), -pulled[i]);
      pulled[i] += step;
      u = u + step * ways[i].normal;
    }
  return u;
}

std::vector<Vec> directions_of(const std::vector<WayOut>& ways) {
  std::vector<WayOut> wanted;
  for (const WayOut& way : distinct(ways))
    if (way.wanted) wanted.push_back(way);
  std::vector<Vec> out = {unit(shortest(wanted))};
  Vec mean{};
  for (const WayOut& way : wanted) mean = mean + way.normal;
  out.push_back(unit(mean));
  for (const double sign : {1.0, -1.0})
    for (const Vec axis : {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}}) out.push_back(sign * axis);
  for (std::size_t i = 0; i < std::min(most_normals, wanted.size()); ++i)
    out.push_back(wanted[i].normal);
  for (std::size_t i = 0; i < std::min(most_paired, wanted.size()); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      out.push_back(unit(wanted[i].normal + wanted[k].normal));
      out.push_back(unit(shortest({wanted[i], wanted[k]})));
    }
  return out;
}

/// Three digits, away from zero; negligible numbers become 0.
double three_digits(double x, double length) {
  if (std::abs(x) <= least_part * length) return 0;
  const double digit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - 2);
  return std::copysign(std::ceil(std::abs(x) / digit - 1e-9) * digit, x);
}

Vec three_digits(const Vec& u) {
  const double l = norm(u);
  return {three_digits(u.x, l), three_digits(u.y, l), three_digits(u.z, l)};
}

/// Longest length within the bound that frees another way: it frees all of them.
double length_along(const Vec& direction, const std::vector<WayOut>& ways, double longest) {
  double length = 0;
  for (const WayOut& way : ways) {
    const double share = dot(way.normal, direction);
    if (share < -against) return 0;
    if (!way.wanted || share < least_along) continue;
    if (const double needed = way.needs / share; needed <= longest)
      length = std::max(length, needed);
  }
  return length;
}

}  // namespace

std::vector<Translation> translations_for(const std::vector<WayOut>& ways, double longest,
                                          std::size_t most) {
  std::vector<Translation> out;
  for (const Vec& direction : directions_of(ways)) {
    const double length = length_along(direction, ways, longest);
    if (length == 0) continue;
    Translation t{three_digits(length * direction), 0};
    if (norm(t.by) > longest) t.by = length * direction;  // the bound beats rounding
    bool fits = true;
    for (const WayOut& way : ways) {
      const double along = dot(way.normal, t.by);
      fits = fits && along >= -against * length;
      t.frees += way.wanted && along >= way.needs * (1 - 1e-12);
    }
    if (!fits || t.frees == 0) continue;
    const bool known = std::any_of(out.begin(), out.end(), [&](const Translation& other) {
      return norm(other.by - t.by) <= same_normal * length;
    });
    if (!known) out.push_back(t);
  }
  std::stable_sort(out.begin(), out.end(), [](const Translation& a, const Translation& b) {
    if (a.frees != b.frees) return a.frees > b.frees;
    return norm(a.by) < norm(b.by);
  });
  if (out.size() > most) out.resize(most);
  return out;
}

}  // namespace deck::detail
