// Nodes and elements behind the rows of the reports of contacts, and their totals and decisions.
// Private to the report stage.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "deck/contact/crossings.hpp"
#include "deck/contact/view.hpp"
#include "report/shared/json.hpp"

namespace deck {

/// Ids of nodes as text; the node that a triangle repeats is there once.
std::string ids_text(const Model& model, std::span<const NodeIndex> nodes, char between);

/// The nodes of a pair of a contact: a node and a segment, or two edges.
struct PairNodes {
  std::span<const NodeIndex> secondary, main;
};
PairNodes pair_nodes(const Contact& contact, std::uint32_t secondary, std::uint32_t main);

/// The secondary node of a penetration (edge pairs: the first node of the edge), and those of a
/// list of a view.
NodeIndex first_node(const Scene& scene, const NamedPenetration& penetration);
std::vector<NodeIndex> first_nodes(const Scene& scene, const std::vector<NamedPenetration>& list);

/// The element that has the edge of a crossing, and the one behind its segment.
ElementName edge_element(const Model& model, const Crossing& crossing);
ElementName segment_element(const Scene& scene, const Crossing& crossing);

/// Where the solver's arithmetic decides otherwise about contact, or with `always`: one sentence,
/// and a table of the first `rows` differences, fitted to `width`. Else "".
std::string decisions_text(const Scene& scene, std::size_t rows, bool always, bool color,
                           std::size_t width);

}  // namespace deck
