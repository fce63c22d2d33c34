// Edge-edge search: a tree over the secondary edges, swept by the main edges.
#include <algorithm>
#include <utility>

#include "contact/box_order.hpp"
#include "contact/search_parallel.hpp"
#include "contact/search_sweep.hpp"

namespace deck {
namespace {

using sweep::at;
using Edge = std::array<std::uint32_t, 2>;

Place edge_place(const NodeArrays& nodes, const Edge& edge, double reach) {
  const Point3<double> a = sweep::point(nodes, edge[0]), b = sweep::point(nodes, edge[1]);
  const Point3<double> d = b - a;
  const double size = std::max(std::abs(d.x), std::max(std::abs(d.y), std::abs(d.z)));
  return {0.5 * a + 0.5 * b, sweep::size_class(size + reach)};
}

}  // namespace

SearchResult find_edge_edge_pairs(const EdgeEdgeInput& in, const SearchOptions& options) {
  const int threads = effective_threads(options.threads);
  SearchResult result;
  sweep::EdgeSweep w;
  w.input = &in;
  w.options = &options;
  const auto secondary_reach = [&in, &options](std::uint32_t i) {
    return sweep::secondary_reach(options, at(in.secondary_gap, i, 0.0));
  };
  w.items = sweep::active(in.secondary.size(), in.secondary_stiffness);
  order_in_space(
      std::span(w.items),
      [&](std::uint32_t i) { return edge_place(in.nodes, in.secondary[i], secondary_reach(i)); },
      threads);
  constexpr std::size_t kWidth = BoxBlock::kWidth;
  std::vector<BoxBlock> leaves((w.items.size() + kWidth - 1) / kWidth);
  parallel_parts(threads, leaves.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    const std::size_t last = std::min(w.items.size(), end * kWidth);
    for (std::size_t k = begin * kWidth; k < last; ++k) {
      const std::uint32_t item = w.items[k];
      leaves[k / kWidth].set(k % kWidth,
                             sweep::edge_box(in.nodes, in.secondary[item], secondary_reach(item)));
    }
  });
  w.tree = BoxTree(std::move(leaves), threads);

  w.mains = sweep::active(in.main.size(), in.main_stiffness);
  order_in_space(
      std::span(w.mains),
      [&](std::uint32_t i) {
        return edge_place(in.nodes, in.main[i],
                          sweep::main_reach(options, at(in.main_gap, i, 0.0)));
      },
      threads);
  result.structure_bytes =
      w.tree.bytes() + (w.items.size() + w.mains.size()) * sizeof(std::uint32_t);
  sweep::run([&w](std::size_t begin, std::size_t end,
                  sweep::Sink& sink) { sweep::kernels().edges(w, begin, end, sink); },
             w.mains.size(), in.secondary.size(), options, result);
  return result;
}

}  // namespace deck
