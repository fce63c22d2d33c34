// Reader: walks the include tree of a deck and cuts it into blocks. Private to the keyword stage.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword.hpp"
#include "deck/text.hpp"
#include "text/shared/columns.hpp"

namespace deck::detail {

/// Splits a header into keyword, ids and schema. `header` is trimmed and starts with '/'.
void parse_header(const SchemaSet& schemas, Block& block);

/// Line buffer of the solver, counted from the first slash.
inline constexpr std::size_t header_columns = 202;

/// Bytes [begin, end) of a keyword line; only blanks before `slash`.
struct HeaderPlace {
  std::uint32_t file;
  std::uint64_t begin, slash, end;
};
/// Reports text after the last column (DK012) and blanks that change the keyword for the solver
/// (DK052). `header`: the line from the slash, without comment.
void check_header_line(Deck& deck, const HeaderPlace& place, std::string_view header);

/// The header without text after its number: "/PART/1" for "/PART/1 left". After a keyword without
/// number such text makes it another keyword for the solver.
std::string_view without_note(std::string_view header);

/// Adds a finding of the reader.
void report(Deck& deck, RuleId rule, Span span, std::string message, Overrides overrides = {});

/// Searches lint_marker in the unsearched bytes of a file up to `end`, or in all of them.
void note_lint_markers(Deck& deck, std::uint32_t file, std::uint64_t end = UINT64_MAX);

/// Bytes [begin, end) of a file, limited to the length of a message.
inline Span make_span(std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
  constexpr std::uint64_t longest = 1 << 20;
  return {file, static_cast<std::uint32_t>(end - begin < longest ? end - begin : longest), begin};
}

/// Error for a file without text: blank, UTF-16 or binary.
Result<void> refuse_empty(const Source& source);
Result<void> refuse_binary(const Source& source);

/// Reads the four lines of the /BEGIN at `header`, from `pos`. Reports unknown versions (DK003) and
/// unreadable units (DK015).
Begin read_begin(Deck& deck, Span header, std::uint64_t pos);

/// Reads three unit codes in columns 1-20, 21-40, 41-60 (DK015: unreadable). False: all blank.
/// `blank_is_one`: in /UNIT a blank or 0 is the factor 1.
bool read_units(Deck& deck, const Line& line, UnitSystem& units, bool blank_is_one = false);

/// Data of the file walk for complete_deck().
struct ReaderNotes {
  std::vector<std::size_t> before_begin;     ///< blocks before the first /BEGIN
  std::vector<std::size_t> submodel_blocks;  ///< header block of each submodel
  std::int32_t unclosed_submodel = -1;
  int begin_count = 0;
};

/// Drops blocks before /BEGIN; sets parameters, submodel offsets, units, encrypted blocks.
void complete_deck(Deck& deck, ReaderNotes& notes, const ReadOptions& options);

/// Fills Deck::parameters from /PARAMETER blocks, after all files are read.
void read_parameters(Deck& deck, const Limits& limits);

/// Value of a numeric parameter as integer; reals are truncated and clamped.
std::int64_t as_integer(const Parameter& parameter);
/// Integer cell with a number or parameter; else 0.
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
