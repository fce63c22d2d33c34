// Measures the columns of a table and prints it.
#include "report/shared/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/shared/shown_text.hpp"

namespace deck {

std::string toned(std::string_view text, Tone tone, bool color) {
  static constexpr const char* codes[] = {"", "1", "2", "1;31", "33", "32", "36"};
  if (!color || tone == Tone::plain || text.empty()) return std::string(text);
  return fmt::format("\x1b[{}m{}\x1b[0m", codes[static_cast<std::size_t>(tone)], text);
}

TextTable::TextTable(std::initializer_list<const char*> titles, bool all) {
  for (std::string_view title : titles) {
    const bool detail = title.starts_with('+');
    if (detail) title.remove_prefix(1);
    left_out_.push_back(detail && !all);
    if (left_out_.back()) continue;
    const bool right = title.starts_with('>'), whole = title.starts_with('=');
    const bool name = title.starts_with('~');
    if (right || whole || name) title.remove_prefix(1);
    columns_.push_back({std::string(title), right ? Align::right : Align::left, whole, name});
  }
}

TextTable::Cell::Cell(double v) : text(fmt::format("{:.6g}", v)) {}

CsvCells::CsvCells(std::string_view t) : text(csv_text(t)) {}
CsvCells::CsvCells(double v) : text(fmt::format("{}", v)) {}

void TextTable::row(std::vector<Cell> cells) {
  std::vector<Cell>& shown = rows_.emplace_back();
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (i >= left_out_.size() || !left_out_[i])
      shown.emplace_back(terminal_text(cells[i].text), cells[i].tone);
}

namespace {

/// Length of the longest number or id in `text`: such words are never broken.
std::size_t longest_number(std::string_view text) {
  std::size_t longest = 0;
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of(" ,/:"), text.size());
    const std::string_view word = text.substr(0, end);
    if (word.find_first_of("0123456789") != word.npos &&
        word.find_first_not_of("0123456789+-.e()%") == word.npos)
      longest = std::max(longest, std::min(end + 1, text.size()));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return longest;
}

}  // namespace

std::string cut_middle(const std::string& text, std::size_t width) {
  if (display_width(text) <= width) return text;
  if (width < 5 || text.size() != display_width(text)) return cut_to(text, width);
  const std::size_t tail = (width - 1) / 2;
  return text.substr(0, width - 1 - tail) + "…" + text.substr(text.size() - tail);
}

std::string TextTable::part(const std::vector<std::size_t>& columns,
                            const std::vector<std::size_t>& width, bool color,
                            std::size_t indent) const {
  std::string out;
  const auto line = [&](const std::vector<Cell>& cells) {
    std::vector<std::vector<std::string>> pieces;
    std::size_t height = 1;
    for (const std::size_t i : columns) {
      const std::string text = i < cells.size() ? cells[i].text : "";
      pieces.push_back(columns_[i].name ? std::vector{cut_middle(text, width[i])}
                                        : broken(text, width[i], width[i]));
      height = std::max(height, pieces.back().size());
    }
    for (std::size_t row = 0; row < height; ++row) {
      std::string text(indent, ' ');
      std::size_t pending = 0;  // blanks, written only if text follows
      bool any = false;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const std::string piece = row < pieces[k].size() ? pieces[k][row] : std::string();
        const std::size_t pad =
            width[columns[k]] - std::min(width[columns[k]], display_width(piece));
        const Align align = columns_[columns[k]].align;
        if (align == Align::right) pending += pad;
        if (!piece.empty()) {
          text.append(pending, ' ');
          pending = 0;
          any = true;
          text += toned(piece, cells[columns[k]].tone, color);
        }
        if (align == Align::left) pending += pad;
        pending += 2;
      }
      out += (any ? text : std::string()) + '\n';
    }
  };
  std::vector<Cell> titles;
  for (const Column& c : columns_) titles.emplace_back(c.title, Tone::bold);
  line(titles);
  for (const auto& cells : rows_) line(cells);
  return out;
}

std::string TextTable::fitted(std::size_t width, bool color, std::size_t indent, std::size_t keys,
                              std::vector<std::string>* left) const {
  constexpr std::size_t narrow = 10, short_name = 18;  // minimum widths of broken and cut texts
  const std::size_t n = columns_.size();
  std::vector<std::size_t> need(n), least(n), all;
  std::vector<bool> empty(n, true);
  for (std::size_t i = 0; i < n; ++i) {
    need[i] = display_width(columns_[i].title);
    least[i] = std::max(columns_[i].name ? short_name : narrow, need[i]);
    for (const auto& cells : rows_) {
      if (i >= cells.size()) continue;
      need[i] = std::max(need[i], display_width(cells[i].text));
      if (!columns_[i].name) least[i] = std::max(least[i], longest_number(cells[i].text));
      empty[i] = empty[i] && cells[i].text.empty();
    }
    if (columns_[i].align == Align::right || columns_[i].whole) least[i] = need[i];
    least[i] = std::min(least[i], need[i]);
    all.push_back(i);
  }
  const auto length = [&](const std::vector<std::size_t>& columns,
                          const std::vector<std::size_t>& widths) {
    std::size_t sum = indent;
    for (const std::size_t i : columns) sum += widths[i] + (i == columns.front() ? 0 : 2);
    return sum;
  };
  if (width == 0) return part(all, need, color, indent);
  // A text without room even in a table of its own is broken anyway.
  std::size_t before = indent;
  for (std::size_t i = 0; i < std::min(keys, n); ++i) before += least[i] + 2;
  for (std::size_t i = keys; i < n; ++i)
    if (columns_[i].whole && before + need[i] > width)
      least[i] = std::min(need[i], std::max(narrow, width - std::min(width, before)));
  // Without room for all, empty columns are dropped.
  if (rows_.size() > 0 && length(all, need) > width)
    std::erase_if(all, [&](std::size_t i) { return i >= keys && empty[i]; });
  std::string out;
  for (std::size_t next = 0; next < all.size();) {
    std::vector<std::size_t> columns;
    if (next > 0) columns.assign(all.begin(), all.begin() + std::min(keys, all.size()));
    const std::size_t repeated = columns.size();
    while (next < all.size()) {
      columns.push_back(all[next]);
      const bool first = columns.size() == repeated + 1 || next < keys;
      if (!first && length(columns, least) > width) {
        columns.pop_back();
        break;
      }
      ++next;
    }
    // The widest texts shrink first.
    std::vector<std::size_t> widths = need;
    while (length(columns, widths) > width) {
      std::size_t widest = n;
      for (const std::size_t i : columns)
        if (widths[i] > least[i] && (widest == n || widths[i] > widths[widest])) widest = i;
      if (widest == n) break;
      --widths[widest];
    }
    out += (out.empty() ? "" : "\n") + part(columns, widths, color, indent);
    if (left == nullptr) continue;
    for (; next < all.size(); ++next) left->push_back(columns_[all[next]].title);
  }
  return out;
}

}  // namespace deck
