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
  // The order of most large meshes, along their rows, is good enough.
  if (looks_ordered()) {
    pack(threads);
    if (serves_well()) return;
  }
  sort_by_place(
      items, [&](std::uint32_t i) { return Place{point(in.nodes, in.secondary[i])}; }, threads);
  pack(threads);
}

// Cheap test before the tree: neighbours in the list of nodes mostly no farther than a segment.
bool NodeSweep::looks_ordered() const {
  constexpr std::size_t worth_trying = 8192, samples = 64, width = PointBlock::width;
  if (items.size() < worth_trying || segments.empty()) return false;
  const auto median = [](std::size_t count, const auto& size_of) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < samples; ++i) {
      const double size = size_of(i * (count / samples));
      sizes.push_back(size >= 0.0 ? size : sweep::infinity);  // an order needs finite numbers
    }
    std::nth_element(sizes.begin(), sizes.begin() + samples / 2, sizes.end());
    return sizes[samples / 2];
  };
  const double apart = median(items.size() - width, [&](std::size_t first) {
    Box box;
    for (std::size_t k = 0; k < width; ++k) {
      const Point3<double> p = point(input->nodes, input->secondary[items[first + k]]);
      box.add({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
    }
    return box.size();
  });
  const double segment = median(segments.size(), [&](std::size_t i) {
    return reach_of_segment(*input, *options, robust_margin, segments[i]).size();
  });
  return apart <= 16.0 * segment;
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

// True if sample segments meet few boxes per point found. Decides speed only, not the result.
bool NodeSweep::serves_well() const {
  constexpr std::size_t samples = 64;
  constexpr std::size_t per_level = 3;  // plus one per point; a space-filling curve needs about 2
  constexpr std::size_t patience = 4096;
  const std::size_t stride = segments.size() / samples + 1;
  std::size_t tested = 0, allowed = 0;
  std::vector<std::pair<std::size_t, std::size_t>> stack;  // level, block
  for (std::size_t i = stride / 2; i < segments.size(); i += stride) {
    const Box b = reach_of_segment(*input, *options, robust_margin, segments[i]);
    const FloatBox rounded = tree.rounded(b);
    const auto near = [](const auto& box, std::size_t axis, auto low, auto high) {
      return low <= box.high[axis] && high >= box.low[axis];  // unused places do not overlap
    };
    allowed += per_level * tree.levels();
    stack.emplace_back(tree.levels() - 1, 0);
    while (!stack.empty()) {
      if (++tested > allowed + patience) return false;
      const auto [level, block] = stack.back();
      stack.pop_back();
      const BoxBlock& boxes = tree.level(level)[block];
      for (std::size_t c = 0; c < BoxBlock::width; ++c) {
        if (!near(rounded, 0, boxes.low[0][c], boxes.high[0][c]) ||
            !near(rounded, 1, boxes.low[1][c], boxes.high[1][c]) ||
            !near(rounded, 2, boxes.low[2][c], boxes.high[2][c]))
          continue;
        const std::size_t child = block * BoxBlock::width + c;
        if (level > 0) {
          stack.emplace_back(level - 1, child);
          continue;
        }
        ++tested;
        const PointBlock& leaf = points[child];
        const double r = reach[child];
        for (std::size_t k = 0; k < PointBlock::width; ++k) {
          if (near(b, 0, leaf.x[k] - r, leaf.x[k] + r) &&
              near(b, 1, leaf.y[k] - r, leaf.y[k] + r) && near(b, 2, leaf.z[k] - r, leaf.z[k] + r))
            ++allowed;
        }
      }
    }
  }
  return tested <= allowed;
}

std::size_t NodeSweep::bytes() const {
  return points.size() * sizeof(PointBlock) + reach.size() * sizeof(double) + tree.bytes() +
         (items.size() + nodes.size() + segments.size()) * sizeof(std::uint32_t);
}

BothForms find_both_forms(const NodeSegmentInput& in, const SearchOptions& options,
                          double robust_margin) {
  const NodeSweep w(in, options, effective_threads(options.threads), robust_margin);
  BothForms both;
  both.result.structure_bytes = w.bytes();
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

std::size_t EdgeSweep::bytes() const {
  return tree.bytes() + (items.size() + mains.size()) * sizeof(std::uint32_t);
}

BothForms find_both_forms(const EdgeEdgeInput& in, const SearchOptions& options,
                          double robust_margin) {
  const EdgeSweep w(in, options, effective_threads(options.threads), robust_margin);
  BothForms both;
  both.result.structure_bytes = w.bytes();
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
