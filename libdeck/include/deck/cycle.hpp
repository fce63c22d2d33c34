// First cycle of a scene: pair kernels, their arrays, nodal sums; steps with prescribed motion.
// Over 600 lines, because the steps hand on the pairs, plans and memories of the kernels: whoever
// includes one part needs the others.
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

// A packet of contact pairs as structure of arrays: input and output of the kernel.

/// Groups of arrays, as bits: the arrays that an effect reads or writes.
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

/// Calls f(arrays...) for each array of one or more structures of arrays, in parallel order.
template <class F, class First, class... Others>
void for_each_array(const F& f, First& first, Others&... others) {
  if constexpr (requires { std::tuple_size<std::remove_const_t<First>>::value; }) {
    for (std::size_t k = 0; k < first.size(); ++k) for_each_array(f, first[k], others[k]...);
  } else {
    f(first, others...);
  }
}

/// Data of n pairs, arrays of n values: pointers for a kernel, vectors for their owner. Roles of a
/// node-segment pair: 0 the secondary node, 1..4 the corners of the segment (a triangle repeats
/// corner 3). Roles of an edge-edge pair: 0, 1 the secondary edge, 2, 3 the main edge.
template <class Array>
struct PairArrays {
  std::array<std::array<Array, 3>, 5> position{};
  std::array<std::array<Array, 3>, 5> velocity{};
  std::array<Array, 5> mass{};

  Array k0{};   ///< pair stiffness without the factor 1/2 of the law; 0: switched off at start-up
  Array gap{};  ///< pair gap
  Array p0{};   ///< Inacti 5, 6: residual penetration (edges: sum of both sides)
  std::array<Array, 3> ft_old{};
  std::array<Array, 8> tie{};  ///< Fn Ft1 Ft2 H1 H2 H3 [p side]; TYPE10 has six

  std::array<Array, 5> temperature{};
  Array area{};                              ///< secondary contact area; 0: use that of the segment
  Array conductivity{};                      ///< of the secondary material, 0: none
  std::array<Array, 2> edge_width{};         ///< of the secondary and the main edge
  std::array<Array, 4> edge_conductivity{};  ///< at each end, 0: none
  Array fric{};                              ///< per-pair friction coefficient
  Array visf2{};             ///< per pair: factor of A in the square of the tangential dashpot
  std::array<Array, 6> c{};  ///< per-pair friction law coefficients
  Array directed{};  ///< orthotropic contacts: 0 for isotropic pairs; empty: all orthotropic
  std::array<Array, 2> ortho_mu{};         ///< per pair, along and across the direction
  std::array<Array, 6> c2{};               ///< friction law coefficients across the direction
  std::array<Array, 2> ortho_direction{};  ///< A, B in the axes of the segment
  /// Unit directions along and across; empty: computed from ortho_direction.
  std::array<std::array<Array, 3>, 2> ortho_axis{};
  /// Icurv 3: distance beyond the gap up to which weights are formed; empty: from nodal normals.
  Array allowance{};
  std::array<std::array<Array, 3>, 4> normal{};  ///< nodal normals of the corners

  /// Calls f(arrays...) for each member of some PairArrays. Functions that shift, pad, copy or
  /// point at arrays use this list.
  template <class F, class... Arrays>
  static void for_each(const F& f, Arrays&... a) {
    for_each_array(f, a.position...), for_each_array(f, a.velocity...),
        for_each_array(f, a.mass...);
    for_each_array(f, a.k0...), for_each_array(f, a.gap...), for_each_array(f, a.p0...);
    for_each_array(f, a.ft_old...), for_each_array(f, a.tie...),
        for_each_array(f, a.temperature...);
    for_each_array(f, a.area...), for_each_array(f, a.conductivity...);
    for_each_array(f, a.edge_width...), for_each_array(f, a.edge_conductivity...);
    for_each_array(f, a.fric...), for_each_array(f, a.visf2...), for_each_array(f, a.c...),
        for_each_array(f, a.directed...);
    for_each_array(f, a.ortho_mu...), for_each_array(f, a.c2...),
        for_each_array(f, a.ortho_direction...);
    for_each_array(f, a.ortho_axis...), for_each_array(f, a.allowance...),
        for_each_array(f, a.normal...);
  }
};

