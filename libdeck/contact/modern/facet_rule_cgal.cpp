// The facet rule of TYPE25 in CGAL's exact numbers: the solver's formulas without their round-off.
// Roots are cut off after 300 binary digits, where they are compared with other lengths.
#include "contact/modern/facet_rule.hpp"

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/shared/exact_number.hpp"

namespace deck::detail::modern {
namespace {

using Q = LazyRational;
using V = Point3<Q>;

V lift(const Vec& p) { return {Q(p.x), Q(p.y), Q(p.z)}; }
Q root(const Q& square) {
  return CGAL::is_positive(square) ? Q(long_square_root(square.exact())) : Q(0);
}

class ExactRule {
 public:
  explicit ExactRule(const FacetRule& rule) : r_(rule), q_(lift(rule.node)), s_(rule.node_gap) {
    for (std::size_t k = 0; k < 4; ++k) p_[k] = lift(rule.corner[k]);
    centre_ = rule.triangle ? p_[2] : Q(0.25) * ((p_[0] + p_[1]) + (p_[2] + p_[3]));
  }

  const Q& distance_squared() const { return f_.distance_squared; }
  const Q& penetration() const { return depth_; }
  bool penetrates() const { return CGAL::is_positive(depth_); }
  /// With adhesion half of the gap is no penetration.
  void take_adhesion_off() { depth_ = std::max(Q(0), Q(depth_ - Q(0.5) * f_.gap)); }
  double gap() const { return rounded_towards_zero(f_.gap.exact()); }
  double depth() const {
    if (!penetrates()) return 0;
    const double depth = rounded_towards_zero(depth_.exact());
    return depth > 0 ? depth : std::numeric_limits<double>::denorm_min();
  }
  /// False: the pair is left out.
  bool counts(bool adhesion) {
    choose_facet();
    const bool sheet = r_.kind == FacetRule::Kind::sheet;
    if (sheet && CGAL::is_positive(f_.behind)) return false;
    beside_ = f_.a < Q(-0.001) || f_.b < Q(-0.001) || f_.a + f_.b > Q(1.001);
    foot_ = q_ + (CGAL::is_zero(f_.size) ? Q(0) : f_.behind / f_.size) * f_.normal;
    depth_ = raw();
    const bool out = excluded();
    if (out) depth_ = Q(0);
    if (out && (adhesion || r_.kind != FacetRule::Kind::solid)) return false;
    if (thin() && penetrates()) at_border();
    return !(adhesion && sheet) || penetrates();
  }

 private:
  struct Facet {
    std::size_t side = 0;
    Q a, b;  // weights before they are kept within the facet
    Q distance_squared, gap;
    V normal;        // not a unit vector
    Q size, behind;  // its square; the place behind times its length
    V closest;
  };

  Facet facet(std::size_t k) const {
    const V &p1 = p_[k], &p2 = p_[(k + 1) % 4];
    Facet f;
    f.side = k;
    f.normal = cross(p1 - centre_, p2 - centre_);
    f.size = dot(f.normal, f.normal);
    f.behind = dot(f.normal, centre_ - q_);
    if (CGAL::is_positive(f.size)) {
      f.a = dot(f.normal, cross(p2 - q_, centre_ - q_)) / f.size;
      f.b = dot(f.normal, cross(centre_ - q_, p1 - q_)) / f.size;
    }
    const auto c = closest_detail::reference_sub_triangle(q_, centre_, p1, p2);
    f.distance_squared = c.distance_squared;
    f.closest = q_ - c.vector;
    const auto gap = [&](std::size_t i) { return Q(r_.corner_gap[i % 4]); };
    const Q middle = r_.triangle ? gap(2) : Q(0.25) * ((gap(0) + gap(1)) + (gap(2) + gap(3)));
    f.gap = s_ + c.weight_o * middle + c.weight_a * gap(k) + c.weight_b * gap(k + 1);
    if (r_.most_gap < 1e300 && f.gap > Q(r_.most_gap)) f.gap = Q(r_.most_gap);
    return f;
  }

  void choose_facet() {
    std::vector<Facet> all;
    for (std::size_t k = 0; k < (r_.triangle ? 1U : 4U); ++k) all.push_back(facet(k));
    Q least = all[0].distance_squared;
    for (const Facet& f : all) least = std::min(least, f.distance_squared);
    bool found = false;
    Q best(0);
    for (const Facet& f : all) {
      if (f.distance_squared > Q(1.03) * least) continue;
      Q excess(0);
      if (CGAL::is_negative(f.a) || CGAL::is_negative(f.b)) {
        const Q square = CGAL::is_zero(f.size) ? Q(0) : f.behind * f.behind / f.size;
        excess = std::max(Q(0), Q(f.distance_squared - square));
      }
      if (found && excess >= best) continue;
      found = true;
      best = excess;
      f_ = f;
    }
    length_ = root(f_.size);
    behind_ = CGAL::is_zero(f_.size) ? Q(0) : Q(f_.behind / length_);
  }

