// Time histories (/TH/...): variables and objects. The schemas have the variables of every keyword
// and the solver's message for a missing object.
#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "keyword/shared/schema_facts.hpp"
#include "lint/check.hpp"
#include "model/shared/families.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {
namespace {

/// True if the word is not in fixed columns: a comma on the line, or a parameter.
bool open_word(const DecodedCard& card, const Cell& cell) {
  return card.line.text.find(',') != std::string_view::npos || cell.text.starts_with('&');
}

enum class HistoryWord { known, possible, unknown };

/// Manuals can be older than the solver: a word is unknown only if no history has it and it is not
/// the start of a word of this one (groups: FN for FNX, FNY, FNZ).
HistoryWord judge(const LintContext& c, const Schema& schema, std::string_view text) {
  constexpr std::size_t shortest_group = 2;
  if (has_word(schema, text)) return HistoryWord::known;
  const auto words = legal_words(schema);
  if (text.size() >= shortest_group &&
      std::any_of(words.begin(), words.end(),
                  [&](const std::string& word) { return word.starts_with(text); }))
    return HistoryWord::possible;
  const auto all = c.schemas.all();
  return std::any_of(
             all.begin(), all.end(),
             [&](const Schema* s) { return s->keyword.starts_with("/TH/") && has_word(*s, text); })
             ? HistoryWord::possible
             : HistoryWord::unknown;
}

/// Calls f(card, cell) for the non-blank words of a history.
template <class F>
void for_each_word(const DecodedBlock& d, F&& f) {
  for (const DecodedCard& card : d.cards)
    if (card.schema->words)
      for (const Cell& cell : card.cells)
        if (!cell.blank()) f(card, cell);
}

void check_variable(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.histories) {
    const Schema& schema = *d.block->schema;
    if (legal_words(schema).empty()) continue;
    for_each_word(d, [&](const DecodedCard& card, const Cell& cell) {
      if (open_word(card, cell)) return;
      const HistoryWord word = judge(c, schema, cell.text);
      if (word == HistoryWord::known) return;
      const bool sure = word == HistoryWord::unknown;
      Finding& found = r.report(rule, *d.block, cell.span,
                                fmt::format("'{}' {} variable of {}", cell.text,
                                            sure ? "is no" : "is no documented", schema.keyword));
      if (sure) return;
      found.severity = Severity::warning;
      found.reference.reset();
    });
  }
}

void check_no_variable(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.histories) {
    const Schema& schema = *d.block->schema;
    const bool described = std::any_of(
        schema.cards.begin(), schema.cards.end(),
        [&](const CardSchema& card) { return card.words && card.in_version(d.block->version); });
    if (!described) continue;
    bool any = false;
    for_each_word(d, [&](const DecodedCard& card, const Cell& cell) {
      any = any || legal_words(schema).empty() || open_word(card, cell) ||
            judge(c, schema, cell.text) != HistoryWord::unknown;
    });
    if (!any) r.report(rule, *d.block, d.block->header_span, name_of(d) + " asks for no variable");
  }
}

/// First id of the list; 0: all objects.
std::int64_t first_id(const DecodedBlock& d) {
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells)
      if (cell.field->type == FieldType::id) return cell.integer;
  return 0;
}

/// A frame can replace a skew, a sub-interface an interface.
bool history_target_exists(const LintContext& c, std::string_view kind, std::int64_t id) {
  const auto& blocks = c.deck.blocks;
  return target_exists(c, kind, id).value_or(true) ||
         (kind == "skew" && target_exists(c, "frame", id).value_or(true)) ||
         (kind == "inter" && std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) {
            return is_below(b.header, "/INTER/SUB") && c.resolved(b, kind, b.id.value) == id;
          }));
}

/// The solver warns about missing objects in a list of objects, and stops in a list of lines.
void report_missing(Reporter& r, const Rule& rule, const DecodedBlock& d, Span span, bool warning,
                    int message, std::string text) {
  Finding& found = r.report(rule, *d.block, span, std::move(text));
  if (warning) found.severity = Severity::warning;
  found.reference.reset();
  if (message != 0) found.reference = ReferenceMessage{message, found.severity};
}

