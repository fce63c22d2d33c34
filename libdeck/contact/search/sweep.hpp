// Shared by the sweeps of the pair search: packed points, sinks, table of sweeps per instruction
// set; search margins of the solver.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "base/shared/parallel.hpp"
#include "contact/search/box_tree.hpp"
#include "deck/contacts.hpp"

namespace deck {

namespace detail {

/// Length of the edge a-b; squares of its components may overflow.
inline double edge_length(const NodeArrays& nodes, std::uint32_t a, std::uint32_t b) {
  const auto point = [&](std::uint32_t i) {
    return Point3<double>{nodes.x[i], nodes.y[i], nodes.z[i]};
  };
  return deck::length(point(b) - point(a));
}

/// Margin of the solver from the sum of the lengths of `count` edges.
inline double margin_of(double sum, std::size_t count) {
  constexpr double factor = static_cast<double>(0.2F);
  return factor * (sum / static_cast<double>(count));
}

}  // namespace detail

namespace sweep {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline double at(std::span<const double> values, std::size_t i, double otherwise) {
  return values.empty() ? otherwise : values[i];
}

// A leaf: eight secondary nodes, neighbours in space. Rank of a node: 8 * leaf + position in it.
struct alignas(64) PointBlock {
  static constexpr std::size_t width = BoxBlock::width;
  std::array<double, width> x{}, y{}, z{};
  std::array<double, width> gap{};
};

// Reach of tests beyond a segment or edge. Computed distances may be a few ulps of the coordinates
// too small; boxes are widened by much more, so box tests lose no pair that the distance formula
// accepts.
struct Reach {
  static constexpr double relative = 0x1p-40;
  static constexpr double of_coordinate = 0x1p-42;
  static constexpr double underflow = 0x1p-500;  // squares of shorter distances vanish
  static double widened(double reach, double largest_coordinate) {
    return reach + (std::abs(reach) * relative + largest_coordinate * of_coordinate + underflow);
  }
};

// Pairs found by one thread, in the order found. Grows by chunks without copying. All sinks of a
// search share an allowance; after it is used up they are full and drop further pairs.
class Sink {
 public:
  static constexpr std::size_t chunk_items = 16384;
  // No allowance: unlimited.
  explicit Sink(std::atomic<std::int64_t>* allowance = nullptr) : allowance_(allowance) {}
  void push(CandidatePair pair) { push_if(true, pair); }
  // Branch-free: the result of a distance comes late and is unpredictable; a wrong prediction would
  // discard the next distances in the pipeline.
  void push_if(bool wanted, CandidatePair pair) {
    if (fill_ == chunk_items) grow();
    last_[fill_] = pair;
    fill_ += wanted;
  }
  bool full() const { return full_; }
  std::size_t size() const {
    return chunks_.empty() ? 0 : (chunks_.size() - 1) * chunk_items + fill_;
  }
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      const std::size_t count = c + 1 == chunks_.size() ? fill_ : chunk_items;
      for (std::size_t i = 0; i < count; ++i) visit(chunks_[c][i]);
    }
  }

 private:
  [[gnu::noinline]] void grow() {
    fill_ = 0;
    if (allowance_ != nullptr && !chunks_.empty() &&
        allowance_->fetch_sub(static_cast<std::int64_t>(chunk_items)) <
            static_cast<std::int64_t>(chunk_items))
      full_ = true;
    if (full_) return;  // a full sink is not read
    chunks_.push_back(std::make_unique<CandidatePair[]>(chunk_items));
    last_ = chunks_.back().get();
  }
  std::atomic<std::int64_t>* allowance_;
  bool full_ = false;
  std::vector<std::unique_ptr<CandidatePair[]>> chunks_;
  CandidatePair* last_ = nullptr;
  std::size_t fill_ = chunk_items;
};

inline constexpr std::uint32_t no_node = std::numeric_limits<std::uint32_t>::max();

// Results of one thread.
struct Found {
  explicit Found(std::atomic<std::int64_t>* allowance = nullptr)
      : pairs(allowance), robust_only(allowance) {}
  bool full() const { return pairs.full() || robust_only.full(); }
  std::size_t size() const { return pairs.size() + robust_only.size(); }
  Sink pairs;
  Sink robust_only;        // pairs of the robust form with its margin that are not in `pairs`
  std::size_t tested = 0;  // number of computed distances
};

