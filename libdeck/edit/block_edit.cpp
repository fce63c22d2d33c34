// Finds the cell of a field, formats a value into it, extends lines or adds them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/shared/words.hpp"
#include "deck/edit.hpp"
#include "deck/text.hpp"
#include "edit/cells.hpp"
#include "keyword/shared/decode_parts.hpp"
#include "keyword/shared/line_check.hpp"
#include "keyword/shared/place.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {
namespace {

/// "Igap is 2 or 3", "Ifric is not 0".
std::string words_of(const Condition& c) {
  const auto list = [](const std::vector<std::int64_t>& values) {
    std::string out;
    for (std::size_t i = 0; i < values.size(); ++i)
      out += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + std::to_string(values[i]);
    return out;
  };
  std::vector<std::string> parts;
  if (!c.words.empty()) parts.push_back("one of its words");
  if (!c.in.empty()) parts.push_back(list(c.in));
  if (!c.not_in.empty()) parts.push_back("not " + list(c.not_in));
  if (c.min) parts.push_back("at least " + std::to_string(*c.min));
  if (c.max) parts.push_back("at most " + std::to_string(*c.max));
  std::string out = c.field + " is ";
  for (std::size_t i = 0; i < parts.size(); ++i) out += (i == 0 ? "" : " and ") + parts[i];
  return out;
}

/// True if other cells or lines of the keyword depend on this field.
bool decides_layout(const Schema& schema, std::string_view name) {
  const auto in = [&](const std::vector<Condition>& when) {
    return std::any_of(when.begin(), when.end(),
                       [&](const Condition& c) { return c.field == name; });
  };
  return std::any_of(schema.cards.begin(), schema.cards.end(), [&](const CardSchema& card) {
    return card.count == name || in(card.when) ||
           std::any_of(card.fields.begin(), card.fields.end(), [&](const Field& f) {
             return in(f.when) || in(f.solver_when) ||
                    std::any_of(f.dimension_when.begin(), f.dimension_when.end(),
                                [&](const auto& d) { return in(d.first); });
           });
  });
}

/// One call of set_value().
class ValueSetter {
 public:
  ValueSetter(const Deck& deck, const Block& block, std::string_view field)
      : deck_(deck), block_(block), name_(field), decoded_(decode(deck, block)) {}

  Result<BlockEdit> run(const CellValue& value, int occurrence, CellWriter& cells, bool& absent) {
    for (const DecodedCard& card : decoded_.cards)
      for (const Cell& cell : card.cells) {
        if (card.missing() || cell.field->name != name_ || occurrence-- > 0) continue;
        return there(card, cell, value, cells);
      }
    absent = true;
    if (occurrence > 0 ||
        (occurrence == 0 && decoded_.find(name_) != nullptr && !line_is_missing()))
      return bad({}, "the block has fewer cells of that name");
    return add_lines(value);
  }

 private:
  Error bad(Span place, const std::string& why) const {
    return block_error(deck_, block_, place, name_, why);
  }

  bool line_is_missing() const {
    return std::any_of(decoded_.cards.begin(), decoded_.cards.end(), [&](const DecodedCard& card) {
      return card.missing() && std::any_of(card.cells.begin(), card.cells.end(),
                                           [&](const Cell& c) { return c.field->name == name_; });
    });
  }

  Result<BlockEdit> there(const DecodedCard& card, const Cell& cell, const CellValue& value,
                          CellWriter& cells) {
    const Field& f = *cell.field;
    const CellColumns at =
        card.free_format ? CellColumns{1, widest_number} : columns_of(card, cell);
    BlockEdit out;
    auto text = format(f, &card, cell.span, value, at.last - at.first + 1, out);
    if (!text) return text.error();
    out.read_again = decides_layout(*block_.schema, f.name);
    if (same(card, cell, value, *text)) *text = std::string(cell.text);
    if (!card.free_format) {
      // A cell behind the end of its line is blank.
      if (text->empty() && card.line.text.size() < static_cast<std::size_t>(at.first)) return out;
      if (f.type == FieldType::text)
        text->resize(static_cast<std::size_t>(at.last - at.first + 1), ' ');
      cells.set(card.line.whole(), at.first, at.last, *text);
      return out;
    }
    if (*text == cell.text) return out;
    out.read_again = true;
    const auto line = free_line(card, cell, *text);
    if (!line)
      return bad(cell.span,
                 "'" + *text + "' has no room on this line in free format (100 columns)");
    LineEdits(deck_.sources).change(card.line, *line, out.edits);
    return out;
  }

