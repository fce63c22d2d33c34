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

// Reports of contacts as plain text, JSON and CSV: gaps, stiffness, initial penetrations and the
// solver's action on each. The functions depend on their arguments only.

/// Writes `text` and clears it. A report function with a TextDrain calls it between rows and
/// returns the rest; with an empty TextDrain it returns the whole document.
using TextDrain = std::function<void(std::string& text)>;

/// Drains `text` once it exceeds 1 MiB.
inline void drain_text(const TextDrain& drain, std::string& text) {
  constexpr std::size_t enough = std::size_t{1} << 20;
  if (drain && text.size() >= enough) drain(text);
}

struct GateReport;  // report/shared/gate.hpp

struct GapsTextOptions {
  std::size_t worst = 20;       ///< rows of the worst list
  std::size_t part_pairs = 10;  ///< rows of the part-pair table
  bool color = false;
  /// Also lists interfaces without penetrations, one row per contact, and describes their sides.
  bool verbose = false;
  std::size_t width = 0;  ///< maximal width of a table line in columns; 0: no limit
  std::string name;       ///< name of the deck if there are several
  const std::vector<Crossing>* crossings = nullptr;  ///< also list these
  const GateReport* gate = nullptr;
};

/// Table of interfaces, part pairs, worst list, crossed elements, pairs that round-off decides,
/// verdict and gate.
std::string gaps_text(const Deck& deck, const Scene& scene, const SceneView& view,
                      const GapsTextOptions& options = {});

/// The document of `deck gaps --json`. `all` adds every secondary node and main segment.
/// `crossings` is the result of find_crossings for this scene.
std::string gaps_json(std::string_view path, const Deck& deck, const Scene& scene,
                      const SceneView& view, bool all,
                      const std::vector<Crossing>* crossings = nullptr,
                      const GateReport* gate = nullptr, const TextDrain& drain = {});

/// Table of crossed elements by part pair.
std::string crossings_text(const Scene& scene, const std::vector<Crossing>& crossings,
                           const GapsTextOptions& options = {});

/// One line per penetration (no ties), deepest first. RFC 4180.
std::string gaps_csv(const Deck& deck, const Scene& scene, const SceneView& view,
                     const TextDrain& drain = {});
/// One line per secondary node of every tie, in the order of the scene. RFC 4180.
std::string ties_csv(const Deck& deck, const Scene& scene, const TextDrain& drain = {});

// The interactive report of `deck gaps --html`: one HTML file with viewer, outer faces of the model
// and all data needed to evaluate other gap settings in the browser.

struct CycleInput;  // report/shared/cycle.hpp
class LoadedDeck;   // deck/loaded_deck.hpp

/// The change of a penetrating node or edge since an earlier run.
struct PageTrend {
  std::int64_t interface_id = 0;            ///< solved penetrations: the id in the earlier run
  std::string role;                         ///< "primary", "reversed", "edges"
  std::array<std::int64_t, 2> secondary{};  ///< node (second 0) or the two nodes of an edge
  double depth = 0, gap = 0;  ///< values of the earlier run; 0 if the penetration is new
  const char* trend = "";     ///< "new", "worse", "same", "better", "solved"
};

struct HtmlInput {
  std::string_view path;  ///< of the deck, as given
  const Deck* deck = nullptr;
  const Scene* scene = nullptr;
  const SceneView* view = nullptr;
  std::vector<WhatIf> what_if;     ///< settings that the scene was built with
  std::vector<std::int64_t> only;  ///< SceneOptions::only of the scene
  const GapBaseline* earlier = nullptr;
  /// Comparison with `earlier`; nullptr: the result of compare_gaps.
  const std::vector<PageTrend>* trends = nullptr;
  /// First cycle with CycleOptions::keep_pairs; nodal sums are not used. May be nullptr.
  const cycle::SceneOutcome* cycle = nullptr;
  std::vector<cycle::ActedNode> acted;  ///< acted_in_page() of `cycle`
  /// Makes the page of `deck cycle --html`: adds the document of `deck cycle --json`; effects and
  /// their cost come first. May be nullptr.
  const CycleInput* effects = nullptr;
  /// Makes the page of `deck parts --html`: masses and time steps of the parts come first (document
  /// of `deck parts --json`), and elements can be coloured by time step. May be nullptr.
  const LoadedDeck* parts = nullptr;
  /// An earlier model: the page lists nodes that moved and draws both positions. May be nullptr.
  const Model* before = nullptr;
  /// The JSON of a repair: repair_json() in report/shared/fix.hpp. May be empty.
  std::string_view repair;
  /// The JSON of a comparison: changes_json() in report/shared/inspection.hpp. May be empty.
  std::string_view changes;
  const char* verb = nullptr;  ///< "fix", "diff"; nullptr: gaps, cycle or parts
  const std::vector<Crossing>* crossings = nullptr;  ///< of the same scene; may be nullptr
  int threads = 1;
};

/// True if the build included the viewer (it needs npm); otherwise `reason` says why not.
bool html_available(std::string* reason = nullptr);

/// The nodes with contact forces that the page shows, in mesh order. Above 100 000 nodes: those
/// with the largest forces, largest first.
std::vector<cycle::ActedNode> acted_in_page(const cycle::State& state,
                                            const cycle::SceneOutcome& outcome);

/// The page of `deck cycle` if `effects` is set, of `deck parts` if `parts` is set, else of `deck
/// gaps`. Error (config): the build has no viewer.
Result<std::string> gaps_html(const HtmlInput& input);

/// SVG matrix of parts: the number of interfaces through which two parts come within the gap; red
/// if they penetrate. Drawn as in the page for the settings of the deck; works without the viewer.
std::string touches_svg(const HtmlInput& input);

}  // namespace deck
