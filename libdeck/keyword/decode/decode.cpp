// Reads the cells of one line by the fields of its card, in fixed columns or free format.
#include "deck/keyword.hpp"

#include <algorithm>

#include "keyword/shared/decode_parts.hpp"
#include "keyword/shared/line_check.hpp"
#include "keyword/shared/reader.hpp"

namespace deck {

detail::FreeCells detail::split_free(const Line& line) {
  FreeCells cells;
  const std::string_view text = line.text.substr(0, line_columns);
  std::size_t at = 0;
  const auto blank = [&](std::size_t k) { return is_blank(text[k]); };
  bool after_comma = true;
  while (at <= text.size()) {
    while (at < text.size() && blank(at)) ++at;
    const std::size_t begin = at;
    while (at < text.size() && text[at] != ',' && !blank(at)) ++at;
    if (at > begin || after_comma)
      if (begin < text.size() || at > begin)
        cells.emplace_back(
            text.substr(begin, at - begin),
            Span{line.file, static_cast<std::uint32_t>(at - begin), line.offset + begin});
    while (at < text.size() && blank(at)) ++at;
    after_comma = at < text.size() && text[at] == ',';
    if (after_comma) ++at;
    if (at >= text.size()) break;
  }
  return cells;
}

bool detail::is_free(const Line& line) {
  return line.text.substr(0, line_columns).find(',') != std::string_view::npos;
}

namespace {

using detail::BlockFindings;
using detail::FreeCells;
using detail::line_columns;
using detail::LineContext;
using detail::LineRule;
using detail::split_free;
using detail::trim;

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string out = "'";
  for (const char c : text.substr(0, longest)) out += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return out + (text.size() > longest ? "…'" : "'");
}

std::string shown(double value) {
  const auto text = format_real(value, 24);
  return text ? text->text : std::string("0");
}

std::string cell_name(const Field& f) {
  return f.name + " (columns " + std::to_string(f.first) + "-" + std::to_string(f.last) + ")";
}

/// True for "0x10" as a whole; a real cell would read 16.
bool is_hexadecimal(const Cell& cell) {
  const std::string_view text = cell.text;
  const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  return cell.field->type == FieldType::real && text.size() > sign + 2 && text[sign] == '0' &&
         (text[sign + 1] | 0x20) == 'x' &&
         text.find_first_not_of("0123456789abcdefABCDEF.pP+-", sign + 2) == std::string_view::npos;
}

void report_number(BlockFindings& noted, const Cell& cell) {
  const Field& f = *cell.field;
  const LineRule rule = detail::number_rule(f, cell.status, cell.text.size(), cell.real);
  if (rule == LineRule::none || !noted.wants(detail::id_of(rule))) return;
  const bool real = f.type == FieldType::real;
  const std::string what = cell_name(f) + " holds " + quoted(cell.text);
  const auto keep = [&](std::string message, Overrides overrides = {}) {
    noted.keep(detail::id_of(rule), cell.span, what + std::move(message), std::move(overrides));
  };
  switch (rule) {
    case LineRule::integer:
    case LineRule::real:
      keep(std::string(", expected ") + (real ? "a real number" : "an integer"));
      break;
    case LineRule::trailing: {
      const std::size_t blank = std::min(cell.text.find_first_of(" \t"), cell.text.size());
      const std::string_view rest = trim(cell.text.substr(blank));
      keep((is_hexadecimal(cell) ? ", a hexadecimal number; it is read as "
                                 : ": text follows the number; it is read as ") +
               (real ? shown(cell.real) : std::to_string(cell.integer)) +
               (rest.empty() ? "" : ", and " + quoted(rest) + " is lost"),
           {.solver = "It reads the same value, silently."});
      break;
    }
    case LineRule::range:
      keep(": the number is out of range", {.message = real ? 100104 : 100103});
      break;
    case LineRule::tiny:
      if (cell.status == NumberStatus::underflow)
        keep(": the number is too small and becomes 0", {.solver = "it reads 0"});
      else
        keep(": the number is subnormal, and every operation on it is slow",
             {.solver = "it computes with it"});
      break;
    case LineRule::not_finite:
      keep(": infinity and not-a-number are not valid input",
           {.solver = "it accepts the text and computes with it", .fix = "write a finite number"});
      break;
    case LineRule::letterless:
      keep(": an exponent without letter fills the whole cell");
      break;
    default:
      break;
  }
}

/// Replaces the value of a cell by that of its parameter.
void apply_parameter(const Deck& deck, BlockFindings& noted, Cell& cell) {
  std::string_view name = cell.text;
  const bool minus = name.starts_with('-');
  if (minus) name.remove_prefix(1);
  name.remove_prefix(1);
  cell.parameter = true;
  cell.status = NumberStatus::ok;
  cell.integer = 0;
  cell.real = 0;
  const Parameter* p = deck.find_parameter(name, cell.span.file);
  if (p == nullptr || !p->valid || p->type == Parameter::Type::text) {
    noted.report(
        RuleId::DK018, cell.span,
        cell_name(*cell.field) + " refers to parameter " + quoted(name) +
            (p == nullptr || p->type == Parameter::Type::text ? ", which is not defined here"
                                                              : ", which has no usable value"));
    return;
  }
  cell.integer = detail::as_integer(*p);
  if (cell.field->type != FieldType::real && cell.integer != detail::saturated(cell.integer)) {
    noted.report(RuleId::DK023, cell.span,
                 cell_name(*cell.field) + " takes " + std::to_string(cell.integer) +
                     " from parameter " + quoted(name) + ", which 32 bits do not hold",
                 {.message = 100103});
    cell.status = NumberStatus::overflow;
  }
  cell.integer = detail::saturated(cell.integer);
  cell.real = p->type == Parameter::Type::integer ? static_cast<double>(p->integer) : p->real;
  if (minus) {
    cell.integer = -cell.integer;
    cell.real = -cell.real;
  }
}

/// Adds the cell with this text to a line.
void read_cell(const Deck& deck, BlockFindings& noted, const Field& field, std::string_view text,
               Span span, DecodedCard& out) {
  Cell& cell = out.cells.emplace_back();
  cell.field = &field;
  cell.span = span;
  cell.text = trim(text);
  if (cell.text.empty()) return;
  if (field.type == FieldType::text || field.type == FieldType::flag) {
    cell.status = NumberStatus::ok;
    cell.integer = field.type == FieldType::flag && cell.text == "1" ? 1 : 0;
    return;
  }
  const std::size_t sign = cell.text.starts_with('-') ? 1 : 0;
  if (sign < cell.text.size() && cell.text[sign] == '&') {
    apply_parameter(deck, noted, cell);
    return;
  }
  if (field.type == FieldType::real) {
    const RealCell r = read_real(cell.text);
    cell.real = r.value;
    cell.status = r.status;
  } else {
    const IntegerCell i = read_integer(cell.text);
    cell.status = detail::narrowed(i);
    cell.integer = detail::saturated(i.value);
  }
  if (noted.on()) report_number(noted, cell);
}

void read_columns(const Deck& deck, BlockFindings& noted, const Field& field, int first, int last,
                  DecodedCard& out) {
  read_cell(deck, noted, field, detail::columns(out.line.text, first, last),
            out.line.columns(first, last), out);
}

/// Reports text on a blank line.
void check_blank(BlockFindings& noted, const Line& line) {
  const std::string_view text = trim(line.text);
  if (text.find_first_not_of("0.+-, ") == std::string_view::npos) return;
  noted.report(RuleId::DK028, line.whole(),
               "text " + quoted(text) + " is on a line that must be blank",
               {.solver = "It does not read the text of this line, but counts the line.",
                .fix = "Move the value to its line. Keep this line, but blank."});
}

/// Reports text outside of all cells of this version: between cells and after the last.
void check_gaps(BlockFindings& noted, const CardSchema& card, int version, const Line& line) {
  if (card.blank()) return check_blank(noted, line);
  const detail::ColumnMap map(card, version);
  detail::for_each_gap_text(map, line.text, [&](int first, int last, bool after, bool zero) {
    if (after && zero) return;
    const LineRule rule = after ? LineRule::after : LineRule::gap;
    if (!noted.wants(detail::id_of(rule))) return;
    const std::string text =
        "text " + quoted(line.text.substr(static_cast<std::size_t>(first - 1),
                                          static_cast<std::size_t>(last - first + 1)));
    if (after)
      noted.keep(
          detail::id_of(rule), line.columns(first, last),
          text + " is after the last cell of this line (column " + std::to_string(map.last) + ")");
    else
      noted.keep(
          detail::id_of(rule), line.columns(first, last),
          text + " is in columns that version " + std::to_string(version) + " leaves blank",
          {.severity = zero ? Severity::info : Severity::warning,
           .solver = "It ignores the text.",
           .fix = "delete it, or check whether the card was written for another input version"});
  });
}

void check_line(BlockFindings& noted, const Line& line, bool fixed_columns) {
  if (const std::string_view tail = detail::tail_of(line.text); !tail.empty())
    noted.report(RuleId::DK012,
                 line.columns(line_columns + 1,
                              static_cast<int>(std::min<std::size_t>(line.text.size(), 1 << 20))),
                 "text beyond column 100 is not read: " + quoted(tail),
                 {.solver = "It ignores the text silently."});
  const std::string_view text = line.text.substr(0, line_columns);
  if (const auto tab = text.find('\t'); fixed_columns && tab != std::string_view::npos)
    noted.report(RuleId::DK013, line.columns(static_cast<int>(tab) + 1, static_cast<int>(tab) + 1),
                 "a tab counts as one column here, so the cells after it shift");
  if (const auto nul = text.find('\0'); nul != std::string_view::npos)
    noted.report(RuleId::DK014, line.columns(static_cast<int>(nul) + 1, static_cast<int>(nul) + 1),
                 "a NUL byte cuts this data line off in most readers");
}

/// True for cards with a single text cell (titles, names).
bool is_text_card(const CardSchema& card) {
  return card.fields.size() == 1 && card.fields[0].type == FieldType::text;
}

bool has_comma(const CardSchema& card, const Line& line) {
  return !card.blank() && !is_text_card(card) && detail::is_free(line);
}

/// Reads the cells of a list. `limit`: largest number of cells on this line, including blank ones.
void read_ids(const Deck& deck, BlockFindings& noted, int limit, DecodedCard& out) {
  const CardSchema& card = *out.schema;
  const Field& f = card.fields.back();
  for (std::size_t i = 0; i + 1 < card.fields.size(); ++i)
    read_columns(deck, noted, card.fields[i], card.fields[i].first, card.fields[i].last, out);
  const int width = f.last - f.first + 1;
  const bool counted = !card.count.empty();
  const auto meaningful = std::size_t{detail::line_columns};
  const int size = static_cast<int>(std::min(out.line.text.size(), meaningful));
  for (int first = f.first, n = 0; n < limit && (counted || first <= size); first += width, ++n) {
    read_columns(deck, noted, f, first, first + width - 1, out);
    if (!counted && out.cells.back().blank()) out.cells.pop_back();
  }
}

}  // namespace

