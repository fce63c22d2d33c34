// Hilbert curve by state table, radix sort of its keys, ordering of points, and the box tree.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "contact/search/box_tree.hpp"

namespace deck::order_detail {
namespace {

// A step along the curve takes one bit of each axis. State: the corner where the curve enters a
// cell and the axis along which it leaves: 8 x 3 states (Hamilton's construction).
struct Step {
  std::uint8_t octant;  // rank of the child along the curve
  std::uint8_t state;
};
constexpr unsigned curve_states = 24;

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
  std::array<std::array<Step, 8>, curve_states> steps{};
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
constexpr auto single_steps = make_steps();

// Two steps at once: index by state and by two bits of each axis (zzyyxx).
struct DoubleStep {
  std::uint8_t rank;
  std::uint8_t state;
};
constexpr auto make_double_steps() {
  std::array<std::array<DoubleStep, 64>, curve_states> steps{};
  for (unsigned state = 0; state < curve_states; ++state) {
    for (unsigned c = 0; c < 64; ++c) {
      const unsigned x = c & 3U, y = (c >> 2) & 3U, z = c >> 4;
      const Step one = single_steps[state][(x >> 1) | (y >> 1) << 1 | (z >> 1) << 2];
      const Step two = single_steps[one.state][(x & 1U) | (y & 1U) << 1 | (z & 1U) << 2];
      steps[state][c] = {static_cast<std::uint8_t>(one.octant << 3 | two.octant), two.state};
    }
  }
  return steps;
}
constexpr auto double_steps = make_double_steps();

struct Scratch {
  std::vector<std::uint64_t> keys, spare;
  std::vector<std::uint32_t> ids;
  std::vector<Place> places;
};
// Up to this number, centres are kept while keys are formed.
constexpr std::size_t most_kept = 32768;

struct Bounds {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Point3<double> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  void add(const Point3<double>& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
};

// Visits positions begin ... end-1 of `ids` with their centres.
template <class Visit>
void each_place(std::span<const std::uint32_t> ids, const PlacesOf& places, const Scratch& scratch,
                std::size_t begin, std::size_t end, const Visit& visit) {
  if (ids.size() <= most_kept) {
    for (std::size_t i = begin; i < end; ++i) visit(i, scratch.places[i]);
    return;
  }
  std::array<Place, 64> some;
  for (std::size_t first = begin; first < end; first += some.size()) {
    const std::size_t count = std::min(some.size(), end - first);
    places(ids.subspan(first, count), some.data());
    for (std::size_t i = 0; i < count; ++i) visit(first + i, some[i]);
  }
}

Bounds bounds_of(std::span<const std::uint32_t> ids, const PlacesOf& places, const Scratch& scratch,
                 int threads) {
  std::vector<Bounds> parts(pieces_of(threads, ids.size()));
  parallel_pieces(threads, ids.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    Bounds bounds;
    each_place(ids, places, scratch, begin, end,
               [&](std::size_t, const Place& place) { bounds.add(place.centre); });
    parts[part] = bounds;
  });
  Bounds all;
  for (const Bounds& b : parts) {
    all.add(b.low);
    all.add(b.high);
  }
  return all;
}

// Sorts `ids` by size class and curve position, then crowded cells again on their own grids.
void order_range(std::span<std::uint32_t> ids, const PlacesOf& places, Scratch& scratch,
                 int threads, int depth) {
  constexpr std::size_t small = 32;  // shorter runs stay as they are
  constexpr int deepest = 64;        // below it only coincident points are left
  constexpr unsigned class_bits = 3;
  const std::size_t n = ids.size();
  if (n < 2 || depth > deepest) return;
  if (n <= most_kept) {
    scratch.places.resize(n);
    places(ids, scratch.places.data());
  }
  const Bounds all = bounds_of(ids, places, scratch, threads);
  // Key in 64 bits: class, curve position, position in the list.
  const auto id_bits = static_cast<unsigned>(std::bit_width(n - 1));
  const unsigned wanted = std::max(4U, id_bits / 2 + 2);
  const unsigned bits = std::min(wanted, (64 - class_bits - id_bits) / 3);
  const CurveGrid grid(all.low, all.high, bits);
  if (!grid.usable() && depth > 0) return;
  scratch.keys.resize(n);
  parallel_pieces(threads, n, [&](std::size_t, std::size_t begin, std::size_t end) {
    each_place(ids, places, scratch, begin, end, [&](std::size_t i, const Place& place) {
      const std::uint64_t curve = grid.usable() ? grid.index(place.centre) : 0;
      const std::uint64_t key = (std::uint64_t{place.size_class} << (3 * bits)) | curve;
      scratch.keys[i] = (key << id_bits) | i;
    });
  });
  radix_sort(scratch.keys, scratch.spare, id_bits, id_bits + 3 * bits + class_bits, threads);
  const std::uint64_t mask = (std::uint64_t{1} << id_bits) - 1;
  if (depth == 0) {  // ids[i] == i
    for (std::size_t i = 0; i < n; ++i) ids[i] = static_cast<std::uint32_t>(scratch.keys[i] & mask);
  } else {
    scratch.ids.assign(ids.begin(), ids.end());
    for (std::size_t i = 0; i < n; ++i) ids[i] = scratch.ids[scratch.keys[i] & mask];
  }
  if (!grid.usable()) return;
  // First list the runs: the recursion reuses the scratch arrays.
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  for (std::size_t i = 0; i < n;) {
    std::size_t j = i + 1;
    while (j < n && (scratch.keys[j] >> id_bits) == (scratch.keys[i] >> id_bits)) ++j;
    if (j - i > small) runs.emplace_back(i, j - i);
    i = j;
  }
  for (const auto& [first, count] : runs) {
    order_range(ids.subspan(first, count), places, scratch, threads, depth + 1);
  }
}

}  // namespace

std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z, unsigned bits) {
  std::uint64_t index = 0;
  unsigned state = 0;
  // Two levels at a time; an odd first one alone.
  if (bits % 2 != 0) {
    const unsigned top = bits - 1;
    const Step step =
        single_steps[0][((x >> top) & 1U) | ((y >> top) & 1U) << 1 | ((z >> top) & 1U) << 2];
    index = step.octant;
    state = step.state;
  }
  for (unsigned level = bits & ~1U; level > 0;) {
    level -= 2;
    const unsigned cell = ((x >> level) & 3U) | ((y >> level) & 3U) << 2 | ((z >> level) & 3U) << 4;
    const DoubleStep step = double_steps[state][cell];
    index = (index << 6) | step.rank;
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
  constexpr std::size_t small = 2048;
  constexpr unsigned digit = 11;
  constexpr std::size_t buckets = std::size_t{1} << digit;
  if (keys.size() < small) {
    // The bits below `low` are the original positions, so a full sort is stable.
    std::sort(keys.begin(), keys.end());
    return;
  }
  spare.resize(keys.size());
  const auto parts = static_cast<std::size_t>(threads);
  std::vector<std::array<std::size_t, buckets>> counts(parts);
  for (unsigned shift = low; shift < high; shift += digit) {
    const std::uint64_t mask = (std::uint64_t{1} << std::min(digit, high - shift)) - 1;
    parallel_parts(threads, keys.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
      auto& count = counts[part];
      count.fill(0);
      for (std::size_t i = begin; i < end; ++i) ++count[(keys[i] >> shift) & mask];
    });
    std::size_t sum = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
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

namespace deck {

std::vector<std::uint32_t> order_in_space(std::size_t count, const PlacesOf& places, int threads) {
  std::vector<std::uint32_t> ids(count);
  std::iota(ids.begin(), ids.end(), 0U);
  order_detail::Scratch scratch;
  order_detail::order_range(ids, places, scratch, threads_for(count, threads), 0);
  return ids;
}

// ---- the box tree, bottom up ------------------------------------------------------------------

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

}  // namespace deck
