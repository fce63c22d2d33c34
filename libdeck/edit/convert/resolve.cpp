// Compares effective values with the cells of the card and writes those that differ.
#include "edit/shared/conversion.hpp"

#include <algorithm>
#include <map>

#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "edit/cells.hpp"

namespace deck {
namespace {

using detail::cell_text;
using detail::LineEdits;

std::string cell_for(std::int64_t v) { return std::to_string(v); }
std::string cell_for(const std::string& v) { return v; }
std::string cell_for(double v) {
  const auto text = format_real(v, 24);
  return text ? text->text : std::string();
}

bool is_zero(std::int64_t v) { return v == 0; }
bool is_zero(double v) { return v == 0; }
bool is_zero(const std::string& v) { return v.find('1') == std::string::npos; }

std::string_view source_of(Origin origin) {
  return origin == Origin::default_block ? "from /DEFAULT/INTER" : "built-in default";
}

/// Cells and texts for one interface.
class DefaultResolver {
 public:
  DefaultResolver(const LoadedDeck& context, const InterBase& inter, LineEdits& lines, Rewrite& out)
      : c_(context),
        inter_(inter),
        block_(*inter.block),
        decoded_(decode(context.deck(), *inter.block)),
        lines_(lines),
        out_(out) {}

  void run() {
    visit_any_interface(inter_, [&](const auto& t) {
      t.for_each([&](std::string_view name, const auto& e) { field(name, e); });
    });
    keep_meaning();
    write();
  }

 private:
  LossEntry& report(Loss loss, Span span, std::string_view field, std::string old_text,
                    std::string new_text, std::string note) {
    return out_.losses.emplace_back(loss_entry(
        c_.deck(), loss, block_, span,
        {std::string(field), std::move(old_text), std::move(new_text), std::move(note)}));
  }

  /// Cell of this version on a line that the block has or lacks at its end.
  const Field* field_of(std::string_view name) const {
    for (const DecodedCard& card : decoded_.cards)
      for (const Field& f : card.schema->fields)
        if (f.in_version(block_.version) && detail::canonical_name(f.name) == name) return &f;
    return nullptr;
  }
  const Cell* cell_of(const Field& field) const { return decoded_.find(field.name); }

  template <class T>
  void field(std::string_view name, const Effective<T>& e) {
    if (e.origin == Origin::derived || e.origin == Origin::geometry) {
      if (!e.has_input) note_derived(name, e.span, e.origin == Origin::geometry);
      return;
    }
    if (e.origin == Origin::card || is_zero(e.value)) return;
    const Field* f = field_of(name);
    const bool unread = inter_.type == 19 && name == "Iedge";
    if (f == nullptr || unread) {
      if (e.origin == Origin::default_block)
        report(Loss::undecided, {}, name, "", cell_for(e.value),
               unread ? "the card's Iedge is not read: the default card stays in force"
                      : "version " + std::to_string(block_.version) +
                            " has no cell for it: the default card stays in force; convert to a "
                            "newer version first");
      return;
    }
    const Cell* cell = cell_of(*f);
    if (inter_.type == 19 && name == "Igap" && e.origin == Origin::default_block &&
        cell_for(e.value) == "2") {
      report(Loss::undecided, {}, name, "", "2",
             "from the default card the solver stops at it (error 1181), on the interface it does "
             "not: write it there if it is meant");
      return;
    }
    if (cell != nullptr && cell->parameter) {
      report(Loss::undecided, cell->span, name, std::string(cell->text), cell_for(e.value),
             "the parameter is 0, so a default is at work; give it the value");
      return;
    }
    set(*f, e.value, std::string(source_of(e.origin)));
  }

  void note_derived(std::string_view name, Span span, bool mesh) {
    if (field_of(name) == nullptr) return;
    report(
        Loss::kept, span, name, "", "",
        mesh ? "left blank: it follows from the mesh" : "left blank: it follows from other values");
  }

  // ---- values -------------------------------------------------------------------------------

  void set(const Field& f, std::int64_t value, const std::string& note) {
    const auto text = format_integer(value, f.last - f.first + 1);
    if (!text) return;
    flags_[f.name] = value;
    put(f, *text, cell_for(value), Loss::kept, note);
  }
  // IBC has no default.
  void set(const Field&, const std::string&, const std::string&) {}
  void set(const Field& f, double value, const std::string& note) {
    const auto text = cell_text(value, factor(f, true), f.last - f.first + 1);
    if (!text) return;
    put(f, text->text, cell_for(value), text->exact ? Loss::kept : Loss::approximated, note);
  }

  void put(const Field& f, const std::string& text, const std::string& value, Loss loss,
           const std::string& note) {
    const Cell* cell = cell_of(f);
    texts_[&f] = text;
    LossEntry& entry =
        report(loss, cell != nullptr ? cell->span : Span{}, f.name,
               cell != nullptr ? std::string(cell->text) : std::string(), text, note);
    if (loss == Loss::approximated)
      entry.note += "; no text of the cell gives " + value + " in working units exactly";
  }

