// Neighbours of nodes; crossings and inverted elements around moved nodes.
#include "edit/fix/nodes/ways_out.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>

#include "contact/shared/node_elements.hpp"
#include "contact/shared/scene_steps.hpp"
#include "deck/contacts.hpp"
#include "model/shared/faces.hpp"

namespace deck::detail {
namespace {

/// Items with a marked node, ascending.
template <class NodesOf>
std::vector<std::uint32_t> items_around(std::size_t count, const std::vector<bool>& marked,
                                        const NodesOf& nodes_of) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::span<const NodeIndex> nodes = nodes_of(i);
    if (std::any_of(nodes.begin(), nodes.end(),
                    [&](NodeIndex n) { return n != no_index && marked[n]; }))
      out.push_back(i);
  }
  return out;
}

/// Slots of the shape: the third node of a beam only orients it.
int shape_slots(const Elements& family) {
  return family.kind == ElementKind::beam ? 2 : family.width;
}

}  // namespace

FixMesh::FixMesh(const Scene& scene) : model_(*scene.model) {
  const std::size_t n = model_.nodes.size();
  collect_edges();
  collect_faces(scene);
  neighbours_.first.assign(n + 1, 0);
  for (const auto& edge : edges_)
    for (const NodeIndex end : edge) ++neighbours_.first[end + 1];
  std::partial_sum(neighbours_.first.begin(), neighbours_.first.end(), neighbours_.first.begin());
  neighbours_.entries.resize(2 * edges_.size());
  std::vector<std::uint32_t> next(neighbours_.first.begin(), neighbours_.first.end() - 1);
  for (const auto& [a, b] : edges_) {
    neighbours_.entries[next[a]++] = b;
    neighbours_.entries[next[b]++] = a;
  }
  part_.assign(n, no_index);
  part_nodes_.assign(model_.parts.size(), 0);
  for (const ElementKind kind : families_with_edges) {
    const Elements& family = model_.family(kind);
    for (std::size_t e = 0; e < family.size(); ++e)
      for (int k = 0; k < shape_slots(family); ++k) {
        const NodeIndex node = family.of(e)[k];
        if (node == no_index || part_[node] != no_index || family.part[e] == no_index) continue;
        part_[node] = family.part[e];
        ++part_nodes_[family.part[e]];
      }
  }
}

