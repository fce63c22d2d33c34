// Findings as text: the card line with a caret.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/shared/paths.hpp"
#include "base/shared/shown_text.hpp"
#include "report/shared/findings.hpp"
#include "report/terminal/words.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {
namespace {

constexpr std::size_t usual_window = 110;  ///< columns of a card line that are shown
constexpr std::size_t most_alike = 3;      ///< findings of a rule that are shown in full

/// A character of a card line: its offset in the line, and its shown text.
struct Glyph {
  std::size_t at = 0;  ///< bytes before it in the line
  std::string_view shown;
  std::size_t columns = 0;
};

/// Characters of the piece of a line from byte `start` on; `shown`: its terminal_columns(), which
/// must outlive the result.
std::vector<Glyph> glyphs_of(std::string_view line, std::string_view shown, std::size_t start) {
  std::vector<Glyph> out;
  for (std::size_t at = 0, to = 0; at < line.size() && to < shown.size();) {
    const TextUnit unit = text_unit_at(shown, to);
    const std::string_view text = shown.substr(to, unit.length);
    out.push_back({start + at, text, display_width(text)});
    at += std::max<std::size_t>(text_unit_at(line, at).length, 1);
    to += std::max<std::size_t>(unit.length, 1);
  }
  return out;
}

/// Range of a cell's text within bytes `first` to `last` of a line, without padding blanks.
std::pair<std::size_t, std::size_t> text_of_cell(std::string_view line, std::size_t first,
                                                 std::size_t last) {
  const auto is_blank = [&](std::size_t i) { return static_cast<unsigned char>(line[i]) <= ' '; };
  std::size_t begin = first, end = std::min(last, line.size());
  while (begin < end && is_blank(begin)) ++begin;
  while (end > begin && is_blank(end - 1)) --end;
  return begin < end ? std::pair(begin, end) : std::pair(first, last);
}

/// Remarks about the solver that nearly every deck with a contact gets.
bool is_of_every_deck(const Finding& d) {
  static constexpr RuleId rules[] = {RuleId::DK292, RuleId::DK295, RuleId::DK296, RuleId::DK307};
  return d.severity == Severity::info &&
         std::find(std::begin(rules), std::end(rules), d.rule) != std::end(rules);
}

class Human {
 public:
  Human(const LintedDeck& deck, const HumanOptions& options) : deck_(deck), options_(options) {}

  /// Errors first; rules in order of first occurrence; more than a few findings of a rule together.
  /// Of very many findings one example of each rule in a few lines, first what the verdict counts.
  std::string findings() {
    constexpr std::size_t many = 100;
    using Kind = std::tuple<RuleId, std::string, Severity>;
    std::vector<const Finding*> all;
    std::map<Kind, std::vector<const Finding*>> of_kind;
    for (const Finding& d : deck_.result->findings) {
      if (!options_.remarks_of_every_deck && is_of_every_deck(d)) continue;
      all.push_back(&d);
      of_kind[{d.rule, d.field, d.severity}].push_back(&d);
    }
    const bool brief = options_.group && options_.per_rule > 0 && all.size() > many;
    const std::set<RuleId> counted = {RuleId::DK301, RuleId::DK308, RuleId::DK328, RuleId::DK341,
                                      RuleId::DK342, RuleId::DK381, RuleId::DK401, RuleId::DK402};
    const auto before = [&](const Finding* d) {
      return std::pair(d->severity, brief && !counted.contains(d->rule));
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Finding* a, const Finding* b) { return before(a) < before(b); });
    std::string out;
    std::map<Kind, int> shown;
    std::map<RuleId, std::uint64_t> hidden = deck_.result->dropped;
    for (const Finding* d : all) {
      const auto& alike = of_kind[{d->rule, d->field, d->severity}];
      int& n = shown[{d->rule, d->field, d->severity}];
      if (options_.group && options_.per_rule > 0 &&
          ((brief && d->severity != Severity::error) || alike.size() > most_alike)) {
        if (n++ > 0) continue;
        const std::uint64_t dropped = hidden[d->rule];
        // Remarks, possibly hundreds, share a line.
        out += d->severity == Severity::info ? folded(*d, alike.size() + dropped)
               : brief && d->severity != Severity::error
                   ? in_brief(*d, alike.size() - 1 + dropped)
                   : one(*d, group({alike.begin() + 1, alike.end()}, dropped));
        hidden.erase(d->rule);
      } else if (options_.per_rule > 0 && n >= options_.per_rule) {
        ++hidden[d->rule];
      } else {
        ++n;
        out += one(*d, {});
      }
    }
    if (out.ends_with(")\n") || brief) out += "\n";
    for (const auto& [rule, count] : hidden)
      out += fmt::format("{} {} more findings of {}: {}\n", paint(bold, "..."), count,
                         paint(bold, id_text(rule)), rule_of(rule).title);
    if (!hidden.empty()) out += "\n";
    return out;
  }

