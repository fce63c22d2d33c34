// Table of compiled kernels for packs of W: frequent compositions, and the generic kernel for all
// others. Included by one translation unit per instruction set.
#pragma once
#include "cycle/kernel/force.hpp"
#include "cycle/kernel/geometry.hpp"

namespace deck::cycle::detail {

template <int W, Model M, ContactKind K>
struct Kernels {
  using V = Pack<W>;

  template <EffectSet Set>
  static void composed(const Constants& k, EffectSet, const PacketView& view, std::size_t begin,
                       std::size_t n, const GeometryBlock& g, PacketResult& out) {
    force_block<V, M, K>(FixedEffects<Set>{}, k, view, begin, n, g, out);
  }
  static void generic(const Constants& k, EffectSet set, const PacketView& view, std::size_t begin,
                      std::size_t n, const GeometryBlock& g, PacketResult& out) {
    force_block<V, M, K>(RuntimeEffects{set}, k, view, begin, n, g, out);
  }
  static constexpr GeometryFn geometry() { return geometry_block<V, M, K, false>; }
  static constexpr GeometryFn triangles() {
    if constexpr (K == ContactKind::edge_edge)
      return nullptr;
    else
      return geometry_block<V, M, K, true>;
  }
  template <EffectSet Set>
  static constexpr KernelTable entry() {
    return {Set, true, W, geometry(), triangles(), composed<Set>};
  }

  static const KernelTable* find(EffectSet set, bool force_generic) {
    constexpr EffectSet e = bit(Effect::elastic), g = bit(Effect::gap_reduction),
                        d = bit(Effect::damping), v = bit(Effect::friction_viscous),
                        i = bit(Effect::friction_incremental), u = bit(Effect::elastic_energy);
    static constexpr KernelTable table[] = {
        entry<e>(),
        entry<e | g>(),
        entry<e | d>(),
        entry<e | d | g>(),
        entry<e | d | v>(),
        entry<e | d | v | g>(),
        entry<e | d | i>(),
        entry<e | d | i | g>(),
        entry<e | u>(),
        entry<e | g | u>(),
        entry<e | d | u>(),
        entry<e | d | g | u>(),
        entry<e | d | v | u>(),
        entry<e | d | v | g | u>(),
        entry<e | d | i | u>(),
        entry<e | d | i | g | u>(),
    };
    static constexpr KernelTable any{0, false, W, geometry(), triangles(), generic};
    if (!force_generic) {
      for (const KernelTable& t : table) {
        if (t.effects == set) return &t;
      }
    }
    return &any;
  }
};

template <int W>
const KernelTable* find_kernel(ContactKind kind, Model model, EffectSet set, bool generic) {
  const bool edges = kind == ContactKind::edge_edge;
  if (model == Model::reference) {
    return edges ? Kernels<W, Model::reference, ContactKind::edge_edge>::find(set, generic)
                 : Kernels<W, Model::reference, ContactKind::node_segment>::find(set, generic);
  }
  return edges ? Kernels<W, Model::robust, ContactKind::edge_edge>::find(set, generic)
               : Kernels<W, Model::robust, ContactKind::node_segment>::find(set, generic);
}

}  // namespace deck::cycle::detail
