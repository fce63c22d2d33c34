// TYPE25: pairs of nodes and segments, and the choice among a node's pairs. facet_rule.hpp has the
// rule, pair25.cpp evaluates one pair in double.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/shared/parallel.hpp"
#include "contact/search/sweep.hpp"
#include "contact/shared/sides.hpp"
#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

constexpr std::uint64_t most_removals = std::uint64_t{1} << 28;

/// The solver's grid. One cell size for all nodes: it can lose far pairs of solids. For sheets it
/// loses nothing, and one cell suffices.
class SolverGrid {
 public:
  SolverGrid(const Coordinates& x, const Sides& s, const SearchLists& lists) {
    if (!s.solids) return;
    std::vector<std::uint8_t> on_main(x.x.size(), 0);
    Box main, all;
    std::size_t count = 0;
    for (const Quad& nodes : lists.segments)
      for (const NodeIndex n : nodes) {
        if (std::exchange(on_main[n], 1) != 0) continue;
        ++count;
        main.add(at(x, n));
      }
    main.widen(s.margin + s.largest);
    all = main;
    for (const SideNode& n : s.nodes) all.add(at(x, n.node));
    n_.low = all.low;
    auto& size = n_.size;
    for (std::size_t k = 0; k < 3; ++k) size[k] = all.high[k] - all.low[k];
    const double area = size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    const double density = area > 0 ? 0.75 * std::sqrt(static_cast<double>(count) / area) : 0;
    for (std::size_t k = 0; k < 3; ++k) n_.cells[k] = std::max(1.0, std::round(size[k] * density));
  }
  const SearchGrid& numbers() const { return n_; }
  /// Largest round-off of a coordinate on its way to a cell.
  double blur() const { return 0x1p-48 * std::max({n_.size[0], n_.size[1], n_.size[2]}); }

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

  /// True if the box covers the point, moved nearer by `by`.
  bool covers(const Box& box, const Vec& p, double by = 0) const {
    const double v[] = {p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k)
      if (cell(k, v[k] + by) < cell(k, box.low[k]) || cell(k, v[k] - by) > cell(k, box.high[k]))
        return false;
    return true;
  }

 private:
  double cell(std::size_t k, double v) const {
    const double share =
        n_.size[k] > 0 ? std::trunc(n_.cells[k] * (v - n_.low[k]) / n_.size[k]) : 0;
    return std::max(1.0, 2 + std::min(n_.cells[k], share));
  }
  SearchGrid n_;
};

SolverGrid::Box box_of(const Coordinates& x, const Face& f) {
  SolverGrid::Box box;
  for (const NodeIndex n : f.nodes) box.add(at(x, n));
  return box;
}

/// Search distance behind solids, by secondary node: half its longest adjacent side.
struct SolidReach {
  std::vector<double> of_node;
  double grid = 0;  ///< common value in the grid
};

