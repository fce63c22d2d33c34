// A packet of contact pairs as structure of arrays: what the kernel reads, what it writes.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace deck::cycle {

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

/// What is known of n pairs, an array of n entries each: pointers where a kernel reads them,
/// vectors where they are made. Roles of a node–segment pair: 0 the secondary node, 1..4 the
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

}  // namespace deck::cycle
