// Findings as the project's own JSON document.
#include "base/shared/columns.hpp"
#include "report/diagnostics_common.hpp"
#include "report/shared/gate.hpp"
#include "report/shared/schemas.hpp"
#include "report/shared_records.hpp"

namespace deck {
namespace {

struct EditRow {
  const LintedDeck* deck = nullptr;
  const TextEdit* edit = nullptr;
  detail::Place at() const { return detail::place_of(*deck, edit->span); }
  Position end() const {
    return deck->deck->sources[edit->span.file].position(edit->span.offset + edit->span.length);
  }
};
Record<EditRow> record_of(const EditRow*) {
  using Row = EditRow;
  static constexpr Column<Row> columns[] = {
      column("file", [](const Row& r) { return r.at().file; }),
      column("line", [](const Row& r) { return r.at().line; }),
      column("column", [](const Row& r) { return r.at().column; }),
      column("end_line", [](const Row& r) { return r.end().line; }),
      column("end_column", [](const Row& r) { return r.end().column; }),
      column<&Row::edit, &TextEdit::text>("text")};
  return {"edit", "Replace the bytes from line:column up to, not including, end_line:end_column.",
          columns, true};
}

struct FixRow {
  const LintedDeck* deck = nullptr;
  const Fix* fix = nullptr;
  Rows<EditRow> edits() const {
    return rows_of(fix->edits, [this](const TextEdit& e) { return EditRow{deck, &e}; });
  }
};
Record<FixRow> record_of(const FixRow*) {
  static constexpr Column<FixRow> columns[] = {
      column<&FixRow::fix, &Fix::title>("title"),
      column<&FixRow::fix, &Fix::safe>("safe", "The solver does the same with the repaired deck"),
      column<&FixRow::edits>("edits")};
  return {"fix", "", columns};
}

struct NoteRow {
  detail::Place at;
  std::string_view message;
};
Record<NoteRow> record_of(const NoteRow*) {
  static constexpr Column<NoteRow> columns[] = {
      column<&NoteRow::at, &detail::Place::file>("file"),
      column<&NoteRow::at, &detail::Place::line>("line"),
      column<&NoteRow::at, &detail::Place::column>("column"),
      column<&NoteRow::at, &detail::Place::end_column>("end_column"),
      column<&NoteRow::message>("message")};
  return {"note", "A second place of a finding.", columns, true};
}

struct FindingRow {
  const LintedDeck* deck = nullptr;
  const Diagnostic* d = nullptr;
  std::string_view fingerprint;
  detail::Place at = detail::place_of(*deck, d->span);
  std::optional<EntityRow> entity() const { return known(!d->keyword.empty(), EntityRow{d}); }
  std::optional<FixRow> fix() const {
    return d->fix ? std::optional<FixRow>({deck, &*d->fix}) : std::nullopt;
  }
  Rows<NoteRow> notes() const {
    return {[this](const auto& add) {
      for (const auto& [span, text] : d->notes) add({detail::place_of(*deck, span), text});
    }};
  }
};
Record<FindingRow> record_of(const FindingRow*) {
  using Row = FindingRow;
  static constexpr Column<Row> columns[] = {
      column("rule", [](const Row& r) { return id_text(r.d->rule); }),
      column<&Row::d, &Diagnostic::field>(
          "field", "Of a rule that covers several fields (DK201); else empty"),
      column<&Row::d, &Diagnostic::severity>("severity"),
      column<&Row::at, &detail::Place::file>("file"),
      column<&Row::at, &detail::Place::line>("line"),
      column<&Row::at, &detail::Place::column>("column"),
      column<&Row::at, &detail::Place::end_column>("end_column", "First column behind the text"),
      column<&Row::d, &Diagnostic::message>("message", "What was read"),
      column<&Row::d, &Diagnostic::reference_behaviour>("reference_behaviour",
                                                        "What the solver does with it"),
      column<&Row::d, &Diagnostic::help>("help", "How to fix it"),
      column<&Row::d, &Diagnostic::reference>("reference"),
      column<&Row::entity>("entity"),
      column<&Row::notes>("notes"),
      column<&Row::fix>("fix"),
      column<&Row::fingerprint>(
          "fingerprint", "Of rule, entity and card text; it stays the same when lines move")};
  return {"finding", "", columns};
}

using Stale = std::pair<const FindingKey, std::uint64_t>;
struct StaleRow {
  const Stale* stale = nullptr;
};
Record<StaleRow> record_of(const StaleRow*) {
  static constexpr Column<StaleRow> columns[] = {
      column<&StaleRow::stale, &Stale::first, &FindingKey::rule>("rule"),
      column<&StaleRow::stale, &Stale::first, &FindingKey::file>("file"),
      column<&StaleRow::stale, &Stale::first, &FindingKey::entity>("entity"),
      column<&StaleRow::stale, &Stale::first, &FindingKey::field>("field"),
      column<&StaleRow::stale, &Stale::second>("count")};
  return {"stale", "An entry of the baseline that no finding matches.", columns, true};
}

struct LintSummaryRow {
  const LintResult* result = nullptr;
};
Record<LintSummaryRow> record_of(const LintSummaryRow*) {
  static constexpr Column<LintSummaryRow> columns[] = {
      column<&LintSummaryRow::result, &LintResult::errors>("errors"),
      column<&LintSummaryRow::result, &LintResult::warnings>("warnings"),
      column<&LintSummaryRow::result, &LintResult::infos>("infos"),
      column<&LintSummaryRow::result, &LintResult::suppressed>("suppressed"),
      column<&LintSummaryRow::result, &LintResult::baselined>("baselined")};
  return {"summary", "Numbers of findings.", columns, true};
}

struct LintDocument {
  const LintedDeck* linted = nullptr;
  std::optional<Coverage> coverage = detail::coverage_of(*linted);
  const LintResult& result() const { return *linted->result; }
  DeckRow deck() const { return {linted->path, linted->deck, nullptr, nullptr}; }
  Verdict verdict() const { return linted->verdict ? *linted->verdict : lint_verdict(*linted); }
  Rows<FindingRow> findings() const {
    return {[this](const auto& add) {
      for (std::size_t i = 0; i < result().diagnostics.size(); ++i)
        add({linted, &result().diagnostics[i], result().fingerprints[i]});
    }};
  }
  Rows<StaleRow> stale() const {
    return rows_of(result().stale, [this](const Stale& s) { return StaleRow{&s}; });
  }
  TallCounts counts() const {
    TallCounts out;
    for (const auto& [rule, count] : result().counts) out.counts.emplace_back(id_text(rule), count);
    return out;
  }
  Rows<NotChecked> not_checked() const { return rows_of(result().not_checked); }
  IfAny<std::size_t> examined() const {
    return if_any(coverage.has_value(), coverage ? coverage->examined : 0);
  }
  IfAny<std::vector<NotExamined>> not_examined() const {
    return coverage ? IfAny<std::vector<NotExamined>>{coverage->not_examined}
                    : IfAny<std::vector<NotExamined>>{};
  }
};
Record<LintDocument> record_of(const LintDocument*) {
  using Row = LintDocument;
  static constexpr Column<Row> columns[] = {
      column<&Row::deck>("deck"),
      column<&Row::verdict>("verdict"),
      column<&Row::findings>("diagnostics", "Ordered by file, line, column, rule"),
      column("summary", [](const Row& r) { return LintSummaryRow{&r.result()}; }),
      column<&Row::stale>("baseline_stale"),
      column<&Row::counts>("counts", "Findings per rule, those beyond the bound included"),
      column<&Row::not_checked>("not_checked"),
      column<&Row::examined>("examined", "Interfaces of TYPE2, 7, 10, 11, 19, 24 and 25"),
      column<&Row::not_examined>("not_examined", "Interfaces of other types, by keyword")};
  return {"document", "", columns};
}

const char* stage_name(RuleStage stage) {
  switch (stage) {
    case RuleStage::reading:
      return "reading";
    case RuleStage::model:
      return "model";
    case RuleStage::check:
      return "check";
    case RuleStage::extra:
      return "geometry";
    case RuleStage::gate:
      return "gate";
    case RuleStage::linter:
      return "linter";
  }
  return "";
}

const char* fix_name(Fixable fixable) {
  return fixable == Fixable::no ? "no" : fixable == Fixable::safe ? "safe" : "unsafe";
}

struct RuleFieldRow {
  const Rule* rule = nullptr;
  const RuleField* field = nullptr;
};
Record<RuleFieldRow> record_of(const RuleFieldRow*) {
  using Row = RuleFieldRow;
  static constexpr Column<Row> columns[] = {
      column<&Row::field, &RuleField::name>("name"),
      column("was", "The rule that it was in earlier versions",
             [](const Row& r) { return id_text(r.field->was); }),
      column("severity",
             [](const Row& r) { return r.field->severity.value_or(r.rule->severity()); }),
      column<&Row::field, &RuleField::note>("note"),
      column(
          "reference_behaviour", "What the solver does",
          [](const Row& r) { return r.field->solver.empty() ? r.rule->solver : r.field->solver; }),
      column("fix", "How to fix it",
             [](const Row& r) { return r.field->fix.empty() ? r.rule->fix : r.field->fix; })};
  return {"field", "A field of a rule that covers several.", columns, true};
}

struct RuleRow {
  const Rule* rule = nullptr;
  std::optional<ReferenceMessage> reference() const {
    return rule->messages.empty() ? std::nullopt : std::optional(rule->messages.front());
  }
  Rows<RuleFieldRow> fields() const {
    return rows_of(rule->fields, [this](const RuleField& f) { return RuleFieldRow{rule, &f}; });
  }
};
Record<RuleRow> record_of(const RuleRow*) {
  using Row = RuleRow;
  static constexpr Column<Row> columns[] = {
      column("id", [](const Row& r) { return id_text(r.rule->id); }),
      column<&Row::rule, &Rule::title>("title"),
      column("family", [](const Row& r) { return family_of(r.rule->id); }),
      column("severity", [](const Row& r) { return r.rule->severity(); }),
      column("found_by", "reading, model, check, geometry, gate or linter",
             [](const Row& r) { return stage_name(r.rule->stage); }),
      column("fixable", "no, safe or unsafe",
             [](const Row& r) { return fix_name(r.rule->fixable); }),
      column<&Row::rule, &Rule::problem>("problem"),
      column<&Row::rule, &Rule::why>("why"),
      column<&Row::rule, &Rule::solver>("reference_behaviour", "What the solver does"),
      column<&Row::rule, &Rule::source>("known_from", "Source of that; empty: nothing is claimed"),
      column<&Row::reference>("reference", "Message of the solver; null: it has none"),
      column<&Row::rule, &Rule::fix>("fix"),
      column<&Row::rule, &Rule::ignore>("ignore_when"),
      column<&Row::fields>("fields")};
  return {"rule", "", columns};
}

struct RulesDocument {
  Rows<RuleRow> rules() const {
    return rows_of(all_rules(), [](const Rule& r) { return RuleRow{&r}; });
  }
};
Record<RulesDocument> record_of(const RulesDocument*) {
  static constexpr Column<RulesDocument> columns[] = {column<&RulesDocument::rules>("rules")};
  return {"document", "", columns};
}

constexpr DocumentHead lint_head{"deck/lint", 1, "Written by deck lint --json."};
constexpr DocumentHead rules_head{"deck/rules", 1, "Written by deck rules --json.", false};

}  // namespace

Record<ReferenceMessage> record_of(const ReferenceMessage*) {
  static constexpr Column<ReferenceMessage> columns[] = {
      column<&ReferenceMessage::number>("message"),
      column<&ReferenceMessage::severity>("severity")};
  return {"reference", "A message of the solver.", columns, true};
}

Record<NotChecked> record_of(const NotChecked*) {
  static constexpr Column<NotChecked> columns[] = {column<&NotChecked::what>("what"),
                                                   column<&NotChecked::why>("why")};
  return {"not_checked", "", columns, true};
}

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
  const char* const bold = color ? "\x1b[1m" : "";
  const char* const off = color ? "\x1b[0m" : "";
  for (const Rule& r : all_rules()) {
    if (family_of(r.id) != family) {
      family = family_of(r.id);
      out += (out.empty() ? "" : "\n") + std::string(bold) +
             std::string(id_text(r.id).substr(0, 3)) + "xx  " + std::string(family) + off + "\n";
    }
    std::string line = "  " + std::string(id_text(r.id)) + "  ";
    std::string severity = to_string(r.severity());
    severity.resize(8, ' ');
    std::string fix = r.fixable == Fixable::no ? "" : fix_name(r.fixable);
    fix.resize(7, ' ');
    std::string number = r.messages.empty() ? "" : std::to_string(r.messages.front().number);
    number.insert(0, 6 - std::min<std::size_t>(number.size(), 6), ' ');
    line += severity + " " + fix + " " + number + "  ";
    if (width == 0 || line.size() + 20 > width) {
      out += line + r.title + "\n";
    } else {
      out += line + wrapped(r.title, line.size(), width).substr(line.size());
    }
  }
  out += "\n" + std::to_string(all_rules().size()) +
         " rules. Columns: id, severity, fix, message of the reference solver, title. "
         "'deck explain ID' shows the page of a rule.\n";
  return out;
}

}  // namespace deck
