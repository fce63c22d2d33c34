// Element families by the names in keywords and groups. Used by later stages, too.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "deck/model.hpp"

namespace deck::detail {

/// Family for a kind of id ("shell", "tetra10", "solid"); nullopt: not an element.
std::optional<ElementKind> family_of_kind(std::string_view kind);
/// Family for a kind of element group ("grshel").
std::optional<ElementKind> family_of_group(std::string_view kind);

/// Names of a family in groups.
struct FamilyName {
  ElementKind kind;
  std::string_view group;    ///< "grshel"
  std::string_view keyword;  ///< "GRSHEL"
  std::string_view member;   ///< type keyword of the id list: "SHEL"
  std::string_view id_kind;  ///< kind for the submodel offset
  std::string_view clause;   ///< clause of a set
  Carrier carrier;
};
const std::vector<FamilyName>& family_names();
const FamilyName& family_name(ElementKind kind);
/// Nodes that carry the element: without orientation nodes of beams and springs.
int carrying_nodes(ElementKind kind);

/// All kinds in order.
inline constexpr ElementKind all_families[] = {
    ElementKind::shell4, ElementKind::shell3, ElementKind::solid8, ElementKind::quad,
    ElementKind::tria,   ElementKind::truss,  ElementKind::beam,   ElementKind::spring};

/// Family of the element of a carrier; nullopt: none.
constexpr std::optional<ElementKind> family_of_carrier(Carrier carrier) {
  constexpr ElementKind of[] = {ElementKind::solid8, ElementKind::quad, ElementKind::shell4,
                                ElementKind::truss,  ElementKind::beam, ElementKind::spring,
                                ElementKind::shell3};
  if (carrier == Carrier::none) return std::nullopt;
  return of[static_cast<std::size_t>(carrier) - 1];
}

}  // namespace deck::detail

namespace deck {

/// Rows of entries: row i is entries[first[i] .. first[i + 1]).
template <class Entry>
struct CompressedRows {
  std::vector<std::uint32_t> first;  ///< size rows + 1; empty: not built
  std::vector<Entry> entries;
  std::size_t rows() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const Entry> row(std::size_t i) const {
    return {entries.data() + first[i], entries.data() + first[i + 1]};
  }
};
using IndexRows = CompressedRows<std::uint32_t>;  ///< each ascending

/// Elements of each node, without duplicates.
using NodeElements = IndexRows;
/// Elements first ... end-1 of a family.
struct ElementRun {
  std::uint32_t first = 0, end = 0;
  std::uint32_t size() const { return end - first; }
};
/// Elements of each part, ascending, as maximal runs: most are consecutive.
using PartElements = CompressedRows<ElementRun>;

/// Uses the first `slots` nodes of each element (0: all), and with `mid_nodes` the mid-side nodes
/// of 10-, 16- and 20-node solids. Skips missing nodes.
NodeElements connect_nodes(const Elements& family, std::size_t node_count, int slots = 0,
                           bool mid_nodes = false);
/// Elements without part are in no run.
PartElements connect_parts(const Elements& family, std::size_t part_count);

/// Number of mid-side node slots of a solid shape.
int extra_node_count(SolidShape shape);

}  // namespace deck
