// A batch in one process: tasks, worker processes, groups of decks.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "batch/record.hpp"
#include "common.hpp"
#include "library.hpp"

namespace deck::cli {

// ---- worker processes: one per job, a fixed number at a time, with a time limit. A worker that
// crashes, hangs or runs out of memory only loses its own job.

/// Output of a worker, in files in memory.
struct Captured {
  int out_file = -1, err_file = -1;
  std::string out() const;
  std::string err() const;
};

/// Result of a job.
struct JobReport {
  std::size_t job = 0;
  std::string answer;  ///< return value of the work; empty: the worker ended before
  int exit_code = -1;  ///< of a worker that exited without an answer; -1: see `why`
  std::string why;     ///< "killed by signal 11 (Segmentation fault)", "no answer in 5 s"
  std::string err;     ///< standard error of a worker without an answer
};

struct WorkerPool {
  int workers = 1;
  double timeout = 0;  ///< seconds for one job; 0: no limit
  /// Runs in a worker; its result becomes JobReport::answer.
  std::function<std::string(std::size_t job, const Captured& output)> work;

  /// Runs jobs 0 ... `jobs` - 1. Calls `done` in this process at each completion, and `tick` about
  /// ten times a second. Returns the signal that stopped it (interrupt, termination, hang-up), or
  /// 0. Error: no process can be started.
  Result<int> run(std::size_t jobs, const std::function<void(const JobReport&)>& done,
                  const std::function<void()>& tick) const;
};

// ---- a run

struct BatchOptions {
  CommonOptions common;
  std::string directory, manifest, verb = "gaps", shard = "1/1";
  int jobs = 0;
  double timeout = 3600;
  bool merge = false, force = false;
  std::string in_directory(const std::string& name) const { return directory + "/" + name; }
};

/// The verb to run, as given in --verb.
struct BatchTask {
  Verb verb;
  std::vector<std::string> words;    ///< options of the verb
  std::vector<std::string> options;  ///< including batch options that are passed on

  // The verb writes decks.
  bool writes = false;
  bool in_place = false;  ///< false: below the output directory
  bool to_json = false;
  bool pages = false;      ///< --html: a page beside each document
  std::string root;        ///< searched for decks that include the same files
  std::string frame_root;  ///< decks keep their relative path below it
  std::map<FileIdentity, std::string> outsiders;  ///< see BatchHooks
  /// Writes only decks; other verbs write a document.
  bool converts() const { return verb.name == "convert"; }
};

/// Decks done together: one, or those that share files if decks are written.
struct BatchJob {
  std::vector<std::size_t> positions = {};  ///< in the list of all decks
  std::vector<std::string> decks = {};      ///< as given
  std::string result = {};                  ///< name of the first deck's result
  std::vector<std::string> files = {};      ///< of the decks, if decks are written
  Record record = {};                       ///< contents 0: not yet computed
  bool done = false;                        ///< the record is of an earlier run
  bool converted = false;                   ///< in place, by an earlier run
  bool overtaken = false;                   ///< and changed since
};

/// Part of a batch in one process. Safe against kill: results are written atomically, the record of
/// a group after them, and a run continues with the valid records. For in-place conversion the
/// record is written first, with the new contents.
struct BatchRun {
  const BatchOptions& o;
  BatchTask task;
  BatchList list;
  Shard shard;
  std::vector<BatchJob> jobs;  ///< of the shard
  std::map<std::string, Record> known = {};
  std::set<WrittenFiles::value_type> written = {};  ///< by earlier runs; absolute path
};
/// Returns the exit code.
int run_batch(BatchRun run);

/// Work of a worker: runs the verb, writes result and record, returns the record as text.
std::string work_on(const BatchRun& run, const BatchJob& job, const Captured& output);

/// The first line of a program's standard error.
std::string first_line(std::string_view text);

/// Writes a result file. Replaces links and pipes of that name, which others may have created, and
/// never follows them. `sync`: see WriteOptions.
Result<void> write_result(const BatchOptions& o, const std::string& name, std::string_view bytes,
                          bool sync);

/// Removes the document of a job without one, which would be an outdated one.
void remove_result(const BatchRun& run, const BatchJob& job);
/// Removes temporary files of a killed process: for these names in a directory, or (without names)
/// for all files below it.
void remove_strays(const std::filesystem::path& directory, const std::set<std::string>& names = {});

/// Writes the summary; for a whole batch also the overview, for conversions the loss report. Prints
/// the totals and writes the document of --json; returns the exit code. `kept`: decks done before.
int write_overview(const BatchOptions& o, const Shard& shard, const Json& summary,
                   std::size_t kept);

}  // namespace deck::cli
