// TextTable: columns of text lined up for a terminal or a file, with optional colour per cell.
#pragma once
#include <concepts>
#include <initializer_list>
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
  /// A title begins with '>' if its column is set to the right, with '=' if its texts are never
  /// broken. '+' before that: without `all` the column is left out, with its cells.
  TextTable(std::initializer_list<const char*> titles, bool all = true);

  /// A text or a number; real numbers get six digits.
  struct Cell {
    std::string text;
    Tone tone = Tone::plain;
    Cell(std::string t, Tone n = Tone::plain) : text(std::move(t)), tone(n) {}        // NOLINT
    Cell(std::string_view t, Tone n = Tone::plain) : text(t), tone(n) {}              // NOLINT
    Cell(const char* t, Tone n = Tone::plain) : text(t), tone(n) {}                   // NOLINT
    Cell(std::integral auto v, Tone n = Tone::plain) : Cell(std::to_string(v), n) {}  // NOLINT
    Cell(double v);                                                                   // NOLINT
  };
  /// Missing cells at the end are blank. What a terminal would obey is spelled out (terminal_text).
  void row(std::vector<Cell> cells);
  std::size_t size() const { return rows_.size(); }

  /// Every line indented by `indent` blanks, without blanks at its end. No line is longer than
  /// `width` (0: any length), as far as single words allow: texts are continued on further lines;
  /// columns that still do not fit stand in a table below, behind the first `keys` columns once
  /// more.
  std::string fitted(std::size_t width, bool color = false, std::size_t indent = 0,
                     std::size_t keys = 1) const;
  /// The same behind two blanks, with the width and colour of a report; "" without rows.
  template <class Options>
  std::string below_heading(const Options& options, std::size_t keys = 1) const {
    return rows_.empty() ? std::string() : fitted(options.width, options.color, 2, keys);
  }

 private:
  /// Some columns, with texts broken at the width of their column.
  std::string part(const std::vector<std::size_t>& columns, const std::vector<std::size_t>& width,
                   bool color, std::size_t indent) const;

  std::vector<Column> columns_;
  std::vector<bool> left_out_;  ///< of the cells of a row
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace deck
