// TYPE25, Iedge: the list of edges, and which edges of sheets penetrate which others.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "contact/modern/parts.hpp"
#include "deck/contact/search.hpp"

namespace deck::detail::modern {
namespace {

class Lister {
 public:
  Lister(SceneContext& c, const Sides& s, const Topology& t)
      : x_(c.scene.coordinates), ids_(c.model.nodes.id), s_(s), t_(t) {}

  std::vector<SideEdge> edges() {
    s_.each_face([&](std::uint32_t i, const Face& f) {
      for (std::uint32_t k = 0; k < 4; ++k) add(i, f, k);
    });
    const auto key = [this](const SideEdge& e) {
      const std::uint32_t across = e.free() ? 0 : e.across + 1;
      return std::tuple(ids_[e.nodes[0]], ids_[e.nodes[1]], s_.base(e.face), across);
    };
    std::stable_sort(list_.begin(), list_.end(),
                     [&](const SideEdge& a, const SideEdge& b) { return key(a) < key(b); });
    std::vector<SideEdge> out;
    for (const SideEdge& e : list_) {
      if (!out.empty() && key(out.back()) == key(e)) continue;
      SideEdge one = e;
      if (keep(one)) out.push_back(one);
    }
    return out;
  }

 private:
  void add(std::uint32_t i, const Face& f, std::uint32_t k) {
    const NodeIndex a = f.nodes[k], b = f.nodes[(k + 1) % 4];
    if (f.interior || a == b) return;
    const std::uint32_t j = t_.across(i, k).face;
    if (j != no_index && s_.base(j) >= s_.base(i)) return;
    SideEdge e;
    e.nodes = ids_[a] < ids_[b] ? std::array{a, b} : std::array{b, a};
    e.face = i;
    e.side = k;
    e.bits = f.bits;
    e.gap = f.gap;
    e.stiffness = f.stiffness;
    const bool solid = f.kind == SegmentKind::solid;
    if (j != no_index) {
      const Face g = s_.face(j);
      e.across = s_.base(j);
      e.bits |= g.bits;
      e.gap = std::max(f.gap, g.gap);
      const double sum = f.stiffness + g.stiffness;
      e.stiffness = f.stiffness == 0 || g.stiffness == 0 ? std::max(f.stiffness, g.stiffness)
                    : sum > 0                            ? 2 * f.stiffness * g.stiffness / sum
                                                         : 0;
      if (solid && g.kind == SegmentKind::solid) e.kind = 1;
    }
    list_.push_back(e);
  }

  Vec normal(const Face& f) const {
    return unit_of(
        cross(at(x_, f.nodes[2]) - at(x_, f.nodes[0]), at(x_, f.nodes[3]) - at(x_, f.nodes[1])));
  }

  bool keep(SideEdge& e) const {
    if (e.kind != 1) return s_.set.shell_edges() != 0;
    const int z = s_.set.solid_edges();
    if (z != 1 && z != 3) return z == 2;
    const Face &a = s_.faces[e.face], &b = s_.faces[e.across];  // solids have no mirrored ones
    if (dot(normal(a), normal(b)) < s_.set.cos_edge) return true;
    e.kind = -1;
    return z == 1;
  }

  const Coordinates& x_;
  const std::vector<std::int64_t>& ids_;
  const Sides& s_;
  const Topology& t_;
  std::vector<SideEdge> list_;
};

using NearPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Igap 2: which edges are near others along the mesh, each pair with the smaller position first.
class NearAlongMesh {
 public:
  NearAlongMesh(const Coordinates& x, const std::vector<SideEdge>& edges, bool doubled)
      : x_(x), edges_(edges), doubled_(doubled), dist_(x.x.size(), endless), met_(edges.size(), 0) {
    for (std::uint32_t i = 0; i < edges.size(); ++i)
      for (const NodeIndex n : edges[i].nodes) at_node_.emplace_back(n, i);
    std::sort(at_node_.begin(), at_node_.end());
  }

  NearPairs find() {
    std::vector<std::uint32_t> order(edges_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return edges_[a].gap > edges_[b].gap;
    });
    most_.resize(edges_.size());
    for (std::uint32_t i = 0; i < edges_.size(); ++i) most_[i] = edges_[i].gap;
    for (const std::uint32_t i : order) from(i);
    std::sort(out_.begin(), out_.end());
    out_.erase(std::unique(out_.begin(), out_.end()), out_.end());
    return std::move(out_);
  }

