// TYPE24: largest accepted penetration, candidates, the test of one node and one segment in double
// with bounds of its round-off, and the choice among a node's pairs. patch_rule.hpp has the rule.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/type24_25/patch_rule.hpp"
#include "contact/type24_25/type24_25.hpp"
#include "deck/contacts.hpp"

namespace deck::detail::type24_25 {
namespace {

/// Part of each node: of its last 4-node shell, else 3-node shell, else solid segment.
std::vector<std::uint32_t> node_parts(const Model& model, const std::vector<Face>& faces) {
  std::vector<std::uint32_t> out(model.nodes.size(), no_index);
  for (const ElementKind kind : {ElementKind::shell4, ElementKind::shell3}) {
    const Elements& family = model.family(kind);
    for (std::uint32_t e = 0; e < family.size(); ++e)
      for (int i = 0; i < family.width; ++i)
        if (const NodeIndex n = family.of(e)[i]; n != no_index) out[n] = family.part[e];
  }
  for (const Face& f : faces)
    if (f.solid_like() && f.solid != no_index)
      for (const NodeIndex n : f.nodes) out[n] = model.solid8.part[f.solid];
  return out;
}

/// Mean direction of the segments at each node; a unit vector for several.
std::vector<Vec> node_normals(const Coordinates& x, const Sides& s) {
  std::vector<Vec> out(x.x.size());
  std::vector<std::uint32_t> count(x.x.size(), 0);
  for (const Face& f : s.faces) {
    if (!(f.stiffness > 0)) continue;
    const std::size_t corners = f.triangle() ? 3 : 4;
    std::array<Vec, 4> normal;
    for (std::size_t k = 0; k < corners; ++k) {
      const Vec p = at(x, f.nodes[k]);
      normal[k] = unit_of(cross(at(x, f.nodes[(k + 1) % corners]) - p,
                                at(x, f.nodes[(k + corners - 1) % corners]) - p));
    }
    if (f.triangle()) normal[2] = normal[1];
    for (std::size_t k = 0; k < corners; ++k) {
      out[f.nodes[k]] = out[f.nodes[k]] + normal[k];
      ++count[f.nodes[k]];
    }
  }
  for (std::size_t n = 0; n < out.size(); ++n)
    if (count[n] > 1) out[n] = unit_of(out[n]);
  return out;
}

/// Deepest accepted penetration, and extra search distance for solids.
struct Limits24 {
  double accepted = 1e30, solid_margin = 0;
};
Limits24 limits_of(const Sides& s) {
  Limits24 out;
  out.solid_margin = s.margin;
  if (s.set.inacti == 0) return out;
  if (s.set.ipen_max > 0) {
    out.accepted = s.set.ipen_max;
    out.solid_margin = std::max(s.margin, s.set.ipen_max);
    return out;
  }
  double sum = 0;
  std::size_t count = 0;
  for (const Face& f : s.faces)
    if (f.solid_like()) {
      sum += f.length;
      ++count;
    }
  const double mean = count == 0 ? 0 : sum / static_cast<double>(count);
  out.accepted = std::max(0.5 * mean, 0.5 * s.largest);
  out.solid_margin = std::max(s.margin, 0.5 * mean);
  return out;
}

/// Bounds of the round-off in the foot of a node on a patch, from the sizes of the terms.
class FootError {
 public:
  /// Sub-areas as in place_on_patch(); `size`: of the patch with the node, `largest`: coordinate.
  FootError(const PatchRule& r, const std::array<double, 4>& a, const std::array<double, 4>& c,
            const PatchPlace<double>& place, double area, double size, double largest)
      : a_(a), c_(c), flat_(flat_patch * area) {
    const double moment = size * largest;
    turn = 0x1p-42 * moment / (2 * area) + 0x1p-50;
    if (!(turn < 0x1p-20)) return;
    of_area_ = 0x1p-45 * moment + size * size * turn;
    for (std::size_t k = 0; k < 4; ++k)
      most_ = std::max(most_, std::max(std::fabs(a[k]), std::fabs(c[k])));
    const bool triangle = r.corner[2].x == r.corner[3].x && r.corner[2].y == r.corner[3].y &&
                          r.corner[2].z == r.corner[3].z;
    if (!triangle && !(std::fabs(a[2]) > 2 * flat_ + of_area_)) return;
    triangle ? bound_triangle(place, size) : weigh_quad(place, size);
    shift += 0x1p-49 * largest;
  }
  double shift = no_limit;               ///< possible shift of the foot; no_limit: unknown
  double turn = 0;                       ///< possible turn of the normal, as an angle
  bool outside = false, inside = false;  ///< certain

