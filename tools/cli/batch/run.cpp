// Runs the jobs of a batch with workers; writes summary, page and loss report, and removes
// temporary files.
#include "batch/run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "base/shared/shown_text.hpp"
#include "base/shared/words.hpp"
#include "lint/shared/config.hpp"
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
  if (run.task.converts()) return;
  for (const std::string& name : {job.result, page_name(job.result)})
    unlink(run.o.in_directory(name).c_str());
}

void remove_strays(const fs::path& directory, const std::set<std::string>& names) {
  std::map<int, bool> processes;  // processes that ended
  // Waits briefly for a process that was killed with its parent.
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

/// Removes documents of decks that left the list or changed their group, unless they were edited.
/// Keeps written decks.
void remove_leftovers(const BatchOptions& o, const std::map<std::string, Record>& records,
                      const Json& summary) {
  std::set<std::string> results, decks;
  for (const Json& line : summary.at("decks")) {
    results.insert(text_in(line, "result"));
    decks.insert(text_in(line, "deck"));
  }
  for (const auto& [name, r] : records) {
    const std::string result = fs::path(name).stem().string() + ".json";
    for (const std::string& file : {result, page_name(result)})
      if (const auto written = r.outputs.find(file);
          written != r.outputs.end() && !results.contains(result) &&
          file_hash(o.in_directory(file)) == written->second)
        unlink(o.in_directory(file).c_str());
    if (std::none_of(r.decks.begin(), r.decks.end(),
                     [&](const std::string& d) { return decks.contains(d); }))
      unlink(o.in_directory(name).c_str());
  }
}

/// Combines the loss reports of all groups, in the order of the summary.
std::string united_losses(const std::map<std::string, Record>& records, const Json& summary) {
  std::map<std::string, const Record*> by_line;
  for (const auto& [path, r] : records)
    if (r.losses.is_object() && !r.lines.empty()) by_line.emplace(r.lines.front().dump(), &r);
  Json all = Json::parse(losses_json({}));
  std::set<std::string> done;  // decks done; one may also have a record of an earlier run
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
  for (const auto& [file, text] : documents)  // the summary comes last
    if (written) written = write_result(o, file, text, true);
  if (written && !o.common.json.empty())
    written = o.common.session->write_output(o.common.json, documents[name]);
  if (!written) return failed(o.common, written.error());
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

namespace {

/// A path with the hash of its contents; for a directory those of schemas (JSON) and rule pages.
std::string with_contents(const std::string& path) {
  std::string text = "\n" + path;
  const auto add = [&](const std::string& file) {
    text += " " + file + " " + std::to_string(file_hash(file));
  };
  std::error_code ec;
  if (fs::is_regular_file(path, ec)) add(path);
  for (const fs::path& file : entries_of(path))
    if (file.extension() == ".json" || file.extension() == ".md") add(file.string());
  return text;
}

/// Hash of everything except the deck that affects a result: program, verb, working directory,
/// options, and the contents of files among them.
std::string settings_of_task(const BatchTask& task) {
  std::string text = program_identity() + "\n" + std::string(task.verb.name) + "\n" +
                     (task.in_place ? "" : task.frame_root) + (task.pages ? "\n--html" : "");
  for (const std::string& word : task.options) text += with_contents(word);
  return text;
}

/// Configuration files that a verb finds by itself, with contents.
std::string settings_of_deck(const BatchTask& task, const std::string& deck) {
  std::string text;
  if (task.verb.name == "lint" || task.verb.name == "gaps" || task.verb.name == "cycle")
    if (const auto config = find_lint_config(deck))
      for (const std::string& path : {config->path, config->baseline, config->compare,
                                      config->accepted, config->rules_directory})
        text += with_contents(path);
  return text;
}

/// Only one process at a time may have a shard, or the whole (all shards). This process keeps the
/// lock, not its workers. File systems without locks are accepted.
Result<void> lock_shard(const BatchRun& run) {
  const std::string own = run.o.in_directory(".batch"), path = own + "/lock";
  std::error_code ec;
  fs::create_directories(own, ec);
  if (ec) return Error{Error::Code::io, "cannot make " + own + ": " + ec.message()};
  if (fs::symlink_status(own, ec).type() != fs::file_type::directory)
    return config_error(own +
                        " is a link, not a directory, and leads outside of the results; remove it");
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file < 0)
    return Error{Error::Code::io, "cannot create " + path + ": " + std::strerror(errno)};
  struct flock part {};
  part.l_type = F_WRLCK;
  part.l_whence = SEEK_SET;
  part.l_start = run.shard.whole() ? 0 : static_cast<off_t>(run.shard.index);
  part.l_len = run.shard.whole() ? 0 : 1;
  if (fcntl(file, F_SETLK, &part) != 0 && (errno == EAGAIN || errno == EACCES))
    return config_error("another deck batch is writing to " + run.o.directory +
                        "; use --shard, or another directory");
  return {};
}

/// Removes temporary files of a killed run: below the results, if no other process uses them, and
/// beside decks changed in place.
void remove_temporaries(const BatchRun& run) {
  if (run.shard.whole()) remove_strays(run.o.directory);
  std::map<fs::path, std::set<std::string>> names;  // by directory
  for (const BatchJob& job : run.jobs)
    for (const fs::path file : job.files)
      if (run.task.in_place) names[file.parent_path()].insert(file.filename().string());
  for (const auto& [directory, files] : names) remove_strays(directory, files);
}

/// Uses the record of an earlier run: the job is done, or must not be repeated.
void reuse_record(const BatchRun& run, BatchJob& job, const Record& r) {
  const Record& now = job.record;
  if (r.settings != now.settings) return;
  // Documents are named after the first deck of the group.
  const auto own = run.known.find(record_name(job.result));
  const bool as_written =
      (run.task.converts() || (own != run.known.end() && &r == &own->second)) &&
      r.decks == now.decks &&
      std::all_of(r.outputs.begin(), r.outputs.end(), [&](const auto& file) {
        return file_hash((fs::path(run.o.directory) / file.first).string()) == file.second;
      });
  if (as_written && (r.done ? r.contents == now.contents : r.before != 0)) {
    const std::uint64_t contents = now.contents;
    job.record = r;
    job.done = true;
    if (r.done) return;
    job.record.done = true;  // it was announced, and exists
    job.record.contents = contents;
    // Otherwise the next run does it again.
    (void)write_result(run.o, record_name(job.result), record_text(job.record), false);
  } else if (r.before != 0 && r.before != now.contents) {
    job.overtaken = true;  // a second conversion would be wrong
  }
}

Result<void> prepare(BatchRun& run) {
  if (auto locked = lock_shard(run); !locked) return locked;
  remove_temporaries(run);
  run.known = read_records(run.o.directory);
  std::map<std::string, std::set<const Record*>> by_deck;
  for (const auto& [name, record] : run.known) {
    // Results of two verbs in one directory cannot be distinguished.
    if (record.verb != run.task.verb.name && !run.o.force)
      return config_error(run.o.directory + " holds the results of 'deck " + record.verb +
                          "'; name another directory, or replace them with --force");
    for (const std::string& deck : record.decks) by_deck[deck].insert(&record);
    for (const auto& [file, hash] : record.in_place ? WrittenFiles() : record.outputs)
      run.written.emplace(absolute_path((fs::path(run.o.directory) / file).string()), hash);
  }
  const std::string settings = settings_of_task(run.task);
  IncludeScan scan(run.o.common.include_paths);
  for (BatchJob& job : run.jobs) {
    std::string text = settings;
    std::set<const Record*> known;
    for (const std::string& deck : job.decks) {
      text += settings_of_deck(run.task, deck);
      job.record.decks.push_back(as_utf8(deck));
      known.merge(std::set(by_deck[job.record.decks.back()]));
    }
    job.record.verb = run.task.verb.name;
    job.record.in_place = run.task.in_place;
    job.record.settings = content_hash(text);
    for (const Record* r : known) job.converted = job.converted || r->before != 0;
    if (run.o.force || known.empty()) continue;
    if (!run.task.writes) job.record.contents = files_of_decks(job.decks, scan).contents;
    for (const Record* r : known) reuse_record(run, job, *r);
  }
  return {};
}

/// Stores the answer of a worker, or the reason why there is none.
void store_report(const BatchRun& run, BatchJob& job, const JobReport& report) {
  if (auto record = parse_record(report.answer);
      record && record->lines.size() == job.decks.size()) {
    job.record = std::move(*record);
    return;
  }
  // A file that shrinks during reading ends the worker with exit_input.
  const int code = report.exit_code == exit_input ? exit_input : exit_internal;
  std::string why = report.why;
  if (const std::string said = first_line(report.err); !said.empty())
    why = report.exit_code == exit_input ? said : why + ": " + said;
  for (const std::string& deck : job.decks) job.record.lines.push_back(deck_line(deck, code, why));
  remove_result(run, job);
}

/// Returns the signal that ended it, or 0. `kept`: decks done before.
Result<int> work(BatchRun& run, std::size_t& kept) {
  std::vector<BatchJob*> todo;
  std::size_t decks = 0;
  for (BatchJob& job : run.jobs) {
    (job.done ? kept : decks) += job.decks.size();
    if (!job.done) todo.push_back(&job);
  }
  if (todo.empty()) return 0;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int wanted = run.o.jobs == 0 ? processors : run.o.jobs;
  const int workers = static_cast<int>(std::min(static_cast<std::size_t>(wanted), todo.size()));
  const int threads =
      run.o.common.threads > 0 ? run.o.common.threads : std::max(1, processors / workers);
  const auto add = [&](const std::vector<std::string>& words) {
    run.task.options.insert(run.task.options.end(), words.begin(), words.end());
  };
  add({"--quiet", "--color", "never", "--threads", std::to_string(threads)});
  if (!run.task.converts()) add({"--json", "-"});
  if (run.task.writes && !run.task.in_place) add({"--output", run.o.directory});
  (void)SchemaSet::built_in();  // once, instead of in every worker
  Progress progress(!run.o.common.quiet);
  std::size_t finished = 0;
  const auto start = std::chrono::steady_clock::now();
  const WorkerPool pool{workers, run.o.timeout, [&](std::size_t index, const Captured& output) {
                          return work_on(run, *todo[index], output);
                        }};
  const auto done = [&](const JobReport& report) {
    BatchJob& job = *todo[report.job];
    store_report(run, job, report);
    for (std::size_t k = 0; k < job.decks.size(); ++k) {
      const int code = job.record.lines[k].at("exit_code").get<int>();
      ++finished;
      if (code <= exit_findings || run.o.common.quiet) continue;
      progress.clear();
      const std::string why = text_in(job.record.lines[k], "error");
      const std::string& path = job.decks[k];  // most messages start with it
      print_error(run.o.common, why.starts_with(path + ":") ? why : path + ": " + why);
    }
  };
  return pool.run(todo.size(), done, [&] {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const double left = took.count() / static_cast<double>(std::max<std::size_t>(finished, 1)) *
                        static_cast<double>(decks - finished);
    progress.update(finished, decks,
                    fmt::format("{}/{} decks, {:.0f} s left", finished, decks, left));
  });
}

Json summary_of(const BatchRun& run) {
  std::map<std::size_t, Json> lines;  // in the order of the list
  for (const BatchJob& job : run.jobs)
    for (std::size_t k = 0; k < job.decks.size(); ++k)
      lines.emplace(job.positions[k], job.record.lines[k]);
  Json words = Json::array();
  for (const std::string& word : run.task.words) words.push_back(as_utf8(word));
  return make_summary(run.task.verb.name, words, lines, run.shard, run.list.decks.size());
}

}  // namespace

int run_batch(BatchRun run) {
  const auto fail = [&](const Error& error) { return failed(run.o.common, error); };
  if (auto prepared = prepare(run); !prepared) return fail(prepared.error());
  std::size_t kept = 0;
  const auto signal = work(run, kept);
  if (!signal) return fail(signal.error());
  if (*signal != 0) {
    print_error(run.o.common, "stopped; finished decks are kept, run the same command to continue");
    ::signal(*signal, SIG_DFL);
    raise(*signal);
  }
  if (const int fd = open(run.o.directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); fd >= 0) {
    syncfs(fd);  // writes results to disk before the summary
    close(fd);
  }
  return write_overview(run.o, run.shard, summary_of(run), kept);
}

}  // namespace deck::cli
