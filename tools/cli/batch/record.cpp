// Keeps records as JSON.
#include "batch/record.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/shared/hash.hpp"
#include "batch/json.hpp"
#include "deck/text/source.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

std::string hex(std::uint64_t v) { return fmt::format("{:016x}", v); }

std::uint64_t from_hex(const nlohmann::ordered_json& v) {
  return std::stoull(v.get<std::string>(), nullptr, 16);
}

void write_files(JsonWriter& json, const char* name, const std::vector<WrittenFile>& files) {
  json.key(name).begin_array(true);
  for (const WrittenFile& f : files)
    json.begin_object(true).field("path", f.path).field("hash", hex(f.hash)).end_object();
  json.end_array();
}

std::vector<WrittenFile> read_files(const nlohmann::ordered_json& list) {
  std::vector<WrittenFile> out;
  for (const auto& f : list)
    out.push_back({f.at("path").get<std::string>(), from_hex(f.at("hash"))});
  return out;
}

}  // namespace

std::uint64_t file_hash(const std::string& path) {
  const auto source = Source::open(path, Limits{});
  return source ? content_hash((*source)->bytes()) : 0;
}

bool is_as_written(const std::string& directory, const WrittenFile& file) {
  return file_hash((fs::path(directory) / file.path).string()) == file.hash;
}

std::string as_utf8(std::string_view text) {
  if (std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; }))
    return std::string(text);
  std::string json;
  append_json_string(json, text);
  return nlohmann::json::parse(json).get<std::string>();
}

std::string record_text(const Record& r) {
  std::string text;
  JsonWriter json(text);
  json.begin_object(true).field("verb", r.verb).key("decks").begin_array(true);
  for (const std::string& deck : r.decks) json.value(deck);
  json.end_array()
      .field("settings", hex(r.settings))
      .field("contents", hex(r.contents))
      .field("done", r.done)
      .field("before", hex(r.before))
      .field("seconds", r.seconds);
  json.key("entries").begin_array(true);
  for (const SummaryEntry& e : r.entries) json.raw(e.json);
  json.end_array();
  write_files(json, "outputs", r.outputs);
  write_files(json, "former", r.former);
  json.key("losses").raw(r.losses.empty() ? "null" : r.losses).end_object();
  return text;
}

std::optional<Record> parse_record(std::string_view text) {
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    Record r;
    r.verb = json.at("verb").get<std::string>();
    r.decks = json.at("decks").get<std::vector<std::string>>();
    r.settings = from_hex(json.at("settings"));
    r.contents = from_hex(json.at("contents"));
    r.done = json.at("done").get<bool>();
    r.before = from_hex(json.at("before"));
    r.seconds = json.at("seconds").get<double>();
    for (const auto& e : json.at("entries")) r.entries.push_back(entry_of(e));
    r.outputs = read_files(json.at("outputs"));
    r.former = read_files(json.at("former"));
    if (const auto& losses = json.at("losses"); !losses.is_null()) r.losses = json_line(losses);
    return r;
  } catch (const std::exception&) {  // not ours
    return std::nullopt;
  }
}

std::string record_path(const std::string& directory, const std::string& result) {
  return directory + "/.batch/" + fs::path(result).stem().string() + ".record";
}

std::map<std::string, Record> read_records(const std::string& directory) {
  std::map<std::string, Record> out;
  std::error_code ec;
  for (auto it = fs::directory_iterator(directory + "/.batch", ec);
       !ec && it != fs::directory_iterator(); it.increment(ec)) {
    if (it->path().extension() != ".record") continue;
    const auto source = Source::open(it->path().string(), Limits{});
    auto record = source ? parse_record((*source)->bytes()) : std::nullopt;
    if (record) out.emplace(it->path().string(), std::move(*record));
  }
  return out;
}

std::string program_identity() {
  const std::string program = "/proc/self/exe";
  std::string text = std::string(library_version()) + " " + hex(file_hash(program));
  Dl_info library{};  // in a program that is linked statically that is the program itself
  std::error_code ec;
  if (dladdr(reinterpret_cast<const void*>(&library_version), &library) != 0 &&
      !fs::equivalent(library.dli_fname, program, ec) && !ec)
    text += " " + hex(file_hash(library.dli_fname));
  return text;
}

}  // namespace deck::cli
