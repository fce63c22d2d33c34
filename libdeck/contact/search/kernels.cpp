// The sweeps of the pair search, compiled once per instruction set and chosen at run time.
#include "contact/search/lanes.hpp"
#include "contact/search/lanes_edges.hpp"

namespace deck::sweep {
namespace {

// A function with all that it calls compiled into it, for an instruction set.
template <auto function>
struct Compiled;
template <class... Arguments, void (*function)(Arguments...)>
struct Compiled<function> {
  [[gnu::flatten]] static void plain(Arguments... arguments) { function(arguments...); }
#if defined(__x86_64__)
  [[gnu::target("avx2"), gnu::flatten]] static void avx2(Arguments... arguments) {
    function(arguments...);
  }
#endif
};

#if defined(__x86_64__)
const std::array<Kernels, 2> kernel_sets{
    Kernels{Compiled<sweep_nodes<TwoLanes>>::plain, Compiled<sweep_edges<TwoLanes>>::plain,
            Compiled<near_distances>::plain, Compiled<meet_boxes<TwoLanes>>::plain,
            Compiled<meet_edges<TwoLanes>>::plain, "sse2"},
    Kernels{Compiled<sweep_nodes<FourLanes>>::avx2, Compiled<sweep_edges<FourLanes>>::avx2,
            Compiled<near_distances>::avx2, Compiled<meet_boxes<FourLanes>>::avx2,
            Compiled<meet_edges<FourLanes>>::avx2, "avx2"}};
#else  // any other processor: two lanes, left to the compiler
const std::array<Kernels, 1> kernel_sets{
    Kernels{Compiled<sweep_nodes<TwoLanes>>::plain, Compiled<sweep_edges<TwoLanes>>::plain,
            Compiled<near_distances>::plain, Compiled<meet_boxes<TwoLanes>>::plain,
            Compiled<meet_edges<TwoLanes>>::plain, "generic"}};
#endif

}  // namespace

std::span<const Kernels> all_kernels() {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) return std::span(kernel_sets).first(1);
#endif
  return kernel_sets;
}

const Kernels& kernels() {
  static const Kernels& best = all_kernels().back();
  return best;
}

}  // namespace deck::sweep
