// Makes text of a deck or user safe to show: escaped, measured, cut and folded.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace deck {

// Titles, cells, file names and keys are escaped before they are shown, by one function per medium.
// No character is lost: invalid UTF-8 and control characters become \xNN (or \n, \r, \t), invisible
// and direction-changing characters \u{202e}.

/// One character of a text, or one byte of invalid UTF-8.
struct TextUnit {
  std::uint32_t code = 0;  ///< the character, or the byte
  std::size_t length = 0;  ///< in bytes; 0: end of the text
  bool character = false;  ///< well-formed UTF-8: no surrogate, not overlong, at most U+10FFFF
  /// True if it can be shown unchanged: no control character (C0, DEL, C1), direction control, line
  /// separator, byte order mark or non-character.
  bool visible() const;
};
TextUnit text_unit_at(std::string_view text, std::size_t at);

/// For one line of a terminal or log: no escape sequences, carriage returns, line ends or text that
/// a CI runner obeys ("::error", "##[", "##vso[").
std::string terminal_text(std::string_view text);
/// terminal_text for several lines: keeps line feeds and tabs.
std::string terminal_lines(std::string_view text);
/// For a card line above a caret: each character or invalid byte has one column. Control characters
/// become their pictures (U+2400...), tabs blanks, others U+FFFD.
std::string terminal_columns(std::string_view text);

/// For content and attributes in XML 1.0; line feeds and tabs as references.
std::string xml_text(std::string_view text);
/// xml_text for HTML: line feeds are kept.
std::string html_text(std::string_view text);

/// For one CSV field (RFC 4180): quoted if it has a comma, quotation mark or line end.
std::string csv_text(std::string_view text);

/// For the message of a workflow command (::error ...::MESSAGE), and for its properties.
std::string workflow_text(std::string_view text);
std::string workflow_property(std::string_view text);

/// Appends `text` as a JSON string. Invisible characters become \uNNNN (same value); invalid UTF-8
/// bytes are read as Latin-1.
void append_json_string(std::string& out, std::string_view text);

// Widths in terminal columns, cutting and folding. Escape codes (colours) have width 0, East Asian
// characters 2.

/// Columns of one character: 0 for a combining accent, 2 for a wide character.
std::size_t character_width(std::uint32_t code);
/// Columns of a text; an invalid byte has one.
std::size_t display_width(std::string_view text);

/// Mark of a ruler above a column; columns count from 1.
constexpr char ruler_mark(std::size_t column) {
  return column % 10 == 0 ? static_cast<char>('0' + column / 10 % 10) : column % 5 == 0 ? '+' : '.';
}

/// Cuts `text` to `width` columns, with "…" at the end.
std::string cut_to(std::string_view text, std::size_t width);

/// Splits `text`: at most `first` columns for the first piece, `rest` for others. Breaks after
/// blanks, commas, colons and slashes, else inside a word. Only blanks at breaks are lost.
std::vector<std::string> broken(std::string_view text, std::size_t first, std::size_t rest);

/// Fills lines of `width` columns with the words, each line after `indent` blanks. Repeated blanks
/// become one.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width);

/// Continues lines longer than `width` on indented lines; width 0: no change.
std::string folded(std::string_view text, std::size_t width);

}  // namespace deck
