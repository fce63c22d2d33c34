// Multiplies every cell of known dimension by its factor and lists what it could not decide.
// One class over 600 lines: what a block needs — its cells, counts, functions, notes — is decided
// cell by cell with the state of the block, which all its steps share.
#include "deck/edit/convert.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "deck/text/number.hpp"
#include "deck/text/rule_id.hpp"
#include "edit/convert/units/unit_system_state.hpp"
#include "edit/convert/version_cards.hpp"
#include "keyword/shared/implied_one.hpp"
#include "keyword/shared/line_check.hpp"
#include "keyword/shared/reader.hpp"
#include "model/shared/constant_stiffness.hpp"
#include "text/shared/edits.hpp"

namespace deck {

using detail::UnitConversion;
using detail::UnitFactor;

namespace detail {

void UnitConversion::undecided(const Block& block, Span place, std::string field, std::string why) {
  leave_undecided(out, deck, block, place, std::move(field), std::move(why), options.partial);
  if (options.partial) left.insert(&block);
}

UnitConversion::OpenShare::OpenShare(UnitConversion& c, const Block& block)
    : c_(c), block_(block), share_{c.out.edits.size(), 0, c.out.losses.size(), 0} {}

UnitConversion::OpenShare::~OpenShare() {
  share_.edits_end = c_.out.edits.size();
  share_.losses_end = c_.out.losses.size();
  if (share_.edits_end > share_.edits || share_.losses_end > share_.losses)
    c_.shares.emplace(&block_, share_);
}

UnitConversion::Place UnitConversion::place_of(const Block& block, const DecodedCard& card,
                                               const Cell& cell) {
  Place place{&block,           cell.span,       cell.field->name, card.line, cell.field->first,
              cell.field->last, card.free_format};
  // The cells of a list stand side by side; the field has the columns of the first.
  if (card.schema->repeat == Repeat::ids && !card.free_format) {
    const int shift = static_cast<int>(cell.span.offset - card.line.offset) + 1 - place.first;
    place.first += shift;
    place.last += shift;
  }
  return place;
}

bool UnitConversion::put(const Place& place, const std::string& text) {
  if (!place.free_format) {
    if (static_cast<int>(text.size()) > place.last - place.first + 1) return false;
    replace_fixed(place.line, place.first, place.last, text);
    return true;
  }
  if (place.line.text.size() + text.size() > line_columns + std::size_t{place.span.length})
    return false;
  out.edits.push_back({place.span, text});
  return true;
}

void UnitConversion::leave_blocks() {
  std::vector<bool> edit_goes(out.edits.size()), loss_goes(out.losses.size());
  for (const Block* block : left) {
    const auto [first, last] = shares.equal_range(block);
    for (auto share = first; share != last; ++share) {
      const Share& s = share->second;
      for (std::size_t i = s.edits; i < s.edits_end; ++i) edit_goes[i] = true;
      for (std::size_t i = s.losses; i < s.losses_end; ++i)
        loss_goes[i] = out.losses[i].loss != Loss::undecided;
    }
  }
  const auto keep = [](auto& list, const std::vector<bool>& goes) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!goes[i]) {
        if (to != i) list[to] = std::move(list[i]);
        ++to;
      }
    list.resize(to);
  };
  keep(out.edits, edit_goes);
  keep(out.losses, loss_goes);
}

void UnitConversion::changed(const Block& block, Span place, std::string_view field,
                             std::string_view before, const ScaledText& after, int width) {
  ++changed_cells;
  if (after.exact) return;
  LossEntry entry = loss_entry(deck, Loss::approximated, block, place);
  entry.field = std::string(field);
  entry.old_text = std::string(before);
  entry.new_text = after.text;
  entry.note = std::to_string(width) + " columns hold no more digits; converting back gives a " +
               "slightly different value";
  out.losses.push_back(std::move(entry));
}

void UnitConversion::replace_fixed(const Line& line, int first, int last, std::string_view text) {
  out.edits.push_back(CellWriter::edit_in_place(deck.sources, line.whole(), first, last, text));
}

void UnitConversion::convert_fixed(const Block& block, const Line& line, int first, int last,
                                   std::string_view field, const UnitFactor& factor) {
  const std::string_view token = trim(columns(line.text, first, last));
  if (token.empty() || factor.one()) return;
  const Span place = line.columns(first, last);
  const RealCell value = read_real(token);
  if (value.status == NumberStatus::ok && value.value == 0) return;
  const int width = last - first + 1;
  const auto text = scale_text(token, width, factor);
  if (!text) {
    undecided(block, place, std::string(field),
              value.status == NumberStatus::ok || value.status == NumberStatus::implicit_exponent
                  ? "the converted value does not fit its columns"
                  : "'" + std::string(token) + "' is not a plain number");
    return;
  }
  replace_fixed(line, first, last, text->text);
  changed(block, place, field, token, *text, width);
}

