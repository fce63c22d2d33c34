// Connections of a TYPE25's segments: neighbours across sides, shared corners, and the direction of
// every side in single precision, as in the solver.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

using Single = Point3<float>;

Single rounded(const Vec& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Single unit(const Single& v) {
  const float l = std::sqrt(dot(v, v));
  return l > 0.0F ? (1.0F / l) * v : Single{};
}
Vec to_double(const Single& v) { return {v.x, v.y, v.z}; }

/// Normal of a facet; a mirrored segment has the negative of its opposite's.
Single facet_normal(const Coordinates& x, const Sides& s, std::uint32_t face, std::uint32_t side) {
  if (s.is_mirror(face)) return -facet_normal(x, s, s.base(face), mirrored_side(side));
  const Quad& nodes = s.faces[face].nodes;
  Single p[4];
  for (std::size_t k = 0; k < 4; ++k) p[k] = rounded(at(x, nodes[k]));
  if (nodes[2] == nodes[3]) return unit(cross(p[0] - p[2], p[1] - p[2]));
  const Single o = 0.25F * (p[0] + p[1] + p[2] + p[3]);
  return unit(cross(p[side] - o, p[(side + 1) % 4] - o));
}

Vec segment_normal(const Coordinates& x, const Quad& n) {
  return unit_of(cross(at(x, n[2]) - at(x, n[0]), at(x, n[3]) - at(x, n[1])));
}

bool has(const Quad& nodes, NodeIndex n) {
  return std::find(nodes.begin(), nodes.end(), n) != nodes.end();
}

/// True if segments can be neighbours across the side between a and b.
bool fits(const Quad& i, const Quad& j, bool coat_i, bool coat_j, NodeIndex a, NodeIndex b) {
  if (coat_i != coat_j) return false;
  if (std::all_of(j.begin(), j.end(), [&](NodeIndex n) { return has(i, n); })) return false;
  const auto third_is_shared = [&](const Quad& triangle, const Quad& other) {
    return triangle[2] == triangle[3] &&
           std::any_of(triangle.begin(), triangle.end(),
                       [&](NodeIndex n) { return n != a && n != b && has(other, n); });
  };
  return !third_is_shared(i, j) && !third_is_shared(j, i);
}

}  // namespace

