// Chooses the segment of each secondary node of a tie and sets the state of the node (Isearch 2).
// Candidates: node and segment in boxes widened by the search distance. For each pair the solver's
// own distance (distance.cpp) decides; the nearest segment wins, equal ones by `replaces`. Segments
// so thin that this distance is round-off are tried for every node in their box. Cost: that of the
// pair search plus one distance per candidate; a lower bound per candidate skips most of them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "base/shared/parallel.hpp"
#include "contact/shared/tie_steps.hpp"

namespace deck::detail {
namespace {

constexpr double beyond = 1.5;  // largest |s|, |t| that a search with Ignore 1 to 3 accepts

/// Search distance of nodes.
class TieReach {
 public:
  TieReach(SceneContext& context, TieThickness& thickness, const Tie& tie)
      : x_(context.scene.coordinates), tie_(tie) {
    if (tie.search_distance != 0) return;
    const bool solids = tie.ignore == 2;
    std::vector<NodeIndex> nodes;
    for (const TiedNode& n : tie.nodes) {
      nodes.push_back(n.node);
      at_node_.push_back(thickness.of_node(n.node));
      range_at_node_.push_back(thickness.range_at(n.node));
    }
    double thickest = 0, longest = 0;
    for (const Corners& c : tie.main) {
      of_segment_.push_back(thickness.of_segment(c, solids));
      thickest = std::max(thickest, of_segment_.back());
      longest = std::max(longest, distance(x_, c[0], c[2]));
    }
    largest_ = thickness.largest_at(nodes);
    if (tie.ignore < 4) return;
    stored_ = tie.inter->dsearch.value;
    if (stored_ == 0)
      stored_ = std::max(0.05 * longest, static_cast<double>(0.6F) * (thickest + largest_));
  }

  bool per_pair() const { return tie_.search_distance == 0; }
  double of_pair(std::size_t node, std::size_t segment) const {
    if (!per_pair()) return tie_.search_distance;
    return std::max(of_diagonals(segment), 0.6 * (at_node_[node] + of_segment_[segment]));
  }
  /// Range of the reach if the solver took the thinnest or the thickest shell at the node.
  std::pair<double, double> range_of_pair(std::size_t node, std::size_t segment) const {
    if (!per_pair()) return {tie_.search_distance, tie_.search_distance};
    const auto [least, most] = range_at_node_[node];
    const auto with = [&](double t) {
      return std::max(of_diagonals(segment), 0.6 * (t + of_segment_[segment]));
    };
    return {with(least), with(most)};
  }
  /// The sum of both shares bounds the reach of every pair.
  double share_of_node(std::size_t node) const { return per_pair() ? 0.6 * at_node_[node] : 0; }
  double share_of_segment(std::size_t segment) const {
    return per_pair() ? std::max(of_diagonals(segment), 0.6 * of_segment_[segment])
                      : tie_.search_distance;
  }
  /// Widening of a segment's box.
  double widening(std::size_t segment) const {
    const Corners& c = tie_.main[segment];
    const double longer = std::max(distance(x_, c[0], c[2]), distance(x_, c[1], c[3]));
    if (!per_pair()) return tie_.search_distance;
    if (tie_.ignore >= 4) return std::max(stored_, longer);
    return std::max(0.05 * longer, 0.6 * (of_segment_[segment] + largest_));
  }
  /// Reference of the stored distance of a pair.
  double stored(double of_pair) const { return tie_.ignore >= 4 ? stored_ : of_pair; }

