// How the segments of a TYPE25 hang together: neighbours across sides, corners that belong
// together, and the direction of every side, in single precision as the solver has it.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "contact/modern/parts.hpp"

namespace deck::detail::modern {
namespace {

using Single = Point3<float>;

/// A side that leads from a node to another.
struct DirectedSide {
  NodeIndex to = no_index;
  std::uint32_t face = 0, side = 0;
};

class Joiner {
 public:
  Joiner(const Coordinates& x, const std::vector<Face>& faces, Topology& out)
      : x_(x), faces_(faces), out_(out) {
    out.neighbour.assign(faces.size(), {no_index, no_index, no_index, no_index});
    partner_side_.assign(faces.size(), {});
    first_.assign(x.x.size() + 1, 0);
    each_side([&](std::uint32_t i, std::uint32_t k) { ++first_[from(i, k) + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    sides_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each_side([&](std::uint32_t i, std::uint32_t k) {
      sides_[next[from(i, k)]++] = {to(i, k), i, k};
    });
  }

  void join() {
    each_side([&](std::uint32_t i, std::uint32_t k) {
      if (out_.neighbour[i][k] == no_index) join(i, k);
    });
  }
  /// Side of the neighbour that lies on side k of i.
  std::uint32_t partner_side(std::uint32_t i, std::uint32_t k) const { return partner_side_[i][k]; }

 private:
  /// Calls f(face, side) for all sides that have a length, in order.
  template <class F>
  void each_side(F&& f) const {
    for (std::uint32_t i = 0; i < faces_.size(); ++i)
      for (std::uint32_t k = 0; k < 4; ++k)
        if (!faces_[i].interior && from(i, k) != to(i, k)) f(i, k);
  }
  NodeIndex from(std::uint32_t i, std::uint32_t k) const { return faces_[i].nodes[k]; }
  NodeIndex to(std::uint32_t i, std::uint32_t k) const { return faces_[i].nodes[(k + 1) % 4]; }
  Vec normal(const Face& f) const {
    return unit_of(
        cross(at(x_, f.nodes[2]) - at(x_, f.nodes[0]), at(x_, f.nodes[3]) - at(x_, f.nodes[1])));
  }

  bool fits(const Face& i, const Face& j, NodeIndex a, NodeIndex b) const {
    const auto has = [](const Face& f, NodeIndex n) {
      return std::find(f.nodes.begin(), f.nodes.end(), n) != f.nodes.end();
    };
    if (i.coat_like() != j.coat_like()) return false;
    if (std::all_of(j.nodes.begin(), j.nodes.end(), [&](NodeIndex n) { return has(i, n); }))
      return false;
    const auto third_is_shared = [&](const Face& triangle, const Face& other) {
      for (const NodeIndex n : triangle.nodes)
        if (n != a && n != b && has(other, n)) return true;
      return false;
    };
    return !(i.triangle() && third_is_shared(i, j)) && !(j.triangle() && third_is_shared(j, i));
  }

  void join(std::uint32_t i, std::uint32_t k) {
    const NodeIndex a = from(i, k), b = to(i, k);
    const Vec d = at(x_, b) - at(x_, a);
    Vec ni, yi;
    const DirectedSide* best = nullptr;
    double best_c = 0;
    bool best_front = false;
    const std::span<const DirectedSide> there(sides_.data() + first_[b],
                                              sides_.data() + first_[b + 1]);
    for (auto s = there.begin(); s != there.end(); ++s) {
      if (s->to != a || s->face == i || out_.neighbour[s->face][s->side] != no_index) continue;
      if (!fits(faces_[i], faces_[s->face], a, b)) continue;
      if (best == nullptr) {
        ni = normal(faces_[i]);
        yi = unit_of(cross(ni, d));
      }
      const Vec yj = -1.0 * unit_of(cross(normal(faces_[s->face]), d));
      const double c = dot(yi, yj);
      const bool front = dot(ni, yj) >= 0;
      const bool better = best == nullptr || (front && !best_front) ||
                          (front == best_front && (front ? c > best_c : c < best_c));
      if (!better) continue;
      best = &*s;
      best_c = c;
      best_front = front;
    }
    if (best == nullptr) return;
    out_.neighbour[i][k] = best->face;
    partner_side_[i][k] = best->side;
    out_.neighbour[best->face][best->side] = i;
    partner_side_[best->face][best->side] = k;
  }

  const Coordinates& x_;
  const std::vector<Face>& faces_;
  Topology& out_;
  std::vector<std::uint32_t> first_;  ///< by node: where its sides are
  std::vector<DirectedSide> sides_;  ///< by the node they lead from, then faces and sides ascending
  std::vector<std::array<std::uint32_t, 4>> partner_side_;
};

/// Classes of corners.
class CornerClasses {
 public:
  explicit CornerClasses(std::size_t faces) : parent_(4 * faces) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::uint32_t find(std::uint32_t c) {
    while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
    return c;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

void set_vertices(const std::vector<Face>& faces, const Joiner& joiner, Topology& t) {
  CornerClasses corners(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    if (faces[i].triangle()) corners.unite(4 * i + 2, 4 * i + 3);
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t j = t.neighbour[i][k];
      if (j == no_index) continue;
      const std::uint32_t l = joiner.partner_side(i, k);
      corners.unite(4 * i + k, 4 * j + (l + 1) % 4);
      corners.unite(4 * i + (k + 1) % 4, 4 * j + l);
    }
  }
  std::vector<std::uint32_t> number(4 * faces.size(), no_index);
  t.vertex.resize(faces.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (std::uint32_t k = 0; k < 4; ++k) {
      std::uint32_t& n = number[corners.find(4 * i + k)];
      if (n == no_index) n = count++;
      t.vertex[i][k] = n;
    }
  t.vertices.resize(count);
}

Single rounded(const Vec& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Single unit(const Single& v) {
  const float l = std::sqrt(dot(v, v));
  return l > 0.0F ? (1.0F / l) * v : Single{};
}
Vec to_double(const Single& v) { return {v.x, v.y, v.z}; }

/// Normal of each facet; a mirrored segment has the negatives of its opposite's.
std::array<Single, 4> facet_normals(const Coordinates& x, const Face& f) {
  Single p[4];
  for (std::size_t k = 0; k < 4; ++k) p[k] = rounded(at(x, f.nodes[k]));
  std::array<Single, 4> out;
  if (f.triangle()) {
    out.fill(unit(cross(p[0] - p[2], p[1] - p[2])));
    return out;
  }
  const Single o = 0.25F * (p[0] + p[1] + p[2] + p[3]);
  for (std::size_t k = 0; k < 4; ++k) out[k] = unit(cross(p[k] - o, p[(k + 1) % 4] - o));
  return out;
}

std::vector<std::array<Single, 4>> all_normals(const Coordinates& x,
                                               const std::vector<Face>& faces) {
  std::vector<std::array<Single, 4>> out(faces.size());
  // Side 1 of a segment is side 1 of its opposite, 2 is 4, 3 is 3.
  constexpr std::size_t same[] = {0, 3, 2, 1};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (!faces[i].opposite_side()) {
      out[i] = facet_normals(x, faces[i]);
      continue;
    }
    const auto& front = out[faces[i].opposite];
    for (std::size_t k = 0; k < 4; ++k) out[i][k] = -front[same[k]];
  }
  return out;
}

}  // namespace

Topology make_topology(const Coordinates& x, const std::vector<Face>& faces) {
  Topology t;
  Joiner joiner(x, faces, t);
  joiner.join();
  set_vertices(faces, joiner, t);
  const auto normals = all_normals(x, faces);
  t.direction.resize(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const NodeIndex a = faces[i].nodes[k], b = faces[i].nodes[(k + 1) % 4];
      if (a == b || faces[i].interior) continue;
      if (!t.is_free(i, k)) {
        const Single other = normals[t.neighbour[i][k]][joiner.partner_side(i, k)];
        t.direction[i][k] = to_double(unit(normals[i][k] + other));
        continue;
      }
      const Vec along = at(x, b) - at(x, a);
      const Vec outward = to_double(unit(cross(rounded(along), normals[i][k])));
      t.direction[i][k] = outward;
      for (const std::uint32_t corner : {k, (k + 1) % 4}) {
        Topology::Vertex& v = t.vertices[t.vertex[i][corner]];
        (v.border ? v.second : v.first) = outward;
        v.border = true;
      }
    }
  return t;
}

}  // namespace deck::detail::modern
