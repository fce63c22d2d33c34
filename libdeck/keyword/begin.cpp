// The header of a deck, /BEGIN: run name, input version and the two systems of units.
#include <algorithm>

#include "deck/text/number.hpp"
#include "keyword/blank_units.hpp"
#include "keyword/shared/reader.hpp"

namespace deck::detail {
namespace {

/// The first four data lines behind /BEGIN, as far as there are any.
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

}  // namespace

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

}  // namespace deck::detail