void UnitConversion::convert_free(const Block& block, const Line& line, Span cell,
                                  std::string_view field, const UnitFactor& factor) {
  const std::string_view token = deck.sources.text(cell);
  if (token.empty() || factor.one() || read_real(token).value == 0) return;
  const auto key = (std::uint64_t{line.file} << 40) ^ line.offset;
  int& spare = spare_
                   .try_emplace(key, line_columns - static_cast<int>(std::min<std::size_t>(
                                                        line.text.size(), line_columns)))
                   .first->second;
  constexpr int enough = 24;  // every double fits
  const int width = std::min(enough, static_cast<int>(token.size()) + spare);
  const auto text = scale_text(token, width, factor);
  if (!text) {
    undecided(block, cell, std::string(field),
              "the converted value makes this free-format line longer than 100 columns, or '" +
                  std::string(token.substr(0, 30)) + "' is not a plain number");
    return;
  }
  spare -= static_cast<int>(text->text.size()) - static_cast<int>(token.size());
  out.edits.push_back({cell, text->text});
  changed(block, cell, field, token, *text, width);
}

void UnitConversion::note_dimension(const Dimension& d, const UnitFactor& factor) {
  std::string name;
  const auto add = [&](const char* base, int exponent) {
    if (exponent == 0) return;
    name += (name.empty() ? "" : " ") + std::string(base);
    if (exponent != 1) name += "^" + std::to_string(exponent);
  };
  add("mass", d.mass);
  add("length", d.length);
  add("time", d.time);
  if (used_factors.contains(name)) return;
  const auto value = format_real(static_cast<double>(factor.value), 24);
  used_factors[name] = factor.power ? "1e" + std::to_string(*factor.power)
                                    : (value ? value->text : std::string("?"));
}

std::vector<std::string> unread_files(const Deck& deck) {
  std::vector<std::string> refusals;
  for (const Diagnostic& d : deck.diagnostics.all())
    if (d.rule == RuleId::DK004 || d.rule == RuleId::DK005 || d.rule == RuleId::DK006)
      refusals.push_back((d.span.valid() ? deck.sources.where(d.span) : deck.sources[0].path()) +
                         ": " + d.message);
  return refusals;
}

std::vector<std::string> contradicting_copies(const SourceSet& sources,
                                              const std::vector<TextEdit>& edits) {
  std::map<std::string, std::vector<std::uint32_t>> files;
  for (std::uint32_t f = 0; f < sources.size(); ++f) files[sources[f].path()].push_back(f);
  std::map<std::uint32_t, std::map<std::pair<std::uint64_t, std::uint32_t>, std::string>> by_file;
  for (const auto& [path, copies] : files)
    if (copies.size() > 1)
      for (const std::uint32_t f : copies) by_file[f];
  std::vector<std::string> refusals;
  if (by_file.empty()) return refusals;
  for (const TextEdit& e : edits)
    if (const auto it = by_file.find(e.span.file); it != by_file.end())
      it->second[{e.span.offset, e.span.length}] = e.text;
  for (const auto& [path, copies] : files)
    for (std::size_t i = 1; i < copies.size(); ++i)
      if (by_file[copies[i]] != by_file[copies[0]]) {
        refusals.push_back(path +
                           ":1:1: included more than once and would have to become two different "
                           "files; give the second include a file of its own, or flatten the deck "
                           "first");
        break;
      }
  return refusals;
}

}  // namespace detail

