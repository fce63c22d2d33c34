// TYPE25, Iedge: list of edges, and pairs of sheet edges that penetrate.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "contact/shared/filtered.hpp"
#include "contact/type24_25/type24_25.hpp"
#include "deck/contacts.hpp"
#include "model/shared/families.hpp"

namespace deck::detail::type24_25 {
namespace {

class EdgeLister {
 public:
  EdgeLister(SceneContext& c, const Sides& s, const Topology& t)
      : c_(c), x_(c.scene.coordinates), ids_(c.model.nodes.id), s_(s), t_(t) {}

  std::vector<SideEdge> edges() {
    for (std::uint32_t i = 0; i < s_.count(); ++i) {
      const Face f = s_.face(i);
      for (std::uint32_t k = 0; k < 4; ++k) add(i, f, k);
    }
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
    for (const Edge& line : s_.lines) out.push_back(of_line(line));
    std::stable_sort(out.begin(), out.end(), [&](const SideEdge& a, const SideEdge& b) {
      return ids_[a.nodes[0]] < ids_[b.nodes[0]];
    });
    return out;
  }

 private:
  std::array<NodeIndex, 2> ordered(NodeIndex a, NodeIndex b) const {
    return ids_[a] < ids_[b] ? std::array{a, b} : std::array{b, a};
  }

  /// A line meets the edges of both surfaces and is free.
  SideEdge of_line(const Edge& line) const {
    SideEdge e;
    e.nodes = ordered(line.nodes[0], line.nodes[1]);
    e.kind = 3;
    e.bits = from_first | from_second;
    e.carrier = line.carrier;
    e.element = line.element;
    const double half = half_of_line(c_.model, *family_of_carrier(line.carrier), line.element);
    e.gap = std::min(s_.set.scale * half, s_.set.cap_m);
    return e;
  }

  void add(std::uint32_t i, const Face& f, std::uint32_t k) {
    const NodeIndex a = f.nodes[k], b = f.nodes[(k + 1) % 4];
    if (f.interior || a == b) return;
    const std::uint32_t j = t_.across(i, k).face;
    if (j != no_index && s_.base(j) >= s_.base(i)) return;
    SideEdge e;
    e.nodes = ordered(a, b);
    e.face = i;
    e.side = k;
    e.carrier = f.carrier;
    e.element = f.element;
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
    const Face &a = s_.faces[e.face], &b = s_.faces[e.across];  // solids have no mirrored faces
    if (dot(normal(a), normal(b)) < s_.set.cos_edge) return true;
    e.kind = -1;
    return z == 1;
  }

