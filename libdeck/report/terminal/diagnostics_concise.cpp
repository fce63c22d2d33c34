// Findings for people and for programs that read lines: one line each, or one line a rule with its
// numbers.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/shared/escape.hpp"
#include "report/diagnostics_common.hpp"
#include "report/shared/text_table.hpp"

namespace deck {
namespace concise_findings {
namespace {

/// Findings of a rule in all decks.
struct RuleNumbers {
  std::uint64_t findings = 0, safe = 0, unsafe = 0;
  std::optional<Severity> severity;  ///< the highest among those that are kept
};

std::string fixable_text(const RuleNumbers& n) {
  std::string out = n.safe > 0 ? std::to_string(n.safe) : "";
  if (n.unsafe > 0) out += fmt::format("{}{} unsafe", out.empty() ? "" : ", ", n.unsafe);
  return out;
}

}  // namespace
}  // namespace concise_findings

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
  std::map<RuleId, concise_findings::RuleNumbers> rules;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    for (const Diagnostic& d : deck.result->diagnostics) {
      concise_findings::RuleNumbers& n = rules[d.rule];
      ++n.findings;
      n.severity = n.severity ? std::min(*n.severity, d.severity) : d.severity;
      if (d.fix) ++(d.fix->safe ? n.safe : n.unsafe);
    }
    for (const auto& [rule, n] : deck.result->dropped) rules[rule].findings += n;
  }
  std::vector<std::pair<RuleId, concise_findings::RuleNumbers>> sorted(rules.begin(), rules.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.second.findings > b.second.findings;
  });
  TextTable table(
      {{"rule"}, {"count", Align::right}, {"fixable", Align::right}, {"severity"}, {"title"}});
  std::uint64_t all = 0;
  for (const auto& [id, n] : sorted) {
    const Rule& rule = rule_of(id);
    all += n.findings;
    table.row({std::string(id_text(id)), std::to_string(n.findings),
               concise_findings::fixable_text(n), to_string(n.severity.value_or(rule.severity())), rule.title});
  }
  if (table.size() == 0) return "no findings\n";
  return table.fitted(width, color) + fmt::format("{} {} of {} {}\n", all,
                                                  all == 1 ? "finding" : "findings", sorted.size(),
                                                  sorted.size() == 1 ? "rule" : "rules");
}

}  // namespace deck
