// ByteStream: compact binary blocks of the page (variable-length integers, differences, byte
// planes), compressed and written as text.
#pragma once
#include <zlib.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace deck::detail {

/// Compresses bytes as they come (zlib); result as base64.
class PackedText {
 public:
  PackedText();
  ~PackedText();
  PackedText(const PackedText&) = delete;
  PackedText& operator=(const PackedText&) = delete;
  void add(std::string_view bytes);
  /// Text of all bytes. Add nothing afterwards.
  std::string finish();

 private:
  void run(std::string_view bytes, int flush);
  z_stream zip_{};
  std::string packed_;
};

class ByteStream {
 public:
  /// Unsigned, seven bits per byte, lowest first.
  void u(std::uint64_t v) {
    for (; v >= 0x80; v >>= 7) bytes_[size_++] = static_cast<char>(v | 0x80);
    byte(static_cast<unsigned>(v));
  }
  /// Signed: sign in the lowest bit.
  void s(std::int64_t v) {
    u((static_cast<std::uint64_t>(v) << 1) ^ static_cast<std::uint64_t>(v >> 63));
  }
  void byte(unsigned v) {
    bytes_[size_++] = static_cast<char>(v);
    if (size_ >= enough) pack();
  }
  /// Doubles as eight planes of bytes: first all lowest bytes, last all highest ones.
  void f64(std::span<const double> values);
  void f64(double value) { f64(std::span(&value, 1)); }
  /// Doubles as in a deck: number of decimals + 1, then differences of whole numbers n with value n
  /// / 10^decimals to the last bit; 0 and byte planes if impossible.
  void decimals(std::span<const double> values);
  /// For few distinct values: table, and one index per item.
  template <class Items, class Value>
  void palette(const Items& items, Value value) {
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    std::vector<double> values;
    std::vector<std::uint32_t> of_items;
    std::uint64_t last = 0;  // neighbours are mostly equal
    std::uint32_t number = 0;
    for (const auto& item : items) {
      const double v = value(item);
      const auto bits = std::bit_cast<std::uint64_t>(v);
      if (values.empty() || bits != last) {
        last = bits;
        number = numbers.emplace(bits, static_cast<std::uint32_t>(values.size())).first->second;
        if (number == values.size()) values.push_back(v);
      }
      of_items.push_back(number);
    }
    u(values.size());
    f64(values);
    if (values.size() <= 1) return;
    for (const std::uint32_t n : of_items) u(n);
  }
  /// Compressed bytes as text.
  std::string text() && {
    pack();
    return packed_.finish();
  }

 private:
  static constexpr std::size_t enough = std::size_t{1} << 18, at_once = 4096;
  void pack() {
    packed_.add({bytes_.data(), size_});
    size_ = 0;
  }
  PackedText packed_;
  std::vector<char> bytes_ = std::vector<char>(enough + at_once);  // that much is added beyond
  std::size_t size_ = 0;                                           // not yet compressed
};

/// Running difference for ByteStream::s.
class Delta {
 public:
  std::int64_t operator()(std::int64_t v) {
    const std::int64_t d = v - last_;
    last_ = v;
    return d;
  }

 private:
  std::int64_t last_ = 0;
};

std::string base64(std::string_view bytes);
/// zlib stream of `bytes` as base64 text.
std::string packed_text(std::string_view bytes);

}  // namespace deck::detail
