// Every value that a conversion changes, for its report: file, line, columns, old, new and why.
#pragma once
#include <string_view>

#include "deck/edit/rewrite.hpp"

namespace deck {

/// Adds an entry to rewrite.losses for every edit that has none yet, with the field the edit
/// changes and `option` as the reason, and the columns to those that have. Also where the
/// conversion is refused: then it is what would have been changed.
void add_changed_values(const LoadedDeck& context, std::string_view option, Rewrite& rewrite);

}  // namespace deck
