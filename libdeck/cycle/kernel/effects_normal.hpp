// Effects of the normal force: gap reduction, elastic law and its energy, dashpot.
#pragma once
#include <cmath>

#include "cycle/kernel/stages.hpp"

namespace deck::cycle::detail {

// Relative to the gap: below this distance the robust law is linear.
inline constexpr double robust_floor = 1e-8;
// The solver removes a node when less than this share of its gap is left (double precision).
inline constexpr double closed_below = 1e-10;

/// Inacti 5 and 6: the initial penetration reduces the gap; the reduction decreases slowly.
struct GapReduction : PairEffect {
  static constexpr Effect effect = Effect::gap_reduction;
  static constexpr const char* name = "gap_reduction";
  static constexpr Field needs(ContactKind) { return Field::residual_penetration; }
  static constexpr Field writes = Field::residual_penetration;
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return card.inacti == 5 || card.inacti == 6;
  }
  static void prepare(const KernelPlan& plan, const PacketView&, Constants& k) {
    k.inacti_share = plan.card.inacti == 6 ? 0.05 : 0.0;
  }
  template <Model M, ContactKind K, class At, class V>
  static void gap(const At& at, PairState<V>& s) {
    const V zero = V::fill(0.0);
    s.p0 = V::load(at.view.p0 + at.i);
    if constexpr (K == ContactKind::node_segment) {
      const V now = s.penetration + at.k.inacti_share * (s.gap - s.penetration);
      s.p0 = min(s.p0, 0.95 * s.p0 + 0.05 * now);
    }
    s.pi = max(zero, s.penetration - s.p0);
    s.ge = s.gap - s.p0;
    s.k0 = select(s.pi == zero, zero, s.k0);
    if constexpr (M == Model::robust) {
      // A gap that is 0 within round-off has no stiffness.
      s.k0 = select(s.ge > 1e-14 * s.gap, s.k0, zero);
    }
  }
  template <Model M, ContactKind K, class At, class V>
  static void store(const At& at, const PairState<V>& s, PacketResult& out) {
    s.p0.store(out.p0.data() + at.i);
  }
};

/// Elastic normal force, hyperbolic in the remaining distance: F = kappa ge pi / d.
struct Elastic : PairEffect {
  static constexpr Effect effect = Effect::elastic;
  static constexpr const char* name = "elastic";
  static constexpr Field needs(ContactKind) {
    return Field::position | Field::stiffness | Field::gap;
  }
  static constexpr Field writes = Field::force | Field::nodal_stiffness | Field::weights;
  static bool called_for(const ContactCard&, const PlanOptions&) { return true; }

  /// Remaining distance and share. The reference subtracts, the robust model measures d. Edges use
  /// 0.9 of the gap: their singularity is at 0.1 of it.
  template <Model M, ContactKind K, class V>
  static void remaining(PairState<V>& s) {
    const V zero = V::fill(0.0);
    if constexpr (K == ContactKind::edge_edge) s.k0 = select(s.pi == zero, zero, s.k0);
    if constexpr (M == Model::reference) {
      if constexpr (K == ContactKind::edge_edge) s.ge = 0.9 * s.ge;
      s.d = s.ge - s.pi;
      s.rho = s.d / s.ge;
    } else {
      s.d = select(s.pi > zero, s.distance, s.ge);
      if constexpr (K == ContactKind::edge_edge) {
        s.d = s.d - 0.1 * s.ge;
        s.ge = 0.9 * s.ge;
      }
      s.rho = ratio_or_one(s.d, s.ge);
    }
    s.gap_closed = (s.rho < V::fill(closed_below)) & (s.k0 > zero);
    s.k0 = select(s.gap_closed, zero, s.k0);
    if constexpr (K == ContactKind::edge_edge) s.pi = select(s.gap_closed, zero, s.pi);
    if constexpr (M == Model::robust) s.rho = max(s.rho, V::fill(robust_floor));
  }
  template <class V>
  static V ratio_or_one(const V& num, const V& den) {
    return select(den > V::fill(0.0), num / den, V::fill(1.0));
  }

