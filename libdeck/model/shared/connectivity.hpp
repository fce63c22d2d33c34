// Connectivity: for a family of elements, which elements touch a node, and which belong to a part;
// compressed rows and runs, built on demand in linear time.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "deck/model/model.hpp"

namespace deck {

/// Rows of indices: row i is entries[first[i] .. first[i + 1]), ascending.
struct IndexRows {
  std::vector<std::uint32_t> first;  ///< size rows + 1; empty if nothing was built
  std::vector<std::uint32_t> entries;
  std::size_t rows() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const std::uint32_t> row(std::size_t i) const {
    return {entries.data() + first[i], entries.data() + first[i + 1]};
  }
};

/// Elements of each node. An element appears once per node, however often it repeats it.
using NodeElements = IndexRows;
/// Elements first ... end-1 of a family.
struct ElementRun {
  std::uint32_t first = 0, end = 0;
  std::uint32_t size() const { return end - first; }
};
/// Elements of each part, ascending, in runs as long as possible: those of a part mostly follow
/// each other.
struct PartElements {
  std::vector<std::uint32_t> first;  ///< of the runs of each part; size parts + 1
  std::vector<ElementRun> runs;
  std::span<const ElementRun> row(std::size_t part) const {
    return {runs.data() + first[part], runs.data() + first[part + 1]};
  }
};

/// `slots` of every element are looked at; 0: all of them. Mid-side nodes of 10-, 16- and 20-node
/// solids count if `mid_nodes` is set. Missing nodes are skipped.
NodeElements connect_nodes(const Elements& family, std::size_t node_count, int slots = 0,
                           bool mid_nodes = false);
/// Elements whose part is missing are in no run.
PartElements connect_parts(const Elements& family, std::size_t part_count);

/// Number of mid-side node slots of a solid shape.
int extra_node_count(SolidShape shape);

}  // namespace deck
