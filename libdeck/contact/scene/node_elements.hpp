// Connectivity: the elements around a node, per family, built when a family is first asked for.
#pragma once
#include <array>
#include <span>

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

 private:
  const Model& model_;
  std::array<NodeElements, 8> rows_;
};

}  // namespace deck
