// Several force evaluations in a row on a mesh that moves as told, with all that contacts remember
// from one to the next. There is no structure: contact forces move nothing.
// Example: auto r = run_steps(scene, make_state(scene), options, 50);
#pragma once
#include <functional>
#include <vector>

#include "deck/cycle/scene_cycle.hpp"

namespace deck::cycle {

/// One contact in one step.
struct StepContact {
  bool active = true;
  std::size_t pairs_with_force = 0, pairs_tied = 0;
  std::size_t removed = 0;  ///< secondary nodes or edges that have left the interface so far
  std::array<double, 3> normal{}, tangential{};
  double force_sum = 0.0;  ///< of the sizes of the pair forces
  double elastic_energy = 0.0, friction_energy = 0.0, damping_energy = 0.0;
};

struct StepLine {
  double time = 0.0, dt1 = 0.0;
  std::vector<StepContact> contacts;  ///< parallel to Scene::contacts
};

/// Something that stays: what happened to a node, edge or pair, and when.
struct StepEvent {
  enum class Kind : std::uint8_t { removed, tied, let_go, released };
  std::size_t step = 0;  ///< from 0
  double time = 0.0;
  std::size_t contact = 0;  ///< position in Scene::contacts
  Kind kind = Kind::removed;
  CandidatePair at;  ///< removed: its secondary; tied, let_go: the pair
  Removal::Because because = Removal::Because::mid_surface;
  NodeRelease release;  ///< of Kind::released
};

struct StepsOutcome {
  SceneOutcome last;
  Coordinates coordinates;  ///< of the last step; empty: a single one without a motion
  std::vector<StepLine> lines;
  std::vector<StepEvent> events;  ///< in the order they happened
  std::size_t searches = 0;       ///< how often the pairs of a contact were searched
};

/// Puts the nodes where they are in a step and says how fast they are there; may set the times
/// (time, dt1, dt12) of the options.
using Motion = std::function<void(std::size_t step, Coordinates&, State&, CycleOptions&)>;
using StepWatch = std::function<void(std::size_t step, const SceneOutcome&, const Coordinates&)>;

/// Evaluates `steps` times. Without a motion nodes keep their velocities: step k is at
/// options.time + k dt1 with every node k dt1 v from the deck's place; the first step is what
/// run_cycle gives. What contacts remember: friction, filters, ties, gaps of Inacti 5 and 6, nodes
/// and edges that were removed (dtmin, mid-surface, Idel), released translations. Pairs are
/// searched again when the motion leaves what was searched. The result does not depend on the
/// number of threads.
[[nodiscard]] StepsOutcome run_steps(const Scene& scene, const State& state, CycleOptions options,
                                     std::size_t steps, const Motion& motion = {},
                                     const StepWatch& watch = {});

}  // namespace deck::cycle
