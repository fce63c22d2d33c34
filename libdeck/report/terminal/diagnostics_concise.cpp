// Findings and the gate in lines: one line per finding, one per rule with its numbers, one per
// gate.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/shared/escape.hpp"
#include "report/shared/gate.hpp"
#include "report/terminal/words.hpp"

namespace deck {
namespace {

/// Findings of a rule in all decks.
struct RuleNumbers {
  std::uint64_t findings = 0, safe = 0, unsafe = 0;
  std::set<Severity> severities = {};  ///< with which they are shown
};

}  // namespace

std::string lint_concise(const std::vector<LintedDeck>& decks) {
  std::string out;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    for (const Diagnostic& d : deck.result->diagnostics) {
      const detail::Place at = detail::place_of(deck, d.span);
      out += fmt::format("{}:{}:{}: {} {}: {}\n", terminal_text(at.file), at.line, at.column,
                         finding_name(d), to_string(d.severity), terminal_text(d.message));
    }
    for (const auto& [rule, n] : deck.result->dropped)
      if (n > 0)
        out += fmt::format("{}:1:1: {} info: {} more of this rule are not kept\n",
                           terminal_text(deck.path), id_text(rule), n);
  }
  return out;
}

std::string lint_statistics(const std::vector<LintedDeck>& decks, bool color, std::size_t width) {
  std::map<RuleId, RuleNumbers> rules;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    for (const Diagnostic& d : deck.result->diagnostics) {
      RuleNumbers& n = rules[d.rule];
      ++n.findings;
      n.severities.insert(d.severity);
      if (d.fix) ++(d.fix->safe ? n.safe : n.unsafe);
    }
    for (const auto& [rule, n] : deck.result->dropped) rules[rule].findings += n;
  }
  std::vector<std::pair<RuleId, RuleNumbers>> sorted(rules.begin(), rules.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.second.findings > b.second.findings;
  });
  TextTable table({"rule", ">count", ">fixable", "severity", "title"});
  std::uint64_t all = 0;
  for (const auto& [id, n] : sorted) {
    all += n.findings;
    std::string fixable = n.safe > 0 ? std::to_string(n.safe) : "";
    if (n.unsafe > 0) append(fixable, ", ", fmt::format("{} unsafe", n.unsafe));
    std::string severities;
    for (const Severity s : n.severities) append(severities, ", ", to_string(s));
    table.row({id_text(id), n.findings, fixable, severities, rule_of(id).title});
  }
  if (table.size() == 0) return "no findings\n";
  return table.fitted(width, color) + fmt::format("{} of {}\n", count(all, "finding", "findings"),
                                                  count(sorted.size(), "rule", "rules"));
}

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