const Cell* DecodedBlock::find(std::string_view field) const {
  for (const DecodedCard& card : cards)
    for (const Cell& cell : card.cells)
      if (cell.field->name == field) return &cell;
  return nullptr;
}

std::int64_t DecodedBlock::integer(std::string_view field) const {
  const Cell* cell = find(field);
  return cell ? cell->integer : 0;
}

double DecodedBlock::real(std::string_view field) const {
  const Cell* cell = find(field);
  return cell ? cell->real : 0;
}

namespace {

bool are_met_on_line(const Field& field, const DecodedCard& line, const LineContext& context) {
  return std::all_of(field.when.begin(), field.when.end(), [&](const Condition& c) {
    for (const Cell& cell : line.cells)
      if (cell.field->name == c.field) return c.accepts(cell.integer);
    return context.value == nullptr || c.accepts((*context.value)(c.field));
  });
}

/// Narrower gaps belong to the flags after them.
constexpr int shortest_blank_cell = 8;

/// A cell in free format for columns without meaning.
void drop_blank_cell(BlockFindings& noted, const Block& block,
                     const std::pair<std::string_view, Span>* cell, int first, int last) {
  if (cell == nullptr || cell->first.empty()) return;
  noted.report(RuleId::DK028, cell->second,
               "text " + quoted(cell->first) + " of this free-format line falls on columns " +
                   std::to_string(first) + "-" + std::to_string(last) + ", which version " +
                   std::to_string(block.version) + " leaves blank",
               {.solver = "It ignores the text; the next one goes to the next cell.",
                .fix = "write two commas for the blank columns, or fixed columns"});
}

/// True if the line is separated by blanks or indented, as in fixed columns.
bool laid_out_in_columns(std::string_view text) {
  constexpr std::size_t indent = 5;
  std::size_t at = std::min(text.find_first_not_of(" \t"), text.size());
  if (at >= indent) return true;
  for (at = text.find_first_of(" \t", at); at < text.size(); at = text.find_first_of(" \t", at)) {
    const std::size_t next = text.find_first_not_of(" \t", at);
    if (next >= text.size()) return false;
    if (text[at - 1] != ',' && text[next] != ',') return true;
    at = next;
  }
  return false;
}

/// "1,25" among cells in columns: a decimal comma, which splits the cell and shifts all others.
void find_decimal_comma(BlockFindings& noted, const FreeCells& cells, const DecodedCard& card) {
  const std::string_view text = card.line.text.substr(0, line_columns);
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto read_as = [&](std::size_t i) {
    const auto it = std::find_if(card.cells.begin(), card.cells.end(), [&](const Cell& c) {
      return c.span.offset == cells[i].second.offset && c.span.length > 0;
    });
    return (it == card.cells.end() ? std::string("no cell") : it->field->name) + " = " +
           std::string(cells[i].first);
  };
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    const auto& [whole, at] = cells[i];
    const auto& [fraction, behind] = cells[i + 1];
    if (whole.empty() || fraction.empty() || !digit(whole.back()) || !digit(fraction.front()) ||
        behind.offset != at.offset + at.length + 1 ||
        text[static_cast<std::size_t>(behind.offset - card.line.offset) - 1] != ',')
      continue;
    if (!laid_out_in_columns(text)) return;
    Span both = at;
    both.length += 1 + behind.length;
    const std::string number = std::string(whole) + "," + std::string(fraction);
    noted.report(RuleId::DK059, both,
                 "the comma in " + quoted(std::string_view(number)) +
                     " parts two cells: " + read_as(i) + ", " + read_as(i + 1));
    return;
  }
}

