// One node and one segment of a TYPE25 in double, with its doubts: facet, depth, position beside
// the segment or beyond its border, effect of the border. facet_rule.hpp has the steps.
#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/shared/filtered.hpp"
#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

double within01(double v) { return std::max(0.0, std::min(1.0, v)); }

/// Closest point of a facet by the rule of all contacts, in the operation order of this type: the
/// last digit decides between equally near segments. Sets `o`, `a`, `b` to the weights of the
/// centre and the two corners.
Facet<double> facet_of(const std::array<Vec, 4>& p, const Vec& centre, std::size_t k, const Vec& q,
                       double& o, double& a, double& b) {
  const Vec &p0 = centre, &p1 = p[k], &p2 = p[(k + 1) % 4];
  const Vec u = p1 - p0, v = p2 - p0, n = cross(u, v);
  const Vec r0 = p0 - q, r1 = p1 - q, r2 = p2 - q;
  Facet<double> f;
  f.side = k;
  f.normal = unit(n);
  f.normal_size = 1;
  f.behind = dot(f.normal, r0);
  const double size = std::max(1e-15, norm(n));
  const Vec direction = unit_of(n);
  f.a = a = dot(direction, cross(r2, r0)) / size;
  f.b = b = dot(direction, cross(r0, r1)) / size;
  o = 1 - a - b;
  const Vec e = p2 - p1;
  const double ee = std::max(1e-20, dot(e, e)), vv = std::max(1e-30, dot(v, v)),
               uu = std::max(1e-30, dot(u, u));
  const double ho = o * std::fabs(o) / ee, ha = a * std::fabs(a) / vv, hb = b * std::fabs(b) / uu;
  if (o < 0 && ho <= ha && ho <= hb) {
    a = within01(dot(r2, e) * (1 / ee));
    b = 1 - a;
    o = 0;
  } else if (a < 0 && ha <= hb && ha <= ho) {
    a = 0;
    b = within01(-dot(r0, v) * (1 / vv));
    o = 1 - b;
  } else if (b < 0 && hb <= ho && hb <= ha) {
    b = 0;
    a = within01(-dot(r0, u) * (1 / uu));
    o = 1 - a;
  }
  f.closest = o * p0 + a * p1 + b * p2;
  const Vec d = q - f.closest;
  f.distance_squared = dot(d, d);
  return f;
}

FacetPlace place_of(const Coordinates& x, const Sides& sides, const SideNode& node, const Face& f) {
  FacetPlace r;
  r.node = at(x, node.node);
  for (std::size_t k = 0; k < 4; ++k) {
    r.corner[k] = at(x, f.nodes[k]);
    r.corner_gap[k] = sides.main_gap[f.nodes[k]];
  }
  r.triangle = f.triangle();
  r.kind = f.sheet()                      ? FacetPlace::Kind::sheet
           : f.kind == SegmentKind::solid ? FacetPlace::Kind::solid
                                          : FacetPlace::Kind::coat;
  r.ishape = sides.set.ishape;
  r.node_gap = node.gap;
  if (sides.set.local()) r.most_gap = node.length + f.length;
  return r;
}

/// The rule in double; collects doubts that round-off may change the result.
class PairInDouble : public FacetSteps<PairInDouble, double> {
 public:
  PairInDouble(const Coordinates& x, const Sides& sides, const Topology& t, const SideNode& node,
               std::uint32_t face, unsigned facets, double slack)
      : FacetSteps(place_of(x, sides, node, sides.face(face))),
        t_(t),
        facets_(facets),
        slack_(slack),
        at_face_(face) {}

  PairFigures figures() {
    choose_facet();
    PairFigures out = of_facet();
    if (slack_ < 0) return out;
    // Exact arithmetic may choose another facet: mostly without effect.
    const Facet<double> chosen = f_;
    for (std::size_t i = 0; i < others_; ++i) {
      nearest_ = nearest_ && other_[i].distance_squared == f_.distance_squared;
      f_ = other_[i];
      const PairFigures o = of_facet();
      doubtful_ =
          doubtful_ || left_out(o) != left_out(out) || (o.penetration > 0) != (out.penetration > 0);
    }
    f_ = chosen;
    out.other_facets = others_ > 0;
    out.doubtful = doubtful_ || !(slack_ < no_limit);
    return out;
  }

