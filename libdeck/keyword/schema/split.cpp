// Cuts a file of keyword schemas into its schemas without parsing them.
#include <algorithm>

#include "keyword/schema/json.hpp"

namespace deck::detail {
namespace {

/// Where the quote is that ends the string of JSON that begins at `first`.
std::size_t end_of_string(std::string_view text, std::size_t first) {
  for (std::size_t end = first;; ++end) {
    end = std::min(text.find('"', end), text.size());
    std::size_t unescaped = end;
    while (unescaped > first && text[unescaped - 1] == '\\') --unescaped;
    if ((end - unescaped) % 2 == 0 || end == text.size()) return end;
  }
}

std::size_t after_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && static_cast<unsigned char>(text[at]) <= ' ') ++at;
  return at;
}

}  // namespace

std::vector<SchemaText> split_schemas(std::string_view text) {
  std::vector<SchemaText> found;
  int depth = 0, level = 0;  // level: depth of the schema objects, 1 or 3; 0: not known yet
  std::size_t begin = 0;     // of the current schema object
  std::string_view key;      // last string at `level` that was followed by ':'
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '{' || c == '[') {
      if (++depth == level && c == '{') {
        begin = i;
        found.emplace_back();
      } else if (depth == 1) {
        begin = i;
      }
    } else if (c == '}' || c == ']') {
      if (depth == level && !found.empty()) found.back().text = text.substr(begin, i + 1 - begin);
      if (--depth <= level) key = {};
    } else if (c == '"') {
      const std::size_t first = i + 1;
      i = end_of_string(text, first);
      const auto string = text.substr(first, i - first);
      const std::size_t next = after_blanks(text, i + 1);
      const bool is_key = next < text.size() && text[next] == ':';
      if (level == 0 && is_key && string != "$schema") {
        level = string == "schemas" ? 3 : 1;
        if (level == 1) found.emplace_back();
      }
      if (is_key && depth == level) {
        key = string;
      } else if (!found.empty() && key == "keyword" && depth == level) {
        found.back().keyword = string;
      } else if (!found.empty() && key == "aliases" && depth == level + 1) {
        found.back().aliases.emplace_back(string);
      }
    }
  }
  return found;
}

}  // namespace deck::detail