// Margin of a sweep in one form only.
inline constexpr double one_form = -1.0;

// Input of a sweep over the main side. Filled by nodes.cpp.
struct NodeSweep {
  const NodeSegmentInput* input = nullptr;
  const SearchOptions* options = nullptr;
  // If >= 0: also collects the pairs that only the robust form with this margin finds.
  double robust_margin = one_form;
  std::vector<std::uint32_t> segments;  // active segments in spatial order
  std::vector<PointBlock> points;
  std::vector<double> reach;         // per leaf: largest gap share of its nodes
  std::vector<std::uint32_t> items;  // per rank: position in the list of secondary nodes
  std::vector<std::uint32_t> nodes;  // per rank: node; the last leaf is filled up
  BoxTree tree;                      // leaves: widened boxes of the point blocks

  // Builds the tree over the secondary nodes and sorts the segments.
  NodeSweep(const NodeSegmentInput& in, const SearchOptions& o, int threads,
            double robust_margin = one_form);

 private:
  void pack(int threads);
};

struct EdgeSweep {
  const EdgeEdgeInput* input = nullptr;
  const SearchOptions* options = nullptr;
  double robust_margin = one_form;   // as in NodeSweep
  std::vector<std::uint32_t> mains;  // active main edges in spatial order
  std::vector<std::uint32_t> items;  // active secondary edges in spatial order
  BoxTree tree;                      // leaves: widened boxes of single secondary edges

  EdgeSweep(const EdgeEdgeInput& in, const SearchOptions& o, int threads,
            double robust_margin = one_form);
};

// Widening of secondary boxes. The main side has the other half of drad and the whole margin.
inline double secondary_reach(const SearchOptions& o, double gap) {
  return std::max(o.gap.share(gap), 0.5 * o.drad);
}
inline double main_reach(const SearchOptions& o, double robust_margin, double gap) {
  return std::max(o.gap.share(gap), 0.5 * o.drad) + std::max(o.margin, robust_margin);
}
// Limit of a pair without margin.
inline double pair_limit(const SearchOptions& o, double gap_s, double gap_m, double length_s,
                         double length_m) {
  return std::max(o.drad, o.gap(gap_s, gap_m, length_s, length_m));
}

// A box that overlaps a leaf of a tree, both rounded: position of the box, number of the leaf.
struct Meeting {
  std::uint32_t box = 0, leaf = 0;
};

// The corners of eight segments; unused ones are no_node.
struct CornerBlock {
  std::array<std::array<std::uint32_t, 8>, 4> node;
  CornerBlock() {
    for (auto& corner : node) corner.fill(no_node);
  }
  std::array<std::uint32_t, 4> of(std::size_t i) const {
    return {node[0][i], node[1][i], node[2][i], node[3][i]};
  }
};
using EdgeNodes = std::array<std::uint32_t, 2>;

// Approximate distance of a node from a segment: within `slack` of any plain formula; `slack` is
// infinite if sub-triangles are too thin.
struct NearDistance {
  double distance = 0.0, slack = infinity;
  std::uint8_t nearest = 0xf;  // bit mask of sub-triangles that are nearest, within a hundredth
  std::int8_t side = 0;        // 1: the node is in front of all these, -1: behind, 0: unknown
};

// Sweeps over positions [begin, end) of the main side, one version per instruction set. All give
// equal pairs and bit-equal distances.
struct Kernels {
  void (*nodes)(const NodeSweep&, std::size_t begin, std::size_t end, Found&);
  void (*edges)(const EdgeSweep&, std::size_t begin, std::size_t end, Found&);
  // For pairs already found, from the lists of the input.
  void (*distances)(const NodeSegmentInput&, std::span<const CandidatePair>, NearDistance*);
  // Adds all meetings of the boxes, box after box.
  void (*meetings)(const BoxTree&, std::span<const Box>, std::vector<Meeting>&);
  // meetings for boxes of edges, without segments that share a node with the edge.
  void (*meetings_apart)(const BoxTree&, std::span<const CornerBlock>, std::span<const Box>,
                         std::span<const EdgeNodes>, std::vector<Meeting>&);
  const char* name;
};
// Fastest versions for this processor.
const Kernels& kernels();
// All versions for this processor, slowest first; for tests.
std::span<const Kernels> all_kernels();

