// Runs verbs in the workers and draws the bar.
// Over 600 lines: the stages of one run, from claiming the directory to the summary, on its state.
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
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <unordered_map>

#include "base/shared/count.hpp"
#include "base/shared/escape.hpp"
#include "batch/json.hpp"
#include "deck/text/source.hpp"
#include "lint/shared/config.hpp"
#include "report/shared/json.hpp"

namespace deck::cli {
namespace fs = std::filesystem;
namespace {

/// Everything but the deck that decides about a result. Files and directories among the options
/// (a configuration, schemas) count with their contents.
std::uint64_t key_of(const BatchTask& task) {
  std::string text = program_identity() + "\n" + std::string(task.verb.name) + "\n" +
                     (task.in_place ? "" : task.frame_root);
  const auto add_file = [&](const fs::path& path) {
    if (const auto state = file_state(path.string()))
      text += "\n = " + path.string() + " " + std::to_string(state->hash);
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
  return content_hash(text);
}

/// Settings that a verb finds by itself.
std::vector<std::string> settings_of(const BatchTask& task, const std::string& deck) {
  std::vector<std::string> paths;
  if (task.verb.name != "lint" && task.verb.name != "gaps" && task.verb.name != "cycle")
    return paths;
  const auto config = find_lint_config(deck);
  if (!config) return paths;
  for (const std::string& path : {config->path, config->baseline, config->compare})
    if (!path.empty()) paths.push_back(path);
  return paths;
}

/// What the verdict says, whatever the exit code lets pass; without one whether anything was
/// examined.
std::string_view status_in(const BatchTask& task, int code,
                           const std::optional<DocumentFacts>& facts) {
  if (!facts || code > exit_findings) return status_of(code);
  if (facts->level.empty()) {
    const bool required = std::find(task.options.begin(), task.options.end(),
                                    "--require-examined") != task.options.end();
    return facts->examined.value_or(1) == 0 && (code == exit_clean || required) ? "not-examined"
                                                                                : status_of(code);
  }
  if (facts->level == "not-examined") return facts->level;
  const bool clean = facts->level == "clean" || facts->level == "remarks";
  return clean ? status_of(code) : status_of(exit_findings);
}

}  // namespace

/// Runs a verb as `deck VERB ... DECK...` would; its output goes where standard output goes.
int run_verb(const BatchTask& task, const std::vector<std::string>& decks, Session& session) {
  CommandLine line("", "deck " + std::string(task.verb.name), session);
  const Action action = task.verb.setup(line);
  std::vector<std::string> arguments = task.options;
  arguments.push_back("--");
  arguments.insert(arguments.end(), decks.begin(), decks.end());
  if (const auto parsed = line.parse(std::move(arguments)); !parsed)
    throw std::runtime_error(parsed.error().message);
  return action();
}

std::string first_line(std::string_view text) {
  constexpr std::string_view prefix = "deck: error: ";
  if (text.starts_with(prefix)) text.remove_prefix(prefix.size());
  return std::string(text.substr(0, text.find('\n')));
}

namespace {

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

Batch::Batch(const BatchOptions& o, BatchTask task, BatchList list,
             std::vector<std::vector<std::size_t>> groups, Shard shard)
    : o_(o),
      task_(std::move(task)),
      all_(std::move(list.decks)),
      includes_(std::move(list.includes)),
      shard_(shard) {
  std::vector<bool> ours(all_.size());
  std::vector<const std::vector<std::size_t>*> mine;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!shard_.has(g)) continue;
    mine.push_back(&groups[g]);
    for (const std::size_t i : groups[g]) ours[i] = true;
  }
  std::vector<std::size_t> place(all_.size());
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (!ours[i]) continue;
    place[i] = decks_.size();
    decks_.push_back(all_[i]);
    positions_.push_back(i);
  }
  for (const auto* group : mine) {
    groups_.emplace_back();
    for (const std::size_t i : *group) groups_.back().push_back(place[i]);
  }
}

Batch::~Batch() {
  for (const int fd : {journal_, lock_})
    if (fd >= 0) close(fd);
}

/// What tells our files in .batch from those of other shards.
std::string Batch::label() const {
  return shard_.whole()
             ? "all"
             : "shard-" + std::to_string(shard_.index) + "-of-" + std::to_string(shard_.count);
}