 private:
  static constexpr double endless = 1e300;
  double bound(double other, double own) const {
    return std::sqrt(2.0) * (doubled_ ? 2 * (other + own) : other + 2 * own);
  }
  double apart(std::uint32_t a, std::uint32_t b) const {
    const auto &s = edges_[a].nodes, &m = edges_[b].nodes;
    return closest_between_edges<Form::reference>(at(x_, s[0]), at(x_, s[1]), at(x_, m[0]),
                                                  at(x_, m[1]))
        .distance;
  }
  void set(NodeIndex n, double d) {
    if (dist_[n] == endless) touched_.push_back(n);
    dist_[n] = std::min(dist_[n], d);
  }
  double least(std::uint32_t e) const {
    return std::min(dist_[edges_[e].nodes[0]], dist_[edges_[e].nodes[1]]);
  }

  void expand(std::uint32_t l, std::uint64_t ring, std::uint64_t start,
              std::vector<std::uint32_t>& next) {
    const auto& own = edges_[l].nodes;
    for (const NodeIndex a : own)
      for (auto it = std::lower_bound(at_node_.begin(), at_node_.end(), std::pair(a, 0U));
           it != at_node_.end() && it->first == a; ++it) {
        const std::uint32_t r = it->second;
        if (met_[r] >= start && met_[r] != ring) continue;
        if (met_[r] != ring) {
          next.push_back(r);
          reached_.push_back(r);
        }
        met_[r] = ring;
        const auto& n = edges_[r].nodes;
        const NodeIndex w = n[0] == a ? n[1] : n[0];
        if (w != own[0] && w != own[1]) set(w, dist_[a] + distance(x_, a, w));
      }
  }

  void from(std::uint32_t i) {
    for (const NodeIndex n : touched_) dist_[n] = endless;
    touched_.clear();
    reached_.clear();
    for (const NodeIndex n : edges_[i].nodes) set(n, 0);
    const double reach = bound(most_[i], edges_[i].gap);
    const std::uint64_t start = ++ring_;
    met_[i] = start;
    std::vector<std::uint32_t> front{i}, next;
    for (bool first = true; !front.empty(); first = false) {
      ++ring_;
      next.clear();
      for (const std::uint32_t l : front)
        if (first || least(l) <= reach || apart(l, i) < reach) expand(l, ring_, start, next);
      std::swap(front, next);
    }
    for (const std::uint32_t l : reached_) {
      const auto &a = edges_[i].nodes, &b = edges_[l].nodes;
      if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) continue;
      const double limit = bound(edges_[l].gap, edges_[i].gap);
      if (!(least(l) <= limit) && !(apart(l, i) < limit)) continue;
      out_.emplace_back(std::min(i, l), std::max(i, l));
      most_[l] = std::max(most_[l], edges_[i].gap);
    }
  }

  const Coordinates& x_;
  const std::vector<SideEdge>& edges_;
  bool doubled_;
  std::vector<std::pair<NodeIndex, std::uint32_t>> at_node_;
  std::vector<double> dist_, most_;
  std::vector<std::uint64_t> met_;
  std::uint64_t ring_ = 0;
  std::vector<NodeIndex> touched_;
  std::vector<std::uint32_t> reached_;
  NearPairs out_;
};

/// Two edges of sheets.
class EdgePairs {
 public:
  EdgePairs(const Coordinates& x, const Sides& s, const Topology& t,
            const std::vector<SideEdge>& edges, const std::vector<std::int64_t>& ids)
      : x_(x), s_(s), t_(t), edges_(edges), ids_(ids) {}

  bool wanted(std::uint32_t s, std::uint32_t m) const {
    const SideEdge &a = edges_[s], &b = edges_[m];
    if (b.kind < 2 || a.kind < 1 || !s_.across(a.bits, b.bits)) return false;
    if (a.kind == 1) return true;
    return key(b) > key(a);
  }

  /// The penetration of a pair that is wanted; 0: none.
  EdgePenetration evaluate(std::uint32_t s, std::uint32_t m) const {
    const SideEdge &a = edges_[s], &b = edges_[m];
    const bool local = s_.set.local();
    const auto main = recessed(b, local ? std::min(b.gap, b.length) : b.gap, b.free());
    const auto own = recessed(a, a.gap, a.free() && s_.set.igap0 != 0);
    const auto c = closest_between_edges<Form::reference>(own[0], own[1], main[0], main[1]);
    EdgePenetration p;
    p.secondary = s;
    p.main = m;
    p.gap = b.gap + a.gap;
    if (local) p.gap = std::min(p.gap, a.length + b.length);
    p.distance = c.distance;
    p.weight_s = c.weight_s;
    p.weight_m = c.weight_m;
    p.penetration = std::max(0.0, p.gap - c.distance);
    if (c.distance > 0) p.normal = (1 / c.distance) * c.vector;
    constexpr double tilt = 1e-4;
    if (b.free() && -dot(c.vector, beta(b)) > tilt * c.distance) p.penetration = 0;
    if (a.free() && a.kind != 1 && dot(c.vector, beta(a)) > tilt * c.distance) p.penetration = 0;
    return p;
  }

