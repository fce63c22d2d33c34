// W doubles with the arithmetic of the pair kernels. Every operation is the IEEE operation per
// lane: results do not depend on W or on the instruction set.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "deck/point3.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

// Forces inlining into the loops; compilers do not inline this deep by default. Not under
// sanitizers: a kernel would cost a gigabyte and minutes.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DECK_PLAIN_CALLS
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DECK_PLAIN_CALLS
#endif
#endif
#ifdef DECK_PLAIN_CALLS
#define DECK_INLINE
#define DECK_FLATTEN
#else
#define DECK_INLINE __attribute__((always_inline))
#define DECK_FLATTEN __attribute__((flatten))
#endif

namespace deck::cycle::detail {

// Register types by width (compilers accept vector_size only on a concrete type). `loose` types
// need no alignment. A vector may alias arrays of its element type.
template <int W>
struct Registers;
template <>
struct Registers<2> {
  typedef double Real __attribute__((vector_size(16)));
  typedef std::int64_t Bits __attribute__((vector_size(16)));
  typedef double LooseReal __attribute__((vector_size(16), aligned(8)));
  typedef std::int64_t LooseBits __attribute__((vector_size(16), aligned(8)));
};
template <>
struct Registers<4> {
  typedef double Real __attribute__((vector_size(32)));
  typedef std::int64_t Bits __attribute__((vector_size(32)));
  typedef double LooseReal __attribute__((vector_size(32), aligned(8)));
  typedef std::int64_t LooseBits __attribute__((vector_size(32), aligned(8)));
};
template <>
struct Registers<8> {
  typedef double Real __attribute__((vector_size(64)));
  typedef std::int64_t Bits __attribute__((vector_size(64)));
  typedef double LooseReal __attribute__((vector_size(64), aligned(8)));
  typedef std::int64_t LooseBits __attribute__((vector_size(64), aligned(8)));
};

/// Calls f with the constants 0 to 3: unlike in a loop, indexed values stay in registers.
template <class F>
DECK_INLINE inline void four_times(F&& f) {
  f(std::integral_constant<std::size_t, 0>{});
  f(std::integral_constant<std::size_t, 1>{});
  f(std::integral_constant<std::size_t, 2>{});
  f(std::integral_constant<std::size_t, 3>{});
}

// Everything below is a template on W: an object for a newer instruction set must not export
// symbols that other objects could link to.
template <int W>
struct Mask {
  using Reg = typename Registers<W>::Bits;
  Reg r;
  friend Mask operator&(const Mask& a, const Mask& b) { return {a.r & b.r}; }
  friend Mask operator|(const Mask& a, const Mask& b) { return {a.r | b.r}; }
  friend Mask operator~(const Mask& a) { return {~a.r}; }
};

template <int W>
struct Pack {
  static constexpr int width = W;
  using Reg = typename Registers<W>::Real;
  Reg r;

  static Pack load(const double* p) {
    return {*reinterpret_cast<const typename Registers<W>::LooseReal*>(p)};
  }
  static Pack fill(double v) {
    Pack out;
    for (int l = 0; l < W; ++l) out.r[l] = v;
    return out;
  }
  void store(double* p) const { *reinterpret_cast<typename Registers<W>::LooseReal*>(p) = r; }
  double operator[](int lane) const { return r[lane]; }

