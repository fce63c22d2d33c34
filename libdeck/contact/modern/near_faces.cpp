// The search that TYPE24 and TYPE25 share: from nodes and faces with their gaps to pairs.
#include "contact/modern/parts.hpp"

namespace deck::detail::modern {

SearchResult near_faces(const SceneContext& context, const Sides& sides,
                        const std::vector<double>& node_gaps, const std::vector<double>& face_gaps,
                        const std::vector<double>& stiffness) {
  const Coordinates& x = context.scene.coordinates;
  std::vector<std::uint32_t> nodes;
  std::vector<std::array<std::uint32_t, 4>> segments;
  nodes.reserve(sides.nodes.size());
  segments.reserve(sides.faces.size());
  for (const SideNode& n : sides.nodes) nodes.push_back(n.node);
  for (const Face& f : sides.faces) segments.push_back(f.nodes);
  NodeSegmentInput in;
  in.nodes = {x.x, x.y, x.z};
  in.secondary = nodes;
  in.secondary_gap = node_gaps;
  in.segments = segments;
  in.segment_gap = face_gaps;
  in.segment_stiffness = stiffness;
  SearchOptions options;
  options.gap = PairGap::from_igap(1, 0);
  // Rounding of the sum of gaps and margin must not lose a pair.
  options.margin = sides.margin * (1 + 1e-12);
  options.threads = context.options.threads;
  return find_node_segment_pairs(in, options);
}

}  // namespace deck::detail::modern
