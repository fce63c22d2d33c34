// What is to do, the workers that do it, and the end of a run.
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
#include <nlohmann/json.hpp>
#include <thread>

#include "base/shared/hash.hpp"
#include "base/shared/paths.hpp"
#include "lint/shared/config.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

/// Everything but the deck that decides about a result. Files and directories among the options
/// (a configuration, schemas) count with their contents.
std::string settings_of_task(const BatchTask& task) {
  std::string text = program_identity() + "\n" + std::string(task.verb.name) + "\n" +
                     (task.in_place ? "" : task.frame_root);
  const auto add_file = [&](const fs::path& path) {
    text += "\n = " + path.string() + " " + std::to_string(file_hash(path.string()));
  };
  std::error_code ec;
  for (const std::string& word : task.options) {
    text += "\n" + word;
    if (fs::is_regular_file(word, ec)) add_file(word);
    if (!fs::is_directory(word, ec)) continue;
    std::set<fs::path> schemas;
    for (auto it = fs::directory_iterator(word, ec); !ec && it != fs::directory_iterator();
         it.increment(ec))
      if (it->path().extension() == ".json") schemas.insert(it->path());
    for (const fs::path& s : schemas) add_file(s);
  }
  return text;
}

/// Settings that a verb finds by itself, with their contents.
std::string settings_of_deck(const BatchTask& task, const std::string& deck) {
  if (task.verb.name != "lint" && task.verb.name != "gaps" && task.verb.name != "cycle") return {};
  const auto config = find_lint_config(deck);
  if (!config) return {};
  std::string text;
  for (const std::string& path : {config->path, config->baseline, config->compare})
    if (!path.empty()) text += "\n" + path + " " + std::to_string(file_hash(path));
  return text;
}

/// Bar, counts and time left, on a terminal.
class Bar {
 public:
  Bar(bool enabled, std::size_t all) : enabled_(enabled && isatty(2) == 1), all_(all) {}
  Bar(const Bar&) = delete;
  Bar& operator=(const Bar&) = delete;
  ~Bar() { clear(); }

  void count(int code) {
    ++done_;
    if (code == exit_findings) ++findings_;
    if (code > exit_findings) ++failed_;
  }
  void draw() {
    if (!enabled_) return;
    constexpr std::size_t width = 24;
    const std::size_t full = all_ == 0 ? width : done_ * width / all_;
    const double elapsed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    std::string left = "-:--:--";
    if (done_ > 0) {
      const auto s = static_cast<long>(elapsed / static_cast<double>(done_) *
                                       static_cast<double>(all_ - done_));
      left = fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
    }
    fmt::print(stderr, "\r\x1b[K[{}{}] {}/{} decks, {} with findings, {} failed, {} left",
               std::string(full, '#'), std::string(width - full, '.'), done_, all_, findings_,
               failed_, left);
    std::fflush(stderr);
    drawn_ = true;
  }
  void clear() {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
    drawn_ = false;
  }

 private:
  bool enabled_, drawn_ = false;
  std::size_t all_, done_ = 0, findings_ = 0, failed_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

Batch::Batch(const BatchOptions& o, BatchTask task, BatchList list, std::vector<BatchGroup> groups,
             Shard shard)
    : o_(o),
      task_(std::move(task)),
      shard_(shard),
      all_(list.decks.size()),
      includes_(std::move(list.includes)) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!shard_.has(g)) continue;
    Job job{std::move(groups[g]), {}, {}};
    job.result = list.decks[job.group.decks.front()].result;
    for (const std::size_t i : job.group.decks) job.decks.push_back(list.decks[i].path);
    jobs_.push_back(std::move(job));
  }
}

Batch::~Batch() {
  if (lock_ >= 0) close(lock_);
}

std::string Batch::below_directory(const std::string& path) const {
  const std::string root(parent_path(absolute_path(o_.directory + "/index.html")));
  const std::string place = absolute_path(path);
  return place.starts_with(root + "/") ? place.substr(root.size() + 1) : place;
}

