// Node-segment search: packs the secondary nodes into a tree and sweeps the segments over it.
#include <algorithm>
#include <utility>

#include "contact/box_order.hpp"
#include "contact/search_parallel.hpp"
#include "contact/search_sweep.hpp"

namespace deck {
namespace {

using sweep::at;

// Leaves of eight nodes each and the tree of their boxes.
void pack_points(std::span<const std::uint32_t> order, int threads, sweep::NodeSweep& w) {
  using sweep::PointBlock;
  const NodeSegmentInput& in = *w.input;
  constexpr std::size_t kWidth = PointBlock::kWidth;
  w.points.resize((order.size() + kWidth - 1) / kWidth);
  std::vector<BoxBlock> leaves((w.points.size() + kWidth - 1) / kWidth);
  parallel_parts(threads, leaves.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    const std::size_t last = std::min(w.points.size(), end * kWidth);
    for (std::size_t block = begin * kWidth; block < last; ++block) {
      PointBlock& leaf = w.points[block];
      Box box;
      const std::size_t count = std::min(kWidth, order.size() - block * kWidth);
      for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t item = order[block * kWidth + k];
        const Point3<double> p = sweep::point(in.nodes, in.secondary[item]);
        leaf.x[k] = p.x;
        leaf.y[k] = p.y;
        leaf.z[k] = p.z;
        leaf.item[k] = item;
        const double reach = sweep::secondary_reach(*w.options, at(in.secondary_gap, item, 0.0));
        leaf.reach = k == 0 ? reach : std::max(leaf.reach, reach);
        const double r = sweep::Reach::widened(reach, 0.0);
        box.add({{p.x - r, p.y - r, p.z - r}, {p.x + r, p.y + r, p.z + r}});
      }
      leaf.used = (1U << count) - 1U;
      leaves[block / kWidth].set(block % kWidth, box);
    }
  });
  w.tree = BoxTree(std::move(leaves), threads);
}

// Where a segment is, from its diagonals.
Place segment_place(const NodeSegmentInput& in, const SearchOptions& options, std::uint32_t i) {
  const auto& s = in.segments[i];
  const Point3<double> a = sweep::point(in.nodes, s[0]), b = sweep::point(in.nodes, s[1]);
  const Point3<double> c = sweep::point(in.nodes, s[2]), d = sweep::point(in.nodes, s[3]);
  const auto span = [](double u, double v, double s_, double t) {
    return std::max(std::max(u, v), std::max(s_, t)) - std::min(std::min(u, v), std::min(s_, t));
  };
  const double size = std::max(span(a.x, b.x, c.x, d.x),
                               std::max(span(a.y, b.y, c.y, d.y), span(a.z, b.z, c.z, d.z)));
  const double reach = sweep::main_reach(options, at(in.segment_gap, i, 0.0));
  return {0.5 * a + 0.5 * c, sweep::size_class(size + reach)};
}

}  // namespace

SearchResult find_node_segment_pairs(const NodeSegmentInput& in, const SearchOptions& options) {
  const int threads = effective_threads(options.threads);
  SearchResult result;
  sweep::NodeSweep w;
  w.input = &in;
  w.options = &options;
  {
    std::vector<std::uint32_t> order = sweep::active(in.secondary.size(), in.secondary_stiffness);
    order_in_space(
        std::span(order),
        [&in](std::uint32_t i) {
          return Place{sweep::point(in.nodes, in.secondary[i]), 0};
        },
        threads);
    pack_points(order, threads, w);
  }
  w.segments = sweep::active(in.segments.size(), in.segment_stiffness);
  order_in_space(
      std::span(w.segments),
      [&in, &options](std::uint32_t i) { return segment_place(in, options, i); }, threads);
  result.structure_bytes = w.points.size() * sizeof(sweep::PointBlock) + w.tree.bytes() +
                           w.segments.size() * sizeof(std::uint32_t);
  sweep::run([&w](std::size_t begin, std::size_t end,
                  sweep::Sink& sink) { sweep::kernels().nodes(w, begin, end, sink); },
             w.segments.size(), in.secondary.size(), options, result);
  return result;
}

}  // namespace deck