 private:
  /// Error of the ratio of two products of areas.
  double of_ratio(double up, double down) const {
    const double by = 4 * most_ * of_area_ + 2 * of_area_ * of_area_ + 0x1p-50 * most_ * most_;
    if (std::fabs(down) <= flat_) return std::fabs(down) + by < 0.99 * flat_ ? 0 : no_limit;
    if (!(std::fabs(down) > 1.01 * flat_ + 4 * by)) return no_limit;
    return 2 * by * (1 + std::fabs(up / down)) / std::fabs(down);
  }
  double of_s() const {
    return of_ratio(a_[1] * c_[3] - c_[1] * a_[3], a_[1] * c_[3] + c_[1] * a_[3]);
  }
  double of_t() const {
    return of_ratio(c_[0] * a_[2] - a_[0] * c_[2], c_[0] * a_[2] + a_[0] * c_[2]);
  }
  void compare(const PatchPlace<double>& place, double s, double t) {
    constexpr double most = 1 + beside_patch;
    outside = std::fabs(place.s) - s > most || std::fabs(place.t) - t > most;
    inside = std::fabs(place.s) + s < most && std::fabs(place.t) + t < most;
  }

  void weigh_quad(const PatchPlace<double>& place, double size) {
    const double s = of_s(), t = of_t();
    compare(place, s, t);
    if (outside || inside) shift = s < 1 && t < 1 ? size * (s + t) : no_limit;
  }

  /// Beside the last corner and on the lines of its two sides one parameter is meaningless or
  /// jumps: each case has its own bound.
  void bound_triangle(const PatchPlace<double>& place, double size) {
    const double a1 = a_[0], c2 = c_[1], c4 = c_[3], by = of_area_, reach = beside_patch * a1;
    if (!(reach > 16 * by)) return;
    const double t = 2 * by * (1 + std::fabs(c_[0] / a1)) / a1, to_corner = std::fabs(1 - place.t);
    const double least = std::min(c2, c4), most = std::max(c2, c4);
    double s = 0, place_by = 0;
    if (least >= -by && most <= by) {
      place_by = 2 * size * (to_corner + t);
    } else if (least >= -by) {
      if (std::fabs(a_[1] * c4 + c2 * a_[3]) < 1.01 * flat_) return;
      s = least <= by ? 2 * of_s() : of_s();
    } else if (most <= by) {  // beyond the corner
      outside = least < -reach - 2 * by;
      shift = outside ? 0 : no_limit;
      return;
    } else if (!(std::fabs(least + reach) > 2 * by)) {
      return;
    }
    compare(place, s, t);
    if (!outside && !inside) return;
    if (place.t > 1 + t) {  // the corner, for any other parameter
      shift = 0;
      return;
    }
    if (outside) {
      const double w1 = 0.25 * (1 - place.t) * (1 - place.s),
                   w2 = 0.25 * (1 - place.t) * (1 + place.s),
                   w = (1 + std::fabs(place.s)) * t + to_corner * s + s * t;
      const bool jumps = std::fabs(w1 - 1) <= w || std::fabs(w2 - 1) <= w ||
                         (std::fabs(w2 - w1) <= 2 * w && w1 >= 1 - w);
      if (w1 + w2 > 1 - 2 * w && jumps) return;
      place_by += 4 * size * w;
    }
    if (s < 1) shift = size * (to_corner * s + t) + place_by;
  }

