// Crossed elements: edges of the secondary side that pass through main segments, counted once.
#include "deck/contact/crossings.hpp"
#include "contact/scene/node_elements.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>

#include "base/parallel.hpp"
#include "contact/crossings/crossings_exact.hpp"
#include "contact/search/box_tree.hpp"
#include "contact/search/sweep.hpp"

namespace deck {
namespace {

constexpr std::size_t width = BoxBlock::kWidth;

Box segment_box(const NodeArrays& nodes, const std::array<std::uint32_t, 4>& segment) {
  Box box = sweep::edge_box(nodes, {segment[0], segment[1]}, 0);
  box.add(sweep::edge_box(nodes, {segment[2], segment[3]}, 0));
  return box;
}

/// Bit i: child i of the block overlaps the box. Without branches, so that one instruction tests
/// several children.
unsigned overlaps(const BoxBlock& block, const Box& box) {
  std::array<std::uint64_t, width> meets;
  meets.fill(1);
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = box.low[k], high = box.high[k];
    for (std::size_t i = 0; i < width; ++i)
      meets[i] &= static_cast<std::uint64_t>(block.low[k][i] <= high) &
                  static_cast<std::uint64_t>(low <= block.high[k][i]);
  }
  unsigned bits = 0;
  for (std::size_t i = 0; i < width; ++i) bits |= static_cast<unsigned>(meets[i]) << i;
  return bits;
}

/// Calls visit(leaf) for every leaf whose box overlaps `box`.
template <class Visit>
void walk(const BoxTree& tree, std::size_t level, std::size_t block, const Box& box,
          const Visit& visit) {
  for (unsigned bits = overlaps(tree.level(level)[block], box); bits != 0; bits &= bits - 1) {
    const std::size_t child = block * width + static_cast<std::size_t>(std::countr_zero(bits));
    if (level == 0)
      visit(child);
    else
      walk(tree, level - 1, child, box, visit);
  }
}

bool passes_through(const NodeArrays& nodes, const std::array<std::uint32_t, 2>& edge,
                    const std::array<std::uint32_t, 4>& s) {
  for (const std::uint32_t n : s)
    if (n == edge[0] || n == edge[1]) return false;
  const auto at = [&](std::uint32_t n) { return sweep::point(nodes, n); };
  // Exact numbers are made of finite ones only; without a place nothing passes through anything.
  const auto lost = [&](std::uint32_t n) {
    return !std::isfinite(nodes.x[n]) || !std::isfinite(nodes.y[n]) || !std::isfinite(nodes.z[n]);
  };
  if (std::any_of(edge.begin(), edge.end(), lost) || std::any_of(s.begin(), s.end(), lost))
    return false;
  const Point3<double> p = at(edge[0]), q = at(edge[1]), a = at(s[0]), c = at(s[2]);
  if (detail::passes_through(p, q, a, at(s[1]), c)) return true;
  return s[2] != s[3] && detail::passes_through(p, q, a, c, at(s[3]));
}

}  // namespace

std::vector<CandidatePair> find_crossing_pairs(
    const NodeArrays& nodes, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const std::array<std::uint32_t, 4>> segments, int threads) {
  if (edges.empty() || segments.empty()) return {};
  threads = effective_threads(threads);
  const auto box_of = [&](std::uint32_t i) { return sweep::edge_box(nodes, edges[i], 0); };
  std::vector<std::uint32_t> order(edges.size());
  std::iota(order.begin(), order.end(), 0U);
  sweep::sort_in_space(order, box_of, threads);
  std::vector<BoxBlock> blocks((order.size() + width - 1) / width);
  for (std::size_t i = 0; i < order.size(); ++i) blocks[i / width].set(i % width, box_of(order[i]));
  const BoxTree tree(std::move(blocks), threads);

  std::vector<std::vector<CandidatePair>> found(static_cast<std::size_t>(threads));
  parallel_parts(
      threads, segments.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m)
          walk(tree, tree.levels() - 1, 0, segment_box(nodes, segments[m]), [&](std::size_t leaf) {
            const std::uint32_t e = order[leaf];
            if (passes_through(nodes, edges[e], segments[m]))
              found[part].push_back({e, static_cast<std::uint32_t>(m)});
          });
      });
  std::vector<CandidatePair> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  return all;
}

