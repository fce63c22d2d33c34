// What the sweeps of the pair search share: the packed points, the shape of one segment, the
// sinks, and the table of sweeps by instruction set.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "contact/box_tree.hpp"
#include "deck/contact/search.hpp"

namespace deck::sweep {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline double at(std::span<const double> values, std::size_t i, double otherwise) {
  return values.empty() ? otherwise : values[i];
}

// Eight secondary nodes, neighbours in space: a leaf of the tree.
struct alignas(64) PointBlock {
  static constexpr std::size_t kWidth = BoxBlock::kWidth;
  std::array<double, kWidth> x{}, y{}, z{};
  std::array<std::uint32_t, kWidth> item{};  // position in the list of secondary nodes
  double reach = 0.0;                        // largest share of the gap among them
  unsigned used = 0;                         // bit mask of the places in use
};

// How far beyond a segment or edge its tests reach. Computed distances may be smaller than exact
// ones by a few units in the last place of the coordinates; boxes are widened by much more than
// that, so that no pair the distance formula accepts is lost to a box test.
struct Reach {
  static constexpr double kRelative = 0x1p-40;
  static constexpr double kOfCoordinate = 0x1p-42;
  static constexpr double kUnderflow = 0x1p-500;  // squares of shorter distances vanish
  static double widened(double reach, double largest_coordinate) {
    return reach + (std::abs(reach) * kRelative + largest_coordinate * kOfCoordinate + kUnderflow);
  }
};

// Pairs found by one thread, in the order found.
struct Sink {
  std::vector<CandidatePair> pairs;
  std::size_t tested = 0;
};

// Everything a sweep over the main side reads. Filled by search_nodes.cpp and search_edges.cpp.
struct NodeSweep {
  const NodeSegmentInput* input = nullptr;
  const SearchOptions* options = nullptr;
  std::vector<std::uint32_t> segments;  // active ones in spatial order
  std::vector<PointBlock> points;
  BoxTree tree;  // leaves: boxes of the point blocks, widened by their reach
};
struct EdgeSweep {
  const EdgeEdgeInput* input = nullptr;
  const SearchOptions* options = nullptr;
  std::vector<std::uint32_t> mains;  // active main edges in spatial order
  std::vector<std::uint32_t> items;  // active secondary edges in spatial order
  BoxTree tree;                      // leaves: boxes of single secondary edges, widened
};

// The gap of a side's share that its own boxes are widened by; the other half of drad and the
// whole margin belong to the main side.
inline double secondary_reach(const SearchOptions& o, double gap) {
  return std::max(o.gap.share(gap), 0.5 * o.drad);
}
inline double main_reach(const SearchOptions& o, double gap) {
  return std::max(o.gap.share(gap), 0.5 * o.drad) + o.margin;
}
inline double pair_limit(const SearchOptions& o, double gap_s, double gap_m, double length_s,
                         double length_m) {
  return std::max(o.drad, o.gap(gap_s, gap_m, length_s, length_m)) + o.margin;
}

inline bool edges_are_near(const SearchOptions& o, const Point3<double>& s1,
                           const Point3<double>& s2, const Point3<double>& m1,
                           const Point3<double>& m2, double limit) {
  if (!(limit > 0.0)) return false;
  if (o.form == Form::robust) {
    return closest_between_edges<Form::robust>(s1, s2, m1, m2).distance < limit;
  }
  return closest_between_edges<Form::reference>(s1, s2, m1, m2).distance_squared < limit * limit;
}

// Sweeps over positions [begin, end) of the main side. One version per instruction set; all give
// the same pairs, bit for bit the same distances.
struct Kernels {
  void (*nodes)(const NodeSweep&, std::size_t begin, std::size_t end, Sink&);
  void (*edges)(const EdgeSweep&, std::size_t begin, std::size_t end, Sink&);
  const char* name;
};
// The fastest versions this processor runs.
const Kernels& kernels();
// Every version this processor runs, slowest first; for tests.
std::span<const Kernels> all_kernels();

inline Point3<double> point(const NodeArrays& nodes, std::uint32_t i) {
  return {nodes.x[i], nodes.y[i], nodes.z[i]};
}

inline constexpr std::size_t kGroup = 8;  // main items that share one walk through the tree

// Positions of everything whose stiffness is not 0.
inline std::vector<std::uint32_t> active(std::size_t count, std::span<const double> stiffness) {
  std::vector<std::uint32_t> ids;
  ids.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (stiffness.empty() || stiffness[i] != 0.0) ids.push_back(static_cast<std::uint32_t>(i));
  }
  return ids;
}

// Things whose sizes differ by more than a factor of eight or so are kept in different leaves and
// groups. The class repeats every 8^8, which does no harm.
inline unsigned size_class(double size) {
  return static_cast<unsigned>(((std::bit_cast<std::uint64_t>(size) >> 52) & 0x7ffU) / 3) & 7U;
}

// Box of an edge, widened by `reach`.
inline Box edge_box(const NodeArrays& nodes, const std::array<std::uint32_t, 2>& edge,
                    double reach) {
  const Point3<double> a = point(nodes, edge[0]), b = point(nodes, edge[1]);
  Box box;
  box.low = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  box.high = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    largest = std::max(largest, std::max(-box.low[k], box.high[k]));
  }
  const double r = Reach::widened(reach, largest);
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= r;
    box.high[k] += r;
  }
  return box;
}

// Runs `body(begin, end, sink)` over `count` main items on several threads and leaves the pairs,
// sorted by secondary and main, in `result`. `secondaries` is the length of the secondary list.
void run(const std::function<void(std::size_t, std::size_t, Sink&)>& body, std::size_t count,
         std::size_t secondaries, const SearchOptions& options, SearchResult& result);

}  // namespace deck::sweep
