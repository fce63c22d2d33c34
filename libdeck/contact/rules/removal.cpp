// Finds pairs that Irem_gap = 2 removes: secondary items near a main item along the mesh.
// A walk starts at each main item. Ring by ring, every front item passes the distances of its nodes
// to the nodes of adjacent items, in straight lines. The walk ends when the smallest distance of a
// ring plus the shortest side exceeds sqrt(2) gaps. Cost: items within that distance, per main
// item.
#include "contact/shared/sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/shared/vec.hpp"
#include "contact/shared/closest.hpp"

namespace deck::detail {
namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();
constexpr std::uint32_t no_position = 0xffffffff;
const double root2 = std::sqrt(2.0);

double side_length(const NodeArrays& x, std::uint32_t a, std::uint32_t b) {
  return norm(Vec{x.x[b] - x.x[a], x.y[b] - x.y[a], x.z[b] - x.z[a]});
}

/// node -> main items with this node and at least one secondary node.
struct NodeItems {
  std::vector<std::uint32_t> start, item;
  template <std::size_t N>
  NodeItems(std::size_t nodes, std::span<const std::array<std::uint32_t, N>> items,
            const std::vector<std::uint32_t>& position)
      : start(nodes + 1, 0) {
    std::vector<std::uint8_t> works(items.size(), 0);
    for (std::size_t i = 0; i < items.size(); ++i)
      for (const std::uint32_t n : items[i]) works[i] |= position[n] != no_position;
    const auto for_each_item = [&](auto&& f) {
      for (std::uint32_t i = 0; i < items.size(); ++i) {
        if (!works[i]) continue;
        const auto& n = items[i];
        for (std::size_t k = 0; k < n.size(); ++k)
          if (std::find(n.begin(), n.begin() + static_cast<std::ptrdiff_t>(k), n[k]) ==
              n.begin() + static_cast<std::ptrdiff_t>(k))
            f(n[k], i);
      }
    };
    for_each_item([&](std::uint32_t n, std::uint32_t) { ++start[n + 1]; });
    for (std::size_t n = 0; n < nodes; ++n) start[n + 1] += start[n];
    item.resize(start[nodes]);
    std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
    for_each_item([&](std::uint32_t n, std::uint32_t i) { item[fill[n]++] = i; });
  }
};

/// Remaining memory for removal lists.
class EntryAllowance {
 public:
  explicit EntryAllowance(std::uint64_t entries) : left_(entries) {}
  bool reserve(std::size_t entries) {
    if (entries > left_) return false;
    left_ -= entries;
    return true;
  }

 private:
  std::uint64_t left_;
};

/// Distances along the mesh from one item. Marks carry its number: tables are not cleared.
struct MeshWalk {
  explicit MeshWalk(std::size_t nodes, std::size_t items)
      : dist(nodes, unreached), expanded(nodes, 0), met(items, 0) {}
  std::vector<double> dist;
  std::vector<std::uint64_t> expanded;  // ring of the node
  std::vector<std::uint64_t> met;       // ring in which an item was met first
  std::vector<std::uint32_t> touched;
  std::vector<std::uint32_t> front, next;
  std::uint64_t ring = 0, first_ring = 0;

  void start(std::uint32_t i, const std::uint32_t* nodes, std::size_t count) {
    for (const std::uint32_t n : touched) dist[n] = unreached;
    touched.clear();
    for (std::size_t k = 0; k < count; ++k) set(nodes[k], 0);
    front.assign(1, i);
    first_ring = ++ring;
    met[i] = ring;
  }
  void set(std::uint32_t n, double d) {
    if (!(d < dist[n])) return;  // a node without a shorter path passes rings on, but no distances
    if (dist[n] == unreached) touched.push_back(n);
    dist[n] = d;
  }
};

}  // namespace

bool is_removed(const RemovalLists& lists, const CandidatePair& pair) {
  if (lists.empty()) return false;
  const auto& list = lists[pair.main];
  return std::binary_search(list.begin(), list.end(), pair.secondary);
}

