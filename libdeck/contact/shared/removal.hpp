// Irem_gap = 2: secondary nodes (edges) of a self contact that lie within sqrt(2) gaps of a main
// segment (edge) along the mesh are not paired with it.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "deck/contact/search.hpp"

namespace deck::detail {

/// Per main item: secondary positions not to be paired with it, sorted. Empty if nothing is
/// removed.
using RemovalLists = std::vector<std::vector<std::uint32_t>>;
bool is_removed(const RemovalLists& lists, const CandidatePair& pair);

/// What removal has to know of a contact's gaps.
struct RemovalGaps {
  PairGap rule;
  int igap = 0;
  double drad = 0, largest = 0, shortest_side = 0;
};

/// False: the lists would have more than `most_entries`. Of the inputs stiffnesses are not used;
/// gaps and lengths are as long as their lists.
bool remove_along_mesh(const NodeSegmentInput& contact, const RemovalGaps& gaps,
                       std::uint64_t most_entries, RemovalLists& lists);
bool remove_along_mesh(const EdgeEdgeInput& contact, const RemovalGaps& gaps,
                       std::uint64_t most_entries, RemovalLists& lists);

}  // namespace deck::detail