namespace {

/// Keywords described in part whose undescribed text holds ids, flags and names only.
bool free_of_units(std::string_view keyword) {
  constexpr std::string_view list[] = {
      "/ANALY",       "/DEF_SHELL", "/DEF_SOLID",   "/IOFLAG",    "/MEMORY", "/SPMD",
      "/BCS",         "/TH",        "/ATH",         "/BTH",       "/CTH",    "/DTH",
      "/RBE2",        "/SHFRA",     "/CAA",         "/REFSTA",    "/UPWIND", "/ALE/GRID/ZERO",
      "/RLINK",       "/ALE/BCS",   "/DUMMY_START", "/DUMMY_END", "/AMS",    "/TABLE",
      "/FUNCT_PYTHON"};
  for (const std::string_view k : list)
    if (keyword == k || (keyword.starts_with(k) && keyword[k.size()] == '/')) return true;
  return false;
}

/// Blocks that name units or parameters, or hold no values; treated elsewhere or not at all.
bool outside_conversion(const Block& b) {
  return b.schema->kind == "engine" || b.schema->kind == "parameter" || b.header == "/BEGIN" ||
         b.header.starts_with("/BEGIN/") || b.header.starts_with("//") ||
         b.header.starts_with("/UNIT") || b.header.starts_with("/TITLE") ||
         free_of_units(b.keyword) || free_of_units(b.header);
}

bool has_dimension(const Field& f) {
  Dimension d = f.dimension;
  d.temperature = 0;  // temperatures have no unit in a deck
  return !d.dimensionless() || !f.dimension_when.empty();
}

bool worth_decoding(const Schema& s) {
  if (s.opaque_tail) return true;
  for (const CardSchema& card : s.cards)
    for (const Field& f : card.fields)
      if (has_dimension(f) || !f.dimension_known || !f.unit_for.empty() || f.ref == "funct" ||
          f.ref == "table")
        return true;
  return false;
}

class BlockConverter {
 public:
  explicit BlockConverter(UnitConversion& c) : c_(c), deck_(c.deck) {}

  void convert(const Block& b) {
    const UnitConversion::OpenShare share(c_, b);
    const auto before = c_.out.edits.size();
    convert_block(b);
    for (TextEdit& e : grown_.finish()) c_.out.edits.push_back(std::move(e));
    if (const auto values = c_.out.edits.size() - before; values > 0) {
      LossEntry entry = loss_entry(deck_, Loss::kept, b, b.header_span);
      entry.note = std::to_string(values) + (values == 1 ? " value" : " values") + " converted";
      c_.out.losses.push_back(std::move(entry));
    }
  }

 private:
  void convert_block(const Block& b) {
    const UnitSystem* units = deck_.units_of(b);
    own_units_ = units != &deck_.begin.input;
    if (b.schema == nullptr) {
      if (!own_units_ || units == nullptr)
        c_.undecided(b, {}, "", "deck does not know this keyword, so it cannot convert its values");
      return;
    }
    if (outside_conversion(b)) return;
    if (units == nullptr) {
      c_.undecided(b, b.unit_id.span, "", "its unit id is not defined");
      return;
    }
    if (own_units_) ++c_.own_unit_blocks;
    if (own_units_ && !c_.working_changes) return;
    if (b.opaque) {
      if (!own_units_) c_.undecided(b, {}, "", "the block is encrypted");
      return;
    }
    // Values that the solver takes in working units, in the units of this block from now on.
    from_working_ = detail::UnitFactors(deck_.begin.working, own_units_ ? *units : c_.target);
    if (b.header.starts_with("/CNODE/") && !own_units_) tolerance(b);
    if (b.schema->kind == "set") {
      if (!own_units_) set_clauses(b);
      return;
    }
    if (!worth_decoding(*b.schema)) return;
    if (const CardSchema* rows = plain_rows(b); rows != nullptr)
      convert_rows(b, *rows);
    else
      convert_cards(b);
  }

  /// The one repeated card of a block without conditions; nullptr: the block is another one.
  static const CardSchema* plain_rows(const Block& b) {
    const CardSchema* only = nullptr;
    for (const CardSchema& card : b.schema->cards) {
      if (!card.in_version(b.version)) continue;
      if (only != nullptr || card.repeat != Repeat::rows || !card.when.empty()) return nullptr;
      only = &card;
    }
    if (only == nullptr || b.schema->opaque_tail || b.schema->has_title) return nullptr;
    for (const Field& f : only->fields)
      if (!f.dimension_when.empty() || !f.dimension_known || f.ref == "funct" ||
          detail::ordinary_default(f))
        return nullptr;
    return only;
  }

  /// Nodes and elements: many lines, few kinds of cells.
  void convert_rows(const Block& b, const CardSchema& card) {
    struct Column {
      const Field* field;
      UnitFactor factor;
    };
    if (own_units_) return;
    std::vector<Column> columns;
    for (const Field& f : card.fields) {
      if (f.type != FieldType::real || !f.in_version(b.version) || !has_dimension(f)) continue;
      const UnitFactor factor = c_.factors.of(f.dimension);
      if (factor.one()) continue;
      c_.note_dimension(f.dimension, factor);
      columns.push_back({&f, factor});
    }
    if (columns.empty()) return;
    LineCursor cursor(deck_.sources, b);
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      const std::string_view text = line.text.substr(0, detail::line_columns);
      if (text.find(',') != std::string_view::npos || text.find('&') != std::string_view::npos) {
        DecodedBlock none;
        none.block = &b;
        convert_card(b, none, decode_line(deck_, b, card, line, nullptr));
        continue;
      }
      for (const Column& column : columns)
        c_.convert_fixed(b, line, column.field->first, column.field->last, column.field->name,
                         column.factor);
    }
  }

