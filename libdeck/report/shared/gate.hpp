// Verdict on a deck, result of a gate, and comparison of penetrations with an earlier run, for
// documents and texts of all verbs.
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

/// A verdict as JSON: level, text, sentences with counts, counts of all.
std::string verdict_json(const Verdict& verdict);
/// The text as one line.
std::string verdict_text(const Verdict& verdict, bool color);

struct GateReport {
  bool asked = false;             ///< a bound, new or worse was wanted
  std::vector<Finding> findings;  ///< from check_gate
  std::size_t undecided = 0;      ///< contacts that could not be evaluated
  const GapBaseline* earlier = nullptr;
  GapsComparison comparison;  ///< with `earlier`

  /// True if all contacts were evaluated and keep the bounds.
  bool passed() const { return findings.empty() && undecided == 0; }
};

/// Tests contacts against the gate. `forces`, `earlier` and `changed` may be nullptr, see
/// check_gate; the report refers to `earlier`.
GateReport gate_report(const Gate& gate, const Scene& scene, const SceneView& view,
                       const cycle::SceneOutcome* forces, const GapBaseline* earlier,
                       const ChangedLines* changed = nullptr);
/// Number of contacts that could not be evaluated.
std::size_t undecided_contacts(const Scene& scene);

/// Members "gate" {passed, undecided, findings} and "compared" {with, new, worse, better, same,
/// solved, rows}; null if not wanted.
void write_gate(JsonWriter& json, const Deck& deck, const Scene& scene, const SceneView& view,
                const GateReport& gate);
/// Document of `deck gate --json` for a readable deck: findings that stop it, and the comparison as
/// numbers.
std::string gate_json(const LintedDeck& deck, const GateReport& gate,
                      const std::vector<const Finding*>& stops, bool passed);
/// One line each; "" if neither was wanted.
std::string gate_text(const GateReport& gate);

}  // namespace deck
