// Pages and VTK files: the page of `deck gaps --html` for verbs that have a scene and show it, and
// the report of two states of a deck: penetrations as they are now against those before, and the
// nodes that moved.
#pragma once
#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common.hpp"
#include "deck/edit.hpp"
#include "deck/loaded_deck.hpp"
#include "deck/report.hpp"
#include "report/shared/vtk.hpp"

namespace deck::cli {

/// Why --html cannot be done: this build has no viewer; empty: `html` is not asked for, or it can.
std::string no_viewer(const std::string& html);
/// no_viewer(), and one page holds one deck.
Result<void> check_html(const CommonOptions& options, const std::string& html);

/// What a page or a drawing is made from: `more` and the scene of the deck.
HtmlInput page_input(const LoadedDeck& loaded, const SceneView& view, HtmlInput more = {});

/// Writes VTK files into a directory itself, or below it into one of the deck if the call has
/// several. Without `script` they have one already.
Result<void> write_vtk(const CommonOptions& options, const std::string& directory,
                       std::string_view deck, const std::vector<VtkFile>& vtk,
                       const std::optional<VtkFile>& script);

/// The page of a deck with ties, crossings and forces of the first cycle; its scene is made again
/// if it lacks what the page needs. `input` has the path and what else the page shall know beside
/// the deck. Error: the viewer is not there, or `stop` was set meanwhile ("cancelled").
Result<std::string> gap_page(LoadedDeck& loaded, HtmlInput input,
                             const std::atomic<bool>* stop = nullptr);

/// The page of `deck diff --html`, and with the verb "fix" of `deck fix --html`: the later deck
/// with what is new, solved or deeper than in the earlier one. `path`: name of the deck in the
/// page. `trends`: HtmlInput::trends; nullptr: both decks are compared as --compare does it. `told`:
/// with them HtmlInput::changes, else HtmlInput::repair.
Result<std::string> difference_page(const LoadedDeck& before, LoadedDeck& after, const char* verb,
                                    std::string_view path, std::string_view told = {},
                                    const std::vector<PageTrend>* trends = nullptr);

/// The page of `deck fix --html` of the deck with `changed` texts, against the deck as
/// it was read. `repair`: HtmlInput::repair. Error: it cannot be read again, or the viewer is not
/// there.
Result<std::string> fix_page(const LoadedDeck& before, const ChangedFiles& changed,
                             std::string_view repair, const CommonOptions& options);

}  // namespace deck::cli
