// TYPE25: which nodes are paired with which segments, and which pair of each node counts.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/shared/parallel.hpp"
#include "contact/modern/parts.hpp"
#include "contact/shared/removal.hpp"

namespace deck::detail::modern {
namespace {

constexpr std::uint64_t most_removals = std::uint64_t{1} << 28;

/// The solver's grid, which can lose far pairs of solids: it takes one length for all nodes.
class Grid {
 public:
  Grid(const Coordinates& x, const Sides& s) {
    std::vector<std::uint8_t> on_main(x.x.size(), 0);
    Box main, all;
    std::size_t count = 0;
    for (const Face& f : s.faces)
      for (const NodeIndex n : f.nodes) {
        if (on_main[n] == 0) ++count;
        on_main[n] = 1;
        main.add(at(x, n));
      }
    main.widen(s.margin + s.largest);
    all = main;
    for (const SideNode& n : s.nodes) all.add(at(x, n.node));
    low_ = all.low;
    for (std::size_t k = 0; k < 3; ++k) size_[k] = all.high[k] - all.low[k];
    const double area = size_[0] * size_[1] + size_[1] * size_[2] + size_[2] * size_[0];
    const double density = area > 0 ? 0.75 * std::sqrt(static_cast<double>(count) / area) : 0;
    for (std::size_t k = 0; k < 3; ++k) cells_[k] = std::max(1.0, std::round(size_[k] * density));
  }

  struct Box {
    std::array<double, 3> low, high;
    Box() {
      low.fill(std::numeric_limits<double>::infinity());
      high.fill(-std::numeric_limits<double>::infinity());
    }
    void add(const Vec& p) {
      const double v[] = {p.x, p.y, p.z};
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], v[k]);
        high[k] = std::max(high[k], v[k]);
      }
    }
    void widen(double by) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] -= by;
        high[k] += by;
      }
    }
    bool holds(const Vec& p) const {
      const double v[] = {p.x, p.y, p.z};
      for (std::size_t k = 0; k < 3; ++k)
        if (!(v[k] >= low[k] && v[k] <= high[k])) return false;
      return true;
    }
  };

  bool covers(const Box& box, const Vec& p) const {
    const double v[] = {p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = cell(k, v[k]);
      if (c < cell(k, box.low[k]) || c > cell(k, box.high[k])) return false;
    }
    return true;
  }

 private:
  double cell(std::size_t k, double v) const {
    const double share = size_[k] > 0 ? std::trunc(cells_[k] * (v - low_[k]) / size_[k]) : 0;
    return std::max(1.0, 2 + std::min(cells_[k], share));
  }
  std::array<double, 3> low_{}, size_{}, cells_{};
};

Grid::Box box_of(const Coordinates& x, const Face& f) {
  Grid::Box box;
  for (const NodeIndex n : f.nodes) box.add(at(x, n));
  return box;
}

/// How far behind solids the solver looks, by secondary node: half the longest side around it.
struct Reach {
  std::vector<double> of_node;
  double grid = 0;  ///< what the grid takes for all
};

Reach reach_of(const Coordinates& x, const Sides& s) {
  Reach out;
  out.of_node.assign(s.nodes.size(), 0);
  if (s.set.inacti != 5 && s.set.inacti != -1) return out;
  std::vector<double> longest(x.x.size(), 0);
  std::vector<std::uint8_t> on_solid(x.x.size(), 0);
  for (const Face& f : s.faces) {
    if (f.solid_like())
      for (const NodeIndex n : f.nodes) on_solid[n] = 1;
    if (!(f.stiffness > 0)) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = f.nodes[k], b = f.nodes[(k + 1) % 4];
      const double l = distance(x, a, b);
      longest[a] = std::max(longest[a], l);
      longest[b] = std::max(longest[b], l);
    }
  }
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    const NodeIndex n = s.nodes[i].node;
    out.of_node[i] = 0.5 * longest[n];
    if (on_solid[n] == 0) continue;
    sum += out.of_node[i];
    ++count;
  }
  if (count > 0) out.grid = 0.5 * sum / static_cast<double>(count);
  return out;
}

