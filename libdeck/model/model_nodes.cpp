// /CNODE: a connection node within the tolerance of another node is merged with it; elements and
// groups then refer to the other node.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <unordered_map>

#include "base/shared/parallel.hpp"
#include "base/shared/vec.hpp"
#include "deck/text.hpp"
#include "model/bulk/bulk.hpp"
#include "model/model_build.hpp"
#include "model/shared/families.hpp"
#include "model/shared/item_spans.hpp"

namespace deck {

NodeIndex ModelData::find_node(std::int64_t node_id) const {
  const NodeIndex n = nodes.map.find(node_id);
  if (n == no_index || merged_nodes.empty()) return n;
  const auto it = std::lower_bound(merged_nodes.begin(), merged_nodes.end(),
                                   std::pair<NodeIndex, NodeIndex>(n, 0));
  return it != merged_nodes.end() && it->first == n ? it->second : n;
}

namespace detail {
namespace {

/// Nodes in cubes of the tolerance; tolerance 0: by exact coordinates.
class NodeGrid {
 public:
  NodeGrid(const Nodes& nodes, double tolerance) : nodes_(nodes), tolerance_(tolerance) {}

  void add(NodeIndex n) { cells_[cell(n, 0, 0, 0)].push_back(n); }

  /// Nearest node within the tolerance, the first of equals; no_index: none.
  NodeIndex nearest(NodeIndex n) const {
    const int reach = tolerance_ > 0 ? 1 : 0;
    NodeIndex best = no_index;
    double best_distance = tolerance_;
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        for (int k = -reach; k <= reach; ++k) {
          const auto it = cells_.find(cell(n, i, j, k));
          if (it == cells_.end()) continue;
          for (const NodeIndex other : it->second) {
            const double d = length3(nodes_.x[n] - nodes_.x[other], nodes_.y[n] - nodes_.y[other],
                                     nodes_.z[n] - nodes_.z[other]);
            if (d < best_distance || (d == best_distance && (best == no_index || other < best))) {
              best = other;
              best_distance = d;
            }
          }
        }
    return best;
  }

 private:
  std::uint64_t cell(NodeIndex n, int i, int j, int k) const {
    std::uint64_t h = 0;
    const double coordinates[3] = {nodes_.x[n], nodes_.y[n], nodes_.z[n]};
    const int shift[3] = {i, j, k};
    for (int axis = 0; axis < 3; ++axis) {
      const double c = coordinates[axis];
      const double at = tolerance_ > 0 ? std::floor(c / tolerance_) + shift[axis] : c + 0.0;
      h = (h ^ std::hash<double>{}(at)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 31;
    }
    return h;  // collisions only add candidates
  }

  const Nodes& nodes_;
  double tolerance_;
  std::unordered_map<std::uint64_t, std::vector<NodeIndex>> cells_;
};

double tolerance_of(const BuildContext& c, const Block& block) {
  constexpr std::string_view keyword = "/CNODE/";
  if (!block.header.starts_with(keyword)) return 0;
  const double value = read_real(block.header.substr(keyword.size())).value;
  const UnitSystem* units = c.deck.units_of(block);
  Dimension length;
  length.length = 1;
  return std::max(0.0, value) *
         (units != nullptr ? conversion_factor(*units, c.deck.begin.working, length) : 1);
}

}  // namespace

void merge_connection_nodes(BuildContext& c) {
  Model& m = c.model;
  const auto is_connection = [](const BulkBlock& b) { return header_starts(*b.block, "/CNODE"); };
  std::span<const BulkBlock> block;
  for (std::size_t i = 0; i < m.node_blocks.size(); i += block.size()) {
    block = runs_of_block(m.node_blocks, i);
    if (!is_connection(block.front()) || block.front().count == 0) continue;
    NodeGrid grid(m.nodes, tolerance_of(c, *block.front().block));
    for (const BulkBlock& other : m.node_blocks)
      if (!is_connection(other) || &other < block.data())
        for (NodeIndex n = other.first; n < other.first + other.count; ++n) grid.add(n);
    for (const BulkBlock& run : block)
      for (NodeIndex n = run.first; n < run.first + run.count; ++n) {
        const NodeIndex target = grid.nearest(n);
        if (target == no_index)
          grid.add(n);
        else
          m.merged_nodes.emplace_back(n, target);
      }
  }
  std::sort(m.merged_nodes.begin(), m.merged_nodes.end());
  // Follows chains of merged nodes.
  for (auto& [node, target] : m.merged_nodes) target = m.find_node(m.nodes.id[target]);
}

void check_coordinates(BuildContext& c) {
  constexpr double largest = 1e75;  // products of four lengths are finite
  const Nodes& nodes = c.model.nodes;
  const auto fits = [](double v) { return std::abs(v) <= largest; };
  std::atomic<bool> all_fit{true};
  parallel_pieces(c.threads, nodes.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (const auto* axis : {&nodes.x, &nodes.y, &nodes.z})
      if (!std::all_of(axis->data() + begin, axis->data() + end, fits)) all_fit = false;
  });
  if (all_fit) return;
  std::vector<NodeIndex> shown;
  for (NodeIndex n = 0; n < nodes.size(); ++n) {
    if (fits(nodes.x[n]) && fits(nodes.y[n]) && fits(nodes.z[n])) continue;
    const bool finite =
        std::isfinite(nodes.x[n]) && std::isfinite(nodes.y[n]) && std::isfinite(nodes.z[n]);
    if (c.findings.wants(finite ? RuleId::DK334 : RuleId::DK333)) shown.push_back(n);
  }
  if (shown.empty()) return;
  const std::vector<Span> spans = node_spans(c.model, shown);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const NodeIndex n = shown[i];
    const double at[] = {nodes.x[n], nodes.y[n], nodes.z[n]};
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (!(std::abs(at[k]) <= std::abs(at[axis]))) axis = k;
    const bool finite = std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]);
    c.findings.add(finding_from(
        {finite ? RuleId::DK334 : RuleId::DK333, spans[i],
         fmt::format("node {}: {} is {:.6g} in working units, {}", nodes.id[n], "XYZ"[axis],
                     at[axis],
                     finite ? "too large for distances to be computed" : "not a finite number"),
         "/NODE", nodes.id[n]}));
  }
}

void redirect_elements(BuildContext& c) {
  Model& m = c.model;
  if (m.merged_nodes.empty()) return;
  std::vector<NodeIndex> target(m.nodes.size());
  for (NodeIndex n = 0; n < target.size(); ++n) target[n] = n;
  for (const auto& [node, other] : m.merged_nodes) target[node] = other;
  for (const ElementKind kind : all_families)
    for (auto* list : {&family_of(m, kind).nodes, &family_of(m, kind).extra_nodes})
      for (NodeIndex& n : *list)
        if (n != no_index) n = target[n];
}

}  // namespace detail
}  // namespace deck
