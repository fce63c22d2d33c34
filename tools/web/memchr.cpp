// memchr() sixteen bytes at a time: reading a deck is looking for ends of lines, and emscripten's
// own goes by words of four.
#include <wasm_simd128.h>

#include <cstddef>
#include <cstdint>

extern "C" void* memchr(const void* text, int wanted, std::size_t size) {
  const auto* at = static_cast<const std::uint8_t*>(text);
  const auto byte = static_cast<std::uint8_t>(wanted);
  const v128_t all = wasm_i8x16_splat(static_cast<std::int8_t>(byte));
  for (; size >= 16; at += 16, size -= 16)
    if (const auto hits = wasm_i8x16_bitmask(wasm_i8x16_eq(wasm_v128_load(at), all)); hits != 0)
      return const_cast<std::uint8_t*>(at) + __builtin_ctz(static_cast<unsigned>(hits));
  for (; size > 0; ++at, --size)
    if (*at == byte) return const_cast<std::uint8_t*>(at);
  return nullptr;
}