void FixMesh::collect_edges() {
  const auto add = [&](NodeIndex a, NodeIndex b) {
    if (a != b && a != no_index && b != no_index)
      edges_.push_back({std::min(a, b), std::max(a, b)});
  };
  for (const ElementKind kind : families_with_edges) {
    const Elements& family = model_.family(kind);
    for (std::uint32_t e = 0; e < family.size(); ++e)
      for (const auto& [a, b] : local_edges(family, e)) add(family.of(e)[a], family.of(e)[b]);
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

void FixMesh::collect_faces(const Scene& scene) {
  // A face from several sources counts once, whatever its first node.
  std::map<std::array<NodeIndex, 4>, std::array<NodeIndex, 4>> faces;
  const auto add = [&](const std::array<NodeIndex, 4>& face) {
    std::array<NodeIndex, 4> key = face;
    std::sort(key.begin(), key.end());
    if (key.back() != no_index) faces.emplace(key, face);
  };
  for (std::size_t e = 0; e < model_.shell4.size(); ++e) {
    const NodeIndex* n = model_.shell4.of(e);
    add({n[0], n[1], n[2], n[3]});
  }
  for (std::size_t e = 0; e < model_.shell3.size(); ++e) {
    const NodeIndex* n = model_.shell3.of(e);
    add({n[0], n[1], n[2], n[2]});
  }
  if (model_.solid8.size() > 0) {
    std::vector<std::uint32_t> all(model_.solid8.size());
    std::iota(all.begin(), all.end(), 0U);
    FaceQuery query;
    query.solids = &all;
    std::vector<Segment> exterior;
    SolidFaces(model_.solid8).add_segments(query, exterior);
    for (const Segment& s : exterior) add(s.nodes);
  }
  for (const Contact& c : scene.contacts)
    for (const MainSegment& m : c.main) add(m.nodes);
  for (const auto& [key, face] : faces) faces_.push_back(face);
}

bool FixMesh::connected_within(const Coordinates& x, NodeIndex from, std::span<const NodeIndex> to,
                               double limit) const {
  using Entry = std::pair<double, NodeIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<NodeIndex> closed;
  open.push({0, from});
  while (!open.empty()) {
    const auto [length, n] = open.top();
    open.pop();
    if (std::find(closed.begin(), closed.end(), n) != closed.end()) continue;
    closed.push_back(n);
    if (std::find(to.begin(), to.end(), n) != to.end()) return true;
    for (const NodeIndex next : neighbours(n)) {
      const double l = length + distance(x, n, next);
      if (l <= limit) open.push({l, next});
    }
  }
  return false;
}

std::vector<bool> FixMesh::marks_of(std::span<const NodeIndex> nodes) const {
  std::vector<bool> out(model_.nodes.size());
  for (const NodeIndex n : nodes) out[n] = true;
  return out;
}

// ---- crossings --------------------------------------------------------------------------------

std::vector<FixMesh::Crossed> FixMesh::crossings(const Coordinates& x,
                                                 std::span<const NodeIndex> nodes,
                                                 int threads) const {
  const std::vector<bool> marked = marks_of(nodes);
  // Moved edges against all faces, then all edges against the moved faces.
  const auto moved_edges =
      items_around(edges_.size(), marked, [&](std::uint32_t e) { return std::span(edges_[e]); });
  const auto moved_faces =
      items_around(faces_.size(), marked, [&](std::uint32_t f) { return std::span(faces_[f]); });
  std::vector<std::array<NodeIndex, 2>> edges;
  for (const std::uint32_t e : moved_edges) edges.push_back(edges_[e]);
  std::vector<std::array<NodeIndex, 4>> faces;
  for (const std::uint32_t f : moved_faces) faces.push_back(faces_[f]);
  std::vector<Crossed> out;
  for (const CandidatePair& p : find_crossing_pairs({x.x, x.y, x.z}, edges, faces_, threads))
    out.emplace_back(moved_edges[p.secondary], p.main);
  for (const CandidatePair& p : find_crossing_pairs({x.x, x.y, x.z}, edges_, faces, threads))
    out.emplace_back(p.secondary, moved_faces[p.main]);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<FixMesh::Crossed> FixMesh::all_crossings(const Coordinates& x, int threads) const {
  std::vector<Crossed> out;
  for (const CandidatePair& p : find_crossing_pairs({x.x, x.y, x.z}, edges_, faces_, threads))
    out.emplace_back(p.secondary, p.main);
  return out;
}

std::vector<NodeIndex> FixMesh::nodes_of(const Crossed& crossing) const {
  std::vector<NodeIndex> out(edges_[crossing.first].begin(), edges_[crossing.first].end());
  out.insert(out.end(), faces_[crossing.second].begin(), faces_[crossing.second].end());
  return out;
}

// ---- turned elements --------------------------------------------------------------------------

namespace {

Vec corner_normal(const Coordinates& x, const NodeIndex* n, int width, int k) {
  const Vec p = at(x, n[k]);
  return cross(at(x, n[(k + 1) % width]) - p, at(x, n[(k + width - 1) % width]) - p);
}

/// Three neighbours of each corner of a brick, right-handed.
constexpr int brick_corners[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                     {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};

double corner_volume(const Coordinates& x, const NodeIndex* n, int k) {
  const Vec p = at(x, n[k]);
  const auto& c = brick_corners[k];
  return dot(at(x, n[c[0]]) - p, cross(at(x, n[c[1]]) - p, at(x, n[c[2]]) - p));
}

bool complete(const NodeIndex* n, int width) {
  return std::find(n, n + width, no_index) == n + width;
}

bool turned_shell(const Coordinates& before, const Coordinates& now, const NodeIndex* n,
                  int width) {
  for (int k = 0; k < width; ++k) {
    const Vec was = corner_normal(before, n, width, k);
    if (dot(was, was) > 0 && !(dot(was, corner_normal(now, n, width, k)) > 0)) return true;
  }
  return false;
}

double tetra_volume(const Coordinates& x, const NodeIndex* n) {
  const Vec p = at(x, n[0]);  // slots n1 n1 n2 n2 n4 n3 n3 n4
  return dot(at(x, n[2]) - p, cross(at(x, n[5]) - p, at(x, n[4]) - p));
}

bool turned_solid(const Coordinates& before, const Coordinates& now, const NodeIndex* n,
                  SolidShape shape) {
  const auto turned = [](double was, double is) {
    return (was > 0 && !(is > 0)) || (was < 0 && !(is < 0));
  };
  if (shape == SolidShape::tetra4 || shape == SolidShape::tetra10)
    return turned(tetra_volume(before, n), tetra_volume(now, n));
  for (int k = 0; k < 8; ++k)
    if (turned(corner_volume(before, n, k), corner_volume(now, n, k))) return true;
  return false;
}

}  // namespace

std::vector<NodeIndex> FixMesh::inverted(const Coordinates& before, const Coordinates& now,
                                         std::span<const NodeIndex> nodes) const {
  std::vector<NodeIndex> out;
  const std::vector<bool> marked = marks_of(nodes);
  const auto look = [&](const Elements& family, const auto& turned) {
    const auto nodes_of = [&](std::uint32_t e) {
      return std::span(family.of(e), static_cast<std::size_t>(family.width));
    };
    for (const std::uint32_t e : items_around(family.size(), marked, nodes_of)) {
      const NodeIndex* n = family.of(e);
      if (complete(n, family.width) && turned(n, e)) out.insert(out.end(), n, n + family.width);
    }
  };
  for (const Elements* shells : {&model_.shell4, &model_.shell3})
    look(*shells, [&](const NodeIndex* n, std::uint32_t) {
      return turned_shell(before, now, n, shells->width);
    });
  look(model_.solid8, [&](const NodeIndex* n, std::uint32_t e) {
    return turned_solid(before, now, n, model_.solid8.shape[e]);
  });
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<NodeIndex> FixMesh::shortened(const Coordinates& before, const Coordinates& now,
                                          std::span<const NodeIndex> nodes, double least) const {
  std::vector<NodeIndex> out;
  for (const NodeIndex n : nodes)
    for (const NodeIndex next : neighbours(n))
      if (distance(now, n, next) < least * distance(before, n, next))
        out.insert(out.end(), {n, next});
  return out;
}

}  // namespace deck::detail
