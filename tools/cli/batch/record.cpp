// Keeps records as JSON.
#include "batch/record.hpp"

#include <filesystem>

#include "base/shared/hash.hpp"
#include "deck/text/source.hpp"
#include "report/shared/json.hpp"
#include "text/shared/read_json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

/// Every member by its name in the file.
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
  } catch (const std::exception&) {  // not ours
    return std::nullopt;
  }
}

std::string record_name(const std::string& result) {
  return ".batch/" + fs::path(result).stem().string() + ".record";
}

std::map<std::string, Record> read_records(const std::string& directory) {
  std::map<std::string, Record> out;
  std::error_code ec;
  for (auto it = fs::directory_iterator(directory + "/.batch", ec);
       !ec && it != fs::directory_iterator(); it.increment(ec)) {
    if (it->path().extension() != ".record") continue;
    const auto source = Source::open(it->path().string(), Limits{});
    auto record = source ? parse_record((*source)->bytes()) : std::nullopt;
    if (record) out.emplace(".batch/" + it->path().filename().string(), std::move(*record));
  }
  return out;
}

}  // namespace deck::cli
