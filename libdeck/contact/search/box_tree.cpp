// Bottom-up construction of the box tree.
#include "contact/search/box_tree.hpp"

#include <algorithm>
#include <utility>

namespace deck {

void BoxTree::set_origin(const Box& box) {
  for (std::size_t k = 0; k < 3; ++k) origin_[k] = std::isfinite(box.low[k]) ? box.low[k] : 0.0;
}

void BoxTree::add_levels(std::vector<BoxBlock> leaves, int threads) {
  levels_.push_back(std::move(leaves));
  while (levels_.back().size() > 1) {
    const std::vector<BoxBlock>& below = levels_.back();
    constexpr std::size_t width = BoxBlock::width;
    std::vector<BoxBlock> above((below.size() + width - 1) / width);
    parallel_pieces(threads, above.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t last = std::min(below.size(), (i + 1) * width);
        for (std::size_t j = i * width; j < last; ++j) above[i].set(j % width, below[j].bounds());
      }
    });
    levels_.push_back(std::move(above));
  }
}

std::size_t BoxTree::bytes() const {
  std::size_t sum = 0;
  for (const auto& level : levels_) sum += level.size() * sizeof(BoxBlock);
  return sum;
}

}  // namespace deck