SolidReach reach_of(const Coordinates& x, const Sides& s) {
  SolidReach out;
  out.of_node.assign(s.nodes.size(), 0);
  if (!s.solids || (s.set.inacti != 5 && s.set.inacti != -1)) return out;
  std::vector<double> longest(x.x.size(), 0);
  std::vector<std::uint8_t> on_solid(x.x.size(), 0);
  for (const Face& f : s.faces) {
    if (f.solid_like())
      for (const NodeIndex n : f.nodes) on_solid[n] = 1;
    if (!(f.stiffness > 0) && !(f.opposite != no_index && f.back_stiffness > 0)) continue;
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

/// Igap 2: removes pairs near along the mesh.
bool remove_near(SceneContext& c, const Sides& s, RemovalLists& lists) {
  if (s.set.igap != 2) return true;
  const Coordinates& x = c.scene.coordinates;
  std::vector<std::uint8_t> bits(x.x.size(), 0);
  for (const SideNode& n : s.nodes) bits[n.node] = n.bits;
  SearchLists of = search_lists(s);
  bool any = false;
  double shortest = std::numeric_limits<double>::infinity();
  std::vector<std::uint8_t> secondary(x.x.size(), 0);
  for (const SideNode& n : s.nodes) secondary[n.node] = 1;
  for (const Face& f : s.faces)
    for (std::size_t k = 0; k < 4; ++k) {
      const NodeIndex a = f.nodes[k], b = f.nodes[(k + 1) % 4];
      any = any || (secondary[a] != 0 && s.across(bits[a], f.bits));
      if (a != b) shortest = std::min(shortest, distance(x, a, b));
    }
  if (!any) return true;
  for (const std::uint32_t i : s.mirrors) {
    of.segments.push_back(mirrored(s.faces[i].nodes));
    of.gaps.push_back(s.faces[i].gap);
  }
  of.searched.clear();
  const std::vector<double> of_nodes(of.nodes.size(), no_limit), lengths(of.gaps.size(), no_limit);
  NodeSegmentInput in = input_of(x, of);
  in.secondary_length = of_nodes;
  in.segment_length = lengths;
  const RemovalGaps rule{PairGap::from_igap(1, 0), 1, 0, s.largest, shortest};
  return remove_along_mesh(in, rule, most_removals, lists);
}

/// Search lists for all pairs that the solver could consider.
SearchLists lists_of(const Sides& s, const SolidReach& reach) {
  SearchLists out = search_lists(s);
  if (s.solids)
    for (std::size_t i = 0; i < s.nodes.size(); ++i)
      out.node_gaps[i] += std::max(0.0, reach.of_node[i] - s.margin);
  for (std::size_t i = 0; i < s.faces.size(); ++i)
    if (s.faces[i].interior) out.searched[i] = 0;
  return out;
}

/// A pair that the solver considers, with a segment or its opposite.
struct FaceCandidate {
  std::uint32_t face = 0;
  unsigned facets = all_facets;
  double least = 0;  ///< lower bound of the distance
  double slack = 0;  ///< bound of the round-off of lengths
  PairConsidered considered;
};

/// Doubts about the chosen pair of a node, and the pairs that exact arithmetic may choose.
class DoubtfulPairs {
 public:
  /// A pair that was not evaluated.
  void add(const FaceCandidate& pair) {
    if (pair.considered.exact) open_.push_back(pair);
  }
  void add(const FaceCandidate& pair, const PairFigures& p, bool counts) {
    const double distance = std::sqrt(p.distance_squared);
    const bool sure = !p.doubtful && !p.other_facets;
    if (p.doubtful)
      least_doubtful_ = std::min(least_doubtful_, distance - pair.slack);
    else if (counts)
      rivals_.push_back({distance - pair.slack, p.penetration > 0});
    if (counts || !sure) add(pair);
    if (counts && sure && pair.considered.exact) most_ = std::min(most_, distance + pair.slack);
  }
  /// False for pairs that cannot decide: beyond one that certainly counts, or all that penetrate.
  bool is_near(const FaceCandidate& pair) const { return !(pair.least > most_); }
  const std::vector<FaceCandidate>& open() const { return open_; }
  /// True if another pair may be chosen, or the chosen one may be misjudged.
  bool any(bool found, double distance, double slack, bool penetrates) const {
    if (!found) return least_doubtful_ < no_limit;
    return least_doubtful_ <= distance + slack ||
           std::any_of(rivals_.begin(), rivals_.end(), [&](const Rival& r) {
             return r.penetrates != penetrates && r.least <= distance + slack;
           });
  }
  /// `most`: no pair beyond this distance penetrates.
  void begin(double most) {
    open_.clear();
    rivals_.clear();
    least_doubtful_ = no_limit;
    most_ = most;
  }

 private:
  struct Rival {
    double least = 0;
    bool penetrates = false;
  };
  std::vector<FaceCandidate> open_;
  std::vector<Rival> rivals_;
  double least_doubtful_ = no_limit, most_ = no_limit;
};

class PairChooser {
 public:
  PairChooser(SceneContext& c, const Sides& s, const Topology& t, const SolidReach& reach,
              const RemovalLists& removed, const SearchLists& lists)
      : accuracy_(c.options.accuracy),
        decides_(accuracy_ >= Accuracy::robust && c.all_placed),
        x_(c.scene.coordinates),
        model_(c.model),
        connectivity_(c.connectivity),
        s_(s),
        t_(t),
        reach_(reach),
        removed_(removed),
        grid_(x_, s, lists) {
    for (const SideNode& n : s.nodes) gap_s_ = std::max(gap_s_, n.gap);
  }

  /// If the solver pairs a node and a segment or its opposite. Sets `open` if it may
  /// penetrate, `both` if the result is valid for the opposite too, except for stiffness.
  PairConsidered candidate(std::uint32_t node, std::uint32_t face, const sweep::NearDistance& near,
                           bool& open, bool& both) const {
    const SideNode& n = s_.nodes[node];
    const bool mirror = s_.is_mirror(face);
    const Face& f = s_.faces[s_.base(face)];
    if (f.interior || (mirror ? f.back_stiffness : f.stiffness) == 0) return {};
    const bool solid = f.solid_like();
    if (mirror && solid) return {};  // inside of a coat
    if (!s_.across(n.bits, f.bits)) return {};
    const double gap = n.gap + f.gap;
    if (!solid && !s_.set.local() && near.distance + near.slack < gap + s_.margin) {
      // Within the reach from all sides, and within the reach of the grid, which uses the largest
      // gap.
      both = true;
      open = open || !(near.distance - near.slack > gap);
      return {true, true};
    }
    if (!solid && near.distance - near.slack >= gap + s_.margin) return {};
    if (solid && same_part(n.node, f)) return {};
    return considered(node, s_.face(face), near, open);
  }
  bool removed(const CandidatePair& pair) const { return is_removed(removed_, pair); }

  /// Chosen pair of a node among candidates by ascending segments; penetration 0 if none.
  NodePenetration choose(std::uint32_t node, std::span<const FaceCandidate> pairs,
                         DoubtfulPairs& doubts, DecisionReport& decisions) const {
    const bool adhesion = s_.set.ivis2 == -1;
    NodePenetration best;
    double best_d = 0, best_slack = 0;
    bool found = false, unsure = false;
    bool any_distance = adhesion;  // is a penetration possible
    double gap = 0;
    for (const FaceCandidate& pair : pairs) {
      const Face f = s_.face(pair.face);
      any_distance = any_distance || f.solid_like();
      gap = std::max(gap, s_.nodes[node].gap + f.gap);
    }
    doubts.begin(any_distance ? no_limit : gap * rounding);
    for (const FaceCandidate& pair : pairs) {
      unsure = unsure || pair.considered.differs();
      if (!pair.considered.solver) {
        doubts.add(pair);
        continue;
      }
      if (found && !adhesion && (decides_ ? !doubts.is_near(pair) : pair.least > best.distance))
        continue;
      ++decisions.pairs;
      const SideNode& n = s_.nodes[node];
      const PairFigures p =
          evaluate_pair(x_, s_, t_, n, pair.face, pair.facets, decides_ ? pair.slack : -1);
      const SegmentKind kind = kind_of(pair.face);
      const bool sheet = kind == SegmentKind::shell;
      const bool out = (p.excluded && (adhesion || kind != SegmentKind::solid)) ||
                       (sheet && (p.behind > 0 || (adhesion && p.penetration == 0)));
      const double limit = adhesion ? best.penetration : best_d;
      if (adhesion) {
        unsure = unsure || is_unsure(p, pair.slack, found, limit, best_slack);
        doubts.add(pair);
      } else if (decides_) {
        doubts.add(pair, p, !out);
      }
      if (out || (found && p.distance_squared > limit)) continue;
      found = true;
      best_d = p.distance_squared;
      best_slack = pair.slack;
      best.node = node;
      best.face = pair.face;
      best.penetration = adhesion ? std::max(0.0, p.penetration - 0.5 * p.gap) : p.penetration;
      best.gap = p.gap;
      best.distance = std::sqrt(p.distance_squared);
      best.normal = p.normal;
    }
    if (!decides_) return best;
    const bool penetrates = best.penetration > 0;
    if (accuracy_ == Accuracy::exact || unsure ||
        doubts.any(found, best.distance, best_slack, penetrates))
      decide(node, doubts, best, decisions);
    return best;
  }
  /// Kind of a segment or its opposite: a shell's opposite is a shell.
  SegmentKind kind_of(std::uint32_t face) const { return s_.faces[s_.base(face)].kind; }

 private:
  /// The gap of a point on a segment is at most that of its corners, except for round-off.
  static constexpr double rounding = 1 + 1e-12;
  /// By the reach of the pair, the box of the segment and the grid.
  PairConsidered considered(std::uint32_t node, const Face& f, const sweep::NearDistance& near,
                            bool& open) const {
    const SideNode& n = s_.nodes[node];
    const bool solid = f.solid_like();
    const double far = solid ? std::max(s_.margin, reach_.of_node[node]) : s_.margin;
    const double in_cells = solid ? std::max(s_.margin, reach_.grid) : s_.margin;
    const double by = near.slack;
    const Vec q = at(x_, n.node);
    SolverGrid::Box box = box_of(x_, f), covered = box;
    box.widen(n.gap + f.gap + far);
    covered.widen(gap_s_ + f.gap + in_cells);
    if (!wider(box, by).holds(q)) return {};
    const double most = s_.set.local() ? n.length + f.length : no_limit,
                 gap = std::min(n.gap + f.gap, most), r = gap + far,
                 d = facet_distance_squared(x_, f, n.node);
    PairConsidered out;
    out.solver = out.exact = box.holds(q) && d < r * r && grid_.covers(covered, q);
    const double blur = by + grid_.blur();
    const bool sure =
        by < no_limit && (near.distance - by > r || !grid_.covers(wider(covered, blur), q, blur) ||
                          (near.distance + by < r && wider(box, -by).holds(q) &&
                           grid_.covers(wider(covered, -blur), q, -blur)));
    if (decides_ && !sure) {
      SearchRule rule{q, {}, f.triangle(), {n.gap, f.gap, far}, {gap_s_, f.gap, in_cells}, most};
      for (std::size_t k = 0; k < 4; ++k) rule.corner[k] = at(x_, f.nodes[k]);
      out.exact = is_considered(rule, grid_.numbers());
    }
    if (out.solver || out.exact)
      open = open || solid || !(by < no_limit) || !(d >= gap * gap * rounding);
    return out;
  }
  static SolverGrid::Box wider(SolverGrid::Box box, double by) {
    box.widen(by);
    return box;
  }

  /// IVIS2 -1: true if round-off may change the node's state at this pair. `most`: largest squared
  /// distance that replaces the pair before, if there is one.
  bool is_unsure(const PairFigures& p, double slack, bool found, double most,
                 double slack_before) const {
    if (p.doubtful || p.other_facets) return true;
    const double by = 8 * std::max(slack, slack_before);
    return std::fabs(p.penetration - 0.5 * p.gap) <= by ||
           (found &&
            std::fabs(p.distance_squared - most) <= by * (1 + by + std::sqrt(p.distance_squared)));
  }

  /// In exact arithmetic. If the solver's segment has a penetration there, too, it stays.
  void decide(std::uint32_t node, const DoubtfulPairs& doubts, NodePenetration& best,
              DecisionReport& decisions) const {
    std::vector<FacetRule> rules;
    std::vector<std::uint32_t> faces;
    for (const FaceCandidate& pair : doubts.open()) {
      if (!doubts.is_near(pair)) continue;
      rules.push_back(facet_rule(x_, s_, t_, s_.nodes[node], pair.face));
      faces.push_back(pair.face);
    }
    if (!std::all_of(rules.begin(), rules.end(), [](const FacetRule& r) { return is_finite(r); }))
      return;
    decisions.fallback += rules.size();
    decisions.exact += rules.size();
    best.solver_acts = best.penetration > 0;
    const std::optional<ExactChoice> exact =
        exact_choice(rules, best.solver_acts, s_.set.ivis2 == -1);
    best.in_contact = exact && exact->penetrates;
    best.solver_distance = best.distance;
    best.exact_distance = exact ? exact->distance : best.distance;
    if (best.in_contact && (!best.solver_acts || accuracy_ == Accuracy::exact)) {
      best.node = node;
      best.face = faces[exact->pair];
      best.penetration = exact->depth;
      best.gap = exact->gap;
      best.distance = exact->distance;
      best.normal = evaluate_pair(x_, s_, t_, s_.nodes[node], best.face).normal;
    }
  }

  /// True if a solid at the node has the part of the solid behind the segment.
  bool same_part(NodeIndex n, const Face& f) const {
    if (f.solid == no_index) return false;
    const auto& part = model_.solid8.part;
    const auto around = connectivity_.elements(ElementKind::solid8, n);
    return std::any_of(around.begin(), around.end(),
                       [&](std::uint32_t e) { return part[e] == part[f.solid]; });
  }

  Accuracy accuracy_;
  bool decides_;
  const Coordinates& x_;
  const Model& model_;
  Connectivity& connectivity_;
  const Sides& s_;
  const Topology& t_;
  const SolidReach& reach_;
  const RemovalLists& removed_;
  SolverGrid grid_;
  double gap_s_ = 0;
};

class NodeByNode {
 public:
  NodeByNode(const PairChooser& chooser, const Sides& s, const NodeSegmentInput& in)
      : chooser_(chooser), s_(s), in_(in) {}

  /// All pairs of a node, by ascending segments.
  NodePenetration choose(std::span<const CandidatePair> near) {
    near_.resize(near.size());
    sweep::kernels().distances(in_, near, near_.data());
    pairs_.clear();
    any_open_ = false;
    both_.assign(near.size(), 0);
    for (std::size_t i = 0; i < near.size(); ++i)
      add_candidate(near[i], near[i].main, near_[i], both_[i]);
    // Their opposites have the same order.
    for (std::size_t i = 0; i < near.size(); ++i)
      if (const std::uint32_t o = s_.faces[near[i].main].opposite; o != no_index)
        add_candidate(near[i], o, near_[i], both_[i]);
    found.candidates += counted_;
    counted_ = 0;
    // Without an open pair none penetrates, whichever is the nearest.
    if (!any_open_) return {};
    return chooser_.choose(near.front().secondary, pairs_, doubts_, found.decisions);
  }
  NodeSearch found;

 private:
  void add_candidate(const CandidatePair& pair, std::uint32_t face, const sweep::NearDistance& near,
                     std::uint8_t& both) {
    bool open = false, same = false;
    const bool mirror = s_.is_mirror(face);
    PairConsidered considered{true, true};
    if (both == 0)
      considered = chooser_.candidate(pair.secondary, face, near, open, same);
    else if (s_.faces[pair.main].back_stiffness == 0)
      return;
    if (!considered.solver && !considered.exact) return;
    both = same ? 1 : 0;
    any_open_ = any_open_ || open;
    if (chooser_.removed({pair.secondary, face})) {
      found.removed += considered.solver ? 1 : 0;
      return;
    }
    counted_ += considered.solver ? 1 : 0;
    // Sheets act on their front only.
    const int side = mirror ? -near.side : near.side;
    if (side < 0 && chooser_.kind_of(face) == SegmentKind::shell) return;
    unsigned facets = near.nearest;
    if (mirror) facets = (facets & 5U) | (facets >> 2 & 2U) | (facets << 2 & 8U);
    pairs_.push_back({face, facets, near.distance - near.slack, near.slack, considered});
  }

  const PairChooser& chooser_;
  const Sides& s_;
  const NodeSegmentInput& in_;
  std::vector<sweep::NearDistance> near_;
  std::vector<FaceCandidate> pairs_;
  std::vector<std::uint8_t> both_;  ///< 1: the result of the segment is valid for its opposite
  DoubtfulPairs doubts_;
  std::uint64_t counted_ = 0;
  bool any_open_ = false;
};

}  // namespace

void NodeSearch::add(NodeSearch part) {
  if (penetrations.empty())
    penetrations = std::move(part.penetrations);
  else
    penetrations.insert(penetrations.end(), part.penetrations.begin(), part.penetrations.end());
  candidates += part.candidates;
  removed += part.removed;
  decisions.pairs += part.decisions.pairs;
  decisions.fallback += part.decisions.fallback;
  decisions.exact += part.decisions.exact;
}

NodeSearch find_nodes25(SceneContext& c, const Sides& s, const Topology& t) {
  NodeSearch out;
  const SolidReach reach = reach_of(c.scene.coordinates, s);
  RemovalLists removal;
  out.complete = remove_near(c, s, removal);
  if (!out.complete) return out;
  const int threads = effective_threads(c.options.threads);
  const SearchLists lists = lists_of(s, reach);
  const PairsByNode near = near_faces(c, s, lists);
  out.complete = near.complete();
  if (!out.complete) return out;
  c.connectivity.prepare(ElementKind::solid8);
  const PairChooser chooser(c, s, t, reach, removal, lists);
  const NodeSegmentInput in = input_of(c.scene.coordinates, lists);
  std::vector<NodeSearch> parts(static_cast<std::size_t>(threads));
  parallel_parts(threads, s.nodes.size(),
                 [&](std::size_t part, std::size_t begin, std::size_t end) {
                   NodeByNode nodes(chooser, s, in);
                   nodes.found.penetrations.reserve(end - begin);
                   near.for_each_node(begin, end, [&](std::span<const CandidatePair> pairs) {
                     const NodePenetration p = nodes.choose(pairs);
                     if (p.penetration != 0) nodes.found.penetrations.push_back(p);
                   });
                   parts[part] = std::move(nodes.found);
                 });
  for (NodeSearch& part : parts) out.add(std::move(part));
  return out;
}

}  // namespace deck::detail::type24_25