 private:
  double of_diagonals(std::size_t segment) const {
    const Corners& c = tie_.main[segment];
    return 0.05 * std::min(distance(x_, c[0], c[2]), distance(x_, c[1], c[3]));
  }
  const Coordinates& x_;
  const Tie& tie_;
  std::vector<double> at_node_, of_segment_;
  std::vector<std::pair<double, double>> range_at_node_;
  double largest_ = 0, stored_ = 0;
};

struct SegmentBox {
  Vec low, high;
  double distance_from(const Vec& p) const {
    const auto outside = [](double v, double least, double most) {
      return std::max(std::max(least - v, v - most), 0.0);
    };
    return norm(
        {outside(p.x, low.x, high.x), outside(p.y, low.y, high.y), outside(p.z, low.z, high.z)});
  }
  bool holds(const Vec& p, double wider) const {
    return p.x >= low.x - wider && p.x <= high.x + wider && p.y >= low.y - wider &&
           p.y <= high.y + wider && p.z >= low.z - wider && p.z <= high.z + wider;
  }
};

SegmentBox box_of(const Coordinates& x, const Corners& c) {
  SegmentBox b{at(x, c[0]), at(x, c[0])};
  for (const NodeIndex n : c) {
    const Vec p = at(x, n);
    b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
    b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
  }
  return b;
}

/// Usable result on a segment: if a sub-triangle is so thin that round-off decides, the solver's
/// distance may be less than the true one.
enum class DistanceTrust : std::uint8_t { none, box, distance };

DistanceTrust trust_in(const Coordinates& x, const Corners& c) {
  const Vec centre = 0.25 * (at(x, c[0]) + at(x, c[1]) + at(x, c[2]) + at(x, c[3]));
  double least = 1;  // area, as a share of a right angle's
  const auto test_area = [&](const Vec& a, const Vec& b, const Vec& d) {
    const double longest = std::max({norm(b - a), norm(d - a), norm(d - b)});
    const double area = norm(cross(b - a, d - a));
    // Far above round-off.
    for (const double share : {1e-6, 1e-3})
      if (!(area > share * longest * longest)) least = std::min(least, share);
  };
  if (is_triangle(c))
    test_area(at(x, c[2]), at(x, c[0]), at(x, c[1]));
  else
    for (std::size_t k = 0; k < 4; ++k) test_area(centre, at(x, c[k]), at(x, c[(k + 1) % 4]));
  return least == 1      ? DistanceTrust::distance
         : least == 1e-3 ? DistanceTrust::box
                         : DistanceTrust::none;
}

/// Adds every node in the widened boxes of segments without usable distance.
void add_pairs_by_box(const Coordinates& x, const Tie& tie, const TieReach& reach,
                      const std::vector<DistanceTrust>& trust, std::vector<CandidatePair>& pairs) {
  std::vector<std::pair<double, std::uint32_t>> along;
  for (std::uint32_t m = 0; m < tie.main.size(); ++m) {
    if (trust[m] != DistanceTrust::none) continue;
    if (along.empty()) {
      for (std::uint32_t i = 0; i < tie.nodes.size(); ++i)
        along.emplace_back(x.x[tie.nodes[i].node], i);
      std::sort(along.begin(), along.end());
    }
    const SegmentBox box = box_of(x, tie.main[m]);
    const double wider = reach.widening(m);
    for (auto it = std::lower_bound(along.begin(), along.end(), std::pair(box.low.x - wider, 0U));
         it != along.end() && it->first <= box.high.x + wider; ++it) {
      const NodeIndex node = tie.nodes[it->second].node;
      if (std::find(tie.main[m].begin(), tie.main[m].end(), node) != tie.main[m].end()) continue;
      if (box.holds(at(x, node), wider)) pairs.push_back({it->second, m});
    }
  }
}

/// Pairs that may be within reach, by node, then segment. False if there are too many.
bool candidates(SceneContext& c, const Tie& tie, const TieReach& reach,
                const std::vector<DistanceTrust>& trust, std::vector<CandidatePair>& out) {
  const Coordinates& x = c.scene.coordinates;
  std::vector<std::uint32_t> nodes;
  std::vector<double> of_nodes, of_segments;
  double farthest = 0;
  for (std::size_t i = 0; i < tie.nodes.size(); ++i) {
    const NodeIndex n = tie.nodes[i].node;
    nodes.push_back(n);
    of_nodes.push_back(reach.share_of_node(i));
    farthest = std::max({farthest, std::fabs(x.x[n]), std::fabs(x.y[n]), std::fabs(x.z[n])});
  }
  for (std::size_t m = 0; m < tie.main.size(); ++m)
    of_segments.push_back(reach.share_of_segment(m));
  SearchOptions options;
  options.gap.rule = GapRule::sum;
  options.form = Form::robust;
  options.threads = c.options.threads;
  // Distances of both sides are rounded; extra candidates are judged again.
  options.margin = 1e-12 * farthest;
  options.max_pairs = c.options.limits.pair_bytes / sizeof(CandidatePair);
  const NodeSegmentInput input{{x.x, x.y, x.z}, nodes,       of_nodes, {}, {},
                               tie.main,        of_segments, {},       {}};
  SearchResult found = find_node_segment_pairs(input, options);
  if (!found.complete) return false;
  out = std::move(found.pairs);
  add_pairs_by_box(x, tie, reach, trust, out);
  if (!std::is_sorted(out.begin(), out.end())) std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return true;
}

/// Quality of a position on a segment; decides between equally near segments.
struct PlaceRank {
  bool inside = true;
  double off_centre = 0;
};

PlaceRank rank_by_weights(const Projection& p, bool triangle) {
  if (!triangle) return {std::fabs(p.s) <= 1 && std::fabs(p.t) <= 1, p.s * p.s + p.t * p.t};
  constexpr double third = 1.0 / 3;
  return {p.s >= 0 && p.t >= 0 && 1 - p.s - p.t >= 0,
          (p.s - third) * (p.s - third) + (p.t - third) * (p.t - third)};
}

double largest_place(const Projection& p) { return std::max(std::fabs(p.s), std::fabs(p.t)); }

/// True if `a` replaces the equally near, earlier `b`.
bool replaces(const Projection& a, bool a_triangle, const Projection& b, bool b_triangle,
              bool weights) {
  if (!weights || (!a_triangle && !b_triangle)) return largest_place(a) < largest_place(b);
  const PlaceRank mine = rank_by_weights(a, a_triangle), other = rank_by_weights(b, b_triangle);
  if (mine.inside != other.inside) return mine.inside;
  return mine.off_centre < other.off_centre;
}

/// A node and a possible segment.
struct SegmentTrial {
  Projection projection;
  double within = 0, stored = 0;
  bool in_box = false;
};

/// Nothing if the segment cannot have the node.
std::optional<SegmentTrial> try_segment(const Coordinates& x, const Tie& tie, const TieReach& reach,
                                        const CandidatePair& pair, NodeIndex node) {
  const Corners& corners = tie.main[pair.main];
  SegmentTrial out;
  out.within = reach.of_pair(pair.secondary, pair.main);
  out.projection = project(x, node, corners, out.within, tie.spotflag == 27);
  const Projection& p = out.projection;
  const bool bounded = tie.ignore >= 1 && tie.ignore <= 3;
  if (!(p.depth > 0)) return {};
  if (bounded && !(std::fabs(p.s) < beyond && std::fabs(p.t) < beyond)) return {};
  out.in_box = box_of(x, corners).holds(at(x, node), reach.widening(pair.main));
  out.stored = reach.stored(out.within) - p.depth;
  return out;
}

/// Lower bound of SegmentTrial::stored.
double least_stored(const Coordinates& x, const Tie& tie, const TieReach& reach,
                    DistanceTrust trust, const CandidatePair& pair, NodeIndex node) {
  const double within = reach.of_pair(pair.secondary, pair.main);
  double distance = 0;
  if (trust == DistanceTrust::distance) {
    const Vec p = at(x, node);
    const SegmentBox box = box_of(x, tie.main[pair.main]);
    distance = box.distance_from(p);
    // The solver's formula has far less round-off.
    distance -= 1e-9 * (std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z) + distance +
                        norm(box.high - box.low));
  }
  return reach.stored(within) - std::max(0.0, within - std::max(0.0, distance));
}

/// `trust`: of all segments; `least`: scratch.
void choose(const Coordinates& x, const Tie& tie, const TieReach& reach,
            std::span<const CandidatePair> pairs, const std::vector<DistanceTrust>& trust,
            std::vector<double>& least, TiedNode& out) {
  if (pairs.empty()) return;
  least.clear();
  for (const CandidatePair& pair : pairs)
    least.push_back(least_stored(x, tie, reach, trust[pair.main], pair, out.node));
  // The likely nearest segment rules out most others without their distances.
  const auto likely =
      static_cast<std::size_t>(std::min_element(least.begin(), least.end()) - least.begin());
  const std::optional<SegmentTrial> first = try_segment(x, tie, reach, pairs[likely], out.node);
  const bool known = first && first->in_box;
  Projection best;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (known && least[i] > first->stored) continue;
    const CandidatePair& pair = pairs[i];
    const std::optional<SegmentTrial> trial =
        i == likely ? first : try_segment(x, tie, reach, pair, out.node);
    if (!trial) continue;
    if (!trial->in_box) {
      out.missed = true;  // unless another segment is found
      continue;
    }
    const Projection& p = trial->projection;
    if (out.segment != no_index) {
      if (trial->stored > out.distance) continue;
      if (trial->stored == out.distance &&
          !replaces(p, is_triangle(tie.main[pair.main]), best, is_triangle(tie.main[out.segment]),
                    tie.spotflag == 27))
        continue;
    }
    best = p;
    out.segment = pair.main;
    out.s = p.s;
    out.t = p.t;
    out.distance = trial->stored;
    out.search = trial->within;
  }
  if (out.segment != no_index) out.missed = false;
}

