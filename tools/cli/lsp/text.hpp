// Text of an editor: where its lines begin, positions as the protocol counts them (UTF-16, or UTF-8
// if the client offers it) and byte offsets, and the edits of a change.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace deck::lsp {

/// What a unit of Place::character is.
enum class Encoding : std::uint8_t { utf16, utf8 };

/// Position of the protocol: both from 0.
struct Place {
  std::uint64_t line = 0, character = 0;
  friend bool operator==(const Place&, const Place&) = default;
};

/// Where the lines of a text begin. A line ends with "\n", "\r\n" or "\r".
class LineTable {
 public:
  explicit LineTable(std::string_view text);

  std::uint64_t size() const { return starts_.size(); }
  /// Bytes of a line without its end; empty for a line that there is not.
  std::string_view line(std::string_view text, std::uint64_t number) const;
  std::uint64_t start(std::uint64_t number) const { return starts_[number]; }
  /// The line that holds the offset.
  std::uint64_t line_of(std::uint64_t offset) const;

  /// Byte offset; a position behind the end of its line is the end of the line, one behind the last
  /// line the end of the text. Bytes that are no UTF-8 count as one character each.
  std::uint64_t offset(std::string_view text, Place place, Encoding encoding) const;
  Place place(std::string_view text, std::uint64_t offset, Encoding encoding) const;

  /// The table of the text in which bytes [begin, end) of `before` were replaced; `after` is the
  /// new text. Costs the lines that changed, and a copy of the table.
  std::shared_ptr<const LineTable> spliced(std::string_view before, std::string_view after,
                                           std::uint64_t begin, std::uint64_t end) const;

 private:
  LineTable() = default;
  std::vector<std::uint64_t> starts_;
};

/// An open document. Its text stands in the workspace, where the reader of decks finds it.
struct Document {
  std::string uri;  ///< as the client writes it
  std::int64_t version = 0;
  std::shared_ptr<const LineTable> lines;
};

/// Replaces bytes [begin, end) and keeps the table.
void replace(std::string& text, Document& document, std::uint64_t begin, std::uint64_t end,
             std::string_view by);

/// Units of a text in an encoding.
std::uint64_t units(std::string_view text, Encoding encoding);

/// "file:///a%20b.rad" -> "/a b.rad"; empty for another scheme.
std::string path_of_uri(std::string_view uri);
std::string uri_of_path(std::string_view path);

/// Well-formed UTF-8: bytes that are none are taken for Latin-1.
std::string utf8(std::string_view text);

}  // namespace deck::lsp
