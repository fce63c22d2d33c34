// Irem_i2 = 1: which initial penetrations a tie (/INTER/TYPE2) of the deck holds already.
#include <algorithm>
#include <utility>

#include "contact/modern/parts.hpp"
#include "contact/shared/tie_parts.hpp"

namespace deck::detail::modern {

std::vector<bool> held_by_ties(SceneContext& c, const Sides& s,
                               const std::vector<NodePenetration>& penetrations) {
  std::vector<std::pair<NodeIndex, NodeIndex>> pairs;  // tied node, corner of its main segment
  for (const Tie& tie : ties_of(c))
    for (const TiedNode& n : tie.nodes)
      if (n.tied)
        for (const NodeIndex corner : tie.main[n.segment]) pairs.emplace_back(n.node, corner);
  std::vector<bool> held(penetrations.size(), false);
  if (pairs.empty()) return held;
  std::sort(pairs.begin(), pairs.end());
  const auto tied = [&](NodeIndex node, NodeIndex corner) {
    return std::binary_search(pairs.begin(), pairs.end(), std::pair{node, corner});
  };
  for (std::size_t i = 0; i < penetrations.size(); ++i) {
    const NodeIndex n = s.nodes[penetrations[i].node].node;
    for (const NodeIndex corner : s.nodes_of(penetrations[i].face))
      if (tied(n, corner) || tied(corner, n)) held[i] = true;
  }
  return held;
}

}  // namespace deck::detail::modern
