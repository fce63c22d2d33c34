// Findings as frames of code with a caret, for people.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "deck/base/escape.hpp"
#include "deck/report/text_table.hpp"
#include "report/diagnostics_common.hpp"

namespace deck {
namespace {

constexpr std::size_t line_window = 110;  ///< columns of a card line that are shown

struct Colors {
  const char *error, *warning, *info, *bold, *blue, *off;
};
constexpr Colors no_colors = {"", "", "", "", "", ""};
constexpr Colors ansi = {"\x1b[1;31m", "\x1b[1;33m", "\x1b[1;36m",
                         "\x1b[1m",    "\x1b[1;34m", "\x1b[0m"};

/// Columns 10, 20, ... as an editor's ruler shows them.
std::string ruler_text(std::size_t first, std::size_t count) {
  std::string out;
  for (std::size_t c = first; c < first + count; ++c)
    out += c % 10 == 0 ? static_cast<char>('0' + c / 10 % 10) : c % 5 == 0 ? '+' : '.';
  return out;
}

class Human {
 public:
  Human(const LintedDeck& deck, const HumanOptions& options)
      : deck_(deck), options_(options), c_(options.color ? ansi : no_colors) {}

  std::string findings() {
    std::string out;
    std::map<RuleId, int> shown;
    std::map<RuleId, std::uint64_t> hidden;
    for (const Diagnostic& d : deck_.result->diagnostics) {
      if (options_.per_rule > 0 && shown[d.rule] >= options_.per_rule) {
        ++hidden[d.rule];
        continue;
      }
      ++shown[d.rule];
      out += one(d);
    }
    for (const auto& [rule, count] : deck_.result->dropped) hidden[rule] += count;
    for (const auto& [rule, count] : hidden)
      out += fmt::format("{}...{} {} more findings of {}{}{}: {}\n", c_.bold, c_.off, count,
                         c_.bold, id_text(rule), c_.off, rule_of(rule).title);
    if (!hidden.empty()) out += "\n";
    return out;
  }

  std::string summary() {
    const LintResult& r = *deck_.result;
    std::string out = fmt::format("{}{}{}: ", c_.bold, terminal_text(deck_.path), c_.off);
    out += count(r.errors, "error") + ", " + count(r.warnings, "warning");
    if (r.infos > 0) out += fmt::format(", {} info", r.infos);
    if (r.suppressed > 0) out += fmt::format(", {} suppressed", r.suppressed);
    if (r.baselined > 0) out += fmt::format(", {} in the baseline", r.baselined);
    std::size_t safe = 0, unsafe = 0;
    for (const Diagnostic& d : r.diagnostics)
      if (d.fix) ++(d.fix->safe ? safe : unsafe);
    if (safe > 0) out += fmt::format("; --fix repairs {}", safe);
    if (unsafe > 0) out += fmt::format("{} --unsafe-fixes {} more", safe > 0 ? "," : ";", unsafe);
    out += "\n";
    if (const auto coverage = detail::coverage_of(deck_))
      if (const std::string lead = coverage_lead(*coverage); !lead.empty())
        out += c_.bold + terminal_text(lead) + c_.off + "\n";
    if (!r.not_checked.empty()) out += "not checked:\n";
    for (const NotChecked& n : r.not_checked)
      out += fmt::format("  - {}: {}\n", terminal_text(n.what), terminal_text(n.why));
    return out;
  }

 private:
  static std::string count(std::uint64_t n, std::string_view what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  }
  const char* color(Severity s) const {
    return s == Severity::error ? c_.error : s == Severity::warning ? c_.warning : c_.info;
  }

