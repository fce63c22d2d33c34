// Double-double is half as long where the processor multiplies and adds in one step: the same text
// compiled for such processors too, and chosen when it runs. The bits are the same: the error of a
// product is exact either way. Private to the contact stage.
#pragma once

#include <utility>

namespace deck {

// Work::run(arguments...), with all that it calls compiled into it. What it calls by name only
// (exact proofs) stays as it is.
template <class Work, class... Arguments>
#if defined(__x86_64__)
[[gnu::target("avx2,fma"), gnu::flatten]]
#endif
auto run_fused(const Arguments&... arguments) {
  return Work::run(arguments...);
}

template <class Work, class... Arguments>
auto fused(const Arguments&... arguments) {
#if defined(__x86_64__)
  static const bool can = __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
  if (can) return run_fused<Work>(arguments...);
#endif
  return Work::run(arguments...);
}

}  // namespace deck
