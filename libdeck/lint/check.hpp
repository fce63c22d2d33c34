// Shared by the checks: context, names and places for findings, targets of ids, limits of values,
// table of rules and functions. Private to the lint stage.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/lint.hpp"
#include "deck/text.hpp"
#include "keyword/shared/decode_parts.hpp"
#include "lint/cell_rule.hpp"
#include "lint/shared/fix.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

/// Decodes the blocks that rules read: interfaces, time histories, blocks with ids of others.
LintContext build_context(const LoadedDeck& loaded);

/// A value as people write it: integers without a point, else up to six digits.
std::string number_text(double value);

/// The beginning of a long text.
inline std::string clipped(std::string_view text, std::size_t longest = 60) {
  return std::string(text.substr(0, longest)) + (text.size() > longest ? "…" : "");
}

/// Calls f(card) for the interfaces of the rule's types.
template <class F>
void for_each_contact(const LintContext& c, const Rule& rule, F&& f) {
  for (const ContactCard& card : c.contacts)
    for (const int type : rule.types)
      if (card.type == type) f(card);
}

/// "/INTER/TYPE7 3": name of a block with a schema.
inline std::string name_of(const DecodedBlock& d) {
  return d.block->schema->keyword + " " + std::to_string(d.block->id.value);
}
inline std::string name_of(const ContactCard& card) { return name_of(card.decoded); }

/// "/TH/NODE": the header up to the id.
inline std::string_view names_of(const Block& block) {
  if (!block.id.span.valid()) return block.keyword;
  const std::string_view names =
      block.header.substr(0, block.id.span.offset - block.header_span.offset);
  return names.substr(0, names.find_last_not_of("/ ") + 1);
}

/// Number in a cell of any type.
inline double number_of(const Cell& cell) {
  return cell.field->type == FieldType::real ? cell.real : static_cast<double>(cell.integer);
}

/// Columns of a cell; the header if the cell or its line is missing.
inline Span place_of(const DecodedBlock& d, const Cell* cell) {
  return cell != nullptr && cell->span.valid() ? cell->span : d.block->header_span;
}
inline Span place_of(const DecodedBlock& d, std::string_view field) {
  return place_of(d, d.find(field));
}

/// Calls f(card, cell) for the cells of a block.
template <class F>
void for_each_cell(const DecodedBlock& d, F&& f) {
  for (const DecodedCard& card : d.cards)
    for (const Cell& cell : card.cells) f(card, cell);
}

/// True for fields without a list of values.
inline bool is_legal(const Field& f, std::int64_t value) {
  return f.values.empty() || std::find(f.values.begin(), f.values.end(), value) != f.values.end();
}

/// Calls f(cell) for flags with an illegal value.
template <class F>
void for_each_illegal_flag(const DecodedBlock& d, F&& f) {
  for_each_cell(d, [&](const DecodedCard&, const Cell& cell) {
    if (!cell.blank() && cell.status != NumberStatus::not_a_number &&
        !is_legal(*cell.field, cell.integer))
      f(cell);
  });
}

/// True if the deck has a block of one of the keywords.
template <class... Keywords>
bool has_block(const LintContext& c, const Keywords&... keywords) {
  return std::any_of(c.deck.blocks.begin(), c.deck.blocks.end(),
                     [&](const Block& b) { return (b.header.starts_with(keywords) || ...); });
}

/// Calls f(block) for the readable blocks of a keyword.
template <class F>
void for_each_block(const LintContext& c, std::string_view keyword, F&& f) {
  for (const Block& b : c.deck.blocks)
    if (b.schema != nullptr && !b.opaque && b.schema->keyword == keyword) f(b);
}

/// Cell Ipri of /IOFLAG: detail level of the listing; value 0 without it.
Cell printout_level(const LintContext& c);

/// Per node: true if `each(f)` calls f for the node.
template <class Each>
std::vector<bool> marked(const Model& model, Each&& for_each_node) {
  std::vector<bool> out(model.nodes.size(), false);
  for_each_node([&](NodeIndex n) {
    if (n != no_index) out[n] = true;
  });
  return out;
}

/// Per node: true if it is on the surface.
std::vector<bool> nodes_of(const Model& model, const SegmentList& surface);

inline bool is_friction(const ContactCard& card) { return card.block->schema->kind == "friction"; }

/// Calls f(card) for all interfaces and frictions.
template <class F>
void for_each_card(const LintContext& c, F&& f) {
  for (const auto* cards : {&c.contacts, &c.frictions})
    for (const ContactCard& card : *cards) f(card);
}

/// The first of several interfaces of one finding.
struct FirstCard {
  const ContactCard* card = nullptr;
  std::size_t others = 0;
  /// True for the first call.
  bool add(const ContactCard& c) {
    if (card != nullptr) {
      ++others;
      return false;
    }
    card = &c;
    return true;
  }
};

