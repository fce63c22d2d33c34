// Nodes and elements behind the rows of the gaps reports, and their totals as JSON. Private to the
// report stage.
#pragma once
#include <vector>

#include "deck/contact/crossings.hpp"
#include "deck/contact/view.hpp"
#include "report/shared/json.hpp"

namespace deck {

/// The secondary node of a penetration (edge pairs: the first node of the edge), and those of a
/// list of a view.
NodeIndex first_node(const Scene& scene, const NamedPenetration& penetration);
std::vector<NodeIndex> first_nodes(const Scene& scene, const std::vector<NamedPenetration>& list);

/// The element that has the edge of a crossing, and the one behind its segment.
ElementName edge_element(const Model& model, const Crossing& crossing);
ElementName segment_element(const Scene& scene, const Crossing& crossing);

}  // namespace deck