  friend Pack operator+(const Pack& a, const Pack& b) { return {a.r + b.r}; }
  friend Pack operator-(const Pack& a, const Pack& b) { return {a.r - b.r}; }
  friend Pack operator*(const Pack& a, const Pack& b) { return {a.r * b.r}; }
  friend Pack operator/(const Pack& a, const Pack& b) { return {a.r / b.r}; }
  friend Pack operator-(const Pack& a) { return {-a.r}; }
  friend Pack operator+(const Pack& a, double b) { return {a.r + b}; }
  friend Pack operator-(double a, const Pack& b) { return {a - b.r}; }
  friend Pack operator*(double a, const Pack& b) { return {a * b.r}; }
  friend Pack operator/(double a, const Pack& b) { return {a / b.r}; }
  friend Mask<W> operator<(const Pack& a, const Pack& b) { return {a.r < b.r}; }
  friend Mask<W> operator<=(const Pack& a, const Pack& b) { return {a.r <= b.r}; }
  friend Mask<W> operator>(const Pack& a, const Pack& b) { return {a.r > b.r}; }
  friend Mask<W> operator==(const Pack& a, const Pack& b) { return {a.r == b.r}; }
  friend Mask<W> operator!=(const Pack& a, const Pack& b) { return {a.r != b.r}; }
};

template <int W>
Pack<W> select(const Mask<W>& m, const Pack<W>& yes, const Pack<W>& no) {
  return {m.r ? yes.r : no.r};
}
template <int W>
bool any(const Mask<W>& m) {
  std::int64_t bits = 0;
  for (int l = 0; l < W; ++l) bits |= m.r[l];
  return bits != 0;
}
/// a if a > b, else b: a NaN in `a` gives b, as in scalar code. The instruction does this; the
/// compiler does not find it for packs of two.
template <int W>
Pack<W> max(const Pack<W>& a, const Pack<W>& b) {
#if defined(__SSE2__)
  if constexpr (W == 2) {
    Pack<W> out;
    const __m128d v = _mm_max_pd((__m128d)a.r, (__m128d)b.r);
    std::memcpy(&out.r, &v, sizeof v);
    return out;
  }
#endif
  return {a.r > b.r ? a.r : b.r};
}
template <int W>
Pack<W> min(const Pack<W>& a, const Pack<W>& b) {
#if defined(__SSE2__)
  if constexpr (W == 2) {
    Pack<W> out;
    const __m128d v = _mm_min_pd((__m128d)a.r, (__m128d)b.r);
    std::memcpy(&out.r, &v, sizeof v);
    return out;
  }
#endif
  return {a.r < b.r ? a.r : b.r};
}
template <int W>
Pack<W> abs(const Pack<W>& a) {
  typename Mask<W>::Reg bits;
  std::memcpy(&bits, &a.r, sizeof bits);
  bits &= INT64_MAX;
  Pack<W> out;
  std::memcpy(&out.r, &bits, sizeof bits);
  return out;
}
template <int W>
Pack<W> sqrt(const Pack<W>& a) {
  Pack<W> out;
#if defined(__AVX512F__)
  if constexpr (W == 8) {
    // Not _mm512_sqrt_pd: its undefined pass-through operand trips -Wuninitialized in g++ 12.
    const __m512d v = _mm512_maskz_sqrt_pd(0xff, (__m512d)a.r);
    std::memcpy(&out.r, &v, sizeof v);
    return out;
  }
#endif
#if defined(__AVX__)
  if constexpr (W == 4) {
    const __m256d v = _mm256_sqrt_pd((__m256d)a.r);
    std::memcpy(&out.r, &v, sizeof v);
    return out;
  }
#endif
#if defined(__SSE2__)
  if constexpr (W == 2) {
    const __m128d v = _mm_sqrt_pd((__m128d)a.r);
    std::memcpy(&out.r, &v, sizeof v);
    return out;
  }
#endif
  for (int l = 0; l < W; ++l) out.r[l] = std::sqrt(a.r[l]);
  return out;
}
/// Applies a scalar function lane by lane: for rare cases and transcendental functions.
template <int W, class F>
Pack<W> map(const Pack<W>& a, F f) {
  Pack<W> out;
  for (int l = 0; l < W; ++l) out.r[l] = f(a.r[l]);
  return out;
}
template <int W>
void store_bits(const Mask<W>& m, std::int64_t* p) {
  *reinterpret_cast<typename Registers<W>::LooseBits*>(p) = m.r;
}
template <int W>
Mask<W> bits_if(const Mask<W>& m, std::int64_t value) {
  return {m.r & value};
}

template <class V>
using Vec3 = Point3<V>;
/// Loads a pack of vectors from three arrays.
template <class V>
Vec3<V> load3(const std::array<const double*, 3>& p, std::size_t i) {
  return {V::load(p[0] + i), V::load(p[1] + i), V::load(p[2] + i)};
}
template <int W>
Vec3<Pack<W>> select(const Mask<W>& m, const Vec3<Pack<W>>& a, const Vec3<Pack<W>>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
template <class V>
V clamp01(const V& t) {
  return max(min(t, V::fill(1.0)), V::fill(0.0));
}

}  // namespace deck::cycle::detail
