// Reads the head of a verb's document without holding the rest.
#include "batch/json.hpp"

#include <nlohmann/json.hpp>

namespace deck::cli {
namespace {

using Json = nlohmann::ordered_json;

void write_value(JsonWriter& json, const Json& v) {
  if (v.is_object()) {
    json.begin_object(true);
    for (const auto& [name, member] : v.items()) {
      json.key(name);
      write_value(json, member);
    }
    json.end_object();
  } else if (v.is_array()) {
    json.begin_array(true);
    for (const auto& item : v) write_value(json, item);
    json.end_array();
  } else if (v.is_string()) {
    json.value(v.get_ref<const std::string&>());
  } else if (v.is_boolean()) {
    json.value(v.get<bool>());
  } else if (v.is_number_unsigned()) {
    json.value(v.get<std::uint64_t>());
  } else if (v.is_number_integer()) {
    json.value(v.get<std::int64_t>());
  } else if (v.is_number()) {
    json.value(v.get<double>());
  } else {
    json.null();
  }
}

/// The member of that name if it is an object, else an empty one.
Json object_of(const Json& document, const char* name) {
  const auto found = document.find(name);
  return found != document.end() && found->is_object() ? *found : Json::object();
}

}  // namespace

std::string json_line(const std::function<void(JsonWriter&)>& write) {
  std::string text;
  JsonWriter json(text);
  write(json);
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}
std::string json_line(const Json& value) {
  return json_line([&](JsonWriter& json) { write_value(json, value); });
}

std::optional<DocumentFacts> document_facts(std::string_view text) {
  std::string member;  // of the document
  std::optional<std::uint64_t> interfaces;
  // Of the members that are lists or objects three are kept, of "interfaces" the number is.
  const auto keep = [&](int depth, Json::parse_event_t event, Json& value) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (depth == 1 && event == Json::parse_event_t::key) member = value.get<std::string>();
    if (opens && member == "interfaces" && depth == 1) interfaces = 0;
    if (opens && member == "interfaces" && depth == 2) ++*interfaces;
    return depth != 1 || !opens || member == "summary" || member == "verdict" || member == "gate";
  };
  const Json document = Json::parse(text, keep, false);
  if (!document.is_object()) return std::nullopt;
  DocumentFacts facts;
  Json counts = object_of(document, "summary");
  for (auto it = counts.begin(); it != counts.end();)
    it = it->is_array() ? counts.erase(it) : std::next(it);
  if (interfaces) counts["interfaces"] = *interfaces;
  facts.counts = json_line(counts);
  if (const Json verdict = object_of(document, "verdict"); !verdict.empty()) {
    facts.verdict = json_line(verdict);
    facts.level = verdict.value("level", "");
  }
  if (const auto examined = document.find("examined");
      examined != document.end() && examined->is_number_unsigned())
    facts.examined = examined->get<std::uint64_t>();
  if (const Json gate = object_of(document, "gate"); gate.contains("passed"))
    facts.gate = gate.at("passed").get<bool>();
  return facts;
}

}  // namespace deck::cli
