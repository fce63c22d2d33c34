// Reports: gaps and penetrations as text, JSON and CSV, and the HTML page of a deck.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/cycle.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/text.hpp"

namespace deck {

// Reports of contacts: gaps, stiffness, initial penetrations and the solver's action on each, as
// plain text, JSON and CSV. They are pure functions from a scene to text.

/// Takes the text so far out of the string, which is empty afterwards. A function that is given one
/// calls it between rows and returns the rest; with an empty one it returns the whole document.
using TextDrain = std::function<void(std::string& text)>;

/// Calls it when there is enough text to be worth it.
inline void drain_text(const TextDrain& drain, std::string& text) {
  constexpr std::size_t enough = std::size_t{1} << 20;
  if (drain && text.size() >= enough) drain(text);
}

struct GateReport;  // report/shared/gate.hpp

struct GapsTextOptions {
  std::size_t worst = 20;       ///< rows of the worst list
  std::size_t part_pairs = 15;  ///< rows of the part-pair table
  bool color = false;
  /// Interfaces without penetrations, too, each contact of an interface in a row of its own, and
  /// what its sides are.
  bool verbose = false;
  std::size_t width = 0;                             ///< columns of a line of a table; 0: any
  std::string name;                                  ///< of the deck, where there are several
  const std::vector<Crossing>* crossings = nullptr;  ///< also list these
  const GateReport* gate = nullptr;
};

/// Interface table, part pairs, worst list, crossed elements, where round-off decides about a
/// contact; then the verdict, and the gate.
std::string gaps_text(const Deck& deck, const Scene& scene, const SceneView& view,
                      const GapsTextOptions& options = {});

/// The document of `deck gaps --json`. With `all`, every secondary node and main segment; with
/// `crossings`, what find_crossings gave for the scene.
std::string gaps_json(std::string_view path, const Deck& deck, const Scene& scene,
                      const SceneView& view, bool all,
                      const std::vector<Crossing>* crossings = nullptr,
                      const GateReport* gate = nullptr, const TextDrain& drain = {});

/// Crossed elements by part pair.
std::string crossings_text(const Scene& scene, const std::vector<Crossing>& crossings,
                           const GapsTextOptions& options = {});

/// One line per penetration, ties left out, deepest first, RFC 4180.
std::string gaps_csv(const Deck& deck, const Scene& scene, const SceneView& view,
                     const TextDrain& drain = {});
/// One line per secondary node of every tie of the scene, in its order, RFC 4180.
std::string ties_csv(const Deck& deck, const Scene& scene, const TextDrain& drain = {});

// The interactive report of `deck gaps --html`: one self-contained HTML page with the viewer, the
// outer faces of the model and everything needed to evaluate other gap settings in the page.

struct CycleInput;  // report/shared/cycle.hpp
class LoadedDeck;   // deck/loaded_deck.hpp

/// The change of a penetrating node or edge since an earlier run.
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
  const GapBaseline* earlier = nullptr;
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
  /// Makes the page that of `deck parts --html`: parts with masses and steps come first, and the
  /// colours can show the steps of the elements. May be nullptr.
  const LoadedDeck* parts = nullptr;
  /// An earlier model: nodes that stand elsewhere now are listed, and the picture shows both. May
  /// be nullptr.
  const Model* before = nullptr;
  /// The JSON of a repair: repair_json() of report/shared/fix.hpp; may be empty.
  std::string_view repair;
  /// The JSON of a comparison: changes_json() of report/shared/inspection.hpp; may be empty.
  std::string_view changes;
  const char* verb = nullptr;  ///< "fix", "diff"; nullptr: gaps, cycle or parts
  const std::vector<Crossing>* crossings = nullptr;  ///< of the same scene; may be nullptr
  int threads = 1;
};

/// True if the viewer was built in (npm was there at build time); if not, why in `reason`.
bool html_available(std::string* reason = nullptr);

/// The nodes with contact forces that the page shows: all, in the order of the mesh; if there are
/// more than 100 000, those with the largest forces, the largest first.
std::vector<cycle::ActedNode> acted_in_page(const cycle::State& state,
                                            const cycle::SceneOutcome& outcome);

/// The page: of `deck gaps`, of `deck cycle` where `effects` is given, of `deck parts` where
/// `parts` is given. Error (config): the viewer was not built in.
Result<std::string> gaps_html(const HtmlInput& input);

/// A matrix of the parts that touch, as the page draws it for the deck's settings: the number of
/// interfaces through which two parts come near each other, red where they penetrate. SVG; needs no
/// viewer.
std::string touches_svg(const HtmlInput& input);

}  // namespace deck
