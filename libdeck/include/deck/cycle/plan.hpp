// The composition of one interface's force kernel: which effects run, what they read and write,
// chosen once from the card so that the loop over pairs asks nothing.
#ifndef DECK_CYCLE_PLAN_HPP_
#define DECK_CYCLE_PLAN_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "deck/cycle/card.hpp"
#include "deck/cycle/packet.hpp"

namespace deck::cycle {

/// The numerical model. `reference` reproduces the published solver guard for guard (the recorded
/// states decide). `robust` is the same physics without its numerical quirks. What differs, and by
/// how much in a telling case (tests/cycle/model_differences_test.cpp holds the figures):
///  * node–segment: the closest of the four sub-triangles gives normal, distance and weights, with
///    relative guards; no blending, no shift of weights, the same weights for velocity and force
///    (power at the pair = power at the nodes; normal forces keep moment balance). On a flat square
///    the blend tilts the normal by up to 25 degrees, a side force of 0.43 of the whole;
///  * neighbouring segments or edges that meet the other side at the same edge or corner share one
///    force instead of adding up (see sharing.hpp; whole contacts only, single pairs stay alone):
///    2 times over an edge, 4 times over a corner of a regular mesh;
///  * the law works with the distance d itself: F = k g (g-d)/d, energy by log1p: the reference is
///    off by 1e-16 g/d (1e-9 at d/g = 2e-8), and by half at d = 5e-11 length units, below its
///    floor; under d/g = 1e-8 the robust law continues as its tangent (C1), the reference drops
///    the node under 1e-10;
///  * a node on the surface takes the facet normal instead of none (no force at all there);
///  * damping uses the reduced mass of both sides (0.89 of the dashpot at the centre of a square of
///    equal nodes, 0.71 at a corner), never pulls, and its work is booked;
///  * friction is limited by max(0,-Fn) instead of |Fn|; the old tangential force keeps its length
///    when turned into the new tangent plane (0.87 is left after 30 degrees); its stiffness is at
///    most the normal tangent stiffness (half, at the edge of the gap);
///  * filters: a true low-pass with weight at most 1, limit applied after it; Ifiltr 2 and 3 as
///    documented (2 pi Xfreq, 2 pi Xfreq dt): at 1000 per time and dt 1e-6 the reference does not
///    filter, the robust model takes 0.6 % of the new force;
///  * AscaleF is applied; temperature friction uses this cycle's weights;
///  * no mechanical action without penetration (with Drad beyond the gap the reference damps and
///    rubs at a distance); a gap used up by Inacti switches the pair off (no number otherwise);
///  * edge–edge: relative parallel test, parallel edges meet at the middle of their overlap (the
///    reference at either end, by the order of nodes), crossing edges take e_s x e_m as normal, no
///    0.9 on the gap (1.13 times the force at half the gap), fixed stiffness is Stfac (a quarter of
///    it in the reference);
///  * conduction counts the gap distance on both sides (on one in the reference: the heat changes
///    with the orientation of the segment); radiation reports a conductance; the share of friction
///    heat that has no receiver (Ithe_form 0) is not booked;
///  * a sensor replaces Tstart/Tstop.
/// Unchanged in both: Inacti relaxes per cycle (the card gives no time constant), clamps act
/// before the 1/2, the viscosity scale sqrt(2 k M).
enum class Model { reference, robust };

/// Instruction set of the compiled kernels, as far as the processor has it. All give the same bits.
enum class Isa { automatic, baseline, avx2, avx512 };

struct PlanOptions {
  bool energies = true;        ///< book elastic energy (costs one logarithm per pair)
  bool force_generic = false;  ///< use the run-time-flag kernel even for a composed set
  Isa isa = Isa::automatic;
};

/// Effects inside the pair loop, as bits of a composition.
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
  friction_pairs = 1u << 8,
  filter = 1u << 9,
  friction_orthotropic = 1u << 10,
  fixed_stiffness = 1u << 11,  ///< Istf 1 of node-segment pairs
};
using EffectSet = std::uint32_t;
constexpr EffectSet bit(Effect e) { return static_cast<EffectSet>(e); }

namespace detail {
struct KernelTable;
struct Constants;
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
};

/// Chooses the kernel for a card. Never fails: a card without any force gives a plan whose
/// effects are off, with the reasons.
[[nodiscard]] KernelPlan make_plan(const ContactCard& card, Model model = Model::reference,
                                   const PlanOptions& options = {});

/// The account of a card without choosing a kernel: each effect, on or off, and the deciding field.
[[nodiscard]] std::vector<EffectState> effect_plan(const ContactCard& card);

}  // namespace deck::cycle

#endif  // DECK_CYCLE_PLAN_HPP_