  /// True if the cell has this value in another spelling.
  bool same(const DecodedCard& card, const Cell& cell, const CellValue& value,
            const std::string& text) const {
    if (cell.parameter || cell.blank() || std::holds_alternative<std::string>(value)) return false;
    if (cell.status != NumberStatus::ok && cell.status != NumberStatus::implicit_exponent)
      return false;
    const Field& f = *cell.field;
    if (f.type != FieldType::real) return read_integer(text).value == cell.integer;
    return number_of(value) == cell.real * factor_of(f, &card) ||
           read_real(text).value == cell.real;
  }

  static double number_of(const CellValue& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
    return std::get<double>(value);
  }

  /// Line in free format with another text in a cell, and commas added up to it; nullopt if it
  /// needs more than 100 columns.
  std::optional<std::string> free_line(const DecodedCard& card, const Cell& cell,
                                       const std::string& text) const {
    const std::string_view old = card.line.text;
    const auto index = static_cast<std::size_t>(&cell - card.cells.data());
    const auto reads = [&](const std::string& line) {
      const std::function<std::int64_t(std::string_view)> value = [&](std::string_view field) {
        return decoded_.integer(field);
      };
      const DecodedCard again =
          decode_in_context(deck_, block_, *card.schema, {line, card.line.file, card.line.offset},
                            nullptr, {&value, 0});
      if (!again.free_format || again.cells.size() < card.cells.size()) return false;
      for (std::size_t i = 0; i < card.cells.size(); ++i)
        if (again.cells[i].text != (i == index ? std::string_view(text) : card.cells[i].text))
          return false;
      return true;
    };
    const auto fits = [&](const std::string& line) {
      return line.size() <= static_cast<std::size_t>(line_columns) && reads(line);
    };
    if (cell.span.valid() && cell.span.offset >= card.line.offset &&
        cell.span.offset + cell.span.length <= card.line.offset + old.size()) {
      std::string line(old);
      line.replace(cell.span.offset - card.line.offset, cell.span.length, text);
      if (fits(line)) return line;
    }
    if (text.empty()) return std::string(old);
    std::string line(trim_right(old));
    for (std::size_t commas = 0; commas <= card.cells.size(); ++commas, line += ',')
      if (fits(line + text)) return line + text;
    return std::nullopt;
  }

  double factor_of(const Field& f, const DecodedCard* card) const {
    Cell one;
    one.field = &f;
    one.real = 1;
    return working_value(deck_, decoded_, one, card);
  }

  Result<std::string> format(const Field& f, const DecodedCard* card, Span place,
                             const CellValue& value, int width, BlockEdit& out) const {
    const auto bad_value = [&](const std::string& why) { return bad(place, why); };
    if (const auto* text = std::get_if<std::string>(&value)) return checked(f, place, *text, width);
    if (f.type == FieldType::text) return bad_value("expected a text");
    const double number = number_of(value);
    if (!std::isfinite(number)) return bad_value("infinity and not-a-number are no input");
    const bool listed = f.values.empty() || number != std::floor(number) ||
                        std::count(f.values.begin(), f.values.end(), number) > 0;
    if (number != 0 && (!listed || (f.min && number < *f.min) || (f.max && number > *f.max)))
      return bad_value(shortest(number) + " is no legal value (deck explain " + f.name + ")");
    if (f.type != FieldType::real) {
      const bool flag = f.type == FieldType::flag;
      const double most = flag ? 1 : static_cast<double>(largest_id);
      if (number != std::floor(number) || number > most || number < (flag ? 0 : -most))
        return bad_value(flag ? "expected 0 or 1"
                              : "expected a whole number of 32 bits, not " + shortest(number));
      auto text = format_integer(static_cast<std::int64_t>(number), width);
      if (!text)
        return bad_value("'" + std::to_string(static_cast<std::int64_t>(number)) +
                         "' is longer than the " + std::to_string(width) + " columns");
      return *text;
    }
    if (deck_.units_of(block_) == nullptr) return bad_value("its unit system is not defined");
    const UnitSystem& units = *deck_.units_of(block_);
    if (!f.dimension_known && !(units == deck_.begin.working))
      return bad_value("its dimension is not known: give the text in the units of the card");
    const double factor = factor_of(f, card);
    // Keep one column blank if it costs no digit: readers separate numbers by blanks.
    auto text = cell_text(number, factor, width - 1);
    if (!text || !text->exact) text = cell_text(number, factor, width);
    if (!text)
      return bad_value(shortest(number / factor) + " does not fit its " + std::to_string(width) +
                       " columns");
    const double back = read_real(text->text).value * factor;
    if (back != number && !text->exact && std::abs(back - number) > 0)
      note(place, f, number, back, width, out);
    return text->text;
  }

