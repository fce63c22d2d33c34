// Reports of the force stage: the one-cycle contact check, as text for people and JSON. Pure
// functions from results to bytes.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/shared/effect_cost.hpp"
#include "deck/cycle/steps.hpp"
#include "deck/keyword/deck.hpp"
#include "deck/model/interfaces.hpp"
#include "deck/report/gaps.hpp"
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
  /// The same without costs of single effects, for the sentence that is always said.
  const std::vector<ContactCost>* loops = nullptr;
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
  std::string not_edges;      ///< on, but not in the edge part of a TYPE19: why
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

/// True if an evaluation has enough pairs in reach for times per pair.
bool enough_pairs_to_time(const cycle::SceneOutcome& outcome);

/// The document of `deck cycle --json` (schemas/output/cycle.schema.json). With `all`, every pair
/// that has a penetration, and every node that contact acts on.
std::string cycle_json(const CycleInput& input, bool all, const TextDrain& drain = {});
/// Table of interfaces, time steps, pairs near the gap singularity, effects, where round-off
/// decides about a contact; then the verdict, and the gate.
std::string cycle_text(const CycleInput& input, const CycleTextOptions& options = {});
/// What is said of the deck with its forces.
Verdict cycle_verdict(const CycleInput& input);

/// Two files, always; the outcome must have kept its pairs:
///
/// * contact_pairs.vtp: a vertex per pair with a penetration or force, at the secondary node
/// (edges:
///   at the point of contact). Point data force (vector, on the secondary side), force_size,
///   normal_force (negative pushes apart), penetration, gap (after Inacti), distance, left_of_gap
///   (share), k0, k_nodal, status (bits of cycle::Status), interface, role (0 primary, 1 reversed,
///   2 edges), node, node2 (second end of an edge, else 0), main_element, main_part.
/// * contact_nodes.vtp: a vertex per node that any contact acts on. Point data force (vector, of
/// all
///   contacts), force_size, acceleration and dt (0 without mass), stiffness, mass, heat, removed
///   (1: leaves its interface), node.
///
/// Coordinates are those that were evaluated, in working units. Nodes also carry released (bits of
/// the translations that IBC frees, 4 X + 2 Y + Z) and the figures of Iadm: radius (0: none),
/// relative_penetration and angle. A `suffix` such as "_0003" makes files of a series.
std::vector<VtkFile> cycle_vtk(const CycleInput& input, const std::string& suffix = {});

/// The two collections that put a series in time: contact_pairs.pvd and contact_nodes.pvd.
std::vector<VtkFile> cycle_vtk_series(const cycle::StepsOutcome& steps,
                                      const std::vector<std::string>& suffixes);

/// Why a node or edge leaves the interface.
const char* to_string(cycle::Removal::Because because);

}  // namespace deck
