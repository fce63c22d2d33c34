// Findings of lint: place, verdict and details for all writers; the JSON document; one line per
// finding, per rule, per gate.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/shared/paths.hpp"
#include "base/shared/shown_text.hpp"
#include "lint/shared/gate.hpp"
#include "report/shared/findings.hpp"
#include "report/shared/gate.hpp"
#include "report/shared_records.hpp"
#include "report/terminal/words.hpp"
#include "text/shared/rule_page.hpp"

namespace deck {

namespace {

/// Numbers of a result without those of gates, whose rules are errors or warnings by their pages.
LintFacts facts_of(const LintResult& r) {
  LintFacts facts{r.errors, r.warnings, r.infos, false};
  for (const RuleId rule : gate_rules) {
    const auto found = r.counts.find(rule);
    const auto first = std::find_if(r.findings.begin(), r.findings.end(),
                                    [&](const Finding& d) { return d.rule == rule; });
    if (found == r.counts.end() || first == r.findings.end()) continue;
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
  // Spans end with their line here: editors want one line per finding.
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

std::string details(const Finding& d) {
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
  std::set<Severity> severities = {};  ///< shown severities
};

}  // namespace

std::string lint_concise(const std::vector<LintedDeck>& decks) {
  std::string out;
  for (const LintedDeck& deck : decks) {
    if (deck.result == nullptr) continue;
    for (const Finding& d : deck.result->findings) {
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
    for (const Finding& d : deck.result->findings) {
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
        terminal_text(gate.earlier->path), c.count(Trend::added), c.count(Trend::worse),
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

LINE_RECORD(ReferenceMessage, "reference", "A message of the solver.",
            COLUMN("message", "", r.number), COLUMN("severity", "", r.severity));

LINE_RECORD(NotChecked, "not_checked", "", COLUMN("what", "", r.what), COLUMN("why", "", r.why));

using FindingCount = std::pair<const FindingKey, std::uint64_t>;
LINE_RECORD(FindingCount, "stale", "An entry of the baseline that no finding matches.",
            COLUMN("rule", "", r.first.rule), COLUMN("file", "", r.first.file),
            COLUMN("entity", "", r.first.entity), COLUMN("field", "", r.first.field),
            COLUMN("count", "", r.second));

namespace {

struct EditRow {
  const LintedDeck* deck = nullptr;
  const TextEdit* edit = nullptr;
  detail::Place at() const { return detail::place_of(*deck, edit->span); }
  Position end() const {
    return deck->deck->sources[edit->span.file].position(edit->span.offset + edit->span.length);
  }
};
LINE_RECORD(EditRow, "edit",
            "Replace the bytes from line:column up to, not including, end_line:end_column.",
            COLUMN("file", "", r.at().file), COLUMN("line", "", r.at().line),
            COLUMN("column", "", r.at().column), COLUMN("end_line", "", r.end().line),
            COLUMN("end_column", "", r.end().column), COLUMN("text", "", r.edit->text));

struct FixRow {
  const LintedDeck* deck = nullptr;
  const Fix* fix = nullptr;
};
RECORD(FixRow, "fix", "", COLUMN("title", "", r.fix->title),
       COLUMN("safe", "The solver does the same with the repaired deck", r.fix->safe),
       COLUMN("edits", "", rows<EditRow>(r.fix->edits, r.deck)));

struct NoteRow {
  detail::Place at;
  std::string_view message;
};
LINE_RECORD(NoteRow, "note", "A second place of a finding.", COLUMN("file", "", r.at.file),
            COLUMN("line", "", r.at.line), COLUMN("column", "", r.at.column),
            COLUMN("end_column", "", r.at.end_column), COLUMN("message", "", r.message));

struct FindingRow {
  const LintedDeck* deck = nullptr;
  const Finding* d = nullptr;
  std::string_view fingerprint;
  detail::Place at = detail::place_of(*deck, d->span);
};

void each_note(const FindingRow& r, const std::function<void(const NoteRow&)>& add) {
  for (const auto& [span, text] : r.d->notes) add({detail::place_of(*r.deck, span), text});
}

RECORD(FindingRow, "finding", "", COLUMN("rule", "", id_text(r.d->rule)),
       COLUMN("field", "Of a rule that covers several fields (DK201); else empty", r.d->field),
       COLUMN("severity", "", r.d->severity), COLUMN("file", "", r.at.file),
       COLUMN("line", "", r.at.line), COLUMN("column", "", r.at.column),
       COLUMN("end_column", "First column behind the text", r.at.end_column),
       COLUMN("message", "What was read", r.d->message),
       COLUMN("reference_behaviour", "What the solver does with it", r.d->reference_behaviour),
       COLUMN("help", "How to fix it", r.d->help), COLUMN("reference", "", r.d->reference),
       COLUMN("entity", "", entity_of(*r.d)), COLUMN("notes", "", rows_from<each_note>(r)),
       COLUMN("fix", "", r.d->fix ? std::optional(FixRow{r.deck, &*r.d->fix}) : std::nullopt),
       COLUMN("fingerprint", "Of rule, entity and card text; it stays the same when lines move",
              r.fingerprint));

struct LintDocument {
  const LintedDeck* linted = nullptr;
  std::optional<Coverage> coverage = detail::coverage_of(*linted);
  const LintResult& result() const { return *linted->result; }
  Named<std::uint64_t> counts() const {
    return {[this](const auto& add) {
      for (const auto& [rule, count] : result().counts) add(id_text(rule), count);
    }};
  }
};

void each_finding(const LintDocument& r, const std::function<void(const FindingRow&)>& add) {
  for (std::size_t i = 0; i < r.result().findings.size(); ++i)
    add({r.linted, &r.result().findings[i], r.result().fingerprints[i]});
}

RECORD(LintDocument, "document", "",
       COLUMN("deck", "", DeckRow{r.linted->path, r.linted->deck, nullptr, nullptr}),
       COLUMN("verdict", "", verdict_of(*r.linted)),
       COLUMN("diagnostics", "Ordered by file, line, column, rule", rows_from<each_finding>(r)),
       LINE_OBJECT("summary", "Numbers of findings.", finding_columns,
                   COLUMN("suppressed", "", r.result().suppressed),
                   COLUMN("baselined", "", r.result().baselined)),
       COLUMN("baseline_stale", "", rows_of(r.result().stale)),
       COLUMN("counts", "Findings per rule, those beyond the bound included", r.counts()),
       COLUMN("not_checked", "", rows_of(r.result().not_checked)),
       COLUMN("examined", "Interfaces of TYPE2, 7, 10, 11, 19, 24 and 25",
              if_any(r.coverage.has_value(), r.coverage ? r.coverage->examined : 0)),
       COLUMN("not_examined", "Interfaces of other types, by keyword",
              r.coverage ? if_any(true, r.coverage->not_examined)
                         : IfAny<std::vector<NotExamined>>{}));

const char* stage_name(RuleStage stage) {
  static constexpr const char* names[] = {"reading",  "model", "check",
                                          "geometry", "gate",  "linter"};
  return names[static_cast<std::size_t>(stage)];
}

const char* fix_name(Fixable fixable) {
  return fixable == Fixable::no ? "no" : fixable == Fixable::safe ? "safe" : "unsafe";
}

struct RuleFieldRow {
  const Rule* rule = nullptr;
  const RuleField* field = nullptr;
};
LINE_RECORD(RuleFieldRow, "field", "A field of a rule that covers several.",
            COLUMN("name", "", r.field->name),
            COLUMN("was", "The rule that it was in earlier versions", id_text(r.field->was)),
            COLUMN("severity", "", r.field->severity.value_or(r.rule->severity())),
            COLUMN("note", "", r.field->note),
            COLUMN("reference_behaviour", "What the solver does",
                   r.field->solver.empty() ? r.rule->solver : r.field->solver),
            COLUMN("fix", "How to fix it", r.field->fix.empty() ? r.rule->fix : r.field->fix));

std::optional<ReferenceMessage> first_message(const Rule& rule) {
  return rule.messages.empty() ? std::nullopt : std::optional(rule.messages.front());
}

}  // namespace

RECORD(Rule, "rule", "", COLUMN("id", "", id_text(r.id)),
       COLUMN("name", "Unique; accepted wherever an id is", r.name), COLUMN("title", "", r.title),
       COLUMN("family", "", family_of(r.id)), COLUMN("severity", "", r.severity()),
       COLUMN("found_by", "reading, model, check, geometry, gate or linter", stage_name(r.stage)),
       COLUMN("fixable", "no, safe or unsafe", fix_name(r.fixable)),
       COLUMN("problem", "", r.problem), COLUMN("why", "", r.why),
       COLUMN("reference_behaviour", "What the solver does", r.solver),
       COLUMN("known_from", "Source of that; empty: nothing is claimed", r.source),
       COLUMN("reference", "Message of the solver; null: it has none", first_message(r)),
       COLUMN("fix", "", r.fix), COLUMN("ignore_when", "", r.ignore),
       COLUMN("fields", "", rows<RuleFieldRow>(r.fields, &r)));

namespace {

struct RulesDocument {};
RECORD(RulesDocument, "document", "", COLUMN("rules", "", rows_of(all_rules())));

constexpr DocumentHead lint_head{"deck/lint", 1, "Written by deck lint --json."};
constexpr DocumentHead rules_head{"deck/rules", 1, "Written by deck rules --json.", false};

}  // namespace

DocumentSchema lint_schema() { return document_schema<LintDocument>(lint_head); }
DocumentSchema rules_schema() { return document_schema<RulesDocument>(rules_head); }

std::string lint_json(const std::vector<LintedDeck>& decks) {
  if (decks.size() == 1)
    return decks[0].result == nullptr ? "" : write_document(lint_head, LintDocument{&decks[0]});
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_json_head(json, lint_head.id, lint_head.version);
  json.key("decks").begin_array();
  for (const LintedDeck& deck : decks)
    if (deck.result != nullptr) write_document(json, lint_head, LintDocument{&deck});
  json.end_array().end_object();
  return out;
}

std::string rules_json() { return write_document(rules_head, RulesDocument{}); }

std::string rules_table(bool color, std::size_t width) {
  std::string out;
  std::string_view family;
  for (const Rule& r : all_rules()) {
    const std::string id(id_text(r.id));
    if (family_of(r.id) != family) {
      family = family_of(r.id);
      const std::string head = fmt::format("{}xx  {}", id.substr(0, id.size() - 2), family);
      out += (out.empty() ? "" : "\n") + toned(head, Tone::bold, color) + "\n";
    }
    const std::string line =
        fmt::format("  {}  {:<8} {:<7} {:>6}  ", id, to_string(r.severity()),
                    r.fixable == Fixable::no ? "" : fix_name(r.fixable),
                    r.messages.empty() ? "" : std::to_string(r.messages.front().number));
    const bool whole = width == 0 || line.size() + 20 > width;
    out +=
        line + (whole ? r.title + "\n" : wrapped(r.title, line.size(), width).substr(line.size()));
  }
  out += "\n" + std::to_string(all_rules().size()) +
         " rules. Columns: id, severity, fix, message of the reference solver, title. "
         "'deck explain ID' shows the page of a rule.\n";
  return out;
}

}  // namespace deck
