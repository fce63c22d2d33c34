// The columns that text takes on a terminal, and text that is folded or cut to a number of them.
// Escape codes (colours) take none, East Asian characters two.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace deck {

/// Columns of one character: 0 for an accent that stands over the one before it, 2 for a wide one.
std::size_t character_width(std::uint32_t code);
/// Columns of a text; a byte that is no UTF-8 takes one.
std::size_t display_width(std::string_view text);

/// What an editor's ruler shows over a column, counted from 1.
constexpr char ruler_mark(std::size_t column) {
  return column % 10 == 0 ? static_cast<char>('0' + column / 10 % 10) : column % 5 == 0 ? '+' : '.';
}

/// `text`, or as much of it as leaves room for "…" behind it.
std::string cut_to(std::string_view text, std::size_t width);

/// `text` in pieces of at most `first` columns, and `rest` for all but the first: broken behind
/// blanks, commas, colons and slashes, or where nothing else helps inside a word. Nothing is lost
/// but blanks where it is broken.
std::vector<std::string> broken(std::string_view text, std::size_t first, std::size_t rest);

/// One paragraph: words behind `indent` blanks, as many as `width` holds, however many blanks were
/// between them.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width);

/// Lines longer than `width` (0: none is) continued on further ones, a little further in.
std::string folded(std::string_view text, std::size_t width);

}  // namespace deck