  bool thin() const { return r_.kind != FacetRule::Kind::solid || CGAL::is_positive(s_); }
  Q raw() const {
    const bool behind = CGAL::is_positive(f_.behind);
    if (r_.kind != FacetRule::Kind::sheet && behind) return f_.gap + behind_;
    if (r_.kind == FacetRule::Kind::solid || !(f_.distance_squared < f_.gap * f_.gap)) return Q(0);
    return f_.gap - root(f_.distance_squared);
  }

  Q over(std::size_t side) const { return dot(foot_ - p_[side], lift(r_.beta[side])); }

  std::size_t lone_border_corner() const {
    std::size_t found = 4, count = 0;
    const auto look = [&](std::size_t k) {
      if (!r_.border[k]) return;
      found = k;
      ++count;
    };
    if (r_.triangle) {
      for (std::size_t k = 0; k < 3; ++k) look(k);
    } else {
      look(f_.side);
      look((f_.side + 1) % 4);
    }
    return count == 1 ? found : 4;
  }

  bool past_bisector(std::size_t side) const {
    const V out = cross(p_[(side + 1) % 4] - p_[side], lift(r_.beta[side])), to = p_[side] - q_;
    const Q along = dot(to, out);
    return CGAL::is_negative(along) &&
           along * along > Q(0.01) * Q(0.01) * dot(to, to) * dot(out, out);
  }

  bool past_corner() const {
    const std::size_t k = lone_border_corner();
    if (k == 4 || !thin()) return false;
    const V h = foot_ - p_[k];
    return dot(h, lift(r_.first[k])) >= s_ && dot(h, lift(r_.second[k])) >= s_;
  }

  bool excluded() const {
    const bool turns = beside_ || !CGAL::is_positive(f_.behind);
    if (!r_.triangle) {
      if (r_.free[f_.side] ? thin() && over(f_.side) >= s_ : past_corner()) return true;
      return turns && past_bisector(f_.side);
    }
    bool any_free = false;
    for (const std::size_t side : {0U, 1U, 3U}) {
      if (!r_.free[side]) continue;
      any_free = true;
      if (thin() && over(side) >= s_) return true;
    }
    if (!any_free && past_corner()) return true;
    for (const std::size_t side : {0U, 1U, 3U})
      if (turns && !r_.free[side] && past_bisector(side)) return true;
    return false;
  }

  bool overhang(V& direction, Q& v, int& times) const {
    times = 1;
    if (!r_.triangle && r_.free[f_.side]) {
      direction = lift(r_.beta[f_.side]);
      v = over(f_.side);
      return true;
    }
    if (!r_.triangle || (!r_.free[0] && !r_.free[1] && !r_.free[3])) {
      const std::size_t k = lone_border_corner();
      if (k == 4) return false;
      const V h = foot_ - p_[k];
      const bool first = dot(h, lift(r_.first[k])) < s_, second = dot(h, lift(r_.second[k])) < s_;
      if (!first && !second) return false;
      direction = lift(first && second ? r_.both[k] : first ? r_.first[k] : r_.second[k]);
      v = dot(h, direction);
      return true;
    }
    times = 0;
    v = s_;
    for (const std::size_t side : {0U, 1U, 3U}) {
      if (!r_.free[side]) continue;
      // As in double: the direction of the last side has its length taken out once more.
      const V b = lift(side == 3 ? unit(r_.beta[side]) : r_.beta[side]);
      const Q here = dot(foot_ - (side == 3 ? centre_ : p_[side]), b);
      if (here >= v) continue;
      v = here;
      direction = b;
      ++times;
    }
    return times > 0;
  }

  void at_border() {
    V direction;
    Q v(0);
    int times = 0;
    if (!overhang(direction, v, times)) return;
    for (int i = 0; i < times; ++i)
      if (r_.ishape == 1)
        square(v);
      else if (r_.ishape == 2)
        cylinder(v, direction);
  }

  static Q length(const V& v) { return root(dot(v, v)); }

  void square(Q& v) {
    const Q rim = f_.gap - s_;
    if (CGAL::is_positive(v) && CGAL::is_negative(behind_ + rim)) {
      const Q scale = CGAL::is_zero(length_) ? Q(0) : Q(rim / length_);
      const Q d = length(q_ - (f_.closest + scale * f_.normal));
      if (d > Q(1e-4)) {
        depth_ = std::max(Q(0), Q(s_ - d));
        return;
      }
    }
    v -= s_;
    if (!CGAL::is_negative(v))
      depth_ = Q(0);
    else if (CGAL::is_positive(f_.gap + v))
      depth_ = -behind_ < f_.gap + v ? Q(-v) : std::max(Q(0), Q(f_.gap + behind_));
  }