  const SceneContext& c_;
  const Coordinates& x_;
  const std::vector<std::int64_t>& ids_;
  const Sides& s_;
  const Topology& t_;
  std::vector<SideEdge> list_;
};

using NearPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Igap 2: edges near each other along the mesh, each pair with the smaller position first.
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

/// True if two edges are a pair. If each could be main, the one with larger ids is.
bool are_wanted(const Sides& sides, const std::vector<std::int64_t>& ids, const SideEdge& s,
                const SideEdge& m) {
  if (m.kind < 2 || s.kind < 1 || !sides.across(s.bits, m.bits)) return false;
  const auto key = [&](const SideEdge& e) { return std::pair(ids[e.nodes[0]], ids[e.nodes[1]]); };
  return s.kind == 1 || key(m) > key(s);
}

RuleEdge rule_edge(const Coordinates& x, const Sides& s, const Topology& t, const SideEdge& e,
                   double inward, bool recessed) {
  RuleEdge out;
  out.end = {at(x, e.nodes[0]), at(x, e.nodes[1])};
  out.gap = e.gap;
  out.recessed = recessed;
  out.inward = inward;
  if (!e.free() || e.kind == 3) return out;  // a line element has no side
  out.beta = t.direction(e.face, e.side);
  for (std::size_t k = 0; k < 2 && recessed; ++k) {
    const std::uint32_t corner =
        s.nodes_of(e.face)[e.side] == e.nodes[k] ? e.side : (e.side + 1) % 4;
    const Topology::Vertex v = t.vertex(e.face, corner);
    out.border[k] = sum_single(v.first, v.second);
  }
  return out;
}

std::array<Vec, 2> ends_of(const RuleEdge& e) {
  std::array<Vec, 2> out = e.end;
  const auto root = [](double v) { return std::sqrt(v); };
  for (std::size_t k = 0; k < 2 && e.recessed; ++k)
    out[k] = moved_inward(out[k], e.inward, e.beta, e.border[k], root, unit_of);
  return out;
}

/// Bounds of the round-off in the distance of two edges.
class EdgeDoubt {
 public:
  EdgeDoubt(const std::array<Vec, 2>& s, const std::array<Vec, 2>& m, double gap) : s_(s), m_(m) {
    const Vec u = s[1] - s[0], v = m[1] - m[0], w = m[1] - s[1];
    double largest = 0;
    for (const Vec& p : {s[0], s[1], m[0], m[1]}) largest = std::max(largest, largest_component(p));
    const double aa = dot(u, u), cc = dot(v, v), across = norm(cross(u, v));
    // Floors of the solver and vanishing squares are left to exact numbers.
    if (!(aa > 1e-12 && cc > 1e-12 && largest < 0x1p200)) return;
    const double sine_squared = across * across / (aa * cc);
    slack = (largest + norm(w) + gap) * 0x1p-44;
    parallel_ = !(sine_squared >= 0x1p-12 && across * across > 1e-12);
    if (!parallel_) turn = slack /= sine_squared;
  }
  double slack = no_limit;  ///< of the distance
  double turn = no_limit;   ///< of the vector between them; large if nearly parallel

  /// False: the solver's distance is certainly not below `gap`.
  bool may_be_closer(double gap, double distance) const {
    if (!(slack < no_limit)) return true;
    if (!parallel_) return distance - slack < gap;
    return is_closer_than(s_[0], s_[1], m_[0], m_[1], gap + slack);
  }
  /// True: certainly below `gap`.
  bool is_closer(double gap, double distance) const {
    if (!(slack < no_limit)) return false;
    if (!parallel_) return distance + slack < gap;
    // The start point of the formula on the second edge is round-off.
    return std::max(from(0), from(1)) + slack < gap;
  }

