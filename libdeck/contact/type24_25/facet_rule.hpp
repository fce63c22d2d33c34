// Rule of TYPE25 for one node and one segment, as numbers without a deck; and exact decisions: if
// the solver considers the pair, which pair of a node counts, if it penetrates. Templates run in
// double and in exact numbers.
//
//    4 ------- 3    The segment is four facets around its centre 0 (triangle: one). The nearest one
//    | \     / |    counts. Depth = gap - h, with the signed height h over the facet (solids: h <=
//    0 |    0    |    only) and the gap interpolated from the corners. A free side has no neighbour
//    and | /     \ |    an outward direction beta: a node that overhangs it by its gap or more is
//    out; less 1 ------- 2    overhang reduces the depth by the shape of the border (Ishape). Over
//    other sides the
//                   node is out beyond the bisector with the neighbour.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/shared/vec.hpp"
#include "contact/shared/closest.hpp"

namespace deck::detail::type24_25 {

/// Position of a node at a segment, without its surroundings.
struct FacetPlace {
  enum class Kind : std::uint8_t { solid, coat, sheet };
  Vec node;
  std::array<Vec, 4> corner{};  ///< triangle: last two equal
  bool triangle = false;
  Kind kind = Kind::sheet;
  int ishape = 1;
  std::array<double, 4> corner_gap{};
  double node_gap = 0, most_gap = 1e300;  ///< Igap 3
};
/// Directions of the border at a corner of a segment.
struct BorderCorner {
  bool border = false;
  Vec first, second;  ///< directions of free sides that end here; null: none
};
/// Directions of sides and borders are the solver's single-precision values: exact input here.
struct FacetRule : FacetPlace {
  std::array<bool, 4> free{};  ///< sides without neighbour
  std::array<Vec, 4> beta{};   ///< direction of each side
  std::array<BorderCorner, 4> at_corner{};
};

/// Sum of two border directions in single precision.
inline Vec sum_single(const Vec& a, const Vec& b) {
  const auto sum = [](double u, double v) {
    return static_cast<double>(static_cast<float>(u) + static_cast<float>(v));
  };
  return {sum(a.x, b.x), sum(a.y, b.y), sum(a.z, b.z)};
}

/// False: a position is missing, or a direction exceeds single precision.
inline bool is_finite(const FacetRule& r) {
  bool all = is_finite(r.node) && std::isfinite(r.node_gap) && std::isfinite(r.most_gap);
  for (std::size_t k = 0; k < 4; ++k)
    all = all && is_finite(r.corner[k]) && is_finite(r.beta[k]) &&
          is_finite(r.at_corner[k].first) && is_finite(r.at_corner[k].second) &&
          std::isfinite(r.corner_gap[k]);
  return all;
}

/// A facet of a segment and the position of the node at it.
template <class T>
struct Facet {
  std::size_t side = 0;
  T a{}, b{};  ///< weights of its two corners before clamping
  T distance_squared{}, gap{};
  Point3<T> closest, normal;
  T behind{};       ///< distance of the node behind the facet, times the length of `normal`
  T normal_size{};  ///< squared length of `normal`
};

/// Steps of the rule for double and exact numbers: choice of the facet, depth, position beside the
/// segment or beyond its border, effect of the border on the depth. Self has the operations that
/// depend on the numbers:
///   root(v), length_of(facet)           roots; length of a facet's normal
///   near()                              depth of a node in front of the facet
///   past_bisector(to, out)              angle of two vectors
///   is_free(side), beta(side), on_border(corner), vertex(corner)   surroundings
///   note_doubt(number)                  the sign of this length decides
template <class Self, class T>
class FacetSteps {
 protected:
  using V = Point3<T>;
  using Kind = FacetPlace::Kind;

  explicit FacetSteps(const FacetPlace& place)
      : r_(place),
        q_(lift(place.node)),
        p_{lift(place.corner[0]), lift(place.corner[1]), lift(place.corner[2]),
           lift(place.corner[3])},
        centre_(place.triangle ? p_[2] : T(0.25) * (p_[0] + p_[1] + p_[2] + p_[3])),
        s_(place.node_gap) {}

  static V lift(const Vec& p) { return {T(p.x), T(p.y), T(p.z)}; }
  std::size_t facet_count() const { return r_.triangle ? 1 : 4; }
  bool thin() const { return r_.kind != Kind::solid || s_ > T(0); }

  /// Gap at weights of the centre and the two corners of a facet.
  T gap_at(std::size_t k, const T& o, const T& a, const T& b) const {
    const auto& g = r_.corner_gap;
    const T centre = r_.triangle ? T(g[2]) : T(T(0.25) * (T(g[0]) + T(g[1]) + T(g[2]) + T(g[3])));
    const T gap = s_ + o * centre + a * T(g[k]) + b * T(g[(k + 1) % 4]);
    return r_.most_gap < 1e300 ? scalar::smaller(gap, T(r_.most_gap)) : gap;
  }