  const std::array<double, 4>&a_, &c_;
  double flat_, of_area_ = 0, most_ = 0;
};

/// True if round-off may change the effect of a pair on the node. `by`: error of the height.
bool is_doubtful(const PatchRule& r, const FootError& foot, double gap, double height, double by,
                 const Vec& normal) {
  if (r.rejects_part || (foot.outside && (!r.solid || r.never_blocks))) return false;
  const auto near = [&](double v, double limit) { return !(std::fabs(v - limit) > by); };
  if (!(by < no_limit)) return true;
  constexpr double tiny = tiny_penetration;
  if (!r.solid) {
    const double p = gap - std::fabs(height);
    if (near(p, 0) || near(p, r.accepted) || near(p, tiny) || near(p, -tiny)) return true;
    return (!foot.inside && (p > -tiny ? p < r.accepted : !r.never_blocks)) ||
           (p > 0 && p < r.accepted && near(height, 0));
  }
  const double p = gap - height;
  if (near(p, tiny) || near(p, -tiny)) return true;
  const bool live = p > -tiny;
  if (foot.outside || (!live && foot.inside)) return false;
  if (!foot.inside) return !r.never_blocks || (live && !r.own_solid && p < r.limit + by);
  if (r.own_solid || p > r.limit + by) return false;
  if (near(p, r.limit)) return true;
  return r.by_direction &&
         !(std::fabs(dot(normal, r.direction)) > (foot.turn + 0x1p-50) * norm(r.direction));
}

class Rules24 {
 public:
  Rules24(SceneContext& c, const Sides& s, const Limits24& limits)
      : x_(c.scene.coordinates),
        model_(c.model),
        connectivity_(c.connectivity),
        s_(s),
        limits_(limits),
        parts_(node_parts(c.model, s.faces)),
        normals_(node_normals(c.scene.coordinates, s)) {
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const auto& [a, b] = s.points[i].edge;
      parts_.push_back(std::max(parts_[a] + 1, parts_[b] + 1) - 1);  // no part: the smallest value
      Vec sum = normals_[a] + normals_[b];
      if (s.points[i].point.place == "inner") sum = of_corners(s.points[i].segment.nodes);
      normals_[model_.nodes.size() + i] = unit_of(sum);
    }
  }

  PatchRule rule(const SideNode& node, const Face& f) const {
    PatchRule r;
    r.node = at(x_, node.node);
    for (std::size_t k = 0; k < 4; ++k) r.corner[k] = at(x_, f.nodes[k]);
    r.solid = f.solid_like();
    r.node_gap = node.gap;
    r.segment_gap = f.gap;
    const bool ignored = s_.set.inacti == 0;
    r.accepted = limits_.accepted;
    r.limit = ignored ? f.length : limits_.accepted;
    r.own_solid = r.solid && own_solid(node.node, f);
    const bool same = parts_[node.node] == part_of(f);
    r.rejects_part = same && !ignored && s_.set.ipen0 != 1;
    r.never_blocks = ignored || same || (node.gap + f.gap > 0 && r.solid);
    r.by_direction = r.solid && !ignored && s_.set.level != 3;
    r.direction = normals_[node.node];
    return r;
  }

 private:
  std::uint32_t part_of(const Face& f) const {
    return f.solid_like() ? (f.solid == no_index ? no_index : model_.solid8.part[f.solid])
                          : parts_[f.nodes[0]];
  }

  Vec of_corners(const Quad& n) const {
    const Vec first = normals_[n[0]] + normals_[n[1]] + normals_[n[2]];
    return n[2] == n[3] ? first : first + normals_[n[3]];
  }

  /// True if a solid at the node (point: at an end of its edge) has a corner of the segment.
  bool own_solid(NodeIndex node, const Face& f) const {
    if (node >= model_.nodes.size()) {
      const auto& [a, b] = s_.points[node - model_.nodes.size()].edge;
      return own_solid(a, f) || own_solid(b, f);
    }
    for (const std::uint32_t e : connectivity_.elements(ElementKind::solid8, node)) {
      const NodeIndex* slots = model_.solid8.of(e);
      for (const NodeIndex n : f.nodes)
        if (std::find(slots, slots + 8, n) != slots + 8) return true;
    }
    return false;
  }

