// Squared distance to the part that double found nearest, if none is nearer: piece_distance().
#include "contact/distance/filtered_bounds.hpp"

#include <cmath>
#include <initializer_list>

namespace deck::filter {
namespace piece_detail {
namespace {

using D = DoubleDouble;
using Q = Point3<D>;

constexpr double half_ulp = 0x1p-53;
// Weights this close to 0 or 1 may belong to another part: leave them to other stages.
constexpr double inside_by = 0x1p-20;
// Largest |a| |b| / |a x b| of a plane's directions.
constexpr double most_oblique = 0x1p10;

double sum_of_sizes(const P& p) { return std::abs(p.x) + std::abs(p.y) + std::abs(p.z); }
P head_of(const Q& q) { return {q.x.hi(), q.y.hi(), q.z.hi()}; }

// a - b exactly.
Q difference(const P& a, const P& b) { return lift<D>(a) - lift<D>(b); }

// Points base + sum of weight * direction, relative to the origin; `free`: number of directions.
struct PairPiece {
  Q base;
  std::array<Q, 2> direction;
  std::array<double, 2> weight{};
  unsigned free = 0;
  SegmentPiece of;

  /// `corners`: the direction as a sum of corners of the segment.
  void add(const Q& along, double by, std::initializer_list<std::size_t> corners = {}) {
    for (const std::size_t c : corners) of.corners[free] |= static_cast<std::uint8_t>(1U << c);
    direction[free] = along;
    weight[free] = by;
    ++free;
  }
};

// Closest point of a piece.
struct PieceFoot {
  PieceDistance distance;
  P q;               // point of the piece with the given weights, rounded
  double off = 0.0;  // bound of its distance from the closest point
  bool usable = false;
  // Difference of the exact weights from the given ones, and its round-off.
  std::array<double, 2> moved{}, unsure{};

  explicit PieceFoot(const PairPiece& piece) {
    Q point = piece.base;
    distance.piece = piece.of;
    double sizes = sum_of_sizes(head_of(piece.base));
    for (unsigned k = 0; k < piece.free; ++k) {
      point = point + D(piece.weight[k]) * piece.direction[k];
      sizes += sum_of_sizes(head_of(piece.direction[k]));
    }
    q = head_of(point);
    const double length = sum_of_sizes(q);  // length, over-estimated by a factor of at most 2
    distance.squared = dot(point, point);
    // At most a dozen operations with relative error 2^-102.
    distance.error = 0x1p-96 * length * sizes;
    double along = 0.0, slack = 0.0;  // length of q's part along the piece, and its round-off
    if (piece.free == 1) {
      const P e = head_of(piece.direction[0]);
      const double ee = dot(e, e), g = dot(q, e);
      if (!(ee > tiny)) return;
      const double size = std::sqrt(ee);
      along = std::abs(g) / size;
      slack = 16.0 * half_ulp * length;
      moved[0] = -g / ee;
      unsure[0] = slack / size;
      subtract(along * along, along * along * 0x1p-38 + (2.0 * along + slack) * slack);
    } else if (piece.free == 2) {
      const P a = head_of(piece.direction[0]), b = head_of(piece.direction[1]), n = cross(a, b);
      const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), nn = dot(n, n);
      const double ga = dot(q, a), gb = dot(q, b);
      if (!(nn * (most_oblique * most_oblique) > aa * bb && nn > tiny)) return;
      moved = {(gb * ab - ga * bb) / nn, (ga * ab - gb * aa) / nn};
      const double root = std::sqrt(nn), size_a = std::sqrt(aa), size_b = std::sqrt(bb);
      along = (std::abs(ga) * size_b + std::abs(gb) * size_a) / root;
      slack = 32.0 * half_ulp * length * (size_a * size_b / root);
      unsure = {slack * (size_b / root), slack * (size_a / root)};
      // The part along the plane in full; its excess over the bound counts as error.
      const double part = -(moved[0] * ga + moved[1] * gb);
      subtract(part, along * along * 0x1p-38 + (2.0 * along + slack) * slack);
    }
    off = (along + slack) * (1.0 + 0x1p-20) + 2.0 * half_ulp * length;
    // Distances far below the sizes have correct digits only in double-double.
    usable = distance.squared.hi() > tiny && length > 0x1p-30 * sizes && off < 0x1p-10 * length;
  }