void read_free(const Deck& deck, const Block& block, BlockFindings& noted,
               const LineContext& context, DecodedCard& out) {
  const CardSchema& card = *out.schema;
  const auto cells = split_free(out.line);
  const bool list = card.repeat == Repeat::ids;
  std::size_t next = 0;
  const auto read_field = [&](const Field& f) {
    const auto [text, span] = next < cells.size()
                                  ? cells[next]
                                  : std::pair{std::string_view(), out.line.columns(101, 101)};
    ++next;
    read_cell(deck, noted, f, text, span, out);
  };
  // In free format, columns that are blank between two cells of this version are a cell, too, whose
  // text is dropped. If the schema is partial, these columns are unknown.
  const bool gaps = !list && (block.schema == nullptr || block.schema->layout_known());
  std::vector<const Field*> fields;
  for (const Field& f : card.fields)
    if (f.in_version(block.version)) fields.push_back(&f);
  if (gaps)
    std::stable_sort(fields.begin(), fields.end(),
                     [](const Field* a, const Field* b) { return a->first < b->first; });
  int end = 0;  // last column so far
  for (const Field* f : fields) {
    if (!are_met_on_line(*f, out, context)) continue;
    if (gaps && f->first > end + 1 && f->first - end > shortest_blank_cell) {
      drop_blank_cell(noted, block, next < cells.size() ? &cells[next] : nullptr, end + 1,
                      f->first - 1);
      ++next;
    }
    read_field(*f);
    end = f->last;
  }
  if (list && !card.fields.empty())
    while (next < cells.size() &&
           (context.cells == 0 || out.cells.size() < static_cast<std::size_t>(context.cells)))
      read_field(card.fields.back());
  find_decimal_comma(noted, cells, out);
  if (next < cells.size() && !list)
    noted.report(RuleId::DK028, cells[next].second,
                 "text " + quoted(cells[next].first) +
                     " follows the last cell of this "
                     "free-format line (" +
                     std::to_string(next) + " cells)",
                 {.fix = "delete it, or check the commas of the line"});
}

}  // namespace