/// Igap 2: what lies near along the mesh is not paired.
bool remove_near(SceneContext& c, const Sides& s, RemovalLists& lists) {
  if (s.set.igap != 2) return true;
  const Coordinates& x = c.scene.coordinates;
  std::vector<std::uint8_t> bits(x.x.size(), 0);
  for (const SideNode& n : s.nodes) bits[n.node] = n.bits;
  std::vector<std::uint32_t> nodes;
  std::vector<double> node_gaps, node_lengths, gaps, lengths;
  std::vector<std::array<std::uint32_t, 4>> segments;
  bool any = false;
  double shortest = std::numeric_limits<double>::infinity();
  for (const SideNode& n : s.nodes) {
    nodes.push_back(n.node);
    node_gaps.push_back(n.gap);
  }
  node_lengths.assign(nodes.size(), never);
  std::vector<std::uint8_t> secondary(x.x.size(), 0);
  for (const SideNode& n : s.nodes) secondary[n.node] = 1;
  for (const Face& f : s.faces) {
    segments.push_back(f.nodes);
    gaps.push_back(f.gap);
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = f.nodes[k], b = f.nodes[(k + 1) % 4];
      any = any || (secondary[a] != 0 && s.across(bits[a], f.bits));
      if (a != b) shortest = std::min(shortest, distance(x, a, b));
    }
  }
  lengths.assign(gaps.size(), never);
  if (!any) return true;
  NodeSegmentInput in;
  in.nodes = {x.x, x.y, x.z};
  in.secondary = nodes;
  in.secondary_gap = node_gaps;
  in.secondary_length = node_lengths;
  in.segments = segments;
  in.segment_gap = gaps;
  in.segment_length = lengths;
  const RemovalGaps rule{PairGap::from_igap(1, 0), 1, 0, s.largest, shortest};
  return remove_along_mesh(in, rule, most_removals, lists);
}

/// Every pair that the solver could look at, by node.
SearchResult search(SceneContext& c, const Sides& s, const Reach& reach) {
  std::vector<double> node_gaps, gaps, stiffness;
  const bool solids =
      std::any_of(s.faces.begin(), s.faces.end(), [](const Face& f) { return f.solid_like(); });
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    const double more = solids ? std::max(0.0, reach.of_node[i] - s.margin) : 0;
    node_gaps.push_back(s.nodes[i].gap + more);
  }
  for (const Face& f : s.faces) {
    gaps.push_back(f.gap);
    const bool off = f.interior || f.kind == SegmentKind::coat_opposite;
    stiffness.push_back(off ? 0 : f.stiffness);
  }
  return near_faces(c, s, node_gaps, gaps, stiffness);
}

class Chooser {
 public:
  Chooser(SceneContext& c, const Sides& s, const Topology& t, const Reach& reach,
          const RemovalLists& removed)
      : x_(c.scene.coordinates),
        model_(c.model),
        connectivity_(c.connectivity),
        s_(s),
        t_(t),
        reach_(reach),
        removed_(removed),
        grid_(x_, s) {
    for (const SideNode& n : s.nodes) gap_s_ = std::max(gap_s_, n.gap);
  }

  /// Whether the solver pairs them. `open`: whether it may be a penetration.
  bool candidate(const CandidatePair& pair, bool& open) const {
    const SideNode& n = s_.nodes[pair.secondary];
    const Face& f = s_.faces[pair.main];
    if (!s_.across(n.bits, f.bits)) return false;
    if (f.solid_like() && same_part(n.node, f)) return false;
    const double far =
        f.solid_like() ? std::max(s_.margin, reach_.of_node[pair.secondary]) : s_.margin;
    double gap = n.gap + f.gap;
    const Vec q = at(x_, n.node);
    Grid::Box box = box_of(x_, f);
    box.widen(gap + far);
    if (!box.holds(q)) return false;
    if (s_.set.local()) gap = std::min(gap, n.length + f.length);
    const double r = gap + far, d = facet_distance_squared(x_, f, n.node);
    if (!(d < r * r)) return false;
    // The gap of a place on the segment is the largest of its corners' at most, but for rounding.
    constexpr double rounding = 1 + 1e-12;
    open = f.solid_like() || !(d >= gap * gap * rounding);
    Grid::Box covered = box_of(x_, f);
    covered.widen(gap_s_ + f.gap + (f.solid_like() ? std::max(s_.margin, reach_.grid) : s_.margin));
    return grid_.covers(covered, q);
  }
  bool removed(const CandidatePair& pair) const { return is_removed(removed_, pair); }

