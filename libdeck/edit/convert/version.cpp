// Rewrites blocks whose layout differs between two input versions and reports every value.
// Per block: evaluate the conditions of both layouts, pair lines by card and round (TargetLayout),
// move cells by name; a cell without a place in the new version is dropped if the solver uses the
// same value without it, else reported as loss or refused. Lines with equal cells keep their bytes
// and comments.
#include "deck/edit.hpp"

#include <algorithm>
#include <unordered_map>

#include "deck/text.hpp"
#include "edit/cells.hpp"
#include "keyword/shared/schema_facts.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace {

using detail::canonical_name;
using detail::cell_of;
using detail::is_zero_text;
using detail::LineEdits;
using detail::NewLine;
using detail::TargetLayout;

constexpr int oldest_source = 100;
constexpr int oldest_target = 110;

std::string number(std::int64_t n) { return std::to_string(n); }

using detail::trim;

std::string_view cell_text(std::string_view line, int first, int last) {
  return trim(detail::columns(line, first, last));
}

bool is_begin(const Block& b) { return b.header == "/BEGIN" || b.header.starts_with("/BEGIN/"); }

class VersionRewriter {
 public:
  VersionRewriter(const LoadedDeck& context, int target, const VersionOptions& options)
      : c_(context), target_(target), options_(options), lines_(context.deck().sources) {
    for (const InterBase* inter : c_.interfaces().all) inter_of_.emplace(inter->block, inter);
  }

  Rewrite run() {
    if (!accepted()) return std::move(out_);
    for (const Block& block : c_.deck().blocks) {
      if (is_begin(block))
        convert_begin(block);
      else if (block.version != target_)
        convert_block(block);
    }
    lines_.append_to(out_.edits);
    report_unknown();
    return std::move(out_);
  }

 private:
  // ---- what is refused as a whole -----------------------------------------------------------

  bool accepted() {
    const Begin& begin = c_.deck().begin;
    out_.bad_request = !is_target_version(target_);
    if (out_.bad_request)
      out_.refusals.push_back(c_.deck().sources[0].path() + ":1:1: " + number(target_) +
                              " is no version that can be written; 110 to 140, 2017 to 2026 and " +
                              number(newest_version) + " are");
    if (!begin.span.valid())
      out_.refusals.push_back(c_.deck().sources[0].path() +
                              ":1:1: the deck has no /BEGIN, so its version is unknown");
    for (const Block& b : c_.deck().blocks) {
      if (b.version >= oldest_source) continue;
      refuse(b.header_span, "version " + number(b.version) +
                                " is too old: its units stand outside /BEGIN and its cards follow "
                                "other rules; decks from version 100 on can be converted");
      break;
    }
    return out_.refusals.empty();
  }

  void refuse(Span span, const std::string& why) {
    out_.refusals.push_back(c_.deck().sources.where(span) + ": " + why);
  }

  LossEntry& report(Loss loss, const Block& block, Span span, std::string_view field,
                    std::string_view old_text, std::string note) {
    return out_.losses.emplace_back(
        loss_entry(c_.deck(), loss, block, span,
                   {std::string(field), std::string(old_text), {}, std::move(note)}));
  }
  /// Drops text without effect, without refusal.
  void removed(const Block& block, Span span, std::string_view field, std::string_view text,
               const std::string& why) {
    report(Loss::dropped, block, span, field, text, "removed: " + why).without_effect = true;
  }

  void undecided(const Block& block, Span span, std::string_view field, std::string_view text,
                 const std::string& why) {
    report(Loss::undecided, block, span, field, text, why);
    if (options_.allow_loss) return;
    refuse(span, std::string(block.keyword) + (field.empty() ? "" : " ") + std::string(field) +
                     ": " + why);
  }

  std::string step(const Block& block) const {
    return "version " + number(block.version) + " to " + number(target_);
  }

  // ---- /BEGIN -------------------------------------------------------------------------------

