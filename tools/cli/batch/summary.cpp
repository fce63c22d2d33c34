// Builds summary.json and merges those of shards.
#include "batch/summary.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "batch/json.hpp"
#include "common.hpp"
#include "deck/text/source.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;

int Summary::worst() const {
  int worst = exit_clean;
  for (const SummaryEntry& e : entries) worst = std::max(worst, e.code);
  return worst;
}

std::size_t Summary::count(std::string_view status) const {
  return static_cast<std::size_t>(std::count_if(
      entries.begin(), entries.end(), [&](const SummaryEntry& e) { return e.status == status; }));
}

std::string_view status_of(int code) {
  if (code == exit_clean) return "clean";
  if (code == exit_findings) return "findings";
  return code == exit_input ? "unreadable" : "failed";
}

SummaryEntry entry_of(std::string json, int code) {
  const auto parsed = nlohmann::json::parse(json, nullptr, false);
  const auto status = parsed.is_object() ? parsed.find("status") : parsed.end();
  const bool known = parsed.is_object() && status != parsed.end() && status->is_string();
  return {std::move(json), code, known ? status->get<std::string>() : std::string(status_of(code))};
}

std::string summary_entry(std::string_view deck, std::string_view status, std::string_view result,
                          int code, std::string_view error, std::string_view verdict,
                          std::string_view counts, std::optional<bool> gate) {
  std::string text;
  JsonWriter json(text);
  const auto text_or_null = [&](const char* name, std::string_view value) {
    json.key(name);
    if (value.empty())
      json.null();
    else
      json.value(value);
  };
  json.begin_object(true).field("deck", deck).field("status", status);
  text_or_null("result", result);
  json.field("exit_code", code);
  text_or_null("error", error);
  json.key("verdict").raw(verdict.empty() ? "null" : verdict);
  text_or_null("gate", !gate ? "" : *gate ? "passed" : "failed");
  json.key("counts").raw(counts.empty() ? "{}" : counts).end_object();
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

std::string summary_json(const Summary& s) {
  std::string text;
  JsonWriter json(text);
  json.begin_object();
  write_json_head(json, "deck/batch", 1);
  json.field("verb", s.verb);
  json.key("arguments").begin_array(true);
  for (const std::string& a : s.arguments) json.value(a);
  json.end_array();
  json.key("shard");
  if (s.shard.whole())
    json.null();
  else
    json.begin_object(true)
        .field("index", s.shard.index)
        .field("count", s.shard.count)
        .field("decks_of_all", s.all);
  if (!s.shard.whole()) {
    json.key("positions").begin_array(true);
    for (const std::size_t p : s.positions) json.value(p);
    json.end_array().end_object();
  }
  json.key("totals")
      .begin_object(true)
      .field("decks", s.entries.size())
      .field("clean", s.count("clean"))
      .field("findings", s.count("findings"))
      .field("not_examined", s.count("not-examined"))
      .field("unreadable", s.count("unreadable"))
      .field("skipped", s.count("skipped"))
      .field("failed", s.count("failed"))
      .end_object();
  json.key("decks").begin_array();
  for (const SummaryEntry& e : s.entries) json.raw(e.json);
  json.end_array().key("includes").begin_array();
  for (const IncludeFile& f : s.includes)
    json.begin_object(true).field("file", f.path).field("why", f.why).end_object();
  json.end_array().end_object();
  return text;
}

Result<Summary> parse_summary(std::string_view text) {
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    if (json.at("schema").at("id") != "deck/batch")
      return Error{Error::Code::syntax, "not a summary of deck batch"};
    Summary s;
    s.tool = json.at("tool").at("version").get<std::string>();
    s.verb = json.at("verb").get<std::string>();
    s.arguments = json.at("arguments").get<std::vector<std::string>>();
    for (const auto& e : json.at("decks"))
      s.entries.push_back(entry_of(json_line(e), e.at("exit_code").get<int>()));
    if (json.contains("includes"))
      for (const auto& f : json.at("includes"))
        s.includes.push_back({f.at("file").get<std::string>(), f.at("why").get<std::string>()});
    s.all = s.entries.size();
    if (const auto& shard = json.at("shard"); shard.is_object()) {
      s.shard = {shard.at("index").get<std::size_t>(), shard.at("count").get<std::size_t>()};
      s.all = shard.at("decks_of_all").get<std::size_t>();
      s.positions = shard.at("positions").get<std::vector<std::size_t>>();
      if (s.positions.size() != s.entries.size())
        return Error{Error::Code::syntax, "as many positions as decks were expected"};
    } else {
      for (std::size_t i = 0; i < s.entries.size(); ++i) s.positions.push_back(i);
    }
    return s;
  } catch (const std::exception& e) {
    return Error{Error::Code::syntax, std::string("not a summary of deck batch: ") + e.what()};
  }
}

