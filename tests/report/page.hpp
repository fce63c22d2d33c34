// Blocks of the page read back as the viewer reads them, and a page under way of a small deck.
#pragma once
#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "contact/small_deck.hpp"
#include "report/html/page_steps.hpp"

namespace deck::test {

using Json = nlohmann::json;
using Ids = std::vector<std::int64_t>;

/// Reads a block of the page from its begin, as the viewer does.
class PageBlock {
 public:
  explicit PageBlock(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string raw;
    unsigned bits = 0, count = 0;
    for (const char c : text) {
      if (c == '=') break;
      bits = bits << 6 | static_cast<unsigned>(digits.find(c));
      if (++count % 4 != 1) raw += static_cast<char>(bits >> (6 - 2 * ((count - 1) % 4)) & 0xff);
    }
    bytes_.resize(1 << 20);
    uLongf size = bytes_.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &size,
                         reinterpret_cast<const Bytef*>(raw.data()), raw.size()),
              Z_OK);
    bytes_.resize(size);
  }
  const std::string& bytes() const { return bytes_; }
  bool done() const { return at_ == bytes_.size(); }
  unsigned byte() { return static_cast<unsigned char>(bytes_.at(at_++)); }
  std::uint64_t u() {
    std::uint64_t v = 0;
    for (unsigned shift = 0;; shift += 7) {
      const unsigned b = byte();
      v |= std::uint64_t{b & 0x7f} << shift;
      if (b < 0x80) return v;
    }
  }
  /// `count` whole numbers, each as the difference from the one before.
  std::vector<std::int64_t> deltas(std::size_t count) {
    std::vector<std::int64_t> out;
    std::int64_t last = 0;
    for (; count > 0; --count) {
      const std::uint64_t v = u();
      out.push_back(last += static_cast<std::int64_t>(v >> 1) ^ -static_cast<std::int64_t>(v & 1));
    }
    return out;
  }
  std::vector<double> reals(std::size_t count) {
    std::vector<std::uint64_t> bits(count);
    for (unsigned plane = 0; plane < 8; ++plane)
      for (std::uint64_t& b : bits) b |= std::uint64_t{byte()} << (8 * plane);
    std::vector<double> out;
    for (const std::uint64_t b : bits) out.push_back(std::bit_cast<double>(b));
    return out;
  }
  std::vector<double> decimals(std::size_t count) {
    const std::size_t places = u();
    if (places == 0) return reals(count);
    std::vector<double> out;
    for (const std::int64_t n : deltas(count))
      out.push_back(static_cast<double>(n) / std::pow(10, places - 1));
    return out;
  }
  std::vector<double> palette(std::size_t count) {
    const std::size_t n = u();
    const std::vector<double> values = reals(n);
    std::vector<double> out(count, values.empty() ? 0.0 : values[0]);
    if (n > 1)
      for (double& v : out) v = values.at(u());
    return out;
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// A page under way of a small deck.
struct Page {
  explicit Page(const SmallDeck& d) : b(d), nodes(b.model.nodes.size()) {}
  std::int64_t id(std::int64_t number) const {
    return b.model.node_id(nodes.list().at(static_cast<std::size_t>(number)));
  }
  Built b;
  detail::PageNodes nodes;
};

}  // namespace deck::test