  void convert_begin(const Block& block) {
    LineCursor cursor(c_.deck().sources, block);
    cursor.next();
    const Line line = cursor.next();
    if (!line.valid()) {
      refuse(block.header_span, "/BEGIN has no line with the version; add it");
      return;
    }
    const std::string_view cell = line.text.substr(0, 10);
    const std::string_view old = trim(cell);
    const std::string fresh = number(target_);
    if (old == fresh) return;
    std::string text(line.text);
    // A number alone in its columns changes alone; the solver ignores a comma close to it, which
    // stays.
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
    if (block.schema != nullptr && block.schema->kind == "engine") return;
    if (block.schema == nullptr || block.opaque || !block.schema->layout_known()) {
      // The other version may read it with other columns.
      auto& unknown = unknown_[{std::string(block.keyword), block.version}];
      if (unknown.count++ == 0) unknown.first = &block;
      return;
    }
    const Schema& schema = *block.schema;
    if (!detail::reads_lines(schema, target_) && detail::reads_lines(schema, block.version)) {
      undecided(block, block.header_span, "", "",
                "a deck of version " + number(target_) +
                    " gets none of its lines; list the ids another way first");
      return;
    }
    if (target_ < schema.from && schema.from == newest_version) {
      undecided(block, block.header_span, "", "",
                "the keyword is new in version " + number(newest_version) +
                    "; remove it first, or keep the version");
      return;
    }
    if (target_ < schema.from && block.version >= schema.from)
      report(Loss::kept, block, {}, "", "",
             schema.keyword + " is newer than version " + number(target_) +
                 "; the reference solver reads it with the columns of version " +
                 number(schema.from) + " and warns (100211)");
    if (!differs(schema, block.version)) return;
    const DecodedBlock decoded = decode(c_.deck(), block);
    const TargetLayout layout(block, decoded, target_);
    if (layout.counts_lines()) {
      undecided(block, block.header_span, "", "",
                "in version " + number(target_) +
                    " the reference solver tells two forms of this keyword apart by their number "
                    "of lines; write the form that is meant by hand");
      return;
    }
    if (!convert_lines(block, decoded, layout)) return;
    LossEntry& entry = report(Loss::kept, block, {}, "", number(block.version), step(block));
    entry.new_text = number(target_);
  }

  bool differs(const Schema& schema, int version) {
    const auto [it, is_new] = differs_.try_emplace({&schema, version}, false);
    if (is_new) it->second = detail::layout_differs(schema, version, target_);
    return it->second;
  }

  /// A line being written: sources of its cells, receiver of findings.
  struct NewLineContext {
    const Block& block;
    const DecodedBlock& decoded;
    const TargetLayout& layout;
    const std::vector<NewLine>* lines;  ///< of the new block
    VersionRewriter* findings;          ///< this or nullptr
  };

  /// True if the old block, too, ends within this round.
  static bool cut_short(const NewLineContext& context, const NewLine& line) {
    if (line.card->repeat != Repeat::group || !line.card->in_version(context.block.version))
      return false;
    const std::vector<DecodedCard>& old = context.decoded.cards;
    const auto begun = std::find_if(old.begin(), old.end(), [&](const DecodedCard& card) {
      return card.schema->repeat == Repeat::group && card.round == line.round;
    });
    return begun != old.end() && is_met(line.card->when, context.decoded, &*begun);
  }

  /// Lines of the new layout, in order, up to the end of the old block. The line right behind the
  /// last existing one completes the block and is added; lines behind a missing one, or one that
  /// the old block lacks too, are not.
  std::vector<NewLine> plan(const NewLineContext& context) const {
    std::vector<NewLine> plan = *context.lines;
    std::size_t last = plan.size();
    while (last > 0 && (plan[last - 1].old == nullptr || plan[last - 1].old->missing())) --last;
    if (last == 0) return {};
    while (last < plan.size() && plan[last].old == nullptr && !cut_short(context, plan[last]))
      ++last;
    while (last > 0 && plan[last - 1].old == nullptr && plan[last - 1].card->optional &&
           text_of(context, plan[last - 1]).empty())
      --last;
    plan.resize(last);
    return plan;
  }