/// Inputs of n pairs. Arrays that no active effect needs may be null.
struct PacketView : PairArrays<const double*> {
  std::size_t size = 0;
  double dt1 = 0.0;                        ///< last completed step; 0 at the start
  double dt12 = 0.0;                       ///< mid-step interval, for incremental friction
  const std::uint8_t* triangle = nullptr;  ///< null: every segment has four corners

  /// Points at the non-empty arrays, from index `begin`. The arrays must outlive the view.
  void point_at(const PairArrays<std::vector<double>>& arrays, std::size_t begin = 0) {
    const auto point = [begin](const double*& to, const std::vector<double>& from) {
      if (!from.empty()) to = from.data() + begin;
    };
    for_each(point, static_cast<PairArrays<const double*>&>(*this), arrays);
  }
};

/// Bits of PacketResult::status.
enum Status : std::int64_t {
  status_contact = 1,       ///< the pair has a force
  status_gap_closed = 2,    ///< at the mid-surface: the node (edge) leaves the interface
  status_step_deleted = 4,  ///< contact time step at or below dtmin: the node leaves
  status_tied = 8,          ///< tied after this cycle
  status_released = 16,     ///< the tie ended in this cycle
  status_bc_release = 32,   ///< IBC releases fixed translations
  status_kept = 64,         ///< curved main sides only: the pair is within reach
};

/// Sums over a packet or interface, on the main side.
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

/// Outputs of n pairs, all arrays n long. Arrays that the plan does not write are 0.
struct PacketResult {
  std::array<std::vector<double>, 4> weights;  ///< H1..H4, or h_s, 1-h_s, h_m, 1-h_m
  std::array<std::vector<double>, 3> force;    ///< on the main side; secondary: the opposite
  std::array<std::vector<double>, 3> normal;   ///< from main towards secondary
  std::vector<double> normal_force;            ///< signed scalar Fn, negative repels
  std::vector<double> k_nodal;                 ///< stiffness added to the secondary node (edge)
  std::vector<double> penetration;             ///< effective, after Inacti
  std::vector<double> distance;
  std::vector<double> effective_gap;
  std::vector<double> p0;
  std::array<std::vector<double>, 3> ft;  ///< friction memory for the next cycle
  std::array<std::vector<double>, 8> tie;
  std::vector<double> elastic_energy;
  std::vector<double> friction_energy;  ///< dt1 V.Ft
  std::vector<double> damping_energy;
  std::vector<double> friction_heat;  ///< dissipated by sliding in this cycle
  std::vector<double> dt_kinematic;
  std::vector<std::int64_t> status;
  std::array<std::vector<double>, 5> heat;  ///< per role (edges: the fifth is 0)
  std::vector<double> conductance;
  std::array<std::vector<double>, 3> criteria;  ///< radius, relative penetration, angle (Iadm)

  std::size_t size = 0;
  /// Resizes all arrays to n and sets them to 0 (dt_kinematic: 1e30).
  void resize(std::size_t n);
  /// Like resize, but does not clear arrays that the kernel writes or that are 0 already.
  void prepare(std::size_t n, Field writes);

  /// Calls f(vector, group, value) for every array: its group of optional arrays (none: always
  /// written) and its initial value.
  template <class Result, class F>
  static void for_each_array(Result& r, F&& f) {
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
  Field dirty_ = Field::none;  ///< optional groups written by the last kernel
};

/// The contact law of a packet. A TYPE19 has two node_segment cards and one edge_edge card.
enum class ContactKind {
  node_segment,  ///< TYPE7: a secondary node against a main segment
  tied,          ///< TYPE10: a node tied to a segment after impact
  edge_edge,     ///< TYPE11: a secondary edge against a main edge
};

/// Piecewise-linear function, extrapolated by its end segments; a single point is a constant.
/// Abscissae must not decrease. A step (two equal abscissae) has the slope of a spacing of 1e-16,
/// as in the solver.
struct Curve {
  std::vector<double> x;
  std::vector<double> y;
  [[nodiscard]] double operator()(double abscissa) const;
};

/// Effective card values in working units; manual names in lower case. Values of 1000 ("explicitly
/// nothing") are 0. Friction coefficient 0 with ifric 0: no friction. viss 0: no damping (a blank
/// VISs is 0.05).
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
  double fpenmax = 0.0;  ///< start-up only: deeper nodes (share of the gap) are left out
  int inacti = 0;        ///< 5 and 6 act every cycle; 1, 2, 3 act at start-up only