  FacetRule rule() const {
    FacetRule r{r_};
    for (std::size_t k = 0; k < 4; ++k) {
      r.free[k] = !(r_.triangle && k == 2) && is_free(k);
      r.beta[k] = beta(k);
      r.at_corner[k] = vertex(k);
    }
    return r;
  }

 private:
  friend FacetSteps;
  static double root(double v) { return std::sqrt(v); }
  static double length_of(const Facet<double>&) { return 1; }

  bool left_out(const PairFigures& p) const {
    return (r_.kind == Kind::sheet && p.behind > 0) || (p.excluded && r_.kind != Kind::solid);
  }
  /// Doubt if round-off may change the sign of a length, or of a number with error `by`.
  void note_doubt(double length) { note_doubt(length, 4 * slack_); }
  void note_doubt(double number, double by) { doubtful_ = doubtful_ || !(std::fabs(number) > by); }

  /// Nodes on a segment or exactly at the gap are frequent: exact sums and products of integers
  /// decide them.
  void note_side_doubt() {
    if (slack_ < 0 || std::fabs(f_.behind) > slack_) return;
    const bool on_it = nearest_ && slack_ < no_limit && f_.distance_squared <= slack_ * slack_ &&
                       is_touching(q_, p_, r_.triangle);
    doubtful_ = doubtful_ || !on_it || f_.behind > 0;
  }
  void note_gap_doubt(double room) {
    if (slack_ < 0 || std::fabs(room) > slack_) return;
    const double corner = r_.corner_gap[0];
    const bool even = std::all_of(r_.corner_gap.begin(), r_.corner_gap.end(),
                                  [&](double gap) { return gap == corner; });
    if (!even || !nearest_ || r_.most_gap < 1e300 || !(slack_ < no_limit) || is_bordered()) {
      doubtful_ = true;
      return;
    }
    // Exact comparison between the gap and the next double.
    const double gap = s_ + corner, back = gap - s_;
    const double rest = (s_ - (gap - back)) + (corner - back);
    const bool closer = is_closer_than(q_, p_, r_.triangle, gap);
    const double next = std::nextafter(gap, rest > 0 ? no_limit : 0);
    doubtful_ = doubtful_ || closer != (room > 0) ||
                (rest != 0 && is_closer_than(q_, p_, r_.triangle, next) != closer);
  }
  /// True if a border beside the facet may change the depth.
  bool is_bordered() const {
    if (lone_border_corner() != 4) return true;
    if (!r_.triangle) return is_free(f_.side);
    return is_free(0) || is_free(1) || is_free(3);
  }
  /// The bisector test depends only on the foot lying beside a facet whose back has the node.
  void note_bisector_doubt() {
    if (!(f_.behind > 0)) return;
    const double by = 0x1p-30 * (1 + std::fabs(f_.a) + std::fabs(f_.b));
    note_doubt(f_.a + 0.001, by);
    note_doubt(f_.b + 0.001, by);
    note_doubt(f_.a + f_.b - 1.001, by);
  }

  PairFigures of_facet() {
    PairFigures out;
    out.gap = f_.gap;
    out.distance_squared = f_.distance_squared;
    out.behind = f_.behind;
    out.normal = f_.normal;
    note_side_doubt();
    if (r_.kind == Kind::sheet && f_.behind > 0) return out;
    note_bisector_doubt();
    out.excluded = !judge();
    out.beside = beside_;
    out.penetration = depth_;
    return out;
  }