  void note(Span place, const Field& f, double asked, double back, int width,
            BlockEdit& out) const {
    // Unit conversion may change the last digit of a double: no loss of the cell.
    if (std::nextafter(asked, back) == back) return;
    out.note = block_error(deck_, block_, place, f.name,
                           shortest(asked) + " becomes " + shortest(back) + ": " +
                               std::to_string(width) + " columns hold no more digits")
                   .message;
  }

  /// The given text, if it fits and the solver reads it as the type of the field.
  Result<std::string> checked(const Field& f, Span place, const std::string& given,
                              int width) const {
    const std::string text(trim(given));
    const std::string shown = "'" + text.substr(0, 60) + "'";
    if (text.size() > static_cast<std::size_t>(width))
      return bad(place, shown + " is longer than the " + std::to_string(width) + " columns");
    if (text.find_first_of("\r\n") != text.npos) return bad(place, "expected one line");
    if (text.empty() || f.type == FieldType::text) return text;
    if (text.starts_with('&') || text.starts_with("-&")) {
      const std::string_view name = std::string_view(text).substr(text.find('&') + 1);
      const std::uint32_t file = place.valid() ? place.file : block_.header_span.file;
      const Parameter* p = deck_.find_parameter(name, file);
      if (p == nullptr || p->type == Parameter::Type::text)
        return bad(place, "there is no parameter with a number called " + std::string(name));
      return text;
    }
    if (f.type == FieldType::flag)
      return text == "0" || text == "1" ? Result<std::string>(text)
                                        : bad(place, "expected 0 or 1, not " + shown);
    const bool real = f.type == FieldType::real;
    const NumberStatus status = real ? read_real(text).status : read_integer(text).status;
    if (status == NumberStatus::ok || (real && status == NumberStatus::implicit_exponent))
      return text;
    return bad(place, std::string(real ? "expected a number" : "expected a whole number") +
                          ", not " + shown);
  }

  /// Reason why the block has no such cell.
  Error no_cell() const {
    const Field* other = nullptr;
    const std::vector<Condition>* asks = nullptr;
    std::vector<std::string> known;
    for (const CardSchema& card : block_.schema->cards)
      for (const Field& f : card.fields) {
        const bool here = card.in_version(block_.version) && f.in_version(block_.version);
        if (here) known.push_back(f.name);
        if (f.name != name_) continue;
        if (!here) {
          other = &f;
          continue;
        }
        asks = !is_met(card.when, decoded_) ? &card.when : &f.when;
      }
    if (asks != nullptr && !asks->empty()) {
      std::string why;
      for (const Condition& c : *asks)
        if (!is_met({c}, decoded_)) why += (why.empty() ? "" : " and ") + words_of(c);
      return bad({}, "the card has this cell only if " + why);
    }
    const std::string version = "input version " + std::to_string(block_.version);
    if (other != nullptr) return bad({}, version + " has no such cell");
    const std::string close = closest_word(name_, known);
    return bad({}, std::string(block_.keyword) + " has no such field" +
                       (close.empty() ? "" : "; did you mean " + close + "?"));
  }