  bool convert_lines(const Block& block, const DecodedBlock& decoded, const TargetLayout& layout) {
    const std::vector<NewLine> all = layout.lines();
    const NewLineContext quiet{block, decoded, layout, &all, nullptr};
    const std::vector<NewLine> lines = plan(quiet);
    const NewLineContext context{block, decoded, layout, &lines, this};
    const std::size_t before = out_.edits.size();
    bool inserted = false;
    std::vector<bool> stays(decoded.cards.size(), false);
    Span anchor = decoded.title_line.valid() ? decoded.title_line.whole() : block.header_span;
    std::ptrdiff_t place = -1;  // index of the last old line that stayed
    for (const NewLine& line : lines) {
      const std::string text = text_of(context, line);
      const DecodedCard* old = line.old != nullptr ? line.old : donor(context, line, stays);
      const bool there = old != nullptr && !old->missing();
      const std::ptrdiff_t k = old == nullptr ? -1 : old - decoded.cards.data();
      if (there && k > place) {
        if (line.old == nullptr) report_card(context, *old);
        lines_.change(old->line, text, out_.edits);
        stays[static_cast<std::size_t>(k)] = true;
        place = k;
        anchor = old->line.whole();
      } else {
        if (line.old != nullptr && there)
          for (const Line& comment : comments_above(line.old->line))
            lines_.insert_after(anchor, std::string(comment.text));
        lines_.insert_after(anchor, text);
        inserted = true;
      }
    }
    for (std::size_t k = 0; k < decoded.cards.size(); ++k) {
      const DecodedCard& card = decoded.cards[k];
      if (card.missing() || stays[k]) continue;
      const bool moved =
          std::any_of(lines.begin(), lines.end(), [&](const NewLine& l) { return l.old == &card; });
      if (moved)
        for (const Line& comment : comments_above(card.line)) lines_.remove(comment, out_.edits);
      else
        report_card(context, card);
      lines_.remove(card.line, out_.edits);
    }
    if (lines.size() < all.size()) remove_extra(block, decoded);
    return inserted || out_.edits.size() != before;
  }

  /// Old line without successor whose cells go to the new line: the new line gets its place and its
  /// comments. nullptr if none.
  static const DecodedCard* donor(const NewLineContext& context, const NewLine& line,
                                  const std::vector<bool>& taken) {
    const auto fields = context.layout.fields(*line.card, line.round);
    const auto& cards = context.decoded.cards;
    for (std::size_t k = 0; k < cards.size(); ++k) {
      const DecodedCard& card = cards[k];
      if (taken[k] || card.missing() || card.free_format || card.round != line.round ||
          card.schema->repeat == Repeat::ids ||
          std::any_of(context.lines->begin(), context.lines->end(),
                      [&](const NewLine& l) { return l.old == &card; }))
        continue;
      if (std::any_of(fields.begin(), fields.end(),
                      [&](const Field* f) { return cell_of(card, f->name) != nullptr; }))
        return &card;
    }
    return nullptr;
  }

  /// Reports the cells of a line that has no successor.
  void report_card(const NewLineContext& context, const DecodedCard& card) {
    for (const Cell& cell : card.cells)
      if (!has_cell(context, cell.field->name, card.round)) report_lost(context.block, cell);
  }

  /// Comments right above a line.
  std::vector<Line> comments_above(const Line& line) const {
    std::vector<Line> out;
    const std::string_view bytes = c_.deck().sources[line.file].bytes();
    for (std::uint64_t at = line.offset; at > 0;) {
      const auto before = at < 2 ? bytes.npos : bytes.rfind('\n', at - 2);
      const std::uint64_t begin = before == bytes.npos ? 0 : before + 1;
      std::string_view text = bytes.substr(begin, at - 1 - begin);
      if (!text.starts_with('#') || text.starts_with("#include") || text.starts_with("#RADIOSS"))
        break;
      if (text.ends_with('\r')) text.remove_suffix(1);
      Line comment = line;
      comment.offset = begin;
      comment.text = text;
      out.insert(out.begin(), comment);
      at = begin;
    }
    return out;
  }

  /// Unread lines at the end would become cells in a layout with more lines: removes them.
  void remove_extra(const Block& block, const DecodedBlock& decoded) {
    for (const Line& line : decoded.extra) {
      if (trim(line.text).empty()) continue;
      removed(block, line.whole(), "", trim(line.text),
              "the line has no meaning in version " + number(block.version) + " and would get one");
      lines_.remove(line, out_.edits);
    }
  }

  /// True if the new block has a cell of that name in that round.
  static bool has_cell(const NewLineContext& context, std::string_view field, int round) {
    return std::any_of(context.lines->begin(), context.lines->end(), [&](const NewLine& l) {
      if (l.round != round) return false;
      const auto fields = context.layout.fields(*l.card, l.round);
      return std::any_of(fields.begin(), fields.end(), [&](const Field* f) {
        return canonical_name(f->name) == canonical_name(field);
      });
    });
  }