  // Rate effects.
  double viss = 0.05;
  double visf = 0.0;  ///< 0 (blank): 1 if the card has friction, else no tangential damping

  // Friction.
  double fric = 0.0;
  int ifric = 0;  ///< 0 Coulomb, 1 viscous, 2 Darmstad, 3 Renard, 4 exponential decay
  std::array<double, 6> c{};
  int iform = 1;   ///< 2 stiffness (incremental), any other viscous (total)
  int ifiltr = 0;  ///< 0 none, 1 numerical, 2 period, 3 cutting frequency
  double xfreq = 0.0;
  std::optional<Curve> fct_idf;  ///< friction against temperature; needs ithe
  double ascalef = 1.0;
  bool fric_id = false;           ///< coefficients per pair of parts come with the packet
  bool fric_orthotropic = false;  ///< they are orthotropic, with a direction per pair

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

  // Time window, time step limits and their effect.
  double tstart = 0.0;
  double tstop = 1e30;
  std::optional<double> sensor_time;  ///< activation time of sens_ID, if there is one
  double dtmin = 0.0;                 ///< pairs (nodes) below this contact time step are deleted
  double step_factor = 0.9;           ///< factor of nodal time steps in the comparison with dtmin
  int itied = 0;                      ///< TYPE7: 0/1/2; TYPE10: 0 rebound, 1 none

  // Flags with side effects outside the pair force.
  int ibc = 0;  ///< translations to release: 4 X + 2 Y + 1 Z
  int ibag = 0;
  int idel = 0;
};

/// Effects in the pair loop that a card can need, as bits. Accounts of a plan list them in this
/// order. Defined in cycle/kernel/effects.hpp.
enum class Effect : std::uint32_t {
  elastic = 1u << 0,
  gap_reduction = 1u << 1,
  damping = 1u << 2,
  friction_viscous = 1u << 3,
  friction_incremental = 1u << 4,
  elastic_energy = 1u << 5,
  // Generic kernel only:
  friction_law = 1u << 6,
  friction_temperature = 1u << 7,
  filter = 1u << 8,
  friction_orthotropic = 1u << 9,
  friction_pairs = 1u << 10,
  fixed_stiffness = 1u << 11,  ///< Istf 1 of node-segment pairs
};
using EffectSet = std::uint32_t;
constexpr EffectSet bit(Effect e) { return static_cast<EffectSet>(e); }

/// One effect of a plan's account: whether it acts, and the field that decides.
struct EffectState {
  std::string name;
  bool on = false;
  std::string field;   ///< deciding card field; may be empty
  std::string reason;  ///< in words, e.g. "Fric = 0"
};

/// True if the interface acts at time t: Tstart <= t <= Tstop, and t is not before the time of its
/// sensor.
[[nodiscard]] bool is_active(const ContactCard& card, double t);

/// Idel: True if a main segment stays, given the live elements behind it and the state of its own
/// element.
[[nodiscard]] bool segment_stays(int idel, int live_elements, bool own_element_alive);

/// Idel: True if a secondary node stays, given its live elements.
[[nodiscard]] bool secondary_stays(int idel, int live_elements);

// Contact forces of one cycle for a packet of pairs. Example: auto plan = make_plan(card);
// PacketResult out; evaluate(plan, view, out);

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

/// Instruction set of the kernels, limited by the processor. All give bit-identical results.
enum class Isa { automatic, baseline, avx2, avx512 };

struct PlanOptions {
  bool energies = true;        ///< book elastic energy (costs one logarithm per pair)
  bool force_generic = false;  ///< use the generic kernel also for composed effect sets
  Isa isa = Isa::automatic;
};

