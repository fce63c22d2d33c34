// Variable-length integers and base64 of the page's binary blocks.
#include "report/html/stream.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

namespace deck::detail {

void ByteStream::f64(std::span<const double> values) {
  // Planes are written one after the other, in pieces.
  for (std::size_t plane = 0; plane < 8; ++plane)
    for (std::size_t from = 0; from < values.size(); from += at_once) {
      const std::size_t end = std::min(from + at_once, values.size());
      char* to = bytes_.data() + size_;
      for (std::size_t i = from; i < end; ++i)
        *to++ = static_cast<char>(std::bit_cast<std::uint64_t>(values[i]) >> (8 * plane) & 0xff);
      size_ += end - from;
      if (size_ >= enough) pack();
    }
}

void ByteStream::decimals(std::span<const double> values) {
  // Powers of ten and whole numbers below 2^51 are exact: one division rounds once.
  constexpr double largest = 2251799813685248.0;
  constexpr int most = 15;
  double power = 1;
  int count = 0;
  const auto fits = [&](double v) {
    const double n = std::nearbyint(v * power);
    return std::abs(n) < largest && n / power == v && (n != 0 || !std::signbit(v));
  };
  for (const double v : values)
    while (count <= most && !fits(v)) {
      power *= 10;
      ++count;
    }
  if (count > most || !std::all_of(values.begin(), values.end(), fits)) {
    u(0);
    f64(values);
    return;
  }
  u(static_cast<std::uint64_t>(count) + 1);
  std::int64_t last = 0;
  for (const double v : values) {
    const auto n = static_cast<std::int64_t>(std::nearbyint(v * power));
    s(n - last);
    last = n;
  }
}

PackedText::PackedText() {
  // Fails only without memory. Level 5 is 6 % smaller but takes 1.6 times as long (dummy on a
  // sled).
  if (deflateInit(&zip_, 1) != Z_OK) throw std::bad_alloc();
}

PackedText::~PackedText() { deflateEnd(&zip_); }

void PackedText::add(std::string_view bytes) { run(bytes, Z_NO_FLUSH); }

std::string PackedText::finish() {
  run({}, Z_FINISH);
  return base64(packed_);
}

void PackedText::run(std::string_view bytes, int flush) {
  constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts with 32 bits
  std::array<char, 24576> buffer;
  do {
    const std::string_view piece = bytes.substr(0, most);
    bytes.remove_prefix(piece.size());
    zip_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
    zip_.avail_in = static_cast<uInt>(piece.size());
    do {
      zip_.next_out = reinterpret_cast<Bytef*>(buffer.data());
      zip_.avail_out = static_cast<uInt>(buffer.size());
      deflate(&zip_, flush);
      packed_.append(buffer.data(), buffer.size() - zip_.avail_out);
    } while (zip_.avail_out == 0);
  } while (!bytes.empty());
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* to = text.data();
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 3))) {
    unsigned v = 0;
    for (std::size_t i = 0; i < 3; ++i)
      v = v << 8 | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      if (i <= bytes.size()) to[i] = digits[v >> (18 - 6 * i) & 63];
    to += 4;
  }
  return text;
}

std::string packed_text(std::string_view bytes) {
  PackedText packed;
  packed.add(bytes);
  return packed.finish();
}

}  // namespace deck::detail
