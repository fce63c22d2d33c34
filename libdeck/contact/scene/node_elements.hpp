// Connectivity: the elements around a node, per family, built when a family is first asked for.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "deck/model/connectivity.hpp"

namespace deck {

/// Families whose elements have edges of their own.
inline constexpr ElementKind families_with_edges[] = {ElementKind::shell4, ElementKind::shell3,
                                                      ElementKind::solid8, ElementKind::truss,
                                                      ElementKind::beam};

class Connectivity {
 public:
  explicit Connectivity(const Model& model) : model_(model) {}
  /// Elements of `kind` that touch `node`, ascending; mid-side nodes of solids count. Not thread
  /// safe.
  std::span<const std::uint32_t> elements(ElementKind kind, NodeIndex node) {
    const Elements& family = model_.family(kind);
    if (family.size() == 0) return {};
    NodeElements& rows = rows_[static_cast<std::size_t>(kind)];
    if (rows.first.empty()) rows = connect_nodes(family, model_.nodes.size(), 0, true);
    return rows.row(node);
  }
  /// The smallest of elements(kind, node), no_index: there is none. A fifth of the memory and time
  /// of the whole rows, where nothing else is wanted.
  std::uint32_t first(ElementKind kind, NodeIndex node) {
    const Elements& family = model_.family(kind);
    if (family.size() == 0) return no_index;
    std::vector<std::uint32_t>& first = first_[static_cast<std::size_t>(kind)];
    if (first.empty()) first = first_elements(family);
    return first[node];
  }

 private:
  std::vector<std::uint32_t> first_elements(const Elements& family) const {
    std::vector<std::uint32_t> out(model_.nodes.size(), no_index);
    for (auto e = static_cast<std::uint32_t>(family.size()); e-- > 0;) {
      const auto take = [&](const NodeIndex* nodes, int count) {
        for (int i = 0; i < count; ++i)
          if (nodes[i] != no_index) out[nodes[i]] = e;
      };
      take(family.of(e), family.width);
      if (!family.extra.empty() && family.extra[e] != no_index)
        take(family.extra_nodes.data() + family.extra[e], extra_node_count(family.shape[e]));
    }
    return out;
  }

  const Model& model_;
  std::array<NodeElements, 8> rows_;
  std::array<std::vector<std::uint32_t>, 8> first_;
};

}  // namespace deck
