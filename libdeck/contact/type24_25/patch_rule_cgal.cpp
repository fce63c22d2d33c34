// Patch rule of TYPE24 in CGAL's exact numbers: the solver's formulas without round-off. Roots that
// are compared with other lengths are cut off after 300 binary digits.
#include "contact/type24_25/patch_rule.hpp"

#include "contact/shared/exact_number.hpp"

namespace deck::detail::type24_25 {
namespace {

/// A pair; empty if the patch has area 0.
class ExactPatch {
 public:
  using Q = Rational;
  using V = Point3<Q>;

  explicit ExactPatch(const PatchRule& r) : gap_(Q(r.node_gap) + Q(r.segment_gap)) {
    std::array<V, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = to_exact(r.corner[k]);
    const V q = to_exact(r.node), o = Q(0.25) * (p[0] + p[1] + p[2] + p[3]);
    V n;
    for (std::size_t k = 0; k < 4; ++k) n = n + cross(p[k] - o, p[(k + 1) % 4] - o);
    const Q size = dot(n, n);
    if (CGAL::is_zero(size)) return;
    std::array<Q, 4> a, c;
    for (std::size_t k = 0; k < 4; ++k) {
      a[k] = dot(n, cross(p[k] - o, p[(k + 1) % 4] - o));
      c[k] = dot(n, cross(p[k] - q, p[(k + 1) % 4] - q));
    }
    // The solver's limits refer to a unit normal; this normal is twice the area long.
    const Q flat = Q(flat_patch) * Q(0.5), square = flat * flat * size * size * size;
    if (CGAL::is_zero(a[0]) && CGAL::abs(a[2]) <= flat * size) return;
    const PatchPlace<Q> place = place_on_patch(
        a, c, [&](const Q& v) { return CGAL::abs(v) <= flat * size; },
        [&](const Q& v) { return v * v <= square; });
    const V apart = q - closest_on_patch(p, place);
    const Q along = dot(n, apart), height_squared = along * along / size;
    // A root equal to the gap needs no digits.
    Q height =
        height_squared == gap_ * gap_ ? Q(CGAL::abs(gap_)) : long_square_root(height_squared);
    distance_ = height;
    const Q away = place.outside ? long_square_root(dot(apart, apart)) : height;
    if (CGAL::is_negative(along)) height = -height;
    const bool same_way = !CGAL::is_negative(dot(n, to_exact(r.direction)));
    result_ = judge_patch(r, gap_, height, away, place.outside, same_way);
    defined_ = true;
  }

  const PatchResult<Q>* result() const { return defined_ ? &result_ : nullptr; }
  void figures(ExactNode& out) const {
    out.gap = rounded_towards_zero(gap_);
    out.distance = rounded_towards_zero(distance_);
    if (out.penetrates) out.depth = rounded_positive_depth(result_.penetration);
  }

 private:
  Q gap_, distance_;
  bool defined_ = false;
  PatchResult<Q> result_;
};

}  // namespace

ExactNode exact_node(std::span<const PatchRule> pairs, bool nearest, std::uint32_t asked) {
  ExactNode out;
  if (pairs.empty()) return out;
  PatchState<ExactPatch::Q> state(nearest, pairs.front().accepted);
  std::optional<ExactPatch> best, other;
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const ExactPatch patch(pairs[i]);
    if (i == asked) other = patch;
    if (patch.result() == nullptr || !state.accept(*patch.result())) continue;
    best = patch;
    out.pair = i;
  }
  out.penetrates = state.found();
  if (!out.penetrates) out.pair = asked;
  if (const auto& of = out.penetrates ? best : other) of->figures(out);
  return out;
}

}  // namespace deck::detail::type24_25
