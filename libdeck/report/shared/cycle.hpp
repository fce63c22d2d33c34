// Reports of the force stage: the one-cycle contact check, as text for people and JSON. Pure
// functions from results to bytes.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/shared/effect_cost.hpp"
#include "deck/cycle.hpp"
#include "deck/keyword.hpp"
#include "deck/model.hpp"
#include "deck/report.hpp"
#include "deck/verdict.hpp"
#include "report/shared/vtk.hpp"

namespace deck {

struct GateReport;  // report/shared/gate.hpp

/// One force evaluation and what it was about.
struct CycleInput {
  std::string_view path;  ///< of the deck, as given
  const Deck* deck = nullptr;
  const Scene* scene = nullptr;
  const cycle::State* state = nullptr;
  const cycle::SceneOutcome* outcome = nullptr;
  cycle::CycleOptions options;
  const cycle::StepsOutcome* steps = nullptr;  ///< of several steps; `outcome` is then the last
  const Coordinates* coordinates = nullptr;  ///< where the outcome was computed; null: the scene's
  const SceneView* view = nullptr;           ///< of the scene
  const GateReport* gate = nullptr;
  /// Of measure_effects over the same outcome, contact by contact; null: not measured.
  const std::vector<ContactCost>* costs = nullptr;
  /// The same evaluation without an effect, and its name; null: not asked for.
  const cycle::SceneOutcome* without = nullptr;
  std::string without_effect;
  int cost_repeats = 0;   ///< timings of each loop
  std::string processor;  ///< that measured
};

/// An effect of an interface: on where any of its parts has it on; `because` names the deciding
/// field with its value and line.
struct EffectLine {
  std::string name;
  bool on = false;
  std::string because;
  std::string field, reason;  ///< as in cycle::EffectState
  Span span;                  ///< the deciding cell; may be invalid
};
std::vector<EffectLine> effect_lines(const Deck& deck, const cycle::SceneOutcome& outcome,
                                     const InterBase& inter);

struct CycleTextOptions {
  bool color = false;
  bool effects = false;  ///< effects against interfaces, and why some do not run
  /// Interfaces without a pair in reach, too, each contact of an interface in a row of its own, and
  /// more columns.
  bool verbose = false;
  bool several = false;   ///< decks in the call: the text names this one
  std::size_t width = 0;  ///< columns of a line of a table; 0: any
};

/// The document of `deck cycle --json` (schemas/output/cycle.schema.json). With `all`, every pair
/// that has a penetration, and every node that contact acts on.
std::string cycle_json(const CycleInput& input, bool all, const TextDrain& drain = {});
/// Table of interfaces, time steps, pairs near the gap singularity, effects, where round-off
/// decides about a contact; then the verdict, and the gate.
std::string cycle_text(const CycleInput& input, const CycleTextOptions& options = {});
/// What is said of the deck with its forces.
Verdict cycle_verdict(const CycleInput& input);

/// Why a node or edge leaves the interface.
const char* to_string(cycle::Removal::Because because);

// ---- what effects cost, as pieces of the reports around it -----------------------------------

/// The loops of all contacts that were timed, by pairs.
struct CostSummary {
  std::size_t contacts = 0;       ///< timed
  std::size_t pairs = 0;          ///< of these
  std::size_t wider = 0;          ///< contacts whose pairs are further apart than their gap
  std::size_t on = 0, known = 0;  ///< effects that some interface asks for, and all that there are
  double loop_ns = 0, flags_ns = 0, all_ns = 0;  ///< per pair; all_ns 0: no such loop anywhere
};
CostSummary summarize_costs(const CycleInput& input);

/// "Only what this deck asks for runs: 7 of 29 effects.", with times where they were measured.
std::string cost_sentence(const CycleInput& input);

/// What an effect is over all interfaces, and what it costs; those that run first, the dearest of
/// each first.
struct EffectSum {
  std::string name;
  bool on = false;             ///< some interface asks for it
  std::string because;         ///< of the first interface
  std::size_t in = 0, of = 0;  ///< interfaces where it runs, and that can have it
  /// Of the contacts with at least a hundred pairs that were timed, by their pairs.
  std::size_t pairs = 0;
  std::string against = {};                      ///< as EffectCost::other
  double ns = 0, low = 0, high = 0, change = 0;  ///< as in EffectCost
};
std::vector<EffectSum> effect_sums(const CycleInput& input);
/// What runs and what does not, with times where they were measured.
std::string effects_text(const CycleInput& input, const CycleTextOptions& options);
/// The tables of the page for readers without scripts.
std::string cost_html(const CycleInput& input);

}  // namespace deck
