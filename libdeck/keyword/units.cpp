// Unit systems: codes as factors to kilogram, metre, second; /BEGIN (run name, version, two unit
// systems); the lines of /UNIT.
#include <algorithm>
#include <cstdlib>
#include <string>

#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "keyword/shared/decode_parts.hpp"
#include "keyword/shared/reader.hpp"

namespace deck {
namespace {

struct Prefix {
  std::string_view code;
  int power;
};
// Longest first, so that "mu" is not read as "m" and "u".
constexpr Prefix prefixes[] = {{"mu", -6},   {"\xc2\xb5", -6}, {"da", 1},  {"y", -24}, {"z", -21},
                               {"a", -18},   {"f", -15},       {"p", -12}, {"n", -9},  {"u", -6},
                               {"\xb5", -6}, {"m", -3},        {"c", -2},  {"d", -1},  {"h", 2},
                               {"k", 3},     {"K", 3},         {"M", 6},   {"G", 9},   {"T", 12},
                               {"P", 15},    {"E", 18},        {"Z", 21},  {"Y", 24},  {"", 0}};

/// factor^power by multiplication, exact for small integers.
double integer_power(double base, int power) {
  double result = 1;
  for (int i = 0; i < std::abs(power); ++i) result *= base;
  return power < 0 ? 1 / result : result;
}

}  // namespace

std::optional<double> unit_factor(std::string_view code, char base) {
  code = detail::trim(code);
  if (code.empty()) return std::nullopt;
  const RealCell number = read_real(code);
  if (number.status == NumberStatus::ok || number.status == NumberStatus::implicit_exponent)
    return number.value > 0 ? std::optional(number.value) : std::nullopt;
  if (code.back() != base) return std::nullopt;
  const std::string_view prefix = code.substr(0, code.size() - 1);
  // Grams are relative to the kilogram.
  const int offset = base == 'g' ? -3 : 0;
  for (const Prefix& p : prefixes) {
    if (p.code != prefix) continue;
    // Correctly rounded, so that "mm" and "0.001" are equal.
    return read_real("1e" + std::to_string(p.power + offset)).value;
  }
  return std::nullopt;
}

double conversion_factor(const UnitSystem& from, const UnitSystem& to, const Dimension& d) {
  if (from == to) return 1;
  return integer_power(from.mass / to.mass, d.mass) *
         integer_power(from.length / to.length, d.length) *
         integer_power(from.time / to.time, d.time);
}

namespace detail {
namespace {

/// The first four data lines after /BEGIN, if they exist.
void begin_lines(const Deck& deck, std::uint32_t file, std::uint64_t pos, Line (&lines)[4]) {
  const std::string_view bytes = deck.sources[file].bytes();
  for (int have = 0; have < 4 && pos < bytes.size();) {
    const auto nl = std::min(bytes.find('\n', pos), bytes.size());
    const std::string_view text = bytes.substr(pos, std::min<std::size_t>(nl - pos, 100));
    const bool comment = text.starts_with('#') || text.starts_with('$');
    if (!comment && trim(text).starts_with('/')) break;
    if (!comment) lines[have++] = {trim_right(text), file, pos};
    pos = nl + 1;
  }
}

/// One cell of a line of units.
struct UnitCell {
  std::string UnitSystem::*code;
  double UnitSystem::*factor;
  const char* name;
  char base;
};
constexpr UnitCell unit_cells[] = {{&UnitSystem::mass_code, &UnitSystem::mass, "mass", 'g'},
                                   {&UnitSystem::length_code, &UnitSystem::length, "length", 'm'},
                                   {&UnitSystem::time_code, &UnitSystem::time, "time", 's'}};

/// Copies the units of the other line into blank cells (DK015) or a blank line. `which` names the
/// line in messages; `begin` is the header.
void fill_blank_units(Deck& deck, Span begin, UnitSystem& units, const UnitSystem& other,
                      const char* which) {
  for (const UnitCell& cell : unit_cells) {
    if (!(units.*cell.code).empty()) continue;
    const std::string what = std::string("the ") + cell.name + " unit of the " + which;
    if ((other.*cell.code).empty()) {
      report(deck, RuleId::DK015, begin,
             what + " is blank or 0 in both systems; deck takes it as 1 in kg, m, s",
             {.severity = Severity::warning,
              .message = 0,
              .solver = "it continues; the unit that it uses is not known"});
      continue;
    }
    units.*cell.code = other.*cell.code;
    units.*cell.factor = other.*cell.factor;
    report(deck, RuleId::DK015, begin,
           what + " is blank or 0; '" + units.*cell.code + "' of the other one is taken",
           {.severity = Severity::warning,
            .message = 0,
            .solver = "it continues with the unit of the other system",
            .fix = "write all three units on both lines"});
  }
}

}  // namespace

bool read_units(Deck& deck, const Line& line, UnitSystem& units, bool blank_is_one) {
  Span spans[3] = {line.columns(1, 20), line.columns(21, 40), line.columns(41, 60)};
  // The lines of /BEGIN always use columns.
  if (blank_is_one && is_free(line)) {
    const FreeCells free = split_free(line);
    for (std::size_t i = 0; i < 3; ++i)
      spans[i] = i < free.size() ? free[i].second : line.columns(101, 101);
  }
  const std::string_view cells[3] = {trim(deck.sources.text(spans[0])),
                                     trim(deck.sources.text(spans[1])),
                                     trim(deck.sources.text(spans[2]))};
  if (cells[0].empty() && cells[1].empty() && cells[2].empty()) return false;
  for (int i = 0; i < 3; ++i) {
    const UnitCell& unit = unit_cells[i];
    units.*unit.code = cells[i];
    if (blank_is_one && cells[i].find_first_not_of("0.+-") == std::string_view::npos) continue;
    if (cells[i].empty()) continue;  // defined by the other system
    const std::string_view word = cells[i].substr(0, cells[i].find_first_of(" \t"));
    const RealCell number = read_real(word);
    if (word == cells[i] && number.status == NumberStatus::ok && number.value == 0) {
      units.*unit.code = {};  // counts as blank
      continue;
    }
    if (const auto factor = unit_factor(cells[i], unit.base)) {
      units.*unit.factor = *factor;
      continue;
    }
    const std::string what = "'" + std::string(cells[i]) + "' is not a " + unit.name + " unit; ";
    if (number.status == NumberStatus::ok && number.value > 0) {
      units.*unit.factor = number.value;
      report(deck, RuleId::DK015, spans[i], what + "it is read as " + std::string(word),
             {.severity = Severity::warning,
              .message = 0,
              .solver = "it reads the number and ignores the rest silently"});
      continue;
    }
    // Densities have no time, stiffness has time squared.
    const bool text =
        number.status != NumberStatus::ok && number.status != NumberStatus::not_finite;
    const bool stops = text || i != 2;
    report(deck, RuleId::DK015, spans[i],
           what + "expected a prefix and '" + unit.base + "', or a positive number",
           {.severity = stops ? Severity::error : Severity::warning,
            .message = text    ? 573
                       : stops ? 683
                               : 0,
            .solver = stops ? "it stops with an error" : "it computes with the number"});
  }
  return true;
}

Begin read_begin(Deck& deck, Span header, std::uint64_t pos) {
  Line lines[4];
  begin_lines(deck, header.file, pos, lines);
  Begin begin;
  begin.span = header;
  begin.run_name = std::string(trim(lines[0].text));
  const std::string_view cell = columns(lines[1].text, 1, 10);
  begin.version_span = lines[1].valid() ? lines[1].columns(1, 10) : header;
  const IntegerCell number = read_integer(cell);
  begin.version_written = static_cast<int>(std::clamp<std::int64_t>(number.value, 0, 99999));
  begin.version_known = is_known_version(begin.version_written);
  begin.version_unread =
      begin.version_written == 41 || begin.version_written == 42 || begin.version_written == 44;
  begin.has_input = read_units(deck, lines[2], begin.input);
  begin.has_working = read_units(deck, lines[3], begin.working);
  if (begin.has_input) fill_blank_units(deck, header, begin.input, begin.working, "input system");
  if (begin.has_working)
    fill_blank_units(deck, header, begin.working, begin.input, "working system");
  if (begin.version_unread)
    report(deck, RuleId::DK050, begin.version_span,
           "input version " + std::to_string(begin.version_written) +
               " has cells of eight columns, which deck does not read",
           {.severity = Severity::error});
  else if (!begin.version_known)
    report(deck, RuleId::DK003, begin.version_span,
           "input version " + std::string(trim(cell).empty() ? "(blank)" : trim(cell)) +
               " is unknown; the columns of version " + std::to_string(newest_version) +
               " are assumed");
  return begin;
}

}  // namespace detail

}  // namespace deck