DecodedCard detail::decode_in_context(const Deck& deck, const Block& block, const CardSchema& card,
                                      const Line& line, Findings* findings,
                                      const LineContext& context) {
  BlockFindings noted(findings, block);
  DecodedCard out;
  out.schema = &card;
  out.line = line;
  if (!line.valid()) return out;
  out.free_format = has_comma(card, line);
  if (noted.on()) check_line(noted, line, !out.free_format && !is_text_card(card));
  if (out.free_format) {
    read_free(deck, block, noted, context, out);
    return out;
  }
  if (card.repeat == Repeat::ids) {
    const int most = card.count.empty() ? line_columns : card.per_line;
    const Field& id = card.fields.back();
    out.cells.reserve(line.text.size() / static_cast<std::size_t>(id.last - id.first + 1) + 1);
    read_ids(deck, noted, context.cells > 0 ? context.cells : most, out);
    return out;
  }
  // A partial schema does not say which columns are blank.
  const bool complete = block.schema == nullptr || block.schema->layout_known();
  if (noted.on() && complete) check_gaps(noted, card, block.version, line);
  out.cells.reserve(card.fields.size());
  bool conditional = false;
  for (const Field& f : card.fields) {
    conditional = conditional || !f.when.empty();
    if (f.when.empty() && f.in_version(block.version))
      read_columns(deck, noted, f, f.first, f.last, out);
  }
  if (!conditional) return out;
  // Conditions use the cells of fields without conditions.
  for (const Field& f : card.fields)
    if (!f.when.empty() && f.in_version(block.version) && are_met_on_line(f, out, context))
      read_columns(deck, noted, f, f.first, f.last, out);
  std::stable_sort(out.cells.begin(), out.cells.end(),
                   [](const Cell& a, const Cell& b) { return a.field->first < b.field->first; });
  return out;
}

DecodedCard decode_line(const Deck& deck, const Block& block, const CardSchema& card,
                        const Line& line, Findings* findings) {
  return detail::decode_in_context(deck, block, card, line, findings, {});
}

}  // namespace deck