  void cylinder(Q& v, const V& direction) {
    v -= s_;
    if (!(CGAL::is_negative(v) && CGAL::is_positive(f_.gap + v))) return;
    const Q d = length(q_ - (foot_ - (f_.gap + v) * direction));
    if (d > Q(1e-4)) depth_ = std::max(Q(0), Q(f_.gap - d));
  }

  const FacetRule& r_;
  V q_;
  Q s_;
  std::array<V, 4> p_;
  V centre_;
  Facet f_;
  Q length_, behind_;
  V foot_;
  bool beside_ = false;
  Q depth_;
};

}  // namespace

std::optional<ExactChoice> exact_choice(std::span<const FacetRule> pairs, bool solver_penetrates,
                                        bool adhesion) {
  std::optional<ExactChoice> best;
  Q distance(0), most(0);  // of the one that counts; what another may have
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    ExactRule rule(pairs[i]);
    if (!rule.counts(adhesion)) continue;
    if (best && rule.distance_squared() > most) continue;
    if (adhesion) rule.take_adhesion_off();
    if (!adhesion && best && rule.distance_squared() == most &&
        best->penetrates == solver_penetrates && rule.penetrates() != solver_penetrates)
      continue;
    distance = rule.distance_squared();
    most = adhesion ? rule.penetration() : distance;
    best = ExactChoice{i, rule.penetrates(), 0, rule.gap(), rule.depth()};
  }
  if (best) best->distance = rounded_square_root(distance.exact());
  return best;
}

namespace {

Q sum_of(const std::array<double, 3>& v) { return Q(v[0]) + Q(v[1]) + Q(v[2]); }

/// The solver's cell of a coordinate.
Q cell_of(const SearchGrid& grid, std::size_t k, const Q& v) {
  Q share(0);
  if (grid.size[k] > 0)
    share =
        std::min(Q(grid.cells[k]), Q(Q(grid.cells[k]) * (v - Q(grid.low[k])) / Q(grid.size[k])));
  // Cut off at whole numbers, below 0 upwards.
  if (CGAL::is_negative(share)) return share > Q(-1) ? Q(2) : Q(1);
  // No whole number of cells has more digits than a double holds.
  Q whole(std::floor(CGAL::to_double(share)));
  while (whole > share) whole -= Q(1);
  while (whole + Q(1) <= share) whole += Q(1);
  return std::max(Q(1), Q(Q(2) + whole));
}

Q least_distance_squared(const LookRule& r) {
  std::array<V, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = lift(r.corner[k]);
  const V q = lift(r.node);
  if (r.triangle)
    return closest_detail::reference_sub_triangle(q, p[2], p[0], p[1]).distance_squared;
  const V o = Q(0.25) * ((p[0] + p[1]) + (p[2] + p[3]));
  Q least = closest_detail::reference_sub_triangle(q, o, p[0], p[1]).distance_squared;
  for (std::size_t k = 1; k < 4; ++k)
    least = std::min(
        least, closest_detail::reference_sub_triangle(q, o, p[k], p[(k + 1) % 4]).distance_squared);
  return least;
}

struct Span {
  Q low, high;
  bool holds(const Q& v) const { return v >= low && v <= high; }
};
double component(const Vec& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Of the corners along an axis, and farther on both sides.
Span span_of(const std::array<Vec, 4>& corner, std::size_t axis, const Q& reach) {
  double low = component(corner[0], axis), high = low;
  for (const Vec& c : corner) {
    low = std::min(low, component(c, axis));
    high = std::max(high, component(c, axis));
  }
  return {Q(low) - reach, Q(high) + reach};
}

}  // namespace

bool is_in_box(const Vec& node, const std::array<Vec, 4>& corner,
               const std::array<double, 3>& reach) {
  const Q sum = sum_of(reach);
  for (std::size_t k = 0; k < 3; ++k)
    if (!span_of(corner, k, sum).holds(Q(component(node, k)))) return false;
  return true;
}

bool is_looked_at(const LookRule& r, const SearchGrid& grid) {
  if (!is_in_box(r.node, r.corner, r.box)) return false;
  const Q in_cells = sum_of(r.cells);
  for (std::size_t k = 0; k < 3; ++k) {
    const Span covered = span_of(r.corner, k, in_cells);
    const Span cells{cell_of(grid, k, covered.low), cell_of(grid, k, covered.high)};
    if (!cells.holds(cell_of(grid, k, Q(component(r.node, k))))) return false;
  }
  Q gap = Q(r.box[0]) + Q(r.box[1]);
  if (gap > Q(r.most_gap)) gap = Q(r.most_gap);
  const Q far = gap + Q(r.box[2]);
  return CGAL::is_positive(far) && least_distance_squared(r) < far * far;
}

}  // namespace deck::detail::modern
