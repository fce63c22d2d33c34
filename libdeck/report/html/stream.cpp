// Variable-length integers and base64 of the page's binary blocks.
#include "report/html/stream.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

namespace deck::detail {

void ByteStream::f64(std::span<const double> values) {
  // Planes are written one after the other, each in pieces.
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
  // Powers of ten and whole numbers below 2^51 are exact, so that one division rounds once.
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

struct PackedText::State {
  z_stream zip{};
  std::array<Bytef, 3 * 8192> packed;  // a multiple of three, so that base64 goes on without a seam
  std::string text;
};

PackedText::PackedText() : state_(std::make_unique<State>()) {
  // Nothing but memory can be missing. Level 5 takes 1.6 times as long for 6 % (dummy on a sled).
  if (deflateInit(&state_->zip, 1) != Z_OK) throw std::bad_alloc();
  state_->zip.next_out = state_->packed.data();
  state_->zip.avail_out = static_cast<uInt>(state_->packed.size());
}

PackedText::~PackedText() { deflateEnd(&state_->zip); }

void PackedText::add(std::string_view bytes) { run(bytes, false); }

std::string PackedText::finish() {
  run({}, true);
  return std::move(state_->text);
}

void PackedText::run(std::string_view bytes, bool last) {
  constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts with 32 bits
  z_stream& zip = state_->zip;
  do {
    const std::string_view piece = bytes.substr(0, most);
    bytes.remove_prefix(piece.size());
    zip.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
    zip.avail_in = static_cast<uInt>(piece.size());
    const bool ends = last && bytes.empty();
    for (;;) {
      const int result = deflate(&zip, ends ? Z_FINISH : Z_NO_FLUSH);
      if (zip.avail_out == 0) encode(false);
      if (ends ? result == Z_STREAM_END : zip.avail_in == 0 && zip.avail_out > 0) break;
    }
  } while (!bytes.empty());
  if (last) encode(true);
}

/// Writes out what is packed: a full buffer, or the end.
void PackedText::encode(bool last) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  auto& packed = state_->packed;
  std::string& text = state_->text;
  const std::size_t size = packed.size() - state_->zip.avail_out;
  if (!last && size < packed.size()) return;
  const std::size_t have = text.size();
  text.resize(have + (size + 2) / 3 * 4);
  char* to = text.data() + have;
  std::fill(packed.begin() + static_cast<std::ptrdiff_t>(size), packed.end(), Bytef{0});
  for (std::size_t i = 0; i < size; i += 3) {
    const unsigned v = unsigned{packed[i]} << 16 | unsigned{packed[i + 1]} << 8 | packed[i + 2];
    *to++ = digits[v >> 18];
    *to++ = digits[v >> 12 & 63];
    *to++ = digits[v >> 6 & 63];
    *to++ = digits[v & 63];
  }
  std::fill(text.end() - static_cast<std::ptrdiff_t>((3 - size % 3) % 3), text.end(), '=');
  state_->zip.next_out = state_->packed.data();
  state_->zip.avail_out = static_cast<uInt>(packed.size());
}

std::string packed_text(std::string_view bytes) {
  PackedText packed;
  packed.add(bytes);
  return packed.finish();
}

}  // namespace deck::detail
