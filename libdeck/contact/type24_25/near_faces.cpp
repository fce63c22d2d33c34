// Pair searches of TYPE24 and TYPE25: segments near each node, by distance or by boxes.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/shared/parallel.hpp"
#include "contact/search/sweep.hpp"
#include "contact/type24_25/type24_25.hpp"

namespace deck::detail::type24_25 {
namespace {

double largest_coordinate(const SceneContext& context) {
  const Coordinates& x = context.scene.coordinates;
  double out = 0;
  if (!context.all_placed) return out;
  for (const std::vector<double>* axis : {&x.x, &x.y, &x.z})
    for (const double v : *axis) out = std::max(out, std::fabs(v));
  return out;
}

/// Reach of the search beyond the gap of a pair: the solver's margin where its pairs are counted,
/// or matter beyond their gap. Else the nearest pair of a node that penetrates is within the
/// largest gap; an eighth of the margin is for thin segments, whose distance the formula
/// overstates.
double margin_beyond_gaps(const SceneContext& context, const Sides& sides,
                          const SearchLists& lists) {
  if (context.options.candidates || sides.solids || sides.set.ivis2 == -1) return sides.margin;
  const auto spread = [](const std::vector<double>& gaps) {
    const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
    return gaps.empty() ? 0 : *most - *least;
  };
  return std::min(sides.margin, spread(lists.node_gaps) + spread(lists.gaps) + sides.margin / 8);
}

/// Pairs of nodes of one surface and segments of the other. `on`, `searched`: scratch.
SearchResult from_surface(const Sides& sides, const SearchLists& lists, NodeSegmentInput in,
                          const SearchOptions& options, std::uint8_t from, std::uint8_t to,
                          std::vector<double>& on, std::vector<double>& searched) {
  on.resize(sides.nodes.size());
  searched.resize(sides.faces.size());
  for (std::size_t i = 0; i < on.size(); ++i) on[i] = (sides.nodes[i].bits & from) != 0 ? 1 : 0;
  for (std::size_t i = 0; i < searched.size(); ++i)
    searched[i] = (sides.faces[i].bits & to) == 0 ? 0 : lists.searched[i];
  in.secondary_stiffness = on;
  in.segment_stiffness = searched;
  return find_node_segment_pairs(in, options);
}

/// Sorts pairs from segment order to node order.
std::vector<CandidatePair> by_node(const std::vector<CandidatePair>& pairs, std::size_t nodes) {
  std::vector<std::size_t> next(nodes + 1, 0);
  for (const CandidatePair& p : pairs) ++next[p.secondary + 1];
  for (std::size_t i = 0; i < nodes; ++i) next[i + 1] += next[i];
  std::vector<CandidatePair> out(pairs.size());
  for (const CandidatePair& p : pairs) out[next[p.secondary]++] = p;
  return out;
}

deck::Box box_of_node(const NodeArrays& x, const SideNode& node) {
  return sweep::box_of_nodes(x, std::array{node.node}, node.gap);
}

/// Tree of nodes, each as a box of its gap.
class NodeTree {
 public:
  NodeTree(const NodeArrays& x, const Sides& sides, std::vector<std::uint32_t> some, int threads)
      : order_(std::move(some)) {
    const auto box_of = [&](std::uint32_t i) { return box_of_node(x, sides.nodes[i]); };
    sweep::put_in_order(order_, box_of, threads);
    const auto box_at = [&](std::size_t i) { return box_of(order_[i]); };
    tree_ = BoxTree(order_.size(), box_at, threads);
  }
  const BoxTree& tree() const { return tree_; }
  std::uint32_t node(std::uint32_t leaf) const { return order_[leaf]; }

