// What is said of a deck: its verdict, what a gate said about it, and how its penetrations differ
// from an earlier run; for the documents and texts of every verb.
#pragma once
#include <string>
#include <vector>

#include "deck/contacts.hpp"
#include "deck/keyword.hpp"
#include "deck/verdict.hpp"
#include "lint/shared/gate.hpp"
#include "report/shared/findings.hpp"
#include "report/shared/json.hpp"

namespace deck {

/// A verdict as JSON: level, text, sentences with their counts, counts of all.
std::string verdict_json(const Verdict& verdict);
/// The text as a line.
std::string verdict_text(const Verdict& verdict, bool color);

struct GateReport {
  bool asked = false;             ///< some bound was set, or new and worse were asked for
  std::vector<Finding> findings;  ///< what check_gate gave
  std::size_t undecided = 0;      ///< contacts that could not be evaluated
  const GapBaseline* earlier = nullptr;
  GapsComparison comparison;  ///< with `earlier`

  /// Nothing passes over the bounds, and that is known of every contact.
  bool passed() const { return findings.empty() && undecided == 0; }
};

/// Holds the contacts against the gate. `forces`, `earlier` and `changed` may be nullptr, as in
/// check_gate; the report refers to `earlier`.
GateReport gate_report(const Gate& gate, const Scene& scene, const SceneView& view,
                       const cycle::SceneOutcome* forces, const GapBaseline* earlier,
                       const ChangedLines* changed = nullptr);
/// Contacts that could not be evaluated.
std::size_t undecided_contacts(const Scene& scene);

/// Members "gate" {passed, undecided, findings} and "compared" {with, new, worse, better, same,
/// solved, rows}, null where they were not asked for.
void write_gate(JsonWriter& json, const Deck& deck, const Scene& scene, const SceneView& view,
                const GateReport& gate);
/// What `deck gate --json` writes of a deck that could be read: the findings that it stops at, and
/// the comparison in numbers.
std::string gate_json(const LintedDeck& deck, const GateReport& gate,
                      const std::vector<const Finding*>& stops, bool passed);
/// Both in a line each; "" if neither was asked for.
std::string gate_text(const GateReport& gate);

}  // namespace deck
