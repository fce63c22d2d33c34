// Pair kernels for the minimum instruction set of the target: packs of two.
#include "cycle/kernel/kernels.hpp"

namespace deck::cycle::detail {

const KernelTable* find_baseline(ContactKind kind, Model model, EffectSet effects, bool generic) {
  return find_kernel<2>(kind, model, effects, generic);
}

}  // namespace deck::cycle::detail
