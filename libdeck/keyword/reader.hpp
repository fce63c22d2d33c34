// Reader: walks the include tree of a deck and cuts it into blocks. Private to the keyword stage.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "deck/keyword/deck.hpp"

namespace deck::detail {

/// Splits a header line into keyword, ids and schema. `header` is trimmed and starts with '/'.
void parse_header(const SchemaSet& schemas, Block& block);

/// Fills Deck::parameters from the /PARAMETER blocks (all files first, then evaluation).
void read_parameters(Deck& deck, const Limits& limits);

inline std::string_view trim(std::string_view s) {
  while (!s.empty() && static_cast<unsigned char>(s.front()) <= ' ') s.remove_prefix(1);
  while (!s.empty() && static_cast<unsigned char>(s.back()) <= ' ') s.remove_suffix(1);
  return s;
}
inline std::string_view trim_right(std::string_view s) {
  while (!s.empty() && static_cast<unsigned char>(s.back()) <= ' ') s.remove_suffix(1);
  return s;
}
inline std::string_view columns(std::string_view line, int first, int last) {
  const auto begin = static_cast<std::size_t>(first - 1);
  if (begin >= line.size()) return {};
  return line.substr(begin, static_cast<std::size_t>(last - first + 1));
}
inline bool starts_with_nocase(std::string_view text, std::string_view lower_case) {
  if (text.size() < lower_case.size()) return false;
  for (std::size_t i = 0; i < lower_case.size(); ++i) {
    const char c = text[i];
    if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c) != lower_case[i]) return false;
  }
  return true;
}

}  // namespace deck::detail
