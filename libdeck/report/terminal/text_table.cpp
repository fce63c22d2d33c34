// Measures the columns of a table and prints it.
#include "deck/report/text_table.hpp"

#include <algorithm>

#include "deck/base/escape.hpp"

namespace deck {

std::string toned(std::string_view text, Tone tone, bool color) {
  const char* code = "";
  switch (tone) {
    case Tone::plain:
      break;
    case Tone::bold:
      code = "\x1b[1m";
      break;
    case Tone::dim:
      code = "\x1b[2m";
      break;
    case Tone::red:
      code = "\x1b[1;31m";
      break;
    case Tone::yellow:
      code = "\x1b[33m";
      break;
    case Tone::green:
      code = "\x1b[32m";
      break;
    case Tone::cyan:
      code = "\x1b[36m";
      break;
  }
  if (!color || *code == '\0' || text.empty()) return std::string(text);
  return code + std::string(text) + "\x1b[0m";
}

std::size_t display_width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
  }));
}

void TextTable::row(std::vector<Cell> cells) {
  for (Cell& cell : cells) cell.text = terminal_text(cell.text);
  rows_.push_back(std::move(cells));
}

std::string TextTable::render(bool color, std::size_t indent) const {
  std::vector<std::size_t> width(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) width[i] = display_width(columns_[i].title);
  for (const auto& cells : rows_)
    for (std::size_t i = 0; i < std::min(cells.size(), columns_.size()); ++i)
      width[i] = std::max(width[i], display_width(cells[i].text));
  std::string out;
  const auto line = [&](const std::vector<Cell>& cells) {
    std::string text(indent, ' ');
    std::size_t pending = 0;  // blanks that are written only if something follows
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Cell empty("");
      const Cell& cell = i < cells.size() ? cells[i] : empty;
      const std::size_t pad = width[i] - display_width(cell.text);
      if (columns_[i].align == Align::right) pending += pad;
      if (!cell.text.empty()) {
        text.append(pending, ' ');
        pending = 0;
        text += toned(cell.text, cell.tone, color);
      }
      if (columns_[i].align == Align::left) pending += pad;
      pending += 2;
    }
    out += text + '\n';
  };
  std::vector<Cell> titles;
  for (const Column& c : columns_) titles.emplace_back(c.title, Tone::bold);
  line(titles);
  for (const auto& cells : rows_) line(cells);
  return out;
}

}  // namespace deck
