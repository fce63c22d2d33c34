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

namespace {

/// `text` in pieces of at most `width` columns: broken behind blanks, commas and slashes, or where
/// nothing else helps inside a word.
std::vector<std::string> broken(const std::string& text, std::size_t width) {
  std::vector<std::string> out;
  std::string_view rest = text;
  while (display_width(rest) > width) {
    std::size_t at = 0, columns = 0, best = 0;
    while (at < rest.size() && columns < width) {
      at += std::max<std::size_t>(text_unit_at(rest, at).length, 1);
      ++columns;
      const char c = rest[at - 1];
      if (c == ' ' || c == ',' || c == '/' || c == ':') best = at;
    }
    if (at < rest.size() && rest[at] == ' ') best = at;
    if (best == 0) best = at;
    std::string piece(rest.substr(0, best));
    while (piece.ends_with(' ')) piece.pop_back();
    out.push_back(std::move(piece));
    rest.remove_prefix(best);
    while (rest.starts_with(' ')) rest.remove_prefix(1);
  }
  out.emplace_back(rest);
  return out;
}

}  // namespace

std::string TextTable::part(const std::vector<std::size_t>& columns,
                            const std::vector<std::size_t>& width, bool color,
                            std::size_t indent) const {
  std::string out;
  const auto line = [&](const std::vector<Cell>& cells) {
    std::vector<std::vector<std::string>> pieces;
    std::size_t height = 1;
    for (const std::size_t i : columns) {
      pieces.push_back(broken(i < cells.size() ? cells[i].text : std::string(), width[i]));
      height = std::max(height, pieces.back().size());
    }
    for (std::size_t row = 0; row < height; ++row) {
      std::string text(indent, ' ');
      std::size_t pending = 0;  // blanks that are written only if something follows
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

std::string TextTable::render(bool color, std::size_t indent) const {
  return fitted(0, color, indent);
}

std::string TextTable::fitted(std::size_t width, bool color, std::size_t indent,
                              std::size_t keys) const {
  constexpr std::size_t narrow = 12;  // texts are not broken into less
  std::vector<std::size_t> need(columns_.size());
  for (std::size_t i = 0; i < need.size(); ++i) need[i] = display_width(columns_[i].title);
  for (const auto& cells : rows_)
    for (std::size_t i = 0; i < std::min(cells.size(), need.size()); ++i)
      need[i] = std::max(need[i], display_width(cells[i].text));
  std::vector<std::size_t> all(columns_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const auto length = [&](const std::vector<std::size_t>& columns) {
    std::size_t sum = indent;
    for (const std::size_t i : columns) sum += need[i] + (i == columns.front() ? 0 : 2);
    return sum;
  };
  // The widest texts give way first.
  while (width > 0 && length(all) > width) {
    std::size_t widest = all.size();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (columns_[i].align == Align::left &&
          need[i] > std::max(narrow, display_width(columns_[i].title)) &&
          (widest == all.size() || need[i] > need[widest]))
        widest = i;
    if (widest == all.size()) break;
    --need[widest];
  }
  std::string out;
  for (std::size_t next = 0; next < all.size();) {
    std::vector<std::size_t> columns;
    for (std::size_t k = 0; next > 0 && k < std::min(keys, all.size()); ++k) columns.push_back(k);
    const std::size_t repeated = columns.size();
    while (next < all.size()) {
      columns.push_back(next);
      const bool first = columns.size() == repeated + 1 || next < keys;
      if (width > 0 && !first && length(columns) > width) {
        columns.pop_back();
        break;
      }
      ++next;
    }
    out += (out.empty() ? "" : "\n") + part(columns, need, color, indent);
  }
  return out;
}

}  // namespace deck