  /// Adds the missing line of the field and the lines before it.
  Result<BlockEdit> add_lines(const CellValue& value) {
    const std::vector<CardSchema>& cards = block_.schema->cards;
    const auto stands = [&](const CardSchema& card) {
      return card.in_version(block_.version) && is_met(card.when, decoded_) &&
             (card.blank() ||
              std::any_of(card.fields.begin(), card.fields.end(), [&](const Field& f) {
                return f.in_version(block_.version) && is_met(f.when, decoded_);
              }));
    };
    std::size_t next = 0;
    Span anchor = decoded_.title_line.valid() ? decoded_.title_line.whole() : block_.header_span;
    for (const DecodedCard& card : decoded_.cards)
      if (!card.missing()) {
        next = static_cast<std::size_t>(card.schema - cards.data()) + 1;
        anchor = card.line.whole();
      }
    const Field* field = nullptr;
    std::size_t target = next;
    for (; target < cards.size() && field == nullptr; ++target)
      if (stands(cards[target]))
        for (const Field& f : cards[target].fields)
          if (f.name == name_ && f.in_version(block_.version) && is_met(f.when, decoded_))
            field = &f;
    if (field == nullptr) return no_cell();
    if (!decoded_.extra.empty())
      return bad(decoded_.extra.front().whole(),
                 "its line is missing, and this line is in its place");
    BlockEdit out;
    out.read_again = true;
    auto text = format(*field, nullptr, {}, value, field->last - field->first + 1, out);
    if (!text) return text.error();
    if (text->empty()) return out;
    LineEdits lines(deck_.sources);
    if (lacks_title(decoded_)) lines.insert_after(anchor, "");
    for (; next < target; ++next) {
      if (!stands(cards[next])) continue;
      if (cards[next].repeat != Repeat::once)
        return bad({}, "its line is missing, after lines that repeat: add the line by hand");
      std::string line;
      if (next + 1 == target) {
        if (field->type == FieldType::text)
          text->resize(static_cast<std::size_t>(field->last - field->first + 1), ' ');
        CellWriter::put(line, field->first, field->last, *text);
        line.resize(trim_right(line).size());
      }
      lines.insert_after(anchor, line);
    }
    lines.append_to(out.edits);
    return out;
  }

  const Deck& deck_;
  const Block& block_;
  const std::string name_;
  const DecodedBlock decoded_;
};

}  // namespace

Error block_error(const Deck& deck, const Block& block, Span place, std::string_view field,
                  const std::string& why) {
  std::string text = deck.sources.where(place.valid() ? place : block.header_span) + ": " +
                     std::string(block.keyword);
  if (block.id.present) text += "/" + std::to_string(block.id.value);
  if (!field.empty()) text += " " + std::string(field);
  return {Error::Code::config, text + ": " + why};
}

Result<BlockEdit> set_value(const Deck& deck, const Block& block, std::string_view field,
                            const CellValue& value, int occurrence, CellWriter& cells,
                            bool& absent) {
  absent = false;
  if (block.schema == nullptr)
    return block_error(deck, block, {}, field, "no schema describes this keyword");
  if (block.opaque) return block_error(deck, block, {}, field, "the block is encrypted");
  if (block.schema->bulk)
    return block_error(deck, block, {}, field,
                       "lines of nodes and elements are no fields; move_node moves a node");
  return ValueSetter(deck, block, field).run(value, occurrence, cells, absent);
}

Result<std::vector<TextEdit>> erase_block(const Deck& deck, const Block& block) {
  if (std::any_of(block.body.begin(), block.body.end(),
                  [&](const FilePiece& piece) { return piece.file != block.header_span.file; }))
    return block_error(deck, block, {}, {}, "lines of it are in an included file");
  const LineEdits lines(deck.sources);
  const auto line_of = [&](const Span& span) {
    const Source& source = deck.sources[span.file];
    Line line;
    line.text = source.line_at(span.offset);
    line.file = span.file;
    line.offset = static_cast<std::uint64_t>(line.text.data() - source.bytes().data());
    return line;
  };
  std::vector<TextEdit> out;
  lines.remove(line_of(block.header_span), out);
  std::size_t kept = out.size();
  LineCursor cursor(deck.sources, block);
  for (Line line = cursor.next_physical(); line.valid(); line = cursor.next_physical()) {
    if (line.text.starts_with("#include")) break;
    lines.remove(line, out);
    if (!line.text.starts_with('#') && !line.text.starts_with('$')) kept = out.size();
  }
  out.resize(kept);
  return out;
}

std::vector<TextEdit> insert_blocks(const Deck& deck, std::string_view blocks) {
  const Span end = end_of_main(deck);
  std::vector<TextEdit> out;
  LineEdits lines(deck.sources);
  for (const std::string_view line : parts_of(blocks, '\n'))
    lines.insert_after(end, std::string(trim_right(line)));
  lines.append_to(out);
  return out;
}

}  // namespace deck::detail
