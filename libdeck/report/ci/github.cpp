// Findings as workflow commands of GitHub Actions.
#include <algorithm>
#include <vector>

#include "base/shared/escape.hpp"
#include "report/diagnostics_common.hpp"

namespace deck {

std::string lint_github(const std::vector<LintedDeck>& decks, const std::string& source_root) {
  struct Item {
    const LintedDeck* deck;
    const Diagnostic* d;
  };
  std::vector<Item> items;
  const detail::SourceRoot root(source_root);
  std::string out, leads, notices, tails;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) {
      out += "::error file=" + workflow_property(root.place(deck.path)) +
             ",title=deck::" + workflow_text(deck.error) + "\n";
      continue;
    }
    for (const Diagnostic& d : deck.result->diagnostics) items.push_back({&deck, &d});
    const auto coverage = detail::coverage_of(deck);
    if (!coverage) continue;
    const std::string lead = coverage_lead(*coverage), tail = coverage_tail(*coverage);
    const auto command = [&](const char* level, std::string_view text) {
      return std::string("::") + level + " file=" + workflow_property(root.place(deck.path)) +
             ",title=not examined::" + workflow_text(text) + "\n";
    };
    if (!lead.empty()) leads += command("warning", lead + tail);
    if (lead.empty() && !tail.empty()) tails += command("notice", tail.substr(1));
  }
  // Only the first annotations of a step are shown.
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.d->severity < b.d->severity; });
  for (const Item& item : items) {
    const Diagnostic& d = *item.d;
    const detail::Place at = detail::place_of(*item.deck, d.span);
    const char* const command = d.severity == Severity::error     ? "error"
                                : d.severity == Severity::warning ? "warning"
                                                                  : "notice";
    (d.severity == Severity::info ? notices : out) +=
        std::string("::") + command + " file=" + workflow_property(root.place(at.file)) +
        ",line=" + std::to_string(at.line) + ",col=" + std::to_string(at.column) +
        ",endColumn=" + std::to_string(at.end_column) + ",title=" + finding_name(d) +
        "::" + workflow_text(d.message + ". " + detail::details(d)) + "\n";
  }
  return out + leads + notices + tails;
}

}  // namespace deck
