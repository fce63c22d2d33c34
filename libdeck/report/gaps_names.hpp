// Nodes and elements behind the rows of the gaps reports. Private to the report stage.
#pragma once
#include <vector>

#include "deck/contact/crossings.hpp"
#include "deck/contact/view.hpp"

namespace deck {

/// The secondary node of every penetration of a view (edge pairs: the first node of the edge).
std::vector<NodeIndex> first_nodes(const Scene& scene, const SceneView& view);

/// The element that has the edge of a crossing, and the one behind its segment.
ElementName edge_element(const Model& model, const Crossing& crossing);
ElementName segment_element(const Scene& scene, const Crossing& crossing);

}  // namespace deck
