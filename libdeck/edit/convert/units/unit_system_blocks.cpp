// Multiplies every cell of known dimension by its factor, block by block.
#include <algorithm>
#include <optional>

#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "edit/convert/units/unit_system.hpp"
#include "keyword/shared/decode_parts.hpp"
#include "keyword/shared/line_check.hpp"
#include "keyword/shared/reader.hpp"
#include "model/shared/constant_stiffness.hpp"
#include "text/shared/edits.hpp"

namespace deck {

using detail::UnitConversion;
using detail::UnitFactor;

namespace {

/// Partly described keywords whose other text has ids, flags and names only.
bool free_of_units(std::string_view keyword) {
  constexpr std::string_view list[] = {
      "/ANALY",       "/DEF_SHELL", "/DEF_SOLID",   "/IOFLAG",    "/MEMORY", "/SPMD",
      "/BCS",         "/TH",        "/ATH",         "/BTH",       "/CTH",    "/DTH",
      "/RBE2",        "/SHFRA",     "/CAA",         "/REFSTA",    "/UPWIND", "/ALE/GRID/ZERO",
      "/RLINK",       "/ALE/BCS",   "/DUMMY_START", "/DUMMY_END", "/AMS",    "/TABLE",
      "/FUNCT_PYTHON"};
  return std::any_of(std::begin(list), std::end(list),
                     [&](std::string_view k) { return detail::is_below(keyword, k); });
}

/// Blocks that define units or parameters, or have no values.
bool outside_conversion(const Block& b) {
  return b.schema->kind == "engine" || b.schema->kind == "parameter" ||
         detail::is_below(b.header, "/BEGIN") || b.header.starts_with("//") ||
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
    for (TextEdit& e : grown_.release_edits()) c_.out.edits.push_back(std::move(e));
    if (const auto values = c_.out.edits.size() - before; values > 0)
      c_.out.losses.push_back(
          loss_entry(deck_, Loss::kept, b, b.header_span,
                     {.note = count(values, "value", "values") + " converted"}));
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
    // Numbers that the solver takes in working units, in the present units of this block.
    from_working_ = detail::UnitFactors(deck_.begin.working, own_units_ ? *units : c_.target);
    if (b.header.starts_with("/CNODE/") && !own_units_) tolerance(b);
    if (b.schema->kind == "set") {
      if (!own_units_) set_clauses(b);
      return;
    }
    if (!worth_decoding(*b.schema)) return;
    if (b.schema->bulk)
      convert_items(b);
    else
      convert_cards(b);
  }

  /// Nodes and elements line by line: there are many.
  void convert_items(const Block& b) {
    ones_ = {};
    DecodedBlock none;
    none.block = &b;
    for (detail::ItemLines lines(deck_, b); lines.next_line();)
      convert_card(b, none, lines.decoded(lines.row()));
  }

  void convert_cards(const Block& b) {
    const DecodedBlock d = decode(deck_, b);
    ones_ = detail::implied_ones(d);
    for (const DecodedCard& card : d.cards)
      if (!card.missing())
        for (const Cell& cell : card.cells) function_use(b, d, card, cell);
    for (const DecodedCard& card : d.cards)
      if (!card.missing()) convert_card(b, d, card);
    add_lines(b, d);
    if (!own_units_ && !b.schema->layout_known()) undescribed(b, d);
  }

  /// Blank scales on omitted lines at the end are written too.
  void add_lines(const Block& b, const DecodedBlock& d) {
    std::map<const CardSchema*, std::string> texts;
    for (const std::string& name : ones_.absent)
      for (const CardSchema& card : b.schema->cards)
        for (const Field& f : card.fields) {
          if (f.name != name || !card.in_version(b.version) || !f.in_version(b.version) ||
              keeps_number(d, name))
            continue;
          if (!is_met(card.when, d) || !is_met(f.when, d)) continue;
          const UnitFactor factor = c_.factors.of(written_dimension(
              f, dimension_of(f, d), f.solver_dimension && is_met(f.solver_when, d)));
          if (factor.one()) continue;
          const auto text = detail::scale_text("1", f.last - f.first + 1, factor);
          if (!text) {
            c_.undecided(b, {}, name, "blank means 1, which does not fit in the new units");
            continue;
          }
          CellWriter::put(texts[&card], f.first, f.last, text->text);
          c_.out.losses.push_back(loss_entry(
              deck_, Loss::kept, b, b.header_span,
              {.field = name,
               .new_text = text->text,
               .note =
                   "its line was missing; blank is 1 in the units of the block, which change"}));
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
      if (!next->in_version(b.version) || !is_met(next->when, d)) continue;
      if (next->repeat != Repeat::once) break;
      const auto text = texts.find(next);
      added += text == texts.end() ? 0 : 1;
      lines.push_back(text == texts.end() ? std::string() : text->second);
    }
    if (added < texts.size() || !d.extra.empty() || detail::lacks_title(d)) {
      c_.undecided(b, {}, *ones_.absent.begin(),
                   "this scale has no line in the block; add the line");
      return;
    }
    detail::LineEdits edits(deck_.sources);
    for (const std::string& line : lines) edits.insert_after(anchor, line);
    edits.append_to(c_.out.edits);
  }

