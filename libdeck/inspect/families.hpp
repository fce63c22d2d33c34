// Keywords and blocks of the families that the model keeps elements in. Private to inspection.
#pragma once
#include <vector>

#include "model/shared/families.hpp"

namespace deck::detail {

/// The block at a position of Model::node_blocks or element_blocks; nullptr: none.
const Block* bulk_block(const std::vector<BulkBlock>& blocks, std::uint32_t block);

/// Keyword of a family, for people.
inline const char* keyword_of_family(ElementKind kind) {
  switch (kind) {
    case ElementKind::shell4:
      return "/SHELL";
    case ElementKind::shell3:
      return "/SH3N";
    case ElementKind::solid8:
      return "/BRICK";
    case ElementKind::quad:
      return "/QUAD";
    case ElementKind::tria:
      return "/TRIA";
    case ElementKind::truss:
      return "/TRUSS";
    case ElementKind::beam:
      return "/BEAM";
    case ElementKind::spring:
      return "/SPRING";
  }
  return "";
}

inline constexpr ElementKind all_families[] = {
    ElementKind::shell4, ElementKind::shell3, ElementKind::solid8, ElementKind::quad,
    ElementKind::tria,   ElementKind::truss,  ElementKind::beam,   ElementKind::spring};

}  // namespace deck::detail
