// Facet rule of TYPE25 in CGAL's exact numbers: the solver's formulas without round-off. Roots that
// are compared with other lengths are cut off after 300 binary digits.
#include "contact/type24_25/facet_rule.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/shared/exact_number.hpp"

namespace deck::detail::type24_25 {
namespace {

using Q = Rational;
using V = Point3<Q>;

class ExactRule : public FacetSteps<ExactRule, Q> {
 public:
  explicit ExactRule(const FacetRule& rule) : FacetSteps(rule), around_(rule) {}

  const Q& distance_squared() const { return f_.distance_squared; }
  const Q& penetration() const { return depth_; }
  bool penetrates() const { return CGAL::is_positive(depth_); }
  /// With adhesion half of the gap does not count as penetration.
  void subtract_adhesion() { depth_ = std::max(Q(0), Q(depth_ - Q(0.5) * f_.gap)); }
  double gap() const { return rounded_towards_zero(f_.gap); }
  double depth() const { return penetrates() ? rounded_positive_depth(depth_) : 0; }
  /// False if the pair is left out.
  bool counts(bool adhesion) {
    std::vector<Facet<Q>> all;
    for (std::size_t k = 0; k < facet_count(); ++k) all.push_back(facet(k));
    choose(all);
    const bool sheet = r_.kind == Kind::sheet;
    if (sheet && CGAL::is_positive(f_.behind)) return false;
    if (!judge() && (adhesion || r_.kind != Kind::solid)) return false;
    return !(adhesion && sheet) || penetrates();
  }

 private:
  friend FacetSteps;
  static Q root(const Q& square) { return long_square_root(square); }
  static Q length_of(const Facet<Q>& f) { return root(f.normal_size); }
  static void note_doubt(const Q&) {}

  Facet<Q> facet(std::size_t k) const {
    const V &p1 = p_[k], &p2 = p_[(k + 1) % 4];
    Facet<Q> f;
    f.side = k;
    f.normal = cross(p1 - centre_, p2 - centre_);
    f.normal_size = dot(f.normal, f.normal);
    f.behind = dot(f.normal, centre_ - q_);
    if (CGAL::is_positive(f.normal_size)) {
      f.a = dot(f.normal, cross(p2 - q_, centre_ - q_)) / f.normal_size;
      f.b = dot(f.normal, cross(centre_ - q_, p1 - q_)) / f.normal_size;
    }
    const auto c = closest_detail::reference_sub_triangle(q_, centre_, p1, p2);
    f.distance_squared = c.distance_squared;
    f.closest = q_ - c.vector;
    f.gap = gap_at(k, c.weight_o, c.weight_a, c.weight_b);
    return f;
  }
  Q near() const {
    if (!(f_.distance_squared < f_.gap * f_.gap)) return Q(0);
    return f_.gap - root(f_.distance_squared);
  }
  static bool past_bisector(const V& to, const V& out) {
    const Q along = dot(to, out);
    return CGAL::is_negative(along) &&
           along * along > Q(0.01) * Q(0.01) * dot(to, to) * dot(out, out);
  }
  bool is_free(std::size_t side) const { return around_.free[side]; }
  const Vec& beta(std::size_t side) const { return around_.beta[side]; }
  bool on_border(std::size_t corner) const { return around_.at_corner[corner].border; }
  const BorderCorner& vertex(std::size_t corner) const { return around_.at_corner[corner]; }

  const FacetRule& around_;
};

Q sum_of(const std::array<double, 3>& v) { return Q(v[0]) + Q(v[1]) + Q(v[2]); }

/// Cell of a coordinate in the solver's grid.
Q cell_of(const SearchGrid& grid, std::size_t k, const Q& v) {
  Q share(0);
  if (grid.size[k] > 0)
    share =
        std::min(Q(grid.cells[k]), Q(Q(grid.cells[k]) * (v - Q(grid.low[k])) / Q(grid.size[k])));
  // Truncated towards 0.
  if (CGAL::is_negative(share)) return share > Q(-1) ? Q(2) : Q(1);
  // No number of cells has more digits than a double.
  Q whole(std::floor(CGAL::to_double(share)));
  while (whole > share) whole -= Q(1);
  while (whole + Q(1) <= share) whole += Q(1);
  return std::max(Q(1), Q(Q(2) + whole));
}

Q least_distance_squared(const SearchRule& r) {
  std::array<V, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = to_exact(r.corner[k]);
  const V q = to_exact(r.node);
  if (r.triangle)
    return closest_detail::reference_sub_triangle(q, p[2], p[0], p[1]).distance_squared;
  const V o = Q(0.25) * ((p[0] + p[1]) + (p[2] + p[3]));
  Q least = closest_detail::reference_sub_triangle(q, o, p[0], p[1]).distance_squared;
  for (std::size_t k = 1; k < 4; ++k)
    least = std::min(
        least, closest_detail::reference_sub_triangle(q, o, p[k], p[(k + 1) % 4]).distance_squared);
  return least;
}

struct AxisRange {
  Q low, high;
  bool holds(const Q& v) const { return v >= low && v <= high; }
};
double component(const Vec& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Range of the corners along an axis, extended by `reach`.
AxisRange span_of(const std::array<Vec, 4>& corner, std::size_t axis, const Q& reach) {
  double low = component(corner[0], axis), high = low;
  for (const Vec& c : corner) {
    low = std::min(low, component(c, axis));
    high = std::max(high, component(c, axis));
  }
  return {Q(low) - reach, Q(high) + reach};
}

}  // namespace

std::optional<ExactChoice> exact_choice(std::span<const FacetRule> pairs, bool solver_penetrates,
                                        bool adhesion) {
  std::optional<ExactChoice> best;
  Q distance(0), most(0);  // of the present choice; largest possible for another
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    ExactRule rule(pairs[i]);
    if (!rule.counts(adhesion)) continue;
    if (best && rule.distance_squared() > most) continue;
    if (adhesion) rule.subtract_adhesion();
    if (!adhesion && best && rule.distance_squared() == most &&
        best->penetrates == solver_penetrates && rule.penetrates() != solver_penetrates)
      continue;
    distance = rule.distance_squared();
    most = adhesion ? rule.penetration() : distance;
    best = ExactChoice{i, rule.penetrates(), 0, rule.gap(), rule.depth()};
  }
  if (best) best->distance = rounded_square_root(distance);
  return best;
}

bool is_in_box(const Vec& node, const std::array<Vec, 4>& corner,
               const std::array<double, 3>& reach) {
  const Q sum = sum_of(reach);
  for (std::size_t k = 0; k < 3; ++k)
    if (!span_of(corner, k, sum).holds(Q(component(node, k)))) return false;
  return true;
}

bool is_considered(const SearchRule& r, const SearchGrid& grid) {
  if (!is_in_box(r.node, r.corner, r.box)) return false;
  const Q in_cells = sum_of(r.cells);
  for (std::size_t k = 0; k < 3; ++k) {
    const AxisRange covered = span_of(r.corner, k, in_cells);
    const AxisRange cells{cell_of(grid, k, covered.low), cell_of(grid, k, covered.high)};
    if (!cells.holds(cell_of(grid, k, Q(component(r.node, k))))) return false;
  }
  Q gap = Q(r.box[0]) + Q(r.box[1]);
  if (gap > Q(r.most_gap)) gap = Q(r.most_gap);
  const Q far = gap + Q(r.box[2]);
  return CGAL::is_positive(far) && least_distance_squared(r) < far * far;
}

}  // namespace deck::detail::type24_25
