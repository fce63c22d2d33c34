#include "deck/edit/version.hpp"

#include <algorithm>
#include <unordered_map>

#include "deck/text/number.hpp"
#include "edit/version_cards.hpp"

namespace deck {
namespace {

using detail::canonical_name;
using detail::is_zero_text;
using detail::LineEdits;
using detail::put_cell;

constexpr int oldest_source = 100;
constexpr int oldest_target = 110;

std::string number(std::int64_t n) { return std::to_string(n); }

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && static_cast<unsigned char>(s.front()) <= ' ') s.remove_prefix(1);
  while (!s.empty() && static_cast<unsigned char>(s.back()) <= ' ') s.remove_suffix(1);
  return s;
}

/// Text of columns first..last of a line.
std::string_view columns(std::string_view line, int first, int last) {
  const auto begin = static_cast<std::size_t>(first - 1);
  if (begin >= line.size()) return {};
  return trimmed(line.substr(begin, static_cast<std::size_t>(last - first + 1)));
}

bool is_begin(const Block& b) { return b.header == "/BEGIN" || b.header.starts_with("/BEGIN/"); }

/// A line of the new layout and the old line it comes from.
struct NewLine {
  const CardSchema* card = nullptr;
  const DecodedCard* old = nullptr;
};

class VersionRewriter {
 public:
  VersionRewriter(const EditContext& context, int target, const VersionOptions& options)
      : c_(context), target_(target), options_(options), lines_(context.deck.sources) {
    for (const InterBase* inter : c_.interfaces.ordered) inter_of_.emplace(inter->block, inter);
  }

  Rewrite run() {
    if (!accepted()) return std::move(out_);
    for (const Block& block : c_.deck.blocks) {
      if (is_begin(block))
        convert_begin(block);
      else if (block.version != target_)
        convert_block(block);
    }
    lines_.finish(out_.edits);
    note_partial();
    return std::move(out_);
  }

 private:
  // ---- what is refused as a whole -----------------------------------------------------------

  bool accepted() {
    const Begin& begin = c_.deck.begin;
    if (target_ < oldest_target || !is_known_version(target_))
      out_.refusals.push_back(c_.deck.sources[0].path() + ":1:1: " + number(target_) +
                              " is no version that can be written; 110 to 140 and 2017 to " +
                              number(newest_version) + " are");
    if (!begin.span.valid())
      out_.refusals.push_back(c_.deck.sources[0].path() +
                              ":1:1: the deck has no /BEGIN, so its version is unknown");
    for (const Block& b : c_.deck.blocks) {
      if (b.version >= oldest_source) continue;
      refuse(b.header_span, "version " + number(b.version) +
                                " is too old: its units stand outside /BEGIN and its cards follow "
                                "other rules; decks from version 100 on can be converted");
      break;
    }
    return out_.refusals.empty();
  }

  void refuse(Span span, const std::string& why) {
    out_.refusals.push_back(c_.deck.sources.where(span) + ": " + why);
  }

  LossEntry& report(Loss loss, const Block& block, Span span, std::string_view field,
                    std::string_view old_text, std::string note) {
    LossEntry entry = loss_entry(c_.deck, loss, block, span);
    entry.field = std::string(field);
    entry.old_text = std::string(old_text);
    entry.note = std::move(note);
    out_.losses.push_back(std::move(entry));
    return out_.losses.back();
  }

  void undecided(const Block& block, Span span, std::string_view field, std::string_view text,
                 const std::string& why) {
    report(Loss::undecided, block, span, field, text, why);
    refuse(span, std::string(block.keyword) + " " + std::string(field) + ": " + why);
  }

  std::string step(const Block& block) const {
    return "version " + number(block.version) + " to " + number(target_);
  }

  // ---- /BEGIN -------------------------------------------------------------------------------

  void convert_begin(const Block& block) {
    LineCursor cursor(c_.deck.sources, block);
    cursor.next();
    const Line line = cursor.next();
    if (!line.valid()) {
      refuse(block.header_span, "/BEGIN has no line with the version; add it");
      return;
    }
    const std::string_view cell = line.text.substr(0, 10);
    const std::string_view old = trimmed(cell);
    const std::string fresh = number(target_);
    if (old == fresh) return;
    std::string text(line.text);
    // Where the number stands alone in its columns, only they change; a comma closer by does not
    // count for the solver, but it is kept.
    const auto comma = cell.find(',');
    if (comma != std::string_view::npos) {
      text.replace(0, comma, fresh);
    } else {
      if (text.size() < 10) text.resize(10, ' ');
      text.replace(0, 10, 10 - fresh.size(), ' ');
      text.insert(10 - fresh.size(), fresh);
    }
    lines_.change(line, text, out_.edits);
    const bool known = is_known_version(static_cast<int>(read_integer(cell).value));
    report(
        Loss::kept, block, line.columns(1, 10), "version", old,
        known ? std::string() : "it was read with the columns of version " + number(block.version))
        .new_text = fresh;
  }

