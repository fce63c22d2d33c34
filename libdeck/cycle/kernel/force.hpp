// The pair loop, one source for every composition of effects. A fixed set of effects compiles to
// straight code; the generic kernel tests the same conditions at run time and gives the same bits.
#pragma once
#include "cycle/kernel/effects.hpp"

namespace deck::cycle::detail {

template <EffectSet Set>
struct FixedEffects {
  using List = decltype(those_in<Set>(AllEffects{}));
  static constexpr bool has(Effect e) { return (Set & bit(e)) != 0; }
};

struct RuntimeEffects {
  using List = AllEffects;
  EffectSet set;
  [[nodiscard]] bool has(Effect e) const { return (set & bit(e)) != 0; }
};

template <class V>
void load_geometry(const PacketView& view, std::size_t i, const GeometryBlock& g, std::size_t slot,
                   PairState<V>& s) {
  const V zero = V::fill(0.0);
  s.gap = V::load(view.gap + i);
  s.k0 = select(V::load(g.keep + slot) != zero, V::load(view.k0 + i), zero);
  s.penetration = V::load(g.penetration + slot);
  s.distance = V::load(g.distance + slot);
  s.n = {V::load(g.normal[0] + slot), V::load(g.normal[1] + slot), V::load(g.normal[2] + slot)};
  four_times([&](auto c) DECK_INLINE {
    s.raw[c] = V::load(g.raw[c] + slot);
    s.weight[c] = V::load(g.weight[c] + slot);
  });
}

/// Stores results of the geometry early, so that they leave the registers.
template <class V>
void store_geometry_results(const PairState<V>& s, std::size_t i, PacketResult& out) {
  four_times([&](auto c) DECK_INLINE { s.weight[c].store(out.weights[c].data() + i); });
  s.n.x.store(out.normal[0].data() + i);
  s.n.y.store(out.normal[1].data() + i);
  s.n.z.store(out.normal[2].data() + i);
  s.distance.store(out.distance.data() + i);
}

/// Stores the pair's own results; effects store theirs.
template <ContactKind K, class V>
void store_pair(const PairState<V>& s, bool sliding, std::size_t i, PacketResult& out) {
  const V zero = V::fill(0.0);
  Vec3<V> f = s.fn * s.n;
  if (sliding) f = f + s.ft;
  f.x.store(out.force[0].data() + i);
  f.y.store(out.force[1].data() + i);
  f.z.store(out.force[2].data() + i);
  s.fn.store(out.normal_force.data() + i);
  (K == ContactKind::edge_edge ? 2.0 * s.k_nodal : s.k_nodal).store(out.k_nodal.data() + i);
  s.pi.store(out.penetration.data() + i);
  s.ge.store(out.effective_gap.data() + i);
  const auto acts = (s.fn != zero) & (s.k0 != zero);
  store_bits(bits_if(acts, status_contact) | bits_if(s.gap_closed, status_gap_closed) |
                 bits_if(s.step_deleted, status_step_deleted),
             out.status.data() + i);
}

// Flattened for the same reason as the geometry.
template <class V, Model M, ContactKind K, class Effects>
DECK_FLATTEN void force_block(const Effects& on, const Constants& shared, const PacketView& view,
                              std::size_t begin, std::size_t n, const GeometryBlock& g,
                              PacketResult& out) {
  // Copies: stores of results could alias these numbers for the compiler.
  const Constants k = shared;
  using List = typename Effects::List;
  const bool sliding = on.has(Effect::friction_viscous) || on.has(Effect::friction_incremental);
  const std::size_t last = view.size - V::width;
  for (std::size_t slot = 0, i = begin; slot < n; slot += V::width, i += V::width) {
    if (i > last) i = last;  // the last pack steps back, see pack_start
    PairState<V> s{};        // zeros where an effect is off
    const PackAt<Effects> at{on, k, view, i};
    load_geometry(view, i, g, slot, s);
    store_geometry_results(s, i, out);
    s.pi = s.penetration;
    s.ge = s.gap;
    List::template gap<M, K>(at, s);
    Elastic::remaining<M, K>(s);
    List::template rates<M, K>(at, s);
    List::template stiffness<M, K>(at, s);
    List::template normal<M, K>(at, s);
    List::template slide<M, K>(at, s);
    List::template coefficient<M, K>(at, s);
    List::template tangential<M, K>(at, s);
    if (sliding) s.e_friction = k.dt1 * dot(s.v, s.ft);
    store_pair<K>(s, sliding, i, out);
    List::template store<M, K>(at, s, out);
  }
}

}  // namespace deck::cycle::detail
