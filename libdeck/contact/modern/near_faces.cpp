// The search that TYPE24 and TYPE25 share: from nodes and segments with their gaps to pairs.
#include <vector>

#include "base/shared/pages.hpp"
#include "base/shared/parallel.hpp"
#include "contact/modern/parts.hpp"

namespace deck::detail::modern {
namespace {

/// Whether a node that comes from `node` is looked at where those of the surface `side` are.
bool belongs(std::uint8_t node, std::uint8_t side, bool group_meets_all) {
  return (node & side) != 0 || (group_meets_all && (node & from_group) != 0);
}

/// Pairs of nodes of one surface and segments of the other. `on`, `searched`: room for who takes
/// part.
SearchResult from_surface(const Sides& sides, const SearchLists& lists, NodeSegmentInput in,
                          const SearchOptions& options, std::uint8_t from, std::uint8_t to,
                          bool group_meets_all, std::vector<double>& on,
                          std::vector<double>& searched) {
  on.resize(sides.nodes.size());
  searched.resize(sides.faces.size());
  for (std::size_t i = 0; i < on.size(); ++i)
    on[i] = belongs(sides.nodes[i].bits, from, group_meets_all) ? 1 : 0;
  for (std::size_t i = 0; i < searched.size(); ++i)
    searched[i] = (sides.faces[i].bits & to) == 0 ? 0 : lists.searched[i];
  in.secondary_stiffness = on;
  in.segment_stiffness = searched;
  return find_node_segment_pairs(in, options);
}

}  // namespace

SearchLists search_lists(const Sides& sides, int threads) {
  SearchLists out;
  make_room(out.nodes, sides.nodes.size(), threads);
  make_room(out.node_gaps, sides.nodes.size(), threads);
  for (const SideNode& n : sides.nodes) {
    out.nodes.push_back(n.node);
    out.node_gaps.push_back(n.gap);
  }
  make_room(out.segments, sides.faces.size(), threads);
  make_room(out.gaps, sides.faces.size(), threads);
  make_room(out.searched, sides.faces.size(), threads);
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

PairsByNode near_faces(const SceneContext& context, const Sides& sides, const SearchLists& lists,
                       bool group_meets_all) {
  const NodeSegmentInput in = input_of(context.scene.coordinates, lists);
  SearchOptions options;
  options.gap = PairGap::from_igap(1, 0);
  // Rounding of the sum of gaps and margin must not lose a pair.
  options.margin = sides.margin * (1 + 1e-12);
  options.threads = context.options.threads;
  if (sides.set.level != 2) return {find_node_segment_pairs(in, options), {}};
  // A surface lies on itself everywhere: looking at all would find much that is not wanted.
  std::vector<double> on, searched;
  const auto find = [&](std::uint8_t from, std::uint8_t to) {
    return from_surface(sides, lists, in, options, from, to, group_meets_all, on, searched);
  };
  PairsByNode out;
  out.one = find(from_first, from_second);
  out.two = find(from_second, from_first);
  return out;
}

}  // namespace deck::detail::modern
