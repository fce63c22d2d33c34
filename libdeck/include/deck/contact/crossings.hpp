// Crossed elements: edges that pass through main segments, which no penetration depth shows. The
// decision is exact; the reference solver has no such check.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "deck/contact/scene.hpp"
#include "deck/contact/search.hpp"

namespace deck {

/// All pairs (secondary: position of the edge, main: position of the segment) where the edge passes
/// through the segment, sorted. Quads are the two triangles (1 2 3) and (1 3 4). An edge passes
/// through a triangle if its ends lie strictly on either side of the plane and it meets the closed
/// triangle: mere touching and edges within the plane do not count, nor do edges that share a node
/// with the segment. Exact for all finite coordinates; does not depend on `threads`.
std::vector<CandidatePair> find_crossing_pairs(
    const NodeArrays& nodes, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const std::array<std::uint32_t, 4>> segments, int threads = 1);

/// One edge of an element through one main segment of a contact.
struct Crossing {
  std::uint32_t contact = 0;        ///< Scene::contacts
  std::array<NodeIndex, 2> edge{};  ///< smaller index first
  ElementKind edge_kind{};          ///< the element that has the edge: of several the first one
  std::uint32_t edge_element = no_index;
  std::uint32_t main = 0;  ///< Contact::main
};

/// Crossed elements of all node-to-segment contacts, the secondary side against the main side:
/// edges of shells, solids, trusses and beams whose nodes are both secondary, through main
/// segments. An edge and the four nodes of a segment are listed once, in the first contact that has
/// both. Springs are left out: they join what they pass through. Ordered by contact, edge, segment.
/// Positions are those of Scene::coordinates.
std::vector<Crossing> find_crossings(const Scene& scene, int threads = 1);

}  // namespace deck