namespace detail {
struct KernelTable;
struct LateEffect;
}  // namespace detail

/// A chosen kernel. Cheap to copy; does not refer to the card.
struct KernelPlan {
  ContactCard card;
  Model model = Model::reference;
  EffectSet effects = 0;  ///< effects in the pair loop
  Field needs = Field::none;
  Field writes = Field::none;
  bool composed = false;             ///< true: fixed composition; false: generic kernel
  std::string composition;           ///< e.g. "elastic+damping+friction_viscous"
  std::string isa;                   ///< "baseline" or "avx2"
  std::vector<EffectState> account;  ///< all effects, on or off, with reasons
  const detail::KernelTable* table = nullptr;
  std::vector<const detail::LateEffect*> late;  ///< effects on finished pairs, in order
};

/// Chooses the kernel for a card. Never fails: for a card without forces all effects are off.
[[nodiscard]] KernelPlan make_plan(const ContactCard& card, Model model = Model::reference,
                                   const PlanOptions& options = {});

/// The account of a card without choosing a kernel.
[[nodiscard]] std::vector<EffectState> effect_plan(const ContactCard& card);

/// Arrays that the plan needs and the view lacks.
[[nodiscard]] Field missing_fields(const KernelPlan& plan, const PacketView& view);

/// Evaluates all pairs of the view into `result`, which is resized and must not overlap the inputs.
/// Pairs are independent: any split into packets, and threads > 1, give the same numbers. Throws
/// std::invalid_argument if a needed array is missing.
void evaluate(const KernelPlan& plan, const PacketView& view, PacketResult& result,
              unsigned threads = 1);

/// Sums of a result in a fixed order, independent of threads and instruction set. Moments need
/// view.position.
[[nodiscard]] Totals totals(const KernelPlan& plan, const PacketView& view,
                            const PacketResult& result);

/// Sums over results in pieces; independent of the division. The plan must outlive it.
class RunningTotals {
 public:
  explicit RunningTotals(const KernelPlan& plan) : plan_(&plan) {}
  void add(const PacketView& view, const PacketResult& result);
  [[nodiscard]] Totals all() const;

 private:
  const KernelPlan* plan_;
  Totals all_, block_;  ///< full blocks of pairs; the last block
  std::size_t pairs_ = 0;
};

/// Pair stiffness K0 by Istf from main and secondary stiffness, without the factor 1/2 of the law;
/// limited to [Stmin, Stmax] for Istf 2..5. TYPE10: the main value. TYPE11: Istf 0 and 5 in series;
/// Istf 1 two springs |Stfac| in series, so the law starts at Stfac / 4. The models differ only in
/// the guard against 0/0.
[[nodiscard]] double pair_stiffness(const ContactCard& card, double k_main, double k_secondary,
                                    Model model = Model::reference);

/// TYPE11, Inacti: contribution of a pair to P_max of both edges.
[[nodiscard]] double edge_residual(const ContactCard& card, double penetration, double gap);

/// Friction coefficient of the law Ifric 0..4 at pressure P and speed V.
[[nodiscard]] double friction_coefficient(int ifric, double mu0, const std::array<double, 6>& c,
                                          double pressure, double speed);

/// Orthotropic Coulomb limit: moves the trial force (f1, f2), if outside, to the ellipse (f1/mu1)^2
/// + (f2/mu2)^2 = fn^2: along the gradient, then radially. A coefficient of 0 removes its
/// direction.
[[nodiscard]] std::array<double, 2> orthotropic_return(double f1, double f2, double mu1, double mu2,
                                                       double fn);

// Gathering nodal arrays into a packet, and adding pair results to the nodes in an order that does
// not depend on threads.

/// Nodal arrays, one value per node. Null: 0 (velocity, temperature), or not needed by the plan.
struct NodalState {
  std::array<const double*, 3> position{};
  std::array<const double*, 3> velocity{};
  const double* mass = nullptr;
  const double* temperature = nullptr;
};

