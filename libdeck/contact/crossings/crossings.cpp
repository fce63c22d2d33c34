// Crossed elements: edges of the secondary side that pass through main segments, counted once.
#include "deck/contact/crossings.hpp"
#include "contact/scene/node_elements.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "base/pages.hpp"
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

bool meet(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(a.low[k] <= b.high[k] && b.low[k] <= a.high[k])) return false;
  return true;
}

/// Segments in a tree of their boxes. `segment_of(i)`: the nodes of one.
template <class SegmentOf>
class SegmentTree {
 public:
  struct Near {
    std::uint32_t segment;
    Box box;
  };
  SegmentTree(const NodeArrays& nodes, std::size_t count, const SegmentOf& segment_of, int threads)
      : nodes_(nodes), segment_of_(segment_of), order_(count) {
    std::iota(order_.begin(), order_.end(), 0U);
    sweep::put_in_order(
        order_, [&](std::uint32_t i) { return box_of(i); }, threads);
    std::vector<BoxBlock> blocks;
    make_room(blocks, (count + width - 1) / width, threads);
    blocks.resize((count + width - 1) / width);
    parallel_parts(threads, blocks.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin * width; i < std::min(count, end * width); ++i)
        blocks[i / width].set(i % width, box_of(order_[i]));
    });
    tree_ = BoxTree(std::move(blocks), threads);
  }

  /// The segments whose boxes meet `box`.
  void near(const Box& box, std::vector<Near>& out) const {
    out.clear();
    walk(tree_, tree_.levels() - 1, 0, box, [&](std::size_t leaf) {
      const BoxBlock& block = tree_.level(0)[leaf / width];
      const std::size_t i = leaf % width;
      out.push_back({order_[leaf],
                     {{block.low[0][i], block.low[1][i], block.low[2][i]},
                      {block.high[0][i], block.high[1][i], block.high[2][i]}}});
    });
  }

 private:
  Box box_of(std::uint32_t i) const { return segment_box(nodes_, segment_of_(i)); }

  const NodeArrays& nodes_;
  const SegmentOf& segment_of_;
  std::vector<std::uint32_t> order_;
  BoxTree tree_;
};

}  // namespace

std::vector<CandidatePair> find_crossing_pairs(
    const NodeArrays& nodes, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const std::array<std::uint32_t, 4>> segments, int threads) {
  if (edges.empty() || segments.empty()) return {};
  threads = effective_threads(threads);
  const auto segment_of = [&](std::uint32_t i) { return segments[i]; };
  const SegmentTree tree(nodes, segments.size(), segment_of, threads);
  std::vector<std::vector<CandidatePair>> found(static_cast<std::size_t>(threads));
  parallel_parts(threads, edges.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<typename decltype(tree)::Near> near;
    for (std::size_t e = begin; e < end; ++e) {
      tree.near(sweep::edge_box(nodes, edges[e], 0), near);
      for (const auto& m : near)
        if (passes_through(nodes, edges[e], segments[m.segment]))
          found[part].push_back({static_cast<std::uint32_t>(e), m.segment});
    }
  });
  std::vector<CandidatePair> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  return all;
}

