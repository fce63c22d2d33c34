// New names for LOCAL parameters that would mean something else in one file. Private to flattening.
#pragma once
#include <string>
#include <vector>

#include "deck/keyword/deck.hpp"

namespace deck::detail {

/// Edits that give every parameter reference its meaning once all files are one. `refusals` gets
/// the names for which there is no free one of the same length; `notes` the new names.
std::vector<TextEdit> rename_local_parameters(const Deck& deck, std::vector<std::string>& refusals,
                                              std::vector<std::string>& notes);

}  // namespace deck::detail