  /// Least and largest excess that exact arithmetic may find. It jumps where a weight turns
  /// negative while the foot is beyond the third side.
  std::pair<double, double> excesses_of(const Facet<double>& f) const {
    const Vec &p1 = p_[f.side], &p2 = p_[(f.side + 1) % 4];
    const double reach = norm(centre_ - q_) + norm(p1 - q_) + norm(p2 - q_),
                 by = 4 * slack_ * reach / norm(cross(p1 - centre_, p2 - centre_)),
                 weight = std::min(f.a, f.b), excess = excess_of(f);
    return {weight < -by ? excess : 0, weight >= by ? excess : excess_beside(f)};
  }
  /// Facets that exact arithmetic may choose instead.
  void note_others(std::span<const Facet<double>> all) {
    const double by = 4 * slack_ * (std::sqrt(f_.distance_squared) + slack_);
    if (f_.distance_squared != least_) note_doubt(1.03 * least_ - f_.distance_squared, by);
    double most = excesses_of(f_).second;
    for (const Facet<double>& f : all)
      if (f.distance_squared < 1.03 * least_ - by) most = std::min(most, excesses_of(f).second);
    for (const Facet<double>& f : all) {
      if (f.side == f_.side || f.distance_squared > 1.03 * least_ + by) continue;
      if (excesses_of(f).first <= most + by) other_[others_++] = f;
    }
  }
  void choose_facet() {
    std::array<Facet<double>, 4> all;
    std::size_t count = 0;
    for (std::size_t k = 0; k < facet_count(); ++k) {
      if ((facets_ >> k & 1U) == 0) continue;
      double o = 0, a = 0, b = 0;
      Facet<double>& f = all[count++] = facet_of(p_, centre_, k, q_, o, a, b);
      f.gap = gap_at(k, o, a, b);
    }
    const auto some = std::span<const Facet<double>>(all).first(std::max<std::size_t>(count, 1));
    choose(some);
    nearest_ = f_.distance_squared == least_;
    if (slack_ >= 0 && slack_ < no_limit) note_others(some);
  }

  double near() {
    const double room = f_.gap - std::sqrt(f_.distance_squared);
    note_gap_doubt(room);
    return std::max(0.0, room);
  }
  bool past_bisector(const Vec& to, const Vec& out) {
    const double size = norm(to) * norm(out);
    if (!(size > 0)) return false;
    const double cosine = dot(to, out) / size;
    note_doubt(cosine + 0.01, 0x1p-30 + 4 * slack_ / norm(to));
    return cosine < -0.01;
  }

  /// Cached.
  const Topology::Across& across(std::size_t side) const {
    std::optional<Topology::Across>& known = across_[side];
    if (!known) known = t_.across(at_face_, static_cast<std::uint32_t>(side));
    return *known;
  }
  Vec beta(std::size_t side) const {
    return t_.direction(at_face_, static_cast<std::uint32_t>(side), across(side));
  }
  bool is_free(std::size_t side) const { return across(side).free(); }
  bool on_border(std::size_t corner) const {
    return t_.on_border(at_face_, static_cast<std::uint32_t>(corner));
  }
  BorderCorner vertex(std::size_t corner) const {
    return t_.vertex(at_face_, static_cast<std::uint32_t>(corner));
  }

  const Topology& t_;
  unsigned facets_;
  double slack_;
  std::uint32_t at_face_;
  mutable std::array<std::optional<Topology::Across>, 4> across_;
  std::array<Facet<double>, 3> other_;
  std::size_t others_ = 0;
  bool nearest_ = false;  ///< no facet is nearer
  bool doubtful_ = false;
};

}  // namespace

double facet_distance_squared(const Coordinates& x, const Face& face, NodeIndex node,
                              unsigned facets) {
  std::array<Vec, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = at(x, face.nodes[k]);
  const Vec centre = face.triangle() ? p[2] : 0.25 * (p[0] + p[1] + p[2] + p[3]);
  const Vec q = at(x, node);
  double least = 0;
  bool any = false;
  for (std::size_t k = 0; k < (face.triangle() ? 1U : 4U); ++k) {
    if ((facets >> k & 1U) == 0) continue;
    double o = 0, a = 0, b = 0;
    const double d = facet_of(p, centre, k, q, o, a, b).distance_squared;
    least = any ? std::min(least, d) : d;
    any = true;
  }
  return least;
}

PairFigures evaluate_pair(const Coordinates& x, const Sides& sides, const Topology& topology,
                          const SideNode& node, std::uint32_t face, unsigned facets, double slack) {
  return PairInDouble(x, sides, topology, node, face, facets, slack).figures();
}

FacetRule facet_rule(const Coordinates& x, const Sides& sides, const Topology& topology,
                     const SideNode& node, std::uint32_t face) {
  return PairInDouble(x, sides, topology, node, face, all_facets, -1).rule();
}

}  // namespace deck::detail::type24_25
