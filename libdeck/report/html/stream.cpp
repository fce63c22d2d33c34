// Variable-length integers and base64 of the page's binary blocks.
#include "report/html/stream.hpp"

#include <zlib.h>

#include <stdexcept>
#include <vector>

#include "base/bits.hpp"

namespace deck::detail {

void ByteStream::f64(std::span<const double> values) {
  const std::size_t start = bytes_.size();
  bytes_.resize(start + 8 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint64_t bits = bit_cast<std::uint64_t>(values[i]);
    for (std::size_t plane = 0; plane < 8; ++plane) {
      bytes_[start + plane * values.size() + i] = static_cast<char>(bits & 0xff);
      bits >>= 8;
    }
  }
}

std::string packed_text(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<Bytef> packed(size);
  // The buffer is as large as zlib asked for: only memory can be missing.
  if (compress2(packed.data(), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), 9) != Z_OK)
    throw std::bad_alloc();
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const unsigned a = packed[i], b = i + 1 < size ? packed[i + 1] : 0u,
                   c = i + 2 < size ? packed[i + 2] : 0u;
    const unsigned v = a << 16 | b << 8 | c;
    text += digits[v >> 18];
    text += digits[v >> 12 & 63];
    text += i + 1 < size ? digits[v >> 6 & 63] : '=';
    text += i + 2 < size ? digits[v & 63] : '=';
  }
  return text;
}

}  // namespace deck::detail