/// For reports only: the nearest segment of nodes without one, and the influence of the shell that
/// gives the node its thickness.
void explain(const TieReach& reach, const NearestSegments* nearest, std::size_t i, TiedNode& n) {
  if (n.segment == no_index && nearest != nullptr) {
    const NearestSegments::Found found = nearest->of(n.node);
    n.nearest = found.segment;
    n.nearest_distance = found.distance;
    if (found.segment != no_index) n.search = reach.of_pair(i, found.segment);
  }
  const std::uint32_t segment = n.segment != no_index ? n.segment : n.nearest;
  if (segment != no_index)
    std::tie(n.least_search, n.most_search) = reach.range_of_pair(i, segment);
}

/// Sets the state of a node: the first rule that applies.
void classify(const Tie& tie, TiedNode& n) {
  const int f = tie.spotflag;
  if (n.segment == no_index) {
    n.message = tie.ignore == 0                                    ? 1078
                : tie.ignore < 0                                   ? 1079
                : tie.ignore >= 2 && tie.inter->dsearch.value == 0 ? 1071
                                                                   : 1157;
    return;
  }
  const bool triangle = is_triangle(tie.main[n.segment]);
  const double off = std::max(std::fabs(n.s), std::fabs(n.t));
  const auto outside_by = [&](double share) {
    return n.s < -share || n.t < -share || n.s + n.t > 1 + share;
  };
  n.tied = true;
  if (f == 27 && triangle) {
    if (outside_by(0.25)) {
      n.message = 1872;
      n.tied = false;
    } else if (outside_by(0.01)) {
      n.message = 1873;
    }
  } else if (off > 1.5 && f >= 25 && f <= 28) {
    n.message = 1158;
    n.tied = false;
  } else if (off > 1.02) {
    n.message = 1079;
  }
}

}  // namespace