  // ---- functions ------------------------------------------------------------------------------

  /// Cells that scale the axes of the function in `cell`, and the meaning of its points.
  void function_use(const Block& b, const DecodedBlock& d, const DecodedCard& card,
                    const Cell& cell) {
    const Field& f = *cell.field;
    if (f.axes.empty() || (cell.integer == 0 && !cell.parameter)) return;
    UnitConversion::FunctionUse use{detail::place_of(b, card, cell), std::abs(cell.integer), {}};
    for (const Axis& axis : f.axes) {
      bool scaled = axis.scales.empty();
      for (const std::string& name : axis.scales) {
        if (keeps_number(d, name)) {
          scaled = scaled || name[0] != 'A';
          continue;
        }
        scaled = scaled || detail::axis_scale(d, card, cell, name).counts();
      }
      Dimension points;
      if (axis.scales.empty()) {
        points = axis.dimension;
        for (const auto& [when, dimension] : axis.dimension_when)
          if (is_met(when, d, &card)) {
            points = dimension;
            break;
          }
      } else if (!scaled) {
        // Without a cell for the scale it is 1 and the points have its dimension; or the scale must
        // keep its number.
        const Field* scale = b.schema->find_field(axis.scales.front());
        if (scale != nullptr) points = dimension_of(*scale, d, &card);
      }
      points.temperature = 0;
      use.points.push_back(points);
    }
    c_.function_uses.push_back(std::move(use));
  }

  /// The solver divides K of a spring by its coefficient A for contacts, and the force is f(x) (A +
  /// B ln(v / D) + E g(v / F)). Both stay correct only if A, B and E keep their numbers and the
  /// points of f change with the unit of force. True for such a coefficient; if K is no stiffness
  /// or f has no points, it is converted like other scales.
  bool keeps_number(const DecodedBlock& d, const std::string& name) const {
    if (!c_.working_changes || own_units_ || name.empty() || name.size() > 2 ||
        std::string_view("ABE").find(name[0]) == std::string_view::npos || d.block == nullptr ||
        d.block->schema->kind != "prop")
      return false;
    const std::string row = name.size() == 1 ? "1" : name.substr(1);
    const Cell* k = d.find("K") != nullptr ? d.find("K") : d.find("K" + row);
    if (k == nullptr || (k->real == 0 && !k->parameter)) return false;
    const Cell* a = d.find(d.find("A") != nullptr ? "A" : "A" + row);
    constexpr int residual = 5;  // the second function gives elongations; A does not scale it
    return a != nullptr && !a->parameter && k->field->dimension == Dimension{1, 0, -2, 0} &&
           d.integer("Ileng") == 0 && d.integer("H" + row) != residual &&
           d.integer("fct_ID1" + row) != 0 && has_points(d, "fct_ID1" + row) &&
           has_points(d, "fct_ID3" + row);
  }

