// ByteStream: the compact binary blocks of the HTML report — variable-length integers, differences
// and byte planes, made to compress well — and how a block becomes text.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace deck::detail {

class ByteStream {
 public:
  /// Unsigned, seven bits per byte, lowest first.
  void u(std::uint64_t v) {
    while (v >= 0x80) {
      bytes_ += static_cast<char>(v | 0x80);
      v >>= 7;
    }
    bytes_ += static_cast<char>(v);
  }
  /// Signed: sign in the lowest bit.
  void s(std::int64_t v) {
    u((static_cast<std::uint64_t>(v) << 1) ^ static_cast<std::uint64_t>(v >> 63));
  }
  /// One byte as it is.
  void byte(unsigned v) { bytes_ += static_cast<char>(v); }
  /// Doubles as eight planes of bytes: first all lowest bytes, last all highest ones.
  void f64(std::span<const double> values);
  void f64(double value) { f64(std::span(&value, 1)); }
  /// Few distinct values, one index per item.
  template <class Items, class Value>
  void palette(const Items& items, Value value) {
    std::unordered_map<double, std::uint32_t> number;
    std::vector<double> values;
    std::vector<std::uint32_t> index;
    for (const auto& item : items) {
      const double v = value(item);
      const auto [it, fresh] = number.emplace(v, static_cast<std::uint32_t>(values.size()));
      if (fresh) values.push_back(v);
      index.push_back(it->second);
    }
    u(values.size());
    f64(values);
    if (values.size() > 1)
      for (const std::uint32_t i : index) u(i);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
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

/// zlib stream of `bytes` as base64 text.
std::string packed_text(std::string_view bytes);

}  // namespace deck::detail
