// What every effect of a contact costs on the deck at hand: the pair loop that the card asks for,
// timed against the loop of a card that differs in that effect alone, over the same pairs.
// Example: for (const ContactCost& c : measure_effects(scene, state, outcome, {}))
// print(c.loop_ns);
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "deck/cycle.hpp"

namespace deck {

/// One effect of a contact: with it against without it, whichever of both the card asks for.
struct EffectCost {
  std::string name;     ///< as in cycle::EffectState
  bool on = false;      ///< the card asks for it
  std::string other;    ///< what the card of the loop that it is held against says, e.g. "VISs = 0"
  std::string why_not;  ///< why there is no figure; empty: there is one
  double ns = 0.0;      ///< median over the repeats of what it adds, nanoseconds per pair
  double low = 0.0, high = 0.0;  ///< quartiles of the same: a range with 0 in it tells nothing
  /// Largest difference of a pair force that it makes here, over the largest pair force.
  double change = 0.0;
};

/// The pair loop of one contact.
struct ContactCost {
  std::size_t contact = 0;              ///< position in Scene::contacts
  std::size_t pairs = 0, measured = 0;  ///< in reach of the search; the first of them are timed
  /// Where no pair is nearer than its gap: how much further pairs were looked for. They go through
  /// the same loop; nothing pushes.
  double margin = 0.0;
  double loop_ns = 0.0;   ///< as the card asks for it, nanoseconds of processor time per pair
  double flags_ns = 0.0;  ///< the same effects asked for by flags inside the loop
  double all_ns = 0.0;    ///< every effect that this kind of contact has and can have together
  std::string all;        ///< what the card of that loop says in addition
  std::string problem;    ///< why nothing was timed; empty: it was
  std::vector<EffectCost> effects;  ///< in the order of the account of the contact
};

struct EffectCostOptions {
  int repeats = 7;  ///< timings of each loop, in turn with the one it is held against
  std::size_t most_pairs = 16384;  ///< timed per contact
  double least_ns = 2e5;           ///< of one timing: short loops run more than once in it
};

/// Takes an effect away from a card that asks for it: one of effects_to_take(). False: the card
/// does not ask for it, and is unchanged.
bool take_effect(const std::string& name, cycle::ContactCard& card);
/// Names of effects that can be taken away, and of groups of them ("friction", "heat").
[[nodiscard]] std::vector<std::string> effects_to_take();

/// Times the loops of all contacts of a scene on this thread, one after the other, with everything
/// else of an evaluation (search, gathering, sums at nodes) left out. No time before the answers
/// agree: every loop must give, bit for bit, what it gives with its effects asked for by flags, and
/// after the timings what it gave before. `outcome` is what run_cycle made of the same scene, state
/// and options.
[[nodiscard]] std::vector<ContactCost> measure_effects(const Scene& scene,
                                                       const cycle::State& state,
                                                       const cycle::SceneOutcome& outcome,
                                                       const cycle::CycleOptions& options,
                                                       const EffectCostOptions& how = {});

}  // namespace deck