  // ---- blocks -------------------------------------------------------------------------------

  void convert_block(const Block& block) {
    if (block.schema == nullptr || block.opaque) {
      ++partial_[std::string(block.keyword)];
      return;
    }
    const Schema& schema = *block.schema;
    if (schema.opaque_tail && schema.kind != "engine") ++partial_[schema.keyword];
    if (target_ < schema.from && block.version >= schema.from)
      report(Loss::kept, block, {}, "", "",
             schema.keyword + " is newer than version " + number(target_) +
                 "; the reference solver reads it with the columns of version " +
                 number(schema.from) + " and warns (100211)");
    if (!differs(schema, block.version)) return;
    const DecodedBlock decoded = decode(c_.deck, block);
    if (schema.opaque_tail) {
      check_partial(block, decoded);
      return;
    }
    const std::size_t before = out_.edits.size();
    const bool repeated = std::any_of(schema.cards.begin(), schema.cards.end(),
                                      [](const CardSchema& c) { return c.repeat != Repeat::once; });
    bool changed = convert_once(block, decoded);
    if (repeated) convert_repeated(block, decoded);
    changed = changed || out_.edits.size() != before;
    if (!changed) return;
    LossEntry& entry = report(Loss::kept, block, {}, "", number(block.version), step(block));
    entry.new_text = number(target_);
  }

  bool differs(const Schema& schema, int version) {
    const auto [it, is_new] = differs_.try_emplace({&schema, version}, false);
    if (is_new) it->second = detail::layout_differs(schema, version, target_);
    return it->second;
  }

  /// Value of a flag in the new layout: what has no cell any more is 0.
  std::int64_t flag_after(const Block& block, const DecodedBlock& decoded,
                          std::string_view field) const {
    for (const CardSchema& card : block.schema->cards)
      if (card.in_version(target_))
        for (const Field& f : card.fields)
          if (f.in_version(target_) && f.name == field) return decoded.integer(field);
    return 0;
  }

  bool holds_after(const Block& block, const DecodedBlock& decoded, const CardSchema& card) const {
    return card.in_version(target_) &&
           std::all_of(card.when.begin(), card.when.end(), [&](const Condition& c) {
             return c.holds(flag_after(block, decoded, c.field));
           });
  }

  /// The lines of the new layout, in order, as far as the old block goes.
  std::vector<NewLine> plan(const Block& block, const DecodedBlock& decoded) const {
    std::vector<NewLine> plan;
    std::vector<bool> used(decoded.cards.size(), false);
    for (const CardSchema& card : block.schema->cards) {
      if (card.repeat != Repeat::once || !holds_after(block, decoded, card)) continue;
      NewLine line{&card, nullptr};
      for (std::size_t k = 0; k < decoded.cards.size() && line.old == nullptr; ++k) {
        const CardSchema& old = *decoded.cards[k].schema;
        if (used[k] || old.repeat != Repeat::once || (&old != &card && old.name != card.name))
          continue;
        used[k] = true;
        line.old = &decoded.cards[k];
      }
      plan.push_back(line);
    }
    // What follows the last line that is there: a new line right behind it is needed, so that the
    // block is complete; behind a missing one nothing is.
    std::size_t last = plan.size();
    while (last > 0 && (plan[last - 1].old == nullptr || plan[last - 1].old->missing())) --last;
    if (last == 0) return {};
    while (last < plan.size() && plan[last].old == nullptr) ++last;
    while (last > 0 && plan[last - 1].old == nullptr && plan[last - 1].card->optional &&
           compose(block, decoded, plan[last - 1], nullptr).empty())
      --last;
    plan.resize(last);
    return plan;
  }

