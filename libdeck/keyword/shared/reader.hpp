// Reader: walks the include tree of a deck and cuts it into blocks. Private to the keyword stage.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

/// Splits a header line into keyword, ids and schema. `header` is trimmed and starts with '/'.
void parse_header(const SchemaSet& schemas, Block& block);

/// The line buffer of the reference solver, counted from the first slash.
inline constexpr std::size_t header_columns = 202;

/// Bytes [begin, end) of a keyword line. Only blanks stand before `slash`.
struct HeaderPlace {
  std::uint32_t file;
  std::uint64_t begin, slash, end;
};
/// Reports text behind the last column (DK012) and blanks at which the solver reads another keyword
/// (DK052). `header` is the line from the slash on, without its comment.
void check_header_line(Deck& deck, const HeaderPlace& place, std::string_view header);

/// The header without the text that a blank parts from a number in it: "/PART/1" of "/PART/1 left".
/// Text behind a keyword without number makes it another keyword for the solver.
std::string_view without_note(std::string_view header);

/// Adds a finding of reading.
void report(Deck& deck, RuleId rule, Span span, std::string message, Overrides overrides = {});

/// Looks for lint_marker in the bytes of a file up to `end` that were not looked at before.
void note_lint_markers(Deck& deck, std::uint32_t file, std::uint64_t end);
/// The same for all that is left; pages of a mapped file are given back on the way.
void note_lint_markers(Deck& deck, std::uint32_t file);

/// Bytes [begin, end) of a file, cut to a length that a message can show.
inline Span make_span(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
  constexpr std::uint64_t longest = 1 << 20;
  return {file, static_cast<std::uint32_t>(end - begin < longest ? end - begin : longest), begin};
}

/// Errors for a file that is no deck: it holds blanks only; it is UTF-16 or binary data.
Result<void> refuse_empty(const Source& source);
Result<void> refuse_binary(const Source& source);

/// Reads the four lines of the /BEGIN at `header`; they are looked for from `pos` on. Reports an
/// unknown version (DK003) and unreadable units (DK015).
Begin read_begin(Deck& deck, Span header, std::uint64_t pos);

/// Three unit codes in columns 1-20, 21-40, 41-60 (DK015 for unreadable ones). False: all blank.
/// `blank_is_one`: in a /UNIT block a blank or 0 cell means the factor 1.
bool read_units(Deck& deck, const Line& line, UnitSystem& units, bool blank_is_one = false);

/// What the walk through the files leaves for the end.
struct ReaderNotes {
  std::vector<std::size_t> before_begin;     ///< blocks in front of the first /BEGIN
  std::vector<std::size_t> submodel_blocks;  ///< header block of every submodel
  std::int32_t unclosed_submodel = -1;
  int begin_count = 0;
};

/// Drops what stands before /BEGIN; parameters, submodel offsets, unit systems, opaque blocks.
void finish_deck(Deck& deck, ReaderNotes& notes, const ReadOptions& options);

/// Fills Deck::parameters from the /PARAMETER blocks (all files first, then evaluation).
void read_parameters(Deck& deck, const Limits& limits);

/// Value of a numeric parameter in an integer place; reals are cut, as far as they fit.
std::int64_t as_integer(const Parameter& parameter);
/// An integer cell that is a number or a parameter; 0 if it is neither.
std::int64_t read_offset(const Deck& deck, const Span& cell);

inline bool starts_with_nocase(std::string_view text, std::string_view lower_case) {
  if (text.size() < lower_case.size()) return false;
  for (std::size_t i = 0; i < lower_case.size(); ++i) {
    const char c = text[i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c) != lower_case[i]) return false;
  }
  return true;
}

}  // namespace deck::detail