  void convert_cards(const Block& b) {
    const DecodedBlock d = decode(deck_, b);
    brought_.clear();
    absent_.clear();
    for (const DecodedCard& card : d.cards) {
      if (card.missing()) continue;
      for (const Cell& cell : card.cells) function_use(b, d, card, cell);
      for (const Cell& cell : card.cells)
        if (detail::measures(d, card, cell)) brought_.insert(&cell);
    }
    for (const DecodedCard& card : d.cards)
      if (!card.missing()) convert_card(b, d, card);
    add_lines(b, d);
    if (!own_units_ && !b.schema->layout_known()) undescribed(b, d);
  }

  /// Blank scales on lines that the block leaves away at its end are written out, too.
  void add_lines(const Block& b, const DecodedBlock& d) {
    std::map<const CardSchema*, std::string> texts;
    for (const std::string& name : absent_)
      for (const CardSchema& card : b.schema->cards)
        for (const Field& f : card.fields) {
          if (f.name != name || !card.in_version(b.version) || !f.in_version(b.version)) continue;
          if (!holds(card.when, d) || !holds(f.when, d)) continue;
          const UnitFactor factor = c_.factors.of(written_dimension(
              f, dimension_of(f, d), f.solver_dimension && holds(f.solver_when, d)));
          if (factor.one()) continue;
          const auto text = detail::scale_text("1.0", f.last - f.first + 1, factor);
          if (!text) {
            c_.undecided(b, {}, name, "blank means 1, which does not fit in the new units");
            continue;
          }
          CellWriter::put(texts[&card], f.first, f.last, text->text);
          LossEntry entry = loss_entry(deck_, Loss::kept, b, b.header_span);
          entry.field = name;
          entry.new_text = text->text;
          entry.note = "its line was missing; blank is 1 in the units of the block, which change";
          c_.out.losses.push_back(std::move(entry));
        }
    if (texts.empty()) return;
    const CardSchema* next = b.schema->cards.data();
    Span anchor = d.title_line.valid() ? d.title_line.whole() : b.header_span;
    for (const DecodedCard& card : d.cards)
      if (!card.missing()) {
        next = card.schema + 1;
        anchor = card.line.whole();
      }
    std::vector<std::string> lines;
    std::size_t added = 0;
    const CardSchema* const end = b.schema->cards.data() + b.schema->cards.size();
    for (; next != end && added < texts.size(); ++next) {
      if (!next->in_version(b.version) || !holds(next->when, d)) continue;
      if (next->repeat != Repeat::once) break;
      const auto text = texts.find(next);
      added += text == texts.end() ? 0 : 1;
      lines.push_back(text == texts.end() ? std::string() : text->second);
    }
    if (added < texts.size() || !d.extra.empty() || detail::lacks_title(d)) {
      c_.undecided(b, {}, *absent_.begin(), "this scale has no line in the block; add the line");
      return;
    }
    detail::LineEdits edits(deck_.sources);
    for (const std::string& line : lines) edits.insert_after(anchor, line);
    edits.finish(c_.out.edits);
  }

  // ---- functions ------------------------------------------------------------------------------

  /// Which cells scale the axes of the function that `cell` names, and what its points are.
  void function_use(const Block& b, const DecodedBlock& d, const DecodedCard& card,
                    const Cell& cell) {
    const Field& f = *cell.field;
    if (f.axes.empty() || (cell.integer == 0 && !cell.parameter)) return;
    UnitConversion::FunctionUse use{
        UnitConversion::place_of(b, card, cell), std::abs(cell.integer), {}};
    for (const Axis& axis : f.axes) {
      bool scaled = axis.scales.empty();
      for (const std::string& name : axis.scales) {
        if (keeps_number(d, name)) {
          scaled = scaled || name[0] != 'A';
          continue;
        }
        const detail::AxisScale scale = detail::axis_scale(d, card, cell, name);
        if (scale.cell != nullptr) brought_.insert(scale.cell);
        if (scale.absent) absent_.insert(name);
        scaled = scaled || scale.counts();
      }
      Dimension points;
      if (axis.scales.empty()) {
        points = axis.dimension;
        for (const auto& [when, dimension] : axis.dimension_when)
          if (holds(when, d, &card)) {
            points = dimension;
            break;
          }
      } else if (!scaled) {
        // This version has no cell for the scale: it is 1, and the points have its dimension; or
        // the scale has to keep its number.
        const Field* scale = b.schema->find_field(axis.scales.front());
        if (scale != nullptr) points = dimension_of(*scale, d, &card);
      }
      points.temperature = 0;
      use.points.push_back(points);
    }
    c_.function_uses.push_back(std::move(use));
  }