  /// Lines that occur once. True if something changed.
  bool convert_once(const Block& block, const DecodedBlock& decoded) {
    const std::vector<NewLine> lines = plan(block, decoded);
    if (lines.empty()) return false;
    const std::size_t before = out_.edits.size();
    bool inserted = false;
    std::vector<bool> stays(decoded.cards.size(), false);
    Span anchor = decoded.title_line.valid() ? decoded.title_line.whole() : block.header_span;
    std::ptrdiff_t place = -1;  // of the last old line that stayed where it was
    for (const NewLine& line : lines) {
      const std::string text = compose(block, decoded, line, this);
      const bool there = line.old != nullptr && !line.old->missing();
      const std::ptrdiff_t k = line.old == nullptr ? -1 : line.old - decoded.cards.data();
      if (there && k > place) {
        lines_.change(line.old->line, text, out_.edits);
        stays[static_cast<std::size_t>(k)] = true;
        place = k;
        anchor = line.old->line.whole();
      } else {
        lines_.insert_after(anchor, text);
        inserted = true;
      }
    }
    for (std::size_t k = 0; k < decoded.cards.size(); ++k) {
      const DecodedCard& card = decoded.cards[k];
      if (card.schema->repeat != Repeat::once || card.missing()) continue;
      if (stays[k]) continue;
      const bool moved =
          std::any_of(lines.begin(), lines.end(), [&](const NewLine& l) { return l.old == &card; });
      if (!moved)
        for (const Cell& cell : card.cells)
          if (!has_cell(lines, cell.field->name)) vanish(block, cell);
      lines_.remove(card.line, out_.edits);
    }
    return inserted || out_.edits.size() != before;
  }

  bool has_cell(const std::vector<NewLine>& lines, std::string_view field) const {
    return std::any_of(lines.begin(), lines.end(), [&](const NewLine& l) {
      return std::any_of(l.card->fields.begin(), l.card->fields.end(), [&](const Field& f) {
        return f.in_version(target_) && canonical_name(f.name) == canonical_name(field);
      });
    });
  }

  /// Groups and lists: cards are changed or taken away where they stand. No version adds a card to
  /// a round whose flags are blank.
  void convert_repeated(const Block& block, const DecodedBlock& decoded) {
    for (const DecodedCard& card : decoded.cards) {
      if (card.schema->repeat == Repeat::once || card.missing()) continue;
      if (card.schema->in_version(target_)) {
        if (card.schema->repeat == Repeat::ids) continue;
        lines_.change(card.line, compose(block, decoded, {card.schema, &card}, this), out_.edits);
        continue;
      }
      for (const Cell& cell : card.cells) vanish(block, cell);
      lines_.remove(card.line, out_.edits);
    }
  }

  // ---- one line -----------------------------------------------------------------------------

  /// Cell of that name on another line of the old block.
  static const Cell* elsewhere(const DecodedBlock& decoded, const DecodedCard* not_here,
                               std::string_view field) {
    for (const DecodedCard& card : decoded.cards) {
      if (&card == not_here || card.schema->repeat != Repeat::once) continue;
      for (const Cell& cell : card.cells)
        if (canonical_name(cell.field->name) == canonical_name(field)) return &cell;
    }
    return nullptr;
  }

  /// Text of a line in the new layout. Findings go to `findings`, which is this or nullptr.
  std::string compose(const Block& block, const DecodedBlock& decoded, const NewLine& line,
                      VersionRewriter* findings) const {
    const auto fields = detail::fields_of(*line.card, target_);
    const bool there = line.old != nullptr && !line.old->missing();
    if (there && line.old->free_format) return compose_free(block, fields, *line.old, findings);
    std::string text = there ? std::string(line.old->line.text) : std::string();
    std::vector<std::pair<const Field*, const Cell*>> moved;
    std::vector<const Field*> fresh;
    for (const Field* f : fields) {
      const Cell* source = there ? cell_of(*line.old, f->name) : nullptr;
      if (source != nullptr && source->field->first == f->first && source->field->last == f->last)
        continue;
      if (source == nullptr && line.card->repeat == Repeat::once)
        source = elsewhere(decoded, line.old, f->name);
      if (source != nullptr)
        moved.emplace_back(f, source);
      else
        fresh.push_back(f);
    }
    if (there) leave_cells(block, fields, *line.old, text, findings);
    if (there)
      for (const Field* f : fresh) clear_stray(block, *f, *line.old, text, findings);
    for (const auto& [field, cell] : moved) carry(block, *field, *cell, text, findings);
    return text;
  }

  static const Cell* cell_of(const DecodedCard& card, std::string_view field) {
    for (const Cell& cell : card.cells)
      if (canonical_name(cell.field->name) == canonical_name(field)) return &cell;
    return nullptr;
  }

