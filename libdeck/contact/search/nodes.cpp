// Pair search: finds all secondary nodes (edges) within their gap of main segments (edges).
// Input: NodeSegmentInput or EdgeEdgeInput. Output: sorted pairs, no pair within its gap missing.
// Secondary items are sorted along a Hilbert curve and put into a tree of boxes (box_tree.hpp;
// eight nodes per leaf). Main items are sorted likewise and walk the tree in groups of
// `items_at_once` (sweep.hpp, lanes.hpp); items of a leaf are tested by box, by slab and by
// distance, in vector registers. Threads take ranges of main items; run.cpp merges. Cost: n log n
// for sorting, then about log n plus the hits per main item. Results do not depend on threads or
// instruction set.
#include <algorithm>
#include <utility>

#include "base/shared/parallel.hpp"
#include "contact/search/box_tree.hpp"
#include "contact/search/sweep.hpp"

namespace deck {
namespace {

using sweep::at;

// Box of a segment, widened by its reach.
Box reach_of_segment(const NodeSegmentInput& in, const SearchOptions& options, double robust_margin,
                     std::uint32_t i) {
  return sweep::box_of_nodes(in.nodes, in.segments[i],
                             sweep::main_reach(options, robust_margin, at(in.segment_gap, i, 0.0)));
}

// Box of a node, widened by its reach.
Box reach_of_node(const NodeSegmentInput& in, const SearchOptions& options, std::uint32_t i) {
  const Point3<double> p = sweep::point(in.nodes, in.secondary[i]);
  const double own = sweep::secondary_reach(options, at(in.secondary_gap, i, 0.0));
  const double r = sweep::Reach::widened(own, 0.0);
  return {{p.x - r, p.y - r, p.z - r}, {p.x + r, p.y + r, p.z + r}};
}

}  // namespace

namespace sweep {

NodeSweep::NodeSweep(const NodeSegmentInput& in, const SearchOptions& o, int threads, double robust)
    : input(&in), options(&o), robust_margin(robust) {
  const auto segment_at = [&](std::uint32_t i) { return reach_of_segment(in, o, robust, i); };
  segments = active(in.segments.size(), in.segment_stiffness);
  items = active(in.secondary.size(), in.secondary_stiffness);
  drop_distant(
      items, [&](std::uint32_t i) { return reach_of_node(in, o, i); }, segments, segment_at,
      threads);
  put_in_order(segments, segment_at, threads);
  sort_by_place(
      items, [&](std::uint32_t i) { return Place{point(in.nodes, in.secondary[i])}; }, threads);
  pack(threads);
}

// Packs points and gaps in the order of `items` and builds the tree.
void NodeSweep::pack(int threads) {
  constexpr std::size_t width = PointBlock::width;
  const NodeSegmentInput& in = *input;
  const std::size_t leaf_count = (items.size() + width - 1) / width;
  points.resize(leaf_count);
  reach.resize(leaf_count);
  nodes.assign(leaf_count * width, no_node);
  const auto pack_leaf = [&](std::size_t i) {
    PointBlock& leaf = points[i];
    Box box;
    for (std::size_t rank = i * width; rank < std::min(items.size(), (i + 1) * width); ++rank) {
      const std::size_t k = rank % width;
      nodes[rank] = in.secondary[items[rank]];
      const Point3<double> p = point(in.nodes, nodes[rank]);
      leaf.x[k] = p.x;
      leaf.y[k] = p.y;
      leaf.z[k] = p.z;
      leaf.gap[k] = at(in.secondary_gap, items[rank], 0.0);
      const double own = secondary_reach(*options, leaf.gap[k]);
      reach[i] = k == 0 ? own : std::max(reach[i], own);
      box.add(reach_of_node(in, *options, items[rank]));
    }
    return box;
  };
  tree = BoxTree(leaf_count, pack_leaf, threads);
}

BothForms find_both_forms(const NodeSegmentInput& in, const SearchOptions& options,
                          double robust_margin) {
  const NodeSweep w(in, options, effective_threads(options.threads), robust_margin);
  BothForms both;
  run([&w](std::size_t begin, std::size_t end,
           Found& found) { kernels().nodes(w, begin, end, found); },
      w.segments.size(), in.secondary.size(), options, both);
  return both;
}

}  // namespace sweep

SearchResult find_node_segment_pairs(const NodeSegmentInput& in, const SearchOptions& options) {
  return sweep::find_both_forms(in, options, sweep::one_form).result;
}

// ---- edges against edges ----------------------------------------------------------------------

namespace sweep {

EdgeSweep::EdgeSweep(const EdgeEdgeInput& in, const SearchOptions& o, int threads, double robust)
    : input(&in), options(&o), robust_margin(robust) {
  const auto secondary_box = [&](std::uint32_t i) {
    return box_of_nodes(in.nodes, in.secondary[i],
                        secondary_reach(o, at(in.secondary_gap, i, 0.0)));
  };
  const auto main_box = [&](std::uint32_t i) {
    return box_of_nodes(in.nodes, in.main[i], main_reach(o, robust, at(in.main_gap, i, 0.0)));
  };
  items = active(in.secondary.size(), in.secondary_stiffness);
  mains = active(in.main.size(), in.main_stiffness);
  drop_distant(items, secondary_box, mains, main_box, threads);
  sort_in_space(items, secondary_box, threads);
  tree = BoxTree(
      items.size(), [&](std::size_t i) { return secondary_box(items[i]); }, threads);
  put_in_order(mains, main_box, threads);
}

BothForms find_both_forms(const EdgeEdgeInput& in, const SearchOptions& options,
                          double robust_margin) {
  const EdgeSweep w(in, options, effective_threads(options.threads), robust_margin);
  BothForms both;
  run([&w](std::size_t begin, std::size_t end,
           Found& found) { kernels().edges(w, begin, end, found); },
      w.mains.size(), in.secondary.size(), options, both);
  return both;
}

}  // namespace sweep

SearchResult find_edge_edge_pairs(const EdgeEdgeInput& in, const SearchOptions& options) {
  return sweep::find_both_forms(in, options, sweep::one_form).result;
}

}  // namespace deck
