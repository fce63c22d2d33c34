// Geometry in lint: builds the contacts of the deck and reports the rules DK3xx — penetrations,
// gaps against the mesh, segments that cannot work — and DK4xx: forces and time step of the first
// cycle. Costs more than all other rules together, so it
// runs only where it is asked for.
#pragma once
#include "deck/contact/scene.hpp"
#include "deck/lint/gate.hpp"
#include "deck/lint/lint.hpp"

namespace deck {

/// A check for LintInput::extra_checks:
///
///   input.extra_checks.push_back([](const LintContext& c, Reporter& r) { check_geometry(c, r); });
///
struct GeometryOptions {
  int threads = 1;  ///< changes no finding
  Limits limits = {};
  const Gate* gate = nullptr;  ///< what passes over it is reported, too
  const EarlierGaps* earlier = nullptr;
};

/// Does nothing where the context has no model or interfaces.
void check_geometry(const LintContext& context, Reporter& reporter,
                    const GeometryOptions& options = {});

}  // namespace deck