/// Legal values of a flag: "0, 1 or 4".
inline std::string list_of(const std::vector<std::int64_t>& values) {
  std::string out;
  for (std::size_t i = 0; i < values.size(); ++i)
    out += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + std::to_string(values[i]);
  return out;
}

inline Finding& report_at(Reporter& r, const Rule& rule, const ContactCard& card,
                          std::string_view field, std::string message) {
  return r.report(rule, field, *card.block, card.span(field), std::move(message));
}

/// Adds a note "because of this" at another field of the card.
inline void note_field(Finding& d, const ContactCard& card, std::string_view field) {
  const FieldView* f = card.find(field);
  if (f != nullptr && f->span.valid()) d.notes.emplace_back(f->span, card.show(field));
}

/// Adds a fix that writes `text` into a field; empty `text` blanks it.
inline void fix_field(Finding& d, const LintContext& c, const ContactCard& card,
                      std::string_view field, std::string_view text, bool safe, std::string title) {
  const FieldView* f = card.find(field);
  // In free format a cell has no columns.
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
  d.fix = std::move(fix);
}

/// True if f(field) is true for a field of the rule; f("") for rules without fields.
template <class F>
bool any_name(const Rule& rule, F&& f) {
  if (rule.fields.empty()) return f(std::string_view());
  return std::any_of(rule.fields.begin(), rule.fields.end(),
                     [&](const RuleField& field) { return f(std::string_view(field.name)); });
}

struct Checked {
  RuleId id;
  void (*check)(const LintContext&, const Rule&, Reporter&);
};

std::vector<Checked> cell_checks();           // predicates on rule pages
std::vector<Checked> header_checks();         // keywords, titles, versions
std::vector<Checked> target_checks();         // ids of loads
std::vector<Checked> history_checks();        // time histories
std::vector<Checked> physics_checks();        // density, stiffness, mass
std::vector<Checked> element_checks();        // elements, functions
std::vector<Checked> reference_checks();      // targets of interfaces and frictions
std::vector<Checked> value_checks();          // flags and ranges of numbers
std::vector<Checked> line_checks();           // optional lines
std::vector<Checked> default_checks();        // /DEFAULT/INTER
std::vector<Checked> pitfall_checks();        // legal cards with a frequent side effect
std::vector<Checked> engine_checks();         // Engine files beside the deck
std::vector<Checked> kinematic_checks();      // conflicting kinematic conditions
std::vector<Checked> sense_checks();          // units, volumes, masses of the model
std::vector<Checked> silent_change_checks();  // values that only the listing shows as changed

/// All checks, ordered by id.
const std::vector<Checked>& all_checks();

/// A check of single blocks; a block is decoded once for all checks of its keyword.
struct BlockChecked {
  RuleId id;
  bool (*wants)(const Rule&, const Schema&);
  void (*check)(const LintContext&, const Rule&, Reporter&, const DecodedBlock&);
};

std::span<const BlockChecked> all_block_checks();  // Defined in values.cpp.

/// "/GRNOD" for "grnod", "node" for "node": kind of an entity in messages.
std::string_view kind_name(std::string_view kind);

/// True for a /GRNOD, /SURF or /LINE (`kind` "grnod", "surf", "line"), or a /SET with that id.
bool selection_exists(const LintContext& c, std::string_view kind, std::int64_t id);

/// "/GRNOD 5" if it exists, else "/SET 5".
std::string selection_name(const LintContext& c, std::string_view kind, std::int64_t id);

/// Number of nodes, segments or edges of a selection.
std::size_t selection_size(const LintContext& c, std::string_view kind, std::int64_t id);

/// False if members were left out (DK332), because the selection may have some.
bool selection_is_empty(const LintContext& c, std::string_view kind, std::int64_t id);

/// True if the entity exists; nullopt: unknown (no model, or a kind without a table).
std::optional<bool> target_exists(const LintContext& c, std::string_view kind, std::int64_t id);

/// "grnod_ID of /BCS 3 is 7, and there is no /GRNOD or /SET of that id"; also where the id exists.
std::string missing_text(const LintContext& c, const DecodedBlock& d, std::string_view field,
                         std::string_view kind, std::int64_t id);

/// Adds a note at the definition of a group, surface or line.
void note_definition(const LintContext& c, Finding& d, std::string_view kind, std::int64_t id);

/// The field that names the target of a load, and if it exists; nullptr: no such field.
std::pair<const Field*, bool> acts_on(const LintContext& c, const DecodedBlock& d);

/// The field that names the target, if the solver ignores the block: id 0, or no load of the deck
/// has a target. Else nullptr.
const Field* acts_on_nothing(const LintContext& c, const DecodedBlock& d);

/// Values with solver messages, from the rule pages.
const std::vector<Limit>& all_limits();
/// The limits of a keyword.
const std::vector<const Limit*>& limits_of(const Schema& schema);

}  // namespace deck::detail