 private:
  std::pair<std::int64_t, std::int64_t> key(const SideEdge& e) const {
    return {ids_[e.nodes[0]], ids_[e.nodes[1]]};
  }
  Vec beta(const SideEdge& e) const { return t_.direction(e.face, e.side); }

  /// The two ends, moved inward by `by` along the directions of the border where `free`.
  std::array<Vec, 2> recessed(const SideEdge& e, double by, bool free) const {
    std::array<Vec, 2> end{at(x_, e.nodes[0]), at(x_, e.nodes[1])};
    if (!free) return end;
    const Vec b = beta(e);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t corner =
          s_.nodes_of(e.face)[e.side] == e.nodes[k] ? e.side : (e.side + 1) % 4;
      const Topology::Vertex v = t_.vertex(e.face, corner);
      Vec d = sum_single(v.first, v.second);
      double c = dot(d, b);
      if (c < 0) {
        d = d - (2 * c) * b;
        c = -c;
      }
      const double size = dot(d, d);
      if (2 * c * c < size) d = d + (std::sqrt(size - c * c) - c) * b;
      d = unit_of(d);
      const double along = dot(d, b);
      if (along != 0) end[k] = end[k] - (by / along) * d;
    }
    return end;
  }

  const Coordinates& x_;
  const Sides& s_;
  const Topology& t_;
  const std::vector<SideEdge>& edges_;
  const std::vector<std::int64_t>& ids_;
};

SearchResult search_edges(SceneContext& c, const Sides& s, const std::vector<SideEdge>& edges) {
  const Coordinates& x = c.scene.coordinates;
  std::vector<std::array<std::uint32_t, 2>> nodes;
  std::vector<double> main_gap, secondary_gap, length, main_on, secondary_on;
  for (const SideEdge& e : edges) {
    nodes.push_back(e.nodes);
    main_gap.push_back(2 * e.gap);
    secondary_gap.push_back(s.set.igap0 != 0 ? 2 * e.gap : e.gap);
    length.push_back(e.length);
    main_on.push_back(e.kind >= 2 ? 1 : 0);
    secondary_on.push_back(e.kind >= 1 ? 1 : 0);
  }
  EdgeEdgeInput in;
  in.nodes = {x.x, x.y, x.z};
  in.secondary = in.main = nodes;
  in.secondary_gap = secondary_gap;
  in.main_gap = main_gap;
  if (s.set.local()) in.secondary_length = in.main_length = length;
  in.secondary_stiffness = secondary_on;
  in.main_stiffness = main_on;
  SearchOptions options;
  options.gap = PairGap::from_igap(s.set.local() ? 3 : 1, 0);
  options.margin = s.margin;
  options.threads = c.options.threads;
  return find_edge_edge_pairs(in, options);
}

}  // namespace

std::vector<SideEdge> make_edges(SceneContext& c, const Sides& s, const Topology& t) {
  std::vector<SideEdge> edges = Lister(c, s, t).edges();
  if (!s.set.local()) return edges;
  std::vector<double> length(c.model.nodes.size(), never);
  for (const SideNode& n : s.nodes) length[n.node] = n.length;
  for (SideEdge& e : edges) e.length = std::min(length[e.nodes[0]], length[e.nodes[1]]);
  return edges;
}

bool find_edges25(SceneContext& c, const Sides& s, const Topology& t,
                  const std::vector<SideEdge>& edges, std::vector<EdgePenetration>& out) {
  if (s.set.shell_edges() == 0) return true;
  const Coordinates& x = c.scene.coordinates;
  NearPairs near;
  if (s.set.igap == 2) near = NearAlongMesh(x, edges, s.set.igap0 != 0).find();
  const SearchResult found = search_edges(c, s, edges);
  if (!found.complete) return false;
  const EdgePairs pairs(x, s, t, edges, c.model.nodes.id);
  for (const CandidatePair& pair : found.pairs) {
    if (!pairs.wanted(pair.secondary, pair.main)) continue;
    const std::pair both(std::min(pair.secondary, pair.main), std::max(pair.secondary, pair.main));
    if (std::binary_search(near.begin(), near.end(), both)) continue;
    const EdgePenetration p = pairs.evaluate(pair.secondary, pair.main);
    if (p.penetration > 0) out.push_back(p);
  }
  return true;
}

}  // namespace deck::detail::modern