  const Coordinates& x_;
  const Model& model_;
  Connectivity& connectivity_;
  const Sides& s_;
  const Limits24& limits_;
  std::vector<std::uint32_t> parts_;
  std::vector<Vec> normals_;
};

/// True if a node lies in the box of a segment with this reach: for the solver, and exactly.
PairConsidered in_box(const Coordinates& x, const Face& f, NodeIndex node,
                      const std::array<double, 3>& reach, bool decides) {
  const std::vector<double>* const axes[] = {&x.x, &x.y, &x.z};
  const double by = reach[0] + reach[1] + reach[2];
  PairConsidered out{true, true};
  bool sure = true;
  for (const std::vector<double>* axis : axes) {
    double low = (*axis)[f.nodes[0]], high = low;
    for (const NodeIndex n : f.nodes) {
      low = std::min(low, (*axis)[n]);
      high = std::max(high, (*axis)[n]);
    }
    const double v = (*axis)[node], inside = std::min(v - (low - by), (high + by) - v);
    out.solver = out.solver && v >= low - by && v <= high + by;
    const double off = 0x1p-48 * (std::fabs(v) + std::fabs(low) + std::fabs(high) + by);
    if (inside < -off) return {};
    sure = sure && inside > off;
  }
  out.exact = out.solver;
  if (sure || !decides) return out;
  std::array<Vec, 4> corner;
  for (std::size_t k = 0; k < 4; ++k) corner[k] = at(x, f.nodes[k]);
  out.exact = is_in_box(at(x, node), corner, reach);
  return out;
}

/// Doubtful pairs of one node.
class DoubtfulPairs24 {
 public:
  DoubtfulPairs24(bool nearest, double accepted) : nearest_(nearest), accepted_(accepted) {}
  void add(std::uint32_t number, const PatchFigures& f) {
    const double p = f.result.penetration;
    const bool blocks = std::fabs(p) < tiny_penetration || (p < 0 && f.result.blocks);
    if (!f.doubtful && (!f.result.exists || !(blocks || (p > 0 && p <= accepted_)))) return;
    const Kind kind = f.doubtful ? Kind::doubtful : blocks ? Kind::blocks : Kind::penetrates;
    const double least = f.doubtful ? f.least : f.result.distance - f.slack;
    pairs_.push_back({number, kind, least});
    if (nearest_ && !f.doubtful) most_ = std::min(most_, f.result.distance + f.slack);
  }
  /// True if exact arithmetic may find a penetration where double finds none, or the reverse.
  bool any() const {
    if (pairs_.empty()) return false;
    if (!nearest_) return pairs_.front().kind == Kind::doubtful;  // the first one decides
    bool kinds[3] = {};
    for (const Pair& p : pairs_)
      if (!(p.least > most_)) kinds[static_cast<std::size_t>(p.kind)] = true;
    return kinds[2] || (kinds[0] && kinds[1]);
  }
  /// Positions of the pairs that may decide, and of `another`; ascending.
  std::vector<std::uint32_t> needed(std::uint32_t another) const {
    std::vector<std::uint32_t> out{another};
    for (const Pair& p : pairs_)
      if (p.number != another && !(p.least > most_)) out.push_back(p.number);
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  enum class Kind : std::uint8_t { blocks, penetrates, doubtful };
  struct Pair {
    std::uint32_t number;
    Kind kind;
    double least;
  };
  bool nearest_;
  double accepted_, most_ = no_limit;  ///< the nearest pair is not farther, if it counts
  std::vector<Pair> pairs_;
};

class NodeByNode24 {
 public:
  NodeByNode24(const SceneContext& c, const Sides& s, const Limits24& limits, const Rules24& rules)
      : x_(c.scene.coordinates),
        s_(s),
        limits_(limits),
        rules_(rules),
        accuracy_(c.options.accuracy),
        decides_(accuracy_ >= Accuracy::robust && c.all_placed),
        nearest_(s.set.inacti != 0) {}

