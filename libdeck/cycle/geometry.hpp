// Closest points of a packet of pairs: node against the four-triangle fan of a segment, edge
// against edge. Two versions each: the reference's (absolute floors, blended normal) and a robust
// one (relative guards, one closest point).
#ifndef DECK_CYCLE_GEOMETRY_HPP_
#define DECK_CYCLE_GEOMETRY_HPP_

#include "cycle/block.hpp"
#include "cycle/pack.hpp"

namespace deck::cycle::detail {

/// Closest point of a sub-triangle (apex, corner k, corner k+1): weights of the two corners, the
/// vector from the closest point to the node, and its length.
template <class V>
struct SubTriangle {
  V b, c, d;
  Vec3<V> toward_node;
  Vec3<V> area;  ///< e1 x e2
  V e1e1, e2e2;
};

/// Reference: the most violated edge line is projected on, with the parameter clamped. The closest
/// point is formed before it is subtracted from the node, as there: far from the origin this is
/// the rounding that shows.
template <class V>
SubTriangle<V> subtriangle_reference(const Vec3<V>& e1, const V& inv_e1, const Vec3<V>& e2,
                                     const V& inv_e2, const Vec3<V>& node, const Vec3<V>& apex) {
  const Vec3<V> w = node - apex;
  const V zero = V::fill(0.0);
  SubTriangle<V> t;
  t.area = cross(e1, e2);
  const V inv_area = 1.0 / max(dot(t.area, t.area), V::fill(1e-30));
  V b = dot(t.area, cross(w, e2)) * inv_area;
  V c = dot(t.area, cross(e1, w)) * inv_area;
  const V a = 1.0 - b - c;
  const Vec3<V> f = e2 - e1;  // the edge opposite the apex
  const V inv_f = 1.0 / max(dot(f, f), V::fill(1e-20));
  const V qa = a * abs(a) * inv_f;
  const V qb = b * abs(b) * inv_e2;
  const V qc = c * abs(c) * inv_e1;
  const V worst = min(qa, min(qb, qc));
  const auto outside = (a < zero) | (b < zero) | (c < zero);
  const auto on_a = qa == worst;
  const auto on_b = ~on_a & (qb == worst);
  const V along_f = clamp01(dot(e2 - w, f) * inv_f);
  const V along_2 = clamp01(dot(w, e2) * inv_e2);
  const V along_1 = clamp01(dot(w, e1) * inv_e1);
  const V b_edge = select(on_a, along_f, select(on_b, zero, along_1));
  const V c_edge = select(on_a, 1.0 - along_f, select(on_b, along_2, zero));
  t.b = select(outside, b_edge, b);
  t.c = select(outside, c_edge, c);
  t.toward_node = node - (apex + (t.b * e1 + t.c * e2));
  t.d = sqrt(dot(t.toward_node, t.toward_node));
  return t;
}

/// Quotient that is 0 where the denominator is 0: a point is its own projection on a null edge.
template <class V>
V ratio(const V& num, const V& den) {
  const V zero = V::fill(0.0);
  return select(den > zero, num / den, zero);
}

/// Robust: the interior point where it exists, else the closest of the three edges.
template <class V>
SubTriangle<V> subtriangle_robust(const Vec3<V>& e1, const V& e1e1, const Vec3<V>& e2,
                                  const V& e2e2, const Vec3<V>& w) {
  const V zero = V::fill(0.0);
  SubTriangle<V> t;
  t.area = cross(e1, e2);
  const V ss = dot(t.area, t.area);
  const V b = ratio(dot(t.area, cross(w, e2)), ss);
  const V c = ratio(dot(t.area, cross(e1, w)), ss);
  const V a = 1.0 - b - c;
  // Below a sine of 1e-14 the barycentric numbers are noise: the edges alone decide.
  const auto inside = ~((a < zero) | (b < zero) | (c < zero)) & (ss > 1e-28 * (e1e1 * e2e2));
  const Vec3<V> f = e2 - e1;
  const V along_f = clamp01(ratio(dot(e2 - w, f), dot(f, f)));
  const V along_2 = clamp01(ratio(dot(w, e2), e2e2));
  const V along_1 = clamp01(ratio(dot(w, e1), e1e1));
  const Vec3<V> to_f = w - (e2 - along_f * f);
  const Vec3<V> to_2 = w - along_2 * e2;
  const Vec3<V> to_1 = w - along_1 * e1;
  const V df = dot(to_f, to_f), d2 = dot(to_2, to_2), d1 = dot(to_1, to_1);
  const V least = min(df, min(d2, d1));
  const auto on_f = df == least;
  const auto on_2 = ~on_f & (d2 == least);
  t.b = select(inside, b, select(on_f, along_f, select(on_2, zero, along_1)));
  t.c = select(inside, c, select(on_f, 1.0 - along_f, select(on_2, along_2, zero)));
  const Vec3<V> edge = select(on_f, to_f, select(on_2, to_2, to_1));
  t.toward_node = select(inside, w - (b * e1 + c * e2), edge);
  t.d = sqrt(dot(t.toward_node, t.toward_node));
  return t;
}

template <class V>
void store_geometry(GeometryBlock& g, std::size_t s, const V& p, const V& d, const V& keep,
                    const Vec3<V>& n, const std::array<V, 4>& raw, const std::array<V, 4>& weight) {
  p.store(g.penetration + s);
  d.store(g.distance + s);
  keep.store(g.keep + s);
  n.x.store(g.normal[0] + s);
  n.y.store(g.normal[1] + s);
  n.z.store(g.normal[2] + s);
  for (std::size_t k = 0; k < 4; ++k) {
    raw[k].store(g.raw[k] + s);
    weight[k].store(g.weight[k] + s);
  }
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

/// Moves the alternating part of quadrangle weights away as far as they stay non-negative.
template <class V>
void remove_alternating(std::array<V, 4>& h) {
  V shift = -0.25 * (h[0] - h[1] + h[2] - h[3]);
  shift = min(shift, min(h[1], h[3]));
  shift = max(shift, max(-h[0], -h[2]));
  h[0] = h[0] + shift;
  h[1] = h[1] - shift;
  h[2] = h[2] + shift;
  h[3] = h[3] - shift;
}

/// Makes weights add up to 1 within half a rounding error: the largest takes what the others leave.
template <class V>
void close_sum(std::array<V, 4>& h) {
  const V largest = max(max(h[0], h[1]), max(h[2], h[3]));
  auto open = largest > V::fill(0.0);  // weights that are all 0 stay so
  std::array<V, 4> rest;
  for (std::size_t k = 0; k < 4; ++k) {
    rest[k] = 1.0 - ((h[(k + 1) % 4] + h[(k + 2) % 4]) + h[(k + 3) % 4]);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const auto take = open & (h[k] == largest);
    h[k] = select(take, rest[k], h[k]);
    open = open & ~take;
  }
}

template <class V, Model M>
void node_triangle_pack(const Constants& k, const PacketView& view, std::size_t i, std::size_t s,
                        GeometryBlock& g) {
  const V zero = V::fill(0.0);
  const Vec3<V> node = Vec3<V>::load(view.position[0], i);
  Vec3<V> apex = Vec3<V>::load(view.position[3], i);
  Vec3<V> x1 = Vec3<V>::load(view.position[1], i), x2 = Vec3<V>::load(view.position[2], i);
  if constexpr (M == Model::robust) {  // the node is the origin
    apex = apex - node;
    x1 = x1 - node;
    x2 = x2 - node;
  }
  const Vec3<V> e1 = x1 - apex, e2 = x2 - apex;
  const V gap = V::load(view.gap + i);
  const V far = max(gap, V::fill(k.reach));
  const V l1 = dot(e1, e1), l2 = dot(e2, e2);
  SubTriangle<V> t;
  Vec3<V> n;
  if constexpr (M == Model::reference) {
    t = subtriangle_reference(e1, 1.0 / max(l1, V::fill(1e-30)), e2, 1.0 / max(l2, V::fill(1e-30)),
                              node, apex);
    n = (1.0 / max(t.d, V::fill(1e-30))) * t.toward_node;
  } else {
    t = subtriangle_robust(e1, l1, e2, l2, Vec3<V>{-apex.x, -apex.y, -apex.z});
    const auto clear = t.d > 1e-15 * sqrt(max(l1, l2));
    const V size = sqrt(dot(t.area, t.area));
    n = select(clear, ratio(V::fill(1.0), t.d) * t.toward_node, ratio(V::fill(1.0), size) * t.area);
  }
  const V p = max(zero, max(zero, far - t.d) + (gap - far));
  std::array<V, 4> h{t.b, t.c, 1.0 - t.b - t.c, zero};
  if constexpr (M == Model::robust) close_sum(h);
  store_geometry(g, s, p, t.d, select(t.d < far, V::fill(1.0), zero), n, h, h);
}

template <class V>
void node_segment_reference(const Constants& k, const PacketView& view, std::size_t i,
                            std::size_t s, GeometryBlock& g) {
  const V zero = V::fill(0.0), one = V::fill(1.0);
  const auto triangle = triangle_mask<V>(view, i);
  const Vec3<V> node = Vec3<V>::load(view.position[0], i);
  std::array<Vec3<V>, 4> x;
  for (std::size_t c = 0; c < 4; ++c) x[c] = Vec3<V>::load(view.position[c + 1], i);
  Vec3<V> apex = V::fill(0.25) * (x[0] + x[1] + x[2] + x[3]);
  apex = select(triangle, x[2], apex);
  const V gap = V::load(view.gap + i);
  const V far = max(gap, V::fill(k.reach));
  std::array<Vec3<V>, 4> e;
  std::array<V, 4> inv;
  for (std::size_t c = 0; c < 4; ++c) {
    e[c] = x[c] - apex;
    inv[c] = 1.0 / max(dot(e[c], e[c]), V::fill(1e-30));
  }
  std::array<V, 4> p, b, c;
  Vec3<V> blend{zero, zero, zero};
  V h0 = zero, d = zero;
  for (std::size_t q = 0; q < 4; ++q) {
    const auto t =
        subtriangle_reference(e[q], inv[q], e[(q + 1) % 4], inv[(q + 1) % 4], node, apex);
    V pq = max(zero, far - t.d);
    if (q == 0) {
      d = t.d;
    } else {
      pq = select(triangle, zero, pq);
      d = select(triangle, d, min(t.d, d));
    }
    p[q] = pq;
    b[q] = t.b;
    c[q] = t.c;
    blend = blend + (pq / max(t.d, V::fill(1e-20))) * t.toward_node;
    if (q == 0) blend = select(triangle, t.toward_node, blend);
    h0 = h0 + pq * (1.0 - t.b - t.c);
  }
  const V deepest = max(max(p[0], p[1]), max(p[2], p[3]));
  const Vec3<V> n = (1.0 / max(sqrt(dot(blend, blend)), V::fill(1e-30))) * blend;
  h0 = 0.25 * h0;
  std::array<V, 4> raw;
  for (std::size_t q = 0; q < 4; ++q) raw[q] = h0 + p[q] * b[q] + p[(q + 3) % 4] * c[(q + 3) % 4];
  const V scale = 1.0 / max(raw[0] + raw[1] + raw[2] + raw[3], V::fill(1e-20));
  for (auto& h : raw) h = scale * h;
  std::array<V, 4> weight = raw;
  remove_alternating(weight);
  close_sum(weight);  // below what the records show; the parts of a force add up to it
  const std::array<V, 4> tri{b[0], c[0], 1.0 - b[0] - c[0], zero};
  for (std::size_t q = 0; q < 4; ++q) {
    raw[q] = select(triangle, tri[q], raw[q]);
    weight[q] = select(triangle, tri[q], weight[q]);
  }
  store_geometry(g, s, max(zero, deepest + (gap - far)), d, select(deepest > zero, one, zero), n,
                 raw, weight);
}

template <class V>
void node_segment_robust(const Constants& k, const PacketView& view, std::size_t i, std::size_t s,
                         GeometryBlock& g) {
  const V zero = V::fill(0.0), one = V::fill(1.0);
  const auto triangle = triangle_mask<V>(view, i);
  const Vec3<V> node = Vec3<V>::load(view.position[0], i);
  // The node is the origin: differences first, so that far from the origin nothing is lost.
  std::array<Vec3<V>, 4> x;
  for (std::size_t c = 0; c < 4; ++c) x[c] = Vec3<V>::load(view.position[c + 1], i) - node;
  Vec3<V> apex = V::fill(0.25) * (x[0] + x[1] + x[2] + x[3]);
  apex = select(triangle, x[2], apex);
  const Vec3<V> w = {-apex.x, -apex.y, -apex.z};
  const V gap = V::load(view.gap + i);
  const V far = max(gap, V::fill(k.reach));
  std::array<Vec3<V>, 4> e;
  std::array<V, 4> ee;
  for (std::size_t c = 0; c < 4; ++c) {
    e[c] = x[c] - apex;
    ee[c] = dot(e[c], e[c]);
  }
  V d = zero;
  Vec3<V> toward = {zero, zero, zero}, area = toward;
  std::array<V, 4> h{zero, zero, zero, zero};
  for (std::size_t q = 0; q < 4; ++q) {
    const auto t = subtriangle_robust(e[q], ee[q], e[(q + 1) % 4], ee[(q + 1) % 4], w);
    const V rest = 1.0 - t.b - t.c;
    std::array<V, 4> hq;
    hq.fill(0.25 * rest);
    hq[q] = hq[q] + t.b;
    hq[(q + 1) % 4] = hq[(q + 1) % 4] + t.c;
    if (q == 0) {
      d = t.d;
      toward = t.toward_node;
      area = t.area;
      h = {select(triangle, t.b, hq[0]), select(triangle, t.c, hq[1]),
           select(triangle, rest, hq[2]), select(triangle, zero, hq[3])};
      continue;
    }
    const auto closer = ~triangle & (t.d < d);
    d = select(closer, t.d, d);
    toward = select(closer, t.toward_node, toward);
    area = select(closer, t.area, area);
    for (std::size_t c = 0; c < 4; ++c) h[c] = select(closer, hq[c], h[c]);
  }
  close_sum(h);
  const V size = sqrt(max(max(ee[0], ee[1]), max(ee[2], ee[3])));
  const auto clear = d > 1e-15 * size;
  const Vec3<V> n = select(clear, ratio(one, d) * toward, ratio(one, sqrt(dot(area, area))) * area);
  const V p = max(zero, max(zero, far - d) + (gap - far));
  store_geometry(g, s, p, d, select(d < far, one, zero), n, h, h);
}

/// Reference edge–edge: one clamp, project, project-back pass.
template <class V>
void edge_edge_reference(const PacketView& view, std::size_t i, std::size_t s, GeometryBlock& g) {
  const V zero = V::fill(0.0), one = V::fill(1.0);
  const Vec3<V> s1 = Vec3<V>::load(view.position[0], i), s2 = Vec3<V>::load(view.position[1], i);
  const Vec3<V> m1 = Vec3<V>::load(view.position[2], i), m2 = Vec3<V>::load(view.position[3], i);
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

/// Robust edge–edge: relative parallel test; parallel edges touch at the middle of their overlap;
/// crossing edges take the normal of both directions.
template <class V>
void edge_edge_robust(const PacketView& view, std::size_t i, std::size_t s, GeometryBlock& g) {
  const V zero = V::fill(0.0), one = V::fill(1.0), half = V::fill(0.5);
  const Vec3<V> s2 = Vec3<V>::load(view.position[1], i);
  const Vec3<V> s1 = Vec3<V>::load(view.position[0], i) - s2;
  const Vec3<V> m1 = Vec3<V>::load(view.position[2], i) - s2;
  const Vec3<V> m2 = Vec3<V>::load(view.position[3], i) - s2;
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
  // A point-like overlap (edges end to end) leaves the ends: project back once.
  hs = select(parallel & (from == to), clamp01(ratio(p + hm * c, a)), hs);
  const V hs2 = 1.0 - hs, hm2 = 1.0 - hm;
  const Vec3<V> sep = hs * us - (m2 + hm * um);
  const V d = sqrt(dot(sep, sep));
  const auto clear = d > 1e-15 * sqrt(max(a, b));
  const Vec3<V> n = select(clear, ratio(one, d) * sep, ratio(one, sqrt(sine2)) * across);
  const V gap = V::load(view.gap + i);
  const std::array<V, 4> h{hs, hs2, hm, hm2};
  store_geometry(g, s, max(zero, gap - d), d, select(d < gap, one, zero), n, h, h);
}

template <class V, Model M, ContactKind K, bool Triangles>
void geometry_block(const Constants& k, const PacketView& view, std::size_t begin, std::size_t n,
                    GeometryBlock& g) {
  for (std::size_t s = 0; s < n; s += V::width) {
    const std::size_t i = pack_start<V::width>(begin, s, view.size);
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

#endif  // DECK_CYCLE_GEOMETRY_HPP_
