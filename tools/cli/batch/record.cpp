// Decks of a batch and their result names; records of groups of decks; summaries, also of all
// shards.
#include "batch/record.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "common.hpp"
#include "deck/text.hpp"
#include "library.hpp"
#include "report/shared/json.hpp"
#include "text/shared/gzip.hpp"
#include "text/shared/read_json.hpp"

namespace deck::cli {

namespace {
namespace fs = std::filesystem;

/// Trimmed lines, without empty ones and comments. "-": standard input.
Result<std::vector<std::string>> manifest_lines(const std::string& path) {
  std::ifstream file;
  if (path != "-") file.open(path, std::ios::binary);
  if (!file) return config_error("cannot read the manifest " + path);
  std::istream& in = path == "-" ? std::cin : file;
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    out.push_back(line.substr(first, line.find_last_not_of(" \t\r") + 1 - first));
  }
  if (in.bad()) return config_error("cannot read the manifest " + path);
  return out;
}

/// True for names with another meaning in the output directory.
bool reserved(const std::string& stem) {
  return stem == "summary" || stem.starts_with("summary-") || stem == "losses";
}

/// The last `parents` directories and the stem: "a--b--car_0000".
std::string name_with_parents(const fs::path& path, int parents) {
  std::string name = fs::path(without_gz(path.string())).stem().string();
  fs::path dir = path.parent_path();
  for (int i = 0; i < parents && dir.has_filename(); ++i, dir = dir.parent_path())
    name = dir.filename().string() + "--" + name;
  return name;
}

/// Result names for normalized absolute paths.
std::vector<std::string> result_names(const std::vector<fs::path>& paths) {
  std::vector<int> parents(paths.size(), 0);
  std::vector<std::string> names(paths.size());
  for (bool longer = true; longer;) {
    longer = false;
    std::map<std::string, std::set<fs::path>> folders;
    for (std::size_t i = 0; i < paths.size(); ++i)
      folders[names[i] = name_with_parents(paths[i], parents[i])].insert(paths[i].parent_path());
    for (std::size_t i = 0; i < paths.size(); ++i) {
      // A directory name does not distinguish files in one directory, or files at the root.
      if ((folders[names[i]].size() < 2 && !reserved(names[i])) ||
          name_with_parents(paths[i], parents[i] + 1) == names[i])
        continue;
      ++parents[i];
      longer = true;
    }
  }
  // For names that differ only in the extension.
  std::set<std::string> used;
  for (std::string& name : names) {
    std::string candidate = name;
    for (int n = 2; reserved(candidate) || !used.insert(candidate).second; ++n)
      candidate = name + "--" + std::to_string(n);
    name = candidate;
  }
  return names;
}

}  // namespace

Result<BatchList> list_decks(std::vector<std::string> given, const std::string& manifest,
                             const std::string& output, IncludeScan& scan) {
  if (!manifest.empty()) {
    const auto lines = manifest_lines(manifest);
    if (!lines) return lines.error();
    given.insert(given.end(), lines->begin(), lines->end());
  }
  if (std::find(given.begin(), given.end(), "-") != given.end())
    return config_error(
        "standard input cannot be one of many decks; --manifest - reads the list from it");
  auto found = expand_decks(given, output);
  if (!found) return found.error();
  BatchList list;
  list.notes = extract_includes(*found, given, scan);
  std::vector<fs::path> paths;
  for (const std::string& path : *found) paths.push_back(absolute_path(path));
  const auto names = result_names(paths);
  for (std::size_t i = 0; i < names.size(); ++i)
    list.decks.push_back({(*found)[i], names[i] + ".json"});
  return list;
}

DeckFiles files_of_decks(const std::vector<std::string>& decks, IncludeScan& scan) {
  DeckFiles out;
  std::string text;
  const auto add = [&](const std::string& path, std::uint64_t contents) {
    out.paths.push_back(path);
    text += "\n" + path + " " + std::to_string(contents);
  };
  for (const std::string& deck : decks) {
    const auto tree = scan.files(deck);
    if (tree.empty()) add(deck, 0);
    for (const IncludeScan::File& f : tree) add(f.path, f.contents);
    for (const std::string& engine : engine_files_beside(deck)) add(engine, file_hash(engine));
  }
  out.contents = content_hash(text);
  return out;
}