  /// The solver divides K of a spring by its coefficient A where the spring counts in contacts, and
  /// the force is f(x) (A + B ln(v / D) + E g(v / F)): only if A, B and E keep their numbers and
  /// the points of f take the unit of force do both stay what they are. True for such a
  /// coefficient; where K is no stiffness or f has no points it is converted as any other scale.
  bool keeps_number(const DecodedBlock& d, const std::string& name) const {
    if (!c_.working_changes || own_units_ || name.empty() || name.size() > 2 ||
        std::string_view("ABE").find(name[0]) == std::string_view::npos || d.block == nullptr ||
        d.block->schema->kind != "prop")
      return false;
    const std::string row = name.size() == 1 ? "1" : name.substr(1);
    const Cell* k = d.find("K") != nullptr ? d.find("K") : d.find("K" + row);
    if (k == nullptr || (k->real == 0 && !k->parameter)) return false;
    const Cell* a = d.find(d.find("A") != nullptr ? "A" : "A" + row);
    constexpr int residual = 5;  // the second function gives elongations, which A does not scale
    return a != nullptr && !a->parameter && k->field->dimension == Dimension{1, 0, -2, 0} &&
           d.integer("Ileng") == 0 && d.integer("H" + row) != residual &&
           d.integer("fct_ID1" + row) != 0 && has_points(d, "fct_ID1" + row) &&
           has_points(d, "fct_ID3" + row);
  }

  /// The cell names no function, or one that is given point by point.
  bool has_points(const DecodedBlock& d, const std::string& name) const {
    const Cell* cell = d.find(name);
    if (cell == nullptr || (cell->integer == 0 && !cell->parameter)) return true;
    const std::int64_t id = std::abs(cell->integer) + deck_.offset_of(*d.block, "funct");
    return std::any_of(deck_.blocks.begin(), deck_.blocks.end(), [&](const Block& b) {
      return b.schema != nullptr && b.schema->keyword == "/FUNCT" &&
             b.id.value + deck_.offset_of(b, "funct") == id;
    });
  }

  // ---- cells ----------------------------------------------------------------------------------

  void convert_card(const Block& b, const DecodedBlock& d, const DecodedCard& card) {
    for (const Cell& cell : card.cells) {
      const Field& f = *cell.field;
      if (f.type == FieldType::id && f.axes.empty() && (cell.integer != 0 || cell.parameter)) {
        if (c_.working_changes && f.ref == "funct")
          c_.undecided(b, cell.span, f.name,
                       "the function's values are in working units, which change");
        else if (!f.dimension_known && !own_units_)
          c_.undecided(b, cell.span, f.name,
                       "the units of the axes of this function are not known");
        else if (f.ref == "funct")
          c_.function_uses.push_back(
              {UnitConversion::place_of(b, card, cell), std::abs(cell.integer), {}});
      }
      if (f.type != FieldType::real) continue;
      const bool zero = cell.blank() || (cell.status == NumberStatus::ok && cell.real == 0);
      const bool brought = brought_.contains(&cell);
      if (!f.dimension_known) {
        if (!own_units_ && (!zero || cell.parameter || brought))
          c_.undecided(b, cell.span, f.name, "the dimension of this value is not known");
        continue;
      }
      if (keeps_number(d, f.name)) continue;
      const std::optional<Dimension> stfac = stfac_dimension(d, cell);
      const bool working = stfac && !(*stfac == Dimension{});
      const Dimension dimension = stfac ? *stfac : effective_dimension(d, card, cell);
      if (zero && !cell.parameter) {
        if (brought && own_units_ && f.solver_dimension && !f.solver_dimension->dimensionless())
          c_.undecided(b, cell.span, f.name,
                       "blank means 1 in working units here, while the block has units of its own; "
                       "write the number");
        else if (brought)
          write_one(b, card, cell, dimension);
        else if (c_.working_changes)
          write_default(b, card, cell, dimension_of(f, d, &card));
      } else if (!own_units_ || working || f.solver_dimension) {
        convert_cell(b, card, cell, dimension);
      }
    }
  }

