// Pair kernels for the instruction set every machine of the target has: packs of two.
#include "cycle/kernel/kernels.hpp"

namespace deck::cycle::detail {

const KernelTable* find_baseline(ContactKind kind, Model model, EffectSet effects, bool generic) {
  return find_kernel<2>(kind, model, effects, generic);
}

}  // namespace deck::cycle::detail
