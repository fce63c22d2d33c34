// Text from outside as it is shown: escaped for its medium, measured and folded in columns.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace deck {

// Text from outside (titles, cells, file names, keys of a configuration) on its way to a person or
// a parser: one function a medium. Nothing is dropped: what a medium cannot show, or would obey, is
// spelled out. Bytes that are no UTF-8 and control characters become \xNN (\n, \r, \t), characters
// that are invisible or turn the reading direction become \u{202e}.

/// What stands at a place of a text: one character, or one byte that belongs to none.
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

/// One line for a terminal or a log. Neither escape sequences nor carriage returns nor line ends
/// are left, and nothing that a CI runner takes for a command ("::error", "##[", "##vso[").
std::string terminal_text(std::string_view text);
/// The same for text of several lines: line feeds and tabs stay.
std::string terminal_lines(std::string_view text);
/// A piece of a card line above a caret: every character and every odd byte takes one column.
/// Control characters appear as their pictures (U+2400...), tabs as blanks, the rest as U+FFFD.
std::string terminal_columns(std::string_view text);

/// Content or attribute value of an XML 1.0 document; line feeds and tabs as references.
std::string xml_text(std::string_view text);
/// The same for HTML, where line feeds may stay.
std::string html_text(std::string_view text);

/// One field of a CSV line (RFC 4180): in quotation marks where it holds a comma, a quotation mark
/// or a line end.
std::string csv_text(std::string_view text);

/// The message of a workflow command (::error ...::MESSAGE), and the value of one of its
/// properties.
std::string workflow_text(std::string_view text);
std::string workflow_property(std::string_view text);

/// Appends `text` as a JSON string with its quotes. What may not be shown is written \uNNNN, so the
/// value stays what it was; bytes that are no UTF-8 are taken for Latin-1.
void append_json_string(std::string& out, std::string_view text);

// The columns that text takes on a terminal, and text that is folded or cut to a number of them.
// Escape codes (colours) take none, East Asian characters two.

/// Columns of one character: 0 for an accent that stands over the one before it, 2 for a wide one.
std::size_t character_width(std::uint32_t code);
/// Columns of a text; a byte that is no UTF-8 takes one.
std::size_t display_width(std::string_view text);

/// What an editor's ruler shows over a column, counted from 1.
constexpr char ruler_mark(std::size_t column) {
  return column % 10 == 0 ? static_cast<char>('0' + column / 10 % 10) : column % 5 == 0 ? '+' : '.';
}

/// `text`, or as much of it as leaves room for "…" behind it.
std::string cut_to(std::string_view text, std::size_t width);

/// `text` in pieces of at most `first` columns, and `rest` for all but the first: broken behind
/// blanks, commas, colons and slashes, or where nothing else helps inside a word. Nothing is lost
/// but blanks where it is broken.
std::vector<std::string> broken(std::string_view text, std::size_t first, std::size_t rest);

/// One paragraph: words behind `indent` blanks, as many as `width` holds, however many blanks were
/// between them.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width);

/// Lines longer than `width` (0: none is) continued on further ones, a little further in.
std::string folded(std::string_view text, std::size_t width);

}  // namespace deck
