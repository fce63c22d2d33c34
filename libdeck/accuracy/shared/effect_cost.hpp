// Cost of every effect of a contact on a deck: the pair loop of the card, timed against the loop of
// a card that differs in this effect only, over the same pairs.
// Example: for (const ContactCost& c : measure_effects(scene, state, outcome, {}))
// print(c.loop_ns);
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "deck/cycle.hpp"

namespace deck {

/// One effect of a contact: loop with it against loop without it.
struct EffectCost {
  std::string name;              ///< as in cycle::EffectState
  bool on = false;               ///< the card asks for it
  std::string other;             ///< values of the other card, such as "VISs = 0"
  std::string why_not;           ///< reason why there is no figure; empty if there is one
  double ns = 0.0;               ///< added time: median over the repeats, nanoseconds per pair
  double low = 0.0, high = 0.0;  ///< its quartiles; a range with 0 means no measurable cost
  /// Largest change of a pair force by it, relative to the largest pair force.
  double change = 0.0;
};

/// The pair loop of one contact.
struct ContactCost {
  std::size_t pairs = 0, measured = 0;  ///< within reach; the first `measured` are timed
  /// Pairs in reach of contacts with equal effects, for which this one was timed.
  std::size_t alike = 0;
  /// If too few pairs are within their gap: extra search distance. Such pairs run through the loop
  /// without force.
  double margin = 0.0;
  double loop_ns = 0.0;   ///< loop of the card, nanoseconds of processor time per pair
  double flags_ns = 0.0;  ///< the generic kernel with equal effects
  double all_ns = 0.0;    ///< with every effect that this kind of contact can have at once
  std::string all;        ///< its additional values on the card
  std::string problem;    ///< reason why nothing was timed; empty if it was
  std::vector<EffectCost> effects;  ///< in the order of the account of the contact
};

struct EffectCostOptions {
  int repeats = 7;  ///< timings of each loop, in turn with the loop it is compared with
  std::size_t most_pairs = 16384;  ///< timed per contact
  std::size_t least_pairs = 100;   ///< of a contact: fewer give unreliable times
  double least_ns = 2e5;           ///< per timing: short loops run repeatedly
  /// Time each contact; false: of contacts with equal effects only the one with most pairs in
  /// reach.
  bool every = true;
};

/// Removes an effect, one of removable_effects(), from a card. False: the card does not have it and
/// is unchanged.
bool remove_effect(const std::string& name, cycle::ContactCard& card);
/// Names of removable effects and groups of them ("friction", "heat").
[[nodiscard]] std::vector<std::string> removable_effects();

/// Times the loops of all contacts of a scene on this thread, without search, gathering and sums at
/// nodes. Requires equal answers: bit for bit those of the generic kernel before timing, and those
/// of the first run after timing. `outcome`: result of run_cycle for this scene, state and options.
[[nodiscard]] std::vector<ContactCost> measure_effects(const Scene& scene,
                                                       const cycle::State& state,
                                                       const cycle::SceneOutcome& outcome,
                                                       const cycle::CycleOptions& options,
                                                       const EffectCostOptions& how = {});

}  // namespace deck
