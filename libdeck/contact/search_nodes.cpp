// Node-segment search: packs the secondary nodes into a tree and sweeps the segments over it.
#include <algorithm>
#include <utility>

#include "contact/box_order.hpp"
#include "contact/search_parallel.hpp"
#include "contact/search_sweep.hpp"

namespace deck {
namespace {

using sweep::at;

// Box of a segment, widened by its own reach; only for judging order and size.
Box segment_box(const NodeSegmentInput& in, const SearchOptions& options, std::uint32_t i) {
  const double reach = sweep::main_reach(options, at(in.segment_gap, i, 0.0));
  Box box;
  for (const std::uint32_t node : in.segments[i]) {
    const Point3<double> p = sweep::point(in.nodes, node);
    box.add({{p.x - reach, p.y - reach, p.z - reach}, {p.x + reach, p.y + reach, p.z + reach}});
  }
  return box;
}

}  // namespace

namespace sweep {

NodeSweep::NodeSweep(const NodeSegmentInput& in, const SearchOptions& o, int threads)
    : input(&in), options(&o) {
  constexpr std::size_t kWidth = PointBlock::kWidth;
  const std::vector<std::uint32_t> chosen = active(in.secondary.size(), in.secondary_stiffness);
  items = order_by_place(
      chosen.size(),
      [&](std::uint32_t i) { return Place{point(in.nodes, in.secondary[chosen[i]])}; }, threads);
  const std::size_t leaf_count = (items.size() + kWidth - 1) / kWidth;
  points.resize(leaf_count);
  reach.resize(leaf_count);
  nodes.resize(items.size());
  std::vector<BoxBlock> blocks((leaf_count + kWidth - 1) / kWidth);
  parallel_parts(threads, blocks.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    const std::size_t last = std::min(leaf_count, end * kWidth);
    for (std::size_t i = begin * kWidth; i < last; ++i) {
      PointBlock& leaf = points[i];
      Box box;
      for (std::size_t rank = i * kWidth; rank < std::min(items.size(), (i + 1) * kWidth); ++rank) {
        const std::size_t k = rank % kWidth;
        const std::uint32_t item = items[rank] = chosen[items[rank]];
        nodes[rank] = in.secondary[item];
        const Point3<double> p = point(in.nodes, nodes[rank]);
        leaf.x[k] = p.x;
        leaf.y[k] = p.y;
        leaf.z[k] = p.z;
        leaf.gap[k] = at(in.secondary_gap, item, 0.0);
        const double own = secondary_reach(o, leaf.gap[k]);
        reach[i] = k == 0 ? own : std::max(reach[i], own);
        const double r = Reach::widened(own, 0.0);
        box.add({{p.x - r, p.y - r, p.z - r}, {p.x + r, p.y + r, p.z + r}});
      }
      blocks[i / kWidth].set(i % kWidth, box);
    }
  });
  tree = BoxTree(std::move(blocks), threads);

  segments = active(in.segments.size(), in.segment_stiffness);
  const auto box_of = [&](std::uint32_t i) { return segment_box(in, o, i); };
  put_in_order(segments, box_of, threads);
}

std::size_t NodeSweep::bytes() const {
  return points.size() * sizeof(PointBlock) + reach.size() * sizeof(double) + tree.bytes() +
         (items.size() + nodes.size() + segments.size()) * sizeof(std::uint32_t);
}

}  // namespace sweep

SearchResult find_node_segment_pairs(const NodeSegmentInput& in, const SearchOptions& options) {
  const sweep::NodeSweep w(in, options, effective_threads(options.threads));
  SearchResult result;
  result.structure_bytes = w.bytes();
  sweep::run([&w](std::size_t begin, std::size_t end,
                  sweep::Sink& sink) { sweep::kernels().nodes(w, begin, end, sink); },
             w.segments.size(), in.secondary.size(), options, result);
  return result;
}

}  // namespace deck
