// Text from outside (titles, cells, file names, keys of a configuration) on its way to a person or
// a parser: one function a medium. Nothing is dropped: what a medium cannot show, or would obey, is
// spelled out. Bytes that are no UTF-8 and control characters become \xNN (\n, \r, \t), characters
// that are invisible or turn the reading direction become \u{202e}.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace deck {

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

}  // namespace deck
