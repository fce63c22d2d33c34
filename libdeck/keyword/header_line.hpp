// What of a keyword line is the header. Private to the library.
#pragma once
#include <string_view>

namespace deck::detail {

/// The header without its comment: a '#' behind a blank starts one. Before version 51 the header
/// holds the title, which may contain anything.
inline std::string_view without_comment(std::string_view header, int version) {
  if (version < 51) return header;
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
