// The families of elements by the names that keywords and groups have for them. Shared with the
// stages to the right.
#pragma once
#include <optional>
#include <string_view>

#include "deck/model/model.hpp"

namespace deck::detail {

/// Family of the elements that an id of this kind names ("shell", "tetra10", "solid"); nullopt: no
/// element.
std::optional<ElementKind> family_of_kind(std::string_view kind);
/// The same for a group of elements ("grshel").
std::optional<ElementKind> family_of_group(std::string_view kind);

/// Family of the element that has a segment, an edge or a face; nullopt: none has it.
constexpr std::optional<ElementKind> family_of_carrier(Carrier carrier) {
  switch (carrier) {
    case Carrier::none:
      return std::nullopt;
    case Carrier::solid:
      return ElementKind::solid8;
    case Carrier::quad:
      return ElementKind::quad;
    case Carrier::shell4:
      return ElementKind::shell4;
    case Carrier::truss:
      return ElementKind::truss;
    case Carrier::beam:
      return ElementKind::beam;
    case Carrier::spring:
      return ElementKind::spring;
    case Carrier::shell3:
      return ElementKind::shell3;
  }
  return std::nullopt;
}

}  // namespace deck::detail
