// Counts the findings at which the solver stops.
#include "deck/model/stops.hpp"

#include <algorithm>

#include "deck/text/rule_id.hpp"

namespace deck {

std::string stops_text(const Deck& deck) {
  const auto& all = deck.diagnostics.all();
  const auto stops = std::count_if(all.begin(), all.end(), [](const Diagnostic& d) {
    return d.severity == Severity::error && d.reference &&
           d.reference->severity == Severity::error && d.rule != RuleId::DK172 &&
           d.rule != RuleId::DK173;
  });
  if (stops == 0) return {};
  return " The solver stops first: " + std::to_string(stops) + (stops == 1 ? " error" : " errors") +
         " in the deck ('deck lint' explains).";
}

}  // namespace deck
