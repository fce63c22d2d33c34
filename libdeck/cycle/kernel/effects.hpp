// Effects inside the pair loop, one struct per effect: its condition on the card, the arrays it
// reads and writes, its constants, its row in the account, and its code for a pack of pairs in each
// stage. stages.hpp explains the stages, effects_normal.hpp has the effects of the normal force,
// `AllEffects` at the end lists all. To add an effect, write a struct here and name it in
// `AllEffects`.
#pragma once
#include <numbers>
#include <string>
#include <type_traits>

#include "cycle/kernel/effects_normal.hpp"

namespace deck::cycle::detail {

/// Common to both friction forms: sliding velocity, coefficient of the card, limit, work.
struct Friction : PairEffect {
  static constexpr Field needs(ContactKind) { return Field::velocity | Field::step_times; }
  static constexpr Field writes = Field::friction_energy;
  static void prepare(const KernelPlan& plan, const PacketView&, Constants& k) {
    const ContactCard& card = plan.card;
    k.mu = card.fric;
    if (card.iform != 2 && card.visf == 0.0) k.zeta = k.zeta2 = 1.0;
  }
  static void account(const ContactCard& card, int iform, const char* name,
                      std::vector<EffectState>& out) {
    const bool rubbing = has_friction(card);
    const bool on = rubbing && (card.iform == 2) == (iform == 2);
    out.push_back({name, on, rubbing ? "Iform" : "Fric",
                   rubbing        ? field_text("Iform", card.iform)
                   : card.fric_id ? "fric_ID"
                                  : field_text("Fric", card.fric)});
  }
  template <Model M, ContactKind K, class At, class V>
  static void slide(const At& at, PairState<V>& s) {
    s.vt = s.v - s.vn * s.n;
    s.mu = V::fill(at.k.mu);
    s.zeta2 = V::fill(at.k.zeta2);
  }
  template <Model M, ContactKind K, class At, class V>
  static void store(const At& at, const PairState<V>& s, PacketResult& out) {
    s.e_friction.store(out.friction_energy.data() + at.i);
    s.slip_heat.store(out.friction_heat.data() + at.i);
  }
  template <class V>
  static V limit(const PairState<V>& s) {
    return s.mu * abs(s.fn);
  }
};

/// Iform 1: a dashpot zeta sqrt(A) on the sliding velocity, limited by mu |Fn|.
struct FrictionViscous : Friction {
  static constexpr Effect effect = Effect::friction_viscous;
  static constexpr const char* name = "friction_viscous";
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return has_friction(card) && card.iform != 2;
  }
  static void account(const ContactCard& card, std::vector<EffectState>& out) {
    Friction::account(card, 1, "friction-viscous", out);
  }
  template <Model M, ContactKind K, class At, class V>
  static void tangential(const At& at, PairState<V>& s) {
    const V v2 = dot(s.vt, s.vt);
    const V ct2 = s.zeta2 * s.a;
    const V stick2 = ct2 * v2;
    const V cap = Friction::limit(s);
    V factor;
    if constexpr (M == Model::reference) {
      factor = sqrt(ct2 * min(stick2, cap * cap) / max(V::fill(1e-30), stick2));
    } else {
      const V speed = sqrt(v2), ct = sqrt(ct2);
      const auto slips = ct * speed > cap;
      factor = select(slips, cap / select(slips, speed, V::fill(1.0)), ct);
    }
    s.ft = factor * s.vt;
    s.slip_heat = at.k.dt1 * (factor * v2);
  }
};

/// Share of the new force that passes the filter (Iform 2: of the step); 1 without filter.
inline double filter_weight(const ContactCard& card, double dt12) {
  if (card.ifiltr <= 0 || card.xfreq == 0.0) return 1.0;
  const double turn = 2.0 * std::numbers::pi;
  if (card.ifiltr == 1) return card.xfreq;
  if (card.ifiltr == 2) return turn / card.xfreq;
  const double cut = turn * card.xfreq * dt12;
  return cut > 1.0 ? cut : 1.0;  // as in the solver: never below 1
}

/// Stores the tangential force for the next cycle.
template <class V>
void store_memory(const PairState<V>& s, std::size_t i, PacketResult& out) {
  s.ft_keep.x.store(out.ft[0].data() + i);
  s.ft_keep.y.store(out.ft[1].data() + i);
  s.ft_keep.z.store(out.ft[2].data() + i);
}

