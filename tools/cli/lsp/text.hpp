// Text in an editor: line starts, positions of the protocol (UTF-16, or UTF-8 if offered by the
// client), byte offsets, edits.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace deck::lsp {

/// Unit of TextPlace::character.
enum class Encoding : std::uint8_t { utf16, utf8 };

/// Position in the protocol, 0-based.
struct TextPlace {
  std::uint64_t line = 0, character = 0;
  friend bool operator==(const TextPlace&, const TextPlace&) = default;
};

/// Starts of the lines of a text. A line ends with "\n", "\r\n" or "\r".
class LineTable {
 public:
  explicit LineTable(std::string_view text);
  std::uint64_t size() const { return starts_.size(); }
  /// Bytes of a line without its end; empty: no such line.
  std::string_view line(std::string_view text, std::uint64_t number) const;
  std::uint64_t start(std::uint64_t number) const { return starts_[number]; }
  /// The line at an offset.
  std::uint64_t line_of(std::uint64_t offset) const;
  /// Byte offset of a position, clipped to the end of its line or of the text. An invalid UTF-8
  /// byte is one character.
  std::uint64_t offset(std::string_view text, TextPlace place, Encoding encoding) const;
  TextPlace place(std::string_view text, std::uint64_t offset, Encoding encoding) const;
  /// The table after replacing bytes [begin, end) of `before`; `after` is the new text. Costs the
  /// changed lines and a copy.
  std::shared_ptr<const LineTable> spliced(std::string_view before, std::string_view after,
                                           std::uint64_t begin, std::uint64_t end) const;

 private:
  LineTable() = default;
  std::vector<std::uint64_t> starts_;
};

/// An open document. The workspace has its text.
struct Document {
  std::string uri;  ///< as written by the client
  std::int64_t version = 0;
  std::shared_ptr<const LineTable> lines;
};

/// Replaces bytes [begin, end) and updates the table.
void replace(std::string& text, Document& document, std::uint64_t begin, std::uint64_t end,
             std::string_view by);

/// Units of a text in an encoding.
std::uint64_t units(std::string_view text, Encoding encoding);

/// "file:///a%20b.rad" -> "/a b.rad"; empty for another scheme.
std::string path_of_uri(std::string_view uri);
std::string uri_of_path(std::string_view path);

/// Converts invalid bytes from Latin-1 to UTF-8.
std::string utf8(std::string_view text);

}  // namespace deck::lsp
