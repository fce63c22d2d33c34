#include "deck/keyword/decode.hpp"

#include <algorithm>
#include <cmath>

#include "keyword/reader.hpp"

namespace deck {
namespace {

using detail::trim;

constexpr int line_columns = 100;

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string out = "'";
  for (const char c : text.substr(0, longest))
    out += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return out + (text.size() > longest ? "…'" : "'");
}

/// Findings of one decode call, about one block.
class Findings {
 public:
  Findings(Diagnostics* sink, const Block& block) : sink_(sink), block_(block) {}
  bool on() const { return sink_ != nullptr; }

  Diagnostic* report(std::string_view rule, Severity severity, Span span, std::string message,
                     std::string behaviour, std::string help, int number = 0,
                     Severity number_severity = Severity::warning) {
    if (sink_ == nullptr || !sink_->wants(rule)) return nullptr;
    Diagnostic d;
    d.rule = rule;
    d.severity = severity;
    d.span = span;
    d.message = std::move(message);
    d.reference_behaviour = std::move(behaviour);
    d.help = std::move(help);
    if (number != 0) d.reference = ReferenceMessage{number, number_severity};
    d.keyword = std::string(block_.keyword);
    d.id = block_.id.value;
    return &sink_->add(std::move(d));
  }

 private:
  Diagnostics* sink_;
  const Block& block_;
};

std::string cell_name(const Field& f) {
  return f.name + " (columns " + std::to_string(f.first) + "-" + std::to_string(f.last) + ")";
}

void report_number(Findings& findings, const Cell& cell) {
  const Field& f = *cell.field;
  const bool real = f.type == FieldType::real;
  const std::string what = cell_name(f) + " holds " + quoted(cell.text);
  switch (cell.status) {
    case NumberStatus::not_a_number:
      findings.report(real ? "DK021" : "DK020", Severity::error, cell.span,
                      what + ", expected " + (real ? "a real number" : "an integer"),
                      "it reports an error and reads 0", "write a number or leave the cell blank",
                      real ? 100102 : 100101, Severity::error);
      break;
    case NumberStatus::trailing_text:
      findings.report("DK022", Severity::error, cell.span,
                      what + ": text follows the number",
                      "it reads " + (real ? std::to_string(cell.real)
                                          : std::to_string(cell.integer)) +
                          " and drops the rest without a word",
                      "check that the value stands in its columns");
      break;
    case NumberStatus::overflow:
      findings.report("DK023", Severity::error, cell.span, what + ": the number is out of range",
                      "it reads an undefined value", "write a smaller number", real ? 100104 : 100103,
                      Severity::error);
      break;
    case NumberStatus::underflow:
      findings.report("DK024", Severity::warning, cell.span,
                      what + ": the number is too small and becomes 0", "it reads 0",
                      "write 0 if that is meant");
      break;
    case NumberStatus::not_finite:
      findings.report("DK025", Severity::error, cell.span,
                      what + ": infinity and not-a-number are no input",
                      "it accepts the text and computes with it", "write a finite number");
      break;
    case NumberStatus::implicit_exponent:
      if (static_cast<int>(cell.text.size()) >= f.last - f.first + 1)
        findings.report("DK026", Severity::warning, cell.span,
                        what + ": an exponent without letter fills the whole cell",
                        "open-reader builds lose the last character of such a cell",
                        "write the exponent with E or drop a digit");
      break;
    case NumberStatus::ok:
      if (real && cell.real != 0 && std::fabs(cell.real) < 2.2250738585072014e-308)
        findings.report("DK024", Severity::warning, cell.span,
                        what + ": the number is subnormal and slows every operation on it",
                        "it computes with it", "write 0 if that is meant");
      break;
    case NumberStatus::blank: break;
  }
}

/// Replaces a cell's value by that of the parameter it names.
void apply_parameter(const Deck& deck, Findings& findings, Cell& cell) {
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
    findings.report("DK018", Severity::error, cell.span,
                    cell_name(*cell.field) + " refers to parameter " + quoted(name) +
                        ", which is not defined here",
                    "it reports an error and reads 0",
                    "define it with /PARAMETER in this file or globally", 100105, Severity::error);
    return;
  }
  cell.integer = p->type == Parameter::Type::integer ? p->integer
                                                     : static_cast<std::int64_t>(p->real);
  cell.real = p->type == Parameter::Type::integer ? static_cast<double>(p->integer) : p->real;
  if (minus) {
    cell.integer = -cell.integer;
    cell.real = -cell.real;
  }
}