/// Node indices of each pair by role (see PacketView). Edge contacts: role 4 is empty.
struct PairList {
  ContactKind kind = ContactKind::node_segment;
  std::array<std::vector<std::uint32_t>, 5> node;
  std::vector<std::uint8_t> triangle;  ///< empty: no triangles; node-segment pairs only
  [[nodiscard]] std::size_t size() const { return node[0].size(); }
};

/// Owner of the gathered arrays of a packet.
class PacketBuffer {
 public:
  /// Gathers position, velocity, mass and temperature, as far as `needs` has them.
  void gather(const NodalState& nodes, const PairList& pairs, Field needs);
  /// The gathered arrays. The caller adds stiffness, gap and history.
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
  std::vector<double> heat;         ///< empty: no contact computes heat
  std::vector<double> conductance;  ///< likewise
  /// Heat of a node; 0 without heat.
  double heat_of(std::size_t node) const { return heat.empty() ? 0.0 : heat[node]; }
  std::vector<std::uint8_t> contact;   ///< 1 if a pair of the node has a force (Ibag, Iadm)
  std::vector<std::uint8_t> removed;   ///< 1 if the node (edge) leaves the interface
  std::vector<std::uint8_t> released;  ///< translations to free, 4 X + 2 Y + 1 Z (IBC)
  void resize(std::size_t nodes, bool heated = true);
};

/// Adds a result to the nodes in pair order, in one thread. `sums` must have its size; several
/// interfaces or pieces can be added.
void assemble(const KernelPlan& plan, const PairList& pairs, const PacketResult& result,
              NodalSums& sums);

/// Time step limit of an interface, and its cause.
struct StepLimit {
  enum class Source { none, kinematic, nodal, velocity } source = Source::none;
  double dt = 1e30;
  std::size_t index = SIZE_MAX;  ///< pair (kinematic) or node (nodal)
};

/// Smallest of: kinematic limit of the pairs; factor * sqrt(2 m / S) of nodes with mass m and
/// contact stiffness S; velocity limit of the interface (1e30: none).
[[nodiscard]] StepLimit step_limit(const Totals& totals, const NodalSums& sums, const double* mass,
                                   double factor = 0.9, double velocity_limit = 1e30);

/// Velocity limit 0.9 g / |Vmax| from the velocity ranges of both sides (x, y, z).
[[nodiscard]] double velocity_step(double gap, const std::array<double, 3>& secondary_min,
                                   const std::array<double, 3>& secondary_max,
                                   const std::array<double, 3>& main_min,
                                   const std::array<double, 3>& main_max);

// From a scene to the kernel: the card of each contact and its pairs with stiffness, gap and
// initial penetration.

/// The card of one contact, in working units. A part of a TYPE19 follows the type that it
/// represents. A blank Drad is 0: the solver does not use the default that it prints.
[[nodiscard]] ContactCard make_card(const Scene& scene, const deck::Contact& contact);

/// Place of a field of an interface, for messages.
struct FieldPlace {
  Span span;  ///< columns on the card; invalid: not in this layout
  Origin origin = Origin::built_in;
};
/// nullopt if the type has no such field.
[[nodiscard]] std::optional<FieldPlace> field_place(const InterBase& inter, std::string_view field);

/// All pairs of a contact within reach, sorted by secondary, then main, with k0, gap and p0; with
/// Ithe also area or edge_width and the arrays of add_conductivity; with fric_ID friction per pair
/// of parts; with Icurv 3 and Iadm nodal normals.
struct ContactPairs : PairArrays<std::vector<double>> {
  std::vector<CandidatePair> at;  ///< positions in the contact's lists
  PairList nodes;                 ///< node indices of the model, by role
  bool complete = true;           ///< false: too many pairs, none is listed
  [[nodiscard]] std::size_t size() const { return at.size(); }
};

/// Coordinates and margin of a pair search.
struct PairSearch {
  const Coordinates* at = nullptr;    ///< null: the scene's
  double margin = 0.0;                ///< added to the reach of every pair
  std::vector<CandidatePair> always;  ///< pairs to include at any distance
};