  std::string summary() {
    const LintResult& r = *deck_.result;
    const Verdict verdict = verdict_of(deck_);
    std::string out = paint(bold, terminal_text(deck_.path)) + ": ", rest;
    for (const VerdictSentence& s : verdict.sentences) {
      if (&s == &verdict.sentences.front())
        out += s.text.substr(0, s.text.size() - 1);  // without full stop
      else
        append(rest, " ", s.text);
    }
    std::uint64_t of_gate = 0;  // not counted among the errors of the deck
    for (const auto& [rule, n] : r.counts) of_gate += is_gate_rule(rule) ? n : 0;
    if (of_gate > 0) out += ", " + count(of_gate, "finding", "findings") + " of the gate";
    if (r.suppressed > 0) out += fmt::format(", {} suppressed", r.suppressed);
    if (r.baselined > 0) out += fmt::format(", {} in the baseline", r.baselined);
    std::size_t safe = 0, unsafe = 0;
    for (const Finding& d : r.findings)
      if (d.fix) ++(d.fix->safe ? safe : unsafe);
    if (safe > 0) out += fmt::format("; --fix repairs {}", safe);
    if (unsafe > 0) out += fmt::format("{} --unsafe-fixes {} more", safe > 0 ? "," : ";", unsafe);
    out += "\n";
    if (!rest.empty()) out += paint(bold, terminal_text(rest)) + "\n";
    return out;
  }

 private:
  static constexpr const char *bold = "1", *blue = "1;34";

  std::string paint(const char* code, std::string_view text) const {
    return options_.color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
  }
  std::string paint(Severity severity, std::string_view text) const {
    static constexpr const char* codes[] = {"1;31", "1;33", "1;36"};
    return paint(codes[static_cast<std::size_t>(severity)], text);
  }

  /// "error[DK171]: " and the message.
  std::string title(const Finding& d, std::string_view found) const {
    return paint(d.severity, fmt::format("{}[{}]", to_string(d.severity), finding_name(d))) +
           paint(bold, fmt::format(": {}", found));
  }

  /// False for a file outside the deck's folder without a keyword: an #include can name any file of
  /// this machine, and its lines must not reach a build log.
  bool is_of_deck(std::uint32_t file) const {
    const Deck& deck = *deck_.deck;
    const auto folder = [&](std::uint32_t f) {
      return std::string(parent_path(absolute_path(deck.sources[f].path()))) + "/";
    };
    return folder(file).starts_with(folder(0)) ||
           std::any_of(deck.blocks.begin(), deck.blocks.end(),
                       [&](const Block& b) { return b.header_span.file == file; });
  }

  /// All findings of a kind in one line with their number.
  std::string folded(const Finding& first, std::uint64_t count) const {
    std::string out = title(first, fmt::format("{}: {}", deck::count(count, "place", "places"),
                                               rule_of(first.rule).title));
    if (first.reference)
      out += fmt::format(" (solver: {} {})", to_string(first.reference->severity),
                         first.reference->number);
    return out + " (-v)\n";
  }
  /// What, where and how to fix it; `more` others of its rule are only counted.
  std::string in_brief(const Finding& d, std::uint64_t more) const {
    std::string out = title(d, terminal_text(d.message)) +
                      fmt::format("\n  {} {}", paint(blue, "-->"),
                                  terminal_text(detail::place_of(deck_, d.span).text()));
    if (more > 0) out += fmt::format(" and {} more (-v)", more);
    return out +
           (d.help.empty() ? "\n" : "\n  " + paint(bold, "help: ") + terminal_text(d.help) + "\n");
  }
  /// Places of the other findings of a rule; `dropped`: number of those not kept.
  std::string group(const std::vector<const Finding*>& others, std::uint64_t dropped) const {
    const auto most = static_cast<std::size_t>(options_.per_rule);
    const Finding& first = *others.front();
    std::string out =
        paint(bold, fmt::format("{} more of {}", others.size() + dropped, finding_name(first))) +
        fmt::format(": {}\n", rule_of(first.rule).title);
    std::uint32_t file = UINT32_MAX;
    for (std::size_t i = 0; i < std::min(most, others.size()); ++i) {
      const detail::Place at = detail::place_of(deck_, others[i]->span);
      const bool same = std::exchange(file, others[i]->span.file) == others[i]->span.file;
      out +=
          same ? fmt::format(", {}", at.line)
               : (i == 0 ? "  " : "; ") +
                     paint(blue,
                           fmt::format("{}:{}",
                                       terminal_text(at.file.substr(at.file.find_last_of('/') + 1)),
                                       at.line));
    }
    return out + (others.size() + dropped > most ? ", … (-v)\n" : " (-v)\n");
  }

