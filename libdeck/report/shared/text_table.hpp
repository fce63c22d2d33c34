// TextTable: columns of text lined up for a terminal or a file, with optional colour per cell.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace deck {

enum class Align : unsigned char { left, right };
enum class Tone : unsigned char { plain, bold, dim, red, yellow, green, cyan };

/// Escape codes around `text` if `color` is set.
std::string toned(std::string_view text, Tone tone, bool color);

class TextTable {
 public:
  struct Column {
    std::string title;
    Align align = Align::left;
    bool whole = false;  ///< its texts are never broken where a line has room for them: places
  };
  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  struct Cell {
    std::string text;
    Tone tone = Tone::plain;
    Cell(std::string t, Tone n = Tone::plain) : text(std::move(t)), tone(n) {}  // NOLINT
    Cell(const char* t) : text(t) {}                                            // NOLINT
  };
  /// Missing cells at the end are blank. What a terminal would obey is spelled out (terminal_text).
  void row(std::vector<Cell> cells);
  std::size_t size() const { return rows_.size(); }

  /// Every line indented by `indent` blanks; no blanks at line ends.
  std::string render(bool color = false, std::size_t indent = 0) const;
  /// The same with no line longer than `width` (0: any length), as far as single words allow: texts
  /// are continued on further lines; columns that still do not fit stand in a table below, behind
  /// the first `keys` columns once more.
  std::string fitted(std::size_t width, bool color = false, std::size_t indent = 0,
                     std::size_t keys = 1) const;

 private:
  /// Some columns, with texts broken at the width of their column.
  std::string part(const std::vector<std::size_t>& columns, const std::vector<std::size_t>& width,
                   bool color, std::size_t indent) const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace deck
