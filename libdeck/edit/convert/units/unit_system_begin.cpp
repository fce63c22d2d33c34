// The places that name units, and the parameters that stand for converted values.
#include <array>
#include <cctype>

#include "deck/text/number.hpp"
#include "edit/convert/units/unit_system_state.hpp"
#include "keyword/shared/reader.hpp"
#include "text/shared/columns.hpp"
#include "text/shared/edits.hpp"

namespace deck::detail {
namespace {

/// The three codes of a unit system as a deck writes them.
std::array<std::string, 3> codes(const UnitSystem& u) {
  const auto text = [](const std::string& code, double factor) {
    if (!code.empty()) return code;
    const auto number = format_real(factor, 20);
    return number ? number->text : std::string("1.");
  };
  return {text(u.mass_code, u.mass), text(u.length_code, u.length), text(u.time_code, u.time)};
}

bool readable(const UnitSystem& u) {
  return (u.mass_code.empty() || unit_factor(u.mass_code, 'g')) &&
         (u.length_code.empty() || unit_factor(u.length_code, 'm')) &&
         (u.time_code.empty() || unit_factor(u.time_code, 's'));
}

bool refuse(UnitConversion& c, const std::string& why) {
  const Span at = c.deck.begin.span;
  c.out.refusals.push_back(
      (at.valid() ? c.deck.sources.where(at) : c.deck.sources[0].path() + ":1:1") + ": " + why);
  return false;
}

void write_codes(CellWriter& cells, const Line& line, const UnitSystem& units) {
  const auto text = codes(units);
  for (int i = 0; i < 3; ++i)
    cells.set(line.whole(), 20 * i + 1, 20 * i + 20, text[static_cast<std::size_t>(i)]);
}

/// Versions up to 90 name the units in headers: /UNIT/LENGTH/mm.
bool convert_headers(UnitConversion& c) {
  const auto text = codes(c.target);
  constexpr std::string_view keywords[3] = {"/UNIT/MASS/", "/UNIT/LENGTH/", "/UNIT/TIME/"};
  const double from[3] = {c.deck.begin.input.mass, c.deck.begin.input.length,
                          c.deck.begin.input.time};
  const double to[3] = {c.target.mass, c.target.length, c.target.time};
  for (std::size_t i = 0; i < 3; ++i) {
    bool found = false;
    for (const Block& b : c.deck.blocks) {
      if (!b.header.starts_with(keywords[i])) continue;
      found = true;
      const std::string_view code = trim(b.header.substr(keywords[i].size()));
      const auto offset = static_cast<std::uint64_t>(code.data() - b.header.data());
      c.out.edits.push_back({Span{b.header_span.file, static_cast<std::uint32_t>(code.size()),
                                  b.header_span.offset + offset},
                             text[i]});
    }
    if (!found && from[i] != to[i])
      return refuse(c, "the deck has no " + std::string(keywords[i]) +
                           " block to name the new unit in; add it");
  }
  return true;
}

bool blank_units(const Line& line) { return trim(columns(line.text, 1, 60)).empty(); }

}  // namespace

bool convert_begin(UnitConversion& c) {
  const Begin& begin = c.deck.begin;
  const SourceSet& sources = c.deck.sources;
  if (!begin.span.valid()) return refuse(c, "no /BEGIN: the units of the deck are not known");
  if (!begin.has_input && !begin.has_working)
    return refuse(c, "/BEGIN names no units: those of the deck are not known");
  if (!readable(begin.input) || !readable(begin.working))
    return refuse(c, "a unit of /BEGIN cannot be read");
  Line lines[4];
  for (const Block& b : c.deck.blocks) {
    if (!(b.header_span == begin.span)) continue;
    LineCursor cursor(sources, b);
    for (Line& line : lines) line = cursor.next();
    break;
  }
  const Line &input = lines[2], &working = lines[3];
  const bool has_input = input.valid() && !blank_units(input);
  const bool has_working = working.valid() && !blank_units(working);
  if (!has_input && !has_working) {
    if (c.options.keep_working && !(begin.working == c.target))
      return refuse(c, "this version names one unit system only; the working units cannot stay");
    return convert_headers(c);
  }
  CellWriter cells(sources);
  if (input.valid()) write_codes(cells, input, c.target);
  if (c.working_changes) {
    if (has_working) write_codes(cells, working, c.target);
  } else if (!has_working) {
    // Blank would mean the new input units.
    if (working.valid()) {
      write_codes(cells, working, begin.working);
    } else {
      const std::string_view bytes = sources[input.file].bytes();
      std::uint64_t end = input.offset + input.text.size();
      while (end < bytes.size() && bytes[end] != '\n') ++end;
      const bool crlf = end > 0 && bytes[end - 1] == '\r';
      if (crlf) --end;
      std::string text = crlf ? "\r\n" : "\n";
      for (const std::string& code : codes(begin.working))
        text.append(20 - std::min<std::size_t>(code.size(), 20), ' ').append(code);
      for (TextEdit& e : cells.finish()) c.out.edits.push_back(std::move(e));
      c.out.edits.push_back({Span{input.file, 0, end}, std::move(text)});
      return true;
    }
  }
  for (TextEdit& e : cells.finish()) c.out.edits.push_back(std::move(e));
  return true;
}

namespace {

/// How often every parameter is named anywhere: in cells, headers, expressions, unread text.
std::map<std::string, std::size_t, std::less<>> count_names(const Deck& deck) {
  std::map<std::string, std::size_t, std::less<>> counts;
  for (std::uint32_t f = 0; f < deck.sources.size(); ++f) {
    const std::string_view bytes = deck.sources[f].bytes();
    for (std::size_t at = bytes.find('&'); at != std::string_view::npos;
         at = bytes.find('&', at + 1)) {
      const auto start = bytes.rfind('\n', at);
      const char first = bytes[start == std::string_view::npos ? 0 : start + 1];
      if (first == '#' || first == '$') continue;
      std::size_t end = at + 1;
      while (end < bytes.size() && name_character(bytes[end])) ++end;
      if (end > at + 1) ++counts[std::string(bytes.substr(at + 1, end - at - 1))];
    }
  }
  // Expressions may leave the & away.
  for (const auto& [name, p] : deck.parameters) {
    const std::string_view e = p.expression;
    for (std::size_t at = 0; at < e.size();) {
      std::size_t end = at;
      while (end < e.size() && name_character(e[end])) ++end;
      if (end > at && (at == 0 || e[at - 1] != '&')) ++counts[std::string(e.substr(at, end - at))];
      at = end + 1;
    }
  }
  return counts;
}

/// The /PARAMETER block that holds this line.
const Block* definition_of(const Deck& deck, const Parameter& p) {
  for (const Block& b : deck.blocks)
    if (b.header.starts_with("/PARAMETER"))
      for (const Piece& piece : b.body)
        if (piece.file == p.span.file && p.span.offset >= piece.begin && p.span.offset < piece.end)
          return &b;
  return nullptr;
}

}  // namespace

namespace {

/// The parameter stays what it is, and the cells that use it get their numbers in the new units.
void write_numbers(UnitConversion& c, const std::string& name,
                   const std::vector<UnitConversion::ParameterUse>& uses, const std::string& why) {
  for (const auto& use : uses) {
    const UnitConversion::OpenShare share(c, *use.block);
    const std::string old(c.deck.sources.text(use.span));
    const int width = use.free_format ? 24 : use.last - use.first + 1;
    const auto number = format_real(use.value, 24);
    const auto text = number ? scale_text(number->text + (number->text.ends_with('.') ? "0" : ""),
                                          width, c.factors.of(use.dimension))
                             : std::nullopt;
    if (!text || !c.put(use, text->text)) {
      c.undecided(*use.block, use.span, use.field,
                  "parameter &" + name + " " + why + ", and the number itself has no room here; " +
                      "give this dimension a parameter of its own");
      continue;
    }
    ++c.changed_cells;
    LossEntry entry =
        loss_entry(c.deck, text->exact ? Loss::kept : Loss::approximated, *use.block, use.span);
    entry.field = use.field;
    entry.old_text = std::string(trim(old));
    entry.new_text = text->text;
    entry.note = "parameter &" + name + " " + why + "; the number was written instead";
    c.out.losses.push_back(std::move(entry));
  }
}

}  // namespace

void convert_parameters(UnitConversion& c) {
  if (c.parameter_uses.empty()) return;
  const auto counts = count_names(c.deck);
  for (const auto& [name, uses] : c.parameter_uses) {
    const auto [first, last] = c.deck.parameters.equal_range(name);
    std::string why;
    for (auto it = first; it != last; ++it)
      if (!it->second.valid) why = "has no usable value";
    if (first == last) why = "is not defined";
    if (!why.empty()) {
      for (const auto& use : uses)
        c.undecided(*use.block, use.span, use.field, "parameter &" + name + " " + why);
      continue;
    }
    for (const auto& use : uses)
      if (!(use.dimension == uses[0].dimension)) why = "is used with several dimensions";
    const auto count = counts.find(name);
    if (why.empty() && (count == counts.end() || count->second != uses.size()))
      why = "is used in other places too, where its value must not change";
    for (auto it = first; it != last && why.empty(); ++it)
      if (it->second.type != Parameter::Type::real || !it->second.expression.empty())
        why = "is not a plain real number";
    for (auto it = first; it != last && why.empty(); ++it)
      if (c.deck.sources.text(it->second.span).find(',') != std::string_view::npos)
        why = "stands in a line in free format";
    if (!why.empty()) {
      write_numbers(c, name, uses, why);
      continue;
    }
    const UnitFactor factor = c.factors.of(uses[0].dimension);
    for (auto it = first; it != last; ++it) {
      const Parameter& p = it->second;
      const Block* block = definition_of(c.deck, p);
      if (block == nullptr) continue;
      const Line line{c.deck.sources.text(p.span), p.span.file, p.span.offset};
      c.convert_fixed(*block, line, 11, 30, "value", factor);
    }
  }
}

}  // namespace deck::detail