namespace {

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

/// Calls visit(edge) for every edge of an element whose nodes are both marked.
template <class Visit>
void marked_edges(const Elements& family, std::uint32_t e, const std::vector<std::uint8_t>& marks,
                  const Visit& visit) {
  const NodeIndex* n = family.of(e);
  for (const LocalEdge& local : local_edges(family, e)) {
    const NodeIndex a = n[local[0]], b = n[local[1]];
    if (a == b || a == no_index || b == no_index || !marks[a] || !marks[b]) continue;
    visit(std::array<NodeIndex, 2>{std::min(a, b), std::max(a, b)});
  }
}

/// Elements with such edges, by family, and where each node has them.
struct Bearers {
  const Elements* family = nullptr;
  std::vector<std::uint32_t> elements;  ///< ascending
  IndexRows at_node = {};               ///< positions in `elements`; not formed: no rows
};

/// Forms `at_node`.
void find_rows(Bearers& bearers, std::size_t node_count) {
  std::vector<std::uint32_t>& first = bearers.at_node.first;
  first.assign(node_count + 1, 0);
  const auto each = [&](const auto& f) {
    for (auto i = static_cast<std::uint32_t>(bearers.elements.size()); i-- > 0;) {
      const NodeIndex* n = bearers.family->of(bearers.elements[i]);
      for (int k = 0; k < bearers.family->width; ++k)
        if (n[k] != no_index) f(n[k], i);
    }
  };
  each([&](NodeIndex n, std::uint32_t) { ++first[n]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  bearers.at_node.entries.resize(first.back());
  // From the end of each row to its beginning, which is where the row before ends.
  each([&](NodeIndex n, std::uint32_t i) { bearers.at_node.entries[--first[n]] = i; });
}

/// Those that have two nodes or more of the contact's secondary side, ascending; where there are no
/// rows to find them in, all.
std::vector<std::uint32_t> bearers_of(const Bearers& bearers, const Contact& contact) {
  if (bearers.at_node.rows() == 0) return bearers.elements;
  std::vector<std::uint8_t> nodes(bearers.elements.size());
  std::vector<std::uint32_t> out;
  for (const SecondaryNode& s : contact.secondary)
    for (const std::uint32_t i : bearers.at_node.row(s.node))
      if (nodes[i] < 2 && ++nodes[i] == 2) out.push_back(bearers.elements[i]);
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Bearers> bearers(const Model& model, const std::vector<std::uint8_t>& marks,
                             int threads) {
  std::vector<Bearers> out;
  std::vector<std::vector<std::uint32_t>> parts(static_cast<std::size_t>(threads));
  for (const ElementKind kind : families_with_edges) {
    Bearers all{&model.family(kind), {}};
    parallel_parts(threads, all.family->size(),
                   [&](std::size_t part, std::size_t begin, std::size_t end) {
                     std::vector<std::uint32_t>& elements = parts[part];
                     elements.clear();
                     for (auto e = static_cast<std::uint32_t>(begin); e < end; ++e) {
                       bool any = false;
                       marked_edges(*all.family, e, marks, [&](const auto&) { any = true; });
                       if (any) elements.push_back(e);
                     }
                   });
    all.elements = std::move(parts[0]);
    for (std::size_t part = 1; part < parts.size(); ++part)
      all.elements.insert(all.elements.end(), parts[part].begin(), parts[part].end());
    parts[0].clear();
    if (!all.elements.empty()) out.push_back(std::move(all));
  }
  return out;
}

/// Edges that were looked at a moment ago: an edge belongs to several elements, mostly to
/// neighbours in the order of the file. Forgets what does not fit.
class RecentEdges {
 public:
  RecentEdges() : slots_(std::size_t{1} << bits, {no_index, no_index}) {}
  /// False: it is one of them.
  bool add(const std::array<NodeIndex, 2>& edge) {
    const std::uint32_t mixed = edge[0] * 0x9e3779b1U ^ edge[1] * 0x85ebca6bU;
    std::array<NodeIndex, 2>& slot = slots_[mixed >> (32 - bits)];
    return std::exchange(slot, edge) != edge;
  }

 private:
  static constexpr int bits = 13;
  std::vector<std::array<NodeIndex, 2>> slots_;
};

/// Edges of these elements between marked nodes that pass through main segments of one contact, in
/// the order of the elements: an edge comes once at least, with the first element that has it.
template <class Tree>
void cross(const Bearers& bearers, const std::vector<std::uint8_t>& marks, const NodeArrays& nodes,
           const Contact& contact, const Tree& tree, int threads, std::vector<Crossing>& out) {
  const std::vector<std::uint32_t> elements = bearers_of(bearers, contact);
  std::vector<std::vector<Crossing>> found(static_cast<std::size_t>(threads));
  parallel_parts(
      threads, elements.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
        std::vector<typename Tree::Near> near;
        std::vector<std::pair<std::array<NodeIndex, 2>, Box>> edges;
        RecentEdges recent;
        for (std::size_t i = begin; i < end; ++i) {
          const std::uint32_t e = elements[i];
          Box around;
          edges.clear();
          marked_edges(*bearers.family, e, marks, [&](const auto& edge) {
            if (!recent.add(edge)) return;
            edges.emplace_back(edge, sweep::edge_box(nodes, edge, 0));
            around.add(edges.back().second);
          });
          if (edges.empty()) continue;
          tree.near(around, near);
          for (const auto& [edge, box] : edges)
            for (const auto& m : near)
              if (meet(m.box, box) && passes_through(nodes, edge, contact.main[m.segment].nodes))
                found[part].push_back({0, edge, bearers.family->kind, e, m.segment});
        }
      });
  for (const auto& part : found) out.insert(out.end(), part.begin(), part.end());
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
  threads = effective_threads(threads);
  const NodeArrays nodes{scene.coordinates.x, scene.coordinates.y, scene.coordinates.z};
  std::vector<std::uint8_t> marks(scene.model->nodes.size());
  const auto mark = [&](const Contact& contact, std::uint8_t value) {
    for (const SecondaryNode& s : contact.secondary) marks[s.node] = value;
  };
  for (const Contact& c : scene.contacts) mark(c, 1);
  std::vector<Bearers> all = bearers(*scene.model, marks, threads);
  if (scene.contacts.size() > 2)  // else most of them belong to every contact
    for (Bearers& b : all) find_rows(b, scene.model->nodes.size());
  const bool alone = scene.contacts.size() == 1;  // its marks are there already
  if (!alone) std::fill(marks.begin(), marks.end(), std::uint8_t{0});
  std::vector<Crossing> out;
  std::set<SpotKey> seen;
  for (std::uint32_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = scene.contacts[c];
    if (contact.main.empty() || contact.secondary.empty()) continue;
    const auto segment_of = [&](std::uint32_t i) { return contact.main[i].nodes; };
    const SegmentTree tree(nodes, contact.main.size(), segment_of, threads);
    if (!alone) mark(contact, 1);
    std::vector<Crossing> found;
    for (const Bearers& b : all) cross(b, marks, nodes, contact, tree, threads, found);
    if (!alone) mark(contact, 0);
    // Of the elements that have an edge the first one stays.
    std::stable_sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
      return std::tie(a.edge, a.main) < std::tie(b.edge, b.main);
    });
    for (Crossing& crossing : found) {
      crossing.contact = c;
      if (seen.insert(spot_of(crossing, contact.main[crossing.main])).second)
        out.push_back(crossing);
    }
  }
  return out;
}

}  // namespace deck
