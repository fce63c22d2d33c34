// First cycle: pair kernels and their arrays, nodal sums, the first cycle of a scene, steps with
// prescribed motion. Over 600 lines: one public header has the whole concept.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/keyword.hpp"

namespace deck::cycle {

// A packet of contact pairs as structure of arrays: the input and the output of the kernel.

/// Groups of arrays, as bits: what an effect needs, what it writes.
enum class Field : std::uint32_t {
  none = 0,
  position = 1u << 0,
  velocity = 1u << 1,
  mass_secondary = 1u << 2,
  mass_main = 1u << 3,
  stiffness = 1u << 4,
  gap = 1u << 5,
  residual_penetration = 1u << 6,
  friction_memory = 1u << 7,
  tie_record = 1u << 8,
  temperature = 1u << 9,
  contact_area = 1u << 10,
  conductivity = 1u << 11,
  pair_friction = 1u << 12,
  nodal_normals = 1u << 13,
  step_times = 1u << 14,
  // Results.
  force = 1u << 16,
  nodal_stiffness = 1u << 17,
  weights = 1u << 18,
  elastic_energy = 1u << 19,
  friction_energy = 1u << 20,
  damping_energy = 1u << 21,
  heat = 1u << 22,
  kinematic_step = 1u << 23,
  status = 1u << 24,
  criteria = 1u << 25,
};
constexpr Field operator|(Field a, Field b) {
  return static_cast<Field>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr Field operator&(Field a, Field b) {
  return static_cast<Field>(static_cast<std::uint32_t>(a) & static_cast<std::uint32_t>(b));
}
constexpr Field& operator|=(Field& a, Field b) { return a = a | b; }
constexpr bool contains(Field set, Field part) { return (set & part) == part; }

/// f(arrays...) for each array of one or more structures of arrays, side by side.
template <class F, class First, class... Others>
void each_of(const F& f, First& first, Others&... others) {
  if constexpr (requires { std::tuple_size<std::remove_const_t<First>>::value; }) {
    for (std::size_t k = 0; k < first.size(); ++k) each_of(f, first[k], others[k]...);
  } else {
    f(first, others...);
  }
}

/// The data of n pairs, arrays of n entries each: pointers where a kernel reads them, vectors where
/// they are made. Roles of a node–segment pair: 0 the secondary node, 1..4 the
/// corners of the segment (a triangle repeats corner 3). Roles of an edge–edge pair: 0, 1 the
/// secondary edge, 2, 3 the main edge.
template <class Array>
struct PairArrays {
  std::array<std::array<Array, 3>, 5> position{};
  std::array<std::array<Array, 3>, 5> velocity{};
  std::array<Array, 5> mass{};

  Array k0{};   ///< pair stiffness before the 1/2 of the law; 0: switched off at start-up
  Array gap{};  ///< pair gap
  Array p0{};   ///< Inacti 5, 6: residual penetration (edges: sum of both sides')
  std::array<Array, 3> ft_old{};
  std::array<Array, 8> tie{};  ///< Fn Ft1 Ft2 H1 H2 H3 [p side]; TYPE10 has six

  std::array<Array, 5> temperature{};
  Array area{};                              ///< secondary contact area; 0: take the segment's
  Array conductivity{};                      ///< of the secondary side's material, 0: none
  std::array<Array, 2> edge_width{};         ///< of the secondary and the main edge
  std::array<Array, 4> edge_conductivity{};  ///< at each end, 0: none
  Array fric{};                              ///< per-pair friction coefficient
  Array visf2{};                    ///< per-pair factor of A in the tangential dashpot's square
  std::array<Array, 6> c{};         ///< per-pair friction law coefficients
  Array directed{};                 ///< orthotropic contacts: 0 for isotropic pairs; none: all are
  std::array<Array, 2> ortho_mu{};  ///< per pair, along and across the direction
  std::array<Array, 6> c2{};        ///< coefficients of the law across the direction
  std::array<Array, 2> ortho_direction{};  ///< A, B in the segment's own axes
  /// Unit directions along and across; none: formed from ortho_direction.
  std::array<std::array<Array, 3>, 2> ortho_axis{};
  /// Icurv 3: how far beyond the gap weights are formed; none: from the pair's nodal normals.
  Array allowance{};
  std::array<std::array<Array, 3>, 4> normal{};  ///< nodal normals of the corners

  /// f(arrays...) for each member of some PairArrays, side by side. The one list of them: what
  /// shifts, pads, copies or points at arrays goes over it.
  template <class F, class... Arrays>
  static void each(const F& f, Arrays&... a) {
    each_of(f, a.position...), each_of(f, a.velocity...), each_of(f, a.mass...);
    each_of(f, a.k0...), each_of(f, a.gap...), each_of(f, a.p0...);
    each_of(f, a.ft_old...), each_of(f, a.tie...), each_of(f, a.temperature...);
    each_of(f, a.area...), each_of(f, a.conductivity...);
    each_of(f, a.edge_width...), each_of(f, a.edge_conductivity...);
    each_of(f, a.fric...), each_of(f, a.visf2...), each_of(f, a.c...), each_of(f, a.directed...);
    each_of(f, a.ortho_mu...), each_of(f, a.c2...), each_of(f, a.ortho_direction...);
    each_of(f, a.ortho_axis...), each_of(f, a.allowance...), each_of(f, a.normal...);
  }
};

/// Inputs of n pairs. Arrays that no active effect needs may be null.
struct PacketView : PairArrays<const double*> {
  std::size_t size = 0;
  double dt1 = 0.0;                        ///< last completed step; 0 at the start
  double dt12 = 0.0;                       ///< mid-step interval, for incremental friction
  const std::uint8_t* triangle = nullptr;  ///< null: every segment has four corners

  /// Points at the arrays that are there, from entry `begin` on. They outlive the view.
  void point_at(const PairArrays<std::vector<double>>& arrays, std::size_t begin = 0) {
    const auto point = [begin](const double*& to, const std::vector<double>& from) {
      if (!from.empty()) to = from.data() + begin;
    };
    each(point, static_cast<PairArrays<const double*>&>(*this), arrays);
  }
};

/// Bits of PacketResult::status.
enum Status : std::int64_t {
  status_contact = 1,       ///< the pair has a force
  status_gap_closed = 2,    ///< mid-surface reached: node (edge) to be removed from the interface
  status_step_deleted = 4,  ///< contact time step at or below dtmin: to be removed
  status_tied = 8,          ///< a tie is live after this cycle
  status_released = 16,     ///< a tie ended in this cycle
  status_bc_release = 32,   ///< fixed translations named by IBC are to be released
  status_kept = 64,         ///< curved main sides only: the pair is within reach
};

/// Sums over a packet (or over a whole interface), on the main side.
struct Totals {
  std::array<double, 3> normal{};      ///< sum of normal forces
  std::array<double, 3> tangential{};  ///< sum of tangential forces
  std::array<double, 3> moment{};      ///< of the total force about the origin
  double normal_abs = 0.0;             ///< sum of |Fn|
  double total_abs = 0.0;              ///< sum of |F|
  double elastic_energy = 0.0;
  double friction_energy = 0.0;
  double damping_energy = 0.0;
  double friction_heat = 0.0;  ///< part of the friction work that became heat
  double dt_kinematic = 1e30;  ///< smallest pair limit
  std::size_t dt_kinematic_pair = SIZE_MAX;
  std::size_t contacts = 0;
  void add(const Totals& other);
};

/// Outputs of n pairs. All arrays are n long; those that the plan does not write are 0.
struct PacketResult {
  std::array<std::vector<double>, 4> weights;  ///< H1..H4, or h_s, 1-h_s, h_m, 1-h_m
  std::array<std::vector<double>, 3> force;    ///< on the main side; secondary: the opposite
  std::array<std::vector<double>, 3> normal;   ///< from main towards secondary
  std::vector<double> normal_force;            ///< signed scalar Fn, negative repels
  std::vector<double> k_nodal;                 ///< stiffness given to the secondary node (edge)
  std::vector<double> penetration;             ///< effective, after Inacti
  std::vector<double> distance;
  std::vector<double> effective_gap;
  std::vector<double> p0;
  std::array<std::vector<double>, 3> ft;  ///< friction memory to keep
  std::array<std::vector<double>, 8> tie;
  std::vector<double> elastic_energy;
  std::vector<double> friction_energy;  ///< dt1 V.Ft
  std::vector<double> damping_energy;
  std::vector<double> friction_heat;  ///< dissipated by sliding in this cycle
  std::vector<double> dt_kinematic;
  std::vector<std::int64_t> status;
  std::array<std::vector<double>, 5> heat;  ///< given to each role (edges leave the fifth 0)
  std::vector<double> conductance;
  std::array<std::vector<double>, 3> criteria;  ///< radius, relative penetration, angle (Iadm)

  std::size_t size = 0;
  /// All arrays n long and 0 (dt_kinematic 1e30).
  void resize(std::size_t n);
  /// As resize, but leaves to the kernel what it overwrites anyway, and alone what is 0 already.
  void prepare(std::size_t n, Field writes);

  /// f(vector, group, value) for every array: the group of optional arrays it belongs to (none:
  /// every kernel writes it), and its value where nothing was written. The one list of results.
  template <class Result, class F>
  static void each_array(Result& r, F&& f) {
    const auto all = [&](auto& arrays, Field group) {
      for (auto& a : arrays) f(a, group, 0.0);
    };
    all(r.weights, Field::none), all(r.force, Field::none), all(r.normal, Field::none);
    for (auto* a : {&r.normal_force, &r.k_nodal, &r.penetration, &r.distance, &r.effective_gap}) {
      f(*a, Field::none, 0.0);
    }
    f(r.status, Field::none, std::int64_t{0});
    f(r.p0, Field::residual_penetration, 0.0);
    all(r.ft, Field::friction_memory);
    f(r.elastic_energy, Field::elastic_energy, 0.0);
    f(r.friction_energy, Field::friction_energy, 0.0);
    f(r.friction_heat, Field::friction_energy, 0.0);
    f(r.damping_energy, Field::damping_energy, 0.0);
    f(r.dt_kinematic, Field::kinematic_step, 1e30);
    all(r.heat, Field::heat);
    f(r.conductance, Field::heat, 0.0);
    all(r.criteria, Field::criteria);
    all(r.tie, Field::tie_record);
  }

 private:
  Field dirty_ = Field::none;  ///< optional groups that the last kernel wrote
};

/// Which law a packet of pairs follows. TYPE19 is two node_segment cards and one edge_edge card.
enum class ContactKind {
  node_segment,  ///< TYPE7: a secondary node against a main segment
  tied,          ///< TYPE10: a node tied to a segment after impact
  edge_edge,     ///< TYPE11: a secondary edge against a main edge
};

/// Piecewise-linear function of one variable, continued linearly beyond both ends from its end
/// segments; a single point is a constant. Abscissae must not decrease; a step (two equal
/// abscissae) takes the slope of a spacing of 1e-16, as the reference solver does.
struct Curve {
  std::vector<double> x;
  std::vector<double> y;
  [[nodiscard]] double operator()(double abscissa) const;
};

/// Effective card values (after defaults), in the deck's working units. Names are the manual's in
/// lower case. Values "explicitly nothing" (1000) are 0 here. A friction coefficient of 0 with
/// ifric 0 means no friction; viss 0 means no damping at all (a blank VISs is 0.05 by default).
struct ContactCard {
  ContactKind kind = ContactKind::node_segment;

  // Stiffness: 0 main only (TYPE11: series), 1 fixed Stfac, 2 mean, 3 max, 4 min, 5 series.
  int istf = 0;
  double stfac = 1.0;
  double stmin = 0.0;
  double stmax = 1e30;

  // Gap: 0 constant Gapmin, 1 and 2 variable (already scaled), 3 also limited by mesh size.
  int igap = 0;
  double gapmin = 0.0;
  double fpenmax = 0.0;  ///< start-up only: nodes deeper than this share of the gap are left out
  int inacti = 0;        ///< 5 and 6 act every cycle; 1, 2, 3 act at start-up only

  // Rate effects.
  double viss = 0.05;
  double visf = 0.0;  ///< 0 (blank): 1 when the card has friction, else no tangential damping

  // Friction.
  double fric = 0.0;
  int ifric = 0;  ///< 0 Coulomb, 1 viscous, 2 Darmstad, 3 Renard, 4 exponential decay
  std::array<double, 6> c{};
  int iform = 1;   ///< 2 stiffness (incremental), any other viscous (total)
  int ifiltr = 0;  ///< 0 none, 1 numerical, 2 period, 3 cutting frequency
  double xfreq = 0.0;
  std::optional<Curve> fct_idf;  ///< friction against temperature; needs ithe
  double ascalef = 1.0;
  bool fric_id = false;           ///< part-pair coefficients come with the packet
  bool fric_orthotropic = false;  ///< and they are orthotropic, with a direction per pair

  // Curvature of the main side, and criteria for adaptive meshing.
  int icurv = 0;                       ///< 0 none, 1 sphere, 2 cylinder, 3 bicubic
  std::array<double, 3> curv_node1{};  ///< centre, or first point of the axis
  std::array<double, 3> curv_node2{};  ///< second point of the axis
  int iadm = 0;
  double nradm = 3.0;
  double padm = 1.0;
  double angladm = 0.0;  ///< degrees

  // Heat.
  int ithe = 0;
  int ithe_form = 0;  ///< 0 with the interface temperature Tint, 1 between the two sides
  double kthe = 0.0;
  std::optional<Curve> fct_idk;
  double ascalek = 1.0;
  double tint = 0.0;
  double frad = 0.0;
  double drad = 0.0;
  double fheats = 0.0;
  double fheatm = 0.0;
  double thermal_speed_up = 1.0;

  // Time: activity window, limits, and what to do at them.
  double tstart = 0.0;
  double tstop = 1e30;
  std::optional<double> sensor_time;  ///< activation time of sens_ID, when one is given
  double dtmin = 0.0;                 ///< pairs (nodes) below this contact time step are deleted
  double step_factor = 0.9;           ///< of nodal time steps, when held against dtmin
  int itied = 0;                      ///< TYPE7: 0/1/2; TYPE10: 0 rebound, 1 none

  // Flags with side effects outside the pair force.
  int ibc = 0;  ///< translations to release: 4 X + 2 Y + 1 Z
  int ibag = 0;
  int idel = 0;
};

/// Effects inside the pair loop that a card may call for, as bits of a composition. The account of
/// a plan names those that have a row in this order. Each is at home in cycle/kernel/effects.hpp.
enum class Effect : std::uint32_t {
  elastic = 1u << 0,
  gap_reduction = 1u << 1,
  damping = 1u << 2,
  friction_viscous = 1u << 3,
  friction_incremental = 1u << 4,
  elastic_energy = 1u << 5,
  // Only in the generic kernel:
  friction_law = 1u << 6,
  friction_temperature = 1u << 7,
  filter = 1u << 8,
  friction_orthotropic = 1u << 9,
  friction_pairs = 1u << 10,
  fixed_stiffness = 1u << 11,  ///< Istf 1 of node-segment pairs
};
using EffectSet = std::uint32_t;
constexpr EffectSet bit(Effect e) { return static_cast<EffectSet>(e); }

/// One line of the account of a plan: an effect, whether it runs, and which field decided.
struct EffectState {
  std::string name;
  bool on = false;
  std::string field;   ///< the card field that decides, empty when nothing does
  std::string reason;  ///< in words, e.g. "Fric = 0"
};

/// True when the interface acts at time t: Tstart <= t <= Tstop, and after its sensor if it has
/// one. Both tests apply together.
[[nodiscard]] bool is_active(const ContactCard& card, double t);

/// Idel: whether a main segment stays, given the live elements left behind it and whether the
/// element it was made from is alive.
[[nodiscard]] bool segment_stays(int idel, int live_elements, bool own_element_alive);

/// Idel: whether a secondary node stays, given the live elements still attached to it.
[[nodiscard]] bool secondary_stays(int idel, int live_elements);

// One-cycle contact forces: evaluates a packet of pairs under a plan.
// Example: auto plan = make_plan(card); PacketResult out; evaluate(plan, view, out);

/// The numerical model. Which effect acts, and with which coefficient, is the same in both and is
/// the solver's; `robust` changes arithmetic only. tools/docs/differences.md lists the solver's
/// rules that differ from its manual, and all that differs between the models, each held by a test:
/// tests/cycle/solver_rules_test.cpp (both models) and tests/cycle/model_differences_test.cpp.
///
/// `reference` reproduces the published solver guard for guard (the recorded states decide).
/// `robust`:
///  * node-segment: the closest of the four sub-triangles gives normal, distance and weights, with
///    relative guards; no blending, no shift of weights, the same weights for velocity and force;
///  * neighbouring segments or edges that meet the other side at the same edge or corner share one
///    force instead of adding up (cycle/shared/contact_run.hpp; whole contacts only);
///  * the law works with the distance itself, not with gap minus penetration, its energy by log1p;
///    under 1e-8 of the gap it continues as its tangent down to 1e-10, where the node is dropped;
///  * edge-edge: relative parallel test, parallel edges meet at the middle of their overlap,
///    crossing edges have a normal;
///  * a gap used up by Inacti switches the pair off (no number otherwise);
///  * the work of the normal dashpot is booked.
enum class Model { reference, robust };

/// Instruction set of the compiled kernels, as far as the processor has it. All give the same bits.
enum class Isa { automatic, baseline, avx2, avx512 };

struct PlanOptions {
  bool energies = true;        ///< book elastic energy (costs one logarithm per pair)
  bool force_generic = false;  ///< use the run-time-flag kernel even for a composed set
  Isa isa = Isa::automatic;
};

namespace detail {
struct KernelTable;
struct LateEffect;
}  // namespace detail

/// A chosen kernel. Cheap to copy; holds no reference to the card it was made from.
struct KernelPlan {
  ContactCard card;
  Model model = Model::reference;
  EffectSet effects = 0;  ///< effects inside the pair loop
  Field needs = Field::none;
  Field writes = Field::none;
  bool composed = false;             ///< a fixed composition, not the run-time-flag kernel
  std::string composition;           ///< e.g. "elastic+damping+friction_viscous"
  std::string isa;                   ///< "baseline" or "avx2"
  std::vector<EffectState> account;  ///< every effect, on or off, and why
  const detail::KernelTable* table = nullptr;
  std::vector<const detail::LateEffect*> late;  ///< effects on finished pairs, in their order
};

/// Chooses the kernel for a card. Never fails: a card without any force gives a plan whose
/// effects are off, with the reasons.
[[nodiscard]] KernelPlan make_plan(const ContactCard& card, Model model = Model::reference,
                                   const PlanOptions& options = {});

/// The account of a card without choosing a kernel: each effect, on or off, and the deciding field.
[[nodiscard]] std::vector<EffectState> effect_plan(const ContactCard& card);

/// Arrays that the plan needs and the view does not have.
[[nodiscard]] Field missing_fields(const KernelPlan& plan, const PacketView& view);

/// Evaluates all pairs of the view into `result` (resized). Inputs and outputs must not overlap.
/// Each pair depends on its own inputs only, so any split into packets gives the same numbers.
/// Throws std::invalid_argument when a needed array is missing (a broken promise of the caller).
/// With threads > 1 the packet is split into contiguous ranges; the result is the same.
void evaluate(const KernelPlan& plan, const PacketView& view, PacketResult& result,
              unsigned threads = 1);

/// Sums of a result, added in a fixed order that does not depend on threads or instruction set.
/// Moments need view.position.
[[nodiscard]] Totals totals(const KernelPlan& plan, const PacketView& view,
                            const PacketResult& result);

/// Sums over results in pieces, equal for any division. The plan must outlive this object.
class RunningTotals {
 public:
  explicit RunningTotals(const KernelPlan& plan) : plan_(&plan) {}
  void add(const PacketView& view, const PacketResult& result);
  [[nodiscard]] Totals all() const;

 private:
  const KernelPlan* plan_;
  Totals all_, block_;  ///< full blocks of pairs, and the last one
  std::size_t pairs_ = 0;
};

/// Pair stiffness K0 from main and secondary values by Istf (before the 1/2 of the law), clamped
/// to [Stmin, Stmax] for Istf 2..5. TYPE10: the main value. TYPE11: Istf 0 and 5 in series, Istf 1
/// two springs of |Stfac| in series, so that the law starts at a quarter of Stfac. The models
/// differ in the guard against 0/0 only.
[[nodiscard]] double pair_stiffness(const ContactCard& card, double k_main, double k_secondary,
                                    Model model = Model::reference);

/// Edge values for TYPE11's Inacti: what a pair contributes to P_max of both its edges.
[[nodiscard]] double edge_residual(const ContactCard& card, double penetration, double gap);

/// The friction coefficient of the card's law (Ifric 0..4) at pressure P and speed V.
[[nodiscard]] double friction_coefficient(int ifric, double mu0, const std::array<double, 6>& c,
                                          double pressure, double speed);

/// Orthotropic Coulomb limit: returns the trial force (f1, f2) brought back to the ellipse
/// (f1/mu1)^2 + (f2/mu2)^2 = fn^2 if it lies outside: projected along the gradient, then radially.
/// A coefficient of 0 removes its direction.
[[nodiscard]] std::array<double, 2> orthotropic_return(double f1, double f2, double mu1, double mu2,
                                                       double fn);

// From nodes to packets and back: gathers nodal arrays into a packet, and adds pair results to the
// nodes in an order that does not depend on the number of threads.

/// Nodal arrays, one entry per node. Null: 0 (velocity, temperature), or the plan needs none.
struct NodalState {
  std::array<const double*, 3> position{};
  std::array<const double*, 3> velocity{};
  const double* mass = nullptr;
  const double* temperature = nullptr;
};

/// Node indices of each pair by role (see PacketView). Edge contacts leave role 4 empty.
struct PairList {
  ContactKind kind = ContactKind::node_segment;
  std::array<std::vector<std::uint32_t>, 5> node;
  std::vector<std::uint8_t> triangle;  ///< empty: none; node-segment pairs only
  [[nodiscard]] std::size_t size() const { return node[0].size(); }
};

/// Owns the gathered arrays of a packet. Only the fields asked for are read from the nodes.
class PacketBuffer {
 public:
  /// Fills position, velocity, mass and temperature of the pairs as far as `needs` asks.
  void gather(const NodalState& nodes, const PairList& pairs, Field needs);
  /// The gathered arrays; the caller adds stiffness, gap and history arrays of its own.
  [[nodiscard]] PacketView view() const;

 private:
  std::size_t size_ = 0;
  PairArrays<std::vector<double>> of_;
  std::vector<std::uint8_t> triangle_;
};

/// Sums at the nodes.
struct NodalSums {
  std::array<std::vector<double>, 3> force;
  std::vector<double> stiffness;
  std::vector<double> heat;         ///< empty: no contact of a scene asks for it
  std::vector<double> conductance;  ///< empty as heat
  /// Heat of a node, 0 where no contact asks for it.
  double heat_of(std::size_t node) const { return heat.empty() ? 0.0 : heat[node]; }
  std::vector<std::uint8_t> contact;   ///< 1 when a pair of the node has a force (Ibag, Iadm)
  std::vector<std::uint8_t> removed;   ///< 1 when the node (edge) is to leave the interface
  std::vector<std::uint8_t> released;  ///< translations to free, 4 X + 2 Y + 1 Z (IBC)
  void resize(std::size_t nodes, bool heated = true);
};

/// Adds a result to the nodes in pair order, from one thread. `sums` must be sized; it is added to,
/// so several interfaces in turn can share it, and results can come piece by piece.
void assemble(const KernelPlan& plan, const PairList& pairs, const PacketResult& result,
              NodalSums& sums);

/// The limit of the time step of an interface and its cause.
struct StepLimit {
  enum class Source { none, kinematic, nodal, velocity } source = Source::none;
  double dt = 1e30;
  std::size_t index = SIZE_MAX;  ///< pair (kinematic) or node (nodal)
};

/// Smallest of: the pairs' kinematic limit, factor * sqrt(2 m / S) over nodes with mass and contact
/// stiffness, and the interface's velocity limit (pass 1e30 to leave it out).
[[nodiscard]] StepLimit step_limit(const Totals& totals, const NodalSums& sums, const double* mass,
                                   double factor = 0.9, double velocity_limit = 1e30);

/// Interface-wide limit 0.9 g / |Vmax| from velocity ranges of both sides (x, y, z).
[[nodiscard]] double velocity_step(double gap, const std::array<double, 3>& secondary_min,
                                   const std::array<double, 3>& secondary_max,
                                   const std::array<double, 3>& main_min,
                                   const std::array<double, 3>& main_max);

// From a scene to the contact kernel: the card of every elementary contact with effective values,
// and its pairs with stiffness, gap and initial penetration as the reference solver forms them.

/// The card of one contact of a scene, in working units. A TYPE19 part follows the rules of the
/// type it stands for. A blank Drad is 0 here: the default that start-up prints is not handed on to
/// the force stage.
[[nodiscard]] ContactCard make_card(const Scene& scene, const deck::Contact& contact);

/// The place of a field of an interface, for "because of this field on this line".
struct FieldPlace {
  Span span;  ///< the columns on the card; invalid where the layout has no such cell
  Origin origin = Origin::built_in;
};
/// Nothing when interfaces of this type have no such field.
[[nodiscard]] std::optional<FieldPlace> field_place(const InterBase& inter, std::string_view field);

/// All pairs of a contact within reach, in the order of the search: by secondary, then main. Filled
/// are k0, gap and p0; with Ithe area or edge_width, and what add_conductivity adds; with fric_ID
/// what its pairs of parts say; with Icurv 3 and Iadm the nodal normals.
struct ContactPairs : PairArrays<std::vector<double>> {
  std::vector<CandidatePair> at;  ///< positions in the contact's lists
  PairList nodes;                 ///< node indices of the model, by role
  bool complete = true;           ///< false: too many pairs, none was kept
  [[nodiscard]] std::size_t size() const { return at.size(); }
};

/// Coordinates and margin of a pair search.
struct PairSearch {
  const Coordinates* at = nullptr;    ///< null: the scene's
  double margin = 0.0;                ///< beyond the reach of every pair
  std::vector<CandidatePair> always;  ///< pairs that are wanted wherever they are
};

/// Finds the pairs closer than their gap (or Drad, or what Icurv adds) at the scene's coordinates
/// and forms their values. The scene must have been built with penetrations and, for Istf 2 to 5,
/// with nodal stiffness.
[[nodiscard]] ContactPairs make_pairs(const Scene& scene, const deck::Contact& contact,
                                      const ContactCard& card, Model model, int threads = 1,
                                      const PairSearch& where = {});

/// Forms the nodal normals (Icurv 3, Iadm) of pairs again, with the nodes at `x`.
void renew_normals(const deck::Contact& contact, const ContactCard& card, const Coordinates& x,
                   ContactPairs& pairs);

/// Adds the conductivity that /HEAT/MAT gives the material of the secondary node's shell, or of the
/// elements that carry both edges, at temperatures given node by node; 0 where there is none.
void add_conductivity(const Scene& scene, const deck::Contact& contact,
                      const std::vector<double>& temperature, ContactPairs& pairs);

// One contact force evaluation of a whole deck: every contact of a scene at the deck's initial
// state, its forces, energies and time step, and the sums at the nodes.
// Example: auto r = run_cycle(scene, make_state(scene), {});

/// A velocity to try: all nodes of the elements of one part.
struct PartVelocity {
  std::int64_t part = 0;  ///< id
  std::array<double, 3> velocity{};
};

/// The share of a stable step that the solver takes, of elements and of nodes, by default.
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

/// The results of one contact.
struct ContactOutcome {
  const deck::Contact* contact = nullptr;
  ContactCard card;
  std::vector<EffectState> effects;
  std::string composition, isa;
  bool active = true;    ///< false: outside its time window or before its sensor
  bool complete = true;  ///< false: nothing was evaluated (too many pairs, values out of range)
  bool stiffness_known = true;  ///< false: of some law or property, so nothing was evaluated
  /// Not complete although its type has forces: what it does is open.
  bool undecided() const { return !complete && !is_type24_or_25(contact->type); }
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
  /// With the nodes at `x`; areas and widths for heat stay those of the scene. The
  /// numerical model of the options must be equal in all calls.
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

/// The results of all contacts of one interface together.
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
/// Sums these contacts of one interface; all messages and tables show this sum.
[[nodiscard]] InterfaceSummary summarize(const std::vector<const ContactOutcome*>& contacts,
                                         const StructureStep& structure);
/// One summary per interface of the scene, in the solver's order.
[[nodiscard]] std::vector<InterfaceSummary> summarize(const Scene& scene,
                                                      const SceneOutcome& outcome);

// Several force evaluations in a row on a mesh with prescribed motion; contacts keep their state
// from one step to the next. Contact forces do not move the nodes: no structure is computed.
// Example: auto r = run_steps(scene, make_state(scene), options, 50);

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