  std::string one(const Diagnostic& d) {
    std::string out =
        fmt::format("{}{}[{}]{}{}: {}{}\n", color(d.severity), detail::severity_name(d.severity),
                    id_text(d.rule), c_.off, c_.bold, terminal_text(d.message), c_.off);
    const detail::Place at = detail::place_of(deck_, d.span);
    const std::string number = std::to_string(at.line);
    const std::string gutter(number.size(), ' ');
    const std::string bar = fmt::format("{}{} |{}", c_.blue, gutter, c_.off);
    if (!at.known) {
      out += fmt::format("{}{}-->{} {}\n", gutter, c_.blue, c_.off, terminal_text(at.file));
    } else {
      out += fmt::format("{}{}-->{} {}:{}:{}\n{}\n", gutter, c_.blue, c_.off,
                         terminal_text(at.file), at.line, at.column, bar);
      out += card(d, at, number, bar);
      out += bar + "\n";
    }
    const auto note = [&](std::string_view label, const std::string& text) {
      if (!text.empty())
        out += fmt::format("{} {}={} {}{}:{} {}\n", gutter, c_.blue, c_.off, c_.bold, label, c_.off,
                           terminal_text(text));
    };
    std::string solver = d.reference_behaviour;
    if (d.reference)
      solver += fmt::format("{}({} {})", solver.empty() ? "" : " ",
                            detail::severity_name(d.reference->severity), d.reference->number);
    note("solver", solver);
    note("help", d.help);
    for (const auto& [span, text] : d.notes)
      note("note", text + (span.valid() ? " --> " + deck_.deck->sources.where(span) : ""));
    if (d.fix) note(d.fix->safe ? "fix" : "unsafe fix", d.fix->title);
    return out + "\n";
  }

  /// The line of the finding with a caret under its columns; long lines are cut around it.
  std::string card(const Diagnostic& d, const detail::Place& at, const std::string& number,
                   const std::string& bar) const {
    const std::string_view line = deck_.deck->sources[d.span.file].line_at(d.span.offset);
    std::size_t first = static_cast<std::size_t>(at.column) - 1;
    std::size_t last = static_cast<std::size_t>(at.end_column) - 1;
    // Point at the text of a cell, not at the blanks that pad it.
    std::size_t b = first, e = std::min(last, line.size());
    while (b < e && static_cast<unsigned char>(line[b]) <= ' ') ++b;
    while (e > b && static_cast<unsigned char>(line[e - 1]) <= ' ') --e;
    if (b < e) {
      first = b;
      last = e;
    }
    std::size_t begin = 0;
    if (line.size() > line_window && last > line_window) begin = first > 20 ? first - 20 : 0;
    const std::string_view shown = line.substr(std::min(begin, line.size()), line_window);
    std::string out;
    const std::string before = begin > 0 ? "…" : "";
    if (options_.ruler)
      out += fmt::format("{} {}{}\n", bar, begin > 0 ? " " : "",
                         ruler_text(begin + 1, std::max<std::size_t>(shown.size(), 10)));
    out += fmt::format("{}{} |{} {}{}{}\n", c_.blue, number, c_.off, before,
                       terminal_columns(shown), begin + shown.size() < line.size() ? "…" : "");
    const std::size_t from = first - std::min(first, begin);
    const std::size_t lead =
        from <= shown.size() ? display_width(terminal_columns(shown.substr(0, from))) : from;
    const std::size_t room = shown.size() > from ? shown.size() - from : 0;
    const std::size_t length =
        std::max<std::size_t>(1, display_width(terminal_columns(shown.substr(
                                     std::min(from, shown.size()), std::min(last - first, room)))));
    out += fmt::format("{} {}{}{}{}{}\n", bar, begin > 0 ? " " : "", std::string(lead, ' '),
                       color(d.severity), std::string(length, '^'), c_.off);
    return out;
  }

  const LintedDeck& deck_;
  const HumanOptions& options_;
  const Colors& c_;
};

}  // namespace

std::string lint_human(const std::vector<LintedDeck>& decks, const HumanOptions& options) {
  std::string out;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    Human human(deck, options);
    out += human.findings();
    if (!options.quiet) out += human.summary();
  }
  return out;
}

}  // namespace deck