/// Iform 2: spring on the sliding path, limited by mu |Fn|; its force is remembered. The spring is
/// K0, twice the stiffness that the normal force starts with (edges: the stabilised stiffness). The
/// filter scales its step.
struct FrictionIncremental : Friction {
  static constexpr Effect effect = Effect::friction_incremental;
  static constexpr const char* name = "friction_incremental";
  static constexpr Field needs(ContactKind kind) {
    return Friction::needs(kind) | Field::friction_memory;
  }
  static constexpr Field writes = Friction::writes | Field::friction_memory;
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return has_friction(card) && card.iform == 2;
  }
  static void prepare(const KernelPlan& plan, const PacketView& view, Constants& k) {
    Friction::prepare(plan, view, k);
    k.alpha = filter_weight(plan.card, view.dt12);
  }
  static void account(const ContactCard& card, std::vector<EffectState>& out) {
    Friction::account(card, 2, "friction-incremental", out);
  }
  template <Model M, ContactKind K, class At, class V>
  static void tangential(const At& at, PairState<V>& s) {
    const Constants& k = at.k;
    const V zero = V::fill(0.0), one = V::fill(1.0);
    const V cap = Friction::limit(s);
    const V spring = K == ContactKind::edge_edge ? s.k_nodal : s.k0;
    const V step = (K == ContactKind::edge_edge ? k.dt12 : k.alpha * k.dt12) * spring;
    Vec3<V> trial = load3<V>(at.view.ft_old, at.i) + step * s.v;
    trial = trial - dot(trial, s.n) * s.n;
    const V size2 = dot(trial, trial);
    V beta;
    if constexpr (M == Model::reference) {
      beta = min(one, cap / sqrt(max(V::fill(1e-30), size2)));
    } else {
      const V size = sqrt(size2);
      beta = select(size > cap, cap / select(size > zero, size, one), one);
    }
    s.ft = beta * trial;
    s.ft_keep = s.ft;
    const V lost = dot(trial - s.ft, s.ft);
    s.slip_heat = select(spring != zero, lost / select(spring != zero, spring, one), zero);
  }
  template <Model M, ContactKind K, class At, class V>
  static void store(const At& at, const PairState<V>& s, PacketResult& out) {
    Friction::store<M, K>(at, s, out);
    store_memory(s, at.i, out);
  }
};

/// fric_ID: coefficient and tangential damping of a pair of parts.
struct FrictionPairs : PairEffect {
  static constexpr Effect effect = Effect::friction_pairs;
  static constexpr const char* name = "friction_pairs";
  static constexpr Field needs(ContactKind) { return Field::pair_friction; }
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return has_friction(card) && card.fric_id;
  }
  static void prepare(const KernelPlan&, const PacketView& view, Constants& k) {
    if (view.visf2 != nullptr) k.zeta = 0.0;
  }
  static void account(const ContactCard& card, std::vector<EffectState>& out) {
    out.push_back(
        {"part-pair-friction", card.fric_id, "fric_ID", card.fric_id ? "fric_ID" : "fric_ID = 0"});
  }
  template <Model M, ContactKind K, class At, class V>
  static void coefficient(const At& at, PairState<V>& s) {
    if (at.view.fric != nullptr) s.mu = V::load(at.view.fric + at.i);
    if (at.view.visf2 != nullptr) s.zeta2 = V::load(at.view.visf2 + at.i);
    if (at.on.has(Effect::friction_viscous)) {
      s.k_nodal = max(s.k_nodal, at.k.inverse_dt1 * sqrt(s.zeta2 * s.a));
    }
  }
};

