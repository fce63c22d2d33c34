// The gate: bounds that a team sets for its contacts. What passes over one is a finding of the
// rules DK370 to DK375, whichever verb looks.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/contact/earlier.hpp"
#include "deck/contact/view.hpp"
#include "deck/cycle/scene_cycle.hpp"
#include "deck/text/rule.hpp"
#include "lint/shared/changed_lines.hpp"

namespace deck {

/// Bounds; what is not set does not bound.
struct GateLimits {
  std::optional<double> max_depth;          ///< of a penetration, working units
  std::optional<double> max_ratio;          ///< penetration over gap
  std::optional<double> max_dt_loss;        ///< 1 - contact step / step of the mesh
  std::optional<std::uint64_t> max_count;   ///< penetrating nodes and edges, each once
  std::optional<std::uint64_t> max_untied;  ///< nodes of /INTER/TYPE2 that are not tied
};

/// Bounds for some interfaces, or for some pairs of parts, instead of the general ones.
struct GateScope {
  std::vector<std::string> match;  ///< patterns of id or title: one of an interface, two of parts
  GateLimits limits;
};

struct Gate {
  GateLimits general;                 ///< max_count, max_untied: of the whole deck
  std::vector<GateScope> interfaces;  ///< [[gate.interface]]; the last that matches holds
  std::vector<GateScope> part_pairs;  ///< [[gate.part-pair]], either way round; before interfaces
  bool on_fresh = false, on_worse = false;  ///< --fail-on new, worse: against an earlier run

  /// True if some bound or comparison was asked for.
  bool any() const;
  /// True if a bound on the time step was: forces have to be evaluated for it.
  bool needs_forces() const;
};

/// What passes over the gate, as findings at the interfaces' headers (the deck's first line where
/// all of them are meant), in deck order; with a note on the deepest node and, with `changed`, on
/// the changed line that they follow from (see stand_at_changes). `forces` and `earlier` may be
/// nullptr; then what they are needed for is not looked at.
std::vector<Diagnostic> check_gate(const Gate& gate, const Scene& scene, const SceneView& view,
                                   const cycle::SceneOutcome* forces, const EarlierGaps* earlier,
                                   const ChangedLines* changed = nullptr);

}  // namespace deck
