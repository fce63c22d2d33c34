// Geometry in lint: builds the contacts and reports rules DK3xx (penetrations, gaps, segments) and
// DK4xx (forces and time step of the first cycle).
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/lint.hpp"
#include "lint/shared/gate.hpp"

namespace deck {

/// Limits of the default check. They count items of the deck, so findings do not depend on the
/// machine.
struct QuickLook {
  std::uint64_t items = 1'000'000;  ///< nodes, elements and members of the sides of all contacts
  std::uint64_t pair_bytes = std::uint64_t{64} << 20;  ///< see Limits::pair_bytes
};

struct GeometryOptions {
  std::optional<QuickLook> quick = {};  ///< nullopt: no limits
  const Gate* gate = nullptr;           ///< its exceeded bounds are reported, too
  const GapBaseline* earlier = nullptr;
  const ChangedLines* changed = nullptr;  ///< noted in gate findings
  std::size_t* too_large = nullptr;  ///< receives the number of contacts left out by the limits
  /// Called with the scene and view; may be empty.
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
