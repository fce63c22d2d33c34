// The interactive report of `deck gaps --html`: one self-contained HTML page with the viewer, the
// outer faces of the model and everything needed to evaluate other gap settings in the page.
#pragma once
#include <array>
#include <cstdint>
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

struct CycleInput;  // report/shared/cycle.hpp
class LoadedDeck;   // deck/front/loaded_deck.hpp

/// What became of a penetrating node or edge since an earlier run.
struct PageTrend {
  std::int64_t interface_id = 0;            ///< as the page names it; of what is solved, as it was
  std::string role;                         ///< "primary", "reversed", "edges"
  std::array<std::int64_t, 2> secondary{};  ///< node (second 0) or the two nodes of an edge
  double depth = 0, gap = 0;                ///< then; of what is new 0
  const char* trend = "";                   ///< "new", "worse", "same", "better", "solved"
};

struct HtmlInput {
  std::string_view path;  ///< of the deck, as given
  const Deck* deck = nullptr;
  const Scene* scene = nullptr;
  const SceneView* view = nullptr;
  std::vector<WhatIf> what_if;     ///< what the scene was built with
  std::vector<std::int64_t> only;  ///< what SceneOptions::only was
  const EarlierGaps* earlier = nullptr;
  /// With `earlier`: its rows beside those of the page, where another comparison than compare_gaps
  /// has found them; nullptr: that one.
  const std::vector<PageTrend>* trends = nullptr;
  /// Forces of the first cycle with their pairs (CycleOptions::keep_pairs), sums at nodes are not
  /// looked at; may be nullptr.
  const cycle::SceneOutcome* cycle = nullptr;
  std::vector<cycle::ActedNode> acted;  ///< of `cycle`: acted_in_page()
  /// Makes the page that of `deck cycle --html`: the document of `deck cycle --json` stands in it,
  /// effects and what they cost come first. May be nullptr.
  const CycleInput* effects = nullptr;
  /// Makes the page that of `deck parts --html`: the parts with their masses and steps come first
  /// (the document of `deck parts --json`), and the colours can show the steps of the elements. May
  /// be nullptr.
  const LoadedDeck* parts = nullptr;
  /// An earlier model: nodes that stand elsewhere now are listed, and the picture shows both. May
  /// be nullptr.
  const Model* before = nullptr;
  /// What a repair says of itself: repair_json() of report/shared/fix.hpp; may be empty.
  std::string_view repair;
  const char* verb =
      nullptr;  ///< that the page names: "fix", "diff"; nullptr: gaps, cycle or parts
  const std::vector<Crossing>* crossings = nullptr;  ///< of the same scene; may be nullptr
  int threads = 1;
};

/// True if the viewer was built in (npm was there at build time); if not, why in `reason`.
bool html_available(std::string* reason = nullptr);

/// What the page shows of the nodes that contact acts on: all in the order of the mesh, of more
/// than 100 000 those with the largest forces, these first.
std::vector<cycle::ActedNode> acted_in_page(const cycle::State& state,
                                            const cycle::SceneOutcome& outcome);

/// The page: of `deck gaps`, of `deck cycle` where `effects` is given, of `deck parts` where
/// `parts` is given. Error (config): the viewer was not built in.
Result<std::string> gaps_html(const HtmlInput& input);

/// Who touches whom, as the page draws it for the deck's settings: parts against parts, the number
/// of interfaces through which they come near each other, red where they penetrate. SVG; needs no
/// viewer.
std::string touches_svg(const HtmlInput& input);

}  // namespace deck