  /// Blanks the cells of the old line that the new one does not have in those columns.
  void leave_cells(const Block& block, const std::vector<const Field*>& fields,
                   const DecodedCard& old, std::string& text, VersionRewriter* findings) const {
    for (const Cell& cell : old.cells) {
      const Field& f = *cell.field;
      const auto same = std::find_if(fields.begin(), fields.end(), [&](const Field* other) {
        return canonical_name(other->name) == canonical_name(f.name);
      });
      if (same != fields.end() && (*same)->first == f.first && (*same)->last == f.last) continue;
      if (cell.blank()) continue;
      put_cell(text, f.first, f.last, "");
      if (same == fields.end() && !elsewhere_after(block, old, f.name) && findings != nullptr)
        findings->vanish(block, cell);
    }
  }

  /// True if another card of the new layout has the cell.
  bool elsewhere_after(const Block& block, const DecodedCard& old, std::string_view field) const {
    for (const CardSchema& card : block.schema->cards) {
      if (&card == old.schema || !card.in_version(target_)) continue;
      for (const Field& f : card.fields)
        if (f.in_version(target_) && canonical_name(f.name) == canonical_name(field)) return true;
    }
    return false;
  }

  /// Text that meant nothing must not become a value.
  void clear_stray(const Block& block, const Field& field, const DecodedCard& old,
                   std::string& text, VersionRewriter* findings) const {
    const std::string stray(columns(text, field.first, field.last));
    if (stray.empty() || is_zero_text(stray)) return;
    put_cell(text, field.first, field.last, "");
    if (findings == nullptr) return;
    findings->report(
        Loss::kept, block, old.line.columns(field.first, field.last), field.name, stray,
        "removed: it has no meaning in version " + number(block.version) + " and would get one");
  }

  void carry(const Block& block, const Field& field, const Cell& cell, std::string& text,
             VersionRewriter* findings) const {
    const auto width = static_cast<std::size_t>(field.last - field.first + 1);
    if (cell.blank()) return;
    if (cell.text.size() <= width) {
      put_cell(text, field.first, field.last, cell.text);
      return;
    }
    const auto shorter = field.type == FieldType::real && !cell.parameter
                             ? format_real(cell.real, static_cast<int>(width))
                             : std::nullopt;
    if (shorter && shorter->exact)
      put_cell(text, field.first, field.last, shorter->text);
    else if (findings != nullptr)
      findings->undecided(block, cell.span, field.name, cell.text,
                          "the value does not fit its " + number(field.last - field.first + 1) +
                              " columns in version " + number(target_) + "; shorten it");
  }

  /// A line with commas stays as it is if it has the same cells; otherwise it gets fixed columns.
  std::string compose_free(const Block& block, const std::vector<const Field*>& fields,
                           const DecodedCard& old, VersionRewriter* findings) const {
    const bool same =
        std::equal(fields.begin(), fields.end(), old.cells.begin(), old.cells.end(),
                   [](const Field* f, const Cell& cell) {
                     return canonical_name(f->name) == canonical_name(cell.field->name);
                   });
    if (same) return std::string(old.line.text);
    std::string text;
    for (const Field* f : fields)
      if (const Cell* cell = cell_of(old, f->name)) carry(block, *f, *cell, text, findings);
    if (findings != nullptr)
      for (const Cell& cell : old.cells)
        if (std::none_of(fields.begin(), fields.end(), [&](const Field* f) {
              return canonical_name(f->name) == canonical_name(cell.field->name);
            }))
          findings->vanish(block, cell);
    return text;
  }

  // ---- values without a cell ----------------------------------------------------------------

  /// A value that the new version cannot hold.
  void vanish(const Block& block, const Cell& cell) {
    if (cell.blank()) return;
    const Field& field = *cell.field;
    if (field.ignored) {
      if (cell.integer != 0)
        report(Loss::kept, block, cell.span, field.name, cell.text,
               "removed: the reference solver does not use it");
      return;
    }
    if (is_default(block, cell)) return;
    const std::string why = "version " + number(target_) + " has no cell for it";
    if (field.name == "Ists") {
      undecided(block, cell.span, field.name, cell.text,
                why +
                    ", and grnd_IDs would be read as a node group; set Ists to 0 and name a "
                    "node group first");
      return;
    }
    report(Loss::dropped, block, cell.span, field.name, cell.text, why);
    if (!options_.allow_loss)
      refuse(cell.span, std::string(block.keyword) + "/" + number(block.id.value) + " " +
                            field.name + " = " + std::string(cell.text) + " would be lost: " + why);
  }

