// A tree of boxes, eight children to a block, built bottom-up over leaves that are already in
// spatial order. Blocks hold the children's boxes side by side so that one test covers all eight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

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
  // False for a box without a number, as for one that holds nothing.
  bool overlaps(const Box& b) const {
    return (low[0] <= b.high[0]) & (high[0] >= b.low[0]) & (low[1] <= b.high[1]) &
           (high[1] >= b.low[1]) & (low[2] <= b.high[2]) & (high[2] >= b.low[2]);
  }
  double size() const { return (high[0] - low[0]) + (high[1] - low[1]) + (high[2] - low[2]); }
};

// Eight boxes. Unused places hold no number at all: no comparison with them is true, so that they
// overlap nothing, not even a box without bounds, and add nothing to the bounds of the block.
struct alignas(64) BoxBlock {
  static constexpr std::size_t width = 8;
  std::array<std::array<double, width>, 3> low;
  std::array<std::array<double, width>, 3> high;

  BoxBlock() {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (auto& axis : low) axis.fill(none);
    for (auto& axis : high) axis.fill(none);
  }
  void set(std::size_t child, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k][child] = b.low[k];
      high[k][child] = b.high[k];
    }
  }
  Box bounds() const {
    Box all;
    for (std::size_t c = 0; c < width; ++c) {
      all.add({{low[0][c], low[1][c], low[2][c]}, {high[0][c], high[1][c], high[2][c]}});
    }
    return all;
  }
};

// Block `index` of level 0 holds the boxes of leaves 8*index ... 8*index+7; block `index` of level
// l > 0 holds the bounds of blocks 8*index ... of level l-1. The last level has one block.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<BoxBlock> leaves, int threads);

  std::size_t levels() const { return levels_.size(); }
  const std::vector<BoxBlock>& level(std::size_t i) const { return levels_[i]; }
  std::size_t bytes() const;

 private:
  std::vector<std::vector<BoxBlock>> levels_;
};

}  // namespace deck
