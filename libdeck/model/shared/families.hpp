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

}  // namespace deck::detail
