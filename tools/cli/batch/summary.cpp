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

SummaryEntry entry_of(const nlohmann::ordered_json& entry) {
  return {json_line(entry), entry.at("exit_code").get<int>(),
          entry.at("status").get<std::string>()};
}

SummaryEntry summary_entry(const EntryFacts& f) {
  std::string line = json_line([&](JsonWriter& json) {
    const auto text_or_null = [&](const char* name, std::string_view value) {
      json.key(name);
      if (value.empty())
        json.null();
      else
        json.value(value);
    };
    json.begin_object(true).field("deck", f.deck).field("status", f.status);
    text_or_null("result", f.result);
    json.field("exit_code", f.code);
    text_or_null("error", f.error);
    json.key("verdict").raw(f.verdict.empty() ? "null" : f.verdict);
    text_or_null("gate", !f.gate ? "" : *f.gate ? "passed" : "failed");
    json.key("counts").raw(f.counts.empty() ? "{}" : f.counts).end_object();
  });
  return {std::move(line), f.code, std::string(f.status)};
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
    for (const auto& e : json.at("decks")) s.entries.push_back(entry_of(e));
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

std::string summary_name(const Shard& shard) {
  if (shard.whole()) return "summary.json";
  return "summary-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".json";
}

namespace {

/// The summaries of all shards.
Result<std::vector<Summary>> read_parts(const std::string& directory) {
  const auto refuse = [](const std::string& why) { return Error{Error::Code::config, why}; };
  std::vector<Summary> parts;
  std::set<std::string> names;
  std::error_code ec;
  for (auto it = fs::directory_iterator(directory, ec); !ec && it != fs::directory_iterator();
       it.increment(ec))
    if (const std::string name = it->path().filename().string();
        name.starts_with("summary-") && name.ends_with(".json"))
      names.insert(name);
  if (ec) return refuse("cannot read " + directory + ": " + ec.message());
  if (names.empty()) return refuse("there is no summary-i-of-n.json in " + directory);
  for (const std::string& name : names) {
    const auto source = Source::open(directory + "/" + name, Limits{});
    if (!source) return refuse(source.error().message);
    auto summary = parse_summary((*source)->bytes());
    if (!summary) return refuse(directory + "/" + name + ": " + summary.error().message);
    parts.push_back(std::move(*summary));
  }
  const std::size_t shards = parts.front().shard.count;
  std::string missing;
  for (std::size_t i = 1; i <= shards; ++i)
    if (const Shard shard{i, shards}; names.erase(summary_name(shard)) == 0)
      missing += " " + std::to_string(i) + "/" + std::to_string(shards);
  if (!missing.empty()) return refuse("these shards are not finished:" + missing);
  if (!names.empty())
    return refuse(directory + " has summaries of " + std::to_string(shards) +
                  " shards and others (" + *names.begin() +
                  "); remove those that do not belong to this run");
  return parts;
}

}  // namespace

Result<Summary> merge_shards(const std::string& directory) {
  const auto refuse = [](const std::string& why) { return Error{Error::Code::config, why}; };
  const auto parts = read_parts(directory);
  if (!parts) return parts.error();
  Summary merged = parts->front();
  merged.entries.clear();
  merged.positions.clear();
  merged.shard = {};
  std::map<std::size_t, SummaryEntry> whole;
  for (const Summary& p : *parts) {
    if (p.verb != merged.verb || p.arguments != merged.arguments || p.tool != merged.tool ||
        p.all != merged.all)
      return refuse(summary_name(p.shard) +
                    " has another list of decks, verb, options or version "
                    "of the program than the other shards");
    for (std::size_t k = 0; k < p.entries.size(); ++k) whole.emplace(p.positions[k], p.entries[k]);
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

}  // namespace deck::cli
