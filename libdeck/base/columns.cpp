// Width of text in terminal columns; cuts and folds text to a width.
#include "base/shared/shown_text.hpp"

#include <algorithm>
#include <iterator>

namespace deck {
namespace {

struct Range {
  std::uint32_t first, last;
};

/// Wide and full-width characters by Unicode's EastAsianWidth, simplified to whole blocks.
constexpr Range wide[] = {
    {0x1100, 0x115f},   {0x231a, 0x231b},   {0x2329, 0x232a},   {0x23e9, 0x23ec},
    {0x23f0, 0x23f0},   {0x23f3, 0x23f3},   {0x25fd, 0x25fe},   {0x2614, 0x2615},
    {0x2648, 0x2653},   {0x267f, 0x267f},   {0x2693, 0x2693},   {0x26a1, 0x26a1},
    {0x26aa, 0x26ab},   {0x26bd, 0x26be},   {0x26c4, 0x26c5},   {0x26ce, 0x26ce},
    {0x26d4, 0x26d4},   {0x26ea, 0x26ea},   {0x26f2, 0x26f3},   {0x26f5, 0x26f5},
    {0x26fa, 0x26fa},   {0x26fd, 0x26fd},   {0x2705, 0x2705},   {0x270a, 0x270b},
    {0x2728, 0x2728},   {0x274c, 0x274c},   {0x274e, 0x274e},   {0x2753, 0x2755},
    {0x2757, 0x2757},   {0x2795, 0x2797},   {0x27b0, 0x27b0},   {0x27bf, 0x27bf},
    {0x2b1b, 0x2b1c},   {0x2b50, 0x2b50},   {0x2b55, 0x2b55},   {0x2e80, 0x303e},
    {0x3041, 0x3247},   {0x3250, 0x4dbf},   {0x4e00, 0xa4cf},   {0xa960, 0xa97f},
    {0xac00, 0xd7a3},   {0xf900, 0xfaff},   {0xfe10, 0xfe19},   {0xfe30, 0xfe6f},
    {0xff01, 0xff60},   {0xffe0, 0xffe6},   {0x16fe0, 0x18d08}, {0x1aff0, 0x1b2ff},
    {0x1f004, 0x1f004}, {0x1f0cf, 0x1f0cf}, {0x1f18e, 0x1f18e}, {0x1f191, 0x1f19a},
    {0x1f200, 0x1f320}, {0x1f32d, 0x1f335}, {0x1f337, 0x1f37c}, {0x1f37e, 0x1f393},
    {0x1f3a0, 0x1f3ca}, {0x1f3cf, 0x1f3d3}, {0x1f3e0, 0x1f3f0}, {0x1f3f4, 0x1f3f4},
    {0x1f3f8, 0x1f43e}, {0x1f440, 0x1f440}, {0x1f442, 0x1f4fc}, {0x1f4ff, 0x1f53d},
    {0x1f54b, 0x1f567}, {0x1f57a, 0x1f57a}, {0x1f595, 0x1f596}, {0x1f5a4, 0x1f5a4},
    {0x1f5fb, 0x1f64f}, {0x1f680, 0x1f6c5}, {0x1f6cc, 0x1f6cc}, {0x1f6d0, 0x1f6df},
    {0x1f6eb, 0x1f6ec}, {0x1f6f4, 0x1f6ff}, {0x1f7e0, 0x1f7f0}, {0x1f90c, 0x1f93a},
    {0x1f93c, 0x1f945}, {0x1f947, 0x1f9ff}, {0x1fa70, 0x1faff}, {0x20000, 0x3fffd}};

/// Combining marks of common scripts: width 0. A mark that is missing here counts as one column, so
/// lines become shorter, never too long.
constexpr Range marks[] = {
    {0x300, 0x36f},   {0x483, 0x489},   {0x591, 0x5bd},   {0x610, 0x61a},
    {0x64b, 0x65f},   {0xe34, 0xe3a},   {0xe47, 0xe4e},   {0x1ab0, 0x1ace},
    {0x1dc0, 0x1dff}, {0x200c, 0x200d}, {0x20d0, 0x20f0}, {0x302a, 0x302d},
    {0x3099, 0x309a}, {0xfe00, 0xfe0f}, {0xfe20, 0xfe2f}, {0xe0100, 0xe01ef}};

template <std::size_t N>
bool within(const Range (&ranges)[N], std::uint32_t code) {
  const auto* at = std::lower_bound(std::begin(ranges), std::end(ranges), code,
                                    [](const Range& r, std::uint32_t c) { return r.last < c; });
  return at != std::end(ranges) && at->first <= code;
}

/// Length of the escape code at `at`, as written by toned(); 0: none.
std::size_t escape_code(std::string_view text, std::size_t at) {
  if (text.substr(at, 2) != "\x1b[") return 0;
  const auto end = text.find('m', at);
  return end == text.npos ? 0 : end - at + 1;
}

struct Measured {
  std::size_t length = 0, columns = 0;
};
Measured measured(std::string_view text, std::size_t at) {
  if (const std::size_t code = escape_code(text, at); code > 0) return {code, 0};
  const TextUnit unit = text_unit_at(text, at);
  return {std::max<std::size_t>(unit.length, 1), unit.character ? character_width(unit.code) : 1};
}

/// Position at which a line longer than `width` is broken: after the last blank if that is in the
/// second half of the line, else after another separator, else at `width`.
std::size_t place_to_break(std::string_view text, std::size_t width) {
  std::size_t at = 0, columns = 0, blank = 0, blank_columns = 0, sign = 0, weak = 0, shown = 0;
  while (at < text.size()) {
    const Measured unit = measured(text, at);
    if (columns + unit.columns > width && shown > 0) break;
    const char c = text[at];
    if (c == ' ' && shown > 0) {
      blank = at + 1;
      blank_columns = columns + 1;
    }
    if (c != ' ' && unit.columns > 0) ++shown;
    at += unit.length;
    columns += unit.columns;
    if (c == ',' || c == '/' || c == ':') sign = at;
    if (c == '_' || c == '-' || c == '=') weak = at;
  }
  if (at < text.size() && text[at] == ' ') return at;
  if (blank > 0 && 2 * blank_columns >= width) return blank;
  if (sign > 0 || blank > 0) return std::max(sign, blank);
  return weak > 0 ? weak : at;
}

}  // namespace

std::size_t character_width(std::uint32_t code) {
  if (code < 0x300) return 1;
  return within(marks, code) ? 0 : within(wide, code) ? 2 : 1;
}

std::size_t display_width(std::string_view text) {
  std::size_t columns = 0;
  for (std::size_t at = 0; at < text.size();) {
    const Measured unit = measured(text, at);
    columns += unit.columns;
    at += unit.length;
  }
  return columns;
}

std::string cut_to(std::string_view text, std::size_t width) {
  if (display_width(text) <= width) return std::string(text);
  std::size_t at = 0, columns = 0;
  for (;;) {
    const Measured unit = measured(text, at);
    if (columns + unit.columns + 1 > width) break;
    columns += unit.columns;
    at += unit.length;
  }
  return std::string(text.substr(0, at)) + "…";
}

std::vector<std::string> broken(std::string_view text, std::size_t first, std::size_t rest) {
  std::vector<std::string> out;
  for (std::size_t width = first; display_width(text) > width; width = rest) {
    std::size_t at = place_to_break(text, width);
    while (at < text.size() && measured(text, at).columns == 0) at += measured(text, at).length;
    if (at >= text.size()) break;
    std::string piece(text.substr(0, at));
    while (piece.ends_with(' ')) piece.pop_back();
    out.push_back(std::move(piece));
    text.remove_prefix(at);
    while (text.starts_with(' ')) text.remove_prefix(1);
  }
  out.emplace_back(text);
  return out;
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
  std::string out, line;
  const auto flush = [&] {
    if (!line.empty()) out += std::string(indent, ' ') + line + "\n";
    line.clear();
  };
  while (!text.empty()) {
    const auto end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    if (!line.empty() && indent + display_width(line) + 1 + display_width(word) > width) flush();
    if (!word.empty()) line += (line.empty() ? "" : " ") + std::string(word);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  flush();
  return out;
}

std::string folded(std::string_view text, std::size_t width) {
  if (width == 0) return std::string(text);
  std::string out;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (display_width(line) <= width) {
      out += line;
    } else {
      const std::size_t lead = std::min(line.find_first_not_of(' '), line.size());
      const std::size_t indent = std::min(lead + 2, width / 2);
      const auto pieces = broken(line, width, width - indent);
      for (std::size_t i = 0; i < pieces.size(); ++i)
        out += (i == 0 ? "" : "\n" + std::string(indent, ' ')) + pieces[i];
    }
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

}  // namespace deck