  // ---- one line -----------------------------------------------------------------------------

  /// Text of a line in the new layout.
  std::string text_of(const NewLineContext& context, const NewLine& line) const {
    const bool there = line.old != nullptr && !line.old->missing();
    if (line.card->repeat == Repeat::ids) return list_text(context, line);
    const auto fields = context.layout.fields(*line.card, line.round);
    if (there && line.old->free_format) return free_text(context, fields, *line.old);
    std::string text = there ? std::string(line.old->line.text) : std::string();
    std::vector<std::pair<const Field*, const Cell*>> targets;
    for (const Field* f : fields) {
      const Cell* source = there ? cell_of(*line.old, f->name) : nullptr;
      if (source != nullptr && source->field->first == f->first && source->field->last == f->last)
        continue;
      if (source == nullptr) source = context.layout.elsewhere(f->name, line.round, line.old);
      targets.emplace_back(f, source);
    }
    if (there) blank_cells(context, fields, line, text);
    if (there)
      for (const auto& [field, source] : targets) clear_stray(context, *field, *line.old, text);
    for (const auto& [field, source] : targets)
      if (source != nullptr) copy_cell_text(context, *field, *source, text);
    text.resize(text.find_last_not_of(' ') + 1);
    return text;
  }

  /// A line of a list: the cells in the columns of the new version.
  std::string list_text(const NewLineContext& context, const NewLine& line) const {
    if (line.old == nullptr || line.old->missing()) return {};
    const CardSchema& old = *line.old->schema;
    const Field& from = old.fields.back();
    const Field& to = line.card->fields.back();
    if (line.old->free_format || &old == line.card ||
        (from.first == to.first && from.last == to.last))
      return std::string(line.old->line.text);
    std::string text;
    Field column = to;
    for (const Cell& cell : line.old->cells) {
      copy_cell_text(context, column, cell, text);
      column.first += to.last - to.first + 1;
      column.last += to.last - to.first + 1;
    }
    return text;
  }

  /// Blanks old cells that the new line does not have in those columns.
  static void blank_cells(const NewLineContext& context, const std::vector<const Field*>& fields,
                          const NewLine& line, std::string& text) {
    for (const Cell& cell : line.old->cells) {
      const Field& f = *cell.field;
      const auto same = std::find_if(fields.begin(), fields.end(), [&](const Field* other) {
        return canonical_name(other->name) == canonical_name(f.name);
      });
      if (same != fields.end() && (*same)->first == f.first && (*same)->last == f.last) continue;
      if (cell.blank()) continue;
      CellWriter::put(text, f.first, f.last, "");
      if (context.findings != nullptr && same == fields.end() &&
          !has_cell(context, f.name, line.round))
        context.findings->report_lost(context.block, cell);
    }
  }

  /// Blanks text without meaning that would become a value.
  static void clear_stray(const NewLineContext& context, const Field& field, const DecodedCard& old,
                          std::string& text) {
    const Block& block = context.block;
    const std::string stray(cell_text(text, field.first, field.last));
    if (stray.empty() || (field.type != FieldType::text && is_zero_text(stray))) return;
    CellWriter::put(text, field.first, field.last, "");
    if (context.findings == nullptr) return;
    context.findings->removed(
        block, old.line.columns(field.first, field.last), field.name, stray,
        "it has no meaning in version " + number(block.version) + " and would get one");
  }

  void copy_cell_text(const NewLineContext& context, const Field& field, const Cell& cell,
                      std::string& text) const {
    if (cell.blank() || detail::copy_cell_text(cell, field, text) || context.findings == nullptr)
      return;
    context.findings->undecided(context.block, cell.span, field.name, cell.text,
                                "the value does not fit its " +
                                    number(field.last - field.first + 1) + " columns in version " +
                                    number(target_) + "; shorten it");
  }

  /// A line with commas and the same cells stays; else it gets fixed columns.
  std::string free_text(const NewLineContext& context, const std::vector<const Field*>& fields,
                        const DecodedCard& old) const {
    const bool same =
        std::equal(fields.begin(), fields.end(), old.cells.begin(), old.cells.end(),
                   [](const Field* f, const Cell& cell) {
                     return canonical_name(f->name) == canonical_name(cell.field->name) &&
                            f->first == cell.field->first;
                   });
    if (same) return std::string(old.line.text);
    std::string text;
    for (const Field* f : fields) {
      const Cell* source = cell_of(old, f->name);
      if (source == nullptr) source = context.layout.elsewhere(f->name, old.round, &old);
      if (source != nullptr) copy_cell_text(context, *f, *source, text);
    }
    if (context.findings != nullptr)
      for (const Cell& cell : old.cells)
        if (!has_cell(context, cell.field->name, old.round))
          context.findings->report_lost(context.block, cell);
    return text;
  }

