// What a gate said about a deck, and how its penetrations differ from an earlier run: for the
// documents and texts of every verb that has a gate.
#pragma once
#include <string>
#include <vector>

#include "deck/contact/earlier.hpp"
#include "deck/keyword/deck.hpp"
#include "deck/lint/gate.hpp"
#include "deck/report/json.hpp"

namespace deck {

struct GateReport {
  bool asked = false;                ///< some bound was set, or new and worse were asked for
  std::vector<Diagnostic> findings;  ///< what check_gate gave
  std::size_t undecided = 0;         ///< contacts that could not be evaluated
  const EarlierGaps* earlier = nullptr;
  GapsComparison comparison;  ///< with `earlier`

  /// Nothing passes over the bounds, and that is known of every contact.
  bool passed() const { return findings.empty() && undecided == 0; }
};

/// Members "gate" {passed, undecided, findings} and "compared" {with, new, worse, better, same,
/// solved, rows}, null where they were not asked for.
void write_gate(JsonWriter& json, const Deck& deck, const Scene& scene, const SceneView& view,
                const GateReport& gate);
/// Both in a line each; "" if neither was asked for.
std::string gate_text(const GateReport& gate);

}  // namespace deck
