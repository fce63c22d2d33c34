// Small helpers that the checks share. Private to the lint stage.
#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "deck/lint/lint.hpp"
#include "lint/context.hpp"
#include "lint/shared/fix.hpp"

namespace deck::detail {

/// Calls f(card) for the interfaces of the types that the rule is true for.
template <class F>
void each(const LintContext& c, const Rule& rule, F&& f) {
  for (const ContactCard& card : c.contacts)
    for (const int type : rule.types)
      if (card.type == type) f(card);
}

/// "/INTER/TYPE7 3"
inline std::string name_of(const ContactCard& card) {
  return card.decoded.block->schema->keyword + " " + std::to_string(card.block->id.value);
}

/// Legal values of a flag: "0, 1 or 4".
inline std::string list_of(const std::vector<std::int64_t>& values) {
  std::string out;
  for (std::size_t i = 0; i < values.size(); ++i)
    out += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + std::to_string(values[i]);
  return out;
}

inline Diagnostic* report_at(Reporter& r, const Rule& rule, const ContactCard& card,
                             std::string_view field, std::string message) {
  return r.report(rule, field, *card.block, card.span(field), std::move(message));
}

/// Adds "because of this" with the place of another field of the card.
inline void note_field(Diagnostic* d, const ContactCard& card, std::string_view field) {
  if (d == nullptr) return;
  const FieldView* f = card.find(field);
  if (f != nullptr && f->span.valid()) d->notes.emplace_back(f->span, card.show(field));
}

/// A fix that writes `text` into the cell of a field, or blanks it if `text` is empty.
inline void fix_field(Diagnostic* d, const LintContext& c, const ContactCard& card,
                      std::string_view field, std::string_view text, bool safe, std::string title) {
  if (d == nullptr) return;
  const FieldView* f = card.find(field);
  // In free format a cell has no columns to write to.
  if (f == nullptr || f->field == nullptr || !f->span.valid()) return;
  for (const DecodedCard& line : card.decoded.cards)
    for (const Cell& cell : line.cells)
      if (cell.field == f->field && line.free_format) return;
  Fix fix;
  fix.title = std::move(title);
  fix.safe = safe;
  if (text.empty()) {
    if (f->span.length == 0) return;
    fix.edits.push_back(blank_edit(f->span));
  } else {
    fix.edits.push_back(
        CellWriter::edit(c.deck.sources, f->span, f->field->first, f->field->last, text));
  }
  d->fix = std::move(fix);
}

}  // namespace deck::detail