  /// The power of the units with which the number itself changes. The solver brings a number from
  /// the units of its block to working units by S, while it means a quantity of dimension P: with
  /// new working units the number that arrives must change by P.
  Dimension effective_dimension(const DecodedBlock& d, const DecodedCard& card,
                                const Cell& cell) const {
    const Field& f = *cell.field;
    Dimension physical = dimension_of(f, d, &card);
    if (!f.over.empty() && holds(f.over_when, d, &card)) {
      // The number counts times that of the scale: where the scale's number changes, it does not.
      const Cell* scale = detail::cell_beside(d, card, cell, f.over);
      if (scale != nullptr &&
          (brought_.contains(scale) || scale->parameter || (!scale->blank() && scale->real != 0)))
        physical = minus(physical, dimension_of(*scale->field, d, &card));
    }
    return written_dimension(f, physical, f.solver_dimension && holds(f.solver_when, d, &card));
  }

  Dimension written_dimension(const Field& f, const Dimension& physical, bool by_solver) const {
    const Dimension solver = by_solver ? *f.solver_dimension : physical;
    if (own_units_) return minus(physical, solver);
    return c_.working_changes ? physical : solver;
  }

  static Dimension minus(Dimension a, const Dimension& b) {
    a.mass = static_cast<std::int8_t>(a.mass - b.mass);
    a.length = static_cast<std::int8_t>(a.length - b.length);
    a.time = static_cast<std::int8_t>(a.time - b.time);
    a.temperature = static_cast<std::int8_t>(a.temperature - b.temperature);
    return a;
  }

  void convert_cell(const Block& b, const DecodedCard& card, const Cell& cell,
                    const Dimension& dimension) {
    const Field& f = *cell.field;
    const UnitFactor factor = c_.factors.of(dimension);
    if (factor.one()) return;
    c_.note_dimension(dimension, factor);
    const UnitConversion::Place place = UnitConversion::place_of(b, card, cell);
    if (cell.parameter) {
      std::string_view name = cell.text;
      name.remove_prefix(name.starts_with('-') ? 2 : 1);
      c_.parameter_uses[std::string(name)].push_back({place, dimension, cell.real});
    } else if (card.free_format) {
      c_.convert_free(b, card.line, cell.span, f.name, factor);
    } else {
      c_.convert_fixed(b, card.line, place.first, place.last, f.name, factor);
    }
  }

  /// The power of the units with which the number of Stfac changes, in an interface whose effective
  /// Istf says whether it is a stiffness. The solver brings it from the units of the block to
  /// working units where the card itself has Istf 1, and takes it as it is elsewhere.
  std::optional<Dimension> stfac_dimension(const DecodedBlock& d, const Cell& cell) const {
    if (cell.field->name != "Stfac" || cell.real == 0) return std::nullopt;
    for (const InterBase* inter : c_.context.interfaces().ordered)
      if (inter->block == d.block) {
        const Dimension stiffness = detail::stiffness_dimension;
        const Dimension physical = detail::constant_stiffness(*inter) ? stiffness : Dimension{};
        const Dimension solver = d.integer("Istf") == 1 ? stiffness : Dimension{};
        if (own_units_) return minus(physical, solver);
        return c_.working_changes ? physical : solver;
      }
    return std::nullopt;
  }

  /// A blank scale is 1 in the units of the block: written out when these change.
  void write_one(const Block& b, const DecodedCard& card, const Cell& cell,
                 const Dimension& dimension) {
    const Field& f = *cell.field;
    const UnitFactor factor = c_.factors.of(dimension);
    if (factor.one()) return;
    const auto text = detail::scale_text("1.0", f.last - f.first + 1, factor);
    if (!text) {
      c_.undecided(b, cell.span, f.name, "blank means 1, which does not fit in the new units");
      return;
    }
    c_.note_dimension(dimension, factor);
    write_out(b, card, cell, text->text,
              "blank is 1 in the units of the block, which change; it was written out");
  }

  /// 0 and blank mean a number in working units: written out when these change.
  void write_default(const Block& b, const DecodedCard& card, const Cell& cell,
                     const Dimension& dimension) {
    const Field& f = *cell.field;
    const auto value = detail::ordinary_default(f);
    const UnitFactor factor = from_working_.of(dimension);
    if (!value || factor.one()) return;
    const bool whole = f.default_text.find_first_of(".eE") == std::string::npos;
    const auto text =
        detail::scale_text(f.default_text + (whole ? ".0" : ""), f.last - f.first + 1, factor);
    if (!text) {
      c_.undecided(b, cell.span, f.name,
                   "blank means " + f.default_text + " in working units, which change");
      return;
    }
    write_out(b, card, cell, text->text,
              "the default " + f.default_text + " is in working units and was written out");
  }

