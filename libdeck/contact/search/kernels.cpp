// The sweeps of the pair search, compiled once per instruction set and chosen at run time. Wider
// vectors do the same operations on more lanes: contraction is off, so the bits do not change.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/search/sweep.hpp"
#include "contact/shared/closest.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace deck::sweep {

#if defined(__x86_64__)

namespace baseline {
#define DECK_LANES 2
#define DECK_LANE_BITS(m) static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(m)))
#define DECK_ID_BITS(m) static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(m)))
#define DECK_SUB_BITS(m) (((m)[0] | (m)[1] | (m)[2] | (m)[3]) != 0)
#include "contact/search/lanes.hpp"
#include "contact/search/lanes_edges.hpp"
#undef DECK_LANES
#undef DECK_LANE_BITS
#undef DECK_ID_BITS
#undef DECK_SUB_BITS
}  // namespace baseline

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
#define DECK_LANES 4
#define DECK_LANE_BITS(m) static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m)))
#define DECK_ID_BITS(m) static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(m)))
#define DECK_SUB_BITS(m) _mm256_movemask_pd(reinterpret_cast<__m256d>(m))
#include "contact/search/lanes.hpp"
#include "contact/search/lanes_edges.hpp"
#undef DECK_LANES
#undef DECK_LANE_BITS
#undef DECK_ID_BITS
#undef DECK_SUB_BITS
}  // namespace avx2
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace {
const std::array<Kernels, 2> kernel_sets{
    Kernels{baseline::sweep_nodes, baseline::sweep_edges, baseline::near_distances,
            baseline::meet_boxes, baseline::meet_edges, "sse2"},
    Kernels{avx2::sweep_nodes, avx2::sweep_edges, avx2::near_distances, avx2::meet_boxes,
            avx2::meet_edges, "avx2"}};
}  // namespace

std::span<const Kernels> all_kernels() {
  return std::span(kernel_sets).first(__builtin_cpu_supports("avx2") ? 2 : 1);
}

#else  // any other processor: two lanes, left to the compiler

namespace generic {
#define DECK_LANES 2
#define DECK_LANE_BITS(m) (static_cast<unsigned>(-(m)[0]) | static_cast<unsigned>(-(m)[1]) << 1)
#define DECK_ID_BITS(m)                                                   \
  (static_cast<unsigned>(-(m)[0]) | static_cast<unsigned>(-(m)[1]) << 1 | \
   static_cast<unsigned>(-(m)[2]) << 2 | static_cast<unsigned>(-(m)[3]) << 3)
#define DECK_SUB_BITS(m) (((m)[0] | (m)[1] | (m)[2] | (m)[3]) != 0)
#include "contact/search/lanes.hpp"
#include "contact/search/lanes_edges.hpp"
#undef DECK_LANES
#undef DECK_LANE_BITS
#undef DECK_ID_BITS
#undef DECK_SUB_BITS
}  // namespace generic

namespace {
const std::array<Kernels, 1> kernel_sets{Kernels{generic::sweep_nodes, generic::sweep_edges,
                                                 generic::near_distances, generic::meet_boxes,
                                                 generic::meet_edges, "generic"}};
}  // namespace

std::span<const Kernels> all_kernels() { return kernel_sets; }

#endif

const Kernels& kernels() {
  static const Kernels& best = all_kernels().back();
  return best;
}

}  // namespace deck::sweep