  /// True if the solver uses the same value without the cell.
  bool is_default(const Block& block, const Cell& cell) const {
    const Field& field = *cell.field;
    if (field.type == FieldType::text) return cell.text == field.default_text;
    const bool unreadable =
        cell.status == NumberStatus::not_a_number || cell.status == NumberStatus::not_finite;
    if (unreadable) return false;
    const double value =
        field.type == FieldType::real ? cell.real : static_cast<double>(cell.integer);
    const auto inter = inter_of_.find(&block);
    if (inter == inter_of_.end()) return value == 0 || value == default_of(field);
    const double then = default_at(block, field, target_);
    // A 0 is the default of its version.
    return value == 0 ? default_at(block, field, block.version) == then : value == then;
  }

  double default_of(const Field& field) const {
    if (field.name == "Irem_i2" && c_.model.implicit) return 1;
    return detail::default_number(field);
  }

  /// What the solver fills in for a cell of an interface that is 0 or missing: its default card, as
  /// far as that has the cell in this version, or the built-in value.
  double default_at(const Block& block, const Field& field, int version) const {
    const Block* card = nullptr;
    const DefaultInter* in_force = nullptr;
    for (const DefaultInter& d : c_.interfaces.defaults)
      if (inter_of_.at(&block)->type == d.type) in_force = &d;
    for (const Block& b : c_.deck.blocks) {
      if (&b == &block) break;
      if (in_force != nullptr && b.header_span == in_force->span) card = &b;
    }
    if (card == nullptr || card->schema == nullptr) return default_of(field);
    const auto* given = in_force->find(field.name);
    const int layout = std::max(version, card->schema->from);
    for (const CardSchema& c : card->schema->cards)
      if (given != nullptr && c.in_version(layout))
        for (const Field& f : c.fields)
          if (f.name == field.name && f.in_version(layout))
            return static_cast<double>(given->value);
    return default_of(field);
  }

  // ---- keywords described in part -----------------------------------------------------------

  /// Cells that come or go in a block of which only some cells are known: text in those columns
  /// cannot be judged, so it has to be blank or zero.
  void check_partial(const Block& block, const DecodedBlock& decoded) {
    for (const CardSchema& card : block.schema->cards)
      if (card.repeat == Repeat::once && card.in_version(block.version) != card.in_version(target_))
        undecided(block, block.header_span, card.name, "",
                  "its lines differ between these versions and are known in part only");
    for (const DecodedCard& card : decoded.cards) {
      if (card.missing() || !card.schema->in_version(target_)) continue;
      for (const Field& f : card.schema->fields) {
        const bool had = f.in_version(block.version), has = f.in_version(target_);
        if (had == has) continue;
        const std::string_view text = columns(card.line.text, f.first, f.last);
        if (is_zero_text(text)) continue;
        const Span span = card.line.columns(f.first, f.last);
        if (has) {
          undecided(block, span, f.name, text,
                    "columns " + number(f.first) + "-" + number(f.last) + " become " + f.name +
                        " in version " + number(target_) + "; what they were is not known");
          continue;
        }
        const Cell* cell = cell_of(card, f.name);
        if (cell == nullptr || cell->blank()) continue;
        vanish(block, *cell);
        std::string line(card.line.text);
        put_cell(line, f.first, f.last, "");
        lines_.change(card.line, line, out_.edits);
      }
    }
  }

  void note_partial() {
    if (partial_.empty()) return;
    std::string text = "kept as they are, because no schema describes them in full:";
    const char* separator = " ";
    for (const auto& [keyword, count] : partial_) {
      text += separator + keyword + (count > 1 ? " (" + number(count) + ")" : "");
      separator = ", ";
    }
    out_.notes.push_back(std::move(text));
  }

  const EditContext& c_;
  const int target_;
  const VersionOptions& options_;
  Rewrite out_;
  LineEdits lines_;
  std::unordered_map<const Block*, const InterBase*> inter_of_;
  std::map<std::pair<const Schema*, int>, bool> differs_;
  std::map<std::string, int> partial_;
};

}  // namespace

Rewrite to_version(const EditContext& context, int version, const VersionOptions& options) {
  return VersionRewriter(context, version, options).run();
}

}  // namespace deck
