// Crossed elements: edges of the secondary side that pass through main segments, each counted once.
// Candidates: a box tree of the main segments, met by boxes of element edges whose two nodes are
// secondary. Decision: an edge passes through a triangle of the segment if its ends lie strictly on
// either side of the plane and the line meets the closed triangle; exact (passes_through in
// exact.hpp), after a fast test in double with an error bound. Cost: about n log m for n edges and
// m segments.
#include "contact/shared/node_elements.hpp"
#include "deck/contacts.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "base/shared/parallel.hpp"
#include "base/shared/side_by_side.hpp"
#include "contact/search/box_tree.hpp"
#include "contact/search/sweep.hpp"
#include "contact/shared/exact.hpp"

namespace deck {
namespace {

constexpr std::size_t block_width = BoxBlock::width;
constexpr std::size_t at_once = 512;  // edges, or elements with their edges, per batch

std::vector<std::uint32_t> all_of(std::size_t count) {
  std::vector<std::uint32_t> out(count);
  std::iota(out.begin(), out.end(), 0U);
  return out;
}

/// Exact numbers need finite input; items without position cross nothing.
template <std::size_t N>
bool all_placed(const NodeArrays& nodes, const std::array<std::uint32_t, N>& of) {
  return std::all_of(of.begin(), of.end(),
                     [&](std::uint32_t n) { return is_finite(sweep::point(nodes, n)); });
}

/// True if `p` and `q` are on one side of the plane through 0, `b` and `c` in spite of round-off:
/// the determinant has six products, each off by less than eight half ulps of the product of the
/// largest entries per column.
bool on_one_side(const Point3<double>& b, const Point3<double>& c, const Point3<double>& p,
                 const Point3<double>& q) {
  constexpr double share = 0x1p-46, vanishing = 0x1p-700, huge = 0x1p300;
  const auto largest = [](double k, double l, double m, double n) {
    const double first = sweep::larger_of(std::abs(k), std::abs(l));
    return sweep::larger_of(first, sweep::larger_of(std::abs(m), std::abs(n)));
  };
  const double x = largest(b.x, c.x, p.x, q.x), y = largest(b.y, c.y, p.y, q.y),
               z = largest(b.z, c.z, p.z, q.z), off = share * (x * y * z);
  const Point3<double> normal = cross(b, c);
  const double of_p = dot(normal, p), of_q = dot(normal, q);
  return off > vanishing && x + y + z < huge &&
         ((of_p > off && of_q > off) || (of_p < -off && of_q < -off));
}

/// For an edge and a segment without common node, all with positions.
bool passes_through(const NodeArrays& nodes, const std::array<std::uint32_t, 2>& edge,
                    const std::array<std::uint32_t, 4>& s) {
  const auto at = [&](std::uint32_t n) { return sweep::point(nodes, n); };
  const Point3<double> p = at(edge[0]), q = at(edge[1]), a = at(s[0]), c = at(s[2]);
  const Point3<double> ap = p - a, aq = q - a, ac = c - a;
  const auto meets = [&](const Point3<double>& corner) {
    return !on_one_side(corner - a, ac, ap, aq) && detail::passes_through(p, q, a, corner, c);
  };
  return meets(at(s[1])) || (s[2] != s[3] && meets(at(s[3])));
}

/// Box tree of segments. `segment_of(i)`: nodes of one.
template <class SegmentOf>
class SegmentTree {
 public:
  SegmentTree(const NodeArrays& nodes, std::vector<std::uint32_t> some, const SegmentOf& segment_of,
              int threads)
      : order_(std::move(some)) {
    const std::size_t count = order_.size();
    sweep::put_in_order(
        order_, [&](std::uint32_t i) { return sweep::box_of_nodes(nodes, segment_of(i), 0); },
        threads);
    corners_.resize((count + block_width - 1) / block_width);
    const auto pack = [&](std::size_t i) {
      const std::array<std::uint32_t, 4> own = segment_of(order_[i]);
      for (std::size_t k = 0; k < 4; ++k)
        corners_[i / block_width].node[k][i % block_width] = own[k];
      return all_placed(nodes, own) ? sweep::box_of_nodes(nodes, own, 0) : Box::nowhere();
    };
    tree_ = BoxTree(count, pack, threads);
  }

