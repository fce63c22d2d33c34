// The effects inside the pair loop, one struct each: the arrays it needs, what it does to the
// state of a pack of pairs, what it writes. Order of application: gap reduction, relative
// velocity, time step, elastic, damping, friction, energies.
#ifndef DECK_CYCLE_EFFECTS_HPP_
#define DECK_CYCLE_EFFECTS_HPP_

#include <cmath>

#include "cycle/kernel/block.hpp"
#include "cycle/kernel/pack.hpp"
#include "deck/cycle/kernel.hpp"

namespace deck::cycle::detail {

/// Law of a pack of pairs while it passes through the effects. Signs: normal from main towards
/// secondary, fn negative when pressing, vn negative when approaching.
template <class V>
struct PairState {
  using M = decltype(V::fill(0.0) < V::fill(0.0));
  // From geometry and packet.
  V gap, penetration, distance, k0;
  Vec3<V> n;
  std::array<V, 4> raw, weight;
  // After gap reduction.
  V p0, pi, ge, d;  ///< d = ge - pi, the distance left to the singularity
  V rho;            ///< d / ge
  // Rates.
  Vec3<V> v, vt;
  V vn, mass, dt_kin;
  // Law.
  V kappa, k_sec, k_tan, a, c, fn, k_nodal;
  M active, gap_closed, step_deleted;
  // Friction.
  V mu, zeta2;
  Vec3<V> ft, ft_keep;
  V slip_heat;
  // Energies.
  V e_elastic, e_friction, e_damping;
};

// Distance, relative to the gap, below which the robust law continues linearly.
inline constexpr double kRobustFloor = 1e-8;
// The solver drops a node when less than this share of its gap is left (double precision).
inline constexpr double kClosed = 1e-10;

/// Inacti 5 and 6: the penetration found at start is taken off the gap and slowly given back.
struct GapReduction {
  static constexpr Field needs = Field::residual_penetration;
  static constexpr Field writes = Field::residual_penetration;
  template <Model M, ContactKind K, class V>
  static void apply(const Constants& k, const PacketView& view, std::size_t i, PairState<V>& s) {
    const V zero = V::fill(0.0);
    s.p0 = V::load(view.p0 + i);
    if constexpr (K == ContactKind::node_segment) {
      const V now = s.penetration + k.inacti_share * (s.gap - s.penetration);
      s.p0 = min(s.p0, 0.95 * s.p0 + 0.05 * now);
    }
    s.pi = max(zero, s.penetration - s.p0);
    s.ge = s.gap - s.p0;
    s.k0 = select(s.pi == zero, zero, s.k0);
    if constexpr (M == Model::robust) {
      // A gap used up within rounding has no law left.
      s.k0 = select(s.ge > 1e-14 * s.gap, s.k0, zero);
    }
  }
};

/// Elastic normal force, hyperbolic in the remaining distance: F = kappa ge pi / d.
struct Elastic {
  static constexpr Field needs = Field::position | Field::stiffness | Field::gap;
  static constexpr Field writes = Field::force | Field::nodal_stiffness | Field::weights;

  /// Remaining distance and share; the reference subtracts, the robust model measured d. Edges
  /// work with nine tenths of the gap: their singularity sits at a tenth of it.
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
    s.gap_closed = (s.rho < V::fill(kClosed)) & (s.k0 > zero);
    s.k0 = select(s.gap_closed, zero, s.k0);
    if constexpr (K == ContactKind::edge_edge) s.pi = select(s.gap_closed, zero, s.pi);
    if constexpr (M == Model::robust) s.rho = max(s.rho, V::fill(kRobustFloor));
  }
  template <class V>
  static V ratio_or_one(const V& num, const V& den) {
    return select(den > V::fill(0.0), num / den, V::fill(1.0));
  }

  /// `fixed`: Istf 1, the same stiffness for every pair that is on.
  template <Model M, class V>
  static void apply(const Constants& k, bool fixed, PairState<V>& s) {
    const V zero = V::fill(0.0);
    s.kappa = fixed ? select(s.k0 != zero, V::fill(k.kappa_fixed), zero) : 0.5 * s.k0;
    if constexpr (M == Model::reference) {
      const V phi = s.ge / max(V::fill(1e-10), s.d);
      s.k_sec = s.kappa * phi;
      s.k_tan = s.k_sec * phi;
      s.fn = -(s.k_sec * s.pi);
    } else {
      const V phi = 1.0 / s.rho;
      const V floor_d = s.rho * s.ge;  // >= d; differs from it only in the linear branch
      s.k_sec = s.kappa * phi;
      s.k_tan = s.k_sec * phi;
      s.fn = -(s.k_sec * (s.ge - floor_d) + s.k_tan * max(zero, floor_d - s.d));
    }
  }
};