Result<void> make_own_directory(const std::string& path) {
  std::error_code ec;
  fs::create_directories(path, ec);
  if (ec) return Error{Error::Code::io, "cannot make " + path + ": " + ec.message()};
  if (fs::symlink_status(path, ec).type() == fs::file_type::directory) return {};
  return Error{Error::Code::config,
               path + " is a link, not a directory, and leads outside of the results; remove it"};
}

namespace {

/// What the journals know beside the entries of the summary, by entry.
struct Journals {
  std::map<std::string, std::string> losses;  ///< lists of a loss report
  std::map<std::string, double> seconds;
};

/// `own`: what the journal of the name `own_name` holds, where that is known.
Journals read_journals_of(const std::string& directory, const std::string& own_name,
                          const std::vector<const Record*>& own) {
  Journals out;
  const auto take = [&](const Record& record) {
    out.seconds[record.entry] = record.seconds;
    if (!record.losses.empty()) out.losses[record.entry] = record.losses;
  };
  std::error_code ec;
  for (auto it = fs::directory_iterator(directory + "/.batch", ec);
       !ec && it != fs::directory_iterator(); it.increment(ec)) {
    if (it->path().extension() != ".jsonl" || it->path().filename() == own_name) continue;
    const auto source = Source::open(it->path().string(), Limits{});
    if (!source) continue;
    for (const Record& record : parse_records((*source)->bytes())) take(record);
  }
  for (const Record* record : own) take(*record);
  return out;
}

/// The loss reports of the decks of a summary as one.
std::string united_losses(const std::map<std::string, std::string>& losses, const Summary& s) {
  std::string text;
  JsonWriter json(text);
  json.begin_object();
  write_json_head(json, "deck/losses", 1);
  std::vector<nlohmann::ordered_json> parts;
  for (const SummaryEntry& e : s.entries)
    if (const auto found = losses.find(e.json); found != losses.end())
      parts.push_back(nlohmann::ordered_json::parse(found->second));
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

Result<void> write_overview(Session& session, const std::string& directory, const Summary& s,
                            const std::string& own_name, const std::vector<const Record*>& own) {
  const std::string suffix = summary_name(s.shard).substr(std::string_view("summary").size());
  const std::string path = directory + "/" + summary_name(s.shard), text = summary_json(s);
  const Journals journals = read_journals_of(directory, own_name, own);
  if (s.verb == "convert")
    if (auto done = write_result(session, directory + "/losses" + suffix,
                                 united_losses(journals.losses, s), true);
        !done)
      return done;
  if (s.shard.whole()) {
    const auto previous = keep_previous(session, directory, path, text);
    if (!previous) return previous.error();
    const std::string page = summary_page(s, *previous ? &**previous : nullptr, journals.seconds);
    if (auto done = write_result(session, directory + "/index.html", page, true); !done)
      return done;
  }
  return write_result(session, path, text, true);
}

Result<void> write_result(Session& session, const std::string& path, std::string_view bytes,
                          bool sync) {
  OutputRules rules;
  WriteOptions options;
  rules.follow_links = options.follow_links = false;
  options.sync = sync;
  return session.write_outputs({{path, bytes}}, rules, options);
}

/// The results of two verbs in one directory could not be told apart.
Result<void> Batch::claim_directory() const {
  const std::string path = in_directory(".batch/verb");
  const std::string verb(task_.verb.name);
  if (const auto before = Source::open(path, Limits{}); before) {
    const std::string was((*before)->bytes());
    if (was == verb) return {};  // another shard may stand there
    if (!o_.force)
      return Error{Error::Code::config,
                   o_.directory + " holds the results of 'deck " + was +
                       "'; name another directory, or replace them with --force"};
  }
  return write_result(*o_.common.session, path, verb, false);
}

Result<void> Batch::prepare() {
  if (auto made = make_own_directory(in_directory(".batch")); !made) return made;
  const std::string lock = in_directory(".batch/" + label() + ".lock");
  lock_ = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (lock_ < 0)
    return Error{Error::Code::io, "cannot create " + lock + ": " + std::strerror(errno)};
  // Held until this process ends; its workers do not hold it. File systems without locks do
  // without.
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(lock_, F_SETLK, &whole) != 0 && (errno == EAGAIN || errno == EACCES))
    return Error{Error::Code::config, "another deck batch is writing to " + o_.directory +
                                          "; use --shard, or another directory"};
  if (auto claimed = claim_directory(); !claimed) return claimed;
  key_ = key_of(task_);
  records_.resize(decks_.size());
  for (Record& r : records_) r.code = -1;
  std::set<std::string> ours = {label() + ".jsonl", summary_name(shard_)};
  for (const BatchDeck& d : decks_) ours.insert(d.result);
  // What all shards write is only ours where there are no others: they may be at it.
  if (shard_.whole())
    for (const char* name : {"index.html", "losses.json", "verb", "previous.json"})
      ours.insert(name);
  remove_strays(ours);
  read_journals();
  settle_announced();
  // Decks that are written together are finished together.
  for (const std::vector<std::size_t>& group : groups_)
    if (o_.force || std::any_of(group.begin(), group.end(),
                                [&](std::size_t i) { return records_[i].code < 0; }))
      for (const std::size_t i : group) {
        // Written in place already: converting that again would count twice.
        if (!o_.force && task_.in_place && records_[i].code >= 0 && records_[i].written)
          overtaken_.insert(i);
        records_[i].code = -1;
      }
  kept_ = static_cast<std::size_t>(
      std::count_if(records_.begin(), records_.end(), [](const Record& r) { return r.code >= 0; }));
  // Our journal begins with all that is known, without broken lines: also what does not hold any
  // more was written by this batch, should this run be killed as well. finish() shortens it.
  std::set<std::string> lines;
  std::string text;
  for (const Record& r : known_)
    if (std::string line = record_line(r); lines.insert(line).second) text += line;
  const std::string path = in_directory(".batch/" + label() + ".jsonl");
  if (auto written = write_result(*o_.common.session, path, text, task_.in_place); !written)
    return written;
  journal_ = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW);
  if (journal_ < 0)
    return Error{Error::Code::io, "cannot open " + path + ": " + std::strerror(errno)};
  return {};
}

