// One contact force evaluation of a whole deck: every contact of a scene at the deck's initial
// state, its forces, energies and time step, and the sums at the nodes.
// Example: auto r = run_cycle(scene, make_state(scene), {});
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "deck/contact/scene.hpp"
#include "deck/cycle/adapter.hpp"
#include "deck/cycle/assemble.hpp"
#include "deck/cycle/kernel.hpp"
#include "deck/keyword/engine_file.hpp"

namespace deck::cycle {

/// A velocity to try: all nodes of the elements of one part.
struct PartVelocity {
  std::int64_t part = 0;  ///< id
  std::array<double, 3> velocity{};
};

/// The share of a stable step that the solver takes, of elements (unless the Engine file says
/// otherwise) and of nodes.
inline constexpr double step_scale = 0.9;

/// Smallest time step that the elements allow: nine tenths of what the mesh gives.
struct StructureStep {
  double dt = 1e30;
  ElementKind kind = ElementKind::shell4;
  std::uint32_t element = no_index;  ///< no_index: no element limits
};

/// One entry per node, working units.
struct State {
  std::array<std::vector<double>, 3> velocity;  ///< empty: the deck gives none, all are 0
  std::vector<double> mass;         ///< 0 where no element with density and no /ADMAS is
  std::vector<double> temperature;  ///< of /INITEMP, else of the material, else 0; empty: all are 0
  bool moving = false;              ///< some velocity is not 0
  bool heated = false;              ///< the deck gives a temperature to some node
  StructureStep structure;
  std::vector<std::string> not_evaluated;  ///< what the deck says about the state and was left out
};

/// Masses of elements and added masses, and the step of the structure, as model/shared/mesh.hpp
/// gives them. Velocities of /INIVEL TRA and T+G on node groups (a skew other than a fixed one is
/// noted as left out), then `velocities`, in order. Rotational initial velocities act on nodal
/// rotations and move no node. Temperatures of /INITEMP, elsewhere T0 of /HEAT/MAT. `engine`: the
/// Engine files beside the deck, some options of which change the step.
[[nodiscard]] State make_state(const Scene& scene, const std::vector<PartVelocity>& velocities = {},
                               const EngineFiles* engine = nullptr);

/// An element that is taken as gone from a time on, for Idel.
struct DeadElement {
  ElementKind kind = ElementKind::shell4;
  std::uint32_t element = no_index;
  double from = 0.0;
};

struct CycleOptions {
  Model model = Model::robust;
  double dt1 = 0.0;   ///< last step; 0: the very first evaluation
  double dt12 = 0.0;  ///< mid-step interval, for incremental friction
  double time = 0.0;  ///< decides Tstart, Tstop and sensors
  int threads = 1;
  bool keep_pairs = false;      ///< fill ContactOutcome::pairs
  double near_singular = 0.05;  ///< pairs with less than this share of their gap left are counted
  double margin = 0.0;  ///< search pairs this much further, so that the list lasts for some motion
  std::vector<DeadElement> dead;
  PlanOptions plan;
  std::function<void(ContactCard&)> change_card;  ///< what is evaluated instead of the deck's card
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

/// A secondary node or edge that leaves its interface for good, from the next evaluation on.
struct Removal {
  enum class Because : std::uint8_t {
    mid_surface,     ///< nothing was left of its gap
    kinematic_step,  ///< dtmin: half the time to the mid-surface; no force any more
    nodal_step,      ///< dtmin: contact stiffness against nodal mass; the force of this cycle stays
    no_element_left  ///< Idel: all its elements are gone
  };
  std::uint32_t secondary = 0;  ///< position in the contact's list
  Because because = Because::mid_surface;
};

/// A pair that ties, or lets go.
struct TieChange {
  CandidatePair at;
  bool tied = false;
};

/// IBC: fixed translations of a node, 4 X + 2 Y + Z, before and after.
struct NodeRelease {
  NodeIndex node = no_index;
  std::uint8_t before = 0, after = 0;
};

/// Iadm: what adaptive meshing asks of a node.
struct NodeCriteria {
  NodeIndex node = no_index;
  double radius = 1e30;      ///< smallest radius of curvature of its segments
  double penetration = 0.0;  ///< Iadm 2, secondary side: deepest, over Padm times the gap
  double angle = 1e30;       ///< Iadm 2, secondary side: smallest cosine over that of Angladm
};

/// What one contact does.
struct ContactOutcome {
  const deck::Contact* contact = nullptr;
  ContactCard card;
  std::vector<EffectState> effects;
  std::string composition, isa;
  bool active = true;    ///< false: outside its time window or before its sensor
  bool complete = true;  ///< false: nothing was evaluated (too many pairs, values out of range)
  /// Not complete although its type has forces: what it does is open.
  bool undecided() const { return !complete && !is_modern(contact->type); }
  std::size_t pairs_in_reach = 0;
  std::size_t pairs_with_force = 0;
  /// In reach, but without a force: off since start-up, removed, or switched off in this cycle.
  std::size_t pairs_switched_off = 0;
  std::size_t pairs_tied = 0;
  std::vector<Removal> removed;        ///< who leaves the interface after this evaluation
  std::vector<TieChange> ties;         ///< pairs that tie or let go in it
  std::vector<NodeRelease> released;   ///< fixed translations that IBC frees in it
  std::vector<NodeCriteria> criteria;  ///< with Iadm only, by node
  Totals totals;                       ///< totals.dt_kinematic_pair is a position in the search
  double heat_secondary = 0.0, heat_main = 0.0;  ///< energy given to each side in this cycle
  /// Its own; index is a node index of the model (kinematic: of that pair). Of the contacts of a
  /// TYPE19 that stiffen one node, the one that does so most has the step of them together.
  StepLimit step;
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

/// Evaluations in a row, each from what the contacts remember of the one before.
class CycleRun {
 public:
  /// The scene must outlive it and be built with penetrations and nodal stiffness. `remember`: more
  /// than one evaluation is wanted.
  explicit CycleRun(const Scene& scene, bool remember = true);
  ~CycleRun();
  CycleRun(const CycleRun&) = delete;
  CycleRun& operator=(const CycleRun&) = delete;
  /// With the nodes at `x`; areas and widths for heat stay those of the scene. The model must be
  /// the same in every call.
  [[nodiscard]] SceneOutcome evaluate(const Coordinates& x, const State& state,
                                      const CycleOptions& options);
  /// How often the pairs of a contact were searched.
  [[nodiscard]] std::size_t searches() const;

