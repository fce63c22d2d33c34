// Findings: place, verdict and details as all writers of lint results show them; one line per
// finding, one per rule with its numbers, one per gate.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/shared/escape.hpp"
#include "base/shared/paths.hpp"
#include "lint/shared/gate.hpp"
#include "report/shared/diagnostics.hpp"
#include "report/shared/gate.hpp"
#include "report/terminal/words.hpp"
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