/// Temporary files of these results that a killed process left. Nobody else writes these.
void Batch::remove_strays(const std::set<std::string>& targets) const {
  std::error_code ec;
  for (const std::string& dir : {o_.directory, in_directory(".batch")})
    for (auto it = fs::directory_iterator(dir, ec); !ec && it != fs::directory_iterator();
         it.increment(ec)) {
      const std::string name = it->path().filename().string();
      if (name.size() < 6 || name[0] != '.' || !name.ends_with(".tmp")) continue;
      const auto dot = name.rfind('.', name.size() - 5);
      const std::string target = name.substr(1, dot == 0 ? 0 : dot - 1);
      if (targets.contains(target) && is_temporary_of(name, target)) unlink(it->path().c_str());
    }
}

void Batch::read_journals() {
  std::unordered_map<std::string, std::vector<std::size_t>> wanted;
  for (std::size_t i = 0; i < decks_.size(); ++i) wanted[as_utf8(decks_[i].path)].push_back(i);
  Freshness freshness;
  std::set<fs::path> journals;
  std::error_code ec;
  for (auto it = fs::directory_iterator(in_directory(".batch"), ec);
       !ec && it != fs::directory_iterator(); it.increment(ec))
    if (it->path().extension() == ".jsonl" &&
        it->symlink_status(ec).type() == fs::file_type::regular)
      journals.insert(it->path());
  for (const fs::path& journal : journals) {
    const auto source = Source::open(journal.string(), Limits{});
    if (!source) continue;
    std::vector<Record>& announced = announced_[journal.stem().string()];
    for (Record& read : parse_records((*source)->bytes())) {
      std::erase_if(announced, [&](const Record& a) { return a.deck == read.deck; });
      if (read.announced) {
        announced.push_back(std::move(read));
        continue;
      }
      const auto found = wanted.find(read.deck);
      if (found != wanted.end())
        for (const std::size_t i : found->second) {
          const std::string& result = task_.writes ? read.result : decks_[i].result;
          if (records_[i].code >= 0 || o_.force) continue;
          // Refused, perhaps for a reason that is gone: a file that could not be read just then.
          if (task_.verb.name == "convert" && read.code != exit_clean && !read.written) continue;
          if (freshness.holds(read, o_.directory, key_, result, settings_of(task_, decks_[i].path)))
            records_[i] = read;
          else if (task_.in_place && read.key == key_ && read.written)
            overtaken_.insert(i);
        }
      known_.push_back(std::move(read));
    }
  }
  for (std::size_t i = 0; i < records_.size(); ++i)
    if (records_[i].code >= 0) overtaken_.erase(i);
}

