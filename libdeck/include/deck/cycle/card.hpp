// The effective values of one contact interface, as plain numbers: all that the force kernel has
// to know about the card. Independent of how a deck is read; an adapter fills it.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace deck::cycle {

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