  // ---- values without a cell ----------------------------------------------------------------

  /// Reports a value without a cell in the new version.
  void report_lost(const Block& block, const Cell& cell) {
    if (cell.blank()) return;
    const Field& field = *cell.field;
    if (field.ignored) {
      if (cell.integer != 0)
        removed(block, cell.span, field.name, cell.text, "the reference solver does not use it");
      return;
    }
    if (is_default(block, cell)) return;
    const std::string why = "version " + number(target_) + " has no cell for it";
    if (field.name == "Ists") {
      const std::string note = why +
                               ", and grnd_IDs would be read as a node group; set Ists to 0 and "
                               "name a node group first";
      report(Loss::undecided, block, cell.span, field.name, cell.text, note);
      refuse(cell.span, std::string(block.keyword) + " Ists: " + note);
      return;
    }
    report(Loss::dropped, block, cell.span, field.name, cell.text, why);
    if (!options_.allow_loss)
      refuse(cell.span, std::string(block.keyword) + "/" + number(block.id.value) + " " +
                            field.name + " = " + std::string(cell.text) + " would be lost: " + why);
  }

  /// True if the solver uses this value without the cell.
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
    // 0 is the default of its version
    return value == 0 ? default_at(block, field, block.version) == then : value == then;
  }

  double default_of(const Field& field) const {
    if (field.name == "Irem_i2" && c_.model().implicit) return 1;
    return field.default_value.value_or(0);
  }

  /// Value for a cell that is 0 or missing: the default card's, if it has the cell in this version,
  /// or the built-in value.
  double default_at(const Block& block, const Field& field, int version) const {
    const auto* given = given_default(*inter_of_.at(&block), field.name, version);
    return given != nullptr ? static_cast<double>(given->value) : default_of(field);
  }

  /// Value of the default card, if its layout of that version has the cell.
  const EffectiveInt* given_default(const InterBase& inter, const std::string& on_card,
                                    int version) const {
    const std::string field = on_card == "Idel2" ? "Idel" : on_card;  // name on the default card
    const DefaultInter* defaults = c_.interfaces().defaults_of(inter.type);
    const auto* given = defaults != nullptr ? defaults->find(field) : nullptr;
    if (given == nullptr) return nullptr;
    for (const Block& b : c_.deck().blocks)
      if (b.header_span == defaults->span)
        for (const CardSchema& card : b.schema->cards)
          for (const Field& f : card.fields)
            if (f.name == field && card.in_version(version) && f.in_version(version)) return given;
    return nullptr;
  }

  // ---- keywords of which not every column is known --------------------------------------------

  void report_unknown() {
    for (const auto& [key, unknown] : unknown_) {
      const Block& block = *unknown.first;
      const std::string blocks =
          unknown.count == 1 ? "its block means" : "its " + number(unknown.count) + " blocks mean";
      const std::string why =
          block.opaque ? "is encrypted" : "has columns that no schema describes in full";
      undecided(block, block.header_span, "", "",
                why + ": whether " + blocks + " the same in version " + number(target_) +
                    " as in version " + number(block.version) +
                    " is not known; compare the manuals of both versions and convert by hand");
    }
  }

  const LoadedDeck& c_;
  const int target_;
  const VersionOptions& options_;
  Rewrite out_;
  LineEdits lines_;
  std::unordered_map<const Block*, const InterBase*> inter_of_;
  std::map<std::pair<const Schema*, int>, bool> differs_;
  struct UnknownKeyword {
    const Block* first = nullptr;
    int count = 0;
  };
  std::map<std::pair<std::string, int>, UnknownKeyword> unknown_;  ///< by keyword and version
};

}  // namespace

bool is_target_version(int version) {
  return version >= oldest_target && is_known_version(version);
}

Rewrite to_version(const LoadedDeck& context, int version, const VersionOptions& options) {
  return VersionRewriter(context, version, options).run();
}

}  // namespace deck