 private:
  std::vector<std::uint32_t> order_;
  BoxTree tree_;
};

/// Pairs of nodes with `takes_node` and segments with `takes_face`.
template <class TakesNode, class TakesFace>
SearchResult in_boxes(const SceneContext& context, const Sides& sides,
                      const std::function<double(const Face&)>& margin, const TakesNode& takes_node,
                      const TakesFace& takes_face) {
  const Coordinates& c = context.scene.coordinates;
  const NodeArrays x{c.x, c.y, c.z};
  const int threads = effective_threads(context.options.threads);
  std::vector<std::uint32_t> nodes, faces;
  for (std::uint32_t i = 0; i < sides.nodes.size(); ++i)
    if (takes_node(sides.nodes[i])) nodes.push_back(i);
  for (std::uint32_t i = 0; i < sides.faces.size(); ++i)
    if (takes_face(sides.faces[i])) faces.push_back(i);
  const NodeTree tree(x, sides, std::move(nodes), threads);
  struct Piece {
    std::vector<deck::Box> boxes;
    std::vector<sweep::Meeting> near;
    std::vector<CandidatePair> found;
  };
  constexpr std::size_t at_once = 64;  // batch size: a box may contain everything
  // Sorting needs them twice.
  const std::size_t most = context.options.limits.pair_bytes / (2 * sizeof(CandidatePair));
  std::vector<CandidatePair> all;
  std::atomic<bool> full{false};
  run_in_order<Piece>(
      (faces.size() + at_once - 1) / at_once, threads,
      [&](std::size_t piece, Piece& p) {
        p.boxes.clear();
        p.near.clear();
        p.found.clear();
        if (full) return;
        const std::size_t first = piece * at_once;
        for (std::size_t i = first; i < std::min(faces.size(), first + at_once); ++i) {
          const Face& f = sides.faces[faces[i]];
          p.boxes.push_back(sweep::box_of_nodes(x, f.nodes, f.gap + margin(f)));
        }
        sweep::kernels().meetings(tree.tree(), p.boxes, p.near);
        for (const sweep::Meeting& m : p.near) {
          const std::uint32_t face = faces[first + m.box], node = tree.node(m.leaf);
          if (!box_of_node(x, sides.nodes[node]).overlaps(p.boxes[m.box])) continue;
          const Quad& corners = sides.faces[face].nodes;
          if (std::find(corners.begin(), corners.end(), sides.nodes[node].node) == corners.end())
            p.found.push_back({node, face});
        }
      },
      [&](std::size_t, const Piece& p) {
        full = full || all.size() + p.found.size() > most;
        if (!full) all.insert(all.end(), p.found.begin(), p.found.end());
      });
  SearchResult out;
  out.complete = !full;
  if (out.complete) out.pairs = by_node(all, sides.nodes.size());
  return out;
}

}  // namespace

SearchLists search_lists(const Sides& sides) {
  SearchLists out;
  out.nodes.reserve(sides.nodes.size());
  out.node_gaps.reserve(sides.nodes.size());
  for (const SideNode& n : sides.nodes) {
    out.nodes.push_back(n.node);
    out.node_gaps.push_back(n.gap);
  }
  out.segments.reserve(sides.faces.size());
  out.gaps.reserve(sides.faces.size());
  out.searched.reserve(sides.faces.size());
  for (const Face& f : sides.faces) {
    out.segments.push_back(f.nodes);
    out.gaps.push_back(f.gap);
    out.searched.push_back(f.stiffness != 0 || f.back_stiffness != 0 ? 1 : 0);
  }
  return out;
}

NodeSegmentInput input_of(const Coordinates& x, const SearchLists& lists) {
  NodeSegmentInput in;
  in.nodes = {x.x, x.y, x.z};
  in.secondary = lists.nodes;
  in.secondary_gap = lists.node_gaps;
  in.segments = lists.segments;
  in.segment_gap = lists.gaps;
  in.segment_stiffness = lists.searched;
  return in;
}

PairsByNode near_faces(const SceneContext& context, const Sides& sides, const SearchLists& lists) {
  const NodeSegmentInput in = input_of(context.scene.coordinates, lists);
  SearchOptions options;
  options.gap = PairGap::from_igap(1, 0);
  // Round-off of gaps, margin and distance must not lose a pair.
  options.margin = margin_beyond_gaps(context, sides, lists) * (1 + 1e-12) +
                   0x1p-44 * largest_coordinate(context);
  options.threads = context.options.threads;
  if (sides.set.level != 2) return {find_node_segment_pairs(in, options), {}};
  // A surface touches itself everywhere: a search among all would find many unwanted pairs.
  std::vector<double> on, searched;
  const auto find = [&](std::uint8_t from, std::uint8_t to) {
    return from_surface(sides, lists, in, options, from, to, on, searched);
  };
  PairsByNode out;
  out.one = find(from_first, from_second);
  out.two = find(from_second, from_first);
  return out;
}

PairsByNode nodes_in_boxes(const SceneContext& context, const Sides& sides,
                           const std::function<double(const Face&)>& margin) {
  const auto find = [&](std::uint8_t from, std::uint8_t to) {
    return in_boxes(
        context, sides, margin,
        [&](const SideNode& n) { return from == 0 || (n.bits & (from | from_group)) != 0; },
        [&](const Face& f) {
          return (to == 0 || (f.bits & to) != 0) && (f.stiffness != 0 || f.back_stiffness != 0);
        });
  };
  if (sides.set.level != 2) return {find(0, 0), {}};
  return {find(from_first, from_second), find(from_second, from_first)};
}

}  // namespace deck::detail::type24_25
