// Reports of the force stage, the one-cycle contact check, as text and JSON.
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

/// One force evaluation with its input.
struct CycleInput {
  std::string_view path;  ///< of the deck, as given
  const Deck* deck = nullptr;
  const Scene* scene = nullptr;
  const cycle::State* state = nullptr;
  const cycle::SceneOutcome* outcome = nullptr;
  cycle::CycleOptions options;
  const cycle::StepsOutcome* steps = nullptr;  ///< of several steps; `outcome` is then the last one
  const Coordinates* coordinates = nullptr;    ///< positions of the outcome; null: the scene's
  const SceneView* view = nullptr;             ///< of the scene
  const GateReport* gate = nullptr;
  /// From measure_effects for this outcome, contact by contact; null: not measured.
  const std::vector<ContactCost>* costs = nullptr;
  /// The evaluation without one effect, and its name; null: not wanted.
  const cycle::SceneOutcome* without = nullptr;
  std::string without_effect;
  int cost_repeats = 0;   ///< timings of each loop
  std::string processor;  ///< measuring processor
};

/// An effect of an interface: on if any of its parts has it on; `because`: deciding field with
/// value and line.
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
  bool effects = false;  ///< table of effects by interface, and reasons of inactive ones
  /// Also interfaces without pairs in reach, a row per contact, and more columns.
  bool verbose = false;
  bool several = false;   ///< several decks in the call: name this one
  std::size_t width = 0;  ///< columns of a line of a table; 0: any
};

/// Document of `deck cycle --json` (schemas/output/cycle.schema.json). `all`: every pair with a
/// penetration, and every node with a contact force.
std::string cycle_json(const CycleInput& input, bool all, const TextDrain& drain = {});
/// Table of interfaces, time steps, pairs near the gap singularity, effects, decisions by
/// round-off; then verdict and gate.
std::string cycle_text(const CycleInput& input, const CycleTextOptions& options = {});
/// Verdict on the deck with its forces.
Verdict cycle_verdict(const CycleInput& input);

/// Reason why a node or edge leaves the interface.
const char* to_string(cycle::Removal::Because because);

// ---- cost of effects, as parts of other reports -----------------------------------------------

/// Sum over the timed loops of all contacts, weighted by pairs.
struct CostSummary {
  std::size_t contacts = 0;                      ///< timed
  std::size_t pairs = 0;                         ///< in timed contacts and those they stand for
  std::size_t wider = 0;                         ///< timed with pairs beyond their gap
  std::size_t on = 0, known = 0;                 ///< effects of some interface, and all effects
  double loop_ns = 0, flags_ns = 0, all_ns = 0;  ///< per pair; all_ns 0: not available
};
CostSummary summarize_costs(const CycleInput& input);

/// "Only what this deck asks for runs: 7 of 29 effects.", with times if measured.
std::string cost_sentence(const CycleInput& input);

/// An effect over all interfaces, with its cost; active ones first, then by cost.
struct EffectSum {
  std::string name;
  bool on = false;             ///< some interface asks for it
  std::string because;         ///< of the first interface
  std::size_t in = 0, of = 0;  ///< interfaces with it active, and able to have it
  /// Over timed contacts and those they stand for, weighted by pairs.
  std::size_t pairs = 0;
  std::string against = {};                      ///< as EffectCost::other
  double ns = 0, low = 0, high = 0, change = 0;  ///< as in EffectCost
};
std::vector<EffectSum> effect_sums(const CycleInput& input);
/// Active and inactive effects, with times if measured.
std::string effects_text(const CycleInput& input, const CycleTextOptions& options);
/// Tables of the page for readers without scripts.
std::string cost_html(const CycleInput& input);

}  // namespace deck
