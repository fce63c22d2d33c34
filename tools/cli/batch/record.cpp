// Writes and checks the journal of finished decks.
#include "batch/record.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>
#include <ctime>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "batch/json.hpp"
#include "deck/text/source.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {

// ---- files ----------------------------------------------------------------------------------

namespace {

std::int64_t nanoseconds(const timespec& t) {
  return static_cast<std::int64_t>(t.tv_sec) * 1000000000 + t.tv_nsec;
}

std::optional<std::string> contents(const std::string& path) {
  const auto source = Source::open(path, Limits{});  // regular files only
  if (!source) return std::nullopt;
  return std::string((*source)->bytes());
}

}  // namespace

std::int64_t file_clock_now() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return nanoseconds(now);
}

FileState file_state(const std::string& path, std::string_view bytes, std::int64_t since) {
  FileState state{path, bytes.size(), 0, content_hash(bytes)};
  struct stat status {};
  // File times advance in steps of some milliseconds, and clocks of servers differ.
  constexpr std::int64_t margin = 2000000000;
  if (stat(path.c_str(), &status) == 0 &&
      static_cast<std::uint64_t>(status.st_size) == bytes.size() &&
      nanoseconds(status.st_mtim) < since - margin)
    state.mtime = nanoseconds(status.st_mtim);
  return state;
}

std::optional<FileState> file_state(const std::string& path) {
  const std::int64_t since = file_clock_now();
  const auto text = contents(path);
  if (!text) return std::nullopt;
  return file_state(path, *text, since);
}

bool Freshness::unchanged(const FileState& state) {
  const auto [it, is_new] = seen_.try_emplace(state.path);
  Seen& now = it->second;
  if (is_new) {
    struct stat status {};
    if (stat(state.path.c_str(), &status) == 0 && S_ISREG(status.st_mode)) {
      now.size = static_cast<std::uint64_t>(status.st_size);
      now.mtime = nanoseconds(status.st_mtim);
    }
  }
  if (now.size != state.size) return false;
  if (state.mtime != 0 && now.mtime == state.mtime) return true;
  if (!now.hash) {
    const auto text = contents(state.path);
    if (!text) return false;
    now.hash = content_hash(*text);
  }
  return now.hash == state.hash;
}

bool Freshness::holds(const Record& record, const std::string& directory, std::uint64_t key,
                      const std::string& result, const std::vector<std::string>& settings) {
  if (record.key != key || record.result != as_utf8(result)) return false;
  if (record.settings.size() != settings.size()) return false;
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (record.settings[i].path != as_utf8(settings[i]) || !unchanged(record.settings[i]))
      return false;
  for (const auto* states : {&record.files, &record.outputs})
    for (const FileState& f : *states)
      if (!unchanged(f)) return false;
  if (result.empty()) return true;
  const auto text = contents(directory + "/" + result);
  return text && text->size() == record.bytes && content_hash(*text) == record.hash;
}

// ---- records --------------------------------------------------------------------------------

std::string as_utf8(std::string_view text) {
  if (std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; }))
    return std::string(text);
  std::string json;
  append_json_string(json, text);
  return nlohmann::json::parse(json).get<std::string>();
}

namespace {

std::string hex(std::uint64_t v) { return fmt::format("{:016x}", v); }

std::uint64_t from_hex(const nlohmann::ordered_json& v) {
  return std::stoull(v.get<std::string>(), nullptr, 16);
}

void write_states(JsonWriter& json, const std::vector<FileState>& states) {
  json.begin_array(true);
  for (const FileState& f : states)
    json.begin_object(true)
        .field("path", f.path)
        .field("size", f.size)
        .field("mtime", f.mtime)
        .field("hash", hex(f.hash))
        .end_object();
  json.end_array();
}

std::vector<FileState> read_states(const nlohmann::ordered_json& list) {
  std::vector<FileState> out;
  for (const auto& f : list)
    out.push_back({f.at("path").get<std::string>(), f.at("size").get<std::uint64_t>(),
                   f.at("mtime").get<std::int64_t>(), from_hex(f.at("hash"))});
  return out;
}

}  // namespace

std::string record_line(const Record& r) {
  std::string text;
  JsonWriter json(text);
  json.begin_object(true)
      .field("deck", r.deck)
      .field("result", r.result)
      .field("key", hex(r.key))
      .field("bytes", r.bytes)
      .field("hash", hex(r.hash))
      .field("code", r.code)
      .field("seconds", r.seconds);
  json.key("files");
  write_states(json, r.files);
  json.key("settings");
  write_states(json, r.settings);
  if (!r.outputs.empty()) {
    json.key("outputs");
    write_states(json, r.outputs);
  }
  if (r.written) json.field("written", true);
  if (r.announced) json.field("announced", true);
  if (!r.losses.empty()) json.key("losses").raw(r.losses);
  json.key("entry").raw(r.entry).end_object();
  text.erase(text.find_last_not_of('\n') + 1);
  return text + "\n";
}

std::optional<Record> parse_record(std::string_view line) {
  try {
    const auto json = nlohmann::ordered_json::parse(line);
    Record r;
    r.deck = json.at("deck").get<std::string>();
    r.result = json.at("result").get<std::string>();
    r.key = from_hex(json.at("key"));
    r.bytes = json.at("bytes").get<std::uint64_t>();
    r.hash = from_hex(json.at("hash"));
    r.code = json.at("code").get<int>();
    r.seconds = json.at("seconds").get<double>();
    r.files = read_states(json.at("files"));
    r.settings = read_states(json.at("settings"));
    if (json.contains("outputs")) r.outputs = read_states(json.at("outputs"));
    r.written = json.value("written", false);
    r.announced = json.value("announced", false);
    if (json.contains("losses")) r.losses = json_line(json.at("losses"));
    r.entry = json_line(json.at("entry"));
    return r;
  } catch (const std::exception&) {  // a line that was cut off, or not ours
    return std::nullopt;
  }
}

std::vector<Record> parse_records(std::string_view lines) {
  std::vector<Record> out;
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(line.size() + 1, lines.size()));
    if (auto record = parse_record(line)) out.push_back(std::move(*record));
  }
  return out;
}

// ---- identity -------------------------------------------------------------------------------

namespace {

/// Appends the build id of the program and of a shared libdeck.
int add_build_id(dl_phdr_info* info, std::size_t, void* data) {
  auto& text = *static_cast<std::string*>(data);
  const std::string_view name = info->dlpi_name == nullptr ? "" : info->dlpi_name;
  if (!name.empty() && name.find("libdeck") == name.npos) return 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& header = info->dlpi_phdr[i];
    if (header.p_type != PT_NOTE) continue;
    const char* at = reinterpret_cast<const char*>(info->dlpi_addr + header.p_vaddr);
    const char* const end = at + header.p_memsz;
    while (end - at > static_cast<std::ptrdiff_t>(sizeof(ElfW(Nhdr)))) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof note);
      const char* const owner = at + sizeof note;
      const char* const id = owner + (note.n_namesz + 3) / 4 * 4;
      if (id + note.n_descsz > end) break;
      if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(owner, "GNU", 4) == 0)
        for (std::size_t b = 0; b < note.n_descsz; ++b)
          text += fmt::format("{:02x}", static_cast<unsigned char>(id[b]));
      at = id + (note.n_descsz + 3) / 4 * 4;
    }
  }
  return 0;
}

}  // namespace

std::string program_identity() {
  std::string text = std::string(library_version()) + " ";
  dl_iterate_phdr(add_build_id, &text);
  return text;
}

}  // namespace deck::cli
