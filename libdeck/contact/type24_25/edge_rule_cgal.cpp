// Edge rules of TYPE25 (sheets, and faces of solids) in CGAL's exact numbers: the solver's formulas
// without round-off. Roots are cut off after 300 binary digits.
#include "contact/type24_25/edge_rule.hpp"

#include <CGAL/Interval_nt.h>

#include <optional>

#include "contact/shared/exact_number.hpp"
#include "contact/type24_25/through_rule.hpp"

namespace deck::detail::type24_25 {

ExactEdgePair exact_edge_pair(const EdgeRule& r) {
  using Q = Rational;
  const auto root = [](const Q& square) { return long_square_root(square); };
  const auto same = [](const Point3<Q>& v) { return v; };
  const auto ends = [&](const RuleEdge& e) {
    std::array<Point3<Q>, 2> out{to_exact(e.end[0]), to_exact(e.end[1])};
    for (std::size_t k = 0; k < 2 && e.recessed; ++k)
      out[k] =
          moved_inward(out[k], Q(e.inward), to_exact(e.beta), to_exact(e.border[k]), root, same);
    return out;
  };
  const auto s = ends(r.secondary), m = ends(r.main);
  const EdgeClosest<Q> c = closest_between_edges<Form::reference>(s[0], s[1], m[0], m[1]);
  Q gap = Q(r.main.gap) + Q(r.secondary.gap);
  if (gap > Q(r.most_gap)) gap = Q(r.most_gap);
  const auto beside = [&](const RuleEdge& e, const Q& along) {
    const Q tilt(edge_tilt);
    return e.one_sided && CGAL::is_positive(along) &&
           along * along > tilt * tilt * c.distance_squared;
  };
  const auto over = [&](const RuleEdge& e) { return dot(c.vector, to_exact(e.beta)); };
  ExactEdgePair out;
  out.gap = rounded_towards_zero(gap);
  out.distance = rounded_square_root(c.distance_squared);
  out.penetrates = CGAL::is_positive(gap) && c.distance_squared < gap * gap &&
                   !beside(r.main, Q(-over(r.main))) && !beside(r.secondary, over(r.secondary));
  if (!out.penetrates) return out;
  const Q distance = long_square_root(c.distance_squared);
  out.depth = rounded_positive_depth(Q(gap - distance));
  return out;
}

namespace {

/// nullopt: intervals do not decide.
std::optional<bool> told_by_intervals(const ThroughRule& r) {
  using Range = CGAL::Interval_nt<false>;
  try {
    const Range::Protector rounding;
    const auto root = [](const Range& square) { return CGAL::sqrt(CGAL::max(Range(0), square)); };
    Range depth(0);
    return ThroughSide<Range, decltype(root)>(r, root).passes(depth);
  } catch (const CGAL::Uncertain_conversion_exception&) {
    return std::nullopt;
  }
}

}  // namespace

ThroughFigures exact_through(const ThroughRule& r, bool figures, std::uint64_t& exact) {
  const std::optional<bool> told = told_by_intervals(r);
  if (told && (!*told || !figures)) return {*told, 0};
  ++exact;
  using Q = Rational;
  const auto root = [](const Q& square) { return long_square_root(square); };
  ThroughFigures out;
  Q depth(0);
  out.passes = ThroughSide<Q, decltype(root)>(r, root).passes(depth);
  if (out.passes) out.depth = rounded_towards_zero(depth);
  return out;
}

}  // namespace deck::detail::type24_25