void check_object(const LintContext& c, const Rule& rule, Reporter& r, const DecodedBlock& d,
                  const DecodedCard& card, const Cell& cell) {
  const std::string_view kind = cell.field->ref;
  const std::int64_t id = c.resolved(*d.block, kind, cell.integer);
  if (id != 0 && history_target_exists(c, kind, id)) return;
  const bool placed = cell.span.valid() && cell.span.length > 0;
  std::string text = id == 0 ? fmt::format("a line of {} names no {}", name_of(d), kind_name(kind))
                             : fmt::format("{} names {} {}, which does not exist", name_of(d),
                                           kind_name(kind), id);
  if (id == 0 && !cell.text.empty()) text += fmt::format(": '{}' is read as 0", cell.text);
  report_missing(r, rule, d, placed ? cell.span : card.line.whole(),
                 card.schema->repeat == Repeat::ids, *cell.field->missing, std::move(text));
}

void check_missing_object(const LintContext& c, const Rule& rule, Reporter& r) {
  for (const DecodedBlock& d : c.histories) {
    int zeros = 0;
    Span first_zero;
    const bool all = first_id(d) == 0;
    for_each_cell(d, [&](const DecodedCard& card, const Cell& cell) {
      const bool list = card.schema->repeat == Repeat::ids;
      if ((list && all) || cell.field->type != FieldType::id || !cell.field->missing) return;
      const bool unresolved = cell.parameter && cell.integer == 0;
      const bool first = &cell == card.cells.data();
      if (cell.integer == 0 && list && cell.field->ref == "part") {
        if (zeros++ == 0) first_zero = cell.span;
      } else if (!unresolved && (cell.integer != 0 || (!list && first))) {
        check_object(c, rule, r, d, card, cell);
      }
    });
    if (zeros > 0)
      report_missing(r, rule, d, first_zero, true, 1610,
                     fmt::format("{} cell{} of {} hold{} 0, and no part has that id", zeros,
                                 zeros == 1 ? "" : "s", name_of(d), zeros == 1 ? "s" : ""));
  }
}

/// The solver refuses an object listed twice in a block ("entry"), or in two blocks ("again").
void check_listed_twice(const LintContext& c, const Rule& rule, Reporter& r) {
  using Object = std::tuple<const Block*, std::string_view, std::int64_t>;
  std::map<Object, std::pair<const DecodedBlock*, const Cell*>> seen;
  for (const DecodedBlock& d : c.histories) {
    const int entry = d.block->schema->stop("entry").value_or(Schema::goes_on);
    const int again = d.block->schema->stop("again").value_or(Schema::goes_on);
    const bool across = again != Schema::goes_on;
    if ((entry == Schema::goes_on && !across) || first_id(d) == 0) continue;
    for_each_cell(d, [&](const DecodedCard& card, const Cell& cell) {
      if (cell.field->type != FieldType::id || cell.integer == 0) return;
      // Other ids of a line set how the object is written.
      if (card.schema->repeat != Repeat::ids && &cell != card.cells.data()) return;
      const std::string_view kind = cell.field->ref;
      const std::int64_t id = c.resolved(*d.block, kind, cell.integer);
      if (!target_exists(c, kind, id).value_or(false)) return;
      const auto [it, fresh] =
          seen.try_emplace({across ? nullptr : d.block, kind, id}, std::pair{&d, &cell});
      const auto& [other, first] = it->second;
      if (fresh || (across && other == &d)) return;
      Finding& found =
          r.report(rule, *d.block, cell.span,
                   across ? fmt::format("{} {} is in {} and in {}", kind_name(kind), id,
                                        name_of(*other), name_of(d))
                          : fmt::format("{} lists {} {} twice", name_of(d), kind_name(kind), id));
      found.reference = ReferenceMessage{across ? again : entry, Severity::error};
      found.notes.emplace_back(first->span, "the other one is here");
    });
  }
}

}  // namespace

std::vector<Checked> history_checks() {
  return {{RuleId::DK650, check_variable},
          {RuleId::DK651, check_no_variable},
          {RuleId::DK652, check_missing_object},
          {RuleId::DK653, check_listed_twice}};
}

}  // namespace deck::detail
