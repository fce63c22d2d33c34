// Converts a deck to other units: names of units, blocks, functions, parameters, notes, and times
// of Engine files.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/shared/words.hpp"
#include "deck/text.hpp"
#include "edit/convert/units/unit_system.hpp"
#include "keyword/shared/engine_layout.hpp"
#include "text/shared/columns.hpp"

namespace deck {
namespace detail {
namespace {

/// Three unit codes as written in decks.
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

/// Versions up to 90 have units in headers: /UNIT/LENGTH/mm.
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
      c.out.edits.push_back({span_in_header(b, code), text[i]});
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
      std::string text;
      int column = 1;
      for (const std::string& code : codes(begin.working)) {
        CellWriter::put(text, column, column + 19, code);
        column += 20;
      }
      LineEdits added(sources);
      added.insert_after(input.whole(), text);
      added.append_to(c.out.edits);
    }
  }
  for (TextEdit& e : cells.release_edits()) c.out.edits.push_back(std::move(e));
  return true;
}

}  // namespace detail

using detail::UnitConversion;
using detail::UnitFactor;

namespace {

constexpr std::string_view base_names[] = {"mass", "length", "time"};

void add_notes(UnitConversion& c) {
  const auto from = detail::codes(c.deck.begin.input), to = detail::codes(c.target);
  const UnitFactor factors[] = {c.factors.mass(), c.factors.length(), c.factors.time()};
  auto& notes = c.out.notes;
  for (std::size_t i = 0; i < 3; ++i)
    notes.push_back(std::string(base_names[i]) + " " + from[i] + " -> " + to[i] + ": factor " +
                    factors[i].text());
  std::map<std::string, std::string> derived;
  for (const auto& [exponents, factor] : c.used_factors) {
    std::string name;
    for (std::size_t i = 0; i < 3; ++i) {
      if (exponents[i] == 0) continue;
      name += (name.empty() ? "" : " ") + std::string(base_names[i]);
      if (exponents[i] != 1) name += "^" + std::to_string(exponents[i]);
    }
    if (std::find(std::begin(base_names), std::end(base_names), name) == std::end(base_names))
      derived.emplace(name, factor.text());
  }
  for (const auto& [name, factor] : derived) notes.push_back(name + ": factor " + factor);
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
  for (int i = 0; i < 3; ++i) {
    const auto comma = i < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos)
      return Error{Error::Code::config, "expected mass,length,time, for example kg,mm,ms"};
    const std::string_view code = detail::trim(text.substr(0, comma));
    const auto factor = unit_factor(code, bases[i]);
    if (!factor || code.size() > 20)
      return Error{Error::Code::config, "'" + std::string(code.substr(0, 40)) + "' is not a " +
                                            std::string(base_names[i]) +
                                            " unit; expected a prefix and '" + bases[i] +
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
  detail::convert_blocks(c);
  detail::convert_functions(c);
  detail::convert_parameters(c);
  c.leave_blocks();
  for (std::string& why : detail::contradicting_copies(context.deck().sources, c.out.edits))
    c.out.refusals.push_back(std::move(why));
  add_notes(c);
  if (!c.out.refusals.empty()) c.out.edits.clear();
  return std::move(c.out);
}

// ---- times of Engine files ---------------------------------------------------------------------

namespace {

class EngineConverter {
 public:
  EngineConverter(const Deck& deck, const UnitSystem& target, bool accept, Rewrite& out)
      : deck_(deck), factors_(deck.begin.working, target), accept_(accept), out_(out) {}

  void convert(const EngineFile& file) {
    converted_ = 0;
    for (const EngineBlock& block : file.blocks)
      if (!block.lines.empty()) convert(block);
    LossEntry entry = entry_at(Loss::kept, Span{file.file, 0, 0});
    entry.note = fmt::format("Engine file: {} converted", count(converted_, "number", "numbers"));
    out_.losses.push_back(std::move(entry));
  }

 private:
  void convert(const EngineBlock& block) {
    const std::optional<EngineLayout> layout = engine_layout(block);
    if (!layout) return undecided(block, block.header, "the cells of this keyword are not known");
    const std::size_t lines = layout->list ? !layout->cells.empty() : block.lines.size();
    for (std::size_t i = 0; i < lines; ++i) {
      const std::vector<Span> cells = engine_cells(deck_.sources, block.lines[i]);
      for (std::size_t k = 0; k < cells.size(); ++k) {
        if (i > 0 || k >= layout->cells.size())
          return undecided(block, cells[k], "this value of the keyword is not known");
        convert(block, cells[k], layout->cells[k]);
      }
    }
  }

  void convert(const EngineBlock& block, const Span& cell, EngineCell what) {
    if (what == EngineCell::plain) return;
    const std::string_view text = deck_.sources.text(cell);
    const RealCell value = read_real(text);
    if (value.status == NumberStatus::ok && value.value == 0) return;
    const auto factor = what == EngineCell::speed ? factors_.of({0, 1, -1}) : factors_.time();
    const auto scaled = detail::scale_text(text, detail::widest_number, factor);
    if (!scaled) return undecided(block, cell, "this is not a plain number");
    out_.edits.push_back({cell, scaled->text});
    ++converted_;
    if (scaled->exact) return;
    LossEntry entry = entry_at(Loss::approximated, cell);
    entry.keyword = std::string(block.keyword);
    entry.old_text = std::string(text);
    entry.new_text = scaled->text;
    entry.note = "no double holds the converted value exactly";
    out_.losses.push_back(std::move(entry));
  }

  void undecided(const EngineBlock& block, const Span& place, const std::string& why) {
    const std::string all = why + ", so it keeps its old units; convert it by hand";
    if (!accept_) {
      out_.refusals.push_back(deck_.sources.where(place) + ": " + std::string(block.keyword) +
                              ": " + why + ", so it cannot be brought to other units");
      return;
    }
    LossEntry entry = entry_at(Loss::undecided, place);
    entry.keyword = std::string(block.keyword);
    entry.note = all;
    out_.losses.push_back(std::move(entry));
  }

  LossEntry entry_at(Loss loss, const Span& place) const {
    LossEntry entry;
    entry.loss = loss;
    entry.file = deck_.sources[place.file].path();
    entry.line = deck_.sources.position(place).line;
    return entry;
  }

  const Deck& deck_;
  const detail::UnitFactors factors_;
  bool accept_;
  Rewrite& out_;
  std::size_t converted_ = 0;
};

}  // namespace

void engine_to_units(const Deck& deck, const EngineFiles& engine, const UnitSystem& target,
                     const UnitsOptions& options, bool accept, Rewrite& out) {
  if (!detail::working_units_change(deck, target, options)) return;
  EngineConverter converter(deck, target, accept, out);
  for (const EngineFile& file : engine.files) converter.convert(file);
  for (const EngineFiles::Unread& file : engine.unread)
    out.refusals.push_back(file.path + ":1:1: the Engine file cannot be read: " + file.why);
  if (!out.refusals.empty()) out.edits.clear();
}

}  // namespace deck