/// Finds the pairs closer than their gap (Drad, Icurv allowance) and computes their values. The
/// scene must be built with penetrations and, for Istf 2 to 5, nodal stiffness.
[[nodiscard]] ContactPairs make_pairs(const Scene& scene, const deck::Contact& contact,
                                      const ContactCard& card, Model model, int threads = 1,
                                      const PairSearch& where = {});

/// Recomputes the nodal normals (Icurv 3, Iadm) with the nodes at `x`.
void renew_normals(const deck::Contact& contact, const ContactCard& card, const Coordinates& x,
                   ContactPairs& pairs);

/// Adds the /HEAT/MAT conductivity of the secondary node's shell, or of the elements of both edges,
/// at the given nodal temperatures; 0 without one.
void add_conductivity(const Scene& scene, const deck::Contact& contact,
                      const std::vector<double>& temperature, ContactPairs& pairs);

// First cycle: evaluates all contacts of a scene once at the initial state: forces, energies, time
// steps, nodal sums. Example: auto r = run_cycle(scene, make_state(scene), {});

/// A velocity for all nodes of one part's elements.
struct PartVelocity {
  std::int64_t part = 0;  ///< id
  std::array<double, 3> velocity{};
};

/// Factor of the stable time step that the solver uses, for elements (default; the Engine file can
/// change it) and for nodes.
inline constexpr double step_scale = 0.9;

/// Smallest time step of the elements: 0.9 times that of the mesh.
struct StructureStep {
  double dt = 1e30;
  ElementKind kind = ElementKind::shell4;
  std::uint32_t element = no_index;  ///< no_index: no element limits
};

/// Initial state, one value per node, working units.
struct State {
  std::array<std::vector<double>, 3> velocity;  ///< empty: all 0
  std::vector<double> mass;         ///< 0 without an element with density and without /ADMAS
  std::vector<double> temperature;  ///< of /INITEMP, else of the material, else 0; empty: all 0
  bool moving = false;              ///< some velocity is not 0
  bool heated = false;              ///< the deck gives a temperature to some node
  StructureStep structure;
  std::vector<std::string> not_evaluated;  ///< options of the deck that were ignored
};

/// Masses and structural time step as in model/shared/mesh.hpp. Velocities of /INIVEL TRA and T+G
/// on node groups (a moving skew is noted in not_evaluated), then `velocities`, in order;
/// rotational velocities do not move nodes. Temperatures of /INITEMP, else T0 of /HEAT/MAT.
/// `engine`: Engine files; some options change the time step. `threads`: 0: all processors.
[[nodiscard]] State make_state(const Scene& scene, const std::vector<PartVelocity>& velocities = {},
                               const EngineFiles* engine = nullptr, int threads = 1);

/// An element that fails at a given time, for Idel.
struct DeadElement {
  ElementKind kind = ElementKind::shell4;
  std::uint32_t element = no_index;
  double from = 0.0;
};