Result<Shard> parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  if (slash != std::string::npos) {
    const IntegerCell index = read_integer(std::string_view(text).substr(0, slash));
    const IntegerCell count = read_integer(std::string_view(text).substr(slash + 1));
    if (index.status == NumberStatus::ok && count.status == NumberStatus::ok && count.value >= 1 &&
        index.value >= 1 && index.value <= count.value)
      return Shard{static_cast<std::size_t>(index.value), static_cast<std::size_t>(count.value)};
  }
  return config_error("--shard " + text + ": expected i/n, part i of n, for example 1/8 ... 8/8");
}

namespace {

/// Calls each(name, member) for all members.
template <class AnyRecord, class Each>
void visit_record(AnyRecord& r, const Each& each) {
  each("verb", r.verb);
  each("decks", r.decks);
  each("settings", r.settings);
  each("contents", r.contents);
  each("done", r.done);
  each("in_place", r.in_place);
  each("before", r.before);
  each("lines", r.lines);
  each("outputs", r.outputs);
  each("losses", r.losses);
}

}  // namespace

std::string program_identity() {
  return std::string(library_version()) + " " + std::to_string(file_hash("/proc/self/exe"));
}

std::uint64_t file_hash(const std::string& path) {
  const auto source = Source::open(path, Limits{});
  return source ? content_hash((*source)->bytes()) : 0;
}

std::string record_text(const Record& r) {
  Json json;
  visit_record(r, [&](const char* name, const auto& value) { json[name] = value; });
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<Record> parse_record(std::string_view text) {
  try {
    const Json json = read_json<Json>(text);
    Record r;
    visit_record(r, [&](const char* name, auto& value) { json.at(name).get_to(value); });
    (void)worst_code(r.lines);
    return r;
  } catch (const std::exception&) {  // not a record
    return std::nullopt;
  }
}

std::string page_name(const std::string& result) {
  return fs::path(result).replace_extension(".html").string();
}

std::string record_name(const std::string& result) {
  return ".batch/" + fs::path(result).stem().string() + ".record";
}

std::map<std::string, Record> read_records(const std::string& directory) {
  std::map<std::string, Record> out;
  for (const fs::path& file : entries_of(directory + "/.batch")) {
    if (file.extension() != ".record") continue;
    const auto source = Source::open(file.string(), Limits{});
    auto record = source ? parse_record((*source)->bytes()) : std::nullopt;
    if (record) out.emplace(".batch/" + file.filename().string(), std::move(*record));
  }
  return out;
}

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
  std::string member;  // current member of the document
  std::optional<std::uint64_t> interfaces;
  // Keeps three of the members that are lists or objects; of "interfaces" only the number.
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
  for (const fs::path& file : entries_of(directory)) {
    const std::string name = file.filename().string();
    if (!name.starts_with("summary-") || !name.ends_with(".json")) continue;
    const auto source = Source::open(file.string(), Limits{});
    if (!source) return source.error();
    parts[name] = read_json<Json>((*source)->bytes());
    if (parts[name].is_discarded()) return config_error(file.string() + " is not JSON");
  }
  if (parts.empty()) return config_error("there is no summary-i-of-n.json in " + directory);
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
        return config_error(
            found.key() +
            " has another list of decks, verb, options or version of the program than "
            "the other shards");
    for (std::size_t k = 0; k < decks.size(); ++k)
      whole.emplace(shard.at("positions").at(k).get<std::size_t>(), decks.at(k));
  }
  if (!missing.empty()) return config_error("these shards are not finished:" + missing);
  if (!parts.empty())
    return config_error(directory + " has summaries of " + std::to_string(shards) +
                        " shards and others (" + parts.begin()->first +
                        "); remove those that do not belong to this run");
  if (whole.size() != all.get<std::size_t>())
    return config_error(
        "the shards do not have all decks: the list, or files that the decks share, changed "
        "between the runs; run them again");
  return make_summary(first.at("verb"), first.at("arguments"), whole, {}, whole.size());
} catch (const std::exception& e) {
  return config_error(directory +
                      " has a summary-i-of-n.json that deck batch did not write: " + e.what());
}

}  // namespace deck::cli
