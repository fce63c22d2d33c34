// TextTable: aligned columns for terminals and files, with optional colour per cell. CsvTable: rows
// as CSV.
#pragma once
#include <array>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/report.hpp"

namespace deck {

enum class Align : unsigned char { left, right };
enum class Tone : unsigned char { plain, bold, dim, red, yellow, green, cyan };

/// Adds escape codes to `text` if `color` is set.
std::string toned(std::string_view text, Tone tone, bool color);
/// "ES2_PART_THO…AM_2D_BOTTOM": keeps both ends.
std::string cut_middle(const std::string& text, std::size_t width);

class TextTable {
 public:
  struct Column {
    std::string title;
    Align align = Align::left;
    bool whole = false;  ///< texts are not broken if a line has room: places
    bool name = false;   ///< texts are cut in the middle, not continued
  };
  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// Title prefix: '>' aligns the column right, '=' never breaks its texts, '~' marks names. '+'
  /// before these: without `all` the column is left out.
  TextTable(std::initializer_list<const char*> titles, bool all = true);

  /// A text or a number; reals have six digits.
  struct Cell {
    std::string text;
    Tone tone = Tone::plain;
    Cell(std::string t, Tone n = Tone::plain) : text(std::move(t)), tone(n) {}        // NOLINT
    Cell(std::string_view t, Tone n = Tone::plain) : text(t), tone(n) {}              // NOLINT
    Cell(const char* t, Tone n = Tone::plain) : text(t), tone(n) {}                   // NOLINT
    Cell(std::integral auto v, Tone n = Tone::plain) : Cell(std::to_string(v), n) {}  // NOLINT
    Cell(double v);                                                                   // NOLINT
  };
  /// Missing cells at the end are blank. Control characters are escaped (terminal_text).
  void row(std::vector<Cell> cells);
  std::size_t size() const { return rows_.size(); }

  /// Lines indented by `indent` blanks, without trailing blanks, and at most `width` long (0: any)
  /// if single words allow: texts continue on further lines; columns without room go to a table
  /// below, which repeats the first `keys` columns. With `left`: one table; adds the titles of
  /// columns without room.
  std::string fitted(std::size_t width, bool color = false, std::size_t indent = 0,
                     std::size_t keys = 1, std::vector<std::string>* left = nullptr) const;
  /// As fitted(), behind two blanks, with width and colour of a report; "" without rows.
  template <class Options>
  std::string below_heading(const Options& options, std::size_t keys = 1) const {
    return rows_.empty() ? std::string() : fitted(options.width, options.color, 2, keys);
  }

 private:
  /// Some columns, with texts broken at the column width.
  std::string part(const std::vector<std::size_t>& columns, const std::vector<std::size_t>& width,
                   bool color, std::size_t indent) const;

  std::vector<Column> columns_;
  std::vector<bool> left_out_;  ///< by cell of a row
  std::vector<std::vector<Cell>> rows_;
};

/// One or more CSV cells: texts, shortest numbers, 1 or 0 for bool; an array has as many cells as
/// its title has names.
struct CsvCells {
  std::string text;
  CsvCells(std::string_view t);                                      // NOLINT
  CsvCells(const std::string& t) : CsvCells(std::string_view(t)) {}  // NOLINT
  CsvCells(const char* t) : CsvCells(std::string_view(t)) {}         // NOLINT
  CsvCells(std::integral auto v) : text(std::to_string(+v)) {}       // NOLINT
  CsvCells(double v);                                                // NOLINT
  template <class T>
  CsvCells(const std::optional<T>& v) : CsvCells(v ? CsvCells(*v) : CsvCells("")) {}  // NOLINT
  template <class T, std::size_t N>
  CsvCells(const std::array<T, N>& v) {  // NOLINT
    for (const T& x : v) text += (&x == v.data() ? "" : ",") + CsvCells(x).text;
  }
};

/// A column of a CsvTable: title, and cells of a row `r`.
#define CSV(title, ...)                                           \
  CsvColumn {                                                     \
    title, [&](const auto& r) -> CsvCells { return __VA_ARGS__; } \
  }
template <class Cells>
struct CsvColumn {
  const char* title;
  Cells cells;
};

/// RFC 4180.
template <class Row>
class CsvTable {
 public:
  template <class... Cells>
  explicit CsvTable(TextDrain drain, CsvColumn<Cells>... columns)
      : drain_(std::move(drain)), cells_{columns.cells...} {
    for (const char* title : {columns.title...})
      text_ += (text_.empty() ? "" : ",") + std::string(title);
    text_ += "\r\n";
  }
  void add(const Row& row) {
    for (const auto& cell : cells_) text_ += (&cell == cells_.data() ? "" : ",") + cell(row).text;
    text_ += "\r\n";
    drain_text(drain_, text_);
  }
  /// The text that the drain did not take.
  std::string text() { return std::move(text_); }

 private:
  TextDrain drain_;
  std::vector<std::function<CsvCells(const Row&)>> cells_;
  std::string text_;
};

}  // namespace deck