struct CycleOptions {
  Model model = Model::robust;
  double dt1 = 0.0;   ///< last step; 0: first evaluation
  double dt12 = 0.0;  ///< mid-step interval, for incremental friction
  double time = 0.0;  ///< for Tstart, Tstop and sensors
  int threads = 1;
  bool keep_pairs = false;      ///< fill ContactOutcome::pairs
  double near_singular = 0.05;  ///< share of the gap; pairs with less left are counted
  double margin = 0.0;          ///< added to the search distance: pairs stay valid for some motion
  std::vector<DeadElement> dead;
  PlanOptions plan;
  std::function<void(ContactCard&)> change_card;  ///< changes the card before its evaluation
  /// Called with (contacts done, all contacts); may be empty.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// One evaluated pair with a penetration or force.
struct PairOutcome {
  CandidatePair at;  ///< positions in the contact's lists
  std::array<double, 4> weights{};
  std::array<double, 3> force{};  ///< on the main side; the secondary side has the opposite
  double normal_force = 0.0;      ///< signed, negative repels
  double penetration = 0.0, gap = 0.0, distance = 0.0;  ///< effective, after Inacti
  double k0 = 0.0, k_nodal = 0.0;
  std::int64_t status = 0;  ///< bits of Status
};

/// A secondary node or edge that leaves its interface after this evaluation.
struct Removal {
  enum class Because : std::uint8_t {
    mid_surface,     ///< the gap is used up
    kinematic_step,  ///< dtmin: half the time to the mid-surface; without a force in this cycle
    nodal_step,      ///< dtmin: contact stiffness against nodal mass; with the force of this cycle
    no_element_left  ///< Idel: all its elements failed
  };
  std::uint32_t secondary = 0;  ///< position in the contact's list
  Because because = Because::mid_surface;
};

/// A pair that ties or releases.
struct TieChange {
  CandidatePair at;
  bool tied = false;
};

/// IBC: fixed translations of a node before and after, 4 X + 2 Y + Z.
struct NodeRelease {
  NodeIndex node = no_index;
  std::uint8_t before = 0, after = 0;
};

/// Iadm: criteria of adaptive meshing for a node.
struct NodeCriteria {
  NodeIndex node = no_index;
  double radius = 1e30;      ///< smallest radius of curvature of its segments
  double penetration = 0.0;  ///< Iadm 2, secondary side: largest penetration / (Padm * gap)
  double angle = 1e30;       ///< Iadm 2, secondary side: smallest cosine / cosine of Angladm
};

/// Results of one contact.
struct ContactOutcome {
  const deck::Contact* contact = nullptr;
  ContactCard card;
  std::vector<EffectState> effects;
  std::string composition, isa;
  bool active = true;    ///< false: outside of its time window, or before its sensor
  bool complete = true;  ///< false: nothing was evaluated (too many pairs, values out of range)
  bool stiffness_known = true;  ///< false: of some law or property, so nothing was evaluated
  /// True if it was not evaluated although deck can evaluate its type.
  bool undecided() const { return !complete && !is_type24_or_25(contact->type); }
  std::size_t pairs_in_reach = 0;
  std::size_t pairs_with_force = 0;
  /// Within reach without a force: off since start-up, removed, or switched off in this cycle.
  std::size_t pairs_switched_off = 0;
  std::size_t pairs_tied = 0;
  std::vector<Removal> removed;        ///< items that leave the interface
  std::vector<TieChange> ties;         ///< pairs that tie or release
  std::vector<NodeRelease> released;   ///< translations that IBC releases
  std::vector<NodeCriteria> criteria;  ///< with Iadm only, by node
  Totals totals;                       ///< totals.dt_kinematic_pair is a position in the search
  double heat_secondary = 0.0, heat_main = 0.0;  ///< energy that each side receives in this cycle
  /// Time step; index is a node (kinematic: of that pair). If several contacts of a TYPE19 stiffen
  /// a node, the one with the largest stiffness has their common time step.
  StepLimit step;
  NodeIndex step_node = no_index;
  double largest_force = 0.0;  ///< of a single pair
  PairOutcome largest;
  double largest_acceleration = 0.0;
  NodeIndex acceleration_node = no_index;
  std::size_t massless_nodes = 0;  ///< nodes with force and without mass
  std::size_t gap_closed = 0;  ///< pairs at the mid-surface; the reference model drops their nodes
  std::vector<PairOutcome> near_singular;  ///< nearest to the mid-surface first, at most 20
  std::size_t near_singular_count = 0;
  std::vector<std::string> notes;  ///< options of the card that were ignored
  std::vector<PairOutcome> pairs;  ///< in the order of the search; filled with keep_pairs
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

/// Consecutive evaluations; contacts keep their history.
class CycleRun {
 public:
  /// The scene must outlive it and be built with penetrations and nodal stiffness. `remember`:
  /// false if only one evaluation follows.
  explicit CycleRun(const Scene& scene, bool remember = true);
  ~CycleRun();
  CycleRun(const CycleRun&) = delete;
  CycleRun& operator=(const CycleRun&) = delete;
  /// Evaluates with the nodes at `x`; areas and widths for heat are those of the scene. All calls
  /// must use the same model.
  [[nodiscard]] SceneOutcome evaluate(const Coordinates& x, const State& state,
                                      const CycleOptions& options);
  /// Number of pair searches of a contact.
  [[nodiscard]] std::size_t searches() const;