  /// Puts `text` into a cell that was 0 or blank.
  void write_out(const Block& b, const DecodedCard& card, const Cell& cell, const std::string& text,
                 std::string note) {
    const Field& f = *cell.field;
    const Line& line = card.line;
    const UnitConversion::Place place = UnitConversion::place_of(b, card, cell);
    if (card.free_format) {
      const bool there = cell.span.offset + cell.span.length <= line.offset + line.text.size();
      if (!there || line.text.size() + text.size() > detail::line_columns) {
        c_.undecided(b, cell.span, f.name,
                     "blank means a number that has to be written out, and this free-format line "
                     "has no room for it");
        return;
      }
      c_.out.edits.push_back({cell.span, text});
    } else if (static_cast<int>(line.text.size()) >= place.first) {
      c_.replace_fixed(line, place.first, place.last, text);
    } else {
      grown_.set(line.whole(), place.first, place.last, text);
    }
    LossEntry entry = loss_entry(deck_, Loss::kept, b, cell.span);
    entry.field = f.name;
    entry.old_text = std::string(cell.text);
    entry.new_text = text;
    entry.note = std::move(note);
    c_.out.losses.push_back(std::move(entry));
  }

  // ---- text that no schema describes ----------------------------------------------------------

  void undescribed(const Block& b, const DecodedBlock& d) {
    for (const DecodedCard& card : d.cards) {
      if (card.missing() || card.free_format) continue;
      std::bitset<detail::line_columns + 1> known;
      for (const Field& f : card.schema->fields)
        if (f.in_version(b.version))
          for (int c = f.first; c <= std::min(f.last, detail::line_columns); ++c)
            known.set(static_cast<std::size_t>(c));
      if (undescribed_text(b, card.line, known)) return;
    }
    for (const Line& line : d.extra)
      if (undescribed_text(b, line, {})) return;
  }

  /// One finding a block is enough. Zeros are zero in any unit.
  bool undescribed_text(const Block& b, const Line& line,
                        const std::bitset<detail::line_columns + 1>& known) {
    const std::string_view text = line.text.substr(0, detail::line_columns);
    const auto hidden = [&](std::size_t i) {
      return known.test(i + 1) || static_cast<unsigned char>(text[i]) <= ' ' || text[i] == ',';
    };
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (hidden(at)) continue;
      const std::size_t begin = at;
      while (at < text.size() && !hidden(at)) ++at;
      const RealCell value = read_real(text.substr(begin, at - begin));
      if (value.status == NumberStatus::ok && value.value == 0) continue;
      c_.undecided(b, line.columns(static_cast<int>(begin) + 1, static_cast<int>(at)), "",
                   "the keyword is described in part only; the dimension of this value is not "
                   "known");
      return true;
    }
    return false;
  }

  // ---- what no schema cell holds --------------------------------------------------------------

  /// /CNODE/tolerance: a length in the header.
  void tolerance(const Block& b) {
    Dimension length;
    length.length = 1;
    const UnitFactor factor = c_.factors.of(length);
    const std::string_view text = detail::trim(b.header.substr(7));
    if (text.empty() || factor.one() || read_real(text).value == 0) return;
    const auto offset = static_cast<std::uint64_t>(text.data() - b.header.data());
    const Span place{b.header_span.file, static_cast<std::uint32_t>(text.size()),
                     b.header_span.offset + offset};
    const auto scaled = detail::scale_text(text, 24, factor);
    if (!scaled) {
      c_.undecided(b, place, "tolerance", "'" + std::string(text) + "' is not a plain number");
      return;
    }
    c_.out.edits.push_back({place, scaled->text});
    ++c_.changed_cells;
  }

  /// PLANE and ELLIPS clauses of a set hold lengths on two lines.
  void set_clauses(const Block& b) {
    Dimension length;
    length.length = 1;
    const UnitFactor factor = c_.factors.of(length);
    LineCursor cursor(deck_.sources, b);
    cursor.next();  // title
    for (Line line = cursor.next(); line.valid(); line = cursor.next()) {
      const std::string_view clause = detail::trim(detail::columns(line.text, 1, 10));
      if (!clause.starts_with("PLANE") && !clause.starts_with("ELLIPS")) continue;
      c_.note_dimension(length, factor);
      for (int row = 0; row < 2 && line.valid(); ++row) {
        if (row > 0) line = cursor.next();
        if (!line.valid()) return;
        if (line.text.find(',') != std::string_view::npos ||
            line.text.find('&') != std::string_view::npos) {
          c_.undecided(b, line.whole(), std::string(clause),
                       "coordinates in free format or by parameters are not converted");
          continue;
        }
        for (int cell = 0; cell < 3; ++cell)
          c_.convert_fixed(b, line, 11 + 20 * cell, 30 + 20 * cell, clause, factor);
      }
    }
  }

  UnitConversion& c_;
  const Deck& deck_;
  bool own_units_ = false;
  detail::UnitFactors from_working_{{}, {}};
  CellWriter grown_{deck_.sources};  // cells behind the end of their line
  std::set<const Cell*> brought_;    // of this block: blank is 1 and has to be said
  std::set<std::string> absent_;     // the same, where the block has no line for the cell
};

