// Crossed elements: edges of the secondary side that pass through main segments, each counted once.
// Candidates: one box tree of the main segments of all contacts that share some, or secondary
// nodes, met by boxes of element edges whose two nodes are secondary; of these, edges and segments
// with a common contact. Decision: an edge passes through a triangle of the segment if its ends lie
// strictly on either side of the plane and the line meets the closed triangle; exact
// (passes_through in exact.hpp), after a fast test in double with an error bound. Cost: about n log
// m for n edges and m segments.
#include "contact/shared/node_elements.hpp"
#include "deck/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/search/box_tree.hpp"
#include "contact/search/sweep.hpp"
#include "contact/shared/exact.hpp"
#include "model/shared/faces.hpp"

namespace deck {
namespace {

constexpr std::size_t block_width = BoxBlock::width;
constexpr std::size_t at_once = 512;  // edges, or elements with their edges, per batch

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

/// Box tree of segments.
class SegmentTree {
 public:
  /// `segment_of(i)`: nodes of one of them.
  template <class SegmentOf>
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

/// Contacts of which each node is secondary; none for a node without position.
IndexRows contacts_at_nodes(const std::vector<Contact>& contacts, const NodeArrays& nodes) {
  IndexRows rows;
  rows.first.assign(nodes.x.size() + 1, 0);
  const auto for_each_node = [&](const auto& f) {
    for (auto c = static_cast<std::uint32_t>(contacts.size()); c-- > 0;)
      if (!contacts[c].main.empty())
        for (const SecondaryNode& s : contacts[c].secondary)
          if (all_placed(nodes, std::array{s.node})) f(s.node, c);
  };
  for_each_node([&](NodeIndex n, std::uint32_t) { ++rows.first[n]; });
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  rows.entries.resize(rows.first.back());
  // From the end of each row to its start, where the row before ends.
  for_each_node([&](NodeIndex n, std::uint32_t c) { rows.entries[--rows.first[n]] = c; });
  return rows;
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

/// Main segments of all contacts, without those far from the secondary nodes. Segments on the same
/// nodes are one spot: contacts share surfaces, two solids a face, and TYPE25 shells have two
/// sides.
struct Spots {
  struct Segment {
    std::uint32_t contact = 0, main = 0;
    std::uint32_t next = no_index;  ///< of the same spot, by contact and position
  };
  std::vector<std::array<NodeIndex, 4>> nodes;  ///< by spot: its nodes, ascending
  std::vector<std::uint32_t> first;             ///< by spot: its first segment
  std::vector<Segment> segments;

  Spots(const std::vector<Contact>& contacts, const NodeArrays& arrays)
      : newest_(arrays.x.size(), no_index) {
    for (auto c = static_cast<std::uint32_t>(contacts.size()); c-- > 0;) {
      const Contact& contact = contacts[c];
      if (contact.secondary.empty()) continue;
      Box around;  // bounds of the secondary nodes
      const auto box = [&](const auto& of) { return sweep::box_of_nodes(arrays, of, 0); };
      for (const SecondaryNode& s : contact.secondary) around.add(box(std::array{s.node}));
      for (auto i = static_cast<std::uint32_t>(contact.main.size()); i-- > 0;) {
        const std::array<NodeIndex, 4>& on = contact.main[i].nodes;
        if (around.overlaps(box(std::array{on[0]})) || around.overlaps(box(on))) add({c, i}, on);
      }
    }
    newest_ = older_ = {};
  }

 private:
  /// Puts a segment before those of its spot.
  void add(Segment segment, std::array<NodeIndex, 4> on) {
    const auto sort_two = [&](std::size_t i, std::size_t k) {
      const auto [low, high] = std::minmax({on[i], on[k]});
      on[i] = low;
      on[k] = high;
    };
    sort_two(0, 1), sort_two(2, 3), sort_two(0, 2), sort_two(1, 3), sort_two(1, 2);
    std::uint32_t& newest = newest_[on[1] / 2 + on[3] / 2];  // one node may be the hub of a fan
    std::uint32_t spot = newest;
    while (spot != no_index && !(detail::NodeKey{nodes[spot]} == detail::NodeKey{on}))
      spot = older_[spot];
    if (spot == no_index) {
      spot = static_cast<std::uint32_t>(nodes.size());
      nodes.push_back(on);
      older_.push_back(std::exchange(newest, spot));
      first.push_back(no_index);
    }
    segment.next = std::exchange(first[spot], static_cast<std::uint32_t>(segments.size()));
    segments.push_back(segment);
  }

  std::vector<std::uint32_t> newest_, older_;  // by a node amid them: the last spot; that before
};

/// Contacts that share main segments or secondary nodes, also by way of others, are of one group,
/// with one box tree: groups in the same place, such as variants of a part, do not slow each other.
class Groups {
 public:
  Groups(const Spots& spots, const IndexRows& at_node, const NodeArrays& nodes,
         std::size_t contacts, int threads)
      : first_(contacts), trees_(contacts) {
    std::iota(first_.begin(), first_.end(), 0U);
    for (const Spots::Segment& s : spots.segments)
      if (s.next != no_index) join(s.contact, spots.segments[s.next].contact);
    for (std::size_t n = 0; n < at_node.rows(); ++n)
      for (const std::uint32_t contact : at_node.row(n)) join(at_node.row(n)[0], contact);
    for (std::uint32_t c = 0; c < contacts; ++c) first_[c] = root(c);
    std::vector<std::vector<std::uint32_t>> lists(contacts);
    for (std::uint32_t i = 0; i < spots.nodes.size(); ++i)
      lists[of(spots.segments[spots.first[i]].contact)].push_back(i);
    for (std::size_t g = 0; g < contacts; ++g)
      trees_[g] = std::make_unique<const SegmentTree>(
          nodes, std::move(lists[g]), [&](std::uint32_t spot) { return spots.nodes[spot]; },
          threads);
  }
  /// Number of the group of a contact.
  std::uint32_t of(std::uint32_t contact) const { return first_[contact]; }
  const SegmentTree& tree(std::uint32_t group) const { return *trees_[group]; }

 private:
  std::uint32_t root(std::uint32_t contact) {
    while (first_[contact] != contact) contact = first_[contact] = first_[first_[contact]];
    return contact;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [first, later] = std::minmax({root(a), root(b)});
    first_[later] = first;
  }
  std::vector<std::uint32_t> first_;                       // by contact: the first of its group
  std::vector<std::unique_ptr<const SegmentTree>> trees_;  // by group
};

/// Edges of one family of elements that pass through segments, in element order. For each spot that
/// an edge passes comes at least one crossing, first that of its first element; all name the first
/// contact with edge and spot, and its first segment passed.
void cross(const Elements& family, const std::vector<Contact>& contacts, const IndexRows& at_node,
           const NodeArrays& nodes, const Spots& spots, const Groups& groups, int threads,
           std::vector<Crossing>& out) {
  struct Query {
    std::uint32_t group = 0, element = 0;
    sweep::EdgeNodes edge{};
  };
  struct Batch {
    RecentEdges recent;  // also of earlier pieces: their elements come first
    std::vector<Query> queries;
    std::vector<sweep::EdgeNodes> edges;  // of one group
    std::vector<Box> boxes;
    std::vector<sweep::Meeting> near;
    std::vector<std::uint32_t> shared;  // contacts of both nodes
    std::vector<Crossing> found;
  };
  const auto ask = [&](Batch& p, std::uint32_t element) {
    const NodeIndex* n = family.of(element);
    std::array<bool, 8> met{};
    std::transform(n, n + family.width, met.begin(),
                   [&](NodeIndex node) { return node != no_index && !at_node.row(node).empty(); });
    for (const LocalEdge& local : local_edges(family, element)) {
      const NodeIndex a = n[local[0]], b = n[local[1]];
      if (a == b || !met[static_cast<std::size_t>(local[0])] ||
          !met[static_cast<std::size_t>(local[1])])
        continue;
      const sweep::EdgeNodes edge{std::min(a, b), std::max(a, b)};
      if (p.recent.add(edge)) p.queries.push_back({groups.of(at_node.row(a)[0]), element, edge});
    }
  };
  const auto cross_one = [&](Batch& p, const Query& query, std::uint32_t spot) {
    const std::array<NodeIndex, 4>* missed = nullptr;
    for (std::uint32_t s = spots.first[spot]; s != no_index; s = spots.segments[s].next) {
      const auto& [contact, main, next] = spots.segments[s];
      const std::array<NodeIndex, 4>& on = contacts[contact].main[main].nodes;
      if (!std::binary_search(p.shared.begin(), p.shared.end(), contact) ||
          (missed != nullptr && on == *missed))
        continue;
      if (passes_through(nodes, query.edge, on)) {
        p.found.push_back({contact, query.edge, family.kind, query.element, main});
        return;
      }
      missed = &on;
    }
  };
  const auto work = [&](std::size_t piece, Batch& p) {
    p.queries.clear();
    p.found.clear();
    const std::size_t end = std::min(family.size(), (piece + 1) * at_once);
    for (auto e = static_cast<std::uint32_t>(piece * at_once); e < end; ++e) ask(p, e);
    std::stable_sort(p.queries.begin(), p.queries.end(),
                     [](const Query& q, const Query& r) { return q.group < r.group; });
    for (auto q = p.queries.begin(); q != p.queries.end();) {
      const SegmentTree& tree = groups.tree(q->group);
      const auto first = q;
      p.edges.clear();
      p.boxes.clear();
      for (; q != p.queries.end() && q->group == first->group; ++q) {
        p.edges.push_back(q->edge);
        p.boxes.push_back(sweep::box_of_nodes(nodes, q->edge, 0));
      }
      tree.near(p.edges, p.boxes, p.near);
      std::uint32_t of = no_index;
      for (const sweep::Meeting& m : p.near) {
        if (std::exchange(of, m.box) != m.box) {
          const auto a = at_node.row(p.edges[m.box][0]), b = at_node.row(p.edges[m.box][1]);
          p.shared.clear();
          std::set_intersection(a.begin(), a.end(), b.begin(), b.end(),
                                std::back_inserter(p.shared));
        }
        cross_one(p, first[m.box], tree.segment(m.leaf));
      }
    }
  };
  run_in_order<Batch>((family.size() + at_once - 1) / at_once, threads, work,
                      [&](std::size_t, const Batch& in) {
                        out.insert(out.end(), in.found.begin(), in.found.end());
                      });
}

}  // namespace

std::vector<CandidatePair> find_crossing_pairs(
    const NodeArrays& nodes, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const std::array<std::uint32_t, 4>> segments, int threads) {
  if (edges.empty() || segments.empty()) return {};
  threads = effective_threads(threads);
  std::vector<std::uint32_t> all_segments(segments.size());
  std::iota(all_segments.begin(), all_segments.end(), 0U);
  const SegmentTree tree(
      nodes, std::move(all_segments), [&](std::uint32_t i) { return segments[i]; }, threads);
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
  std::vector<Crossing> found;
  const Spots spots(scene.contacts, nodes);
  if (spots.nodes.empty()) return found;
  const IndexRows at_node = contacts_at_nodes(scene.contacts, nodes);
  const Groups groups(spots, at_node, nodes, scene.contacts.size(), threads);
  for (const ElementKind kind : families_with_edges)
    cross(scene.model->family(kind), scene.contacts, at_node, nodes, spots, groups, threads, found);
  const auto key = [](const Crossing& c) { return std::tie(c.contact, c.edge, c.main); };
  std::stable_sort(found.begin(), found.end(),
                   [&](const Crossing& a, const Crossing& b) { return key(a) < key(b); });
  // An edge keeps its first element.
  const auto same = [&](const Crossing& a, const Crossing& b) { return key(a) == key(b); };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

}  // namespace deck
