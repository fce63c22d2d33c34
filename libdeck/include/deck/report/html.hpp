// The interactive report of `deck gaps --html`: one self-contained HTML page with the viewer, the
// outer faces of the model and everything needed to evaluate other gap settings in the page.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contact/crossings.hpp"
#include "deck/contact/view.hpp"
#include "deck/cycle/scene_cycle.hpp"
#include "deck/keyword/deck.hpp"
#include "deck/model/interfaces.hpp"
#include "deck/text/result.hpp"

namespace deck {

/// What an earlier report found, for "new, solved, worse".
struct EarlierGaps {
  struct Row {
    std::int64_t interface_id = 0;
    std::string role;                         ///< "primary", "reversed", "edges"
    std::array<std::int64_t, 2> secondary{};  ///< node (second 0) or the two nodes of an edge
    double depth = 0, gap = 0;                ///< lengths, also for edges
  };
  std::string path;       ///< of the JSON file, as given
  std::string deck_path;  ///< of the deck it describes
  std::vector<Row> rows;  ///< deepest row of every secondary node or edge
};

/// Reads the document that `deck gaps --json` wrote; of a list of decks the one called `deck_path`,
/// else the first. Error: no such document, with what was expected.
Result<EarlierGaps> read_earlier_gaps(std::string path, std::string_view json,
                                      std::string_view deck_path);

struct HtmlInput {
  std::string_view path;  ///< of the deck, as given
  const Deck* deck = nullptr;
  const Scene* scene = nullptr;
  const SceneView* view = nullptr;
  std::vector<WhatIf> what_if;     ///< what the scene was built with
  std::vector<std::int64_t> only;  ///< what SceneOptions::only was
  const EarlierGaps* earlier = nullptr;
  /// Forces of the first cycle with their pairs (CycleOptions::keep_pairs); may be nullptr.
  const cycle::SceneOutcome* cycle = nullptr;
  const std::vector<Crossing>* crossings = nullptr;  ///< of the same scene; may be nullptr
  int threads = 1;
};

/// True if the viewer was built in (npm was there at build time); if not, why in `reason`.
bool html_available(std::string* reason = nullptr);

/// The page. Error (config): the viewer was not built in.
Result<std::string> gaps_html(const HtmlInput& input);

}  // namespace deck