Cell read_cell(const Deck& deck, Findings& findings, const Field& field, std::string_view text,
               Span span) {
  Cell cell;
  cell.field = &field;
  cell.span = span;
  cell.text = trim(text);
  if (field.type == FieldType::text) {
    cell.status = cell.text.empty() ? NumberStatus::blank : NumberStatus::ok;
    return cell;
  }
  if (field.type == FieldType::flag) {
    cell.status = cell.text.empty() ? NumberStatus::blank : NumberStatus::ok;
    cell.integer = cell.text == "1" ? 1 : 0;
    return cell;
  }
  if (cell.text.starts_with('&') || cell.text.starts_with("-&")) {
    apply_parameter(deck, findings, cell);
    return cell;
  }
  if (field.type == FieldType::real) {
    const RealCell r = read_real(cell.text);
    cell.real = r.value;
    cell.status = r.status;
  } else {
    const IntegerCell i = read_integer(cell.text);
    cell.integer = i.value;
    cell.status = i.status;
    if (cell.status == NumberStatus::ok && (i.value > 2147483647 || i.value < -2147483648LL))
      cell.status = NumberStatus::overflow;
  }
  if (findings.on() && cell.status != NumberStatus::blank) report_number(findings, cell);
  return cell;
}

/// Text outside every cell of this version: between cells, and after the last one.
void check_gaps(Findings& findings, const CardSchema& card, int version, const Line& line) {
  bool covered[line_columns + 1] = {};
  int last = 0;
  for (const Field& f : card.fields) {
    if (!f.in_version(version)) continue;
    for (int c = f.first; c <= std::min(f.last, line_columns); ++c) covered[c] = true;
    last = std::max(last, f.last);
  }
  const int size = static_cast<int>(std::min<std::size_t>(line.text.size(), line_columns));
  for (int c = 1; c <= size;) {
    const auto blank = [&](int k) {
      return static_cast<unsigned char>(line.text[static_cast<std::size_t>(k - 1)]) <= ' ';
    };
    if (covered[c] || blank(c)) {
      ++c;
      continue;
    }
    int end = c;
    while (end < size && !covered[end + 1] && !blank(end + 1)) ++end;
    const std::string_view text = line.text.substr(static_cast<std::size_t>(c - 1),
                                                   static_cast<std::size_t>(end - c + 1));
    const bool after = c > last;
    const bool zero = text.find_first_not_of("0.+-") == std::string_view::npos;
    if (after && !zero)
      findings.report("DK028", Severity::warning, line.columns(c, end),
                      "text " + quoted(text) + " stands after the last cell of this line (column " +
                          std::to_string(last) + ")",
                      "it drops the text", "move the value into its columns or delete it", 100213);
    else if (!after)
      findings.report("DK027", zero ? Severity::info : Severity::warning, line.columns(c, end),
                      "text " + quoted(text) + " stands in columns that version " +
                          std::to_string(version) + " leaves blank",
                      "it drops the text",
                      "delete it, or check whether the card was written for another input version",
                      100214);
    c = end + 1;
  }
}

void check_line(Findings& findings, const Line& line) {
  if (line.text.size() > line_columns) {
    std::string_view tail = line.text.substr(line_columns);
    while (!tail.empty() && tail.front() == ' ') tail.remove_prefix(1);
    if (!tail.empty())
      findings.report("DK012", Severity::warning,
                      line.columns(line_columns + 1, static_cast<int>(std::min<std::size_t>(
                                                         line.text.size(), 1 << 20))),
                      "text beyond column 100: " + quoted(tail), "it drops the text silently",
                      "shorten the line to 100 columns", 100213);
  }
  if (const auto tab = line.text.find('\t'); tab != std::string_view::npos)
    findings.report("DK013", Severity::warning,
                    line.columns(static_cast<int>(tab) + 1, static_cast<int>(tab) + 1),
                    "a tab in fixed columns",
                    "a tab is one column for it, so the cells after it are shifted",
                    "replace tabs by blanks");
  if (const auto nul = line.text.find('\0'); nul != std::string_view::npos)
    findings.report("DK014", Severity::error,
                    line.columns(static_cast<int>(nul) + 1, static_cast<int>(nul) + 1),
                    "a NUL byte in a data line", "it ends the line there", "remove the byte");
}

