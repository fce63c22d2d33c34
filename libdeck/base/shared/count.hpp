// "1 node", "3 nodes": a number with what it counts.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace deck {

inline std::string count(std::uint64_t n, std::string_view one, std::string_view many) {
  std::string text = std::to_string(n);
  text += ' ';
  text += n == 1 ? one : many;
  return text;
}

/// "62 nodes and 12 edges", without what there is none of.
inline std::string nodes_and_edges(std::uint64_t nodes, std::uint64_t edges) {
  if (edges == 0) return count(nodes, "node", "nodes");
  if (nodes == 0) return count(edges, "edge", "edges");
  return count(nodes, "node", "nodes") + " and " + count(edges, "edge", "edges");
}

}  // namespace deck
