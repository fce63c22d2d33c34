// Geometry in lint: builds the contacts of the deck and reports the rules DK3xx — penetrations,
// gaps against the mesh, segments that cannot work — and DK4xx: forces and time step of the first
// cycle.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/lint.hpp"
#include "lint/shared/gate.hpp"

namespace deck {

/// How much is checked by default. Counts that are known from the deck
/// decide, no clock: a deck has the same findings on every machine.
struct QuickLook {
  std::uint64_t items = 1'000'000;  ///< nodes, elements and members of the sides of all contacts
  std::uint64_t pair_bytes = std::uint64_t{64} << 20;  ///< see Limits::pair_bytes
};

struct GeometryOptions {
  std::optional<QuickLook> quick = {};  ///< nullopt: all is looked at
  const Gate* gate = nullptr;           ///< what passes over it is reported, too
  const GapBaseline* earlier = nullptr;
  const ChangedLines* changed = nullptr;  ///< what the gate says is noted there
  std::size_t* too_large = nullptr;       ///< gets how many contacts only a quick look left out
  /// Called with what was looked at; may be empty.
  std::function<void(const Scene&, const SceneView&)> seen = {};
};

/// An extra check for run_lint, of the scene that the LoadedDeck of the context has, but for a
/// quick look; returns what that left out. The number of candidates is not looked at.
///
///   run_lint(loaded, options,
///            {[](const LintContext& c, Reporter& r) { return check_geometry(c, r); }});
///
std::vector<NotChecked> check_geometry(const LintContext& context, Reporter& reporter,
                                       const GeometryOptions& options = {});

}  // namespace deck
