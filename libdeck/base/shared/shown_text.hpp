// Text from a deck or a user, made safe to show: escaped, measured in columns, cut and folded.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace deck {

// Titles, cells, file names and keys of a configuration are escaped before they are shown: one
// function per medium (terminal, XML, CSV, ...). Nothing is dropped: characters that the medium
// cannot show, or would execute, are spelled out. Invalid UTF-8 and control characters become \xNN
// (or \n, \r, \t); characters that are invisible or turn the reading direction become \u{202e}.

/// The unit at a place of a text: one character, or one byte of invalid UTF-8.
struct TextUnit {
  std::uint32_t code = 0;  ///< the character, or the byte
  std::size_t length = 0;  ///< in bytes; 0: the text ends here
  bool character =
      false;  ///< well-formed UTF-8: no surrogate, not overlong, nothing above U+10FFFF
  /// True for a character that may be shown as it is: no control character (C0, DEL, C1), no
  /// direction control, no line separator, no byte order mark, no non-character.
  bool visible() const;
};
TextUnit text_unit_at(std::string_view text, std::size_t at);

/// One line for a terminal or a log, without escape sequences, carriage returns and line ends, and
/// without texts that a CI runner takes for a command ("::error", "##[", "##vso[").
std::string terminal_text(std::string_view text);
/// As terminal_text, for several lines: line feeds and tabs stay.
std::string terminal_lines(std::string_view text);
/// A piece of a card line above a caret: every character and every odd byte takes one column.
/// Control characters appear as their pictures (U+2400...), tabs as blanks, the rest as U+FFFD.
std::string terminal_columns(std::string_view text);

/// Content or attribute value of an XML 1.0 document; line feeds and tabs as references.
std::string xml_text(std::string_view text);
/// As xml_text, for HTML: line feeds may stay.
std::string html_text(std::string_view text);

/// One field of a CSV line (RFC 4180): in quotation marks if it contains a comma, a quotation mark
/// or a line end.
std::string csv_text(std::string_view text);

/// The message of a workflow command (::error ...::MESSAGE), and the value of one of its
/// properties.
std::string workflow_text(std::string_view text);
std::string workflow_property(std::string_view text);

/// Appends `text` as a JSON string with its quotes. Characters that are not visible are written
/// \uNNNN, so the value does not change; invalid UTF-8 bytes are read as Latin-1.
void append_json_string(std::string& out, std::string_view text);

// The number of terminal columns of a text, and texts cut or folded to a number of columns.
// Escape codes (colours) take none, East Asian characters two.

/// Columns of one character: 0 for a combining accent, 2 for a wide character.
std::size_t character_width(std::uint32_t code);
/// Columns of a text; an invalid byte takes one column.
std::size_t display_width(std::string_view text);

/// The mark of a ruler above a column; columns count from 1.
constexpr char ruler_mark(std::size_t column) {
  return column % 10 == 0 ? static_cast<char>('0' + column / 10 % 10) : column % 5 == 0 ? '+' : '.';
}

/// `text`; if it is longer than `width` columns, cut and ended with "…".
std::string cut_to(std::string_view text, std::size_t width);

/// Breaks `text` into pieces: the first has at most `first` columns, the others at most `rest`.
/// Breaks after blanks, commas, colons and slashes; inside a word only if there is no such place.
/// Only blanks at a break are lost.
std::vector<std::string> broken(std::string_view text, std::size_t first, std::size_t rest);

/// One paragraph: fills lines of `width` columns with the words, each line behind `indent` blanks.
/// Several blanks between words become one.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width);

/// Continues lines longer than `width` on further, indented lines; width 0: changes nothing.
std::string folded(std::string_view text, std::size_t width);

}  // namespace deck
