// Words of the LS-DYNA reader: what a cell or a type stands for. Private to it.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "edit/lsdyna/read.hpp"

namespace deck::detail {

/// What is lost with a cell that has no counterpart.
std::string_view why_dropped(std::string_view cell);
/// "part set" for type 2.
std::string_view set_name(std::int64_t type);
/// What a contact of this kind is as an interface of that type.
std::string_view target_note(DynaKind kind, int type);
/// A heading as a title line, which must be neither a comment nor a keyword. May be empty.
std::string title_of(const std::string& heading);

}  // namespace deck::detail
