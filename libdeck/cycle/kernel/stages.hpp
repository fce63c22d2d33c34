// Building blocks of an effect: state of a pack of pairs, constants of an evaluation, and the
// stages.
#pragma once
#include <string>
#include <vector>

#include "cycle/kernel/block.hpp"
#include "cycle/kernel/pack.hpp"
#include "deck/cycle.hpp"

namespace deck::cycle::detail {

/// Constants of the law, from the card and the time step.
struct Constants {
  const ContactCard* card = nullptr;
  double kappa_fixed = 0.0;   ///< initial stiffness if it is fixed; else it is K0 / 2
  double inacti_share = 0.0;  ///< Inacti 6 leaves 5 % of the remaining gap
  double xi = 0.0;            ///< VISs
  double quadratic = 0.0;     ///< factor of the quadratic damping, 0.32 with damping
  double zeta = 0.0;          ///< VISF; 0 for Iform 2 and if pairs have their own
  double zeta2 = 0.0;         ///< zeta^2
  double mu = 0.0;
  double alpha = 1.0;  ///< filter weight; Iform 2: of the step
  double reach = 0.0;  ///< pairs are kept up to max(gap, reach): radiation distance
  double dt1 = 0.0;
  double inverse_dt1 = 0.0;
  double dt12 = 0.0;
  double delete_below = -1.0;  ///< contact time step at which a pair is deleted; -1 never
};

/// Values of a pack of pairs on its way through the effects. Signs: the normal points from main to
/// secondary, fn < 0 presses, vn < 0 approaches.
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

/// A pack of pairs in the loop: active effects, constants, the packet and its first pair.
template <class Effects>
struct PackAt {
  const Effects& on;
  const Constants& k;
  const PacketView& view;
  std::size_t i;
};

/// Stages of the loop, in this order. An effect overrides the stages it takes part in. Within a
/// stage effects act in the order of `AllEffects`.
struct PairEffect {
  static constexpr Field needs(ContactKind) { return Field::none; }
  static constexpr Field writes = Field::none;
  /// Once per evaluation: computes the constants of the effect.
  static void prepare(const KernelPlan&, const PacketView&, Constants&) {}
  /// Adds a row to the account of a plan.
  static void account(const ContactCard&, std::vector<EffectState>&) {}

  /// Gap and penetration at which the law starts.
  template <Model M, ContactKind K, class At, class V>
  static void gap(const At&, PairState<V>&) {}
  /// Velocities; switches off pairs below a time limit.
  template <Model M, ContactKind K, class At, class V>
  static void rates(const At&, PairState<V>&) {}
  /// Initial stiffness of the law.
  template <Model M, ContactKind K, class At, class V>
  static void stiffness(const At&, PairState<V>&) {}
  /// Normal force and values derived from it.
  template <Model M, ContactKind K, class At, class V>
  static void normal(const At&, PairState<V>&) {}
  /// Sliding velocity; coefficient and tangential damping of the card.
  template <Model M, ContactKind K, class At, class V>
  static void slide(const At&, PairState<V>&) {}
  /// Coefficient of friction of the pair.
  template <Model M, ContactKind K, class At, class V>
  static void coefficient(const At&, PairState<V>&) {}
  /// Tangential force.
  template <Model M, ContactKind K, class At, class V>
  static void tangential(const At&, PairState<V>&) {}
  /// Stores arrays of the effect.
  template <Model M, ContactKind K, class At, class V>
  static void store(const At&, const PairState<V>&, PacketResult&) {}
};

/// "Field = value", without trailing zeros.
inline std::string field_text(const char* field, double value) {
  std::string text = std::to_string(value);
  while (text.size() > 1 && text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return std::string(field) + " = " + text;
}
inline std::string field_text(const char* field, int value) {
  return std::string(field) + " = " + std::to_string(value);
}

inline bool has_friction(const ContactCard& card) {
  if (card.kind == ContactKind::tied) return false;
  if (card.kind == ContactKind::edge_edge) return card.fric != 0.0 || card.fric_id;
  return card.fric != 0.0 || card.ifric != 0 || card.fric_id || (card.ithe && card.fct_idf);
}

}  // namespace deck::cycle::detail
