// One node and one segment of a TYPE25: the facet that counts, the depth, whether the node lies
// beside the segment or beyond its border, and what the border's shape makes of the depth.
#include <algorithm>
#include <cmath>

#include "contact/modern/parts.hpp"

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
       std::uint32_t face)
      : set_(sides.set),
        t_(t),
        node_(node),
        face_(sides.faces[face]),
        at_face_(face),
        q_(at(x, node.node)),
        c_(corners_of(x, face_)) {}

  PairFigures figures() {
    choose_facet();
    foot_ = q_ + f_.behind * f_.normal;
    PairFigures out;
    out.gap = f_.gap;
    out.distance_squared = f_.distance_squared;
    out.behind = f_.behind;
    out.normal = f_.normal;
    out.beside = f_.a < -0.001 || f_.b < -0.001 || f_.a + f_.b > 1.001;
    beside_ = out.beside;
    p_ = raw();
    out.excluded = excluded();
    if (out.excluded) p_ = 0;
    if (thin() && p_ != 0) at_border();
    out.penetration = p_;
    return out;
  }

 private:
  bool thin() const { return face_.kind != SegmentKind::solid || node_.gap > 0; }

  void choose_facet() {
    std::array<Facet, 4> all;
    double least = 0;
    for (std::size_t k = 0; k < c_.facets; ++k) {
      double o = 0, a = 0, b = 0;
      Facet& f = all[k] = facet_of(c_, k, q_, o, a, b);
      f.gap = gap_at(k, o, a, b);
      least = k == 0 ? f.distance_squared : std::min(least, f.distance_squared);
    }
    double best = 0;
    bool found = false;
    for (std::size_t k = 0; k < c_.facets; ++k) {
      const Facet& f = all[k];
      if (f.distance_squared > 1.03 * least) continue;
      const double excess =
          f.a >= 0 && f.b >= 0 ? 0 : std::max(0.0, f.distance_squared - f.behind * f.behind);
      if (found && excess >= best) continue;
      best = excess;
      found = true;
      f_ = f;
    }
    if (!found) f_ = all[0];
  }

  double gap_at(std::size_t k, double o, double a, double b) const {
    const auto& g = face_.nodal_gap;
    const double centre = face_.triangle() ? g[2] : 0.25 * (g[0] + g[1] + g[2] + g[3]);
    const double gap = node_.gap + o * centre + a * g[k] + b * g[(k + 1) % 4];
    return set_.local() ? std::min(gap, node_.length + face_.length) : gap;
  }

  double raw() const {
    const double near = std::max(0.0, f_.gap - std::sqrt(f_.distance_squared));
    switch (face_.kind) {
      case SegmentKind::solid:
        return f_.behind > 0 ? f_.gap + f_.behind : 0;
      case SegmentKind::coat:
        return f_.behind > 0 ? f_.gap + f_.behind : near;
      default:
        return f_.behind > 0 ? 0 : near;
    }
  }

  const Vec& beta(std::size_t side) const { return t_.direction[at_face_][side]; }
  bool is_free(std::size_t side) const { return t_.is_free(at_face_, side); }
  const Topology::Vertex& vertex(std::size_t corner) const {
    return t_.vertices[t_.vertex[at_face_][corner]];
  }
  /// Overhang of the foot point over a side, seen from the place where the side starts.
  double over(std::size_t side) const { return dot(foot_ - c_.p[side], beta(side)); }

  /// The corner on a border, where exactly one of these is; 4: none or several are.
  template <std::size_t N>
  std::size_t lone_border_corner(const std::array<std::size_t, N>& corners) const {
    std::size_t found = 4, count = 0;
    for (const std::size_t k : corners)
      if (vertex(k).border) {
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
  bool past_bisector(std::size_t side) const {
    const Vec d = c_.p[(side + 1) % 4] - c_.p[side];
    const Vec to = c_.p[side] - q_, out = cross(d, beta(side));
    const double size = norm(to) * norm(out);
    return size > 0 && dot(to, out) / size < -0.01;
  }

  bool past_corner() const {
    const std::size_t k = lone_border_corner();
    if (k == 4 || !thin()) return false;
    const Topology::Vertex& v = vertex(k);
    const Vec h = foot_ - c_.p[k];
    return dot(h, v.first) >= node_.gap && dot(h, v.second) >= node_.gap;
  }

  bool excluded() const {
    const bool turns = beside_ || f_.behind <= 0;
    if (!face_.triangle()) {
      if (is_free(f_.side) ? thin() && over(f_.side) >= node_.gap : past_corner()) return true;
      return turns && past_bisector(f_.side);
    }
    bool any_free = false;
    for (const std::size_t side : {0U, 1U, 3U}) {
      if (!is_free(side)) continue;
      any_free = true;
      if (thin() && over(side) >= node_.gap) return true;
    }
    if (!any_free && past_corner()) return true;
    if (!turns) return false;
    for (const std::size_t side : {0U, 1U, 3U})
      if (!is_free(side) && past_bisector(side)) return true;
    return false;
  }

  /// Direction of the border beside the node, and how far the node hangs over; false: none.
  bool overhang(Vec& direction, double& v, int& times) const {
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
      if (here >= v) continue;
      v = here;
      direction = b;
      ++times;
    }
    return times > 0;
  }

  bool corner_overhang(Vec& direction, double& v) const {
    const std::size_t k = lone_border_corner();
    if (k == 4) return false;
    const Topology::Vertex& at = vertex(k);
    const Vec h = foot_ - c_.p[k];
    const bool first = dot(h, at.first) < node_.gap, second = dot(h, at.second) < node_.gap;
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
      if (d > 1e-4) {
        p_ = std::max(0.0, s - d);
        return;
      }
    }
    v -= s;
    if (v >= 0)
      p_ = 0;
    else if (g + v > 0)
      p_ = -b < g + v ? -v : std::max(0.0, g + b);
  }

  void cylinder(double& v, const Vec& direction) {
    const double g = f_.gap;
    v -= node_.gap;
    if (!(v < 0 && g + v > 0)) return;
    const double d = norm(q_ - (foot_ - (g + v) * direction));
    if (d > 1e-4) p_ = std::max(0.0, g - d);
  }

  const Settings& set_;
  const Topology& t_;
  const SideNode& node_;
  const Face& face_;
  std::uint32_t at_face_;
  Vec q_;
  Corners c_;
  Facet f_;
  Vec foot_;
  bool beside_ = false;
  double p_ = 0;
};

}  // namespace

double facet_distance_squared(const Coordinates& x, const Face& face, NodeIndex node) {
  const Corners c = corners_of(x, face);
  const Vec q = at(x, node);
  double least = 0;
  for (std::size_t k = 0; k < c.facets; ++k) {
    double o = 0, a = 0, b = 0;
    const double d = facet_of(c, k, q, o, a, b).distance_squared;
    least = k == 0 ? d : std::min(least, d);
  }
  return least;
}

PairFigures evaluate_pair(const Coordinates& x, const Sides& sides, const Topology& topology,
                          const SideNode& node, std::uint32_t face) {
  return Pair(x, sides, topology, node, face).figures();
}

}  // namespace deck::detail::modern
