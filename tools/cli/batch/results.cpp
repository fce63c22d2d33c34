// What a batch leaves at its end: summary, page, loss report; and no temporary files.
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
#include "report/shared/deck_json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;

Result<void> write_result(const BatchOptions& o, const std::string& name, std::string_view bytes,
                          bool sync) {
  OutputRules rules;
  WriteOptions options;
  rules.follow_links = options.follow_links = false;
  options.sync = sync;
  const OutputFile file{o.in_directory(name), bytes};
  if (auto allowed = o.common.session->check_output(file.path, rules, bytes); !allowed)
    return allowed;
  return write_files_atomic({file}, options);
}

void remove_result(const BatchRun& run, const BatchJob& job) {
  if (!run.task.converts()) unlink(run.o.in_directory(job.result).c_str());
}

void remove_strays(const fs::path& directory, const std::set<std::string>& names) {
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
           directory.empty() ? "." : directory, fs::directory_options::skip_permission_denied, ec);
       !ec && it != fs::recursive_directory_iterator(); it.increment(ec)) {
    if (!names.empty()) it.disable_recursion_pending();
    const std::string name = it->path().filename().string();
    const auto is_of = [&](const std::string& target) { return is_temporary_of(name, target); };
    if (const auto process = temporary_of(name);
        process && (names.empty() || std::any_of(names.begin(), names.end(), is_of)) &&
        is_gone(*process))
      unlink(it->path().c_str());
  }
}

namespace {

/// Removes the documents of decks that are not in the list any more, or in another group, unless
/// somebody changed them. Decks that were written stay.
void remove_leftovers(const BatchOptions& o, const std::map<std::string, Record>& records,
                      const Json& summary) {
  std::set<std::string> results, decks;
  for (const Json& line : summary.at("decks")) {
    results.insert(text_in(line, "result"));
    decks.insert(text_in(line, "deck"));
  }
  for (const auto& [name, r] : records) {
    const std::string result = fs::path(name).stem().string() + ".json";
    const auto written = r.outputs.find(result);
    if (written != r.outputs.end() && !results.contains(result) &&
        file_hash(o.in_directory(result)) == written->second)
      unlink(o.in_directory(result).c_str());
    if (std::none_of(r.decks.begin(), r.decks.end(),
                     [&](const std::string& d) { return decks.contains(d); }))
      unlink(o.in_directory(name).c_str());
  }
}

/// The loss reports of all groups as one, in the order of the summary.
std::string united_losses(const std::map<std::string, Record>& records, const Json& summary) {
  std::map<std::string, const Record*> by_line;
  for (const auto& [path, r] : records)
    if (r.losses.is_object() && !r.lines.empty()) by_line.emplace(r.lines.front().dump(), &r);
  Json all = Json::parse(losses_json({}));
  std::set<std::string> done;  // decks: one may have a record of its own, of an earlier run
  for (const Json& line : summary.at("decks")) {
    const auto found = by_line.find(line.dump());
    if (found == by_line.end() || done.contains(text_in(line, "deck"))) continue;
    done.insert(found->second->decks.begin(), found->second->decks.end());
    for (const char* kind : {"kept", "approximated", "dropped", "undecided"})
      for (const Json& loss : found->second->losses.value(kind, Json::array()))
        all[kind].push_back(loss);
  }
  return json_text(all);
}

}  // namespace

int write_overview(const BatchOptions& o, const Shard& shard, const Json& s, std::size_t kept) {
  const std::string name = summary_name(shard);
  const std::map<std::string, Record> records = read_records(o.directory);
  std::map<std::string, std::string> documents = {{name, json_text(s)}};
  if (text_in(s, "verb") == "convert")
    documents["losses" + name.substr(std::string_view("summary").size())] =
        united_losses(records, s);
  if (shard.whole()) documents["index.html"] = summary_page(s);
  if (shard.whole()) remove_leftovers(o, records, s);
  Result<void> written;
  for (const auto& [file, text] : documents)  // the summary is the last
    if (written) written = write_result(o, file, text, true);
  if (written && !o.common.json.empty())
    written = o.common.session->write_output(o.common.json, documents[name]);
  if (!written) return failed(o.common, written.error().message);
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