 private:
  struct Memory;
  const Scene* scene_;
  bool remember_;
  std::unique_ptr<Memory> memory_;
};

/// Evaluates all contacts once. The scene must be built with penetrations and nodal stiffness.
/// Threads do not change the result.
[[nodiscard]] SceneOutcome run_cycle(const Scene& scene, const State& state,
                                     const CycleOptions& options = {});

/// A node with contact force or stiffness.
struct ActedNode {
  NodeIndex node = no_index;
  std::array<double, 3> force{};  ///< sum over all contacts
  double stiffness = 0.0;         ///< sum over all contacts
  double dt = 1e30;  ///< 0.9 sqrt(2 m / stiffness); 1e30 without mass or stiffness: no limit
};
/// The acted nodes in mesh order. `state` must be the one of the outcome.
[[nodiscard]] std::vector<ActedNode> acted_nodes(const State& state, const SceneOutcome& outcome);

/// Results of all contacts of one interface.
struct InterfaceSummary {
  std::int64_t id = 0;
  const InterBase* inter = nullptr;
  bool active = false;  ///< at least one contact is active
  std::size_t pairs_in_reach = 0, pairs_with_force = 0;
  double largest_pair_force = 0.0;
  double force_sum = 0.0;  ///< sum of |pair force|
  double elastic_energy = 0.0, friction_energy = 0.0, damping_energy = 0.0;
  double largest_acceleration = 0.0;
  NodeIndex acceleration_node = no_index;
  double contact_dt = 1e30, structure_dt = 1e30;
  StepLimit::Source contact_dt_source = StepLimit::Source::none;
  NodeIndex contact_dt_node = no_index;
  std::size_t gap_closed = 0, near_singular = 0;
};
/// Sums the contacts of one interface; all outputs use it.
[[nodiscard]] InterfaceSummary summarize(const std::vector<const ContactOutcome*>& contacts,
                                         const StructureStep& structure);
/// One summary per interface of the scene, in the solver's order.
[[nodiscard]] std::vector<InterfaceSummary> summarize(const Scene& scene,
                                                      const SceneOutcome& outcome);

// Consecutive force evaluations with prescribed motion; contacts keep their history. Contact forces
// do not move nodes. Example: auto r = run_steps(scene, make_state(scene), options, 50);

/// One contact in one step.
struct StepContact {
  bool active = true;
  std::size_t pairs_with_force = 0, pairs_tied = 0;
  std::size_t removed = 0;  ///< secondary nodes or edges removed so far
  std::array<double, 3> normal{}, tangential{};
  double force_sum = 0.0;  ///< sum of |pair force|
  double elastic_energy = 0.0, friction_energy = 0.0, damping_energy = 0.0;
};

struct StepLine {
  double time = 0.0, dt1 = 0.0;
  std::vector<StepContact> contacts;  ///< parallel to Scene::contacts
};

/// An event at a node, edge or pair.
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
  Coordinates coordinates;  ///< of the last step; empty: one step without motion
  std::vector<StepLine> lines;
  std::vector<StepEvent> events;  ///< in time order
  std::size_t searches = 0;       ///< number of pair searches
};

/// Sets positions and velocities of the nodes for a step. May set the times (time, dt1, dt12) of
/// the options.
using Motion = std::function<void(std::size_t step, Coordinates&, State&, CycleOptions&)>;
using StepWatch = std::function<void(std::size_t step, const SceneOutcome&, const Coordinates&)>;

/// Evaluates `steps` times. Without `motion` nodes keep their velocities v: in step k the time is
/// options.time + k dt1 and the displacement k dt1 v; step 0 equals run_cycle. History of contacts:
/// friction, filters, ties, gaps of Inacti 5 and 6, removed nodes and edges (dtmin, mid-surface,
/// Idel), released translations. Searches pairs again when nodes leave the searched range. Threads
/// do not change the result.
[[nodiscard]] StepsOutcome run_steps(const Scene& scene, const State& state, CycleOptions options,
                                     std::size_t steps, const Motion& motion = {},
                                     const StepWatch& watch = {});

}  // namespace deck::cycle