  /// The pair of a node that counts, from its candidates by ascending segments; penetration 0:
  /// none.
  NodePenetration choose(std::span<const CandidatePair> pairs) const {
    const bool adhesion = s_.set.ivis2 == -1;
    NodePenetration best;
    double best_d = 0;
    bool found = false;
    for (const CandidatePair& pair : pairs) {
      const SideNode& n = s_.nodes[pair.secondary];
      const Face& f = s_.faces[pair.main];
      const PairFigures p = evaluate_pair(x_, s_, t_, n, pair.main);
      const bool sheet = f.kind == SegmentKind::shell || f.kind == SegmentKind::shell_opposite;
      if (p.excluded && (adhesion || f.kind != SegmentKind::solid)) continue;
      if (sheet && (p.behind > 0 || (adhesion && p.penetration == 0))) continue;
      const double limit = adhesion ? best.penetration : best_d;
      if (found && p.distance_squared > limit) continue;
      found = true;
      best_d = p.distance_squared;
      best.node = pair.secondary;
      best.face = pair.main;
      best.penetration = adhesion ? std::max(0.0, p.penetration - 0.5 * p.gap) : p.penetration;
      best.gap = p.gap;
      best.distance = std::sqrt(p.distance_squared);
      best.normal = p.normal;
    }
    return best;
  }

 private:
  /// A solid at the node is of the same part as the one behind the segment.
  bool same_part(NodeIndex n, const Face& f) const {
    if (f.solid == no_index) return false;
    const auto& part = model_.solid8.part;
    const auto around = connectivity_.elements(ElementKind::solid8, n);
    return std::any_of(around.begin(), around.end(),
                       [&](std::uint32_t e) { return part[e] == part[f.solid]; });
  }

  const Coordinates& x_;
  const Model& model_;
  Connectivity& connectivity_;
  const Sides& s_;
  const Topology& t_;
  const Reach& reach_;
  const RemovalLists& removed_;
  Grid grid_;
  double gap_s_ = 0;
};

}  // namespace

Found find_nodes25(SceneContext& c, const Sides& s, const Topology& t) {
  Found out;
  const Reach reach = reach_of(c.scene.coordinates, s);
  RemovalLists lists;
  const bool fits = remove_near(c, s, lists);
  const SearchResult near = fits ? search(c, s, reach) : SearchResult{};
  out.complete = fits && near.complete;
  if (!out.complete) return out;
  c.connectivity.prepare(ElementKind::solid8);
  const Chooser chooser(c, s, t, reach, lists);
  // Pieces end where a node ends, so that every node is one thread's.
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < near.pairs.size(); ++i)
    if (i == 0 || near.pairs[i].secondary != near.pairs[i - 1].secondary) first.push_back(i);
  first.push_back(near.pairs.size());
  const std::size_t nodes = first.size() - 1;
  std::vector<NodePenetration> best(nodes);
  const int threads = effective_threads(c.options.threads);
  std::vector<std::uint64_t> candidates(static_cast<std::size_t>(threads)), removed(candidates);
  parallel_parts(threads, nodes, [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::vector<CandidatePair> pairs;
    std::uint64_t kept = 0, dropped = 0;
    for (std::size_t n = begin; n < end; ++n) {
      pairs.clear();
      bool any_open = false;  // else none of them is a penetration, whichever is the nearest
      for (std::size_t i = first[n]; i < first[n + 1]; ++i) {
        bool open = false;
        if (!chooser.candidate(near.pairs[i], open)) continue;
        any_open = any_open || open;
        if (chooser.removed(near.pairs[i]))
          ++dropped;
        else
          pairs.push_back(near.pairs[i]);
      }
      kept += pairs.size();
      if (any_open) best[n] = chooser.choose(pairs);
    }
    candidates[part] = kept;
    removed[part] = dropped;
  });
  for (const NodePenetration& p : best)
    if (p.penetration != 0) out.penetrations.push_back(p);
  for (const std::uint64_t n : candidates) out.candidates += n;
  for (const std::uint64_t n : removed) out.removed += n;
  return out;
}

}  // namespace deck::detail::modern
