#include "report/html_stream.hpp"

#include <zlib.h>

#include <bit>
#include <stdexcept>
#include <vector>

namespace deck::detail {

void ByteStream::f64(std::span<const double> values) {
  const std::size_t start = bytes_.size();
  bytes_.resize(start + 8 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint64_t bits = std::bit_cast<std::uint64_t>(values[i]);
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

namespace {

/// Bytes of the UTF-8 character that starts at `i`; 0 if there is none.
std::size_t character_length(std::string_view t, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(t[k]); };
  const unsigned char c = byte(i);
  if (c < 0x80) return 1;
  const std::size_t n = c >= 0xc2 && c < 0xe0   ? 2
                        : c >= 0xe0 && c < 0xf0 ? 3
                        : c >= 0xf0 && c < 0xf5 ? 4
                                                : 0;
  if (n == 0 || i + n > t.size()) return 0;
  for (std::size_t k = 1; k < n; ++k)
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
  return n;
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = character_length(text, i);
    if (n == 0) {  // Latin-1
      const auto c = static_cast<unsigned char>(text[i++]);
      out += static_cast<char>(0xc0 | c >> 6);
      out += static_cast<char>(0x80 | (c & 0x3f));
      continue;
    }
    if (n > 1) {
      out += text.substr(i, n);
      i += n;
      continue;
    }
    switch (const char c = text[i++]) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return out;
}

}  // namespace deck::detail
