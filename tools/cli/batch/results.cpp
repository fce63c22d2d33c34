// What a batch leaves at its end: summary, page, loss report; and what goes because nobody needs it
// any more.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "batch/run.hpp"
#include "report/shared/losses.hpp"

namespace deck::cli {
namespace fs = std::filesystem;

Result<void> write_result(const BatchOptions& o, const std::string& name, std::string_view bytes,
                          bool sync) {
  OutputRules rules;
  WriteOptions options;
  rules.follow_links = options.follow_links = false;
  options.sync = sync;
  return o.common.session->write_outputs({{o.in_directory(name), bytes}}, rules, options);
}

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
    const auto of_ours = [&](const std::string& target) { return is_temporary_of(name, target); };
    if (const auto process = temporary_of(name);
        process && (!names || std::any_of(names->begin(), names->end(), of_ours)) &&
        is_gone(*process))
      unlink(it->path().c_str());
  }
}

namespace {

/// Removes what records name and the summary does not need: results and decks of groups that are
/// gone or are others now, unless somebody changed them.
void remove_leftovers(const std::string& directory, const std::map<std::string, Record>& records,
                      const Json& summary) {
  std::set<std::string> lines, decks, current;
  for (const Json& line : summary.at("decks")) {
    lines.insert(line.dump());
    decks.insert(text_in(line, "deck"));
  }
  const auto is_current = [&](const Record& r) {
    return std::any_of(r.lines.begin(), r.lines.end(),
                       [&](const Json& line) { return lines.contains(line.dump()); });
  };
  for (const auto& [path, r] : records)
    if (is_current(r))
      for (const auto& [file, hash] : r.outputs) current.insert(file);
  const auto remove = [&](const Record& r, const WrittenFiles& files) {
    for (const auto& file : files) {
      const fs::path relative = fs::path(file.first).lexically_normal();
      const bool result = std::any_of(r.lines.begin(), r.lines.end(), [&](const Json& line) {
        return text_in(line, "result") == file.first;
      });
      if ((r.in_place && !result) || current.contains(file.first) || relative.is_absolute() ||
          *relative.begin() == ".." || !is_as_written(directory, file))
        continue;
      unlink((fs::path(directory) / relative).c_str());
      std::error_code ec;  // directories that are empty now
      for (fs::path up = relative.parent_path();
           !up.empty() && fs::remove(fs::path(directory) / up, ec); up = up.parent_path()) {
      }
    }
  };
  for (const auto& [name, r] : records) {
    remove(r, r.former);
    if (is_current(r)) continue;
    remove(r, r.outputs);
    // What was converted in place must not be converted again, whatever this run said of it.
    const bool listed = std::any_of(r.decks.begin(), r.decks.end(),
                                    [&](const std::string& d) { return decks.contains(d); });
    if (r.before == 0 || !listed) unlink((directory + "/" + name).c_str());
  }
}

/// The loss reports of all groups as one, in the order of the summary.
std::string united_losses(const std::map<std::string, Record>& records, const Json& summary) {
  std::map<std::string, const Json*> by_line;
  for (const auto& [path, r] : records)
    if (r.losses.is_object() && !r.lines.empty())
      by_line.emplace(r.lines.front().dump(), &r.losses);
  Json all = Json::parse(losses_json({}));
  for (const Json& line : summary.at("decks"))
    if (const auto found = by_line.find(line.dump()); found != by_line.end())
      for (const char* kind : {"kept", "approximated", "dropped", "undecided"})
        for (const Json& loss : found->second->value(kind, Json::array()))
          all[kind].push_back(loss);
  return json_text(all);
}

Result<void> write_documents(const BatchOptions& o, const Shard& shard, const Json& summary) {
  const std::string name = summary_name(shard);
  const std::map<std::string, Record> records = read_records(o.directory);
  std::map<std::string, std::string> documents = {{name, json_text(summary)}};
  if (text_in(summary, "verb") == "convert")
    documents["losses" + name.substr(std::string_view("summary").size())] =
        united_losses(records, summary);
  if (shard.whole()) documents["index.html"] = summary_page(summary);
  if (shard.whole()) remove_leftovers(o.directory, records, summary);
  for (const auto& [file, text] : documents)  // the summary is the last
    if (auto done = write_result(o, file, text, true); !done) return done;
  return {};
}

}  // namespace

int write_overview(const BatchOptions& o, const Shard& shard, const Json& s, std::size_t kept) {
  Result<void> written = write_documents(o, shard, s);
  if (written && !o.common.json.empty())
    written = o.common.session->write_output(o.common.json, json_text(s));
  if (!written) {
    print_error(o.common, written.error().message);
    return exit_usage;
  }
  if (o.common.wants_text()) {
    const Json& totals = s.at("totals");
    const auto number = [&](const char* status) { return totals.value(status, std::size_t{0}); };
    const auto if_any = [&](const char* status, const char* what) {
      return number(status) > 0 ? fmt::format("{}{}", number(status), what) : std::string();
    };
    std::string text = summary_table(s, text_width(), o.common.color_on(1));
    if (!text.empty()) text += "\n";
    text += fmt::format("{}: {} clean, {} with findings, {}{} unreadable, {}{} failed",
                        count(number("decks"), "deck", "decks"), number("clean"),
                        number("findings"), if_any("not_examined", " with nothing examined, "),
                        number("unreadable"), if_any("skipped", " skipped, "), number("failed"));
    if (kept > 0) text += fmt::format("; {} were finished before", kept);
    print_lines(text + "; " + terminal_text(o.directory) + "/" + summary_name(shard) + "\n");
  }
  return worst_code(s.at("decks"));
}

}  // namespace deck::cli
