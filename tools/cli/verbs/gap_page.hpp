// Pages and VTK files: the gaps page for verbs with a scene, and the comparison of two states of a
// deck (penetrations, moved nodes).
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

/// Error if `html` is set and this build has no viewer; else empty.
std::string no_viewer(const std::string& html);
/// no_viewer(), and only one deck per page.
Result<void> check_html(const CommonOptions& options, const std::string& html);

/// Input of a page or picture: `more` and the scene of the deck.
HtmlInput page_input(const LoadedDeck& loaded, const SceneView& view, HtmlInput more = {});

/// Writes VTK files into a directory, or a subdirectory per deck if there are several. Without
/// `script` one exists already.
Result<void> write_vtk(const CommonOptions& options, const std::string& directory,
                       std::string_view deck, const std::vector<VtkFile>& vtk,
                       const std::optional<VtkFile>& script);

/// Page of a deck with ties, crossings and first cycle; builds the scene again if data are missing.
/// `input`: path and further data. Error: no viewer, or `stop` was set ("cancelled").
Result<std::string> gap_page(LoadedDeck& loaded, HtmlInput input,
                             const std::atomic<bool>* stop = nullptr);

/// Page of `deck diff --html` or, with verb "fix", `deck fix --html`: the later deck with new,
/// solved and deeper penetrations. `path`: name in the page. `trends`: HtmlInput::trends; nullptr:
/// compare as --compare does. `told`: HtmlInput::changes with trends, else HtmlInput::repair.
Result<std::string> difference_page(const LoadedDeck& before, LoadedDeck& after, const char* verb,
                                    std::string_view path, std::string_view told = {},
                                    const std::vector<PageTrend>* trends = nullptr);

/// Page of `deck fix --html`: the deck with `changed` texts compared with the original. `repair`:
/// HtmlInput::repair. Error: it cannot be read, or no viewer.
Result<std::string> fix_page(const LoadedDeck& before, const ChangedFiles& changed,
                             std::string_view repair, const CommonOptions& options);

}  // namespace deck::cli
