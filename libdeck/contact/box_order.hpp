// Orders things in space along a Hilbert curve, so that neighbours in the list are neighbours in
// space. Works for any grading: crowded cells of the curve are ordered again on a finer grid.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "contact/search_parallel.hpp"
#include "deck/contact/closest.hpp"

namespace deck {

// Where a thing is, and its size class (0..7): things of different class are never mixed.
struct Place {
  Point3<double> centre;
  unsigned size_class = 0;
};

namespace order_detail {

// Position of a cell along a three-dimensional Hilbert curve of 2^bits cells per axis.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z, unsigned bits);

// Sorts by the bits [low, high) only; stable. `spare` has the size of `keys`.
void radix_sort(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& spare, unsigned low,
                unsigned high, int threads);

// A cubic grid round a set of points. Coordinates are quartered so that no difference overflows.
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

struct Scratch {
  std::vector<std::uint64_t> keys, spare;
  std::vector<std::uint32_t> ids;
};

template <class PlaceOf>
void order_range(std::span<std::uint32_t> ids, const PlaceOf& place_of, Scratch& scratch,
                 int threads, int depth) {
  constexpr std::size_t kSmall = 32;  // runs below this length are left as they are
  constexpr int kDeepest = 64;        // beyond it only coincident points are left
  constexpr unsigned kClassBits = 3;
  const std::size_t n = ids.size();
  if (n < 2 || depth > kDeepest) return;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  struct Bounds {
    Point3<double> low{kInf, kInf, kInf}, high{-kInf, -kInf, -kInf};
    void add(const Point3<double>& p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  };
  std::vector<Bounds> parts(static_cast<std::size_t>(threads));
  parallel_parts(threads, n, [&](std::size_t part, std::size_t begin, std::size_t end) {
    Bounds bounds;
    for (std::size_t i = begin; i < end; ++i) bounds.add(place_of(ids[i]).centre);
    parts[part] = bounds;
  });
  Bounds all;
  for (const Bounds& b : parts) {
    all.add(b.low);
    all.add(b.high);
  }
  const auto id_bits = static_cast<unsigned>(std::bit_width(n - 1));
  const unsigned wanted = std::max(4U, id_bits / 2 + 2);
  const unsigned bits = std::min(wanted, (64 - kClassBits - id_bits) / 3);
  const CurveGrid grid(all.low, all.high, bits);
  if (!grid.usable() && depth > 0) return;
  scratch.keys.resize(n);
  parallel_parts(threads, n, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Place place = place_of(ids[i]);
      const std::uint64_t curve = grid.usable() ? grid.index(place.centre) : 0;
      const std::uint64_t key = (std::uint64_t{place.size_class} << (3 * bits)) | curve;
      scratch.keys[i] = (key << id_bits) | i;
    }
  });
  radix_sort(scratch.keys, scratch.spare, id_bits, id_bits + 3 * bits + kClassBits, threads);
  scratch.ids.assign(ids.begin(), ids.end());
  const std::uint64_t mask = (std::uint64_t{1} << id_bits) - 1;
  for (std::size_t i = 0; i < n; ++i) ids[i] = scratch.ids[scratch.keys[i] & mask];
  // Crowded cells: remember the runs first, since the recursion reuses the scratch arrays.
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  for (std::size_t i = 0; i < n;) {
    std::size_t j = i + 1;
    while (j < n && (scratch.keys[j] >> id_bits) == (scratch.keys[i] >> id_bits)) ++j;
    if (j - i > kSmall) runs.emplace_back(i, j - i);
    i = j;
  }
  if (!grid.usable()) return;
  for (const auto& [first, count] : runs) {
    order_range(ids.subspan(first, count), place_of, scratch, threads, depth + 1);
  }
}

}  // namespace order_detail

// Reorders `ids` along the curve; place_of(id) gives the Place of one. The result depends only on
// the places and on the order of `ids` at entry.
template <class PlaceOf>
void order_in_space(std::span<std::uint32_t> ids, const PlaceOf& place_of, int threads) {
  order_detail::Scratch scratch;
  order_detail::order_range(ids, place_of, scratch, threads, 0);
}

}  // namespace deck
