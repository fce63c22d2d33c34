// Reads JSON of unknown origin with a limit on nesting: copying and printing recurse once per
// level. Private to the library and its tools.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace deck {

/// True if the nesting is deeper than in any document of deck.
inline bool is_nested_too_deep(std::string_view json) {
  constexpr std::size_t most = 100;
  std::size_t open = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      if (++open > most) return true;
    } else if (!in_text && (c == ']' || c == '}')) {
      open -= open > 0;
    }
  }
  return false;
}

/// The value; is_discarded() if the text is not JSON or nested too deep. `each`: callback of
/// Json::parse.
template <class Json>
Json read_json(std::string_view text, const typename Json::parser_callback_t& each = nullptr) {
  if (is_nested_too_deep(text)) return Json(Json::value_t::discarded);
  return Json::parse(text.begin(), text.end(), each, false);
}

}  // namespace deck
