// What a batch leaves at its end: summary, page, loss report; and what goes because nobody needs it
// any more.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "base/shared/paths.hpp"
#include "batch/run.hpp"
#include "deck/text/source.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;

Result<void> make_own_directory(const std::string& path) {
  std::error_code ec;
  fs::create_directories(path, ec);
  if (ec) return Error{Error::Code::io, "cannot make " + path + ": " + ec.message()};
  if (fs::symlink_status(path, ec).type() == fs::file_type::directory) return {};
  return Error{Error::Code::config,
               path + " is a link, not a directory, and leads outside of the results; remove it"};
}

Result<void> write_result(Session& session, const std::string& path, std::string_view bytes,
                          bool sync) {
  OutputRules rules;
  WriteOptions options;
  rules.follow_links = options.follow_links = false;
  options.sync = sync;
  return session.write_outputs({{path, bytes}}, rules, options);
}

// ---- what killed processes left --------------------------------------------------------------

void remove_strays(const std::string& directory,
                   const std::optional<std::set<std::string>>& names) {
  std::map<int, bool> processes;  // those that are gone
  // Waits a little for one that was killed with its parent.
  const auto is_gone = [&](int pid) {
    const auto [it, is_new] = processes.try_emplace(pid, false);
    for (int waited = 0; is_new && waited < 200 && !it->second; ++waited) {
      it->second = kill(pid, 0) != 0 && errno == ESRCH;
      if (!it->second) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return it->second;
  };
  std::error_code ec;
  for (auto it = fs::recursive_directory_iterator(
           directory, fs::directory_options::skip_permission_denied, ec);
       !ec && it != fs::recursive_directory_iterator(); it.increment(ec)) {
    if (names) it.disable_recursion_pending();
    const std::string name = it->path().filename().string();
    const auto temporary = temporary_of(name);
    const bool wanted =
        temporary && (!names || std::any_of(names->begin(), names->end(), [&](const auto& target) {
          return is_temporary_of(name, target);
        }));
    if (wanted && is_gone(*temporary)) unlink(it->path().c_str());
  }
}

namespace {

/// Removes what records name and the summary does not need: results and decks of groups that are
/// gone or are others now, unless somebody changed them.
void remove_leftovers(const std::string& directory, const std::map<std::string, Record>& records,
                      const Summary& summary) {
  std::set<std::string> entries, decks, current;
  for (const SummaryEntry& e : summary.entries) {
    entries.insert(e.json);
    decks.insert(nlohmann::json::parse(e.json).at("deck").get<std::string>());
  }
  const auto is_current = [&](const Record& r) {
    return std::any_of(r.entries.begin(), r.entries.end(),
                       [&](const SummaryEntry& e) { return entries.contains(e.json); });
  };
  for (const auto& [path, r] : records)
    if (is_current(r))
      for (const WrittenFile& f : r.outputs) current.insert(f.path);
  const auto remove = [&](const WrittenFile& f) {
    const fs::path relative = fs::path(f.path).lexically_normal();
    if (current.contains(f.path) || relative.is_absolute() || *relative.begin() == ".." ||
        !is_as_written(directory, f))
      return;
    unlink((fs::path(directory) / relative).c_str());
    std::error_code ec;  // directories that are empty now
    for (fs::path up = relative.parent_path();
         !up.empty() && fs::remove(fs::path(directory) / up, ec); up = up.parent_path()) {
    }
  };
  for (const auto& [path, r] : records) {
    for (const WrittenFile& f : r.former) remove(f);
    if (is_current(r)) continue;
    for (const WrittenFile& f : r.outputs) remove(f);
    // What was converted in place must not be converted again, whatever this run said of it.
    const bool listed = std::any_of(r.decks.begin(), r.decks.end(),
                                    [&](const std::string& d) { return decks.contains(d); });
    if (r.before == 0 || !listed) unlink(path.c_str());
  }
}

// ---- documents -------------------------------------------------------------------------------

/// The loss reports of all groups as one.
std::string united_losses(const std::map<std::string, Record>& records, const Summary& summary) {
  std::map<std::string, const std::string*> by_entry;
  for (const auto& [path, r] : records)
    if (!r.losses.empty() && !r.entries.empty())
      by_entry.emplace(r.entries.front().json, &r.losses);
  std::vector<nlohmann::ordered_json> parts;
  for (const SummaryEntry& e : summary.entries)
    if (const auto found = by_entry.find(e.json); found != by_entry.end())
      parts.push_back(nlohmann::ordered_json::parse(*found->second));
  std::string text;
  JsonWriter json(text);
  json.begin_object();
  write_json_head(json, "deck/losses", 1);
  for (const char* kind : {"kept", "approximated", "dropped", "undecided"}) {
    json.key(kind).begin_array();
    for (const auto& part : parts)
      for (const auto& entry : part.at(kind)) json.raw(json_line(entry));
    json.end_array();
  }
  json.end_object();
  return text;
}

/// The results that those of `text` are compared with: the last that were not the same. The summary
/// that is about to be replaced is kept for that. nullopt: there are none.
Result<std::optional<Summary>> keep_previous(Session& session, const std::string& directory,
                                             const std::string& path, const std::string& text) {
  const std::string kept = directory + "/.batch/previous.json";
  if (const auto now = Source::open(path, Limits{}); now && (*now)->bytes() != text)
    if (auto done = write_result(session, kept, (*now)->bytes(), true); !done) return done.error();
  const auto before = Source::open(kept, Limits{});
  if (!before) return std::optional<Summary>();
  auto summary = parse_summary((*before)->bytes());
  return summary ? std::optional<Summary>(std::move(*summary)) : std::nullopt;
}

}  // namespace

Result<void> write_overview(Session& session, const std::string& directory, const Summary& s) {
  const std::string suffix = summary_name(s.shard).substr(std::string_view("summary").size());
  const std::string path = directory + "/" + summary_name(s.shard), text = summary_json(s);
  const std::map<std::string, Record> records = read_records(directory);
  if (s.verb == "convert")
    if (auto done =
            write_result(session, directory + "/losses" + suffix, united_losses(records, s), true);
        !done)
      return done;
  if (s.shard.whole()) {
    remove_leftovers(directory, records, s);
    const auto previous = keep_previous(session, directory, path, text);
    if (!previous) return previous.error();
    std::map<std::string, double> seconds;
    for (const auto& [name, r] : records)
      for (const SummaryEntry& e : r.entries) seconds.emplace(e.json, r.seconds);
    const std::string page = summary_page(s, *previous ? &**previous : nullptr, seconds);
    if (auto done = write_result(session, directory + "/index.html", page, true); !done)
      return done;
  }
  return write_result(session, path, text, true);
}

int report_batch(const BatchOptions& o, const Summary& s, std::size_t kept) {
  if (!o.common.json.empty())
    if (auto written = o.common.session->write_output(o.common.json, summary_json(s)); !written) {
      print_error(o.common, written.error().message);
      return exit_usage;
    }
  if (o.common.wants_text()) {
    const std::size_t nothing = s.count("not-examined");
    const std::string not_examined =
        nothing > 0 ? fmt::format("{} with nothing examined, ", nothing) : std::string();
    const std::size_t left_out = s.count("skipped");
    const std::string skipped = left_out > 0 ? fmt::format("{} skipped, ", left_out) : "";
    std::string text = summary_table(s, text_width(), o.common.color_on(1));
    if (!text.empty()) text += "\n";
    text +=
        fmt::format("{}: {} clean, {} with findings, {}{} unreadable, {}{} failed",
                    count(s.entries.size(), "deck", "decks"), s.count("clean"), s.count("findings"),
                    not_examined, s.count("unreadable"), skipped, s.count("failed"));
    if (kept > 0) text += fmt::format("; {} were finished before", kept);
    print_lines(text + "; " + terminal_text(o.directory) + "/" + summary_name(s.shard) + "\n");
  }
  return s.worst();
}

}  // namespace deck::cli
