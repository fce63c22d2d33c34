// Closest points of a packet of pairs: a node and a segment, or two edges. Input: positions of a
// block. Output: GeometryBlock (distance, normal, weights). Cost: constant per pair, no branches.
// A quadrangle 1234 becomes a fan of four triangles around its centre 0: 012, 023, 034, 041. A
// triangle 123 is one sub-triangle with apex 3. Per sub-triangle: project the node on the plane; if
// the foot lies outside, project it on an edge.
// Two versions of each. `reference` follows the solver: absolute floors, a normal blended over the
// fan. `robust`: relative guards, one closest point, the normal of that point.
#pragma once
#include "cycle/kernel/block.hpp"
#include "cycle/kernel/pack.hpp"

namespace deck::cycle::detail {

/// Reciprocals of two and of four numbers with one division. A number of exactly 1 keeps the bits
/// of the others.
template <class V>
std::array<V, 2> reciprocals(const V& a, const V& b) {
  const V r = 1.0 / (a * b);
  return {r * b, r * a};
}
template <class V>
std::array<V, 4> reciprocals(const std::array<V, 4>& a) {
  const V ab = a[0] * a[1], cd = a[2] * a[3];
  const std::array<V, 2> pair = reciprocals(ab, cd);
  return {pair[0] * a[1], pair[0] * a[0], pair[1] * a[3], pair[1] * a[2]};
}

/// Edge from the apex of a fan to a corner, with values that both adjacent sub-triangles need: for
/// the node at w, w x e, its clamped projection on the spoke, and the vector from there to the
/// node.
template <class V>
struct Spoke {
  Vec3<V> e, turn, to;
  V ee, inv, along, d2;
  Spoke() = default;
  DECK_INLINE Spoke(const Vec3<V>& corner, const V& square, const V& reciprocal, const Vec3<V>& w)
      : e(corner), ee(square), inv(reciprocal) {
    turn = cross(w, e);
    along = clamp01(dot(w, e) * inv);
    to = w - along * e;
    d2 = dot(to, to);
  }
};

/// Remaining values of a sub-triangle (apex, corner k, corner k+1): opposite side, area vector
/// times 2 and its square, reciprocals of squares.
template <class V>
struct SubTriangleSides {
  Vec3<V> f, area;
  V ss, inv_f, inv_area;
};

/// Closest point of a sub-triangle: weights of the two corners, the vector from the closest point
/// to the node, and its squared length.
template <class V>
struct SubTriangle {
  V b, c, d2;
  Vec3<V> toward_node;
};

/// Reference: project on the most violated edge line with clamped parameter. The closest point is
/// formed before it is subtracted from the node, as in the solver: far from the origin this
/// round-off shows.
template <class V>
DECK_INLINE inline SubTriangle<V> subtriangle_reference(const Spoke<V>& s1, const Spoke<V>& s2,
                                                        const SubTriangleSides<V>& s,
                                                        const Vec3<V>& node, const Vec3<V>& apex,
                                                        const Vec3<V>& w) {
  const V zero = V::fill(0.0);
  SubTriangle<V> t;
  const V b = dot(s.area, s2.turn) * s.inv_area;
  const V c = -dot(s.area, s1.turn) * s.inv_area;
  const V a = 1.0 - b - c;
  const V qa = a * abs(a) * s.inv_f;
  const V qb = b * abs(b) * s2.inv;
  const V qc = c * abs(c) * s1.inv;
  const V worst = min(qa, min(qb, qc));
  const auto outside = (a < zero) | (b < zero) | (c < zero);
  const auto on_a = qa == worst;
  const auto on_b = ~on_a & (qb == worst);
  const V along_f = clamp01(dot(s2.e - w, s.f) * s.inv_f);
  const V b_edge = select(on_a, along_f, select(on_b, zero, s1.along));
  const V c_edge = select(on_a, 1.0 - along_f, select(on_b, s2.along, zero));
  t.b = select(outside, b_edge, b);
  t.c = select(outside, c_edge, c);
  t.toward_node = node - (apex + (t.b * s1.e + t.c * s2.e));
  t.d2 = dot(t.toward_node, t.toward_node);
  return t;
}

/// Quotient, or 0 if the denominator is 0: a null edge projects every point on itself.
template <class V>
V ratio(const V& num, const V& den) {
  const V zero = V::fill(0.0);
  return select(den > zero, num / den, zero);
}

/// 1 where a square is 0, else the square: keeps products finite.
template <class V>
V or_one(const V& square) {
  return select(square > V::fill(0.0), square, V::fill(1.0));
}

/// Robust: the interior point if it exists, else the closest point of the three edges. Reciprocals
/// of 0 are 1 here, but their numerators are 0: projections on null edges are 0.
template <class V>
DECK_INLINE inline SubTriangle<V> subtriangle_robust(const Spoke<V>& s1, const Spoke<V>& s2,
                                                     const SubTriangleSides<V>& s,
                                                     const Vec3<V>& w) {
  const V zero = V::fill(0.0);
  SubTriangle<V> t;
  const V b = dot(s.area, s2.turn) * s.inv_area;
  const V c = -dot(s.area, s1.turn) * s.inv_area;
  const V a = 1.0 - b - c;
  // Below a sine of 1e-14 barycentric numbers are noise: only the edges decide.
  const auto inside = ~((a < zero) | (b < zero) | (c < zero)) & (s.ss > 1e-28 * (s1.ee * s2.ee));
  const V along_f = clamp01(dot(s2.e - w, s.f) * s.inv_f);
  const Vec3<V> to_f = w - (s2.e - along_f * s.f);
  const V df = dot(to_f, to_f);
  const V least = min(df, min(s2.d2, s1.d2));
  const auto on_f = df == least;
  const auto on_2 = ~on_f & (s2.d2 == least);
  t.b = select(inside, b, select(on_f, along_f, select(on_2, zero, s1.along)));
  t.c = select(inside, c, select(on_f, 1.0 - along_f, select(on_2, s2.along, zero)));
  const Vec3<V> edge = select(on_f, to_f, select(on_2, s2.to, s1.to));
  t.toward_node = select(inside, w - (b * s1.e + c * s2.e), edge);
  t.d2 = dot(t.toward_node, t.toward_node);
  return t;
}

/// The sub-triangles of a quadrangle around its centre. Lanes with triangles use the first one
/// only; the other squares count as 1, which gives the bits of a triangle alone.
template <class V>
struct Fan {
  std::array<Spoke<V>, 4> spoke;
  std::array<SubTriangleSides<V>, 4> side;