 private:
  struct Memory;
  const Scene* scene_;
  bool remember_;
  std::unique_ptr<Memory> memory_;
};

/// Evaluates all contacts of a scene that was built with penetrations and nodal stiffness. The
/// result does not depend on the number of threads.
[[nodiscard]] SceneOutcome run_cycle(const Scene& scene, const State& state,
                                     const CycleOptions& options = {});

/// A node that some contact pushes or stiffens.
struct ActedNode {
  NodeIndex node = no_index;
  std::array<double, 3> force{};  ///< on the node, of all contacts
  double stiffness = 0.0;         ///< given by all contacts
  double dt = 1e30;  ///< 0.9 sqrt(2 m / stiffness); 1e30 without mass or stiffness: no limit
};
/// In the order of nodes. The state must be that of the outcome.
[[nodiscard]] std::vector<ActedNode> acted_nodes(const State& state, const SceneOutcome& outcome);

/// What contacts of one interface do together.
struct InterfaceSummary {
  std::int64_t id = 0;
  const InterBase* inter = nullptr;
  bool active = false;  ///< one of them at least
  std::size_t pairs_in_reach = 0, pairs_with_force = 0;
  double largest_pair_force = 0.0;
  double force_sum = 0.0;  ///< of the sizes of the pair forces
  double elastic_energy = 0.0, friction_energy = 0.0, damping_energy = 0.0;
  double largest_acceleration = 0.0;
  NodeIndex acceleration_node = no_index;
  double contact_dt = 1e30, structure_dt = 1e30;
  StepLimit::Source contact_dt_source = StepLimit::Source::none;
  NodeIndex contact_dt_node = no_index;
  std::size_t gap_closed = 0, near_singular = 0;
};
/// Of these contacts, which are of one interface; the one sum that every message and table shows.
[[nodiscard]] InterfaceSummary summarize(const std::vector<const ContactOutcome*>& contacts,
                                         const StructureStep& structure);
/// Of every interface, in the solver's order; interfaces that the scene does not hold are left out.
[[nodiscard]] std::vector<InterfaceSummary> summarize(const Scene& scene,
                                                      const SceneOutcome& outcome);

}  // namespace deck::cycle
