// Findings for forges: workflow commands of GitHub Actions, a Code Quality report of GitLab.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "base/shared/escape.hpp"
#include "report/diagnostics_common.hpp"
#include "report/shared/json.hpp"

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

std::string lint_gitlab(const std::vector<LintedDeck>& decks, const std::string& source_root) {
  std::string out;
  JsonWriter json(out);
  json.begin_array();
  std::map<std::string, int> seen;
  const detail::SourceRoot root(source_root);
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    for (std::size_t i = 0; i < deck.result->diagnostics.size(); ++i) {
      const Diagnostic& d = deck.result->diagnostics[i];
      const detail::Place at = detail::place_of(deck, d.span);
      // Fingerprints must be unique in a report; equal findings get a number.
      std::string print = deck.result->fingerprints[i];
      if (const int n = seen[print]++; n > 0) print += "-" + std::to_string(n);
      static constexpr const char* severities[] = {"major", "minor", "info"};
      json.begin_object().field("description", d.message + ". " + detail::details(d));
      json.field("check_name", finding_name(d)).field("fingerprint", print);
      json.field("severity", severities[static_cast<std::size_t>(d.severity)]);
      json.key("location").begin_object().field("path", root.place(at.file));
      json.key("lines").begin_object(true).field("begin", at.line).end_object();
      json.end_object().end_object();
    }
  }
  json.end_array();
  if (out.back() != '\n') out += '\n';
  return out;
}

}  // namespace deck
