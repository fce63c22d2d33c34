// Neighbours of nodes, crossings and inverted elements around moved ones.
#include "edit/fix/nodes/depenetrate_mesh.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>

#include "contact/shared/node_elements.hpp"
#include "contact/shared/scene_parts.hpp"
#include "deck/contact/crossings.hpp"
#include "model/shared/faces.hpp"

namespace deck::detail {
namespace {

/// Rows node -> items, for items with any number of nodes.
template <class Items>
IndexRows rows_by_node(const Items& items, std::size_t nodes) {
  IndexRows rows;
  rows.first.assign(nodes + 1, 0);
  const auto each = [&](const auto& f) {
    for (std::uint32_t i = 0; i < items.size(); ++i)
      for (std::size_t k = 0; k < items[i].size(); ++k) {
        bool repeated = false;
        for (std::size_t j = 0; j < k; ++j) repeated |= items[i][j] == items[i][k];
        if (!repeated) f(items[i][k], i);
      }
  };
  each([&](NodeIndex n, std::uint32_t) { ++rows.first[n + 1]; });
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  rows.entries.resize(rows.first.back());
  std::vector<std::uint32_t> at(rows.first.begin(), rows.first.end() - 1);
  each([&](NodeIndex n, std::uint32_t i) { rows.entries[at[n]++] = i; });
  return rows;
}

/// The items around some nodes, each once, ascending. `count`: of all items.
std::vector<std::uint32_t> items_around(const IndexRows& rows, std::span<const NodeIndex> nodes,
                                        std::size_t count) {
  std::vector<bool> around(count);
  for (const NodeIndex n : nodes)
    for (const std::uint32_t i : rows.row(n)) around[i] = true;
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < count; ++i)
    if (around[i]) out.push_back(static_cast<std::uint32_t>(i));
  return out;
}

/// Slots of a node-defined shape that are part of it: a beam's third node only orients it.
int shape_slots(const Elements& family) {
  return family.kind == ElementKind::beam ? 2 : family.width;
}

}  // namespace

FixMesh::FixMesh(const Scene& scene) : model_(*scene.model) {
  const std::size_t n = model_.nodes.size();
  collect_edges();
  collect_faces(scene);
  edges_of_ = rows_by_node(edges_, n);
  faces_of_ = rows_by_node(faces_, n);
  neighbours_.first.assign(1, 0);
  for (NodeIndex a = 0; a < n; ++a) {
    for (const std::uint32_t e : edges_of_.row(a))
      neighbours_.entries.push_back(edges_[e][0] == a ? edges_[e][1] : edges_[e][0]);
    neighbours_.first.push_back(static_cast<std::uint32_t>(neighbours_.entries.size()));
  }
  shells4_ = connect_nodes(model_.shell4, n);
  shells3_ = connect_nodes(model_.shell3, n);
  solids_ = connect_nodes(model_.solid8, n);
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
  // A face from several sources once, whatever node it starts with.
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
    for (const Segment& s : SolidFaces(model_.solid8).segments(query)) add(s.nodes);
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

// ---- crossings --------------------------------------------------------------------------------

std::vector<FixMesh::Crossed> FixMesh::crossings(const Coordinates& x,
                                                 std::span<const NodeIndex> nodes,
                                                 int threads) const {
  std::vector<Crossed> out;
  // Moved edges against all faces, then all edges against the moved faces.
  std::vector<std::array<NodeIndex, 2>> edges;
  const std::vector<std::uint32_t> moved_edges = items_around(edges_of_, nodes, edges_.size());
  for (const std::uint32_t e : moved_edges) edges.push_back(edges_[e]);
  for (const CandidatePair& p : find_crossing_pairs({x.x, x.y, x.z}, edges, faces_, threads))
    out.emplace_back(moved_edges[p.secondary], p.main);
  std::vector<std::array<NodeIndex, 4>> faces;
  const std::vector<std::uint32_t> moved_faces = items_around(faces_of_, nodes, faces_.size());
  for (const std::uint32_t f : moved_faces) faces.push_back(faces_[f]);
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
  if (shape == SolidShape::tetra4 || shape == SolidShape::tetra10) {
    const double was = tetra_volume(before, n), is = tetra_volume(now, n);
    return (was > 0 && !(is > 0)) || (was < 0 && !(is < 0));
  }
  for (int k = 0; k < 8; ++k) {
    const double was = corner_volume(before, n, k), is = corner_volume(now, n, k);
    if ((was > 0 && !(is > 0)) || (was < 0 && !(is < 0))) return true;
  }
  return false;
}

}  // namespace

std::vector<NodeIndex> FixMesh::inverted(const Coordinates& before, const Coordinates& now,
                                         std::span<const NodeIndex> nodes) const {
  std::vector<NodeIndex> out;
  const auto look = [&](const IndexRows& rows, const Elements& family, const auto& turned) {
    if (family.size() == 0) return;
    for (const std::uint32_t e : items_around(rows, nodes, family.size())) {
      const NodeIndex* n = family.of(e);
      if (complete(n, family.width) && turned(n, e)) out.insert(out.end(), n, n + family.width);
    }
  };
  look(shells4_, model_.shell4,
       [&](const NodeIndex* n, std::uint32_t) { return turned_shell(before, now, n, 4); });
  look(shells3_, model_.shell3,
       [&](const NodeIndex* n, std::uint32_t) { return turned_shell(before, now, n, 3); });
  look(solids_, model_.solid8, [&](const NodeIndex* n, std::uint32_t e) {
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