  /// Leaves that edges with these boxes may pass through; no segments at a node of the edge.
  void near(std::span<const sweep::EdgeNodes> edges, std::span<const Box> boxes,
            std::vector<sweep::Meeting>& out) const {
    out.clear();
    sweep::kernels().meetings_apart(tree_, corners_, boxes, edges, out);
  }
  std::uint32_t segment(std::uint32_t leaf) const { return order_[leaf]; }
  std::array<std::uint32_t, 4> corners(std::uint32_t leaf) const {
    return corners_[leaf / block_width].of(leaf % block_width);
  }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<sweep::CornerBlock> corners_;  // in tree order
  BoxTree tree_;
};

constexpr LocalEdge bar_edges[] = {{0, 1}};
constexpr LocalEdge triangle_edges[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr LocalEdge quad_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr LocalEdge brick_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                     {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr LocalEdge penta_edges[] = {{0, 1}, {1, 2}, {2, 0}, {4, 5}, {5, 6},
                                     {6, 4}, {0, 4}, {1, 5}, {2, 6}};
// The slots of a tetrahedron are n1 n1 n2 n2 n4 n3 n3 n4.
constexpr LocalEdge tetra_edges[] = {{0, 2}, {2, 5}, {5, 0}, {0, 4}, {2, 4}, {5, 4}};

/// Mark of a node: 0 if not secondary; else this bit, and one per side of the main box passed.
constexpr std::uint8_t secondary_node = 0x40;
constexpr std::uint8_t outside_box = 0x3f;

std::uint8_t mark_of(const NodeArrays& nodes, NodeIndex n, const Box& box) {
  unsigned mark = secondary_node;
  const double at[] = {nodes.x[n], nodes.y[n], nodes.z[n]};
  for (std::size_t k = 0; k < 3; ++k)
    mark |= static_cast<unsigned>(at[k] < box.low[k]) << (2 * k) |
            static_cast<unsigned>(at[k] > box.high[k]) << (2 * k + 1);
  return static_cast<std::uint8_t>(mark);
}

/// Calls visit(edge) for every edge of an element with two marked nodes. An edge whose nodes lie
/// beyond one side of the box cannot meet anything in it.
template <class Visit>
void marked_edges(const Elements& family, std::uint32_t e, const std::vector<std::uint8_t>& marks,
                  const Visit& visit) {
  const NodeIndex* n = family.of(e);
  for (const LocalEdge& local : local_edges(family, e)) {
    const NodeIndex a = n[local[0]], b = n[local[1]];
    if (a == b || a == no_index || b == no_index) continue;
    if (!marks[a] || !marks[b] || (marks[a] & marks[b] & outside_box) != 0) continue;
    visit(std::array<NodeIndex, 2>{std::min(a, b), std::max(a, b)});
  }
}

/// Elements with such edges, by family, and by node.
struct EdgeCarriers {
  const Elements* family = nullptr;
  std::vector<std::uint32_t> elements;  ///< ascending
  IndexRows at_node = {};               ///< positions in `elements`; empty until needed
};

void find_rows(EdgeCarriers& carriers, std::size_t node_count) {
  std::vector<std::uint32_t>& first = carriers.at_node.first;
  first.assign(node_count + 1, 0);
  const auto for_each_node = [&](const auto& f) {
    for (auto i = static_cast<std::uint32_t>(carriers.elements.size()); i-- > 0;) {
      const NodeIndex* n = carriers.family->of(carriers.elements[i]);
      for (int k = 0; k < carriers.family->width; ++k)
        if (n[k] != no_index) f(n[k], i);
    }
  };
  for_each_node([&](NodeIndex n, std::uint32_t) { ++first[n]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  carriers.at_node.entries.resize(first.back());
  // From the end of each row to its start, where the row before ends.
  for_each_node([&](NodeIndex n, std::uint32_t i) { carriers.at_node.entries[--first[n]] = i; });
}

/// Elements with two or more secondary nodes of the contact, unless all of these lie beyond one
/// side of the box; ascending. All elements if there are no rows.
std::vector<std::uint32_t> carriers_of(const EdgeCarriers& carriers, const Contact& contact,
                                       const std::vector<std::uint8_t>& marks) {
  if (carriers.at_node.rows() == 0) return carriers.elements;
  // One bit for the first node, one for more, and the sides that all are beyond.
  constexpr std::uint8_t one = 0x40, more = 0x80;
  std::vector<std::uint8_t> found(carriers.elements.size());
  std::uint32_t low = no_index, high = 0;  // range of elements with a node
  for (const SecondaryNode& s : contact.secondary) {
    const std::uint8_t beyond = marks[s.node] & outside_box;
    const std::span<const std::uint32_t> row = carriers.at_node.row(s.node);
    for (const std::uint32_t i : row)
      found[i] = found[i] == 0 ? one | beyond : more | (found[i] & beyond);
    if (row.empty()) continue;
    low = std::min(low, row.front());
    high = std::max(high, row.back() + 1);
  }
  std::vector<std::uint32_t> out;
  for (std::size_t i = low; i < high; ++i)
    if (found[i] == more) out.push_back(carriers.elements[i]);
  return out;
}

std::vector<EdgeCarriers> carriers(const Model& model, const std::vector<std::uint8_t>& marks,
                                   int threads) {
  std::vector<EdgeCarriers> out;
  for (const ElementKind kind : families_with_edges) {
    EdgeCarriers all{&model.family(kind), {}};
    std::vector<std::vector<std::uint32_t>> parts(pieces_of(threads, all.family->size()));
    parallel_pieces(threads, all.family->size(),
                    [&](std::size_t part, std::size_t begin, std::size_t end) {
                      std::vector<std::uint32_t>& elements = parts[part];
                      for (auto e = static_cast<std::uint32_t>(begin); e < end; ++e) {
                        bool any = false;
                        marked_edges(*all.family, e, marks, [&](const auto&) { any = true; });
                        if (any) elements.push_back(e);
                      }
                    });
    all.elements = std::move(parts[0]);
    for (std::size_t part = 1; part < parts.size(); ++part)
      all.elements.insert(all.elements.end(), parts[part].begin(), parts[part].end());
    if (!all.elements.empty()) out.push_back(std::move(all));
  }
  return out;
}

/// Recently tested edges (mostly neighbours in the file share one). Forgets old entries.
class RecentEdges {
 public:
  RecentEdges() : slots_(std::size_t{1} << bits, {no_index, no_index}) {}
  /// False if it is a recent one.
  bool add(const std::array<NodeIndex, 2>& edge) {
    const std::uint32_t mixed = edge[0] * 0x9e3779b1U ^ edge[1] * 0x85ebca6bU;
    std::array<NodeIndex, 2>& slot = slots_[mixed >> (32 - bits)];
    return std::exchange(slot, edge) != edge;
  }

 private:
  static constexpr int bits = 13;
  std::vector<std::array<NodeIndex, 2>> slots_;
};

/// Main segments of a contact without backs of earlier ones, which count for the first.
struct MainSides {
  std::size_t count = 0;                ///< number of these, listed first
  std::vector<std::uint32_t> opposite;  ///< back of each; no_index: none. Empty: no backs

  explicit MainSides(const Contact& contact) : count(contact.main.size()) {
    const auto& kinds = contact.segment_kinds;
    const auto mirrored = [](SegmentKind k) {
      return k == SegmentKind::shell_opposite || k == SegmentKind::coat_opposite;
    };
    const auto first = std::find_if(kinds.begin(), kinds.end(), mirrored);
    if (first == kinds.end()) return;
    count = static_cast<std::size_t>(first - kinds.begin());
    opposite.assign(count, no_index);
    auto next = static_cast<std::uint32_t>(count);
    for (std::size_t i = 0; i < count && next < contact.main.size(); ++i) {
      const auto& n = contact.main[i].nodes;
      const bool triangle = n[2] == n[3];
      const std::array<NodeIndex, 4> other{n[1], n[0], triangle ? n[2] : n[3], n[2]};
      if (contact.main[next].nodes == other && kinds[i] != SegmentKind::solid) opposite[i] = next++;
    }
  }
  /// Segment that an edge passes through, or else its back (bent otherwise); no_index if neither.
  std::uint32_t met(const NodeArrays& nodes, const std::array<std::uint32_t, 2>& edge,
                    std::uint32_t segment, const std::array<std::uint32_t, 4>& s) const {
    if (passes_through(nodes, edge, s)) return segment;
    if (opposite.empty() || opposite[segment] == no_index || s[2] == s[3]) return no_index;
    return passes_through(nodes, edge, {s[1], s[0], s[3], s[2]}) ? opposite[segment] : no_index;
  }
};

/// Keeps the first of several segments on the same nodes, such as the face between two solids.
/// Returns the next of each segment (no_index: none), or nothing if no carrier is a solid.
std::vector<std::uint32_t> keep_first(const std::vector<MainSegment>& main,
                                      std::vector<std::uint32_t>& some) {
  const auto of_solid = [&](std::uint32_t i) { return main[i].carrier == Carrier::solid; };
  const auto solids = static_cast<std::size_t>(std::count_if(some.begin(), some.end(), of_solid));
  if (solids == 0) return {};
  constexpr std::size_t looks = 8;  // a segment that is not found stays
  const std::size_t mask = std::bit_ceil(2 * solids) - 1;
  std::vector<std::uint32_t> next(main.size(), no_index), table(mask + looks, no_index);
  const auto sorted = [&](std::uint32_t i) {
    std::array<NodeIndex, 4> n = main[i].nodes;
    std::sort(n.begin(), n.end());
    return n;
  };
  const auto is_first = [&](std::uint32_t i) {
    std::uint64_t mixed = 0;
    for (const std::uint64_t n : main[i].nodes) mixed += n * n;
    for (std::size_t at = (mixed * 0x9e3779b97f4a7c15u >> 32) & mask, end = at + looks; at < end;
         ++at) {
      if (table[at] == no_index) {
        table[at] = i;
        return true;
      }
      if (sorted(table[at]) != sorted(i)) continue;
      next[i] = std::exchange(next[table[at]], i);
      return false;
    }
    return true;
  };
  std::erase_if(some, [&](std::uint32_t i) { return of_solid(i) && !is_first(i); });
  return next;
}

/// Edges of these elements between marked nodes that pass through main segments of one contact, in
/// element order; an edge comes at least once, with its first element.
template <class Tree>
void cross(const EdgeCarriers& carriers, const std::vector<std::uint8_t>& marks,
           const NodeArrays& nodes, const Contact& contact, const MainSides& main, const Tree& tree,
           const std::vector<std::uint32_t>& next, int threads, std::vector<Crossing>& out) {
  const std::vector<std::uint32_t> elements = carriers_of(carriers, contact, marks);
  if (elements.empty()) return;
  struct Batch {
    RecentEdges recent;  // also of earlier pieces: their elements come first
    std::vector<sweep::EdgeNodes> edges;
    std::vector<std::uint32_t> elements;  // elements with these
    std::vector<Box> boxes;
    std::vector<sweep::Meeting> near;
    std::vector<Crossing> found;
  };
  const auto work = [&](std::size_t piece, Batch& p) {
    p.edges.clear();
    p.elements.clear();
    p.boxes.clear();
    p.found.clear();
    const std::size_t end = std::min(elements.size(), (piece + 1) * at_once);
    for (std::size_t i = piece * at_once; i < end; ++i)
      marked_edges(*carriers.family, elements[i], marks, [&](const auto& edge) {
        if (!p.recent.add(edge)) return;
        p.edges.push_back(edge);
        p.elements.push_back(elements[i]);
        p.boxes.push_back(sweep::box_of_nodes(nodes, edge, 0));
      });
    tree.near(p.edges, p.boxes, p.near);
    for (const sweep::Meeting& m : p.near) {
      const sweep::EdgeNodes& edge = p.edges[m.box];
      for (std::uint32_t s = tree.segment(m.leaf); s != no_index;
           s = next.empty() ? no_index : next[s])
        if (const std::uint32_t met = main.met(nodes, edge, s, contact.main[s].nodes);
            met != no_index)
          p.found.push_back({0, edge, carriers.family->kind, p.elements[m.box], met});
    }
  };
  run_in_order<Batch>((elements.size() + at_once - 1) / at_once, threads, work,
                      [&](std::size_t, const Batch& in) {
                        out.insert(out.end(), in.found.begin(), in.found.end());
                      });
}

/// An edge and the nodes of a segment in any order: segments on equal nodes are one.
using SpotKey = std::pair<std::array<NodeIndex, 2>, std::array<NodeIndex, 4>>;
SpotKey spot_of(const Crossing& crossing, const MainSegment& segment) {
  SpotKey spot{crossing.edge, segment.nodes};
  std::sort(spot.second.begin(), spot.second.end());
  return spot;
}

/// Crossings of one contact by edge and segment, with the edge's first element. `marks`: scratch.
std::vector<Crossing> crossings_of(const Contact& contact, const std::vector<EdgeCarriers>& all,
                                   const NodeArrays& nodes, std::vector<std::uint8_t>& marks,
                                   int threads) {
  std::vector<Crossing> found;
  if (contact.main.empty() || contact.secondary.empty()) return found;
  const auto segment_of = [&](std::uint32_t i) { return contact.main[i].nodes; };
  const MainSides main(contact);
  Box around;  // bounds of the secondary nodes
  for (const SecondaryNode& s : contact.secondary)
    around.add(sweep::box_of_nodes(nodes, std::array{s.node}, 0));
  std::vector<std::uint32_t> near = all_of(main.count);
  const Box box = sweep::keep_inside(
      near, [&](std::uint32_t i) { return sweep::box_of_nodes(nodes, segment_of(i), 0); }, around,
      threads);
  if (near.empty()) return found;
  unsigned beyond = outside_box;  // sides of the box that all nodes are beyond
  for (const SecondaryNode& s : contact.secondary)
    if (all_placed(nodes, std::array{s.node}))
      beyond &= marks[s.node] = mark_of(nodes, s.node, box);
  if (beyond == 0) {
    const std::vector<std::uint32_t> next = keep_first(contact.main, near);
    const SegmentTree tree(nodes, std::move(near), segment_of, threads);
    for (const EdgeCarriers& b : all)
      cross(b, marks, nodes, contact, main, tree, next, threads, found);
  }
  for (const SecondaryNode& s : contact.secondary) marks[s.node] = 0;
  // Keep the first element of an edge.
  std::stable_sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.edge, a.main) < std::tie(b.edge, b.main);
  });
  return found;
}

std::vector<std::vector<Crossing>> crossings_by_contact(const Scene& scene,
                                                        const std::vector<EdgeCarriers>& all,
                                                        const NodeArrays& nodes, int threads) {
  std::vector<std::size_t> sizes;
  for (const Contact& c : scene.contacts)
    sizes.push_back(c.main.empty() ? 0 : c.main.size() + c.secondary.size());
  std::vector<std::vector<std::uint8_t>> marks(static_cast<std::size_t>(threads));
  std::vector<std::vector<Crossing>> found(sizes.size());
  side_by_side(threads, sizes, [&](std::size_t c, const Share& share) {
    std::vector<std::uint8_t>& own = marks[share.worker];
    own.resize(scene.model->nodes.size());
    found[c] = crossings_of(scene.contacts[c], all, nodes, own, share.threads);
  });
  return found;
}

}  // namespace

std::vector<CandidatePair> find_crossing_pairs(
    const NodeArrays& nodes, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const std::array<std::uint32_t, 4>> segments, int threads) {
  if (edges.empty() || segments.empty()) return {};
  threads = effective_threads(threads);
  const auto segment_of = [&](std::uint32_t i) { return segments[i]; };
  const SegmentTree tree(nodes, all_of(segments.size()), segment_of, threads);
  struct Batch {
    std::vector<Box> boxes;
    std::vector<sweep::Meeting> near;
    std::vector<CandidatePair> found;
  };
  std::vector<CandidatePair> all;
  run_in_order<Batch>(
      (edges.size() + at_once - 1) / at_once, threads,
      [&](std::size_t piece, Batch& out) {
        const std::size_t first = piece * at_once;
        out.boxes.clear();
        out.found.clear();
        const auto some = edges.subspan(first, std::min(at_once, edges.size() - first));
        for (const auto& edge : some) out.boxes.push_back(sweep::box_of_nodes(nodes, edge, 0));
        tree.near(some, out.boxes, out.near);
        for (const sweep::Meeting& m : out.near) {
          const auto& edge = edges[first + m.box];
          if (all_placed(nodes, edge) && passes_through(nodes, edge, tree.corners(m.leaf)))
            out.found.push_back({static_cast<std::uint32_t>(first + m.box), tree.segment(m.leaf)});
        }
      },
      [&](std::size_t, const Batch& in) {
        all.insert(all.end(), in.found.begin(), in.found.end());
      });
  std::sort(all.begin(), all.end());
  return all;
}

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

std::vector<Crossing> find_crossings(const Scene& scene, int threads) {
  threads = effective_threads(threads);
  const NodeArrays nodes{scene.coordinates.x, scene.coordinates.y, scene.coordinates.z};
  std::vector<EdgeCarriers> all;
  {
    std::vector<std::uint8_t> marks(scene.model->nodes.size());
    for (const Contact& c : scene.contacts)
      for (const SecondaryNode& s : c.secondary) marks[s.node] = secondary_node;
    all = carriers(*scene.model, marks, threads);
  }
  if (scene.contacts.size() > 2)  // else most of them belong to every contact
    for (EdgeCarriers& b : all) find_rows(b, scene.model->nodes.size());
  std::vector<Crossing> out;
  std::set<SpotKey> seen;
  std::vector<std::vector<Crossing>> found = crossings_by_contact(scene, all, nodes, threads);
  for (std::uint32_t c = 0; c < found.size(); ++c)
    for (Crossing& crossing : found[c]) {
      crossing.contact = c;
      if (seen.insert(spot_of(crossing, scene.contacts[c].main[crossing.main])).second)
        out.push_back(crossing);
    }
  return out;
}

}  // namespace deck
