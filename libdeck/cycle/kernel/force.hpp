// The pair loop: one text for every composition. A fixed set of effects folds to straight code; the
// generic kernel asks the same questions at run time and so gives the same bits.
#ifndef DECK_CYCLE_FORCE_HPP_
#define DECK_CYCLE_FORCE_HPP_

#include "cycle/kernel/effects.hpp"

namespace deck::cycle::detail {

/// Effects known at compile time.
template <EffectSet Set>
struct FixedEffects {
  static constexpr bool has(Effect e) { return (Set & bit(e)) != 0; }
};

/// Effects known at run time.
struct RuntimeEffects {
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

/// Friction coefficient and tangential damping of a pair, then the chosen form and its filter.
template <Model M, ContactKind K, class Effects, class V>
void apply_friction(const Effects& on, const Constants& k, const PacketView& view, std::size_t i,
                    PairState<V>& s) {
  Friction::slide(s);
  s.mu = V::fill(k.mu);
  s.zeta2 = V::fill(k.zeta2);
  if (on.has(Effect::friction_pairs)) {
    if (view.fric != nullptr) s.mu = V::load(view.fric + i);
    if (view.visf2 != nullptr) s.zeta2 = V::load(view.visf2 + i);
  }
  if (on.has(Effect::friction_temperature)) FrictionTemperature::apply(view, i, *k.card, s);
  if (on.has(Effect::friction_law)) {
    FrictionLaw::apply<M>(view, i, *k.card, on.has(Effect::friction_pairs), s);
  }
  // The ellipse is the limit of directed pairs: the form itself only sticks.
  if (on.has(Effect::friction_orthotropic)) {
    s.mu = select(FrictionOrthotropic::directed<V>(view, i), V::fill(1e30), s.mu);
  }
  if (on.has(Effect::friction_viscous)) {
    if (on.has(Effect::friction_pairs)) {
      s.k_nodal = max(s.k_nodal, k.inverse_dt1 * sqrt(s.zeta2 * s.a));
    }
    FrictionViscous::apply<M>(k, s);
    if (on.has(Effect::friction_orthotropic)) {
      FrictionOrthotropic::apply<M>(k, false, view, i, s);
    }
    if (on.has(Effect::filter)) Filter::apply(k, view, i, s);
  }
  if (on.has(Effect::friction_incremental)) {
    FrictionIncremental::apply<M, K>(k, view, i, s);
    if (on.has(Effect::friction_orthotropic)) {
      FrictionOrthotropic::apply<M>(k, true, view, i, s);
    }
  }
  s.e_friction = k.dt1 * dot(s.v, s.ft);
}

/// What geometry found goes out as it is, and early: it need not wait in registers.
template <class V>
void pass_on(const PairState<V>& s, std::size_t i, PacketResult& out) {
  four_times([&](auto c) DECK_INLINE { s.weight[c].store(out.weights[c].data() + i); });
  s.n.x.store(out.normal[0].data() + i);
  s.n.y.store(out.normal[1].data() + i);
  s.n.z.store(out.normal[2].data() + i);
  s.distance.store(out.distance.data() + i);
}

template <ContactKind K, class Effects, class V>
void store_pair(const Effects& on, const PairState<V>& s, std::size_t i, PacketResult& out) {
  const V zero = V::fill(0.0);
  const bool rubs = on.has(Effect::friction_viscous) || on.has(Effect::friction_incremental);
  Vec3<V> f = s.fn * s.n;
  if (rubs) f = f + s.ft;
  f.x.store(out.force[0].data() + i);
  f.y.store(out.force[1].data() + i);
  f.z.store(out.force[2].data() + i);
  s.fn.store(out.normal_force.data() + i);
  (K == ContactKind::edge_edge ? 2.0 * s.k_nodal : s.k_nodal).store(out.k_nodal.data() + i);
  s.pi.store(out.penetration.data() + i);
  s.ge.store(out.effective_gap.data() + i);
  const auto acts = (s.fn != zero) & (s.k0 != zero);
  auto status = bits_if(acts, status_contact) | bits_if(s.gap_closed, status_gap_closed);
  if (on.has(Effect::gap_reduction)) s.p0.store(out.p0.data() + i);
  if (on.has(Effect::damping)) {
    status = status | bits_if(s.step_deleted, status_step_deleted);
    s.dt_kin.store(out.dt_kinematic.data() + i);
    s.e_damping.store(out.damping_energy.data() + i);
  }
  store_bits(status, out.status.data() + i);
  if (on.has(Effect::elastic_energy)) s.e_elastic.store(out.elastic_energy.data() + i);
  if (rubs) {
    s.e_friction.store(out.friction_energy.data() + i);
    s.slip_heat.store(out.friction_heat.data() + i);
  }
  if (on.has(Effect::friction_incremental) || on.has(Effect::filter)) {
    s.ft_keep.x.store(out.ft[0].data() + i);
    s.ft_keep.y.store(out.ft[1].data() + i);
    s.ft_keep.z.store(out.ft[2].data() + i);
  }
}

// Flattened for the same reason as the geometry.
template <class V, Model M, ContactKind K, class Effects>
DECK_FLATTEN void force_block(const Effects& on, const Constants& shared, const PacketView& view,
                              std::size_t begin, std::size_t n, const GeometryBlock& g,
                              PacketResult& out) {
  // Copies: results are stored in between, and could be these numbers for all the compiler knows.
  const Constants k = shared;
  const std::size_t last = view.size - V::width;
  for (std::size_t slot = 0, i = begin; slot < n; slot += V::width, i += V::width) {
    if (i > last) i = last;  // the last pack steps back, see pack_start
    PairState<V> s{};        // zeros where an effect is off; those nobody reads cost nothing
    load_geometry(view, i, g, slot, s);
    pass_on(s, i, out);
    s.pi = s.penetration;
    s.ge = s.gap;
    if (on.has(Effect::gap_reduction)) GapReduction::apply<M, K>(k, view, i, s);
    Elastic::remaining<M, K>(s);
    if (on.has(Effect::damping)) {
      Rates::gather<K>(view, i, s);
      Rates::limit(k, s);
    }
    Elastic::apply<M>(k, on.has(Effect::fixed_stiffness), s);
    if (on.has(Effect::elastic_energy)) ElasticEnergy::apply<M, K>(s);
    s.k_nodal = s.k_tan;
    if (on.has(Effect::damping)) Damping::apply<M, K>(k, s);
    if (on.has(Effect::friction_viscous) || on.has(Effect::friction_incremental)) {
      apply_friction<M, K>(on, k, view, i, s);
    }
    store_pair<K>(on, s, i, out);
  }
}

}  // namespace deck::cycle::detail

#endif  // DECK_CYCLE_FORCE_HPP_
