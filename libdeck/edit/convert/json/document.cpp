// Access to the members of a deck's JSON document, each with its place where it is wrong.
#include "edit/convert/json/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "keyword/shared/deck_json_cells.hpp"

namespace deck::detail {
namespace {

std::string found(const Json& json, const char* expected) {
  return fmt::format("expected {}, found {}", expected, json.type_name());
}

/// The member or element that a segment names; nullptr: none.
const Json* step(const Json* json, const std::string& segment) {
  if (json->is_object()) {
    const auto it = json->find(segment);
    return it == json->end() ? nullptr : &*it;
  }
  if (!json->is_array() || segment.find_first_not_of("0123456789") != segment.npos) return nullptr;
  const std::size_t index = std::stoul(segment);
  return index < json->size() ? &(*json)[index] : nullptr;
}

std::string text_at(const Json& object, const char* key) {
  const auto it = object.is_object() ? object.find(key) : object.end();
  return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}

/// Name of the value behind column `index` of a row; 0 is its text.
std::string row_value(const Json& item, std::size_t index) {
  if (index == 0 || !item.contains("fields") || !item["fields"].is_array()) return {};
  const Json& names = item["fields"];
  if (names.empty()) return {};
  const Json& name = names[std::min(index, names.size()) - 1];
  return name.is_string() ? name.get<std::string>() : std::string();
}

}  // namespace

std::vector<std::string> Path::segments() const {
  if (parent == nullptr) return {};
  std::vector<std::string> all = parent->segments();
  all.push_back(key.empty() ? std::to_string(index) : std::string(key));
  return all;
}

void fail(const Path& path, std::string what) { throw Wrong{path.segments(), std::move(what)}; }

std::string place_in_deck(const Json& root, const std::vector<std::string>& path) {
  // /files/F/items/I/lines/L/fields/NAME, /files/F/items/I/rows/R/V,
  // /files/F/items/I/effective/NAME
  std::vector<const Json*> at = {&root};
  for (const std::string& segment : path) {
    const Json* next = at.back() == nullptr ? nullptr : step(at.back(), segment);
    at.push_back(next);
  }
  if (path.size() < 4 || path[0] != "files" || path[2] != "items" || at[4] == nullptr) return {};
  std::vector<std::string> words;
  if (std::string name = text_at(*at[2], "path"); !name.empty()) words.push_back(std::move(name));
  const Json& item = *at[4];
  if (std::string keyword = text_at(item, "keyword"); !keyword.empty()) {
    if (item.contains("id") && item["id"].is_number_integer())
      keyword += "/" + std::to_string(item["id"].get<std::int64_t>());
    words.push_back(std::move(keyword));
  }
  if (path.size() >= 6 && path[4] == "lines" && at[6] != nullptr) {
    if (const std::string card = text_at(*at[6], "card"); !card.empty())
      words.push_back("card \"" + card + "\"");
    if (path.size() >= 8 && (path[6] == "fields" || path[6] == "columns")) words.push_back(path[7]);
  } else if (path.size() >= 6 && path[4] == "rows") {
    words.push_back("row " + path[5]);
    if (path.size() >= 7 && path[6].find_first_not_of("0123456789") == std::string::npos)
      if (std::string name = row_value(item, std::stoul(path[6])); !name.empty())
        words.push_back(std::move(name));
  } else if (path.size() >= 6 && path[4] == "effective") {
    words.push_back(path[5]);
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string shown(const Json& json) {
  return json.is_number_float() ? fmt::format("{}", json.get<double>()) : json.dump();
}

const Json& member(const Json& object, const char* key, const Path& path) {
  if (!object.is_object()) fail(path, found(object, "an object"));
  const auto it = object.find(key);
  if (it == object.end()) fail(path, fmt::format("\"{}\" is missing", key));
  return *it;
}

const Json* optional_member(const Json& object, const char* key, const Path& path) {
  if (!object.is_object()) fail(path, found(object, "an object"));
  const auto it = object.find(key);
  return it == object.end() || it->is_null() ? nullptr : &*it;
}

void only(const Json& object, std::initializer_list<std::string_view> known, const Path& path) {
  if (!object.is_object()) fail(path, found(object, "an object"));
  for (const auto& entry : object.items())
    if (std::find(known.begin(), known.end(), entry.key()) == known.end())
      fail({&path, entry.key()},
           fmt::format("unknown member; known here are {}", fmt::join(known, ", ")));
}

const Json& array_of(const Json& json, const Path& path) {
  if (!json.is_array()) fail(path, found(json, "a list"));
  return json;
}

const std::string& string_of(const Json& json, const Path& path) {
  if (!json.is_string()) fail(path, found(json, "a string"));
  return json.get_ref<const std::string&>();
}

bool bool_of(const Json& json, const Path& path) {
  if (!json.is_boolean()) fail(path, found(json, "true or false"));
  return json.get<bool>();
}

std::int64_t integer_of(const Json& json, const Path& path) {
  if (!json.is_number_integer()) fail(path, found(json, "an integer"));
  if (json.is_number_unsigned() &&
      json.get<std::uint64_t>() >
          static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    fail(path, "the number is too large");
  return json.get<std::int64_t>();
}

bool is_external(const Json& file, const Path& path) {
  const Json* external = optional_member(file, "external", path);
  if (external == nullptr || !bool_of(*external, {&path, "external"})) return false;
  only(file, {"path", "external"}, path);
  return true;
}

bool untouched(const Json& object, const char* sum, const std::string& text, const Path& path) {
  const Json* json = optional_member(object, sum, path);
  return json != nullptr && string_of(*json, {&path, sum}) == sum_of_text(text);
}

}  // namespace deck::detail
