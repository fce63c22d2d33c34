// The gate and the comparison with an earlier run, a line each.
#include <fmt/format.h>

#include "deck/base/escape.hpp"
#include "deck/report/gate.hpp"
#include "report/terminal/words.hpp"

namespace deck {

std::string gate_text(const GateReport& gate) {
  std::string out;
  if (gate.earlier != nullptr) {
    const GapsComparison& c = gate.comparison;
    out += fmt::format(
        "Penetrating nodes and edges against {}: {} new, {} worse, {} better, {} the same, {} "
        "solved.\n",
        terminal_text(gate.earlier->path), c.count(Trend::fresh), c.count(Trend::worse),
        c.count(Trend::better), c.count(Trend::same), c.solved.size());
  }
  if (!gate.asked) return out;
  if (gate.findings.empty()) return out + "Gate: passed.\n";
  return out +
         fmt::format("Gate: not passed, {}.\n", count(gate.findings.size(), "finding", "findings"));
}

}  // namespace deck
