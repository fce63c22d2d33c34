// One contact force evaluation of a whole deck: every contact of a scene at the deck's initial
// state, its forces, energies and time step, and the sums at the nodes.
// Example: auto r = run_cycle(scene, make_state(scene), {});
#ifndef DECK_CYCLE_SCENE_CYCLE_HPP_
#define DECK_CYCLE_SCENE_CYCLE_HPP_

#include <functional>
#include <string>
#include <vector>

#include "deck/cycle/adapter.hpp"
#include "deck/cycle/kernel.hpp"
#include "deck/cycle/state.hpp"

namespace deck::cycle {

struct CycleOptions {
  Model model = Model::robust;
  double dt1 = 0.0;   ///< last step; 0: the very first evaluation
  double dt12 = 0.0;  ///< mid-step interval, for incremental friction
  double time = 0.0;  ///< decides Tstart, Tstop and sensors
  int threads = 1;
  bool keep_pairs = false;      ///< fill ContactOutcome::pairs
  double near_singular = 0.05;  ///< pairs with less than this share of their gap left are counted
  PlanOptions plan;
  /// Called with (contacts done, contacts in all); may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// One evaluated pair that has a penetration or a force.
struct PairOutcome {
  CandidatePair at;  ///< positions in the contact's lists
  std::array<double, 4> weights{};
  std::array<double, 3> force{};  ///< on the main side; the secondary side gets the opposite
  double normal_force = 0.0;      ///< signed, negative repels
  double penetration = 0.0, gap = 0.0, distance = 0.0;  ///< effective, after Inacti
  double k0 = 0.0, k_nodal = 0.0;
  std::int64_t status = 0;  ///< bits of Status
};

/// What one contact does.
struct ContactOutcome {
  const deck::Contact* contact = nullptr;
  ContactCard card;
  std::vector<EffectState> effects;
  std::string composition, isa;
  bool active = true;    ///< false: outside its time window or before its sensor
  bool complete = true;  ///< false: nothing was evaluated (too many pairs, values out of range)
  std::size_t pairs_in_reach = 0;
  std::size_t pairs_with_force = 0;
  std::size_t pairs_switched_off = 0;  ///< in reach, without stiffness
  Totals totals;                       ///< totals.dt_kinematic_pair is a position in the search
  double heat_secondary = 0.0, heat_main = 0.0;  ///< energy given to each side in this cycle
  StepLimit step;  ///< its own; index is a node index of the model (kinematic: of that pair)
  NodeIndex step_node = no_index;
  double largest_force = 0.0;  ///< of one pair
  PairOutcome largest;
  double largest_acceleration = 0.0;
  NodeIndex acceleration_node = no_index;
  std::size_t massless_nodes = 0;  ///< nodes with a force but without mass
  std::size_t gap_closed = 0;      ///< pairs at their mid-surface: the reference drops the node
  std::vector<PairOutcome> near_singular;  ///< closest to it first, at most 20
  std::size_t near_singular_count = 0;
  std::vector<std::string> notes;  ///< what the card asks for and was left out
  std::vector<PairOutcome> pairs;  ///< in the order of the search; with keep_pairs
};

struct SceneOutcome {
  std::vector<ContactOutcome> contacts;  ///< parallel to Scene::contacts
  NodalSums nodes;                       ///< sums over all contacts
  double largest_nodal_force = 0.0;
  NodeIndex force_node = no_index;
  double contact_dt = 1e30;  ///< of all contacts together
  StepLimit::Source contact_dt_source = StepLimit::Source::none;
  std::size_t limiting_contact = SIZE_MAX;  ///< position in `contacts`
  NodeIndex limiting_node = no_index;
  StructureStep structure;
};

/// Evaluates all contacts of a scene that was built with penetrations and nodal stiffness. The
/// result does not depend on the number of threads.
[[nodiscard]] SceneOutcome run_cycle(const Scene& scene, const State& state,
                                     const CycleOptions& options = {});

/// What lint rules want to know about an interface before the run: its parts together.
struct InterfaceSummary {
  std::int64_t id = 0;
  const InterBase* inter = nullptr;
  bool active = true;
  std::size_t pairs_with_force = 0;
  double largest_pair_force = 0.0;
  double force_sum = 0.0;  ///< of the sizes of the pair forces
  double elastic_energy = 0.0;
  double largest_acceleration = 0.0;
  NodeIndex acceleration_node = no_index;
  double contact_dt = 1e30, structure_dt = 1e30;
  StepLimit::Source contact_dt_source = StepLimit::Source::none;
  NodeIndex contact_dt_node = no_index;
  std::size_t gap_closed = 0, near_singular = 0;
};
/// In deck order; interfaces that the scene does not hold are left out.
[[nodiscard]] std::vector<InterfaceSummary> summarize(const Scene& scene,
                                                      const SceneOutcome& outcome);

}  // namespace deck::cycle

#endif  // DECK_CYCLE_SCENE_CYCLE_HPP_
