// The gate and the comparison with an earlier run, a line each.
#include <fmt/format.h>

#include "base/shared/escape.hpp"
#include "report/shared/gate.hpp"
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
    std::size_t lost = 0;
    for (const auto& [inter, nodes] : c.lost_ties) lost += nodes.size();
    if (lost > 0)
      out += count(lost, "node was tied there and is", "nodes were tied there and are") +
             " not any more.\n";
  }
  if (!gate.asked) return out;
  if (gate.findings.empty()) return out + "Gate: passed.\n";
  return out +
         fmt::format("Gate: not passed, {}.\n", count(gate.findings.size(), "finding", "findings"));
}

}  // namespace deck
