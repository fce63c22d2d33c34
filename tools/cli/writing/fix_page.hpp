// The report of a fixed deck: penetrations as they will be, compared with those before.
#pragma once
#include <string>

#include "common.hpp"
#include "deck/edit/rewrite.hpp"

namespace deck::cli {

/// The page of `deck gaps --html --compare` of the deck with `changed` texts, against the deck as
/// it was read. Error: it cannot be read again, or the viewer is not there.
Result<std::string> fix_page(const LoadedDeck& before, const ChangedFiles& changed,
                             const CommonOptions& options);

}  // namespace deck::cli