  std::int64_t flag(std::string_view name, bool after) const {
    if (after)
      if (const auto it = flags_.find(std::string(name)); it != flags_.end()) return it->second;
    return decoded_.integer(name);
  }

  /// Deck units to working units, with the present or the written flags.
  double factor(const Field& f, bool after) const {
    const UnitSystem* units = c_.deck().units_of(block_);
    if (units == nullptr) return 1;
    const auto all = [&](const std::vector<Condition>& when) {
      return std::all_of(when.begin(), when.end(),
                         [&](const Condition& c) { return c.accepts(flag(c.field, after)); });
    };
    Dimension dimension = f.dimension;
    for (const auto& [when, d] : f.dimension_when)
      if (all(when)) {
        dimension = d;
        break;
      }
    if (f.solver_dimension && all(f.solver_when)) dimension = *f.solver_dimension;
    return conversion_factor(*units, c_.deck().begin.working, dimension);
  }

  /// Values whose unit depends on a written flag.
  void keep_meaning() {
    for (const DecodedCard& card : decoded_.cards)
      for (const Cell& cell : card.cells) {
        const Field& f = *cell.field;
        if (f.type != FieldType::real || cell.real == 0) continue;
        if (f.dimension_when.empty() && f.solver_when.empty()) continue;
        if (texts_.count(&f) > 0) continue;
        const double before = factor(f, false), after = factor(f, true);
        if (before == after) continue;
        if (cell.parameter) {
          report(Loss::undecided, cell.span, f.name, std::string(cell.text), "",
                 "its unit changes with a flag that is now on the card, and it is a parameter");
          out_.refusals.push_back(c_.deck().sources.where(cell.span) + ": " + f.name +
                                  " is a parameter whose unit would change");
          continue;
        }
        const double value = cell.real * before;
        const auto text = cell_text(value, after, f.last - f.first + 1);
        if (text)
          put(f, text->text, cell_for(value), text->exact ? Loss::kept : Loss::approximated,
              "the same value in the unit that goes with the flags now on the card");
      }
  }

  // ---- lines --------------------------------------------------------------------------------

  void write() {
    if (texts_.empty()) return;
    Span anchor = decoded_.title_line.valid() ? decoded_.title_line.whole() : block_.header_span;
    std::vector<std::string> behind;  // lines behind the end of the block
    std::size_t needed = 0;
    for (const DecodedCard& card : decoded_.cards) {
      const auto changed = std::any_of(
          card.schema->fields.begin(), card.schema->fields.end(),
          [&](const Field& f) { return f.in_version(block_.version) && texts_.count(&f) > 0; });
      if (card.missing()) {
        behind.push_back(changed ? new_text(card) : std::string());
        if (changed) needed = behind.size();
        continue;
      }
      anchor = card.line.whole();
      if (changed) lines_.change(card.line, new_text(card), out_.edits);
    }
    behind.resize(needed);
    // The line behind a header without lines would become the title.
    if (needed > 0 && detail::lacks_title(decoded_)) lines_.insert_after(anchor, "");
    for (const std::string& text : behind) lines_.insert_after(anchor, text);
  }

  /// Line with the new texts; lines with commas and missing lines get fixed columns.
  std::string new_text(const DecodedCard& card) {
    const bool fixed = !card.missing() && !card.free_format;
    std::string text(fixed ? card.line.text : std::string_view());
    for (const Cell& cell : card.cells)
      if (!fixed && !detail::copy_cell_text(cell, *cell.field, text))
        out_.refusals.push_back(c_.deck().sources.where(cell.span) + ": " + cell.field->name +
                                " does not fit its columns; shorten it");
    for (const Field& f : card.schema->fields)
      if (const auto it = texts_.find(&f); it != texts_.end())
        CellWriter::put(text, f.first, f.last, it->second);
    return text;
  }

  const LoadedDeck& c_;
  const InterBase& inter_;
  const Block& block_;
  DecodedBlock decoded_;
  LineEdits& lines_;
  Rewrite& out_;
  std::map<const Field*, std::string> texts_;
  std::map<std::string, std::int64_t> flags_;  ///< written flags
};

}  // namespace

Rewrite resolve_defaults(const LoadedDeck& context, const ResolveOptions& options) {
  Rewrite out;
  LineEdits lines(context.deck().sources);
  for (const InterBase* inter : context.interfaces().all)
    DefaultResolver(context, *inter, lines, out).run();
  lines.append_to(out.edits);
  for (const LossEntry& e : out.losses)
    if (e.loss == Loss::undecided && !options.allow_loss)
      out.refusals.push_back(e.file + ":" + std::to_string(e.line) + ": " + e.keyword + "/" +
                             std::to_string(e.id) + " " + e.field + ": " + e.note);
  if (!out.refusals.empty()) out.edits.clear();
  return out;
}

}  // namespace deck