/// One process at a time has a shard, and who has the whole has all of them.
Result<void> Batch::lock() {
  const std::string path = in_directory(".batch/lock");
  lock_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (lock_ < 0)
    return Error{Error::Code::io, "cannot create " + path + ": " + std::strerror(errno)};
  // Held until this process ends; its workers do not hold it. File systems without locks do
  // without.
  struct flock part {};
  part.l_type = F_WRLCK;
  part.l_whence = SEEK_SET;
  part.l_start = shard_.whole() ? 0 : static_cast<off_t>(shard_.index);
  part.l_len = shard_.whole() ? 0 : 1;
  if (fcntl(lock_, F_SETLK, &part) != 0 && (errno == EAGAIN || errno == EACCES))
    return Error{Error::Code::config, "another deck batch is writing to " + o_.directory +
                                          "; use --shard, or another directory"};
  return {};
}

Result<void> Batch::prepare() {
  if (auto made = make_own_directory(in_directory(".batch")); !made) return made;
  if (auto locked = lock(); !locked) return locked;
  remove_temporaries();
  known_ = read_records(o_.directory);
  std::map<std::string, std::vector<const Record*>> by_deck;
  for (const auto& [path, record] : known_) {
    // The results of two verbs in one directory could not be told apart.
    if (record.verb != task_.verb.name && !o_.force)
      return Error{Error::Code::config,
                   o_.directory + " holds the results of 'deck " + record.verb +
                       "'; name another directory, or replace them with --force"};
    for (const std::string& deck : record.decks) by_deck[deck].push_back(&record);
    for (const auto* files : {&record.outputs, &record.former})
      for (const WrittenFile& f : *files)
        written_.emplace(absolute_path((fs::path(o_.directory) / f.path).string()), f.hash);
  }
  const std::string settings = settings_of_task(task_);
  IncludeScan scan(o_.common.include_paths);
  for (Job& job : jobs_) {
    std::string text = settings;
    for (const std::string& deck : job.decks) {
      text += settings_of_deck(task_, deck);
      for (const Record* record : by_deck[as_utf8(deck)])
        if (std::find(job.known.begin(), job.known.end(), record) == job.known.end())
          job.known.push_back(record);
    }
    job.settings = content_hash(text);
    if (o_.force || job.known.empty()) continue;
    if (!task_.writes) job.group.contents = files_of_decks(job.decks, scan).contents;
    take_over(job);
  }
  return {};
}

/// Removes the temporary files of a killed run.
void Batch::remove_temporaries() const {
  if (shard_.whole())
    remove_strays(o_.directory);
  else {
    std::set<std::string> names = {summary_name(shard_)};
    for (const Job& job : jobs_) names.insert(job.result);
    remove_strays(o_.directory, names);
  }
  if (!task_.in_place) return;
  std::map<std::string, std::set<std::string>> names;  // by directory
  for (const Job& job : jobs_)
    for (const std::string& file : job.group.files) {
      const fs::path path(file);
      names[path.has_parent_path() ? path.parent_path().string() : "."].insert(
          path.filename().string());
    }
  for (const auto& [directory, files] : names) remove_strays(directory, files);
}

/// What need not be done, and what must not be.
void Batch::take_over(Job& job) const {
  std::vector<std::string> decks;
  for (const std::string& deck : job.decks) decks.push_back(as_utf8(deck));
  const auto own = known_.find(record_path(o_.directory, job.result));
  for (const Record* r : job.known) {
    if (r->settings != job.settings) continue;
    // Documents are named after the first deck, among all of the list.
    const bool named = task_.converts() || (own != known_.end() && r == &own->second);
    const bool as_written = named && r->decks == decks &&
                            std::all_of(r->outputs.begin(), r->outputs.end(), [&](const auto& f) {
                              return is_as_written(o_.directory, f);
                            });
    if (as_written && (r->done ? r->contents == job.group.contents : r->before != 0)) {
      job.record = *r;
      if (r->done) continue;
      job.record->done = true;  // it was announced, and is there
      job.record->contents = job.group.contents;
      (void)write_record(job, *job.record, false);  // else it is looked at once more next time
    } else if (r->before != 0 && r->before != job.group.contents) {
      job.overtaken = true;  // converting it again would count twice
    }
  }
  if (job.record) job.overtaken = false;
}