  template <Model M, ContactKind K, class At, class V>
  static void stiffness(const At&, PairState<V>& s) {
    s.kappa = 0.5 * s.k0;
  }
  template <Model M, ContactKind K, class At, class V>
  static void normal(const At&, PairState<V>& s) {
    const V zero = V::fill(0.0);
    if constexpr (M == Model::reference) {
      const V phi = s.ge / max(V::fill(1e-10), s.d);
      s.k_sec = s.kappa * phi;
      s.k_tan = s.k_sec * phi;
      s.fn = -(s.k_sec * s.pi);
    } else {
      const V phi = 1.0 / s.rho;
      const V floor_d = s.rho * s.ge;  // >= d; equal to d outside the linear branch
      s.k_sec = s.kappa * phi;
      s.k_tan = s.k_sec * phi;
      s.fn = -(s.k_sec * (s.ge - floor_d) + s.k_tan * max(zero, floor_d - s.d));
    }
    s.k_nodal = s.k_tan;
  }
};

/// Istf 1 of node-segment pairs: constant stiffness while the pair is active.
struct FixedStiffness : PairEffect {
  static constexpr Effect effect = Effect::fixed_stiffness;
  static constexpr const char* name = "fixed_stiffness";
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return card.istf == 1 && card.kind == ContactKind::node_segment;
  }
  static void prepare(const KernelPlan& plan, const PacketView&, Constants& k) {
    k.kappa_fixed = std::abs(plan.card.stfac);
  }
  template <Model M, ContactKind K, class At, class V>
  static void stiffness(const At& at, PairState<V>& s) {
    const V zero = V::fill(0.0);
    s.kappa = select(s.k0 != zero, V::fill(at.k.kappa_fixed), zero);
  }
};

/// Stored energy, the exact potential of the law: kappa ge^2 (rho - 1 - ln rho).
struct ElasticEnergy : PairEffect {
  static constexpr Effect effect = Effect::elastic_energy;
  static constexpr const char* name = "elastic_energy";
  static constexpr Field needs(ContactKind kind) { return Elastic::needs(kind); }
  static constexpr Field writes = Field::elastic_energy;
  static bool called_for(const ContactCard&, const PlanOptions& options) {
    return options.energies;
  }
  template <Model M, ContactKind K, class At, class V>
  static void normal(const At&, PairState<V>& s) {
    const V zero = V::fill(0.0);
    V value;
    if constexpr (M == Model::reference) {
      const V log_rho = map(max(s.rho, V::fill(1e-30)), [](double r) { return std::log(r); });
      value = s.kappa * s.ge * s.ge * (s.rho - V::fill(1.0) - log_rho);
    } else {
      // With u = 1 - rho: -u - log1p(-u); as a series where both terms cancel.
      const V u = 1.0 - s.rho;
      const V shape = map(u, [](double x) {
        if (x < 0.03) {
          double sum = 0.0;
          for (int p = 9; p >= 2; --p) sum = sum * x + 1.0 / p;
          return x * x * sum;
        }
        return -x - std::log1p(-x);
      });
      const V beyond = max(zero, s.rho * s.ge - s.d);
      value = s.kappa * s.ge * s.ge * shape + (-s.fn) * beyond - 0.5 * (s.k_tan * beyond * beyond);
    }
    s.e_elastic = select(s.kappa != zero, value, zero);
  }
  template <Model M, ContactKind K, class At, class V>
  static void store(const At& at, const PairState<V>& s, PacketResult& out) {
    s.e_elastic.store(out.elastic_energy.data() + at.i);
  }
};

/// Relative velocity and mass of a pair for damping and viscous friction. Mass: of the secondary
/// node; between edges the smaller of both weighted means.
struct Rates {
  template <ContactKind K, class V>
  static void gather(const PacketView& view, std::size_t i, PairState<V>& s) {
    if constexpr (K == ContactKind::edge_edge) {
      s.v = (s.weight[0] * load3<V>(view.velocity[0], i) +
             s.weight[1] * load3<V>(view.velocity[1], i)) -
            (s.weight[2] * load3<V>(view.velocity[2], i) +
             s.weight[3] * load3<V>(view.velocity[3], i));
      std::array<V, 4> m;
      four_times([&](auto c) DECK_INLINE { m[c] = V::load(view.mass[c] + i); });
      s.mass =
          min(s.weight[0] * m[0] + s.weight[1] * m[1], s.weight[2] * m[2] + s.weight[3] * m[3]);
    } else {
      Vec3<V> main = s.raw[0] * load3<V>(view.velocity[1], i);
      four_times([&](auto c) DECK_INLINE {
        if (c != 0) main = main + s.raw[c] * load3<V>(view.velocity[c + 1], i);
      });
      s.v = load3<V>(view.velocity[0], i) - main;
      s.mass = V::load(view.mass[0] + i);
    }
    s.vn = dot(s.n, s.v);
  }