 private:
  void subtract(double part, double error) {
    distance.squared = distance.squared - D(part);
    distance.error += error;
  }
};

// Height of a vertex, `d` away from a vertex of the piece, over the plane across the foot.
struct VertexHeight {
  double height = 0.0, margin = 0.0;
  bool coincides = true;  // at a vertex of the piece: exactly as far
  VertexHeight() = default;
  VertexHeight(const P& d, const PieceFoot& foot)
      : height(dot(d, foot.q)),
        margin(sum_of_sizes(d) * (foot.off + 32.0 * half_ulp * sum_of_sizes(foot.q))),
        coincides(sum_of_sizes(d) == 0.0) {}
  VertexHeight& operator+=(const VertexHeight& other) {
    height += other.height;
    margin += other.margin;
    coincides = coincides && other.coincides;
    return *this;
  }
  explicit operator bool() const { return height > margin || coincides; }
};

bool is_inside(double weight) { return weight > inside_by && weight < 1.0 - inside_by; }

// True if the exact weights lie in the part of the given ones.
bool weights_stay(const PieceFoot& foot, const PairPiece& piece) {
  for (unsigned k = 0; k < piece.free; ++k)
    if (!(std::abs(foot.moved[k]) + foot.unsure[k] < 0.0625 * inside_by)) return false;
  return true;
}

// Corner numbers of the best sub-triangle's ends, and of the other two.
struct SegmentWork {
  static std::optional<PieceDistance> run(const SegmentPair& pair,
                                          const SegmentClosest<double>& c) {
    const auto& best = c.closest();
    const auto& x = pair.points;
    const bool has_o = best.weight_o > 0.0, has_a = best.weight_a > 0.0,
               has_b = best.weight_b > 0.0;
    const unsigned parts = unsigned{has_o} + unsigned{has_a} + unsigned{has_b};
    if (parts == 0) return std::nullopt;
    if (parts > 1 && ((has_o && !is_inside(best.weight_o)) ||
                      (has_a && !is_inside(best.weight_a)) || (has_b && !is_inside(best.weight_b))))
      return std::nullopt;
    return pair.triangle ? triangle(x, has_o, has_a, has_b, c)
                         : quad(pair, x, has_o, has_a, has_b, c);
  }

  static std::optional<PieceDistance> triangle(const std::array<P, 5>& x, bool has_o, bool has_a,
                                               bool has_b, const SegmentClosest<double>& c) {
    if (c.best != 0) return std::nullopt;
    // Vertices o, a, b with weights; the first one used is the base.
    const std::array<std::size_t, 3> corner{2, 0, 1};
    const std::array<bool, 3> has{has_o, has_a, has_b};
    const auto& best = c.closest();
    const std::array<double, 3> weight{best.weight_o, best.weight_a, best.weight_b};
    const std::size_t base = has_o ? 0 : (has_a ? 1 : 2);
    PairPiece piece;
    piece.base = difference(x[corner[base]], x[4]);
    piece.of.base = static_cast<std::uint8_t>(corner[base]);
    for (std::size_t k = base + 1; k < 3; ++k)
      if (has[k]) piece.add(difference(x[corner[k]], x[corner[base]]), weight[k], {corner[k]});
    const PieceFoot foot(piece);
    if (!foot.usable || !weights_stay(foot, piece)) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k)
      if (!has[k] && !VertexHeight(x[corner[k]] - x[corner[base]], foot)) return std::nullopt;
    return foot.distance;
  }