Result<Summary> merge_summaries(const std::vector<Summary>& parts) {
  const auto refuse = [](const std::string& why) { return Error{Error::Code::config, why}; };
  if (parts.empty()) return refuse("there is nothing to merge");
  Summary merged = parts.front();
  merged.entries.clear();
  merged.positions.clear();
  merged.shard = {};
  std::map<std::size_t, SummaryEntry> whole;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Summary& p = parts[i];
    const std::string name = "shard " + std::to_string(i + 1);
    if (p.verb != merged.verb || p.arguments != merged.arguments)
      return refuse(name + " ran another verb or other options than shard 1");
    if (p.tool != merged.tool)
      return refuse(name + " was made by version " + p.tool + ", shard 1 by " + merged.tool);
    if (p.all != merged.all) return refuse(name + " had another list of decks than shard 1");
    for (std::size_t k = 0; k < p.entries.size(); ++k)
      if (!whole.emplace(p.positions[k], p.entries[k]).second)
        return refuse(name + " has a deck that another shard has too");
  }
  if (whole.size() != merged.all)
    return refuse(
        "the shards do not have all decks: the list, or files that the decks share, changed "
        "between the runs; run them again");
  for (auto& [position, entry] : whole) {
    merged.positions.push_back(position);
    merged.entries.push_back(std::move(entry));
  }
  return merged;
}

std::string summary_name(const Shard& shard) {
  if (shard.whole()) return "summary.json";
  return "summary-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".json";
}

Result<std::vector<Summary>> read_shard_summaries(const std::string& directory) {
  const auto refuse = [](const std::string& why) { return Error{Error::Code::config, why}; };
  std::map<std::size_t, std::map<std::size_t, Summary>> sets;
  std::error_code ec;
  for (auto it = fs::directory_iterator(directory, ec); !ec && it != fs::directory_iterator();
       it.increment(ec)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with("summary-") || !name.ends_with(".json")) continue;
    const auto source = Source::open(it->path().string(), Limits{});
    if (!source) return refuse(source.error().message);
    auto summary = parse_summary((*source)->bytes());
    if (!summary) return refuse(it->path().string() + ": " + summary.error().message);
    if (summary_name(summary->shard) != name)
      return refuse(it->path().string() + " says it is " + summary_name(summary->shard));
    sets[summary->shard.count].emplace(summary->shard.index, std::move(*summary));
  }
  if (ec) return refuse("cannot read " + directory + ": " + ec.message());
  if (sets.empty()) return refuse("there is no summary-i-of-n.json in " + directory);
  if (sets.size() > 1)
    return refuse(directory + " has summaries of " + std::to_string(sets.begin()->first) +
                  " and of " + std::to_string(sets.rbegin()->first) +
                  " shards; remove those that do not belong to this run");
  auto& [count, set] = *sets.begin();
  std::string missing;
  for (std::size_t i = 1; i <= count; ++i)
    if (!set.contains(i)) missing += " " + std::to_string(i) + "/" + std::to_string(count);
  if (!missing.empty()) return refuse("these shards are not finished:" + missing);
  std::vector<Summary> parts;
  for (auto& [index, summary] : set) parts.push_back(std::move(summary));
  return parts;
}

}  // namespace deck::cli
