// One node and one segment of a TYPE25: the facet that counts, the depth, whether the node lies
// beside the segment or beyond its border, and what the border's shape makes of the depth.
#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/modern/parts.hpp"
#include "contact/shared/filtered.hpp"

namespace deck::detail::modern {
namespace {

/// A facet of a segment and the node's place against it.
struct Facet {
  std::size_t side = 0;
  double a = 0, b = 0;  ///< weights of its two corners before they are kept within the facet
  double distance_squared = 0, behind = 0, gap = 0;
  Vec normal, closest;
};

struct Corners {
  std::array<Vec, 4> p;
  Vec centre;
  std::size_t facets = 4;
};

Corners corners_of(const Coordinates& x, const Face& f) {
  Corners c;
  for (std::size_t k = 0; k < 4; ++k) c.p[k] = at(x, f.nodes[k]);
  c.centre = c.p[2];
  if (f.triangle())
    c.facets = 1;
  else
    c.centre = 0.25 * (c.p[0] + c.p[1] + c.p[2] + c.p[3]);
  return c;
}

double within01(double v) { return std::max(0.0, std::min(1.0, v)); }

/// The closest point of a facet by the rule of all contacts, in the order of operations of this
/// type: which of two equally near segments counts hangs on the last digit. `o`, `a`, `b` become
/// the weights of the centre and the two corners.
Facet facet_of(const Corners& c, std::size_t k, const Vec& q, double& o, double& a, double& b) {
  const Vec &p0 = c.centre, &p1 = c.p[k], &p2 = c.p[(k + 1) % 4];
  const Vec u = p1 - p0, v = p2 - p0, n = cross(u, v);
  const Vec r0 = p0 - q, r1 = p1 - q, r2 = p2 - q;
  Facet f;
  f.side = k;
  f.normal = unit(n);
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

class Pair {
 public:
  Pair(const Coordinates& x, const Sides& sides, const Topology& t, const SideNode& node,
       std::uint32_t face, unsigned facets, double slack)
      : set_(sides.set),
        t_(t),
        node_(node),
        main_gap_(sides.main_gap),
        face_(sides.face(face)),
        facets_(facets),
        slack_(slack),
        at_face_(face),
        q_(at(x, node.node)),
        c_(corners_of(x, face_)) {}

  PairFigures figures() {
    choose_facet();
    PairFigures out = of_facet();
    if (slack_ < 0) return out;
    // Another facet may be the one in exact arithmetic: mostly it makes no difference.
    const Facet chosen = f_;
    for (std::size_t i = 0; i < others_; ++i) {
      nearest_ = nearest_ && other_[i].distance_squared == f_.distance_squared;
      f_ = other_[i];
      const PairFigures o = of_facet();
      doubtful_ =
          doubtful_ || left_out(o) != left_out(out) || (o.penetration > 0) != (out.penetration > 0);
    }
    f_ = chosen;
    out.other_facets = others_ > 0;
    out.doubtful = doubtful_ || !(slack_ < never);
    return out;
  }

  FacetRule rule() const {
    FacetRule r;
    r.node = q_;
    r.corner = c_.p;
    r.triangle = face_.triangle();
    r.kind = face_.sheet()                      ? FacetRule::Kind::sheet
             : face_.kind == SegmentKind::solid ? FacetRule::Kind::solid
                                                : FacetRule::Kind::coat;
    r.ishape = set_.ishape;
    for (std::size_t k = 0; k < 4; ++k) r.corner_gap[k] = main_gap_[face_.nodes[k]];
    r.node_gap = node_.gap;
    if (set_.local()) r.most_gap = node_.length + face_.length;
    for (std::size_t k = 0; k < 4; ++k) {
      r.free[k] = face_.nodes[k] != face_.nodes[(k + 1) % 4] && is_free(k);
      r.beta[k] = beta(k);
      const Topology::Vertex v = vertex(k);
      r.border[k] = v.border;
      r.first[k] = v.first;
      r.second[k] = v.second;
      r.both[k] = unit(sum_single(v.first, v.second));
    }
    return r;
  }

 private:
  bool thin() const { return face_.kind != SegmentKind::solid || node_.gap > 0; }
  bool left_out(const PairFigures& p) const {
    return (face_.sheet() && p.behind > 0) || (p.excluded && face_.kind != SegmentKind::solid);
  }
  /// Round-off may turn the sign of a length, or of another number that it changes by `by`.
  void weigh(double length) { weigh(length, slack_); }
  void weigh(double number, double by) { doubtful_ = doubtful_ || !(std::fabs(number) > by); }

  /// Nodes that lie on a segment, and those exactly at the gap, are frequent: sums and products of
  /// integers tell them.
  void weigh_side() {
    if (slack_ < 0 || std::fabs(f_.behind) > slack_) return;
    const bool on_it = nearest_ && slack_ < never && f_.distance_squared <= slack_ * slack_ &&
                       is_touching(q_, c_.p, face_.triangle());
    doubtful_ = doubtful_ || !on_it || f_.behind > 0;
  }
  void weigh_room(double room) {
    if (slack_ < 0 || std::fabs(room) > slack_) return;
    const double corner = main_gap_[face_.nodes[0]];
    const bool even = std::all_of(face_.nodes.begin(), face_.nodes.end(),
                                  [&](NodeIndex n) { return main_gap_[n] == corner; });
    if (!even || !nearest_ || set_.local() || !(slack_ < never) || is_bordered()) {
      doubtful_ = true;
      return;
    }
    // Of the gap and the next number, where their sum lies between the two.
    const double gap = node_.gap + corner, back = gap - node_.gap;
    const double rest = (node_.gap - (gap - back)) + (corner - back);
    const bool closer = is_closer_than(q_, c_.p, face_.triangle(), gap);
    const double next = std::nextafter(gap, rest > 0 ? never : 0);
    doubtful_ = doubtful_ || closer != (room > 0) ||
                (rest != 0 && is_closer_than(q_, c_.p, face_.triangle(), next) != closer);
  }
  /// A border beside the facet has a say in the depth.
  bool is_bordered() const {
    if (lone_border_corner() != 4) return true;
    if (!face_.triangle()) return is_free(f_.side);
    return is_free(0) || is_free(1) || is_free(3);
  }

  PairFigures of_facet() {
    PairFigures out;
    out.gap = f_.gap;
    out.distance_squared = f_.distance_squared;
    out.behind = f_.behind;
    out.normal = f_.normal;
    weigh_side();
    if (face_.sheet() && f_.behind > 0) return out;
    foot_ = q_ + f_.behind * f_.normal;
    out.beside = f_.a < -0.001 || f_.b < -0.001 || f_.a + f_.b > 1.001;
    beside_ = out.beside;
    p_ = raw();
    out.excluded = excluded();
    if (out.excluded) p_ = 0;
    if (thin() && p_ != 0) at_border();
    out.penetration = p_;
    return out;
  }

  /// Facets that exact arithmetic may take in place of `chosen`.
  void note_others(const std::array<Facet, 4>& all, std::size_t count, const Facet& chosen,
                   double least, double excess) {
    const double by = 4 * slack_ * (std::sqrt(chosen.distance_squared) + slack_);
    if (chosen.distance_squared != least) weigh(1.03 * least - chosen.distance_squared, by);
    for (std::size_t k = 0; k < count; ++k) {
      const Facet& f = all[k];
      if (f.side == chosen.side || f.distance_squared > 1.03 * least + by) continue;
      if (excess_of(f) > excess + by) continue;
      other_[others_++] = f;
    }
  }
  static double excess_of(const Facet& f) {
    return f.a >= 0 && f.b >= 0 ? 0 : std::max(0.0, f.distance_squared - f.behind * f.behind);
  }

  void choose_facet() {
    std::array<Facet, 4> all;
    std::size_t count = 0;
    double least = 0;
    for (std::size_t k = 0; k < c_.facets; ++k) {
      if ((facets_ >> k & 1U) == 0) continue;
      double o = 0, a = 0, b = 0;
      Facet& f = all[count++] = facet_of(c_, k, q_, o, a, b);
      f.gap = gap_at(k, o, a, b);
      least = count == 1 ? f.distance_squared : std::min(least, f.distance_squared);
    }
    double best = 0;
    bool found = false;
    for (std::size_t k = 0; k < count; ++k) {
      const Facet& f = all[k];
      if (f.distance_squared > 1.03 * least) continue;
      const double excess = excess_of(f);
      if (found && excess >= best) continue;
      best = excess;
      found = true;
      f_ = f;
    }
    if (!found) f_ = all[0];
    nearest_ = f_.distance_squared == least;
    if (slack_ >= 0 && slack_ < never) note_others(all, count, f_, least, best);
  }

  double gap_at(std::size_t k, double o, double a, double b) const {
    double g[4];
    for (std::size_t i = 0; i < 4; ++i) g[i] = main_gap_[face_.nodes[i]];
    const double centre = face_.triangle() ? g[2] : 0.25 * (g[0] + g[1] + g[2] + g[3]);
    const double gap = node_.gap + o * centre + a * g[k] + b * g[(k + 1) % 4];
    return set_.local() ? std::min(gap, node_.length + face_.length) : gap;
  }

  double raw() {
    const double room = f_.gap - std::sqrt(f_.distance_squared), near = std::max(0.0, room);
    if (face_.kind != SegmentKind::solid && f_.behind <= 0) weigh_room(room);
    switch (face_.kind) {
      case SegmentKind::solid:
        return f_.behind > 0 ? f_.gap + f_.behind : 0;
      case SegmentKind::coat:
        return f_.behind > 0 ? f_.gap + f_.behind : near;
      default:
        return f_.behind > 0 ? 0 : near;
    }
  }

  /// Looked up once.
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
  Topology::Vertex vertex(std::size_t corner) const {
    return t_.vertex(at_face_, static_cast<std::uint32_t>(corner));
  }
  /// Overhang of the foot point over a side, seen from the place where the side starts.
  double over(std::size_t side) const { return dot(foot_ - c_.p[side], beta(side)); }

  /// The corner on a border, where exactly one of these is; 4: none or several are.
  template <std::size_t N>
  std::size_t lone_border_corner(const std::array<std::size_t, N>& corners) const {
    std::size_t found = 4, count = 0;
    for (const std::size_t k : corners)
      if (on_border(k)) {
        found = k;
        ++count;
      }
    return count == 1 ? found : 4;
  }
  std::size_t lone_border_corner() const {
    if (face_.triangle()) return lone_border_corner(std::array<std::size_t, 3>{0, 1, 2});
    return lone_border_corner(std::array<std::size_t, 2>{f_.side, (f_.side + 1) % 4});
  }

  /// Beyond the plane that halves the angle at a side, by more than a hundredth.
  bool past_bisector(std::size_t side) {
    const Vec d = c_.p[(side + 1) % 4] - c_.p[side];
    const Vec to = c_.p[side] - q_, out = cross(d, beta(side));
    const double size = norm(to) * norm(out);
    if (!(size > 0)) return false;
    const double cosine = dot(to, out) / size;
    weigh(cosine + 0.01, 0x1p-30 + 4 * slack_ / norm(to));
    return cosine < -0.01;
  }

  bool past_corner() {
    const std::size_t k = lone_border_corner();
    if (k == 4 || !thin()) return false;
    const Topology::Vertex v = vertex(k);
    const Vec h = foot_ - c_.p[k];
    return hangs_over(dot(h, v.first)) && hangs_over(dot(h, v.second));
  }

  /// By the gap of the node at least.
  bool hangs_over(double v) {
    weigh(v - node_.gap, 4 * slack_);
    return v >= node_.gap;
  }

  bool excluded() {
    // What turns on it is the bisector.
    const double by = 0x1p-30 * (1 + std::fabs(f_.a) + std::fabs(f_.b));
    if (f_.behind > 0) {
      weigh(f_.a + 0.001, by);
      weigh(f_.b + 0.001, by);
      weigh(f_.a + f_.b - 1.001, by);
    }
    const bool turns = beside_ || f_.behind <= 0;
    if (!face_.triangle()) {
      if (is_free(f_.side) ? thin() && hangs_over(over(f_.side)) : past_corner()) return true;
      return turns && past_bisector(f_.side);
    }
    bool any_free = false;
    for (const std::size_t side : {0U, 1U, 3U}) {
      if (!is_free(side)) continue;
      any_free = true;
      if (thin() && hangs_over(over(side))) return true;
    }
    if (!any_free && past_corner()) return true;
    if (!turns) return false;
    for (const std::size_t side : {0U, 1U, 3U})
      if (!is_free(side) && past_bisector(side)) return true;
    return false;
  }

  /// Direction of the border beside the node, and how far the node hangs over; false: none.
  bool overhang(Vec& direction, double& v, int& times) {
    times = 1;
    if (!face_.triangle()) {
      if (is_free(f_.side)) {
        direction = beta(f_.side);
        v = over(f_.side);
        return true;
      }
      return corner_overhang(direction, v);
    }
    if (!is_free(0) && !is_free(1) && !is_free(3)) return corner_overhang(direction, v);
    times = 0;
    v = node_.gap;
    for (const std::size_t side : {0U, 1U, 3U}) {
      if (!is_free(side)) continue;
      // The solver measures the last side from the centre.
      const Vec b = side == 3 ? unit(beta(side)) : beta(side);
      const double here = dot(foot_ - (side == 3 ? c_.centre : c_.p[side]), b);
      weigh(here - v, 4 * slack_);
      if (here >= v) continue;
      v = here;
      direction = b;
      ++times;
    }
    return times > 0;
  }

  bool corner_overhang(Vec& direction, double& v) {
    const std::size_t k = lone_border_corner();
    if (k == 4) return false;
    const Topology::Vertex at = vertex(k);
    const Vec h = foot_ - c_.p[k];
    const bool first = !hangs_over(dot(h, at.first)), second = !hangs_over(dot(h, at.second));
    if (!first && !second) return false;
    direction = first && second ? unit(sum_single(at.first, at.second))
                : first         ? at.first
                                : at.second;
    v = dot(h, direction);
    return true;
  }

  void at_border() {
    Vec direction;
    double v = 0;
    int times = 0;
    if (!overhang(direction, v, times)) return;
    for (int i = 0; i < times; ++i)
      if (set_.ishape == 1)
        square(v);
      else if (set_.ishape == 2)
        cylinder(v, direction);
  }

  void square(double& v) {
    const double g = f_.gap, s = node_.gap, b = f_.behind;
    if (v > 0 && b + (g - s) < 0) {
      const double d = norm(q_ - (f_.closest + (g - s) * f_.normal));
      weigh(d - 1e-4, 4 * slack_);
      if (d > 1e-4) {
        weigh(s - d, 4 * slack_);
        p_ = std::max(0.0, s - d);
        return;
      }
    }
    v -= s;
    weigh(v, 4 * slack_);
    weigh(g + v, 4 * slack_);
    if (v < 0 && g + v > 0 && -b >= g + v) weigh(g + b, 4 * slack_);
    if (v >= 0)
      p_ = 0;
    else if (g + v > 0)
      p_ = -b < g + v ? -v : std::max(0.0, g + b);
  }

  void cylinder(double& v, const Vec& direction) {
    const double g = f_.gap;
    v -= node_.gap;
    weigh(v, 4 * slack_);
    weigh(g + v, 4 * slack_);
    if (!(v < 0 && g + v > 0)) return;
    const double d = norm(q_ - (foot_ - (g + v) * direction));
    weigh(d - 1e-4, 4 * slack_);
    weigh(g - d, 4 * slack_);
    if (d > 1e-4) p_ = std::max(0.0, g - d);
  }

  const Settings& set_;
  const Topology& t_;
  const SideNode& node_;
  const std::vector<double>& main_gap_;
  Face face_;
  unsigned facets_;
  double slack_;
  std::uint32_t at_face_;
  Vec q_;
  Corners c_;
  Facet f_;
  Vec foot_;
  bool beside_ = false;
  double p_ = 0;
  mutable std::array<std::optional<Topology::Across>, 4> across_;
  std::array<Facet, 3> other_;
  std::size_t others_ = 0;
  bool nearest_ = false;  ///< no facet is nearer
  bool doubtful_ = false;
};

}  // namespace

double facet_distance_squared(const Coordinates& x, const Face& face, NodeIndex node,
                              unsigned facets) {
  const Corners c = corners_of(x, face);
  const Vec q = at(x, node);
  double least = 0;
  bool any = false;
  for (std::size_t k = 0; k < c.facets; ++k) {
    if ((facets >> k & 1U) == 0) continue;
    double o = 0, a = 0, b = 0;
    const double d = facet_of(c, k, q, o, a, b).distance_squared;
    least = any ? std::min(least, d) : d;
    any = true;
  }
  return least;
}

PairFigures evaluate_pair(const Coordinates& x, const Sides& sides, const Topology& topology,
                          const SideNode& node, std::uint32_t face, unsigned facets, double slack) {
  return Pair(x, sides, topology, node, face, facets, slack).figures();
}

FacetRule facet_rule(const Coordinates& x, const Sides& sides, const Topology& topology,
                     const SideNode& node, std::uint32_t face) {
  return Pair(x, sides, topology, node, face, all_facets, -1).rule();
}

}  // namespace deck::detail::modern
