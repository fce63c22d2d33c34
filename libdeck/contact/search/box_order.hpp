// Orders things in space along a Hilbert curve, so that neighbours in the list are neighbours in
// space. Works for any grading: crowded cells of the curve are ordered again on a finer grid.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/shared/parallel.hpp"
#include "deck/point3.hpp"

namespace deck {

// Threads for a loop that does little for each of `count` things. A thread takes as long to start
// as some thousand of them, and to wait for it where other programs have the processors much
// longer.
inline int threads_for(std::size_t count, int threads) { return count < 32768 ? 1 : threads; }

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

}  // namespace order_detail

// Writes the places of the things `ids` to `out`. Called more than once for a thing, so that the
// places of all of them never need memory at the same time.
using PlacesOf = std::function<void(std::span<const std::uint32_t> ids, Place* out)>;

// Positions 0 ... count-1 along the curve. The result depends only on the places.
std::vector<std::uint32_t> order_in_space(std::size_t count, const PlacesOf& places, int threads);

// The same for a function that gives the place of one thing.
template <class PlaceOf>
std::vector<std::uint32_t> order_by_place(std::size_t count, const PlaceOf& place_of, int threads) {
  const PlacesOf places = [&place_of](std::span<const std::uint32_t> ids, Place* out) {
    for (const std::uint32_t i : ids) *out++ = place_of(i);
  };
  return order_in_space(count, places, threads);
}

}  // namespace deck
