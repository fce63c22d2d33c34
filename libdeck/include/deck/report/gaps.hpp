// Reports of the geometry stage: gaps, stiffness, initial penetrations and what the solver does
// about them, as text for people, JSON and CSV. Pure functions from a scene to bytes.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "deck/contact/crossings.hpp"
#include "deck/contact/view.hpp"
#include "deck/keyword/deck.hpp"
#include "deck/text/result.hpp"

namespace deck {

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

/// Of the document of `deck gaps --json`: since 2 ties stand apart from penetrations.
inline constexpr int gaps_version = 2;

/// The document of `deck gaps --json`. With `all`, every secondary node and main segment; with
/// `crossings`, what find_crossings gave for the scene.
std::string gaps_json(std::string_view path, const Deck& deck, const Scene& scene,
                      const SceneView& view, bool all,
                      const std::vector<Crossing>* crossings = nullptr,
                      const GateReport* gate = nullptr, const TextDrain& drain = {});

/// Crossed elements by part pair.
std::string crossings_text(const Scene& scene, const std::vector<Crossing>& crossings,
                           const GapsTextOptions& options = {});

/// Reads the document that `deck gaps --json` wrote; of a list of decks the one called `deck_path`,
/// else the first. Error: no such document, with what was expected; or one of a deck of which an
/// include was missing (Error::Code::io).
Result<EarlierGaps> read_earlier_gaps(std::string path, std::string_view json,
                                      std::string_view deck_path);

/// One line per penetration, ties left out, deepest first, RFC 4180.
std::string gaps_csv(const Deck& deck, const Scene& scene, const SceneView& view,
                     const TextDrain& drain = {});
/// One line per secondary node of every tie of the scene, in its order, RFC 4180.
std::string ties_csv(const Deck& deck, const Scene& scene, const TextDrain& drain = {});

}  // namespace deck
