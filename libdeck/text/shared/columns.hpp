// Columns, words and parts of a line.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace deck::detail {

/// Ids have 32 bits in the solver.
inline constexpr std::int64_t largest_id = 2147483647;

/// Titles are cut here.
inline constexpr std::size_t title_columns = 100;

/// True for characters of parameter names.
inline bool name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

inline bool is_blank(char c) { return static_cast<unsigned char>(c) <= ' '; }
inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

inline std::string_view trim_right(std::string_view s) {
  while (!s.empty() && is_blank(s.back())) s.remove_suffix(1);
  return s;
}
inline std::string_view trim_left(std::string_view s) {
  while (!s.empty() && is_blank(s.front())) s.remove_prefix(1);
  return s;
}
inline std::string_view trim(std::string_view s) {
  s = trim_left(s);
  return trim_right(s);
}
/// Columns first to last, 1-based, cut at the end of the line.
inline std::string_view columns(std::string_view line, int first, int last) {
  const auto begin = static_cast<std::size_t>(first - 1);
  if (begin >= line.size()) return {};
  return line.substr(begin, static_cast<std::size_t>(last - first + 1));
}
/// The words of a line, separated by blanks.
inline std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> out;
  for (std::size_t at = line.find_first_not_of(' '); at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    out.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(' ', end);
  }
  return out;
}
/// The parts of a text between separators; no empty part after a final one.
inline std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> out;
  while (!text.empty()) {
    out.push_back(text.substr(0, text.find(separator)));
    text.remove_prefix(std::min(out.back().size() + 1, text.size()));
  }
  return out;
}
/// True if the header belongs to the keyword or one below it: "/INTER" for "/INTER/TYPE7/1".
inline bool is_below(std::string_view header, std::string_view keyword) {
  return header.starts_with(keyword) &&
         (header.size() == keyword.size() || header[keyword.size()] == '/');
}

}  // namespace deck::detail