 private:
  /// Distance for a start there: weight of the first end.
  double from(double weight) const {
    const Vec u = s_[0] - s_[1], v = m_[0] - m_[1], w = s_[1] - m_[1];
    const auto clamped = [](double h) { return std::max(0.0, std::min(1.0, h)); };
    const double on_s = clamped(dot(weight * v - w, u) / dot(u, u));
    const double on_m = clamped(dot(w + on_s * u, v) / dot(v, v));
    return norm(w + on_s * u - on_m * v);
  }
  const std::array<Vec, 2>&s_, &m_;
  bool parallel_ = true;
};

/// Figures of a pair for the accuracy; `in_contact` by exact arithmetic if wanted.
EdgePenetration decided(const CandidatePair& pair, const EdgeRule& rule, Accuracy accuracy,
                        DecisionReport& decisions) {
  const bool decides = accuracy >= Accuracy::robust && is_finite(rule);
  const EdgeFigures f = evaluate_edges(rule, decides);
  EdgePenetration p;
  p.secondary = pair.secondary;
  p.main = pair.main;
  p.penetration = f.penetration;
  p.gap = f.gap;
  p.distance = f.closest.distance;
  p.weight_s = f.closest.weight_s;
  p.weight_m = f.closest.weight_m;
  if (p.distance > 0) p.normal = (1 / p.distance) * f.closest.vector;
  p.in_contact = p.solver_acts = p.penetration > 0;
  if (!decides) return p;
  ++decisions.pairs;
  if (accuracy != Accuracy::exact && !f.doubtful) return p;
  ++decisions.fallback;
  ++decisions.exact;
  const ExactEdgePair exact = exact_edge_pair(rule);
  p.in_contact = exact.penetrates;
  p.solver_distance = p.distance;
  p.exact_distance = exact.distance;
  if (exact.penetrates && (!p.solver_acts || accuracy == Accuracy::exact)) {
    p.penetration = exact.depth;
    p.gap = exact.gap;
    p.distance = exact.distance;
  }
  return p;
}

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
  std::vector<SideEdge> edges = EdgeLister(c, s, t).edges();
  if (!s.set.local()) return edges;
  std::vector<double> length(c.model.nodes.size(), no_limit);
  for (const SideNode& n : s.nodes) length[n.node] = n.length;
  for (SideEdge& e : edges) e.length = std::min(length[e.nodes[0]], length[e.nodes[1]]);
  return edges;
}

EdgeRule edge_rule(const Coordinates& x, const Sides& sides, const Topology& t, const SideEdge& s,
                   const SideEdge& m) {
  const bool local = sides.set.local();
  EdgeRule r;
  r.secondary = rule_edge(x, sides, t, s, s.gap, s.free() && sides.set.igap0 != 0);
  r.main = rule_edge(x, sides, t, m, local ? std::min(m.gap, m.length) : m.gap, m.free());
  r.secondary.one_sided = s.free() && s.kind != 1;
  r.main.one_sided = m.free();
  if (local) r.most_gap = s.length + m.length;
  return r;
}

EdgeFigures evaluate_edges(const EdgeRule& r, bool with_doubts) {
  EdgeFigures out;
  const auto s = ends_of(r.secondary), m = ends_of(r.main);
  out.closest = closest_between_edges<Form::reference>(s[0], s[1], m[0], m[1]);
  const EdgeClosest<double>& c = out.closest;
  out.gap = std::min(r.main.gap + r.secondary.gap, r.most_gap);
  out.penetration = std::max(0.0, out.gap - c.distance);
  const double over_m = -dot(c.vector, r.main.beta), over_s = dot(c.vector, r.secondary.beta);
  const double tilt = edge_tilt * c.distance;
  if (r.main.one_sided && over_m > tilt) out.penetration = 0;
  if (r.secondary.one_sided && over_s > tilt) out.penetration = 0;
  if (!with_doubts) return out;
  const EdgeDoubt doubt(s, m, out.gap);
  if (!doubt.may_be_closer(out.gap, c.distance)) return out;
  // Certainly beside a free edge: no contact at any distance.
  const auto beside = [&](const RuleEdge& e, double over) {
    return e.one_sided && over - tilt > 2 * doubt.turn;
  };
  if (beside(r.main, over_m) || beside(r.secondary, over_s)) return out;
  const auto unsure = [&](const RuleEdge& e, double over) {
    return e.one_sided && !(tilt - over > 2 * doubt.turn);
  };
  out.doubtful = unsure(r.main, over_m) || unsure(r.secondary, over_s) ||
                 !doubt.is_closer(out.gap, c.distance);
  return out;
}

bool find_edges25(SceneContext& c, const Sides& s, const Topology& t,
                  const std::vector<SideEdge>& edges, std::vector<EdgePenetration>& out,
                  DecisionReport& decisions) {
  if (s.set.shell_edges() == 0) return true;
  const Coordinates& x = c.scene.coordinates;
  NearPairs near;
  if (s.set.igap == 2) near = NearAlongMesh(x, edges, s.set.igap0 != 0).find();
  const SearchResult found = search_edges(c, s, edges);
  if (!found.complete) return false;
  const Accuracy accuracy = c.all_placed ? c.options.accuracy : Accuracy::reference;
  for (const CandidatePair& pair : found.pairs) {
    const SideEdge &secondary = edges[pair.secondary], &main = edges[pair.main];
    if (!are_wanted(s, c.model.nodes.id, secondary, main)) continue;
    const std::pair both(std::min(pair.secondary, pair.main), std::max(pair.secondary, pair.main));
    if (std::binary_search(near.begin(), near.end(), both)) continue;
    const EdgeRule rule = edge_rule(x, s, t, secondary, main);
    const EdgePenetration p = decided(pair, rule, accuracy, decisions);
    if (p.in_contact || p.solver_acts) out.push_back(p);
  }
  return true;
}

}  // namespace deck::detail::type24_25
