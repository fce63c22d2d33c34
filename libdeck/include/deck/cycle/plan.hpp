// The composition of one interface's force kernel: which effects run, what they read and write,
// chosen once from the card so that the loop over pairs asks nothing.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "deck/cycle/card.hpp"
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
///    force instead of adding up (sharing.hpp; whole contacts only);
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

}  // namespace deck::cycle