bool remove_along_mesh(const NodeSegmentInput& in, const RemovalGaps& gaps,
                       std::uint64_t most_entries, RemovalLists& lists) {
  lists.clear();
  const std::size_t nodes = in.nodes.x.size();
  std::vector<std::uint32_t> position(nodes, no_position);
  double thickest = 0, longest = 0;
  for (std::uint32_t i = 0; i < in.secondary.size(); ++i) {
    position[in.secondary[i]] = i;
    thickest = std::max(thickest, in.secondary_gap[i]);
    longest = std::max(longest, sweep::at(in.secondary_length, i, 0));
  }
  const NodeItems at_node(nodes, in.segments, position);
  if (at_node.item.empty()) return true;
  lists.resize(in.segments.size());
  EntryAllowance room(most_entries);
  MeshWalk f(nodes, in.segments.size());
  for (std::uint32_t i = 0; i < in.segments.size(); ++i) {
    const auto& own = in.segments[i];
    const double gap = in.segment_gap[i], length = sweep::at(in.segment_length, i, 0);
    double reach = gaps.rule.gapmin;
    if (gaps.igap != 0) {
      reach = gap + thickest;
      if (gaps.igap == 3) reach = std::min(reach, length + longest);
    }
    const double limit = root2 * std::max(reach, gaps.drad);
    f.start(i, own.data(), 4);
    double lower = 0;
    bool any = false;
    while (lower + gaps.shortest_side <= limit && !f.front.empty()) {
      any = true;
      lower = unreached;
      ++f.ring;
      f.next.clear();
      for (const std::uint32_t q : f.front) {
        const auto& qn = in.segments[q];
        for (const std::uint32_t a : qn) {
          if (f.expanded[a] == f.ring) continue;
          f.expanded[a] = f.ring;
          for (std::uint32_t k = at_node.start[a]; k < at_node.start[a + 1]; ++k) {
            const std::uint32_t r = at_node.item[k];
            if (f.met[r] >= f.first_ring && f.met[r] != f.ring) continue;
            if (f.met[r] != f.ring) f.next.push_back(r);
            f.met[r] = f.ring;
            for (const std::uint32_t b : in.segments[r]) {
              if (position[b] == no_position || std::find(qn.begin(), qn.end(), b) != qn.end())
                continue;
              f.set(b, f.dist[a] + side_length(in.nodes, a, b));
              lower = std::min(lower, f.dist[b]);
            }
          }
        }
      }
      std::swap(f.front, f.next);
    }
    if (!any) continue;
    for (const std::uint32_t b : f.touched) {
      const std::uint32_t s = position[b];
      if (s == no_position || std::find(own.begin(), own.end(), b) != own.end()) continue;
      double bound = limit;
      if (gaps.igap != 0)
        bound =
            root2 * std::max(gaps.drad, gaps.rule(in.secondary_gap[s], gap,
                                                  sweep::at(in.secondary_length, s, 0), length));
      if (f.dist[b] <= bound) lists[i].push_back(s);
    }
    std::sort(lists[i].begin(), lists[i].end());
    if (!room.reserve(lists[i].size())) return false;
  }
  return true;
}

bool remove_along_mesh(const EdgeEdgeInput& in, const RemovalGaps& gaps, std::uint64_t most_entries,
                       RemovalLists& lists) {
  lists.clear();
  const NodeArrays& x = in.nodes;
  const std::size_t nodes = x.x.size();
  std::vector<std::uint32_t> position(nodes, no_position);
  for (const auto& e : in.secondary)
    for (const std::uint32_t n : e) position[n] = 0;
  // Finds reached main edges among the secondary edges by their nodes.
  std::vector<std::pair<std::array<std::uint32_t, 2>, std::uint32_t>> lookup;
  for (std::uint32_t i = 0; i < in.secondary.size(); ++i) {
    std::array<std::uint32_t, 2> n = in.secondary[i];
    if (n[0] > n[1]) std::swap(n[0], n[1]);
    lookup.emplace_back(n, i);
  }
  std::sort(lookup.begin(), lookup.end());
  const NodeItems at_node(nodes, in.main, position);
  if (at_node.item.empty()) return true;
  const double reach = root2 * gaps.largest;
  lists.resize(in.main.size());
  EntryAllowance room(most_entries);
  MeshWalk f(nodes, in.main.size());
  const auto point = [&](std::uint32_t n) { return Point3<double>{x.x[n], x.y[n], x.z[n]}; };
  const auto apart = [&](const std::array<std::uint32_t, 2>& a,
                         const std::array<std::uint32_t, 2>& b) {
    return closest_between_edges<Form::reference>(point(a[0]), point(a[1]), point(b[0]),
                                                  point(b[1]))
        .distance;
  };
  std::vector<std::uint32_t> reached;
  for (std::uint32_t i = 0; i < in.main.size(); ++i) {
    const auto& own = in.main[i];
    f.start(i, own.data(), 2);
    reached.clear();
    while (!f.front.empty()) {
      ++f.ring;
      f.next.clear();
      for (const std::uint32_t q : f.front) {
        const auto& edge = in.main[q];
        const bool near = std::min(f.dist[edge[0]], f.dist[edge[1]]) <= reach;
        if (!near && !(apart(edge, own) < reach)) continue;
        for (const std::uint32_t a : edge) {
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
            for (const std::uint32_t b : in.main[r])
              if (b != a && position[b] != no_position) f.set(b, f.dist[a] + side_length(x, a, b));
          }
        }
      }
      std::swap(f.front, f.next);
    }
    for (const std::uint32_t r : reached) {
      const auto& edge = in.main[r];
      const bool common =
          edge[0] == own[0] || edge[0] == own[1] || edge[1] == own[0] || edge[1] == own[1];
      if (common) continue;
      double bound = reach;
      if (gaps.igap != 0)
        bound = root2 *
                std::max({gaps.drad, gaps.rule.gapmin,
                          gaps.rule(in.main_gap[r], in.main_gap[i], sweep::at(in.main_length, r, 0),
                                    sweep::at(in.main_length, i, 0))});
      const double along = std::min(f.dist[edge[0]], f.dist[edge[1]]);
      if (!(along <= bound) && !(apart(edge, own) < bound)) continue;
      std::array<std::uint32_t, 2> n = edge;
      if (n[0] > n[1]) std::swap(n[0], n[1]);
      const auto it = std::lower_bound(lookup.begin(), lookup.end(), std::pair{n, 0u});
      if (it != lookup.end() && it->first == n) lists[i].push_back(it->second);
    }
    std::sort(lists[i].begin(), lists[i].end());
    if (!room.reserve(lists[i].size())) return false;
  }
  return true;
}

}  // namespace deck::detail