/// In a worker: runs the verb, writes the result, answers with the record.
std::string Batch::work_on(std::size_t group, Captured& output) const {
  if (task_.writes) return write_group(group, output);
  const std::size_t index = groups_[group].front();
  const auto start = std::chrono::steady_clock::now();
  const std::int64_t since = file_clock_now();
  const BatchDeck& deck = decks_[index];
  Record record;
  record.deck = deck.path;
  record.key = key_;
  Session session = *o_.common.session;
  session.on_load = [&](const Deck& loaded) {
    record.files.clear();
    for (std::uint32_t f = 0; f < loaded.sources.size(); ++f)
      record.files.push_back(
          file_state(loaded.sources[f].path(), loaded.sources[f].bytes(), since));
  };
  std::string error, document;
  try {
    record.code = run_verb(task_, {deck.path}, session);
    document = output.out();
  } catch (const std::bad_alloc&) {
    record.code = exit_internal;
    error = "out of memory";
  } catch (const std::exception& e) {
    record.code = exit_internal;
    error = e.what();
  }
  for (const std::string& path : settings_of(task_, deck.path))
    if (auto state = file_state(path)) record.settings.push_back(*state);
  std::optional<DocumentFacts> facts;
  if (error.empty() && record.code > exit_findings) error = first_line(output.err());
  if (!document.empty() && record.code != exit_internal) {
    facts = document_facts(document);
    // Results are flushed together at the end.
    if (!facts) {
      record.code = exit_internal;
      error = "the result is not JSON";
    } else if (auto written =
                   write_result(*o_.common.session, in_directory(deck.result), document, false);
               !written) {
      record.code = exit_usage;
      error = written.error().message;
      facts.reset();
    }
  } else if (record.code <= exit_findings) {
    record.code = exit_internal;
    error = "there is no result";
  }
  if (facts) {
    record.result = deck.result;
    record.bytes = document.size();
    record.hash = content_hash(document);
  } else {
    unlink(in_directory(deck.result).c_str());  // a result of earlier would be taken for this one
  }
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  record.entry = summary_entry(deck.path, status_in(task_, record.code, facts), record.result,
                               record.code, error, facts ? facts->verdict : "",
                               facts ? facts->counts : "{}", facts ? facts->gate : std::nullopt);
  return record_line(record);
}

/// Of the decks of a group, in their order.
std::vector<Record> Batch::records_of(const JobReport& report) const {
  const std::vector<std::size_t>& group = groups_[report.job];
  std::vector<Record> records;
  if (report.answered) {
    records = parse_records(report.message);
    if (records.size() == group.size()) return records;
    records.clear();
  }
  // A file that shrinks while it is read ends the worker in an orderly way.
  const int code = report.exit_code == exit_input ? exit_input : exit_internal;
  std::string why = report.why;
  if (const std::string said = first_line(report.err); !said.empty())
    why = report.exit_code == exit_input ? said : why + ": " + said;
  for (const std::size_t i : group) {
    Record record;
    record.deck = as_utf8(decks_[i].path);
    record.code = code;
    record.entry = summary_entry(decks_[i].path, status_of(record.code), "", code, why, "", "{}");
    if (!task_.writes || task_.with_documents) unlink(in_directory(decks_[i].result).c_str());
    records.push_back(std::move(record));
  }
  return records;
}

/// Only what is finished goes into the journal: the rest is tried again next time.
Result<void> Batch::keep(Record record, std::size_t index) {
  if (record.code <= exit_findings) {
    if (auto noted = note(record_line(record), false); !noted) return noted;
  }
  records_[index] = std::move(record);
  return {};
}

Result<void> Batch::note(const std::string& lines, bool flush) const {
  const ssize_t n = write(journal_, lines.data(), lines.size());
  if (n == static_cast<ssize_t>(lines.size()) && (!flush || fdatasync(journal_) == 0)) return {};
  const int why = n < 0 || n == static_cast<ssize_t>(lines.size()) ? errno : ENOSPC;
  // What comes after a line that was cut off begins a line of its own.
  if (n > 0 && write(journal_, "\n", 1) != 1) errno = why;
  return Error{Error::Code::io,
               "cannot write to " + in_directory(".batch") + ": " + std::strerror(why)};
}

