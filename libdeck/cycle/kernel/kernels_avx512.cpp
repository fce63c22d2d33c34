// Pair kernels for AVX-512, packs of eight, compiled with its flags; callers test the processor.
#include "cycle/kernel/kernels.hpp"

namespace deck::cycle::detail {

#if defined(__AVX512F__)
const KernelTable* find_avx512(ContactKind kind, Model model, EffectSet effects, bool generic) {
  return find_kernel<8>(kind, model, effects, generic);
}
#else
const KernelTable* find_avx512(ContactKind, Model, EffectSet, bool) { return nullptr; }
#endif

}  // namespace deck::cycle::detail