  /// Squared distance beyond the height, for a foot beside the facet.
  static T excess_of(const Facet<T>& f) {
    return f.a >= T(0) && f.b >= T(0) ? T(0) : excess_beside(f);
  }
  static T excess_beside(const Facet<T>& f) {
    const T height = f.normal_size == T(0) ? T(0) : T(f.behind * f.behind / f.normal_size);
    return scalar::larger(T(0), T(f.distance_squared - height));
  }
  /// Among facets within 3 % of the least squared distance, the one with the least excess counts.
  void choose(std::span<const Facet<T>> all) {
    least_ = all[0].distance_squared;
    for (const Facet<T>& f : all) least_ = scalar::smaller(least_, f.distance_squared);
    const Facet<T>* best = nullptr;
    for (const Facet<T>& f : all) {
      if (f.distance_squared > T(1.03) * least_) continue;
      const T excess = excess_of(f);
      if (best != nullptr && excess >= excess_) continue;
      excess_ = excess;
      best = &f;
    }
    f_ = best == nullptr ? all[0] : *best;
  }

  /// Sets the depth by the facet f_. False: the node is beyond the segment's border or bisectors,
  /// without depth.
  bool judge() {
    const T length = self().length_of(f_);
    const T along = f_.normal_size == T(0) ? T(0) : T(f_.behind / f_.normal_size);
    behind_ = length == T(0) ? T(0) : T(f_.behind / length);
    beside_ = f_.a < T(-0.001) || f_.b < T(-0.001) || f_.a + f_.b > T(1.001);
    foot_ = q_ + along * f_.normal;
    depth_ = raw();
    const bool out = excluded();
    if (out) depth_ = T(0);
    if (thin() && depth_ != T(0)) at_border(length);
    return !out;
  }

  const FacetPlace r_;
  const V q_;
  const std::array<V, 4> p_;
  const V centre_;
  const T s_;  ///< gap of the node
  Facet<T> f_;
  T least_{}, excess_{};  ///< set by choose(): least squared distance; excess of f_
  T behind_{}, depth_{};
  bool beside_ = false;

  /// The single corner on a border among those with weight; 4 if none or several.
  std::size_t lone_border_corner() const {
    std::size_t found = 4, count = 0;
    const auto count_border = [&](std::size_t k) {
      if (!self().on_border(k)) return;
      found = k;
      ++count;
    };
    if (r_.triangle) {
      for (std::size_t k = 0; k < 3; ++k) count_border(k);
    } else {
      count_border(f_.side);
      count_border((f_.side + 1) % 4);
    }
    return count == 1 ? found : 4;
  }

 private:
  static constexpr std::array<std::size_t, 3> triangle_sides{0, 1, 3};

  Self& self() { return static_cast<Self&>(*this); }
  const Self& self() const { return static_cast<const Self&>(*this); }
  T length(const V& v) const { return self().root(dot(v, v)); }
  /// Overhang of the foot over a side, from the start of the side.
  T over(std::size_t side) const { return dot(foot_ - p_[side], lift(self().beta(side))); }

  T raw() {
    const bool behind = f_.behind > T(0);
    if (behind && r_.kind != Kind::sheet) return f_.gap + behind_;
    return behind || r_.kind == Kind::solid ? T(0) : self().near();
  }

  /// True for an overhang of at least the node's gap.
  bool hangs_over(const T& v) {
    self().note_doubt(v - s_);
    return v >= s_;
  }
  /// True if past the plane that halves the angle at a side, by more than a hundredth.
  bool past_bisector(std::size_t side) {
    const V out = cross(p_[(side + 1) % 4] - p_[side], lift(self().beta(side)));
    return self().past_bisector(p_[side] - q_, out);
  }
  bool past_corner() {
    const std::size_t k = lone_border_corner();
    if (k == 4 || !thin()) return false;
    const BorderCorner v = self().vertex(k);
    const V h = foot_ - p_[k];
    return hangs_over(dot(h, lift(v.first))) && hangs_over(dot(h, lift(v.second)));
  }

  bool excluded() {
    const bool turns = beside_ || f_.behind <= T(0);
    if (!r_.triangle) {
      if (self().is_free(f_.side) ? thin() && hangs_over(over(f_.side)) : past_corner())
        return true;
      return turns && past_bisector(f_.side);
    }
    bool any_free = false;
    for (const std::size_t side : triangle_sides) {
      if (!self().is_free(side)) continue;
      any_free = true;
      if (thin() && hangs_over(over(side))) return true;
    }
    if (!any_free && past_corner()) return true;
    if (!turns) return false;
    for (const std::size_t side : triangle_sides)
      if (!self().is_free(side) && past_bisector(side)) return true;
    return false;
  }

