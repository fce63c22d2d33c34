// Findings as workflow commands of GitHub Actions.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/shared/escape.hpp"
#include "report/diagnostics_common.hpp"

namespace deck {

std::string lint_github(const std::vector<LintedDeck>& decks, const std::string& source_root) {
  std::vector<std::pair<const LintedDeck*, const Diagnostic*>> found;
  const detail::SourceRoot root(source_root);
  // `more`: further properties of the command
  const auto command = [&](const char* level, std::string_view file, const std::string& more,
                           std::string_view text) {
    return fmt::format("::{} file={},{}::{}\n", level, workflow_property(root.place(file)), more,
                       workflow_text(text));
  };
  std::string out, leads, notices, tails;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) {
      out += command("error", deck.path, "title=deck", deck.error);
      continue;
    }
    for (const Diagnostic& d : deck.result->diagnostics) found.emplace_back(&deck, &d);
    const auto coverage = detail::coverage_of(deck);
    if (!coverage) continue;
    const std::string lead = coverage_lead(*coverage), tail = coverage_tail(*coverage);
    if (!lead.empty()) leads += command("warning", deck.path, "title=not examined", lead + tail);
    if (lead.empty() && !tail.empty())
      tails += command("notice", deck.path, "title=not examined", tail.substr(1));
  }
  // Only the first annotations of a step are shown.
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.second->severity < b.second->severity;
  });
  for (const auto& [deck, d] : found) {
    const bool remark = d->severity == Severity::info;
    const detail::Place at = detail::place_of(*deck, d->span);
    (remark ? notices : out) += command(remark ? "notice" : to_string(d->severity), at.file,
                                        fmt::format("line={},col={},endColumn={},title={}", at.line,
                                                    at.column, at.end_column, finding_name(*d)),
                                        d->message + ". " + detail::details(*d));
  }
  return out + leads + notices + tails;
}

}  // namespace deck
