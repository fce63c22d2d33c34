// Hilbert curve by state table, and the radix sort of its keys.
#include "contact/box_order.hpp"

#include <array>
#include <cmath>

namespace deck::order_detail {
namespace {

// One step of the curve takes one bit of each axis. A state is the corner where the curve enters
// a cell and the axis along which it leaves it: 8 x 3 states (Hamilton's construction).
struct Step {
  std::uint8_t octant;  // rank of the child along the curve
  std::uint8_t state;
};
constexpr unsigned kStates = 24;

constexpr unsigned rotate_left(unsigned v, unsigned by) {
  by %= 3;
  return ((v << by) | (v >> (3 - by))) & 7U;
}
constexpr unsigned rotate_right(unsigned v, unsigned by) { return rotate_left(v, 3 - by % 3); }
constexpr unsigned gray(unsigned v) { return v ^ (v >> 1); }
constexpr unsigned gray_inverse(unsigned v) { return v ^ (v >> 1) ^ (v >> 2); }
constexpr unsigned trailing_ones(unsigned v) {
  unsigned count = 0;
  for (; (v & 1U) != 0; v >>= 1) ++count;
  return count;
}
constexpr unsigned entry(unsigned w) { return w == 0 ? 0 : gray(2 * ((w - 1) / 2)); }
constexpr unsigned direction(unsigned w) {
  if (w == 0) return 0;
  return (w % 2 == 0 ? trailing_ones(w - 1) : trailing_ones(w)) % 3;
}

constexpr auto make_steps() {
  std::array<std::array<Step, 8>, kStates> steps{};
  for (unsigned e = 0; e < 8; ++e) {
    for (unsigned d = 0; d < 3; ++d) {
      for (unsigned cell = 0; cell < 8; ++cell) {
        const unsigned w = gray_inverse(rotate_right(cell ^ e, d + 1));
        const unsigned next_e = e ^ rotate_left(entry(w), d + 1);
        const unsigned next_d = (d + direction(w) + 1) % 3;
        steps[e * 3 + d][cell] = {static_cast<std::uint8_t>(w),
                                  static_cast<std::uint8_t>(next_e * 3 + next_d)};
      }
    }
  }
  return steps;
}
constexpr auto kSteps = make_steps();

}  // namespace

std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z, unsigned bits) {
  std::uint64_t index = 0;
  unsigned state = 0;
  for (unsigned level = bits; level-- > 0;) {
    const unsigned cell =
        ((x >> level) & 1U) | (((y >> level) & 1U) << 1) | (((z >> level) & 1U) << 2);
    const Step step = kSteps[state][cell];
    index = (index << 3) | step.octant;
    state = step.state;
  }
  return index;
}

CurveGrid::CurveGrid(const Point3<double>& low, const Point3<double>& high, unsigned bits)
    : low_(0.25 * low), bits_(bits) {
  const Point3<double> size = 0.25 * high - low_;
  const double extent = std::max(size.x, std::max(size.y, size.z));
  const double cells = std::ldexp(1.0, static_cast<int>(bits));
  cells_per_length_ = cells / extent;
  last_cell_ = cells - 1.0;
  usable_ = extent > 0.0 && std::isfinite(cells_per_length_) && std::isfinite(extent);
}

void radix_sort(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& spare, unsigned low,
                unsigned high, int threads) {
  constexpr std::size_t kSmall = 2048;
  constexpr unsigned kDigit = 11;
  constexpr std::size_t kBuckets = std::size_t{1} << kDigit;
  if (keys.size() < kSmall) {
    // The bits below `low` are the position at entry: a full sort is the stable one.
    std::sort(keys.begin(), keys.end());
    return;
  }
  spare.resize(keys.size());
  const auto parts = static_cast<std::size_t>(threads);
  std::vector<std::array<std::size_t, kBuckets>> counts(parts);
  for (unsigned shift = low; shift < high; shift += kDigit) {
    const std::uint64_t mask = (std::uint64_t{1} << std::min(kDigit, high - shift)) - 1;
    parallel_parts(threads, keys.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
      auto& count = counts[part];
      count.fill(0);
      for (std::size_t i = begin; i < end; ++i) ++count[(keys[i] >> shift) & mask];
    });
    std::size_t sum = 0;
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      for (auto& count : counts) {
        const std::size_t here = count[bucket];
        count[bucket] = sum;
        sum += here;
      }
    }
    parallel_parts(threads, keys.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
      auto& place = counts[part];
      for (std::size_t i = begin; i < end; ++i) spare[place[(keys[i] >> shift) & mask]++] = keys[i];
    });
    keys.swap(spare);
  }
}

}  // namespace deck::order_detail