inline Point3<double> point(const NodeArrays& nodes, std::uint32_t i) {
  return {nodes.x[i], nodes.y[i], nodes.z[i]};
}

inline constexpr std::size_t items_at_once = 8;  // main items that share a walk

// A group walks as one only if its box is not much larger than its members': one giant or stray
// item would cause far too many tests.
inline bool worth_sharing(double group_size, double sum_of_sizes) {
  return group_size <= 0.75 * sum_of_sizes;
}

// True if a list of main items is in good spatial order, so that neighbours can share walks and
// memory. Tests samples; decides speed only. A mesh numbered along its rows is in order except
// where rows end: some of the groups and, with short rows, many of the windows.
template <class BoxOf>
bool is_coherent(std::span<const std::uint32_t> ids, const BoxOf& box_of) {
  constexpr std::size_t window_items = 64, stride = 16 * window_items;
  std::size_t windows = 0, good_windows = 0, groups = 0, good_groups = 0;
  for (std::size_t first = 0; first + window_items <= ids.size(); first += stride) {
    Box window;
    double window_sum = 0.0;
    for (std::size_t g = 0; g < window_items; g += items_at_once) {
      Box group;
      double group_sum = 0.0;
      for (std::size_t i = 0; i < items_at_once; ++i) {
        const Box b = box_of(ids[first + g + i]);
        group.add(b);
        group_sum += b.size();
      }
      ++groups;
      good_groups += worth_sharing(group.size(), group_sum);
      window.add(group);
      window_sum += group_sum;
    }
    ++windows;
    good_windows += window.size() <= window_sum;
  }
  return good_groups * 10 >= groups * 9 && good_windows * 2 >= windows;
}

// Positions of the items with stiffness != 0.
inline std::vector<std::uint32_t> active(std::size_t count, std::span<const double> stiffness) {
  std::vector<std::uint32_t> ids;
  if (stiffness.empty()) {
    ids.resize(count);
    std::iota(ids.begin(), ids.end(), 0U);
    return ids;
  }
  ids.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (stiffness[i] != 0.0) ids.push_back(static_cast<std::uint32_t>(i));
  }
  return ids;
}

// Bounds of all boxes of a list.
template <class BoxOf>
Box bounds_of(const std::vector<std::uint32_t>& ids, const BoxOf& box_of, int threads) {
  std::vector<Box> parts(pieces_of(threads, ids.size()));
  parallel_pieces(threads, ids.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    Box all;
    for (std::size_t i = begin; i < end; ++i) all.add(box_of(ids[i]));
    parts[part] = all;
  });
  Box all;
  for (const Box& part : parts) all.add(part);
  return all;
}

// Keeps the items that overlap `box`, in order; returns their bounds.
template <class BoxOf>
Box keep_inside(std::vector<std::uint32_t>& ids, const BoxOf& box_of, const Box& box, int threads) {
  struct Kept {
    std::size_t begin = 0, end = 0;
    Box bounds;
  };
  std::vector<Kept> parts(pieces_of(threads, ids.size()));
  parallel_pieces(threads, ids.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    Kept mine{begin, begin, {}};
    for (std::size_t i = begin; i < end; ++i) {
      const Box own = box_of(ids[i]);
      if (!own.overlaps(box)) continue;
      mine.bounds.add(own);
      ids[mine.end++] = ids[i];
    }
    parts[part] = mine;
  });
  std::size_t kept = 0;
  Box all;
  for (const Kept& part : parts) {
    all.add(part.bounds);
    if (part.begin != kept)
      std::copy(ids.begin() + static_cast<std::ptrdiff_t>(part.begin),
                ids.begin() + static_cast<std::ptrdiff_t>(part.end),
                ids.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += part.end - part.begin;
  }
  ids.resize(kept);
  return all;
}

