// The report of two states of a deck: penetrations as they are now against those before, and the
// nodes that moved.
#pragma once
#include <string>
#include <string_view>

#include "common.hpp"
#include "deck/edit/rewrite.hpp"
#include "deck/report/html.hpp"

namespace deck::cli {

/// The page of `deck diff --html`, and with the verb "fix" of `deck fix --html`: the later deck
/// with what is new, solved or deeper than in the earlier one. `path`: name of the deck in the
/// page. `trends`: HtmlInput::trends; nullptr: both decks are compared as --compare does it.
Result<std::string> difference_page(const LoadedDeck& before, LoadedDeck& after, const char* verb,
                                    std::string_view path, std::string_view repair = {},
                                    const std::vector<PageTrend>* trends = nullptr);

/// The page of `deck fix --html` of the deck with `changed` texts, against the deck as
/// it was read. `repair`: HtmlInput::repair. Error: it cannot be read again, or the viewer is not
/// there.
Result<std::string> fix_page(const LoadedDeck& before, const ChangedFiles& changed,
                             std::string_view repair, const CommonOptions& options);

}  // namespace deck::cli
