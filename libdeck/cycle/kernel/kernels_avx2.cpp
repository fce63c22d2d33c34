// Pair kernels for AVX2, packs of four. Compiled with -mavx2; callers test the processor first.
#include "cycle/kernel/kernels.hpp"

namespace deck::cycle::detail {

#if defined(__AVX2__)
const KernelTable* find_avx2(ContactKind kind, Model model, EffectSet effects, bool generic) {
  return find_kernel<4>(kind, model, effects, generic);
}
#else
const KernelTable* find_avx2(ContactKind, Model, EffectSet, bool) { return nullptr; }
#endif

}  // namespace deck::cycle::detail