void search_ties(SceneContext& c, TieThickness& thickness, Tie& tie) {
  const TieReach reach(c, thickness, tie);
  std::vector<DistanceTrust> trust;
  trust.reserve(tie.main.size());
  for (const Corners& corners : tie.main) trust.push_back(trust_in(c.scene.coordinates, corners));
  std::vector<CandidatePair> pairs;
  if (!candidates(c, tie, reach, trust, pairs)) {
    tie.not_evaluated = "too many pairs of nodes and segments are within its search distance";
    return;
  }
  const Coordinates& x = c.scene.coordinates;
  const int threads = effective_threads(c.options.threads);
  parallel_pieces(threads, tie.nodes.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    auto next = std::lower_bound(pairs.begin(), pairs.end(),
                                 CandidatePair{static_cast<std::uint32_t>(begin), 0});
    std::vector<double> least;
    for (std::size_t i = begin; i < end; ++i) {
      const auto first = next;
      while (next != pairs.end() && next->secondary == i) ++next;
      const std::size_t at = static_cast<std::size_t>(first - pairs.begin());
      const std::size_t count = static_cast<std::size_t>(next - first);
      choose(x, tie, reach, {pairs.data() + at, count}, trust, least, tie.nodes[i]);
      classify(tie, tie.nodes[i]);
    }
  });
  std::optional<NearestSegments> nearest;
  if (std::any_of(tie.nodes.begin(), tie.nodes.end(),
                  [](const TiedNode& n) { return n.segment == no_index; }))
    nearest.emplace(x, tie.main);
  parallel_pieces(threads, tie.nodes.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      explain(reach, nearest ? &*nearest : nullptr, i, tie.nodes[i]);
  });
}

}  // namespace deck::detail