/// Free-format cells: commas and blanks separate, two commas make an empty cell.
std::vector<std::pair<std::string_view, Span>> split_free(const Line& line) {
  std::vector<std::pair<std::string_view, Span>> cells;
  const std::string_view text = line.text.substr(0, line_columns);
  std::size_t at = 0;
  const auto blank = [&](std::size_t k) { return static_cast<unsigned char>(text[k]) <= ' '; };
  bool after_comma = true;
  while (at <= text.size()) {
    while (at < text.size() && blank(at)) ++at;
    const std::size_t begin = at;
    while (at < text.size() && text[at] != ',' && !blank(at)) ++at;
    if (at > begin || after_comma)
      if (begin < text.size() || at > begin)
        cells.emplace_back(text.substr(begin, at - begin),
                           Span{line.file, static_cast<std::uint32_t>(at - begin),
                                line.offset + begin});
    while (at < text.size() && blank(at)) ++at;
    after_comma = at < text.size() && text[at] == ',';
    if (after_comma) ++at;
    if (at >= text.size()) break;
  }
  return cells;
}

bool has_comma(const CardSchema& card, const Line& line) {
  // Cards of a single text cell (titles, names) are exempt.
  if (card.fields.size() == 1 && card.fields[0].type == FieldType::text) return false;
  return line.text.substr(0, line_columns).find(',') != std::string_view::npos;
}