void add_notes(UnitConversion& c) {
  const auto text = [](const UnitFactor& f) {
    const auto value = format_real(static_cast<double>(f.value), 24);
    return f.power ? "1e" + std::to_string(*f.power) : (value ? value->text : std::string("?"));
  };
  const auto code = [](const std::string& name, double factor) {
    const auto value = format_real(factor, 24);
    return !name.empty() ? name : value ? value->text : std::string("?");
  };
  const UnitSystem &from = c.deck.begin.input, &to = c.target;
  auto& notes = c.out.notes;
  notes.push_back("mass " + code(from.mass_code, from.mass) + " -> " + code(to.mass_code, to.mass) +
                  ": factor " + text(c.factors.mass()));
  notes.push_back("length " + code(from.length_code, from.length) + " -> " +
                  code(to.length_code, to.length) + ": factor " + text(c.factors.length()));
  notes.push_back("time " + code(from.time_code, from.time) + " -> " + code(to.time_code, to.time) +
                  ": factor " + text(c.factors.time()));
  for (const auto& [dimension, factor] : c.used_factors)
    if (dimension != "mass" && dimension != "length" && dimension != "time")
      notes.push_back(dimension + ": factor " + factor);
  notes.push_back(std::to_string(c.changed_cells) + " values converted");
  if (c.own_unit_blocks > 0)
    notes.push_back(std::to_string(c.own_unit_blocks) +
                    " blocks have units of their own and keep their values");
  if (c.working_changes)
    notes.push_back(
        "the working units change with the input units: the times of Engine files and all results "
        "are in the new units");
  else
    notes.push_back("the working units stay: results and Engine files keep their units");
}

}  // namespace

Result<UnitSystem> parse_unit_system(std::string_view text) {
  UnitSystem units;
  double* const factors[3] = {&units.mass, &units.length, &units.time};
  std::string* const codes[3] = {&units.mass_code, &units.length_code, &units.time_code};
  constexpr char bases[3] = {'g', 'm', 's'};
  constexpr const char* names[3] = {"mass", "length", "time"};
  for (int i = 0; i < 3; ++i) {
    const auto comma = i < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos)
      return Error{Error::Code::config, "expected mass,length,time, for example kg,mm,ms"};
    const std::string_view code = detail::trim(text.substr(0, comma));
    const auto factor = unit_factor(code, bases[i]);
    if (!factor || code.size() > 20)
      return Error{Error::Code::config, "'" + std::string(code.substr(0, 40)) + "' is not a " +
                                            names[i] + " unit; expected a prefix and '" + bases[i] +
                                            "', or a positive number"};
    *factors[i] = *factor;
    *codes[i] = std::string(code);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return units;
}

Rewrite to_units(const LoadedDeck& context, const UnitSystem& target, const UnitsOptions& options) {
  UnitConversion c(context, target, options);
  c.out.refusals = detail::unread_files(context.deck());
  if (!c.out.refusals.empty()) return std::move(c.out);
  if (!detail::convert_begin(c)) return std::move(c.out);
  if (context.deck().begin.input == target && !c.working_changes) {
    c.out.edits.clear();
    c.out.notes.push_back("the deck is in these units already");
    return std::move(c.out);
  }
  BlockConverter blocks(c);
  for (const Block& b : context.deck().blocks) blocks.convert(b);
  detail::convert_functions(c);
  detail::convert_parameters(c);
  c.leave_blocks();
  for (std::string& why : detail::contradicting_copies(context.deck().sources, c.out.edits))
    c.out.refusals.push_back(std::move(why));
  add_notes(c);
  if (!c.out.refusals.empty()) c.out.edits.clear();
  return std::move(c.out);
}

}  // namespace deck
