// Cuts a file of keyword schemas into its schemas without parsing them.
#include <algorithm>

#include "keyword/schema/json.hpp"

namespace deck::detail {

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
      while (++i < text.size() && text[i] != '"')
        if (text[i] == '\\') ++i;
      const auto string = text.substr(std::min(first, text.size()), i - first);
      const auto next = text.find_first_not_of(" \t\r\n", i + 1);
      const bool is_key = next != std::string_view::npos && text[next] == ':';
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