  /// Segments near a node, ascending.
  void search_node(std::span<const CandidatePair> near, NodeSearch& out) {
    numbers_.clear();
    pairs_.clear();
    differs_ = false;
    at_node_ = near.front().secondary;
    for (const CandidatePair& pair : near) add_pair(pair.main);
    for (const CandidatePair& pair : near)
      if (const std::uint32_t o = s_.faces[pair.main].opposite; o != no_index) add_pair(o);
    out.candidates += pairs_.size();
    if (pairs_.empty() && !differs_) return;
    const PatchChoice chosen = choose_pair(pairs_, nearest_, decides_);
    const PatchFigures& f = chosen.figures;
    NodePenetration best;
    best.in_contact = best.solver_acts = chosen.penetrates;
    if (chosen.penetrates) {
      const double p = f.result.penetration;
      best = {at_node_, numbers_[chosen.pair], p, f.gap, std::fabs(f.gap - p), f.normal};
    }
    if (decides_) {
      out.decisions.pairs += pairs_.size();
      if (accuracy_ == Accuracy::exact || chosen.doubtful || differs_)
        decide(chosen, best, out.decisions);
    }
    if (best.in_contact || best.solver_acts) out.penetrations.push_back(best);
  }

 private:
  void add_pair(std::uint32_t number) {
    const Face f = s_.face(number);
    const SideNode& node = s_.nodes[at_node_];
    const bool across =
        s_.set.level != 2 || (node.bits & from_group) != 0 || s_.across(node.bits, f.bits);
    const double margin = f.solid_like() ? limits_.solid_margin : s_.margin;
    if (f.stiffness == 0 || !across || on_own_edge(node.node, f)) return;
    const PairConsidered considered = in_box(x_, f, node.node, {margin, node.gap, f.gap}, decides_);
    if (!considered.solver && !considered.exact) return;
    if (considered.differs() && !std::exchange(differs_, true)) {
      exact_numbers_ = numbers_;
      exact_pairs_ = pairs_;
    }
    const PatchRule rule = rules_.rule(node, f);
    if (considered.solver) {
      numbers_.push_back(number);
      pairs_.push_back(rule);
    }
    if (considered.exact && differs_) {
      exact_numbers_.push_back(number);
      exact_pairs_.push_back(rule);
    }
  }

  /// True if a point's edge ends in a corner of the segment.
  bool on_own_edge(NodeIndex node, const Face& f) const {
    const std::size_t nodes = x_.x.size() - s_.points.size();
    if (node < nodes) return false;
    const auto& ends = s_.points[node - nodes].edge;
    return std::find_first_of(f.nodes.begin(), f.nodes.end(), ends.begin(), ends.end()) !=
           f.nodes.end();
  }

  /// In exact arithmetic. If the solver's segment has a penetration there, too, it stays.
  void decide(const PatchChoice& chosen, NodePenetration& best, DecisionReport& decisions) const {
    std::vector<PatchRule> pairs;
    std::vector<std::uint32_t> numbers;
    std::uint32_t asked = 0;
    if (differs_) {
      pairs = exact_pairs_;
      numbers = exact_numbers_;
    } else {
      for (const std::uint32_t i : chosen.needed) {
        if (i == chosen.pair) asked = static_cast<std::uint32_t>(pairs.size());
        pairs.push_back(pairs_[i]);
        numbers.push_back(numbers_[i]);
      }
    }
    if (!std::all_of(pairs.begin(), pairs.end(), [](const PatchRule& r) { return is_finite(r); }))
      return;
    decisions.fallback += pairs.size();
    decisions.exact += pairs.size();
    const ExactNode exact = exact_node(pairs, nearest_, asked);
    best.in_contact = exact.penetrates;
    best.solver_distance = best.distance;
    best.exact_distance = exact.distance;
    if (!exact.penetrates || (best.solver_acts && accuracy_ != Accuracy::exact)) return;
    const PatchFigures f = evaluate_patch(pairs[exact.pair], false);
    if (!best.solver_acts) best.solver_distance = f.height;
    best.node = at_node_;
    best.face = numbers[exact.pair];
    best.penetration = exact.depth;
    best.gap = exact.gap;
    best.distance = exact.distance;
    best.normal = f.normal;
  }