  /// True if the cell names no function, or a function with points.
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
          c_.function_uses.push_back({detail::place_of(b, card, cell), std::abs(cell.integer), {}});
      }
      if (f.type != FieldType::real) continue;
      const bool zero = cell.blank() || (cell.status == NumberStatus::ok && cell.real == 0);
      const bool brought = ones_.cells.contains(&cell);
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
          write_default(b, card, cell, stfac && !own_units_ ? *stfac : dimension_of(f, d, &card));
      } else if (!own_units_ || working || f.solver_dimension) {
        convert_cell(b, card, cell, dimension);
      }
    }
  }

  /// Power of the units by which the number changes. The solver converts the number from block
  /// units to working units by S, but its meaning has dimension P: with new working units the
  /// result must change by P.
  Dimension effective_dimension(const DecodedBlock& d, const DecodedCard& card,
                                const Cell& cell) const {
    const Field& f = *cell.field;
    Dimension physical = dimension_of(f, d, &card);
    if (!f.over.empty() && is_met(f.over_when, d, &card)) {
      // The number multiplies a scale: if the scale's number changes, this one does not.
      const Cell* scale = detail::cell_beside(d, card, cell, f.over);
      if (scale != nullptr && (ones_.cells.contains(scale) || scale->parameter ||
                               (!scale->blank() && scale->real != 0)))
        physical = minus(physical, dimension_of(*scale->field, d, &card));
    }
    return written_dimension(f, physical, f.solver_dimension && is_met(f.solver_when, d, &card));
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
    const UnitFactor factor = c_.factors.of(dimension);
    if (factor.one()) return;
    c_.note_dimension(dimension, factor);
    const detail::CellPlace place = detail::place_of(b, card, cell);
    if (!cell.parameter) return c_.convert(place, factor);
    const std::string_view name = cell.text.substr(cell.text.starts_with('-') ? 2 : 1);
    c_.parameter_uses[std::string(name)].push_back({place, dimension, cell.real});
  }

  /// Power of the units by which Stfac changes; the interface's effective Istf says if it is a
  /// stiffness. The solver converts Stfac to working units if the card itself has Istf 1, else
  /// takes it as it is.
  std::optional<Dimension> stfac_dimension(const DecodedBlock& d, const Cell& cell) const {
    if (cell.field->name != "Stfac") return std::nullopt;
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

  /// A blank scale is 1 in block units: written out if these change.
  void write_one(const Block& b, const DecodedCard& card, const Cell& cell,
                 const Dimension& dimension) {
    const Field& f = *cell.field;
    const UnitFactor factor = c_.factors.of(dimension);
    if (factor.one()) return;
    const auto text = detail::scale_text("1", f.last - f.first + 1, factor);
    if (!text) {
      c_.undecided(b, cell.span, f.name, "blank means 1, which does not fit in the new units");
      return;
    }
    c_.note_dimension(dimension, factor);
    write_out(b, card, cell, text->text,
              "blank is 1 in the units of the block, which change; it was written out");
  }

  /// 0 and blank mean a number in working units: written out if these change.
  void write_default(const Block& b, const DecodedCard& card, const Cell& cell,
                     const Dimension& dimension) {
    const Field& f = *cell.field;
    const auto value = detail::ordinary_default(f);
    const UnitFactor factor = from_working_.of(dimension);
    if (!value || factor.one()) return;
    const auto text = detail::scale_text(f.default_text, f.last - f.first + 1, factor);
    if (!text) {
      c_.undecided(b, cell.span, f.name,
                   "blank means " + f.default_text + " in working units, which change");
      return;
    }
    write_out(b, card, cell, text->text,
              "the default " + f.default_text + " is in working units and was written out");
  }

  /// Writes `text` into a cell that was 0 or blank.
  void write_out(const Block& b, const DecodedCard& card, const Cell& cell, const std::string& text,
                 std::string note) {
    const Field& f = *cell.field;
    const detail::CellPlace place = detail::place_of(b, card, cell);
    const Line& line = card.line;
    if (!card.free_format && static_cast<int>(line.text.size()) < place.first) {
      grown_.set(line.whole(), place.first, place.last, text);
    } else {
      const bool there = cell.span.offset + cell.span.length <= line.offset + line.text.size();
      if ((card.free_format && !there) || !c_.cells.put(place, text)) {
        c_.undecided(b, cell.span, f.name,
                     "blank means a number that has to be written out, and this free-format line "
                     "has no room for it");
        return;
      }
    }
    c_.out.losses.push_back(loss_entry(deck_, Loss::kept, b, cell.span,
                                       {.field = f.name,
                                        .old_text = std::string(cell.text),
                                        .new_text = text,
                                        .note = std::move(note)}));
  }

  // ---- text that no schema describes ----------------------------------------------------------

  /// One finding per block. Zero is zero in any unit.
  void undescribed(const Block& b, const DecodedBlock& d) {
    detail::find_undescribed_words(d, [&](const Line& line, std::size_t begin, std::size_t end) {
      const RealCell value = read_real(line.text.substr(begin, end - begin));
      if (value.status == NumberStatus::ok && value.value == 0) return false;
      c_.undecided(b, line.columns(static_cast<int>(begin) + 1, static_cast<int>(end)), "",
                   "the keyword is described in part only; the dimension of this value is not "
                   "known");
      return true;
    });
  }

  // ---- values outside schema cells ------------------------------------------------------------

  /// /CNODE/tolerance: a length in the header.
  void tolerance(const Block& b) {
    const UnitFactor& factor = c_.factors.length();
    const std::string_view text = detail::trim(b.header.substr(7));
    const RealCell value = read_real(text);
    if (text.empty() || factor.one()) return;
    if (value.status == NumberStatus::ok && value.value == 0) return;
    const Span place = detail::span_in_header(b, text);
    const auto scaled = detail::scale_text(text, detail::widest_number, factor);
    if (!scaled) {
      c_.undecided(b, place, "tolerance", "'" + std::string(text) + "' is not a plain number");
      return;
    }
    c_.out.edits.push_back({place, scaled->text});
    ++c_.changed_cells;
  }

  /// PLANE and ELLIPS clauses of a set have lengths on two lines.
  void set_clauses(const Block& b) {
    constexpr Dimension length{0, 1, 0, 0};
    const UnitFactor& factor = c_.factors.length();
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
          c_.convert(b, line, 11 + 20 * cell, 30 + 20 * cell, clause, factor);
      }
    }
  }

  UnitConversion& c_;
  const Deck& deck_;
  bool own_units_ = false;
  detail::UnitFactors from_working_{{}, {}};
  CellWriter grown_{deck_.sources};  // cells behind the end of their line
  detail::ImpliedOnes ones_;         // of this block: blank cells that mean 1
};
}  // namespace

void detail::convert_blocks(UnitConversion& conversion) {
  BlockConverter blocks(conversion);
  for (const Block& b : conversion.deck.blocks) blocks.convert(b);
}

}  // namespace deck