/// Ifric 1..4: mu from contact pressure (normal force over the area of the segment) and sliding
/// speed.
struct FrictionLaw : PairEffect {
  static constexpr Effect effect = Effect::friction_law;
  static constexpr const char* name = "friction_law";
  static constexpr Field needs(ContactKind) { return Field::position; }
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return has_friction(card) && card.ifric > 0 && card.kind != ContactKind::edge_edge;
  }
  static void account(const ContactCard& card, std::vector<EffectState>& out) {
    out.push_back({"friction-law", called_for(card, {}), "Ifric",
                   card.kind == ContactKind::edge_edge ? "edge contacts use a constant coefficient"
                                                       : field_text("Ifric", card.ifric)});
  }
  template <class V>
  static V area(const PacketView& view, std::size_t i) {
    const Vec3<V> d13 = load3<V>(view.position[3], i) - load3<V>(view.position[1], i);
    const Vec3<V> d24 = load3<V>(view.position[4], i) - load3<V>(view.position[2], i);
    const Vec3<V> area2 = cross(d13, d24);
    return V::fill(0.5) * sqrt(dot(area2, area2));
  }
  template <Model M>
  static double pressure(double fn, double area) {
    return M == Model::robust && !(area > 0.0) ? 0.0 : -fn / area;
  }
  template <Model M, ContactKind K, class At, class V>
  static void coefficient(const At& at, PairState<V>& s) {
    const PacketView& view = at.view;
    const ContactCard& card = *at.k.card;
    const bool pairs = at.on.has(Effect::friction_pairs);
    const V whole = area<V>(view, at.i);
    const V speed = sqrt(max(V::fill(1e-30), dot(s.vt, s.vt)));
    for (int l = 0; l < V::width; ++l) {
      const std::size_t pair = at.i + static_cast<std::size_t>(l);
      std::array<double, 6> c = card.c;
      for (std::size_t q = 0; pairs && q < 6; ++q) {
        if (view.c[q] != nullptr) c[q] = view.c[q][pair];
      }
      s.mu.r[l] =
          friction_coefficient(card.ifric, s.mu[l], c, pressure<M>(s.fn[l], whole[l]), speed[l]);
    }
  }
};

/// fct_IDF: mu scaled by a function of the mean temperature of both sides. AscaleF has no effect.
/// With Ithe_form 1 the solver weights corners by another pair of its packet; here each pair uses
/// its own weights.
struct FrictionTemperature : PairEffect {
  static constexpr Effect effect = Effect::friction_temperature;
  static constexpr const char* name = "friction_temperature";
  static constexpr Field needs(ContactKind) { return Field::temperature; }
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return has_friction(card) && card.ithe && card.fct_idf && !card.fric_id &&
           card.kind != ContactKind::edge_edge;
  }
  static void account(const ContactCard& card, std::vector<EffectState>& out) {
    out.push_back(
        {"friction-temperature", called_for(card, {}),
         card.fct_idf && !card.ithe ? "Ithe" : "fct_IDF",
         !card.fct_idf  ? "fct_IDF = 0"
         : !card.ithe   ? "fct_IDF acts with heat exchange only: Ithe = 0"
         : card.fric_id ? "fct_IDF does nothing beside fric_ID"
         : card.ithe_form == 1
             ? "fct_IDF; with Ithe_form 1 the solver weights the main side as another pair, here "
               "as its own"
             : "fct_IDF"});
    out.push_back({"friction-temperature-scale", false, "AscaleF",
                   card.ascalef != 1.0
                       ? field_text("AscaleF", card.ascalef) + ": the solver never applies it"
                       : "AscaleF = 1"});
  }
  template <Model M, ContactKind K, class At, class V>
  static void coefficient(const At& at, PairState<V>& s) {
    const PacketView& view = at.view;
    const ContactCard& card = *at.k.card;
    for (int l = 0; l < V::width; ++l) {
      const std::size_t pair = at.i + static_cast<std::size_t>(l);
      double main = card.tint;
      if (card.ithe_form == 1) {
        main = 0.0;
        for (std::size_t c = 0; c < 4; ++c) {
          main += s.weight[c][l] * view.temperature[c + 1][pair];
        }
      }
      const double mean = 0.5 * (view.temperature[0][pair] + main);
      const double scale = card.fric != 0.0 ? card.fric : 1.0;
      s.mu.r[l] = scale * (*card.fct_idf)(mean);
    }
  }
};

/// Inputs of the ellipse of a directed pair.
struct SlipState {
  double normal[3], velocity[3];  ///< whole relative velocity of the pair
  double fn = 0.0;                ///< signed
  double pressure = 0.0;          ///< for the law: normal force over the area of the segment
  bool incremental = false;       ///< Iform 2
};
/// Moves the tangential force of a pair back to its ellipse. Compiled once outside the kernels: the
/// linker could take a header function from an object of another instruction set.
void orthotropic_slip(const ContactCard& card, const PacketView& view, std::size_t pair,
                      const SlipState& state, double (&ft)[3]);

