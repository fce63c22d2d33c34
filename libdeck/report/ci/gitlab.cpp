// Findings as a Code Quality report of GitLab.
#include <map>

#include "report/diagnostics_common.hpp"
#include "report/shared/json.hpp"

namespace deck {

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
      json.begin_object();
      json.field("description", d.message + ". " + detail::details(d))
          .field("check_name", finding_name(d))
          .field("fingerprint", print)
          .field("severity", d.severity == Severity::error     ? "major"
                             : d.severity == Severity::warning ? "minor"
                                                               : "info");
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
