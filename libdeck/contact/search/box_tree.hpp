// A tree of boxes with eight children per block, built bottom-up over leaves in spatial order. A
// block stores its children's boxes side by side: one test covers all eight.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/shared/parallel.hpp"
#include "deck/point3.hpp"

namespace deck {

struct Box {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{infinity, infinity, infinity};
  std::array<double, 3> high{-infinity, -infinity, -infinity};

  void add(const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = b.low[k] < low[k] ? b.low[k] : low[k];
      high[k] = b.high[k] > high[k] ? b.high[k] : high[k];
    }
  }
  // False for a box of NaN, as for an empty one.
  bool overlaps(const Box& b) const {
    return (low[0] <= b.high[0]) & (high[0] >= b.low[0]) & (low[1] <= b.high[1]) &
           (high[1] >= b.low[1]) & (low[2] <= b.high[2]) & (high[2] >= b.low[2]);
  }
  double size() const { return (high[0] - low[0]) + (high[1] - low[1]) + (high[2] - low[2]); }

  // NaN: overlaps nothing, not even an unbounded box.
  static Box nowhere() {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {{none, none, none}, {none, none, none}};
  }
};

// A box in single precision relative to an origin, rounded outwards: overlaps all that the double
// box overlaps. Half the memory, twice as many per test.
struct FloatBox {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low{infinity, infinity, infinity};
  std::array<float, 3> high{-infinity, -infinity, -infinity};

  FloatBox() = default;
  FloatBox(const Box& b, const std::array<double, 3>& origin) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = below(b.low[k] - origin[k]);
      high[k] = -below(origin[k] - b.high[k]);
    }
  }
  void add(const FloatBox& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = b.low[k] < low[k] ? b.low[k] : low[k];
      high[k] = b.high[k] > high[k] ? b.high[k] : high[k];
    }
  }
  float size() const { return (high[0] - low[0]) + (high[1] - low[1]) + (high[2] - low[2]); }

 private:
  // One or two ulps below the nearest number; infinite below the least one.
  static float below(double v) {
    constexpr double most = std::numeric_limits<float>::max();
    const double not_above = v > most ? most : v;
    const auto nearest = static_cast<float>(not_above < -most ? -most : not_above);
    return nearest - (std::fabs(nearest) * 0x1p-23F + std::numeric_limits<float>::min());
  }
};

// Eight boxes. Unused ones are NaN: they overlap nothing and do not change bounds.
struct alignas(64) BoxBlock {
  static constexpr std::size_t width = 8;
  std::array<std::array<float, width>, 3> low;
  std::array<std::array<float, width>, 3> high;

  BoxBlock() {
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    for (auto& axis : low) axis.fill(none);
    for (auto& axis : high) axis.fill(none);
  }
  void set(std::size_t child, const FloatBox& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k][child] = b.low[k];
      high[k][child] = b.high[k];
    }
  }
  FloatBox bounds() const {
    FloatBox all;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < width; ++c) {
        all.low[k] = low[k][c] < all.low[k] ? low[k][c] : all.low[k];
        all.high[k] = high[k][c] > all.high[k] ? high[k][c] : all.high[k];
      }
    return all;
  }
};

// Block `index` of level 0 has the boxes of leaves 8*index ... 8*index+7; block `index` of level l
// > 0 has the bounds of the eight blocks 8*index ... of level l-1. The last level has one block.
class BoxTree {
 public:
  BoxTree() = default;
  // box_of(0) ... box_of(count-1) are called on several threads.
  template <class BoxOf>
  BoxTree(std::size_t count, const BoxOf& box_of, int threads) {
    if (count == 0) return;
    // Near most boxes, wherever the model lies and however far a stray node is.
    set_origin(box_of(count / 2));
    constexpr std::size_t width = BoxBlock::width;
    std::vector<BoxBlock> leaves((count + width - 1) / width);
    parallel_pieces(threads, leaves.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin * width; i < std::min(count, end * width); ++i)
        leaves[i / width].set(i % width, rounded(box_of(i)));
    });
    add_levels(std::move(leaves), threads);
  }

  std::size_t levels() const { return levels_.size(); }
  const std::vector<BoxBlock>& level(std::size_t i) const { return levels_[i]; }
  // The box in the format of the blocks.
  FloatBox rounded(const Box& b) const { return {b, origin_}; }

 private:
  void set_origin(const Box& box);
  void add_levels(std::vector<BoxBlock> leaves, int threads);

  std::array<double, 3> origin_{};
  std::vector<std::vector<BoxBlock>> levels_;
};

// Order along a Hilbert curve: neighbours in the list are neighbours in space. Crowded cells of the
// curve are ordered again on a finer grid, so any grading works.

// Threads for a cheap loop over `count` items. Starting a thread takes as long as some thousand
// items, and much longer on a busy machine.
inline int threads_for(std::size_t count, int threads) { return count < 32768 ? 1 : threads; }

// Centre and size class (0..7) of an item; classes are never mixed.
struct Place {
  Point3<double> centre;
  unsigned size_class = 0;
};

namespace order_detail {

// Position of a cell on a Hilbert curve of 2^bits cells per axis.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z, unsigned bits);

// Sorts by the bits [low, high) only; stable. `spare` has the size of `keys`.
void radix_sort(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& spare, unsigned low,
                unsigned high, int threads);

// A cubic grid around points. Coordinates are divided by four: no difference overflows.
class CurveGrid {
 public:
  CurveGrid(const Point3<double>& low, const Point3<double>& high, unsigned bits);
  bool usable() const { return usable_; }  // false: all points coincide
  std::uint64_t index(const Point3<double>& p) const {
    return hilbert_index(cell(p.x, low_.x), cell(p.y, low_.y), cell(p.z, low_.z), bits_);
  }

 private:
  std::uint32_t cell(double v, double low) const {
    const double t = (0.25 * v - low) * cells_per_length_;
    return t > 0.0 ? static_cast<std::uint32_t>(std::min(t, last_cell_)) : 0U;
  }
  Point3<double> low_;
  double cells_per_length_ = 0.0;
  double last_cell_ = 0.0;
  unsigned bits_ = 0;
  bool usable_ = false;
};

}  // namespace order_detail

// Writes the centres of `ids` to `out`. Called repeatedly instead of storing all of them.
using PlacesOf = std::function<void(std::span<const std::uint32_t> ids, Place* out)>;

// Positions 0 ... count-1 along the curve. Depends only on the centres.
std::vector<std::uint32_t> order_in_space(std::size_t count, const PlacesOf& places, int threads);

// order_in_space for a function of one item.
template <class PlaceOf>
std::vector<std::uint32_t> order_by_place(std::size_t count, const PlaceOf& place_of, int threads) {
  const PlacesOf places = [&place_of](std::span<const std::uint32_t> ids, Place* out) {
    for (const std::uint32_t i : ids) *out++ = place_of(i);
  };
  return order_in_space(count, places, threads);
}

}  // namespace deck