Topology::Topology(const Coordinates& x, const Sides& sides)
    : x_(x), s_(sides), closed_(x.x.size()) {
  first_.assign(x.x.size() + 1, 0);
  const auto for_each_side = [&](std::uint32_t i, const auto& use) {
    const Face& f = s_.faces[i];
    if (f.interior) return;
    for (std::uint32_t k = 0; k < 4; ++k)
      if (const NodeIndex a = f.nodes[k]; a != f.nodes[(k + 1) % 4]) use(a, k);
  };
  for (std::uint32_t i = 0; i < s_.faces.size(); ++i)
    for_each_side(i, [&](NodeIndex a, std::uint32_t) { ++first_[a]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  sides_.resize(first_.back());
  // From the end of each row to its start, where the row before ends.
  for (auto i = static_cast<std::uint32_t>(s_.faces.size()); i-- > 0;)
    for_each_side(i, [&](NodeIndex a, std::uint32_t k) { sides_[--first_[a]] = 4 * i + k; });
}

/// True if two segments, alone at a pair of nodes and with opposite direction there, are neighbours
/// on both sides.
bool Topology::simple(std::uint32_t i, std::uint32_t j, NodeIndex a, NodeIndex b) const {
  const Face &f = s_.faces[i], &g = s_.faces[j];
  return i != j && (f.opposite == no_index) == (g.opposite == no_index) &&
         fits(f.nodes, g.nodes, f.coat_like(), g.coat_like(), a, b);
}

Topology::Across Topology::across(std::uint32_t face, std::uint32_t side) const {
  const Quad nodes = s_.nodes_of(face);
  const NodeIndex a = nodes[side], b = nodes[(side + 1) % 4];
  const std::uint32_t base = s_.base(face);
  if (a == b || s_.faces[base].interior) return {};
  DirectedSide along, against;
  bool several = false;
  const auto find_side = [&](NodeIndex from, NodeIndex to, DirectedSide& out) {
    for_each_leaving(from, [&](const DirectedSide& d) {
      if (d.to != to) return;
      several = several || out.face != no_index;
      out = d;
    });
  };
  find_side(a, b, along);
  find_side(b, a, against);
  if (several) return among_many(face, side, a, b);
  if (along.face == no_index || against.face == no_index) return {};
  if (!simple(along.face, against.face, a, b)) return among_many(face, side, a, b);
  const DirectedSide& other = along.face == base ? against : along;
  if (!s_.is_mirror(face)) return {other.face, other.side};
  return {s_.faces[other.face].opposite, mirrored_side(other.side)};
}

/// Joins segments between a and b: each to the first one found by turning from its front.
Topology::Across Topology::among_many(std::uint32_t face, std::uint32_t side, NodeIndex a,
                                      NodeIndex b) const {
  struct Entry {
    std::uint32_t face = 0, side = 0;
    bool forward = false;  // from a to b
    std::uint32_t joined = no_index;
  };
  std::vector<Entry> all;
  for (const bool forward : {true, false})
    for_each_leaving(forward ? a : b, [&](const DirectedSide& d) {
      if (d.to != (forward ? b : a)) return;
      all.push_back({d.face, d.side, forward});
      if (const std::uint32_t o = s_.faces[d.face].opposite; o != no_index)
        all.push_back({o, mirrored_side(d.side), !forward});
    });
  std::sort(all.begin(), all.end(), [](const Entry& u, const Entry& v) {
    return std::tie(u.face, u.side) < std::tie(v.face, v.side);
  });
  for (std::uint32_t e = 0; e < all.size(); ++e) {
    if (all[e].joined != no_index) continue;
    const Face f = s_.face(all[e].face);
    const Vec d = all[e].forward ? at(x_, b) - at(x_, a) : at(x_, a) - at(x_, b);
    const Vec ni = segment_normal(x_, f.nodes), yi = unit_of(cross(ni, d));
    std::uint32_t best = no_index;
    double best_c = 0;
    bool best_front = false;
    for (std::uint32_t o = 0; o < all.size(); ++o) {
      if (all[o].forward == all[e].forward || all[o].face == all[e].face) continue;
      if (all[o].joined != no_index) continue;
      const Face g = s_.face(all[o].face);
      if (!fits(f.nodes, g.nodes, f.coat_like(), g.coat_like(), a, b)) continue;
      const Vec yj = -1.0 * unit_of(cross(segment_normal(x_, g.nodes), d));
      const double c = dot(yi, yj);
      const bool front = dot(ni, yj) >= 0;
      const bool better = best == no_index || (front && !best_front) ||
                          (front == best_front && (front ? c > best_c : c < best_c));
      if (!better) continue;
      best = o;
      best_c = c;
      best_front = front;
    }
    if (best == no_index) continue;
    all[e].joined = best;
    all[best].joined = e;
  }
  for (const Entry& e : all)
    if (e.face == face && e.side == side && e.joined != no_index)
      return {all[e.joined].face, all[e.joined].side};
  return {};
}

Vec Topology::direction(std::uint32_t face, std::uint32_t side, const Across& other) const {
  const Quad nodes = s_.nodes_of(face);
  const NodeIndex a = nodes[side], b = nodes[(side + 1) % 4];
  if (a == b || s_.faces[s_.base(face)].interior) return {};
  const Single own = facet_normal(x_, s_, face, side);
  if (!other.free()) return to_double(unit(own + facet_normal(x_, s_, other.face, other.side)));
  return to_double(unit(cross(rounded(at(x_, b) - at(x_, a)), own)));
}

/// True if all sides at a node have simple neighbours.
bool Topology::closed_around(NodeIndex n) const {
  std::atomic<Closed>& known = closed_[n];
  Closed closed = known.load(std::memory_order_relaxed);
  if (closed == Closed::unknown) {  // several threads find equal values
    closed = find_closed(n) ? Closed::yes : Closed::no;
    known.store(closed, std::memory_order_relaxed);
  }
  return closed == Closed::yes;
}

bool Topology::find_closed(NodeIndex n) const {
  constexpr std::size_t most = 16;
  if (first_[n + 1] - first_[n] > most) return false;
  std::array<DirectedSide, most> room;
  std::size_t filled = 0;
  for_each_leaving(n, [&](const DirectedSide& d) { room[filled++] = d; });
  const std::span<const DirectedSide> sides(room.data(), filled);
  std::array<NodeIndex, most> from{};  // starts of the sides that end here
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Quad& nodes = s_.faces[sides[i].face].nodes;
    std::uint32_t k = (sides[i].side + 3) % 4;
    if (nodes[k] == n) k = (k + 3) % 4;
    from[i] = nodes[k];
    if (nodes[(k + 1) % 4] != n || std::count(nodes.begin(), nodes.end(), n) !=
                                       (nodes[2] == nodes[3] && nodes[2] == n ? 2 : 1))
      return false;
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    std::size_t partner = most, count = 0;
    for (std::size_t j = 0; j < sides.size(); ++j) {
      if (j != i && sides[j].to == sides[i].to) return false;
      if (from[j] != sides[i].to) continue;
      partner = j;
      ++count;
    }
    if (count != 1 || !simple(sides[i].face, sides[partner].face, n, sides[i].to)) return false;
  }
  return true;
}

template <class Visit>
Topology::FreeEnd Topology::walk(std::uint32_t face, std::uint32_t corner, bool onward,
                                 const Visit& visit) const {
  std::uint32_t i = face, c = corner;
  for (;;) {
    const Quad nodes = s_.nodes_of(i);
    const bool triangle = nodes[2] == nodes[3];
    if (triangle && c >= 2) c = onward ? 3 : 2;  // one corner
    visit(i, c);
    const std::uint32_t side = onward ? c : (c + 3) % 4;
    if (nodes[side] == nodes[(side + 1) % 4] || s_.faces[s_.base(i)].interior) return {};
    const Across next = across(i, side);
    if (next.free()) return {i, side};
    i = next.face;
    c = onward ? (next.side + 1) % 4 : next.side;
    const bool same =
        i == face &&
        (c == corner || (c >= 2 && corner >= 2 && s_.nodes_of(i)[2] == s_.nodes_of(i)[3]));
    if (same) return {};
  }
}

Topology::FreeEnd Topology::walk(std::uint32_t face, std::uint32_t corner, bool onward) const {
  return walk(face, corner, onward, [](std::uint32_t, std::uint32_t) {});
}

Topology::Vertex Topology::vertex(std::uint32_t face, std::uint32_t corner) const {
  Vertex out;
  if (closed_around(s_.nodes_of(face)[corner])) return out;
  FreeEnd one = walk(face, corner, true), two = walk(face, corner, false);
  if (one.face == no_index ||
      (two.face != no_index && std::tie(two.face, two.side) < std::tie(one.face, one.side)))
    std::swap(one, two);
  if (one.face == no_index) return out;
  out.border = true;
  out.first = direction(one.face, one.side);
  if (two.face != no_index) out.second = direction(two.face, two.side);
  return out;
}

Vec Topology::normal(std::uint32_t face, std::uint32_t corner) const {
  Single sum;
  const auto add = [&](std::uint32_t i, std::uint32_t c) {
    sum = sum + facet_normal(x_, s_, i, c) + facet_normal(x_, s_, i, (c + 3) % 4);
  };
  if (walk(face, corner, true, add).face != no_index) {
    bool first = true;  // of the way back
    walk(face, corner, false, [&](std::uint32_t i, std::uint32_t c) {
      if (!std::exchange(first, false)) add(i, c);
    });
  }
  return to_double(unit(sum));
}

bool Topology::on_border(std::uint32_t face, std::uint32_t corner) const {
  return !closed_around(s_.nodes_of(face)[corner]) &&
         (walk(face, corner, true).face != no_index || walk(face, corner, false).face != no_index);
}

}  // namespace deck::detail::type24_25