/// Number of the signal that ended it, or 0.
Result<int> Batch::work() {
  std::vector<std::size_t> todo;  // groups
  std::size_t decks_to_do = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (records_[groups_[g].front()].code < 0) {
      todo.push_back(g);
      decks_to_do += groups_[g].size();
    }
  if (todo.empty()) return 0;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int wanted = o_.jobs == 0 ? processors : o_.jobs;
  const int jobs = static_cast<int>(std::min(static_cast<std::size_t>(wanted), todo.size()));
  const int threads =
      o_.common.threads > 0 ? o_.common.threads : std::max(1, processors / std::max(1, jobs));
  task_.options.insert(task_.options.end(),
                       {"--quiet", "--color", "never", "--threads", std::to_string(threads)});
  if (!task_.writes || task_.with_documents)
    task_.options.insert(task_.options.end(), {"--json", "-"});
  if (task_.writes && !task_.in_place)
    task_.options.insert(task_.options.end(), {"--output", o_.directory});
  (void)SchemaSet::built_in();  // once, and not in every worker
  Bar bar(!o_.common.quiet, decks_to_do);
  std::optional<Error> trouble;
  WorkerPool pool(jobs, o_.timeout,
                  [this](std::size_t index, Captured& out) { return work_on(index, out); });
  const auto signal = pool.run(
      todo,
      [&](const JobReport& report) {
        const std::vector<std::size_t>& group = groups_[report.job];
        if (!report.answered) remove_strays({decks_[group.front()].result});
        if (!report.answered && task_.writes) settle(announced_by(group));
        std::vector<Record> records = records_of(report);
        for (std::size_t k = 0; k < group.size() && !trouble; ++k) {
          bar.count(records[k].code);
          if (records[k].code > exit_findings && !o_.common.quiet) {
            bar.clear();
            const auto entry = nlohmann::json::parse(records[k].entry);
            const std::string why = entry.at("error").get<std::string>();
            const std::string& path = decks_[group[k]].path;  // which most messages begin with
            print_error(o_.common, why.starts_with(path + ":") ? why : path + ": " + why);
          }
          if (auto kept = keep(std::move(records[k]), group[k]); !kept) trouble = kept.error();
        }
        return !trouble.has_value();
      },
      [&] { bar.draw(); });
  if (trouble) return *trouble;
  return signal;
}

Summary Batch::summary() const {
  Summary s;
  s.tool = std::string(library_version());
  s.verb = std::string(task_.verb.name);
  s.arguments = task_.words;
  s.shard = shard_;
  s.all = all_.size();
  s.includes = includes_;
  s.positions = positions_;
  for (const Record& r : records_) s.entries.push_back(entry_of(r.entry, r.code));
  return s;
}

/// Leaves what holds, and what was written in place and cannot be done again.
std::vector<const Record*> Batch::lasting() const {
  std::vector<const Record*> out;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    if (records_[i].code <= exit_findings) {
      out.push_back(&records_[i]);
      continue;
    }
    const auto last = std::find_if(known_.rbegin(), known_.rend(), [&](const Record& r) {
      return r.written && r.key == key_ && r.deck == as_utf8(decks_[i].path);
    });
    if (overtaken_.contains(i) && last != known_.rend()) out.push_back(&*last);
  }
  return out;
}

Result<void> Batch::shorten_journal() const {
  std::string text;
  for (const Record* r : lasting()) text += record_line(*r);
  return write_result(*o_.common.session, in_directory(".batch/" + label() + ".jsonl"), text,
                      task_.in_place);
}

/// Puts the parts together and writes the summary.
int Batch::finish() {
  remove_leftovers();
  if (auto shortened = shorten_journal(); !shortened) return fail(shortened.error().message);
  if (const int fd = open(o_.directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); fd >= 0) {
    syncfs(fd);  // the results, before the summary says that they are there
    close(fd);
  }
  const Summary s = summary();
  if (auto written =
          write_overview(*o_.common.session, o_.directory, s, label() + ".jsonl", lasting());
      !written)
    return fail(written.error().message);
  return report_batch(o_, s, kept_);
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

int Batch::run() {
  if (auto prepared = prepare(); !prepared) return fail(prepared.error().message);
  const auto signal = work();
  if (!signal) return fail(signal.error().message);
  if (*signal != 0) {
    print_error(o_.common, "stopped; finished decks are kept, run the same command to continue");
    ::signal(*signal, SIG_DFL);
    raise(*signal);
  }
  return finish();
}

}  // namespace deck::cli