void read_ids(const Deck& deck, Findings& findings, const CardSchema& card, const Line& line,
              DecodedCard& out) {
  const Field& f = card.fields.back();
  for (std::size_t i = 0; i + 1 < card.fields.size(); ++i) {
    const Field& lead = card.fields[i];
    out.cells.push_back(read_cell(deck, findings, lead,
                                  detail::columns(line.text, lead.first, lead.last),
                                  line.columns(lead.first, lead.last)));
  }
  const int width = f.last - f.first + 1;
  const int size = static_cast<int>(std::min<std::size_t>(line.text.size(), line_columns));
  for (int first = f.first; first <= size; first += width) {
    const int last = first + width - 1;
    Cell cell = read_cell(deck, findings, f, detail::columns(line.text, first, last),
                          line.columns(first, last));
    if (!cell.blank()) out.cells.push_back(std::move(cell));
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

DecodedCard decode_line(const Deck& deck, const Block& block, const CardSchema& card,
                        const Line& line, Diagnostics* diagnostics) {
  Findings findings(diagnostics, block);
  DecodedCard out;
  out.schema = &card;
  out.line = line;
  if (!line.valid()) return out;
  if (findings.on()) check_line(findings, line);
  if (has_comma(card, line)) {
    out.free_format = true;
    std::size_t next = 0;
    const auto cells = split_free(line);
    const bool list = card.repeat == Repeat::ids;
    for (std::size_t i = 0; i < card.fields.size() || (list && next < cells.size()); ++i) {
      const Field& f = card.fields[std::min(i, card.fields.size() - 1)];
      if (!f.in_version(block.version)) continue;
      const auto [text, span] = next < cells.size()
                                    ? cells[next]
                                    : std::pair{std::string_view(), line.columns(101, 101)};
      ++next;
      out.cells.push_back(read_cell(deck, findings, f, text, span));
    }
    return out;
  }
  if (card.repeat == Repeat::ids) {
    read_ids(deck, findings, card, line, out);
    return out;
  }
  if (findings.on()) check_gaps(findings, card, block.version, line);
  for (const Field& f : card.fields) {
    if (!f.in_version(block.version)) continue;
    out.cells.push_back(read_cell(deck, findings, f, detail::columns(line.text, f.first, f.last),
                                  line.columns(f.first, f.last)));
  }
  return out;
}

DecodedBlock decode(const Deck& deck, const Block& block, Diagnostics* diagnostics) {
  DecodedBlock out;
  out.block = &block;
  const Schema* schema = block.schema;
  if (schema == nullptr || block.opaque) return out;
  Findings findings(diagnostics, block);
  LineCursor cursor(deck.sources, block);
  if (schema->has_title && block.version >= 51) {
    out.title_line = cursor.next();
    out.title = std::string(out.title_line.text.substr(0, line_columns));
  } else {
    out.title = std::string(block.inline_title);
  }
  const auto holds = [&](const CardSchema& card) {
    return card.in_version(block.version) &&
           std::all_of(card.when.begin(), card.when.end(), [&](const Condition& c) {
             return c.holds(out.integer(c.field));
           });
  };
  bool repeating = false;
  for (std::size_t i = 0; i < schema->cards.size() && !repeating; ++i) {
    const CardSchema& card = schema->cards[i];
    if (!holds(card)) continue;
    if (card.repeat == Repeat::once) {
      const Line line = cursor.next();
      if (!line.valid() && card.optional) continue;
      if (!line.valid() && findings.on()) {
        std::string why;
        for (const Condition& c : card.when) {
          const Cell* cause = out.find(c.field);
          why += " (present because " + c.field + " = " +
                 std::to_string(cause ? cause->integer : 0) + ")";
        }
        if (auto* d = findings.report(
                "DK029", Severity::error, block.header_span,
                std::string(block.keyword) + " ends before its line '" + card.name + "'" + why,
                "it takes every cell of the line for 0 and goes on",
                "add the line; blanks are enough where defaults are wanted", 100217))
          for (const Condition& c : card.when)
            if (const Cell* cause = out.find(c.field))
              d->notes.emplace_back(cause->span, c.field + " asks for the line");
      }
      out.cards.push_back(decode_line(deck, block, card, line, diagnostics));
      continue;
    }
    repeating = true;
    std::size_t first = i;
    std::size_t count = 1;
    if (card.repeat == Repeat::group) {
      count = 0;
      while (first + count < schema->cards.size() &&
             schema->cards[first + count].repeat == Repeat::group)
        ++count;
    }
    for (std::size_t k = 0;; k = (k + 1) % count) {
      const CardSchema& member = schema->cards[first + k];
      if (!member.in_version(block.version)) continue;
      if (!member.when.empty() && k > 0) {
        // Conditions inside a group look at the cells of the same round.
        bool all = true;
        for (const Condition& c : member.when) {
          std::int64_t value = 0;
          for (std::size_t back = out.cards.size(); back-- > 0;)
            for (const Cell& cell : out.cards[back].cells)
              if (cell.field->name == c.field) {
                value = cell.integer;
                back = 0;
                break;
              }
          all = all && c.holds(value);
        }
        if (!all) continue;
      }
      const Line line = cursor.next();
      if (!line.valid()) break;
      out.cards.push_back(decode_line(deck, block, member, line, diagnostics));
    }
  }
  if (repeating) return out;
  for (Line line = cursor.next(); line.valid(); line = cursor.next()) out.extra.push_back(line);
  if (!findings.on() || schema->opaque_tail || schema->cards.empty()) return out;
  for (const Line& line : out.extra) {
    if (trim(line.text).empty()) continue;
    findings.report("DK030", Severity::warning, line.whole(),
                    std::string(block.keyword) + " is complete; this line is one too many",
                    "it ignores the line",
                    "check the flags that ask for optional lines, then delete the line or set the "
                    "flag",
                    100219);
  }
  return out;
}

Dimension dimension_of(const Field& field, const DecodedBlock& block) {
  for (const auto& [when, dimension] : field.dimension_when)
    if (std::all_of(when.begin(), when.end(),
                    [&](const Condition& c) { return c.holds(block.integer(c.field)); }))
      return dimension;
  return field.dimension;
}

double working_value(const Deck& deck, const DecodedBlock& block, const Cell& cell) {
  const UnitSystem* units = deck.units_of(*block.block);
  if (units == nullptr || cell.field == nullptr) return cell.real;
  return cell.real *
         conversion_factor(*units, deck.begin.working, dimension_of(*cell.field, block));
}

}  // namespace deck