  /// A finding in full with its notes.
  std::string one(const Finding& d, const std::string& others) {
    const detail::Place at = detail::place_of(deck_, d.span);
    const std::string number = std::to_string(at.line);
    const std::string gutter(number.size(), ' ');
    const std::string bar = paint(blue, gutter + " |");
    std::string out =
        title(d, terminal_text(d.message)) +
        fmt::format("\n{}{} {}\n", gutter, paint(blue, "-->"), terminal_text(at.text()));
    if (at.known) out += bar + "\n";
    if (at.known && is_of_deck(d.span.file)) out += card(d, at, number, bar) + bar + "\n";
    const auto note = [&](std::string_view label, const std::string& text) {
      if (!text.empty())
        out += fmt::format("{} {} {} {}\n", gutter, paint(blue, "="),
                           paint(bold, fmt::format("{}:", label)), terminal_text(text));
    };
    note("solver", detail::with_message(d.reference_behaviour, d.reference));
    note("help", d.help);
    for (const auto& [span, text] : d.notes)
      note("note", text + (span.valid() ? " --> " + deck_.deck->sources.where(span) : ""));
    if (d.fix) note(d.fix->safe ? "fix" : "unsafe fix", d.fix->title);
    return out + others + "\n";
  }

  /// Line of the finding with a caret under its columns; long lines are cut around it.
  std::string card(const Finding& d, const detail::Place& at, const std::string& number,
                   const std::string& bar) const {
    const std::string_view line = deck_.deck->sources[d.span.file].line_at(d.span.offset);
    const auto [first, last] = text_of_cell(line, static_cast<std::size_t>(at.column) - 1,
                                            static_cast<std::size_t>(at.end_column) - 1);
    // Only the part of a very long line near the caret.
    constexpr std::size_t most = 2000;
    std::size_t start = std::min(first, line.size()) > most ? first - most : 0;
    while (start > 0 && start < line.size() &&
           (static_cast<unsigned char>(line[start]) & 0xc0U) == 0x80U && first - start < most + 3)
      --start;
    const std::string_view near = line.substr(std::min(start, line.size()), 2 * most);
    const std::string picture = terminal_columns(near);
    std::vector<Glyph> glyphs = glyphs_of(near, picture, start);
    const std::size_t text_end = glyphs.size();
    // Blanks for a caret behind the end of the line, and for a ruler of at least a few columns.
    const std::size_t least = std::max<std::size_t>(first + 1, options_.ruler ? 10 : 0);
    for (std::size_t k = start + near.size(); k < least; ++k) glyphs.push_back({k, " ", 1});
    std::vector<std::size_t> columns = {0};  // before each character
    for (const Glyph& g : glyphs) columns.push_back(columns.back() + g.columns);
    const auto index_at = [&](std::size_t byte) {  // first one at or behind the byte
      const auto it =
          std::lower_bound(glyphs.begin(), glyphs.end(), byte,
                           [](const Glyph& g, std::size_t wanted) { return g.at < wanted; });
      return static_cast<std::size_t>(it - glyphs.begin());
    };
    const auto width_of = [&](std::size_t from, std::size_t to) {
      return columns[std::min(to, glyphs.size())] - columns[from];
    };
    const std::size_t caret = std::min(index_at(first), glyphs.size() - 1);
    const std::size_t caret_end = std::max(caret + 1, index_at(last));
    const std::size_t gutter = number.size() + 3;
    const std::size_t room = options_.width == 0
                                 ? usual_window
                                 : std::max<std::size_t>(options_.width, gutter + 20) - gutter;
    // Cut around the caret: as much as fits before it, and a cell behind it.
    std::size_t begin = 0, end = glyphs.size();
    if (width_of(0, end) > room) {
      const std::size_t wanted = std::min(index_at(glyphs[caret_end - 1].at + 11), end);
      while (begin < caret && width_of(begin, wanted) + 2 > room) ++begin;
      const std::size_t left = room - (begin > 0 ? 1 : 0);
      if (width_of(begin, end) > left)
        while (end > begin + 1 && width_of(begin, end) + 1 > left) --end;
    }
    const bool cut_before = begin > 0 || start > 0;
    const bool cut_behind = end < text_end || start + near.size() < line.size();
    const char* margin = cut_before ? " " : "";
    std::string out, text;
    if (options_.ruler) {
      std::string ruler;
      for (std::size_t k = begin; k < end; ++k)
        if (glyphs[k].columns > 0)
          ruler += ruler_mark(glyphs[k].at + 1) + std::string(glyphs[k].columns - 1, ' ');
      out += fmt::format("{} {}{}\n", bar, margin, ruler);
    }
    for (std::size_t k = begin; k < std::min(end, text_end); ++k) text += glyphs[k].shown;
    out += fmt::format("{} {}{}{}\n", paint(blue, number + " |"), cut_before ? "…" : "", text,
                       cut_behind ? "…" : "");
    const std::size_t length = std::max<std::size_t>(1, width_of(caret, std::min(caret_end, end)));
    return out + fmt::format("{} {}{}{}\n", bar, margin, std::string(width_of(begin, caret), ' '),
                             paint(d.severity, std::string(length, '^')));
  }