/// What the worker says, or what is to be said of a worker that is gone.
void Batch::take(Job& job, const JobReport& report) const {
  if (report.answered) job.record = parse_record(report.answer);
  if (job.record && job.record->entries.size() == job.decks.size()) return;
  job.record.emplace();
  // A file that shrinks while it is read ends the worker in an orderly way.
  const int code = report.exit_code == exit_input ? exit_input : exit_internal;
  std::string why = report.why;
  if (const std::string said = first_line(report.err); !said.empty())
    why = report.exit_code == exit_input ? said : why + ": " + said;
  for (const std::string& deck : job.decks)
    job.record->entries.push_back(
        summary_entry({deck, status_of(code), "", code, why, "", "", std::nullopt}));
  // A result of earlier would be taken for this one.
  if (!task_.writes || task_.with_documents) unlink(in_directory(job.result).c_str());
}

/// Number of the signal that ended it, or 0. `kept`: decks that need not be done.
Result<int> Batch::work(std::size_t& kept) {
  std::vector<Job*> todo;
  std::size_t decks = 0;
  for (Job& job : jobs_) {
    if (job.record) {
      kept += job.decks.size();
      continue;
    }
    todo.push_back(&job);
    decks += job.decks.size();
  }
  if (todo.empty()) return 0;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int wanted = o_.jobs == 0 ? processors : o_.jobs;
  const int workers = static_cast<int>(std::min(static_cast<std::size_t>(wanted), todo.size()));
  const int threads = o_.common.threads > 0 ? o_.common.threads : std::max(1, processors / workers);
  task_.options.insert(task_.options.end(),
                       {"--quiet", "--color", "never", "--threads", std::to_string(threads)});
  if (!task_.writes || task_.with_documents)
    task_.options.insert(task_.options.end(), {"--json", "-"});
  if (task_.writes && !task_.in_place)
    task_.options.insert(task_.options.end(), {"--output", o_.directory});
  (void)SchemaSet::built_in();  // once, and not in every worker
  Bar bar(!o_.common.quiet, decks);
  const WorkerPool pool{workers, o_.timeout, [&](std::size_t index, const Captured& output) {
                          return work_on(*todo[index], output);
                        }};
  return pool.run(
      todo.size(),
      [&](const JobReport& report) {
        Job& job = *todo[report.job];
        take(job, report);
        for (std::size_t k = 0; k < job.decks.size(); ++k) {
          const SummaryEntry& entry = job.record->entries[k];
          bar.count(entry.code);
          if (entry.code <= exit_findings || o_.common.quiet) continue;
          bar.clear();
          const std::string why = nlohmann::json::parse(entry.json).at("error").get<std::string>();
          const std::string& path = job.decks[k];  // which most messages begin with
          print_error(o_.common, why.starts_with(path + ":") ? why : path + ": " + why);
        }
      },
      [&] { bar.draw(); });
}

/// Puts the parts together and writes the summary.
int Batch::finish(std::size_t kept) {
  if (const int fd = open(o_.directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); fd >= 0) {
    syncfs(fd);  // the results, before the summary says that they are there
    close(fd);
  }
  std::map<std::size_t, const SummaryEntry*> entries;  // in the order of the list
  for (const Job& job : jobs_)
    for (std::size_t k = 0; k < job.decks.size(); ++k)
      entries.emplace(job.group.decks[k], &job.record->entries[k]);
  Summary s;
  s.tool = std::string(library_version());
  s.verb = std::string(task_.verb.name);
  s.arguments = task_.words;
  s.shard = shard_;
  s.all = all_;
  s.includes = includes_;
  for (const auto& [position, entry] : entries) {
    s.positions.push_back(position);
    s.entries.push_back(*entry);
  }
  if (auto written = write_overview(*o_.common.session, o_.directory, s); !written)
    return fail(written.error().message);
  return report_batch(o_, s, kept);
}

int Batch::run() {
  if (auto prepared = prepare(); !prepared) return fail(prepared.error().message);
  std::size_t kept = 0;
  const auto signal = work(kept);
  if (!signal) return fail(signal.error().message);
  if (*signal != 0) {
    print_error(o_.common, "stopped; finished decks are kept, run the same command to continue");
    ::signal(*signal, SIG_DFL);
    raise(*signal);
  }
  return finish(kept);
}

}  // namespace deck::cli