  /// Direction of the border beside the node, and the overhang; false if none.
  bool overhang(V& direction, T& v, int& times) {
    times = 1;
    if (!r_.triangle) {
      if (!self().is_free(f_.side)) return corner_overhang(direction, v);
      direction = lift(self().beta(f_.side));
      v = over(f_.side);
      return true;
    }
    if (!self().is_free(0) && !self().is_free(1) && !self().is_free(3))
      return corner_overhang(direction, v);
    times = 0;
    v = s_;
    for (const std::size_t side : triangle_sides) {
      if (!self().is_free(side)) continue;
      // The solver measures the last side from the centre and normalises it once more.
      const Vec beta = self().beta(side);
      const V b = lift(side == 3 ? unit(beta) : beta);
      const T here = dot(foot_ - (side == 3 ? centre_ : p_[side]), b);
      self().note_doubt(here - v);
      if (here >= v) continue;
      v = here;
      direction = b;
      ++times;
    }
    return times > 0;
  }
  bool corner_overhang(V& direction, T& v) {
    const std::size_t k = lone_border_corner();
    if (k == 4) return false;
    const BorderCorner at = self().vertex(k);
    const V h = foot_ - p_[k];
    const bool first = !hangs_over(dot(h, lift(at.first))),
               second = !hangs_over(dot(h, lift(at.second)));
    if (!first && !second) return false;
    direction = lift(first && second ? unit(sum_single(at.first, at.second))
                     : first         ? at.first
                                     : at.second);
    v = dot(h, direction);
    return true;
  }

  void at_border(const T& length) {
    V direction;
    T v(0);
    int times = 0;
    if (!overhang(direction, v, times)) return;
    for (int i = 0; i < times; ++i)
      if (r_.ishape == 1)
        square(v, length);
      else if (r_.ishape == 2)
        cylinder(v, direction);
  }

  void square(T& v, const T& normal_length) {
    const T &g = f_.gap, rim = g - s_;
    const T outside = scalar::smaller(v, T(-behind_ - rim));
    self().note_doubt(outside);
    if (outside > T(0)) {
      const T scale = normal_length == T(0) ? T(0) : T(rim / normal_length);
      const T d = length(q_ - (f_.closest + scale * f_.normal));
      self().note_doubt(d - T(1e-4));
      if (d > T(1e-4)) {
        self().note_doubt(s_ - d);
        depth_ = scalar::larger(T(0), T(s_ - d));
        return;
      }
    }
    v = v - s_;
    self().note_doubt(v);
    self().note_doubt(g + v);
    if (v < T(0) && g + v > T(0) && -behind_ >= g + v) self().note_doubt(g + behind_);
    if (v >= T(0))
      depth_ = T(0);
    else if (g + v > T(0))
      depth_ = -behind_ < g + v ? T(-v) : scalar::larger(T(0), T(g + behind_));
  }

  void cylinder(T& v, const V& direction) {
    const T& g = f_.gap;
    v = v - s_;
    self().note_doubt(v);
    self().note_doubt(g + v);
    if (!(v < T(0) && g + v > T(0))) return;
    const T d = length(q_ - (foot_ - T(g + v) * direction));
    self().note_doubt(d - T(1e-4));
    self().note_doubt(g - d);
    if (d > T(1e-4)) depth_ = scalar::larger(T(0), T(g - d));
  }

  V foot_;
};

/// The solver's grid: cells along each axis of a box.
struct SearchGrid {
  std::array<double, 3> low{}, size{}, cells{};
};
/// Reach of the solver's search around a segment; sums of numbers that it has.
struct SearchRule {
  Vec node;
  std::array<Vec, 4> corner{};
  bool triangle = false;
  std::array<double, 3> box{};    ///< extension of the segment's box: two gaps and a length
  std::array<double, 3> cells{};  ///< extension in the grid
  double most_gap = 1e300;        ///< Igap 3: replaces the gaps in the distance test
};
/// True if the pair is considered. Finite numbers only.
bool is_considered(const SearchRule& rule, const SearchGrid& grid);
/// True if a node lies in the box of a segment extended by `reach`. Finite numbers only.
bool is_in_box(const Vec& node, const std::array<Vec, 4>& corner,
               const std::array<double, 3>& reach);

/// Choice among the pairs of a node. Normally the nearest one that is not left out counts.
/// Round-off chooses among equally near ones: prefer one with the solver's result, then the last.
/// With adhesion (IVIS2 -1) a pair replaces the one before if its squared distance is at most the
/// value that one stores.
struct ExactChoice {
  std::uint32_t pair = 0;  ///< position in the list
  bool penetrates = false;
  double distance = 0, gap = 0;  ///< rounded once
  double depth = 0;              ///< rounded towards zero, but kept above 0
};
/// nullopt if all are left out. Finite numbers only.
std::optional<ExactChoice> exact_choice(std::span<const FacetRule> pairs, bool solver_penetrates,
                                        bool adhesion = false);

}  // namespace deck::detail::type24_25
