// Connectivity: elements at each node, per family, built on first use.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/shared/parallel.hpp"
#include "deck/contacts.hpp"
#include "model/shared/families.hpp"

namespace deck {

/// Families whose elements have edges of their own.
inline constexpr ElementKind families_with_edges[] = {ElementKind::shell4, ElementKind::shell3,
                                                      ElementKind::solid8, ElementKind::truss,
                                                      ElementKind::beam};

/// An edge of an element by the slots of its two nodes.
using LocalEdge = std::array<int, 2>;
std::span<const LocalEdge> local_edges(const Elements& family, std::uint32_t element);

class Connectivity {
 public:
  explicit Connectivity(const Model& model) : model_(model) {}
  /// Elements of `kind` at `node`, ascending, mid-side nodes of solids included. Not thread-safe.
  std::span<const std::uint32_t> elements(ElementKind kind, NodeIndex node) {
    const NodeElements& rows = rows_[static_cast<std::size_t>(kind)];
    if (rows.first.empty()) prepare(kind);
    if (rows.first.empty()) return {};  // there are no such elements
    return rows.row(node);
  }
  /// Afterwards several threads may call elements(kind, ...).
  void prepare(ElementKind kind) {
    const Elements& family = model_.family(kind);
    NodeElements& rows = rows_[static_cast<std::size_t>(kind)];
    if (family.size() > 0 && rows.first.empty())
      rows = connect_nodes(family, model_.nodes.size(), 0, true);
  }
  /// Smallest of elements(kind, node); no_index if none. A fifth of the memory and time.
  std::uint32_t first(ElementKind kind, NodeIndex node) {
    const Elements& family = model_.family(kind);
    if (family.size() == 0) return no_index;
    prepare_first(kind);
    return first_[static_cast<std::size_t>(kind)][node];
  }
  /// Afterwards several threads may call first(kind, ...).
  void prepare_first(ElementKind kind, int threads = 1) {
    const Elements& family = model_.family(kind);
    std::vector<std::uint32_t>& first = first_[static_cast<std::size_t>(kind)];
    if (family.size() > 0 && first.empty()) first = first_elements(family, threads);
  }

 private:
  std::vector<std::uint32_t> first_elements(const Elements& family, int threads) const {
    std::vector<std::uint32_t> out(model_.nodes.size(), no_index);
    // Every thread writes to its own nodes.
    parallel_parts(threads, out.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
      for (auto e = static_cast<std::uint32_t>(family.size()); e-- > 0;) {
        const auto set_first = [&](const NodeIndex* nodes, int count) {
          for (int i = 0; i < count; ++i)
            if (nodes[i] - begin < end - begin) out[nodes[i]] = e;  // no_index: too large
        };
        set_first(family.of(e), family.width);
        if (!family.extra.empty() && family.extra[e] != no_index)
          set_first(family.extra_nodes.data() + family.extra[e], extra_node_count(family.shape[e]));
      }
    });
    return out;
  }

  const Model& model_;
  std::array<NodeElements, 8> rows_;
  std::array<std::vector<std::uint32_t>, 8> first_;
};

/// Element that names a node: smallest index of the first family with an element there; else all 0.
ElementName element_at(const Model& model, Connectivity& connectivity, NodeIndex node);

/// The elements of a kind of carrier; nullptr: none.
const Elements* elements_of(const Model& model, Carrier carrier);

/// The element of a segment or edge; not valid() if the carrier is none.
ElementName carrier_name(const Model& model, Carrier carrier, std::uint32_t element);

}  // namespace deck