  const LintedDeck& deck_;
  const HumanOptions& options_;
};

/// Skipped checks, each once, with their decks unless all.
std::string not_checked_text(const std::vector<LintedDeck>& decks) {
  std::vector<std::pair<const NotChecked*, std::vector<std::string>>> all;
  std::size_t read = 0;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    ++read;
    for (const NotChecked& n : deck.result->not_checked) {
      auto it = std::find_if(all.begin(), all.end(), [&](const auto& entry) {
        return entry.first->what == n.what && entry.first->why == n.why;
      });
      if (it == all.end()) it = all.insert(all.end(), {&n, {}});
      it->second.push_back(terminal_text(deck.path));
    }
  }
  if (all.empty()) return {};
  constexpr std::size_t most = 3;
  std::string out = "not checked:\n";
  for (const auto& [n, paths] : all) {
    out += fmt::format("  - {}: {}", terminal_text(n->what), terminal_text(n->why));
    if (paths.size() < read) {
      out += fmt::format(" [{}",
                         fmt::join(std::span(paths).first(std::min(most, paths.size())), ", "));
      out += paths.size() > most ? fmt::format(", … and {} more decks]", paths.size() - most) : "]";
    }
    out += "\n";
  }
  return out;
}

std::string grand_total(const std::vector<LintedDeck>& decks, bool color) {
  std::uint64_t errors = 0, warnings = 0, clean = 0, unread = 0;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) {
      ++unread;
      continue;
    }
    errors += deck.result->errors;
    warnings += deck.result->warnings;
    if (deck.result->errors + deck.result->warnings == 0) ++clean;
  }
  std::string out = toned(fmt::format("{} decks: ", decks.size()), Tone::bold, color) +
                    fmt::format("{}, {}; {} without either", count(errors, "error", "errors"),
                                count(warnings, "warning", "warnings"), clean);
  if (unread > 0) out += fmt::format("; {} could not be read", unread);
  return out + "\n";
}

}  // namespace

std::string lint_human(const std::vector<LintedDeck>& decks, const HumanOptions& options) {
  std::string out;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    Human human(deck, options);
    out += human.findings();
    if (!options.quiet) out += human.summary();
  }
  if (options.quiet) return out;
  out += not_checked_text(decks);
  if (decks.size() > 1) out += grand_total(decks, options.color);
  return out;
}

}  // namespace deck
