// Findings as the project's own JSON document.
#include "base/shared/columns.hpp"
#include "report/diagnostics_common.hpp"
#include "report/shared/verdict.hpp"

namespace deck {
namespace {

void write_edits(JsonWriter& json, const LintedDeck& deck, const Fix& fix) {
  json.begin_object();
  json.field("title", fix.title).field("safe", fix.safe).key("edits").begin_array();
  for (const TextEdit& e : fix.edits) {
    const detail::Place at = detail::place_of(deck, e.span);
    const Source& source = deck.deck->sources[e.span.file];
    const Position end = source.position(e.span.offset + e.span.length);
    json.begin_object(true)
        .field("file", at.file)
        .field("line", at.line)
        .field("column", at.column)
        .field("end_line", end.line)
        .field("end_column", end.column)
        .field("text", e.text)
        .end_object();
  }
  json.end_array().end_object();
}

void write_diagnostic(JsonWriter& json, const LintedDeck& deck, const Diagnostic& d,
                      const std::string& print) {
  const detail::Place at = detail::place_of(deck, d.span);
  json.begin_object();
  json.field("rule", id_text(d.rule))
      .field("field", d.field)
      .field("severity", to_string(d.severity))
      .field("file", at.file)
      .field("line", at.line)
      .field("column", at.column)
      .field("end_column", at.end_column)
      .field("message", d.message)
      .field("reference_behaviour", d.reference_behaviour)
      .field("help", d.help);
  json.key("reference");
  if (d.reference)
    json.begin_object(true)
        .field("message", d.reference->number)
        .field("severity", to_string(d.reference->severity))
        .end_object();
  else
    json.null();
  json.key("entity");
  if (!d.keyword.empty())
    json.begin_object(true).field("keyword", d.keyword).field("id", d.id).end_object();
  else
    json.null();
  json.key("notes").begin_array();
  for (const auto& [span, text] : d.notes) {
    const detail::Place note = detail::place_of(deck, span);
    json.begin_object(true)
        .field("file", note.file)
        .field("line", note.line)
        .field("column", note.column)
        .field("end_column", note.end_column)
        .field("message", text)
        .end_object();
  }
  json.end_array();
  json.key("fix");
  if (d.fix)
    write_edits(json, deck, *d.fix);
  else
    json.null();
  json.field("fingerprint", print);
  json.end_object();
}

void write_document(JsonWriter& json, const LintedDeck& deck) {
  const LintResult& r = *deck.result;
  json.begin_object();
  write_json_head(json, "deck/lint", 1);
  write_json_deck(json, deck.path, *deck.deck, nullptr, nullptr);
  write_verdict(json, deck.verdict ? *deck.verdict : lint_verdict(deck));
  json.key("diagnostics").begin_array();
  for (std::size_t i = 0; i < r.diagnostics.size(); ++i)
    write_diagnostic(json, deck, r.diagnostics[i], r.fingerprints[i]);
  json.end_array();
  json.key("summary")
      .begin_object(true)
      .field("errors", r.errors)
      .field("warnings", r.warnings)
      .field("infos", r.infos)
      .field("suppressed", r.suppressed)
      .field("baselined", r.baselined)
      .end_object();
  json.key("baseline_stale").begin_array();
  for (const auto& [key, count] : r.stale)
    json.begin_object(true)
        .field("rule", key.rule)
        .field("file", key.file)
        .field("entity", key.entity)
        .field("field", key.field)
        .field("count", count)
        .end_object();
  json.end_array();
  json.key("counts").begin_object();
  for (const auto& [rule, count] : r.counts) json.field(id_text(rule), count);
  json.end_object();
  json.key("not_checked").begin_array();
  for (const NotChecked& n : r.not_checked)
    json.begin_object(true).field("what", n.what).field("why", n.why).end_object();
  json.end_array();
  if (const auto coverage = detail::coverage_of(deck)) write_json_coverage(json, *coverage);
  json.end_object();
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

}  // namespace

std::string lint_json(const std::vector<LintedDeck>& decks) {
  std::string out;
  JsonWriter json(out);
  if (decks.size() == 1) {
    if (decks[0].result != nullptr) write_document(json, decks[0]);
  } else {
    json.begin_object();
    write_json_head(json, "deck/lint", 1);
    json.key("decks").begin_array();
    for (const LintedDeck& deck : decks)
      if (deck.result != nullptr) write_document(json, deck);
    json.end_array().end_object();
  }
  if (!out.empty() && out.back() != '\n') out += '\n';
  return out;
}

std::string rules_json() {
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_json_head(json, "deck/rules", 1);
  json.key("rules").begin_array();
  for (const Rule& r : all_rules()) {
    json.begin_object();
    json.field("id", id_text(r.id))
        .field("title", r.title)
        .field("family", family_of(r.id))
        .field("severity", to_string(r.severity()))
        .field("found_by", stage_name(r.stage))
        .field("fixable", fix_name(r.fixable))
        .field("problem", r.problem)
        .field("why", r.why)
        .field("reference_behaviour", r.solver)
        .field("known_from", r.source);
    json.key("reference");
    if (!r.messages.empty())
      json.begin_object(true)
          .field("message", r.messages.front().number)
          .field("severity", to_string(r.messages.front().severity))
          .end_object();
    else
      json.null();
    json.field("fix", r.fix).field("ignore_when", r.ignore);
    json.key("fields").begin_array();
    for (const RuleField& f : r.fields)
      json.begin_object(true)
          .field("name", f.name)
          .field("was", id_text(f.was))
          .field("severity", to_string(f.severity.value_or(r.severity())))
          .field("note", f.note)
          .field("reference_behaviour", f.solver.empty() ? r.solver : f.solver)
          .field("fix", f.fix.empty() ? r.fix : f.fix)
          .end_object();
    json.end_array();
    json.end_object();
  }
  json.end_array().end_object();
  if (out.back() != '\n') out += '\n';
  return out;
}

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