  /// Step limit: half the time to the mid-surface. Pairs at or below dtmin are switched off.
  template <class V>
  static void limit(const Constants& k, PairState<V>& s) {
    const V zero = V::fill(0.0);
    s.dt_kin = 0.5 * s.d / max(V::fill(1e-30), -s.vn);
    s.step_deleted = (s.dt_kin <= V::fill(k.delete_below)) & (s.k0 != zero);
    s.k0 = select(s.step_deleted, zero, s.k0);
    s.dt_kin = select(s.k0 != zero, s.dt_kin, V::fill(1e30));
  }
};

/// Velocities and their step limit; normal dashpot relative to sqrt(2 k M), stiffer and with a
/// quadratic term on approach.
struct Damping : PairEffect {
  static constexpr Effect effect = Effect::damping;
  static constexpr const char* name = "damping";
  static constexpr Field needs(ContactKind kind) {
    const Field mass = kind == ContactKind::edge_edge ? Field::mass_main : Field::none;
    return Field::velocity | Field::step_times | Field::mass_secondary | mass;
  }
  static constexpr Field writes = Field::kinematic_step | Field::status | Field::damping_energy;
  static bool called_for(const ContactCard& card, const PlanOptions&) {
    return card.viss != 0.0 || has_friction(card) || card.dtmin > 0.0 || card.itied != 0;
  }
  static void prepare(const KernelPlan& plan, const PacketView&, Constants& k) {
    const ContactCard& card = plan.card;
    k.xi = card.viss;
    k.quadratic = card.viss != 0.0 ? 0.32 : 0.0;
    if (card.iform != 2) k.zeta = card.visf;
    k.zeta2 = k.zeta * k.zeta;
    if (card.dtmin > 0.0 && card.itied == 0) k.delete_below = card.dtmin;
  }
  template <Model M, ContactKind K, class At, class V>
  static void rates(const At& at, PairState<V>& s) {
    Rates::gather<K>(at.view, at.i, s);
    Rates::limit(at.k, s);
  }
  template <Model M, ContactKind K, class At, class V>
  static void normal(const At& at, PairState<V>& s) {
    const Constants& k = at.k;
    const V zero = V::fill(0.0);
    s.a = 2.0 * (s.k_sec * s.mass);
    V quad;
    if constexpr (M == Model::reference) {
      s.a = select(s.vn < zero, s.a / max(V::fill(1e-10), s.rho), s.a);
      quad = k.quadratic * (s.mass * max(zero, -s.vn)) / max(V::fill(1e-10), s.d);
    } else {
      s.a = select(s.vn < zero, s.a / s.rho, s.a);
      const V room = s.rho * s.ge;
      quad = select(room > zero, k.quadratic * (s.mass * max(zero, -s.vn)) / room, zero);
    }
    s.c = select(s.k0 != zero, k.xi * sqrt(s.a) + quad, zero);
    const V elastic = s.fn;
    if constexpr (K == ContactKind::node_segment) {
      s.fn = s.fn + s.c * s.vn;  // may pull, as in the solver
    } else {
      s.fn = s.fn + min(s.c * s.vn, -s.fn);  // between edges it never pulls
    }
    if constexpr (M == Model::robust) {
      s.e_damping = k.dt1 * ((s.fn - elastic) * s.vn);
    } else {
      s.e_damping = zero;  // the solver books no damping work here
    }
    const V root = k.zeta * sqrt(s.a);
    s.k_nodal = max(s.k_tan + k.inverse_dt1 * s.c, k.inverse_dt1 * root);
  }
  template <Model M, ContactKind K, class At, class V>
  static void store(const At& at, const PairState<V>& s, PacketResult& out) {
    s.dt_kin.store(out.dt_kinematic.data() + at.i);
    s.e_damping.store(out.damping_energy.data() + at.i);
  }
};

}  // namespace deck::cycle::detail