namespace {

/// An edge with the element that has it.
struct ElementEdge {
  std::array<NodeIndex, 2> nodes{};
  ElementKind kind{};
  std::uint32_t element = no_index;
};

using LocalEdge = std::array<int, 2>;
constexpr LocalEdge bar_edges[] = {{0, 1}};
constexpr LocalEdge triangle_edges[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr LocalEdge quad_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr LocalEdge brick_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                     {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr LocalEdge penta_edges[] = {{0, 1}, {1, 2}, {2, 0}, {4, 5}, {5, 6},
                                     {6, 4}, {0, 4}, {1, 5}, {2, 6}};
// The slots of a tetrahedron are n1 n1 n2 n2 n4 n3 n3 n4.
constexpr LocalEdge tetra_edges[] = {{0, 2}, {2, 5}, {5, 0}, {0, 4}, {2, 4}, {5, 4}};

std::span<const LocalEdge> local_edges(const Elements& family, std::uint32_t e) {
  switch (family.kind) {
    case ElementKind::shell4:
      return quad_edges;
    case ElementKind::shell3:
      return triangle_edges;
    case ElementKind::solid8:
      switch (family.shape[e]) {
        case SolidShape::tetra4:
        case SolidShape::tetra10:
          return tetra_edges;
        case SolidShape::penta6:
          return penta_edges;
        default:
          return brick_edges;
      }
    case ElementKind::truss:
    case ElementKind::beam:
      return bar_edges;
    default:
      return {};
  }
}

/// Marks the nodes that are secondary in any node-to-segment contact.
std::vector<std::uint8_t> secondary_nodes(const Scene& scene) {
  std::vector<std::uint8_t> marks(scene.model->nodes.size());
  for (const Contact& c : scene.contacts)
    for (const SecondaryNode& s : c.secondary) marks[s.node] = 1;
  return marks;
}

/// Every edge between two marked nodes once, with the first element that has it, sorted by nodes.
std::vector<ElementEdge> edges_between(const Model& model, const std::vector<std::uint8_t>& marks) {
  std::vector<ElementEdge> out;
  for (const ElementKind kind : families_with_edges) {
    const Elements& family = model.family(kind);
    for (std::uint32_t e = 0; e < family.size(); ++e) {
      const NodeIndex* n = family.of(e);
      for (const LocalEdge& local : local_edges(family, e)) {
        const NodeIndex a = n[local[0]], b = n[local[1]];
        if (a == b || a == no_index || b == no_index || !marks[a] || !marks[b]) continue;
        out.push_back({{std::min(a, b), std::max(a, b)}, kind, e});
      }
    }
  }
  const auto before = [](const ElementEdge& a, const ElementEdge& b) { return a.nodes < b.nodes; };
  std::stable_sort(out.begin(), out.end(), before);
  const auto same = [](const ElementEdge& a, const ElementEdge& b) { return a.nodes == b.nodes; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

/// An edge and the nodes of a segment in any order: segments on the same nodes are one place.
using SpotKey = std::pair<std::array<NodeIndex, 2>, std::array<NodeIndex, 4>>;
SpotKey spot_of(const Crossing& crossing, const MainSegment& segment) {
  SpotKey spot{crossing.edge, segment.nodes};
  std::sort(spot.second.begin(), spot.second.end());
  return spot;
}

}  // namespace

std::vector<Crossing> find_crossings(const Scene& scene, int threads) {
  std::vector<Crossing> out;
  const Coordinates& x = scene.coordinates;
  const std::vector<ElementEdge> all = edges_between(*scene.model, secondary_nodes(scene));
  if (all.empty()) return out;
  std::vector<std::uint32_t> contact_of(scene.model->nodes.size(), no_index);
  std::set<SpotKey> seen;
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    if (contact.main.empty()) continue;
    for (const SecondaryNode& s : contact.secondary) contact_of[s.node] = c;
    std::vector<std::array<std::uint32_t, 4>> segments;
    segments.reserve(contact.main.size());
    for (const MainSegment& m : contact.main) segments.push_back(m.nodes);
    std::vector<std::uint32_t> owners;
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::uint32_t e = 0; e < all.size(); ++e) {
      if (contact_of[all[e].nodes[0]] != c || contact_of[all[e].nodes[1]] != c) continue;
      owners.push_back(e);
      edges.push_back(all[e].nodes);
    }
    for (const CandidatePair& pair :
         find_crossing_pairs({x.x, x.y, x.z}, edges, segments, threads)) {
      const ElementEdge& e = all[owners[pair.secondary]];
      const Crossing crossing{c, e.nodes, e.kind, e.element, pair.main};
      if (seen.insert(spot_of(crossing, contact.main[pair.main])).second) out.push_back(crossing);
    }
  }
  return out;
}

}  // namespace deck
