// Lines of decks, the document that lists them, and one document of those of all shards.
#include "batch/summary.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "common.hpp"
#include "deck/text/source.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

/// On one line, but the document itself and its lists of objects: to these `depth` is 0 and 1.
void spell(JsonWriter& json, const Json& v, int depth) {
  if (v.is_object()) {
    json.begin_object(depth > 0);
    for (const auto& [name, member] : v.items()) spell(json.key(name), member, depth + 1);
    json.end_object();
  } else if (v.is_array()) {
    json.begin_array(depth > 1 || v.empty() || !v.front().is_object());
    for (const auto& item : v) spell(json, item, depth + 1);
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

Error refuse(std::string why) { return {Error::Code::config, std::move(why)}; }

}  // namespace

std::string as_utf8(std::string_view text) {
  std::string json;
  append_json_string(json, text);
  return Json::parse(json).get<std::string>();
}

Json deck_line(std::string_view deck, int code, std::string_view error, std::string_view status) {
  if (status.empty())
    status = code == exit_clean      ? "clean"
             : code == exit_findings ? "findings"
             : code == exit_input    ? "unreadable"
                                     : "failed";
  Json line = {{"deck", as_utf8(deck)}, {"status", status},        {"result", nullptr},
               {"exit_code", code},     {"error", nullptr},        {"verdict", nullptr},
               {"gate", nullptr},       {"counts", Json::object()}};
  if (!error.empty()) line["error"] = as_utf8(error);
  return line;
}

std::optional<Json> head_of(std::string_view text) {
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
  Json head = {{"verdict", nullptr}, {"gate", nullptr}, {"counts", Json::object()}};
  for (const auto& [name, value] : document.items()) {
    if (name == "verdict" && value.is_object() && !value.empty()) head[name] = value;
    if (name == "gate" && value.contains("passed"))
      head[name] = value.at("passed").get<bool>() ? "passed" : "failed";
    if (name == "examined" && value.is_number_unsigned()) head[name] = value;
    if (name == "summary" && value.is_object())
      for (const auto& [what, number] : value.items())
        if (!number.is_array()) head["counts"][what] = number;
  }
  if (interfaces) head["counts"]["interfaces"] = *interfaces;
  return head;
}

std::string text_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<double> counted(const Json& line, const char* name) {
  const auto counts = line.find("counts");
  if (counts == line.end() || !counts->contains(name) || !counts->at(name).is_number())
    return std::nullopt;
  return counts->at(name).get<double>();
}

int worst_code(const Json& decks) {
  int worst = exit_clean;
  for (const Json& line : decks) worst = std::max(worst, line.at("exit_code").get<int>());
  return worst;
}

std::string json_text(const Json& document) {
  std::string text;
  JsonWriter json(text);
  spell(json, document, 0);
  return text;
}

Json make_summary(const Json& verb, const Json& arguments, const Json& includes,
                  const std::map<std::size_t, Json>& decks, const Shard& shard, std::size_t all) {
  std::string head;
  JsonWriter json(head);
  json.begin_object();
  write_json_head(json, "deck/batch", 1);
  json.end_object();
  Json out = Json::parse(head);
  Json totals = {{"decks", decks.size()}}, lines = Json::array(), positions = Json::array();
  for (const char* status :
       {"clean", "findings", "not_examined", "unreadable", "skipped", "failed"})
    totals[status] = 0;
  for (const auto& [position, line] : decks) {
    std::string status = text_in(line, "status");
    std::replace(status.begin(), status.end(), '-', '_');
    totals[status] = totals.value(status, 0) + 1;
    lines.push_back(line);
    positions.push_back(position);
  }
  out["verb"] = verb;
  out["arguments"] = arguments;
  out["shard"] = nullptr;
  if (!shard.whole())
    out["shard"] = {{"index", shard.index},
                    {"count", shard.count},
                    {"decks_of_all", all},
                    {"positions", std::move(positions)}};
  out["totals"] = std::move(totals);
  out["decks"] = std::move(lines);
  out["includes"] = includes;
  return out;
}

std::string summary_name(const Shard& shard) {
  if (shard.whole()) return "summary.json";
  return "summary-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".json";
}

namespace {

/// The summaries of all shards, by name.
Result<std::map<std::string, Json>> read_parts(const std::string& directory) {
  std::map<std::string, Json> parts;
  std::error_code ec;
  for (auto it = fs::directory_iterator(directory, ec); !ec && it != fs::directory_iterator();
       it.increment(ec)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with("summary-") || !name.ends_with(".json")) continue;
    const auto source = Source::open(it->path().string(), Limits{});
    if (!source) return refuse(source.error().message);
    parts[name] = Json::parse((*source)->bytes(), nullptr, false);
  }
  if (ec) return refuse("cannot read " + directory + ": " + ec.message());
  if (parts.empty()) return refuse("there is no summary-i-of-n.json in " + directory);
  return parts;
}

/// Throws where a part is no summary of a shard.
Result<Json> merge_parts(const std::map<std::string, Json>& parts, const std::string& directory) {
  const Json& first = parts.begin()->second;
  const auto shards = first.at("shard").at("count").get<std::size_t>();
  std::string missing;
  std::set<std::string> wanted;
  for (std::size_t i = 1; i <= shards; ++i)
    if (!parts.contains(*wanted.insert(summary_name({i, shards})).first))
      missing += " " + std::to_string(i) + "/" + std::to_string(shards);
  if (!missing.empty()) return refuse("these shards are not finished:" + missing);
  std::map<std::size_t, Json> whole;
  for (const auto& [name, part] : parts) {
    if (!wanted.contains(name))
      return refuse(directory + " has summaries of " + std::to_string(shards) +
                    " shards and others (" + name +
                    "); remove those that do not belong to this run");
    const Json &shard = part.at("shard"), &decks = part.at("decks");
    (void)worst_code(decks);
    for (const char* same : {"schema", "tool", "verb", "arguments"})
      if (part.at(same) != first.at(same) ||
          shard.at("decks_of_all") != first.at("shard").at("decks_of_all"))
        return refuse(name +
                      " has another list of decks, verb, options or version of the program than "
                      "the other shards");
    for (std::size_t k = 0; k < decks.size(); ++k)
      whole.emplace(shard.at("positions").at(k).get<std::size_t>(), decks.at(k));
  }
  if (whole.size() != first.at("shard").at("decks_of_all").get<std::size_t>())
    return refuse(
        "the shards do not have all decks: the list, or files that the decks share, changed "
        "between the runs; run them again");
  return make_summary(first.at("verb"), first.at("arguments"), first.at("includes"), whole, {},
                      whole.size());
}

}  // namespace

Result<Json> merge_shards(const std::string& directory) {
  const auto parts = read_parts(directory);
  if (!parts) return parts.error();
  try {
    return merge_parts(*parts, directory);
  } catch (const std::exception& e) {
    return refuse(directory +
                  " has a summary-i-of-n.json that deck batch did not write: " + e.what());
  }
}

}  // namespace deck::cli
