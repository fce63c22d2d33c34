// Lines of decks, the document that lists them, and one document of those of all shards.
#include "batch/record.hpp"

#include <algorithm>
#include <filesystem>

#include "common.hpp"
#include "deck/text/source.hpp"
#include "report/shared/json.hpp"
#include "text/shared/read_json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

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
  const Json document = read_json<Json>(text, keep);
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
  json.begin_object();
  for (const auto& [name, member] : document.items()) {
    json.key(name);
    if (!member.is_array() || member.empty() || !member.front().is_object()) {
      json.raw(member.dump());
      continue;
    }
    json.begin_array();
    for (const Json& item : member) json.raw(item.dump());
    json.end_array();
  }
  json.end_object();
  return text;
}

Json make_summary(const Json& verb, const Json& arguments, const std::map<std::size_t, Json>& decks,
                  const Shard& shard, std::size_t all) {
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
  return out;
}

std::string summary_name(const Shard& shard) {
  if (shard.whole()) return "summary.json";
  return "summary-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".json";
}

Result<Json> merge_shards(const std::string& directory) try {
  std::map<std::string, Json> parts;
  std::error_code ec;
  for (auto it = fs::directory_iterator(directory, ec); !ec && it != fs::directory_iterator();
       it.increment(ec)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with("summary-") || !name.ends_with(".json")) continue;
    const auto source = Source::open(it->path().string(), Limits{});
    if (!source) return source.error();
    parts[name] = read_json<Json>((*source)->bytes());
    if (parts[name].is_discarded()) return refuse(it->path().string() + " is not JSON");
  }
  if (parts.empty()) return refuse("there is no summary-i-of-n.json in " + directory);
  const Json first = parts.begin()->second;
  const auto shards = first.at("shard").at("count").get<std::size_t>();
  const Json& all = first.at("shard").at("decks_of_all");
  std::map<std::size_t, Json> whole;
  std::string missing;
  for (std::size_t i = 1; i <= shards; ++i) {
    const auto found = parts.extract(summary_name({i, shards}));
    if (found.empty()) {
      missing += " " + std::to_string(i) + "/" + std::to_string(shards);
      continue;
    }
    const Json& part = found.mapped();
    const Json &shard = part.at("shard"), &decks = part.at("decks");
    (void)worst_code(decks);
    for (const char* same : {"schema", "tool", "verb", "arguments"})
      if (part.at(same) != first.at(same) || shard.at("decks_of_all") != all)
        return refuse(found.key() +
                      " has another list of decks, verb, options or version of the program than "
                      "the other shards");
    for (std::size_t k = 0; k < decks.size(); ++k)
      whole.emplace(shard.at("positions").at(k).get<std::size_t>(), decks.at(k));
  }
  if (!missing.empty()) return refuse("these shards are not finished:" + missing);
  if (!parts.empty())
    return refuse(directory + " has summaries of " + std::to_string(shards) +
                  " shards and others (" + parts.begin()->first +
                  "); remove those that do not belong to this run");
  if (whole.size() != all.get<std::size_t>())
    return refuse(
        "the shards do not have all decks: the list, or files that the decks share, changed "
        "between the runs; run them again");
  return make_summary(first.at("verb"), first.at("arguments"), whole, {}, whole.size());
} catch (const std::exception& e) {
  return refuse(directory +
                " has a summary-i-of-n.json that deck batch did not write: " + e.what());
}

}  // namespace deck::cli
