// One-cycle contact forces: evaluates a packet of pairs under a plan.
// Example: auto plan = make_plan(card); PacketResult out; evaluate(plan, view, out);
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "deck/cycle/packet.hpp"

namespace deck::cycle {

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

/// The same sums of results that come piece by piece: those of one result in any pieces. The plan
/// outlives it.
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

}  // namespace deck::cycle