  template <class Mask, class Guard, class RimGuard>
  DECK_INLINE Fan(const std::array<Vec3<V>, 4>& x, const Vec3<V>& apex, const Vec3<V>& w,
                  const Mask& triangle, Guard&& guard, RimGuard&& rim_guard) {
    const V one = V::fill(1.0);
    std::array<Vec3<V>, 4> e;
    std::array<V, 4> ee, square, rim, area;
    four_times([&](auto q) DECK_INLINE {
      e[q] = x[q] - apex;
      ee[q] = dot(e[q], e[q]);
      square[q] = q < 2 ? guard(ee[q]) : select(triangle, one, guard(ee[q]));
    });
    four_times([&](auto q) DECK_INLINE {
      SubTriangleSides<V>& s = side[q];
      s.f = e[(q + 1) % 4] - e[q];
      s.area = cross(e[q], e[(q + 1) % 4]);
      s.ss = dot(s.area, s.area);
      area[q] = guard(s.ss);
      rim[q] = rim_guard(dot(s.f, s.f));
      if (q == 0) return;
      area[q] = select(triangle, one, area[q]);
      rim[q] = select(triangle, one, rim[q]);
    });
    const std::array<V, 4> inv_spoke = reciprocals(square), inv_rim = reciprocals(rim);
    // In pairs: the product of four areas would overflow earlier.
    const std::array<V, 2> low = reciprocals(area[0], area[1]),
                           high = reciprocals(area[2], area[3]);
    const V inv_area[] = {low[0], low[1], high[0], high[1]};
    four_times([&](auto q) DECK_INLINE {
      spoke[q] = Spoke<V>(e[q], ee[q], inv_spoke[q], w);
      side[q].inv_f = inv_rim[q];
      side[q].inv_area = inv_area[q];
    });
  }
};

/// A triangle alone; the bits are those of the first sub-triangle of a fan.
template <class V>
struct OneTriangle {
  Spoke<V> s1, s2;
  SubTriangleSides<V> side;
  template <class Guard, class RimGuard>
  OneTriangle(const Vec3<V>& e1, const Vec3<V>& e2, const Vec3<V>& w, Guard&& guard,
              RimGuard&& rim_guard) {
    const V l1 = dot(e1, e1), l2 = dot(e2, e2);
    const std::array<V, 2> inv = reciprocals(guard(l1), guard(l2));
    s1 = Spoke<V>(e1, l1, inv[0], w);
    s2 = Spoke<V>(e2, l2, inv[1], w);
    side.f = e2 - e1;
    side.area = cross(e1, e2);
    side.ss = dot(side.area, side.area);
    side.inv_f = 1.0 / rim_guard(dot(side.f, side.f));
    side.inv_area = 1.0 / guard(side.ss);
  }
};

// Guards of both models for squared lengths.
template <class V>
struct ReferenceGuard {
  double floor;
  V operator()(const V& square) const { return max(square, V::fill(floor)); }
};
template <class V>
struct RobustGuard {
  V operator()(const V& square) const { return or_one(square); }
};

template <class V>
DECK_INLINE inline void store_geometry(GeometryBlock& g, std::size_t s, const V& p, const V& d,
                                       const V& keep, const Vec3<V>& n, const std::array<V, 4>& raw,
                                       const std::array<V, 4>& weight) {
  p.store(g.penetration + s);
  d.store(g.distance + s);
  keep.store(g.keep + s);
  n.x.store(g.normal[0] + s);
  n.y.store(g.normal[1] + s);
  n.z.store(g.normal[2] + s);
  four_times([&](auto k) DECK_INLINE {
    raw[k].store(g.raw[k] + s);
    weight[k].store(g.weight[k] + s);
  });
}

template <class V>
auto triangle_mask(const PacketView& view, std::size_t i) {
  V flag = V::fill(0.0);
  if (view.triangle != nullptr) {
    for (int l = 0; l < V::width; ++l) {
      flag.r[l] = view.triangle[i + static_cast<std::size_t>(l)] != 0 ? 1.0 : 0.0;
    }
  }
  return flag != V::fill(0.0);
}

/// Removes the alternating part of quadrangle weights as far as they stay non-negative.
template <class V>
DECK_INLINE inline void remove_alternating(std::array<V, 4>& h) {
  V shift = -0.25 * (h[0] - h[1] + h[2] - h[3]);
  shift = min(shift, min(h[1], h[3]));
  shift = max(shift, max(-h[0], -h[2]));
  h[0] = h[0] + shift;
  h[1] = h[1] - shift;
  h[2] = h[2] + shift;
  h[3] = h[3] - shift;
}

/// Makes weights add up to 1 within half a rounding error: the largest is 1 minus the others.
template <class V>
DECK_INLINE inline void close_sum(std::array<V, 4>& h) {
  const V largest = max(max(h[0], h[1]), max(h[2], h[3]));
  auto open = largest > V::fill(0.0);  // weights that are all 0 stay 0
  std::array<V, 4> rest;
  four_times([&](auto k) DECK_INLINE {
    rest[k] = 1.0 - ((h[(k + 1) % 4] + h[(k + 2) % 4]) + h[(k + 3) % 4]);
  });
  four_times([&](auto k) DECK_INLINE {
    const auto take = open & (h[k] == largest);
    h[k] = select(take, rest[k], h[k]);
    open = open & ~take;
  });
}

/// Unit vector from the closest point to the node; on the surface, the facet's normal.
template <class V>
DECK_INLINE inline Vec3<V> unit_normal(const V& d, const Vec3<V>& toward, const Vec3<V>& area,
                                       const V& area2, const V& size2) {
  const auto clear = d > 1e-15 * sqrt(size2);
  const V length = select(clear, d, sqrt(area2));
  return ratio(V::fill(1.0), length) * select(clear, toward, area);
}

template <class V, Model M>
void node_triangle_pack(const Constants& k, const PacketView& view, std::size_t i, std::size_t s,
                        GeometryBlock& g) {
  const V zero = V::fill(0.0);
  const Vec3<V> node = load3<V>(view.position[0], i);
  Vec3<V> apex = load3<V>(view.position[3], i);
  Vec3<V> x1 = load3<V>(view.position[1], i), x2 = load3<V>(view.position[2], i);
  if constexpr (M == Model::robust) {  // the node is the origin
    apex = apex - node;
    x1 = x1 - node;
    x2 = x2 - node;
  }
  const Vec3<V> e1 = x1 - apex, e2 = x2 - apex;
  const V gap = V::load(view.gap + i);
  const V far = max(gap, V::fill(k.reach));
  SubTriangle<V> t;
  Vec3<V> n;
  V d;
  if constexpr (M == Model::reference) {
    const Vec3<V> w = node - apex;
    const OneTriangle<V> one(e1, e2, w, ReferenceGuard<V>{1e-30}, ReferenceGuard<V>{1e-20});
    t = subtriangle_reference(one.s1, one.s2, one.side, node, apex, w);
    d = sqrt(t.d2);
    n = (1.0 / max(d, V::fill(1e-30))) * t.toward_node;
  } else {
    const Vec3<V> w{-apex.x, -apex.y, -apex.z};
    const OneTriangle<V> one(e1, e2, w, RobustGuard<V>{}, RobustGuard<V>{});
    t = subtriangle_robust(one.s1, one.s2, one.side, w);
    d = sqrt(t.d2);
    n = unit_normal(d, t.toward_node, one.side.area, one.side.ss, max(one.s1.ee, one.s2.ee));
  }
  const V p = max(zero, max(zero, far - d) + (gap - far));
  std::array<V, 4> h{t.b, t.c, 1.0 - t.b - t.c, zero};
  if constexpr (M == Model::robust) close_sum(h);
  store_geometry(g, s, p, d, select(d < far, V::fill(1.0), zero), n, h, h);
}

template <class V>
void node_segment_reference(const Constants& k, const PacketView& view, std::size_t i,
                            std::size_t s, GeometryBlock& g) {
  const V zero = V::fill(0.0), one = V::fill(1.0);
  const auto triangle = triangle_mask<V>(view, i);
  const Vec3<V> node = load3<V>(view.position[0], i);
  std::array<Vec3<V>, 4> x;
  four_times([&](auto c) DECK_INLINE { x[c] = load3<V>(view.position[c + 1], i); });
  Vec3<V> apex = V::fill(0.25) * (x[0] + x[1] + x[2] + x[3]);
  apex = select(triangle, x[2], apex);
  const V gap = V::load(view.gap + i);
  const V far = max(gap, V::fill(k.reach));
  const Vec3<V> w = node - apex;
  const Fan<V> fan(x, apex, w, triangle, ReferenceGuard<V>{1e-30}, ReferenceGuard<V>{1e-20});
  std::array<SubTriangle<V>, 4> t;
  std::array<V, 4> p, floored;
  V d = zero;
  four_times([&](auto q) DECK_INLINE {
    t[q] = subtriangle_reference(fan.spoke[q], fan.spoke[(q + 1) % 4], fan.side[q], node, apex, w);
    const V dq = sqrt(t[q].d2);
    p[q] = max(zero, far - dq);
    floored[q] = max(dq, V::fill(1e-20));
    if (q == 0) {
      d = dq;
      return;
    }
    p[q] = select(triangle, zero, p[q]);
    d = select(triangle, d, min(dq, d));
  });
  const std::array<V, 4> inv_d = reciprocals(floored);
  Vec3<V> blend{zero, zero, zero};
  V h0 = zero;
  four_times([&](auto q) DECK_INLINE {
    blend = blend + (p[q] * inv_d[q]) * t[q].toward_node;
    if (q == 0) blend = select(triangle, t[q].toward_node, blend);
    h0 = h0 + p[q] * (1.0 - t[q].b - t[q].c);
  });
  const V deepest = max(max(p[0], p[1]), max(p[2], p[3]));
  h0 = 0.25 * h0;
  std::array<V, 4> raw;
  four_times([&](auto q)
                 DECK_INLINE { raw[q] = h0 + p[q] * t[q].b + p[(q + 3) % 4] * t[(q + 3) % 4].c; });
  const V sum = max(raw[0] + raw[1] + raw[2] + raw[3], V::fill(1e-20));
  const std::array<V, 2> scale =
      reciprocals(max(sqrt(dot(blend, blend)), V::fill(1e-30)), select(triangle, one, sum));
  const Vec3<V> n = scale[0] * blend;
  for (auto& h : raw) h = scale[1] * h;
  std::array<V, 4> weight = raw;
  remove_alternating(weight);
  close_sum(weight);  // below the precision of the records; the parts of a force add up to it
  const std::array<V, 4> tri{t[0].b, t[0].c, 1.0 - t[0].b - t[0].c, zero};
  four_times([&](auto q) DECK_INLINE {
    raw[q] = select(triangle, tri[q], raw[q]);
    weight[q] = select(triangle, tri[q], weight[q]);
  });
  store_geometry(g, s, max(zero, deepest + (gap - far)), d, select(deepest > zero, one, zero), n,
                 raw, weight);
}

template <class V>
void node_segment_robust(const Constants& k, const PacketView& view, std::size_t i, std::size_t s,
                         GeometryBlock& g) {
  const V zero = V::fill(0.0), one = V::fill(1.0);
  const auto triangle = triangle_mask<V>(view, i);
  const Vec3<V> node = load3<V>(view.position[0], i);
  // Differences to the node first: far from the origin they lose nothing.
  std::array<Vec3<V>, 4> x;
  four_times([&](auto c) DECK_INLINE { x[c] = load3<V>(view.position[c + 1], i) - node; });
  Vec3<V> apex = V::fill(0.25) * (x[0] + x[1] + x[2] + x[3]);
  apex = select(triangle, x[2], apex);
  const Vec3<V> w = {-apex.x, -apex.y, -apex.z};
  const V gap = V::load(view.gap + i);
  const V far = max(gap, V::fill(k.reach));
  const Fan<V> fan(x, apex, w, triangle, RobustGuard<V>{}, RobustGuard<V>{});
  V d2 = zero, area2 = zero;
  Vec3<V> toward = {zero, zero, zero}, area = toward;
  std::array<V, 4> h{zero, zero, zero, zero};
  four_times([&](auto q) DECK_INLINE {
    const auto t = subtriangle_robust(fan.spoke[q], fan.spoke[(q + 1) % 4], fan.side[q], w);
    const V rest = 1.0 - t.b - t.c;
    std::array<V, 4> hq;
    hq.fill(0.25 * rest);
    hq[q] = hq[q] + t.b;
    hq[(q + 1) % 4] = hq[(q + 1) % 4] + t.c;
    if (q == 0) {
      d2 = t.d2;
      toward = t.toward_node;
      area = fan.side[q].area;
      area2 = fan.side[q].ss;
      h = {select(triangle, t.b, hq[0]), select(triangle, t.c, hq[1]),
           select(triangle, rest, hq[2]), select(triangle, zero, hq[3])};
      return;
    }
    const auto closer = ~triangle & (t.d2 < d2);
    d2 = select(closer, t.d2, d2);
    toward = select(closer, t.toward_node, toward);
    area = select(closer, fan.side[q].area, area);
    area2 = select(closer, fan.side[q].ss, area2);
    for (std::size_t c = 0; c < 4; ++c) h[c] = select(closer, hq[c], h[c]);
  });
  close_sum(h);
  const V d = sqrt(d2);
  const Vec3<V> n = unit_normal(
      d, toward, area, area2,
      max(max(fan.spoke[0].ee, fan.spoke[1].ee), max(fan.spoke[2].ee, fan.spoke[3].ee)));
  const V p = max(zero, max(zero, far - d) + (gap - far));
  store_geometry(g, s, p, d, select(d < far, one, zero), n, h, h);
}

/// Reference edge-edge: clamp, project, project back, once.
template <class V>
void edge_edge_reference(const PacketView& view, std::size_t i, std::size_t s, GeometryBlock& g) {
  const V zero = V::fill(0.0), one = V::fill(1.0);
  const Vec3<V> s1 = load3<V>(view.position[0], i), s2 = load3<V>(view.position[1], i);
  const Vec3<V> m1 = load3<V>(view.position[2], i), m2 = load3<V>(view.position[3], i);
  const Vec3<V> es = s2 - s1, em = m2 - m1, r = m2 - s2;
  const V a = dot(es, es), b = dot(em, em), c = -dot(es, em), p = dot(es, r), q = -dot(em, r);
  V hm = clamp01((p * c - q * a) / max(a * b - c * c, V::fill(1e-20)));
  const V hs = clamp01(-(p + hm * c) / max(a, V::fill(1e-20)));
  hm = clamp01(-(q + hs * c) / max(b, V::fill(1e-20)));
  const V hs2 = 1.0 - hs, hm2 = 1.0 - hm;
  const Vec3<V> sep = (hs * s1 + hs2 * s2) - (hm * m1 + hm2 * m2);
  const V d = sqrt(dot(sep, sep));
  const Vec3<V> n = (1.0 / max(d, V::fill(1e-30))) * sep;
  const V gap = V::load(view.gap + i);
  const std::array<V, 4> h{hs, hs2, hm, hm2};
  store_geometry(g, s, max(zero, gap - d), d, select(d < gap, one, zero), n, h, h);
}

/// Robust edge-edge: relative parallel test. Parallel edges touch at the middle of their overlap;
/// crossing edges have the normal of both directions.
template <class V>
void edge_edge_robust(const PacketView& view, std::size_t i, std::size_t s, GeometryBlock& g) {
  const V zero = V::fill(0.0), one = V::fill(1.0), half = V::fill(0.5);
  const Vec3<V> s2 = load3<V>(view.position[1], i);
  const Vec3<V> s1 = load3<V>(view.position[0], i) - s2;
  const Vec3<V> m1 = load3<V>(view.position[2], i) - s2;
  const Vec3<V> m2 = load3<V>(view.position[3], i) - s2;
  const Vec3<V> us = s1, um = m1 - m2;  // from the second node to the first
  const V a = dot(us, us), b = dot(um, um), c = dot(us, um);
  const V p = dot(us, m2), q = dot(um, m2);
  const Vec3<V> across = cross(us, um);
  const V sine2 = dot(across, across);  // = ab - c^2, without its cancellation
  // S = hs us, M = m2 + hm um; stationary where us.(S-M) = um.(S-M) = 0.
  V hm = clamp01(ratio(c * p - a * q, sine2));
  V hs = clamp01(ratio(p + hm * c, a));
  hm = clamp01(ratio(hs * c - q, b));
  // Parallel within rounding: the overlap interval on the secondary edge, and its middle.
  const V t2 = ratio(p, a), t1 = ratio(p + c, a);
  const V from = clamp01(min(t1, t2)), to = clamp01(max(t1, t2));
  const auto parallel = sine2 <= 1e-20 * (a * b);
  hs = select(parallel, half * (from + to), hs);
  hm = select(parallel, clamp01(ratio(hs * c - q, b)), hm);
  // A point-like overlap (edges end to end) may leave the ends: project back once.
  hs = select(parallel & (from == to), clamp01(ratio(p + hm * c, a)), hs);
  const V hs2 = 1.0 - hs, hm2 = 1.0 - hm;
  const Vec3<V> sep = hs * us - (m2 + hm * um);
  const V d = sqrt(dot(sep, sep));
  const Vec3<V> n = unit_normal(d, sep, across, sine2, max(a, b));
  const V gap = V::load(view.gap + i);
  const std::array<V, 4> h{hs, hs2, hm, hm2};
  store_geometry(g, s, max(zero, gap - d), d, select(d < gap, one, zero), n, h, h);
}

// Flattened: by default the compiler keeps calls of dot and cross with operands in memory.
template <class V, Model M, ContactKind K, bool Triangles>
DECK_FLATTEN void geometry_block(const Constants& shared, const PacketView& view, std::size_t begin,
                                 std::size_t n, GeometryBlock& g) {
  const Constants k = shared;  // as in the force
  const std::size_t size = view.size;
  for (std::size_t s = 0; s < n; s += V::width) {
    const std::size_t i = pack_start<V::width>(begin, s, size);
    if constexpr (K == ContactKind::edge_edge) {
      if constexpr (M == Model::reference) {
        edge_edge_reference<V>(view, i, s, g);
      } else {
        edge_edge_robust<V>(view, i, s, g);
      }
    } else if constexpr (Triangles) {
      node_triangle_pack<V, M>(k, view, i, s, g);
    } else if constexpr (M == Model::reference) {
      node_segment_reference<V>(k, view, i, s, g);
    } else {
      node_segment_robust<V>(k, view, i, s, g);
    }
  }
}

}  // namespace deck::cycle::detail
