#include <algorithm>
#include <vector>

#include "report/diagnostics_common.hpp"

namespace deck {
namespace {

/// Escapes what workflow commands use themselves; properties also escape ':' and ','.
std::string escaped(std::string_view text, bool property) {
  std::string out;
  for (const char c : text) {
    if (c == '%')
      out += "%25";
    else if (c == '\r')
      out += "%0D";
    else if (c == '\n')
      out += "%0A";
    else if (property && c == ':')
      out += "%3A";
    else if (property && c == ',')
      out += "%2C";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string lint_github(const std::vector<LintedDeck>& decks) {
  struct Item {
    const LintedDeck* deck;
    const Diagnostic* d;
  };
  std::vector<Item> items;
  std::string out;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) {
      out += "::error file=" + escaped(detail::relative_path(deck.path), true) +
             ",title=deck::" + escaped(deck.error, false) + "\n";
      continue;
    }
    for (const Diagnostic& d : deck.result->diagnostics) items.push_back({&deck, &d});
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
    out += std::string("::") + command + " file=" + escaped(detail::relative_path(at.file), true) +
           ",line=" + std::to_string(at.line) + ",col=" + std::to_string(at.column) +
           ",endColumn=" + std::to_string(at.end_column) + ",title=" + std::string(d.rule) +
           "::" + escaped(d.message + ". " + detail::details(d), false) + "\n";
  }
  return out;
}

}  // namespace deck
