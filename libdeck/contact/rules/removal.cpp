// Irem_gap = 2: secondary nodes (edges) of a self contact that lie within sqrt(2) gaps of a main
// segment (edge) along the mesh are not paired with it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/scene/scene_parts.hpp"

namespace deck::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double root2 = std::sqrt(2.0);

/// node -> items of the main side that touch it and have at least one secondary node.
struct NodeItems {
  std::vector<std::uint32_t> start, item;
  template <class Items>
  NodeItems(std::size_t nodes, const Items& items, const std::vector<std::uint32_t>& position)
      : start(nodes + 1, 0) {
    std::vector<std::uint8_t> works(items.size(), 0);
    for (std::size_t i = 0; i < items.size(); ++i)
      for (const NodeIndex n : items[i].nodes) works[i] |= position[n] != no_index;
    const auto each = [&](auto&& f) {
      for (std::uint32_t i = 0; i < items.size(); ++i) {
        if (!works[i]) continue;
        const auto& n = items[i].nodes;
        for (std::size_t k = 0; k < n.size(); ++k)
          if (std::find(n.begin(), n.begin() + static_cast<std::ptrdiff_t>(k), n[k]) ==
              n.begin() + static_cast<std::ptrdiff_t>(k))
            f(n[k], i);
      }
    };
    each([&](NodeIndex n, std::uint32_t) { ++start[n + 1]; });
    for (std::size_t n = 0; n < nodes; ++n) start[n + 1] += start[n];
    item.resize(start[nodes]);
    std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
    each([&](NodeIndex n, std::uint32_t i) { item[fill[n]++] = i; });
  }
};

/// What is left of the room for removal lists.
class Room {
 public:
  explicit Room(const MemoryLimits& limits) : left_(limits.pair_bytes / sizeof(std::uint32_t)) {}
  bool take(std::size_t entries) {
    if (entries > left_) return false;
    left_ -= entries;
    return true;
  }

 private:
  std::uint64_t left_;
};

/// Distances along the mesh from one item, with stamps so that nothing is cleared between items.
struct Front {
  explicit Front(std::size_t nodes, std::size_t items)
      : dist(nodes, infinity), expanded(nodes, 0), met(items, 0) {}
  std::vector<double> dist;
  std::vector<std::uint64_t> expanded;  // ring in which a node was expanded
  std::vector<std::uint64_t> met;       // ring in which an item was met first
  std::vector<NodeIndex> touched;
  std::vector<std::uint32_t> front, next;
  std::uint64_t ring = 0, first_ring = 0;

  void start(std::uint32_t i, const NodeIndex* nodes, std::size_t count) {
    for (const NodeIndex n : touched) dist[n] = infinity;
    touched.clear();
    for (std::size_t k = 0; k < count; ++k) set(nodes[k], 0);
    front.assign(1, i);
    first_ring = ++ring;
    met[i] = ring;
  }
  void set(NodeIndex n, double d) {
    if (!(d < dist[n])) return;  // a node that no path reaches passes rings on, not distances
    if (dist[n] == infinity) touched.push_back(n);
    dist[n] = d;
  }
};

}  // namespace

bool curvilinear_removal(const SceneContext& c, const Contact& contact, RemovalLists& removed) {
  removed.clear();
  if (contact.irem_gap != 2) return true;
  const Coordinates& x = c.scene.coordinates;
  const std::size_t nodes = x.x.size();
  std::vector<std::uint32_t> position(nodes, no_index);
  double thickest = 0, longest = 0;
  for (std::uint32_t i = 0; i < contact.secondary.size(); ++i) {
    const SecondaryNode& s = contact.secondary[i];
    position[s.node] = i;
    thickest = std::max(thickest, s.gap);
    longest = std::max(longest, s.length);
  }
  const NodeItems at_node(nodes, contact.main, position);
  if (at_node.item.empty()) return true;
  const double shortest = contact.shortest_side;
  removed.resize(contact.main.size());
  Room room(c.scene.limits);
  Front f(nodes, contact.main.size());
  for (std::uint32_t i = 0; i < contact.main.size(); ++i) {
    const MainSegment& main = contact.main[i];
    double reach = contact.gapmin;
    if (contact.igap != 0) {
      reach = main.gap + thickest;
      if (contact.igap == 3) reach = std::min(reach, main.length + longest);
    }
    const double limit = root2 * std::max(reach, contact.drad);
    f.start(i, main.nodes.data(), 4);
    double lower = 0;
    bool any = false;
    while (lower + shortest <= limit && !f.front.empty()) {
      any = true;
      lower = infinity;
      ++f.ring;
      f.next.clear();
      for (const std::uint32_t q : f.front) {
        const auto& qn = contact.main[q].nodes;
        for (const NodeIndex a : qn) {
          if (f.expanded[a] == f.ring) continue;
          f.expanded[a] = f.ring;
          for (std::uint32_t k = at_node.start[a]; k < at_node.start[a + 1]; ++k) {
            const std::uint32_t r = at_node.item[k];
            if (f.met[r] >= f.first_ring && f.met[r] != f.ring) continue;
            if (f.met[r] != f.ring) f.next.push_back(r);
            f.met[r] = f.ring;
            for (const NodeIndex b : contact.main[r].nodes) {
              if (position[b] == no_index || std::find(qn.begin(), qn.end(), b) != qn.end())
                continue;
              f.set(b, f.dist[a] + distance(x, a, b));
              lower = std::min(lower, f.dist[b]);
            }
          }
        }
      }
      std::swap(f.front, f.next);
    }
    if (!any) continue;
    for (const NodeIndex b : f.touched) {
      if (position[b] == no_index) continue;
      if (std::find(main.nodes.begin(), main.nodes.end(), b) != main.nodes.end()) continue;
      const SecondaryNode& s = contact.secondary[position[b]];
      double bound = limit;
      if (contact.igap != 0)
        bound = root2 *
                std::max(contact.drad, contact.gap_rule(s.gap, main.gap, s.length, main.length));
      if (f.dist[b] <= bound) removed[i].push_back(position[b]);
    }
    std::sort(removed[i].begin(), removed[i].end());
    if (!room.take(removed[i].size())) return false;
  }
  return true;
}