  static std::optional<PieceDistance> quad(const SegmentPair& pair, const std::array<P, 5>& x,
                                           bool has_o, bool has_a, bool has_b,
                                           const SegmentClosest<double>& c) {
    const auto& best = c.closest();
    const auto k = static_cast<std::size_t>(c.best);
    // Seen from `u`, an end of the best sub-triangle: its other end, and the two corners beyond.
    const bool from_a = has_a || !has_b;
    const std::size_t u = from_a ? k : (k + 1) % 4, v = from_a ? (k + 1) % 4 : k;
    const std::size_t m = (k + 2) % 4, n = (k + 3) % 4;
    const Q to_v = difference(x[v], x[u]);
    PairPiece piece;
    piece.base = difference(x[u], x[4]);
    piece.of.base = static_cast<std::uint8_t>(u);
    if (has_o) {
      // The centre is u + (v-u + m-u + n-u)/4: in this plane m and n weigh the same.
      const Q others = difference(x[m], x[u]) + difference(x[n], x[u]);
      const double quarter = 0.25 * best.weight_o;
      if (has_a && has_b) {
        piece.add(to_v, best.weight_b + quarter, {v});
        piece.add(others, quarter, {m, n});
      } else if (has_a || has_b) {
        piece.add(to_v + others, quarter, {v, m, n});
      } else {
        return std::nullopt;  // the centre, a mean, has no corners beyond it on all sides
      }
    } else if (has_a && has_b) {
      piece.add(to_v, best.weight_b, {v});
    }
    const PieceFoot foot(piece);
    if (!foot.usable || !weights_stay(foot, piece)) return std::nullopt;
    // Heights of corners and centre over the plane across the foot, minus that of the piece.
    std::array<VertexHeight, 4> corner;
    VertexHeight sum;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j == u) continue;
      corner[j] = VertexHeight(x[j] - x[u], foot);
      sum += corner[j];
    }
    std::array<bool, 4> beyond{};
    for (std::size_t j = 0; j < 4; ++j) beyond[j] = bool(corner[j]);
    if (has_a) beyond[k] = true;
    if (has_b) beyond[(k + 1) % 4] = true;
    const bool centre_beyond = has_o || bool(sum);
    if (!(centre_beyond && beyond[k] && beyond[(k + 1) % 4])) return std::nullopt;
    const double high =
        std::sqrt(foot.distance.squared.hi() + foot.distance.error) * (1.0 + 0x1p-50);
    for (std::size_t j = 0; j < 4; ++j) {
      if (j == k || (centre_beyond && beyond[j] && beyond[(j + 1) % 4])) continue;
      const Support<double> own(c.sub[j].vector, pair.v, pair.largest);
      if (!own.is_apart(own.least(j), high)) return std::nullopt;
    }
    return foot.distance;
  }
};

// Two edges: the parallelogram s2 - m2 + hs (s1 - s2) - hm (m1 - m2).
struct EdgeWork {
  static std::optional<PieceDistance> run(const EdgePair& pair, const EdgeClosest<double>& c) {
    if (c.parallel) return std::nullopt;
    const auto& x = pair.points;
    const Q s = difference(x[0], x[1]), m = difference(x[3], x[2]);
    const std::array<double, 2> weight{c.weight_s, c.weight_m};
    const std::array<const Q*, 2> along{&s, &m};
    PairPiece piece;
    piece.base = difference(x[1], x[3]);
    std::array<bool, 2> inside{};
    for (std::size_t k = 0; k < 2; ++k) {
      if (weight[k] == 0.0) continue;
      if (weight[k] == 1.0) {
        piece.base = piece.base + *along[k];
        continue;
      }
      if (!is_inside(weight[k])) return std::nullopt;
      inside[k] = true;
      piece.add(*along[k], weight[k]);
    }
    const PieceFoot foot(piece);
    if (!foot.usable || !weights_stay(foot, piece)) return std::nullopt;
    for (std::size_t k = 0; k < 2; ++k) {
      if (inside[k]) continue;
      if (!VertexHeight(weight[k] == 0.0 ? head_of(*along[k]) : -head_of(*along[k]), foot))
        return std::nullopt;
    }
    return foot.distance;
  }
};

}  // namespace
}  // namespace piece_detail

Answer PieceDistance::closer_than(double gap) const {
  if (!can_be_squared(gap)) return Answer::unknown;
  const DoubleDouble over = squared - DoubleDouble(gap) * gap;
  const double slack = error + 0x1p-95 * (squared.hi() + gap * gap);
  if (over.hi() > slack) return Answer::no;
  return over.hi() < -slack ? Answer::yes : Answer::unknown;
}

std::optional<PieceDistance> piece_distance(const SegmentPair& pair,
                                            const SegmentClosest<double>& c) {
  return fused<piece_detail::SegmentWork>(pair, c);
}

std::optional<PieceDistance> piece_distance(const EdgePair& pair, const EdgeClosest<double>& c) {
  return fused<piece_detail::EdgeWork>(pair, c);
}

}  // namespace deck::filter
