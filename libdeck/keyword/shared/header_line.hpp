// What of a keyword line is the header, and what is wrong with its form. Private to the library.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "deck/keyword/deck.hpp"

namespace deck::detail {

/// The line buffer of the reference solver, counted from the first slash.
inline constexpr std::size_t header_columns = 202;

/// Bytes [begin, end) of a keyword line. Only blanks stand before `slash`.
struct HeaderPlace {
  std::uint32_t file;
  std::uint64_t begin, slash, end;
};
/// Reports text behind the last column (DK012) and blanks at which the solver reads another keyword
/// (DK052). `header` is the line from the slash on, without its comment.
void check_header_line(Deck& deck, const HeaderPlace& place, std::string_view header);

/// The header without its comment: a '#' behind a blank starts one.
inline std::string_view without_comment(std::string_view header) {
  const auto blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  for (std::size_t hash = 1; hash < header.size(); ++hash) {
    if (header[hash] != '#' || !blank(header[hash - 1])) continue;
    header = header.substr(0, hash);
    while (!header.empty() && blank(header.back())) header.remove_suffix(1);
    break;
  }
  return header;
}

}  // namespace deck::detail