/// Stored energy, exact potential of the law: kappa ge^2 (rho - 1 - ln rho).
struct ElasticEnergy {
  static constexpr Field needs = Elastic::needs;
  static constexpr Field writes = Field::elastic_energy;
  template <Model M, ContactKind K, class V>
  static void apply(PairState<V>& s) {
    const V zero = V::fill(0.0);
    V value;
    if constexpr (M == Model::reference) {
      const V log_rho = map(max(s.rho, V::fill(1e-30)), [](double r) { return std::log(r); });
      value = s.kappa * s.ge * s.ge * (s.rho - V::fill(1.0) - log_rho);
    } else {
      // With u = 1 - rho: -u - log1p(-u); a series where the two terms cancel.
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
};

/// Relative velocity of a pair and the mass that damping and viscous friction work with.
struct Rates {
  static constexpr Field needs = Field::velocity | Field::step_times;
  static constexpr Field writes = Field::kinematic_step | Field::status;

  /// The mass of the secondary node; between edges the smaller of both weighted means.
  template <ContactKind K>
  static constexpr Field mass_needs() {
    return K == ContactKind::node_segment ? Field::mass_secondary
                                          : Field::mass_secondary | Field::mass_main;
  }

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

  /// Half the time to the mid-surface; pairs at or below dtmin are switched off.
  template <class V>
  static void limit(const Constants& k, PairState<V>& s) {
    const V zero = V::fill(0.0);
    s.dt_kin = 0.5 * s.d / max(V::fill(1e-30), -s.vn);
    s.step_deleted = (s.dt_kin <= V::fill(k.delete_below)) & (s.k0 != zero);
    s.k0 = select(s.step_deleted, zero, s.k0);
    s.dt_kin = select(s.k0 != zero, s.dt_kin, V::fill(1e30));
  }
};

/// Normal dashpot relative to sqrt(2 k M), stiffer and with a quadratic term on approach.
struct Damping {
  static constexpr Field needs = Rates::needs;
  static constexpr Field writes = Field::damping_energy;
  template <Model M, ContactKind K, class V>
  static void apply(const Constants& k, PairState<V>& s) {
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
      s.fn = s.fn + min(s.c * s.vn, -s.fn);  // between edges it never does
    }
    if constexpr (M == Model::robust) {
      s.e_damping = k.dt1 * ((s.fn - elastic) * s.vn);
    } else {
      s.e_damping = zero;  // the reference books no damping work here
    }
    const V root = k.zeta * sqrt(s.a);
    s.k_nodal = max(s.k_tan + k.inverse_dt1 * s.c, k.inverse_dt1 * root);
  }
};

/// What both friction forms share: the sliding velocity, the limit and the work.
struct Friction {
  static constexpr Field needs = Rates::needs;
  static constexpr Field writes = Field::friction_energy;
  template <class V>
  static void slide(PairState<V>& s) {
    s.vt = s.v - s.vn * s.n;
  }
  template <class V>
  static V limit(const PairState<V>& s) {
    return s.mu * abs(s.fn);
  }
};

/// Iform 1: a dashpot zeta sqrt(A) on the sliding velocity, limited by mu |Fn|.
struct FrictionViscous {
  static constexpr Field needs = Friction::needs;
  static constexpr Field writes = Friction::writes;
  template <Model M, class V>
  static void apply(const Constants& k, PairState<V>& s) {
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
    s.slip_heat = k.dt1 * (factor * v2);
  }
};

/// Iform 2: a spring on the sliding path, limited by mu |Fn|; its force is remembered. The spring
/// is K0, twice the stiffness that the normal force starts with (edges: the stabilised stiffness),
/// and the filter scales its step.
struct FrictionIncremental {
  static constexpr Field needs = Friction::needs | Field::friction_memory;
  static constexpr Field writes = Friction::writes | Field::friction_memory;
  template <Model M, ContactKind K, class V>
  static void apply(const Constants& k, const PacketView& view, std::size_t i, PairState<V>& s) {
    const V zero = V::fill(0.0), one = V::fill(1.0);
    const V cap = Friction::limit(s);
    const V spring = K == ContactKind::edge_edge ? s.k_nodal : s.k0;
    const V step = (K == ContactKind::edge_edge ? k.dt12 : k.alpha * k.dt12) * spring;
    Vec3<V> trial = load3<V>(view.ft_old, i) + step * s.v;
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
};

/// Ifric 1..4: mu from contact pressure (normal force over the whole segment) and sliding speed.
struct FrictionLaw {
  static constexpr Field needs = Field::position;
  static constexpr Field writes = Field::none;
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
  template <Model M, class V>
  static void apply(const PacketView& view, std::size_t i, const ContactCard& card, bool pairs,
                    PairState<V>& s) {
    const V whole = area<V>(view, i);
    const V speed = sqrt(max(V::fill(1e-30), dot(s.vt, s.vt)));
    for (int l = 0; l < V::width; ++l) {
      const std::size_t pair = i + static_cast<std::size_t>(l);
      std::array<double, 6> c = card.c;
      for (std::size_t q = 0; pairs && q < 6; ++q) {
        if (view.c[q] != nullptr) c[q] = view.c[q][pair];
      }
      s.mu.r[l] =
          friction_coefficient(card.ifric, s.mu[l], c, pressure<M>(s.fn[l], whole[l]), speed[l]);
    }
  }
};

/// fct_IDF: mu scaled by a function of the mean temperature of both sides. AscaleF is inert. With
/// Ithe_form 1 the solver weights the corners as another pair of its packet does; here they have
/// the weights of their own pair.
struct FrictionTemperature {
  static constexpr Field needs = Field::temperature;
  static constexpr Field writes = Field::none;
  template <class V>
  static void apply(const PacketView& view, std::size_t i, const ContactCard& card,
                    PairState<V>& s) {
    for (int l = 0; l < V::width; ++l) {
      const std::size_t pair = i + static_cast<std::size_t>(l);
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

/// What the ellipse of a directed pair is made from.
struct SlipState {
  double normal[3], velocity[3];  ///< velocity: all of the pair's relative velocity
  double fn = 0.0;                ///< signed
  double pressure = 0.0;          ///< for the law, over the whole segment
  bool incremental = false;       ///< Iform 2
};
/// Brings the tangential force of a pair back to its ellipse. Compiled once, outside the kernels: a
/// plain function in a header could be linked from a translation unit of another instruction set.
void orthotropic_slip(const ContactCard& card, const PacketView& view, std::size_t pair,
                      const SlipState& state, double (&ft)[3]);

/// Orthotropic coefficients of a pair of parts: the sticking force of the chosen form is brought
/// back to an ellipse whose axes follow the segment. The viscous form (Iform 1) gives a sliding
/// pair under pressure the opposite sign, as in the solver: it is pushed along.
struct FrictionOrthotropic {
  static constexpr Field needs = Field::position | Field::pair_friction;
  static constexpr Field writes = Field::friction_energy;

  /// Pairs with a direction; null: all are.
  template <class V>
  static auto directed(const PacketView& view, std::size_t i) {
    const V flag = view.directed != nullptr ? V::load(view.directed + i) : V::fill(1.0);
    return flag != V::fill(0.0);
  }

  template <Model M, class V>
  static void apply(const Constants& k, bool incremental, const PacketView& view, std::size_t i,
                    PairState<V>& s) {
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

/// Ifiltr with Iform 1: the tangential force is smoothed with the last one, after its limit.
struct Filter {
  static constexpr Field needs = Field::friction_memory;
  static constexpr Field writes = Field::friction_memory;
  template <class V>
  static void apply(const Constants& k, const PacketView& view, std::size_t i, PairState<V>& s) {
    const V one = V::fill(1.0);
    const Vec3<V> old = load3<V>(view.ft_old, i);
    s.ft = (k.alpha * one) * s.ft + ((1.0 - k.alpha) * one) * old;
    s.ft_keep = s.ft;
    s.slip_heat = k.dt1 * dot(s.ft, s.vt);
  }
};

}  // namespace deck::cycle::detail

#endif  // DECK_CYCLE_EFFECTS_HPP_