/// Orthotropic coefficients of a pair of parts: the sticking force of the chosen form moves back to
/// an ellipse whose axes follow the segment. As in the solver, the viscous form (Iform 1) reverses
/// the force of a sliding pair under pressure, which pushes it along.
struct FrictionOrthotropic : PairEffect {
  static constexpr Effect effect = Effect::friction_orthotropic;
  static constexpr const char* name = "friction_orthotropic";
  static constexpr Field needs(ContactKind) { return Field::position | Field::pair_friction; }
  static constexpr Field writes = Field::friction_energy;
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return has_friction(card) && card.fric_id && card.fric_orthotropic &&
           card.kind != ContactKind::edge_edge;
  }
  static void account(const ContactCard& card, std::vector<EffectState>& out) {
    const bool on = card.fric_id && card.fric_orthotropic && card.kind == ContactKind::node_segment;
    out.push_back({"orthotropic-friction", on, "fric_ID",
                   !card.fric_id ? "fric_ID = 0"
                   : on          ? "directions in /FRICTION"
                                 : "no directions in /FRICTION"});
  }

  /// Lanes with a direction; null means all.
  template <class V>
  static auto directed(const PacketView& view, std::size_t i) {
    const V flag = view.directed != nullptr ? V::load(view.directed + i) : V::fill(1.0);
    return flag != V::fill(0.0);
  }

  /// The ellipse limits directed pairs: the form itself only sticks.
  template <Model M, ContactKind K, class At, class V>
  static void coefficient(const At& at, PairState<V>& s) {
    s.mu = select(directed<V>(at.view, at.i), V::fill(1e30), s.mu);
  }
  template <Model M, ContactKind K, class At, class V>
  static void tangential(const At& at, PairState<V>& s) {
    const Constants& k = at.k;
    const PacketView& view = at.view;
    const std::size_t i = at.i;
    const bool incremental = at.on.has(Effect::friction_incremental);
    const Vec3<V> trial = s.ft;
    const V area = k.card->ifric > 0 ? FrictionLaw::area<V>(view, i) : V::fill(1.0);
    for (int l = 0; l < V::width; ++l) {
      const std::size_t pair = i + static_cast<std::size_t>(l);
      if (view.directed != nullptr && view.directed[pair] == 0.0) continue;
      double ft[3] = {trial.x[l], trial.y[l], trial.z[l]};
      orthotropic_slip(*k.card, view, pair,
                       {{s.n.x[l], s.n.y[l], s.n.z[l]},
                        {s.v.x[l], s.v.y[l], s.v.z[l]},
                        s.fn[l],
                        FrictionLaw::pressure<M>(s.fn[l], area[l]),
                        incremental},
                       ft);
      s.ft.x.r[l] = ft[0];
      s.ft.y.r[l] = ft[1];
      s.ft.z.r[l] = ft[2];
    }
    const V zero = V::fill(0.0), one = V::fill(1.0);
    V heat = k.dt1 * dot(s.ft, s.vt);
    if (incremental) {
      const V lost = dot(trial - s.ft, s.ft);
      heat = select(s.k0 != zero, lost / select(s.k0 != zero, s.k0, one), zero);
      s.ft_keep = s.ft;
    }
    s.slip_heat = select(directed<V>(view, i), heat, s.slip_heat);
  }
};