  const Coordinates& x_;
  const Sides& s_;
  const Limits24& limits_;
  const Rules24& rules_;
  Accuracy accuracy_;
  bool decides_, nearest_;
  std::uint32_t at_node_ = 0;
  std::vector<std::uint32_t> numbers_;
  std::vector<PatchRule> pairs_;
  bool differs_ = false;  ///< exact arithmetic has other pairs:
  std::vector<std::uint32_t> exact_numbers_;
  std::vector<PatchRule> exact_pairs_;
};

}  // namespace

PatchFigures evaluate_patch(const PatchRule& r, bool with_doubts) {
  PatchFigures out;
  Vec o, sum;
  for (const Vec& p : r.corner) o = o + 0.25 * p;
  double size = 0, largest = largest_component(r.node);
  for (std::size_t k = 0; k < 4; ++k) {
    sum = sum + cross(r.corner[k] - o, r.corner[(k + 1) % 4] - o);
    if (!with_doubts) continue;
    size = std::max(size, std::max(norm(r.corner[k] - o), norm(r.corner[k] - r.node)));
    largest = std::max(largest, largest_component(r.corner[k]));
  }
  const double area = 0.5 * norm(sum);
  out.normal = unit_of(sum);
  std::array<double, 4> a{}, c{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec &p = r.corner[k], &next = r.corner[(k + 1) % 4];
    a[k] = dot(out.normal, cross(p - o, next - o));
    c[k] = dot(out.normal, cross(p - r.node, next - r.node));
  }
  const auto flat = [&](double v) { return std::fabs(v) <= flat_patch * area; };
  const PatchPlace<double> place = place_on_patch(a, c, flat, flat);
  const Vec apart = r.node - closest_on_patch(r.corner, place);
  const double height = dot(out.normal, apart);
  const double away = place.outside ? norm(apart) : std::fabs(height);
  out.gap = r.node_gap + r.segment_gap;
  const bool same_way = !(dot(out.normal, r.direction) < 0);
  out.result = judge_patch(r, out.gap, height, away, place.outside, same_way);
  out.height = std::fabs(height);
  if (!with_doubts) return out;
  const bool sane = largest > 0x1p-200 && largest < 0x1p200;
  const FootError foot(r, a, c, place, area, size, largest);
  out.slack = sane && foot.shift < no_limit ? foot.shift + 2 * foot.turn * norm(apart) +
                                                  0x1p-50 * (out.gap + std::fabs(height))
                                            : no_limit;
  out.doubtful = is_doubtful(r, foot, out.gap, height, out.slack, out.normal);
  const double h = out.height;
  if (out.slack < no_limit)
    out.least = (r.solid ? h : std::min(h, std::fabs(out.gap - height))) - out.slack;
  return out;
}

PatchChoice choose_pair(std::span<const PatchRule> pairs, bool nearest, bool with_doubts) {
  PatchChoice out;
  const double accepted = pairs.empty() ? 0 : pairs.front().accepted;
  PatchState<double> state(nearest, accepted);
  DoubtfulPairs24 doubts(nearest, accepted);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const PatchFigures f = evaluate_patch(pairs[i], with_doubts);
    if (with_doubts) doubts.add(i, f);
    if (!state.accept(f.result)) continue;
    out.pair = i;
    out.figures = f;
  }
  out.penetrates = state.found();
  out.doubtful = with_doubts && doubts.any();
  if (with_doubts) out.needed = doubts.needed(out.pair);
  return out;
}

NodeSearch find_nodes24(SceneContext& c, Sides& s) {
  const Limits24 limits = limits_of(s);
  const PointsAsNodes with_points(c.scene.coordinates, s);
  NodeSearch out;
  out.largest_accepted = limits.accepted;
  const PairsByNode near = nodes_in_boxes(
      c, s, [&](const Face& f) { return f.solid_like() ? limits.solid_margin : s.margin; });
  out.complete = near.complete();
  if (!out.complete) return out;
  c.connectivity.prepare(ElementKind::solid8);
  const Rules24 rules(c, s, limits);
  const int threads = effective_threads(c.options.threads);
  std::vector<NodeSearch> parts(static_cast<std::size_t>(threads));
  parallel_parts(threads, s.nodes.size(),
                 [&](std::size_t part, std::size_t begin, std::size_t end) {
                   NodeByNode24 nodes(c, s, limits, rules);
                   NodeSearch mine;
                   near.for_each_node(begin, end, [&](std::span<const CandidatePair> pairs) {
                     nodes.search_node(pairs, mine);
                   });
                   parts[part] = std::move(mine);
                 });
  for (NodeSearch& part : parts) out.add(std::move(part));
  return out;
}

}  // namespace deck::detail::type24_25