bool curvilinear_edge_removal(const SceneContext& c, const Contact& contact,
                              RemovalLists& removed) {
  removed.clear();
  if (contact.irem_gap != 2) return true;
  const Coordinates& x = c.scene.coordinates;
  const std::size_t nodes = x.x.size();
  std::vector<std::uint32_t> position(nodes, no_index);
  for (const ContactEdge& e : contact.secondary_edges)
    for (const NodeIndex n : e.nodes) position[n] = 0;
  // Reached main edges are looked up among the secondary edges by their nodes.
  std::vector<std::pair<std::array<NodeIndex, 2>, std::uint32_t>> lookup;
  for (std::uint32_t i = 0; i < contact.secondary_edges.size(); ++i) {
    std::array<NodeIndex, 2> n = contact.secondary_edges[i].nodes;
    if (n[0] > n[1]) std::swap(n[0], n[1]);
    lookup.emplace_back(n, i);
  }
  std::sort(lookup.begin(), lookup.end());
  const NodeItems at_node(nodes, contact.main_edges, position);
  if (at_node.item.empty()) return true;
  const double reach = root2 * contact.max_gap;
  removed.resize(contact.main_edges.size());
  Room room(c.scene.limits);
  Front f(nodes, contact.main_edges.size());
  const auto point = [&](NodeIndex n) { return Point3<double>{x.x[n], x.y[n], x.z[n]}; };
  const auto apart = [&](const ContactEdge& a, const ContactEdge& b) {
    return closest_between_edges<Form::reference>(point(a.nodes[0]), point(a.nodes[1]),
                                                  point(b.nodes[0]), point(b.nodes[1]))
        .distance;
  };
  std::vector<std::uint32_t> reached;
  for (std::uint32_t i = 0; i < contact.main_edges.size(); ++i) {
    const ContactEdge& main = contact.main_edges[i];
    f.start(i, main.nodes.data(), 2);
    reached.clear();
    while (!f.front.empty()) {
      ++f.ring;
      f.next.clear();
      for (const std::uint32_t q : f.front) {
        const ContactEdge& edge = contact.main_edges[q];
        const bool near = std::min(f.dist[edge.nodes[0]], f.dist[edge.nodes[1]]) <= reach;
        if (!near && !(apart(edge, main) < reach)) continue;
        for (const NodeIndex a : edge.nodes) {
          if (f.expanded[a] == f.ring) continue;
          f.expanded[a] = f.ring;
          for (std::uint32_t k = at_node.start[a]; k < at_node.start[a + 1]; ++k) {
            const std::uint32_t r = at_node.item[k];
            if (f.met[r] >= f.first_ring && f.met[r] != f.ring) continue;
            if (f.met[r] != f.ring) {
              f.next.push_back(r);
              reached.push_back(r);
            }
            f.met[r] = f.ring;
            for (const NodeIndex b : contact.main_edges[r].nodes)
              if (b != a && position[b] != no_index) f.set(b, f.dist[a] + distance(x, a, b));
          }
        }
      }
      std::swap(f.front, f.next);
    }
    for (const std::uint32_t r : reached) {
      const ContactEdge& edge = contact.main_edges[r];
      const bool common = edge.nodes[0] == main.nodes[0] || edge.nodes[0] == main.nodes[1] ||
                          edge.nodes[1] == main.nodes[0] || edge.nodes[1] == main.nodes[1];
      if (common) continue;
      double bound = reach;
      if (contact.igap != 0)
        bound = root2 * std::max({contact.drad, contact.gapmin,
                                  contact.gap_rule(edge.gap, main.gap, edge.length, main.length)});
      const double along = std::min(f.dist[edge.nodes[0]], f.dist[edge.nodes[1]]);
      if (!(along <= bound) && !(apart(edge, main) < bound)) continue;
      std::array<NodeIndex, 2> n = edge.nodes;
      if (n[0] > n[1]) std::swap(n[0], n[1]);
      const auto it = std::lower_bound(lookup.begin(), lookup.end(), std::pair{n, 0u});
      if (it != lookup.end() && it->first == n) removed[i].push_back(it->second);
    }
    std::sort(removed[i].begin(), removed[i].end());
    if (!room.take(removed[i].size())) return false;
  }
  return true;
}

}  // namespace deck::detail
