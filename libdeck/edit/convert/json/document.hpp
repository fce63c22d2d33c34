// The JSON document of a deck while it is read: places in it, and the first thing that is wrong.
// Private to the edit stage.
#pragma once
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace deck::detail {

using Json = nlohmann::json;

/// Thrown inside this folder only: what is wrong, and the way to it from the top of the document.
struct Wrong {
  std::vector<std::string> path;
  std::string what;
};

/// Where we are in the document. Turned into text only when something is wrong.
struct Path {
  const Path* parent = nullptr;
  std::string_view key;
  std::size_t index = 0;
  std::vector<std::string> segments() const;
};

[[noreturn]] void fail(const Path& path, std::string what);

/// The document that `path` leads through, for people: "a_0000.rad, /INTER/TYPE7/3, card "gap",
/// Gapmin". Empty where it leads into no file.
std::string place_in_deck(const Json& root, const std::vector<std::string>& path);

/// A value as text; a number with the digits that it needs.
std::string shown(const Json& json);

const Json& member(const Json& object, const char* key, const Path& path);
/// nullptr if there is no such member.
const Json* optional_member(const Json& object, const char* key, const Path& path);
/// Fails for a member that is none of `known`.
void only(const Json& object, std::initializer_list<std::string_view> known, const Path& path);

const Json& array_of(const Json& json, const Path& path);
const std::string& string_of(const Json& json, const Path& path);
bool bool_of(const Json& json, const Path& path);
/// Integer of a JSON number; numbers beyond 64 bits are refused.
std::int64_t integer_of(const Json& json, const Path& path);

/// True for a file that the document names and does not carry.
bool is_external(const Json& file, const Path& path);
/// True if `sum` is there and is that of `text`: the text is what was once written there.
bool untouched(const Json& object, const char* sum, const std::string& text, const Path& path);

}  // namespace deck::detail