/// Ifiltr with Iform 1: smooths the limited tangential force with that of the last cycle.
struct Filter : PairEffect {
  static constexpr Effect effect = Effect::filter;
  static constexpr const char* name = "filter";
  static constexpr Field needs(ContactKind) { return Field::friction_memory; }
  static constexpr Field writes = Field::friction_memory;
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return has_friction(card) && card.iform != 2 && has_frequency(card);
  }
  static bool has_frequency(const ContactCard& card) {
    return card.kind == ContactKind::node_segment && card.ifiltr > 0 && card.xfreq != 0.0;
  }
  static void prepare(const KernelPlan& plan, const PacketView& view, Constants& k) {
    k.alpha = filter_weight(plan.card, view.dt12);
  }
  static void account(const ContactCard& card, std::vector<EffectState>& out) {
    const bool whole = card.ifiltr == 3 || (card.ifiltr == 1 && card.xfreq >= 1.0);
    out.push_back({"friction-filter", has_friction(card) && has_frequency(card) && !whole,
                   card.ifiltr > 0 && card.ifiltr != 3 ? "Xfreq" : "Ifiltr", reason(card)});
  }
  /// Reason why a filter has no effect or another effect than smoothing.
  static std::string reason(const ContactCard& card) {
    if (card.kind == ContactKind::edge_edge) return "no filter between edges";
    if (card.ifiltr <= 0) return "Ifiltr = 0";
    if (card.xfreq == 0.0) return field_text("Xfreq", 0.0);
    if (card.ifiltr == 3) return "Ifiltr = 3: the solver's weight is never below 1";
    const std::string text = field_text("Xfreq", card.xfreq);
    if (card.ifiltr == 1 && card.xfreq >= 1.0) return text + ": a weight of 1";
    if (card.iform != 2) return text;
    return text + ", scales the spring of Iform 2 and smooths nothing";
  }
  template <Model M, ContactKind K, class At, class V>
  static void tangential(const At& at, PairState<V>& s) {
    const Constants& k = at.k;
    const V one = V::fill(1.0);
    const Vec3<V> old = load3<V>(at.view.ft_old, at.i);
    s.ft = (k.alpha * one) * s.ft + ((1.0 - k.alpha) * one) * old;
    s.ft_keep = s.ft;
    s.slip_heat = k.dt1 * dot(s.ft, s.vt);
  }
  template <Model M, ContactKind K, class At, class V>
  static void store(const At& at, const PairState<V>& s, PacketResult& out) {
    store_memory(s, at.i, out);
  }
};

/// Compile-time list of effects; runs a stage of the active ones.
template <class... E>
struct EffectList {
  /// Calls f<E>() for each effect in order.
  template <class F>
  static constexpr void for_each(F&& f) {
    (f.template operator()<E>(), ...);
  }
  template <Model M, ContactKind K, class At, class V>
  static void gap(const At& at, PairState<V>& s) {
    ((at.on.has(E::effect) ? E::template gap<M, K>(at, s) : void()), ...);
  }
  template <Model M, ContactKind K, class At, class V>
  static void rates(const At& at, PairState<V>& s) {
    ((at.on.has(E::effect) ? E::template rates<M, K>(at, s) : void()), ...);
  }
  template <Model M, ContactKind K, class At, class V>
  static void stiffness(const At& at, PairState<V>& s) {
    ((at.on.has(E::effect) ? E::template stiffness<M, K>(at, s) : void()), ...);
  }
  template <Model M, ContactKind K, class At, class V>
  static void normal(const At& at, PairState<V>& s) {
    ((at.on.has(E::effect) ? E::template normal<M, K>(at, s) : void()), ...);
  }
  template <Model M, ContactKind K, class At, class V>
  static void slide(const At& at, PairState<V>& s) {
    ((at.on.has(E::effect) ? E::template slide<M, K>(at, s) : void()), ...);
  }
  template <Model M, ContactKind K, class At, class V>
  static void coefficient(const At& at, PairState<V>& s) {
    ((at.on.has(E::effect) ? E::template coefficient<M, K>(at, s) : void()), ...);
  }
  template <Model M, ContactKind K, class At, class V>
  static void tangential(const At& at, PairState<V>& s) {
    ((at.on.has(E::effect) ? E::template tangential<M, K>(at, s) : void()), ...);
  }
  template <Model M, ContactKind K, class At, class V>
  static void store(const At& at, const PairState<V>& s, PacketResult& out) {
    ((at.on.has(E::effect) ? E::template store<M, K>(at, s, out) : void()), ...);
  }
};

/// The effects of a list that are in `Set`.
template <EffectSet Set, class Chosen, class... Rest>
struct ChooseEffects {
  using List = Chosen;
};
template <EffectSet Set, class... Chosen, class E, class... Rest>
struct ChooseEffects<Set, EffectList<Chosen...>, E, Rest...> {
  using More = std::conditional_t<(Set & bit(E::effect)) != 0, EffectList<Chosen..., E>,
                                  EffectList<Chosen...>>;
  using List = typename ChooseEffects<Set, More, Rest...>::List;
};
template <EffectSet Set, class... E>
typename ChooseEffects<Set, EffectList<>, E...>::List those_in(EffectList<E...>);

/// All effects, in the order in which they act within a stage.
using AllEffects = EffectList<Elastic, FixedStiffness, GapReduction, ElasticEnergy, Damping,
                              FrictionViscous, FrictionIncremental, FrictionPairs,
                              FrictionTemperature, FrictionLaw, FrictionOrthotropic, Filter>;

}  // namespace deck::cycle::detail