// Drops from both lists the items beyond the bounds of the other list: most of a surface that
// others touch at one end only. Boxes include the reach.
template <class BoxOf, class OtherBoxOf>
void drop_distant(std::vector<std::uint32_t>& ids, const BoxOf& box_of,
                  std::vector<std::uint32_t>& others, const OtherBoxOf& other_box_of, int threads) {
  Box round_ids = bounds_of(ids, box_of, threads);
  std::size_t before = 0;
  do {
    before = ids.size();
    const Box round_others = keep_inside(others, other_box_of, round_ids, threads);
    round_ids = keep_inside(ids, box_of, round_others, threads);
  } while (ids.size() < before / 2);  // another round would gain little
}

// Items whose sizes differ by more than a factor of about eight go to different leaves and groups.
// The class repeats every 8^8, which is harmless.
inline unsigned size_class(double size) {
  return static_cast<unsigned>(((std::bit_cast<std::uint64_t>(size) >> 52) & 0x7ffU) / 3) & 7U;
}

// By value: std::min and std::max keep their arguments in memory.
inline double smaller_of(double a, double b) { return b < a ? b : a; }
inline double larger_of(double a, double b) { return a < b ? b : a; }

// Box of one, two or four nodes, widened by `reach`.
template <std::size_t N>
Box box_of_nodes(const NodeArrays& nodes, const std::array<std::uint32_t, N>& of, double reach) {
  struct Range {
    double low, high;
    double farthest() const { return larger_of(-low, high); }
  };
  const auto range = [&of](const double* v) -> Range {
    const double a = v[of[0]], b = v[of[N > 1 ? 1 : 0]];
    Range r{smaller_of(a, b), larger_of(a, b)};
    if constexpr (N == 4) {
      const double c = v[of[2]], d = v[of[3]];
      r = {smaller_of(r.low, smaller_of(c, d)), larger_of(r.high, larger_of(c, d))};
    }
    return r;
  };
  const Range x = range(nodes.x.data()), y = range(nodes.y.data()), z = range(nodes.z.data());
  const double largest =
      larger_of(larger_of(0.0, x.farthest()), larger_of(y.farthest(), z.farthest()));
  const double r = Reach::widened(reach, largest);
  return {{x.low - r, y.low - r, z.low - r}, {x.high + r, y.high + r, z.high + r}};
}

// Sorts items in space by their centres; place_of(id) per item.
template <class PlaceOf>
void sort_by_place(std::vector<std::uint32_t>& ids, const PlaceOf& place_of, int threads) {
  std::vector<std::uint32_t> order = order_by_place(
      ids.size(), [&](std::uint32_t i) { return place_of(ids[i]); }, threads);
  for (std::uint32_t& i : order) i = ids[i];
  ids.swap(order);
}

// Sorts items in space by centre and size of their boxes.
template <class BoxOf>
void sort_in_space(std::vector<std::uint32_t>& ids, const BoxOf& box_of, int threads) {
  sort_by_place(
      ids,
      [&](std::uint32_t id) {
        const Box b = box_of(id);
        return Place{{0.5 * b.low[0] + 0.5 * b.high[0], 0.5 * b.low[1] + 0.5 * b.high[1],
                      0.5 * b.low[2] + 0.5 * b.high[2]},
                     size_class(b.size())};
      },
      threads);
}

// sort_in_space, unless they are in good order.
template <class BoxOf>
void put_in_order(std::vector<std::uint32_t>& ids, const BoxOf& box_of, int threads) {
  if (!is_coherent(ids, box_of)) sort_in_space(ids, box_of, threads);
}

// Pairs of both forms, sorted by secondary and main. `complete` refers to their sum.
struct BothForms {
  SearchResult result;
  std::vector<CandidatePair> robust_only;
};

// Runs `body(begin, end, found)` over `count` main items on several threads; pairs go to `both`.
// `secondaries`: length of the secondary list.
void run(const std::function<void(std::size_t, std::size_t, Found&)>& body, std::size_t count,
         std::size_t secondaries, const SearchOptions& options, BothForms& both);

// Pairs of find_node_segment_pairs or find_edge_edge_pairs, and the further pairs of the robust
// form with margin `robust_margin`, in one sweep.
BothForms find_both_forms(const NodeSegmentInput& input, const SearchOptions& options,
                          double robust_margin);
BothForms find_both_forms(const EdgeEdgeInput& input, const SearchOptions& options,
                          double robust_margin);

}  // namespace sweep
}  // namespace deck
