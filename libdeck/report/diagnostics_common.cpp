// Place, severity and details of a finding as all writers of lint results show them.
#include "report/shared/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/shared/paths.hpp"
#include "lint/shared/gate.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {
namespace {

/// What was found, without what a gate says: its rules are errors or warnings by their pages.
LintFacts facts_of(const LintResult& r) {
  LintFacts facts{r.errors, r.warnings, r.infos, false};
  for (const RuleId rule : gate_rules) {
    const auto found = r.counts.find(rule);
    const auto first = std::find_if(r.diagnostics.begin(), r.diagnostics.end(),
                                    [&](const Diagnostic& d) { return d.rule == rule; });
    if (found == r.counts.end() || first == r.diagnostics.end()) continue;
    (first->severity == Severity::error     ? facts.errors
     : first->severity == Severity::warning ? facts.warnings
                                            : facts.remarks) -= found->second;
  }
  return facts;
}

}  // namespace

Verdict lint_verdict(const LintedDeck& linted, std::optional<ContactFacts> contacts,
                     bool contacts_left_out) {
  VerdictInput in;
  in.deck = linted.of_interfaces != nullptr ? linted.of_interfaces : linted.deck;
  in.interfaces = linted.interfaces;
  in.lint = facts_of(*linted.result);
  in.lint->contacts_left_out = contacts_left_out;
  in.contacts = std::move(contacts);
  return make_verdict(in);
}

namespace detail {

Place place_of(const LintedDeck& linted, const Span& span) {
  Place out;
  out.file = linted.path;
  if (linted.deck == nullptr || !span.valid()) return out;
  const Source& source = linted.deck->sources[span.file];
  out.file = source.path();
  const Position begin = source.position(span.offset);
  out.line = begin.line;
  out.column = begin.column;
  // A span never crosses its line here: editors want one line per finding.
  const std::string_view line = source.line_at(span.offset);
  const std::uint64_t end_of_line = line.size() + 1;
  out.end_column = std::clamp<std::uint64_t>(begin.column + span.length, begin.column,
                                             std::max(end_of_line, begin.column));
  out.known = true;
  return out;
}

std::string Place::text() const {
  return known ? fmt::format("{}:{}:{}", file, line, column) : file;
}

std::string details(const Diagnostic& d) {
  std::string out;
  if (!d.reference_behaviour.empty())
    out += "Reference solver: " + with_message(d.reference_behaviour, d.reference);
  if (!d.help.empty()) out += (out.empty() ? "" : " ") + std::string("Fix: ") + d.help;
  return out;
}

std::optional<Coverage> coverage_of(const LintedDeck& linted) {
  if (linted.deck == nullptr || linted.interfaces == nullptr) return std::nullopt;
  const Deck* const deck = linted.of_interfaces != nullptr ? linted.of_interfaces : linted.deck;
  return deck::coverage_of(*deck, *linted.interfaces, Examined::contacts_and_ties);
}

std::string SourceRoot::place(std::string_view file) const {
  namespace fs = std::filesystem;
  if (root_.empty())
    while (file.starts_with("./")) file.remove_prefix(2);
  if (root_.empty() || file == "-") return std::string(file);
  const fs::path whole = absolute_path(std::string(file));
  const fs::path relative = whole.lexically_relative(root_);
  const bool below = !relative.empty() && *relative.begin() != "..";
  return (below ? relative : whole).generic_string();
}

}  // namespace detail
}  // namespace deck
